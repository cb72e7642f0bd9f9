// frame_brighten.c: computes by how much the studio is brightened for a dark model, or dimmed for a white one.
// Photographers light a black product more strongly than a white one, because otherwise only its outline would be
// visible. A white product on a white page needs less light, or its seams and edges vanish. The amount depends only on
// the colours of the surfaces, not on the view: all pictures of a model have the same exposure.
#include "frame.h"

#include "linear.h"
#include "srgb.h"
#include "surface_lattice.h"
#include "texture_map.h"

#include <string.h>

// A model is dark if three quarters of its surface have a base colour with a luminance below BRIGHT. If the 75th
// percentile of the luminance is m stops below BRIGHT, the exposure increases by RATE cbrt(m) stops: black stays black,
// but its parts can be told apart. The exposure increases by at most MOST stops, by LAMPS stops if a material emits
// light, and only as long as at most 5 % of the surface exceeds WHITE.
#define BRIGHT 0.35
#define RATE   0.9
#define MOST   2.5
#define LAMPS  1.25
#define WHITE  1.0

// A model is white if all its materials are physical, but neither metal nor glass nor emissive, and if their base colours
// have a luminance of at least PAPER. Models with textures or vertex colours are never white. The exposure of white
// models decreases by DIM stops.
#define PAPER 0.9
#define DIM   (5.0 / 6)

// The colours of textures are rarely white. Models with flat faces and textured classic materials are brightened until
// 98 % of the surface has at most this luminance. The lightest texels then look nearly white on faces that the key
// light reaches.
#define LIGHTEST 1.7

// The exposure stays if more than 5 % of the surface emits light with a luminance above GLOW: such colours are displayed
// as they are. The small lamps of a device do not count.
#define GLOW 0.02

enum { BINS = 1024, STEPS = 48 }; // the number of bins, and of steps per stop

// A histogram: area[b] is the area of the surfaces whose base colour has sqrt(luminance) ≈ b / BINS, as a whole number,
// so that the order of the surfaces has no effect.
struct luminances {
    int64_t area[BINS], all;
    int64_t shining; // of `all`, the area that emits light
    // the mesh and the material whose points are added
    const lam_mesh *mesh;
    const lam_material *material;
};

static double luminance(double r, double g, double b) { return 0.2126 * r + 0.7152 * g + 0.0722 * b; }

// Adds a corner's share of the mesh's own colour.
static void add_tint(const lam_mesh *mesh, uint32_t corner, double weight, double color[3])
{
    size_t at = mesh->colors_rate == LAM_PER_VERTEX ? mesh_element(mesh->color_indices, mesh, corner) : corner / 3;
    for (size_t c = 0; c < 3; c++)
        color[c] += weight * (mesh->colors_format == LAM_COLORS_LINEAR_F32
                                  ? (double)((const float *)mesh->colors)[4 * at + c]
                                  : srgb_linear(((const uint8_t *)mesh->colors)[4 * at + c] / 255.0));
}

// Returns the value of a map at a point of a triangle, given the weights of the corners; 1 without a map.
static texel map_value(const struct luminances *sum, enum lam_map which, uint32_t triangle, const double weight[3])
{
    const lam_mesh *mesh = sum->mesh;
    const lam_texture_map *map = sum->material->maps[which];
    const float *from = map && map->texcoords ? mesh->second_texcoords : mesh->texcoords;
    const uint32_t *own = map && map->texcoords ? mesh->second_texcoord_indices : mesh->texcoord_indices;
    double s = 0, t = 0;
    if (!map || !from)
        return (texel){1, 1, 1, 1};
    for (uint32_t k = 0; k < 3; k++) {
        const float *at = from + 2 * (size_t)mesh_element(own, mesh, 3 * triangle + k);
        s += weight[k] * (double)at[0];
        t += weight[k] * (double)at[1];
    }
    return texture_map_base(map, (float)s, (float)t);
}

static bool is_dark(const lam_rgb *c) { return c->r == 0 && c->g == 0 && c->b == 0; }

// Returns the luminance of a colour of the material at a point of a triangle, times the mesh's own colour if `tinted`.
static double luminance_at(const struct luminances *sum, const lam_rgb *color, enum lam_map which, bool tinted,
                           uint32_t triangle, const double weight[3])
{
    double tint[3] = {0}, at[3];
    for (uint32_t k = 0; tinted && k < 3; k++)
        add_tint(sum->mesh, 3 * triangle + k, weight[k], tint);
    const texel value = map_value(sum, which, triangle, weight);
    for (int c = 0; c < 3; c++)
        at[c] = (double)(&color->r)[c] * (tinted ? tint[c] : 1) * (double)value[c];
    return luminance(at[0], at[1], at[2]);
}

static void add_row(void *user, const struct lattice_row *row)
{
    struct luminances *sum = user;
    const lam_material *material = sum->material;
    const bool colored = sum->mesh->colors != NULL, shines = !is_dark(&material->emission);
    const bool varies = colored || material->maps[LAM_MAP_DIFFUSE] || (shines && material->maps[LAM_MAP_EMISSION]);
    for (int i = 0; i < (varies ? row->points : 1); i++) {
        double weight[3];
        for (int k = 0; k < 3; k++)
            weight[k] = row->weight[k] + i * row->step[k];
        const double bright =
            luminance_at(sum, &(lam_rgb){material->diffuse.r, material->diffuse.g, material->diffuse.b},
                         LAM_MAP_DIFFUSE, colored, row->triangle, weight);
        if (!(bright >= 0))
            continue;
        const double bin = __builtin_sqrt(bright) * BINS;
        const int64_t area = varies ? row->size : row->size * row->points;
        sum->area[bin < BINS - 1 ? (int)bin : BINS - 1] += area;
        sum->all += area;
        if (shines && luminance_at(sum, &material->emission, LAM_MAP_EMISSION, false, row->triangle, weight) > GLOW)
            sum->shining += area;
    }
}

// Returns the luminance that the given share of the surface does not exceed.
static double percentile(const struct luminances *sum, double share)
{
    int64_t below = 0;
    int bin = 0;
    while (bin < BINS - 1 && (double)(below + sum->area[bin]) < share * (double)sum->all)
        below += sum->area[bin++];
    return ((double)bin + 0.5) * ((double)bin + 0.5) / ((double)BINS * BINS);
}

// Returns true if the studio is the model's only light, and if the model has its own colours.
static bool applies(const struct frame *frame, const lam_scene *scene)
{
    const lam_draw_params *settings = &frame->settings;
    if (settings->brighten != LAM_BRIGHTEN_AUTO || !*scene->format || strcmp(scene->format, "scene") == 0)
        return false;
    if (scene->lights.count || scene->environment || (settings->rig != LAM_RIG_AUTO && settings->rig != LAM_RIG_STUDIO))
        return false;
    if (settings->color == LAM_COLOR_RAW || settings->ground == LAM_GROUND_CHECKER ||
        settings->ground == LAM_GROUND_COLOR)
        return false;
    for (int i = 0; i < frame->range_count; i++)
        if (frame->ranges[i].reflection == LAM_REFLECTION_NONE)
            return false;
    return lam_output_is_light(settings->output) || settings->output == LAM_OUTPUT_CLIPPED;
}

// Returns true if no surface can be dark, so that sampling is unnecessary.
static bool is_bright(const struct frame *frame)
{
    for (int i = 0; i < frame->range_count; i++) {
        const lam_material *m = frame->materials[frame->ranges[i].front];
        const lam_mesh *mesh = frame->draws[frame->ranges[i].draw].mesh;
        double bright = luminance((double)m->diffuse.r, (double)m->diffuse.g, (double)m->diffuse.b);
        if (bright < BRIGHT || m->maps[LAM_MAP_DIFFUSE] || (mesh && mesh->colors))
            return false;
    }
    return true;
}

// Returns whether the whole model is white. See PAPER.
static bool is_white(const struct frame *frame)
{
    int surfaces = 0;
    for (int i = 0; i < frame->range_count; i++) {
        const struct frame_draw_range *range = &frame->ranges[i];
        const struct frame_draw *draw = &frame->draws[range->draw];
        const lam_material *m = frame->materials[range->front];
        if (draw->ground)
            continue;
        surfaces++;
        if (draw->strokes || !frame_is_physical(range->reflection) || m->metallic > 0 || m->transmission > 0 ||
            !is_dark(&m->emission))
            return false;
        if (m->maps[LAM_MAP_DIFFUSE] || draw->mesh->colors ||
            luminance((double)m->diffuse.r, (double)m->diffuse.g, (double)m->diffuse.b) < PAPER)
            return false;
    }
    return surfaces > 0;
}

// Returns whether the model has textured classic materials and is lit by the rig for flat faces.
static bool is_painted(const struct frame *frame, const lam_scene *scene)
{
    bool textured = false;
    for (int i = 0; i < frame->range_count; i++) {
        const lam_material *material = frame->materials[frame->ranges[i].front];
        if (material->physical)
            return false;
        textured |= material->maps[LAM_MAP_DIFFUSE] != NULL;
    }
    return textured && !frame->settings.ground && scene_form(scene) == FORM_FLAT;
}

double frame_brighten_stops(const struct frame *frame, const lam_scene *scene)
{
    struct luminances sum = {.all = 0};
    if (!applies(frame, scene))
        return 0;
    if (is_bright(frame))
        return is_white(frame) ? -DIM : 0;
    bool lamps = false;
    const struct surface_lattice lattice = surface_lattice_of(scene);
    for (int i = 0; i < frame->range_count; i++) {
        const struct frame_draw_range *range = &frame->ranges[i];
        const struct frame_draw *draw = &frame->draws[range->draw];
        const uint32_t first = range->first_id - draw->first_id;
        sum.mesh = draw->mesh;
        sum.material = frame->materials[range->front];
        lamps |= !is_dark(&sum.material->emission);
        if (!draw->strokes && !draw->ground)
            surface_lattice_visit(&lattice, scene, draw->object, first, first + range->count, add_row, &sum);
    }
    int steps = 0;
    double bright = percentile(&sum, 0.75), white = percentile(&sum, 0.95);
    bool more = sum.all > 0;
    if (sum.shining > sum.all / 20)
        return 0;
    while (more && steps < (int)((lamps ? LAMPS : MOST) * STEPS)) {
        double half = (steps + 0.5) / (STEPS * RATE); // half a step above the current one
        more = bright * math_exp2(half * half * half) < BRIGHT && white * math_exp2((steps + 1.0) / STEPS) < WHITE;
        steps += more;
    }
    double lightest = is_painted(frame, scene) ? percentile(&sum, 0.98) : LIGHTEST;
    while (lightest > 0 && steps < (int)(MOST * STEPS) && lightest * math_exp2((steps + 1.0) / STEPS) < LIGHTEST)
        steps++;
    return (double)steps / STEPS;
}
