// streams.c: memory streams, reading of lines, and waiting for pipes.
//
// A Windows stream cannot call functions of the program, so a memory stream is a temporary file. Windows keeps the file
// in its cache, and removes the file when the stream is closed. fflush and fclose copy the file's bytes to the caller's
// memory.
#include "names.h"

#include <errno.h>
#include <fcntl.h>
#include <io.h>
#include <poll.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <windows.h>

#undef fclose
#undef fflush

// --- streams in memory

static struct memory_stream {
    FILE *file;
    char **text;
    size_t *size;
    char *fixed; // for fmemopen: the caller's memory of `capacity` bytes, used instead of `text`; otherwise NULL
    size_t capacity;
    struct memory_stream *next;
} *streams;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

static FILE *start(struct memory_stream how)
{
    wchar_t folder[MAX_PATH + 1], path[MAX_PATH + 1];
    struct memory_stream *stream = calloc(1, sizeof *stream);
    if (stream && GetTempPathW(MAX_PATH, folder) && GetTempFileNameW(folder, L"lam", 0, path))
        stream->file = _wfopen(path, L"w+bTD");
    if (!stream || !stream->file) {
        free(stream);
        return NULL;
    }
    how.file = stream->file;
    *stream = how;
    pthread_mutex_lock(&lock);
    stream->next = streams;
    streams = stream;
    pthread_mutex_unlock(&lock);
    return stream->file;
}

FILE *open_memstream(char **text, size_t *size)
{
    *text = NULL;
    *size = 0;
    return start((struct memory_stream){.text = text, .size = size});
}

FILE *fmemopen(void *data, size_t size, const char *mode)
{
    (void)mode;
    return start((struct memory_stream){.fixed = data, .capacity = size});
}

// Copies the stream's bytes to the caller's memory. Returns false if memory runs out or an earlier write has failed.
static bool give_text(const struct memory_stream *stream)
{
    if (fflush(stream->file) != 0 || ferror(stream->file))
        return false;
    long long end = _ftelli64(stream->file);
    if (stream->fixed) {
        size_t size = end >= 0 && (size_t)end < stream->capacity ? (size_t)end : stream->capacity;
        rewind(stream->file);
        return end >= 0 && fread(stream->fixed, 1, size, stream->file) == size &&
               _fseeki64(stream->file, end, SEEK_SET) == 0;
    }
    char *text = end >= 0 ? realloc(*stream->text, (size_t)end + 1) : NULL;
    if (!text)
        return false;
    *stream->text = text;
    rewind(stream->file);
    *stream->size = fread(text, 1, (size_t)end, stream->file);
    text[*stream->size] = 0;
    return *stream->size == (size_t)end && _fseeki64(stream->file, end, SEEK_SET) == 0;
}

// Returns the address of the list's pointer to a stream. If the list does not contain the stream, returns the address
// of the last pointer, which is NULL. The caller must hold the list's lock.
static struct memory_stream **find(FILE *file)
{
    struct memory_stream **at = &streams;
    while (*at && (*at)->file != file)
        at = &(*at)->next;
    return at;
}

int windows_fflush(FILE *file)
{
    pthread_mutex_lock(&lock);
    struct memory_stream *stream = file ? *find(file) : NULL;
    pthread_mutex_unlock(&lock);
    return stream ? (give_text(stream) ? 0 : EOF) : fflush(file);
}

int windows_fclose(FILE *file)
{
    pthread_mutex_lock(&lock);
    struct memory_stream **at = find(file), *stream = *at;
    if (stream)
        *at = stream->next;
    pthread_mutex_unlock(&lock);
    bool ok = !stream || give_text(stream);
    free(stream);
    return fclose(file) == 0 && ok ? 0 : EOF;
}

// --- lines

ssize_t getline(char **line, size_t *capacity, FILE *file)
{
    size_t size = 0;
    for (int letter = 0; letter != '\n' && (letter = getc(file)) != EOF;) {
        if (size + 2 > *capacity || !*line) {
            size_t larger = *line && *capacity ? 2 * *capacity : 128;
            char *grown = realloc(*line, larger);
            if (!grown)
                return -1;
            *line = grown;
            *capacity = larger;
        }
        (*line)[size++] = (char)letter;
        (*line)[size] = 0;
    }
    return size ? (ssize_t)size : -1;
}

// --- waiting

// Returns whether a read would return immediately. Only pipes are checked; other files are always ready.
static bool is_ready(int file)
{
    HANDLE handle = (HANDLE)_get_osfhandle(file);
    DWORD bytes = 0;
    return GetFileType(handle) != FILE_TYPE_PIPE || !PeekNamedPipe(handle, NULL, 0, NULL, &bytes, NULL) || bytes;
}

int poll(struct pollfd *files, nfds_t count, int wait_ms)
{
    for (ULONGLONG start = GetTickCount64();; Sleep(5)) {
        int ready = 0;
        for (nfds_t i = 0; i < count; i++) {
            files[i].revents = 0;
            if (files[i].fd >= 0)
                files[i].revents =
                    files[i].events & POLLIN && is_ready(files[i].fd) ? POLLIN : files[i].events & POLLOUT;
            ready += files[i].revents != 0;
        }
        if (ready || (wait_ms >= 0 && GetTickCount64() - start >= (ULONGLONG)wait_ms))
            return ready;
    }
}
