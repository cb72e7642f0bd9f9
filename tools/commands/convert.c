// convert.c: the command `convert`: writes a model or a scene in another format.
#include "command.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include <lambent/export.h>

#include "console.h"
#include "limit_options.h"
#include "interrupt.h"
#include "job.h"
#include "job_steps.h"
#include "json.h"
#include "output.h"
#include "report.h"
#include "sandbox_start.h"

enum { THUMBNAIL = 512 };

struct convert {
    const struct options *options;
    const char *model, *output;
    const char *format;
    bool replaces; // the output existed before, so its companion files may exist too
    struct job job;
    lam_export *result;
};

static const char *file_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static const char *ending(const char *path)
{
    const char *dot = strrchr(file_name(path), '.');
    return dot ? dot + 1 : "";
}

// Returns the path of file `i` of the result, allocated with malloc. File 0 is the named output. Returns NULL if memory
// runs out.
static char *path_of(const struct convert *c, int i)
{
    char *path = NULL;
    int folder = (int)(file_name(c->output) - c->output);
    if (i == 0)
        return strdup(c->output);
    return asprintf(&path, "%.*s%s", folder, c->output, lam_export_file_name(c->result, i)) < 0 ? NULL : path;
}

// Returns the format for the extension of a path, in upper or lower case. Returns NULL on failure.
static const char *find_format(const char *path, lam_error *error)
{
    char list[100] = "";
    for (int i = 0; lam_export_format(i); i++) {
        if (strcasecmp(ending(path), lam_export_format(i)) == 0)
            return lam_export_format(i);
        snprintf(list + strlen(list), sizeof list - strlen(list), "%s.%s",
                 i == 0                      ? ""
                 : !lam_export_format(i + 1) ? " or "
                                             : ", ",
                 lam_export_format(i));
    }
    complain(error, LAM_UNSUPPORTED, "%.300s: lambent cannot write this format of models; write %s", path, list);
    return NULL;
}

static bool check(struct convert *c, lam_error *error)
{
    struct stat in, out;
    if (strcmp(c->output, "-") == 0)
        return complain(error, LAM_BAD_ARGUMENT,
                        "convert needs a file name whose extension selects the format, found '-'");
    if (c->options->convert.thumbnail && strcasecmp(ending(c->output), "glb") != 0)
        return complain(error, LAM_BAD_ARGUMENT,
                        "option '--thumbnail' requires an output with the extension .glb, found %.200s", c->output);
    if (c->options->convert.thumbnail && strcmp(c->model, "-") == 0)
        return complain(error, LAM_BAD_ARGUMENT, "option '--thumbnail' reads the model twice, so it cannot read '-'");
    if (!(c->format = find_format(c->output, error)) || !output_check(c->output, "", OUTPUT_NAMED, error))
        return false;
    c->replaces = stat(c->output, &out) == 0;
    bool same = c->replaces && stat(c->model, &in) == 0 && in.st_dev == out.st_dev && in.st_ino == out.st_ino;
    return !same || complain(error, LAM_BAD_ARGUMENT, "%.300s: the model and the output are the same file", c->output);
}

// Returns whether the library writes the letter `given` of a file name as `written`. The library writes _ for each
// letter that a name in an OBJ or MTL file cannot contain.
static bool is_letter(char given, char written)
{
    return written == given ||
           (written == '_' && ((signed char)given <= ' ' || given == '-' || given == '\\' || given == 0x7f));
}

// Returns whether the path has the name of a companion file of the OBJ file, such as "part.mtl" or "part-0.png".
// Accepts any number of up to four digits in the name, because the actual numbers are known only after the model is
// read.
static bool is_beside(const struct convert *c, const char *path)
{
    size_t stem = strlen(c->output) - strlen(ending(c->output)) - 1;
    const char *rest = path + stem;
    bool is = strcmp(c->format, "obj") == 0 && strlen(path) > stem;
    for (size_t i = 0; is && i < stem; i++)
        is = is_letter(c->output[i], path[i]);
    size_t digits = is && *rest == '-' ? strspn(rest + 1, "0123456789") : 0;
    return is && (strcmp(rest, ".mtl") == 0 || (digits && digits <= 4 && strcmp(rest + 1 + digits, ".png") == 0));
}

// If the output does not exist yet, files with the names of its companion files are not replaced, because another
// program created them.
static enum writer_right right_of(void *user, const char *path)
{
    const struct convert *c = user;
    return strcmp(path, c->output) == 0 ? WRITER_ANY
           : !is_beside(c, path)        ? WRITER_NONE
           : c->replaces                ? WRITER_ANY
                                        : WRITER_NEW;
}

static bool check_beside(const struct convert *c, const char *path, lam_error *error)
{
    struct stat found;
    return c->replaces || lstat(path, &found) != 0 ||
           complain(
               error, LAM_CANNOT_WRITE,
               "%.300s would be overwritten, but %.200s does not exist yet; remove the file, or name another output",
               path, c->output);
}

// Writes the model last, because the model refers to its companion files.
static bool write_files(struct convert *c, lam_error *error)
{
    int count = 0, filled = 0;
    while (lam_export_file_name(c->result, count))
        count++;
    struct writer_file *files = calloc((size_t)count + 1, sizeof *files);
    bool ok = files || complain(error, LAM_MACHINE, "out of memory");
    for (int i = count - 1; ok && i >= 0; i--) {
        char *path = path_of(c, i);
        ok = path || complain(error, LAM_MACHINE, "out of memory");
        ok = ok && job_check_inputs(c->job.scene, path, false, error) && (i == 0 || check_beside(c, path, error));
        if (path)
            files[filled++] = (struct writer_file){path, lam_export_file(c->result, i), right_of(c, path), i == 0};
    }
    ok = ok && writer_save_all(files, count, error);
    for (int i = 0; i < filled; i++)
        free((char *)(uintptr_t)files[i].path);
    free(files);
    return ok;
}

// Draws the model as `lambent MODEL` does. Reads the model again, because drawing changes the scene.
static bool draw_thumbnail(const struct convert *c, struct progress *progress, lam_image *image, lam_error *error)
{
    struct options own = *c->options;
    own.picture.width = own.picture.height = THUMBNAIL;
    struct job job = {
        .options = &own, .model = c->model, .keeps_axes = true, .device = device_option_make(&own, error)};
    job.times.start = c->job.times.start;
    bool ok = job.device && job_draw(&job, LAM_RGBA8, progress, error);
    if (ok) {
        *image = job.image;
        job.image = (lam_image){0};
    }
    lam_device_free(job.device);
    job_free(&job);
    return ok;
}

static bool convert(struct convert *c, struct progress *progress, lam_error *error)
{
    lam_picture_settings settings;
    lam_control control;
    lam_export_params params = {.name = file_name(c->output), .control = &control};
    if (!job_load(&c->job, progress, error) || !job_control(&c->job, NULL, &control, error) ||
        !job_section(&c->job, &control, error))
        return false;
    c->job.model_counts.triangles = lam_scene_triangle_count(c->job.scene); // sections change the counts
    c->job.model_counts.lines = lam_scene_line_count(c->job.scene);
    c->job.model_counts.points = lam_scene_point_count(c->job.scene);
    if (lam_scene_picture_settings(c->job.scene, &settings) && settings.present & LAM_SETTING_CAMERA)
        params.camera = &settings.camera;
    lam_image thumbnail = {0};
    if (c->options->convert.thumbnail && !draw_thumbnail(c, progress, &thumbnail, error))
        return false;
    params.thumbnail = c->options->convert.thumbnail ? &thumbnail : NULL;
    c->result =
        !job_control(&c->job, NULL, &control, error) ? NULL : lam_scene_export(c->job.scene, c->format, &params, error);
    lam_image_free(&thumbnail);
    return c->result && write_files(c, error);
}

static void print_json(const struct convert *c)
{
    struct json json = {.file = stdout};
    json_open(&json, NULL, '{');
    json_put(&json, TEXT("lambent", lam_version()), TEXT("model", c->model), TEXT("output", c->output),
             COUNT("triangles", c->job.model_counts.triangles), COUNT("lines", c->job.model_counts.lines),
             COUNT("points", c->job.model_counts.points));
    json_open(&json, "files", '[');
    for (int i = 0; lam_export_file_name(c->result, i); i++) {
        char *path = path_of(c, i);
        json_put(&json, OBJECT(NULL, TEXT("path", path), COUNT("bytes", lam_export_file(c->result, i).size)));
        free(path);
    }
    json_close(&json, ']');
    json_open(&json, "losses", '[');
    for (int i = 0; lam_export_loss(c->result, i); i++)
        json_text(&json, NULL, lam_export_loss(c->result, i));
    json_close(&json, ']');
    json_warnings(&json, c->job.scene);
    json_close(&json, '}');
    putchar('\n');
}

static void print_text(const struct convert *c)
{
    char counts[MODEL_COUNTS_SIZE];
    job_say_warnings(&c->job, &(int){0}, true);
    for (int i = 0; lam_export_loss(c->result, i); i++)
        say_warning(lam_export_loss(c->result, i));
    say_plain("%s  %s  %zu bytes\n", c->output, model_counts_text(&c->job.model_counts, counts),
              lam_export_file(c->result, 0).size);
    for (int i = 1; lam_export_file_name(c->result, i); i++) {
        char *path = path_of(c, i);
        say_plain("%s  %zu bytes\n", path ? path : "", lam_export_file(c->result, i).size);
        free(path);
    }
}

int run_convert(int operand_count, char **operands, const struct options *options)
{
    (void)operand_count;
    struct convert c = {.options = options, .model = operands[0], .output = operands[1]};
    c.job = (struct job){
        .options = options, .model = operands[0], .keeps_scene = true, .keeps_axes = true, .times.start = clock_ms()};
    struct progress progress;
    lam_error error = {0};
    interrupt_start();
    progress_start(&progress, c.model, console_is_terminal() && !options->report.quiet);
    struct sandbox_paths paths = {.may_write = right_of, .user = &c};
    bool ok = check(&c, &error);
    if (ok) {
        sandbox_add_input(&paths, c.model);
        sandbox_add(&paths, c.output, SANDBOX_MAKE);
        ok = sandbox_start(options, &paths, &error) && convert(&c, &progress, &error);
    }
    progress_end(&progress);
    if (ok && options->report.json)
        print_json(&c);
    else if (ok && !options->report.quiet)
        print_text(&c);
    lam_export_free(c.result);
    job_free(&c.job);
    if (interrupted())
        interrupt_finish();
    return ok ? 0 : report_failure(&error, options);
}
