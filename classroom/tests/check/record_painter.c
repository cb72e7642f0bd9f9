// record_painter.c OUT: checks shaders with OpenGL as a painter that compiles only OpenGL ES, like a page's WebGL 2. It
// records the requests to the painter, its answers and the report; classroom/tests/web/check.mjs replays them for the module of
// the page, whose requests, verdict and JSON must be the same. Standard input contains the fragment shader, the vertex
// shader and the contract, each with a 0 at its end, "" for none. The exit code is 77 without OpenGL. TEST_SIZE is the
// size of the pictures.
//
// The file is little-endian, with a record for each call: its letter, then 32-bit numbers and texts with a 0 at their
// end.
//   O renderer                          place opened
//   C hash(vertex, fragment) built refused-bits vertex-log fragment-log link-log count {name type elements attribute}
//   D hash(mesh, values, attributes, cull) pixels
//   J report
// A drawing that is requested twice in a row is recorded once, because a check draws again if the first drawing was
// slow.
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "draw_request.h"

enum { TEST_SIZE = 40, MAX_TEXTS = 1 << 18 };

static FILE *out;
static uint32_t last_drawing; // the hash; 0 after another call
static lam_check_painter gl;

static void number(uint32_t n)
{
    unsigned char bytes[4] = {(unsigned char)n, (unsigned char)(n >> 8), (unsigned char)(n >> 16),
                              (unsigned char)(n >> 24)};
    fwrite(bytes, 1, sizeof bytes, out);
}

static void text(const char *s) { fwrite(s, 1, strlen(s) + 1, out); }

// FNV-1a.
static uint32_t hash(uint32_t before, const void *data, size_t size)
{
    const unsigned char *bytes = data;
    for (size_t i = 0; i < size; i++)
        before = (before ^ bytes[i]) * 16777619U;
    return before;
}
static const uint32_t first_hash = 2166136261U;

static void *open(void *user, lam_check_language language, int size, char renderer[128], lam_error *error)
{
    void *place = gl.open(user, language, size, renderer, error);
    if (place) {
        fputc('O', out);
        text(renderer);
    }
    return place;
}

static bool compile(void *place, const char *vertex, const char *fragment, lam_check_program *p, lam_error *error)
{
    if (!gl.compile(place, vertex, fragment, p, error))
        return false;
    last_drawing = 0;
    fputc('C', out);
    number(hash(hash(first_hash, vertex, strlen(vertex)), fragment, strlen(fragment)));
    number(p->program != NULL);
    number((uint32_t)p->refused_vertex | (uint32_t)p->refused_fragment << 1);
    text(p->vertex_log);
    text(p->fragment_log);
    text(p->link_log);
    number((uint32_t)p->input_count);
    for (int i = 0; i < p->input_count; i++) {
        text(p->inputs[i].name);
        number((uint32_t)p->inputs[i].type);
        number((uint32_t)p->inputs[i].elements);
        number(p->inputs[i].attribute);
    }
    return true;
}

static bool draw(void *place, const lam_check_drawing *d, float *pixels, lam_error *error)
{
    static const size_t components[] = {0, 1, 1, 1, 2, 3, 4, 9, 16, 4}; // for each lam_check_type
    if (!gl.draw(place, d, pixels, error))
        return false;
    const lam_check_mesh *m = d->mesh;
    size_t vertices = (size_t)m->vertex_count;
    uint32_t all = hash(first_hash, m->positions, vertices * 12);
    all = hash(all, m->normals, vertices * 16);
    all = hash(all, m->tangents, vertices * 12);
    all = hash(all, m->indices, (size_t)m->index_count * 2);
    for (int i = 0; i < d->value_count; i++) {
        const lam_check_value *v = &d->values[i];
        int32_t place_of[3] = {v->input, v->first, v->count};
        all = hash(all, place_of, sizeof place_of);
        all = hash(all, v->numbers, (size_t)v->count * components[d->program->inputs[v->input].type] * 4);
    }
    for (uint64_t i = 0; i < d->stream_count; i++) {
        const lam_check_stream *s = &d->streams[i];
        int32_t place_of[2] = {s->input, s->components};
        all = hash(all, place_of, sizeof place_of);
        all = hash(all, s->numbers, vertices * (size_t)s->components * 4);
    }
    int32_t how[4] = {d->position, d->normal, d->tangent, (int32_t)d->cull};
    all = hash(all, how, sizeof how);
    if (all == last_drawing)
        return true;
    last_drawing = all;
    fputc('D', out);
    number(all);
    fwrite(pixels, sizeof *pixels, (size_t)4 * TEST_SIZE * TEST_SIZE, out);
    return true;
}

int main(int argc, char **argv)
{
    static char texts[MAX_TEXTS + 3];
    if (argc != 2 || fread(texts, 1, MAX_TEXTS, stdin) == 0)
        return 2;
    char *vertex = texts + strlen(texts) + 1, *name = vertex + strlen(vertex) + 1;
    gl = gl_painter(NULL);
    lam_check_painter painter = gl;
    painter.open = open;
    painter.compile = compile;
    painter.draw = draw;
    painter.es_only = true;
    out = fopen(argv[1], "wb");
    if (!out)
        return 2;
    lam_error error = {0};
    lam_check_contract *contract = NULL;
    if (*name) {
        const char *json = lam_check_contract_text(name);
        contract = json ? lam_check_contract_read(json, strlen(json), name, &error) : NULL;
    }
    char fragment_name[] = "shader.frag", vertex_name[] = "shader.vert";
    struct check_submission submission = {.fragment = fragment_name, .vertex = *vertex ? vertex_name : NULL};
    lam_check_cache *cache = lam_check_cache_make((size_t)64 << 20, &error);
    lam_check_params params = {.fragment = texts,
                               .fragment_name = fragment_name,
                               .vertex = *vertex ? vertex : NULL,
                               .vertex_name = submission.vertex,
                               .contract = contract,
                               .size = TEST_SIZE,
                               .tolerance = 2.0 / 255,
                               .painter = &painter,
                               .cache = cache};
    struct check_result result = {.submission = &submission};
    int code = 0;
    if (lam_check_run(&params, &result.report, &error)) {
        fputc('J', out);
        check_report_json(out, &result, NULL, 2);
    } else {
        fprintf(stderr, "%s\n", error.text);
        code = error.code == LAM_UNSUPPORTED ? 77 : 2;
    }
    lam_check_report_free(&result.report);
    lam_check_cache_free(cache);
    lam_check_contract_free(contract);
    return fclose(out) == 0 ? code : 2;
}
