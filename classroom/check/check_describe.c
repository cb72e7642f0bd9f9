// check_describe.c: describes in one sentence a difference that no known mistake explains, and finds the line of a
// mistake that is visible only in the source.
#include "check_run.h"

#include <string.h>

static bool is_near(double a, double b) { return a > 0.999 * b && a < 1.001 * b; }

static bool shows_ambient(const struct run *r, int i) { return r->report->scenes[i].terms & LAM_CHECK_TERM_AMBIENT; }
static bool shows_diffuse(const struct run *r, int i) { return r->report->scenes[i].terms & LAM_CHECK_TERM_DIFFUSE; }
static bool shows_specular(const struct run *r, int i) { return r->report->scenes[i].terms & LAM_CHECK_TERM_SPECULAR; }

static const struct reference_scene *scene_of(const struct run *r, int i) { return &r->scenes[i].reference_scene; }

static bool is_lit(const struct reference_light *light)
{
    return light->color.r + light->color.g + light->color.b + light->specular.r > 0;
}

static bool has_lights(const struct run *r, int i)
{
    int lit = 0;
    for (int k = 0; k < scene_of(r, i)->light_count; k++)
        lit += is_lit(&scene_of(r, i)->lights[k]);
    return lit > 1;
}

static bool is_uneven(const struct run *r, int i)
{
    lam_vec3 scale = scene_of(r, i)->scale;
    return !is_near(scale.x, scale.y) || !is_near(scale.y, scale.z);
}

static bool is_coarse(const struct run *r, int i)
{
    enum reference_mesh mesh = scene_of(r, i)->mesh;
    return mesh == MESH_COARSE || mesh == MESH_PLANE || mesh >= MESH_PATCH;
}

static bool has_kind(const struct run *r, int i, lam_light_type type)
{
    for (int k = 0; k < scene_of(r, i)->light_count; k++)
        if (scene_of(r, i)->lights[k].type == type && is_lit(&scene_of(r, i)->lights[k]))
            return true;
    return false;
}

static bool has_direction(const struct run *r, int i) { return has_kind(r, i, LAM_LIGHT_DIRECTIONAL); }
static bool has_point(const struct run *r, int i) { return has_kind(r, i, LAM_LIGHT_POINT); }
static bool has_spot(const struct run *r, int i) { return has_kind(r, i, LAM_LIGHT_SPOT); }

static bool is_attenuated(const struct run *r, int i)
{
    const float *a = scene_of(r, i)->lights[0].attenuation;
    return a[1] > 0 || a[2] > 0;
}

static bool is_lit_from_behind(const struct run *r, int i)
{
    const struct reference_scene *s = scene_of(r, i);
    lam_vec3 eye = {s->eye.x - s->target.x, s->eye.y - s->target.y, s->eye.z - s->target.z};
    lam_vec3 way = s->lights[0].type == LAM_LIGHT_DIRECTIONAL ? s->lights[0].to_light : s->lights[0].position;
    return eye.x * way.x + eye.y * way.y + eye.z * way.z < 0;
}

static bool has_bumps(const struct run *r, int i)
{
    lam_vec3 bump = scene_of(r, i)->bump;
    return bump.x != 0 || bump.y != 0 || bump.z != 0;
}

static bool is_flat(const struct run *r, int i) { return scene_of(r, i)->flat; }
static bool has_two_sides(const struct run *r, int i) { return r->scenes[i].row->needs & NEED_TWO_SIDES; }
static bool is_translucent(const struct run *r, int i) { return r->scenes[i].alpha; }
static bool is_glossy(const struct run *r, int i) { return scene_of(r, i)->shininess > 30; }

// A property of scenes. If all differing scenes have the property, and all scenes without the property match, the
// report mentions the property as a hint. If several properties qualify, the rarest is used.
static const struct {
    const char *sentence;
    bool (*has)(const struct run *r, int scene);
} properties[] = {
    {"only the ambient term differs: scenes without it match", shows_ambient},
    {"only the diffuse term differs: scenes without it match", shows_diffuse},
    {"only the specular term differs: scenes without it match", shows_specular},
    {"correct with one light, wrong with several", has_lights},
    {"correct with uniform scales, but different with non-uniform scales: check the normals and their matrix",
     is_uneven},
    {"correct at the vertices of small triangles, but different between the vertices of large triangles: compute the "
     "interpolated value in each fragment",
     is_coarse},
    {"only directional lights differ", has_direction},
    {"only point lights differ", has_point},
    {"only spots differ", has_spot},
    {"correct without attenuation, but different with it", is_attenuated},
    {"correct if the light comes from the front, but different if it comes from behind", is_lit_from_behind},
    {"only scenes with a bumpy normal map differ: check tangent, bitangent and the texel", has_bumps},
    {"only flat shading differs", is_flat},
    {"only the scene with back faces differs", has_two_sides},
    {"only the scene with a translucent material differs: check alpha", is_translucent},
    {"only small highlights differ: check the exponent", is_glossy},
};

// Returns the number of scenes with a property. Returns 0 if a scene without the property differs, or if too few scenes
// with the property differ.
static int count_with(const struct run *r, bool (*has)(const struct run *r, int scene))
{
    int with = 0, failed = 0;
    for (int i = 0; i < r->scene_count; i++) {
        bool found = has(r, i);
        with += found;
        failed += found && !r->scenes[i].passes;
        if (!found && !r->scenes[i].passes)
            return 0;
    }
    return with < r->scene_count && 4 * failed >= 3 * with ? with : 0;
}

// Finds the factor by which every picture is too bright. Returns false if there is no such factor.
static bool find_factor(struct run *r, double *factor)
{
    double products = 0, squares = 0, sum = 0, left = 0;
    for (int turn = 0; turn < 2; turn++)
        for (int i = 0; i < r->scene_count; i++) {
            const float *theirs = r->scenes[i].samples;
            size_t count = scene_comparison_sample_count(&r->scenes[i]);
            scene_comparison_sample(&r->scenes[i], r->scenes[i].reference, r->numbers);
            for (size_t k = 0; k < count && !r->scenes[i].spoilt && !r->scenes[i].alpha; k++) {
                double x = (double)r->numbers[k], y = (double)theirs[k];
                if (x >= 1 || y >= 1)
                    continue;
                products += turn == 0 ? x * y : 0;
                squares += turn == 0 ? x * x : 0;
                double d = turn == 1 ? y - *factor * x : 0;
                left += d * d;
                sum += turn == 1 ? y * y : 0;
            }
            *factor = squares > 0 ? products / squares : 0;
        }
    return *factor > 0.02 && !is_near(*factor, 1) && left < 1e-4 * sum;
}

void check_describe(struct run *r)
{
    const char *sentence = NULL;
    double factor = 0;
    int fewest = r->scene_count, worst = 0, failed = 0;
    for (size_t k = 0; k < sizeof properties / sizeof *properties; k++) {
        int with = count_with(r, properties[k].has);
        if (with > 0 && with < fewest) {
            fewest = with;
            sentence = properties[k].sentence;
        }
    }
    for (int i = 0; i < r->scene_count; i++) {
        failed += !r->scenes[i].passes;
        worst = r->scenes[i].mean_difference > r->scenes[worst].mean_difference ? i : worst;
    }
    if (sentence)
        diagnostics_add(&r->diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, NULL, 0, "%s", sentence);
    else if (find_factor(r, &factor))
        diagnostics_add(&r->diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, NULL, 0,
                        "every picture is %.3g times as bright as the reference", factor);
    else
        diagnostics_add(&r->diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, NULL, 0,
                        "%d of %d scenes differ, most of all '%s': %s", failed, r->scene_count,
                        r->scenes[worst].row->name, r->scenes[worst].row->description);
}
