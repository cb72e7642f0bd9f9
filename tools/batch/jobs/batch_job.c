// batch_job.c: reads a line of JSON as a job.
#include "batch_job.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "animate_frame.h"
#include "base64.h"
#include "journal.h"
#include "console.h"
#include "environment_option.h"
#include "job.h"
#include "limit_options.h"
#include "output_name.h"

enum { ID_MAX = 200, NAME_MAX_BYTES = 1000 };

static const char *const keys[] = {"id", "model", "data", "name", "options", "output", "format", "timeout_s", NULL};

static bool refuse(lam_error *error, const char *key, const char *text)
{
    return complain(error, LAM_BAD_ARGUMENT, "key '%s': %s", key, text);
}

// --- the line

static const char *kind_of(const json_t *value)
{
    static const char *const kinds[] = {"an object", "a list", "a string", "an integer",
                                        "a number",  "true",   "false",    "null"};
    return kinds[json_typeof(value)];
}

static json_t *parse(const char *line, size_t size, lam_error *error)
{
    json_error_t reason;
    json_t *root = json_loadb(line, size, JSON_REJECT_DUPLICATES, &reason);
    if (!root) {
        complain(error, LAM_BAD_ARGUMENT, "expected JSON: %.160s (byte %d)", reason.text, reason.position);
        for (char *c = error->text; *c; c++) // the message may repeat bytes of the line
            *c = (unsigned char)*c < 0x7F ? *c : '?';
    } else if (!json_is_object(root)) {
        complain(error, LAM_BAD_ARGUMENT, "expected a job, an object of JSON, found %s", kind_of(root));
        json_decref(root);
        root = NULL;
    }
    return root;
}

static bool is_id(const json_t *id)
{
    return json_is_integer(id) || (json_is_string(id) && json_string_length(id) <= ID_MAX);
}

static bool check_keys(json_t *root, lam_error *error)
{
    const char *key;
    json_t *value;
    json_object_foreach(root, key, value)
    {
        int i = 0;
        while (keys[i] && strcmp(keys[i], key) != 0)
            i++;
        if (!keys[i])
            return complain(error, LAM_BAD_ARGUMENT,
                            "found key '%.60s', expected id, model or data, name, options, output, format, timeout_s; "
                            "or cancel alone",
                            key);
    }
    return true;
}

// Gets the text of a key. Sets *text to NULL and returns true if the key is missing or null.
static bool text_of(const json_t *root, const char *key, const char **text, lam_error *error)
{
    const json_t *value = json_object_get(root, key);
    *text = json_string_value(value);
    if (*text || !value || json_is_null(value))
        return !*text || **text || refuse(error, key, "is empty");
    return complain(error, LAM_BAD_ARGUMENT, "key '%s': found %s, expected a string", key, kind_of(value));
}

// --- the parts of a job

static bool read_timeout(struct batch_job *job, const json_t *root, const struct options *base, lam_error *error)
{
    const json_t *value = json_object_get(root, "timeout_s");
    double most = limits_time(base), seconds = json_number_value(value);
    // the time limit is for the whole job, even if the job draws an animation
    job->options.limits.time_limit_s = most > 0 ? most : (double)INFINITY;
    if (!value || json_is_null(value))
        return true;
    if (!json_is_number(value) || !(seconds > 0 && seconds <= 1e9) || (most > 0 && seconds > most))
        return complain(
            error, LAM_BAD_ARGUMENT,
            "key 'timeout_s': expected seconds above 0, at most %.10g, the worker's own limit (--time-limit)",
            most > 0 ? most : 1e9);
    job->options.limits.time_limit_s = seconds;
    return true;
}

static bool read_bytes(struct batch_job *job, const json_t *value, lam_error *error)
{
    size_t size, at;
    uint8_t *bytes = base64_decode(json_string_value(value), json_string_length(value), &size, &at);
    if (!bytes)
        return at == SIZE_MAX
                   ? complain(error, LAM_MACHINE, "out of memory")
                   : complain(error, LAM_BAD_ARGUMENT,
                              "key 'data': expected base64 (RFC 4648, with padding), found something else at "
                              "character %zu",
                              at);
    job->bytes = (lam_bytes){bytes, size};
    return true;
}

// Reads the model: an allowed file, a shape, or bytes with a name.
static bool read_model(struct batch_job *job, const json_t *root, const struct batch_job_rules *rules, lam_error *error)
{
    const char *model, *data, *name;
    if (!text_of(root, "model", &model, error) || !text_of(root, "data", &data, error) ||
        !text_of(root, "name", &name, error))
        return false;
    if (!model == !data)
        return complain(error, LAM_BAD_ARGUMENT,
                        "expected either key 'model' (a file or a shape) or key 'data' (the model's bytes)");
    if (model && name)
        return refuse(error, "name", "is allowed only with key 'data'");
    if (name && (strlen(name) > NAME_MAX_BYTES || strchr(name, '/')))
        return refuse(error, "name", "expected a file's name without a folder, of at most 1000 bytes");
    if (model && strcmp(model, "-") == 0)
        return refuse(error, "model", "standard input contains the jobs; send a model's bytes in key 'data'");
    if (model && lam_shape_find(model) < 0 && !job_roots_have(rules->options, model, false, error))
        return false;
    if (data && !read_bytes(job, json_object_get(root, "data"), error))
        return false;
    return batch_plan_add(&job->plan, model ? model : name ? name : "model", NULL, error);
}

// Reads the name for the pictures. Pictures in an answer need a name too, because the name's extension selects the
// format.
static bool read_output(struct batch_job *job, const json_t *root, lam_error *error)
{
    const char *output, *format;
    struct options *o = &job->options;
    if (!text_of(root, "output", &output, error) || !text_of(root, "format", &format, error))
        return false;
    if (output && format)
        return refuse(error, "format", "applies only to pictures in the answer; the name of a file selects its format");
    if (output && strcmp(output, "-") == 0)
        return refuse(error, "output", "omit this key to receive the picture in the answer");
    if (output && output_name_is_pattern(output) && output_name_has(output, "frame"))
        return refuse(error, "output", "an animation of a job is one file, without {frame} in its name");
    job->in_answer = !output;
    if (output)
        job->output = strdup(output);
    else if (format && (strlen(format) > 10 || strspn(format, "abcdefghijklmnopqrstuvwxyz") != strlen(format)))
        return refuse(error, "format", "expected the format of a picture, such as png");
    else if (asprintf(&job->output, "{stem}%s%s%s.%s", o->batch.view_count > 1 ? "-{view}" : "",
                      o->batch.size_count > 1 ? "-{size}" : "", o->batch.show_count > 1 ? "-{show}" : "",
                      format ? format : "png") < 0)
        job->output = NULL;
    o->picture.output = job->output;
    return job->output || complain(error, LAM_MACHINE, "out of memory");
}

// --- files that the options name

static bool check_environment(const struct batch_job *job, const struct batch_job_rules *rules, lam_error *error)
{
    const char *text = job->options.shading.environment, *paths[LAM_FACE_COUNT] = {text};
    if (!text || text == rules->options->shading.environment || environment_option_built_in(text))
        return true;
    char *names = strchr(text, ',') ? environment_option_faces(text, paths, error) : NULL;
    bool ok = names || !strchr(text, ',');
    for (int i = 0; ok && i < (names ? LAM_FACE_COUNT : 1); i++)
        ok = job_roots_have(rules->options, paths[i], false, error);
    free(names);
    return ok;
}

// Checks the files of looks before the options are parsed, because parsing reads these files.
static bool check_looks(const struct batch_job *job, const struct batch_job_rules *rules, lam_error *error)
{
    static const char option[] = "--look";
    for (int i = 0; i < job->word_count; i++) {
        const char *argument = job->words[i], *value = NULL;
        if (strncmp(argument, option, sizeof option - 1) == 0 && argument[sizeof option - 1] == '=')
            value = argument + sizeof option;
        else if (strcmp(argument, option) == 0 && i + 1 < job->word_count)
            value = job->words[i + 1];
        if (value && *value && !look_find(value) && !job_roots_have(rules->options, value, false, error))
            return false;
    }
    return true;
}

static bool check_outputs(const struct batch_job *job, const struct batch_job_rules *rules, lam_error *error)
{
    bool ok = true;
    for (int i = 0; ok && !job->in_answer && i < job->plan.view_count; i++) {
        char *output = batch_plan_output(&job->plan, 0, i);
        ok = output ? job_roots_have(rules->options, output, true, error)
                    : complain(error, LAM_MACHINE, "out of memory");
        free(output);
    }
    return ok;
}

// --- whole jobs

static bool read_options(struct batch_job *job, const json_t *root, const struct batch_job_rules *rules,
                         lam_error *error)
{
    struct options *o = &job->options;
    if (!options_copy(o, rules->options)) {
        *o = (struct options){0};
        return complain(error, LAM_MACHINE, "out of memory");
    }
    o->work.threads = rules->threads;
    o->limits.in_flight = rules->in_flight;
    o->limits.files_inside = true;
    o->limits.allow_paths.count = 0; // a job's model may read only files in its own folder
    return job_words_make(json_object_get(root, "options"), &job->words, &job->word_count, error) &&
           check_looks(job, rules, error) && job_words_apply(job->words, job->word_count, o, error) &&
           check_environment(job, rules, error) && job_check_options(o, error);
}

static bool fill(struct batch_job *job, json_t *root, const struct batch_job_rules *rules, lam_error *error)
{
    struct batch_plan plan;
    bool ok = check_keys(root, error) && read_options(job, root, rules, error) &&
              read_timeout(job, root, rules->options, error) && read_output(job, root, error);
    if (!ok)
        return false;
    ok = batch_plan_start(&plan, &job->options, error);
    job->plan = plan;
    if (!ok || !read_model(job, root, rules, error) || !batch_plan_check(&job->plan, error) ||
        !check_outputs(job, rules, error))
        return false;
    return !rules->has_keys || (job->options_text = batch_options_text(&job->options, error));
}

enum batch_line batch_job_read(const char *line, size_t size, const struct batch_job_rules *rules,
                               struct batch_job **out, json_t **id, lam_error *error)
{
    *out = NULL;
    *id = NULL;
    json_t *root = parse(line, size, error);
    if (!root)
        return LINE_REFUSED;
    json_t *cancelled = json_object_get(root, "cancel"), *own = cancelled ? cancelled : json_object_get(root, "id");
    enum batch_line kind = LINE_REFUSED;
    struct batch_job *job = NULL;
    if (!own || !is_id(own)) {
        complain(error, LAM_BAD_ARGUMENT, "key '%s': %s%s, expected a string of at most 200 bytes or an integer",
                 cancelled ? "cancel" : "id", own ? "found " : "is missing", own ? kind_of(own) : "");
    } else if (cancelled && json_object_size(root) > 1) {
        refuse(error, "cancel", "stands alone");
    } else if (cancelled) {
        *id = json_incref(own);
        kind = LINE_CANCEL;
    } else {
        *id = json_incref(own);
        job = calloc(1, sizeof *job);
        if (!job)
            complain(error, LAM_MACHINE, "out of memory");
        else if (fill(job, root, rules, error))
            kind = LINE_JOB;
    }
    json_decref(root);
    if (kind == LINE_JOB) {
        job->id = json_incref(*id);
        *out = job;
    } else {
        batch_job_free(job);
    }
    return kind;
}

void batch_job_free(struct batch_job *job)
{
    if (!job)
        return;
    batch_plan_free(&job->plan);
    options_free(&job->options);
    job_words_free(job->words, job->word_count);
    lam_bytes_free(&job->bytes);
    json_decref(job->id);
    free(job->output);
    free(job->options_text);
    free(job);
}
