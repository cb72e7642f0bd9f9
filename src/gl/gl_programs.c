// gl_programs.c: compiles the shaders of glsl.h, one program for each set of choices, and sets their uniforms.
#include "gl_device.h"

#include "fail.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const uniform_names[UNIFORM_COUNT] = {
    [UNIFORM_MODEL_VIEW_PROJECTION] = "model_view_projection",
    [UNIFORM_MODEL_VIEW] = "model_view",
    [UNIFORM_NORMAL_MATRIX] = "normal_matrix",
    [UNIFORM_ENVIRONMENT_MATRIX] = "environment_matrix",
    [UNIFORM_OBJECT] = "object",
    [UNIFORM_SHADOW_MATRIX] = "shadow_matrix",
    [UNIFORM_SHADOW_PLACES] = "shadow_places",
    [UNIFORM_SHADOW_ROUNDING] = "shadow_rounding",
    [UNIFORM_FIRST_PRODUCT] = "first_product",
    [UNIFORM_BACK_FIRST_PRODUCT] = "back_first_product",
    [UNIFORM_FIRST_TRIANGLE] = "first_triangle",
    [UNIFORM_ALPHA_CUTOFF] = "alpha_cutoff",
    [UNIFORM_BACK_ALPHA_CUTOFF] = "back_alpha_cutoff",
    [UNIFORM_MAPPED_EMISSION] = "glow",
    [UNIFORM_BACK_MAPPED_EMISSION] = "back_glow",
};

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

// Finds the uniforms of maps, and assigns a unit to each sampler.
static bool find_maps(struct gl_frame *f, struct gl_program *program, lam_error *error)
{
    const struct gl *gl = f->gl;
    int unit = UNIT_FIRST_MAP;
    for (int side = 0; side < 2; side++)
        for (int i = 0; i < LAM_MAP_COUNT; i++) {
            char name[64];
            int length = snprintf(name, sizeof name, "%s%s_map", side ? "back_" : "", lam_map_name((lam_map)i));
            GLint at = gl->GetUniformLocation(program->name, name);
            if (at >= 0 && unit == f->device->unit_count)
                return fail(error, LAM_UNSUPPORTED,
                            "OpenGL: a material reads more than %d different textures, the number of texture units of "
                            "this driver",
                            f->device->unit_count - UNIT_FIRST_MAP);
            if (at >= 0) {
                gl->Uniform1i(at, unit);
                program->map_units[side][i] = (uint8_t)unit++;
            }
            for (int row = 0; row < 2; row++) {
                snprintf(name + length, sizeof name - (size_t)length, "_%c", row ? 't' : 's');
                program->locations[UNIFORM_MAPS + 2 * (side * LAM_MAP_COUNT + i) + row] =
                    gl->GetUniformLocation(program->name, name);
            }
        }
    return true;
}

static bool find_uniforms(struct gl_frame *f, struct gl_program *program, lam_error *error)
{
    const struct gl *gl = f->gl;
    gl_use_program(f->device, program->name);
    for (int u = 0; u < UNIFORM_COUNT; u++)
        program->locations[u] = uniform_names[u] ? gl->GetUniformLocation(program->name, uniform_names[u]) : -1;
    struct glsl_material_layout head = glsl_material_layout(true, program->choices.field_layers);
    for (int i = 0; i < head.count; i++) {
        char back[64] = "back_";
        const char *name = strcat(back, glsl_field_name(head.fields[i], true)) + strlen("back_");
        program->locations[UNIFORM_HEAD + i] = gl->GetUniformLocation(program->name, name);
        program->locations[UNIFORM_BACK_HEAD + i] = gl->GetUniformLocation(program->name, back);
    }
    static const char *const textures[UNIT_COPY] = {"environment_faces", "light_list",       "product_list",
                                                    "nearer_depth_ids",  "opaque_depth_ids", "environment_light"};
    for (int unit = 0; unit < UNIT_COPY; unit++) {
        GLint at = gl->GetUniformLocation(program->name, textures[unit]);
        if (at >= 0)
            gl->Uniform1i(at, unit);
    }
    GLint tree = gl->GetUniformLocation(program->name, "shadow_tree");
    if (tree >= 0)
        gl->Uniform1i(tree, UNIT_SHADOW_TREE);
    GLint occlusion = gl->GetUniformLocation(program->name, "ambient_occlusion");
    if (occlusion >= 0)
        gl->Uniform1i(occlusion, gl_occlusion_unit(program));
    static const char *const blocks[POINT_COUNT] = {"Lights", "Products", "BackProducts"};
    for (GLuint point = 0; point < POINT_COUNT; point++) {
        GLuint block = gl->GetUniformBlockIndex(program->name, blocks[point]);
        if (block != GL_INVALID_INDEX)
            gl->UniformBlockBinding(program->name, block, point);
    }
    return find_maps(f, program, error);
}

struct gl_program *program_for(struct gl_frame *f, const struct glsl_choices *choices, lam_error *error)
{
    struct gl_device *device = f->device;
    for (int i = 0; i < device->program_count; i++)
        if (memcmp(&device->programs[i].choices, choices, sizeof *choices) == 0)
            return &device->programs[i];
    // The programs may move, so gl_device.c compiles all programs of a frame before it stores pointers to any.
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
    memcpy(&program->choices, choices, sizeof *choices); // including the padding, for memcmp
    if (find_uniforms(f, program, error))
        return program;
    f->gl->DeleteProgram(name);
    device->program_count--;
    device->current.program = UINT32_MAX;
    return NULL;
}

// --- uniforms, set only if the value has changed

void program_set(struct gl_frame *f, struct gl_program *program, enum uniform uniform, const float *values, int count)
{
    GLint at = program->locations[uniform];
    float *before = program->values[uniform];
    size_t bytes = (size_t)count * sizeof *values;
    if (at < 0 || (program->set[uniform] && memcmp(before, values, bytes) == 0))
        return;
    memcpy(before, values, bytes);
    program->set[uniform] = true;
    gl_use_program(f->device, program->name);
    if (count == 16)
        f->gl->UniformMatrix4fv(at, 1, GL_FALSE, values);
    else if (count == 9)
        f->gl->UniformMatrix3fv(at, 1, GL_FALSE, values);
    else if (count == 4)
        f->gl->Uniform4fv(at, 1, values);
    else
        f->gl->Uniform1f(at, values[0]);
}

void program_set_int(struct gl_frame *f, struct gl_program *program, enum uniform uniform, int value)
{
    GLint at = program->locations[uniform];
    int *before = &program->ints[uniform - UNIFORM_FLOATS];
    if (at < 0 || (program->set[uniform] && *before == value))
        return;
    *before = value;
    program->set[uniform] = true;
    gl_use_program(f->device, program->name);
    f->gl->Uniform1i(at, value);
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

// Like blend_tinted_pixel (src/cpu/shade/blend.c): there is one alpha, the mean of the channels, and the background is
// tinted by the difference.
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
    for (int i = 0; i < device->program_count; i++)
        gl->DeleteProgram(device->programs[i].name);
    free(device->programs);
    if (device->copy_program)
        gl->DeleteProgram(device->copy_program);
    if (device->tint_program)
        gl->DeleteProgram(device->tint_program);
    if (device->empty_array)
        gl->DeleteVertexArrays(1, &device->empty_array);
}
