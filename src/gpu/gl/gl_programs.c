// gl_programs.c: compiles the shaders of glsl.h, one program for each set of choices, and sets their uniforms.
#include "gl_device.h"

#include "fail.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static GLuint compile(const struct gl *gl, GLenum kind, const char *text, lam_error *error)
{
    GLuint shader = gl->CreateShader(kind);
    GLint done = 0;
    gl->ShaderSource(shader, 1, &text, NULL);
    gl->CompileShader(shader);
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &done);
    if (done)
        return shader;
    char log[320] = "";
    gl->GetShaderInfoLog(shader, sizeof log, NULL, log);
    gl->DeleteShader(shader);
    fail(error, LAM_UNSUPPORTED, "OpenGL: the driver cannot compile the %s shader: %s",
         kind == GL_VERTEX_SHADER ? "vertex" : "fragment", log);
    return 0;
}

// Links a program. Returns 0 on failure.
static GLuint link_program(const struct gl *gl, const char *vertex, const char *fragment, lam_error *error)
{
    GLuint parts[2] = {compile(gl, GL_VERTEX_SHADER, vertex, error), 0};
    parts[1] = parts[0] ? compile(gl, GL_FRAGMENT_SHADER, fragment, error) : 0;
    GLuint program = parts[1] ? gl->CreateProgram() : 0;
    if (program) {
        GLint done = 0;
        gl->AttachShader(program, parts[0]);
        gl->AttachShader(program, parts[1]);
        gl->LinkProgram(program);
        gl->GetProgramiv(program, GL_LINK_STATUS, &done);
        if (!done) {
            char log[320] = "";
            gl->GetProgramInfoLog(program, sizeof log, NULL, log);
            gl->DeleteProgram(program);
            program = 0;
            fail(error, LAM_UNSUPPORTED, "OpenGL: the driver cannot link the shaders: %s", log);
        }
    }
    for (int i = 0; i < 2; i++)
        if (parts[i])
            gl->DeleteShader(parts[i]);
    return program;
}

// Assigns a texture unit to the sampler of a map.
static bool find_map(struct gl_frame *f, struct gl_program *program, const struct glsl_row *row, GLint at, int *unit,
                     lam_error *error)
{
    if (*unit == f->device->unit_count)
        return fail(error, LAM_UNSUPPORTED,
                    "OpenGL: a material reads more than %d different textures, the number of texture units of this "
                    "driver",
                    f->device->unit_count - UNIT_FIRST_MAP);
    f->gl->Uniform1i(at, *unit);
    program->map_units[row->back][row->map] = (uint8_t)(*unit)++;
    return true;
}

static void add_uniform(struct gl_program *program, GLint location, const struct glsl_row *row)
{
    program->uniforms[program->uniform_count++] = (struct gl_uniform){.location = location, .row = *row};
}

// Finds the uniforms of the rows, and of the maps.
static bool find_rows(struct gl_frame *f, struct gl_program *program, lam_error *error)
{
    static const char *const others[UNIFORM_ROWS] = {"shadow_matrix", "shadow_offsets", "shadow_rounding",
                                                     "first_triangle", "sample_number"};
    const struct gl *gl = f->gl;
    struct glsl_row rows[GLSL_ROWS_MAX];
    struct glsl_stage stage = glsl_stage_of(&program->choices);
    int count = glsl_declarations(&stage, rows), unit = UNIT_FIRST_MAP;
    size_t bytes = ((size_t)count + UNIFORM_ROWS) * sizeof *program->uniforms;
    program->uniforms = malloc(bytes);
    if (!program->uniforms)
        return fail_memory(error, bytes);
    for (int i = 0; i < UNIFORM_ROWS; i++)
        add_uniform(program, gl->GetUniformLocation(program->name, others[i]), &(struct glsl_row){0});
    for (int i = 0; i < count; i++) {
        GLint at = rows[i].block ? -1 : gl->GetUniformLocation(program->name, rows[i].name);
        if (at >= 0 && rows[i].semantic == GLSL_MAP && !find_map(f, program, &rows[i], at, &unit, error))
            return false;
        if (at >= 0 && strncmp(rows[i].type, "sampler", strlen("sampler")) != 0)
            add_uniform(program, at, &rows[i]);
    }
    return true;
}

static bool find_uniforms(struct gl_frame *f, struct gl_program *program, lam_error *error)
{
    const struct gl *gl = f->gl;
    gl_use_program(f->device, program->name);
    const struct {
        const char *name;
        int unit;
    } textures[] = {{"environment_faces", UNIT_ENVIRONMENT},
                    {"light_list", UNIT_LIGHTS},
                    {"product_list", UNIT_PRODUCTS},
                    {"nearer_depth_ids", UNIT_NEARER_DEPTH_IDS},
                    {"opaque_depth_ids", UNIT_OPAQUE_DEPTH_IDS},
                    {"environment_light", UNIT_ENVIRONMENT_LIGHT},
                    {"shadow_tree", UNIT_SHADOW_TREE},
                    {"ambient_occlusion", gl_occlusion_unit(program)}};
    for (size_t i = 0; i < sizeof textures / sizeof *textures; i++) {
        GLint at = gl->GetUniformLocation(program->name, textures[i].name);
        if (at >= 0)
            gl->Uniform1i(at, textures[i].unit);
    }
    static const char *const blocks[POINT_COUNT] = {"Lights", "Products", "BackProducts"};
    for (GLuint point = 0; point < POINT_COUNT; point++) {
        GLuint block = gl->GetUniformBlockIndex(program->name, blocks[point]);
        if (block != GL_INVALID_INDEX)
            gl->UniformBlockBinding(program->name, block, point);
    }
    return find_rows(f, program, error);
}

struct gl_program *program_for(struct gl_frame *f, const struct glsl_choices *choices, lam_error *error)
{
    struct gl_device *device = f->device;
    for (int i = 0; i < device->program_count; i++)
        if (memcmp(&device->programs[i].choices, choices, sizeof *choices) == 0)
            return &device->programs[i];
    // The programs may move in memory, so gl_device.c compiles all programs of a frame before it stores pointers to
    // any.
    struct gl_program *list =
        gl_grown(device->programs, device->program_count, &device->program_capacity, sizeof *list, error);
    if (!list)
        return NULL;
    device->programs = list;
    struct glsl_text text;
    if (!glsl_make(choices, &text, error))
        return NULL;
    GLuint name = link_program(f->gl, text.vertex, text.fragment, error);
    glsl_free(&text);
    if (!name)
        return NULL;
    struct gl_program *program = &device->programs[device->program_count++];
    *program = (struct gl_program){.name = name};
    memcpy(&program->choices, choices, sizeof *choices); // also copies the padding, because memcmp compares the padding
    if (find_uniforms(f, program, error))
        return program;
    f->gl->DeleteProgram(name);
    free(program->uniforms);
    device->program_count--;
    device->current.program = UINT32_MAX;
    return NULL;
}

// --- uniforms, set only if the value has changed

// Returns whether a uniform of the current program needs a new value. If so, stores the value.
static bool changes(struct gl_frame *f, struct gl_program *program, int uniform, const void *value, size_t bytes)
{
    struct gl_uniform *u = &program->uniforms[uniform];
    if (u->location < 0 || (u->set && memcmp(u->value, value, bytes) == 0))
        return false;
    memcpy(u->value, value, bytes);
    u->set = true;
    gl_use_program(f->device, program->name);
    return true;
}

void program_set_int(struct gl_frame *f, struct gl_program *program, int uniform, GLint value)
{
    if (changes(f, program, uniform, &value, sizeof value))
        f->gl->Uniform1i(program->uniforms[uniform].location, value);
}

void program_set(struct gl_frame *f, struct gl_program *program, int uniform, const float *values, int count)
{
    GLint at = program->uniforms[uniform].location;
    if (!changes(f, program, uniform, values, (size_t)count * sizeof *values))
        return;
    if (count == 16)
        f->gl->UniformMatrix4fv(at, 1, GL_FALSE, values);
    else if (count == 9)
        f->gl->UniformMatrix3fv(at, 1, GL_FALSE, values);
    else if (count == 4)
        f->gl->Uniform4fv(at, 1, values);
    else
        f->gl->Uniform1f(at, *values);
}

// --- the program that copies a target

static const char copy_vertex[] =
    "void main()\n"
    "{\n"
    "    // One triangle covers the whole target.\n"
    "    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);\n"
    "}\n";
static const char copy_fragment[] =
    "uniform sampler2D picture;\n"
    "uniform float factor;\n"
    "out vec4 pixel;\n"
    "void main() { pixel = texelFetch(picture, ivec2(gl_FragCoord.xy), 0) * factor; }\n";

// As in blend_tinted_pixel (src/core/cpu/shade/blend.c), the layers reduce alpha by the mean transmittance of the channels.
// If no opaque surface is behind the layers and there is a background for glass, the smallest transmittance replaces
// the mean, and the excess of each channel multiplies this background.
static const char tint_fragment[] =
    "uniform sampler2D picture;\n"
    "uniform sampler2D tint;\n"
    "uniform float last;\n"
    "uniform vec4 background;\n"
    "out vec4 pixel;\n"
    "void main()\n"
    "{\n"
    "    vec4 p = texelFetch(picture, ivec2(gl_FragCoord.xy), 0);\n"
    "    vec3 t = texelFetch(tint, ivec2(gl_FragCoord.xy), 0).rgb;\n"
    "    pixel = vec4(p.rgb * t, 0.0);\n"
    "    if (last > 0.5) {\n"
    "        bool open = p.a == 0.0 && background.a > 0.0;\n"
    "        float left = open ? min(min(t.r, t.g), t.b) : (t.r + t.g + t.b) * (1.0 / 3.0);\n"
    "        if (open) {\n"
    "            pixel.rgb = (t - left) * background.rgb;\n"
    "        }\n"
    "        pixel.a = 1.0 - left * (1.0 - p.a);\n"
    "    }\n"
    "}\n";

bool program_copy_make(struct gl_device *device, lam_error *error)
{
    static const char *const starts[] = {
        "#version 330 core\n",
        "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n"};
    char vertex[512], fragment[512], tint[1024];
    snprintf(vertex, sizeof vertex, "%s%s", starts[device->context.es], copy_vertex);
    snprintf(fragment, sizeof fragment, "%s%s", starts[device->context.es], copy_fragment);
    const struct gl *gl = &device->context.gl;
    device->copy_program = link_program(gl, vertex, fragment, error);
    if (!device->copy_program)
        return false;
    device->copy_factor = gl->GetUniformLocation(device->copy_program, "factor");
    gl_use_program(device, device->copy_program);
    gl->Uniform1i(gl->GetUniformLocation(device->copy_program, "picture"), UNIT_COPY);
    gl->Uniform1f(device->copy_factor, device->copy_factor_value = 1);
    snprintf(tint, sizeof tint, "%s%s", starts[device->context.es], tint_fragment);
    device->tint_program = link_program(gl, vertex, tint, error);
    if (!device->tint_program)
        return false;
    gl_use_program(device, device->tint_program);
    gl->Uniform1i(gl->GetUniformLocation(device->tint_program, "picture"), UNIT_COPY);
    gl->Uniform1i(gl->GetUniformLocation(device->tint_program, "tint"), UNIT_NEARER_DEPTH_IDS);
    device->tint_last = gl->GetUniformLocation(device->tint_program, "last");
    device->tint_background = gl->GetUniformLocation(device->tint_program, "background");
    gl->GenVertexArrays(1, &device->empty_array);
    return true;
}

void programs_free(struct gl_device *device)
{
    const struct gl *gl = &device->context.gl;
    for (int i = 0; i < device->program_count; i++) {
        gl->DeleteProgram(device->programs[i].name);
        free(device->programs[i].uniforms);
    }
    free(device->programs);
    if (device->copy_program)
        gl->DeleteProgram(device->copy_program);
    if (device->tint_program)
        gl->DeleteProgram(device->tint_program);
    if (device->empty_array)
        gl->DeleteVertexArrays(1, &device->empty_array);
}
