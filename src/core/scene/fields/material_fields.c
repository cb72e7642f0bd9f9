// material_fields.c: the table of a material's fields. Validation, scene files, options, reports, shaders and the
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

// A field of a layer, with the columns of the field's lam_field.
#define LAYER(member, kind, ...)                                                                                       \
    {.field = {MEMBER(member), __VA_ARGS__}, .reader = FIELD_LAYER, .layer = LAYER_##kind, .physical = true}

// A field that only lobes read, with the columns of the field's lam_field from lobes.h. Parameters without columns are
// omitted.
#define LOBE_FIELD(member, ...)                                                                                        \
    __VA_OPT__({.field = {.name = #member, .offset = offsetof(lam_material, member), __VA_ARGS__},                     \
                .reader = FIELD_LOBE,                                                                                  \
                .optional = true}, )

static const struct material_field rows[] = {
    {.field = {MEMBER(ambient), .symbol = "ka", .source = "Ka", .type = LAM_FIELD_RGB, .max = UNBOUNDED,
               .standard = GREY(0.62f),
               .summary = "ka: fraction of ambient and hemisphere light that the surface reflects"},
     .product = "ambient_product",
     .product_summary = "ka La: the material's ambient colour times all light from everywhere",
     .reader = FIELD_LIT},
    {.field = {MEMBER(diffuse), .symbol = "kd", .source = "Kd", .type = LAM_FIELD_RGBA, .max = UNBOUNDED,
               .standard = GREY(0.62f),
               .summary = "kd: fraction of light that the surface scatters evenly in all directions; alpha: opacity"}},
    {.field = {MEMBER(specular), .symbol = "ks", .source = "Ks", .type = LAM_FIELD_RGB, .max = UNBOUNDED,
               .standard = GREY(0.12f), .summary = "ks: strength of the highlight"},
     .product = "",
     .reader = FIELD_HIGHLIGHT},
    {.field = {MEMBER(emission), .source = "Ke", .type = LAM_FIELD_RGB, .max = UNBOUNDED,
               .summary = "light that the surface emits"},
     .reader = FIELD_LIT},
    {.field = {MEMBER(shininess), .symbol = "α", .source = "Ns", .max = UNBOUNDED, .standard = {32},
               .summary = "exponent of the highlight"},
     .reader = FIELD_LOBE},
    {.field = {MEMBER(reflectivity), .symbol = "kr", .type = LAM_FIELD_RGB, .max = UNBOUNDED,
               .summary = "kr: fraction of the environment that the material reflects"},
     .reader = FIELD_ENVIRONMENT},
    {.field = {.name = "diffuse.a",
               .key = "opacity",
               .source = "d",
               .offset = offsetof(lam_material, diffuse.a),
               .max = 1,
               .standard = {1},
               .summary = "1 is opaque, 0 is clear; in a scene file, opacity multiplies the alpha of diffuse"},
     .reader = FIELD_NEVER},
    LOBE_PARAMETERS(LOBE_FIELD){
        .field = {MEMBER(physical), .type = LAM_FIELD_FLAG, .max = 1,
                  .summary = "use the metallic-roughness model of glTF 2.0; diffuse is then the base colour"},
        .reader = FIELD_CHOICE,
        .optional = true},
    {.field = {MEMBER(metallic), .source = "Pm", .max = 1, .summary = "0 is a dielectric, 1 is a metal"},
     .reader = FIELD_LOBE,
     .optional = true,
     .physical = true},
    {.field = {MEMBER(roughness), .source = "Pr", .max = 1, .standard = {0.5},
               .summary = "0 is a mirror, 1 is matt; values below 0.045 are drawn as 0.045"},
     .reader = FIELD_LOBE,
     .physical = true},
    {.field =
         {MEMBER(unlit), .type = LAM_FIELD_FLAG, .max = 1,
          .summary =
              "whether to draw the diffuse colour without lighting; an option for the reflection model overrides this"},
     .reader = FIELD_CHOICE,
     .optional = true},
    LAYER(ior, DIELECTRIC, .max = UNBOUNDED, .standard = {1.5},
          .summary = "index of refraction of a dielectric; 0 reflects all light"),
    LAYER(specular_weight, DIELECTRIC, .max = 1, .standard = {1}, .summary = "strength of a dielectric's reflection"),
    LAYER(f0_color, DIELECTRIC, .type = LAM_FIELD_RGB, .max = UNBOUNDED, .standard = GREY(1),
          .summary = "colour of a dielectric's reflection at normal incidence"),
    LAYER(specular_glossiness, DIELECTRIC, .max = 1,
          .summary =
              "multiplies the diffuse term by 1 - specular_glossiness * max f0; 1 for specular-glossiness files"),
    LAYER(clearcoat, CLEARCOAT, .max = 1, .summary = "fraction of the surface that a clear coat covers"),
    LAYER(clearcoat_roughness, CLEARCOAT, .max = 1, .summary = "roughness of the clear coat"),
    LAYER(sheen_color, SHEEN, .type = LAM_FIELD_RGB, .max = 1,
          .summary = "colour of the sheen of fabrics such as velvet"),
    LAYER(sheen_roughness, SHEEN, .max = 1, .summary = "roughness of the sheen"),
    LAYER(anisotropy, ANISOTROPY, .max = 1, .summary = "how much the highlight is stretched, as on brushed metal"),
    {.field = {.name = "anisotropy_rotation_rad",
               .key = "anisotropy_rotation",
               .unit = "degrees",
               .type = LAM_FIELD_ANGLE,
               .offset = offsetof(lam_material, anisotropy_rotation_rad),
               .min = -360,
               .max = 360,
               .summary = "angle from the tangent to the direction in which the highlight is stretched"},
     .reader = FIELD_LAYER,
     .layer = LAYER_ANISOTROPY,
     .physical = true},
    LAYER(iridescence, IRIDESCENCE, .max = 1, .summary = "fraction of the surface that a thin film covers"),
    LAYER(iridescence_ior, IRIDESCENCE, .max = UNBOUNDED, .standard = {1.3},
          .summary = "index of refraction of the film"),
    LAYER(iridescence_thickness_min, IRIDESCENCE, .max = 1e6, .standard = {100}, .unit = "nm",
          .summary = "film thickness for a map value of 0"),
    LAYER(iridescence_thickness_max, IRIDESCENCE, .max = 1e6, .standard = {400}, .unit = "nm",
          .summary = "film thickness for a map value of 1, or without a map"),
    LAYER(transmission, TRANSMISSION, .max = 1,
          .summary = "fraction of refracted light that passes through the surface, as in glass"),
    LAYER(thickness, VOLUME, .max = UNBOUNDED, .summary = "thickness of the volume behind the surface; 0: no volume"),
    LAYER(attenuation_distance, VOLUME, .max = UNBOUNDED,
          .summary = "distance within the material that turns white light into attenuation_color; 0: infinite"),
    LAYER(attenuation_color, VOLUME, .type = LAM_FIELD_RGB, .max = 1, .standard = GREY(1),
          .summary = "colour that white light has after travelling attenuation_distance"),
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
