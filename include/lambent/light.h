// lambent/light.h: light sources.
#ifndef LAMBENT_LIGHT_H
#define LAMBENT_LIGHT_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum lam_light_type {
    LAM_LIGHT_AMBIENT,     // from everywhere: adds ka ⊙ ambient
    LAM_LIGHT_HEMISPHERE,  // from a sky over a ground: adds ka ⊙ mix(ground, sky, ½ + ½ n·up)
    LAM_LIGHT_POINT,       // from a position to all sides
    LAM_LIGHT_DIRECTIONAL, // from infinitely far, parallel
    LAM_LIGHT_SPOT,        // from a position, in a cone
} lam_light_type;

// The space that a light's position, direction and up are given in.
typedef enum lam_light_frame {
    LAM_FRAME_WORLD = 0, // the scene's own space
    LAM_FRAME_CAMERA,    // eye space: x right, y up, the camera looks along −z; the light moves with the camera
    LAM_FRAME_OBJECT,    // the space of a named object; the light moves with it
    LAM_FRAME_MODEL,     // the space of the whole scene as it was made; the light moves with lam_scene_transform
} lam_light_frame;

// 1/(constant + linear·d + quadratic·d²), d in model units from the lit point to the light. All three ≥ 0. All zero
// stands for 1, 0, 0. 0, 0, 1 is the pure inverse square; where the sum is 0 (d = 0), the light's term is 0.
typedef struct lam_attenuation {
    float constant, linear, quadratic;
} lam_attenuation;

// A light. lam_light_default(type) gives a white one. Fields that a type has no use for are ignored.
typedef struct lam_light {
    lam_light_type type;
    lam_light_frame frame;
    const char *object; // LAM_FRAME_OBJECT: name of the object; NULL: the first one
    const char *name;   // UTF-8; NULL: unnamed

    lam_vec3 position;           // point, spot
    lam_vec3 direction;          // directional, spot: the way the light travels; any length but 0
    lam_rgb ambient;             // La: all types but hemisphere; not attenuated, not narrowed by the cone
    lam_rgb diffuse;             // Ld: point, directional, spot
    lam_rgb specular;            // Ls: point, directional, spot
    lam_attenuation attenuation; // point, spot
    float range;                 // model units; > 0 multiplies by max(min(1 − (d/range)⁴, 1), 0) as glTF does; 0: none

    // The spot's cone, by one of two laws, c being the cosine of the angle between axis and lit point.
    // outer_rad > 0: clamp((c − cos outer)/max(0.001, cos inner − cos outer), 0, 1)², as glTF does.
    // Otherwise: 0 outside cutoff_rad (the edge itself is lit), c^exponent inside, as OpenGL does;
    // cutoff_rad 0 or π: no edge, max(c, 0)^exponent.
    float cutoff_rad, exponent; // half angle in (0, π/2], 0 or π; exponent ≥ 0
    float inner_rad, outer_rad; // half angles, 0 ≤ inner < outer ≤ π/2

    lam_rgb sky, ground; // hemisphere: light from above and from below
    lam_vec3 up;         // hemisphere: towards the sky; zero: the scene's up axis
} lam_light;

// A white light of a type: ambient colour 0 (for LAM_LIGHT_AMBIENT 0.2), diffuse and specular 1, attenuation 1, 0, 0,
// at the origin, direction (0, 0, −1), spot: cutoff 45°, exponent 0; hemisphere: sky 0.4, ground 0.1.
LAM_API lam_light lam_light_default(lam_light_type type);

// Checks the numbers of one light against the ranges above. LAM_BAD_ARGUMENT names the field.
LAM_API bool lam_light_check(const lam_light *light, lam_error *error);

// Ready-made sets of lights.
typedef enum lam_rig {
    LAM_RIG_AUTO = 0,  // the scene's own lights; the studio where it has none
    LAM_RIG_NONE,      // only what the scene has, be it nothing
    LAM_RIG_STUDIO,    // key, fill and rim light fixed to the camera, and a hemisphere light: the default look
    LAM_RIG_HEADLIGHT, // one directional light from the eye
    // key, fill and back light of a portrait, directional, fixed to the camera: diffuse and specular 0.8 from (−1, 1,
    // 1), 0.4 from (1, 0.25, 1), 0.6 from (0.5, 1, −1); ambient light 0.05
    LAM_RIG_THREE_POINT,
    // one point light at (1, 2, 3) times the radius of the scene's sphere from its centre (lam_scene_sphere): ambient
    // 0.1, diffuse and specular 1, attenuation 1, 0, 0
    LAM_RIG_LECTURE,
} lam_rig;

enum { LAM_RIG_LIGHTS_MAX = 8 };

// Writes the lights of a rig and returns their number (0 for AUTO and NONE). A light with a place stands as for a scene
// whose sphere has its centre at the origin and the radius 1; lam_scene_rig_lights places it for any other.
LAM_API int lam_rig_lights(lam_rig rig, lam_light lights[LAM_RIG_LIGHTS_MAX]);

#ifdef __cplusplus
}
#endif
#endif
