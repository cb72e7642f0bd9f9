// arena.h: memory that is freed all at once.
//
// Small requests are allocated from shared blocks, whose size grows up to the size of a huge page. Requests of 1 MiB
// and more get pages of their own. The arena asks the system for huge pages, because the first access is then three
// times as fast. Memory is zeroed only if the function's comment states this. Only one thread at a time may use an
// arena.
#ifndef ARENA_H
#define ARENA_H

#include "call_control.h"

#include <stdarg.h>
#include <stddef.h>

struct arena_block;
struct arena {
    struct arena_block *blocks;
    struct call_control *call; // allocations count towards this call's memory limit; may be NULL
    size_t total;              // bytes allocated
    bool large;                // the first block has the largest size
};

void arena_start(struct arena *arena, struct call_control *call);
void arena_start_large(struct arena *arena, struct call_control *call); // Starts with a block of the largest size.
void arena_free(struct arena *arena); // frees everything; the arena is then empty and can be used again
// These functions allocate and free an arena on the heap. arena_new returns NULL if memory runs out; arena_delete frees
// everything in the arena and accepts NULL.
struct arena *arena_new(struct call_control *call);
void arena_delete(struct arena *arena);

// Allocates memory, aligned to 64 bytes for requests of 64 bytes or more, and to 16 bytes otherwise. Returns NULL if
// memory or the call's budget is exhausted (call_memory_error reports which). For size 0, the pointer is valid.
void *arena_alloc(struct arena *arena, size_t bytes);
void *arena_alloc_zeroed(struct arena *arena, size_t bytes);

// Allocates `count` items of `size` bytes. Also returns NULL if the product overflows.
void *arena_array(struct arena *arena, size_t count, size_t size);

// These functions copy a string (NULL gives NULL), copy the first `length` bytes of a text as a string, or format a
// string.
char *arena_string(struct arena *arena, const char *text);
char *arena_string_of(struct arena *arena, const char *text, size_t length);
char *arena_vformat(struct arena *arena, const char *format, va_list arguments);

// Makes the arena the owner of `held` bytes at `pages` (pages.h). `charged` is the number of bytes for these pages that
// already count towards the call's memory limit; arena_free subtracts this number. Returns false if memory runs out;
// the caller then still owns the pages.
bool arena_adopt(struct arena *arena, void *pages, size_t held, size_t charged);

// For tests: makes allocation number `countdown` of this thread fail once; 0 is the next allocation. −1 disables this.
void arena_fail_after(long countdown);

#endif
