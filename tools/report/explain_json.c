// explain_json.c: prints an explained pixel as one line of JSON. Angles are in degrees; missing values are null.
#include "explain_json.h"

#include "explain_words.h"
#include "json.h"
#include "settings_json.h"
#include "vectors.h"

#include <lambent/fields.h>
#include <lambent/light.h>

static void color(struct json *json, const char *key, lam_rgb c)
{
    json_numbers(json, key, (double[]){(double)c.r, (double)c.g, (double)c.b}, 3);
}

static void color4(struct json *json, const char *key, lam_rgba c)
{
    json_numbers(json, key, (double[]){(double)c.r, (double)c.g, (double)c.b, (double)c.a}, 4);
}

static void real(struct json *json, const char *key, float x) { json_number(json, key, (double)x); }

static void index_of(struct json *json, const char *key, int i)
{
    if (i < 0)
        json_none(json, key);
    else
        json_count(json, key, (uint64_t)i);
}

static void degrees(struct json *json, const char *key, double radians) { json_number(json, key, in_degrees(radians)); }

// Writes a matrix with the rows ambient, diffuse and specular.
static void matrix(struct json *json, const char *key, lam_rgb ambient, lam_rgb diffuse, lam_rgb specular)
{
    json_open(json, key, '[');
    color(json, NULL, ambient);
    color(json, NULL, diffuse);
    color(json, NULL, specular);
    json_close(json, ']');
}

// Writes the cone of a spot light, or null.
static void write_cone(struct json *json, const lam_light *light)
{
    if (light->type != LAM_LIGHT_SPOT) {
        json_none(json, "cone");
        return;
    }
    json_open(json, "cone", '{');
    if (light->outer_rad > 0) {
        degrees(json, "inner_deg", (double)light->inner_rad);
        degrees(json, "outer_deg", (double)light->outer_rad);
    } else {
        if (light->cutoff_rad > 0 && (double)light->cutoff_rad < 3.14159)
            degrees(json, "cutoff_deg", (double)light->cutoff_rad);
        else
            json_none(json, "cutoff_deg");
        real(json, "exponent", light->exponent);
    }
    json_close(json, '}');
}

static void write_light(struct json *json, const lam_explained_light *l, const lam_light *given)
{
    json_open(json, NULL, '{');
    index_of(json, "light", l->light);
    json_text(json, "name", l->name);
    json_text(json, "type", lam_light_type_describe(l->type)->word);
    json_text(json, "frame", light_frame_word(l->frame));
    matrix(json, "matrix", l->ambient, l->diffuse, l->specular);
    json_vector(json, "position", l->position);
    json_vector(json, "axis", l->axis);
    json_vector(json, "l", l->l);
    json_vector(json, "r", l->r);
    json_vector(json, "h", l->h);
    degrees(json, "theta_deg", l->theta_rad);
    degrees(json, "phi_deg", l->phi_rad);
    degrees(json, "psi_deg", l->psi_rad);
    if (l->type == LAM_LIGHT_DIRECTIONAL)
        json_none(json, "distance");
    else
        real(json, "distance", l->distance);
    const lam_attenuation *a = &l->attenuation_terms;
    json_numbers(json, "attenuation_terms", (double[]){(double)a->constant, (double)a->linear, (double)a->quadratic},
                 3);
    if (l->range > 0)
        real(json, "range", l->range);
    else
        json_none(json, "range");
    real(json, "attenuation", l->attenuation);
    real(json, "cos_axis", l->cos_axis);
    write_cone(json, given);
    real(json, "spot", l->spot);
    json_flag(json, "casts_shadows", l->casts_shadows);
    color(json, "passed", l->passed);
    if (l->shadow_object >= 0) {
        json_open(json, "in_the_way", '{');
        index_of(json, "object", l->shadow_object);
        json_count(json, "triangle", l->shadow_triangle);
        real(json, "distance", l->shadow_distance);
        json_close(json, '}');
    } else {
        json_none(json, "in_the_way");
    }
    real(json, "occlusion", l->occlusion);
    real(json, "n_dot_l", l->n_dot_l);
    real(json, "base", l->base);
    real(json, "power", l->power);
    real(json, "D", l->D);
    real(json, "S", l->S);
    if (l->visibility > 0) {
        real(json, "distribution", l->distribution);
        real(json, "visibility", l->visibility);
        color(json, "fresnel", l->fresnel);
    }
    if (l->layers) {
        json_open(json, "layers", '{');
        real(json, "S", l->layers->S);
        real(json, "base_diffuse", l->layers->base_diffuse);
        color(json, "base", l->layers->base);
        real(json, "sheen_left", l->layers->sheen_left);
        color(json, "sheen", l->layers->sheen);
        real(json, "coat", l->layers->coat);
        json_close(json, '}');
    }
    color(json, "kd_Ld", l->kd_Ld);
    color(json, "ks_Ls", l->ks_Ls);
    json_flag(json, "left_out", l->skipped);
    color(json, "ambient_term", l->ambient_term);
    color(json, "diffuse_term", l->diffuse_term);
    color(json, "specular_term", l->specular_term);
    json_close(json, '}');
}

static void write_layers(struct json *json, const lam_explained_layers *layers)
{
    if (!layers)
        return;
    json_open(json, "layers", '{');
    color(json, "dielectric_f0", layers->dielectric_f0);
    color(json, "metal_f0", layers->metal_f0);
    real(json, "matt", layers->matt);
    color(json, "transmittance", layers->transmittance);
    real(json, "sheen_left", layers->sheen_left);
    if (is_zero(layers->coat_normal))
        json_none(json, "coat_normal");
    else
        json_vector(json, "coat_normal", layers->coat_normal);
    real(json, "coat", layers->coat);
    color(json, "mirrored_part", layers->mirrored_part);
    color(json, "sheen_part", layers->sheen_part);
    color(json, "coat_part", layers->coat_part);
    json_close(json, '}');
}

static void write_point(struct json *json, const lam_explanation *e, const lam_explained_point *p)
{
    json_open(json, NULL, '{');
    index_of(json, "corner", p->corner);
    json_vector(json, "mesh_position", p->mesh_position);
    json_vector(json, "world_position", p->world_position);
    json_vector(json, "position", p->position);
    json_vector(json, "n", p->n);
    json_vector(json, "v", p->v);
    if (is_zero(p->t))
        json_none(json, "t");
    else
        json_vector(json, "t", p->t);
    color(json, "color", p->color);
    color(json, "ambient_light", p->ambient_light);
    real(json, "unoccluded", p->unoccluded);
    color(json, "ambient_term", p->ambient_term);
    write_layers(json, p->layers);
    json_open(json, "lights", '[');
    for (int i = 0; i < p->light_count; i++)
        write_light(json, &p->lights[i], &e->lights[i]);
    json_close(json, ']');
    json_open(json, "hemispheres", '[');
    for (int i = 0; i < p->hemisphere_count; i++) {
        const lam_explained_hemisphere *h = &p->hemispheres[i];
        json_open(json, NULL, '{');
        index_of(json, "light", h->light);
        json_text(json, "name", h->name);
        json_vector(json, "up", h->up);
        color(json, "sky", h->sky);
        color(json, "ground", h->ground);
        real(json, "n_dot_up", h->n_dot_up);
        json_flag(json, "by_diffuse", h->by_diffuse);
        color(json, "term", h->term);
        json_close(json, '}');
    }
    json_close(json, ']');
    if (is_zero(p->reflected)) {
        json_none(json, "environment");
    } else {
        json_open(json, "environment", '{');
        json_vector(json, "R", p->reflected);
        json_vector(json, "direction", p->environment_direction);
        color(json, "light", p->environment_light);
        if (p->environment_scale + p->environment_bias > 0) {
            real(json, "level", p->environment_level);
            color(json, "prefiltered", p->prefiltered);
            color(json, "irradiance", p->irradiance);
            real(json, "scale", p->environment_scale);
            real(json, "bias", p->environment_bias);
        }
        color(json, "diffuse_part", p->environment_diffuse);
        color(json, "specular_part", p->environment_specular);
        json_close(json, '}');
    }
    json_open(json, "terms", '{');
    color(json, "emission", p->emission);
    color(json, "ambient", p->ambient);
    color(json, "diffuse", p->diffuse);
    color(json, "specular", p->specular);
    color(json, "reflection", p->reflection);
    json_close(json, '}');
    color(json, "sum", p->sum);
    color(json, "result", p->result);
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
        json_flag(json, field->key, numbers[0] != 0);
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
        json_open(json, NULL, '{');
        json_text(json, "map", lam_map_name(m->map));
        json_text(json, "texture", m->texture);
        json_count(json, "width", (uint64_t)m->width);
        json_count(json, "height", (uint64_t)m->height);
        json_numbers(json, "coordinates", (double[]){(double)m->s, (double)m->t}, 2);
        json_numbers(json, "place", (double[]){(double)m->column, (double)m->row}, 2);
        real(json, "level", m->level);
        color4(json, "texel", m->texel);
        json_close(json, '}');
    }
    json_close(json, ']');
    const lam_explained_values *v = f->values;
    if (!v) {
        json_none(json, "values");
        return;
    }
    json_open(json, "values", '{');
    color(json, "base_color", v->base_color);
    real(json, "metallic", v->metallic);
    real(json, "roughness", v->roughness);
    real(json, "lit_roughness", v->lit_roughness);
    real(json, "shininess", v->shininess);
    real(json, "occlusion", v->occlusion);
    json_vector(json, "mesh_normal", v->mesh_normal);
    if (is_zero(v->tangent))
        json_none(json, "tangent");
    else
        json_vector(json, "tangent", v->tangent);
    real(json, "bitangent_sign", v->bitangent_sign);
    json_close(json, '}');
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
        json_none(json, "matrices");
        json_none(json, "places");
        return;
    }
    json_open(json, "matrices", '{');
    write_rows(json, "model_view", &f->matrices->model_view.m[0][0], 4);
    write_rows(json, "projection", &f->matrices->projection.m[0][0], 4);
    write_rows(json, "normal", &f->matrices->normal[0][0], 3);
    json_close(json, '}');
    json_flag(json, "face_normal", f->face_normal);
    static const char *const names[] = {"corner 0", "corner 1", "corner 2", "point"};
    json_open(json, "places", '[');
    for (int i = 0; i < 4; i++) {
        const lam_explained_place *p = &f->places[i];
        json_open(json, NULL, '{');
        json_text(json, "of", names[i]);
        json_vector(json, "object", p->mesh_position);
        json_vector(json, "eye", p->eye_position);
        json_numbers(json, "clip", p->clip, 4);
        json_numbers(json, "ndc", p->ndc, 3);
        json_numbers(json, "window", p->window, 3);
        if (i < 3 && !f->face_normal)
            json_vector(json, "normal", p->normal);
        json_close(json, '}');
    }
    json_close(json, ']');
    json_number(json, "winding", f->winding);
}

// Writes the reflection model and its formulas. The key "gated" means that the result is 0 if n·l is not positive.
static void write_formulas(struct json *json, const lam_explained_fragment *f)
{
    const lam_reflection_info *model = lam_reflection_describe(f->reflection);
    json_text(json, "model", model->word);
    json_open(json, "formulas", '{');
    json_text(json, "D", model->diffuse);
    json_text(json, "base", model->base);
    json_flag(json, "gated", !model->backlit && !(model->backlit_fibre && f->surface.fibre));
    json_flag(json, "microfacet", model->microfacet);
    json_close(json, '}');
}

static void write_fragment(struct json *json, const lam_explanation *e, const lam_explained_fragment *f)
{
    const lam_material *m = &f->surface;
    json_open(json, NULL, '{');
    index_of(json, "object", f->object);
    json_text(json, "object_name", f->object_name);
    index_of(json, "mesh", f->mesh);
    json_text(json, "mesh_name", f->mesh_name);
    index_of(json, "part", f->part);
    json_text(json, "part_name", f->part_name);
    json_count(json, f->corners == 3 ? "triangle" : f->corners == 2 ? "line" : "point", f->triangle);
    write_formulas(json, f);
    json_text(json, "side", f->back ? "back" : "front");
    json_text(json, "lit_normal", f->flipped ? "-n" : "n");
    json_count(json, "samples", (uint64_t)f->samples);
    json_open(json, "shown", '[');
    for (int s = 0; s < 16; s++)
        if (f->sample_mask >> s & 1) {
            json_open(json, NULL, '{');
            json_count(json, "sample", (uint64_t)s);
            real(json, "through", f->transmittance[s]);
            json_close(json, '}');
        }
    json_close(json, ']');
    index_of(json, "lit_sample", f->lit_sample);
    json_numbers(json, "picture_position", (double[]){f->picture_x, f->picture_y}, 2);
    json_numbers(json, "weights", (double[]){(double)f->weights[0], (double)f->weights[1], (double)f->weights[2]}, 3);
    write_places(json, f);
    json_open(json, "material", '{');
    index_of(json, "material", f->material);
    json_text(json, "name", m->name);
    matrix(json, "matrix", m->ambient, (lam_rgb){m->diffuse.r, m->diffuse.g, m->diffuse.b}, m->specular);
    for (int i = 0; lam_material_field(i); i++)
        write_field(json, lam_material_field(i), m);
    json_close(json, '}');
    write_maps(json, f);
    json_open(json, "points", '[');
    for (int i = 0; i < f->point_count; i++)
        write_point(json, e, &f->points[i]);
    json_close(json, ']');
    if (f->ground)
        json_text(json, "ground", lam_ground_name(f->ground));
    if (f->ground == LAM_GROUND_SHADOW) {
        real(json, "received", f->received);
        real(json, "unobstructed", f->unobstructed);
    }
    color4(json, "color", f->color);
    real(json, "weight", f->weight);
    json_close(json, '}');
}

void explain_json(FILE *file, const lam_explanation *e, const struct job *job)
{
    struct json json = {.file = file};
    json_open(&json, NULL, '{');
    json_text(&json, "lambent", lam_version());
    json_text(&json, "model", job->model);
    settings_json(&json, job->options);
    json_count(&json, "x", (uint64_t)e->x);
    json_count(&json, "y", (uint64_t)e->y);
    json_count(&json, "width", (uint64_t)e->width);
    json_count(&json, "height", (uint64_t)e->height);
    json_count(&json, "samples", (uint64_t)e->samples);
    json_text(&json, "shading", shading_word(e->shading));
    json_text(&json, "reflection", lam_reflection_describe(e->reflection)->word);
    json_text(&json, "viewer", e->distant_viewer ? "infinite" : "local");
    json_open(&json, "triangles", '[');
    for (int i = 0; i < e->fragment_count; i++)
        write_fragment(&json, e, &e->fragments[i]);
    json_close(&json, ']');
    if (e->behind.r != 0 || e->behind.g != 0 || e->behind.b != 0)
        color(&json, "behind", e->behind);
    color4(&json, "sum", e->sum);
    color4(&json, "background", e->background);
    color4(&json, "result", e->result);
    color(&json, "straight", e->straight);
    json_number(&json, "exposure_stops", e->stops);
    real(&json, "exposure", e->exposure);
    json_text(&json, "encoding", e->color == LAM_COLOR_RAW ? "raw" : "srgb");
    json_text(&json, "tone", lam_tone_name(e->tone));
    if (e->reference)
        json_count(&json, "reference", (uint64_t)e->reference);
    color(&json, "toned", e->toned);
    color(&json, "encoded", e->encoded);
    json_open(&json, "bytes", '[');
    for (int i = 0; i < 4; i++)
        json_count(&json, NULL, e->bytes[i]);
    json_close(&json, ']');
    json_close(&json, '}');
    putc('\n', file);
}
