// light_fields.c: the table of a light's fields. Validation, scene files, options and the documentation use these rows;
// to add a field, add a member to lam_light and a row here. No light type has two rows with the same key.
#include "fields.h"

#include <lambent/light.h>

#include <math.h>

#define UNBOUNDED (double)INFINITY

#define MEMBER(member) .name = #member, .key = #member, .offset = offsetof(lam_light, member)
#define ANGLE(member, word)                                                                                            \
    .name = #member, .key = word, .offset = offsetof(lam_light, member), .type = LAM_FIELD_ANGLE, .unit = "degrees"
#define GREY(x)   {(double)(x), (double)(x), (double)(x)}
#define BIT(type) (1u << LAM_LIGHT_##type)
#define PLACED    (BIT(POINT) | BIT(SPOT))
#define AIMED     (BIT(DIRECTIONAL) | BIT(SPOT))
#define REACHING  (PLACED | BIT(DIRECTIONAL))

static const struct light_field rows[] = {
    {.field = {MEMBER(position), .type = LAM_FIELD_POINT, .min = -UNBOUNDED, .max = UNBOUNDED, .light_types = PLACED,
               .unit = "model units",
               .summary = "position; a scene file also accepts x, y, z, w, where w = 0 makes a directional light from "
                          "the direction x, y, z"}},
    {.field = {MEMBER(direction), .type = LAM_FIELD_DIRECTION, .min = -UNBOUNDED, .max = UNBOUNDED,
               .standard = {0, 0, -1}, .light_types = AIMED, .summary = "direction in which the light travels"}},
    {.field = {MEMBER(ambient), .symbol = "La", .type = LAM_FIELD_RGB, .max = UNBOUNDED, .standard = GREY(0.2f),
               .light_types = BIT(AMBIENT), .summary = "light from all directions"}},
    {.field = {MEMBER(ambient), .symbol = "La", .type = LAM_FIELD_RGB, .max = UNBOUNDED, .light_types = REACHING,
               .summary = "ambient light; distance and the cone do not reduce it"}},
    {.field = {MEMBER(diffuse), .symbol = "Ld", .type = LAM_FIELD_RGB, .max = UNBOUNDED, .standard = GREY(1),
               .light_types = REACHING, .summary = "light for the diffuse term; default: color times intensity"}},
    {.field = {MEMBER(specular), .symbol = "Ls", .type = LAM_FIELD_RGB, .max = UNBOUNDED, .standard = GREY(1),
               .light_types = REACHING, .summary = "light for the specular term; default: color times intensity"}},
    {.field = {MEMBER(attenuation), .type = LAM_FIELD_TRIPLE, .max = UNBOUNDED, .standard = {1}, .light_types = PLACED,
               .summary = "a, b and c of 1/(a + b d + c d^2); at least one is above 0"}},
    {.field = {MEMBER(range), .max = UNBOUNDED, .light_types = PLACED, .unit = "model units",
               .summary = "distance beyond which the light contributes nothing, as in glTF; 0: no limit"},
     .optional = true},
    {.field = {ANGLE(cutoff_rad, "cutoff"), .max = 180, .standard = {45}, .light_types = BIT(SPOT),
               .summary =
                   "half angle of the cone: 0 to 90, or 180; if you set only the exponent, the cone has no edge"},
     .optional = true,
     .cone = HARD_CONE},
    {.field = {MEMBER(exponent), .max = UNBOUNDED, .light_types = BIT(SPOT),
               .summary = "exponent of the cosine of the angle from the cone's axis"},
     .cone = HARD_CONE},
    {.field = {ANGLE(inner_rad, "inner"), .max = 90, .light_types = BIT(SPOT),
               .summary =
                   "half angle of the fully lit inner cone; requires outer; not allowed with cutoff or exponent"},
     .cone = SOFT_CONE},
    {.field = {ANGLE(outer_rad, "outer"), .max = 90, .light_types = BIT(SPOT),
               .summary = "half angle beyond which the light is zero, as in glTF; larger than inner"},
     .cone = SOFT_CONE},
    {.field = {MEMBER(occluded), .max = 1, .light_types = REACHING,
               .summary =
                   "fraction of this light to which ambient occlusion applies; a scene file also accepts true (1) and "
                   "false (0)"},
     .optional = true},
    {.field = {MEMBER(sky), .type = LAM_FIELD_RGB, .max = UNBOUNDED, .standard = GREY(0.4f),
               .light_types = BIT(HEMISPHERE), .summary = "light from above"}},
    {.field = {MEMBER(ground), .type = LAM_FIELD_RGB, .max = UNBOUNDED, .standard = GREY(0.1f),
               .light_types = BIT(HEMISPHERE), .summary = "light from below"}},
    {.field = {MEMBER(up), .type = LAM_FIELD_DIRECTION, .min = -UNBOUNDED, .max = UNBOUNDED,
               .light_types = BIT(HEMISPHERE), .summary = "direction of the sky; default: the scene's up axis"},
     .optional = true},
    {.field = {MEMBER(by_diffuse), .type = LAM_FIELD_FLAG, .max = 1, .light_types = BIT(HEMISPHERE),
               .summary = "whether classic materials reflect this light with their diffuse color instead of their "
                          "ambient color"},
     .optional = true},
    {.field = {.name = "no_shadows",
               .key = "shadows",
               .offset = offsetof(lam_light, no_shadows),
               .type = LAM_FIELD_FLAG,
               .max = 1,
               .standard = {1},
               .light_types = REACHING,
               .summary = "whether this light casts shadows; requires shadows in the picture"},
     .optional = true},
    {.field = {MEMBER(radius), .max = UNBOUNDED, .light_types = PLACED, .unit = "world units",
               .summary = "radius of the ball that emits the light; a larger ball casts softer shadows; 0: a point"},
     .optional = true},
    {.field = {ANGLE(angular_radius_rad, "radius"), .max = 89, .light_types = BIT(DIRECTIONAL),
               .summary = "angular radius of the disc that emits the light; a larger disc casts softer shadows (the "
                          "sun: 0.27)"},
     .optional = true},
};
enum { COUNT = sizeof rows / sizeof *rows };
_Static_assert((int)COUNT <= LAM_FIELDS_MAX, "more fields than LAM_FIELDS_MAX");

const struct light_field *light_field(int index) { return (unsigned)index < COUNT ? &rows[index] : NULL; }

const lam_field *lam_light_field(int index) { return (unsigned)index < COUNT ? &rows[index].field : NULL; }
