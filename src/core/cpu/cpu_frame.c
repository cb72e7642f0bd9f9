// cpu_frame.c: sets up a frame: the threads' memory, the parallel tasks, and the products of materials and lights.
#include "cpu_frame.h"

#include "fail.h"
#include "visible_triangles.h"

#include <stdlib.h>
#include <string.h>

// --- the arrays of a thread

// Allocates sections of a block, aligned to 64 bytes. If `block` is NULL, only the total size is computed.
struct suballocator {
    char *block;
    size_t used;
};

static void *suballocate(struct suballocator *from, size_t count, size_t size)
{
    void *part = from->block ? from->block + from->used : NULL;
    from->used += (count * size + 63) & ~(size_t)63;
    return part;
}

#define ARRAY(pointer, count) ((pointer) = suballocate(from, count, sizeof *(pointer)))

// Allocates rows for the largest possible number of vertices in a tile: three for each fragment.
static void lay_out_vertices(struct suballocator *from, struct vertex_cache *cache, int samples)
{
    size_t vertices = 3 * ((size_t)tile_samples_count(samples) + LANES_MAX), slots = 64;
    while (slots < 2 * vertices)
        slots *= 2;
    ARRAY(cache->table, slots);
    ARRAY(cache->color, vertices);
    ARRAY(cache->key, vertices);
    ARRAY(cache->rest, vertices);
}

static void lay_out_shading(struct suballocator *from, struct shading *shading, const struct frame *frame)
{
    if (frame->settings.shading != LAM_SHADING_PHONG)
        lay_out_vertices(from, &shading->vertices, frame->settings.samples);
    ARRAY(shading->batch, 1);
    shading->starts = NULL;
    if (frame_has_rays(frame))
        ARRAY(shading->starts, 1);
    shading->stream = NULL;
    if (frame->settings.bounces) {
        ARRAY(shading->stream, 1);
        ARRAY(shading->hit_batch, 1);
        ARRAY(shading->hit_starts, 1);
    }
    shading->shadows = NULL;
    if (frame->settings.shadows && frame->settings.shading == LAM_SHADING_PHONG)
        ARRAY(shading->shadows, 1);
    if (!light_culling_wanted(frame))
        return;
    size_t lights = (size_t)frame->light_count;
    ARRAY(shading->lights.numbers, lights);
    ARRAY(shading->lights.bound, lights);
    ARRAY(shading->lights.bits, (lights + 63) / 64);
}

static void lay_out_thread(struct suballocator *from, struct thread_state *thread, const struct resolve_target *target)
{
    const struct frame *frame = target->frame;
    size_t samples = (size_t)tile_samples_count(frame->settings.samples);
    size_t fragments = (frame->translucent && samples < LAYERS_MAX ? (size_t)LAYERS_MAX : samples) + LANES_MAX;
    ARRAY(thread->samples.keys, samples);
    ARRAY(thread->samples.ids, samples);
    thread->samples.counts = NULL;
    if (frame->settings.output == LAM_OUTPUT_OVERDRAW)
        ARRAY(thread->samples.counts, samples);
    ARRAY(thread->fragments.id, fragments);
    ARRAY(thread->fragments.pixel, fragments);
    ARRAY(thread->fragments.weight, fragments);
    ARRAY(thread->fragments.sample, fragments);
    ARRAY(thread->fragments.group, fragments);
    ARRAY(thread->fragments.order, fragments);
    ARRAY(thread->fragments.scratch, 3 * fragments);
    thread->shading.vertices.run_vertex = thread->fragments.scratch;
    for (int c = 0; c < 4; c++) {
        ARRAY(thread->fragments.color[c], fragments);
        ARRAY(thread->sums.sum[c], TILE * TILE + LANES_MAX);
    }
    lay_out_shading(from, &thread->shading, frame);
    thread->sums.pixels = NULL;
    if (target->converted)
        ARRAY(thread->sums.pixels, TILE * TILE * 4);
    thread->sums.unclipped = NULL;
    if (frame->settings.output == LAM_OUTPUT_CLIPPED)
        ARRAY(thread->sums.unclipped, TILE * TILE * 4);
    for (int c = 0; c < 3; c++)
        thread->fragments.through[c] = thread->fragments.bend[c] = thread->sums.tint[c] = NULL;
    thread->sums.behind = NULL;
    if (!frame->translucent)
        return;
    ARRAY(thread->layers.samples, LAYERS_MAX);
    ARRAY(thread->layers.keys, (size_t)LAYERS_MAX * (size_t)frame->settings.samples);
    ARRAY(thread->blend.order, LAYERS_MAX);
    ARRAY(thread->blend.start, TILE * TILE + 1);
    ARRAY(thread->blend.layers, LAYERS_MAX);
    ARRAY(thread->sums.transmittance, samples);
    for (int c = 0; frame->transmits && c < 3; c++) {
        ARRAY(thread->fragments.through[c], fragments);
        ARRAY(thread->sums.tint[c], samples);
    }
    for (int c = 0; frame->refracts && c < 3; c++)
        ARRAY(thread->fragments.bend[c], fragments);
    thread->sums.background = frame->glass_background;
}

static bool set_up_thread(struct thread_state *thread, const struct cpu_frame *cpu, lam_error *error)
{
    struct suballocator count = {0};
    lay_out_thread(&count, thread, &cpu->target);
    // The number of threads must not decide whether the call succeeds, so only the first thread's memory is counted.
    if (!buffer_reserve(&thread->storage, count.used, thread == cpu->threads ? cpu->call : NULL, error))
        return false;
    lay_out_thread(&(struct suballocator){.block = thread->storage.data}, thread, &cpu->target);
    thread->coverage_ns = thread->lighting_ns = thread->resolve_ns = thread->pixels_covered = 0;
    thread->shading.points_lit = thread->shading.lights_evaluated = thread->shading.rays = 0;
    thread->shading.ray_layers.failed = false;
    thread->shading.work = cpu->raster.work;
    thread->shading.uncounted = 0;
    return true;
}

static bool set_up_threads(struct cpu_frame *cpu, struct buffer *heads, lam_error *error)
{
    size_t of_thread = tile_count(cpu) * TILE_BINS;
    size_t bytes = of_thread * (size_t)cpu->raster.thread_count * sizeof(struct bin_block *);
    if (!buffer_reserve(heads, bytes, NULL, error))
        return false;
    memset(heads->data, 0, bytes);
    for (int i = 0; i < cpu->raster.thread_count; i++) {
        if (!set_up_thread(&cpu->threads[i], cpu, error))
            return false;
        struct thread_bins *bins = &cpu->bins[i];
        bins->heads = (struct bin_block **)heads->data + of_thread * (size_t)i;
        bins->blocks.current = bins->clipped.current = 0;
        bins->blocks.used = bins->clipped.used = 0;
        bins->clipped_count = 0;
        bins->triangles_binned = bins->work = 0;
    }
    return true;
}

uint64_t thread_bytes(const struct thread_state *thread, const struct thread_bins *bins, bool first)
{
    return (uint64_t)thread->shading.ray_layers.capacity * sizeof *thread->shading.ray_layers.list +
           (first ? thread->storage.capacity : 0) + bins->blocks.charged + bins->clipped.charged;
}

void thread_free(struct thread_state *thread, struct thread_bins *bins)
{
    slabs_free(&bins->blocks);
    slabs_free(&bins->clipped);
    buffer_free(&thread->storage);
    free(thread->shading.ray_layers.list);
    *thread = (struct thread_state){0};
}

// --- parallel tasks

// Returns the number of vertices that are transformed and stored before triangles are binned. Only the vertices of
// indexed meshes are stored, because triangles share them (corners.inc).
static uint32_t vertices_of(const lam_mesh *mesh) { return mesh->indices ? mesh->vertex_count : 0; }

static size_t chunks_of(uint32_t count, uint32_t size) { return ((size_t)count + size - 1) / size; }

static void fill_chunks(struct chunk *chunks, size_t *at, int draw, uint32_t count, uint32_t size)
{
    for (uint32_t first = 0; first < count; first += size)
        chunks[(*at)++] = (struct chunk){(uint32_t)draw, first, count - first < size ? count - first : size};
}

// Lists the parallel tasks and reserves memory for the vertices.
static bool list_chunks(struct cpu_frame *cpu, struct frame_memory *memory, lam_error *error)
{
    const struct frame *frame = cpu->raster.frame;
    uint64_t vertices = 0;
    size_t vertex_chunks = 0, triangle_chunks = 0;
    for (int i = 0; i < frame->draw_count; i++) {
        const lam_mesh *mesh = frame->draws[i].mesh;
        vertices += vertices_of(mesh);
        vertex_chunks += chunks_of(vertices_of(mesh), VERTEX_CHUNK);
        triangle_chunks += chunks_of(mesh->triangle_count, TRIANGLE_CHUNK);
    }
    if (vertices > INT32_MAX)
        return fail(error, LAM_LIMIT, "the scene has %llu vertices, at most %d can be drawn at once",
                    (unsigned long long)vertices, INT32_MAX);
    if (!call_check_unfolded(cpu->call, vertices, "vertices", error))
        return false;
    size_t chunks = vertex_chunks + triangle_chunks;
    if (!buffer_reserve(&memory->chunks,
                        chunks * sizeof(struct chunk) + ((size_t)frame->draw_count + 1) * sizeof(uint32_t), cpu->call,
                        error) ||
        !buffer_reserve(&memory->vertices, ((size_t)vertices * 3 + 1) * sizeof(float), cpu->call, error))
        return false;
    struct chunk *list = memory->chunks.data;
    uint32_t *first_vertex = (uint32_t *)(list + chunks), next = 0;
    size_t v = 0, t = vertex_chunks;
    for (int i = 0; i < frame->draw_count; i++) {
        const lam_mesh *mesh = frame->draws[i].mesh;
        first_vertex[i] = next;
        next += vertices_of(mesh);
        fill_chunks(list, &v, i, vertices_of(mesh), VERTEX_CHUNK);
        fill_chunks(list, &t, i, mesh->triangle_count, TRIANGLE_CHUNK);
    }
    cpu->raster.vertices = memory->vertices.data;
    cpu->raster.first_vertex = first_vertex;
    cpu->vertex_chunks = list;
    cpu->vertex_chunk_count = vertex_chunks;
    cpu->triangle_chunks = list + vertex_chunks;
    cpu->triangle_chunk_count = triangle_chunks;
    return true;
}

// --- materials and lights

static bool set_up_shading(struct cpu_frame *cpu, struct frame_memory *memory, lam_error *error)
{
    const struct frame *frame = cpu->shade.frame;
    cpu->shade.materials = products_make(&memory->products, frame, cpu->call, error);
    if (!cpu->shade.materials || !light_culling_wanted(frame))
        return cpu->shade.materials != NULL;
    cpu->shade.light_bounds = &memory->light_bounds;
    return light_bounds_make(&memory->light_bounds, &memory->lights, frame, cpu->shade.materials, cpu->call, error);
}

// Lists the memory that can be reused while occlusion is computed. The memory of the picture can be reused, because
// the picture has not been drawn yet. If fragments are stored, the memory of the transformed vertices can be reused
// too.
static int lend_memory(const struct cpu_frame *cpu, const struct frame_memory *memory, struct scratch_memory lent[2])
{
    const lam_image *image = cpu->target.image;
    ptrdiff_t row = image->width * (ptrdiff_t)working_bytes(image);
    int count = 0;
    if (keeps_fragments(cpu) && !cpu->raster.frame->makes_normals)
        lent[count++] = (struct scratch_memory){.memory = memory->vertices.data, .capacity = memory->vertices.capacity};
    if (!cpu->target.converted && image_stride(image) == row && (uintptr_t)image->pixels % 64 == 0)
        lent[count++] =
            (struct scratch_memory){.memory = image->pixels, .capacity = (size_t)row * (size_t)image->height};
    return count;
}

static bool set_up_occlusion(struct cpu_frame *cpu, struct frame_memory *memory, lam_error *error)
{
    const struct frame *frame = cpu->raster.frame;
    struct scratch_memory lent[2];
    if (frame->settings.occlusion == LAM_OCCLUSION_RAYS) {
        if (!buffer_reserve(&memory->occlusion, sizeof(struct occlusion_pattern), cpu->call, error))
            return false;
        occlusion_pattern_fill(memory->occlusion.data, frame->settings.occlusion_samples);
        cpu->shade.occlusion_pattern = memory->occlusion.data;
    } else if (frame->settings.occlusion == LAM_OCCLUSION_SCREEN) {
        if (!screen_occlusion_start(&cpu->occlusion, frame, lent, lend_memory(cpu, memory, lent), &memory->occlusion,
                                    cpu->pool, cpu->call, error))
            return false;
        cpu->shade.occlusion = &cpu->occlusion;
    }
    return true;
}

bool cpu_frame_set_up(struct cpu_frame *cpu, struct frame_memory *memory, lam_error *error)
{
    return list_chunks(cpu, memory, error) && set_up_occlusion(cpu, memory, error) &&
           set_up_shading(cpu, memory, error) && set_up_threads(cpu, &memory->bins, error);
}

uint64_t frame_memory_bytes(const struct frame_memory *memory)
{
    return memory->vertices.capacity + memory->chunks.capacity + memory->products.capacity + memory->lights.capacity +
           memory->bins.capacity + memory->reference.capacity + memory->occlusion.capacity + memory->behind.capacity +
           path_frame_bytes(&memory->paths);
}

void frame_memory_free(struct frame_memory *memory)
{
    buffer_free(&memory->vertices);
    buffer_free(&memory->chunks);
    buffer_free(&memory->products);
    buffer_free(&memory->lights);
    buffer_free(&memory->bins);
    buffer_free(&memory->reference);
    buffer_free(&memory->occlusion);
    buffer_free(&memory->behind);
    path_frame_free(&memory->paths);
}
