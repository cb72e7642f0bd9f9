// import.c: from a file or memory to a scene: the table of formats, and the steps that all of them share.
#include "importer.h"

#include "fail.h"
#include "float_state.h"
#include "unsupported_formats.h"

#include <lambent/image.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

static const struct importer *const importers[] = {&importer_obj, &importer_stl, &importer_ply, &importer_scene};
enum { IMPORTERS = sizeof importers / sizeof *importers };

const char *lam_format_name(int format) { return format >= 0 && format < IMPORTERS ? importers[format]->name : NULL; }

const char *lam_format_extensions(int format)
{
    return format >= 0 && format < IMPORTERS ? importers[format]->extensions : NULL;
}

// --- errors with a place

static bool fail_at(lam_error *error, const char *place, const char *format, va_list arguments)
{
    char sentence[sizeof error->text];
    vsnprintf(sentence, sizeof sentence, format, arguments);
    return fail(error, LAM_CANNOT_READ, "%s: %s", place, sentence);
}

bool fail_line(lam_error *error, const struct import_source *source, size_t line, const char *format, ...)
{
    if (!error)
        return false;
    char place[sizeof error->text];
    snprintf(place, sizeof place, "%s:%zu", source->name, line);
    va_list arguments;
    va_start(arguments, format);
    fail_at(error, place, format, arguments);
    va_end(arguments);
    return false;
}

bool fail_byte(lam_error *error, const struct import_source *source, size_t offset, const char *format, ...)
{
    if (!error)
        return false;
    char place[sizeof error->text];
    snprintf(place, sizeof place, "%s: byte %zu", source->name, offset);
    va_list arguments;
    va_start(arguments, format);
    fail_at(error, place, format, arguments);
    va_end(arguments);
    return false;
}

// --- which format

// "obj, stl and ply"
static const char *format_list(char out[128])
{
    size_t used = 0;
    for (int i = 0; i < IMPORTERS; i++) {
        const char *between = i == 0 ? "" : i == IMPORTERS - 1 ? " and " : ", ";
        used += (size_t)snprintf(out + used, 128 - used, "%s%s", between, importers[i]->name);
    }
    return out;
}

static bool has_ending(const struct importer *importer, const char *ending)
{
    const char *word = importer->extensions;
    size_t length = strlen(ending);
    while (*word && length) {
        size_t end = strcspn(word, " ");
        if (end == length && strncasecmp(word, ending, length) == 0)
            return true;
        word += end;
        word += strspn(word, " ");
    }
    return false;
}

// Content decides. Where it leaves a choice, or says nothing, the name's ending does.
const struct importer *importer_for(const char *name, const struct file_bytes *file, const char *wanted,
                                    lam_error *error)
{
    char list[128];
    if (wanted) {
        for (int i = 0; i < IMPORTERS; i++) {
            if (strcasecmp(importers[i]->name, wanted) == 0 || has_ending(importers[i], wanted))
                return importers[i];
        }
        fail(error, LAM_UNSUPPORTED, "%s: the format '%s' cannot be read; this version reads %s", name, wanted,
             format_list(list));
        return NULL;
    }
    if (file->size == 0) {
        fail(error, LAM_CANNOT_READ, "%s: the file is empty", name);
        return NULL;
    }
    const char *ending = path_ending(name);
    const struct importer *by_content = NULL, *by_ending = NULL;
    int best = 0;
    for (int i = 0; i < IMPORTERS; i++) {
        int sure = importers[i]->probe(file->data, file->size);
        bool named = has_ending(importers[i], ending);
        if (named)
            by_ending = importers[i];
        if (sure > best || (sure == best && sure > 0 && named)) {
            best = sure;
            by_content = importers[i];
        }
    }
    if (best == 2)
        return by_content;
    // Known to be something else, whatever its name says.
    const struct unsupported_format *foreign = unsupported_format_of(file->data, file->size);
    if (foreign && foreign->is_model) {
        fail(error, LAM_UNSUPPORTED, "%s: this is %s, which this version cannot read yet; it reads %s", name,
             foreign->name, format_list(list));
        return NULL;
    }
    if (foreign) {
        fail(error, LAM_CANNOT_READ, "%s: this is %s, not a 3D model; expected %s", name, foreign->name,
             format_list(list));
        return NULL;
    }
    if (by_ending)
        return by_ending; // its reader says what is wrong
    fail(error, LAM_CANNOT_READ, "%s: this is no model format known here; expected %s", name, format_list(list));
    return NULL;
}

// --- companion files

struct companions {
    const char *model; // the model's path; NULL: it came from memory
    lam_open_fn *open;
    void *user;
};

bool confine(const char *name, char *out, size_t room)
{
    size_t length = strlen(name);
    if (length >= room)
        return false;
    for (size_t i = 0; i <= length; i++)
        out[i] = name[i] == '\\' ? '/' : name[i];
    bool leaves = out[0] == '/' || (out[0] && out[1] == ':');
    for (const char *part = out; *part;) {
        size_t end = strcspn(part, "/");
        leaves |= end == 2 && part[0] == '.' && part[1] == '.';
        part += end;
        part += strspn(part, "/");
    }
    if (leaves) {
        const char *last = path_name(out);
        memmove(out, last, strlen(last) + 1);
    }
    return true;
}

enum { PATH_LONGEST = 4096 };

// Through the caller's function, by the name as it may be looked for.
static bool open_by_caller(const struct import_source *source, const char *inside, struct file_bytes *out,
                           lam_error *error)
{
    const struct companions *companions = source->open_state;
    if (!companions->open)
        return fail(error, LAM_CANNOT_READ, "%s: the file '%s' is not at hand", source->name, inside);
    lam_bytes bytes = {0};
    if (!companions->open(companions->user, inside, &bytes, error))
        return false;
    bool ok = file_copy(bytes.data, bytes.size, source->call, out, error);
    lam_bytes_free(&bytes);
    return ok;
}

// The name beside the model, as it can be opened from here.
static bool beside(const struct import_source *source, const char *name, char path[2 * PATH_LONGEST], lam_error *error)
{
    const char *model = ((const struct companions *)source->open_state)->model;
    int folder = name[0] == '/' ? 0 : (int)(path_name(model) - model);
    // Behind "./" a file called "-" is a file.
    int length =
        snprintf(path, 2 * PATH_LONGEST, "%.*s%s%s", folder, model, folder == 0 && name[0] == '-' ? "./" : "", name);
    if (length < 0 || length >= 2 * PATH_LONGEST)
        return fail(error, LAM_CANNOT_READ, "%s: the path to '%.80s' is too long", source->name, name);
    return true;
}

// A pipe or a device of that name would be waited for.
static bool read_regular(const struct import_source *source, const char *path, struct file_bytes *out, lam_error *error)
{
    struct stat about;
    if (stat(path, &about) == 0 && !S_ISREG(about.st_mode))
        return fail(error, LAM_CANNOT_READ, "%s: is not a file", path);
    return file_read(path, source->pool, source->call, out, error);
}

static bool confine_or_fail(const struct import_source *source, const char *name, char inside[PATH_LONGEST],
                            lam_error *error)
{
    if (!confine(name, inside, PATH_LONGEST) || !*inside || strcmp(inside, "..") == 0)
        return fail(error, LAM_CANNOT_READ, "%s: names a file '%.80s' that cannot be looked for", source->name, name);
    return true;
}

static bool open_companion(const struct import_source *source, const char *name, struct file_bytes *out,
                           lam_error *error)
{
    const struct companions *companions = source->open_state;
    char inside[PATH_LONGEST], path[2 * PATH_LONGEST];
    if (!confine_or_fail(source, name, inside, error))
        return false;
    if (companions->open || !companions->model)
        return open_by_caller(source, inside, out, error);
    return beside(source, inside, path, error) && read_regular(source, path, out, error);
}

static bool open_model(const struct import_source *source, const char *name, struct arena *arena, const char **path,
                       struct file_bytes *out, lam_error *error)
{
    const struct companions *companions = source->open_state;
    char inside[PATH_LONGEST], at[2 * PATH_LONGEST];
    *path = NULL;
    if (!source->params->models_anywhere || companions->open || !companions->model) {
        if (!confine_or_fail(source, name, inside, error))
            return false;
        if (companions->open || !companions->model)
            return open_by_caller(source, inside, out, error);
        name = inside;
    }
    if (!beside(source, name, at, error))
        return false;
    *path = arena_string(arena, at);
    if (!*path)
        return call_memory_error(source->call, strlen(at), error);
    return read_regular(source, at, out, error);
}

// --- the steps

static bool check_params(const lam_load_params *params, const char *name, lam_error *error)
{
    double crease = params->crease_angle_rad;
    if (!(crease >= 0 && crease <= 3.1415927))
        return fail(error, LAM_BAD_ARGUMENT, "%s: crease_angle_rad is %g, expected 0 to pi", name, crease);
    if (params->threads < 0 || params->threads > 1024)
        return fail(error, LAM_BAD_ARGUMENT, "%s: threads is %d, expected 0 to 1024", name, params->threads);
    if ((unsigned)params->up > LAM_UP_Z || (unsigned)params->color > LAM_COLOR_RAW ||
        (unsigned)params->normals > LAM_NORMALS_FACET)
        return fail(error, LAM_BAD_ARGUMENT, "%s: up, color or normals is not one of its constants", name);
    return true;
}

static bool check_not_empty(const struct lam_scene *scene, const char *name, lam_error *error)
{
    uint64_t triangles = 0, points = 0;
    for (int i = 0; i < scene->meshes.count; i++) {
        const lam_mesh *mesh = (const lam_mesh *)scene->meshes.items + i;
        triangles += mesh->triangle_count;
        points += mesh->vertex_count;
    }
    if (triangles)
        return true;
    if (points)
        return fail(error, LAM_CANNOT_READ, "%s: holds no triangles (%llu points only)", name,
                    (unsigned long long)points);
    return fail(error, LAM_CANNOT_READ, "%s: holds no triangles", name);
}

static struct lam_scene *start_scene(const struct import_source *source, const struct importer *importer,
                                     lam_error *error)
{
    const lam_load_params *params = source->params;
    struct lam_scene *scene = scene_make(source->call, error);
    if (scene) {
        scene->format = importer->name;
        scene->color = params->color;
        scene->up = params->up == LAM_UP_AUTO ? importer->up : params->up;
    }
    return scene;
}

// What follows reading: where it came from, normals, extents.
static bool finish(struct lam_scene *scene, const struct import_source *source, const struct importer *importer,
                   uint64_t start_ns, lam_error *error)
{
    const lam_load_params *params = source->params;
    if (!check_not_empty(scene, source->name, error))
        return false;
    // A scene file notes where each of its models came from by itself.
    struct scene_origin origin = {.normals = params->normals, .crease_angle_rad = params->crease_angle_rad};
    if (importer != &importer_scene && source->path) {
        origin.path = arena_string(&scene->arena, source->path);
        if (!origin.path)
            return call_memory_error(source->call, strlen(source->path), error);
    }
    if (importer != &importer_scene && !scene_note_origin(scene, origin, 0, error))
        return false;
    uint64_t read_ns = now_ns();
    scene->read_ms = (double)(read_ns - start_ns) * 1e-6;
    call_progress(source->call, 0.8, "normals");
    if (params->normals_when_drawn && params->normals != LAM_NORMALS_FACET && importer != &importer_scene)
        scene_defer_normals(scene, params->normals, params->crease_angle_rad);
    else if (!scene_prepare(scene, params->normals, params->crease_angle_rad, source->pool, source->call, error))
        return false;
    if (!scene_measure(scene, source->pool, error))
        return false;
    scene->prepare_ms = (double)(now_ns() - read_ns) * 1e-6;
    call_progress(source->call, 1, "normals");
    return true;
}

// The importer that reads a file of this beginning and size part by part: the one that would be chosen for
// the whole.
static const struct importer *importer_of_parts(const char *name, const uint8_t *head, size_t size, const char *wanted)
{
    if (wanted) {
        const struct importer *importer = importer_for(name, NULL, wanted, NULL);
        return importer && importer->load_parts ? importer : NULL;
    }
    for (int i = 0; i < IMPORTERS; i++) // those that have load_parts look at no more than the head
        if (importers[i]->probe(head, importers[i]->load_parts ? size : FILE_HEAD) == 2)
            return importers[i]->load_parts ? importers[i] : NULL;
    return NULL;
}

// A large file of a layout that is read part by part; NULL: it is none, and nothing was said.
static struct lam_scene *load_parts(struct import_source *source, const struct importer **importer)
{
    uint8_t *head = malloc(FILE_HEAD + FILE_PADDING);
    struct file_parts file;
    struct lam_scene *scene = NULL;
    if (head && source->path && file_open_parts(source->path, head, &file)) {
        source->bytes = head;
        source->size = FILE_HEAD;
        *importer = importer_of_parts(source->name, head, file.size, source->params->format);
        if (*importer)
            scene = start_scene(source, *importer, NULL);
        if (scene && !(*importer)->load_parts(source, &file, scene)) {
            lam_scene_free(scene);
            scene = NULL;
        }
        file_close_parts(&file);
        source->bytes = NULL;
        source->size = 0;
    }
    free(head);
    return scene;
}

// `path` or else `bytes`.
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
    struct companions companions = {.model = path, .open = params->open, .user = params->user};
    struct import_source source = {
        .name = name,
        .path = path && strcmp(path, "-") != 0 ? path : NULL,
        .params = params,
        .pool = pool_make(params->threads),
        .call = &call,
        .open = open_companion,
        .open_model = open_model,
        .open_state = &companions,
    };
    struct lam_scene *scene = NULL;
    struct file_bytes file = {0};
    const struct importer *importer = NULL;
    bool ok = source.pool || fail(error, LAM_LIMIT, "%s: out of memory for threads", name);
    if (ok)
        scene = load_parts(&source, &importer);
    ok = ok && (scene  ? true
                : path ? file_read(path, source.pool, &call, &file, error)
                       : file_copy(bytes, size, &call, &file, error));
    if (ok && !scene) {
        source.bytes = file.data;
        source.size = file.size;
        call_progress(&call, 0.05, "read");
        importer = importer_for(name, &file, params->format, error);
        scene = importer ? start_scene(&source, importer, error) : NULL;
        ok = scene && importer->load(&source, scene, error);
    }
    ok = ok && finish(scene, &source, importer, start_ns, error);
    if (ok)
        scene_built(scene);
    else
        lam_scene_free(scene);
    file_release(&file);
    pool_free(source.pool);
    float_state_leave(state);
    return ok ? scene : NULL;
}

lam_scene *lam_scene_load(const char *path, const lam_load_params *params, const lam_control *control, lam_error *error)
{
    if (!path || !*path) {
        fail(error, LAM_BAD_ARGUMENT, "no file name given");
        return NULL;
    }
    return load(path, NULL, 0, strcmp(path, "-") == 0 ? "standard input" : path, params, control, error);
}

lam_scene *lam_scene_load_memory(const void *bytes, size_t size, const char *name, const lam_load_params *params,
                                 const lam_control *control, lam_error *error)
{
    if (!bytes && size) {
        fail(error, LAM_BAD_ARGUMENT, "no bytes given");
        return NULL;
    }
    return load(NULL, bytes, size, name ? name : "(memory)", params, control, error);
}
