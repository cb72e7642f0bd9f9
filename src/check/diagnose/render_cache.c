// render_cache.c: a hash table of samples in an arena of bounded size.
#include "render_cache.h"

#include <stdlib.h>
#include <string.h>
#include <string.h>

#include "arena.h"
#include "fail.h"

enum { BUCKETS = 4096 };

struct cached_render {
    struct cached_render *next;
    struct render_key key;
    float *numbers;
};

struct lam_check_cache {
    struct arena arena;
    size_t max_bytes;
    struct cached_render *buckets[BUCKETS];
};

lam_check_cache *lam_check_cache_make(size_t max_bytes, lam_error *error)
{
    lam_check_cache *p = calloc(1, sizeof *p);
    if (!p) {
        fail_memory(error, sizeof *p);
        return NULL;
    }
    arena_start(&p->arena, NULL);
    p->max_bytes = max_bytes;
    return p;
}

void lam_check_cache_free(lam_check_cache *cache)
{
    if (cache)
        arena_free(&cache->arena);
    free(cache);
}

static uint64_t bits_of(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static size_t bucket_of(const struct render_key *k)
{
    const uint64_t parts[] = {(uint64_t)k->scene,
                              k->contract,
                              k->declared,
                              k->numbers,
                              (uint64_t)k->light_frame,
                              (uint64_t)k->reflection,
                              (uint64_t)k->vertex_lit,
                              (uint64_t)k->size,
                              (uint64_t)k->light_capacity,
                              k->supports,
                              k->expectation,
                              k->set.words[0],
                              k->set.words[1],
                              bits_of(k->set.factor),
                              bits_of(k->set.constant)};
    uint64_t hash = 14695981039346656037u; // FNV-1a, one number at a time
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        hash = (hash ^ parts[i] ^ parts[i] >> 29) * 1099511628211u;
    return (hash >> 40) % BUCKETS;
}

static bool same(const struct render_key *a, const struct render_key *b)
{
    return a->scene == b->scene && a->contract == b->contract && a->declared == b->declared &&
           a->numbers == b->numbers && a->light_frame == b->light_frame && a->reflection == b->reflection &&
           a->vertex_lit == b->vertex_lit && a->size == b->size && a->light_capacity == b->light_capacity &&
           a->supports == b->supports && a->expectation == b->expectation && fault_set_equal(&a->set, &b->set);
}

const float *render_cache_find(const lam_check_cache *cache, const struct render_key *key)
{
    if (!cache)
        return NULL;
    for (const struct cached_render *p = cache->buckets[bucket_of(key)]; p; p = p->next)
        if (same(&p->key, key))
            return p->numbers;
    return NULL;
}

float *render_cache_add(lam_check_cache *cache, const struct render_key *key, size_t count)
{
    if (!cache || count > (SIZE_MAX - sizeof(struct cached_render)) / sizeof(float) ||
        cache->arena.total + count * sizeof(float) + sizeof(struct cached_render) > cache->max_bytes)
        return NULL;
    struct cached_render *p = arena_alloc(&cache->arena, sizeof *p);
    float *numbers = p ? arena_array(&cache->arena, count, sizeof *numbers) : NULL;
    if (!numbers)
        return NULL;
    struct cached_render **bucket = &cache->buckets[bucket_of(key)];
    *p = (struct cached_render){*bucket, *key, numbers};
    *bucket = p;
    return numbers;
}
