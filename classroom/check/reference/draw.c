// draw.c: compiles the tested shaders, sets their uniforms for each reference scene, and draws.
#include "draw_request.h"
#include "reference_scene.h"

#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "fail.h"

// One element of an input whose name is in the contract.
struct uniform_binding {
    const struct contract_name *name;
    int light;
    int input, element; // indices in the program
};

struct shader_run {
    struct canvas canvas;
    struct shader_interface interface;
    struct draw_request request;
    struct draw_result drawn;
    lam_check_program program;
    int position, normal, tangent; // indices of inputs, or −1
    struct map_inputs maps;
    struct uniform_binding *bindings; // one for each element of each uniform
    lam_check_value *values;          // one value per binding
    float (*numbers)[16];             // the floats of `values`
    int binding_count;
};

static void report_unknown(struct draw_result *drawn, const char *name)
{
    for (int i = 0; i < drawn->unknown_count; i++)
        if (strcmp(drawn->unknown[i], name) == 0)
            return;
    if (drawn->unknown_count < MAX_UNKNOWN_NAMES)
        snprintf(drawn->unknown[drawn->unknown_count++], sizeof drawn->unknown[0], "%.63s", name);
}

// Returns whether a uniform's type matches the type in the contract: both are matrices, both are vectors or both are
// scalars. A colour may also be a texture.
static bool type_fits(lam_check_type type, const struct contract_name *name)
{
    const char *contract_type = name->type;
    struct type_shape t = type_shape(type);
    if (type == LAM_CHECK_TYPE_SAMPLER2D)
        return (role_of(name->semantic)->types & TYPE_SAMPLER) != 0;
    if (strncmp(contract_type, "mat", 3) == 0)
        return t.columns > 1;
    if (strcmp(contract_type, "vec2") == 0)
        return t.columns == 1 && t.rows == 2;
    if (strncmp(contract_type, "vec", 3) == 0)
        return t.columns == 1 && t.rows > 2;
    return t.rows == 1;
}

static const struct contract_name *look_up(const struct contract *contract, const char *name, bool attribute,
                                           int *index)
{
    const struct contract_name *found = contract_find(contract, name, attribute, index);
    const char *dot = strchr(name, '.');
    return found || !dot ? found : contract_find(contract, dot + 1, attribute, index); // Block.member
}

// Returns whether the program is compiled from desktop GLSL that was rewritten for OpenGL ES (shader_dialect_es).
static bool is_rewritten(const struct shader_run *run)
{
    return run->canvas.painter.es_only && shader_dialect_language(&run->interface) != LAM_CHECK_LANGUAGE_ES;
}

static void add_binding(struct shader_run *run, int index)
{
    const lam_check_input *input = &run->program.inputs[index];
    int light = 0;
    const struct contract_name *known = is_rewritten(run) ? shader_dialect_built_in(input->name) : NULL;
    if (!known)
        known = look_up(run->interface.contract, input->name, false, &light);
    if (!known) {
        report_unknown(&run->drawn, input->name);
        return;
    }
    if (input->type == LAM_CHECK_TYPE_OTHER && known->semantic == SEMANTIC_ZERO)
        return; // the uniform keeps its default value
    if (!type_fits(input->type, known)) {
        if (run->drawn.types_count < MAX_UNKNOWN_NAMES)
            snprintf(run->drawn.types[run->drawn.types_count++], sizeof run->drawn.types[0],
                     "uniform %s %.40s should be of type %s", type_shape(input->type).name, input->name, known->type);
        return;
    }
    for (int i = 0; i < input->elements; i++) {
        run->bindings[run->binding_count++] =
            (struct uniform_binding){.name = known, .light = light + i, .input = index, .element = i};
        int *count = known->group >= 0 ? &run->drawn.group_counts[known->group] : NULL;
        if (count && strchr(input->name, '[') && light + i + 1 > *count)
            *count = light + i + 1;
    }
}

static void add_attribute(struct shader_run *run, int index)
{
    const char *name = run->program.inputs[index].name;
    const struct contract_name *known = is_rewritten(run) ? shader_dialect_built_in(name) : NULL;
    if (!known)
        known = contract_find(run->interface.contract, name, true, NULL);
    if (!known)
        report_unknown(&run->drawn, name);
    else if (known->semantic == SEMANTIC_POSITION)
        run->position = index;
    else if (known->semantic == SEMANTIC_NORMAL)
        run->normal = index;
    else if (known->semantic == SEMANTIC_TANGENT && run->interface.maps)
        run->maps.tangent = index;
    else if (known->semantic == SEMANTIC_TANGENT)
        run->tangent = index;
    else if (known->semantic == SEMANTIC_BITANGENT)
        run->maps.bitangent = index;
    else if (known->semantic == SEMANTIC_FACTOR)
        run->maps.factors[run->maps.factors[0] < 0 ? 0 : 1] = index;
    else if (known->semantic == SEMANTIC_TEXCOORD && run->interface.maps)
        run->maps.texture_coordinates[run->maps.texture_coordinates[0] < 0 ? 0 : 1] = index;
}

static bool find_inputs(struct shader_run *run, lam_error *error)
{
    size_t capacity = 1;
    for (int i = 0; i < run->program.input_count; i++)
        capacity += (size_t)run->program.inputs[i].elements;
    run->bindings = calloc(capacity, sizeof *run->bindings);
    run->values = calloc(capacity, sizeof *run->values);
    run->numbers = calloc(capacity, sizeof *run->numbers);
    if (!run->bindings || !run->values || !run->numbers)
        return fail_memory(error, capacity * sizeof *run->numbers);
    run->position = run->normal = run->tangent = -1;
    run->maps = no_map_inputs;
    for (int i = 0; i < run->program.input_count; i++)
        if (strncmp(run->program.inputs[i].name, "gl_", 3) == 0)
            continue;
        else if (run->program.inputs[i].attribute)
            add_attribute(run, i);
        else
            add_binding(run, i);
    return true;
}

// Converts a value to the columns of a uniform's type.
static void convert_value(struct type_shape shape, const struct uniform_value *value, float out[16])
{
    for (int c = 0; c < shape.columns; c++)
        memcpy(out + (ptrdiff_t)c * shape.rows, value->v + (ptrdiff_t)4 * c, (size_t)shape.rows * sizeof *out);
}

static bool draw_scene(struct shader_run *run, const struct reference_scene *scene, float *pixels, lam_error *error)
{
    lam_light_frame frame = (lam_light_frame)run->request.light_frame;
    struct reference_matrices m;
    reference_matrices(scene, &m);
    for (int i = 0; i < run->binding_count; i++) {
        const struct uniform_binding *w = &run->bindings[i];
        lam_light_frame space = w->name->group >= 0 && frame != LAM_FRAME_WORLD ? frame : w->name->space;
        int light =
            w->name->group < 0 ? w->light : shader_interface_light(&run->interface, scene, w->name->group, w->light);
        struct uniform_value value = uniform_semantic_value(w->name->semantic, light, space, scene, &m);
        convert_value(type_shape(run->program.inputs[w->input].type), &value, run->numbers[i]);
        run->values[i] =
            (lam_check_value){.input = w->input, .first = w->element, .count = 1, .numbers = run->numbers[i]};
    }
    lam_check_drawing drawing = {.program = &run->program,
                                 .position = run->position,
                                 .normal = run->normal,
                                 .tangent = run->tangent,
                                 .values = run->values,
                                 .value_count = run->binding_count};
    memcpy(drawing.model_view, matrix_value(&m.model_view).v, sizeof drawing.model_view);
    memcpy(drawing.projection, matrix_value(&m.projection).v, sizeof drawing.projection);
    return canvas_draw(&run->canvas, scene->mesh, &drawing, &run->maps, pixels, error);
}

// --- shaders that loop forever

// Software drivers leave an endless loop after tens of thousands of iterations and continue with the current values.
// The check recognises such a shader by the processor time that all threads use; a correct shader uses a hundredth of
// the limit. The limit depends on the machine's speed: it is a multiple of the time that a sum of dependent terms
// takes. This time is measured in intervals so short that at least one of them is not interrupted.
static double seconds(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

#ifdef __wasi__ // WASI does not report processor time, so the caller stops endless loops
static double time_limit_s(int size) { return size > 0 ? DBL_MAX : 0; }
#else
enum { RUNS = 16, TERMS = 1 << 16, TERMS_PER_PIXEL = 2000, MIN_PIXELS = 128 * 128 };
static const double min_time_limit_s = 0.05; // the clock's resolution may be as coarse as 10 ms

static double time_limit_s(int size)
{
    volatile float seed = 0.5f;
    double shortest = 1;
    for (int run = 0; run < RUNS; run++) {
        double start = seconds(CLOCK_MONOTONIC);
        float x = seed, a = seed;
        for (int i = 0; i < TERMS; i++)
            x = x * a + a;
        seed = x * 0.5f;
        double taken = seconds(CLOCK_MONOTONIC) - start;
        shortest = taken < shortest ? taken : shortest;
    }
    double limit = shortest / TERMS * TERMS_PER_PIXEL * ((double)size * size + MIN_PIXELS);
    return limit > min_time_limit_s ? limit : min_time_limit_s;
}
#endif

// Compiles and links the sources with the painter's compiler. `program` stays empty if they do not compile.
static bool compile(struct shader_run *run, const char *vertex, const char *fragment, lam_check_program *program,
                    lam_error *error)
{
    const lam_check_painter *painter = &run->canvas.painter;
    if (!is_rewritten(run))
        return painter->compile(run->canvas.context, vertex, fragment, program, error);
    char *es_vertex = shader_dialect_es(vertex, true, error);
    char *es_fragment = es_vertex ? shader_dialect_es(fragment, false, error) : NULL;
    bool ok = es_fragment && painter->compile(run->canvas.context, es_vertex, es_fragment, program, error);
    free(es_vertex);
    free(es_fragment);
    if (ok) {
        shader_dialect_restore(program->vertex_log);
        shader_dialect_restore(program->fragment_log);
        shader_dialect_restore(program->link_log);
    }
    return ok;
}

// Builds the program. Errors are recorded in run->drawn and refer to the unchanged sources. If a shader lowers the
// precision, both shaders are then built again with full precision, because a correct shader may use a lower precision
// (draw_request.h).
static bool build(struct shader_run *run, lam_error *error)
{
    const char *vertex = shader_dialect_skip_mark(run->request.vertex),
               *fragment = shader_dialect_skip_mark(run->request.fragment);
    struct draw_result *drawn = &run->drawn;
    if (!compile(run, vertex, fragment, &run->program, error))
        return false;
    drawn->refused_vertex = run->program.refused_vertex;
    drawn->refused_fragment = run->program.refused_fragment;
    bool compiles = !drawn->refused_vertex && !drawn->refused_fragment;
    drawn->state = run->program.program ? DRAWN_PICTURES : compiles ? DRAWN_REFUSED_LINK : DRAWN_REFUSED;
    memcpy(drawn->log, compiles ? run->program.link_log : run->program.vertex_log, sizeof drawn->log);
    memcpy(drawn->fragment_log, run->program.fragment_log, sizeof drawn->fragment_log);
    if (!run->program.program ||
        !(shader_dialect_lowers_precision(vertex) || shader_dialect_lowers_precision(fragment)))
        return true;
    char *high_vertex = shader_dialect_highp(vertex), *high_fragment = shader_dialect_highp(fragment);
    lam_check_program *high = calloc(1, sizeof *high);
    bool ok = high_vertex && high_fragment && high;
    if (!ok)
        fail_memory(error, strlen(vertex) + strlen(fragment));
    ok = ok && compile(run, high_vertex, high_fragment, high, error);
    if (ok && high->program) {
        run->canvas.painter.forget(run->canvas.context, &run->program);
        run->program = *high;
    }
    free(high_vertex);
    free(high_fragment);
    free(high);
    return ok;
}

static bool draw_scenes(struct shader_run *run, float *pixels, lam_error *error)
{
    if (!find_inputs(run, error))
        return false;
    shader_interface_set_counts(&run->interface, run->drawn.group_counts);
    size_t at = 0, each = 4 * (size_t)run->request.size * (size_t)run->request.size;
    double limit = time_limit_s(run->request.size);
    for (int i = 0; i < reference_scene_count; i++)
        if (run->request.scenes >> i & 1) {
            struct reference_scene scene = shader_interface_scene(&run->interface, &reference_scenes[i]);
            double taken = 0;
            for (int turn = 0; turn == 0 || (turn == 1 && taken > limit);
                 turn++) { // the first draw may include the driver's compilation, so a slow scene is drawn again
                double start = seconds(CLOCK_PROCESS_CPUTIME_ID);
                if (!draw_scene(run, &scene, pixels + at, error))
                    return false;
                taken = seconds(CLOCK_PROCESS_CPUTIME_ID) - start;
            }
            if (taken > limit) {
                run->drawn.state = DRAWN_SLOW;
                run->drawn.seconds = taken;
                snprintf(run->drawn.log, sizeof run->drawn.log, "%s", reference_scenes[i].name);
                return true;
            }
            at += each;
        }
    return true;
}

static bool draw_all(struct shader_run *run, lam_bytes *out, lam_error *error)
{
    snprintf(run->drawn.driver, sizeof run->drawn.driver, "%s", run->canvas.renderer);
    run->drawn.scenes = run->request.scenes;
    size_t count = 0;
    for (int i = 0; i < reference_scene_count; i++)
        count += run->request.scenes >> i & 1;
    count *= 4 * (size_t)run->request.size * (size_t)run->request.size;
    float *pixels = malloc(count * sizeof *pixels + 1);
    if (!pixels)
        return fail_memory(error, count * sizeof *pixels);
    bool ok = build(run, error) && (!run->program.program || draw_scenes(run, pixels, error)) &&
              draw_result_write(&run->drawn, run->drawn.state == DRAWN_PICTURES ? pixels : NULL,
                                run->drawn.state == DRAWN_PICTURES ? count : 0, out, error);
    free(pixels);
    return ok;
}

bool check_draw(const void *request, size_t size, const lam_check_painter *painter, lam_bytes *out, lam_error *error)
{
    *out = (lam_bytes){0};
    struct shader_run *run = calloc(1, sizeof *run);
    if (!run)
        return fail_memory(error, sizeof *run);
    bool ok = draw_request_read(request, size, &run->request, error);
    const char *text = run->request.contract;
    struct complete_texts texts = {.vertex = run->request.vertex,
                                   .fragment = run->request.fragment,
                                   .lines = {run->request.lines[0], run->request.lines[1]}};
    struct text packed = {0};
    lam_check_contract *contract = NULL;
    ok = ok && prefix_read(NULL, &texts, error);
    if (ok && run->request.size == READ_ONLY) {
        declarations_pack(&texts.sides[0], &packed);
        declarations_pack(&texts.sides[1], &packed);
        *out = (lam_bytes){packed.bytes, packed.length};
        ok = !packed.failed || fail_memory(error, packed.capacity);
    } else if (ok) {
        contract = lam_check_contract_read(text, strlen(text), NULL, error);
        ok = contract && shader_interface_make(&run->interface, &texts, &contract->contract, error) &&
             canvas_open(&run->canvas, painter, shader_dialect_language(&run->interface), run->request.size, error) &&
             draw_all(run, out, error);
    }
    if (run->canvas.context)
        run->canvas.painter.forget(run->canvas.context, &run->program);
    canvas_close(&run->canvas);
    prefix_free(&texts);
    lam_check_contract_free(contract);
    free(run->bindings);
    free(run->values);
    free(run->numbers);
    free(run);
    return ok;
}

bool lam_check_draw(const void *request, size_t size, const char *gl_device, lam_bytes *out, lam_error *error)
{
    lam_check_painter painter = gl_painter(gl_device);
    return check_draw(request, size, &painter, out, error);
}
