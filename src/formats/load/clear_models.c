// clear_models.c: makes a fully transparent scene visible, because its picture would otherwise be empty.
#include "clear_models.h"

#include <lambent/material.h>

#include <stdio.h>

static lam_material *material_at(struct lam_scene *scene, int index)
{
    return index >= 0 ? (lam_material *)scene->materials.items + index : scene->default_material;
}

static bool colors_are_clear(const lam_mesh *mesh)
{
    bool floats = mesh->colors_format == LAM_COLORS_LINEAR_F32, clear = mesh->colors && mesh->color_count > 0;
    for (uint32_t i = 0; clear && i < mesh->color_count; i++)
        clear = floats ? !(((const float *)mesh->colors)[4 * (size_t)i + 3] > 0)
                       : ((const uint8_t *)mesh->colors)[4 * (size_t)i + 3] == 0;
    return clear;
}

// A part of an object, with the materials of its front and back faces. next_shown moves to the next part, and returns
// false after the last part.
struct shown {
    uint32_t part;
    lam_material *front, *back; // NULL if back faces use the front's material
};

static bool next_shown(struct lam_scene *scene, const lam_object *object, struct shown *shown)
{
    const lam_mesh *mesh = scene_mesh(scene, object->mesh);
    bool one = object->material >= 0 || !mesh->part_count;
    if (mesh_items(mesh) == 0 || shown->part >= (one ? 1 : mesh->part_count))
        return false;
    shown->front = material_at(scene, one ? object->material : mesh->parts[shown->part].material);
    shown->back = object->back_material >= 0 ? material_at(scene, object->back_material) : NULL;
    shown->part++;
    return true;
}

static bool is_clear(struct lam_scene *scene, const lam_object *object)
{
    struct shown shown = {0};
    while (next_shown(scene, object, &shown)) {
        bool materials = !(shown.front->diffuse.a > 0) && (!shown.back || !(shown.back->diffuse.a > 0));
        if (!materials) // a material is visible, so only transparent mesh colours can hide the object
            return colors_are_clear(scene_mesh(scene, object->mesh));
    }
    return true;
}

static void make_opaque(struct lam_scene *scene, const lam_object *object)
{
    struct shown shown = {0};
    while (next_shown(scene, object, &shown)) {
        shown.front->diffuse.a = shown.front->diffuse.a > 0 ? shown.front->diffuse.a : 1;
        if (shown.back)
            shown.back->diffuse.a = shown.back->diffuse.a > 0 ? shown.back->diffuse.a : 1;
    }
    const lam_mesh *mesh = scene_mesh(scene, object->mesh);
    if (!colors_are_clear(mesh))
        return;
    void *colors = (void *)(uintptr_t)mesh->colors; // the colours are in the scene's arena, so they may be changed
    for (uint32_t i = 0; i < mesh->color_count; i++) {
        if (mesh->colors_format == LAM_COLORS_LINEAR_F32)
            ((float *)colors)[4 * (size_t)i + 3] = 1;
        else
            ((uint8_t *)colors)[4 * (size_t)i + 3] = 255;
    }
    if (object->mesh < scene->extents.count)
        ((struct scene_extent *)scene->extents.items)[object->mesh].translucent = false;
}

void show_clear_scene(struct lam_scene *scene, const char *name)
{
    bool clear = true;
    for (int i = 0; clear && i < scene->objects.count; i++)
        clear = is_clear(scene, scene_object(scene, i));
    for (int i = 0; clear && i < scene->objects.count; i++)
        make_opaque(scene, scene_object(scene, i));
    char count[40] = "";
    if (scene->clear_materials > 1)
        snprintf(count, sizeof count, ", the first of %d", scene->clear_materials);
    const char *opaque = "the picture would be empty, so everything is drawn opaque";
    if (scene->first_clear)
        scene_warn(scene, "%s%s%s%s", scene->first_clear, count, clear ? "; " : "", clear ? opaque : "");
    else if (clear)
        scene_warn(scene, "%s: every material or colour is fully transparent (alpha 0); %s", name, opaque);
}
