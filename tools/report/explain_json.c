// explain_json.c: prints an explained pixel as one line of JSON. Angles are in degrees; missing values are null.
#include "explain_json.h"

#include "json.h"
#include "report.h"
#include "vectors.h"

#include <lambent/fields.h>
#include <lambent/light.h>

#include <math.h>

// A matrix with the rows ambient, diffuse and specular.
#define MATRIX(key, ambient, diffuse, specular)                                                                        \
    LIST(key, COLOR(NULL, ambient), COLOR(NULL, diffuse), COLOR(NULL, specular))

// A vector that is null if it is zero.
#define DIRECTION(name, v)                                                                                             \
    {                                                                                                                  \
        .key = (name), .kind = is_zero(v) ? RESULT_NONE : RESULT_NUMBERS, .count = 3, .numbers = {                     \
            (v).x,                                                                                                     \
            (v).y,                                                                                                     \
            (v).z                                                                                                      \
        }                                                                                                              \
    }

// Writes the cone of a spot light, or null.
static void write_cone(struct json *json, const lam_light *light)
{
    const bool edge = light->cutoff_rad > 0 && (double)light->cutoff_rad < 3.14159;
    if (light->type != LAM_LIGHT_SPOT)
        json_put(json, NONE("cone"));
    else if (light->outer_rad > 0)
        json_put(json, OBJECT("cone", NUMBER("inner_deg", in_degrees((double)light->inner_rad)),
                              NUMBER("outer_deg", in_degrees((double)light->outer_rad))));
    else
        json_put(json, OBJECT("cone", NUMBER("cutoff_deg", edge ? in_degrees((double)light->cutoff_rad) : (double)NAN),
                              NUMBER("exponent", light->exponent)));
}

// `n` and `v`: the normal and the direction to the eye.
static void write_light(struct json *json, const lam_explained_light *l, const lam_light *given, lam_vec3 n, lam_vec3 v)
{
    const lam_attenuation *a = &l->attenuation_terms;
    json_open(json, NULL, '{');
    json_put(json, INDEX("light", l->light), TEXT("name", l->name),
             TEXT("type", lam_light_type_describe(l->type)->word), TEXT("frame", light_frame_word(l->frame)),
             MATRIX("matrix", l->ambient, l->diffuse, l->specular), VECTOR("position", l->position),
             VECTOR("axis", l->axis), VECTOR("l", l->l), VECTOR("r", l->r), VECTOR("h", l->h),
             NUMBER("theta_deg", in_degrees(l->theta_rad)), NUMBER("phi_deg", in_degrees(l->phi_rad)),
             NUMBER("psi_deg", in_degrees(l->psi_rad)), NUMBER("v_off_plane_deg", off_plane_deg(v, n, l->l)),
             NUMBER("distance", l->type == LAM_LIGHT_DIRECTIONAL ? NAN : l->distance),
             NUMBERS("attenuation_terms", 3, (double)a->constant, (double)a->linear, (double)a->quadratic),
             NUMBER("range", l->range > 0 ? l->range : NAN), NUMBER("attenuation", l->attenuation),
             NUMBER("cos_axis", l->cos_axis));
    write_cone(json, given);
    json_put(json, NUMBER("spot", l->spot), FLAG("casts_shadows", l->casts_shadows), COLOR("passed", l->passed));
    if (l->shadow_object >= 0)
        json_put(json, OBJECT("in_the_way", INDEX("object", l->shadow_object), COUNT("triangle", l->shadow_triangle),
                              NUMBER("distance", l->shadow_distance)));
    else
        json_put(json, NONE("in_the_way"));
    json_put(json, NUMBER("occlusion", l->occlusion), NUMBER("n_dot_l", l->n_dot_l), NUMBER("base", l->base),
             NUMBER("power", l->power), NUMBER("D", l->D), NUMBER("S", l->S));
    if (l->visibility > 0)
        json_put(json, NUMBER("distribution", l->distribution), NUMBER("visibility", l->visibility),
                 COLOR("fresnel", l->fresnel));
    const lam_explained_light_layers *layers = l->layers;
    if (layers)
        json_put(json, OBJECT("layers", NUMBER("S", layers->S), NUMBER("base_diffuse", layers->base_diffuse),
                              COLOR("base", layers->base), NUMBER("sheen_left", layers->sheen_left),
                              COLOR("sheen", layers->sheen), NUMBER("coat", layers->coat)));
    json_put(json, COLOR("kd_Ld", l->kd_Ld), COLOR("ks_Ls", l->ks_Ls), FLAG("left_out", l->skipped),
             COLOR("ambient_term", l->ambient_term), COLOR("diffuse_term", l->diffuse_term),
             COLOR("specular_term", l->specular_term));
    json_close(json, '}');
}

static void write_layers(struct json *json, const lam_explained_layers *l)
{
    if (l)
        json_put(json, OBJECT("layers", COLOR("dielectric_f0", l->dielectric_f0), COLOR("metal_f0", l->metal_f0),
                              NUMBER("matt", l->matt), COLOR("transmittance", l->transmittance),
                              NUMBER("sheen_left", l->sheen_left), DIRECTION("coat_normal", l->coat_normal),
                              NUMBER("coat", l->coat), COLOR("mirrored_part", l->mirrored_part),
                              COLOR("sheen_part", l->sheen_part), COLOR("coat_part", l->coat_part)));
}

static void write_environment(struct json *json, const lam_explained_point *p)
{
    if (is_zero(p->reflected)) {
        json_put(json, NONE("environment"));
        return;
    }
    json_open(json, "environment", '{');
    json_put(json, VECTOR("R", p->reflected), VECTOR("direction", p->environment_direction),
             COLOR("light", p->environment_light));
    if (p->environment_scale + p->environment_bias > 0)
        json_put(json, NUMBER("level", p->environment_level), COLOR("prefiltered", p->prefiltered),
                 COLOR("irradiance", p->irradiance), NUMBER("scale", p->environment_scale),
                 NUMBER("bias", p->environment_bias));
    json_put(json, COLOR("diffuse_part", p->environment_diffuse), COLOR("specular_part", p->environment_specular));
    json_close(json, '}');
}

static void write_point(struct json *json, const lam_explanation *e, const lam_explained_point *p)
{
    json_open(json, NULL, '{');
    json_put(json, INDEX("corner", p->corner), VECTOR("mesh_position", p->mesh_position),
             VECTOR("world_position", p->world_position), VECTOR("position", p->position), VECTOR("n", p->n),
             VECTOR("v", p->v), DIRECTION("t", p->t), COLOR("color", p->color),
             COLOR("ambient_light", p->ambient_light), NUMBER("unoccluded", p->unoccluded),
             COLOR("ambient_term", p->ambient_term));
    write_layers(json, p->layers);
    json_open(json, "lights", '[');
    for (int i = 0; i < p->light_count; i++)
        write_light(json, &p->lights[i], &e->lights[i], p->n, p->v);
    json_close(json, ']');
    json_open(json, "hemispheres", '[');
    for (int i = 0; i < p->hemisphere_count; i++) {
        const lam_explained_hemisphere *h = &p->hemispheres[i];
        json_put(json, OBJECT(NULL, INDEX("light", h->light), TEXT("name", h->name), VECTOR("up", h->up),
                              COLOR("sky", h->sky), COLOR("ground", h->ground), NUMBER("n_dot_up", h->n_dot_up),
                              FLAG("by_diffuse", h->by_diffuse), COLOR("term", h->term)));
    }
    json_close(json, ']');
    write_environment(json, p);
    json_put(json,
             OBJECT("terms", COLOR("emission", p->emission), COLOR("ambient", p->ambient), COLOR("diffuse", p->diffuse),
                    COLOR("specular", p->specular), COLOR("reflection", p->reflection)),
             COLOR("sum", p->sum), COLOR("result", p->result));
    json_close(json, '}');
}

// Writes a field of the material, unless the material's matrix contains the field.
static void write_field(struct json *json, const lam_field *field, const lam_material *m)
{
    double numbers[4];
    int count = lam_field_get_written(field, m, numbers);
    bool in_matrix = field->offset == offsetof(lam_material, ambient) ||
                     field->offset == offsetof(lam_material, diffuse) ||
                     field->offset == offsetof(lam_material, specular);
    if (field->type == LAM_FIELD_FLAG)
        json_put(json, FLAG(field->key, numbers[0] != 0));
    else if (count == 1)
        json_number(json, field->key, numbers[0]);
    else if (!in_matrix)
        json_numbers(json, field->key, numbers, 3);
}

static void write_maps(struct json *json, const lam_explained_fragment *f)
{
    json_open(json, "maps", '[');
    for (int i = 0; i < f->map_count; i++) {
        const lam_explained_map *m = &f->maps[i];
        json_put(json,
                 OBJECT(NULL, TEXT("map", lam_map_name(m->map)), TEXT("texture", m->texture), COUNT("width", m->width),
                        COUNT("height", m->height), NUMBERS("coordinates", 2, (double)m->s, (double)m->t),
                        NUMBERS("place", 2, (double)m->column, (double)m->row), NUMBER("level", m->level),
                        NUMBERS("across", 2, (double)m->across[0], (double)m->across[1]),
                        NUMBERS("down", 2, (double)m->down[0], (double)m->down[1]), NUMBER("probes", m->probes),
                        COLOR4("texel", m->texel)));
    }
    json_close(json, ']');
    const lam_explained_values *v = f->values;
    if (!v)
        json_put(json, NONE("values"));
    else
        json_put(json, OBJECT("values", COLOR("base_color", v->base_color), NUMBER("metallic", v->metallic),
                              NUMBER("roughness", v->roughness), NUMBER("lit_roughness", v->lit_roughness),
                              NUMBER("shininess", v->shininess), NUMBER("occlusion", v->occlusion),
                              VECTOR("mesh_normal", v->mesh_normal), DIRECTION("tangent", v->tangent),
                              NUMBER("bitangent_sign", v->bitangent_sign)));
}

static void write_rows(struct json *json, const char *key, const double *numbers, int size)
{
    json_open(json, key, '[');
    for (int row = 0; row < size; row++)
        json_numbers(json, NULL, numbers + row * size, size);
    json_close(json, ']');
}

// Writes the matrices, and the positions of the point and of the triangle's corners in each space. Writes null for both
// if one of them is missing.
static void write_places(struct json *json, const lam_explained_fragment *f)
{
    if (!f->places || !f->matrices) {
        json_put(json, NONE("matrices"), NONE("places"));
        return;
    }
    json_open(json, "matrices", '{');
    write_rows(json, "model_view", &f->matrices->model_view.m[0][0], 4);
    write_rows(json, "projection", &f->matrices->projection.m[0][0], 4);
    write_rows(json, "normal", &f->matrices->normal[0][0], 3);
    json_close(json, '}');
    json_put(json, FLAG("face_normal", f->face_normal));
    static const char *const names[] = {"corner 0", "corner 1", "corner 2", "point"};
    json_open(json, "places", '[');
    for (int i = 0; i < 4; i++) {
        const lam_explained_place *p = &f->places[i];
        json_open(json, NULL, '{');
        json_put(json, TEXT("of", names[i]), VECTOR("object", p->mesh_position), VECTOR("eye", p->eye_position));
        json_numbers(json, "clip", p->clip, 4);
        json_numbers(json, "ndc", p->ndc, 3);
        json_numbers(json, "window", p->window, 3);
        if (i < 3 && !f->face_normal)
            json_put(json, VECTOR("normal", p->normal));
        json_close(json, '}');
    }
    json_close(json, ']');
    json_number(json, "winding", f->winding);
    double plane[4];
    explain_plane(f, plane);
    json_numbers(json, "plane", plane, 4);
}

static void write_material(struct json *json, const lam_explained_fragment *f)
{
    const lam_material *m = &f->surface;
    json_open(json, "material", '{');
    json_put(json, INDEX("material", f->material), TEXT("name", m->name),
             MATRIX("matrix", m->ambient, m->diffuse, m->specular));
    for (int i = 0; lam_material_field(i); i++)
        write_field(json, lam_material_field(i), m);
    json_close(json, '}');
}

static void write_fragment(struct json *json, const lam_explanation *e, const lam_explained_fragment *f)
{
    const lam_reflection_info *model = lam_reflection_describe(f->reflection);
    json_open(json, NULL, '{');
    json_put(json, INDEX("object", f->object), TEXT("object_name", f->object_name), INDEX("mesh", f->mesh),
             TEXT("mesh_name", f->mesh_name), INDEX("part", f->part), TEXT("part_name", f->part_name),
             COUNT(f->corners == 3   ? "triangle"
                   : f->corners == 2 ? "line"
                                     : "point",
                   f->triangle),
             TEXT("model", model->word),
             // "gated" means that the result is 0 if n·l is not positive
             OBJECT("formulas", TEXT("D", model->diffuse), TEXT("base", model->base),
                    FLAG("gated", !model->backlit && !(model->backlit_fibre && f->surface.fibre)),
                    FLAG("microfacet", model->microfacet), FLAG("toned", model->toned),
                    FLAG("threads", model->tangents)),
             TEXT("side", f->back ? "back" : "front"), TEXT("lit_normal", f->flipped ? "-n" : "n"),
             COUNT("samples", f->samples));
    json_open(json, "shown", '[');
    for (int s = 0; s < 16; s++)
        if (f->sample_mask >> s & 1)
            json_put(json, OBJECT(NULL, COUNT("sample", s), NUMBER("through", f->transmittance[s])));
    json_close(json, ']');
    json_put(json, INDEX("lit_sample", f->lit_sample), NUMBERS("picture_position", 2, f->picture_x, f->picture_y),
             NUMBERS("weights", 3, (double)f->weights[0], (double)f->weights[1], (double)f->weights[2]));
    write_places(json, f);
    write_material(json, f);
    write_maps(json, f);
    json_open(json, "points", '[');
    for (int i = 0; i < f->point_count; i++)
        write_point(json, e, &f->points[i]);
    json_close(json, ']');
    if (f->ground)
        json_text(json, "ground", lam_ground_name(f->ground));
    if (f->ground == LAM_GROUND_SHADOW)
        json_put(json, NUMBER("received", f->received), NUMBER("unobstructed", f->unobstructed));
    json_put(json, COLOR4("color", f->color), NUMBER("weight", f->weight));
    json_close(json, '}');
}

bool explain_formula(const struct job *job, const lam_explanation *e, lam_formula_point *point)
{
    const lam_formula formula = job_formula(job->options);
    const lam_explained_fragment *f = e->fragments;
    lam_error unused;
    if (!formula.text || !e->fragment_count || f->corners != 3 || f->mesh < 0)
        return false;
    if (formula.implicit)
        return f->places && lam_formula_evaluate(&formula, f->places[3].mesh_position, point, &unused);
    const lam_mesh *mesh = lam_scene_mesh(job->scene, f->mesh);
    const uint32_t *indices = mesh->texcoord_indices ? mesh->texcoord_indices : mesh->indices;
    lam_vec3 at = {0, 0, 0};
    for (uint32_t i = 0, corner = 3 * f->triangle; mesh->texcoords && i < 3; i++, corner++) {
        const float *st = mesh->texcoords + 2 * (size_t)(indices ? indices[corner] : corner);
        at.x += (double)f->weights[i] * (double)st[0];
        at.y += (double)f->weights[i] * (double)st[1];
    }
    return mesh->texcoords && lam_formula_evaluate(&formula, at, point, &unused);
}

static void write_formula(struct json *json, const struct job *job, const lam_explanation *e)
{
    lam_formula_point p;
    if (!explain_formula(job, e, &p))
        return;
    if (job->options->shape.implicit)
        json_put(json, OBJECT("formula", VECTOR("at", p.at), NUMBER("f", p.value), VECTOR("gradient", p.normal)));
    else
        json_put(json, OBJECT("formula", NUMBER("u", p.at.x), NUMBER("v", p.at.y), VECTOR("p", p.p),
                              VECTOR("p_u", p.p_u), VECTOR("p_v", p.p_v), VECTOR("cross", p.normal)));
}

void explain_json(FILE *file, const lam_explanation *e, const struct job *job)
{
    struct json json = {.file = file};
    json_open(&json, NULL, '{');
    json_put(&json, TEXT("lambent", lam_version()), TEXT("model", job->model));
    settings_json(&json, job->options);
    json_put(&json, COUNT("x", e->x), COUNT("y", e->y), COUNT("width", e->width), COUNT("height", e->height),
             COUNT("samples", e->samples), TEXT("shading", shading_word(e->shading)),
             TEXT("reflection", lam_reflection_describe(e->reflection)->word),
             TEXT("viewer", e->distant_viewer ? "infinite" : "local"));
    write_formula(&json, job, e);
    json_open(&json, "triangles", '[');
    for (int i = 0; i < e->fragment_count; i++)
        write_fragment(&json, e, &e->fragments[i]);
    json_close(&json, ']');
    if (e->behind.r != 0 || e->behind.g != 0 || e->behind.b != 0)
        json_put(&json, COLOR("behind", e->behind));
    json_put(&json, COLOR4("sum", e->sum), COLOR4("background", e->background), COLOR4("result", e->result),
             COLOR("straight", e->straight), NUMBER("exposure_stops", e->stops), NUMBER("exposure", e->exposure),
             TEXT("encoding", e->color == LAM_COLOR_RAW ? "raw" : "srgb"), TEXT("tone", lam_tone_name(e->tone)),
             OBJECT("formulas", TEXT("curved", lam_tone_formula(e->tone)), TEXT("encoded", encoding_formula(e->color)),
                    TEXT("bytes", BYTE_FORMULA)));
    if (e->reference)
        json_put(&json, COUNT("reference", e->reference));
    json_put(&json, COLOR("exposed", exposed_color(e)), COLOR("curved", curved_color(e)), COLOR("toned", e->toned),
             COLOR("encoded", e->encoded), NUMBERS("bytes", 4, e->bytes[0], e->bytes[1], e->bytes[2], e->bytes[3]));
    if (e->bounce_count) {
        json_put(&json, COUNT("paths", e->bounce_paths));
        json_open(&json, "bounces", '[');
        for (int k = 0; k < e->bounce_count; k++)
            json_put(&json, OBJECT(NULL, COLOR("light", e->bounces[k].light), COLOR("error", e->bounces[k].error)));
        json_close(&json, ']');
    }
    json_close(&json, '}');
    putc('\n', file);
}
