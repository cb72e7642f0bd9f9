// obj_libraries.c: reads the material files of an OBJ file. Each material file is read once, even if the OBJ file
// refers to it several times or in different spellings. At most OBJ_LIBRARIES_MAX names are tried, so that a small file
// cannot make the program read many large files.
#include "obj.h"

#include "fail.h"

#include <string.h>

// The result of reading a library.
enum attempt { READ, MISSING, MISSING_BEFORE, LEFT_OUT };

static bool no_memory(const struct obj *obj, size_t bytes, lam_error *error)
{
    return call_memory_error(obj->source->call, bytes, error);
}

static bool note(struct obj *obj, const char *confined, bool read, lam_error *error)
{
    const char *kept = arena_string(&obj->memory, confined);
    return (kept && name_table_add(&obj->libraries.tried, kept, read)) || no_memory(obj, strlen(confined), error);
}

// Opens and reads one file. If the file cannot be opened, `why` receives the reason.
static bool try_library(struct obj *obj, const char *name, enum attempt *attempt, lam_error *why, lam_error *error)
{
    struct obj_libraries *libraries = &obj->libraries;
    char confined[COMPANION_NAME_SIZE];
    struct companion file;
    bool cut;
    if (!companion_name(obj->source, name, confined, &cut))
        confined[0] = 0; // all invalid names share one entry in the table
    int before = name_table_find(&libraries->tried, confined);
    *attempt = before > 0 ? READ : before == 0 ? MISSING_BEFORE : LEFT_OUT;
    if (before >= 0 || libraries->tried.count == OBJ_LIBRARIES_MAX)
        return true;
    bool found = companion_find(obj->source, obj->scene, name, "", &obj->memory, &file, why);
    struct mtl_folder folder = {obj->scene->materials.count, ""};
    *attempt = found ? READ : MISSING;
    if (found)
        folder.folder = arena_string_of(&obj->memory, file.name, (size_t)(path_name(file.name) - file.name));
    bool ok = note(obj, confined, found, error);
    if (!found && why->code != LAM_CANNOT_READ) {
        if (error)
            *error = *why;
        return false;
    }
    if (found && (!folder.folder || !scene_list_append(&obj->materials.folders, &folder, sizeof folder, &obj->memory)))
        ok = no_memory(obj, sizeof folder, error);
    ok = ok && (!found || mtl_read(&obj->materials, obj->source, obj->scene, &file, error));
    file_release(&file.file);
    return ok;
}

static bool take(struct obj *obj, const char *name, const uint8_t *at, enum attempt *attempt, lam_error *error)
{
    struct obj_libraries *libraries = &obj->libraries;
    lam_error why = {0};
    if (!try_library(obj, name, attempt, &why, error))
        return false;
    if (*attempt == MISSING) {
        libraries->missing = true;
        scene_warn(obj->scene, "%s; its materials are drawn in neutral grey", why.text);
    }
    if (*attempt == LEFT_OUT && !libraries->left_out) {
        libraries->left_out = libraries->missing = true;
        scene_warn(obj->scene,
                   "%s:%zu: names more than %d material files; the others are ignored, and their materials are drawn "
                   "in neutral grey",
                   obj->source->name, obj_line_number(obj, at), OBJ_LIBRARIES_MAX);
    }
    return true;
}

bool obj_read_libraries(struct obj *obj, const char *names, const uint8_t *at, lam_error *error)
{
    enum attempt attempt;
    lam_error why = {0};
    obj->libraries.named = true;
    if (!strpbrk(names, " \t"))
        return take(obj, names, at, &attempt, error);
    if (!try_library(obj, names, &attempt, &why, error))
        return false;
    if (attempt == READ)
        return true;
    char *words = arena_string(&obj->memory, names), *rest;
    if (!words)
        return no_memory(obj, strlen(names), error);
    for (char *word = strtok_r(words, " \t", &rest); word; word = strtok_r(NULL, " \t", &rest)) {
        if (!take(obj, word, at, &attempt, error))
            return false;
    }
    return true;
}
