// environment_cache.c: caches environments, so that many scenes can share them.
#include "environment_cache.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <lambent/path.h>

#include "environment_option.h"

enum { KEPT = 4 };

// Identifies the files from which an environment was read.
struct identity {
    int count;
    struct {
        dev_t device;
        ino_t inode;
        off_t size;
        struct timespec changed;
    } files[LAM_FACE_COUNT];
};

struct entry {
    char *text; // NULL if the entry is free
    lam_color_mode color;
    struct identity identity;
    lam_environment *environment; // NULL while a thread reads the environment
    uint64_t used;                // the time of the entry's last use
};

struct environment_cache {
    pthread_mutex_t lock;
    pthread_cond_t changed;
    struct entry entries[KEPT];
    uint64_t uses;
};

struct environment_cache *environment_cache_make(void)
{
    struct environment_cache *cache = calloc(1, sizeof *cache);
    if (cache) {
        pthread_mutex_init(&cache->lock, NULL);
        pthread_cond_init(&cache->changed, NULL);
    }
    return cache;
}

static void forget(struct entry *entry)
{
    lam_environment_free(entry->environment);
    free(entry->text);
    *entry = (struct entry){0};
}

void environment_cache_free(struct environment_cache *cache)
{
    if (!cache)
        return;
    for (int i = 0; i < KEPT; i++)
        forget(&cache->entries[i]);
    pthread_cond_destroy(&cache->changed);
    pthread_mutex_destroy(&cache->lock);
    free(cache);
}

// Identifies the files of an environment. Returns false if a file cannot be found or the text is not a list of files.
// Reports no error, because reading the environment then fails with an error message.
static bool identify(const char *text, struct identity *identity)
{
    const char *paths[LAM_FACE_COUNT] = {text};
    lam_error unused;
    memset(identity, 0, sizeof *identity);
    if (environment_option_built_in(text))
        return true;
    char *names = strchr(text, ',') ? environment_option_faces(text, paths, &unused) : NULL;
    bool ok = names || !strchr(text, ',');
    int count = names ? LAM_FACE_COUNT : 1;
    for (int i = 0; ok && i < count; i++) {
        struct stat about;
        ok = lam_path_stat(paths[i], &about) == 0;
        if (!ok)
            break;
        identity->files[i].device = about.st_dev;
        identity->files[i].inode = about.st_ino;
        identity->files[i].size = about.st_size;
        identity->files[i].changed = about.st_ctim;
    }
    identity->count = count;
    free(names);
    return ok;
}

static bool is_same(const struct identity *a, const struct identity *b)
{
    bool same = a->count == b->count;
    for (int i = 0; same && i < a->count; i++)
        same = a->files[i].device == b->files[i].device && a->files[i].inode == b->files[i].inode &&
               a->files[i].size == b->files[i].size && a->files[i].changed.tv_sec == b->files[i].changed.tv_sec &&
               a->files[i].changed.tv_nsec == b->files[i].changed.tv_nsec;
    return same;
}

// Returns the entry of an environment. If another thread is reading the environment, waits for that thread. Returns a
// free or evicted entry if the environment has no entry, or NULL if threads are reading environments for all entries.
static struct entry *find(struct environment_cache *cache, const char *text, lam_color_mode color,
                          const struct identity *identity)
{
    struct entry *best = NULL;
    for (int i = 0; i < KEPT; i++) {
        struct entry *entry = &cache->entries[i];
        if (entry->text && entry->color == color && is_same(&entry->identity, identity) &&
            strcmp(entry->text, text) == 0) {
            if (entry->environment)
                return entry;
            pthread_cond_wait(&cache->changed, &cache->lock);
            return find(cache, text, color, identity);
        }
        bool idle = !entry->text || entry->environment;
        if (idle && (!best || entry->used < best->used))
            best = entry;
    }
    if (best)
        forget(best);
    return best;
}

static bool set(lam_scene *scene, const lam_environment *environment, double rotation_rad, lam_error *error)
{
    return lam_scene_set_environment(scene, environment, rotation_rad, error); // the scene keeps a reference
}

// The caller holds the lock; the function releases the lock while it reads the environment.
static bool set_shared(struct environment_cache *cache, const char *text, lam_color_mode color,
                       const struct identity *identity, lam_scene *scene, double rotation_rad,
                       const lam_control *control, lam_error *error)
{
    struct entry *entry = find(cache, text, color, identity);
    if (entry && entry->environment) {
        entry->used = ++cache->uses;
        return set(scene, entry->environment, rotation_rad, error);
    }
    char *copy = entry ? strdup(text) : NULL;
    entry = copy ? entry : NULL; // if memory is short, the environment is not cached
    if (entry)
        *entry = (struct entry){.text = copy, .color = color, .identity = *identity, .used = ++cache->uses};
    pthread_mutex_unlock(&cache->lock);
    lam_environment *environment = environment_option_load(text, color, control, error);
    pthread_mutex_lock(&cache->lock);
    bool ok = environment && set(scene, environment, rotation_rad, error);
    if (entry && environment) {
        entry->environment = environment;
    } else {
        lam_environment_free(environment);
        if (entry)
            forget(entry);
    }
    pthread_cond_broadcast(&cache->changed);
    return ok;
}

bool environment_cache_set(struct environment_cache *cache, const char *text, lam_color_mode color, lam_scene *scene,
                           double rotation_rad, const lam_control *control, lam_error *error)
{
    struct identity identity;
    if (cache && identify(text, &identity)) {
        pthread_mutex_lock(&cache->lock);
        bool ok = set_shared(cache, text, color, &identity, scene, rotation_rad, control, error);
        pthread_mutex_unlock(&cache->lock);
        return ok;
    }
    lam_environment *environment = environment_option_load(text, color, control, error);
    bool ok = environment && set(scene, environment, rotation_rad, error);
    lam_environment_free(environment);
    return ok;
}
