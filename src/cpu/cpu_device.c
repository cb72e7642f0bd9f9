// cpu_device.c: the software device: its memory, and the order of the pipeline's steps.
#include "device_type.h"
#include "kernels.h"

#include "cpu_features.h"
#include "fail.h"
#include "recorder.h"
#include "srgb.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct cpu_device {
    struct lam_device base;
    const struct kernels *kernels;
    struct pool *pool;
    int thread_count;
    struct thread_state *threads;
    struct buffer vertices; // x, y and key of all vertices
    struct buffer lists;    // pieces, first vertices
    struct buffer products; // material × light
    struct buffer lights;   // their table
    struct light_bounds light_bounds;
    struct buffer bins; // heads of all threads' bins
    struct seeing_room seeing;
    float decode_srgb[256], decode_linear[256];
};

// --- instruction sets

static const char *const isa_names[LAM_ISA_COUNT] = {"auto", "scalar", "sse4", "avx2", "avx512", "neon"};

const char *lam_isa_name(lam_isa isa) { return (unsigned)isa < LAM_ISA_COUNT ? isa_names[isa] : NULL; }

// The kernels of an instruction set; NULL: not in this build, or not on this processor.
static const struct kernels *kernels_of(lam_isa isa)
{
    unsigned have = cpu_features();
    (void)have;
    switch (isa) {
    case LAM_ISA_SCALAR:
        return &kernels_scalar;
#if defined(__x86_64__)
    case LAM_ISA_SSE4:
        return have & CPU_SSE4 ? &kernels_sse4 : NULL;
    case LAM_ISA_AVX2:
        return have & CPU_AVX2 ? &kernels_avx2 : NULL;
    case LAM_ISA_AVX512:
        return have & CPU_AVX512 ? &kernels_avx512 : NULL;
#elif defined(__aarch64__)
    case LAM_ISA_NEON:
        return have & CPU_NEON ? &kernels_neon : NULL;
#endif
    default:
        return NULL;
    }
}

bool lam_isa_usable(lam_isa isa) { return isa == LAM_ISA_AUTO || kernels_of(isa) != NULL; }

static lam_isa widest_isa(void)
{
    for (int isa = LAM_ISA_COUNT - 1; isa > LAM_ISA_AUTO; isa--)
        if (kernels_of((lam_isa)isa))
            return (lam_isa)isa;
    return LAM_ISA_SCALAR;
}

// --- memory

// Hands out parts of a block, each aligned to 64 bytes; with a NULL block it only counts.
struct carving {
    char *at;
    size_t used;
};

static void *suballocate(struct carving *carving, size_t bytes)
{
    void *part = carving->at ? carving->at + carving->used : NULL;
    carving->used += (bytes + 63) & ~(size_t)63;
    return part;
}

static void suballocate_thread(struct carving *carving, struct thread_state *thread, const struct frame *frame)
{
    int samples = frame->samples;
    size_t entries = (size_t)TILE * TILE * (size_t)samples;
    size_t opaque = (size_t)fragments_of_tile(samples), points = 3 * (opaque + LANES_MAX);
    size_t fragments = (frame->translucent && opaque < LAYERS_MAX ? (size_t)LAYERS_MAX : opaque) + LANES_MAX;
    thread->keys = suballocate(carving, entries * sizeof(float));
    thread->ids = suballocate(carving, entries * sizeof(uint32_t));
    thread->fragment_id = suballocate(carving, fragments * sizeof(uint32_t));
    thread->fragment_pixel = suballocate(carving, fragments * sizeof(uint16_t));
    thread->fragment_weight = suballocate(carving, fragments);
    thread->fragment_sample = suballocate(carving, fragments);
    thread->fragment_group = suballocate(carving, fragments * sizeof(uint32_t));
    thread->order = suballocate(carving, fragments * sizeof(uint32_t));
    thread->fragment_point = suballocate(carving, 3 * fragments * sizeof(uint32_t));
    for (int c = 0; c < 4; c++) {
        thread->fragment_color[c] = suballocate(carving, fragments * sizeof(float));
        thread->sum[c] = suballocate(carving, (TILE * TILE + LANES_MAX) * sizeof(float));
    }
    size_t slots = 64;
    while (slots < 2 * points)
        slots *= 2;
    thread->point_table = suballocate(carving, slots * sizeof(uint32_t));
    thread->point_color = suballocate(carving, points * sizeof *thread->point_color);
    thread->point_key = suballocate(carving, points * sizeof *thread->point_key);
    thread->points = suballocate(carving, sizeof *thread->points);
    if (light_lists_wanted(frame)) {
        size_t lights = (size_t)frame->light_count;
        thread->choice.numbers = suballocate(carving, lights * sizeof *thread->choice.numbers);
        thread->choice.most = suballocate(carving, lights * sizeof *thread->choice.most);
        thread->choice.bits = suballocate(carving, (lights + 63) / 64 * sizeof *thread->choice.bits);
    }
    thread->counts = frame->show == LAM_OUTPUT_OVERDRAW ? suballocate(carving, entries * sizeof(int32_t)) : NULL;
    thread->shown = frame->show == LAM_OUTPUT_CLIPPED ? suballocate(carving, TILE * TILE * 4 * sizeof(float)) : NULL;
    if (!frame->translucent)
        return;
    thread->layer_samples = suballocate(carving, LAYERS_MAX * sizeof(uint16_t));
    thread->layer_keys = suballocate(carving, (size_t)LAYERS_MAX * (size_t)samples * sizeof(float));
    thread->layer_order = suballocate(carving, LAYERS_MAX * sizeof(uint32_t));
    thread->layer_start = suballocate(carving, (TILE * TILE + 1) * sizeof(uint32_t));
    thread->layers = suballocate(carving, LAYERS_MAX * sizeof *thread->layers);
    thread->clear = suballocate(carving, opaque * sizeof(float));
}

static bool make_threads_ready(struct cpu_device *device, struct cpu_frame *cpu, lam_error *error)
{
    size_t of_thread = (size_t)cpu->tiles_across * (size_t)cpu->tiles_down * TILE_BINS;
    size_t bins = of_thread * (size_t)device->thread_count * sizeof(struct bin_block *);
    if (!buffer_reserve(&device->bins, bins, cpu->call, error))
        return false;
    memset(device->bins.data, 0, bins);
    for (int i = 0; i < device->thread_count; i++) {
        struct thread_state *thread = &device->threads[i];
        struct carving carving = {0};
        suballocate_thread(&carving, thread, cpu->frame);
        if (!buffer_reserve(&thread->scratch, carving.used, cpu->call, error))
            return false;
        carving = (struct carving){.at = thread->scratch.data};
        suballocate_thread(&carving, thread, cpu->frame);
        thread->bins = (struct bin_block **)device->bins.data + of_thread * (size_t)i;
        thread->blocks.current = thread->pieces.current = 0;
        thread->blocks.used = thread->pieces.used = 0;
        thread->piece_count = 0;
        thread->coverage_ns = thread->lighting_ns = thread->resolve_ns = 0;
        thread->pixels_covered = thread->points_lit = thread->lights_evaluated = thread->triangles_binned = 0;
    }
    return true;
}

static uint64_t cpu_memory(const struct lam_device *base)
{
    const struct cpu_device *device = (const struct cpu_device *)base;
    const struct seeing_room *seeing = &device->seeing;
    uint64_t bytes = device->vertices.room + device->lists.room + device->products.room + device->lights.room +
                     device->bins.room + seeing->sets.room + seeing->normals.room + seeing->fragment_stores.room;
    for (int i = 0; i < device->thread_count; i++) {
        const struct thread_state *thread = &device->threads[i];
        bytes += thread->scratch.room + slabs_bytes(&thread->blocks) + slabs_bytes(&thread->pieces);
    }
    return bytes;
}

static void cpu_free(struct lam_device *base)
{
    struct cpu_device *device = (struct cpu_device *)base;
    pool_free(device->pool);
    for (int i = 0; i < device->thread_count; i++) {
        slabs_free(&device->threads[i].blocks);
        slabs_free(&device->threads[i].pieces);
        buffer_free(&device->threads[i].scratch);
    }
    free(device->threads);
    buffer_free(&device->vertices);
    buffer_free(&device->lists);
    buffer_free(&device->products);
    buffer_free(&device->lights);
    buffer_free(&device->bins);
    buffer_free(&device->seeing.sets);
    buffer_free(&device->seeing.normals);
    buffer_free(&device->seeing.fragment_stores);
    free(device);
}

// --- the frame's lists

static uint32_t vertices_of(const lam_mesh *mesh)
{
    return mesh->indices ? mesh->vertex_count : 3 * mesh->triangle_count;
}

static size_t pieces_of(uint32_t count, uint32_t size) { return ((size_t)count + size - 1) / size; }

static void fill_pieces(struct piece *pieces, size_t *at, int draw, uint32_t count, uint32_t size)
{
    for (uint32_t first = 0; first < count; first += size)
        pieces[(*at)++] = (struct piece){(uint32_t)draw, first, count - first < size ? count - first : size};
}

// Lists the pieces of work and makes room for the vertices. False: out of memory, or more vertices than can be
// numbered.
static bool make_lists(struct cpu_device *device, struct cpu_frame *cpu, size_t *vertex_pieces, size_t *triangle_pieces,
                       lam_error *error)
{
    const struct frame *frame = cpu->frame;
    uint64_t vertices = 0;
    *vertex_pieces = *triangle_pieces = 0;
    for (int i = 0; i < frame->draw_count; i++) {
        const lam_mesh *mesh = frame->draws[i].mesh;
        vertices += vertices_of(mesh);
        *vertex_pieces += pieces_of(vertices_of(mesh), VERTEX_PIECE);
        *triangle_pieces += pieces_of(mesh->triangle_count, TRIANGLE_PIECE);
    }
    if (vertices > INT32_MAX)
        return fail(error, LAM_LIMIT, "the scene has %llu vertices, at most %d can be drawn at once",
                    (unsigned long long)vertices, INT32_MAX);
    size_t pieces = *vertex_pieces + *triangle_pieces;
    if (!buffer_reserve(&device->lists,
                        pieces * sizeof(struct piece) + ((size_t)frame->draw_count + 1) * sizeof(uint32_t), cpu->call,
                        error) ||
        !buffer_reserve(&device->vertices, ((size_t)vertices * 3 + 1) * sizeof(float), cpu->call, error))
        return false;
    cpu->vertices = device->vertices.data;
    struct piece *list = device->lists.data;
    uint32_t *first_vertex = (uint32_t *)(list + pieces), next = 0;
    size_t v = 0, t = *vertex_pieces;
    for (int i = 0; i < frame->draw_count; i++) {
        const lam_mesh *mesh = frame->draws[i].mesh;
        first_vertex[i] = next;
        next += vertices_of(mesh);
        fill_pieces(list, &v, i, vertices_of(mesh), VERTEX_PIECE);
        fill_pieces(list, &t, i, mesh->triangle_count, TRIANGLE_PIECE);
    }
    cpu->first_vertex = first_vertex;
    cpu->vertex_pieces = list;
    cpu->triangle_pieces = list + *vertex_pieces;
    return true;
}

static void product(float out[3], const float *a, const float *b)
{
    for (int i = 0; i < 3; i++)
        out[i] = a[i] * b[i];
}

// Materials × lights, once for the frame.
static bool make_products(struct cpu_device *device, struct cpu_frame *cpu, lam_error *error)
{
    const struct frame *frame = cpu->frame;
    size_t materials = (size_t)frame->material_count, lights = (size_t)frame->light_count;
    size_t skies = (size_t)frame->hemisphere_count,
           each = lights * sizeof(struct light_products) + skies * 6 * sizeof(float);
    size_t bytes;
    if (__builtin_mul_overflow(materials, each + sizeof(struct material_products), &bytes))
        return fail(error, LAM_LIMIT, "%zu materials under %zu lights are too many", materials, lights);
    if (!buffer_reserve(&device->products, bytes, cpu->call, error))
        return false;
    struct material_products *products = device->products.data;
    char *at = (char *)(products + materials);
    for (size_t m = 0; m < materials; m++) {
        const lam_material *material = frame->materials[m];
        struct material_products *out = &products[m];
        product(out->ambient, &material->ambient.r, frame->ambient);
        memcpy(out->emission, &material->emission, sizeof out->emission);
        memcpy(out->diffuse, &material->diffuse, sizeof out->diffuse);
        out->shininess = material->shininess;
        if (frame->match_highlights && frame->reflection == LAM_REFLECTION_BLINN_PHONG)
            out->shininess *= 4;
        if (frame->gl1 && out->shininess > 128)
            out->shininess = 128;
        out->fibre = material->fibre;
        memcpy(out->reflectivity, &material->reflectivity, sizeof out->reflectivity);
        out->mirrors =
            frame->environment && (out->reflectivity[0] != 0 || out->reflectivity[1] != 0 || out->reflectivity[2] != 0);
        struct light_products *list = (struct light_products *)at;
        at += lights * sizeof *list;
        for (size_t i = 0; i < lights; i++) {
            product(list[i].diffuse, &material->diffuse.r, frame->lights[i].diffuse);
            product(list[i].specular, &material->specular.r, frame->lights[i].specular);
            product(list[i].ambient, &material->ambient.r, frame->lights[i].ambient);
        }
        out->lights = list;
        out->sky = (float(*)[3])at;
        out->ground = out->sky + skies;
        at += skies * 6 * sizeof(float);
        for (size_t i = 0; i < skies; i++) {
            product(out->sky[i], &material->ambient.r, frame->hemispheres[i].sky);
            product(out->ground[i], &material->ambient.r, frame->hemispheres[i].ground);
        }
    }
    cpu->materials = products;
    if (!light_lists_wanted(frame))
        return true;
    cpu->lights = &device->light_bounds;
    return light_bounds_make(&device->light_bounds, &device->lights, frame, products, cpu->call, error);
}

// --- the steps

static bool still_on(const struct cpu_frame *cpu)
{
    return !__atomic_load_n(&cpu->failed, __ATOMIC_RELAXED) && call_should_continue(cpu->call);
}

static void vertex_task(void *user, size_t index, int thread)
{
    (void)thread;
    struct cpu_frame *cpu = user;
    if (still_on(cpu))
        cpu->kernels->project(cpu, &cpu->vertex_pieces[index]);
}

static void triangle_task(void *user, size_t index, int thread)
{
    struct cpu_frame *cpu = user;
    if (still_on(cpu))
        cpu->kernels->bin(cpu, &cpu->threads[thread], &cpu->triangle_pieces[index]);
}

static void fill_empty_tile(const struct cpu_frame *cpu, int tile_x, int tile_y)
{
    lam_image *image = cpu->image;
    int width = image->width - tile_x * TILE, height = image->height - tile_y * TILE;
    width = width < TILE ? width : TILE;
    height = height < TILE ? height : TILE;
    size_t size = image->format == LAM_RGBA8 ? 4 : 16;
    char row[TILE * 16];
    for (int x = 0; x < width; x++)
        memcpy(row + (size_t)x * size, cpu->empty_pixel, size);
    for (int y = 0; y < height; y++)
        memcpy((char *)image->pixels +
                   (((size_t)tile_y * TILE + (size_t)y) * (size_t)image->width + (size_t)tile_x * TILE) * size,
               row, (size_t)width * size);
}

static void tile_task(void *user, size_t index, int number)
{
    struct cpu_frame *cpu = user;
    struct thread_state *thread = &cpu->threads[number];
    if (!still_on(cpu))
        return;
    int tile_x = (int)(index % (size_t)cpu->tiles_across), tile_y = (int)(index / (size_t)cpu->tiles_across);
    if ((cpu->fragment_stores ? cpu->fragment_stores[index].count > 0 : tile_has_triangles(cpu, index)) ||
        cpu->recorder) {
        int width = cpu->image->width - tile_x * TILE, height = cpu->image->height - tile_y * TILE;
        width = width < TILE ? width : TILE;
        height = height < TILE ? height : TILE;
        uint64_t start = now_ns();
        if (cpu->fragment_stores) {
            cpu->kernels->load_fragment_store(&cpu->fragment_stores[index], thread, cpu->frame->samples);
        } else {
            cpu->kernels->cover(cpu, thread, tile_x, tile_y);
            if (thread->translucent_triangles) {
                thread->coverage_ns += now_ns() - start;
                blend_tile(cpu, thread, tile_x, tile_y, width, height);
                start = now_ns();
            }
            cpu->kernels->collect(cpu, thread, width, height);
        }
        group_fragments(cpu->frame, thread);
        uint64_t covered = now_ns();
        lam_output show = cpu->frame->show;
        if (show != LAM_OUTPUT_COVERAGE && show != LAM_OUTPUT_OVERDRAW)
            cpu->kernels->light(cpu, thread, tile_x, tile_y);
        uint64_t lit = now_ns();
        if (lam_output_is_light(show))
            cpu->kernels->resolve(cpu, thread, tile_x, tile_y);
        else
            show_tile(cpu, thread, tile_x, tile_y, width, height);
        thread->coverage_ns += covered - start;
        thread->lighting_ns += lit - covered;
        thread->resolve_ns += now_ns() - lit;
    } else {
        fill_empty_tile(cpu, tile_x, tile_y);
    }
    if (number == 0)
        call_progress(cpu->call, (double)index / ((double)cpu->tiles_across * cpu->tiles_down), "frame");
}

// Draws the one tile that holds the recorder's pixel, with the kernels that keep its numbers.
static void record_tile(struct cpu_frame *cpu, struct recorder *recorder)
{
    cpu->kernels = &kernels_recording;
    cpu->recorder = recorder;
    const lam_explanation *out = recorder->out;
    tile_task(cpu, (size_t)(out->y >> TILE_SHIFT) * (size_t)cpu->tiles_across + (size_t)(out->x >> TILE_SHIFT), 0);
    if (recorder->failed)
        cpu->failed = FAILED_MEMORY;
}

static bool step_done(const struct cpu_frame *cpu, lam_error *error)
{
    int failed = __atomic_load_n(&cpu->failed, __ATOMIC_RELAXED);
    if (failed == FAILED_LAYERS)
        return fail(error, LAM_LIMIT,
                    "more than %d translucent triangles lie over one pixel: so many can be put in order, no more",
                    LAYERS_MAX);
    if (failed)
        return call_memory_error(cpu->call, 2 << 20, error);
    return call_should_continue(cpu->call) || call_error(cpu->call, error);
}

static double milliseconds_since(uint64_t *start)
{
    uint64_t now = now_ns();
    double ms = (double)(now - *start) * 1e-6;
    *start = now;
    return ms;
}

static void fill_report(lam_frame_report *report, const struct cpu_device *device)
{
    uint64_t coverage = 0, lighting = 0, resolved = 0;
    for (int i = 0; i < device->thread_count; i++) {
        const struct thread_state *thread = &device->threads[i];
        coverage += thread->coverage_ns;
        lighting += thread->lighting_ns;
        resolved += thread->resolve_ns;
        report->pixels_covered += thread->pixels_covered;
        report->points_lit += thread->points_lit;
        report->lights_evaluated += thread->lights_evaluated;
        report->triangles_binned += thread->triangles_binned;
    }
    double sum = (double)(coverage + lighting + resolved);
    if (sum > 0) {
        report->coverage_ms = report->tiles_ms * (double)coverage / sum;
        report->lighting_ms = report->tiles_ms * (double)lighting / sum;
        report->resolve_ms = report->tiles_ms * (double)resolved / sum;
    }
}

static bool cpu_draw(struct lam_device *base, const struct frame *frame, lam_image *image, struct call_control *call,
                     lam_error *error)
{
    struct cpu_device *device = (struct cpu_device *)base;
    struct cpu_frame cpu = {.frame = frame,
                            .kernels = device->kernels,
                            .pattern = sample_pattern(frame->samples),
                            .image = image,
                            .call = call,
                            .pool = device->pool,
                            .threads = device->threads,
                            .decode_srgb = device->decode_srgb,
                            .decode_linear = device->decode_linear,
                            .tiles_across = (image->width + TILE - 1) / TILE,
                            .tiles_down = (image->height + TILE - 1) / TILE};
    // The guard band reaches 65536 pixels to each side of the window's middle: snapped coordinates then fit 26 bits.
    cpu.guard[0] = cpu.guard[1] = 65536.0f;
    size_t vertex_pieces, triangle_pieces;
    if (!make_lists(device, &cpu, &vertex_pieces, &triangle_pieces, error) || !make_products(device, &cpu, error) ||
        !make_threads_ready(device, &cpu, error))
        return false;
    cpu.kernels->resolve_empty(&cpu);
    if (!lam_output_is_light(frame->show))
        show_empty(&cpu);

    uint64_t clock = now_ns();
    pool_run(device->pool, vertex_pieces, vertex_task, &cpu);
    base->report.vertices_ms = milliseconds_since(&clock);
    if (!step_done(&cpu, error))
        return false;
    pool_run(device->pool, triangle_pieces, triangle_task, &cpu);
    base->report.triangles_ms = milliseconds_since(&clock);
    if (!step_done(&cpu, error))
        return false;
    cpu.recorder = base->recorder;
    bool ok = !frame->makes_normals || (see_triangles(&cpu, &device->seeing, error) && step_done(&cpu, error));
    if (frame->makes_normals)
        base->report.normals_ms = milliseconds_since(&clock) - device->seeing.search_ms;
    if (ok && base->recorder)
        record_tile(&cpu, base->recorder);
    else if (ok)
        pool_run(device->pool, (size_t)cpu.tiles_across * (size_t)cpu.tiles_down, tile_task, &cpu);
    seeing_room_empty(&device->seeing, device->thread_count);
    base->report.tiles_ms = milliseconds_since(&clock) + (cpu.fragment_stores ? device->seeing.search_ms : 0);
    fill_report(&base->report, device);
    return ok && step_done(&cpu, error);
}

lam_device *lam_device_cpu(const lam_cpu_params *params, lam_error *error)
{
    static const struct device_type type = {cpu_draw, cpu_memory, cpu_free, .makes_normals = true};
    static const lam_cpu_params plain = {0};
    if (!params)
        params = &plain;
    if (params->threads < 0 || params->threads > 1024) {
        fail(error, LAM_BAD_ARGUMENT, "cpu: threads is %d, expected 1 to 1024, or 0 for one each processor",
             params->threads);
        return NULL;
    }
    lam_isa isa = params->isa == LAM_ISA_AUTO ? widest_isa() : params->isa;
    const struct kernels *kernels = kernels_of(isa);
    if (!kernels) {
        const char *name = lam_isa_name(params->isa);
        fail(error, LAM_UNSUPPORTED, "cpu: %s has no instruction set '%s'; '%s' is the widest here",
             name ? "this processor or build" : "lambent", name ? name : "?", lam_isa_name(widest_isa()));
        return NULL;
    }
    struct cpu_device *device = calloc(1, sizeof *device);
    struct pool *pool = pool_make(params->threads);
    struct thread_state *threads = pool ? calloc((size_t)pool_threads(pool), sizeof *threads) : NULL;
    if (!device || !pool || !threads) {
        fail_memory(error, sizeof *device);
        free(device);
        pool_free(pool);
        free(threads);
        return NULL;
    }
    device->base.type = &type;
    device->base.isa = isa;
    device->base.threads = pool_threads(pool);
    device->kernels = kernels;
    device->pool = pool;
    device->thread_count = pool_threads(pool);
    device->threads = threads;
    device->seeing.vertices = &device->vertices;
    for (int i = 0; i < 256; i++) {
        device->decode_srgb[i] = (float)srgb_linear(i / 255.0);
        device->decode_linear[i] = (float)(i / 255.0);
    }
    snprintf(device->base.name, sizeof device->base.name, "cpu %s, %d thread%s", kernels->name, device->thread_count,
             device->thread_count == 1 ? "" : "s");
    return &device->base;
}
