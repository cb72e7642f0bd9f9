// posix.c: implements functions of POSIX and GNU that mingw-w64 lacks: strings, processors, waits.
#include <errno.h>
#include <pthread.h>
#include <sched.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <windows.h>

// --- strings

void *memmem(const void *text, size_t size, const void *word, size_t word_size)
{
    const char *at = text, *end = at + size, *first = word;
    if (!word_size)
        return (void *)(uintptr_t)text;
    for (; (size_t)(end - at) >= word_size; at++) {
        at = memchr(at, *first, (size_t)(end - at) - word_size + 1);
        if (!at || memcmp(at, word, word_size) == 0)
            return (void *)(uintptr_t)at;
    }
    return NULL;
}

char *strchrnul(const char *text, int letter)
{
    const char *found = strchr(text, letter);
    return (char *)(uintptr_t)(found ? found : text + strlen(text));
}

char *strndup(const char *text, size_t size)
{
    size_t length = strnlen(text, size);
    char *copy = malloc(length + 1);
    if (copy) {
        memcpy(copy, text, length);
        copy[length] = 0;
    }
    return copy;
}

char *strcasestr(const char *text, const char *word)
{
    size_t size = strlen(word);
    for (; *text && _strnicmp(text, word, size) != 0; text++)
        ;
    return *text || !size ? (char *)(uintptr_t)text : NULL;
}

char *strsep(char **text, const char *separators)
{
    char *begin = *text;
    if (begin) {
        char *end = begin + strcspn(begin, separators);
        *text = *end ? end + 1 : NULL;
        *end = 0;
    }
    return begin;
}

const char *windows_strerror_r(int reason, char *buffer, size_t size)
{
    (void)buffer, (void)size;
    return strerror(reason); // stored per thread
}

// --- the machine

int sched_getaffinity(int process, size_t size, cpu_set_t *set)
{
    DWORD_PTR own, all;
    (void)process, (void)size;
    if (!GetProcessAffinityMask(GetCurrentProcess(), &own, &all))
        return -1;
    *set = __builtin_popcountll(own);
    return 0;
}

int windows_hostname(char *name, size_t size)
{
    DWORD length = (DWORD)size;
    return GetComputerNameA(name, &length) ? 0 : -1;
}

// --- waiting

static int64_t nanoseconds(clockid_t clock)
{
    struct timespec now;
    clock_gettime(clock, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

#undef pthread_cond_timedwait
int windows_cond_timedwait(pthread_cond_t *changed, pthread_mutex_t *mutex, const struct timespec *until)
{
    int64_t at = (int64_t)until->tv_sec * 1000000000 + until->tv_nsec - nanoseconds(CLOCK_MONOTONIC) +
                 nanoseconds(CLOCK_REALTIME);
    return pthread_cond_timedwait(changed, mutex, &(struct timespec){at / 1000000000, (long)(at % 1000000000)});
}
