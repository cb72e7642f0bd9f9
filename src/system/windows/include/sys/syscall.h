// sys/syscall.h: Windows has no numbered system calls.
