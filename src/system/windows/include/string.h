// string.h: adds functions of POSIX and GNU to mingw-w64's header.
#ifndef WINDOWS_STRING_H
#define WINDOWS_STRING_H

#include_next <string.h>

void *memmem(const void *text, size_t size, const void *word, size_t word_size);
char *strchrnul(const char *text, int letter);
char *strndup(const char *text, size_t size);
char *strcasestr(const char *text, const char *word);
char *strsep(char **text, const char *separators);
// Works like the GNU version, which returns the text.
const char *windows_strerror_r(int reason, char *buffer, size_t size);
#define strerror_r windows_strerror_r

#endif
