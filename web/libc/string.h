// string.h: wasi-libc's header, with GNU's strerror_r, which returns the text.
#ifndef WEB_STRING_H
#define WEB_STRING_H

#include_next <string.h>

static inline const char *web_strerror_r(int reason, char *buffer, size_t size)
{
    (void)buffer, (void)size;
    return strerror(reason); // one thread
}
#define strerror_r web_strerror_r

#endif
