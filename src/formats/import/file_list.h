// file_list.h: lists the files that a load tried to open.
#ifndef FILE_LIST_H
#define FILE_LIST_H

#include "lock.h"
#include "name_table.h"
#include "scene_internal.h"

struct file_list {
    lock lock; // several threads may open companions
    struct arena memory;
    struct name_table paths;
    bool incomplete; // memory ran out
};

void file_list_start(struct file_list *list);

// Adds a copy of a path. Any thread may call this function. Returns whether the path is new. `list` may be NULL.
bool file_list_add(struct file_list *list, const char *path);

// Adds the paths to the scene, which copies them to its arena: first the model's own path (may be NULL), then the other
// paths in alphabetical order, without duplicates. Returns false if memory runs out.
bool file_list_give(struct file_list *list, const char *model, struct lam_scene *scene, lam_error *error);

void file_list_end(struct file_list *list);

#endif
