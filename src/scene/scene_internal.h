// scene_internal.h: internals of lam_scene, for importers, shapes and the frame.
#ifndef SCENE_INTERNAL_H
#define SCENE_INTERNAL_H

#include "arena.h"
#include "aabb_tree.h"
#include "pool.h"
#include "texture_map.h"
#include "call_control.h"

#include <lambent/scene_file.h>

// A growing array in an arena, which keeps the outgrown arrays until the scene is freed.
struct scene_list {
    void *items;
    int count, capacity;
};

// Bounds of a mesh's triangles, lines or points.
struct scene_extent {
    lam_vec3 minimum, maximum; // mesh coordinates, origin included
    // The vertices that triangles refer to, in order; NULL: all vertices.
    const uint32_t *used;
    uint32_t used_count;
    struct aabb_tree boxes; // of the used vertices
    bool translucent;       // some colour has an alpha below 1
    struct arena *own;      // of the mesh's arrays and this extent's; NULL: they are in the scene's arena
};

// The source of meshes, for writing a scene file: a model file, a built-in shape or a formula, and the parameters it was
// read with.
struct scene_origin {
    const char *path;           // that opens the file; NULL: a shape, a formula, or a file from memory
    const char *shape;          // its name; NULL: none
    const lam_formula *formula; // NULL: none
    lam_shape_params segments;
    lam_normals normals;
    double crease_angle_rad; // 0: the default
    bool field_tangents;     // the file's tangents were dropped
    // Of a glTF file, as in lam_load_params; NULL: the file's own choice.
    const char *scene, *variant, *animation;
    double time_s;
    int first_mesh, mesh_count;
    int first_material, material_count;
    // Copies of the file's materials, objects and parts' materials, before any change by the program.
    const lam_material *materials;
    const lam_object *objects;
    int object_count;
    const int *part_materials; // of all parts of the meshes, in order
    int part_count;
    bool edited; // a mesh was replaced or removed, or one of several objects removed: a scene file cannot name the rest
};

// Identifies a scene in the caches of devices. A token is unique, unlike the scene's address, which a later scene may
// reuse, and it outlives the scene.
struct scene_token {
    int references; // atomic
    int gone;       // atomic; the scene was freed
};

// A camera of the model's file.
struct scene_camera {
    const char *name;  // NULL: unnamed
    lam_camera camera; // near_plane > 0 and far_plane 0: it sees infinitely far
};

struct lam_scene {
    struct arena arena;
    struct scene_token *token;
    struct scene_list meshes;    // lam_mesh
    struct scene_list extents;   // struct scene_extent, one for each measured mesh, in the same order
    struct scene_list materials; // lam_material
    struct scene_list objects;   // lam_object
    struct scene_list lights;    // lam_light
    struct scene_list cameras;   // struct scene_camera
    struct scene_list textures;  // lam_texture *: one reference each
    struct scene_list kept;      // struct arena *: of meshes that the mark may bring back
    struct scene_list warnings;  // const char *
    struct scene_list files;     // const char *: paths
    struct scene_list origins;   // struct scene_origin, in the order of their meshes
    // Materials of MTL files that are fully transparent, and a sentence about the first one, with its place; NULL: none.
    int clear_materials;
    const char *first_clear;
    const lam_picture_settings *settings; // of a scene file; NULL: none
    lam_up up;
    lam_mat4 placement; // the product of all lam_scene_transform calls
    lam_rgb ambient;
    lam_material default_material;   // of parts without a material
    lam_environment *environment;    // shared with others; NULL: none
    double environment_rotation_rad; // about the up axis
    struct lazy_environment *studio; // the light if there is no other (scene_lit_by_environment)
    lam_color_mode color;            // the interpretation of the file's colours
    const char *format;
    lam_file_info file; // of a glTF file
    double read_ms, prepare_ms;
    uint64_t input_bytes;  // of the files that it was read from; 0: none
    uint64_t object_items; // triangles, lines and points of all objects that were added
    // The crease angle of meshes whose normals are left to the device; 0: all meshes have normals.
    double deferred_crease_rad;
    struct scene_mark *mark; // the state of lam_scene_reset; NULL: none
    bool shared_arrays;      // meshes may have arrays in common: none is changed in place
};

// As lam_scene_make, but allocations are charged to `call` (may be NULL) until scene_built.
struct lam_scene *scene_make(struct call_control *call, lam_error *error);
void scene_built(struct lam_scene *scene);

// Returns whether a scene has no lights, and a lit physical material of its own: the environment is then its light, or
// without one the built-in studio, in place of a rig.
bool scene_lit_by_environment(const struct lam_scene *scene);

struct scene_token *scene_token_make(lam_error *error); // NULL: out of memory
struct scene_token *scene_token_hold(struct scene_token *token);
void scene_token_release(struct scene_token *token); // `token` may be NULL

// Add an item whose arrays and strings are in the scene's arena, without copying them and without computing normals.
// Return its index; −1: LAM_LIMIT: out of memory, or while loading more triangles than the call may have.
int scene_adopt_mesh(struct lam_scene *scene, const lam_mesh *mesh, lam_error *error);
int scene_adopt_material(struct lam_scene *scene, const lam_material *material, lam_error *error);
int scene_adopt_object(struct lam_scene *scene, const lam_object *object, lam_error *error);
int scene_adopt_light(struct lam_scene *scene, const lam_light *light, lam_error *error);

// Makes the scene share a texture that a material of it names: it is freed with the scene. Returns false if memory runs
// out.
bool scene_share_texture(struct lam_scene *scene, const lam_texture *texture, lam_error *error);
// The same for a reference that the caller has and gives away, also on failure.
bool scene_adopt_texture(struct lam_scene *scene, lam_texture *texture, lam_error *error);

// Appends an item to a list. Returns its index; −1: out of memory.
int scene_append(struct lam_scene *scene, struct scene_list *list, const void *item, size_t size, lam_error *error);

// Adds a warning, formatted. At most SCENE_WARNINGS_MAX are kept; the last of them says that others are omitted.
enum { SCENE_WARNINGS_MAX = 64 };
void scene_warn(struct lam_scene *scene, const char *format, ...) __attribute__((format(printf, 2, 3)));

// Counts a fully transparent material; the sentence of the first one is kept. The load ends with a warning of them.
void scene_note_clear(struct lam_scene *scene, const char *format, ...) __attribute__((format(printf, 2, 3)));

// Records the origin of the meshes and materials from origin.first_… on. Returns false if memory runs out.
bool scene_note_origin(struct lam_scene *scene, struct scene_origin origin, int first_object, lam_error *error);

// Adds a built-in shape as a mesh, charged to the call of the scene's arena. Returns its index; −1 on failure.
int scene_add_shape(struct lam_scene *scene, const char *shape, const lam_shape_params *params,
                    struct call_control *call, lam_error *error);
int scene_add_formula(struct lam_scene *scene, const lam_formula *formula, struct call_control *call, lam_error *error);

// Prepares every mesh for drawing: computes normals that are missing, or all of them if `normals` asks for it.
bool scene_prepare(struct lam_scene *scene, lam_normals normals, double crease_angle_rad, struct pool *pool,
                   struct call_control *call, lam_error *error);
// The same, but leaves smooth normals to the device.
void scene_defer_normals(struct lam_scene *scene, lam_normals normals, double crease_angle_rad);

// Returns whether some mesh has a material with a normal map and no tangents.
bool scene_needs_tangents(const struct lam_scene *scene);

// Gives surfaces with colours of their own and no material a white one, so that they reflect their colours; the neutral
// grey would darken them. For a scene that was just read. Returns false if memory runs out.
bool scene_give_colors_white(struct lam_scene *scene, lam_error *error);
// Gives MikkTSpace's tangents to each such mesh, or with `all` to every mesh, that has normals, texture coordinates and
// no tangents, for the texture coordinates of the normal map. Charged to `call`.
bool scene_make_tangents(struct lam_scene *scene, bool all, struct call_control *call, lam_error *error);

// Checks a mesh, copies it to the scene's arena and makes the normals that it lacks. False: LAM_BAD_ARGUMENT, LAM_LIMIT.
bool scene_copy_mesh(struct lam_scene *scene, const lam_mesh *mesh, lam_mesh *copy, lam_error *error);
// The extent of one mesh; may give the mesh an origin.
bool scene_measure_mesh(struct lam_scene *scene, lam_mesh *mesh, struct scene_extent *extent, struct pool *pool,
                        lam_error *error);
// From now on the scene frees the memory of meshes only with itself: a mark may bring them back. False: out of memory.
bool scene_keep_meshes(struct lam_scene *scene, lam_error *error);

// Computes the extents of new meshes, and gives distant meshes an origin (origin.h), which changes their positions in
// place. Every public function that adds meshes ends with it, so that read access never writes. Returns false if memory
// runs out.
bool scene_measure(struct lam_scene *scene, struct pool *pool, lam_error *error);

// Returns the largest distance of a triangle's vertex from a point, in world space.
double scene_radius(const struct lam_scene *scene, lam_vec3 centre);

// Returns whether a mesh consists of lines or points: functions that make normals or follow surfaces skip it.
static inline bool mesh_is_strokes(const lam_mesh *mesh) { return mesh->line_count || mesh->point_count; }

// Returns the number of triangles, of lines or of points, and of their corners.
static inline uint32_t mesh_items(const lam_mesh *mesh)
{
    return mesh->line_count ? mesh->line_count : mesh->point_count ? mesh->point_count : mesh->triangle_count;
}
static inline size_t mesh_corners(const lam_mesh *mesh)
{
    return mesh->line_count    ? (size_t)mesh->line_count * 2
           : mesh->point_count ? mesh->point_count
                               : (size_t)mesh->triangle_count * 3;
}

static inline const lam_mesh *scene_mesh(const struct lam_scene *scene, int i)
{
    return (const lam_mesh *)scene->meshes.items + i;
}
static inline const struct scene_extent *scene_extent(const struct lam_scene *scene, int i)
{
    return (const struct scene_extent *)scene->extents.items + i;
}
static inline const lam_object *scene_object(const struct lam_scene *scene, int i)
{
    return (const lam_object *)scene->objects.items + i;
}
// Whether an object is drawn: neither it nor its mesh is hidden.
static inline bool scene_shows(const struct lam_scene *scene, int i)
{
    return !scene_object(scene, i)->hidden && !scene_mesh(scene, scene_object(scene, i)->mesh)->hidden;
}

#endif
