// shade.c: prepares fragments for lighting. Attributes are fetched and interpolated once for each visible triangle of a
// pixel, maps are read, and lights that cannot reach the points are dropped. lights.c then lights the points of one
// surface together. This file is compiled once for each instruction set, with LANES and ISA defined (kernels.h), and
// once with RECORDING, to shade one pixel and record its values.
#include "double_lanes.h"
#include "group.h"
#include "point.h"

#include "kernels.h"
#include "light_bounds.h"
#include "occlusion.h"
#include "samples.h"
#include "translucent_fragments.h"
#include "vertex_colors.h"

#include <stdlib.h>
#include <string.h>

static bool shades_vertices(const struct frame *frame)
{
    return frame->settings.shading != LAM_SHADING_PHONG && output_kind(frame->settings.output) != OUTPUT_GEOMETRY;
}

static struct group group_of(const struct shade_frame *shade, struct fragments *fragments, struct shading *shading,
                             const struct tile *tile, uint32_t number)
{
    const struct frame_draw_range *range = &shade->frame->ranges[number >> 1];
    const struct frame_draw *draw = &shade->frame->draws[range->draw];
    bool back = (number & 1) && !draw->one_sided;
    const struct visible_normals *visible = draw->crease_rad > 0 && shade->visible.normals ? &shade->visible : NULL;
    const struct material_products *material = &shade->materials[back ? range->back : range->front];
    bool separate =
        material->maps && shades_vertices(shade->frame) && output_kind(shade->frame->settings.output) != OUTPUT_VECTOR;
    return (struct group){
        .shade = shade,
        .frame = shade->frame,
        .fragments = fragments,
        .shading = shading,
        .tile = tile,
        .draw = draw,
        .mesh = draw->mesh,
        .material = material,
        .decode = draw->mesh->colors_format == LAM_COLORS_SRGB8 ? shade->decode_srgb : shade->decode_linear,
        .share = shade->decode_linear,
        .translucent = range->translucent,
        .blends = range->translucent && material->given->alpha_mode == LAM_ALPHA_BLEND,
        .catches = draw->ground && shade->frame->ground.kind == LAM_GROUND_SHADOW &&
                   !output_is_value(shade->frame->settings.output),
        .reflection = range->reflection,
        .separate_texture_terms = separate,
        .maps_emission = material->maps >> LAM_MAP_EMISSION & 1,
        .has_map_rows = material->maps && !separate,
        .widens = shade->frame->widens_highlights && frame_is_physical(range->reflection),
        .flip = back,
        .first_id = draw->first_id,
        .normals = visible ? &visible->normals[0][0] : draw->mesh->normals,
        .visible = visible,
        .hierarchy = shade->hierarchy,
        .tangents = lam_reflection_describe(range->reflection)->tangents || material->layers & LAYER_ANISOTROPY ||
                    shade->frame->settings.output == LAM_OUTPUT_TANGENTS,
        .occlusion = shade->occlusion || shade->occlusion_pattern,
        .traced = shade->paths && range->reflection != LAM_REFLECTION_NONE && frame_draw_casts(draw),
        .recorder = shade->recorder};
}

// Barycentric weights of corners 1 and 2; the weight of corner 0 is 1 minus both.
struct weights {
    num b1, b2;
};

// Normalizes vectors like unit3, in short loops that keep the processor busy (light_loop.inc).
static void make_unit(float rows[3][BATCH_ROW], int count)
{
    _Alignas(64) float square[BATCH_ROW], near[BATCH_ROW];
    for (int i = 0; i < count; i += LANES) {
        vec3 v = load3(rows, i);
        num s = dot3(v, v);
        num_store(square + i, s);
        num_store(near + i, rsqrt_near(s));
    }
    for (int i = 0; i < count; i += LANES)
        store3(rows, i, scale3(load3(rows, i), rsqrt_from(num_load(square + i), num_load(near + i))));
}

#include "record_points.inc"

#include "attributes.inc"
#include "triangle_runs.inc"

LANE_FN struct weights load_weights(const struct shading_batch *batch, int at)
{
    return (struct weights){num_load(batch->b1 + at), num_load(batch->b2 + at)};
}

#include "textures.inc"

// Converts the rows of a batch to the surfaces that the lighting equations use. The rows contain positions in mesh
// space, and normals and tangents in eye space, which may have any length. With `has_tangent`, the rows contain
// tangents; otherwise a direction field supplies them if the reflection model needs them.
static void make_surfaces(const struct group *g, struct shading_batch *batch, int count, bool has_tangent)
{
    bool tangents = g->tangents, distant = g->frame->distant_viewer;
    for (int i = 0; i < count; i += LANES) {
        vec3 mesh_point = load3(batch->p, i);
        RECORD(record_position(g, mesh_point));
        vec3 p = mesh_to_eye(g, mesh_point);
        store3(batch->p, i, p);
        store3(batch->v, i, distant ? to_eye(p, VIEWER_INFINITE) : negate3(p));
    }
    make_unit(batch->n, count);
    if (!distant)
        make_unit(batch->v, count); // to_eye(p, VIEWER_LOCAL)
    for (int i = 0; tangents && i < count; i += LANES) {
        vec3 n = load3(batch->n, i);
        store3(batch->t, i, perpendicular3(has_tangent ? load3(batch->t, i) : mesh_field_tangent(g, n), n));
    }
}

static bool shows_emission(lam_output output)
{
    return output == LAM_OUTPUT_PICTURE || output == LAM_OUTPUT_CLIPPED || output == LAM_OUTPUT_EMISSION;
}

// Counts shaded points. Returns false if the frame must stop.
static bool count_shaded(const struct group *g, uint64_t count)
{
    uint64_t lights = (uint64_t)(g->lights ? g->lights->count : g->frame->light_count);
    if (g->shade->paths && lights > 1)
        lights = 1; // paths choose one light at a time
    bool evaluated = g->reflection != LAM_REFLECTION_NONE && lam_output_is_light(g->frame->settings.output);
    uint64_t both = evaluated ? count * lights : 0;
    g->shading->points_lit += count;
    g->shading->lights_evaluated += both;
    uint64_t around = evaluated && g->shade->environment_light ? count * WORK_LAYER : 0;
    g->shading->uncounted += both * WORK_LIGHT + around;
    return work_step(g->shading->work, &g->shading->uncounted);
}

// Returns the number of points that are prepared at a time. The recorder needs the points one by one.
static int batch_size(const struct group *g) { return is_recording(g) ? LANES : BATCH_MAX; }

// --- Phong shading: normals are interpolated and normalized, and every fragment is shaded

// Finds the runs of a batch, with the positions of their triangles. Points that are not in the window, which rays have
// found, have no derivatives with respect to it.
static void find_runs(const struct group *g, int count, bool in_window)
{
    struct triangle_runs *runs = &g->shading->batch->runs;
    list_runs(g->shading->batch, count);
    for (int i = 0; i < runs->count; i += LANES) {
        vec3 p[3];
        if (i + 3 * LANES <= runs->count)
            prefetch_positions(g->mesh, runs->triangle + i + 2 * LANES);
        fetch_positions(g, runs->triangle + i, p);
        if (in_window)
            store_run_corners(runs, g, i, p);
        for (int k = 0; k < 3 && !in_window; k++)
            store_run3(runs, RUN_CORNERS + 3 * k, i, black3());
        store_run_interpolant(runs, RUN_INTERPOLANT, i, interpolant3(p));
        if (!g->normals)
            store_run3(runs, RUN_EXTRA, i, g->draw->facets ? facet_normals(g, p) : face_normal(g, p));
    }
}

// Interpolates the positions in mesh space and, without vertex normals, sets the normals.
static void interpolate_positions(const struct group *g, int count)
{
    struct shading_batch *batch = g->shading->batch;
    const struct triangle_runs *runs = &batch->runs;
    for (int i = 0; i < count; i += LANES) {
        struct run_lanes at = run_lanes_of(runs, i);
        store3(batch->p, i, interpolate3(load_weights(batch, i), load_run_interpolant(runs, RUN_INTERPOLANT, at)));
        if (g->normals)
            continue;
        vec3 n = load_run3(runs, RUN_EXTRA, at), no_change = sub3(n, n);
        if (g->draw->facets) // as if interpolated between equal corner normals: −0 becomes 0
            n = interpolate3(load_weights(batch, i), (struct interpolant){n, no_change, no_change});
        store3(batch->n, i, n);
    }
}

// Finds the triangles, weights and mesh positions of `count` fragments, starting with `first`.
static void locate_fragments(const struct group *g, int first, int count)
{
    struct shading_batch *batch = g->shading->batch;
    struct triangle_runs *runs = &batch->runs;
    list_fragments(g, first, count);
    list_samples(g, first, count);
    find_runs(g, count, true);
    for (int i = 0; i < count; i += LANES) {
        struct run_lanes at = run_lanes_of(runs, i);
        struct weights w = run_weights(g, first, i, at);
        num_store(batch->b1 + i, w.b1);
        num_store(batch->b2 + i, w.b2);
    }
    interpolate_positions(g, count);
}

static void interpolate_normals(const struct group *g, struct shading_batch *batch, int count)
{
    struct triangle_runs *runs = &batch->runs;
    struct elements ahead[3]; // of the next LANES runs
    normal_elements(g, runs->triangle, ahead);
    for (int i = 0; i < runs->count; i += LANES) {
        vec3 n[3];
        struct elements e[3] = {ahead[0], ahead[1], ahead[2]};
        if (i + LANES < runs->count)
            normal_elements(g, runs->triangle + i + LANES, ahead);
        for (int k = 0; k < 3; k++) {
            prefetch_elements(g->normals, &ahead[k], 3);
            n[k] = normal_to_eye(g, fetch3(g->normals, &e[k], 3));
        }
        store_run_interpolant(runs, RUN_INTERPOLANT, i, interpolant3(n));
    }
    for (int i = 0; i < count; i += LANES)
        store3(
            batch->n, i,
            interpolate3(load_weights(batch, i), load_run_interpolant(runs, RUN_INTERPOLANT, run_lanes_of(runs, i))));
}

// Finds the variance of the interpolated normals within each pixel; the rows of the runs contain the normals at the
// corners.
static void find_normal_variance(const struct group *g, struct shading_batch *batch, int count)
{
    for (int i = 0; i < count; i += LANES) {
        num variance = num_of(0.0f);
        if (g->normals) {
            struct run_lanes at = run_lanes_of(&batch->runs, i);
            struct weights w = load_weights(batch, i);
            struct interpolant s = load_run_interpolant(&batch->runs, RUN_INTERPOLANT, at);
            struct window_slopes d = window_slopes_of(g, i, at, w);
            variance = normal_variance(interpolate3(w, s), add3(scale3(s.to1, d.x.b1), scale3(s.to2, d.x.b2)),
                                       add3(scale3(s.to1, d.y.b1), scale3(s.to2, d.y.b2)));
        }
        num_store(batch->variance + i, variance);
        num_store(batch->coat_variance + i, variance);
    }
}

// Increases the roughness by the variance of the normals, which already includes the variance from normal maps.
static void widen_roughness(const struct group *g, struct shading_batch *batch, int count)
{
    for (int i = 0; i < count; i += LANES) {
        num given = g->has_map_rows ? num_load(batch->roughness + i) : num_of(g->material->given->roughness);
        num_store(batch->roughness + i, widened_roughness(given, num_load(batch->variance + i)));
    }
}

static void interpolate_tangents(const struct group *g, struct shading_batch *batch, int count)
{
    const lam_mesh *mesh = g->mesh;
    for (int i = 0; i < count; i += LANES) {
        struct elements e[3];
        vec3 t[3];
        all_corners(mesh->tangent_indices, mesh->indices, batch->triangle + i, e);
        for (int k = 0; k < 3; k++)
            t[k] = tangent_to_eye(g, fetch3(mesh->tangents, &e[k], 4));
        store3(batch->t, i, interpolate3(load_weights(batch, i), interpolant3(t)));
        for (int n = 0; n < LANES; n++) // the sign is the same at all corners
            batch->sign[i + n] = mesh->tangents[4 * (size_t)e[0].at[n] + 3];
    }
}

// Interpolates vertex colours (1 if the mesh has none) and alpha.
static void interpolate_colors(const struct group *g, struct shading_batch *batch, int count)
{
    for (int i = 0; i < count; i += LANES) {
        vec3 color = vec3_of(num_of(1.0f), num_of(1.0f), num_of(1.0f));
        num alpha = num_of(1.0f);
        if (g->mesh->colors) {
            struct weights w = load_weights(batch, i);
            vec3 c[3];
            num a[3];
            for (uint32_t k = 0; k < 3; k++) {
                struct elements e = color_elements(g, batch->triangle + i, k);
                c[k] = fetch_color(g, &e);
                a[k] = g->blends ? fetch_alpha(g, &e) : num_of(1.0f);
            }
            color = interpolate3(w, interpolant3(c));
            alpha = interpolate1(w, a);
        }
        store3(batch->color, i, color);
        num_store(batch->alpha + i, g->blends ? saturate(g->material->diffuse[3] * alpha) : num_of(1.0f));
    }
}

// Loads, for each pixel, the fraction of the surrounding light that is not occluded. The fraction was computed for the
// nearest opaque surface or the ground, so translucent surfaces receive all of the surrounding light.
static void load_occlusion(const struct group *g, struct shading_batch *batch, int count)
{
    const struct screen_occlusion *o = g->shade->occlusion;
    bool all = g->translucent && !g->draw->ground;
    int half = o->step - 1; // as in screen_pixel
    for (int i = 0; i < count; i += LANES) {
        inum x = int_of(num_load(batch->x + i)), y = int_of(num_load(batch->y + i));
        inum pixel =
            ((y & half) * 2 + (x & half)) * (int32_t)o->plane + shift_right(y, half) * o->stride + shift_right(x, half);
        num_store(batch->unoccluded + i, all ? num_of(1.0f) : gather_float(o->unoccluded, pixel));
    }
}

static struct ray_surface ray_surface_of(const struct group *g)
{
    return (struct ray_surface){g->draw, g->normals, g->visible, g->flip};
}

// Computes the start points of the rays and, if rays compute the ambient occlusion, traces these rays.
static void start_fragment_rays(const struct group *g, int count)
{
    struct shading_batch *batch = g->shading->batch;
    struct light_rays rays = light_rays_of(g);
    struct ray_surface lit = ray_surface_of(g);
    struct ray_points points = {count, batch->triangle, NULL, batch->b1, batch->b2, batch->x, batch->y};
    ray_starts_find(&rays, &lit, &points, LANES, g->shading->starts);
    if (g->occlusion && g->shade->occlusion_pattern)
        g->shade->ray_kernels->occlude(&rays, &lit, g->shading->starts, &points, batch->unoccluded);
    g->shading->rays += rays.sent;
}

// Prepares points one attribute after the other, so that the processor can work on several packets of LANES at the
// same time.
static void prepare_located(const struct group *g, int count)
{
    struct shading_batch *batch = g->shading->batch;
    bool has_tangent =
        (g->tangents || reads_map(g, LAM_MAP_NORMAL) || reads_map(g, LAM_MAP_CLEARCOAT_NORMAL)) && g->mesh->tangents;
    if (g->normals)
        interpolate_normals(g, batch, count);
    if (g->widens)
        find_normal_variance(g, batch, count);
    if (has_tangent)
        interpolate_tangents(g, batch, count);
    interpolate_colors(g, batch, count);
    RECORD(record_frame(g, has_tangent));
    if (g->material->maps)
        apply_maps(g, count);
    RECORD(record_values(g));
    if (g->widens)
        widen_roughness(g, batch, count);
    RECORD(record_lit_roughness(g));
    if (g->hierarchy)
        start_fragment_rays(g, count);
    if (g->occlusion && g->shade->occlusion)
        load_occlusion(g, batch, count);
    make_surfaces(g, batch, count, has_tangent);
}

static void prepare_fragments(const struct group *g, int first, int count)
{
    locate_fragments(g, first, count);
    prepare_located(g, count);
}

// Computes the level of detail of the selected map at each point.
static void find_levels(const struct group *g, int count)
{
    struct shading_batch *batch = g->shading->batch;
    struct map_reader reader = map_reader_of(g, count);
    int slot = 0;
    while (slot < LOD_MAPS && !reads_map(g, frame_lod_maps[slot]))
        slot++;
    bool placed = slot < LOD_MAPS && frame_has_texcoords(g->mesh, g->material->given->maps[frame_lod_maps[slot]]);
    if (placed)
        read_map(&reader, frame_lod_maps[slot]);
    for (int i = 0; i < reader.count && !placed; i += LANES)
        num_store(batch->level + i, num_of(slot < LOD_MAPS ? -50.0f : 0.0f));
}

static void output_geometry(const struct group *g, int first, int count)
{
    struct shading_batch *batch = g->shading->batch;
    for (int i = 0; i < count; i++) {
        uint32_t id = g->fragments->id[g->fragments->order[first + i]], triangle = (id & ~BACK_SIDE) - g->first_id;
        float facing = id & BACK_SIDE ? -1.0f : 1.0f, depth = -batch->p[2][i];
        bool ids = g->frame->settings.output == LAM_OUTPUT_IDS;
        float same = g->frame->settings.output == LAM_OUTPUT_DEPTH ? depth
                     : g->frame->settings.output == LAM_OUTPUT_AMBIENT_OCCLUSION
                         ? g->occlusion ? batch->unoccluded[i] : 1
                         : facing;
        batch->color[0][i] = ids ? (float)(triangle & 0xffffff) : same;
        batch->color[1][i] = ids ? (float)g->draw->object : same;
        batch->color[2][i] = ids ? (float)(triangle >> 24) : same;
    }
}

// Light beyond the range of floats is limited to this value, so that sums of samples stay finite. The value also
// replaces NaN, which results from infinite light times 0.
#define LIGHT_MAX 1e30f

#include "path_hits.inc"

// Stores the colour of point i of the batch as the colour of fragment to[i]. Neighbouring points usually belong to
// consecutive fragments.
static void scatter_colors(const struct shading_batch *batch, float *const colors[4], const uint32_t *to, int count)
{
    const float *const from[4] = {batch->color[0], batch->color[1], batch->color[2], batch->alpha};
    for (int i = 0, more; i < count; i += more) {
        more = consecutive(to + i, count - i);
        for (int c = 0; c < 4; c++) {
            float *at = colors[c] + to[i];
            num value = min_of(num_load(from[c] + i), num_of(LIGHT_MAX));
            if (more == LANES)
                num_store(at, value);
            else
                num_store_where(at, lane_numbers() < more, value, num_load(at));
        }
    }
}

// Stores the transmittance of the fragments of a batch.
static void scatter_through(const struct group *g, int first, int count)
{
    const struct shading_batch *batch = g->shading->batch;
    bool passes = g->material->layers & LAYER_TRANSMISSION && frame_is_physical(g->reflection);
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < count; i++)
            g->fragments->through[c][g->fragments->order[first + i]] = passes ? batch->through[c][i] : 0;
    for (int c = 0; c < 3 && g->fragments->bend[0]; c++)
        for (int i = 0; i < count; i++)
            g->fragments->bend[c][g->fragments->order[first + i]] = passes ? batch->bend[c][i] : -1;
}

// Shades the fragments from `first` to `end`. `prepared` means that all of them are already prepared.
static void shade_prepared(const struct group *g, int first, int end, bool prepared)
{
    int max = batch_size(g);
    for (; first < end; first += max) {
        int count = end - first < max ? end - first : max;
        if (!prepared)
            prepare_fragments(g, first, count);
        if (output_kind(g->frame->settings.output) == OUTPUT_GEOMETRY)
            output_geometry(g, first, count);
        else if (g->frame->settings.output == LAM_OUTPUT_LOD)
            find_levels(g, count);
        if (output_kind(g->frame->settings.output) != OUTPUT_GEOMETRY) {
            struct shadow_rows *shadows = g->hierarchy ? g->shading->shadows : NULL;
            lam_output output = g->frame->settings.output;
            if (shadows)
                shadows->count = 0;
            if (shadows && !g->traced && output_kind(output) != OUTPUT_VECTOR && output_kind(output) != OUTPUT_MATERIAL)
                FOR_ISA(find_shadows)(g, g->shading->batch, count);
            if (g->traced)
                trace_fragments(g, first, count);
            else
                FOR_ISA(light_points)(g, g->shading->batch, count);
        }
        scatter_colors(g->shading->batch, g->fragments->color, g->fragments->order + first, count);
        if (g->translucent && g->fragments->through[0])
            scatter_through(g, first, count);
        if (!count_shaded(g, (uint64_t)count))
            return;
    }
}

#include "vertex_shading.inc"
#include "light_cull.inc"
#include "light_cull_blocks.inc"

#include "mask.inc"

// --- groups of fragments

// Makes the list of lights for the fragments from `first` to `end`, which all belong to one surface. Returns whether it
// has already prepared the fragments for shading, or listed their vertices.
static bool cull_lights_for(const struct shade_frame *shade, struct group *g, int first, int end)
{
    const struct frame *frame = shade->frame;
    if (!shade->light_bounds || g->reflection == LAM_REFLECTION_NONE ||
        output_kind(frame->settings.output) == OUTPUT_GEOMETRY)
        return false;
    bool whole = false;
    struct point_bounds bounds = empty_bounds();
    if (shades_vertices(frame)) {
        whole = frame->settings.shading == LAM_SHADING_GOURAUD &&
                end - first <= tile_samples_count(frame->settings.samples);
        if (whole) {
            list_vertices(g, first, end, false);
            add_vertices(&bounds, g);
        } else {
            add_corners(&bounds, g, first, end);
        }
    } else {
        whole = end - first <= BATCH_MAX;
        for (int at = first; at < end; at += BATCH_MAX) {
            int count = end - at < BATCH_MAX ? end - at : BATCH_MAX;
            prepare_fragments(g, at, count);
            add_batch(&bounds, g->shading->batch, count);
        }
    }
    cull_lights(shade, g, &bounds);
    g->lights = &g->shading->lights;
    return whole;
}

// Shades fragments of one group with the group's list of lights.
static void shade_range(const struct group *g, int first, int end, bool prepared)
{
    if (!shades_vertices(g->frame)) {
        shade_prepared(g, first, end, prepared);
        return;
    }
    bool flat = g->frame->settings.shading == LAM_SHADING_FLAT;
    int max = tile_samples_count(g->frame->settings.samples); // the capacity of the vertex cache
    for (; first < end; first += max) {
        int part = end - first < max ? end : first + max;
        if (!prepared)
            list_vertices(g, first, part, flat);
        shade_vertices(g, flat);
        interpolate_vertices(g, first, part, flat);
    }
}

static bool in_group(const struct fragments *fragments, int i, uint32_t number)
{
    return fragments->group[fragments->order[i]] == number;
}

// Returns the end of the group that begins at `first`. Fragments are sorted by group, and often all belong to the same
// group, so the end is found by doubling steps and then by bisection.
static int group_end(const struct fragments *fragments, int first)
{
    uint32_t number = fragments->group[fragments->order[first]];
    int all = fragments->count, inside = first, outside = all;
    if (in_group(fragments, all - 1, number))
        return all;
    for (int step = 1; inside + step < outside; step *= 2) {
        if (in_group(fragments, inside + step, number))
            inside += step;
        else
            outside = inside + step;
    }
    while (outside - inside > 1) {
        int middle = inside + (outside - inside) / 2;
        if (in_group(fragments, middle, number))
            inside = middle;
        else
            outside = middle;
    }
    return outside;
}

static void shade_fragments(const struct shade_frame *shade, struct fragments *fragments, struct shading *shading,
                            const struct tile *tile)
{
    for (int start = 0, end; start < fragments->count; start = end) {
        end = group_end(fragments, start);
        struct group g = group_of(shade, fragments, shading, tile, fragments->group[fragments->order[start]]);
        struct pixel_blocks blocks = split_by_block(shade, fragments, start, end);
        for (int b = 0, first = start; b < blocks.count; first = blocks.end[b++]) {
            bool prepared = cull_lights_for(shade, &g, first, blocks.end[b]);
            shade_range(&g, first, blocks.end[b], prepared);
        }
    }
}

#ifdef RECORDING
#include "record_pixel.inc"

const struct recording_kernels recording_kernels = {.record_fragments = record_fragments, .record_pixel = record_pixel};
#else
const struct shade_kernels FOR_ISA(shade_kernels) = {mask_fragments, shade_fragments, light_vertices};
#endif
