// scene_internal.h: the inside of lam_scene, for importers, shapes and the frame.
#ifndef SCENE_INTERNAL_H
#define SCENE_INTERNAL_H

#include "arena.h"
#include "aabb_tree.h"
#include "pool.h"
#include "call_control.h"

#include <lambent/scene_file.h>

// A growing array in an arena: doubling leaves the old half behind in the arena until the scene goes.
struct scene_list {
    void *items;
    int count, room;
};

// What a mesh's triangles span, and whether any of its colours has an alpha below 1. `used` lists the vertices that
// triangles refer to, in order; NULL: all of them.
struct scene_extent {
    lam_vec3 minimum, maximum; // mesh coordinates, origin included
    const uint32_t *used;
    uint32_t used_count;
    struct aabb_tree boxes; // of those vertices
    bool translucent;
};

// Where meshes came from, for writing them as a scene file: a model file or a built-in shape, and how it was read.
struct scene_origin {
    const char *path;  // as it can be opened from here; NULL: a shape, or bytes in memory
    const char *shape; // its name; NULL: a file
    lam_shape_params segments;
    lam_normals normals;
    double crease_angle_rad; // 0: the default
    bool field_tangents;     // the file's tangents were left out
    int first_mesh, mesh_count;
    int first_material, material_count;
    const lam_material *materials; // as the file had them
    const lam_object *objects;     // as the file had them, object_count, in order
    int object_count;
    const int *part_materials; // of all parts of its meshes, in order: the material as the file had it
    int part_count;
};

// Stands for a scene in the caches of devices: whoever holds it knows that no other scene has the same one,
// though another may come to lie at the same address, and sees when it is gone.
struct scene_token {
    int references; // touched atomically
    int gone;       // likewise: the scene was freed
};

struct lam_scene {
    struct arena arena;
    struct scene_token *token;
    struct scene_list meshes;             // lam_mesh
    struct scene_list extents;            // struct scene_extent, one for each measured mesh, in the same order
    struct scene_list materials;          // lam_material
    struct scene_list objects;            // lam_object
    struct scene_list lights;             // lam_light
    struct scene_list warnings;           // const char *
    struct scene_list origins;            // struct scene_origin, in the order of their meshes
    const lam_picture_settings *settings; // of a scene file; NULL: none
    lam_up up;
    lam_mat4 placement; // what lam_scene_transform did so far
    lam_rgb ambient;
    lam_material default_material;   // of parts that name none
    lam_environment *environment;    // shared with others; NULL: none
    double environment_rotation_rad; // about the up axis
    lam_color_mode color;            // what the file's colours were read as
    const char *format;
    double read_ms, prepare_ms;
    // meshes without normals get theirs from the device that draws them, creased at this angle; 0: there are none
    double deferred_crease_rad;
};

// As lam_scene_make, charging `call` (may be NULL) while the scene is being built; scene_built ends that.
struct lam_scene *scene_make(struct call_control *call, lam_error *error);
void scene_built(struct lam_scene *scene);

struct scene_token *scene_token_hold(struct scene_token *token);
void scene_token_release(struct scene_token *token); // NULL is fine

// Take what already lies in the scene's arena, without copying and without making normals. Return the index, −1 when
// memory is out.
int scene_take_mesh(struct lam_scene *scene, const lam_mesh *mesh, lam_error *error);
int scene_take_material(struct lam_scene *scene, const lam_material *material, lam_error *error);
int scene_take_object(struct lam_scene *scene, const lam_object *object, lam_error *error);
int scene_take_light(struct lam_scene *scene, const lam_light *light, lam_error *error);

// Appends one item of a list; its index, −1 when memory is out.
int scene_append(struct lam_scene *scene, struct scene_list *list, const void *item, size_t size, lam_error *error);

// Adds a warning, formatted. At most SCENE_WARNINGS_MAX are kept; the last one then says that more follow.
enum { SCENE_WARNINGS_MAX = 64 };
void scene_warn(struct lam_scene *scene, const char *format, ...) __attribute__((format(printf, 2, 3)));

// Notes where the meshes and materials from these numbers on came from. False when memory is out.
bool scene_note_origin(struct lam_scene *scene, struct scene_origin origin, int first_object, lam_error *error);

// A built-in shape as a new mesh, charged to the scene's own watch. Its index, −1 on failure.
int scene_add_shape(struct lam_scene *scene, const char *shape, const lam_shape_params *params,
                    struct call_control *call, lam_error *error);

// Makes every mesh ready to draw: normals where they are missing or asked for, degenerate ones told.
bool scene_prepare(struct lam_scene *scene, lam_normals normals, double crease_angle_rad, struct pool *pool,
                   struct call_control *call, lam_error *error);
// The same, but leaves smooth normals to the device.
void scene_defer_normals(struct lam_scene *scene, lam_normals normals, double crease_angle_rad);

// Works out the extents of meshes that have none yet; every public call that adds meshes ends with it, so that readers
// never write. False when memory is out.
bool scene_measure(struct lam_scene *scene, struct pool *pool, lam_error *error);

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

#endif
