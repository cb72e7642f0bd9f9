// lambent/scene.h: scenes: meshes, materials, objects and lights together, loaded from a file or built by a program.
#ifndef LAMBENT_SCENE_H
#define LAMBENT_SCENE_H

#include "environment.h"
#include "mesh.h"
#include "texture.h"

#ifdef __cplusplus
extern "C" {
#endif

// A scene. lam_scene_free frees all of its memory. As long as no thread changes the scene, any number of threads may
// read and draw it.
typedef struct lam_scene lam_scene;

typedef struct lam_material lam_material; // material.h
typedef struct lam_light lam_light;       // light.h

// Predefined sets of lights.
typedef enum lam_rig {
    // The scene's own lights. If there are none: the studio for classic materials, and for physical materials only the
    // scene's environment, or the built-in environment "studio" if the scene has no environment.
    LAM_RIG_AUTO = 0,
    LAM_RIG_NONE, // only the scene's own lights, even if there are none
    // The default look: a near key light, a fill and a rim light that move with the camera, and a hemisphere light,
    // which classic materials reflect with kd, because many exporters write a black ka.
    // Ambient occlusion applies in full to the fill light, and at 60 % to the key light and the rim light. In
    // lam_scene_rig_lights without a ground, it applies in full to all of them, and curved models and terrains have a
    // key light next to the eye, and no rim light.
    LAM_RIG_STUDIO,
    LAM_RIG_HEADLIGHT, // one directional light from the eye
    // Directional key, fill and back lights as in portrait photography, fixed to the camera: diffuse and specular 0.8
    // from (−1, 1, 1), 0.4 from (1, 0.25, 1), 0.6 from (0.5, 1, −1); ambient 0.05.
    LAM_RIG_THREE_POINT,
    // One point light in the direction (1, 2, 3) from the centre of the scene's sphere (lam_scene_sphere), rotated to
    // the scene's up axis and scaled by the radius: ambient 0.1, diffuse and specular 1, attenuation 1, 0, 0.
    LAM_RIG_LECTURE,
} lam_rig;

// The largest number of lights in a rig.
enum { LAM_RIG_LIGHTS_MAX = 8 };

// Writes the lights of a rig, at most LAM_RIG_LIGHTS_MAX, and returns their number, which is 0 for AUTO and NONE. Positions and attenuation are for
// a scene whose sphere has its centre at the origin and radius 1; for LAM_FRAME_VIEW, half the diagonal of the box is
// used as the radius. lam_scene_rig_lights places them in a scene.
LAM_API int lam_rig_lights(lam_rig rig, lam_light *lights);

// The axis that points up.
typedef enum lam_up {
    // Like LAM_UP_FILE; but if a PLY or STL model cannot stand on that axis, and stands on exactly one of the other two
    // positive axes, that axis, with a warning. This turns scans upright that lie on their back.
    LAM_UP_AUTO = 0,
    LAM_UP_X,          // +x
    LAM_UP_Y,          // +y
    LAM_UP_Z,          // +z
    LAM_UP_NEGATIVE_X, // −x
    LAM_UP_NEGATIVE_Y, // −y
    LAM_UP_NEGATIVE_Z, // −z
    // The file's axes: y for glTF, OBJ and PLY, z for STL, 3MF, and OBJ and PLY files that contain a terrain in the xy
    // plane (with a warning).
    LAM_UP_FILE,
    LAM_UP_COUNT
} lam_up;

// Returns the name of an up axis: "auto", "x", "y", "z", "-x", "-y", "-z" or "file". Returns NULL if `up` is out of
// range.
LAM_API const char *lam_up_name(lam_up up);
// Returns the up axis with this name, in upper or lower case, with an optional plus ("+Z"). Returns LAM_UP_COUNT if
// there is none.
LAM_API lam_up lam_up_find(const char *name);

// Parses a colour: "#rgb", "#rrggbb", "#rrggbbaa", a colour name of HTML 4 or "orange", "transparent", linear numbers
// "r/g/b" or "r/g/b/a", or one linear number for all three channels. Hexadecimal colours and names are sRGB:
// LAM_COLOR_SRGB decodes them to linear light, and LAM_COLOR_RAW leaves their numbers unchanged. Returns false on
// failure: LAM_BAD_ARGUMENT.
LAM_API bool lam_color_parse(const char *text, lam_color_mode mode, lam_rgba *color, lam_error *error);

// Returns the colour name of lam_color_parse with this index (from 0); "transparent" is not included. Returns NULL if
// the index is out of range.
LAM_API const char *lam_color_name(int index);

// The source of normals.
typedef enum lam_normals {
    // From the file; smooth normals if it has none. STL's facet normals are not used.
    LAM_NORMALS_FILE = 0,
    // Smooth normals, computed even if the file has normals: faces are weighted by area × corner angle, and creases are
    // kept.
    LAM_NORMALS_SMOOTH,
    LAM_NORMALS_FACET, // the triangle's own normal at all three corners
} lam_normals;

struct lam_bytes;

// Opens a file that a model (MTL, texture) or a scene file (a model, a picture) names. `name` is relative to the folder
// of the loaded file and stays inside it. Fills `bytes`. Returns false and fills `error` if the file cannot be read. If
// `error` is LAM_CANNOT_READ, the loader may try other names for a picture or a material file (docs/formats.md).
typedef bool lam_open_fn(void *user, const char *name, struct lam_bytes *bytes, lam_error *error);

// Frees the bytes of a lam_open_fn. The loader calls it once for each opened file.
typedef void lam_release_fn(void *user, struct lam_bytes *bytes);

// Parameters of loading. Zero is the default of each field.
typedef struct lam_load_params {
    // The name of a format as `lambent formats` prints it, such as "obj" or "3mf"; NULL: detected from the content.
    const char *format;
    lam_up up;            // the up axis
    lam_color_mode color; // encoding of the file's colours
    // Scene files only. true: `color` overrides the file's mode. false: the file's mode is used, or `color` if the file
    // states no mode.
    bool override_color;
    lam_normals normals; // the source of normals
    // Angle in radians, 0..π, above which neighbouring faces do not share a computed normal. 0: 40°; for no smoothing
    // at all use LAM_NORMALS_FACET.
    double crease_angle_rad;
    int threads; // number of loading threads; 0: one for each processor
    // Leaves normals that the file does not contain to the CPU device, which computes them for visible triangles in
    // each frame. Drawing a large model once is then faster. lam_mesh.normals stays NULL until lam_scene_make_normals
    // computes all normals. Scene files and other devices do not support this.
    bool normals_when_drawn;
    // Scene files only. true: models and pictures that the scene file names may be in any folder. false: they must be
    // in the scene file's folder or below, after following links. Files that models name stay in the model's folder
    // (see `allowed_paths`).
    bool models_anywhere;
    // Opens the files that a model names. NULL: opens files beside the model; a model in memory then cannot name files.
    lam_open_fn *open;
    // Frees the bytes of `open`. NULL: the loader frees them with lam_bytes_free, so they must come from malloc.
    lam_release_fn *release;
    void *user; // passed to `open` and `release`
    // glTF: the scene to read, by its name or its index (the first is 0). NULL: the file's default scene.
    const char *scene;
    // glTF: the material variant (KHR_materials_variants), by its name or its index (the first is 0). NULL: the
    // materials of the primitives themselves.
    const char *variant;
    // glTF and 3MF only. true: ignores required extensions that this version does not support, and (glTF) omits
    // primitives whose geometry is wrong, with a warning. false: fails with LAM_UNSUPPORTED or LAM_CANNOT_READ.
    bool lenient;
    // glTF: the animation whose pose at `time_s` is shown, by its name or its index (the first is 0). NULL: the pose
    // without animation.
    const char *animation;
    // Seconds, finite. Before the first and after the last key of a channel, the value of that key is used.
    double time_s;
    // OBJ and PLY: marks the edges that splitting polygons into triangles added (lam_mesh.inner_edges), for wireframes.
    bool polygon_edges;
    // STEP, IGES and BREP: computes lam_mesh.exact_area and exact_volume, which may take longer than the triangles.
    bool measure;
    // Folders and files that a model or a scene file may refer to, in addition to its own folder. Without them, a name
    // that leads out of that folder, such as "../textures/wood.png", is reduced to its last component.
    const char *const *allowed_paths;
    int allowed_path_count; // number of allowed_paths
    // STEP, IGES and BREP: the largest distance between the triangles and the exact surface, as a fraction of the
    // model's diagonal, 1e-6..0.1. 0: 1/4000, a quarter of a pixel in a picture of 1024×1024 pixels.
    double deflection;
    LAM_RESERVED(7);
} lam_load_params;

// Loads a model file into a new scene: its meshes, materials and lights, and an object for each mesh. If everything is
// fully transparent, materials and colours become opaque, with a warning. `params` and `control` may be NULL. The
// caller frees the scene. Returns NULL on failure: LAM_CANNOT_READ, LAM_UNSUPPORTED, LAM_LIMIT, LAM_CANCELLED.
LAM_API lam_scene *lam_scene_load(const char *path, const lam_load_params *params, const lam_control *control,
                                  lam_error *error);

// Loads a model from memory. Messages contain `name`, and the extension of `name` helps to detect the format. `name`
// may be NULL. The bytes are not needed after the call.
LAM_API lam_scene *lam_scene_load_memory(const void *bytes, size_t size, const char *name,
                                         const lam_load_params *params, const lam_control *control, lam_error *error);

// These functions describe the readable model format with this index (from 0): the name ("obj"), and the file
// extensions, separated by blanks ("obj"). The strings are static. The functions return NULL if the index is out of
// range.
LAM_API const char *lam_model_format_name(int format);
LAM_API const char *lam_model_format_extensions(int format);

// Returns the package that reads the format: "lambent-formats", or NULL if the library itself reads the format. Such a
// format is read by the program lambent-import, in a process of its own. Sets *installed (may be NULL) to whether this
// version can read the format now.
LAM_API const char *lam_model_format_package(int format, bool *installed);

// Prepares a process that will lose the right to run programs (a sandbox): starts a small process that runs
// lambent-import for it. Must be called before the process starts threads. Returns the socket to which loads send
// their requests by sendmsg(2); the process must keep the socket open. Returns −1 if lambent-import is not installed,
// and the same socket if called again. Other processes need not call this function.
LAM_API int lam_import_start(void);

// Computes the normals of every mesh again, as loading would. LAM_NORMALS_FILE changes only meshes without normals.
// `crease_angle_rad` and `threads` are as in lam_load_params; `control` may be NULL. On failure some meshes may have
// new normals and others the old ones. Errors: LAM_LIMIT, LAM_CANCELLED.
LAM_API bool lam_scene_make_normals(lam_scene *scene, lam_normals normals, double crease_angle_rad, int threads,
                                    const lam_control *control, lam_error *error);

// Makes an empty scene with y up. Returns NULL on failure: LAM_LIMIT.
LAM_API lam_scene *lam_scene_make(lam_error *error);
LAM_API void lam_scene_free(lam_scene *scene); // NULL is allowed

// These functions add an item to a scene. Arrays and strings are copied. Each call returns the index of the added
// element, or −1 on failure: LAM_BAD_ARGUMENT (an index out of range, a number out of range or not finite), LAM_LIMIT.
// Smooth normals, with creases at 40°, are computed for a mesh without normals.
LAM_API int lam_scene_add_mesh(lam_scene *scene, const lam_mesh *mesh, lam_error *error);
LAM_API int lam_scene_add_material(lam_scene *scene, const lam_material *material, lam_error *error);
LAM_API int lam_scene_add_light(lam_scene *scene, const lam_light *light, lam_error *error);

// These functions add computed meshes in the same way. The name of a shape is one of lam_shape_name(). `params` and
// `control` may be NULL.
LAM_API int lam_scene_add_shape(lam_scene *scene, const char *shape, const lam_shape_params *params, lam_error *error);
LAM_API int lam_scene_add_parametric(lam_scene *scene, const lam_parametric *surface, const lam_control *control,
                                     lam_error *error);
// Errors in a formula name the column in its text.
LAM_API int lam_scene_add_formula(lam_scene *scene, const lam_formula *formula, const lam_control *control,
                                  lam_error *error);
LAM_API int lam_scene_add_implicit(lam_scene *scene, const lam_implicit *surface, const lam_control *control,
                                   lam_error *error);

// Writes a mesh of triangles as a model file, completely or not at all. The extension of the file name selects the
// format: .obj, .stl (binary) or .ply (binary). The file contains normals and texture coordinates if the format
// supports them, but no materials or colours. `up` is the up axis of the mesh (LAM_UP_AUTO and LAM_UP_FILE: y). OBJ and
// PLY have y up and STL has z up: the coordinates are rotated, so that the file shows the same picture. Errors:
// LAM_BAD_ARGUMENT (no triangles), LAM_UNSUPPORTED (another extension), LAM_CANNOT_WRITE, LAM_LIMIT.
LAM_API bool lam_mesh_save(const lam_mesh *mesh, const char *path, lam_up up, lam_error *error);
// Returns the extension with this index (from 0) that lam_mesh_save supports, without the dot: "obj". Returns NULL past
// the last one.
LAM_API const char *lam_mesh_format(int index);

// The triangles that are culled.
typedef enum lam_cull {
    LAM_CULL_NONE = 0, // none
    LAM_CULL_BACK,     // triangles whose back is visible
    LAM_CULL_FRONT,    // triangles whose front is visible
} lam_cull;

// A mesh placed in the scene. Begin with lam_object_default().
typedef struct lam_object {
    const char *name; // UTF-8; NULL: unnamed
    int mesh;         // index of the mesh
    // From mesh space to world space: affine (last row 0 0 0 1) and invertible.
    lam_mat4 transform;
    int material;      // index of the material; −1: the materials of the mesh's parts
    int back_material; // material index of back faces; −1: as the front
    // true: back faces are lit with the unchanged normal n and the front material; false: with −n.
    bool one_sided;
    lam_cull cull; // the culled side
    bool hidden;   // true: not drawn (lam_scene_hide_object)
    // 1 + the index of the innermost group (lam_scene_group); 0: none
    int group;
    LAM_RESERVED(15);
} lam_object;

// An assembly of a STEP file, or a node of a glTF file above other nodes. A group contains objects and other groups.
typedef struct lam_group {
    const char *name; // UTF-8, not empty
    // 1 + the index of the group that contains this group; 0: none. A parent precedes its groups.
    int parent;
    LAM_RESERVED(4);
} lam_group;

// Returns an object with mesh 0, the identity transform, and −1 for both materials.
LAM_API lam_object lam_object_default(void);

// Adds an object, with the same result and errors as the calls above.
LAM_API int lam_scene_add_object(lam_scene *scene, const lam_object *object, lam_error *error);

// These functions replace the item at `index` with a copy of the given item. They return false on failure:
// LAM_BAD_ARGUMENT (no such index, or as in the calls that add), LAM_LIMIT.
LAM_API bool lam_scene_set_material(lam_scene *scene, int index, const lam_material *material, lam_error *error);
LAM_API bool lam_scene_set_object(lam_scene *scene, int index, const lam_object *object, lam_error *error);
LAM_API bool lam_scene_set_light(lam_scene *scene, int index, const lam_light *light, lam_error *error);

// Replaces a mesh in all objects that show it. The arguments are as in lam_scene_add_mesh. The memory of a mesh that
// this function set is freed when the mesh is replaced or removed, unless the scene has a mark (lam_scene_mark); the
// memory of other meshes is freed with the scene. A scene file cannot store a replaced mesh. Returns false on failure
// and changes nothing: LAM_BAD_ARGUMENT, LAM_LIMIT.
LAM_API bool lam_scene_set_mesh(lam_scene *scene, int index, const lam_mesh *mesh, lam_error *error);

// These functions hide or show an object, or all objects of a mesh. Pictures, boxes and cameras are the same as in a
// scene without the hidden objects; a light in the frame of a hidden object stays there. Counts include hidden objects;
// scene files and exported models omit them. An object is drawn if neither the object nor its mesh is hidden. The
// functions return false on failure: LAM_BAD_ARGUMENT (no such index).
LAM_API bool lam_scene_hide_object(lam_scene *scene, int index, bool hidden, lam_error *error);
LAM_API bool lam_scene_hide_mesh(lam_scene *scene, int index, bool hidden, lam_error *error);

// These functions remove an object, or a mesh with all objects that show it. The indices of later objects or meshes
// decrease by one, and the mesh indices of objects are updated. On failure, the functions return false and change
// nothing: LAM_BAD_ARGUMENT (no such index), LAM_LIMIT.
LAM_API bool lam_scene_remove_object(lam_scene *scene, int index, lam_error *error);
LAM_API bool lam_scene_remove_mesh(lam_scene *scene, int index, lam_error *error);

// Moves the meshes, materials, objects, lights, cameras, warnings and file names of another scene into this scene, behind
// its own, and frees the other scene, even on failure. The environment, the ambient light and the up axis of `scene`
// stay. A scene file cannot describe the result. Returns false on failure: LAM_BAD_ARGUMENT (a scene has sections, a
// mark, or normals that the device computes), LAM_LIMIT. After LAM_LIMIT, only lam_scene_free may be called.
LAM_API bool lam_scene_add_scene(lam_scene *scene, lam_scene *other, lam_error *error);

// Replaces each object that shows several parts by an object for each part, with the part's name, so that parts can be
// hidden and moved alone. A scene file cannot describe the result. Returns false on failure and changes nothing:
// LAM_BAD_ARGUMENT (the scene has sections), LAM_LIMIT.
LAM_API bool lam_scene_split_parts(lam_scene *scene, lam_error *error);

// Removes all lights. The scene's ambient light (lam_scene_set_ambient) stays.
LAM_API void lam_scene_clear_lights(lam_scene *scene);

// Sets the material of a part of a mesh (−1: the default material) in all objects of the mesh. Returns false on
// failure: LAM_BAD_ARGUMENT, LAM_LIMIT.
LAM_API bool lam_scene_set_part_material(lam_scene *scene, int mesh, uint32_t part, int material, lam_error *error);

// These functions return the number of items of each kind.
LAM_API int lam_scene_mesh_count(const lam_scene *scene);
LAM_API int lam_scene_material_count(const lam_scene *scene);
LAM_API int lam_scene_object_count(const lam_scene *scene);
LAM_API int lam_scene_light_count(const lam_scene *scene);

// These functions return an item of a scene. The pointer is valid until the scene is changed or freed. The result is
// NULL if the index is out of range.
LAM_API const lam_mesh *lam_scene_mesh(const lam_scene *scene, int index);
LAM_API const lam_material *lam_scene_material(const lam_scene *scene, int index);
LAM_API const lam_object *lam_scene_object(const lam_scene *scene, int index);
LAM_API const lam_light *lam_scene_light(const lam_scene *scene, int index);
LAM_API const lam_group *lam_scene_group(const lam_scene *scene, int index);

// These functions return the number of triangles, lines, points and vertices over all objects.
LAM_API uint64_t lam_scene_triangle_count(const lam_scene *scene);
LAM_API uint64_t lam_scene_line_count(const lam_scene *scene);
LAM_API uint64_t lam_scene_point_count(const lam_scene *scene);
LAM_API uint64_t lam_scene_vertex_count(const lam_scene *scene);

// Returns the name of the format that the scene was loaded from, or "" for a scene built by a program.
LAM_API const char *lam_scene_format(const lam_scene *scene);

// The treatment of an extension that a glTF file names.
typedef enum lam_extension_support {
    LAM_EXTENSION_READ = 0,  // supported
    LAM_EXTENSION_NO_EFFECT, // known, without effect on the picture
    LAM_EXTENSION_IGNORED,   // known, but ignored
    // Unknown. The file is drawn without it; if it requires the extension, loading must be lenient.
    LAM_EXTENSION_UNKNOWN,
} lam_extension_support;

// An extension that a model's file names.
typedef struct lam_file_extension {
    const char *name;              // "KHR_materials_unlit"
    bool required;                 // whether the file requires it
    lam_extension_support support; // its treatment
    LAM_RESERVED(4);
} lam_file_extension;

// An animation of a model's file.
typedef struct lam_file_animation {
    const char *name; // NULL: unnamed
    // Seconds from 0 to the last key, as the file states them; 0: the file does not state them.
    double length_s;
    int channel_count; // number of channels, which animate one property each
    LAM_RESERVED(4);
} lam_file_animation;

// A picture that a model's file names.
typedef struct lam_file_image {
    const char *name; // NULL: unnamed
    const char *file; // as written; NULL: the picture is inside the model
    // "png", "jpeg": from the model or the file's extension; NULL: unknown.
    const char *format;
    // The textures made from the picture, as colours and as numbers (lam_texture_values). NULL: no material uses the
    // picture in this form, or the picture could not be read.
    const lam_texture *textures[2];
    LAM_RESERVED(4);
} lam_file_image;

// Information about a glTF or 3MF file. For other formats all fields are zero. Names that the file does not contain are
// NULL.
typedef struct lam_file_info {
    const char *version;                  // of the format: "2.0"
    const char *generator;                // the program that wrote the file
    const char *copyright;                // as the file states it
    const char *const *scenes;            // the names of its scenes
    int scene_count;                      // elements of `scenes`
    int scene;                            // index of the scene that was read; −1: none
    const char *const *variants;          // the variants of KHR_materials_variants
    int variant_count;                    // elements of `variants`
    const lam_file_animation *animations; // in the file's order
    int animation_count;                  // elements of `animations`
    const lam_file_image *images;         // in the file's order
    int image_count;                      // elements of `images`
    // In the order of "extensionsUsed", then of "extensionsRequired".
    const lam_file_extension *extensions;
    int extension_count; // elements of `extensions`
    // Metres per unit of length in the file: 1 for glTF, 0.001 for millimetres; 0: the format does not state it.
    double unit_m;
    // The largest memory in bytes of the process that read the file for the library (lambent-formats); 0: there was none.
    uint64_t reader_memory;
    LAM_RESERVED(14);
} lam_file_info;

// Returns information about the file of a loaded scene. The information is valid until the scene is freed. All fields
// are zero for scene files and for scenes built by a program. Returns NULL if the scene is NULL.
LAM_API const lam_file_info *lam_scene_file_info(const lam_scene *scene);

// Returns the bytes of memory of a scene: its arrays, names, lists and textures, shared ones included, without its
// environment. Drawing needs more memory.
LAM_API uint64_t lam_scene_memory(const lam_scene *scene);

// Returns the warning with this index (from 0): one sentence about a problem that did not stop the load. Returns NULL
// if the index is out of range.
LAM_API const char *lam_scene_warning(const lam_scene *scene, int index);

// Returns the path of the file with this index (from 0) that loading tried to open. The model's own path comes first,
// then the files that it names (material libraries, buffers, pictures, the models of a scene file), each once, in
// alphabetical order. Missing files are included, because loading may give another scene once they exist. A path is the
// model's folder plus the name in the file; for files that lam_load_params.open opened, it is the name passed to that
// function. Scenes built by a program have no paths, and models from memory or standard input have no path of their
// own. The strings are valid until the scene is freed. Returns NULL if the index is out of range.
LAM_API const char *lam_scene_file(const lam_scene *scene, int index);

// Adds a warning, which is copied, unless the scene already has the same sentence. A scene keeps at most 64 warnings.
LAM_API void lam_scene_add_warning(lam_scene *scene, const char *text);

// Gets the box around the triangles of all objects, in world space. Returns false and stores zeros for a scene without
// triangles.
LAM_API bool lam_scene_bounds(const lam_scene *scene, lam_vec3 *minimum, lam_vec3 *maximum);

// These functions return the number of cameras in the model's file, and the name of the camera with this index (from 0;
// lam_scene_camera in camera.h). The name is NULL for an unnamed camera or an index out of range. Cameras keep the
// positions of the file; lam_scene_transform does not move them.
LAM_API int lam_scene_camera_count(const lam_scene *scene);
LAM_API const char *lam_scene_camera_name(const lam_scene *scene, int index);

// Returns the index of the camera with this name. If no camera has this name, a name in digits selects the camera with
// this index. Returns −1 if there is no such camera.
LAM_API int lam_scene_find_camera(const lam_scene *scene, const char *name);

// These functions get and set the up axis (LAM_UP_AUTO and LAM_UP_FILE mean y; a value out of range is ignored). The up
// axis rotates the fitted camera, the rig and the environment, but never the coordinates. The front of the model, which
// faces the viewer at azimuth 0, is +Z with x or y up and −Y with z up. A negative axis turns the picture upside down.
LAM_API lam_up lam_scene_up(const lam_scene *scene);
LAM_API void lam_scene_set_up(lam_scene *scene, lam_up up);

// Gets a sphere around the triangles of an object, in the object's own space, or (`object` −1) of the whole scene, in
// world space. The sphere's centre is the centre of the triangles' box, and its radius is the largest distance from
// that centre to a vertex. Returns false and stores zeros if there are no triangles or no such object.
LAM_API bool lam_scene_sphere(const lam_scene *scene, int object, lam_vec3 *centre, double *radius);

// Moves all objects: the transform of each object becomes `transform` × its own. Lights stay, except in the frames of
// the model and of an object. Returns false and changes nothing on failure: LAM_BAD_ARGUMENT (not affine or not
// invertible).
LAM_API bool lam_scene_transform(lam_scene *scene, const lam_mat4 *transform, lam_error *error);

// Rotates all objects, right-handed, about an axis of any nonzero length through the point `centre`.
LAM_API bool lam_scene_rotate(lam_scene *scene, lam_vec3 centre, lam_vec3 axis, double angle_rad, lam_error *error);

// Writes the lights that a rig adds to this scene, at their positions, and returns their number. The call works like
// lam_rig_lights, but resolves LAM_RIG_AUTO. The lights of LAM_RIG_STUDIO differ for curved models and terrains, unless
// the picture has a ground (`ground`).
LAM_API int lam_scene_rig_lights(const lam_scene *scene, lam_rig rig, bool ground, lam_light *lights);

// Makes tangents for every mesh that has texture coordinates and no tangents, with MikkTSpace, which is the basis of
// baked normal maps (M. S. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008). At each corner, ∂p/∂s is
// averaged over the adjacent triangles that are connected by edges and share the orientation of the mapping and the
// position, normal and texture coordinates of the corner, weighted by their angles. The result is unit and
// perpendicular to the normal. If the texture coordinates give no direction, the corner has the tangent of meshes
// without texture coordinates (docs/lighting/threads.md). The call uses the texture coordinates of the normal map of
// the first part that has one, or else the first set. The bitangent points up in the normal map's picture, or else in
// the direction of increasing t. Loading a model does this for meshes with normal maps; drawing does not. `control` may
// be NULL. On failure some meshes may have tangents and others not. Errors: LAM_LIMIT, LAM_CANCELLED.
LAM_API bool lam_scene_make_tangents(lam_scene *scene, const lam_control *control, lam_error *error);

// These functions save the state of the scene, and restore it any number of times: its meshes, materials, objects,
// lights, ambient light and up axis. Environment and warnings are not restored. Use these calls to draw several
// pictures of one model with different options: the model is loaded once, and devices keep their data of the model.
// Elements added after the mark use memory until the scene is freed. A second mark replaces the first. The functions
// return false on failure: LAM_BAD_ARGUMENT (reset without a mark), LAM_LIMIT.
LAM_API bool lam_scene_mark(lam_scene *scene, lam_error *error);
LAM_API bool lam_scene_reset(lam_scene *scene, lam_error *error);

// These functions set and get the scene's ambient light (La_global), which is added to the light of ambient lights.
// Default: 0.
LAM_API void lam_scene_set_ambient(lam_scene *scene, lam_rgb ambient);
LAM_API lam_rgb lam_scene_ambient(const lam_scene *scene);

// Sets the environment, which lights all materials: classic materials are converted by lam_material_as_physical, unless
// lam_draw_params.reflection names a classic model. NULL, the default: none (LAM_RIG_AUTO may add one). `rotation_rad` rotates it about the up axis, counter-clockwise seen from
// above. With y up and no rotation its axes are the world's axes; with another up axis it is rotated like the fitted
// camera, so that its top points up. The scene keeps a reference: the caller may free its own. Returns false on
// failure: LAM_BAD_ARGUMENT (no scene, a rotation that is not finite).
LAM_API bool lam_scene_set_environment(lam_scene *scene, const lam_environment *environment, double rotation_rad,
                                       lam_error *error);

// Works like lam_scene_set_environment, but classic materials only mirror the environment by their reflectivity, as the
// lectures describe; the lights or the rig light them. The scene has one environment: a later call of one of the two
// functions replaces it.
LAM_API bool lam_scene_set_reflection_map(lam_scene *scene, const lam_environment *environment, double rotation_rad,
                                          lam_error *error);

// Returns whether the environment was set by lam_scene_set_reflection_map.
LAM_API bool lam_scene_has_reflection_map(const lam_scene *scene);

// Returns the environment, or NULL if there is none.
LAM_API const lam_environment *lam_scene_environment(const lam_scene *scene);

// Sets the material of parts that name no material. Initially, this is lam_material_default(). Returns false for the
// same reasons as lam_scene_add_material.
LAM_API bool lam_scene_set_default_material(lam_scene *scene, const lam_material *material, lam_error *error);
LAM_API const lam_material *lam_scene_default_material(const lam_scene *scene);

// Gets the time that loading took, in milliseconds: reading and parsing the file, and preparing the scene (normals,
// bounds).
LAM_API void lam_scene_times(const lam_scene *scene, double *read_ms, double *prepare_ms);

#ifdef __cplusplus
}
#endif
#endif
