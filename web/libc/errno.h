// errno.h: wasi-libc's, whose errno is one number for all threads: it was compiled without any. Those of a pool make no system calls.
#ifndef WEB_ERRNO_H
#define WEB_ERRNO_H

#define _Thread_local
#include_next <errno.h>
#undef _Thread_local

#endif
