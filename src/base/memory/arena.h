// arena.h: memory that is freed all at once.
//
// Small requests are suballocated from blocks that grow up to a huge page; requests of 1 MiB and more get pages of their
// own, advised to be huge pages (first touch of fresh memory is three times as fast with them). Memory is not zeroed
// unless the function says so. One thread at a time.
#ifndef ARENA_H
#define ARENA_H

#include "call_control.h"

#include <stdarg.h>
#include <stddef.h>

struct arena_block;
struct arena {
    struct arena_block *blocks;
    struct call_control *call; // charged for allocations; may be NULL
    size_t total;              // bytes held
    bool large;                // the first block is one of the largest
};

void arena_start(struct arena *arena, struct call_control *call);
void arena_start_large(struct arena *arena, struct call_control *call); // Starts with a block of the largest size.
void arena_free(struct arena *arena); // frees everything; the arena is empty and usable again
// An arena on the heap (NULL: out of memory), and its end with everything in it (NULL is fine).
struct arena *arena_new(struct call_control *call);
void arena_delete(struct arena *arena);

// Aligned to 64 bytes for 64 bytes and more, else to 16. NULL when memory or the call's budget is exhausted
// (call_memory_error reports which). Size 0 gives a valid pointer.
void *arena_alloc(struct arena *arena, size_t bytes);
void *arena_alloc_zeroed(struct arena *arena, size_t bytes);

// Allocates `count` items of `size` bytes. Returns NULL also if the product overflows.
void *arena_array(struct arena *arena, size_t count, size_t size);

// Copies a string (NULL stays NULL), copies the first `length` bytes as a string, or formats a string.
char *arena_string(struct arena *arena, const char *text);
char *arena_string_of(struct arena *arena, const char *text, size_t length);
char *arena_vformat(struct arena *arena, const char *format, va_list arguments);

// Makes the arena own `held` bytes at `pages` (pages.h). `charged`: the amount charged to its call for them, to be
// refunded with them. False: out of memory; the caller still owns them.
bool arena_adopt(struct arena *arena, void *pages, size_t held, size_t charged);

// For tests: makes allocation number `countdown` (0: the next) of this thread fail once. Returns −1 if there is none.
void arena_fail_after(long countdown);

#endif
