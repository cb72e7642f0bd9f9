// info_names.c: lists the names of a model's objects, groups and parts, which --hide and --material …@NAME accept.
#include "info.h"

#include <stdlib.h>
#include <string.h>

#include "console.h"

static int by_name(const void *a, const void *b)
{
    const struct info_name *x = a, *y = b;
    int order = strcmp(x->name, y->name);
    return order ? order : (x->order > y->order) - (x->order < y->order);
}

static int by_order(const void *a, const void *b)
{
    const struct info_name *x = a, *y = b;
    return (x->order > y->order) - (x->order < y->order);
}

static void add(struct info_names *names, const char *name, int objects, int parts, int groups)
{
    if (!name || !*name)
        return;
    if (names->items)
        names->items[names->count] = (struct info_name){
            .name = name, .order = names->count, .objects = objects, .parts = parts, .groups = groups};
    names->count++;
}

// Adds the names of all objects, groups in use, and parts. If `items` is NULL, only counts them.
static void add_all(struct info_names *names, const lam_scene *scene, const bool *used)
{
    names->count = 0;
    for (int i = 0; i < lam_scene_object_count(scene); i++)
        add(names, lam_scene_object(scene, i)->name, 1, 0, 0);
    for (int i = 0; lam_scene_group(scene, i); i++)
        if (used[i])
            add(names, lam_scene_group(scene, i)->name, 0, 0, 1);
    for (int m = 0; m < lam_scene_mesh_count(scene); m++)
        for (uint32_t p = 0; p < lam_scene_mesh(scene, m)->part_count; p++)
            add(names, lam_scene_mesh(scene, m)->parts[p].name, 0, 1, 0);
}

// Returns for each group whether it contains objects. The caller frees the array. Returns NULL if memory runs out.
static bool *used_groups(const lam_scene *scene)
{
    size_t count = 0;
    while (lam_scene_group(scene, (int)count))
        count++;
    bool *used = calloc(count + 1, sizeof *used);
    for (int i = 0; used && i < lam_scene_object_count(scene); i++)
        for (int g = lam_scene_object(scene, i)->group; g && !used[g - 1]; g = lam_scene_group(scene, g - 1)->parent)
            used[g - 1] = true;
    return used;
}

bool info_names_list(const lam_scene *scene, struct info_names *names, lam_error *error)
{
    bool *used = used_groups(scene);
    if (used) {
        add_all(names, scene, used);
        names->items = calloc((size_t)names->count + 1, sizeof *names->items);
    }
    if (!names->items) {
        free(used);
        return complain(error, LAM_MACHINE, "out of memory");
    }
    add_all(names, scene, used);
    free(used);
    qsort(names->items, (size_t)names->count, sizeof *names->items, by_name);
    int kept = 0;
    for (int i = 0; i < names->count; i++) {
        struct info_name *last = kept ? &names->items[kept - 1] : NULL;
        if (last && strcmp(last->name, names->items[i].name) == 0) {
            last->objects += names->items[i].objects;
            last->parts += names->items[i].parts;
            last->groups += names->items[i].groups;
        } else {
            names->items[kept++] = names->items[i];
        }
    }
    names->count = kept;
    qsort(names->items, (size_t)kept, sizeof *names->items, by_order);
    return true;
}
