// stl_shared.c: reads the positions of a large binary STL as vertices that several facets share.
//
// A binary STL stores three corners for each facet. Programs store neighbouring facets close to one another in the
// file, so a small table of recent vertices finds nearly all corners at the same position. The mesh then needs half the
// memory, and later steps process each vertex once.
//
// The facets are divided into windows, and vertices are shared only within a window. One thread reads the chunks of a
// window in order. Once the vertices of the previous window are counted, the thread knows the indices of its own
// vertices and copies these vertices to the final array. The windows depend only on the number of facets, so the mesh
// does not depend on the number of threads. Closed surfaces that touch are welded at common vertices only within a
// window (normals.h).
#include "stl.h"

#include "loop_status.h"
#include "pages.h"

#include <pthread.h>
#include <string.h>

enum {
    // With few windows, more facets share vertices. With many windows, more threads are busy.
    WINDOWS = 16,     // number of windows, if each window contains at most WINDOW_CHUNKS chunks
    WINDOWS_MAX = 32, // the maximum number of windows
    WINDOW_CHUNKS = THRESHOLD(16, 1),
    FACETS_MIN = THRESHOLD(1 << 16, 24), // smaller files gain little
    TABLE_BITS = THRESHOLD(14, 6),       // the table has 2^TABLE_BITS pairs of vertices: 512 KiB
};

struct recent_vertex {
    uint64_t xy; // bits of the position
    uint32_t z, number;
};

// The two most recent vertices with a given hash. If only one vertex were stored, many vertices of large models would
// be overwritten before the next row of facets uses them.
typedef struct recent_vertex recent_vertices[2];

// Returns the index of a position's pair in the table. The position 0 has index 0.
static inline size_t pair_of(uint64_t xy, uint32_t z)
{
    return (xy * UINT64_C(0x9e3779b97f4a7c15) + z * UINT64_C(0xd6e8feb86659fd93)) >> (64 - TABLE_BITS);
}

static inline bool is_at(const struct recent_vertex *recent, uint64_t xy, uint32_t z)
{
    return ((xy ^ recent->xy) | (z ^ recent->z)) == 0;
}

// The memory of one thread.
struct share_worker {
    recent_vertices *table;
    uint32_t (*positions)[3]; // bits of the positions of the window's vertices
    uint8_t *rows;            // the facets of a chunk, if the file is read in parts
};

// The state of the loop over all windows.
struct sharing {
    const struct import_source *source;
    struct loop_status loop;
    const struct row_bytes *facets;
    size_t window_chunks, chunks, window_vertices; // chunks and maximum number of vertices per window
    struct share_worker *workers;
    struct stl_words *words;
    uint32_t *indices;
    float (*positions)[3];                       // reserved for the maximum number of vertices
    size_t reserved_indices, reserved_positions; // bytes of these arrays that the scene does not own
    int failed;                                  // atomic
    pthread_mutex_t mutex;                       // protects the members below
    pthread_cond_t counted;
    size_t next_window; // the next window to count
    uint32_t vertices;  // number of vertices in the windows before next_window
};

// Finds the vertices of some facets. `count` is the number of vertices so far. Returns the new number. Nearly all
// corners are at the position of the most recent vertex with their hash, and need one comparison. No read address
// depends on an earlier comparison, so the processor does not wait for the comparison.
static uint32_t share_facets(const struct share_worker *worker, const uint8_t *facet, size_t facets, uint32_t count,
                             uint32_t *restrict indices, struct stl_words *words)
{
    recent_vertices *restrict table = worker->table;
    uint32_t(*restrict positions)[3] = worker->positions;
    for (size_t i = 0; i < facets; i++, facet += STL_FACET) {
        for (size_t k = 0; k < 3; k++) {
            const uint8_t *corner = facet + STL_CORNERS + 12 * k;
            uint64_t xy;
            uint32_t z;
            memcpy(&xy, corner, sizeof xy);
            memcpy(&z, corner + 8, sizeof z);
            struct recent_vertex *recent = table[pair_of(xy, z)];
            if (!is_at(&recent[0], xy, z)) {
                // 0, or all bits
                uint32_t is_second = -(uint32_t)is_at(&recent[1], xy, z);
                uint32_t number = count ^ ((count ^ recent[1].number) & is_second);
                recent[1] = recent[0];
                recent[0] = (struct recent_vertex){xy, z, number};
                memcpy(positions[count], corner, sizeof *positions);
                count += 1 + is_second;
            }
            *indices++ = recent[0].number;
        }
        stl_add_word(words, stl_word_of(facet));
    }
    return count;
}

static bool all_finite(uint32_t (*positions)[3], uint32_t count)
{
    uint32_t nonfinite = 0; // bit 31: a number is NaN or infinite
    for (uint32_t i = 0; i < count; i++)
        for (int axis = 0; axis < 3; axis++)
            nonfinite |= (positions[i][axis] & 0x7fffffff) + 0x00800000;
    return !(nonfinite & 0x80000000);
}

// Reads a chunk of a window, and adds its vertices to *count. Returns false if the facets must be read without sharing.
static bool share_chunk(struct sharing *s, struct share_worker *worker, size_t index, uint32_t *count)
{
    const struct import_source *source = s->source;
    size_t first, last;
    parallel_rows_range(s->facets->count, index, &first, &last);
    size_t offset = s->facets->offset + first * STL_FACET;
    const uint8_t *rows = worker->rows ? worker->rows : source->parts.memory + offset;
    if (!should_continue(&s->loop) || *count + 3 * PARALLEL_ROWS > s->window_vertices ||
        (worker->rows &&
         !file_read_part(&source->parts, source->name, offset, worker->rows, (last - first) * STL_FACET, NULL)))
        return false;
    s->words[index] = (struct stl_words){0};
    uint32_t before = *count;
    *count = share_facets(worker, rows, last - first, before, s->indices + 3 * first, &s->words[index]);
    return all_finite(worker->positions + before, *count - before);
}

// Fills empty entries with a position that belongs to another pair, so that no corner is found there. Pair 0 is filled
// with NaN, and all other pairs are filled with the position 0.
static void start_window(struct share_worker *worker)
{
    memset(worker->table, 0, sizeof *worker->table << TABLE_BITS);
    memset(worker->table[0], 0xff, sizeof worker->table[0]);
}

// Waits until the previous window is counted, and counts this window. Returns the number of vertices before this
// window.
static uint32_t count_window(struct sharing *s, size_t index, uint32_t count)
{
    pthread_mutex_lock(&s->mutex);
    while (s->next_window < index)
        pthread_cond_wait(&s->counted, &s->mutex);
    uint32_t before = s->vertices;
    s->vertices += count;
    s->next_window++;
    pthread_cond_broadcast(&s->counted);
    pthread_mutex_unlock(&s->mutex);
    return before;
}

static void share_window(void *user, size_t index, int thread)
{
    struct sharing *s = user;
    struct share_worker *worker = &s->workers[thread];
    size_t first = index * s->window_chunks, end = first + s->window_chunks;
    uint32_t count = 0;
    end = end < s->chunks ? end : s->chunks;
    start_window(worker);
    for (size_t chunk = first; chunk < end && !__atomic_load_n(&s->failed, __ATOMIC_RELAXED); chunk++)
        if (!share_chunk(s, worker, chunk, &count))
            __atomic_store_n(&s->failed, 1, __ATOMIC_RELAXED);
    uint32_t before = count_window(s, index, count);
    if (__atomic_load_n(&s->failed, __ATOMIC_RELAXED))
        return;
    memcpy(s->positions + before, worker->positions, count * sizeof *s->positions);
    size_t corners = 3 * end * PARALLEL_ROWS;
    corners = corners < 3 * s->facets->count ? corners : 3 * s->facets->count;
    for (size_t i = 3 * first * PARALLEL_ROWS; i < corners; i++)
        s->indices[i] += before;
}

static bool start_workers(struct sharing *s, struct arena *scratch)
{
    size_t threads = (size_t)pool_threads(s->source->pool);
    s->workers = arena_array(scratch, threads, sizeof *s->workers);
    for (size_t i = 0; s->workers && i < threads; i++) {
        struct share_worker *worker = &s->workers[i];
        worker->table = arena_array(scratch, (size_t)1 << TABLE_BITS, sizeof *worker->table);
        worker->positions = arena_array(scratch, s->window_vertices + 1, sizeof *worker->positions);
        worker->rows = s->source->parts.memory ? NULL : arena_array(scratch, PARALLEL_ROWS, STL_FACET);
        if (!worker->table || !worker->positions || (!s->source->parts.memory && !worker->rows))
            return false;
    }
    return s->workers != NULL;
}

// Returns whether the facets of the first chunk share vertices: at most half of the corners are at new positions.
static bool first_chunk_shares(struct sharing *s, struct arena *scratch)
{
    uint32_t count = 0;
    s->indices = arena_array(scratch, PARALLEL_ROWS, 3 * sizeof *s->indices);
    start_window(s->workers);
    return s->indices && share_chunk(s, s->workers, 0, &count) && count <= 3 * PARALLEL_ROWS / 2;
}

// Releases the unused end of an array and makes the scene the owner of the array. Returns false if memory runs out.
static bool pass_to_scene(struct sharing *s, struct lam_scene *scene, void *array, size_t *reserved, size_t bytes)
{
    pages_trim(array, reserved, bytes);
    if (!call_charge(s->source->call, bytes))
        return false;
    if (!arena_adopt(&scene->arena, array, *reserved, bytes)) {
        call_refund(s->source->call, bytes);
        return false;
    }
    *reserved = 0;
    return true;
}

static bool share(struct sharing *s, struct lam_scene *scene, lam_mesh *mesh)
{
    size_t windows = (s->chunks + s->window_chunks - 1) / s->window_chunks,
           index_bytes = s->facets->count * 3 * sizeof *s->indices;
    s->indices = pages_get(index_bytes, &s->reserved_indices);
    s->positions = pages_get(windows * s->window_vertices * sizeof *s->positions, &s->reserved_positions);
    if (!s->indices || !s->positions)
        return false;
    pthread_mutex_init(&s->mutex, NULL);
    pthread_cond_init(&s->counted, NULL);
    pool_run(s->source->pool, windows, share_window, s);
    pthread_cond_destroy(&s->counted);
    pthread_mutex_destroy(&s->mutex);
    if (s->failed ||
        !pass_to_scene(s, scene, s->positions, &s->reserved_positions, s->vertices * sizeof *s->positions) ||
        !pass_to_scene(s, scene, s->indices, &s->reserved_indices, index_bytes))
        return false;
    mesh->positions = (const float *)(const void *)s->positions;
    mesh->vertex_count = s->vertices;
    mesh->indices = s->indices;
    scene->first_all_used = true;
    return true;
}

// Returns the number of chunks per window.
static size_t window_chunks(size_t chunks)
{
    size_t few = (chunks + WINDOWS - 1) / WINDOWS, many = (chunks + WINDOWS_MAX - 1) / WINDOWS_MAX;
    return few < WINDOW_CHUNKS ? few : many > WINDOW_CHUNKS ? many : WINDOW_CHUNKS;
}

bool stl_share_vertices(const struct import_source *source, const struct row_bytes *facets, struct stl_words *words,
                        struct lam_scene *scene, lam_mesh *mesh)
{
    if (facets->count < FACETS_MIN)
        return false;
    struct arena scratch;
    arena_start(&scratch, NULL); // most of this memory is for threads, so it is not counted
    struct sharing s = {.source = source,
                        .loop = {.call = source->call},
                        .facets = facets,
                        .chunks = parallel_rows_count(facets->count),
                        .words = words};
    s.window_chunks = window_chunks(s.chunks);
    s.window_vertices = (s.window_chunks + 1) * PARALLEL_ROWS * 3 / 2;
    bool done = start_workers(&s, &scratch) && first_chunk_shares(&s, &scratch) && share(&s, scene, mesh);
    if (s.reserved_indices)
        pages_free(s.indices, s.reserved_indices);
    if (s.reserved_positions)
        pages_free(s.positions, s.reserved_positions);
    arena_free(&scratch);
    return done;
}
