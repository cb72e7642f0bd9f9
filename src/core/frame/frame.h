// frame.h: converts a scene and a camera to flat arrays in eye space, the input of every device.
//
// The transforms are computed in double and rounded to float once. Triangle t of a draw has the number first_id + t,
// which is unique within the frame. Visibility buffers store this number.
#ifndef FRAME_H
#define FRAME_H

#include "buffer.h"
#include "light_kinds.h"
#include "outputs.h"
#include "scene_internal.h"

#include <lambent/device.h>
#include <lambent/material.h>

// One object: a mesh with a transform.
struct frame_draw {
    const lam_mesh *mesh;
    int object;     // index in the scene
    int first_part; // the number of parts of the scene's earlier objects
    uint32_t first_id;
    // Mesh positions to pixels: rows X·w, Y·w (pixels, y down), clip z, w. The pixel of a point is (X·w/w, Y·w/w).
    float pixel[4][4];
    float eye[3][4];     // mesh positions to eye space
    float normal[3][3];  // mesh normals to eye space, up to a positive factor
    float tangent[3][3]; // mesh directions to eye space, up to a positive factor
    // Set only if rays are traced: mesh positions to world space; mesh normals to world space, up to a positive factor.
    double world[3][4], world_normal[3][3];
    // Set only if rays are traced: the largest error of a vertex along each world axis. The numbers in the file are
    // assumed to be exact to one unit in the last place of a float: 2⁻²³ Σ_j |world_ij| max |x_j|.
    double rounding[3];
    bool mirrored; // the transform reverses the winding
    bool one_sided;
    // The mesh consists of rectangles for lines or points (frame_strokes.h), built for this frame in eye space. These
    // rectangles are not surfaces: flat shading uses their vertex normals, and they cast no shadows.
    bool strokes;
    // The mesh is the ground, built for this frame in world space (frame_ground.h); `object` is −1. The ground casts
    // no shadows.
    bool ground;
    bool solid; // a ground with a colour that paths of light meet; it does cast shadows
    bool clear; // all triangles let light through unchanged (colourless glass, for example), so rays ignore them
    lam_cull cull;
    // If this crease angle is above 0, the mesh has no normals, and the device uses the angle to compute the normals of
    // visible triangles.
    double crease_rad;
    // Like crease_rad, but with a crease at every edge: each point uses its facet's normal. Set only if no other step
    // reads normals.
    bool facets;
};

// Consecutive triangles of one draw with the same materials.
struct frame_draw_range {
    uint32_t first_id, count;
    int draw;
    int front, back; // indices into materials
    // The opacity may be below 1, or the material transmits light: the triangles are blended or masked. Glass that paths
    // refract (settings.bounces above 1) is not blended.
    bool translucent;
    lam_reflection reflection; // the model for both sides, never AUTO
    bool passes_rays;          // rays treat the triangles as translucent, regardless of the output
    bool transmits;            // the material transmits light (LAYER_TRANSMISSION), and the output shows this
};

// A point, directional or spot light in eye space.
struct frame_light {
    int kind, falloff; // LIGHT_…, FALLOFF_…
    float position[3];
    float axis[3]; // unit vector along which the light travels
    float attenuation[3];
    float inverse_range; // 0 if the range is unlimited
    float cos_cutoff, exponent;
    float cos_outer, inverse_width;
    float ambient[3]; // only with gl1; otherwise, frame->ambient contains this light's ambient term
    float diffuse[3], specular[3];
    float occluded; // the fraction of the light to which ambient occlusion applies
    int light;      // the index in the scene; −1 for a light of the rig
    const lam_light *source;
    // These members are set only with shadows.
    bool casts_shadows;
    double world_position[3]; // point, spot
    double world_axis[3];     // unit vector along which the light travels
    // the radius of a sphere (point, spot) or of a disc at distance 1 (directional); 0 is a point
    double radius;
};

// Returns the number of stops by which a dark model is brightened, or a negative number for a white model
// (lam_brighten). Call this function after the frame's draws are built.
struct frame;
double frame_brighten_stops(const struct frame *frame, const lam_scene *scene);

// Sets the kind, falloff, attenuation, range and cone of a light, and zeroes position, axis and colours.
void frame_light_init(struct frame_light *out, const lam_light *light);

// The hemisphere lights that materials reflect with kd (lam_light.by_diffuse) follow all others.
struct frame_hemisphere {
    float up[3]; // unit, eye space
    float sky[3], ground[3];
    int light; // same as in frame_light
    const lam_light *source;
};

// The ground under the scene (frame_ground.h).
struct frame_ground {
    lam_ground kind; // NONE if there is no ground, or if only the ground's underside is visible
    // World space: the point under the scene's centre, and unit vectors.
    lam_vec3 middle, right, up, front;
    double whole, end;                          // distances from `middle` at which fading begins and ends
    double square;                              // the side length of the squares of `mesh`
    float eye_middle[3], eye_up[3], eye_height; // eye space: p·eye_up = eye_height for each point p of the plane
    lam_mesh mesh;
    lam_material material;
    uint32_t first_id; // the number of the ground's first triangle; the ground's triangles are the last of the frame
    struct buffer memory;
};

// The edges of surfaces that the frame draws as lines (src/effects/edges).
// A later style is drawn over an earlier one.
enum {
    EDGE_STYLE_GRID,
    EDGE_STYLE_WIREFRAME,
    EDGE_STYLE_FEATURE,
    EDGE_STYLE_HALO, // around the lines and letters of annotations
    EDGE_STYLE_INK,
    EDGE_STYLE_X, // the axes
    EDGE_STYLE_Y,
    EDGE_STYLE_Z,
    EDGE_STYLES
};
struct frame_edges {
    double min_cosine; // an edge is a crease if the cosine between the normals of its faces is smaller
    double width[EDGE_STYLES];
    lam_rgba color[EDGE_STYLES]; // linear, not premultiplied
    double pixel[4][4];          // world space to pixels, as frame_draw.pixel
    bool of_model;               // edges of the model are drawn, not only annotations
    bool has_box;                // the scene has the box `low`..`high`; without it, there are no annotations
    lam_vec3 low, high;
    int up;        // the index of the world's up axis
    double unit_m; // the length of a model unit in metres, or 0
};

enum { FRAME_TILE = 64 }; // pixels per side of a tile of the picture; the same on every machine

struct frame {
    struct scene_token *token; // the scene's token; the frame does not own a reference to it
    int width, height;
    // The draw parameters with defaults resolved. samples, tone, stage and occlusion are never AUTO. `shadows` is set
    // if a light casts shadows and the output shows these shadows. `reflection` may be AUTO: each material then has its
    // own model (frame_draw_range.reflection). If light_cutoff is 0, every light is evaluated. edge_angle_rad and
    // occlusion_radius are unchanged.
    lam_draw_params settings;
    lam_output shown;     // the output that was asked for; settings.output is the one that devices draw for it
    float to_world[3][3]; // eye space to world space, rotation only
    // Path tracing, in passes (path_passes.h): the numbers of the first path and of the first position within a pixel, and
    // NULL or, for each tile, whether it is not drawn any more.
    int path_first, path_position;
    const bool *finished_tiles;
    // An explained pixel: paths of other pixels need not be traced. NULL: all pixels matter.
    const int *only_pixel;
    int path_bounces;          // the reflections of a path, at most settings.bounces
    float exposure;            // 2^stops, from the parameters and `brightened`
    double brightened;         // stops (lam_brighten)
    int point_triangles;       // triangles per point (frame_strokes.h)
    double eye_to_world[3][4]; // set only if rays are traced
    bool draws_edges;          // `edges` is set
    struct frame_edges edges;
    bool distant_viewer; // v = +z at every point: the camera is orthographic, or the viewer is LAM_VIEWER_INFINITE
    bool orthographic;
    // The height of a pixel in eye units, at distance 1 (in an orthographic view, everywhere), and its width divided by
    // its height.
    float pixel_size, pixel_aspect;
    float middle[2];        // where the camera's axis meets the picture, in pixels from the upper left corner
    float occlusion_radius; // radius of ambient occlusion in eye units; 0 disables it
    float cavity_radius;    // radius of cavity shading in eye units; 0 disables it
    bool narrow_valleys;    // cavity shading uses a smaller radius
    bool deep_valleys;      // cavity shading makes valleys darker
    bool widens_highlights; // whether highlights of physical materials are widened (lam_specular_aa)
    bool translucent;       // whether any range is translucent
    bool passes_rays;       // whether passes_rays is set in any range
    bool masked;            // whether any range has a material of LAM_ALPHA_MASK
    // whether the material of any range transmits coloured light, regardless of the output
    bool tints_rays;
    bool transmits; // whether the material of any range transmits light; layers then need a transmittance per channel
    // whether any range is rough or thick glass, which blurs and refracts the picture behind it
    // (src/core/cpu/shade/behind.h)
    bool refracts;
    bool makes_normals; // whether a draw has a crease_rad, and the output needs its normals
    // The background that glass shows if no surface is behind the glass: premultiplied colour divided by the exposure,
    // and alpha. If the output is the picture and its background is transparent, this background is white. Glass then
    // has the colour that it has on white, and its alpha is 1 minus its smallest transmittance.
    float glass_background[4];
    float eye_pixel[3][4]; // eye space to pixels: rows X·w, Y·w, w
    // The depth key of a point: 1/w in perspective; (1 − z/w)/2 if orthographic. Larger keys are nearer. The key is an
    // affine function of the window coordinates.
    float near_plane, far_plane;
    // LAM_OUTPUT_DEPTH: the range of distances that 8 bits encode, from the scene's nearest vertex to the farthest,
    // clipped to the near and far planes.
    float depth_near, depth_far;

    struct frame_draw *draws;
    int draw_count;
    struct frame_draw_range *ranges; // sorted by first_id, without gaps
    int range_count;
    uint32_t triangle_count;
    // The default material, then material i of the scene at 1 + i. A reflection model lights either classic or physical
    // materials. If a surface's front and back need different kinds of material, the list repeats all materials. If
    // unlit lines or points have emission, the list repeats all materials again. Each copy is converted to the kind
    // that its reflection model lights.
    const lam_material **materials;
    int material_count, scene_material_count; // number of all materials, and number without the copies
    lam_material *converted;                  // materials converted to the other kind
    int converted_count;
    int panes;               // materials that lam_draw_params.glass changed
    lam_mesh *stroke_meshes; // one per draw of lines or points
    int stroke_mesh_count;
    struct frame_light *lights;
    int light_count;
    struct frame_hemisphere *hemispheres;
    int hemisphere_count;
    float ambient[3]; // La_global + Σ La of all lights (gl1: of lights without a position only)

    const lam_environment *environment; // may be NULL
    lam_environment *studio;            // the built-in studio, owned; NULL until a frame uses it
    bool lights_classic;                // whether the environment lights classic materials, too, which are converted
    bool environment_lights;    // whether the environment lights a range with a physical model (environment_light.h)
    float to_environment[3][3]; // from eye space to the environment's axes

    // The environment's brightest lamp is a separate light that casts shadows: rig[rig_count]. The environment's
    // diffuse light excludes this lamp.
    bool separate_lamp;

    lam_light *rig; // LAM_RIG_LIGHTS_MAX + 1
    int rig_count;
    lam_material default_material;
    struct frame_ground ground;
    struct buffer storage; // memory of the arrays
    struct buffer strokes; // memory of the arrays of stroke_meshes
    size_t strokes_used;   // bytes
};

// Checks a camera's numbers (frame_check.c). Fails with LAM_BAD_ARGUMENT.
bool frame_camera_check(const lam_camera *camera, lam_error *error);
bool frame_params_check(const lam_draw_params *params, lam_error *error);

// Returns the reflection model that lights a material; never AUTO.
lam_reflection frame_reflection(const struct frame *frame, const lam_material *material);

// Returns whether rays are traced from lit points. Rays for edges are separate (draws_edges).
static inline bool frame_has_rays(const struct frame *frame)
{
    return frame->settings.shadows || frame->settings.bounces || frame->settings.occlusion == LAM_OCCLUSION_RAYS;
}

// Returns whether a draw's triangles cast shadows.
static inline bool frame_draw_casts(const struct frame_draw *draw)
{
    return !draw->strokes && (!draw->ground || draw->solid);
}

// Returns whether the hierarchy contains a draw's triangles.
static inline bool frame_draw_blocks(const struct frame_draw *draw) { return frame_draw_casts(draw) && !draw->clear; }

// Transforms a position of a draw's mesh to world space.
static inline void frame_to_world(const struct frame_draw *draw, const float from[3], double to[3])
{
    double x = (double)from[0], y = (double)from[1], z = (double)from[2];
    for (int i = 0; i < 3; i++)
        to[i] = ((draw->world[i][0] * x + draw->world[i][1] * y) + draw->world[i][2] * z) + draw->world[i][3];
}

// Returns whether a reflection model lights physical materials.
bool frame_is_physical(lam_reflection model);
// Returns the factor of a classic material's exponent: a Phong highlight with the exponent α/4 looks like a Blinn–Phong
// highlight with α.
float frame_exponent_share(lam_reflection model);

// Returns the maximum number of materials that frame_materials_build and frame_back_material convert to the other kind.
size_t frame_materials_to_convert(const struct frame *frame, const lam_scene *scene);
void frame_materials_build(struct frame *frame, const lam_scene *scene);
// Returns which layers of a material the frame draws, as LAYER_… bits. Transmission works only with Phong shading.
int frame_layers(const struct frame *frame, const lam_material *material);

// Adds the ranges of a draw to the frame, and sets draw->clear. Each range has one material on each side.
void frame_ranges_build(struct frame *frame, const lam_scene *scene, int draw_index);

// Returns the index of material `back`. If the model that lights `front` cannot light `back`, returns the index of a
// converted copy of `back`.
int frame_back_material(struct frame *frame, int front, int back);

// Returns the index of the material for unlit lines and points. The material's diffuse colour includes its emission. If
// the file sets no colour for the material or the vertices (`colored`), and the background is not dark, the material is
// a visible grey.
int frame_stroke_material(struct frame *frame, int front, bool colored);

// How the frame filters a map of a material.
struct texture_sampler frame_map_sampler(const struct frame *frame, const lam_material *material,
                                         const lam_texture_map *map);

// Returns the maps that shading uses: a bit 1 << LAM_MAP_… for each. If colours of vertices or triangles are
// interpolated, these are the maps that multiply such a colour.
unsigned frame_maps(const struct frame *frame, const lam_material *material);

// Returns whether a metallic-roughness material and its maps are converted to a classic material at each point.
bool frame_converts_at_points(const struct frame *frame, const lam_material *material);

// Gets the colours by which lights are multiplied: kd and ks. For a physical material, kd is base (1 − metallic), and
// ks is 1, because the Fresnel factor is applied later (fresnel_of). Factors that maps change are not included, because
// each point applies them.
void frame_material_colors(const struct frame *frame, const lam_material *material, float kd[3], float ks[3]);
// Returns the three numbers by which a material multiplies a hemisphere light: kd or ka.
const float *frame_sky_color(const struct frame *frame, const struct frame_hemisphere *h, const lam_material *material);

// Returns whether a classic material mirrors the frame's environment.
bool frame_reflects_environment(const struct frame *frame, const lam_material *material);

// Returns whether a mesh has the texture coordinates that a map uses. If not, the mesh is drawn without the map, as if
// all texels were 1.
static inline bool frame_has_texcoords(const lam_mesh *mesh, const lam_texture_map *map)
{
    return map->texcoords ? mesh->second_texcoords != NULL : mesh->texcoords != NULL;
}

// Returns the largest strength S of a material's highlight, including the Fresnel factor.
float frame_lobe_max(const lam_material *material);

// Returns the highlight exponent of a material, as changed by match_highlights and gl1.
float frame_shininess(const struct frame *frame, const lam_material *material);

// The maps in order of precedence: LAM_OUTPUT_LOD shows the first of these maps that the material has.
enum { LOD_MAPS = 9 };
extern const lam_map frame_lod_maps[LOD_MAPS];

// Builds the frame, and reuses its storage from the previous call. Errors: LAM_BAD_ARGUMENT (camera or parameters out
// of range), LAM_LIMIT (memory, too many triangles).
bool frame_build(struct frame *frame, const lam_scene *scene, const lam_camera *camera, const lam_draw_params *params,
                 int width, int height, struct call_control *call, lam_error *error);
void frame_free(struct frame *frame);

// Returns the index of the range that contains a triangle number.
static inline int frame_range_of(const struct frame *frame, uint32_t id)
{
    int low = 0, high = frame->range_count - 1;
    while (low < high) {
        int middle = (low + high + 1) / 2;
        if (frame->ranges[middle].first_id <= id)
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}

#endif
