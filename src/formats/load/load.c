// load.c: loads a scene from a file or memory: the steps that all formats share.
#include "clear_models.h"
#include "companion.h"
#include "fail.h"
#include "file_list.h"
#include "float_state.h"
#include "formats.h"
#include "prepare.h"
#include "unsupported_formats.h"
#include "up_guess.h"

#include <lambent/image.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool check_params(const lam_load_params *params, const char *name, lam_error *error)
{
    if (!check_reserved(name, params, error))
        return false;
    double crease = params->crease_angle_rad;
    if (!(crease >= 0 && crease <= 3.1415927))
        return fail(error, LAM_BAD_ARGUMENT, "%s: crease_angle_rad is %g, expected 0 to pi", name, crease);
    if (!(params->time_s - params->time_s == 0))
        return fail(error, LAM_BAD_ARGUMENT, "%s: time_s is not finite", name);
    double deflection = params->deflection;
    if (deflection != 0 && !(deflection >= 1e-6 && deflection <= 0.1))
        return fail(error, LAM_BAD_ARGUMENT, "%s: deflection is %g, expected 1e-6 to 0.1", name, deflection);
    if (params->threads < 0 || params->threads > 1024)
        return fail(error, LAM_BAD_ARGUMENT, "%s: threads is %d, expected 0 to 1024", name, params->threads);
    if ((unsigned)params->up >= LAM_UP_COUNT || (unsigned)params->color > LAM_COLOR_RAW ||
        (unsigned)params->normals > LAM_NORMALS_FACET)
        return fail(error, LAM_BAD_ARGUMENT, "%s: up, color or normals is not one of its constants", name);
    return true;
}

static bool check_not_empty(const struct lam_scene *scene, const char *name, lam_error *error)
{
    uint64_t items = 0;
    for (int i = 0; i < scene->meshes.count; i++)
        items += mesh_items(scene_mesh(scene, i));
    return items || fail(error, LAM_CANNOT_READ, "%s: contains no triangles, lines or points", name);
}

static struct lam_scene *start_scene(const struct import_source *source, const struct importer *importer,
                                     lam_error *error)
{
    const lam_load_params *params = source->params;
    struct lam_scene *scene = scene_make(source->call, error);
    if (scene) {
        scene->format = importer->name;
        scene->color = params->color;
        scene->up = params->up == LAM_UP_AUTO || params->up == LAM_UP_FILE ? importer->up : params->up;
    }
    return scene;
}

// Runs the steps after reading: origin, normals, tangents, bounds.
static bool finish(struct lam_scene *scene, const struct import_source *source, const struct importer *importer,
                   uint64_t start_ns, lam_error *error)
{
    const lam_load_params *params = source->params;
    if (!importer->is_scene_file &&
        (!scene_repair(scene, source->name, params->normals, params->crease_angle_rad, source->pool, error) ||
         !scene_give_colors_white(scene, error)))
        return false;
    if (!check_not_empty(scene, source->name, error))
        return false;
    // A scene file describes its own transparency, but the MTL files of its models may be wrong.
    if (!importer->is_scene_file || scene->clear_materials)
        show_clear_scene(scene, source->name);
    // The importer of scene files has already recorded the origin of each model.
    struct scene_origin origin = {.normals = params->normals, .crease_angle_rad = params->crease_angle_rad};
    if (!importer->is_scene_file && source->path) {
        origin.path = arena_string(&scene->arena, source->path);
        origin.scene = arena_string(&scene->arena, params->scene);
        origin.variant = arena_string(&scene->arena, params->variant);
        origin.animation = arena_string(&scene->arena, params->animation);
        origin.time_s = params->time_s;
        if (!origin.path || !origin.scene != !params->scene || !origin.variant != !params->variant ||
            !origin.animation != !params->animation)
            return call_memory_error(source->call, strlen(source->path), error);
    }
    if (!importer->is_scene_file && !scene_note_origin(scene, origin, 0, error))
        return false;
    uint64_t read_ns = now_ns();
    scene->read_ms = (double)(read_ns - start_ns) * 1e-6;
    call_progress(source->call, 0.8, "normals");
    double crease_angle_rad = importer_crease(importer, params->normals, params->crease_angle_rad);
    bool tangents = scene_needs_tangents(scene); // computing tangents requires normals
    if (params->normals_when_drawn && !importer->is_scene_file && !tangents)
        scene_defer_normals(scene, params->normals, crease_angle_rad);
    else if (!scene_prepare(scene, params->normals, crease_angle_rad, source->pool, source->call, error))
        return false;
    if (tangents && !scene_make_tangents(scene, false, source->call, error))
        return false;
    if (!scene_measure(scene, source->pool, error))
        return false;
    if (params->up == LAM_UP_AUTO || params->up == LAM_UP_FILE)
        guess_up(scene, importer, params->up == LAM_UP_AUTO, source);
    if (scene->settings && scene->settings->section_count &&
        !scene_cut(scene, scene->settings->sections, scene->settings->section_count, source->call, error))
        return false;
    if (scene_needs_form(scene))
        scene_find_form(scene, source->pool);
    scene->prepare_ms = (double)(now_ns() - read_ns) * 1e-6;
    call_progress(source->call, 1, "normals");
    return true;
}

// If a path cannot be opened, and is a web address or names an unsupported format, adds an explanation to the error.
static void explain_path(const char *path, lam_error *error)
{
    char list[FORMAT_LIST_SIZE];
    const struct unsupported_format *foreign = unsupported_format_named(path_ending(path));
    for (const struct importer *m = module_importers; foreign && m->name; m++)
        foreign = strcmp(m->described, foreign->name) == 0 ? NULL : foreign;
    bool address = strstr(path, "://") != NULL;
    if (!error || error->code != LAM_CANNOT_READ || (!address && !foreign))
        return;
    size_t used = strlen(error->text);
    if (address)
        used += (size_t)snprintf(error->text + used, sizeof error->text - used,
                                 "; this is an address, expected a file: download it first");
    if (used < sizeof error->text)
        snprintf(error->text + used, sizeof error->text - used, "; lambent reads %s%s%s", format_list(list),
                 foreign ? ": export the model as " : "", foreign ? foreign->instead : "");
}

// Opens `path`, or the bytes if `path` is NULL, and loads the scene. On failure, *scene is NULL or an incomplete scene,
// which the caller frees.
static bool read(struct import_source *source, const char *path, const void *bytes, size_t size,
                 const struct importer **importer, lam_scene **scene, lam_error *error)
{
    struct file_bytes *head = source->file;
    if (!(path ? file_open_parts(path, source->call, &source->parts, head, error)
               : file_copy(bytes, size, source->call, head, error))) {
        if (path)
            explain_path(path, error);
        return false;
    }
    if (!path) {
        source->parts = (struct file_parts){.file = -1, .memory = head->data, .size = size};
        call_add_input(source->call, size);
    }
    source->bytes = head->data;
    source->size = head->size;
    call_progress(source->call, 0.05, "read");
    *importer =
        !file_check_pointer(head, source->name, error) ? NULL : importer_for(source, source->params->format, error);
    *scene = *importer ? start_scene(source, *importer, error) : NULL;
    return *scene && (*importer)->load(source, *scene, error);
}

// Loads from `path`, or from `bytes` if `path` is NULL.
static lam_scene *load(const char *path, const void *bytes, size_t size, const char *name, const lam_load_params *given,
                       const lam_control *control, lam_error *error)
{
    static const lam_load_params defaults;
    const lam_load_params *params = given ? given : &defaults;
    if (!check_params(params, name, error))
        return NULL;
    uint64_t state = float_state_enter(), start_ns = now_ns();
    struct call_control call;
    call_start(&call, control);
    // The folder of `path`, spelled as the caller wrote it, including the final '/'.
    char *folder = path ? strndup(path, (size_t)(path_name(path) - path)) : NULL;
    struct file_list files;
    file_list_start(&files);
    struct companions companions = {.folder = folder,
                                    .inside = "",
                                    .open = params->open,
                                    .release = params->release,
                                    .user = params->user,
                                    .files = &files};
    struct file_bytes file = {0};
    struct import_source source = {
        .name = name,
        .path = path && strcmp(path, "-") != 0 ? path : NULL,
        .parts = {.file = -1},
        .file = &file,
        .params = params,
        .pool = pool_make(params->threads),
        .call = &call,
        .open = companion_open,
        .open_of_scene = companion_open_of_scene,
        .importer_for = importer_for,
        .open_state = &companions,
    };
    struct lam_scene *scene = NULL;
    const struct importer *importer = NULL;
    bool ok = source.pool || fail(error, LAM_MACHINE, "%s: out of memory for threads", name);
    ok = ok && (folder || !path || fail_memory(error, strlen(path)));
    ok = ok && read(&source, path, bytes, size, &importer, &scene, error);
    ok = ok && finish(scene, &source, importer, start_ns, error) && file_list_give(&files, source.path, scene, error);
    if (ok) {
        scene->input_bytes = call_input_bytes(&call);
        scene_built(scene);
    } else {
        lam_scene_free(scene);
    }
    file_close_parts(&source.parts);
    file_release(&file);
    pool_free(source.pool);
    file_list_end(&files);
    free(folder);
    float_state_leave(state);
    return ok ? scene : NULL;
}

lam_scene *lam_scene_load(const char *path, const lam_load_params *params, const lam_control *control, lam_error *error)
{
    if (!path || !*path)
        return fail(error, LAM_BAD_ARGUMENT, "no file name given"), NULL;
    return load(path, NULL, 0, strcmp(path, "-") == 0 ? "standard input" : path, params, control, error);
}

lam_scene *lam_scene_load_memory(const void *bytes, size_t size, const char *name, const lam_load_params *params,
                                 const lam_control *control, lam_error *error)
{
    if (!bytes && size)
        return fail(error, LAM_BAD_ARGUMENT, "no bytes given"), NULL;
    return load(NULL, bytes, size, name ? name : "(memory)", params, control, error);
}
