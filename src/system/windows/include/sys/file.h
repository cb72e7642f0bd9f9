// sys/file.h: locks whole files; Windows releases the locks when the process ends, as POSIX does.
#ifndef WINDOWS_FILE_H
#define WINDOWS_FILE_H

#define LOCK_EX 2
#define LOCK_NB 4

// Acquires an exclusive lock without waiting for it. Fails with EWOULDBLOCK while another process has the lock.
int flock(int file, int operation);

#endif
