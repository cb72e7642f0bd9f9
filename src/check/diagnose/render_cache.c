// render_cache.c: a table by key, in memory that is bounded and given back at once.
#include "render_cache.h"

#include <stdlib.h>
#include <string.h>

#include "arena.h"
#include "fail.h"

enum { BUCKETS = 4096 };

struct picture {
    struct picture *next;
    struct picture_key key;
    float *numbers;
};

struct lam_check_pictures {
    struct arena arena;
    size_t most;
    struct picture *buckets[BUCKETS];
};

lam_check_pictures *lam_check_pictures_make(size_t bytes_most, lam_error *error)
{
    lam_check_pictures *p = calloc(1, sizeof *p);
    if (!p) {
        fail_memory(error, sizeof *p);
        return NULL;
    }
    arena_start(&p->arena, NULL);
    p->most = bytes_most;
    return p;
}

void lam_check_pictures_free(lam_check_pictures *pictures)
{
    if (pictures)
        arena_free(&pictures->arena);
    free(pictures);
}

static size_t bucket_of(const struct picture_key *k)
{
    const uint64_t parts[] = {(uint64_t)k->scene,
                              (uint64_t)k->contract,
                              (uint64_t)k->light_frame,
                              (uint64_t)k->reflection,
                              (uint64_t)k->vertex_lit,
                              (uint64_t)k->size,
                              (uint64_t)k->room,
                              k->offers,
                              k->set};
    uint64_t hash = 14695981039346656037u; // FNV-1a, a number at a time
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        hash = (hash ^ parts[i] ^ parts[i] >> 29) * 1099511628211u;
    return (hash >> 40) % BUCKETS;
}

static bool same(const struct picture_key *a, const struct picture_key *b)
{
    return a->scene == b->scene && a->contract == b->contract && a->light_frame == b->light_frame &&
           a->reflection == b->reflection && a->vertex_lit == b->vertex_lit && a->size == b->size &&
           a->room == b->room && a->offers == b->offers && a->set == b->set;
}

const float *render_cache_find(const lam_check_pictures *pictures, const struct picture_key *key)
{
    if (!pictures)
        return NULL;
    for (const struct picture *p = pictures->buckets[bucket_of(key)]; p; p = p->next)
        if (same(&p->key, key))
            return p->numbers;
    return NULL;
}

float *render_cache_add(lam_check_pictures *pictures, const struct picture_key *key, size_t count)
{
    if (!pictures || count > (SIZE_MAX - sizeof(struct picture)) / sizeof(float) ||
        pictures->arena.total + count * sizeof(float) + sizeof(struct picture) > pictures->most)
        return NULL;
    struct picture *p = arena_alloc(&pictures->arena, sizeof *p);
    float *numbers = p ? arena_array(&pictures->arena, count, sizeof *numbers) : NULL;
    if (!numbers)
        return NULL;
    struct picture **bucket = &pictures->buckets[bucket_of(key)];
    *p = (struct picture){*bucket, *key, numbers};
    *bucket = p;
    return numbers;
}
