// shader.c: the command `shader`: prints a scene's shaders, their inputs, and code that sets the inputs.
#include "shader.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "classroom.h"
#include "command.h"
#include "console.h"
#include "foreign.h"
#include "interrupt.h"
#include "job.h"
#include "json.h"
#include "output.h"
#include "report.h"
#include "sandbox_start.h"

// --- the list of inputs

static void list_uniforms(FILE *file, const lam_shader_uniform *list, int count)
{
    for (int i = 0; i < count; i++) {
        const lam_shader_uniform *u = &list[i];
        fprintf(file, "//   %-11s %-28s ", u->type, u->name);
        if (u->block)
            fprintf(file, "(block %s, byte %d) ", u->block, u->offset);
        if (u->count)
            fprintf(file, "= ");
        shader_numbers(file, u->value, u->count, false);
        // Only the first element of an array has a description.
        const char *bracket = strchr(u->name, '[');
        bool first = !bracket || strncmp(bracket, "[0]", 3) == 0;
        fprintf(file, "%s%s%s\n", u->count && first ? "  " : "", first ? "// " : "", first ? u->meaning : "");
    }
}

// Prints the attributes, the uniforms and their values as comments (`//` before each line).
static void shader_contract(FILE *file, const lam_shader *s)
{
    fprintf(file, "// Attributes%s:\n",
            s->glsl == LAM_GLSL_120 ? ", to be bound to these locations before linking"
                                    : ", at the locations in the text");
    for (int i = 0; i < s->attribute_count; i++)
        fprintf(file, "//   %d  %-5s %-20s // %s\n", s->attributes[i].location, s->attributes[i].type,
                s->attributes[i].name, s->attributes[i].meaning);
    if (s->flat && s->glsl == LAM_GLSL_120)
        fprintf(file, "//   Flat shading: GLSL 120 has no `flat`, so the three vertices of a triangle carry "
                      "the same values.\n");
    else if (s->flat)
        fprintf(file, "//   Flat shading: each triangle has three vertices of its own, with its face normal.\n");
    if (s->uniform_count) {
        fprintf(file, "// Uniforms of the frame (matrices column by column):\n");
        list_uniforms(file, s->uniforms, s->uniform_count);
    }
    for (int i = 0; i < s->texture_count; i++)
        fprintf(file, "//   %s contains %d texels; --host c and --json print them.\n", s->textures[i].name,
                s->textures[i].texels);
    for (int i = 0; i < s->draw_count; i++) {
        const lam_shader_draw *d = &s->draws[i];
        fprintf(file, "// Uniforms of draw %d, object %d%s", i, d->object, d->object_name ? " '" : "");
        print_foreign(file, FOREIGN_COMMENT, FOREIGN(d->object_name));
        fprintf(file, "%s, triangles %u to %u, front %s%s%s:\n", d->object_name ? "'" : "", d->first_triangle,
                d->first_triangle + d->triangle_count - 1, d->clockwise ? "clockwise" : "counter-clockwise",
                d->cull == LAM_CULL_BACK    ? ", backs culled"
                : d->cull == LAM_CULL_FRONT ? ", fronts culled"
                                            : "",
                d->translucent ? ", blended" : "");
        if (d->origin[0] != 0 || d->origin[1] != 0 || d->origin[2] != 0)
            fprintf(file, "//   position is relative to (%.17g, %.17g, %.17g)\n", d->origin[0], d->origin[1],
                    d->origin[2]);
        list_uniforms(file, d->uniforms, d->uniform_count);
    }
}

// --- files

// Returns the path of the shader files without .vert or .frag, allocated with malloc. If `output` is a folder, the path
// is the folder and the model's name. Otherwise, the path is `output` without .vert or .frag.
static char *base_of(const char *output, const char *model)
{
    char *base = output_path(output, model, "");
    size_t length = base ? strlen(base) : 0;
    bool named = output_is_named(output);
    if (named && length > 5 && (strcmp(base + length - 5, ".vert") == 0 || strcmp(base + length - 5, ".frag") == 0))
        base[length - 5] = 0;
    return base;
}

// Writes a file. Shader files do not record which program wrote them. This function therefore replaces any existing
// file, even if `output` names only a folder. The folder of `output` may be missing.
static bool write_file(const char *output, const char *base, const char *ending, const char *text, size_t size,
                       lam_error *error)
{
    char *path = malloc(strlen(base) + strlen(ending) + 1);
    if (!path)
        return complain(error, LAM_MACHINE, "out of memory");
    strcpy(path, base);
    strcat(path, ending);
    lam_bytes bytes = {(void *)(uintptr_t)text, size};
    bool named = output_is_named(output) || access(path, F_OK) == 0;
    bool ok = output_check(path, "", named, error) && writer_save(path, &bytes, false, error);
    free(path);
    return ok;
}

static const char *const endings[] = {".vert", ".frag", ".application.c", ".c"};

static void add_files(struct sandbox_paths *paths, const struct options *o, const char *model)
{
    char *base = base_of(o->picture.output, model), *path = NULL;
    size_t count = sizeof endings / sizeof *endings - !o->shader.host;
    paths->failed |= !base;
    for (size_t i = 0; base && i < count; i++) {
        if (asprintf(&path, "%s%s", base, endings[i]) < 0)
            path = NULL;
        paths->failed |= !path;
        if (path)
            sandbox_add_output(paths, path, false);
        free(path);
    }
    free(base);
}

static bool write_files(const struct options *o, const lam_shader *shader, const char *model, lam_error *error)
{
    char *base = base_of(o->picture.output, model), *host = NULL;
    size_t host_size = 0;
    if (!base)
        return complain(error, LAM_MACHINE, "out of memory");
    bool ok = write_file(o->picture.output, base, endings[0], shader->vertex, strlen(shader->vertex), error) &&
              write_file(o->picture.output, base, endings[1], shader->fragment, strlen(shader->fragment), error);
    if (ok && shader->application)
        ok = write_file(o->picture.output, base, endings[2], shader->application, strlen(shader->application), error);
    if (ok && o->shader.host) {
        FILE *file = open_memstream(&host, &host_size);
        const char *name = strrchr(base, '/');
        if (file)
            shader_host(file, shader, name ? name + 1 : base, model);
        ok = (file && fclose(file) == 0) || complain(error, LAM_MACHINE, "out of memory");
        ok = ok && write_file(o->picture.output, base, endings[3], host, host_size, error);
        free(host);
    }
    if (ok && !o->report.quiet)
        say_plain("%s.vert, %s.frag%s%s%s%s%s%s: GLSL %s%s\n", base, base, shader->application ? ", " : "",
                  shader->application ? base : "", shader->application ? ".application.c" : "",
                  o->shader.host ? ", " : "", o->shader.host ? base : "", o->shader.host ? ".c" : "",
                  lam_glsl_name(shader->glsl), shader->application ? ", C99" : "");
    free(base);
    return ok;
}

static void print(const struct options *o, const lam_shader *shader, const char *model, bool sources)
{
    if (sources && shader->application)
        printf("// ===== application stage =====\n%s\n", shader->application);
    if (sources) {
        printf("// ===== vertex shader =====\n%s\n", shader->vertex);
        printf("// ===== fragment shader =====\n%s\n", shader->fragment);
    }
    printf("// ===== inputs =====\n");
    if (o->shader.style == LAM_SHADER_STYLE_LECTURE || o->shader.mistake)
        printf("// Lambent draws the same picture with these options and --tone none --ao off.\n");
    shader_contract(stdout, shader);
    if (o->shader.host && sources) {
        printf("\n// ===== host code =====\n");
        shader_host(stdout, shader, "shader", model);
    }
}

// --- mistakes

bool shader_mistake_is_known(const char *name, lam_error *error)
{
    char first[64];
    const char *second = strchr(name, '+');
    snprintf(first, sizeof first, "%.*s", (int)strcspn(name, "+"), name);
    struct suggestion nearest = suggest_start(first);
    lam_shader_mistake mistake;
    for (int i = 0; lam_shader_mistake_row(i, &mistake); i++) {
        if (strcmp(first, mistake.id) == 0)
            return !second || shader_mistake_is_known(second + 1, error);
        suggest_try(&nearest, mistake.id);
    }
    return complain(
        error, LAM_BAD_ARGUMENT,
        "option '--mistake': found '%.60s', expected the name of a mistake, which '--mistake list' lists%s%s%s", name,
        nearest.best ? "; did you mean '" : "", nearest.best ? nearest.best : "", nearest.best ? "'?" : "");
}

int run_shader(int operand_count, char **operands, const struct options *given)
{
    struct options options = *given;
    bool to_files = options.picture.output && strcmp(options.picture.output, "-") != 0;
    struct job job = {.options = &options, .model = operand_count ? operands[0] : "sphere"};
    lam_error error = {0};
    if (options.shader.mistake && strcmp(options.shader.mistake, "list") == 0)
        return classroom_run(operand_count, operands, given);
    if (options.shader.mistake && option_given(&options, "style") && options.shader.style == LAM_SHADER_STYLE_FULL)
        complain(&error, LAM_BAD_ARGUMENT,
                 "options '--mistake' and '--style full': mistakes exist only in the lecture style");
    else if (options.shader.mistake && !shader_mistake_is_known(options.shader.mistake, &error))
        ; // already reported
    else if (!*job.model)
        complain(&error, LAM_BAD_ARGUMENT, "a model's name is empty");
    else if (options.report.dry_run)
        complain(&error, LAM_BAD_ARGUMENT, "option '--dry-run' applies to pictures, not to shaders");
    if (error.code)
        return report_failure(&error, given);
    interrupt_start();
    job.times.start = clock_ms();
    struct progress progress;
    progress_start(&progress, job.model, console_is_terminal() && !options.report.quiet);
    struct sandbox_paths paths = {0};
    sandbox_add_input(&paths, job.model);
    if (to_files)
        add_files(&paths, &options, job.model);
    lam_shader *shader = sandbox_start(&options, &paths, &error) ? job_shader(&job, &progress, &error) : NULL;
    progress_end(&progress);
    job_say_warnings(&job, &(int){0}, !options.report.quiet);
    bool ok = shader && (!to_files || write_files(given, shader, job.model, &error));
    if (ok && options.report.json)
        shader_json(stdout, shader, job.model);
    else if (ok && !(to_files && options.report.quiet))
        print(given, shader, job.model, !to_files);
    lam_shader_free(shader);
    lam_scene_free(job.scene);
    if (interrupted())
        interrupt_finish();
    return ok ? 0 : report_failure(&error, given);
}
