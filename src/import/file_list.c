// file_list.c: the files that a load looked for, found or not.
#include "file_list.h"

#include "fail.h"

#include <stdlib.h>
#include <string.h>

void file_list_start(struct file_list *list)
{
    *list = (struct file_list){0};
    lock_start(&list->lock);
}

void file_list_add(struct file_list *list, const char *path)
{
    if (!list)
        return;
    lock_take(&list->lock);
    if (list->count == list->capacity) {
        size_t capacity = list->capacity ? 2 * list->capacity : 8;
        char **more = realloc(list->paths, capacity * sizeof *more);
        list->paths = more ? more : list->paths;
        list->capacity = more ? capacity : list->capacity;
    }
    char *copy = list->count < list->capacity ? strdup(path) : NULL;
    if (copy)
        list->paths[list->count++] = copy;
    else
        list->incomplete = true;
    lock_give(&list->lock);
}

static int by_name(const void *a, const void *b) { return strcmp(*(char *const *)a, *(char *const *)b); }

static bool give(struct lam_scene *scene, const char *path, lam_error *error)
{
    const char *copy = arena_string(&scene->arena, path);
    return copy ? scene_append(scene, &scene->files, &copy, sizeof copy, error) >= 0 : fail_memory(error, strlen(path));
}

bool file_list_give(struct file_list *list, const char *model, struct lam_scene *scene, lam_error *error)
{
    if (list->incomplete)
        return fail_memory(error, list->count * sizeof *list->paths);
    if (list->count)
        qsort(list->paths, list->count, sizeof *list->paths, by_name);
    bool ok = !model || give(scene, model, error);
    for (size_t i = 0; ok && i < list->count; i++)
        if (i == 0 || strcmp(list->paths[i], list->paths[i - 1]) != 0)
            ok = give(scene, list->paths[i], error);
    return ok;
}

void file_list_end(struct file_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        free(list->paths[i]);
    free(list->paths);
    lock_end(&list->lock);
}
