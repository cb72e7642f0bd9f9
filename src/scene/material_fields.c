// material_fields.c: the table of a material's fields. Checks, scene files, options, reports, shaders and their
// documentation are made from these rows; a new field is a member of lam_material and a row here.
#include "fields.h"

#include <lambent/material.h>

#include <math.h>

#define MEMBER(member) .name = #member, .key = #member, .offset = offsetof(lam_material, member)
#define GREY(x)        {x, x, x, 1}
#define BIT(model)     (1u << LAM_REFLECTION_##model)
#define ANY_HIGHLIGHT  (BIT(PHONG) | BIT(BLINN_PHONG) | KAJIYA_KAY)
#define KAJIYA_KAY     (BIT(KAJIYA_KAY) | BIT(KAJIYA_KAY_LECTURE))

static const struct material_field rows[] = {
    {.field = {MEMBER(ambient), .symbol = "ka", .source = "Ka", .type = LAM_FIELD_RGB, .max = INFINITY,
               .standard = GREY(0.72f), .summary = "share of ambient and hemisphere light returned"},
     .shader = "ka: share of the light from everywhere that is reflected",
     .product = "ambient_product",
     .reader = FIELD_LIT},
    {.field = {MEMBER(diffuse), .symbol = "kd", .source = "Kd", .type = LAM_FIELD_RGBA, .max = INFINITY,
               .standard = GREY(0.72f),
               .summary = "share returned evenly to all sides; the fourth number is the opacity"},
     .shader = "kd: share that is reflected evenly, and the opacity in a"},
    {.field = {MEMBER(specular), .symbol = "ks", .source = "Ks", .type = LAM_FIELD_RGB, .max = INFINITY,
               .standard = GREY(0.12f), .summary = "strength of the highlight"},
     .shader = "ks: strength of the highlight",
     .product = "",
     .reader = FIELD_LOBE,
     .lobes = ANY_HIGHLIGHT},
    {.field = {MEMBER(emission), .source = "Ke", .type = LAM_FIELD_RGB, .max = INFINITY,
               .summary = "light that the surface itself gives"},
     .shader = "light that the surface itself gives",
     .reader = FIELD_LIT},
    {.field = {MEMBER(shininess), .symbol = "α", .source = "Ns", .max = INFINITY, .standard = {32},
               .summary = "exponent of the highlight"},
     .shader = "the highlight's exponent",
     .reader = FIELD_LOBE,
     .lobes = ANY_HIGHLIGHT},
    {.field = {MEMBER(reflectivity), .symbol = "kr", .type = LAM_FIELD_RGB, .max = INFINITY,
               .summary = "share of the environment mirrored"},
     .shader = "kr: share of the surroundings that is mirrored",
     .reader = FIELD_ENVIRONMENT},
    {.field = {.name = "diffuse.a",
               .key = "opacity",
               .source = "d",
               .offset = offsetof(lam_material, diffuse.a),
               .max = 1,
               .standard = {1},
               .summary = "1 opaque, 0 clear; in a scene file it multiplies the opacity of diffuse"},
     .reader = FIELD_NEVER},
    {.field = {MEMBER(fibre), .type = LAM_FIELD_FLAG, .max = 1,
               .summary = "Kajiya-Kay without the gate [n.l > 0], for hair and thread"},
     .shader = "1: threads in the air, lit from behind as well; 0: a solid surface",
     .reader = FIELD_LOBE,
     .lobes = KAJIYA_KAY,
     .optional = true},
};
enum { COUNT = sizeof rows / sizeof *rows };
_Static_assert((int)COUNT <= FIELDS_MAX, "more fields than FIELDS_MAX");

const struct material_field *material_field(int index) { return (unsigned)index < COUNT ? &rows[index] : NULL; }

const lam_field *lam_material_field(int index) { return (unsigned)index < COUNT ? &rows[index].field : NULL; }
