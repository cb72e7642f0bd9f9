// failing_memory.h: a test program's own malloc, calloc, realloc, aligned_alloc, posix_memalign, mmap, read and pread, which fail
// or fall short when told to. Everything in the process gets them, the libraries too; in builds with sanitizers, whose
// allocator must stay, only Lambent's own calls (ld --wrap).
#ifndef FAILING_MEMORY_H
#define FAILING_MEMORY_H

#include <stdbool.h>
#include <stddef.h>

// The request with this number, from 0, fails; with `onwards` all later ones too. −1: none fails. Counting begins anew.
void memory_fail_at(long number, bool onwards);
long memory_requests(void); // since then
bool memory_failed(void);   // whether one has failed since then

// Requests of this library, by a part of its file's name, never fail and are not counted: what it does without memory is not
// Lambent's. It has been loaded.
void memory_spare(const char *library);

// What is held now: blocks that were not freed, and bytes that are mapped. In builds with sanitizers, which search for leaks
// themselves, blocks are not counted: some are the C library's until Lambent frees them.
struct memory_held {
    long blocks, mapped;
};
struct memory_held memory_held(void);

// Reads of regular files return at most `bytes` each; 0: no bound.
void reads_return_at_most(size_t bytes);
// The read that would pass this offset stops there, and the next one fails with EIO (`error`) or says that the file ends.
// −1: none.
void reads_end_at(long offset, bool error);
bool reads_ended(void); // whether that was reached since then

#endif
