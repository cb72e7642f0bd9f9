// scene_join.c: moves the contents of one scene into another.
#include "scene_internal.h"

#include "fail.h"
#include "float_state.h"
#include "linear.h"

#include <lambent/light.h>
#include <lambent/material.h>

#include <stdlib.h>
#include <string.h>

// Moves the memory of a scene to the scene that keeps it.
static bool take_memory(lam_scene *scene, lam_scene *other, lam_error *error)
{
    struct arena *arena = malloc(sizeof *arena);
    if (!arena)
        return fail_memory(error, sizeof *arena);
    if (scene_append(scene, &scene->kept, &arena, sizeof arena, error) < 0) {
        free(arena);
        return false;
    }
    *arena = other->arena;
    arena->call = NULL;
    arena_start(&other->arena, NULL);
    return true;
}

static bool append_all(lam_scene *scene, struct scene_list *to, struct scene_list *from, size_t size, lam_error *error)
{
    for (int i = 0; i < from->count; i++)
        if (scene_append(scene, to, (const char *)from->items + (size_t)i * size, size, error) < 0)
            return false;
    from->count = 0;
    return true;
}

// Makes the indices of the other scene refer to the lists of both scenes. Its default material becomes a material.
static void shift_indices(lam_scene *other, int meshes, int materials, int groups, int plain)
{
    for (int i = 0; i < other->meshes.count; i++) {
        lam_mesh *mesh = (lam_mesh *)other->meshes.items + i;
        for (uint32_t k = 0; k < mesh->part_count; k++) {
            int *material = &((lam_part *)(uintptr_t)mesh->parts)[k].material;
            *material = *material < 0 ? plain : *material + materials;
        }
    }
    for (int i = 0; i < other->objects.count; i++) {
        lam_object *object = (lam_object *)other->objects.items + i;
        if (object->material < 0 && !scene_mesh(other, object->mesh)->part_count)
            object->material = plain;
        else if (object->material >= 0)
            object->material += materials;
        object->back_material += object->back_material >= 0 ? materials : 0;
        object->mesh += meshes;
        object->group += object->group ? groups : 0;
    }
    for (int i = 0; i < other->groups.count; i++) {
        lam_group *group = (lam_group *)other->groups.items + i;
        group->parent += group->parent ? groups : 0;
    }
    for (int i = 0; i < other->origins.count; i++) {
        struct scene_origin *origin = (struct scene_origin *)other->origins.items + i;
        origin->first_mesh += meshes;
        origin->first_material += materials;
        origin->edited = true; // a scene file cannot describe the moved default material
    }
}

static bool join(lam_scene *scene, lam_scene *other, lam_error *error)
{
    const int meshes = scene->meshes.count, materials = scene->materials.count;
    if (!append_all(scene, &scene->materials, &other->materials, sizeof(lam_material), error))
        return false;
    const int plain = scene_adopt_material(scene, other->default_material, error);
    if (plain < 0 || !take_memory(scene, other, error))
        return false;
    shift_indices(other, meshes, materials, scene->groups.count, plain);
    scene->object_items += other->object_items;
    scene->input_bytes += other->input_bytes;
    scene->read_ms += other->read_ms;
    scene->prepare_ms += other->prepare_ms;
    return append_all(scene, &scene->extents, &other->extents, sizeof(struct scene_extent), error) &&
           append_all(scene, &scene->meshes, &other->meshes, sizeof(lam_mesh), error) &&
           append_all(scene, &scene->objects, &other->objects, sizeof(lam_object), error) &&
           append_all(scene, &scene->groups, &other->groups, sizeof(lam_group), error) &&
           append_all(scene, &scene->lights, &other->lights, sizeof(lam_light), error) &&
           append_all(scene, &scene->cameras, &other->cameras, sizeof(struct scene_camera), error) &&
           append_all(scene, &scene->textures, &other->textures, sizeof(lam_texture *), error) &&
           append_all(scene, &scene->kept, &other->kept, sizeof(struct arena *), error) &&
           append_all(scene, &scene->origins, &other->origins, sizeof(struct scene_origin), error) &&
           append_all(scene, &scene->files, &other->files, sizeof(const char *), error) &&
           append_all(scene, &scene->warnings, &other->warnings, sizeof(const char *), error);
}

bool lam_scene_add_scene(lam_scene *scene, lam_scene *other, lam_error *error)
{
    bool ok = scene && other && scene != other;
    if (!ok)
        fail(error, LAM_BAD_ARGUMENT, "lam_scene_add_scene: a scene is NULL, or both are the same");
    else if (scene->cut || other->cut || other->mark || scene->deferred_crease_rad || other->deferred_crease_rad)
        ok = fail(error, LAM_BAD_ARGUMENT,
                  "lam_scene_add_scene: a scene has sections or a mark, or leaves its normals to the device");
    ok = ok && join(scene, other, error);
    if (other != scene)
        lam_scene_free(other);
    return ok;
}
