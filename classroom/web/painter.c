// painter.c: the painter of a check with WebGL 2. It calls painter.js, which draws. Numbers identify render targets and
// programs. Texts end with a 0.
#include "check_module.h"

#include <stdlib.h>
#include <string.h>

#include "console.h"

#define IMPORT(name) __attribute__((import_module("painter"), import_name(#name)))

// Returns the number of a render target, or 0 if WebGL is not available; `renderer` then contains the reason.
int32_t painter_open(int32_t size, char *renderer, int32_t capacity) IMPORT(open);
void painter_close(int32_t place) IMPORT(close);
// Returns the number of a program, or 0 if it does not compile or link. Bits of `refused` name the shader with errors:
// 1 is the vertex shader, 2 the fragment shader. Each log has room for `capacity` bytes.
int32_t painter_compile(int32_t place, const char *vertex, const char *fragment, int32_t *refused, char *vertex_log,
                        char *fragment_log, char *link_log, int32_t capacity) IMPORT(compile);
int32_t painter_input_count(int32_t program) IMPORT(input_count);
// `numbers` receives the type as a lam_check_type, the number of elements, and 1 for an attribute or 0 for a uniform.
void painter_input(int32_t program, int32_t index, char *name, int32_t capacity, int32_t *numbers) IMPORT(input);
void painter_forget(int32_t program) IMPORT(forget);
void painter_mesh(int32_t place, int32_t number, int32_t vertex_count, int32_t index_count, const float *positions,
                  const float *normals, const float *tangents, const uint16_t *indices) IMPORT(mesh);
void painter_value(int32_t program, int32_t input, int32_t first, int32_t count, const float *numbers) IMPORT(value);
void painter_stream(int32_t program, int32_t input, int32_t components, int32_t vertex_count, const float *numbers)
    IMPORT(stream);
// Returns 0 if the picture was drawn, -1 if the browser has stopped the drawing, or WebGL's error.
int32_t painter_draw(int32_t place, int32_t program, int32_t mesh, int32_t index_count, int32_t position,
                     int32_t normal, int32_t tangent, int32_t cull, float *pixels) IMPORT(draw);

static bool was_stopped;

bool web_painter_was_stopped(void)
{
    bool was = was_stopped;
    was_stopped = false;
    return was;
}

static int32_t number_of(const void *handle) { return (int32_t)(uintptr_t)handle; }

static void *open(void *user, lam_check_language language, int size, char renderer[128], lam_error *error)
{
    (void)user, (void)language; // the language is always that of OpenGL ES
    int32_t place = painter_open(size, renderer, 128);
    if (!place)
        complain(error, LAM_UNSUPPORTED, "%s", renderer);
    return (void *)(uintptr_t)place;
}

static void close(void *place) { painter_close(number_of(place)); }

// No other code uses the page's WebGL.
static void rest(void *place) { (void)place; }

static bool wake(void *place, lam_error *error)
{
    (void)place, (void)error;
    return true;
}

static void forget(void *place, lam_check_program *program)
{
    (void)place;
    if (program->program)
        painter_forget(number_of(program->program));
    free(program->inputs);
    program->program = NULL;
    program->inputs = NULL;
    program->input_count = 0;
}

static bool compile(void *place, const char *vertex, const char *fragment, lam_check_program *program, lam_error *error)
{
    memset(program, 0, sizeof *program);
    int32_t refused = 0;
    int32_t number = painter_compile(number_of(place), vertex, fragment, &refused, program->vertex_log,
                                     program->fragment_log, program->link_log, sizeof program->link_log);
    program->refused_vertex = refused & 1;
    program->refused_fragment = refused & 2;
    if (!number)
        return true;
    program->program = (void *)(uintptr_t)number;
    int count = painter_input_count(number);
    program->inputs = calloc((size_t)count + 1, sizeof *program->inputs);
    if (!program->inputs) {
        forget(place, program);
        return complain(error, LAM_LIMIT, "out of memory");
    }
    program->input_count = count;
    for (int i = 0; i < count; i++) {
        lam_check_input *input = &program->inputs[i];
        int32_t numbers[3] = {0};
        painter_input(number, i, input->name, sizeof input->name, numbers);
        input->type = (lam_check_type)numbers[0];
        input->elements = numbers[1];
        input->attribute = numbers[2] != 0;
    }
    return true;
}

static bool draw(void *place, const lam_check_drawing *d, float *pixels, lam_error *error)
{
    const lam_check_mesh *m = d->mesh;
    int32_t at = number_of(place), program = number_of(d->program->program);
    painter_mesh(at, m->number, m->vertex_count, m->index_count, m->positions, m->normals, m->tangents, m->indices);
    for (int i = 0; i < d->value_count; i++)
        painter_value(program, d->values[i].input, d->values[i].first, d->values[i].count, d->values[i].numbers);
    for (uint64_t i = 0; i < d->stream_count; i++)
        painter_stream(program, d->streams[i].input, d->streams[i].components, m->vertex_count, d->streams[i].numbers);
    int32_t wrong = painter_draw(at, program, m->number, m->index_count, d->position, d->normal, d->tangent,
                                 (int32_t)d->cull, pixels);
    if (wrong < 0) {
        was_stopped = true;
        return complain(error, LAM_LIMIT, "the browser has stopped the shader, which took too long");
    }
    return wrong == 0 || complain(error, LAM_UNSUPPORTED, "WebGL reports error 0x%04x while drawing", (unsigned)wrong);
}

const lam_check_painter web_painter = {.open = open,
                                       .close = close,
                                       .rest = rest,
                                       .wake = wake,
                                       .compile = compile,
                                       .forget = forget,
                                       .draw = draw,
                                       .es_only = true};
