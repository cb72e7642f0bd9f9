// scene_edit.c: replaces, hides and removes meshes and objects of a scene.
#include "scene_internal.h"

#include "fail.h"
#include "float_state.h"

#include <string.h>

static bool check_index(const lam_scene *scene, const char *kind, int index, int count, lam_error *error)
{
    if (!scene)
        return fail(error, LAM_BAD_ARGUMENT, "%s: the scene is NULL", kind);
    return (index >= 0 && index < count) || fail(error, LAM_BAD_ARGUMENT, "%s: %d of %d", kind, index, count);
}

static void remove_item(struct scene_list *list, int index, size_t size)
{
    char *at = (char *)list->items + (size_t)index * size;
    memmove(at, at + size, (size_t)(--list->count - index) * size);
}

bool scene_keep_meshes(struct lam_scene *scene, lam_error *error)
{
    for (int i = 0; i < scene->extents.count; i++) {
        struct scene_extent *extent = (struct scene_extent *)scene->extents.items + i;
        if (extent->own && scene_append(scene, &scene->kept, &extent->own, sizeof extent->own, error) < 0)
            return false;
        extent->own = NULL;
    }
    return true;
}

// The arrays of a new mesh may be at the addresses of freed arrays. A new token prevents device caches from confusing
// the new mesh with the old mesh.
void scene_change_token(struct lam_scene *scene, struct scene_token *token)
{
    __atomic_store_n(&scene->token->gone, 1, __ATOMIC_RELEASE);
    scene_token_release(scene->token);
    scene->token = token;
}

static struct scene_origin *origin_with(const struct lam_scene *scene, int mesh)
{
    for (int i = 0; i < scene->origins.count; i++) {
        struct scene_origin *origin = (struct scene_origin *)scene->origins.items + i;
        if (mesh >= origin->first_mesh && mesh < origin->first_mesh + origin->mesh_count)
            return origin;
    }
    return NULL;
}

static void note_edit(const struct lam_scene *scene, int mesh)
{
    struct scene_origin *origin = origin_with(scene, mesh);
    if (origin)
        origin->edited = true;
}

// Copies a mesh into its own arena and computes its extent. Returns false on error; the arena can then be discarded.
static bool build_mesh(lam_scene *scene, const lam_mesh *mesh, struct arena *own, lam_mesh *copy,
                       struct scene_extent *extent, lam_error *error)
{
    struct arena whole = scene->arena; // the steps below allocate from the scene's arena
    scene->arena = *own;
    uint64_t state = float_state_enter();
    bool ok = scene_copy_mesh(scene, mesh, copy, error) && scene_measure_mesh(scene, copy, extent, NULL, error);
    float_state_leave(state);
    *own = scene->arena;
    scene->arena = whole;
    return ok;
}

bool lam_scene_set_mesh(lam_scene *scene, int index, const lam_mesh *mesh, lam_error *error)
{
    if (!check_index(scene, "mesh", index, lam_scene_mesh_count(scene), error))
        return false;
    if (!mesh)
        return fail(error, LAM_BAD_ARGUMENT, "mesh: the mesh is NULL");
    struct arena *own = arena_new(NULL);
    struct scene_token *token = own ? scene_token_make(error) : NULL;
    struct scene_extent extent;
    lam_mesh copy;
    bool ok = own ? token != NULL : fail_memory(error, sizeof *own);
    ok = ok && build_mesh(scene, mesh, own, &copy, &extent, error);
    ok = ok && (!scene->mark || scene_append(scene, &scene->kept, &own, sizeof own, error) >= 0);
    if (!ok) {
        arena_delete(own);
        scene_token_release(token);
        return false;
    }
    extent.own = scene->mark ? NULL : own;
    struct scene_extent *place = (struct scene_extent *)scene->extents.items + index;
    arena_delete(place->own);
    *place = extent;
    ((lam_mesh *)scene->meshes.items)[index] = copy;
    note_edit(scene, index);
    scene_change_token(scene, token);
    return true;
}

bool lam_scene_hide_object(lam_scene *scene, int index, bool hidden, lam_error *error)
{
    if (!check_index(scene, "object", index, lam_scene_object_count(scene), error))
        return false;
    ((lam_object *)scene->objects.items)[index].hidden = hidden;
    return true;
}

bool lam_scene_hide_mesh(lam_scene *scene, int index, bool hidden, lam_error *error)
{
    if (!check_index(scene, "mesh", index, lam_scene_mesh_count(scene), error))
        return false;
    ((lam_mesh *)scene->meshes.items)[index].hidden = hidden;
    return true;
}

// The whole objects and the cut ones have the same indices, so neither may be removed.
static bool check_whole(const lam_scene *scene, lam_error *error)
{
    return !scene->cut || fail(error, LAM_BAD_ARGUMENT, "the scene has sections; remove them first");
}

static void remove_object(lam_scene *scene, int index)
{
    const int mesh = scene_object(scene, index)->mesh;
    struct scene_origin *origin = origin_with(scene, mesh);
    if (origin && origin->object_count > 1)
        origin->edited = true;
    scene->object_items -= mesh_items(scene_mesh(scene, mesh));
    remove_item(&scene->objects, index, sizeof(lam_object));
}

bool lam_scene_remove_object(lam_scene *scene, int index, lam_error *error)
{
    if (!check_index(scene, "object", index, lam_scene_object_count(scene), error) || !check_whole(scene, error))
        return false;
    remove_object(scene, index);
    return true;
}

bool lam_scene_remove_mesh(lam_scene *scene, int index, lam_error *error)
{
    if (!check_index(scene, "mesh", index, lam_scene_mesh_count(scene), error) || !check_whole(scene, error))
        return false;
    struct scene_token *token = scene_token_make(error);
    if (!token)
        return false;
    for (int i = scene->objects.count - 1; i >= 0; i--)
        if (scene_object(scene, i)->mesh == index)
            remove_object(scene, i);
    for (int i = 0; i < scene->objects.count; i++) {
        lam_object *object = (lam_object *)scene->objects.items + i;
        object->mesh -= object->mesh > index;
    }
    note_edit(scene, index);
    struct scene_origin *of_mesh = origin_with(scene, index);
    if (of_mesh)
        of_mesh->mesh_count--;
    for (int i = 0; i < scene->origins.count; i++) {
        struct scene_origin *origin = (struct scene_origin *)scene->origins.items + i;
        origin->first_mesh -= origin->first_mesh > index;
    }
    arena_delete(scene_extent(scene, index)->own);
    remove_item(&scene->extents, index, sizeof(struct scene_extent));
    remove_item(&scene->meshes, index, sizeof(lam_mesh));
    scene_change_token(scene, token);
    return true;
}
