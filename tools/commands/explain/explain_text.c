// explain_text.c: prints an explained pixel as aligned text, with units and the formula of each term (docs/lighting.md
// lists all formulas). It is longer than 600 lines because it has one short function for each term.
#include "explain.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <lambent/fields.h>
#include <lambent/light.h>

#include "explain_json.h"
#include "foreign.h"

enum { FEW_LIGHTS = 16 }; // with more lights, only contributing lights are printed

static void named(const char *name)
{
    if (name && *name) {
        printf(" '");
        print_foreign(stdout, FOREIGN_TERMINAL, FOREIGN(name));
        printf("'");
    }
}

// --- a light

static void print_attenuation(const lam_explained_light *l)
{
    if (l->type == LAM_LIGHT_DIRECTIONAL) {
        row_number(4, "attenuation", (double)l->attenuation, "directional: not attenuated");
        return;
    }
    row_number(4, "distance d", (double)l->distance, "model units");
    char remark[200];
    int used = snprintf(remark, sizeof remark, "1 / (%.7g + %.7g d + %.7g d²)", (double)l->attenuation_terms.constant,
                        (double)l->attenuation_terms.linear, (double)l->attenuation_terms.quadratic);
    if (l->range > 0)
        snprintf(remark + used, sizeof remark - (size_t)used, " · max(min(1 − (d/%.7g)⁴, 1), 0)", (double)l->range);
    row_number(4, "attenuation", (double)l->attenuation, remark);
}

static void print_highlight(const lam_explained_fragment *f, const lam_explained_point *p, const lam_explained_light *l)
{
    const lam_reflection_info *model = lam_reflection_describe(f->reflection);
    bool gated = !model->backlit && !(model->backlit_fibre && f->surface.fibre);
    const char *gate = gated ? "[n·l > 0] " : "";
    char remark[200];
    if (model->tangents) {
        row_number(4, "t·l", dot(p->t, l->l), "cos(t,l)");
        row_number(4, "t·v", dot(p->t, p->v), "cos(t,v)");
    }
    const lam_explained_light_layers *layers = p->layers ? l->layers : NULL;
    bool gates_diffuse =
        strncmp(model->diffuse, "max(", 4) != 0; // a formula that begins with max() is already 0 if n·l ≤ 0
    char over[60] = "";
    if (layers)
        explain_layers_over(over, p->layers, layers->sheen_left);
    snprintf(remark, sizeof remark, "%s%s%s%s", over, layers && p->layers->matt < 1 ? "matt · " : "",
             gates_diffuse ? gate : "", model->diffuse);
    row_number(4, "D", (double)l->D, remark);
    if (!model->base)
        return;
    if (model->microfacet) {
        if (!layers || f->surface.anisotropy == 0) {
            row_number(4, "D(h)", (double)l->distribution,
                       "share of microfacets that face h: α² / (π (|n × h|² + (n·h)² α²)²)");
            row_number(4, "V", (double)l->visibility, "share of microfacets visible from light and eye");
        }
        row_color(4, "F", l->fresnel, "their reflectance: f0 + (1 − f0) (1 − v·h)⁵");
        snprintf(remark, sizeof remark, "%sπ D(h) V max(n·l, 0)%s", gate,
                 layers && f->surface.anisotropy > 0 ? ", stretched along the surface" : "");
        row_number(4, "S", (double)(layers ? layers->S : l->S), remark);
        if (layers)
            explain_light_layers(layers, p->layers);
        return;
    }
    if (model->toned) {
        row_number(4, "w", 0.5 + 0.5 * (double)l->n_dot_l, "(1 + n·l) ÷ 2: warmth");
        row_number(4, "S", (double)l->S, "the colour of the second term is ks ⊙ Ls ⊙ (w, w, 1 − w)");
        return;
    }
    row_number(4, "base", (double)l->base, model->base);
    row_number(4, "power α", (double)l->power, "the shininess");
    snprintf(remark, sizeof remark, "%sbase^α = %s%.7g^%.7g", gate, gated && !(l->n_dot_l > 0) ? "0 · " : "",
             (double)l->base, (double)l->power);
    row_number(4, "S", (double)l->S, remark);
}

// Prints the fraction of the light that passes, and the surface that blocks the rest.
static void print_shadow(const lam_explained_light *l)
{
    char remark[200] = "nothing blocks the light";
    if (!l->casts_shadows)
        return;
    if (l->shadow_object >= 0)
        snprintf(remark, sizeof remark, "triangle %u of object %d blocks the light, %.7g from the point",
                 l->shadow_triangle, l->shadow_object, (double)l->shadow_distance);
    row_color(4, "passed", l->passed, remark);
}

static void product(char text[200], const lam_explained_light *l, const char *what, lam_rgb c, float answer)
{
    char occlusion[24] = "";
    if (l->occlusion != 1)
        snprintf(occlusion, sizeof occlusion, "%.7g · ", (double)l->occlusion);
    int used = snprintf(text, 200, "%sspot · attenuation · %s%s = %s%.7g · %.7g · (%.7g %.7g %.7g) · %.7g",
                        l->occlusion != 1 ? "occlusion · " : "", what, l->casts_shadows ? " · passed" : "", occlusion,
                        (double)l->spot, (double)l->attenuation, (double)c.r, (double)c.g, (double)c.b, (double)answer);
    if (l->casts_shadows && used < 200)
        snprintf(text + used, 200 - (size_t)used, " · (%.7g %.7g %.7g)", (double)l->passed.r, (double)l->passed.g,
                 (double)l->passed.b);
}

// Prints how the factor of a spot light is computed, for cones as in OpenGL or in glTF (lam_light).
static void print_cone(const lam_explained_light *l, const lam_light *given)
{
    const double c = (double)l->cos_axis, exponent = (double)given->exponent;
    char remark[200];
    row_number(4, "c", c, "(−l)·axis");
    if (given->outer_rad > 0) {
        const double inner = cos((double)given->inner_rad), outer = cos((double)given->outer_rad);
        row_number(4, "cos inner", inner, "of the half angle within which the light is uniform");
        row_number(4, "cos outer", outer, "of the half angle at which the light ends");
        snprintf(remark, sizeof remark, "%sclamp((c − cos outer) / max(0.001, cos inner − cos outer), 0, 1)²",
                 l->spot > 0 ? "" : "outside of the cone, c ≤ cos outer: ");
    } else {
        const bool edge = given->cutoff_rad > 0 && (double)given->cutoff_rad < 3.14159;
        row_number(4, "exponent ε", exponent, "");
        if (edge)
            row_number(4, "cos cutoff", cos((double)given->cutoff_rad), "of the cone's half angle");
        if (l->spot > 0)
            snprintf(remark, sizeof remark, "c^ε = %.7g^%.7g", c, exponent);
        else if (edge && c < cos((double)given->cutoff_rad))
            snprintf(remark, sizeof remark, "outside of the cone: c < cos cutoff");
        else
            snprintf(remark, sizeof remark, "max(c, 0)^ε");
    }
    row_number(4, "spot", (double)l->spot, remark);
}

static void print_light(const lam_explanation *e, const lam_explained_fragment *f, const lam_explained_point *p,
                        const lam_explained_light *l, int number_in_list)
{
    if (l->light >= 0)
        printf("\n  light %d", l->light);
    else
        printf("\n  light %d of the rig", number_in_list);
    named(l->name);
    printf(", %s, fixed to the %s\n", lam_light_type_describe(l->type)->word, light_frame_word(l->frame));
    row_heading(4, "matrix", "");
    row_color(4, "ambient La", l->ambient, "");
    row_color(4, "diffuse Ld", l->diffuse, "");
    row_color(4, "specular Ls", l->specular, "");
    if (l->type != LAM_LIGHT_DIRECTIONAL)
        row_vector(4, "position", l->position, "eye space");
    if (l->type != LAM_LIGHT_POINT)
        row_vector(4, "axis", l->axis, "direction of the light");
    row_vector(4, "l", l->l, "to the light");
    if (!lam_reflection_describe(f->reflection)->tangents) {
        char remark[100];
        const double off = off_plane_deg(p->v, p->n, l->l);
        snprintf(remark, sizeof remark,
                 off > 0.05 ? "between n and h; not φ/2, because v is %.2f° off the plane of n and l"
                            : "between n and h, φ/2",
                 off);
        row_vector(4, "r", l->r, "2 (n·l) n − l");
        row_vector(4, "h", l->h, "(l + v) / |l + v|");
        row_angle("θ", l->theta_rad, "between n and l");
        row_angle("φ", l->phi_rad, "between r and v");
        row_angle("ψ", l->psi_rad, remark);
    }
    print_attenuation(l);
    if (l->type == LAM_LIGHT_SPOT)
        print_cone(l, &e->lights[number_in_list]);
    print_shadow(l);
    if (l->occlusion != 1)
        row_number(4, "occlusion", (double)l->occlusion, "1 − occluded (1 − unoccluded)");
    row_number(4, "n·l", (double)l->n_dot_l, "");
    print_highlight(f, p, l);
    char text[200];
    bool microfacet = lam_reflection_describe(f->reflection)->microfacet;
    product(text, l, microfacet ? "base (1 − metallic) ⊙ Ld · D" : "kd ⊙ Ld · D", l->kd_Ld, l->D);
    row_color(4, "diffuse", l->diffuse_term, text);
    if (l->layers && p->layers) {
        bool coat = p->layers->coat > 0, sheen = l->layers->sheen_left < 1 || !is_black(l->layers->sheen);
        snprintf(text, sizeof text, "%sspot · attenuation%s · Ls ⊙ (%s%s%s)", l->occlusion != 1 ? "occlusion · " : "",
                 l->casts_shadows ? " · passed" : "", coat ? "(1 − share) " : "",
                 !sheen ? "base"
                 : coat ? "(left · base + sheen)"
                        : "left · base + sheen",
                 coat ? " + coat" : "");
        row_color(4, "specular", l->specular_term, text);
    } else {
        product(text, l, microfacet ? "F ⊙ Ls · S" : "ks ⊙ Ls · S", l->ks_Ls, l->S);
        row_color(4, "specular", l->specular_term, text);
    }
    if (e->gl1)
        row_color(4, "ambient", l->ambient_term, "spot · attenuation · ka ⊙ La, as in OpenGL 1");
}

static void print_hemisphere(const lam_explained_hemisphere *h, int number_in_list)
{
    if (h->light >= 0)
        printf("\n  light %d", h->light);
    else
        printf("\n  hemisphere %d of the rig", number_in_list);
    named(h->name);
    printf(", hemisphere\n");
    row_color(4, "sky", h->sky, "");
    row_color(4, "ground", h->ground, "");
    row_vector(4, "up", h->up, "eye space");
    row_number(4, "n·up", (double)h->n_dot_up, "");
    row_color(4, "ambient", h->term,
              h->by_diffuse ? "kd ⊙ mix(ground, sky, ½ + ½ n·up)" : "ka ⊙ mix(ground, sky, ½ + ½ n·up)");
}

// Prints all lights, or only the contributing lights if there are many.
static void print_lights(const lam_explanation *e, const lam_explained_fragment *f, const lam_explained_point *p)
{
    int nothing = 0, left_out = 0;
    for (int i = 0; i < p->light_count; i++) {
        const lam_explained_light *l = &p->lights[i];
        bool adds = !is_black(l->ambient_term) || !is_black(l->diffuse_term) || !is_black(l->specular_term);
        left_out += l->skipped;
        nothing += !adds;
        if (p->light_count <= FEW_LIGHTS || (adds && !l->skipped))
            print_light(e, f, p, l, i);
    }
    if (p->light_count <= FEW_LIGHTS || nothing + left_out == 0)
        return;
    printf("\n  %d of %d lights contribute nothing here", nothing, p->light_count);
    if (left_out)
        printf("; %d more were skipped: too weak (--light-cutoff)", left_out);
    printf("\n");
}

// --- a point and a triangle

static bool same(lam_vec3 a, lam_vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

static void print_environment(const lam_explanation *e, const lam_explained_fragment *f, const lam_explained_point *p)
{
    if (is_zero(p->reflected))
        return;
    printf("\n  environment\n");
    row_vector(4, "R", p->reflected, "2 (n·v) n − v, the reflected eye vector");
    row_vector(4, "direction", p->environment_direction, "R in the environment's own axes");
    row_color(4, "light from there", p->environment_light, "");
    if (p->environment_scale + p->environment_bias > 0) {
        char text[100];
        int level = (int)p->environment_level;
        int share = (int)((p->environment_level - (float)level) * 100 + 0.5f);
        snprintf(text, sizeof text, "of the prefiltered environment for the roughness: %d %% of %d, %d %% of %d",
                 100 - share, level, share, level + 1);
        row_number(4, "level", (double)p->environment_level, text);
        row_color(4, "prefiltered", p->prefiltered, "mean light around R, at this level");
        row_color(4, "irradiance ÷ π", p->irradiance, "above the surface");
        row_number(4, "scale", (double)p->environment_scale, "");
        row_number(4, "bias", (double)p->environment_bias, "the lobe's integral is f0 scale + bias");
        explain_environment_parts(p);
    } else if (e->reference && f->surface.physical) {
        char text[100];
        snprintf(text, sizeof text, "of the integral of the environment's light, by %d directions", e->reference);
        row_color(4, "diffuse part", p->environment_diffuse, text);
        row_color(4, "mirrored part", p->environment_specular, "");
    }
}

// Returns whether the point is lit with the texture. With the other methods of shading, the texture multiplies the
// interpolated light.
static bool is_textured(const lam_explanation *e, const lam_explained_fragment *f)
{
    return f->surface.maps[LAM_MAP_DIFFUSE] && e->shading == LAM_SHADING_PHONG;
}

static bool is_colored(const lam_explained_point *p) { return p->color.r != 1 || p->color.g != 1 || p->color.b != 1; }

static void print_terms(const lam_explanation *e, const lam_explained_fragment *f, const lam_explained_point *p)
{
    printf("\n  terms\n");
    const char *tint = !is_colored(p)      ? ""
                       : is_textured(e, f) ? ", times texture and vertex colour"
                                           : ", times the vertex colour";
    char text[200];
    if (f->reflection == LAM_REFLECTION_NONE) {
        snprintf(text, sizeof text, "kd: unlit%s", tint);
        row_color(4, "diffuse", p->diffuse, text);
    } else {
        if (p->unoccluded != 1)
            row_number(4, "unoccluded", (double)p->unoccluded,
                       "ambient occlusion: the fraction of surrounding light that arrives; multiplies ambient and "
                       "environment light");
        row_color(4, "emission", p->emission, "");
        snprintf(text, sizeof text, "%s%s%s = ka ⊙ (%.7g %.7g %.7g)%s",
                 e->gl1 ? "ka ⊙ La_global + Σ of the lights' ambient terms" : "ka ⊙ (La_global + Σ La)",
                 p->hemisphere_count ? " + Σ hemispheres" : "", tint, (double)p->ambient_light.r,
                 (double)p->ambient_light.g, (double)p->ambient_light.b, p->hemisphere_count || e->gl1 ? " + …" : "");
        row_color(4, "ambient", p->ambient, text);
        bool around = !is_black(p->environment_diffuse) || !is_black(p->environment_specular);
        snprintf(text, sizeof text, "Σ of the lights' diffuse terms%s%s", tint,
                 around ? " + the environment's diffuse part" : "");
        row_color(4, "diffuse", p->diffuse, text);
        row_color(4, "specular", p->specular,
                  !around     ? "Σ of the lights' specular terms"
                  : p->layers ? "Σ of the lights' specular terms + the environment's other parts"
                              : "Σ of the lights' specular terms + the environment's mirrored part");
        snprintf(text, sizeof text, "kr ⊙ environment = (%.7g %.7g %.7g) ⊙ (%.7g %.7g %.7g)",
                 (double)f->surface.reflectivity.r, (double)f->surface.reflectivity.g,
                 (double)f->surface.reflectivity.b, (double)p->environment_light.r, (double)p->environment_light.g,
                 (double)p->environment_light.b);
        row_color(4, "reflection", p->reflection, e->has_environment && !around ? text : "");
    }
    row_color(4, "sum", p->sum, "emission + ambient + diffuse + specular + reflection");
    if (p->result.r != p->sum.r || p->result.g != p->sum.g || p->result.b != p->sum.b)
        row_color(4, "clamped", p->result, "to 0…1, as in OpenGL 1");
}

static void print_point(const lam_explanation *e, const lam_explained_fragment *f, const lam_explained_point *p)
{
    if (p->corner >= 0)
        printf("\n  corner %d of the triangle is lit\n", p->corner);
    row_vector(2, "position in the mesh", p->mesh_position, "model units");
    row_vector(2, "position in the world", p->world_position, "");
    row_vector(2, "position in eye space", p->position, "");
    const bool bent = f->values && !same(f->values->mesh_normal, p->n);
    row_vector(2, "n", p->n,
               f->flipped       ? "reversed: the back is visible"
               : bent           ? "changed by a normal map"
               : f->face_normal ? "the triangle's"
               : p->corner >= 0 ? "the corner's"
               : f->corners < 3 ? ""
                                : "Σ weight · n of the corners, normalised");
    row_vector(2, "v", p->v, e->distant_viewer ? "to the eye, which is infinitely far away" : "to the eye");
    if (!is_zero(p->t) && lam_reflection_describe(f->reflection)->tangents)
        row_vector(2, "t", p->t, "along the threads");
    const char *tinting = is_textured(e, f) ? "texture and vertex colour" : "vertex colour";
    if (is_colored(p))
        row_color(2, tinting, p->color, "multiplies ambient and diffuse");
    if (p->layers)
        explain_layers(p->layers);
    print_lights(e, f, p);
    for (int i = 0; i < p->hemisphere_count; i++)
        print_hemisphere(&p->hemispheres[i], i);
    print_environment(e, f, p);
    print_terms(e, f, p);
}

static const char *field_label(const lam_field *field, char text[64])
{
    snprintf(text, 64, "%s%s%s", field->key, field->symbol ? " " : "", field->symbol ? field->symbol : "");
    return text;
}

static bool differs(const lam_field *field, const double numbers[4])
{
    int count = field->type == LAM_FIELD_RGB || field->type == LAM_FIELD_RGBA ? 3 : 1;
    for (int i = 0; i < count; i++)
        if ((float)numbers[i] != (float)field->standard[i])
            return true;
    return false;
}

static void print_color(const lam_explanation *e, const lam_field *field, const lam_material *m)
{
    double numbers[4];
    char text[64];
    bool mirrored = field->offset == offsetof(lam_material, reflectivity);
    // Omits the fields of physical materials that have their default values.
    bool known = field->symbol || field->offset == offsetof(lam_material, emission);
    if (lam_field_get(field, m, numbers) > 1 && (e->has_environment || !mirrored) && (known || differs(field, numbers)))
        row_three(4, field_label(field, text), numbers[0], numbers[1], numbers[2], "");
}

// Prints the shininess, the steps of toon shading, and other values that differ from their defaults.
static void print_number(const lam_explained_fragment *f, const lam_field *field, const lam_material *m)
{
    double numbers[4];
    char text[64];
    if (lam_field_get_written(field, m, numbers) > 1)
        return;
    if (field->offset == offsetof(lam_material, shininess))
        row_number(4, field_label(field, text), (double)f->shininess,
                   f->shininess == m->shininess ? "" : "as changed by the options");
    else if (differs(field, numbers) || (strcmp(field->key, "toon_steps") == 0 && f->reflection == LAM_REFLECTION_TOON))
        row_number(4, field_label(field, text), numbers[0], field->unit ? field->unit : "");
}

static void print_material(const lam_explanation *e, const lam_explained_fragment *f)
{
    const lam_material *m = &f->surface;
    if (f->ground)
        printf("\n  its material");
    else if (f->material >= 0)
        printf("\n  material %d", f->material);
    else
        printf("\n  the default material");
    if (!f->ground)
        named(m->name);
    printf("\n");
    row_heading(4, "matrix", "");
    for (int i = 0; lam_material_field(i); i++)
        print_color(e, lam_material_field(i), m);
    for (int i = 0; lam_material_field(i); i++)
        print_number(f, lam_material_field(i), m);
    printf("\n");
}

// Returns text such as "triangle 5" or "line 2".
static const char *item_of(const lam_explained_fragment *f, char out[32])
{
    snprintf(out, 32, "%s %u", f->corners == 3 ? "triangle" : f->corners == 2 ? "line" : "point", f->triangle);
    return out;
}

static void print_map(const lam_explained_map *m)
{
    char text[200];
    printf("  map '%s'", lam_map_name(m->map));
    named(m->texture);
    printf(", %d×%d texels\n", m->width, m->height);
    row_label(4, "coordinates");
    printf("%13.7g %13.7g   of the mesh\n", (double)m->s, (double)m->t);
    row_label(4, "place");
    printf("%13.7g %13.7g   texels from the upper left corner\n", (double)m->column, (double)m->row);
    row_label(4, "footprint");
    printf("%13.7g %13.7g   texels from this pixel to the next one on the right\n", (double)m->across[0],
           (double)m->across[1]);
    row_label(4, "");
    printf("%13.7g %13.7g   and to the one below\n", (double)m->down[0], (double)m->down[1]);
    row_number(4, "probes", m->probes, "lookups along the longer axis of the footprint");
    snprintf(text, sizeof text, "%s", m->level > 0 ? "texels of level 0 that a probe spans: 2^level" : "magnified");
    row_number(4, "level of detail", (double)m->level, text);
    row_label(4, m->map == LAM_MAP_BUMP ? "heights" : "texel");
    printf("%13.7g %13.7g %13.7g %13.7g   %s\n", (double)m->texel.r, (double)m->texel.g, (double)m->texel.b,
           (double)m->texel.a, m->map == LAM_MAP_BUMP ? "left, right, above, below" : "filtered");
    printf("\n");
}

// Prints the material after its maps are applied.
static void print_values(const lam_explained_fragment *f)
{
    const lam_explained_values *v = f->values;
    const lam_material *m = &f->surface;
    for (int i = 0; i < f->map_count; i++)
        print_map(&f->maps[i]);
    if (!v || (!m->physical && !f->map_count))
        return;
    printf("  the material here\n");
    row_color(4, m->physical ? "base colour" : "diffuse kd", v->base_color, "with maps and vertex colour");
    if (m->physical) {
        row_number(4, "metallic", (double)v->metallic, "");
        row_number(4, "roughness", (double)v->roughness, v->roughness < 0.045f ? "lit as 0.045" : "");
        if (v->lit_roughness > v->roughness)
            row_number(4, "widened to", (double)v->lit_roughness, "by the variance of the normals within the pixel");
    } else {
        row_number(4, "shininess α", (double)v->shininess, "");
    }
    if (v->occlusion != 1)
        row_number(4, "occlusion", (double)v->occlusion, "multiplies ambient light");
    if (!is_zero(v->tangent)) {
        row_vector(4, "n of the mesh", v->mesh_normal, "interpolated");
        row_vector(4, "tangent", v->tangent, "interpolated, not normalised");
        row_number(4, "bitangent's sign", (double)v->bitangent_sign, "bitangent = sign · n × t");
    }
    printf("\n");
}

// The primitive, and the part, mesh and object that contain it.
static void print_primitive(const lam_explanation *e, const lam_explained_fragment *f)
{
    char name[32];
    if (f->ground)
        printf("\nthe ground (%s), its ", lam_ground_name(f->ground));
    if (f->corners == 3 && f->ground)
        printf("triangle %u", f->triangle);
    else if (f->corners == 3)
        printf("\ntriangle %u, its %s, of ", f->triangle, f->back ? "back" : "front");
    else
        printf("\n%s, of ", item_of(f, name));
    if (f->part >= 0) {
        printf("part %d", f->part);
        named(f->part_name);
        printf(" of ");
    }
    if (!f->ground) {
        printf("mesh %d", f->mesh);
        named(f->mesh_name);
        printf(", object %d", f->object);
        named(f->object_name);
    }
    printf(": %d of %d sample%s\n", f->samples, e->samples, e->samples == 1 ? "" : "s");
}

static void print_result(const lam_explanation *e, const lam_explained_fragment *f)
{
    if (f->ground == LAM_GROUND_SHADOW) {
        row_number(2, "light received", (double)f->received, "luminance of the sum: 0.2126 r + 0.7152 g + 0.0722 b");
        row_number(2, "unobstructed", (double)f->unobstructed, "the same without shadows and occlusion");
        row_number(2, "taken away",
                   f->unobstructed > f->received ? 1 - (double)f->received / (double)f->unobstructed : 0,
                   "1 − received / unobstructed");
    }
    lam_rgb c = {f->color.r, f->color.g, f->color.b};
    const bool mapped = f->surface.maps[LAM_MAP_DIFFUSE] && !is_textured(e, f);
    row_color(2, "colour", c,
              f->ground == LAM_GROUND_SHADOW ? "black: the ground's alpha is the blocked share of the light"
              : mapped              ? "the corners' or the triangle's light; ambient and diffuse times the texture"
              : f->point_count == 3 ? "c0 + weight1 · (c1 − c0) + weight2 · (c2 − c0), the corners' sums"
              : e->shading == LAM_SHADING_FLAT ? "the sum, constant over the triangle"
                                               : "the sum");
    if (f->color.a != 1)
        row_number(2, "alpha", (double)f->color.a,
                   f->ground == LAM_GROUND_SHADOW ? "blocked share · the ground's fade-out factor"
                   : f->ground                    ? "the ground's fade-out factor"
                                                  : "opacity · the vertex colour's alpha");
}

static void print_fragment(const lam_explanation *e, const lam_explained_fragment *f)
{
    print_primitive(e, f);
    row_label(2, "taken at");
    printf("%13.7g %13.7g   ", f->picture_x, f->picture_y);
    if (f->lit_sample < 0)
        printf("pixels from the top left: the pixel's centre\n");
    else
        printf("pixels from the top left: sample %d, since the centre is outside the triangle\n", f->lit_sample);
    row_three(2, "weights of the corners", (double)f->weights[0], (double)f->weights[1], (double)f->weights[2],
              "barycentric, perspective-correct");
    explain_places(e, f);
    print_material(e, f);
    print_values(f);
    for (int i = 0; i < f->point_count; i++)
        print_point(e, f, &f->points[i]);
    if (f->point_count == 3)
        printf("\n");
    print_result(e, f);
    bool veiled = false;
    for (int s = 0; s < e->samples; s++)
        veiled |= (f->sample_mask >> s & 1) && f->transmittance[s] < 1;
    for (int s = 0; veiled && s < e->samples; s++) {
        char name[32];
        snprintf(name, sizeof name, "sample %d", s);
        if (f->sample_mask >> s & 1)
            row_number(2, name, (double)f->transmittance[s], "transmittance of the surfaces in front: Π (1 − alpha)");
    }
}

// --- the pixel

static void print_pixel(const lam_explanation *e)
{
    printf("\n");
    row_heading(0, "pixel", "         alpha");
    for (int i = 0; i < e->fragment_count; i++) {
        const lam_explained_fragment *f = &e->fragments[i];
        char name[32];
        row_label(2, item_of(f, name));
        printf("%13.7g %13.7g %13.7g %13.7g   counts %.7g\n", (double)f->color.r, (double)f->color.g,
               (double)f->color.b, (double)f->color.a, (double)f->weight);
    }
    if (e->behind.r != 0 || e->behind.g != 0 || e->behind.b != 0)
        row_color(2, "behind glass", e->behind,
                  "transmittance · the picture and background that rough or thick glass shows");
    row_label(2, "weighted sum");
    printf("%13.7g %13.7g %13.7g %13.7g   Σ weight · alpha · colour%s\n", (double)e->sum.r, (double)e->sum.g,
           (double)e->sum.b, (double)e->sum.a,
           e->behind.r != 0 || e->behind.g != 0 || e->behind.b != 0 ? " + behind glass" : "");
    char stops[64];
    snprintf(stops, sizeof stops, "2^%.7g stops, multiplies the sum's colour", e->stops);
    row_number(2, "exposure", (double)e->exposure, e->exposure == 1 ? "not applied" : stops);
    char text[100];
    row_color(2, "colour ÷ alpha", exposed_color(e), e->exposure == 1 ? "" : "exposure · sum ÷ alpha");
    if (e->tone != LAM_TONE_NONE) {
        snprintf(text, sizeof text, "--tone %s: %s", lam_tone_name(e->tone), lam_tone_formula(e->tone));
        row_color(2, "toned", curved_color(e), text);
    }
    row_label(2, "background");
    printf("%13.7g %13.7g %13.7g %13.7g\n", (double)e->background.r, (double)e->background.g, (double)e->background.b,
           (double)e->background.a);
    row_color(2, "over it", e->toned, "(alpha · colour + (1 − alpha) · background) ÷ alpha of both");
    snprintf(text, sizeof text, "--color-mode %s: %s", e->color == LAM_COLOR_RAW ? "raw" : "srgb",
             encoding_formula(e->color));
    row_color(2, "encoded", e->encoded, text);
    row_label(2, "bytes");
    printf("%13u %13u %13u %13u   " BYTE_FORMULA "\n", e->bytes[0], e->bytes[1], e->bytes[2], e->bytes[3]);
    row_label(2, "in .pfm");
    printf("%13.7g %13.7g %13.7g %13.7g   %ssum + (1 − alpha) · background\n", (double)e->result.r, (double)e->result.g,
           (double)e->result.b, (double)e->result.a, e->exposure == 1 ? "" : "exposure · ");
}

static void print_bounces(const lam_explanation *e)
{
    lam_rgb sum = {0, 0, 0};
    printf("\nlight between surfaces: %d paths, with exposure, before the background\n", e->bounce_paths);
    row_heading(0, "reflections", "   standard error");
    for (int k = 0; k < e->bounce_count; k++) {
        const lam_explained_bounce *b = &e->bounces[k];
        char name[32];
        snprintf(name, sizeof name, k ? "%d" : "emission", k);
        row_label(2, name);
        printf("%13.7g %13.7g %13.7g %13.7g %13.7g %13.7g\n", (double)b->light.r, (double)b->light.g,
               (double)b->light.b, (double)b->error.r, (double)b->error.g, (double)b->error.b);
        sum = (lam_rgb){sum.r + b->light.r, sum.g + b->light.g, sum.b + b->light.b};
    }
    row_color(2, "sum", sum, "the light of the picture's pixel before --denoise");
}

// Prints the derivatives of the model's formula, and the normal that they give, in the axes of the formula.
static void print_formula(const lam_explanation *e, const struct job *job)
{
    lam_formula_point p;
    if (!explain_formula(job, e, &p))
        return;
    printf("\nthe formula at the point, in its own axes\n");
    const double size = sqrt(dot(p.normal, p.normal));
    const lam_vec3 n = {p.normal.x / size, p.normal.y / size, p.normal.z / size};
    if (job->options->shape.implicit) {
        row_vector(2, "x, y, z", p.at, "");
        row_number(2, "f", p.value, "left side − right side; not exactly 0 on a triangle");
        row_vector(2, "∇f", p.normal, "(∂f/∂x, ∂f/∂y, ∂f/∂z), outward");
        row_vector(2, "n", n, "∇f / |∇f|");
        return;
    }
    row_label(2, "u, v");
    printf("%13.7g %13.7g\n", p.at.x, p.at.y);
    row_vector(2, "p(u, v)", p.p, "");
    row_vector(2, "∂p/∂u", p.p_u, "");
    row_vector(2, "∂p/∂v", p.p_v, "");
    row_vector(2, "∂p/∂u × ∂p/∂v", p.normal, job->options->shading.flip ? "reversed by --flip" : "");
    row_vector(2, "n", n, "the cross product, normalised");
}

void explain_text(const lam_explanation *e, const struct job *job)
{
    print_foreign(stdout, FOREIGN_TERMINAL, FOREIGN(job->model));
    printf(": pixel %d,%d of %dx%d, %s shading, %s reflection, %d sample%s a pixel\n", e->x, e->y, e->width, e->height,
           shading_word(e->shading), lam_reflection_describe(e->reflection)->word, e->samples,
           e->samples == 1 ? "" : "s");
    print_formula(e, job);
    if (!e->fragment_count)
        printf("\nOnly the background is visible here.\n");
    if (e->bounce_count)
        printf("\nThe terms, the pixel and its bytes below belong to local lighting, without --bounces.\n");
    for (int i = 0; i < e->fragment_count; i++)
        print_fragment(e, &e->fragments[i]);
    print_pixel(e);
    if (e->bounce_count)
        print_bounces(e);
}
