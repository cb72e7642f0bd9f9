// scene_section.c: parses the planes of sections, and keeps a scene's sections. src/formats/section cuts the objects.
#include "scene_internal.h"

#include "fail.h"
#include "linear.h"
#include "number.h"

#include <string.h>

enum { TEXT_MAX = 256 };

static bool fail_section(const char *text, const char *found, lam_error *error)
{
    return fail(error, LAM_BAD_ARGUMENT,
                "found '%.60s'%s%.60s%s, expected a plane such as x=0, -z=40%% or normal=1/1/0,distance=2.5, with "
                ",color=COLOUR if you like",
                text, *found && strcmp(found, text) != 0 ? " ('" : "", strcmp(found, text) != 0 ? found : "",
                *found && strcmp(found, text) != 0 ? "')" : "");
}

// Parses a finite number at *at, and moves *at behind the number.
static bool take_number(const char **at, double *number)
{
    const char *begin = *at + (**at == '-' || **at == '+');
    if (!((*begin >= '0' && *begin <= '9') || *begin == '.'))
        return false;
    *at = (const char *)number_double((const uint8_t *)*at, (const uint8_t *)*at + strlen(*at), number);
    return *at && math_finite(*number);
}

// Parses the distance of a plane: a number, or a percentage.
static bool take_distance(const char *text, lam_section *section)
{
    if (!take_number(&text, &section->distance))
        return false;
    section->relative = *text == '%';
    section->distance *= section->relative ? 0.01 : 1;
    return !text[section->relative];
}

static bool take_normal(const char *text, lam_section *section)
{
    double *const axes[] = {&section->normal.x, &section->normal.y, &section->normal.z};
    for (int k = 0; k < 3; k++)
        if (!take_number(&text, axes[k]) || *text++ != (k < 2 ? '/' : 0))
            return false;
    return v3_length(section->normal) > 0;
}

static bool take_axis(const char *key, const char *value, lam_section *section)
{
    const bool negative = *key == '-';
    const char axis = key[negative || *key == '+'];
    if (axis < 'x' || axis > 'z' || !take_distance(value, section))
        return false;
    const double sign = negative ? -1 : 1;
    section->normal = v3(axis == 'x' ? sign : 0, axis == 'y' ? sign : 0, axis == 'z' ? sign : 0);
    if (negative) // the value is a coordinate along the axis
        section->distance = section->relative ? 1 - section->distance : -section->distance;
    return true;
}

bool lam_section_parse(const char *text, lam_color_mode mode, lam_section *section, lam_error *error)
{
    char copy[TEXT_MAX], *rest = copy;
    if (!text || !section)
        return fail(error, LAM_BAD_ARGUMENT, "lam_section_parse: %s is NULL", text ? "section" : "text");
    if (strlen(text) >= sizeof copy)
        return fail_section(text, "", error);
    *section = (lam_section){0};
    strcpy(copy, text);
    bool plane = false, distance = false;
    for (char *pair; (pair = strsep(&rest, ","));) {
        char *end = strpbrk(pair, "=:");
        const char *value = end ? end + 1 : "50%"; // an axis alone
        if (end)
            *end = 0;
        bool ok = true;
        if (strcmp(pair, "color") == 0) {
            if (!lam_color_parse(value, mode, &section->color, error))
                return false;
        } else if (strcmp(pair, "distance") == 0) {
            ok = !distance && take_distance(value, section);
            distance = true;
        } else if (strcmp(pair, "normal") == 0) {
            ok = !plane && take_normal(value, section);
            plane = true;
        } else {
            ok = strlen(pair) - (*pair == '-' || *pair == '+') == 1 && !plane && !distance &&
                 take_axis(pair, value, section);
            plane = distance = true;
        }
        if (!ok)
            return fail_section(text, pair, error);
    }
    return plane || fail_section(text, "", error);
}

// --- the scene's sections

bool scene_uncut(struct lam_scene *scene, lam_error *error)
{
    struct scene_cut *cut = scene->cut;
    struct scene_token *token = cut ? scene_token_make(error) : NULL;
    if (!token)
        return !cut;
    memcpy(scene->objects.items, cut->objects, (size_t)cut->object_count * sizeof(lam_object));
    scene->object_items = cut->items;
    for (int i = cut->object_count; i < scene->objects.count; i++)
        scene->object_items += mesh_items(scene_mesh(scene, scene_object(scene, i)->mesh));
    if (scene->meshes.count + scene->materials.count > cut->all) { // the program has added something after the cut
        if (!cut->kept && scene_append(scene, &scene->kept, &cut->own, sizeof cut->own, error) < 0) {
            scene_token_release(token);
            return false;
        }
        cut->kept = true;
    } else {
        scene->meshes.count = scene->extents.count = cut->meshes;
        scene->materials.count = cut->materials;
    }
    scene->cut = NULL;
    if (!cut->kept)
        arena_delete(cut->own);
    scene_change_token(scene, token);
    return true;
}

const lam_section *lam_scene_section(const lam_scene *scene, int index)
{
    return scene && scene->cut && index >= 0 && index < scene->cut->count ? &scene->cut->sections[index] : NULL;
}

double lam_scene_section_area(const lam_scene *scene, int index)
{
    return lam_scene_section(scene, index) ? scene->cut->areas[index] : 0;
}
