// hierarchy.c: builds the hierarchy of a frame on demand, and keeps it as long as no mesh moves.
#include "builder.h"
#include "rays.h"

#include "fail.h"

#include <string.h>

// The arrays of a ground change if its squares do.
static double square_of(const struct frame *frame, const struct frame_draw *draw)
{
    return draw->solid ? frame->ground.square : 0;
}

static bool same_sources(const struct hierarchy_memory *memory, const struct frame *frame)
{
    if (memory->token != frame->token || memory->hierarchy.source_count != frame->draw_count)
        return false;
    const struct ray_source *sources = memory->sources.data;
    for (int i = 0; i < frame->draw_count; i++) {
        const struct frame_draw *draw = &frame->draws[i];
        const struct ray_source *s = &sources[i];
        if (s->positions != draw->mesh->positions || s->indices != draw->mesh->indices ||
            s->triangle_count != draw->mesh->triangle_count || s->first_id != draw->first_id ||
            s->blocks != frame_draw_blocks(draw) || s->square != square_of(frame, draw))
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
    struct ray_source *sources = memory->sources.data;
    for (int i = 0; i < frame->draw_count; i++) {
        const struct frame_draw *draw = &frame->draws[i];
        sources[i] = (struct ray_source){draw->mesh->positions,
                                         draw->mesh->indices,
                                         draw->mesh->triangle_count,
                                         draw->first_id,
                                         frame_draw_blocks(draw),
                                         square_of(frame, draw),
                                         {{0}}};
        memcpy(sources[i].world, draw->world, sizeof sources[i].world);
    }
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
    size_t count = frame->triangle_count;
    *built = false;
    if (memory->token && same_sources(memory, frame))
        return h;
    forget(memory);
    buffer_release(&memory->nodes, call);
    if (!buffer_reserve(&memory->sources, ((size_t)frame->draw_count + 1) * sizeof(struct ray_source), call, error) ||
        !buffer_reserve(&memory->leaves, (count + 1) * LEAF_FLOATS * sizeof(float), call, error) ||
        !buffer_reserve(&memory->twins, (count + 1) * sizeof(uint32_t), call, error) ||
        !buffer_reserve(&memory->scratch, (count + 1) * sizeof(uint32_t), call, error))
        return NULL;
    struct builder builder = {.frame = frame,
                              .hierarchy = h,
                              .leaves = memory->leaves.data,
                              .twins = memory->twins.data,
                              .numbers = memory->scratch.data,
                              .nodes = &memory->nodes,
                              .pool = pool,
                              .loop = {.call = call}};
    note_sources(memory, frame);
    *h = (struct hierarchy){.leaves = builder.leaves,
                            .twins = builder.twins,
                            .sources = memory->sources.data,
                            .source_count = frame->draw_count,
                            .triangle_count = (uint32_t)count};
    bool ok = ray_space_choose(&builder, error) && ray_nodes_build(&builder, error);
    buffer_release(&memory->scratch, call); // needed again only after an object moves
    if (!ok)
        return NULL;
    if (!builder.has_twins) {
        buffer_release(&memory->twins, call);
        h->twins = NULL;
    }
    for (int i = 0; i < frame->draw_count; i++)
        if (frame_draw_casts(&frame->draws[i]))
            add_rounding(h, &frame->draws[i]);
    memory->token = scene_token_hold(frame->token);
    *built = true;
    return h;
}

void hierarchy_free(struct hierarchy_memory *memory)
{
    forget(memory);
    buffer_free(&memory->nodes);
    buffer_free(&memory->leaves);
    buffer_free(&memory->twins);
    buffer_free(&memory->scratch);
    buffer_free(&memory->sources);
}

uint64_t hierarchy_bytes(const struct hierarchy_memory *memory)
{
    return memory->nodes.capacity + memory->leaves.capacity + memory->twins.capacity + memory->scratch.capacity +
           memory->sources.capacity;
}
