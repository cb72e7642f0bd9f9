// lambent/mesh.h: triangles, lines and points, their attributes, and meshes made from formulas.
#ifndef LAMBENT_MESH_H
#define LAMBENT_MESH_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

// The type of a mesh's colours: four channels, R G B A.
typedef enum lam_colors_format {
    LAM_COLORS_NONE = 0,   // no colours
    LAM_COLORS_SRGB8,      // 4 bytes, RGB sRGB-encoded, A linear
    LAM_COLORS_LINEAR8,    // 4 bytes, all linear
    LAM_COLORS_LINEAR_F32, // 4 floats, linear
} lam_colors_format;

// Whether an attribute has one value for each vertex or for each triangle.
typedef enum lam_rate {
    LAM_PER_VERTEX = 0,   // one for each vertex, or by an index array
    LAM_PER_TRIANGLE = 1, // one for each triangle
} lam_rate;

// A range of triangles with one name and one material: an OBJ group, an STL solid, a glTF primitive. The parts of a
// mesh are in order, do not overlap, and cover all of its triangles.
typedef struct lam_part {
    const char *name;        // UTF-8; NULL: unnamed
    uint32_t first_triangle; // index into the mesh's triangles
    uint32_t triangle_count; // triangles of the part
    int32_t material;        // index into the scene's materials; −1: the default material
    LAM_RESERVED(4);
} lam_part;

// A mesh of triangles, of lines or of points. lam_scene_add_mesh copies the arrays, and the scene owns the copies.
//
// At most one of triangle_count, line_count and point_count is not 0. Statements about triangles also apply to lines,
// which have two corners, and to points, which have one. Corner c of line l has the number 2l + c, and point p has the
// number p; index arrays have one element for each such number, and parts count lines or points.
// lam_draw_params.line_width and point_size set the width of lines and the size of points in pixels. Lines and points
// face the eye and are visible from all sides. Lines and points are lit if the mesh contains normals; the library never
// computes normals for lines and points. Without normals, they show the diffuse colour and the emission, unlit.
//
// Corner c of triangle t has the number i = 3t + c. Its position is element indices[i] of `positions`. Every other
// attribute may have an index array of its own (3 per triangle), for files whose corners share positions but not
// normals; if that array is NULL, `indices` is used. If `indices` is NULL too, corner i uses element i.
typedef struct lam_mesh {
    const char *name; // UTF-8; NULL: unnamed
    // Added to every position, in double precision, to keep the detail of models far away from zero. If a mesh is more
    // than 16 times its size away from zero on some axis, the scene gives it an origin near its centre and stores a
    // copy of the positions relative to this origin.
    double origin[3];

    const float *positions;  // 3 per vertex, finite
    uint32_t vertex_count;   // elements of `positions`
    const uint32_t *indices; // 3 per triangle, each < vertex_count
    uint32_t triangle_count; // triangles of the mesh

    // Three numbers for each element. The normals may have any length and are normalised when used. NULL: the scene
    // computes smooth normals.
    const float *normals;
    uint32_t normal_count;          // elements of `normals`
    const uint32_t *normal_indices; // 3 per triangle; NULL: `indices`

    const float *texcoords;           // 2 per element: s, t; NULL if there is none
    uint32_t texcoord_count;          // elements of `texcoords`
    const uint32_t *texcoord_indices; // 3 per triangle; NULL: `indices`

    // A second set of texture coordinates, for maps whose lam_texture_map.texcoords is 1.
    const float *second_texcoords;           // 2 per element; NULL if there is none
    uint32_t second_texcoord_count;          // elements of `second_texcoords`
    const uint32_t *second_texcoord_indices; // 3 per triangle; NULL: `indices`

    // 4 per element: the unit tangent ∂p/∂s and the sign of the bitangent. NULL: none.
    const float *tangents;
    uint32_t tangent_count;          // elements of `tangents`
    const uint32_t *tangent_indices; // 3 per triangle; NULL: `indices`

    // Colours in the format `colors_format`; they multiply the material's ambient and diffuse colours. NULL: none.
    const void *colors;
    uint32_t color_count;            // elements of `colors`
    lam_colors_format colors_format; // type of an element
    lam_rate colors_rate;            // LAM_PER_TRIANGLE: triangle t uses element t
    const uint32_t *color_indices;   // 3 per triangle; NULL: `indices`

    // The smoothing group of each triangle, for normals that the library computes: triangles of different groups, and
    // triangles of group 0, do not share normals. NULL: only the crease angle decides.
    const uint32_t *smoothing_groups;

    const lam_part *parts; // NULL: one unnamed part with the default material
    uint32_t part_count;   // elements of `parts`

    uint32_t line_count;  // lines of a mesh of lines
    uint32_t point_count; // points of a mesh of points

    // One byte for each triangle: bit k (0, 1, 2) is set if the edge from corner k to the next corner is inside a
    // polygon that was split into triangles. The wireframe omits such edges. Bit 3 is set if the triangle belongs to a cut
    // surface (section.h) or to a face of an exact shape (STEP), whose outline is a feature edge. NULL: all edges are
    // edges of the model.
    const uint8_t *inner_edges;
    bool hidden; // true: objects of this mesh are hidden (lam_scene_hide_mesh)
    // The area of an exact shape (STEP, IGES, BREP) and the volume that it encloses if it is closed, in square and cubic
    // units of the mesh, to about six digits. 0: unknown (lam_load_params.measure).
    double exact_area, exact_volume;
    LAM_RESERVED(27);
} lam_mesh;

// Parameters of a built-in shape. All zero: the defaults of the shape.
typedef struct lam_shape_params {
    double radius; // size of the whole shape, model units; 0: 1
    // Segments around, 3..16384; 0: the shape's default, which is smooth at 1024 pixels. For gyroid and metaballs: the
    // cells along a side, at most 1024. teapot rounds up to a multiple of 4 for body and lid; handle and spout have
    // half as many, at least 4.
    int slices;
    // Segments along, 1..16384; 0: the shape's default. sphere needs at least 2, torus and torus-knot 3; teapot allows
    // at most 4096 for each patch; gyroid and metaballs ignore it.
    int stacks;
    const lam_control *control; // control of the construction; NULL if there is none
    int threads;                // number of threads that compute the shape, 1..1024; 0: auto
    LAM_RESERVED(7);
} lam_shape_params;

// Returns the number of built-in shapes: sphere, torus, plane, cube, cylinder, cone, teapot, torus-knot, gyroid,
// metaballs. The y axis of a shape points up, and its centre is the origin. With radius 1, each shape fits exactly into
// the cube from −1 to 1.
LAM_API int lam_shape_count(void);

// These functions return the name of a shape and one line about it. The strings are static. The functions return NULL
// if the index is out of range.
LAM_API const char *lam_shape_name(int shape);
LAM_API const char *lam_shape_summary(int shape);

// Returns the index of the shape with this name, or −1 if there is none.
LAM_API int lam_shape_find(const char *name);

// A point of a parametric surface.
typedef struct lam_surface_point {
    lam_vec3 p; // position
    // The partial derivatives, whose cross product ∂p/∂u × ∂p/∂v points outward. If a derivative is zero (at a pole),
    // give the limit of its direction, or zero to use the neighbouring points.
    lam_vec3 dp_du, dp_dv;
} lam_surface_point;

// Writes the surface's point at (u, v) to `out`. `user` is lam_parametric.user.
typedef void lam_surface_fn(void *user, double u, double v, lam_surface_point *out);

// A surface given by a function of two parameters.
typedef struct lam_parametric {
    lam_surface_fn *surface;    // the function
    void *user;                 // passed to `surface`
    double u_min, u_max;        // range of u, u_min < u_max
    double v_min, v_max;        // range of v, v_min < v_max
    int u_segments, v_segments; // 1..16384
    // Whether the surface is closed in u and in v: both ends share positions and normals.
    bool u_closed, v_closed;
    LAM_RESERVED(8);
} lam_parametric;

// A surface defined by formulas in a text. docs/shapes.md describes the language. Normals come from the symbolic
// derivatives.
//
// Parametric: "a = 2; x = (a + cos(v))*cos(u); y = (a + cos(v))*sin(u); z = sin(v)". If the two ends of a range meet,
// they are joined. If the surface has a crease along a grid line, the normals on both sides of it are separate.
//
// Implicit: "a = 2; x^2 + y^2 + z^2 - a^2", the points at which the expression is zero, or "x^2 + y^2 + z^2 = 4", the
// points at which both sides are equal. The expression (left side minus right side) is negative inside.
typedef struct lam_formula {
    const char *text; // at most 4096 bytes
    // Parametric: the ranges of u and v, each two constant expressions; NULL: "0..2pi".
    const char *u, *v;
    // Parametric: 1..16384; 0: 16..512, so that edges deviate from the surface by at most 1/4000 of its size. Implicit:
    // u_segments is the number of cells along the longest side of the box, 2..1024; 0: 96. v_segments is 0.
    int u_segments, v_segments;
    // true: the front faces the direction −(∂p/∂u × ∂p/∂v) or −∇f; false: ∂p/∂u × ∂p/∂v or ∇f.
    bool flip;
    bool implicit; // true: an implicit surface; false: a parametric one
    // Implicit: the box that is searched, in the format of u and v. NULL: a box around the surface, within −4..4, or
    // within −16..16 if the surface is closed only there.
    const char *x, *y, *z;
    LAM_RESERVED(4);
} lam_formula;

// A point of a formula's surface, in the axes of the formula.
typedef struct lam_formula_point {
    // Implicit: the point. Parametric: u, v and 0.
    lam_vec3 at;
    double value;         // implicit: left side minus right side at the point
    lam_vec3 p, p_u, p_v; // parametric: the point, ∂p/∂u and ∂p/∂v
    lam_vec3 normal;      // any length: ∇f, or ∂p/∂u × ∂p/∂v; reversed by `flip`
    LAM_RESERVED(4);
} lam_formula_point;

// Evaluates a formula and its symbolic derivatives. Implicit: at the point `at`. Parametric: at the texture coordinates
// at.x and at.y of the mesh, the fractions of the ranges of u and v. Errors: as lam_scene_add_formula.
LAM_API bool lam_formula_evaluate(const lam_formula *formula, lam_vec3 at, lam_formula_point *point, lam_error *error);

// A surface given by the zeros of a function that is negative inside.
typedef struct lam_implicit {
    double (*value)(void *user, lam_vec3 p);      // the function
    lam_vec3 (*gradient)(void *user, lam_vec3 p); // its gradient, which points outward
    void *user;                                   // passed to both
    // Two corners of the box that is searched; the surface is cut at the box's sides.
    lam_vec3 minimum, maximum;
    int cells; // along the longest side of the box, 2..1024; 0: 96
    LAM_RESERVED(8);
} lam_implicit;

#ifdef __cplusplus
}
#endif
#endif
