// lambent/scene.h: meshes, materials, objects and lights together, made from a file or by hand.
#ifndef LAMBENT_SCENE_H
#define LAMBENT_SCENE_H

#include "environment.h"
#include "light.h"
#include "material.h"
#include "mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

// Opaque. It lives in one arena and is freed by one call. While nobody changes it, any number of threads may read
// and draw it at once.
typedef struct lam_scene lam_scene;

typedef enum lam_up {
    LAM_UP_AUTO = 0, // by format: glTF, OBJ and PLY are Y up, STL is Z up
    LAM_UP_X,
    LAM_UP_Y,
    LAM_UP_Z,
} lam_up;

// A colour as people write it: "#rgb", "#rrggbb", "#rrggbbaa", a colour name of HTML 4 (or "orange"), "transparent",
// or linear numbers "r/g/b" or "r/g/b/a". Hexadecimal colours and names are sRGB: LAM_COLOR_SRGB decodes them to
// linear light, LAM_COLOR_RAW leaves the numbers as they are. LAM_BAD_ARGUMENT says what was found and expected.
LAM_API bool lam_color_parse(const char *text, lam_color_mode mode, lam_rgba *color, lam_error *error);

typedef enum lam_normals {
    LAM_NORMALS_FILE = 0, // the file's; smooth ones where it has none (STL's facet normals count as none)
    LAM_NORMALS_SMOOTH,   // made smooth whatever the file says
    LAM_NORMALS_FACET,    // each triangle's own, at its three corners
} lam_normals;

// A file that a model names (MTL, texture), read by the caller. Returns false and fills the error if it cannot.
// `bytes` is freed by the loader with lam_bytes_free's rule (malloc'd). `name` is relative to the model's folder,
// already confined to it.
struct lam_bytes;
typedef bool lam_open_fn(void *user, const char *name, struct lam_bytes *bytes, lam_error *error);

typedef struct lam_load_params {
    const char *format; // "obj", "stl", "ply", "scene"…; NULL: told by content
    lam_up up;          // overrides the format's up axis
    lam_color_mode color;
    // scene files: `color` holds whatever the file says; false: the file's, `color` where it says nothing
    bool color_decides;
    lam_normals normals;
    // Made normals are split where neighbouring faces meet at more than this angle, radians, 0..π.
    double crease_angle_rad; // 0: 40°; for 0 itself use LAM_NORMALS_FACET
    int threads;             // 0: one for each processor
    // Smooth normals that the file lacks are left to the device, which makes those of the triangles that a
    // frame shows, each time it draws: the same picture sooner, where a large model is drawn once.
    // lam_mesh.normals stays NULL then; lam_scene_make_normals makes them all after all. Not for scene files,
    // nor for other devices than the CPU's.
    bool normals_when_drawn;
    // Scene files: the models that they name may lie anywhere, as on a command line; false: only in the scene file's
    // folder and those below it. What the models name themselves always stays in the model's folder.
    bool models_anywhere;
    // Companion files when loading from memory. NULL: none can be opened.
    lam_open_fn *open;
    void *user;
} lam_load_params;

// Reads a model file into a new scene: its meshes, materials, one object for each mesh, its lights. `params` and
// `control` may be NULL. The caller frees the scene. Errors: LAM_CANNOT_READ, LAM_UNSUPPORTED, LAM_LIMIT,
// LAM_CANCELLED; then NULL is returned and nothing is left behind.
LAM_API lam_scene *lam_scene_load(const char *path, const lam_load_params *params, const lam_control *control,
                                  lam_error *error);

// The same from memory. `name` stands for the file in messages and gives the hint of its ending; may be NULL.
// The bytes are not kept.
LAM_API lam_scene *lam_scene_load_memory(const void *bytes, size_t size, const char *name,
                                         const lam_load_params *params, const lam_control *control, lam_error *error);

// The model formats that can be read, one constant table: the name ("obj") and the file-name endings ("obj").
// NULL out of range.
LAM_API const char *lam_format_name(int format);
LAM_API const char *lam_format_extensions(int format);

// Makes the normals of every mesh anew, as loading would have done: LAM_NORMALS_FILE changes only meshes that have
// none. `crease_angle_rad` 0: 40°. `threads` 0: one for each processor. `control` may be NULL. On failure some meshes
// may have new normals and others the old ones.
LAM_API bool lam_scene_make_normals(lam_scene *scene, lam_normals normals, double crease_angle_rad, int threads,
                                    const lam_control *control, lam_error *error);

// An empty scene, Y up. NULL only when memory is out.
LAM_API lam_scene *lam_scene_make(lam_error *error);
LAM_API void lam_scene_free(lam_scene *scene); // NULL is fine

// Add to a scene. Arrays and strings are copied. Each returns the index of what was added, −1 on failure
// (LAM_BAD_ARGUMENT: an index out of range, a number that is not finite; LAM_LIMIT: memory).
// A mesh without normals gets smooth ones, creased at 40°.
LAM_API int lam_scene_add_mesh(lam_scene *scene, const lam_mesh *mesh, lam_error *error);
LAM_API int lam_scene_add_material(lam_scene *scene, const lam_material *material, lam_error *error);
LAM_API int lam_scene_add_light(lam_scene *scene, const lam_light *light, lam_error *error);

// Add meshes that are computed. The shape's name is one of lam_shape_name(). `params` and `control` may be NULL.
LAM_API int lam_scene_add_shape(lam_scene *scene, const char *shape, const lam_shape_params *params, lam_error *error);
LAM_API int lam_scene_add_parametric(lam_scene *scene, const lam_parametric *surface, const lam_control *control,
                                     lam_error *error);
LAM_API int lam_scene_add_implicit(lam_scene *scene, const lam_implicit *surface, const lam_control *control,
                                   lam_error *error);

typedef enum lam_cull {
    LAM_CULL_NONE = 0,
    LAM_CULL_BACK,
    LAM_CULL_FRONT,
} lam_cull;

// A mesh placed in the scene. lam_object_default() has the identity transform, everything else zero but `material`
// and `back_material`, which are −1.
typedef struct lam_object {
    const char *name;   // UTF-8; NULL: unnamed
    int mesh;           // index
    lam_mat4 transform; // mesh to world, affine (last row 0 0 0 1); invertible
    int material;       // −1: the parts' own
    int back_material;  // −1: the front's
    bool one_sided;     // true: back faces are lit with n as it is and the front material; false: with −n
    lam_cull cull;
} lam_object;

LAM_API lam_object lam_object_default(void);
LAM_API int lam_scene_add_object(lam_scene *scene, const lam_object *object, lam_error *error);

// Change what a scene holds: the item at `index` becomes a copy of the one given. False: LAM_BAD_ARGUMENT (no such
// index, or as in the calls that add), LAM_LIMIT.
LAM_API bool lam_scene_set_material(lam_scene *scene, int index, const lam_material *material, lam_error *error);
LAM_API bool lam_scene_set_object(lam_scene *scene, int index, const lam_object *object, lam_error *error);
LAM_API bool lam_scene_set_light(lam_scene *scene, int index, const lam_light *light, lam_error *error);
LAM_API void lam_scene_clear_lights(lam_scene *scene); // all of them; the scene's ambient light stays

// Gives a part of a mesh another material (−1: the default one), wherever objects show the mesh.
LAM_API bool lam_scene_set_part_material(lam_scene *scene, int mesh, uint32_t part, int material, lam_error *error);

// Look into a scene. Pointers stay valid until the scene is changed or freed; NULL out of range.
LAM_API int lam_scene_mesh_count(const lam_scene *scene);
LAM_API int lam_scene_material_count(const lam_scene *scene);
LAM_API int lam_scene_object_count(const lam_scene *scene);
LAM_API int lam_scene_light_count(const lam_scene *scene);
LAM_API const lam_mesh *lam_scene_mesh(const lam_scene *scene, int index);
LAM_API const lam_material *lam_scene_material(const lam_scene *scene, int index);
LAM_API const lam_object *lam_scene_object(const lam_scene *scene, int index);
LAM_API const lam_light *lam_scene_light(const lam_scene *scene, int index);
LAM_API uint64_t lam_scene_triangle_count(const lam_scene *scene); // over all objects
LAM_API uint64_t lam_scene_vertex_count(const lam_scene *scene);   // over all objects
LAM_API const char *lam_scene_format(const lam_scene *scene);      // name of the file format; "" if made by hand

// Things worth telling that did not stop the load, one sentence each, in order; NULL out of range.
LAM_API const char *lam_scene_warning(const lam_scene *scene, int index);
LAM_API void lam_scene_add_warning(lam_scene *scene,
                                   const char *text); // one more; copied; after the 64th none is kept

// The box around all objects' triangles, in world space. False (and the box zeroed) for a scene without triangles.
LAM_API bool lam_scene_bounds(const lam_scene *scene, lam_vec3 *minimum, lam_vec3 *maximum);

// The up axis: read, and set (LAM_UP_AUTO: Y). It turns the fitted camera and the rig, never the coordinates.
LAM_API lam_up lam_scene_up(const lam_scene *scene);
LAM_API void lam_scene_set_up(lam_scene *scene, lam_up up);

// A sphere around the scene's triangles, or around one object's in that object's own space (`object` −1: the whole
// scene, in world space). Its centre is the middle of their box, its radius the largest distance of a vertex from
// there: for a sphere, the sphere itself. False (and all zero) where there are no triangles, or no such object.
LAM_API bool lam_scene_sphere(const lam_scene *scene, int object, lam_vec3 *centre, double *radius);

// Moves all objects: each one's transform becomes transform × its own. Lights stay, but those whose frame is an object
// or the model. The matrix must be affine and invertible: LAM_BAD_ARGUMENT, and nothing has moved.
LAM_API bool lam_scene_transform(lam_scene *scene, const lam_mat4 *transform, lam_error *error);

// The same, turning right-handed about the axis (not zero) through the point `centre`.
LAM_API bool lam_scene_rotate(lam_scene *scene, lam_vec3 centre, lam_vec3 axis, double angle_rad, lam_error *error);

// The lights that a rig adds to this scene when it is drawn, in their places: lam_rig_lights with AUTO decided.
LAM_API int lam_scene_rig_lights(const lam_scene *scene, lam_rig rig, lam_light lights[LAM_RIG_LIGHTS_MAX]);

// Makes tangents for every mesh that has texture coordinates and none of its own: ∂p/∂s of the triangles, averaged by
// their angles over the corners that share position, normal and texture coordinate, perpendicular to the normal; a
// corner whose texture coordinates do not tell a direction gets that of meshes without them (docs/lighting.md). Drawing
// never makes tangents by itself. `control` may be NULL. Errors: LAM_LIMIT, LAM_CANCELLED; then some meshes may have
// theirs and others not.
LAM_API bool lam_scene_make_tangents(lam_scene *scene, const lam_control *control, lam_error *error);

// Light from everywhere, added to that of the ambient lights (La_global). Default 0.
LAM_API void lam_scene_set_ambient(lam_scene *scene, lam_rgb ambient);
LAM_API lam_rgb lam_scene_ambient(const lam_scene *scene);

// What materials with a reflectivity mirror (environment.h): `rotation_rad` turns it about the up axis,
// counter-clockwise seen from above. With Y up and no rotation the cube's axes are the world's; with another up axis it
// is turned as the fitted camera is, its top where up is. The scene keeps the environment by itself: the caller may
// free his. NULL: none, the default. False: LAM_BAD_ARGUMENT (no scene, the rotation is not finite).
LAM_API bool lam_scene_set_environment(lam_scene *scene, const lam_environment *environment, double rotation_rad,
                                       lam_error *error);
LAM_API const lam_environment *lam_scene_environment(const lam_scene *scene); // NULL: none
LAM_API double lam_scene_environment_rotation(const lam_scene *scene);        // radians

// The material of parts that name none; lam_material_default() until it is set. False: as lam_scene_add_material.
LAM_API bool lam_scene_set_default_material(lam_scene *scene, const lam_material *material, lam_error *error);
LAM_API const lam_material *lam_scene_default_material(const lam_scene *scene);

// Milliseconds that loading took: reading and parsing the file, and preparing (normals, bounds).
LAM_API void lam_scene_times(const lam_scene *scene, double *read_ms, double *prepare_ms);

#ifdef __cplusplus
}
#endif
#endif
