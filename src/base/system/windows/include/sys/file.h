// sys/file.h: locks of whole files, which Windows drops with the process as POSIX does.
#ifndef WINDOWS_FILE_H
#define WINDOWS_FILE_H

#define LOCK_EX 2
#define LOCK_NB 4

// An exclusive lock, without waiting for it. Fails with EWOULDBLOCK while another process has it.
int flock(int file, int operation);

#endif
