// visible_triangles.c: for meshes without normals: which triangles the frame shows, and the normals of those.
#include "visible_triangles.h"

#include "cpu_frame.h"

#include "fail.h"

#include <string.h>

// --- every triangle in a bin

static void mark_bins(void *user, size_t index, int number)
{
    (void)number;
    struct cpu_frame *cpu = user;
    if (!raster_should_continue(&cpu->raster))
        return;
    for (int i = 0; i < pool_threads(cpu->pool) * TILE_BINS; i++) {
        const struct thread_bins *bins = &cpu->bins[i / TILE_BINS];
        const struct bin_block *block = bins->heads[index * TILE_BINS + (size_t)(i % TILE_BINS)];
        for (; block; block = block->next)
            for (uint32_t k = 0; k < block->count; k++) {
                uint32_t id = block->ids[k];
                if (id & CLIPPED)
                    id = clipped_piece(bins, id & ~CLIPPED)->id;
                number_set_add(&cpu->shade.seen.triangles, id);
            }
    }
}

// --- the triangles of the tiles' fragments

struct tile_search {
    struct cpu_frame *cpu;
    struct arena *arenas;
};

// Tiles: half a million fragments, and some megabytes, where all is covered.
enum { LARGE_PICTURE = 128 };

// Adds the triangles of the fragments, and tells the lowest and the highest of them. Which of them differ
// from the one before is a coin's toss: that is asked without a branch.
static void add_shown(struct number_set *set, const struct fragments *fragments, uint32_t *lowest, uint32_t *highest)
{
    uint32_t *shown = fragments->order; // not in use yet
    uint32_t before = NOTHING;
    int count = 0;
    for (int i = 0; i < fragments->count; i++) {
        uint32_t id = fragments->id[i] & ~BACK_SIDE;
        shown[count] = id;
        count += id != before;
        before = id;
    }
    *lowest = UINT32_MAX;
    *highest = 0;
    for (int i = 0; i < count; i++) {
        number_set_add(set, shown[i]);
        *lowest = shown[i] < *lowest ? shown[i] : *lowest;
        *highest = shown[i] > *highest ? shown[i] : *highest;
    }
}

static void search_tile(void *user, size_t index, int number)
{
    struct tile_search *search = user;
    struct cpu_frame *cpu = search->cpu;
    struct thread_state *thread = &cpu->threads[number];
    if (!raster_should_continue(&cpu->raster))
        return;
    if (!tile_has_triangles(&cpu->raster, index))
        return;
    uint64_t start = now_ns();
    struct tile tile = tile_number(cpu, index);
    cpu->kernels->cover_tile(&cpu->raster, &thread->samples, &tile);
    thread->pixels_covered +=
        cpu->kernels->visibility_resolve(cpu->raster.pattern, &thread->samples, &thread->fragments, &tile);
    struct fragment_store *fragment_store = &cpu->fragment_stores[index];
    uint32_t highest;
    add_shown(&cpu->shade.seen.triangles, &thread->fragments, &fragment_store->lowest, &highest);
    if (!cpu->kernels->save_fragments(fragment_store, &thread->fragments, cpu->raster.frame->samples, highest,
                                      &search->arenas[number]))
        raster_fail(&cpu->raster, FAILED_MEMORY);
    thread->coverage_ns += now_ns() - start;
}

static bool search_tiles(struct cpu_frame *cpu, struct seeing_room *room, lam_error *error)
{
    size_t tiles = tile_count(cpu), threads = (size_t)pool_threads(cpu->pool);
    if (!buffer_reserve(&room->fragment_stores, tiles * sizeof(struct fragment_store) + threads * sizeof(struct arena),
                        cpu->call, error))
        return false;
    cpu->fragment_stores = room->fragment_stores.data;
    memset(cpu->fragment_stores, 0, tiles * sizeof(struct fragment_store));
    room->arenas = (struct arena *)(cpu->fragment_stores + tiles);
    for (size_t i = 0; i < threads; i++)
        (tiles > LARGE_PICTURE ? arena_start_large : arena_start)(&room->arenas[i], cpu->call);
    uint64_t start = now_ns();
    pool_run(cpu->pool, tiles, search_tile, &(struct tile_search){cpu, room->arenas});
    room->search_ms = (double)(now_ns() - start) * 1e-6;
    return true;
}

// The bins are done with.
static void release_bins(struct cpu_frame *cpu)
{
    size_t tiles = tile_count(cpu);
    for (int i = 0; i < pool_threads(cpu->pool); i++) {
        memset(cpu->bins[i].heads, 0, tiles * TILE_BINS * sizeof(struct bin_block *));
        call_refund(cpu->call, slabs_free(&cpu->bins[i].blocks));
    }
}

// --- both

static bool make_set(struct cpu_frame *cpu, struct seeing_room *room, lam_error *error)
{
    struct number_set *set = &cpu->shade.seen.triangles;
    size_t words = number_set_words(cpu->raster.frame->triangle_count);
    if (!buffer_reserve(&room->sets, words * (sizeof *set->bits + sizeof *set->before), cpu->call, error))
        return false;
    set->size = cpu->raster.frame->triangle_count;
    set->bits = room->sets.data;
    set->before = (uint32_t *)(set->bits + words);
    memset(set->bits, 0, words * sizeof *set->bits);
    return true;
}

// Finds memory for the elements and normals of so many corners: in the spare one where that is large, else of
// their own, of which fewer pages are touched: corners share normals.
static bool place_normals(struct seeing_room *room, struct seen_normals *seen, size_t corners, struct spare *spare,
                          struct call_control *call, lam_error *error)
{
    size_t elements = (corners * sizeof *seen->elements + 63) / 64 * 64,
           normals = (corners * sizeof *seen->normals + 63) / 64 * 64;
    bool lies_there = elements + normals <= spare->room / 4;
    if (!lies_there && !buffer_reserve(&room->normals, elements + normals, call, error))
        return false;
    char *memory = lies_there ? spare->memory : room->normals.data;
    seen->elements = (uint32_t *)memory;
    seen->normals = (float(*)[3])(memory + elements);
    seen->used = 0;
    spare->used = lies_there ? elements + normals : 0;
    return true;
}

bool see_triangles(struct cpu_frame *cpu, struct seeing_room *room, lam_error *error)
{
    const struct frame *frame = cpu->raster.frame;
    struct seen_normals *seen = &cpu->shade.seen;
    room->search_ms = 0;
    if (!make_set(cpu, room, error))
        return false;
    if (!frame->translucent && !cpu->shade.recorder && lam_output_is_light(frame->show)) {
        if (!search_tiles(cpu, room, error))
            return false;
    } else {
        pool_run(cpu->pool, tile_count(cpu), mark_bins, cpu);
    }
    if (!raster_should_continue(&cpu->raster))
        return true; // the caller asks why
    // The vertices are done with too; what is made may lie where they did.
    struct spare spare = {0};
    if (cpu->fragment_stores) {
        release_bins(cpu);
        spare = (struct spare){.memory = room->vertices->data, .room = room->vertices->room};
        cpu->raster.vertices = NULL;
    }
    number_set_count(&seen->triangles);
    size_t corners = 3 * (size_t)seen->triangles.count;
    if (corners == 0)
        return true; // no triangle is seen
    if (!place_normals(room, seen, corners, &spare, cpu->call, error))
        return false;
    for (int i = 0; i < frame->draw_count; i++)
        if (frame->draws[i].crease_rad > 0 &&
            !normals_seen(frame->draws[i].mesh, frame->draws[i].first_id, frame->draws[i].crease_rad, seen, spare,
                          cpu->kernels->lanes, cpu->pool, cpu->call, error))
            return false;
    return true;
}

void seeing_room_empty(struct seeing_room *room, int threads)
{
    for (int i = 0; room->arenas && i < threads; i++)
        arena_free(&room->arenas[i]);
    room->arenas = NULL;
}
