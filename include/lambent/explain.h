// lambent/explain.h: how one pixel of a picture came about: every number on the way from the triangles to the bytes.
#ifndef LAMBENT_EXPLAIN_H
#define LAMBENT_EXPLAIN_H

#include "device.h"

#ifdef __cplusplus
extern "C" {
#endif

// All vectors are in eye space unless a name says otherwise (docs/lighting.md, "Vectors"). Vectors and numbers are the
// floats that the picture was made with; the angles are worked out from them.

// A point, directional or spot light at a lit point.
typedef struct lam_explained_light {
    const char *name; // NULL: unnamed
    int light;        // index in the scene; −1: of the rig
    lam_light_type type;
    lam_light_frame frame;              // that it was given in
    lam_vec3 position;                  // point and spot
    lam_vec3 axis;                      // directional and spot: unit, the way the light travels
    lam_rgb ambient, diffuse, specular; // La, Ld, Ls: the light's matrix

    lam_vec3 l, r, h;                  // unit; zero where there is none
    double theta_rad;                  // between n and l; the angles are NaN where one of the two is missing
    double phi_rad;                    // between r and v
    double psi_rad;                    // between n and h
    float distance;                    // model units; 0: directional
    lam_attenuation attenuation_terms; // a, b, c
    float range;                       // 0: none
    float attenuation;                 // with the range's window; 1: none
    float cos_axis;                    // spot: c, the cosine between −l and the axis; else 1
    float spot;                        // the cone's factor; 1: no cone
    float n_dot_l;
    float base, power; // of the highlight: S = base^power where it is not gated; base 0…1
    float D, S;

    lam_rgb kd_Ld, ks_Ls;  // products with the material
    lam_rgb diffuse_term;  // spot · attenuation · D · kd ⊙ Ld
    lam_rgb specular_term; // spot · attenuation · S · ks ⊙ Ls
    // gl1: spot · attenuation · ka ⊙ La; else 0 here, and La is in the point's ambient light
    lam_rgb ambient_term;
    // its terms are not in the sum: too weak in this part of the picture (lam_draw_params.light_cutoff)
    bool left_out;
} lam_explained_light;

typedef struct lam_explained_hemisphere {
    const char *name;
    int light;   // index in the scene; −1: of the rig
    lam_vec3 up; // unit
    lam_rgb sky, ground;
    float n_dot_up;
    lam_rgb term; // ka ⊙ mix(ground, sky, ½ + ½ n·up)
} lam_explained_hemisphere;

// A point that was lit: the fragment itself (Phong), a corner (Gouraud), the last corner (flat).
typedef struct lam_explained_point {
    int corner; // 0…2; −1: the fragment
    lam_vec3 mesh_position, world_position, position;
    lam_vec3 n, v, t;      // unit; t is zero where the reflection model does not look at it
    lam_rgb color;         // the vertex colour; 1 where the mesh has none
    lam_rgb ambient_light; // La_global + Σ La
    lam_rgb ambient_term;  // ka ⊙ that
    const lam_explained_hemisphere *hemispheres;
    int hemisphere_count;
    const lam_explained_light *lights;
    int light_count;
    // Where there is an environment (has_environment), else zero; and zero without n or v:
    lam_vec3 reflected;             // R = 2 (n·v) n − v, the eye vector's mirror image
    lam_vec3 environment_direction; // R in the environment's own axes, which it is looked up with
    lam_rgb environment_light;      // what comes from there; the reflection term is kr ⊙ it
    // The terms, ambient and diffuse times the vertex colour, and their sum: emission + ambient + diffuse + specular +
    // reflection.
    lam_rgb emission, ambient, diffuse, specular, reflection;
    lam_rgb sum;
    lam_rgb result; // the sum; with gl1 and one of the vertex methods clamped to 0…1
} lam_explained_point;

// A triangle that the pixel shows.
typedef struct lam_explained_fragment {
    int object, mesh, part; // indices; part is −1 for a mesh without parts
    const char *object_name, *mesh_name, *part_name;
    uint32_t triangle;                 // of the mesh
    bool back;                         // its back side is seen
    bool flipped;                      // and lit with −n
    int material;                      // index in the scene; −1: the default material
    lam_material surface;              // its numbers, and its name
    float shininess;                   // the power in use (match_highlights and gl1 change it)
    int samples;                       // that show it
    int lit_sample;                    // the sample where its values are taken; −1: the pixel's centre
    double picture_x, picture_y;       // that place, in pixels from the top left corner
    float weights[3];                  // barycentrics there, perspective-correct
    const lam_explained_point *points; // 1, or the 3 corners with Gouraud shading
    int point_count;
    lam_rgba color; // not premultiplied
    // Bit s: sample s shows it. It counts there with the share of light that translucent triangles before it let
    // through: 1 where there are none.
    uint16_t sample_mask;
    float through[16]; // of each sample that shows it
    float weight;      // Σ through ÷ samples: its share of the pixel
} lam_explained_fragment;

typedef struct lam_explanation {
    int x, y, width, height;
    int samples;
    lam_pixel_format format;
    lam_color_mode color;
    lam_shading shading;
    lam_reflection reflection; // never AUTO
    bool distant_viewer;       // v = (0, 0, 1) for every point
    bool gl1;
    bool has_environment;
    const lam_explained_fragment
        *fragments;     // in the order of the nearest sample that shows them; translucent ones first, by depth
    int fragment_count; // 0: the pixel shows the background alone

    lam_rgba sum;        // Σ weight · alpha · color, and Σ weight · alpha
    double stops;        // the exposure asked for
    float exposure;      // 2^stops
    lam_rgba background; // not premultiplied
    lam_rgba result;     // premultiplied: exposure · sum over the background; what LAM_RGBA32F holds
    lam_rgb straight;    // result ÷ alpha
    lam_rgb encoded;     // sRGB curve, or clamped with LAM_COLOR_RAW
    uint8_t bytes[4];    // what LAM_RGBA8 holds: floor(255·encoded + ½), and alpha
} lam_explanation;

// Draws the part of the picture that pixel (x, y) lies in, x from the left, y from the top, and keeps every number of
// that pixel. It runs the code that draws pictures; the arguments are those of lam_draw, with the picture's size and
// format in place of the picture. The device's next picture is not affected. Only the CPU device can do it. NULL on
// failure: LAM_BAD_ARGUMENT, LAM_UNSUPPORTED (another device), LAM_LIMIT, LAM_CANCELLED. Names in it belong to the
// scene.
LAM_API lam_explanation *lam_explain(lam_device *device, const lam_scene *scene, const lam_camera *camera,
                                     const lam_draw_params *params, int width, int height, lam_pixel_format format,
                                     int x, int y, const lam_control *control, lam_error *error);

LAM_API void lam_explanation_free(lam_explanation *explanation); // NULL is fine

#ifdef __cplusplus
}
#endif
#endif
