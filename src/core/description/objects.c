// objects.c: reads the objects of a scene file: all keys except the model itself (models.c).
#include "models.h"

#include "fail.h"
#include "linear.h"

#include <lambent/material.h>

#include <stdio.h>
#include <string.h>

#define EVERY_OBJECT                                                                                                   \
    "name", "transform", "material", "back_material", "two_sided", "cull", "tangents", "normals", "crease_angle"
static const char *const shape_keys[] = {EVERY_OBJECT, "shape", "radius", "slices", "stacks", NULL};
static const char *const file_keys[] = {EVERY_OBJECT, "file",      "materials", "parts", "scene",
                                        "variant",    "animation", "time",      NULL};
static const char *const any_keys[] = {EVERY_OBJECT, "shape", "radius",  "slices",    "stacks", "file", "materials",
                                       "parts",      "scene", "variant", "animation", "time",   NULL};

// --- keys of all objects

// Reads "materials": changes to the model's own materials, by their names.
static bool change_materials(struct reader *r, const struct place *place, const json_t *value,
                             const struct scene_origin *origin)
{
    const char *key;
    json_t *change, *list = json_object_get(value, "materials");
    const struct place *here = KEY_OF(place, "materials");
    if (list && !json_is_object(list))
        return json_unexpected(&r->json, here, list, "an object of the model's materials");
    json_object_foreach(list, key, change)
    {
        bool found = false;
        for (int i = origin->first_material; i < origin->first_material + origin->material_count; i++) {
            lam_material *material = (lam_material *)r->scene->materials.items + i;
            char number[16]; // the name of an unnamed material
            snprintf(number, sizeof number, "#%d", i - origin->first_material);
            if (strcmp(material->name ? material->name : number, key) != 0)
                continue;
            found = true;
            if (!read_material_keys(r, KEY_OF(here, key), change, material))
                return false;
        }
        if (!found)
            return json_fail(&r->json, KEY_OF(here, key), "the model has no material of this name");
    }
    return true;
}

// Reads "parts": a material for each part of the model, in order; null keeps the part's own material.
static bool replace_parts(struct reader *r, const struct place *place, const json_t *value,
                          const struct scene_origin *origin)
{
    const json_t *list = json_object_get(value, "parts");
    const struct place *here = KEY_OF(place, "parts");
    char kind[JSON_KIND_SIZE];
    size_t n = 0;
    if (!list)
        return true;
    if (!json_is_array(list) || json_array_size(list) != (size_t)origin->part_count)
        return json_fail(&r->json, here,
                         "found %s, expected a list of %d, one material or null for each part of the model",
                         json_kind(list, kind), origin->part_count);
    for (int i = origin->first_mesh; i < origin->first_mesh + origin->mesh_count; i++)
        for (uint32_t k = 0; k < scene_mesh(r->scene, i)->part_count; k++, n++) {
            // the parts are in the scene's arena, so they may be changed
            lam_part *part = (lam_part *)(uintptr_t)&scene_mesh(r->scene, i)->parts[k];
            const json_t *material = json_array_get(list, n);
            int index = part->material;
            if (!json_is_null(material) && !read_material(r, ELEMENT_OF(here, n), material, NULL, &index))
                return false;
            part->material = index;
        }
    return true;
}

// Returns the material that supplies the missing keys of a back side: the object's material or, if it has none, the
// material of its first part.
static lam_material front_of(const struct lam_scene *scene, const lam_object *object)
{
    const lam_mesh *mesh = scene_mesh(scene, object->mesh);
    int index = object->material >= 0 ? object->material : mesh->part_count ? mesh->parts[0].material : -1;
    return index >= 0 ? ((const lam_material *)scene->materials.items)[index] : lam_material_default();
}

static bool read_sides(struct reader *r, const struct place *place, const json_t *value, lam_object *object)
{
    bool two_sided = !object->one_sided;
    int cull = (int)object->cull;
    if (!json_take_bool(&r->json, place, value, "two_sided", &two_sided) ||
        !json_take_word(&r->json, place, value, "cull", cull_words, &cull))
        return false;
    object->one_sided = !two_sided;
    object->cull = (lam_cull)cull;
    const json_t *back = json_object_get(value, "back_material");
    lam_material front = front_of(r->scene, object);
    front.name = NULL;
    return !back || read_material(r, KEY_OF(place, "back_material"), back, &front, &object->back_material);
}

// The indices of the first object, light and camera of an entry.
struct entry {
    int object, light, camera;
};

// Applies an object's transform to the lights and cameras of its file.
static void place_lights_and_cameras(struct lam_scene *scene, const struct entry *entry, const lam_mat4 *transform)
{
    for (int i = entry->light; i < scene->lights.count; i++) {
        lam_light *light = (lam_light *)scene->lights.items + i;
        light->position = mat4_point(transform, light->position);
        light->direction = mat4_vector(transform, light->direction);
    }
    for (int i = entry->camera; i < scene->cameras.count; i++) {
        lam_camera *camera = &((struct scene_camera *)scene->cameras.items)[i].camera;
        camera->eye = mat4_point(transform, camera->eye);
        camera->target = mat4_point(transform, camera->target);
        camera->up = mat4_vector(transform, camera->up);
    }
}

// Applies keys such as "transform" and "material" to the objects, lights and cameras of an entry. Shapes and files
// share these keys.
static bool finish(struct reader *r, const struct place *place, const json_t *value, const struct entry *entry,
                   const char *name)
{
    int first = entry->object;
    lam_mat4 transform = lam_mat4_identity();
    const json_t *steps = json_object_get(value, "transform"), *material = json_object_get(value, "material");
    int front = -1;
    if (steps && !read_transform(r, KEY_OF(place, "transform"), steps, &transform))
        return false;
    if (material && !read_material(r, KEY_OF(place, "material"), material, NULL, &front))
        return false;
    if (steps)
        place_lights_and_cameras(r->scene, entry, &transform);
    if (steps && first == 0) {
        lam_mat4 *own = arena_alloc(&r->scene->arena, sizeof *own);
        if (!own)
            return call_memory_error(r->source->call, sizeof *own, r->json.error);
        *own = transform;
        r->scene->first_transform = own;
    }
    for (int i = first; i < r->scene->objects.count; i++) {
        lam_object *object = (lam_object *)r->scene->objects.items + i;
        // The product with the identity is skipped, because it would lose the signs of zeros.
        if (steps)
            object->transform =
                mat4_is_identity(&object->transform) ? transform : mat4_mul(&transform, &object->transform);
        if (front >= 0)
            object->material = front;
        if (name && (i == first || !object->name))
            object->name = name;
        if (!read_sides(r, place, value, object))
            return false;
    }
    return true;
}

// Reads "shape": {"parametric": {"formula": "x=…; y=…; z=…", "u": "0..2pi", "v": "0..pi", "segments": [64, 32], "flip":
// true}}, or {"implicit": {"formula": "x^2+…", "x": "-1..1", "y": "-1..1", "z": "-1..1", "segments": 96, "flip":
// true}}. If the inner object is a string, it is the formula, and all other keys have their defaults.
static bool read_formula(struct reader *r, const struct place *place, const json_t *value, lam_formula *formula)
{
    static const char *const outer[] = {"parametric", "implicit", NULL};
    static const char *const inner[2][7] = {{"formula", "u", "v", "segments", "flip", NULL},
                                            {"formula", "x", "y", "z", "segments", "flip", NULL}};
    formula->implicit = !json_object_get(value, "parametric") && json_object_get(value, "implicit");
    const char *kind = outer[formula->implicit];
    const json_t *given = json_object_get(value, kind);
    const struct place *at = KEY_OF(place, kind);
    if (!json_check_keys(&r->json, place, value, outer))
        return false;
    if (json_object_size(value) > 1)
        return json_fail(&r->json, place, "contains both parametric and implicit, expected only one");
    if (json_is_string(given))
        return take_text(r, place, value, kind, &formula->text);
    if (!json_is_object(given))
        return json_unexpected(&r->json, at, given, "a string or an object with the key formula");
    const json_t *list = json_object_get(given, "segments");
    if (!json_check_keys(&r->json, at, given, inner[formula->implicit]) ||
        !take_text(r, at, given, "formula", &formula->text) || !take_text(r, at, given, "u", &formula->u) ||
        !take_text(r, at, given, "v", &formula->v) || !take_text(r, at, given, "x", &formula->x) ||
        !take_text(r, at, given, "y", &formula->y) || !take_text(r, at, given, "z", &formula->z) ||
        !json_take_bool(&r->json, at, given, "flip", &formula->flip))
        return false;
    if (!formula->text)
        return json_fail(&r->json, at, "'formula' is missing, expected a string such as \"%s\"",
                         formula->implicit ? "x^2+y^2+z^2-1" : "x=u; y=v; z=sin(u)");
    if (formula->implicit)
        return take_whole(r, at, given, "segments", 2, 1024, &formula->u_segments);
    if (!list)
        return true;
    int *const counts[2] = {&formula->u_segments, &formula->v_segments};
    for (size_t i = 0; i < 2; i++) {
        const json_t *number = json_array_get(list, i);
        json_int_t count = json_is_integer(number) ? json_integer_value(number) : -1;
        if (json_array_size(list) != 2 || count < 0 || count > 16384)
            return json_fail(&r->json, KEY_OF(at, "segments"),
                             "expected two whole numbers from 0 to 16384, along u and v");
        *counts[i] = (int)count;
    }
    return true;
}

static bool read_object(struct reader *r, const struct place *place, const json_t *value)
{
    struct model_wanted wanted = {
        .place = place, .materials = json_object_get(value, "materials"), .parts = json_object_get(value, "parts")};
    struct scene_origin *o = &wanted.origin;
    const char *name = NULL;
    int normals = LAM_NORMALS_FILE, field = false;
    double crease_deg = -1;
    bool is_file = json_is_object(value) && json_object_get(value, "file");
    bool is_shape = json_is_object(value) && json_object_get(value, "shape");
    if (!json_check_keys(&r->json, place, value, is_file == is_shape ? any_keys : is_file ? file_keys : shape_keys))
        return false;
    if (is_file == is_shape)
        return json_fail(&r->json, place,
                         is_file ? "contains both shape and file, expected only one"
                                 : "contains neither shape nor file, expected one of them");
    const json_t *computed = json_object_get(value, "shape");
    lam_formula formula = {0};
    bool is_formula = is_shape && json_is_object(computed);
    if (is_formula && !read_formula(r, KEY_OF(place, "shape"), computed, &formula))
        return false;
    static const char *const of_shapes[] = {"radius", "slices", "stacks"};
    for (size_t i = 0; is_formula && i < sizeof of_shapes / sizeof *of_shapes; i++)
        if (json_object_get(value, of_shapes[i]))
            return json_fail(&r->json, KEY_OF(place, of_shapes[i]),
                             "applies only to built-in shapes, but the shape is a formula");
    if ((!is_formula && !take_text(r, place, value, "shape", &o->shape)) ||
        !take_text(r, place, value, "file", &wanted.file) || !take_text(r, place, value, "name", &name) ||
        !take_text(r, place, value, "scene", &o->scene) || !take_text(r, place, value, "variant", &o->variant) ||
        !take_text(r, place, value, "animation", &o->animation) ||
        !json_take_number(&r->json, place, value, "time", -1e9, 1e9, &o->time_s) ||
        !json_take_word(&r->json, place, value, "normals", normals_words, &normals) ||
        !json_take_number(&r->json, place, value, "crease_angle", 0, 180, &crease_deg) ||
        !json_take_word(&r->json, place, value, "tangents", tangent_words, &field))
        return false;
    o->formula = is_formula ? &formula : NULL;
    o->normals = (lam_normals)normals;
    o->field_tangents = field;
    // 0 means the importer's default; a tiny angle makes every edge a crease.
    o->crease_angle_rad = crease_deg < 0 ? 0 : crease_deg > 0 ? math_radians(crease_deg) : 1e-6;
    if (o->shape && lam_shape_find(o->shape) >= 0 &&
        (!json_take_number(&r->json, place, value, "radius", 1e-30, 1e30, &o->segments.radius) ||
         !take_whole(r, place, value, "slices", 3, 16384, &o->segments.slices) ||
         !take_whole(r, place, value, "stacks", 1, 16384, &o->segments.stacks)))
        return false;
    struct entry entry = {r->scene->objects.count, r->scene->lights.count, r->scene->cameras.count};
    int index;
    bool own;
    if (!add_model(r, &wanted, &index, &own))
        return false;
    const struct scene_origin *origin = (const struct scene_origin *)r->scene->origins.items + index;
    return (!own || (change_materials(r, place, value, origin) && replace_parts(r, place, value, origin))) &&
           finish(r, place, value, &entry, name);
}

bool read_objects(struct reader *r, const json_t *root)
{
    const json_t *list = json_object_get(root, "objects");
    const struct place *place = KEY_OF(NULL, "objects");
    if (!list)
        return json_fail(&r->json, NULL, "'objects' is missing, expected a list of at least one object");
    if (!json_is_array(list) || !json_array_size(list))
        return json_unexpected(&r->json, place, list, "a list of at least one object");
    for (size_t i = 0; i < json_array_size(list); i++) {
        if (!call_should_continue(r->source->call))
            return call_error(r->source->call, r->json.error);
        if (!read_object(r, ELEMENT_OF(place, i), json_array_get(list, i)))
            return false;
    }
    return true;
}
