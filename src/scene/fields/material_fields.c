// material_fields.c: the table of a material's fields. Validation, scene files, options, reports, shaders and their
// documentation use these rows. To add a field, add a member to lam_material and a row here, or in LOBE_PARAMETERS if
// only lobes read it.
#define LANES 1
#include "lighting.h"

#include "fields.h"

#include <lambent/material.h>

#include <math.h>
#include <string.h>

#define UNBOUNDED (double)INFINITY

#define MEMBER(member) .name = #member, .key = #member, .offset = offsetof(lam_material, member)
#define GREY(x)        {(double)(x), (double)(x), (double)(x), 1}

// A field of a layer; the columns of its lam_field follow.
#define LAYER(member, kind, ...)                                                                                       \
    {.field = {MEMBER(member), __VA_ARGS__}, .reader = FIELD_LAYER, .layer = LAYER_##kind, .physical = true}

// A field that only lobes read, with the columns of its lam_field from lobes.h. Parameters without columns are omitted.
#define LOBE_FIELD(member, ...)                                                                                        \
    __VA_OPT__({.field = {.name = #member, .offset = offsetof(lam_material, member), __VA_ARGS__},                     \
                .reader = FIELD_LOBE,                                                                                  \
                .optional = true}, )

static const struct material_field rows[] = {
    {.field = {MEMBER(ambient), .symbol = "ka", .source = "Ka", .type = LAM_FIELD_RGB, .max = UNBOUNDED,
               .standard = GREY(0.62f), .summary = "ka: share of ambient and hemisphere light that is returned"},
     .product = "ambient_product",
     .product_summary = "ka La: the material's ambient colour times all light from everywhere",
     .reader = FIELD_LIT},
    {.field = {MEMBER(diffuse), .symbol = "kd", .source = "Kd", .type = LAM_FIELD_RGBA, .max = UNBOUNDED,
               .standard = GREY(0.62f), .summary = "kd: share that is returned evenly to all sides; a: opacity"}},
    {.field = {MEMBER(specular), .symbol = "ks", .source = "Ks", .type = LAM_FIELD_RGB, .max = UNBOUNDED,
               .standard = GREY(0.12f), .summary = "ks: strength of the highlight"},
     .product = "",
     .reader = FIELD_HIGHLIGHT},
    {.field = {MEMBER(emission), .source = "Ke", .type = LAM_FIELD_RGB, .max = UNBOUNDED,
               .summary = "light that the surface itself gives"},
     .reader = FIELD_LIT},
    {.field = {MEMBER(shininess), .symbol = "α", .source = "Ns", .max = UNBOUNDED, .standard = {32},
               .summary = "exponent of the highlight"},
     .reader = FIELD_LOBE},
    {.field = {MEMBER(reflectivity), .symbol = "kr", .type = LAM_FIELD_RGB, .max = UNBOUNDED,
               .summary = "kr: share of the environment that the material reflects"},
     .reader = FIELD_ENVIRONMENT},
    {.field = {.name = "diffuse.a",
               .key = "opacity",
               .source = "d",
               .offset = offsetof(lam_material, diffuse.a),
               .max = 1,
               .standard = {1},
               .summary = "1 opaque, 0 clear; a scene file's multiplies that of diffuse"},
     .reader = FIELD_NEVER},
    LOBE_PARAMETERS(LOBE_FIELD){
        .field = {MEMBER(physical), .type = LAM_FIELD_FLAG, .max = 1,
                  .summary = "a metallic-roughness material (glTF 2.0); diffuse is its base colour"},
        .reader = FIELD_CHOICE,
        .optional = true},
    {.field = {MEMBER(metallic), .source = "Pm", .max = 1, .summary = "0 a dielectric, 1 a metal"},
     .reader = FIELD_LOBE,
     .optional = true,
     .physical = true},
    {.field = {MEMBER(roughness), .source = "Pr", .max = 1, .standard = {0.5},
               .summary = "0 a mirror, 1 matt; the lobe takes at least 0.045"},
     .reader = FIELD_LOBE,
     .physical = true},
    {.field = {MEMBER(unlit), .type = LAM_FIELD_FLAG, .max = 1,
               .summary = "the diffuse colour as it is, unless a reflection model is asked for"},
     .reader = FIELD_CHOICE,
     .optional = true},
    LAYER(ior, DIELECTRIC, .max = UNBOUNDED, .standard = {1.5},
          .summary = "index of refraction of the dielectric; 0 reflects everything"),
    LAYER(specular_weight, DIELECTRIC, .max = 1, .standard = {1},
          .summary = "how much of a dielectric's reflection there is"),
    LAYER(f0_color, DIELECTRIC, .type = LAM_FIELD_RGB, .max = UNBOUNDED, .standard = GREY(1),
          .summary = "colour of a dielectric's reflection along the normal"),
    LAYER(specular_glossiness, DIELECTRIC, .max = 1,
          .summary = "1: the matt part is also multiplied by 1 - max f0, as specular-glossiness files have it"),
    LAYER(clearcoat, CLEARCOAT, .max = 1, .summary = "share of the surface under a clear coat"),
    LAYER(clearcoat_roughness, CLEARCOAT, .max = 1, .summary = "of the coat, as roughness"),
    LAYER(sheen_color, SHEEN, .type = LAM_FIELD_RGB, .max = 1,
          .summary = "colour of fibres perpendicular to the surface: velvet"),
    LAYER(sheen_roughness, SHEEN, .max = 1, .summary = "how much these fibres lean"),
    LAYER(anisotropy, ANISOTROPY, .max = 1, .summary = "how much the highlight is stretched: brushed metal"),
    {.field = {.name = "anisotropy_rotation_rad",
               .key = "anisotropy_rotation",
               .unit = "degrees",
               .type = LAM_FIELD_ANGLE,
               .offset = offsetof(lam_material, anisotropy_rotation_rad),
               .min = -360,
               .max = 360,
               .summary = "from the tangent to the direction in which it is stretched"},
     .reader = FIELD_LAYER,
     .layer = LAYER_ANISOTROPY,
     .physical = true},
    LAYER(iridescence, IRIDESCENCE, .max = 1, .summary = "share of the surface under a thin film"),
    LAYER(iridescence_ior, IRIDESCENCE, .max = UNBOUNDED, .standard = {1.3},
          .summary = "index of refraction of the film"),
    LAYER(iridescence_thickness_min, IRIDESCENCE, .max = 1e6, .standard = {100}, .unit = "nm",
          .summary = "thickness of the film where its map is 0"),
    LAYER(iridescence_thickness_max, IRIDESCENCE, .max = 1e6, .standard = {400}, .unit = "nm",
          .summary = "thickness of the film where its map is 1, or without a map"),
    LAYER(transmission, TRANSMISSION, .max = 1,
          .summary = "share of the light in a dielectric that continues behind it: glass"),
    LAYER(thickness, VOLUME, .max = UNBOUNDED, .summary = "of the volume behind the surface; 0: none"),
    LAYER(attenuation_distance, VOLUME, .max = UNBOUNDED,
          .summary = "after which attenuation_color is left of white light; 0: infinite"),
    LAYER(attenuation_color, VOLUME, .type = LAM_FIELD_RGB, .max = 1, .standard = GREY(1),
          .summary = "white light after it has passed the volume"),
};
enum { COUNT = sizeof rows / sizeof *rows };
_Static_assert((int)COUNT <= LAM_FIELDS_MAX, "more fields than LAM_FIELDS_MAX");

const struct material_field *material_field(int index) { return (unsigned)index < COUNT ? &rows[index] : NULL; }

const lam_field *lam_material_field(int index) { return (unsigned)index < COUNT ? &rows[index].field : NULL; }

static bool is_black(lam_rgb c) { return c.r == 0 && c.g == 0 && c.b == 0; }

int material_layers(const lam_material *m)
{
    static const lam_rgb white = {1, 1, 1};
    int set = 0;
    if (!m->physical)
        return 0;
    if (m->ior != 1.5f || m->specular_weight != 1 || memcmp(&m->f0_color, &white, sizeof white) != 0 ||
        m->maps[LAM_MAP_SPECULAR_WEIGHT] || m->maps[LAM_MAP_F0_COLOR])
        set |= LAYER_DIELECTRIC;
    if (m->clearcoat > 0)
        set |= LAYER_CLEARCOAT;
    if (!is_black(m->sheen_color))
        set |= LAYER_SHEEN;
    if (m->anisotropy > 0)
        set |= LAYER_ANISOTROPY;
    if (m->iridescence > 0)
        set |= LAYER_IRIDESCENCE;
    if (m->transmission > 0)
        set |= LAYER_TRANSMISSION;
    if (m->transmission > 0 && m->thickness > 0)
        set |= LAYER_VOLUME;
    return set;
}

int map_layer(lam_map map)
{
    switch (map) {
    case LAM_MAP_SPECULAR_WEIGHT:
    case LAM_MAP_F0_COLOR:
        return LAYER_DIELECTRIC;
    case LAM_MAP_CLEARCOAT:
    case LAM_MAP_CLEARCOAT_ROUGHNESS:
    case LAM_MAP_CLEARCOAT_NORMAL:
        return LAYER_CLEARCOAT;
    case LAM_MAP_SHEEN_COLOR:
    case LAM_MAP_SHEEN_ROUGHNESS:
        return LAYER_SHEEN;
    case LAM_MAP_ANISOTROPY:
        return LAYER_ANISOTROPY;
    case LAM_MAP_IRIDESCENCE:
    case LAM_MAP_IRIDESCENCE_THICKNESS:
        return LAYER_IRIDESCENCE;
    case LAM_MAP_TRANSMISSION:
        return LAYER_TRANSMISSION;
    case LAM_MAP_THICKNESS:
        return LAYER_VOLUME;
    default:
        return 0;
    }
}

void material_note_written(lam_material *material, int field)
{
    if (rows[field].physical)
        material->physical = true;
}
