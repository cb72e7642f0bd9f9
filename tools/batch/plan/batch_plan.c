// batch_plan.c: the models to draw, and the names of their pictures.
#include "batch_shard.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "animate_frame.h"
#include "console.h"
#include "output.h"
#include "vectors.h"

// Makes the pattern for the pictures' names: the user's pattern, or a pattern that distinguishes several pictures of a
// model. If the pattern remains NULL, a picture is named after its model.
static bool make_pattern(struct batch_plan *plan, lam_error *error)
{
    const struct options *o = plan->options;
    const char *output = o->picture.output, *side = o->batch.view_count > 1 ? "-{view}" : "",
               *size = o->batch.size_count > 1 ? "-{size}" : "", *show = o->batch.show_count > 1 ? "-{show}" : "";
    if (output_name_is_pattern(output)) {
        plan->pattern = strdup(output);
    } else if (plan->view_count > 1) {
        if (output_is_named(output))
            return complain(
                error, LAM_BAD_ARGUMENT,
                "option '--output' names one picture, but each model has %d%s; name a folder, -o pictures/, or a "
                "pattern, -o '{stem}%s%s%s.png'",
                plan->view_count, *size ? " (one size is 800x600)" : "", side, size, show);
        bool slash = output && output[strlen(output) - 1] != '/';
        if (asprintf(&plan->pattern, "%s%s{stem}%s%s%s.png", output ? output : "", slash ? "/" : "", side, size, show) <
            0)
            plan->pattern = NULL;
    } else {
        return true;
    }
    return plan->pattern
               ? output_name_check(plan->pattern,
                                   NAME_VIEW | NAME_SIZE | (animation_wanted(plan->options) ? NAME_FRAME : 0), error)
               : complain(error, LAM_MACHINE, "out of memory");
}

static bool check_together(const struct options *o, lam_error *error)
{
    static const char *const others[] = {"camera", "azimuth", "view", "elevation", "azimuths",
                                         "views",  "zoom",    "fov",  "projection"};
    const bool file = o->batch.cameras, angles = !file && o->batch.by_azimuth;
    const int count = file ? 9 : angles ? 6 : o->batch.view_count ? 5 : 0;
    for (int i = 0; i < count; i++)
        if ((!angles || i < 2 || i == 5) && option_given(o, others[i])) // azimuths have an elevation
            return complain(error, LAM_BAD_ARGUMENT, "several %s and the option '--%s' cannot be used together",
                            file     ? "cameras"
                            : angles ? "azimuths"
                                     : "sides",
                            others[i]);
    const char *wants = o->batch.resume ? "resume" : o->batch.skip_same ? "skip-same" : NULL;
    if (wants && o->batch.journal && strcmp(o->batch.journal, "none") == 0)
        return complain(error, LAM_BAD_ARGUMENT, "option '--%s' needs a journal, but '--journal none' disables it",
                        wants);
    if (o->batch.resume && o->batch.skip_same)
        return complain(
            error, LAM_BAD_ARGUMENT,
            "options '--resume' and '--skip-same' cannot be used together; --skip-same also continues a killed run");
    if (o->batch.shard_by == SHARD_BY_LIST && !o->batch.shard)
        return complain(error, LAM_BAD_ARGUMENT, "option '--shard-by' requires --shard K/N");
    if (o->batch.size_count && option_given(o, "size"))
        return complain(error, LAM_BAD_ARGUMENT, "option '--size': give all sizes in one list, such as 256,512");
    if (o->batch.show_count && option_given(o, "show"))
        return complain(error, LAM_BAD_ARGUMENT,
                        "option '--show': give all quantities in one list, such as color,depth");
    if (o->picture.save_scene && (o->batch.view_count > 1 || o->batch.size_count > 1 || o->batch.show_count > 1))
        return complain(error, LAM_BAD_ARGUMENT, "option '--save-scene' works only with a single picture");
    return true;
}

// Sets the view with this index. The options have been checked.
static void set_view(struct job_view *out, const struct options *o, int index)
{
    const char *at = o->batch.views;
    double degrees = o->view.azimuth_deg;
    out->given = o->batch.view_count > 0;
    out->view = lam_view_of_side((lam_side)o->view.side);
    if (!out->given) {
        snprintf(out->name, sizeof out->name, "%s", lam_side_name((lam_side)o->view.side));
        if (o->view.has_azimuth)
            out->view.azimuth_rad = radians(degrees);
    } else if (o->batch.by_azimuth) {
        while (index--)
            at = strchr(at, ',') + 1;
        read_number(at, &degrees);
        out->view.azimuth_rad = radians(degrees);
        snprintf(out->name, sizeof out->name, "%.*s", (int)strcspn(at, ","), at);
    } else {
        lam_views_parse(at, index, &out->view, out->name, NULL);
        out->numbered = strpbrk(at, "0123456789"); // so have the sides in a list with numbers
    }
}

// Sets the view of a camera of a file. The picture has the camera's size, unless the user gave a size.
static bool set_camera(struct job_view *out, const struct options *o, const char *text, int index, int count,
                       lam_error *error)
{
    lam_camera camera = {0};
    lam_error reason;
    if (!lam_camera_parse(text, NULL, &camera, &reason))
        return complain(error, LAM_BAD_ARGUMENT, "%s: row %d: %.300s", o->batch.cameras, index + 1, reason.text);
    if (camera.width && !o->batch.size_count && !o->picture.has_size) {
        out->width = camera.width;
        out->height = camera.height;
    }
    out->given = true;
    snprintf(out->name, sizeof out->name, "%0*d", snprintf(NULL, 0, "%d", count - 1), index);
    return (out->camera = strdup(text)) || complain(error, LAM_MACHINE, "out of memory");
}

bool batch_plan_start(struct batch_plan *plan, const struct options *o, lam_error *error)
{
    *plan = (struct batch_plan){.options = o};
    if (!check_together(o, error) || (o->batch.shard && !batch_shard_of(o->batch.shard, &plan->shard, error)))
        return false;
    plan->by_list = o->batch.shard_by == SHARD_BY_LIST;
    json_t *cameras = o->batch.cameras ? cameras_file_read(o->batch.cameras, error) : NULL;
    if (o->batch.cameras && !cameras)
        return false;
    const int views = cameras               ? (int)json_array_size(cameras)
                      : o->batch.view_count ? o->batch.view_count
                                            : 1,
              sizes = o->batch.size_count ? o->batch.size_count : 1,
              shows = o->batch.show_count ? o->batch.show_count : 1;
    plan->views = calloc((size_t)views * (size_t)sizes * (size_t)shows, sizeof *plan->views);
    bool ok = plan->views || complain(error, LAM_MACHINE, "out of memory");
    for (; ok && plan->view_count < views * sizes * shows; plan->view_count++) {
        struct job_view *view = &plan->views[plan->view_count];
        const int s = plan->view_count / shows % sizes, v = plan->view_count / (shows * sizes);
        const char *show = o->batch.shows;
        view->width = o->batch.size_count ? o->batch.sizes[s][0] : o->picture.width;
        view->height = o->batch.size_count ? o->batch.sizes[s][1] : o->picture.height;
        if (cameras)
            ok = set_camera(view, o, json_string_value(json_array_get(cameras, (size_t)v)), v, views, error);
        else
            set_view(view, o, v);
        for (int i = plan->view_count % shows; i > 0; i--)
            show = strchr(show, ',') + 1;
        if (show)
            snprintf(view->show, sizeof view->show, "%.*s", (int)strcspn(show, ","), show);
    }
    json_decref(cameras);
    ok = ok && make_pattern(plan, error);
    if (!ok)
        batch_plan_free(plan);
    return ok;
}

bool batch_plan_add(struct batch_plan *plan, const char *path, const char *root, lam_error *error)
{
    if (plan->count == plan->capacity) {
        size_t capacity = plan->capacity ? 2 * plan->capacity : 64;
        struct batch_model *more = realloc(plan->models, capacity * sizeof *more);
        if (!more)
            return complain(error, LAM_MACHINE, "out of memory");
        plan->models = more;
        plan->capacity = capacity;
    }
    struct batch_model *model = &plan->models[plan->count];
    *model = (struct batch_model){.path = strdup(path), .root = root ? strdup(root) : NULL};
    if (model->path && (model->root || !root)) {
        plan->count++;
        return true;
    }
    free(model->path);
    free(model->root);
    return complain(error, LAM_MACHINE, "out of memory");
}

void batch_plan_drop_last(struct batch_plan *plan)
{
    struct batch_model *model = &plan->models[--plan->count];
    free(model->path);
    free(model->root);
}

char *batch_plan_output(const struct batch_plan *plan, size_t index, int view)
{
    const struct batch_model *model = &plan->models[index];
    const struct job_view *v = &plan->views[view];
    struct output_words words = {.model = model->path,
                                 .root = model->root,
                                 .view = v->name,
                                 .show = *v->show                      ? v->show
                                         : plan->options->picture.show ? plan->options->picture.show
                                                                       : "color",
                                 .azimuth_deg = in_degrees(v->view.azimuth_rad),
                                 .width = v->width,
                                 .height = v->height,
                                 .frame = OUTPUT_FRAME_OPEN};
    return output_path_of(plan->pattern ? plan->pattern : plan->options->picture.output, &words);
}

bool batch_plan_transforms(const struct batch_plan *plan, size_t index, char **path)
{
    *path = NULL;
    if (!plan->view_count || !plan->views[0].numbered || (plan->pattern && output_is_stream(plan->pattern)))
        return true;
    const char *slash = plan->pattern ? strrchr(plan->pattern, '/') : NULL, *model = plan->models[index].path;
    char *first = batch_plan_output(plan, index, 0), *folder = first ? output_folder_of(first) : NULL,
         *above = slash ? strndup(plan->pattern, (size_t)(slash - plan->pattern)) : strdup("");
    bool own = plan->count == 1 || (above && output_name_has(above, "stem"));
    int length;
    const char *stem = output_stem(model, &length);
    bool ok = folder && above &&
              asprintf(path, "%s/%.*s%stransforms.json", folder, own ? 0 : length, stem, own ? "" : "-") >= 0;
    free(first);
    free(folder);
    free(above);
    return ok;
}

char *batch_plan_folder(const struct batch_plan *plan)
{
    const char *name = plan->pattern ? plan->pattern : plan->options->picture.output;
    if (!name)
        return strdup("");
    if (!output_name_is_pattern(name) && !output_is_named(name)) {
        char *folder = NULL;
        return asprintf(&folder, "%s%s", name, name[strlen(name) - 1] == '/' ? "" : "/") < 0 ? NULL : folder;
    }
    size_t length = strcspn(name, "{}");
    while (length && name[length - 1] != '/')
        length--;
    return strndup(name, length);
}

bool batch_same_output(const char *a, const char *b, const char *output, lam_error *error)
{
    if (strcmp(a, b) == 0)
        return complain(error, LAM_BAD_ARGUMENT, "'%.120s' is listed twice", a);
    return complain(
        error, LAM_BAD_ARGUMENT,
        "'%.120s' and '%.120s' would both be written to '%.120s'; name a pattern: -o '{dir}/{stem}-{ext}.png'", a, b,
        output);
}

// The name of a picture. Sorting these structs finds duplicate names.
struct named_output {
    size_t model;
    char *output;
};

static int by_output(const void *a, const void *b)
{
    const struct named_output *x = a, *y = b;
    int order = strcmp(x->output, y->output);
    return order ? order : (x->model > y->model) - (x->model < y->model);
}

static bool find_doubles(const struct batch_plan *plan, const struct named_output *named, size_t count,
                         lam_error *error)
{
    for (size_t i = 1; i < count; i++) {
        if (strcmp(named[i].output, named[i - 1].output) != 0)
            continue;
        const char *a = plan->models[named[i - 1].model].path, *b = plan->models[named[i].model].path;
        if (named[i].model == named[i - 1].model)
            return complain(
                error, LAM_BAD_ARGUMENT,
                "several pictures of '%.150s' would be written to '%.200s'; the name needs {view}, {size} or {show}", a,
                named[i].output);
        return batch_same_output(a, b, named[i].output, error);
    }
    return true;
}

// Keeps only the models of this shard, in order.
static bool keep_shard(struct batch_plan *plan, lam_error *error)
{
    size_t kept = 0;
    bool ok = true;
    for (size_t i = 0; i < plan->count; i++) {
        struct batch_model *model = &plan->models[i];
        char *name = ok ? batch_shard_name(model->path, model->root) : NULL;
        ok = name != NULL;
        if (ok && batch_shard_of_name(name, plan->shard.count) == plan->shard.number) {
            plan->models[kept++] = *model;
        } else {
            free(model->path);
            free(model->root);
        }
        free(name);
    }
    plan->count = kept;
    return ok || complain(error, LAM_MACHINE, "out of memory");
}

// Returns whether a file of cameras is missing or was written by Lambent.
static bool may_replace(const char *path, lam_error *error)
{
    char start[64] = "";
    FILE *file = fopen(path, "rb");
    if (!file)
        return true;
    size_t size = fread(start, 1, sizeof start - 1, file);
    fclose(file);
    return (size && strstr(start, "\"lambent\"")) ||
           complain(error, LAM_CANNOT_WRITE,
                    "%s: already exists, and lambent did not write it; name another folder with -o", path);
}

bool batch_plan_check(struct batch_plan *plan, lam_error *error)
{
    if (plan->by_list && plan->listed < plan->count)
        return complain(error, LAM_BAD_ARGUMENT,
                        "option '--shard-by list' divides a single list; give only @FILE or --files-from FILE");
    const size_t each = (size_t)plan->view_count + 1,
                 count = plan->count * each; // the last file is the list of cameras
    size_t used = 0;
    struct named_output *named = calloc(count + 1, sizeof *named);
    bool ok = named || complain(error, LAM_MACHINE, "out of memory");
    for (size_t i = 0; ok && i < count; i++) {
        const size_t model = i / each, view = i % each;
        char *output = NULL;
        const bool cameras = view + 1 == each, made = !cameras || batch_plan_transforms(plan, model, &output);
        if (!cameras)
            output = batch_plan_output(plan, model, (int)view);
        if (output)
            named[used++] = (struct named_output){model, output};
        ok = made && (output || cameras) ? !cameras || !output || may_replace(output, error)
                                         : complain(error, LAM_MACHINE, "out of memory");
    }
    if (ok)
        qsort(named, used, sizeof *named, by_output);
    ok = ok && find_doubles(plan, named, used, error);
    for (size_t i = 0; i < used; i++)
        free(named[i].output);
    free(named);
    return ok && (!plan->shard.count || plan->by_list || keep_shard(plan, error));
}

void batch_plan_free(struct batch_plan *plan)
{
    while (plan->count)
        batch_plan_drop_last(plan);
    free(plan->models);
    for (int i = 0; i < plan->view_count; i++)
        free(plan->views[i].camera);
    free(plan->views);
    free(plan->pattern);
    *plan = (struct batch_plan){0};
}
