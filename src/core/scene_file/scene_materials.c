// scene_materials.c: reads the materials of a scene file.
#include "scene_reader.h"

#include "fail.h"
#include "spelling.h"

#include <lambent/material.h>

#include <string.h>

bool read_material_keys(struct scene_reader *r, const struct place *place, const json_t *value, bool whole,
                        lam_material *material)
{
    const char *keys[LAM_FIELDS_MAX + 1];
    int count = 0;
    for (; lam_material_field(count); count++)
        keys[count] = lam_material_field(count)->key;
    keys[count] = NULL;
    if (!check_keys(r, place, value, keys))
        return false;
    for (int i = 0; i < count; i++)
        if (json_object_get(value, keys[i]))
            material_note_written(material, i);
    for (int i = 0; i < count; i++)
        if (material_field(i)->reader != FIELD_NEVER && !take_field(r, place, value, lam_material_field(i), material))
            return false;
    // by default, the ambient colour is the diffuse colour
    if (whole && !json_object_get(value, "ambient"))
        material->ambient = (lam_rgb){material->diffuse.r, material->diffuse.g, material->diffuse.b};
    double opacity = 1;
    if (!take_number(r, place, value, "opacity", 0, 1, &opacity))
        return false;
    material->diffuse.a *= (float)opacity;
    return true;
}

// Returns the index of the file's material with this name, or −1 if there is none.
static int named(const struct scene_reader *r, const char *name)
{
    const char *key;
    json_t *value;
    int i = 0;
    json_object_foreach(r->materials, key, value)
    {
        if (strcmp(key, name) == 0)
            return r->material_at[i];
        i++;
    }
    return -1;
}

static bool unknown_name(struct scene_reader *r, const struct place *place, const char *name)
{
    const char *nearest = NULL, *key;
    json_t *value;
    char shown[2][SHOWN_NAME_SIZE];
    json_object_foreach(r->materials, key, value)
    {
        const char *two[2] = {nearest, key};
        if (strlen(key) <= 60)
            nearest = nearest ? nearest_word(name, two, 2) : nearest_word(name, two + 1, 1);
    }
    for (int i = 0; !nearest && i < LAM_MATERIAL_COUNT; i++) {
        const char *classic = lam_material_name((lam_material_id)i);
        nearest = nearest_word(name, &classic, 1);
    }
    shown_name(name, shown[0]);
    return nearest ? fail_place(r, place, "no material is named '%s'; did you mean '%s'?", shown[0],
                                shown_name(nearest, shown[1]))
                   : fail_place(r, place, "no material is named '%s', neither in \"materials\" nor a classic one",
                                shown[0]);
}

bool read_material_value(struct scene_reader *r, const struct place *place, const json_t *value,
                         const lam_material *base, int *index)
{
    lam_material material = base ? *base : lam_material_default();
    if (json_is_string(value)) {
        const char *name = json_string_value(value);
        *index = named(r, name);
        if (*index >= 0)
            return true;
        lam_material_id id = lam_material_find(name);
        if (id == LAM_MATERIAL_COUNT)
            return unknown_name(r, place, name);
        material = lam_material_named(id, r->color);
    } else if (!read_material_keys(r, place, value, !base, &material)) {
        return false;
    }
    *index = scene_adopt_material(r->scene, &material, r->error);
    return *index >= 0;
}

bool read_materials(struct scene_reader *r, const json_t *root)
{
    json_t *list = json_object_get(root, "materials");
    const struct place *place = KEY_OF(NULL, "materials");
    if (!list)
        return true;
    if (!json_is_object(list)) {
        char kind[JSON_KIND_SIZE];
        return fail_place(r, place, "found %s, expected an object of named materials", json_kind(list, kind));
    }
    r->material_at = arena_array(&r->scene->arena, json_object_size(list), sizeof *r->material_at);
    if (!r->material_at)
        return call_memory_error(r->source->call, json_object_size(list) * sizeof *r->material_at, r->error);
    const char *key;
    json_t *value;
    int i = 0;
    json_object_foreach(list, key, value)
    {
        if (!json_is_object(value)) {
            char kind[JSON_KIND_SIZE];
            return fail_place(r, KEY_OF(place, key), "found %s, expected an object, { … }", json_kind(value, kind));
        }
        if (!read_material_value(r, KEY_OF(place, key), value, NULL, &r->material_at[i]))
            return false;
        lam_material *material = (lam_material *)r->scene->materials.items + r->material_at[i++];
        material->name = arena_string(&r->scene->arena, key);
        if (!material->name)
            return call_memory_error(r->source->call, strlen(key), r->error);
    }
    r->materials = list;
    return true;
}
