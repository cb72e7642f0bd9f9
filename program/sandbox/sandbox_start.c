// sandbox_start.c: determines the files that a command may access.
#include "sandbox_start.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <lambent/path.h>

#include "console.h"
#include "joined_models.h"
#include "limit_options.h"
#include "file_io.h"

static struct sandbox_state active = {.reason = "not entered", .starter = -1};

const struct sandbox_state *sandbox_active(void) { return &active; }

const char *sandbox_advice(const lam_error *error)
{
    bool denied = error->code == LAM_CANNOT_READ && strstr(error->text, strerror(EACCES));
    return active.landlock && denied
               ? "; the sandbox allows reading only in the model's folder and in the folders of --allow-path"
               : "";
}

// Adds the folder of a path: the text up to and including its last "/", or "." if the path contains no "/". Returns
// false if memory runs out.
static bool add_folder_of(struct sandbox_paths *paths, const char *path, int access)
{
    const char *slash = strrchr(path, '/');
    char *folder = slash ? strndup(path, (size_t)(slash + 1 - path)) : strdup(".");
    if (folder)
        sandbox_add(paths, folder, access);
    paths->failed |= !folder;
    free(folder);
    return !paths->failed;
}

static bool is_scene_file(const char *model)
{
    const char *dot = strrchr(model, '.');
    return dot && strcmp(dot, ".json") == 0;
}

// Returns whether the name says that Lambent reads the file itself. The content decides, so other names may need
// lambent-import.
static bool is_own_format(const char *model)
{
    const char *dot = strrchr(model, '.');
    size_t length = dot ? strlen(dot + 1) : 0;
    for (int i = 0; length && lam_model_format_name(i) && !lam_model_format_package(i, NULL); i++) {
        const char *list = lam_model_format_extensions(i), *at = strcasestr(list, dot + 1);
        if (at && (at == list || at[-1] == ' ') && (!at[length] || at[length] == ' '))
            return true;
    }
    return false;
}

void sandbox_add_input(struct sandbox_paths *paths, const char *model)
{
    const char *next = joined_models_next(model);
    if (next) {
        char *first = strndup(model, (size_t)(next - model) - strlen(JOINED_MODELS));
        if (first)
            sandbox_add_input(paths, first);
        free(first);
        sandbox_add_input(paths, next);
        return;
    }
    paths->imports |= strcmp(model, "-") == 0;
    if (strcmp(model, "-") == 0 || lam_shape_find(model) >= 0)
        return;
    struct stat about;
    if (lstat(model, &about) != 0 || S_ISLNK(about.st_mode))
        sandbox_add(paths, model, SANDBOX_READ); // a link to a file in another folder
    add_folder_of(paths, model, SANDBOX_READ);
    paths->scene_files |= is_scene_file(model);
    paths->imports |= is_scene_file(model) || !is_own_format(model);
}

void sandbox_add_file(struct sandbox_paths *paths, const char *file) { sandbox_add(paths, file, SANDBOX_READ); }

void sandbox_add_older(struct sandbox_paths *paths, const char *path)
{
    struct stat about;
    if (strcmp(path, "-") == 0 || lam_path_stat(path, &about) != 0)
        return;
    if (S_ISREG(about.st_mode))
        sandbox_add(paths, path, SANDBOX_READ); // reading the file shows whether Lambent wrote it
    else if (!S_ISDIR(about.st_mode))
        sandbox_add(paths, path, SANDBOX_WRITE);
}

void sandbox_add_output(struct sandbox_paths *paths, const char *path, bool by_model)
{
    sandbox_add_older(paths, path);
    if (strcmp(path, "-") != 0)
        sandbox_add(paths, path, by_model ? SANDBOX_MAKE : SANDBOX_REPLACE);
}

// Adds the paths in a list separated by `separator`.
static void add_list(struct sandbox_paths *paths, const char *list, char separator)
{
    for (const char *at = list; at && *at;) {
        const char *end = strchrnul(at, separator);
        char *path = strndup(at, (size_t)(end - at));
        paths->failed |= !path;
        if (path && *path)
            sandbox_add(paths, path, SANDBOX_READ);
        free(path);
        at = *end ? end + 1 : end;
    }
}

// Adds the system files that the program reads: shared libraries, fonts, the number of processors, and the seed of
// Jansson's hash tables.
static void add_system(struct sandbox_paths *paths)
{
    static const char *const folders[] = {
        "/lib",
        "/lib64",
        "/usr/lib",
        "/usr/lib64",
        "/usr/local/lib",
        "/etc/ld.so.cache",
        "/nix/store",
        "/gnu/store",
        "/usr/share/fonts",
        "/usr/local/share/fonts",
        "/sys/devices/system/cpu",
        "/dev/urandom",
    };
    for (size_t i = 0; i < sizeof folders / sizeof *folders; i++)
        sandbox_add(paths, folders[i], SANDBOX_READ);
    add_list(paths, getenv("LD_LIBRARY_PATH"), ':');
    add_list(paths, getenv("LAMBENT_FONT"), 0);
    // The Draco module in the library's search path (src/system/dynamic_library.c).
    static const char *const modules[] = {"", "../", "lambent/", "../" LAMBENT_LIBDIR "/lambent/"};
    char own[PATH_MAX], path[PATH_MAX + 100];
    bool known = own_folder(own);
    for (size_t i = 0; known && i < sizeof modules / sizeof *modules; i++) {
        snprintf(path, sizeof path, "%s%slambent-draco.so", own, modules[i]);
        sandbox_add(paths, path, SANDBOX_READ);
    }
}

void sandbox_add_options(struct sandbox_paths *paths, const struct options *o)
{
    for (int i = 0; i < o->limits.allow_paths.count; i++)
        sandbox_add(paths, o->limits.allow_paths.items[i], SANDBOX_READ);
    if (o->shading.environment)
        add_list(paths, o->shading.environment, ',');
    if (o->lighting.look)
        sandbox_add(paths, o->lighting.look, SANDBOX_READ);
    if (o->captions.font)
        sandbox_add(paths, o->captions.font, SANDBOX_READ);
    if (o->picture.save_scene)
        sandbox_add_output(paths, o->picture.save_scene, false);
}

bool sandbox_hold(const struct options *o, char **operands, int count, lam_error *error)
{
    const char *const named[] = {o->picture.output ? o->picture.output : ".",
                                 o->picture.save_scene,
                                 o->batch.journal,
                                 o->batch.report_page,
                                 o->hash.check,
                                 o->hash.pictures};
    const struct texts *allowed = &o->limits.allow_paths;
    bool ok = true;
    if (o->batch.isolate || o->batch.jobs || o->limits.sandbox == SANDBOX_REQUIRE)
        lam_path_refuse_links();
    for (int i = 0; ok && i < allowed->count; i++)
        ok = lam_path_hold(allowed->items[i], true, error);
    for (int i = 0; ok && i < count; i++)
        ok = lam_path_hold(operands[i], false, error);
    for (size_t i = 0; ok && i < sizeof named / sizeof *named; i++)
        ok = !named[i] || lam_path_hold(named[i], false, error);
    char *list = o->shading.environment ? strdup(o->shading.environment) : NULL, *rest = list;
    for (char *file; ok && (file = strsep(&rest, ","));)
        ok = lam_path_hold(file, false, error);
    free(list);
    return ok;
}

static bool check_required(const struct options *o, lam_error *error)
{
    if (o->limits.sandbox != SANDBOX_REQUIRE || (active.landlock && active.filter))
        return true;
    return complain(error, LAM_UNSUPPORTED, "option '--sandbox require': the sandbox is not complete: %s",
                    active.reason);
}

bool sandbox_is_wanted(const struct options *o)
{
    struct sandbox_state offered = sandbox_offered();
    return o->limits.sandbox != SANDBOX_OFF && !device_option_is_gl(o) && (offered.landlock || offered.filter);
}

static enum writer_right right_of(void *user, const char *path)
{
    const struct sandbox_paths *paths = user;
    enum writer_right right = WRITER_NONE;
    for (int i = 0; i < paths->count; i++)
        if (strcmp(paths->items[i].path, path) == 0)
            right = paths->items[i].access & SANDBOX_REPLACE ? WRITER_ANY
                    : paths->items[i].access & SANDBOX_MAKE  ? WRITER_NEW_OR_OURS
                                                             : right;
    return right;
}

// Starts the writer if a file may be written and no writer is running.
static bool start_writer(const struct options *o, struct sandbox_paths *paths, lam_error *error)
{
    bool writes = paths->may_write;
    for (int i = 0; i < paths->count; i++)
        writes |= (paths->items[i].access & (SANDBOX_MAKE | SANDBOX_REPLACE)) != 0;
    if (!writes || writer_is_there() || paths->failed)
        return true;
    if (!paths->may_write) {
        paths->may_write = right_of;
        paths->user = paths;
    }
    return writer_start(paths, limits_memory(o), error);
}

bool sandbox_start(const struct options *o, struct sandbox_paths *paths, lam_error *error)
{
    bool ok = true, everything = paths->scene_files && !o->limits.files_inside && !o->limits.allow_paths.count;
    if (o->limits.sandbox == SANDBOX_OFF) {
        active.reason = "--sandbox off";
    } else if (device_option_is_gl(o)) {
        active.reason = "OpenGL's driver needs privileges that a sandbox removes";
        ok = check_required(o, error);
    } else if (o->limits.sandbox == SANDBOX_REQUIRE && sandbox_offered().reason) {
        active = (struct sandbox_state){.reason = sandbox_offered().reason};
        ok = check_required(o, error);
    } else {
        limits_memory(o); // both read system files that are inaccessible afterwards
        lam_processors_available();
        add_system(paths);
        sandbox_add_options(paths, o);
        if (everything)
            sandbox_add(paths, "/", SANDBOX_READ);
        ok = (!sandbox_is_wanted(o) || start_writer(o, paths, error)) && sandbox_enter(paths, &active, error) &&
             check_required(o, error);
        active.reads_everything = everything;
    }
    sandbox_paths_free(paths);
    return ok;
}
