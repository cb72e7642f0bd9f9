// draw.c: compiles the shaders under test, gives their uniforms the values of each reference scene, and draws.
#include "draw_request.h"
#include "shader_interface.h"
#include "offscreen.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "fail.h"

enum { BLOCKS_MOST = 8, BLOCK_BYTES_MOST = 65536 };

// An active uniform that the contract knows, one element of it.
struct wire {
    enum uniform_semantic role;
    int light;
    GLenum type;
    GLint location; // −1: in a block
    int block, offset, matrix_stride;
};

struct bench {
    struct offscreen target;
    struct shader_interface reading;
    struct draw_request job;
    struct check_drawn drawn;
    GLuint program;
    int position, normal; // attribute locations; −1: built in, or none
    struct wire *wires;   // room for every element of every uniform
    int wire_count;
    GLuint blocks[BLOCKS_MOST];
    int block_bytes[BLOCKS_MOST];
};

static enum gl_profile profile_of(const struct shader_interface *r)
{
    const struct declarations *d = r->vertex.version > r->fragment.version ? &r->vertex : &r->fragment;
    if (strcmp(d->profile, "es") == 0 || d->version == 100)
        return GL_PROFILE_ES;
    if (d->version < 150 || strcmp(d->profile, "compatibility") == 0)
        return GL_PROFILE_COMPATIBILITY;
    return GL_PROFILE_CORE;
}

static void tell_unknown(struct check_drawn *drawn, const char *name)
{
    for (int i = 0; i < drawn->unknown_count; i++)
        if (strcmp(drawn->unknown[i], name) == 0)
            return;
    if (drawn->unknown_count < DRAWN_UNKNOWN_MOST)
        snprintf(drawn->unknown[drawn->unknown_count++], sizeof drawn->unknown[0], "%.63s", name);
}

static const char *type_name(GLenum type)
{
    switch (type) {
    case GL_FLOAT:
        return "float";
    case GL_FLOAT_VEC2:
        return "vec2";
    case GL_FLOAT_VEC3:
        return "vec3";
    case GL_FLOAT_VEC4:
        return "vec4";
    case GL_INT:
        return "int";
    case GL_BOOL:
        return "bool";
    case GL_FLOAT_MAT3:
        return "mat3";
    case GL_FLOAT_MAT4:
        return "mat4";
    default:
        return "another type";
    }
}

// What a type can hold of a role's numbers: matrices are matrices, vectors vectors, and numbers numbers.
static bool type_fits(GLenum type, const char *contract_type)
{
    if (strncmp(contract_type, "mat", 3) == 0)
        return type == GL_FLOAT_MAT3 || type == GL_FLOAT_MAT4;
    if (strncmp(contract_type, "vec", 3) == 0)
        return type == GL_FLOAT_VEC3 || type == GL_FLOAT_VEC4;
    return type == GL_FLOAT || type == GL_INT || type == GL_BOOL;
}

static const struct contract_name *look_up(const struct contract *contract, const char *name, bool attribute,
                                           int *index)
{
    const struct contract_name *found = contract_find(contract, name, attribute, index);
    const char *dot = strchr(name, '.');
    return found || !dot ? found : contract_find(contract, dot + 1, attribute, index); // Block.member
}

static void add_wire(struct bench *b, GLuint number, const char *name, GLenum type, GLint elements)
{
    const struct gl *gl = &b->target.context.gl;
    if (strncmp(name, "gl_", 3) == 0)
        return;
    int light = 0;
    const struct contract_name *known = look_up(b->reading.contract, name, false, &light);
    if (!known) {
        tell_unknown(&b->drawn, name);
        return;
    }
    if (!type_fits(type, known->type)) {
        if (b->drawn.types_count < DRAWN_UNKNOWN_MOST)
            snprintf(b->drawn.types[b->drawn.types_count++], sizeof b->drawn.types[0],
                     "uniform %s %.40s: the contract's is %s", type_name(type), name, known->type);
        return;
    }
    GLint block = -1, offset = 0, stride = 0, array_stride = 0;
    gl->GetActiveUniformsiv(b->program, 1, &number, GL_UNIFORM_BLOCK_INDEX, &block);
    if (block >= 0) {
        gl->GetActiveUniformsiv(b->program, 1, &number, GL_UNIFORM_OFFSET, &offset);
        gl->GetActiveUniformsiv(b->program, 1, &number, GL_UNIFORM_MATRIX_STRIDE, &stride);
        gl->GetActiveUniformsiv(b->program, 1, &number, GL_UNIFORM_ARRAY_STRIDE, &array_stride);
    }
    for (int i = 0; i < elements; i++) {
        char element[128];
        snprintf(element, sizeof element, "%s", name);
        char *bracket = elements > 1 ? strrchr(element, '[') : NULL;
        if (bracket && i > 0)
            snprintf(bracket, sizeof element - (size_t)(bracket - element), "[%d]", i);
        b->wires[b->wire_count++] =
            (struct wire){.role = known->role,
                          .light = light + i,
                          .type = type,
                          .block = block,
                          .location = block < 0 ? gl->GetUniformLocation(b->program, element) : -1,
                          .offset = offset + i * array_stride,
                          .matrix_stride = stride};
        if (strchr(name, '[') && known->role >= ROLE_LIGHT_POSITION && known->role <= ROLE_LIGHT_AMBIENT &&
            light + i + 1 > b->drawn.light_count)
            b->drawn.light_count = light + i + 1;
    }
}

static bool find_uniforms(struct bench *b, lam_error *error)
{
    const struct gl *gl = &b->target.context.gl;
    GLint count = 0, blocks = 0;
    size_t room = 1;
    gl->GetProgramiv(b->program, GL_ACTIVE_UNIFORMS, &count);
    for (GLuint i = 0; i < (GLuint)count; i++) {
        char name[8];
        GLint elements = 0;
        GLenum type = 0;
        gl->GetActiveUniform(b->program, i, sizeof name, NULL, &elements, &type, name);
        room += (size_t)elements;
    }
    b->wires = calloc(room, sizeof *b->wires);
    if (!b->wires)
        return fail_memory(error, room * sizeof *b->wires);
    for (GLuint i = 0; i < (GLuint)count; i++) {
        char name[128];
        GLint elements = 0;
        GLenum type = 0;
        gl->GetActiveUniform(b->program, i, sizeof name, NULL, &elements, &type, name);
        add_wire(b, i, name, type, elements);
    }
    gl->GetProgramiv(b->program, GL_ACTIVE_UNIFORM_BLOCKS, &blocks);
    for (GLuint i = 0; i < (GLuint)blocks && i < BLOCKS_MOST; i++) {
        GLint bytes = 0;
        gl->GetActiveUniformBlockiv(b->program, i, GL_UNIFORM_BLOCK_DATA_SIZE, &bytes);
        b->block_bytes[i] = bytes < BLOCK_BYTES_MOST ? bytes : BLOCK_BYTES_MOST;
        gl->GenBuffers(1, &b->blocks[i]);
        gl->BindBufferBase(GL_UNIFORM_BUFFER, i, b->blocks[i]);
        gl->UniformBlockBinding(b->program, i, i);
    }
    return true;
}

static void find_attributes(struct bench *b)
{
    const struct gl *gl = &b->target.context.gl;
    GLint count = 0;
    b->position = b->normal = -1;
    gl->GetProgramiv(b->program, GL_ACTIVE_ATTRIBUTES, &count);
    for (GLuint i = 0; i < (GLuint)count; i++) {
        char name[128];
        GLint elements = 0;
        GLenum type = 0;
        gl->GetActiveAttrib(b->program, i, sizeof name, NULL, &elements, &type, name);
        if (strncmp(name, "gl_", 3) == 0)
            continue;
        const struct contract_name *known = contract_find(b->reading.contract, name, true, NULL);
        if (!known)
            tell_unknown(&b->drawn, name);
        else if (known->role == ROLE_POSITION)
            b->position = gl->GetAttribLocation(b->program, name);
        else if (known->role == ROLE_NORMAL)
            b->normal = gl->GetAttribLocation(b->program, name);
    }
}

// A role's numbers in a uniform's type: `values` matrices are 4×4 by columns.
static int shape_value(GLenum type, int count, const float values[16], float out[16])
{
    if (type == GL_FLOAT_MAT3) {
        for (int c = 0; c < 3; c++)
            for (int r = 0; r < 3; r++)
                out[3 * c + r] = values[4 * c + r];
        return 9;
    }
    memcpy(out, values, 16 * sizeof *out);
    (void)count;
    return type == GL_FLOAT_MAT4 ? 16 : type == GL_FLOAT_VEC4 ? 4 : type == GL_FLOAT_VEC3 ? 3 : 1;
}

static void set_uniform(const struct gl *gl, const struct wire *w, const float *v)
{
    GLint whole = (GLint)v[0];
    switch (w->type) {
    case GL_FLOAT:
        gl->Uniform1fv(w->location, 1, v);
        break;
    case GL_FLOAT_VEC3:
        gl->Uniform3fv(w->location, 1, v);
        break;
    case GL_FLOAT_VEC4:
        gl->Uniform4fv(w->location, 1, v);
        break;
    case GL_FLOAT_MAT3:
        gl->UniformMatrix3fv(w->location, 1, GL_FALSE, v);
        break;
    case GL_FLOAT_MAT4:
        gl->UniformMatrix4fv(w->location, 1, GL_FALSE, v);
        break;
    default:
        gl->Uniform1iv(w->location, 1, &whole);
        break;
    }
}

static void store_in_block(const struct wire *w, const float *v, int count, unsigned char *bytes, int room)
{
    int columns = w->type == GL_FLOAT_MAT4 ? 4 : w->type == GL_FLOAT_MAT3 ? 3 : 1, rows = count / columns;
    for (int c = 0; c < columns; c++) {
        int at = w->offset + c * w->matrix_stride;
        if (at < 0 || at + rows * 4 > room)
            return;
        if (w->type == GL_INT || w->type == GL_BOOL) {
            int32_t whole = (int32_t)v[0];
            memcpy(bytes + at, &whole, sizeof whole);
        } else {
            memcpy(bytes + at, v + c * rows, (size_t)rows * sizeof *v);
        }
    }
}

static void set_built_ins(const struct gl *gl, const struct contract *contract,
                          const struct reference_scene *reference_scene, const struct reference_matrices *m)
{
    float values[16];
    if (!gl->MatrixMode || !gl->LoadMatrixf)
        return;
    uniform_semantic_value(ROLE_MODEL_VIEW, 0, contract, contract->light_frame, reference_scene, m, values);
    gl->MatrixMode(GL_MODELVIEW);
    gl->LoadMatrixf(values);
    uniform_semantic_value(ROLE_PROJECTION, 0, contract, contract->light_frame, reference_scene, m, values);
    gl->MatrixMode(GL_PROJECTION);
    gl->LoadMatrixf(values);
}

static bool set_values(struct bench *b, const struct reference_scene *reference_scene, enum gl_profile profile,
                       lam_error *error)
{
    const struct gl *gl = &b->target.context.gl;
    const struct contract *contract = b->reading.contract;
    struct reference_matrices m;
    reference_matrices(reference_scene, &m);
    if (profile == GL_PROFILE_COMPATIBILITY)
        set_built_ins(gl, contract, reference_scene, &m);
    unsigned char *bytes = calloc(BLOCKS_MOST, BLOCK_BYTES_MOST);
    if (!bytes)
        return fail_memory(error, BLOCKS_MOST * BLOCK_BYTES_MOST);
    for (int i = 0; i < b->wire_count; i++) {
        const struct wire *w = &b->wires[i];
        float values[16], shaped[16];
        int count = uniform_semantic_value(w->role, w->light, contract, (lam_light_frame)b->job.light_frame,
                                           reference_scene, &m, values);
        count = shape_value(w->type, count, values, shaped);
        if (w->block < 0)
            set_uniform(gl, w, shaped);
        else if (w->block < BLOCKS_MOST)
            store_in_block(w, shaped, count, bytes + (size_t)w->block * BLOCK_BYTES_MOST, b->block_bytes[w->block]);
    }
    for (int i = 0; i < BLOCKS_MOST; i++)
        if (b->blocks[i]) {
            gl->BindBuffer(GL_UNIFORM_BUFFER, b->blocks[i]);
            gl->BufferData(GL_UNIFORM_BUFFER, b->block_bytes[i], bytes + (size_t)i * BLOCK_BYTES_MOST, GL_STATIC_DRAW);
        }
    free(bytes);
    return true;
}

// --- shaders that take too long

// A loop that never ends may end all the same: software drivers leave one after some ten thousand turns, and
// go on with what they have. It is told by the time: a right shader takes a hundredth of this for each pixel,
// such a loop more. What a shader takes is the processor's time, of all threads; the measure is a sum whose
// terms wait for each other, by the clock, in pieces so short that one of them is not interrupted.
enum { PIECES = 16, TERMS = 1 << 16, TERMS_A_PIXEL = 2000, PIXELS_AT_LEAST = 128 * 128 };
static const double least_s = 0.05; // processors' clocks may tick as coarsely as 10 ms

static double seconds(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

static double longest_s(int size)
{
    volatile float seed = 0.5f;
    double least = 1;
    for (int piece = 0; piece < PIECES; piece++) {
        double start = seconds(CLOCK_MONOTONIC);
        float x = seed, a = seed;
        for (int i = 0; i < TERMS; i++)
            x = x * a + a;
        seed = x * 0.5f;
        double taken = seconds(CLOCK_MONOTONIC) - start;
        least = taken < least ? taken : least;
    }
    double longest = least / TERMS * TERMS_A_PIXEL * ((double)size * size + PIXELS_AT_LEAST);
    return longest > least_s ? longest : least_s;
}

// Compiles and links; what is refused is in b->drawn.
static void build(struct bench *b)
{
    struct check_drawn *d = &b->drawn;
    const struct gl *gl = &b->target.context.gl;
    GLuint vertex = offscreen_compile(&b->target, GL_VERTEX_SHADER, b->job.vertex, d->log, sizeof d->log);
    if (!vertex) {
        d->state = DRAWN_REFUSED_VERTEX;
        return;
    }
    GLuint fragment = offscreen_compile(&b->target, GL_FRAGMENT_SHADER, b->job.fragment, d->log, sizeof d->log);
    if (!fragment) {
        d->state = DRAWN_REFUSED_FRAGMENT;
    } else {
        b->program = offscreen_link(&b->target, vertex, fragment, d->log, sizeof d->log);
        if (!b->program)
            d->state = DRAWN_REFUSED_LINK;
    }
    gl->DeleteShader(vertex);
    if (fragment)
        gl->DeleteShader(fragment);
}

static bool draw_scenes(struct bench *b, enum gl_profile profile, float *pixels, lam_error *error)
{
    b->target.context.gl.UseProgram(b->program);
    if (!find_uniforms(b, error))
        return false;
    find_attributes(b);
    b->drawn.has_list = b->drawn.light_count > 0 || b->reading.light_count > 0;
    if (b->reading.light_count > b->drawn.light_count)
        b->drawn.light_count = b->reading.light_count;
    int lights = b->drawn.has_list ? b->drawn.light_count : 1;
    size_t at = 0, each = 4 * (size_t)b->job.size * (size_t)b->job.size;
    double longest = longest_s(b->job.size);
    for (int i = 0; i < reference_scene_count; i++)
        if (b->job.scenes >> i & 1) {
            struct reference_scene reference_scene =
                contract_reference_scene(b->reading.contract, b->reading.offers, &reference_scenes[i], lights);
            if (!set_values(b, &reference_scene, profile, error))
                return false;
            double taken = 0;
            for (int turn = 0; turn == 0 || (turn == 1 && taken > longest); turn++) { // the first may compile
                double start = seconds(CLOCK_PROCESS_CPUTIME_ID);
                if (!offscreen_draw(&b->target, reference_scene.mesh, b->position, b->normal, pixels + at, error))
                    return false;
                taken = seconds(CLOCK_PROCESS_CPUTIME_ID) - start;
            }
            if (taken > longest) {
                b->drawn.state = DRAWN_SLOW;
                b->drawn.seconds = taken;
                snprintf(b->drawn.log, sizeof b->drawn.log, "%s", reference_scenes[i].name);
                return true;
            }
            at += each;
        }
    return true;
}

bool lam_check_draw(const void *job, size_t size, const char *gl_device, lam_bytes *out, lam_error *error)
{
    *out = (lam_bytes){0};
    struct bench *b = calloc(1, sizeof *b);
    if (!b)
        return fail_memory(error, sizeof *b);
    float *pixels = NULL;
    bool ok = job_read(job, size, &b->job, error) && shader_interface_make(&b->reading, b->job.vertex, b->job.fragment,
                                                                           (lam_check_contract)b->job.contract, error);
    bool open = false;
    if (ok) {
        enum gl_profile profile = profile_of(&b->reading);
        ok = open = offscreen_open(&b->target, profile, gl_device, b->job.size, error);
        size_t count = 0;
        if (ok) {
            snprintf(b->drawn.driver, sizeof b->drawn.driver, "%s", b->target.context.renderer);
            b->drawn.scenes = b->job.scenes;
            for (int i = 0; i < reference_scene_count; i++)
                count += b->job.scenes >> i & 1;
            count *= 4 * (size_t)b->job.size * (size_t)b->job.size;
            pixels = malloc(count * sizeof *pixels + 1);
            ok = pixels || fail_memory(error, count * sizeof *pixels);
        }
        if (ok)
            build(b);
        ok = ok && (!b->program || draw_scenes(b, profile, pixels, error)) &&
             drawn_write(&b->drawn, b->drawn.state == DRAWN_PICTURES ? pixels : NULL,
                         b->drawn.state == DRAWN_PICTURES ? count : 0, out, error);
    }
    if (open) {
        const struct gl *gl = &b->target.context.gl;
        if (b->program)
            gl->DeleteProgram(b->program);
        gl->DeleteBuffers(BLOCKS_MOST, b->blocks);
        offscreen_close(&b->target);
    }
    shader_interface_free(&b->reading);
    free(pixels);
    free(b->wires);
    free(b);
    return ok;
}
