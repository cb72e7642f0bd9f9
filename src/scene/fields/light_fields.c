// light_fields.c: the table of a light's fields. Validation, scene files, options and their documentation use these
// rows; to add a field, add a member to lam_light and a row here. Rows with the same key have no light type in common.
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
               .summary =
                   "the position; in a scene file also x, y, z, w, with w = 0 a directional light from (x, y, z)"}},
    {.field = {MEMBER(direction), .type = LAM_FIELD_DIRECTION, .min = -UNBOUNDED, .max = UNBOUNDED,
               .standard = {0, 0, -1}, .light_types = AIMED, .summary = "the way the light travels"}},
    {.field = {MEMBER(ambient), .symbol = "La", .type = LAM_FIELD_RGB, .max = UNBOUNDED, .standard = GREY(0.2f),
               .light_types = BIT(AMBIENT), .summary = "light from everywhere"}},
    {.field = {MEMBER(ambient), .symbol = "La", .type = LAM_FIELD_RGB, .max = UNBOUNDED, .light_types = REACHING,
               .summary = "neither attenuated nor narrowed by the cone"}},
    {.field = {MEMBER(diffuse), .symbol = "Ld", .type = LAM_FIELD_RGB, .max = UNBOUNDED, .standard = GREY(1),
               .light_types = REACHING, .summary = "light that is returned evenly; default: color times intensity"}},
    {.field = {MEMBER(specular), .symbol = "Ls", .type = LAM_FIELD_RGB, .max = UNBOUNDED, .standard = GREY(1),
               .light_types = REACHING, .summary = "light of the highlights; default: color times intensity"}},
    {.field = {MEMBER(attenuation), .type = LAM_FIELD_TRIPLE, .max = UNBOUNDED, .standard = {1}, .light_types = PLACED,
               .summary = "a, b, c of 1/(a + b d + c d^2), not all 0"}},
    {.field = {MEMBER(range), .max = UNBOUNDED, .light_types = PLACED, .unit = "model units",
               .summary = "the distance at which the light ends, as in glTF; 0: no end"},
     .optional = true},
    {.field = {ANGLE(cutoff_rad, "cutoff"), .max = 180, .standard = {45}, .light_types = BIT(SPOT),
               .summary = "half angle of the cone, up to 90, or 180; with exponent alone the cone has no edge"},
     .optional = true,
     .cone = HARD_CONE},
    {.field = {MEMBER(exponent), .max = UNBOUNDED, .light_types = BIT(SPOT),
               .summary = "of the cosine between the axis and the lit point"},
     .cone = HARD_CONE},
    {.field = {ANGLE(inner_rad, "inner"), .max = 90, .light_types = BIT(SPOT),
               .summary = "half angle of the full light; with outer, without cutoff and exponent"},
     .cone = SOFT_CONE},
    {.field = {ANGLE(outer_rad, "outer"), .max = 90, .light_types = BIT(SPOT),
               .summary = "half angle at which the light ends, as in glTF; more than inner"},
     .cone = SOFT_CONE},
    {.field = {MEMBER(occluded), .max = 1, .light_types = REACHING,
               .summary = "share that ambient occlusion dims; in a scene file also true (1) and false"},
     .optional = true},
    {.field = {MEMBER(sky), .type = LAM_FIELD_RGB, .max = UNBOUNDED, .standard = GREY(0.4f),
               .light_types = BIT(HEMISPHERE), .summary = "light from above"}},
    {.field = {MEMBER(ground), .type = LAM_FIELD_RGB, .max = UNBOUNDED, .standard = GREY(0.1f),
               .light_types = BIT(HEMISPHERE), .summary = "light from below"}},
    {.field = {MEMBER(up), .type = LAM_FIELD_DIRECTION, .min = -UNBOUNDED, .max = UNBOUNDED,
               .light_types = BIT(HEMISPHERE), .summary = "towards the sky; default: the scene's up axis"},
     .optional = true},
    {.field = {.name = "no_shadows",
               .key = "shadows",
               .offset = offsetof(lam_light, no_shadows),
               .type = LAM_FIELD_FLAG,
               .max = 1,
               .standard = {1},
               .light_types = REACHING,
               .summary = "whether surfaces cast shadows in its light, if a picture has shadows"},
     .optional = true},
    {.field = {MEMBER(radius), .max = UNBOUNDED, .light_types = PLACED, .unit = "world units",
               .summary = "of the ball that gives the light, which makes soft shadows; 0: a point"},
     .optional = true},
    {.field = {ANGLE(angular_radius_rad, "radius"), .max = 89, .light_types = BIT(DIRECTIONAL),
               .summary = "angular radius of the disc that gives the light, which makes soft shadows (the sun: 0.27)"},
     .optional = true},
};
enum { COUNT = sizeof rows / sizeof *rows };
_Static_assert((int)COUNT <= LAM_FIELDS_MAX, "more fields than LAM_FIELDS_MAX");

const struct light_field *light_field(int index) { return (unsigned)index < COUNT ? &rows[index] : NULL; }

const lam_field *lam_light_field(int index) { return (unsigned)index < COUNT ? &rows[index].field : NULL; }
