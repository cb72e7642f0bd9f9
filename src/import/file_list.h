// file_list.h: lists the files that a load looked for, found or not.
#ifndef FILE_LIST_H
#define FILE_LIST_H

#include "lock.h"
#include "name_table.h"
#include "scene_internal.h"

struct file_list {
    lock lock; // companions may be opened by several threads
    struct arena memory;
    struct name_table paths;
    bool incomplete; // out of memory
};

void file_list_start(struct file_list *list);

// Adds a copy of a path, from any thread. Returns whether it is new. `list` may be NULL.
bool file_list_add(struct file_list *list, const char *path);

// Gives the model's own path (NULL: none) and then the others, in alphabetical order and each once, to the scene, whose
// arena copies them. Returns false if memory runs out.
bool file_list_give(struct file_list *list, const char *model, struct lam_scene *scene, lam_error *error);

void file_list_end(struct file_list *list);

#endif
