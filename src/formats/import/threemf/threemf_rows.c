// threemf_rows.c: growing arrays that count towards the call's memory limit.
#include "threemf.h"

#ifdef HAVE_3MF

#include <stdlib.h>
#include <string.h>

bool threemf_no_memory(struct threemf *file, size_t bytes)
{
    return call_memory_error(file->source->call, bytes, file->error);
}

bool threemf_reserve(struct threemf *file, struct threemf_rows *rows, size_t size, size_t count)
{
    struct call_control *call = file->source->call;
    if (count <= rows->capacity)
        return true;
    size_t capacity = 2 * rows->capacity > count ? 2 * rows->capacity : count + 15, bytes;
    if (__builtin_mul_overflow(capacity, size, &bytes) || !call_charge(call, bytes))
        return threemf_no_memory(file, capacity);
    void *moved = realloc(rows->items, bytes);
    call_refund(call, moved ? rows->bytes : bytes);
    if (!moved)
        return threemf_no_memory(file, bytes);
    rows->items = moved;
    rows->capacity = capacity;
    rows->bytes = bytes;
    return true;
}

void *threemf_add(struct threemf *file, struct threemf_rows *rows, size_t size)
{
    if (!threemf_reserve(file, rows, size, rows->count + 1))
        return NULL;
    return memset((char *)rows->items + rows->count++ * size, 0, size);
}

void threemf_rows_free(struct threemf *file, struct threemf_rows *rows)
{
    call_refund(file->source->call, rows->bytes);
    free(rows->items);
    *rows = (struct threemf_rows){0};
}

#endif
