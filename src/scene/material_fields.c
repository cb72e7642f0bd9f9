// material_fields.c: the table of a material's fields. Checks, scene files, options, reports, shaders and their
// documentation are made from these rows; a new field is a member of lam_material and a row here.
#include "fields.h"

#include <lambent/material.h>

#include <math.h>

#define UNBOUNDED (double)INFINITY

#define MEMBER(member) .name = #member, .key = #member, .offset = offsetof(lam_material, member)
#define GREY(x)        {(double)(x), (double)(x), (double)(x), 1}

static const struct material_field rows[] = {
    {.field = {MEMBER(ambient), .symbol = "ka", .source = "Ka", .type = LAM_FIELD_RGB, .max = UNBOUNDED,
               .standard = GREY(0.72f), .summary = "ka: share of ambient and hemisphere light that is returned"},
     .product = "ambient_product",
     .product_summary = "ka La: the material's ambient colour times all light from everywhere",
     .reader = FIELD_LIT},
    {.field = {MEMBER(diffuse), .symbol = "kd", .source = "Kd", .type = LAM_FIELD_RGBA, .max = UNBOUNDED,
               .standard = GREY(0.72f), .summary = "kd: share that is returned evenly to all sides; a: opacity"}},
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
               .summary = "kr: share of the environment that is mirrored"},
     .reader = FIELD_ENVIRONMENT},
    {.field = {.name = "diffuse.a",
               .key = "opacity",
               .source = "d",
               .offset = offsetof(lam_material, diffuse.a),
               .max = 1,
               .standard = {1},
               .summary = "1 opaque, 0 clear; a scene file's multiplies that of diffuse"},
     .reader = FIELD_NEVER},
    {.field = {MEMBER(fibre), .type = LAM_FIELD_FLAG, .max = 1,
               .summary = "for hair and thread: Kajiya-Kay without the gate [n.l > 0]"},
     .reader = FIELD_LOBE,
     .optional = true},
    {.field = {.name = "roughness_angle_rad",
               .key = "roughness_angle",
               .symbol = "σ",
               .unit = "degrees",
               .type = LAM_FIELD_ANGLE,
               .offset = offsetof(lam_material, roughness_angle_rad),
               .max = 90,
               .standard = {30},
               .summary = "Oren-Nayar's sigma: standard deviation of the slope of the surface's facets"},
     .reader = FIELD_LOBE,
     .optional = true},
    {.field = {MEMBER(physical), .type = LAM_FIELD_FLAG, .max = 1,
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
};
enum { COUNT = sizeof rows / sizeof *rows };
_Static_assert((int)COUNT <= LAM_FIELDS_MAX, "more fields than LAM_FIELDS_MAX");

const struct material_field *material_field(int index) { return (unsigned)index < COUNT ? &rows[index] : NULL; }

const lam_field *lam_material_field(int index) { return (unsigned)index < COUNT ? &rows[index].field : NULL; }

void material_note_written(lam_material *material, int field)
{
    if (rows[field].physical)
        material->physical = true;
}
