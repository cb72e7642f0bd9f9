// lambent/light.h: light sources.
//
// docs/lighting.md lists the equations. ⊙ multiplies channel by channel.
#ifndef LAMBENT_LIGHT_H
#define LAMBENT_LIGHT_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

// The kinds of light.
typedef enum lam_light_type {
    LAM_LIGHT_AMBIENT, // uniform light: adds ka ⊙ ambient
    // Light from sky and ground: adds ka ⊙ mix(ground, sky, ½ + ½ n·up), or kd instead of ka (by_diffuse).
    LAM_LIGHT_HEMISPHERE,
    LAM_LIGHT_POINT,       // from a point, in all directions
    LAM_LIGHT_DIRECTIONAL, // parallel, from infinitely far away
    LAM_LIGHT_SPOT,        // from a point, in a cone
    LAM_LIGHT_TYPE_COUNT
} lam_light_type;

// The name of a light type. lam_light_field lists its fields.
typedef struct lam_light_type_info {
    const char *word;    // name in options, scene files and reports: "point"
    const char *summary; // one line
    LAM_RESERVED(8);
} lam_light_type_info;

// Returns the description of a light type, or NULL if there is no such type.
LAM_API const lam_light_type_info *lam_light_type_describe(lam_light_type type);

// The space of a light's position, direction and up.
typedef enum lam_light_frame {
    LAM_FRAME_WORLD = 0, // the scene's space
    // Eye space: x to the right, y up, the camera looks along −z. The light moves with the camera.
    LAM_FRAME_CAMERA,
    LAM_FRAME_OBJECT, // the space of a named object; the light moves with it
    // The space of the whole scene as created. The light moves with lam_scene_transform.
    LAM_FRAME_MODEL,
    // The camera's axes, as in eye space, with the origin at the centre of the scene's box: the light stays on the same
    // side of the picture and at the same distance from the scene for every camera.
    LAM_FRAME_VIEW,
} lam_light_frame;

// Attenuation with the distance d from the lit point to the light, in model units:
//  1 / (constant + linear·d + quadratic·d²)
// All three are ≥ 0. If all are zero, the default 1, 0, 0 applies. The numbers 0, 0, 1 give the inverse square law. If
// the sum is 0, the light's terms are 0.
typedef struct lam_attenuation {
    float constant, linear, quadratic;
} lam_attenuation;

// A light. lam_light_default() returns a white light of each type. Fields that the type does not use are ignored.
typedef struct lam_light {
    lam_light_type type;   // the type; determines the fields in use
    lam_light_frame frame; // the space of `position`, `direction` and `up`
    const char *object;    // LAM_FRAME_OBJECT: the object's name; NULL: the first
    const char *name;      // UTF-8; NULL: unnamed

    lam_vec3 position; // point, spot
    // Directional, spot: the direction in which the light travels. It may have any nonzero length.
    lam_vec3 direction;
    // La, for all types except hemisphere. Neither attenuation nor the cone dims this colour, except with
    // lam_draw_params.gl1.
    lam_rgb ambient;
    lam_rgb diffuse;             // Ld: point, directional, spot
    lam_rgb specular;            // Ls: point, directional, spot
    lam_attenuation attenuation; // point, spot
    // Point, spot: the distance at which the light ends, in model units. The attenuation is multiplied by max(min(1 −
    // (d/range)⁴, 1), 0), the window of glTF's KHR_lights_punctual. 0: no range.
    float range;

    // The cone of a spot light with a hard edge (OpenGL 1): cos(angle)^exponent within `cutoff_rad` of the axis, the
    // edge included, and 0 outside. `cutoff_rad` is a half angle in (0, π/2]. 0 or π: no edge, max(cos(angle),
    // 0)^exponent.
    float cutoff_rad;
    float exponent; // ≥ 0; 0: uniform light within the cone
    // The soft cone of a spot light (glTF's KHR_lights_punctual), used if `outer_rad` > 0; half angles with 0 ≤ inner <
    // outer ≤ π/2:
    //  clamp((cos(angle) − cos outer) / max(0.001, cos inner − cos outer), 0, 1)²
    float inner_rad, outer_rad;

    lam_rgb sky;    // hemisphere: light from above
    lam_rgb ground; // hemisphere: light from below
    lam_vec3 up;    // hemisphere: towards the sky; zero: the scene's up axis

    // Point, directional, spot: the light casts no shadows (lam_draw_params.shadows).
    bool no_shadows;
    // Point, spot: the radius of the sphere that emits the light, in world units; a radius softens shadows. 0: a point.
    float radius;
    // Directional: the angular radius of the disc that emits the light (0.27 degrees for the sun). 0: a point.
    float angular_radius_rad;
    // Point, directional, spot: the share of this light to which ambient occlusion (lam_draw_params.occlusion) applies,
    // 0..1. 1 suits large, soft lights. Ambient and hemisphere light is always dimmed.
    float occluded;
    // Hemisphere: classic materials reflect this light with their diffuse colour kd, whatever their ka.
    bool by_diffuse;
    LAM_RESERVED(29);
} lam_light;

// Returns a white light of a type at the origin, with the direction (0, 0, −1), ambient 0 (LAM_LIGHT_AMBIENT: 0.2),
// diffuse and specular 1, and attenuation 1, 0, 0. Spot: cutoff 45°, exponent 0. Hemisphere: sky 0.4, ground 0.1.
LAM_API lam_light lam_light_default(lam_light_type type);

// Checks a light's numbers against the ranges above. Fails with LAM_BAD_ARGUMENT, and the sentence names the field.
LAM_API bool lam_light_check(const lam_light *light, lam_error *error);

#ifdef __cplusplus
}
#endif
#endif
