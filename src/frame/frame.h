// frame.h: a scene and a camera flattened into what a device draws: flat lists, floats, eye space.
//
// All set-up work in double ends here, rounded once to float. Triangles of all draws are numbered through: triangle t
// of a draw has the number first_id + t, and that number is what a visibility buffer holds.
#ifndef FRAME_H
#define FRAME_H

#include "buffer.h"
#include "light_kinds.h"
#include "scene_internal.h"

#include <lambent/device.h>

// One object: a mesh under a transform.
struct frame_draw {
    const lam_mesh *mesh;
    int object; // index in the scene
    uint32_t first_id;
    // Mesh positions to pixels: rows X·w, Y·w (pixels, y down), clip z, w. A point is at (X·w/w, Y·w/w).
    float pixel[4][4];
    float eye[3][4];     // mesh positions to eye space
    float normal[3][3];  // mesh normals to eye space, length not kept
    float tangent[3][3]; // mesh directions to eye space, length not kept
    bool mirrored;       // the transform turns the winding
    bool one_sided;
    lam_cull cull;
    // > 0: the mesh has no normals; the device makes those that it needs, creased at this angle
    double crease_rad;
};

// A run of triangles of one draw with the same materials.
struct frame_draw_range {
    uint32_t first_id, count;
    int draw;
    int front, back;  // indices into materials
    bool translucent; // a material's or a colour's alpha is below 1: blended, not just covered
};

// A point, directional or spot light in eye space.
struct frame_light {
    int kind, falloff; // LIGHT_…, FALLOFF_…
    float position[3];
    float axis[3]; // unit: the way the light travels
    float attenuation[3];
    float inverse_range; // 0: none
    float cos_cutoff, exponent;
    float cos_outer, inverse_width;
    float ambient[3]; // of this light alone, where it is not in the frame's sum (gl1)
    float diffuse[3], specular[3];
    int light; // index among the scene's lights; −1: of the rig
    const lam_light *source;
};

// Fills the part of a light that does not depend on its place: kind, falloff, attenuation, range and cone. The rest is
// zeroed.
void frame_light_reach(struct frame_light *out, const lam_light *light);

struct frame_hemisphere {
    float up[3]; // unit, eye space
    float sky[3], ground[3];
    int light; // as above
    const lam_light *source;
};

struct frame {
    struct scene_token *token; // the scene's; not held
    int width, height;
    int samples;
    lam_rgba background;
    lam_color_mode color;
    float exposure; // the factor, 2^stops
    lam_shading shading;
    lam_stage stage;           // never AUTO
    lam_reflection reflection; // never AUTO
    lam_flat_normal flat_normal;
    bool match_highlights, gl1;
    lam_output show;
    // share of the encoded range that lights left out may be worth together; 0: none is left out
    float light_cutoff;
    bool distant_viewer; // v = +z for every point: an orthographic camera, or asked for
    bool orthographic;
    bool translucent;   // any surface is
    bool makes_normals; // some draw has a crease_rad, and its normals will be asked for
    // Depth key of a point: perspective 1/w; orthographic (1 − z/w)/2. Larger is nearer; affine in the window.
    float near_plane, far_plane;

    struct frame_draw *draws;
    int draw_count;
    struct frame_draw_range *surfaces; // in the order of first_id, covering all numbers
    int surface_count;
    uint32_t triangle_count;
    const lam_material **materials; // 0: the default material; 1 + i: the scene's
    int material_count;
    struct frame_light *lights;
    int light_count;
    struct frame_hemisphere *hemispheres;
    int hemisphere_count;
    float ambient[3]; // La_global + Σ La of all lights (gl1: of those without a place only)

    const lam_environment *environment; // NULL: none
    float to_environment[3][3];         // directions of eye space to the environment's axes

    lam_light rig[LAM_RIG_LIGHTS_MAX];
    lam_material default_material;
    struct buffer storage; // holds the arrays
};

// The exponent of highlights on a material, after match_highlights and gl1.
float frame_shininess(const struct frame *frame, const lam_material *material);

// Whether lights but one are left out.
static inline bool shows_one_light(lam_output show)
{
    return show == LAM_OUTPUT_LIGHT || show == LAM_OUTPUT_N_L || show == LAM_OUTPUT_N_H;
}

// Builds the frame; keeps its storage from call to call. Errors: LAM_BAD_ARGUMENT (camera or parameters out of range),
// LAM_LIMIT (memory, too many triangles).
bool frame_build(struct frame *frame, const lam_scene *scene, const lam_camera *camera, const lam_draw_params *params,
                 int width, int height, struct call_control *call, lam_error *error);
void frame_free(struct frame *frame);

// The surface that a triangle number belongs to.
static inline int frame_draw_range_of(const struct frame *frame, uint32_t id)
{
    int low = 0, high = frame->surface_count - 1;
    while (low < high) {
        int middle = (low + high + 1) / 2;
        if (frame->surfaces[middle].first_id <= id)
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}

#endif
