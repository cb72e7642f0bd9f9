// lambent/mesh.h: triangles, their attributes, and meshes made from formulas.
#ifndef LAMBENT_MESH_H
#define LAMBENT_MESH_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

// What colours of a mesh are made of. Four channels R G B A always.
typedef enum lam_colors_format {
    LAM_COLORS_NONE = 0,
    LAM_COLORS_SRGB8,      // 4 bytes, RGB sRGB-encoded, A linear
    LAM_COLORS_LINEAR8,    // 4 bytes, all linear
    LAM_COLORS_LINEAR_F32, // 4 floats, linear
} lam_colors_format;

typedef enum lam_rate {
    LAM_PER_VERTEX = 0,
    LAM_PER_TRIANGLE = 1,
} lam_rate;

// A run of triangles that share a name and a material: an OBJ group, an STL solid, a glTF primitive.
typedef struct lam_part {
    const char *name;        // UTF-8; NULL: unnamed
    uint32_t first_triangle; // parts are in order, do not overlap, and cover all triangles
    uint32_t triangle_count;
    int32_t material; // index into the scene's materials; −1: the default material
} lam_part;

// A mesh of triangles: plain data, borrowed arrays (the scene that holds it owns them).
// A corner c of triangle t is number i = 3t + c. Its position is positions[3·indices[i] …]; each other attribute
// has an optional index array of its own (3 per triangle), for files whose corners share positions but not
// normals; where that array is NULL, `indices` serves. `indices` NULL means corner i uses element i.
// Positions are relative to `origin`, kept in double, so that detail far from zero survives:
// the true position is origin + position.
typedef struct lam_mesh {
    const char *name; // UTF-8; NULL: unnamed
    double origin[3];

    const float *positions; // 3 per vertex
    uint32_t vertex_count;
    const uint32_t *indices; // 3 per triangle, each < vertex_count
    uint32_t triangle_count;

    const float *normals; // 3 per element, any length but made unit when used; NULL: made by the scene
    uint32_t normal_count;
    const uint32_t *normal_indices;

    const float *texcoords; // 2 per element: s, t; NULL: none
    uint32_t texcoord_count;
    const uint32_t *texcoord_indices;

    const float *tangents; // 4 per element: unit tangent ∂p/∂s and the sign of the bitangent; NULL: none
    uint32_t tangent_count;
    const uint32_t *tangent_indices;

    const void *colors; // multiplied into the material's ambient and diffuse; NULL: none
    uint32_t color_count;
    lam_colors_format colors_format;
    lam_rate colors_rate; // LAM_PER_TRIANGLE: element t for triangle t, color_indices unused
    const uint32_t *color_indices;

    // Smoothing group of each triangle, for made normals only: triangles of different groups, and those of group
    // 0, do not share normals. NULL: none given, the crease angle alone decides.
    const uint32_t *smoothing_groups;

    const lam_part *parts; // NULL: one unnamed part, default material
    uint32_t part_count;
} lam_mesh;

// A built-in shape's options. All zero is the shape's plain default.
typedef struct lam_shape_params {
    double radius; // of the whole, model units; 0: 1
    // Segments around, 3..16384; 0: the shape's own (smooth at 1024 pixels). For gyroid and metaballs the cells along a
    // side, at most 1024.
    int slices;
    // Segments along, 1..16384; 0: the shape's own. sphere needs 2, torus and torus-knot 3; teapot takes at most 4096
    // along each patch; gyroid and metaballs have no use for it.
    int stacks;
    const lam_control *control; // over the making; NULL: none
} lam_shape_params;

// The built-in shapes, one constant table: sphere, torus, plane, cube, cylinder, cone, teapot, torus-knot,
// gyroid, metaballs. Y up, centred on the origin; with a radius of 1 each touches the cube from −1 to 1 from inside.
LAM_API int lam_shape_count(void);
LAM_API const char *lam_shape_name(int shape);    // static; NULL out of range
LAM_API const char *lam_shape_summary(int shape); // one line for people; static
LAM_API int lam_shape_find(const char *name);     // −1: no such shape

// A point of a parametric surface: p(u, v) and its partial derivatives, whose cross product ∂p/∂u × ∂p/∂v points
// outward. Where a derivative vanishes (a pole) give the limit's direction, or zero: then the neighbours decide.
typedef struct lam_surface_point {
    lam_vec3 p, dp_du, dp_dv;
} lam_surface_point;
typedef void lam_surface_fn(void *user, double u, double v, lam_surface_point *out);

typedef struct lam_parametric {
    lam_surface_fn *surface;
    void *user;                        // handed to `surface`
    double u_min, u_max, v_min, v_max; // domain; min < max
    int u_segments, v_segments;        // 1..16384
    bool u_closed, v_closed;           // the surface meets itself at the ends of u, of v: one seam, equal normals
} lam_parametric;

// An implicit surface f(p) = 0, negative inside; `gradient` gives ∇f, which points outward.
typedef struct lam_implicit {
    double (*value)(void *user, lam_vec3 p);
    lam_vec3 (*gradient)(void *user, lam_vec3 p);
    void *user;
    lam_vec3 minimum, maximum; // the box that is searched; the surface is cut at its sides
    int cells;                 // cells along the longest side, 2..1024; 0: 96
} lam_implicit;

#ifdef __cplusplus
}
#endif
#endif
