// scene_mark.c: saves and restores the state of a scene, for pictures that differ in a few settings.
#include "scene_internal.h"

#include "fail.h"

#include <lambent/light.h>
#include <lambent/material.h>

#include <string.h>

// The lists that are restored, with the size of their items. Cameras, groups and origins come from files and are never removed.
static const struct {
    size_t list, item;
} lists[] = {
    {offsetof(struct lam_scene, meshes), sizeof(lam_mesh)},
    {offsetof(struct lam_scene, extents), sizeof(struct scene_extent)},
    {offsetof(struct lam_scene, materials), sizeof(lam_material)},
    {offsetof(struct lam_scene, objects), sizeof(lam_object)},
    {offsetof(struct lam_scene, groups), sizeof(lam_group)},
    {offsetof(struct lam_scene, lights), sizeof(lam_light)},
    {offsetof(struct lam_scene, origins), sizeof(struct scene_origin)},
    {offsetof(struct lam_scene, cameras), sizeof(struct scene_camera)},
};
enum { LISTS = sizeof lists / sizeof *lists };

struct scene_mark {
    struct scene_list saved[LISTS];
    int *part_materials; // the materials of all parts of the meshes, in order
    lam_up up;
    lam_mat4 placement;
    lam_rgb ambient;
    lam_material default_material;
    double deferred_crease_rad;
    struct scene_cut *cut;
    uint64_t object_items;
};

static struct scene_list *list_of(struct lam_scene *scene, int i)
{
    return (struct scene_list *)((char *)scene + lists[i].list);
}

static size_t part_count(const struct lam_scene *scene, int meshes)
{
    size_t count = 0;
    for (int i = 0; i < meshes; i++)
        count += scene_mesh(scene, i)->part_count;
    return count;
}

bool lam_scene_mark(lam_scene *scene, lam_error *error)
{
    if (!scene)
        return fail(error, LAM_BAD_ARGUMENT, "lam_scene_mark: the scene is NULL");
    struct scene_cut *cut = scene->cut;
    if (!scene_keep_meshes(scene, error) ||
        (cut && !cut->kept && scene_append(scene, &scene->kept, &cut->own, sizeof cut->own, error) < 0))
        return false;
    if (cut)
        cut->kept = true;
    struct scene_mark *mark = arena_alloc(&scene->arena, sizeof *mark);
    if (!mark)
        return call_memory_error(scene->arena.call, sizeof *mark, error);
    *mark = (struct scene_mark){.up = scene->up,
                                .placement = scene->placement,
                                .ambient = scene->ambient,
                                .default_material = *scene->default_material,
                                .deferred_crease_rad = scene->deferred_crease_rad,
                                .cut = scene->cut,
                                .object_items = scene->object_items};
    for (int i = 0; i < LISTS; i++) {
        const struct scene_list *list = list_of(scene, i);
        struct scene_list *saved = &mark->saved[i];
        *saved = (struct scene_list){arena_array(&scene->arena, (size_t)list->count, lists[i].item), list->count, 0};
        if (!saved->items)
            return call_memory_error(scene->arena.call, (size_t)list->count * lists[i].item, error);
        if (list->count)
            memcpy(saved->items, list->items, (size_t)list->count * lists[i].item);
    }
    const size_t parts = part_count(scene, scene->meshes.count);
    mark->part_materials = arena_array(&scene->arena, parts, sizeof(int));
    if (!mark->part_materials)
        return call_memory_error(scene->arena.call, parts * sizeof(int), error);
    for (int i = 0, n = 0; i < scene->meshes.count; i++)
        for (uint32_t k = 0; k < scene_mesh(scene, i)->part_count; k++)
            mark->part_materials[n++] = scene_mesh(scene, i)->parts[k].material;
    scene->mark = mark;
    return true;
}

bool lam_scene_reset(lam_scene *scene, lam_error *error)
{
    if (!scene || !scene->mark)
        return fail(error, LAM_BAD_ARGUMENT, "lam_scene_reset: %s", scene ? "no state is marked" : "the scene is NULL");
    const struct scene_mark *mark = scene->mark;
    if (scene->cut != mark->cut && !scene_uncut(scene, error))
        return false;
    scene->cut = mark->cut;
    scene->object_items = mark->object_items;
    // the capacity of a list never shrinks, so there is space for its earlier elements
    for (int i = 0; i < LISTS; i++) {
        struct scene_list *list = list_of(scene, i);
        list->count = mark->saved[i].count;
        if (list->count)
            memcpy(list->items, mark->saved[i].items, (size_t)list->count * lists[i].item);
    }
    for (int i = 0, n = 0; i < scene->meshes.count; i++)
        for (uint32_t k = 0; k < scene_mesh(scene, i)->part_count; k++)
            ((lam_part *)(uintptr_t)scene_mesh(scene, i)->parts)[k].material = mark->part_materials[n++];
    scene->up = mark->up;
    scene->placement = mark->placement;
    scene->ambient = mark->ambient;
    *scene->default_material = mark->default_material;
    scene->deferred_crease_rad = mark->deferred_crease_rad;
    return true;
}
