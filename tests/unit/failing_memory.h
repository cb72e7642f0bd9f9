// failing_memory.h: a test program's own malloc, calloc, realloc, aligned_alloc, posix_memalign, mmap, read and pread,
// which fail or return less on request. Everything in the process uses them, including the libraries; in builds with
// sanitizers, whose allocator must stay, only Lambent's own calls use them (ld --wrap).
#ifndef FAILING_MEMORY_H
#define FAILING_MEMORY_H

#include <stdbool.h>
#include <stddef.h>

// The request with this number, from 0, fails; with `onwards`, all later ones fail too. With −1, none fails. Counting
// restarts.
void memory_fail_at(long number, bool onwards);
long memory_requests(void); // since then
bool memory_failed(void);   // whether a request has failed since then

// Requests of this library, given by a part of its file's name, never fail and are not counted, because Lambent does
// not determine its behaviour without memory. The library must have been loaded.
void memory_spare(const char *library);

// The memory in use: blocks that were not freed, and mapped bytes. In builds with sanitizers, which search for leaks
// themselves, blocks are not counted, because some belong to the C library until Lambent frees them.
struct memory_held {
    long blocks, mapped;
};
struct memory_held memory_held(void);

// Reads of regular files return at most `bytes` each; 0 means no limit.
void reads_return_at_most(size_t bytes);
// The read that would pass this offset stops there, and the next one fails with EIO (`error`) or reports the end of the
// file. −1 means no limit.
void reads_end_at(long offset, bool error);
bool reads_ended(void); // whether that offset was reached since then

#endif
