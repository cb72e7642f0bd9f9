// edges.c: the edges of a frame, listed once for a scene, with visibility computed for each view.
#include "edge_tasks.h"

#include "cpu_features.h"
#include "fail.h"
#include "linear.h"

#include <stdlib.h>
#include <string.h>

CPU_VERSIONS(edge_rays, edge_rays);

// --- the list of edges

// Everything that a draw's edges depend on. Equal pointers mean equal contents, since a scene never modifies its
// arrays.
struct source {
    const float *positions;
    const uint32_t *indices;
    const uint8_t *inner_edges;
    uint32_t triangle_count;
    uint32_t first, count; // in the list
};

static uint32_t triangles_of(const struct frame_draw *draw)
{
    return frame_draw_casts(draw) && !draw->ground ? draw->mesh->triangle_count : 0;
}

static bool same_source(const struct source *source, const struct frame_draw *draw)
{
    const lam_mesh *mesh = draw->mesh;
    return triangles_of(draw) == source->triangle_count &&
           (!source->triangle_count || (mesh->positions == source->positions && mesh->indices == source->indices &&
                                        mesh->inner_edges == source->inner_edges));
}

static bool is_listed(const struct edge_memory *memory, const struct frame *frame)
{
    if (memory->token != frame->token || memory->source_count != frame->draw_count)
        return false;
    const struct source *sources = memory->sources.data;
    for (int i = 0; i < frame->draw_count; i++)
        if (!same_source(&sources[i], &frame->draws[i]))
            return false;
    return true;
}

static bool list(struct edge_memory *memory, const struct frame *frame, struct call_control *call, lam_error *error)
{
    size_t triangles = 0;
    scene_token_release(memory->token);
    memory->token = NULL;
    for (int i = 0; i < frame->draw_count; i++)
        triangles += triangles_of(&frame->draws[i]);
    if (3 * triangles > UINT32_MAX)
        return fail(error, LAM_LIMIT, "%zu triangles have too many edges to draw, expected at most %u", triangles,
                    UINT32_MAX / 3);
    if (!buffer_reserve(&memory->sources, ((size_t)frame->draw_count + 1) * sizeof(struct source), call, error) ||
        !buffer_reserve(&memory->edges, (3 * triangles + 1) * sizeof(struct mesh_edge), call, error))
        return false;
    struct source *sources = memory->sources.data;
    uint32_t count = 0;
    for (int i = 0; i < frame->draw_count; i++) {
        const lam_mesh *mesh = frame->draws[i].mesh;
        bool failed = false;
        sources[i] = (struct source){
            mesh->positions, mesh->indices, mesh->inner_edges, triangles_of(&frame->draws[i]), count, 0};
        if (sources[i].triangle_count)
            sources[i].count = mesh_edges(mesh, (struct mesh_edge *)memory->edges.data + count, call, &failed, error);
        if (failed)
            return false;
        count += sources[i].count;
    }
    memory->source_count = frame->draw_count;
    memory->token = scene_token_hold(frame->token);
    return true;
}

// --- the view

static void set_view(struct edge_view *view, const struct frame *frame, const struct hierarchy *h,
                     struct loop_status *loop)
{
    *view = (struct edge_view){.frame = frame,
                               .hierarchy = h,
                               .every_hides = !frame->passes_rays,
                               .window = {frame->width, frame->height},
                               .loop = loop};
    double eye[3];
    for (int i = 0; i < 3; i++) // in eye space, the camera looks along −z
        eye[i] = frame->eye_to_world[i][frame->orthographic ? 2 : 3];
    if (frame->orthographic)
        memcpy(view->eye, eye, sizeof eye);
    else
        ray_point(h, eye, view->eye);
    const double *z = frame->edges.pixel[2], *w = frame->edges.pixel[3];
    view->near_[3] = z[3] + w[3];
    for (int i = 0; i < 3; i++) {
        view->near_[i] = (z[i] + w[i]) / h->scale;
        view->near_[3] += (z[i] + w[i]) * h->centre[i];
    }
    for (int i = 0; i < frame->draw_count; i++)
        view->every_hides &= frame->draws[i].cull == LAM_CULL_NONE;
}

// --- tasks

struct search {
    struct edge_memory *memory;
    struct edge_view view;
    edge_rays *rays_of;
    size_t *first_tasks; // the first task of each draw, plus one at the end
    enum { WEIGH, MEASURE, DRAW } step;
    uint64_t drawn, rays; // atomic
};

static void run_task(void *user, size_t index, int thread)
{
    struct search *search = user;
    const struct frame *frame = search->view.frame;
    int low = 0, high = frame->draw_count - 1;
    if (!should_continue(search->view.loop))
        return;
    while (low < high) { // the last draw that begins at or before `index`
        int middle = (low + high + 1) / 2;
        if (search->first_tasks[middle] <= index)
            low = middle;
        else
            high = middle - 1;
    }
    const struct source *source = (const struct source *)search->memory->sources.data + low;
    uint32_t first = (uint32_t)(index - search->first_tasks[low]) * EDGES_PER_TASK, left = source->count - first;
    struct edge_measure *measures =
        frame->settings.hidden_lines == LAM_HIDDEN_LINES_DASH ? search->memory->measures.data : NULL;
    uint16_t *weights = frame->settings.edges ? search->memory->weights.data : NULL;
    struct edge_task task = {.view = &search->view,
                             .draw = &frame->draws[low],
                             .edges = (const struct mesh_edge *)search->memory->edges.data + source->first + first,
                             .count = left < EDGES_PER_TASK ? left : EDGES_PER_TASK,
                             .weights = weights ? weights + source->first + first : NULL,
                             .measures = measures ? measures + source->first + first : NULL,
                             .rays_of = search->rays_of,
                             .strokes = &search->memory->strokes[thread]};
    if (search->step == WEIGH || search->step == MEASURE) {
        (search->step == WEIGH ? edge_task_weigh : edge_task_measure)(&task);
        return;
    }
    if (!edge_task_draw(&task, (char *)search->memory->scratch.data + (size_t)thread * edge_scratch_bytes()) &&
        should_continue(search->view.loop))
        no_memory(search->view.loop);
    __atomic_fetch_add(&search->drawn, task.drawn, __ATOMIC_RELAXED);
    __atomic_fetch_add(&search->rays, task.rays, __ATOMIC_RELAXED);
}

static bool reserve_threads(struct edge_memory *memory, int threads, struct call_control *call, lam_error *error)
{
    if (!memory->strokes) {
        memory->strokes = calloc((size_t)threads, sizeof *memory->strokes);
        memory->thread_count = memory->strokes ? threads : 0;
    }
    if (!memory->strokes)
        return fail_memory(error, (size_t)threads * sizeof *memory->strokes);
    for (int i = 0; i < memory->thread_count; i++)
        memory->strokes[i].count = 0;
    return buffer_reserve(&memory->scratch, (size_t)threads * edge_scratch_bytes(), call, error);
}

static size_t edge_count(const struct edge_memory *memory, const struct frame *frame)
{
    size_t count = 0;
    for (int i = 0; i < frame->draw_count; i++)
        count += ((const struct source *)memory->sources.data)[i].count;
    return count;
}

// Computes the weights of all feature edges, and drops specks.
static bool drop_specks(struct search *search, size_t task_count, struct pool *pool, struct call_control *call,
                        lam_error *error)
{
    const struct frame *frame = search->view.frame;
    struct edge_memory *memory = search->memory;
    const struct source *sources = memory->sources.data;
    size_t count = edge_count(memory, frame);
    if (!buffer_reserve(&memory->weights, (count + 1) * sizeof(uint16_t), call, error))
        return false;
    struct edge_task *draws = calloc((size_t)frame->draw_count + 1, sizeof *draws);
    if (!draws)
        return fail_memory(error, ((size_t)frame->draw_count + 1) * sizeof *draws);
    search->step = WEIGH;
    pool_run(pool, task_count, run_task, search);
    for (int i = 0; i < frame->draw_count; i++)
        draws[i] = (struct edge_task){.view = &search->view,
                                      .draw = &frame->draws[i],
                                      .edges = (const struct mesh_edge *)memory->edges.data + sources[i].first,
                                      .count = sources[i].count,
                                      .weights = (uint16_t *)memory->weights.data + sources[i].first};
    bool ok = should_continue(search->view.loop) && edge_specks_drop(draws, frame->draw_count, search->view.loop);
    free(draws);
    if (!ok && should_continue(search->view.loop))
        no_memory(search->view.loop);
    return ok || loop_error(search->view.loop, 128 * count, error);
}

// Measures all edges and links them into chains, along which the dashes run.
static bool find_chains(struct search *search, size_t task_count, struct pool *pool, struct call_control *call,
                        lam_error *error)
{
    const struct frame *frame = search->view.frame;
    struct edge_memory *memory = search->memory;
    const struct source *sources = memory->sources.data;
    size_t count = edge_count(memory, frame);
    if (!buffer_reserve(&memory->measures, (count + 1) * sizeof(struct edge_measure), call, error))
        return false;
    search->step = MEASURE;
    pool_run(pool, task_count, run_task, search);
    bool ok = should_continue(search->view.loop);
    for (int i = 0; i < frame->draw_count && ok; i++)
        ok = edge_chains_link(&frame->draws[i], (const struct mesh_edge *)memory->edges.data + sources[i].first,
                              (struct edge_measure *)memory->measures.data + sources[i].first, sources[i].count,
                              search->view.loop);
    if (!ok && should_continue(search->view.loop))
        no_memory(search->view.loop);
    return ok || loop_error(search->view.loop, 2 * count * sizeof(struct edge_measure), error);
}

// Finds the visible parts of the model's edges.
static bool find_model_edges(struct search *search, struct pool *pool, struct call_control *call, lam_error *error)
{
    struct edge_memory *memory = search->memory;
    const struct frame *frame = search->view.frame;
    if (!is_listed(memory, frame) && !list(memory, frame, call, error))
        return false;
    size_t bytes = ((size_t)frame->draw_count + 1) * sizeof *search->first_tasks, task_count = 0;
    search->first_tasks = malloc(bytes);
    if (!search->first_tasks)
        return fail_memory(error, bytes);
    const struct source *sources = memory->sources.data;
    for (int i = 0; i < frame->draw_count; i++) {
        search->first_tasks[i] = task_count;
        task_count += ((size_t)sources[i].count + EDGES_PER_TASK - 1) / EDGES_PER_TASK;
    }
    bool ready = !frame->settings.edges || drop_specks(search, task_count, pool, call, error);
    if (frame->settings.hidden_lines == LAM_HIDDEN_LINES_DASH)
        ready = ready && find_chains(search, task_count, pool, call, error);
    search->step = DRAW;
    if (ready)
        pool_run(pool, task_count, run_task, search);
    free(search->first_tasks);
    return ready;
}

bool edges_find(struct edge_memory *memory, const struct frame *frame, const struct hierarchy *hierarchy, int lanes,
                struct pool *pool, struct call_control *call, struct edge_counts *counts, lam_error *error)
{
    struct loop_status loop = {.call = call};
    struct search search = {.memory = memory, .view = {.frame = frame, .loop = &loop}};
    // The functions for all instruction sets compute identical results.
    search.rays_of = CPU_WIDEST(lanes, edge_rays);
    if (!reserve_threads(memory, pool_threads(pool), call, error))
        return false;
    if (hierarchy)
        set_view(&search.view, frame, hierarchy, &loop);
    if (frame->edges.of_model && !find_model_edges(&search, pool, call, error))
        return false;
    struct edge_task annotations = {.view = &search.view, .rays_of = search.rays_of, .strokes = &memory->strokes[0]};
    if (frame->edges.has_box && !annotations_draw(&annotations, memory->scratch.data) && should_continue(&loop))
        no_memory(&loop);
    *counts = (struct edge_counts){search.drawn, search.rays + annotations.rays};
    if (!should_continue(&loop))
        return loop_error(&loop, sizeof(struct edge_stroke) * EDGES_PER_TASK, error);
    return edges_cover(memory, frame, pool, call, error);
}

void edges_free(struct edge_memory *memory)
{
    scene_token_release(memory->token);
    buffer_free(&memory->edges);
    buffer_free(&memory->sources);
    buffer_free(&memory->scratch);
    buffer_free(&memory->measures);
    buffer_free(&memory->weights);
    buffer_free(&memory->bands);
    for (int i = 0; i < EDGE_STYLES; i++)
        buffer_free(&memory->coverage[i]);
    for (int i = 0; i < memory->thread_count; i++)
        free(memory->strokes[i].list);
    free(memory->strokes);
    *memory = (struct edge_memory){0};
}

uint64_t edges_bytes(const struct edge_memory *memory)
{
    uint64_t bytes = memory->edges.capacity + memory->sources.capacity + memory->scratch.capacity +
                     memory->measures.capacity + memory->weights.capacity + memory->bands.capacity;
    for (int i = 0; i < EDGE_STYLES; i++)
        bytes += memory->coverage[i].capacity;
    for (int i = 0; i < memory->thread_count; i++)
        bytes += memory->strokes[i].capacity * sizeof(struct edge_stroke);
    return bytes;
}
