// sys/syscall.h: Windows has no system calls with numbers.
