// check_module.c: checks shaders for a page, one after another. The page's WebGL 2 draws them.
#include "check_module.h"

#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "console.h"
#include "json.h"

static const size_t max_cache_bytes = (size_t)64 << 20;

static struct {
    char *texts;
    uint32_t bytes;
    lam_check_cache *cache; // of the pictures of known mistakes
    lam_check_report report;
    unsigned char *rgba; // the pixels of the last requested picture
} module;

char *web_texts(uint32_t bytes)
{
    free(module.texts);
    module.texts = calloc(1, (size_t)bytes + 1);
    module.bytes = module.texts ? bytes : 0;
    return module.texts;
}

// Returns text `index` of the call, or "" if the call has no such text.
static const char *text_of(int index)
{
    const char *at = module.texts ? module.texts : "", *end = at + module.bytes;
    for (; index > 0 && at < end; index--)
        at += strlen(at) + 1;
    return at < end ? at : "";
}

static void answer_error(const lam_error *error)
{
    struct json json = {.file = stdout};
    json_put(&json, OBJECT(NULL, FLAG("ok", false), TEXT("error", error->text)));
}

static bool check(lam_check_params *params, lam_error *error)
{
    lam_check_report_free(&module.report);
    if (!module.cache && !(module.cache = lam_check_cache_make(max_cache_bytes, error)))
        return false;
    params->cache = module.cache;
    if (lam_check_run(params, &module.report, error))
        return true;
    if (!web_painter_was_stopped())
        return false;
    // The stopped work and the cache are lost.
    lam_check_cache_free(module.cache);
    module.cache = NULL;
    module.report = (lam_check_report){.verdict = LAM_CHECK_ENDLESS};
    return true;
}

void web_check(int size, double max_pictures)
{
    static const double tolerance = 2; // of 255, as in the command
    lam_error error = {0};
    const char *vertex = text_of(1), *contract_name = text_of(2), *highlight = text_of(3);
    lam_check_contract *contract = NULL;
    if (*contract_name) {
        const char *text = lam_check_contract_text(contract_name);
        if (!text)
            complain(&error, LAM_BAD_ARGUMENT, "there is no contract '%.60s'", contract_name);
        else
            contract = lam_check_contract_read(text, strlen(text), contract_name, &error);
    }
    struct check_submission submission = {.fragment = (char[]){"shader.frag"},
                                          .vertex = *vertex ? (char[]){"shader.vert"} : NULL};
    lam_check_params params = {.fragment = text_of(0),
                               .fragment_name = submission.fragment,
                               .vertex = *vertex ? vertex : NULL,
                               .vertex_name = submission.vertex,
                               .contract = contract,
                               .size = size,
                               .tolerance = tolerance / 255,
                               .reflection =
                                   strcmp(highlight, "phong") == 0 ? LAM_REFLECTION_PHONG : LAM_REFLECTION_AUTO,
                               .max_pictures = max_pictures < 0 ? 0 : (uint64_t)max_pictures,
                               .painter = &web_painter};
    if (!error.code && check(&params, &error))
        check_report_json(stdout, &(struct check_result){.submission = &submission, .report = module.report}, NULL,
                          tolerance);
    else
        answer_error(&error);
    fflush(stdout);
    lam_check_contract_free(contract);
}

static unsigned char byte_of(float x) { return (unsigned char)(x > 0 ? (x < 1 ? x * 255 + 0.5F : 255) : 0); }

static const float *row_of(const lam_image *image, int y)
{
    size_t stride = image->stride ? (size_t)image->stride : 4 * sizeof(float) * (size_t)image->width;
    return (const float *)(const void *)((const char *)image->pixels + (size_t)y * stride);
}

const void *web_check_picture(int scene, int which)
{
    const lam_check_report *r = &module.report;
    if (scene < 0 || scene >= r->scene_count || which < 0 || which > 2)
        return NULL;
    const lam_image *theirs = &r->scenes[scene].theirs, *reference = &r->scenes[scene].reference;
    size_t count = 4 * (size_t)theirs->width * (size_t)theirs->height;
    free(module.rgba);
    module.rgba = malloc(count + 1);
    if (!module.rgba)
        return NULL;
    for (int y = 0; y < theirs->height; y++) {
        const float *a = row_of(theirs, y), *b = row_of(reference, y);
        unsigned char *out = module.rgba + 4 * (size_t)y * (size_t)theirs->width;
        for (int i = 0; i < 4 * theirs->width; i++) {
            float difference = byte_of(a[i]) - byte_of(b[i]);
            out[i] = which == 0   ? byte_of(a[i])
                     : which == 1 ? byte_of(b[i])
                     : i % 4 == 3 ? 255
                                  : byte_of((difference < 0 ? -difference : difference) * 8 / 255);
        }
    }
    return module.rgba;
}

static void list_contract(struct json *json, const lam_check_contract *contract)
{
    lam_check_name row;
    json_open(json, NULL, '{');
    json_put(json, TEXT("name", lam_check_contract_name(contract)), TEXT("title", lam_check_contract_title(contract)));
    json_open(json, "names", '[');
    for (int i = 0; lam_check_contract_row(contract, i, &row); i++) {
        json_put(json, OBJECT(NULL, TEXT("name", row.name), TEXT("type", row.type), TEXT("meaning", row.meaning),
                              TEXT("space", row.space), FLAG("attribute", row.attribute)));
    }
    json_close(json, ']');
    json_close(json, '}');
}

static void list_texts(struct json *json, const char *key, const char *(*name)(int), const char *(*meaning)(int))
{
    json_open(json, key, '[');
    for (int i = 0; name(i); i++) {
        json_put(json, OBJECT(NULL, TEXT("name", name(i)), TEXT("meaning", meaning(i))));
    }
    json_close(json, ']');
}

void web_check_lists(void)
{
    struct json json = {.file = stdout};
    lam_error error = {0};
    json_open(&json, NULL, '{');
    json_open(&json, "contracts", '[');
    for (int i = 0; lam_check_contract_shipped(i); i++) {
        const char *name = lam_check_contract_shipped(i), *text = lam_check_contract_text(name);
        lam_check_contract *contract = lam_check_contract_read(text, strlen(text), name, &error);
        if (contract)
            list_contract(&json, contract);
        lam_check_contract_free(contract);
    }
    json_close(&json, ']');
    list_texts(&json, "scenes", lam_check_scene_name, lam_check_scene_description);
    list_texts(&json, "mistakes", lam_check_mistake, lam_check_mistake_explanation);
    exercises_list(&json);
    json_close(&json, '}');
    fflush(stdout);
}

void web_exercise(void)
{
    lam_error error = {0};
    if (!exercise_put(text_of(0), &error))
        answer_error(&error);
    fflush(stdout);
}
