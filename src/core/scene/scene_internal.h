// scene_internal.h: internals of lam_scene, for importers, shapes and the frame.
#ifndef SCENE_INTERNAL_H
#define SCENE_INTERNAL_H

#include "arena.h"
#include "aabb_tree.h"
#include "pool.h"
#include "texture_map.h"
#include "call_control.h"

#include <lambent/scene_file.h>
#include <lambent/section.h>

// A growing array in an arena. The outgrown arrays are kept until the scene is freed.
struct scene_list {
    void *items;
    int count, capacity;
};

// The bounds of a mesh's triangles, lines or points.
struct scene_extent {
    lam_vec3 minimum, maximum; // in mesh coordinates, including the origin
    // The vertices that triangles use, in order; NULL means all vertices.
    const uint32_t *used;
    uint32_t used_count;
    struct aabb_tree boxes; // tree of bounding boxes of the used vertices
    bool translucent;       // at least one colour has an alpha below 1
    struct arena *own;      // owner of the arrays of the mesh and of this extent; NULL means the scene's arena
};

// The source of meshes: a model file, a built-in shape or a formula, with its load parameters. Needed to write a scene
// file.
struct scene_origin {
    const char *path;           // path of the file; NULL means a shape, a formula, or a file from memory
    const char *shape;          // name of the shape, or NULL
    const lam_formula *formula; // may be NULL
    lam_shape_params segments;
    lam_normals normals;
    double crease_angle_rad; // 0 means the default
    bool field_tangents;     // the tangents of the file were discarded
    // As in lam_load_params, for glTF files; NULL means the file's default.
    const char *scene, *variant, *animation;
    double time_s;
    int first_mesh, mesh_count;
    int first_material, material_count;
    // Copies of the file's materials, objects and parts' materials, before any change by the program.
    const lam_material *materials;
    const lam_object *objects;
    int object_count;
    const int *part_materials; // the materials of all parts of the meshes, in order
    int part_count;
    // the program replaced or removed a mesh, or removed one of several objects, so a scene file cannot describe the
    // scene
    bool edited;
};

// Identifies a scene in device caches. A token is unique and outlives the scene. The address of the scene is not
// enough, because a later scene may reuse it.
struct scene_token {
    int references; // atomic
    int gone;       // whether the scene was freed; atomic
};

// A camera of the model's file.
struct scene_camera {
    const char *name;  // NULL if unnamed
    lam_camera camera; // if near_plane > 0 and far_plane is 0, there is no far plane
};

// The sections of a scene. The cut meshes are the last of the scene's meshes, in `own`, which also contains this struct.
struct scene_cut {
    lam_section sections[LAM_SECTIONS_MAX];
    lam_section placed[LAM_SECTIONS_MAX]; // in world space, not relative, with unit normals
    double areas[LAM_SECTIONS_MAX];
    int count;
    struct arena *own;
    bool kept;             // lam_scene_reset may restore these sections, so the memory is freed with the scene
    lam_object *objects;   // the whole objects
    int object_count;      // their number
    int meshes, materials; // their numbers before the cut
    int all;               // the number of meshes and materials after the cut
    uint64_t items;        // lam_scene.object_items before the cut
};

struct lam_scene {
    struct arena arena;
    struct scene_token *token;
    struct scene_list meshes;    // lam_mesh
    struct scene_list extents;   // struct scene_extent: one element for each measured mesh, in the order of the meshes
    struct scene_list materials; // lam_material
    struct scene_list objects;   // lam_object
    struct scene_list groups;    // lam_group
    struct scene_list lights;    // lam_light
    struct scene_list cameras;   // struct scene_camera
    struct scene_list textures;  // lam_texture *: each element is one reference
    struct scene_list kept;      // struct arena *: memory of meshes that lam_scene_reset may restore
    struct scene_list warnings;  // const char *
    struct scene_list files;     // const char *: paths
    struct scene_list origins;   // struct scene_origin, in the order of their meshes
    // The number of fully transparent materials in MTL files, and a message that names the first of them and its
    // position. The message is NULL if there is no such material.
    int clear_materials;
    const char *first_clear;
    const lam_picture_settings *settings; // the settings of a scene file; NULL for other files
    lam_up up;
    lam_mat4 placement; // the product of all lam_scene_transform calls
    // the transform that a scene file gives to its first model, in the arena; NULL for other files, and if there is none
    const lam_mat4 *first_transform;
    lam_rgb ambient;
    lam_material *default_material;  // for parts without a material
    lam_environment *environment;    // may be shared with other scenes; NULL if there is none
    double environment_rotation_rad; // rotation about the up axis
    bool reflection_map;             // lam_scene_set_reflection_map has set the environment
    struct lazy_environment *studio; // the built-in studio environment (scene_lit_by_environment)
    lam_color_mode color;            // the encoding of the file's colours
    const char *format;
    lam_file_info file; // information about a glTF file
    double read_ms, prepare_ms;
    uint64_t input_bytes;  // total size in bytes of the files that the scene was read from, or 0
    uint64_t object_items; // triangles, lines and points of all added objects
    // The crease angle of meshes whose normals the device computes; 0 means that all meshes have normals.
    double deferred_crease_rad;
    uint64_t *known_form;    // the form, and a hash of the objects that it was found for; atomic
    struct scene_mark *mark; // the state for lam_scene_reset, or NULL
    struct scene_cut *cut;   // NULL: no sections
    bool shared_arrays;      // meshes may share arrays, so no array is changed in place
    bool first_all_used;     // the importer of the first mesh knows that triangles use every vertex
    bool normals_missing;    // before scene_repair, an index of a normal may be UINT32_MAX: the corner has no normal
};

// Works like lam_scene_make, but allocations count towards the limit of `call` (may be NULL) until scene_built is
// called.
struct lam_scene *scene_make(struct call_control *call, lam_error *error);
void scene_built(struct lam_scene *scene);

// Returns whether the environment lights a scene instead of a rig. The scene contains no lights. Either the scene has an
// environment that lights all materials, or it contains at least one lit physical and no lit classic material. Without an
// environment, the built-in studio environment then lights the scene.
bool scene_lit_by_environment(const struct lam_scene *scene);

// Returns whether the rig of a scene without lights may depend on the scene's form (scene_form).
bool scene_needs_form(const struct lam_scene *scene);

struct scene_token *scene_token_make(lam_error *error); // NULL if memory runs out
struct scene_token *scene_token_hold(struct scene_token *token);
void scene_token_release(struct scene_token *token); // `token` may be NULL

// These functions add an item whose arrays and strings are already in the scene's arena. These functions neither copy
// the arrays nor compute normals. They return the index of the item, or −1 with LAM_LIMIT if memory runs out or a load
// exceeds the call's triangle limit.
int scene_adopt_mesh(struct lam_scene *scene, const lam_mesh *mesh, lam_error *error);
int scene_adopt_material(struct lam_scene *scene, const lam_material *material, lam_error *error);
int scene_adopt_object(struct lam_scene *scene, const lam_object *object, lam_error *error);
int scene_adopt_light(struct lam_scene *scene, const lam_light *light, lam_error *error);

// Adds a reference to a texture that one of the scene's materials uses. The scene releases the reference when it is
// freed. Returns false if memory runs out.
bool scene_share_texture(struct lam_scene *scene, const lam_texture *texture, lam_error *error);
// Takes over the caller's reference to a texture, even on failure.
bool scene_adopt_texture(struct lam_scene *scene, lam_texture *texture, lam_error *error);

// Appends an item to a list in an arena. Returns false if memory runs out.
bool scene_list_append(struct scene_list *list, const void *item, size_t size, struct arena *arena);
// Appends an item to a list of the scene. Returns the item's index, or −1 if memory runs out.
int scene_append(struct lam_scene *scene, struct scene_list *list, const void *item, size_t size, lam_error *error);

// Adds a formatted warning. At most SCENE_WARNINGS_MAX warnings are kept; the last one says that others were omitted.
enum { SCENE_WARNINGS_MAX = 64 };
void scene_warn(struct lam_scene *scene, const char *format, ...) __attribute__((format(printf, 2, 3)));

// Counts a fully transparent material, and keeps the message about the first one. At the end of the load,
// show_clear_scene warns about these materials.
void scene_note_clear(struct lam_scene *scene, const char *format, ...) __attribute__((format(printf, 2, 3)));

// Records the origin of the meshes and materials that begin at origin.first_mesh and origin.first_material. Returns
// false if memory runs out.
bool scene_note_origin(struct lam_scene *scene, struct scene_origin origin, int first_object, lam_error *error);

// Adds a built-in shape as a mesh. The memory counts towards the limit of the call of the scene's arena. Returns the
// mesh's index, or −1 on failure.
int scene_add_shape(struct lam_scene *scene, const char *shape, const lam_shape_params *params,
                    struct call_control *call, lam_error *error);
int scene_add_formula(struct lam_scene *scene, const lam_formula *formula, struct call_control *call, lam_error *error);

// Prepares every mesh for drawing: computes missing normals, or all normals if `normals` requests that.
bool scene_prepare(struct lam_scene *scene, lam_normals normals, double crease_angle_rad, struct pool *pool,
                   struct call_control *call, lam_error *error);
// Prepares every mesh for drawing, but leaves smooth normals to the device.
void scene_defer_normals(struct lam_scene *scene, lam_normals normals, double crease_angle_rad);

// Returns whether at least one mesh has no tangents, although the mesh's material uses a normal map.
bool scene_needs_tangents(const struct lam_scene *scene);

// Checks a mesh, copies it to the scene's arena and computes its missing normals. Fails with LAM_BAD_ARGUMENT or
// LAM_LIMIT.
bool scene_copy_mesh(struct lam_scene *scene, const lam_mesh *mesh, lam_mesh *copy, lam_error *error);
// Computes the extent of one mesh. If the mesh is far from zero, also makes the positions relative to an origin.
bool scene_measure_mesh(struct lam_scene *scene, lam_mesh *mesh, struct scene_extent *extent, struct pool *pool,
                        lam_error *error);
// Cuts the objects (src/formats/section); the caller has checked the arguments.
bool scene_cut(struct lam_scene *scene, const lam_section *sections, int count, struct call_control *call,
               lam_error *error);
// Restores the whole objects. Returns false if memory runs out.
bool scene_uncut(struct lam_scene *scene, lam_error *error);
// Makes device caches forget the meshes, because their memory is freed.
void scene_change_token(struct lam_scene *scene, struct scene_token *token);

// Makes the scene keep the memory of all meshes until the scene is freed, because lam_scene_reset may restore these
// meshes. Returns false if memory runs out.
bool scene_keep_meshes(struct lam_scene *scene, lam_error *error);

// Computes the extents of new meshes, and gives distant meshes an origin (origin.h), which changes their positions in
// place. Every public function that adds meshes calls scene_measure at its end, so that functions that only read a
// scene never change it. Returns false if memory runs out.
bool scene_measure(struct lam_scene *scene, struct pool *pool, lam_error *error);

// Returns the largest distance of a used vertex from a point, in world space.
double scene_radius(const struct lam_scene *scene, lam_vec3 centre);

// Properties of the surface of the visible objects, from the points of a lattice (surface_lattice.h). They depend
// neither on the order of the triangles nor on their number.
struct surface_facts {
    lam_vec3 facing; // the sum of all area vectors, divided by the sum of their lengths
    double fullest;  // the fraction of the area in the six directions with the most area
    double detail;   // the number of planes per point of the lattice, 0..1
};
struct surface_facts surface_facts(const struct lam_scene *scene, struct pool *pool);

// The form of a scene, which determines the lights of the studio.
enum scene_form {
    FORM_FLAT,    // a few flat faces contain most of the area, as in machine parts; or the scene has few faces
    FORM_CURVED,  // the normals differ everywhere, as in scans
    FORM_TERRAIN, // an open surface with slopes; most of its area faces up
};

// These functions return the form of the visible objects, and whether their faces are too small to be visible. The
// results are the same on every computer, and in each frame of an animation. `scene` may be NULL.
enum scene_form scene_form(const struct lam_scene *scene);
bool scene_is_fine(const struct lam_scene *scene);
// Computes these results with the threads of a pool. The scene keeps them until its objects change.
int scene_find_form(const struct lam_scene *scene, struct pool *pool);

// Returns whether a mesh consists of lines or points. Functions that compute normals or follow surfaces skip such
// meshes.
static inline bool mesh_is_strokes(const lam_mesh *mesh) { return mesh->line_count || mesh->point_count; }

// These functions return the number of triangles, lines or points, and the number of their corners.
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

// Returns the element of an attribute at a corner. `own` is the attribute's index array; if it is NULL, the mesh's
// indices are used.
static inline uint32_t mesh_element(const uint32_t *own, const lam_mesh *mesh, size_t corner)
{
    return own ? own[corner] : mesh->indices ? mesh->indices[corner] : (uint32_t)corner;
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
// Returns whether an object is drawn: neither the object nor its mesh is hidden.
static inline bool scene_shows(const struct lam_scene *scene, int i)
{
    return !scene_object(scene, i)->hidden && !scene_mesh(scene, scene_object(scene, i)->mesh)->hidden;
}

#endif
