// lambent/scene.h: scenes: meshes, materials, objects and lights together, loaded from a file or made by hand.
#ifndef LAMBENT_SCENE_H
#define LAMBENT_SCENE_H

#include "environment.h"
#include "light.h"
#include "material.h"
#include "mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

// A scene. Its memory is freed by one call. While nobody changes it, any number of threads may read and draw it.
typedef struct lam_scene lam_scene;

// The axis that points up.
typedef enum lam_up {
    LAM_UP_AUTO = 0,   // the format's: y for glTF, OBJ and PLY, z for STL and 3MF
    LAM_UP_X,          // +x
    LAM_UP_Y,          // +y
    LAM_UP_Z,          // +z
    LAM_UP_NEGATIVE_X, // −x
    LAM_UP_NEGATIVE_Y, // −y
    LAM_UP_NEGATIVE_Z, // −z
    LAM_UP_COUNT
} lam_up;

// The word of an up axis: "auto", "x", "y", "z", "-x", "-y" or "-z"; NULL out of range.
LAM_API const char *lam_up_name(lam_up up);
// The up axis of a word, in capitals or not, also with a plus ("+Z"); LAM_UP_COUNT: there is none.
LAM_API lam_up lam_up_find(const char *name);

// Reads a colour: "#rgb", "#rrggbb", "#rrggbbaa", a colour name of HTML 4 or "orange", "transparent", linear numbers
// "r/g/b" or "r/g/b/a", or one linear number for all three channels. Hexadecimal colours and names are sRGB: LAM_COLOR_SRGB decodes them to linear light, and
// LAM_COLOR_RAW leaves their numbers as they are. False: LAM_BAD_ARGUMENT.
LAM_API bool lam_color_parse(const char *text, lam_color_mode mode, lam_rgba *color, lam_error *error);

// The colour names of lam_color_parse, from 0; NULL out of range. "transparent" is not among them.
LAM_API const char *lam_color_name(int index);

// Where normals come from.
typedef enum lam_normals {
    // The file's; smooth ones if it has none. STL's facet normals count as none.
    LAM_NORMALS_FILE = 0,
    // Smooth ones, made even where the file has normals: faces are weighted by area × corner angle, and creased.
    LAM_NORMALS_SMOOTH,
    LAM_NORMALS_FACET, // each triangle's own, at its three corners
} lam_normals;

struct lam_bytes;

// Opens a file that a model names (MTL, texture), or that a scene file names (a model, a picture). `name` is relative to
// the folder of the file that was loaded and does not leave it. Fills `bytes`. False: it cannot be read, and `error` says
// why.
typedef bool lam_open_fn(void *user, const char *name, struct lam_bytes *bytes, lam_error *error);

// Frees the bytes of a lam_open_fn. The loader calls it once for each file that was opened.
typedef void lam_release_fn(void *user, struct lam_bytes *bytes);

// How a model is loaded. All zero is the default.
typedef struct lam_load_params {
    // The name of a format as `lambent formats` prints it, such as "obj" or "3mf"; NULL: recognised by the content.
    const char *format;
    lam_up up;            // the up axis
    lam_color_mode color; // of the file's colours
    // Scene files: true: `color` overrides the file. false: the file's mode, or else `color`.
    bool override_color;
    lam_normals normals; // where normals come from
    // Angle in radians, 0..π, above which neighbouring faces do not share a made normal. 0: 40°; for no smoothing at
    // all use LAM_NORMALS_FACET.
    double crease_angle_rad;
    int threads; // that load; 0: one for each processor
    // Leaves normals that the file does not contain to the CPU device, which computes the visible triangles' each time
    // it draws: faster for a large model that is drawn once. lam_mesh.normals stays NULL; lam_scene_make_normals makes
    // all of them later. Not for scene files, and not for other devices.
    bool normals_when_drawn;
    // Scene files: true: the models and pictures that they name may lie in any folder. false: only in the scene file's
    // folder and below, links followed. Files that models name stay in the model's folder (see `allowed_paths`).
    bool models_anywhere;
    // Opens the files that a model names. NULL: those beside the model; for a model in memory none can be opened.
    lam_open_fn *open;
    // Frees the bytes of `open`. NULL: the loader frees them with lam_bytes_free, so they come from malloc.
    lam_release_fn *release;
    void *user; // passed to `open` and `release`
    // glTF: the scene of the file that is read, by its name or its number from 0. NULL: the file's default scene.
    const char *scene;
    // glTF: the variant of the materials (KHR_materials_variants), by its name or its number from 0. NULL: the materials
    // of the primitives themselves.
    const char *variant;
    // glTF and 3MF: true: extensions that the file requires and this version does not know are ignored, as are glTF's primitive
    // restart values among indices. false: LAM_UNSUPPORTED, LAM_CANNOT_READ.
    bool lenient;
    // glTF: the animation whose pose at `time_s` is shown, by its name or its number from 0. NULL: the pose that the file
    // has without one.
    const char *animation;
    // Seconds; before the first and after the last key of a channel it has that key's values. Finite.
    double time_s;
    // OBJ and PLY: keeps which edges cutting polygons into triangles made (lam_mesh.inner_edges), for wireframes.
    bool polygon_edges;
    // Folders and files that the files named by a model or a scene file may lie in, besides the folder of the one that names
    // them. Without them a name that leads out of that folder, such as "../textures/wood.png", is cut to its last part.
    const char *const *allowed_paths;
    int allowed_path_count; // of allowed_paths
    LAM_RESERVED(8);
} lam_load_params;

// Loads a model file into a new scene: its meshes, materials and lights, and an object for each mesh. Where everything is
// fully transparent, materials and colours become opaque, with a warning. `params` and `control` may be NULL. The caller
// frees the scene. NULL on failure: LAM_CANNOT_READ, LAM_UNSUPPORTED, LAM_LIMIT, LAM_CANCELLED.
LAM_API lam_scene *lam_scene_load(const char *path, const lam_load_params *params, const lam_control *control,
                                  lam_error *error);

// The same from memory. Messages use `name` for the file, and its extension helps to find the format; it may be NULL.
// The bytes are not kept.
LAM_API lam_scene *lam_scene_load_memory(const void *bytes, size_t size, const char *name,
                                         const lam_load_params *params, const lam_control *control, lam_error *error);

// The model formats that can be read, from 0: the name ("obj"), and the endings of file names, separated by blanks
// ("obj"). Static strings; NULL out of range.
LAM_API const char *lam_model_format_name(int format);
LAM_API const char *lam_model_format_extensions(int format);

// Makes the normals of every mesh again, as loading would have. LAM_NORMALS_FILE changes only meshes without normals.
// `crease_angle_rad` and `threads` are as in lam_load_params; `control` may be NULL. On failure some meshes may have
// new normals and others the old ones. Errors: LAM_LIMIT, LAM_CANCELLED.
LAM_API bool lam_scene_make_normals(lam_scene *scene, lam_normals normals, double crease_angle_rad, int threads,
                                    const lam_control *control, lam_error *error);

// Makes an empty scene, y up. NULL: LAM_LIMIT.
LAM_API lam_scene *lam_scene_make(lam_error *error);
LAM_API void lam_scene_free(lam_scene *scene); // NULL is fine

// Add to a scene. Arrays and strings are copied. Each returns the index of the added element, −1 on failure:
// LAM_BAD_ARGUMENT (an index out of range, a number out of range or not finite), LAM_LIMIT. A mesh without normals gets
// smooth ones, creased at 40°.
LAM_API int lam_scene_add_mesh(lam_scene *scene, const lam_mesh *mesh, lam_error *error);
LAM_API int lam_scene_add_material(lam_scene *scene, const lam_material *material, lam_error *error);
LAM_API int lam_scene_add_light(lam_scene *scene, const lam_light *light, lam_error *error);

// Add meshes that are computed, in the same way. The shape's name is one of lam_shape_name(). `params` and `control`
// may be NULL.
LAM_API int lam_scene_add_shape(lam_scene *scene, const char *shape, const lam_shape_params *params, lam_error *error);
LAM_API int lam_scene_add_parametric(lam_scene *scene, const lam_parametric *surface, const lam_control *control,
                                     lam_error *error);
// Errors of a formula name the column of its text.
LAM_API int lam_scene_add_formula(lam_scene *scene, const lam_formula *formula, const lam_control *control,
                                  lam_error *error);
LAM_API int lam_scene_add_implicit(lam_scene *scene, const lam_implicit *surface, const lam_control *control,
                                   lam_error *error);

// Writes a mesh of triangles as a model file, whole or not at all: by the name's ending .obj, .stl (binary) or .ply (binary),
// with its normals and texture coordinates where the format has them, without materials and colours. `up` is the axis of the
// mesh that is up (AUTO: y). It is y in OBJ and PLY and z in STL: the coordinates are turned, so that the file shows the same
// picture. Errors: LAM_BAD_ARGUMENT (no triangles), LAM_UNSUPPORTED (another ending), LAM_CANNOT_WRITE, LAM_LIMIT.
LAM_API bool lam_mesh_save(const lam_mesh *mesh, const char *path, lam_up up, lam_error *error);
// The endings that lam_mesh_save knows, from 0, without the dot: "obj". NULL: no more.
LAM_API const char *lam_mesh_format(int index);

// The triangles that are left out by the side they show.
typedef enum lam_cull {
    LAM_CULL_NONE = 0, // none
    LAM_CULL_BACK,     // triangles that show their back
    LAM_CULL_FRONT,    // triangles that show their front
} lam_cull;

// A mesh placed in the scene. Begin with lam_object_default().
typedef struct lam_object {
    const char *name; // UTF-8; NULL: unnamed
    int mesh;         // index of the mesh
    // From the mesh's space to the world's: affine (last row 0 0 0 1) and invertible.
    lam_mat4 transform;
    int material;      // index of the material; −1: the materials of the mesh's parts
    int back_material; // index of the material of back faces; −1: the front's
    // true: back faces are lit with n as it is and the front material; false: with −n.
    bool one_sided;
    lam_cull cull; // the side that is left out
    bool hidden;   // true: not drawn (lam_scene_hide_object)
    LAM_RESERVED(15);
} lam_object;

// An object with mesh 0, the identity transform, and −1 for both materials.
LAM_API lam_object lam_object_default(void);

// Adds an object, as the calls above do.
LAM_API int lam_scene_add_object(lam_scene *scene, const lam_object *object, lam_error *error);

// Change a scene: the item at `index` becomes a copy of the one given. False: LAM_BAD_ARGUMENT (no such index, or as in
// the calls that add), LAM_LIMIT.
LAM_API bool lam_scene_set_material(lam_scene *scene, int index, const lam_material *material, lam_error *error);
LAM_API bool lam_scene_set_object(lam_scene *scene, int index, const lam_object *object, lam_error *error);
LAM_API bool lam_scene_set_light(lam_scene *scene, int index, const lam_light *light, lam_error *error);

// Replaces a mesh: all objects that show it show the new one. It takes the same arguments as lam_scene_add_mesh. The memory of a
// mesh that this function set is freed when the mesh is replaced or removed, unless the scene has a mark (lam_scene_mark); the
// memory of other meshes is freed with the scene. A scene file cannot be written of a replaced mesh. False, and nothing has changed:
// LAM_BAD_ARGUMENT, LAM_LIMIT.
LAM_API bool lam_scene_set_mesh(lam_scene *scene, int index, const lam_mesh *mesh, lam_error *error);

// Hide an object, or all objects that show a mesh, or show them again. Pictures, boxes and cameras are the same as in a scene without
// hidden objects; a light in the frame of a hidden object stays there. Counts include hidden objects; scene files and exported models leave
// them out. An object is drawn if neither it nor its mesh is hidden. False: LAM_BAD_ARGUMENT (no such index).
LAM_API bool lam_scene_hide_object(lam_scene *scene, int index, bool hidden, lam_error *error);
LAM_API bool lam_scene_hide_mesh(lam_scene *scene, int index, bool hidden, lam_error *error);

// Remove an object, or a mesh with all objects that show it. The indices of later objects, or of later meshes, become one less, and
// the objects name their meshes by the new indices. False, and nothing has changed: LAM_BAD_ARGUMENT (no such index), LAM_LIMIT.
LAM_API bool lam_scene_remove_object(lam_scene *scene, int index, lam_error *error);
LAM_API bool lam_scene_remove_mesh(lam_scene *scene, int index, lam_error *error);

// Removes all lights. The scene's ambient light (lam_scene_set_ambient) stays.
LAM_API void lam_scene_clear_lights(lam_scene *scene);

// Gives a part of a mesh another material (−1: the default one), in all objects of the mesh. False:
// LAM_BAD_ARGUMENT, LAM_LIMIT.
LAM_API bool lam_scene_set_part_material(lam_scene *scene, int mesh, uint32_t part, int material, lam_error *error);

// The number of items of each kind.
LAM_API int lam_scene_mesh_count(const lam_scene *scene);
LAM_API int lam_scene_material_count(const lam_scene *scene);
LAM_API int lam_scene_object_count(const lam_scene *scene);
LAM_API int lam_scene_light_count(const lam_scene *scene);

// An item of a scene. The pointer is valid until the scene is changed or freed; NULL out of range.
LAM_API const lam_mesh *lam_scene_mesh(const lam_scene *scene, int index);
LAM_API const lam_material *lam_scene_material(const lam_scene *scene, int index);
LAM_API const lam_object *lam_scene_object(const lam_scene *scene, int index);
LAM_API const lam_light *lam_scene_light(const lam_scene *scene, int index);

// The number of triangles, of lines, of points, and of vertices, over all objects.
LAM_API uint64_t lam_scene_triangle_count(const lam_scene *scene);
LAM_API uint64_t lam_scene_line_count(const lam_scene *scene);
LAM_API uint64_t lam_scene_point_count(const lam_scene *scene);
LAM_API uint64_t lam_scene_vertex_count(const lam_scene *scene);

// The name of the format that the scene was loaded from; "" for a scene made by hand.
LAM_API const char *lam_scene_format(const lam_scene *scene);

// How a load treats an extension that a glTF file names.
typedef enum lam_extension_support {
    LAM_EXTENSION_READ = 0,  // all of it counts
    LAM_EXTENSION_NO_EFFECT, // known, and it says nothing about the picture
    LAM_EXTENSION_IGNORED,   // known; the file is drawn without it
    // Not known; the file is drawn without it, unless it requires it and the load is not lenient.
    LAM_EXTENSION_UNKNOWN,
} lam_extension_support;

// An extension that a model's file names.
typedef struct lam_file_extension {
    const char *name;              // "KHR_materials_unlit"
    bool required;                 // the file cannot be understood without it
    lam_extension_support support; // the reaction of the load
    LAM_RESERVED(4);
} lam_file_extension;

// An animation of a model's file.
typedef struct lam_file_animation {
    const char *name; // NULL: unnamed
    // Seconds from 0 to the last key, as the file states them; 0: it does not.
    double length_s;
    int channel_count; // channels: the animated property
    LAM_RESERVED(4);
} lam_file_animation;

// A picture that a model's file names.
typedef struct lam_file_image {
    const char *name; // NULL: unnamed
    const char *file; // as written; NULL: its bytes are in the model
    // "png", "jpeg": as the model or the file's ending says; NULL: neither does.
    const char *format;
    // Their uses in materials, as colours and as numbers (lam_texture_values); NULL: no material reads it so, or it
    // could not be read.
    const lam_texture *textures[2];
    LAM_RESERVED(4);
} lam_file_image;

// The contents of a glTF or 3MF file beside the scene that was made from it. Other formats leave all of it zero. Names that the file does
// not give are NULL.
typedef struct lam_file_info {
    const char *version;                  // of the format: "2.0"
    const char *generator;                // the program that wrote the file
    const char *copyright;                // as the file states it
    const char *const *scenes;            // the names of its scenes
    int scene_count;                      // elements of `scenes`
    int scene;                            // the one that was read; −1: there is none
    const char *const *variants;          // of KHR_materials_variants
    int variant_count;                    // elements of `variants`
    const lam_file_animation *animations; // in the file's order
    int animation_count;                  // elements of `animations`
    const lam_file_image *images;         // in the file's order
    int image_count;                      // elements of `images`
    // In the order of "extensionsUsed", then the ones only in "extensionsRequired".
    const lam_file_extension *extensions;
    int extension_count; // elements of `extensions`
    // Metres of a unit of the file's lengths: 1 of glTF's, 0.001 of millimetres; 0: the format does not say.
    double unit_m;
    LAM_RESERVED(15);
} lam_file_info;

// Describes the file of a loaded scene. Valid until the scene is freed; all zero for scenes made by hand and for scene
// files. NULL for a scene that is NULL.
LAM_API const lam_file_info *lam_scene_file_info(const lam_scene *scene);

// The bytes of memory of a scene: its arrays, names, lists and textures, also shared ones, without its environment.
// Drawing takes more.
LAM_API uint64_t lam_scene_memory(const lam_scene *scene);

// The warnings of a scene from 0, in order: one sentence for each problem that did not stop the load. NULL out
// of range.
LAM_API const char *lam_scene_warning(const lam_scene *scene, int index);

// The paths of the files that loading the scene looked for, from 0. First the model's own, then the files that it names
// (material libraries, buffers, pictures, the models of a scene file), each once, in alphabetical order. Missing files
// are included, because a load may give another scene once they exist. A path is the model's folder with the name in
// the file after it, as it was opened; for files that lam_load_params.open opened, the name given to it. Scenes made by
// hand have none, models from memory and from standard input none of their own. Valid until the scene is freed; NULL
// out of range.
LAM_API const char *lam_scene_file(const lam_scene *scene, int index);

// Adds a warning, which is copied, unless the scene has the same sentence. After the 64th none is kept.
LAM_API void lam_scene_add_warning(lam_scene *scene, const char *text);

// The box around the triangles of all objects, in world space. False, and all zero, for a scene without triangles.
LAM_API bool lam_scene_bounds(const lam_scene *scene, lam_vec3 *minimum, lam_vec3 *maximum);

// The cameras that the model's file has, from 0 (lam_scene_camera in camera.h): their number, and their names, NULL for
// one without a name or out of range. They keep the file's positions; lam_scene_transform does not move them.
LAM_API int lam_scene_camera_count(const lam_scene *scene);
LAM_API const char *lam_scene_camera_name(const lam_scene *scene, int index);

// The number of the camera with this name, or else with this number in digits. −1: there is none.
LAM_API int lam_scene_find_camera(const lam_scene *scene, const char *name);

// The up axis (LAM_UP_AUTO: y; a value out of range changes nothing). It turns the fitted camera, the rig and the
// environment, never the coordinates. The front of the model, which faces the viewer at azimuth 0, is +Z with x or y up
// and −Y with z up; of two opposite axes the second turns the picture upside down.
LAM_API lam_up lam_scene_up(const lam_scene *scene);
LAM_API void lam_scene_set_up(lam_scene *scene, lam_up up);

// A sphere around the triangles of an object, in the object's own space, or (`object` −1) of the whole scene, in world
// space. Its centre is the middle of their box, its radius the largest distance of a vertex from there. False, and all
// zero, if there are no triangles or no such object.
LAM_API bool lam_scene_sphere(const lam_scene *scene, int object, lam_vec3 *centre, double *radius);

// Moves all objects: the transform of each becomes transform × its own. Lights stay, except in the frames of the model
// and of an object. False: LAM_BAD_ARGUMENT (not affine or not invertible), and nothing has moved.
LAM_API bool lam_scene_transform(lam_scene *scene, const lam_mat4 *transform, lam_error *error);

// The same for a right-handed rotation about an axis of any length but 0 through the point `centre`.
LAM_API bool lam_scene_rotate(lam_scene *scene, lam_vec3 centre, lam_vec3 axis, double angle_rad, lam_error *error);

// The lights that a rig adds to this scene, at their positions, and their number: lam_rig_lights with
// LAM_RIG_AUTO decided.
LAM_API int lam_scene_rig_lights(const lam_scene *scene, lam_rig rig, lam_light lights[LAM_RIG_LIGHTS_MAX]);

// Makes tangents for every mesh that has texture coordinates and no tangents, by MikkTSpace, for which normal maps are
// baked (M. S. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008). ∂p/∂s of the triangles is averaged with
// their angles as weights over the triangles around a corner that are joined by edges, have the same orientation of the
// mapping, and the same position, normal and texture coordinates there; it is unit and perpendicular to the normal. A
// corner whose texture coordinates give no direction gets the tangent of meshes without them
// (docs/lighting/threads.md). The texture coordinates are used by the normal map of the mesh's first part with one, or
// else the first set. The bitangent points up in the normal map's picture, or else to where t grows. Loading a model
// does this for meshes with normal maps; drawing does not. `control` may be NULL. On failure some meshes may have
// tangents and others not. Errors: LAM_LIMIT, LAM_CANCELLED.
LAM_API bool lam_scene_make_tangents(lam_scene *scene, const lam_control *control, lam_error *error);

// Remembers the scene as it is, and brings it back to that as often as wanted: its meshes, materials, objects, lights,
// ambient light and up axis, whatever was added or changed since. Environment and warnings stay as they are. For
// pictures of one model that differ in a few options: the model is loaded once, and devices keep their data of it.
// Elements added since use memory until the scene is freed. A second mark takes the place of the first. False:
// LAM_BAD_ARGUMENT (reset: nothing is marked), LAM_LIMIT.
LAM_API bool lam_scene_mark(lam_scene *scene, lam_error *error);
LAM_API bool lam_scene_reset(lam_scene *scene, lam_error *error);

// Light from everywhere, added to the ambient lights' (La_global). Default 0.
LAM_API void lam_scene_set_ambient(lam_scene *scene, lam_rgb ambient);
LAM_API lam_rgb lam_scene_ambient(const lam_scene *scene);

// Sets the environment, which classic materials with a reflectivity mirror and which lights physical ones; NULL, the
// default: none (LAM_RIG_AUTO adds one). `rotation_rad` turns it
// about the up axis, counter-clockwise seen from above. With y up and no rotation its axes are the world's; with
// another up axis it is turned as the fitted camera is, its top up. The scene keeps the environment: the caller may
// free its own reference. False: LAM_BAD_ARGUMENT (no scene, a rotation that is not finite).
LAM_API bool lam_scene_set_environment(lam_scene *scene, const lam_environment *environment, double rotation_rad,
                                       lam_error *error);

// The environment, NULL if there is none.
LAM_API const lam_environment *lam_scene_environment(const lam_scene *scene);

// Sets the material of parts that name none, at first lam_material_default(). False: as lam_scene_add_material.
LAM_API bool lam_scene_set_default_material(lam_scene *scene, const lam_material *material, lam_error *error);
LAM_API const lam_material *lam_scene_default_material(const lam_scene *scene);

// The milliseconds that loading took: reading and parsing the file, and preparing the scene (normals, bounds).
LAM_API void lam_scene_times(const lam_scene *scene, double *read_ms, double *prepare_ms);

#ifdef __cplusplus
}
#endif
#endif
