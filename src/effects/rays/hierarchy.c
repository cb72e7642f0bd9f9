// hierarchy.c: builds the hierarchy of a frame on demand, and keeps it as long as no mesh moves.
#include "builder.h"
#include "rays.h"

#include "fail.h"

#include <string.h>

// All data that a hierarchy depends on. Equal pointers mean equal contents, since a scene never modifies its arrays.
struct source {
    const float *positions;
    const uint32_t *indices;
    uint32_t triangle_count, first_id;
    bool blocks;
    double world[3][4];
};

static bool same_sources(const struct hierarchy_memory *memory, const struct frame *frame)
{
    if (memory->token != frame->token || memory->source_count != frame->draw_count)
        return false;
    const struct source *sources = memory->sources.data;
    for (int i = 0; i < frame->draw_count; i++) {
        const struct frame_draw *draw = &frame->draws[i];
        const struct source *s = &sources[i];
        if (s->positions != draw->mesh->positions || s->indices != draw->mesh->indices ||
            s->triangle_count != draw->mesh->triangle_count || s->first_id != draw->first_id ||
            s->blocks != frame_draw_blocks(draw))
            return false;
        // Objects without shadows may change from frame to frame, so they are excluded.
        if (frame_draw_casts(draw) && memcmp(s->world, draw->world, sizeof s->world) != 0)
            return false;
    }
    return true;
}

// Raises h->rounding to the rounding errors of a draw. The errors come from the coordinates in the file
// (frame_draw.rounding), from the transform to the hierarchy's space, and from the computation of a point in a
// triangle. The transform and the computation together need fewer than eight operations in double precision. Their
// operands are at most the sum below.
static void add_rounding(struct hierarchy *h, const struct frame_draw *draw)
{
    for (int i = 0; i < 3; i++) {
        double away = __builtin_fabs(draw->world[i][3]) + __builtin_fabs(h->centre[i]);
        double rounding = draw->rounding[i] * h->scale + 0x1p-50 * (1 + away * h->scale);
        h->rounding[i] = rounding > h->rounding[i] ? rounding : h->rounding[i];
    }
}

static void note_sources(struct hierarchy_memory *memory, const struct frame *frame)
{
    struct source *sources = memory->sources.data;
    for (int i = 0; i < frame->draw_count; i++) {
        const struct frame_draw *draw = &frame->draws[i];
        if (frame_draw_casts(draw))
            add_rounding(&memory->hierarchy, draw);
        sources[i] = (struct source){draw->mesh->positions, draw->mesh->indices,     draw->mesh->triangle_count,
                                     draw->first_id,        frame_draw_blocks(draw), {{0}}};
        memcpy(sources[i].world, draw->world, sizeof sources[i].world);
    }
    memory->source_count = frame->draw_count;
    memory->token = scene_token_hold(frame->token);
}

static void forget(struct hierarchy_memory *memory)
{
    scene_token_release(memory->token);
    memory->token = NULL;
}

const struct hierarchy *hierarchy_of_frame(struct hierarchy_memory *memory, const struct frame *frame,
                                           struct pool *pool, struct call_control *call, bool *built, lam_error *error)
{
    struct hierarchy *h = &memory->hierarchy;
    size_t count = frame->triangle_count, nodes = 1 + (size_t)ray_nodes_below(frame->triangle_count);
    *built = false;
    if (memory->token && same_sources(memory, frame))
        return h;
    forget(memory);
    if (!buffer_reserve(&memory->sources, ((size_t)frame->draw_count + 1) * sizeof(struct source), call, error) ||
        !buffer_reserve(&memory->nodes, nodes * sizeof(struct ray_node), call, error) ||
        !buffer_reserve(&memory->triangles, (count + 1) * sizeof(struct ray_triangle), call, error) ||
        !buffer_reserve(&memory->twins, (count + 1) * sizeof(uint32_t), call, error) ||
        !buffer_reserve(&memory->scratch, 2 * (count + 1) * sizeof(struct primitive), call, error))
        return NULL;
    struct builder builder = {.frame = frame,
                              .hierarchy = h,
                              .triangles = memory->triangles.data,
                              .nodes = memory->nodes.data,
                              .twins = memory->twins.data,
                              .pool = pool,
                              .loop = {.call = call}};
    builder.primitives = memory->scratch.data;
    builder.in_cells = builder.primitives + count;
    *h = (struct hierarchy){.nodes = builder.nodes,
                            .triangles = builder.triangles,
                            .twins = builder.twins,
                            .node_count = (uint32_t)nodes,
                            .triangle_count = (uint32_t)count};
    bool ok = ray_triangles_prepare(&builder, error) && ray_nodes_build(&builder, error);
    // The scratch memory is half as large as the hierarchy, and is needed again only after an object moves.
    buffer_release(&memory->scratch, call);
    if (!ok)
        return NULL;
    note_sources(memory, frame);
    *built = true;
    return h;
}

void hierarchy_free(struct hierarchy_memory *memory)
{
    forget(memory);
    buffer_free(&memory->nodes);
    buffer_free(&memory->triangles);
    buffer_free(&memory->twins);
    buffer_free(&memory->scratch);
    buffer_free(&memory->sources);
}

uint64_t hierarchy_bytes(const struct hierarchy_memory *memory)
{
    return memory->nodes.capacity + memory->triangles.capacity + memory->twins.capacity + memory->scratch.capacity +
           memory->sources.capacity;
}
