// plan.c: implements --dry-run: lists the pictures and files without drawing.
#include "report.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include <lambent/path.h>

int planned_samples(const struct options *options)
{
    return options->draw.samples ? options->draw.samples
                                 : lam_default_samples(options->picture.width, options->picture.height);
}

bool plan_replaces(const struct job *job)
{
    struct stat found;
    return strcmp(job->output, "-") != 0 && lam_path_stat(job->output, &found) == 0 && S_ISREG(found.st_mode);
}

// Returns the values of a repeatable option, or NULL if the option is not repeatable.
static const struct texts *texts_of(const struct option *option, const struct options *options)
{
    bool repeated = option->store == store_light || option->store == store_material || option->store == store_rotation;
    return repeated ? (const struct texts *)(const void *)((const char *)options + option->field) : NULL;
}

void each_given_option(const struct options *options, option_visit *visit, void *user)
{
    for (const struct option *option = option_table; option->name; option++) {
        size_t row = (size_t)(option - option_table);
        const struct texts *texts = texts_of(option, options);
        bool replaced = option->group == GROUP_SETTINGS; // replaced by the values in the settings file
        if ((!options->given[row] && !options->by_config[row]) || replaced)
            continue;
        for (int i = 0; texts && i < texts->count; i++)
            visit(user, option->name, texts->items[i]);
        if (!texts)
            visit(user, option->name, options->values[row]);
    }
}

// Prints an option. Quotes the value if a shell would split it.
static void print_option(void *user, const char *name, const char *value)
{
    FILE *out = user;
    if (strcmp(name, "dry-run") == 0)
        return;
    const char *quote = value && (!*value || strpbrk(value, " \t\n#;&|<>*?$'\"()[]{}\\!~`")) ? "'" : "";
    fprintf(out, " --%s%s%s%s%s", name, value ? " " : "", quote, value ? value : "", quote);
}

void report_plan(FILE *out, const struct job *job)
{
    const struct options *o = job->options;
    const lam_camera *camera = &job->camera;
    const char *format = lam_scene_format(job->scene);
    fprintf(out, "%s\n", strcmp(job->model, "-") == 0 ? "standard input" : job->model);
    char items[MODEL_COUNTS_SIZE];
    fprintf(out, "  model     %s, %s\n", *format ? format : "shape", model_counts_text(&job->model_counts, items));
    fprintf(out, "  picture   %s, %s, %dx%d, %d samples per pixel%s\n",
            strcmp(job->output, "-") == 0 ? "standard output" : job->output, job->format, o->picture.width,
            o->picture.height, planned_samples(o), plan_replaces(job) ? "; replaces the file" : "");
    if (job->frames.count)
        fprintf(out, "  frames    %d, %.4g a second%s%s\n", job->frames.count, job->frames.frames_per_second,
                job->frames.last ? ", to " : "", job->frames.last ? job->frames.last : "");
    if (o->picture.save_scene)
        fprintf(out, "  scene     %s\n", o->picture.save_scene);
    fprintf(out, "  camera    eye %.7g %.7g %.7g, target %.7g %.7g %.7g\n", camera->eye.x, camera->eye.y, camera->eye.z,
            camera->target.x, camera->target.y, camera->target.z);
    fprintf(out, "  device    %s\n", lam_device_name(job->device));
    fprintf(out, "  options  ");
    each_given_option(o, print_option, out);
    fprintf(out, settings_are_used(o) ? " --no-config\n" : "\n");
}
