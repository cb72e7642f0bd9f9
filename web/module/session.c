// session.c: draws the pictures of command lines, one after another, for a page that changes the command line. A model
// is loaded once.
#include "session.h"

#include <lambent/light.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lambent/words.h>

#include "animate_frame.h"
#include "command_table.h"
#include "console.h"
#include "contents.h"
#include "limit_options.h"
#include "environment_cache.h"
#include "explain_json.h"
#include "job.h"
#include "json.h"
#include "kept_model.h"
#include "report.h"

static struct kept_model model;

static struct {
    char *text;
    uint32_t bytes;
    lam_device *device;
    int isa, threads;                       // of the device
    struct environment_cache *environments; // for the current files
    lam_image image;                        // of the last picture
    uint64_t memory_limit_bytes;            // 0 means no limit
    struct progress progress;
} session;

// The command line that is drawn now.
static struct {
    struct options options;
    struct job job;
    lam_error error;
} call;

char *web_words(uint32_t bytes)
{
    free(session.text);
    session.text = calloc(1, (size_t)bytes + 1);
    session.bytes = session.text ? bytes : 0;
    return session.text;
}

void web_limit_memory(double bytes) { session.memory_limit_bytes = bytes > 0 ? (uint64_t)bytes : 0; }

void web_forget(void)
{
    kept_model_forget(&model);
    environment_cache_free(session.environments);
    session.environments = NULL;
}

// Parses the words. The call's options and job are then complete; its end frees the options in any case. `saves`: the
// call writes a file, which can be an animation. The job of an animation loads a model of its own.
static bool start(int count, bool saves)
{
    static bool filled;
    struct options *options = &call.options;
    struct job *job = &call.job;
    lam_error *error = &call.error;
    *job = (struct job){0};
    *error = (lam_error){0};
    if (!filled)
        option_table_fill();
    filled = true;
    char **words = calloc((size_t)count + 1, sizeof *words), *at = session.text;
    *options = option_defaults();
    lam_cancel_clear(web_cancel_flag());
    progress_start(&session.progress, "", false);
    session.progress.show = web_progress;
    for (int i = 0; words && i < count && at < session.text + session.bytes; i++) {
        words[i] = at;
        at += strlen(at) + 1;
    }
    const struct command *render = &command_table[COMMAND_render];
    int operands = words ? options_parse(count, words, render->groups | 1ull << GROUP_SHAPE, options, error) : -1;
    if (!words)
        complain(error, LAM_LIMIT, "out of memory");
    else if (operands >= 0 && operands != 1)
        complain(error, LAM_BAD_ARGUMENT, operands ? "unexpected argument '%s', expected one model" : "no model given",
                 operands ? words[1] : "");
    const char *name = operands == 1 ? words[0] : NULL;
    free(words);
    if (!options->limits.memory_limit_bytes)
        options->limits.memory_limit_bytes = session.memory_limit_bytes;
    if (!name || !job_check_options(options, error) || !job_check_formula(name, options, error))
        return false;
    bool animated = animation_wanted(options);
    if (animated && !saves)
        return complain(error, LAM_BAD_ARGUMENT,
                        "options '--turntable' and '--sweep' make files, expected one picture");
    if (session.device && (session.isa != options->work.isa || session.threads != options->work.threads)) {
        lam_device_free(session.device);
        session.device = NULL;
    }
    if (!session.device)
        session.device = device_option_make(options, error);
    session.isa = options->work.isa;
    session.threads = options->work.threads;
    options->work.threads = 1; // the device uses the other threads; files are read on this thread, because no other
                               // thread has them
    if (!session.environments)
        session.environments = environment_cache_make();
    *job = (struct job){.options = options,
                        .model = name,
                        .device = session.device,
                        .keeps_scene = !animated,
                        .environments = session.environments};
    job->times.start = clock_ms();
    return session.device && (animated || kept_model_take(&model, job, &session.progress, error));
}

// Prints the result of a command line, and ends the call. Returns the exit code.
static int answer(bool ok)
{
    struct job *job = &call.job;
    const lam_error *error = &call.error;
    struct json json = {.file = stdout};
    json_open(&json, NULL, '{');
    json_put(&json, FLAG("ok", ok));
    if (!ok) {
        json_message(&json, "error", error->text);
        json_put(&json, FLAG("cancelled", error->code == LAM_CANCELLED));
    }
    if (ok)
        picture_json(&json, job, model.read_ms);
    json_close(&json, '}');
    putc('\n', stdout);
    fflush(stdout);
    if (job->keeps_scene)
        job->scene = NULL; // the session owns the scene
    lam_image_free(&session.image);
    session.image = job->image;
    job->image = (lam_image){0};
    job_free(job);
    options_free(&call.options);
    return ok ? 0 : exit_code_of(error->code)->code;
}

// Ends a call that has printed its own answer (`ok`), or prints the error. Returns the exit code.
static int end_call(bool ok)
{
    if (!ok)
        return answer(false);
    fflush(stdout);
    call.job.scene = NULL;
    job_free(&call.job);
    options_free(&call.options);
    return 0;
}

const void *web_pixels(void) { return session.image.pixels; }

int web_draw(int count)
{
    bool ok = start(count, false) && job_draw(&call.job, LAM_RGBA8, &session.progress, &call.error);
    return answer(ok);
}

int web_save(int count)
{
    bool ok = start(count, true);
    call.job.output = call.options.picture.output;
    if (ok && (!call.job.output || strcmp(call.job.output, "-") == 0))
        ok = complain(&call.error, LAM_BAD_ARGUMENT, "expected the file to write after -o");
    bool (*run)(struct job *, struct progress *, lam_error *) =
        animation_wanted(&call.options) ? animation_run : job_run;
    ok = ok && run(&call.job, &session.progress, &call.error);
    return answer(ok);
}

int web_explain(int count, int x, int y)
{
    lam_explanation *explanation = NULL;
    bool ok = start(count, false);
    if (ok && (x < 0 || y < 0 || x >= call.options.picture.width || y >= call.options.picture.height))
        ok = complain(&call.error, LAM_BAD_ARGUMENT, "pixel %d,%d lies outside of the picture", x, y);
    if (ok)
        explanation = job_explain(&call.job, x, y, NULL, &call.error);
    if (explanation)
        explain_json(stdout, explanation, &call.job);
    ok = explanation != NULL;
    lam_explanation_free(explanation);
    return end_call(ok);
}

enum { CURVE_STEPS = 100 };

static void curve_json(struct json *json, const char *key, double farthest, const lam_light *light,
                       double value(const lam_light *light, double x))
{
    json_open(json, key, '[');
    for (int k = 0; k <= CURVE_STEPS; k++)
        json_number(json, NULL, value(light, (double)(float)(farthest * k / CURVE_STEPS)));
    json_close(json, ']');
}

static double attenuation_value(const lam_light *light, double x)
{
    return (double)lam_attenuation_at(light, (float)x);
}
static double spot_value(const lam_light *light, double x) { return (double)lam_spot_at(light, radians(x)); }

// Returns the light with this index in an explanation's list, which contains only some types of lights.
static lam_light light_of(const struct job *job, int number)
{
    int count = lam_draw_lights(job->scene, job->rig, job->options->draw.ground, NULL, 0);
    lam_light *lights = calloc((size_t)count + 1, sizeof *lights), found = lam_light_default(LAM_LIGHT_AMBIENT);
    if (lights)
        lam_draw_lights(job->scene, job->rig, job->options->draw.ground, lights, count);
    for (int i = 0; lights && i < count; i++)
        if (lights[i].type != LAM_LIGHT_AMBIENT && lights[i].type != LAM_LIGHT_HEMISPHERE && number-- == 0)
            found = lights[i];
    free(lights);
    return found;
}

static lam_reflection reflection_named(const char *word)
{
    int i = 0;
    while (i < LAM_REFLECTION_COUNT - 1 && strcmp(lam_reflection_describe((lam_reflection)i)->word, word) != 0)
        i++;
    return (lam_reflection)i;
}

int web_curves(int count, int light, double farthest, double shininess)
{
    bool ok =
        start(count - 1, false) && job_load(&call.job, NULL, &call.error) && job_arrange(&call.job, NULL, &call.error);
    lam_light one = ok ? light_of(&call.job, light) : lam_light_default(LAM_LIGHT_AMBIENT);
    if (ok && one.type == LAM_LIGHT_AMBIENT)
        ok = complain(&call.error, LAM_BAD_ARGUMENT, "the picture has no light %d with a place or a direction", light);
    if (ok) {
        const char *word = session.text;
        for (int i = 1; i < count; i++)
            word += strlen(word) + 1;
        lam_reflection reflection = reflection_named(word);
        struct json json = {.file = stdout};
        json_open(&json, NULL, '{');
        json_text(&json, "type", lam_light_type_describe(one.type)->word);
        curve_json(&json, "attenuation", farthest, &one, attenuation_value);
        curve_json(&json, "spot", 90, &one, spot_value);
        json_open(&json, "highlight", '[');
        for (int k = 0; k <= CURVE_STEPS; k++)
            json_number(&json, NULL,
                        (double)lam_highlight_at(reflection, (float)shininess,
                                                 radians((double)(float)(90.0 * k / CURVE_STEPS))));
        json_close(&json, ']');
        json_close(&json, '}');
        putc('\n', stdout);
    }
    return end_call(ok);
}

int web_lights(int count)
{
    lam_bytes text = {0};
    bool ok = start(count, false) && job_load(&call.job, NULL, &call.error) &&
              job_arrange(&call.job, NULL, &call.error) &&
              lam_lights_encode(call.job.scene, call.job.rig, call.options.draw.ground, &text, &call.error);
    if (ok) {
        fwrite(text.data, 1, text.size, stdout);
    }
    lam_bytes_free(&text);
    return end_call(ok);
}

int web_contents(int count)
{
    bool ok = start(count, false) && job_load(&call.job, NULL, &call.error);
    if (ok) {
        struct json json = {.file = stdout};
        json_open(&json, NULL, '{');
        contents_json(&json, call.job.scene);
        json_close(&json, '}');
        putc('\n', stdout);
    }
    return end_call(ok);
}

static void describe_option(struct json *json, const struct option *o)
{
    json_open(json, NULL, '{');
    json_put(json, TEXT("name", o->name), TEXT("group", group_titles[o->group]), TEXT("value", o->value),
             TEXT("default", o->standard), TEXT("summary", o->summary), TEXT("others", o->others));
    static const char *const kinds[] = {"any",    "file",        "color",  "material", "light",
                                        "camera", "environment", "varied", "swept"};
    json_put(json, TEXT("kind", kinds[o->kind]),
             FLAG("repeats", o->store == store_light || o->store == store_material || o->store == store_rotation ||
                                 o->store == store_texts),
             FLAG("number", o->store == store_number || o->store == store_float || o->store == store_integer ||
                                o->store == store_angle),
             FLAG("whole", o->store == store_integer));
    if (o->max > o->min) {
        json_put(json, NUMBER("min", o->min), NUMBER("max", o->max));
    }
    if (o->words) {
        json_open(json, "words", '[');
        for (const struct choice *w = o->words; w->name; w++) {
            json_put(json, OBJECT(NULL, TEXT("name", w->name), TEXT("summary", w->summary)));
        }
        json_close(json, ']');
    }
    json_close(json, '}');
}

void web_options(void)
{
    struct json json = {.file = stdout};
    option_table_fill();
    json_open(&json, NULL, '{');
    json_text(&json, "version", lam_version());
    json_open(&json, "shapes", '[');
    for (int i = 0; i < lam_shape_count(); i++)
        json_text(&json, NULL, lam_shape_name(i));
    json_close(&json, ']');
    json_open(&json, "materials", '[');
    for (int i = 0; i < LAM_MATERIAL_COUNT; i++) {
        json_put(&json, OBJECT(NULL, TEXT("name", lam_material_name((lam_material_id)i)),
                               TEXT("metal", lam_material_metal((lam_material_id)i))));
    }
    json_close(&json, ']');
    json_open(&json, "environments", '[');
    for (int i = 0; lam_environment_built_in_name(i); i++)
        json_text(&json, NULL, lam_environment_built_in_name(i));
    json_close(&json, ']');
    json_open(&json, "endings", '[');
    for (int i = 0; lam_model_format_extensions(i); i++)
        for (const char *word = lam_model_format_extensions(i); *word; word += strspn(word, " ")) {
            char ending[16];
            int length = (int)strcspn(word, " ");
            snprintf(ending, sizeof ending, "%.*s", length, word);
            json_text(&json, NULL, ending);
            word += length;
        }
    json_close(&json, ']');
    json_open(&json, "options", '[');
    for (const struct option *o = option_table; o->name; o++)
        if ((PICTURE_GROUPS | 1ull << GROUP_SHAPE) >> o->group & 1)
            describe_option(&json, o);
    json_close(&json, ']');
    json_close(&json, '}');
    putc('\n', stdout);
    fflush(stdout);
}
