// render_cache.c: a hash table of samples in an arena of limited size, and a list of fault shaders.
#include "render_cache.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "arena.h"
#include "fail.h"

enum { BUCKETS = 4096, MAX_SHADERS = 64 };

struct cached_render {
    struct cached_render *next;
    struct render_key key;
    float *numbers;
};

struct lam_check_cache {
    pthread_mutex_t lock;
    struct fault_shader *shaders[MAX_SHADERS]; // not in use
    int shader_count;
    struct arena arena;
    size_t max_bytes;
    struct cached_render *buckets[BUCKETS];
};

lam_check_cache *lam_check_cache_make(size_t max_bytes, lam_error *error)
{
    lam_check_cache *p = calloc(1, sizeof *p);
    if (!p)
        return fail_memory(error, sizeof *p), NULL;
    pthread_mutex_init(&p->lock, NULL);
    arena_start(&p->arena, NULL);
    p->max_bytes = max_bytes;
    return p;
}

void lam_check_cache_free(lam_check_cache *cache)
{
    if (!cache)
        return;
    for (int i = 0; i < cache->shader_count; i++)
        fault_shader_close(cache->shaders[i]);
    arena_free(&cache->arena);
    pthread_mutex_destroy(&cache->lock);
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
                              k->factors,
                              (uint64_t)k->tone,
                              k->expectation,
                              k->set.words[0],
                              k->set.words[1],
                              k->set.words[2],
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
           a->supports == b->supports && a->tone == b->tone && a->expectation == b->expectation &&
           fault_set_equal(&a->set, &b->set);
}

static const struct cached_render *find(const lam_check_cache *cache, const struct render_key *key)
{
    const struct cached_render *p = cache->buckets[bucket_of(key)];
    while (p && !same(&p->key, key))
        p = p->next;
    return p;
}

// Entries are never changed or removed, so their samples can be read without the lock.
const float *render_cache_find(lam_check_cache *cache, const struct render_key *key)
{
    if (!cache)
        return NULL;
    pthread_mutex_lock(&cache->lock);
    const struct cached_render *found = find(cache, key);
    pthread_mutex_unlock(&cache->lock);
    return found ? found->numbers : NULL;
}

void render_cache_add(lam_check_cache *cache, const struct render_key *key, const float *samples, size_t count)
{
    if (!cache || count > (SIZE_MAX - sizeof(struct cached_render)) / sizeof(float))
        return;
    pthread_mutex_lock(&cache->lock);
    bool fits = cache->arena.total + count * sizeof(float) + sizeof(struct cached_render) <= cache->max_bytes;
    struct cached_render *p = fits && !find(cache, key) ? arena_alloc(&cache->arena, sizeof *p) : NULL;
    float *numbers = p ? arena_array(&cache->arena, count, sizeof *numbers) : NULL;
    if (numbers) {
        memcpy(numbers, samples, count * sizeof *numbers);
        struct cached_render **bucket = &cache->buckets[bucket_of(key)];
        *p = (struct cached_render){*bucket, *key, numbers};
        *bucket = p;
    }
    pthread_mutex_unlock(&cache->lock);
}

struct fault_shader *render_cache_take_shader(lam_check_cache *cache, const lam_check_painter *painter, int size,
                                              int stride, lam_error *error)
{
    struct fault_shader *shader = NULL;
    if (cache) {
        pthread_mutex_lock(&cache->lock);
        for (int i = 0; i < cache->shader_count && !shader; i++)
            if (fault_shader_draws(cache->shaders[i], size, stride)) {
                shader = cache->shaders[i];
                cache->shaders[i] = cache->shaders[--cache->shader_count];
            }
        pthread_mutex_unlock(&cache->lock);
    }
    if (!shader)
        return fault_shader_open(painter, size, stride, error);
    if (fault_shader_wake(shader, error))
        return shader;
    fault_shader_close(shader);
    return NULL;
}

void render_cache_keep_shader(lam_check_cache *cache, struct fault_shader *shader)
{
    bool kept = false;
    if (cache && shader) {
        fault_shader_rest(shader);
        pthread_mutex_lock(&cache->lock);
        kept = cache->shader_count < MAX_SHADERS;
        if (kept)
            cache->shaders[cache->shader_count++] = shader;
        pthread_mutex_unlock(&cache->lock);
    }
    if (!kept)
        fault_shader_close(shader);
}
