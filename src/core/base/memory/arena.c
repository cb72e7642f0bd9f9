// arena.c: memory that is freed all at once.
#include "arena.h"

#include "pages.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    BLOCK_FIRST = 16 << 10,  // size of the first block; each further block is twice as large
    BLOCK_LARGEST = 2 << 20, // size of the largest block: a huge page
    OWN_PAGES = 1 << 20,     // larger requests use separate pages
};

// A block's header. The memory of small blocks follows the header; large blocks point to pages.
struct arena_block {
    struct arena_block *next;
    uint8_t *memory;
    size_t capacity, used;
    bool whole;     // serves a single request
    size_t held;    // if above 0, the size in bytes of the pages at `memory`, which pages_free must release
    size_t charged; // bytes that count towards the call's memory limit
};

static _Thread_local long fail_countdown = -1;

void arena_fail_after(long countdown) { fail_countdown = countdown; }

static bool fails_now(void)
{
    if (fail_countdown < 0)
        return false;
    return fail_countdown-- == 0;
}

void arena_start(struct arena *arena, struct call_control *call) { *arena = (struct arena){.call = call}; }

void arena_start_large(struct arena *arena, struct call_control *call)
{
    *arena = (struct arena){.call = call, .large = true};
}

struct arena *arena_new(struct call_control *call)
{
    struct arena *arena = malloc(sizeof *arena);
    if (arena)
        arena_start(arena, call);
    return arena;
}

void arena_delete(struct arena *arena)
{
    if (arena)
        arena_free(arena);
    free(arena);
}

void arena_free(struct arena *arena)
{
    struct arena_block *block = arena->blocks;
    while (block) {
        struct arena_block *next = block->next;
        if (block->held)
            pages_free(block->memory, block->held);
        if (arena->call)
            call_refund(arena->call, block->charged);
        free(block);
        block = next;
    }
    arena->blocks = NULL;
    arena->total = 0;
}

static void link_block(struct arena *arena, struct arena_block *block)
{
    // The block from which small requests are allocated remains the first in the list.
    if (block->whole && arena->blocks) {
        block->next = arena->blocks->next;
        arena->blocks->next = block;
    } else {
        block->next = arena->blocks;
        arena->blocks = block;
    }
    arena->total += block->charged;
}

static void *own_pages(struct arena *arena, size_t bytes)
{
    if (arena->call && !call_charge(arena->call, bytes))
        return NULL;
    struct arena_block *block = calloc(1, sizeof *block);
    if (block)
        block->memory = pages_get(bytes, &block->held);
    if (!block || !block->memory) {
        free(block);
        if (arena->call)
            call_refund(arena->call, bytes);
        return NULL;
    }
    block->capacity = block->used = block->held;
    block->charged = bytes;
    block->whole = true;
    link_block(arena, block);
    return block->memory;
}

static struct arena_block *new_block(struct arena *arena, size_t bytes)
{
    size_t capacity = arena->large ? BLOCK_LARGEST : BLOCK_FIRST;
    if (arena->blocks && !arena->blocks->whole)
        capacity = arena->blocks->capacity * 2;
    if (capacity > BLOCK_LARGEST)
        capacity = BLOCK_LARGEST;
    if (capacity < bytes + 64)
        capacity = bytes + 64;
    if (arena->call && !call_charge(arena->call, capacity))
        return NULL;
    const bool pages = capacity >= BLOCK_LARGEST;
    struct arena_block *block = malloc(sizeof *block + (pages ? 0 : capacity));
    if (block) {
        *block = (struct arena_block){.memory = (uint8_t *)(block + 1), .capacity = capacity, .charged = capacity};
        if (pages)
            block->memory = pages_get(capacity, &block->held);
    }
    if (!block || !block->memory) {
        free(block);
        if (arena->call)
            call_refund(arena->call, capacity);
        return NULL;
    }
    link_block(arena, block);
    return block;
}

void *arena_alloc(struct arena *arena, size_t bytes)
{
    if (fails_now() || bytes > SIZE_MAX / 4)
        return NULL;
    if (bytes >= OWN_PAGES)
        return own_pages(arena, bytes);
    size_t alignment = bytes >= 64 ? 64 : 16;
    struct arena_block *block = arena->blocks;
    for (int attempt = 0; attempt < 2; attempt++) {
        if (block && !block->whole) {
            uintptr_t at = (uintptr_t)block->memory + block->used;
            size_t gap = (alignment - at % alignment) % alignment;
            if (block->used + gap + bytes <= block->capacity) {
                block->used += gap + bytes;
                return (void *)(at + gap);
            }
        }
        if (attempt == 0)
            block = new_block(arena, bytes);
    }
    return NULL;
}

void *arena_alloc_zeroed(struct arena *arena, size_t bytes)
{
    void *memory = arena_alloc(arena, bytes);
    if (memory && bytes < OWN_PAGES) // pages are already zeroed
        memset(memory, 0, bytes);
    return memory;
}

void *arena_array(struct arena *arena, size_t count, size_t size)
{
    size_t bytes;
    if (__builtin_mul_overflow(count, size, &bytes))
        return NULL;
    return arena_alloc(arena, bytes);
}

char *arena_string_of(struct arena *arena, const char *text, size_t length)
{
    char *copy = arena_alloc(arena, length + 1);
    if (copy) {
        memcpy(copy, text, length);
        copy[length] = 0;
    }
    return copy;
}

char *arena_string(struct arena *arena, const char *text)
{
    return text ? arena_string_of(arena, text, strlen(text)) : NULL;
}

char *arena_vformat(struct arena *arena, const char *format, va_list arguments)
{
    va_list again;
    va_copy(again, arguments);
    int length = vsnprintf(NULL, 0, format, again);
    va_end(again);
    char *text = length < 0 ? NULL : arena_alloc(arena, (size_t)length + 1);
    if (text)
        vsnprintf(text, (size_t)length + 1, format, arguments);
    return text;
}

bool arena_adopt(struct arena *arena, void *pages, size_t held, size_t charged)
{
    struct arena_block *block = fails_now() ? NULL : calloc(1, sizeof *block);
    if (!block)
        return false;
    *block = (struct arena_block){
        .memory = pages, .capacity = held, .used = held, .held = held, .whole = true, .charged = charged};
    link_block(arena, block);
    return true;
}
