// file_list.c: lists the files that a load tried to open.
#include "file_list.h"

#include "fail.h"

#include <stdlib.h>
#include <string.h>

void file_list_start(struct file_list *list)
{
    *list = (struct file_list){0};
    lock_start(&list->lock);
    arena_start(&list->memory, NULL);
    list->paths.memory = &list->memory;
}

bool file_list_add(struct file_list *list, const char *path)
{
    if (!list)
        return true;
    lock_take(&list->lock);
    bool fresh = name_table_find(&list->paths, path) < 0;
    const char *copy = fresh ? arena_string(&list->memory, path) : NULL;
    if (fresh && !(copy && name_table_add(&list->paths, copy, 0)))
        list->incomplete = true;
    lock_give(&list->lock);
    return fresh;
}

static int by_name(const void *a, const void *b) { return strcmp(*(const char *const *)a, *(const char *const *)b); }

static bool give(struct lam_scene *scene, const char *path, lam_error *error)
{
    const char *copy = arena_string(&scene->arena, path);
    return copy ? scene_append(scene, &scene->files, &copy, sizeof copy, error) >= 0 : fail_memory(error, strlen(path));
}

bool file_list_give(struct file_list *list, const char *model, struct lam_scene *scene, lam_error *error)
{
    if (list->incomplete)
        return fail_memory(error, list->paths.count * sizeof *list->paths.entries);
    size_t count = 0;
    const char **paths = arena_array(&list->memory, list->paths.count, sizeof *paths);
    if (!paths)
        return fail_memory(error, list->paths.count * sizeof *paths);
    for (uint32_t i = 0; i < list->paths.capacity; i++)
        if (list->paths.entries[i].name)
            paths[count++] = list->paths.entries[i].name;
    qsort(paths, count, sizeof *paths, by_name);
    bool ok = !model || give(scene, model, error);
    for (size_t i = 0; ok && i < count; i++)
        ok = give(scene, paths[i], error);
    return ok;
}

void file_list_end(struct file_list *list)
{
    arena_free(&list->memory);
    lock_end(&list->lock);
}
