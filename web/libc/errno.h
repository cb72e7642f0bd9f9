// errno.h: wasi-libc's header, whose errno is one number for all threads, because it was compiled without threads. The
// threads of a pool make no system calls.
#ifndef WEB_ERRNO_H
#define WEB_ERRNO_H

#define _Thread_local
#include_next <errno.h>
#undef _Thread_local

#endif
