// scene_colors.c: materials for surfaces with vertex colours but without a material.
#include "prepare.h"

#include <lambent/material.h>

// Returns the index of a white material, which is created on first use. Returns −1 if memory runs out.
static int white_of(struct lam_scene *scene, int *white, lam_error *error)
{
    if (*white < 0) {
        lam_material material = lam_material_default();
        material.ambient = (lam_rgb){1, 1, 1};
        material.diffuse = (lam_rgba){1, 1, 1, 1};
        *white = scene_adopt_material(scene, &material, error);
    }
    return *white;
}

bool scene_give_colors_white(struct lam_scene *scene, lam_error *error)
{
    int white = -1;
    for (int m = 0; m < scene->meshes.count; m++) {
        const lam_mesh *mesh = scene_mesh(scene, m);
        for (uint32_t p = 0; mesh->colors && p < mesh->part_count; p++) {
            // the parts are in the scene's arena, so they may be changed
            lam_part *part = (lam_part *)(uintptr_t)mesh->parts + p;
            if (part->material < 0 && (part->material = white_of(scene, &white, error)) < 0)
                return false;
        }
    }
    for (int i = 0; i < scene->objects.count; i++) {
        lam_object *object = (lam_object *)scene->objects.items + i;
        const lam_mesh *mesh = scene_mesh(scene, object->mesh);
        if (mesh->colors && !mesh->part_count && object->material < 0 &&
            (object->material = white_of(scene, &white, error)) < 0)
            return false;
    }
    return true;
}
