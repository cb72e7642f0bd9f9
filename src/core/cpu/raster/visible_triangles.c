// visible_triangles.c: collects data of the whole picture before lighting. For meshes without normals, finds the
// visible triangles and their normals. For ambient occlusion, finds the distances of surfaces.
#include "visible_triangles.h"

#include "cpu_frame.h"

#include "fail.h"

#include <string.h>

// --- all binned triangles

static void mark_bins(void *user, size_t index, int number)
{
    (void)number;
    struct cpu_frame *cpu = user;
    if (!work_continues(&cpu->work))
        return;
    for (int i = 0; i < pool_threads(cpu->pool) * TILE_BINS; i++) {
        const struct thread_bins *bins = &cpu->bins[i / TILE_BINS];
        const struct bin_block *block = bins->heads[index * TILE_BINS + (size_t)(i % TILE_BINS)];
        for (; block; block = block->next)
            for (uint32_t k = 0; k < block->count; k++) {
                uint32_t id = block->entries[k].first;
                if (id & CLIPPED)
                    id = clipped_triangle(bins, id & ~CLIPPED)->id;
                for (unsigned rest = block->entries[k].triangles; rest; rest &= rest - 1)
                    rank_bitset_add(&cpu->shade.visible.triangles, id + (uint32_t)__builtin_ctz(rest));
            }
    }
}

// --- the triangles of the tiles' fragments

struct tile_search {
    struct cpu_frame *cpu;
    struct arena *arenas;
};

// Number of tiles for each thread. If all tiles are covered, they contain about a quarter of a million fragments, which
// need more than a megabyte.
enum { LARGE_PICTURE = 64 };

// Finds the lowest and the highest triangle number of the fragments.
static void range_of_triangles(const struct fragments *fragments, uint32_t *lowest, uint32_t *highest)
{
    int32_t low = INT32_MAX, high = 0; // signed, because every processor can compare vectors of signed integers
    for (int i = 0; i < fragments->count; i++) {
        int32_t id = (int32_t)(fragments->id[i] & ~BACK_SIDE);
        low = id < low ? id : low;
        high = id > high ? id : high;
    }
    *lowest = (uint32_t)low;
    *highest = (uint32_t)high;
}

// Adds the triangles of the fragments to `set`. The processor cannot predict whether a fragment's triangle differs from
// the previous one, so the test has no branch. The bits of a word are combined before they are added to `set`, because
// one atomic operation for each triangle would take longer than the rest of this function.
static void add_triangles(struct rank_bitset *set, const struct fragments *fragments)
{
    enum { WORDS = 128 };
    struct {
        size_t word;
        uint64_t bits;
    } combined[WORDS] = {0};
    uint32_t *ids = fragments->order; // not used yet
    uint32_t previous = NOTHING;
    int count = 0;
    for (int i = 0; i < fragments->count; i++) {
        uint32_t id = fragments->id[i] & ~BACK_SIDE;
        ids[count] = id;
        count += id != previous;
        previous = id;
    }
    for (int i = 0; i < count; i++) {
        const size_t word = ids[i] / 64, k = word % WORDS;
        if (combined[k].word != word) {
            rank_bitset_add_bits(set, combined[k].word, combined[k].bits);
            combined[k].word = word;
            combined[k].bits = 0;
        }
        combined[k].bits |= (uint64_t)1 << ids[i] % 64;
    }
    for (int i = 0; i < WORDS; i++)
        rank_bitset_add_bits(set, combined[i].word, combined[i].bits);
}

static void search_tile(void *user, size_t index, int number)
{
    struct tile_search *search = user;
    struct cpu_frame *cpu = search->cpu;
    struct thread_state *thread = &cpu->threads[number];
    if (!work_continues(&cpu->work))
        return;
    if (!tile_has_triangles(&cpu->raster, index))
        return;
    uint64_t start = now_ns();
    struct tile tile = tile_number(cpu, index);
    cpu->kernels->raster->cover_tile(&cpu->raster, &thread->samples, &tile);
    if (cpu->shade.occlusion) {
        cpu->kernels->raster->depth_of_tile(&cpu->raster, &thread->samples, &tile, &cpu->occlusion);
        cpu->kernels->raster->layers_of_tile(&cpu->raster, &tile, &cpu->occlusion);
    }
    thread->pixels_covered +=
        cpu->kernels->raster->visibility_resolve(cpu->raster.pattern, &thread->samples, &thread->fragments, &tile);
    struct fragment_store *fragment_store = &cpu->fragment_stores[index];
    uint32_t highest;
    range_of_triangles(&thread->fragments, &fragment_store->lowest, &highest);
    if (cpu->raster.frame->makes_normals)
        add_triangles(&cpu->shade.visible.triangles, &thread->fragments);
    if (!cpu->kernels->raster->save_fragments(fragment_store, &thread->fragments, cpu->raster.frame->settings.samples,
                                              highest, &search->arenas[number]))
        work_fail(&cpu->work, FAILED_MEMORY);
    thread->coverage_ns += now_ns() - start;
}

static bool search_tiles(struct cpu_frame *cpu, struct visible_buffers *buffers, lam_error *error)
{
    size_t tiles = tile_count(cpu), threads = (size_t)pool_threads(cpu->pool);
    if (!buffer_reserve(&buffers->fragment_stores,
                        tiles * sizeof(struct fragment_store) + threads * sizeof(struct arena), cpu->call, error))
        return false;
    cpu->fragment_stores = buffers->fragment_stores.data;
    memset(cpu->fragment_stores, 0, tiles * sizeof(struct fragment_store));
    buffers->arenas = (struct arena *)(cpu->fragment_stores + tiles);
    for (size_t i = 0; i < threads; i++)
        (tiles > LARGE_PICTURE * threads ? arena_start_large : arena_start)(&buffers->arenas[i], cpu->call);
    uint64_t start = now_ns();
    pool_run(cpu->pool, tiles, search_tile, &(struct tile_search){cpu, buffers->arenas});
    buffers->search_ms = (double)(now_ns() - start) * 1e-6;
    return true;
}

// Frees the bins if they are large, because they are no longer needed.
static void release_bins(struct cpu_frame *cpu)
{
    size_t tiles = tile_count(cpu);
    for (int i = 0; i < pool_threads(cpu->pool); i++) {
        memset(cpu->bins[i].heads, 0, tiles * TILE_BINS * sizeof(struct bin_block *));
        if (cpu->bins[i].blocks.count > 1)
            call_refund(cpu->call, slabs_free(&cpu->bins[i].blocks));
    }
}

// --- memory for the set and the normals

static bool make_set(struct cpu_frame *cpu, struct visible_buffers *buffers, lam_error *error)
{
    struct rank_bitset *set = &cpu->shade.visible.triangles;
    size_t words = rank_bitset_words(cpu->raster.frame->triangle_count);
    if (!buffer_reserve(&buffers->sets, words * (sizeof *set->bits + sizeof *set->ranks), cpu->call, error))
        return false;
    set->size = cpu->raster.frame->triangle_count;
    set->bits = buffers->sets.data;
    set->ranks = (uint32_t *)(set->bits + words);
    memset(set->bits, 0, words * sizeof *set->bits);
    const struct frame *frame = cpu->raster.frame;
    for (int i = 0; i < frame->draw_count && frame->settings.bounces; i++) // paths also meet invisible triangles
        for (uint32_t t = 0; t < frame->draws[i].mesh->triangle_count && frame->draws[i].crease_rad > 0; t++)
            rank_bitset_add(set, frame->draws[i].first_id + t);
    return true;
}

// Finds memory for the elements and normals of this many corners. The scratch memory is used if it is large enough.
// Otherwise, separate memory is allocated. Corners share normals, so only some pages of this memory are used.
static bool place_normals(struct visible_buffers *buffers, struct visible_normals *visible, size_t corners,
                          struct scratch_memory *scratch, struct call_control *call, lam_error *error)
{
    size_t elements = (corners * sizeof *visible->elements + 63) / 64 * 64,
           normals = (corners * sizeof *visible->normals + 63) / 64 * 64;
    bool fits = elements + normals <= scratch->capacity / 4;
    if (!fits && !buffer_reserve(&buffers->normals, elements + normals, call, error))
        return false;
    char *memory = fits ? scratch->memory : buffers->normals.data;
    visible->elements = (uint32_t *)memory;
    visible->normals = (float(*)[3])(memory + elements);
    visible->used = 0;
    scratch->used = fits ? elements + normals : 0;
    return true;
}

// --- only distances, for ambient occlusion

static void measure_tile(void *user, size_t index, int number)
{
    struct cpu_frame *cpu = user;
    struct thread_state *thread = &cpu->threads[number];
    if (!work_continues(&cpu->work) || !tile_has_triangles(&cpu->raster, index))
        return;
    uint64_t start = now_ns();
    struct tile tile = tile_number(cpu, index);
    cpu->kernels->raster->cover_tile(&cpu->raster, &thread->samples, &tile);
    cpu->kernels->raster->depth_of_tile(&cpu->raster, &thread->samples, &tile, &cpu->occlusion);
    cpu->kernels->raster->layers_of_tile(&cpu->raster, &tile, &cpu->occlusion);
    thread->coverage_ns += now_ns() - start;
}

// --- the whole pass

static bool make_normals(struct cpu_frame *cpu, struct visible_buffers *buffers, struct scratch_memory scratch,
                         lam_error *error)
{
    const struct frame *frame = cpu->raster.frame;
    struct visible_normals *visible = &cpu->shade.visible;
    rank_bitset_finish(&visible->triangles);
    size_t corners = 3 * (size_t)visible->triangles.count;
    if (corners == 0)
        return true; // no triangle is visible
    if (!place_normals(buffers, visible, corners, &scratch, cpu->call, error))
        return false;
    struct normals_work work = {scratch, cpu->kernels->lanes, cpu->pool, cpu->call};
    for (int i = 0; i < frame->draw_count; i++)
        if (frame->draws[i].crease_rad > 0 && !make_visible_normals(frame->draws[i].mesh, frame->draws[i].first_id,
                                                                    frame->draws[i].crease_rad, visible, &work, error))
            return false;
    return true;
}

bool keeps_fragments(const struct cpu_frame *cpu)
{
    const struct frame *frame = cpu->raster.frame;
    return !frame->translucent && !cpu->shade.recorder && lam_output_is_light(frame->settings.output);
}

bool cover_in_advance(struct cpu_frame *cpu, struct visible_buffers *buffers, lam_error *error)
{
    const struct frame *frame = cpu->raster.frame;
    buffers->search_ms = 0;
    if (frame->makes_normals && !make_set(cpu, buffers, error))
        return false;
    if (keeps_fragments(cpu)) {
        if (!search_tiles(cpu, buffers, error))
            return false;
    } else {
        if (frame->makes_normals)
            pool_run(cpu->pool, tile_count(cpu), mark_bins, cpu);
        if (cpu->shade.occlusion)
            pool_run(cpu->pool, tile_count(cpu), measure_tile, cpu);
    }
    if (!work_continues(&cpu->work))
        return true; // the caller reports the reason
    // The transformed vertices are no longer needed, so their memory is reused. (The vertices of meshes without indices
    // are not stored.)
    struct scratch_memory scratch = {0};
    if (cpu->fragment_stores) {
        release_bins(cpu);
        scratch = (struct scratch_memory){.memory = buffers->vertices->data, .capacity = buffers->vertices->capacity};
        cpu->raster.vertices = NULL;
    }
    return !frame->makes_normals || make_normals(cpu, buffers, scratch, error);
}

void visible_buffers_empty(struct visible_buffers *buffers, int threads)
{
    for (int i = 0; buffers->arenas && i < threads; i++)
        arena_free(&buffers->arenas[i]);
    buffers->arenas = NULL;
}
