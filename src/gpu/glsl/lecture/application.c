// application.c: makes the application stage in the lecture style: a C function that lights a vertex. The function's
// source comes from application.c.in, and contains the scene's own lights, materials and matrices.
#include "lecture.h"

#include "application.inc"
#include "fail.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- functions that the source calls

static const struct helper {
    const char *name, *text;
} helpers[] = {
    // Each function calls only functions above it.
    {"add", "static vec3 add(vec3 a, vec3 b) { return (vec3){a.x + b.x, a.y + b.y, a.z + b.z}; }\n"},
    {"subtract", "static vec3 subtract(vec3 a, vec3 b) { return (vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }\n"},
    {"times", "static vec3 times(vec3 a, vec3 b) { return (vec3){a.x * b.x, a.y * b.y, a.z * b.z}; }\n"},
    {"scale", "static vec3 scale(double s, vec3 a) { return (vec3){s * a.x, s * a.y, s * a.z}; }\n"},
    {"dot", "static double dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }\n"},
    {"cross", "static vec3 cross(vec3 a, vec3 b)\n{\n"
              "    return (vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};\n}\n"},
    {"length", "static double length(vec3 a) { return sqrt(dot(a, a)); }\n"},
    {"normalize", "static vec3 normalize(vec3 a) { return scale(1.0 / length(a), a); }\n"},
    {"max", "static double max(double a, double b) { return a > b ? a : b; }\n"},
    {"clamp",
     "static double clamp(double x, double low, double high) { return x < low ? low : x > high ? high : x; }\n"},
    {"vector", "static vec3 vector(const float v[3]) { return (vec3){v[0], v[1], v[2]}; }\n"},
    {"transform", "// The product of a matrix, given by rows, and the column (v, w).\n"
                  "static vec3 transform(const double m[3][4], vec3 v, double w)\n{\n"
                  "    return (vec3){m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z + m[0][3] * w,\n"
                  "                  m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z + m[1][3] * w,\n"
                  "                  m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z + m[2][3] * w};\n}\n"},
    {"store",
     "static void store(float out[4], vec3 color, double opacity)\n{\n"
     "    out[0] = (float)color.x, out[1] = (float)color.y, out[2] = (float)color.z, out[3] = (float)opacity;\n}\n"},
};
enum { HELPERS = sizeof helpers / sizeof *helpers };

static bool calls(const char *text, const char *name)
{
    size_t length = strlen(name);
    for (const char *at = text; (at = strstr(at, name)); at++)
        if (at[length] == '(' && (at == text || !strchr("abcdefghijklmnopqrstuvwxyz_", at[-1])))
            return true;
    return false;
}

// Appends the functions that `body` calls, directly or indirectly.
static void add_helpers(struct text *text, const char *body)
{
    bool used[HELPERS];
    for (int i = HELPERS - 1; i >= 0; i--) {
        used[i] = calls(body, helpers[i].name);
        for (int k = i + 1; k < HELPERS; k++)
            used[i] |= used[k] && calls(strchr(helpers[k].text, '{'), helpers[i].name);
    }
    for (int i = 0; i < HELPERS; i++)
        if (used[i])
            text_add(text, helpers[i].text);
}

// --- values of the scene

// Appends a number with the fewest digits that parse to the same float.
static void add_number(struct text *text, float value)
{
    char number[32];
    for (int digits = 1; digits <= 9; digits++) {
        snprintf(number, sizeof number, "%.*g", digits, (double)value);
        if (strtof(number, NULL) == value)
            break;
    }
    text_add(text, number);
}

static void add_numbers(struct text *text, const float *values, int count)
{
    for (int i = 0; i < count; i++) {
        text_add(text, i ? ", " : "{");
        add_number(text, values[i]);
    }
    text_add(text, "}");
}

static void add_member(struct text *text, const char *before, const float *values, int count)
{
    text_add(text, before);
    add_numbers(text, values, count);
}

static void add_hemispheres(struct text *text, const struct frame *frame)
{
    text_add(text, "\nstatic const struct {\n    vec3 up, sky, ground;\n} hemispheres[] = {\n");
    for (int i = 0; i < frame->hemisphere_count; i++) {
        const struct frame_hemisphere *h = &frame->hemispheres[i];
        add_member(text, "    {.up = ", h->up, 3);
        add_member(text, ", .sky = ", h->sky, 3);
        add_member(text, ", .ground = ", h->ground, 3);
        text_add(text, "},\n");
    }
    text_add(text, "};\n");
}

// Appends the lights, with the members that at least one of them needs.
static void add_lights(struct text *text, const struct glsl_stage *f, const struct frame *frame, const int *order)
{
    text_print(text, "\nstatic const struct {\n%s%s%s%s    vec3 diffuse%s;\n} lights[] = {\n",
               f->positions ? "    vec3 position;\n" : "",
               f->directions ? "    vec3 direction;   // in which the light travels; a spot light's axis\n" : "",
               f->has_falloff ? "    vec4 attenuation; // 1 / (x + y d + z d^2); w is 1 / range\n" : "",
               f->has_cone ? "    vec4 cone;        // cos cutoff, exponent; cos outer, 1 / (cos inner - cos outer)\n"
                           : "",
               f->highlights ? ", specular" : "");
    for (int i = 0; i < f->choices->light_count; i++) {
        const struct frame_light *from = &frame->lights[order[i]];
        struct glsl_light light = glsl_light_of(from);
        text_add(text, "    {");
        if (from->kind != LIGHT_DIRECTIONAL)
            add_member(text, ".position = ", light.position, 3);
        if (from->kind != LIGHT_POINT)
            add_member(text, from->kind == LIGHT_DIRECTIONAL ? ".direction = " : ", .direction = ", light.direction, 3);
        if (f->has_falloff)
            add_member(text, ",\n     .attenuation = ", light.attenuation, 4);
        if (from->kind >= LIGHT_SPOT_CUTOFF)
            add_member(text, f->has_falloff ? ", .cone = " : ",\n     .cone = ", light.cone, 4);
        add_member(text, ",\n     .diffuse = ", light.diffuse, 3);
        if (f->highlights)
            add_member(text, ", .specular = ", light.specular, 3);
        text_add(text, "},\n");
    }
    text_add(text, "};\n");
}

static void add_matrix(struct text *text, const char *before, const float *rows, int columns)
{
    text_add(text, before);
    for (int row = 0; row < 3; row++)
        add_member(text, row ? ",\n      " : "\n     {", rows + columns * row, columns);
    text_add(text, "},\n");
}

struct members {
    bool fibre, toon_steps, opacity;
};

// Appends the matrices and the material of each draw, with the same values as a shader's uniforms.
static void add_draws(struct text *text, const struct frame *frame, const struct frame_draw_range *const *ranges,
                      int count, struct members has)
{
    text_print(text,
               "\nstatic const struct draw {\n"
               "    double model_view[3][4], normal_matrix[3][4]; // to eye space, by rows\n"
               "    vec3 ka, kd, ks, emission;\n"
               "    double shininess%s%s%s;\n} draws[] = {\n",
               has.fibre ? ", fibre" : "", has.toon_steps ? ", toon_steps" : "", has.opacity ? ", opacity" : "");
    for (int i = 0; i < count; i++) {
        const struct frame_draw *draw = &frame->draws[ranges[i]->draw];
        const lam_material *material = frame->materials[ranges[i]->front];
        float kd[3], ks[3], shininess = frame_shininess(frame, material);
        frame_material_colors(frame, material, kd, ks);
        add_matrix(text, "    {.model_view =", &draw->eye[0][0], 4);
        add_matrix(text, "     .normal_matrix =", &draw->normal[0][0], 3);
        add_member(text, "     .ka = ", &material->ambient.r, 3);
        add_member(text, ", .kd = ", kd, 3);
        add_member(text, ", .ks = ", ks, 3);
        add_member(text, ", .emission = ", &material->emission.r, 3);
        text_add(text, ",\n     .shininess = ");
        add_number(text, shininess);
        if (has.fibre)
            text_print(text, ", .fibre = %d", material->fibre);
        if (has.toon_steps)
            add_member(text, ", .toon_steps = ", &material->toon_steps, 1);
        if (has.opacity) {
            text_add(text, ", .opacity = ");
            add_number(text, material->diffuse.a);
        }
        text_add(text, "},\n");
    }
    text_add(text, "};\n");
}

// --- the complete source

static void add_body(struct text *text, const struct glsl_stage *f, bool origin)
{
    const struct glsl_choices *c = f->choices;
    bool tints = c->colors, tangents = f->needs_tangent && c->tangents, translucent = c->alpha[0] != LAM_ALPHA_OPAQUE;
    bool reads_point = (f->has_lights && f->positions) || (f->highlights && !c->distant_viewer);
    bool reads_normal = f->has_lights || f->has_hemispheres, weakened = f->has_cone || f->has_falloff;
    const char *sum = f->highlights ? "add(diffuse, specular)" : "diffuse";
    struct constant_table t = {.count = 0};
    lecture_add_flags(&t, f);
    constant_flag(&t, "flat", f->shading == LAM_SHADING_FLAT);
    constant_flag(&t, "has_origin", origin);
    constant_flag(&t, "reads_point", reads_point);
    constant_flag(&t, "reads_normal", reads_normal);
    text_print(constant_made(&t, "PARAMETERS"), "const struct draw *draw%s%s%s%s", reads_point ? ", vec3 P" : "",
               reads_normal ? ", vec3 N" : "", tangents ? ", vec3 T" : "", tints ? ", vec3 tint" : "");
    for (int back = 0; back < 2; back++)
        text_print(constant_made(&t, back ? "BACK_ARGUMENTS" : "FRONT_ARGUMENTS"), "draw%s%s%s%s",
                   reads_point ? ", P" : "",
                   !reads_normal ? ""
                   : back        ? ", scale(-1.0, N)"
                                 : ", N",
                   tangents ? ", T" : "", tints ? ", vector(color)" : "");
    text_print(
        constant_made(&t, "VERTEX_PARAMETERS"),
        "int number, const float position[3], const float normal[3],%s%s\n                  float front_color[4]%s",
        tangents ? " const float tangent[3]," : "", tints ? " const float color[4]," : "",
        c->two_sided ? ", float back_color[4]" : "");
    constant_text(&t, "KA", tints ? "times(tint, draw->ka)" : "draw->ka");
    constant_text(&t, "KD", tints ? "times(tint, draw->kd)" : "draw->kd");
    lecture_add_way(constant_made(&t, "WAY"), c, "scale(-1.0, lights[i].direction)", "subtract(lights[i].position, P)");
    lecture_add_spots(constant_made(&t, "SPOTS"), c, "double");
    constant_number(&t, "LIGHTS", c->light_count);
    constant_number(&t, "HEMISPHERES", c->hemisphere_count);
    glsl_add_sky_color(constant_made(&t, "SKY_COLOR"), c, "ka", "kd");
    text_print(constant_made(&t, "ARRIVING"), "%s%s%s%s%s%s%s", weakened ? "scale(" : "", f->has_cone ? "spot" : "",
               f->has_cone && f->has_falloff ? " * " : "", f->has_falloff ? "attenuation" : "", weakened ? ", " : "",
               sum, weakened ? ")" : "");
    constant_text(&t, "OPACITY", !translucent ? "1.0" : tints ? "draw->opacity * color[3]" : "draw->opacity");
    constant_specialize(text, text_application_c_in, &t);
}

static void add_all(struct text *text, const struct glsl_stage *f, const char *body, const struct frame *frame,
                    const int *order, const struct frame_draw_range *const *ranges, int count, struct members has)
{
    text_add(text,
             "// The application stage: the program lights each vertex before it draws. C99, to be linked with -lm.\n"
             "#include <math.h>\n\ntypedef struct {\n    double x, y, z;\n} vec3;\n");
    if (f->has_falloff || f->has_cone)
        text_add(text, "typedef struct {\n    double x, y, z, w;\n} vec4;\n");
    text_add(text, "\n");
    add_helpers(text, body);
    add_member(text, "\n// --- the scene, in eye space\n\nstatic const vec3 ambient_light = ", frame->ambient, 3);
    text_add(text, ";\n");
    if (f->has_hemispheres)
        add_hemispheres(text, frame);
    if (f->has_lights)
        add_lights(text, f, frame, order);
    add_draws(text, frame, ranges, count, has);
    text_add(text, "\n// --- its light\n\n");
    text_add(text, body);
}

char *lecture_application(const struct glsl_choices *choices, const struct frame *frame, const int *order,
                          const struct frame_draw_range *const *ranges, int count, lam_error *error)
{
    struct glsl_choices lit = *choices;
    lit.stage = LAM_STAGE_VERTEX; // the facts of the vertex stage include all facts about the lighting
    const struct glsl_stage f = glsl_stage_of(&lit);
    if (!lecture_check(&lit, &f, error))
        return NULL;
    if (f.has_environment) {
        fail(error, LAM_UNSUPPORTED,
             "'lam_shader_params.style lecture' does not support 'lam_scene_set_environment' with "
             "'lam_draw_params.stage application'; expected 'lam_draw_params.stage vertex', 'lam_draw_params.stage "
             "fragment' or 'lam_shader_params.style full'");
        return NULL;
    }
    bool origin = false;
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            origin |= frame->draws[ranges[i]->draw].mesh->origin[k] != 0;
    struct text body = {0}, text = {0};
    add_body(&body, &f, origin);
    bool ok = !body.failed && body.bytes && (!choices->mistake || mistake_apply(choices, &body.bytes, 1, error));
    if (ok) {
        struct members has = {f.needs_tangent && glsl_lobe_reads(&f, "fibre"), glsl_lobe_reads(&f, "toon_steps"),
                              lit.alpha[0] != LAM_ALPHA_OPAQUE};
        add_all(&text, &f, body.bytes, frame, order, ranges, count, has);
    }
    const lam_error *first = body.failed ? &body.error : &text.error;
    if (body.failed || text.failed || !body.bytes)
        fail(error, first->code ? first->code : LAM_MACHINE, "%s", first->code ? first->text : "out of memory");
    free(body.bytes);
    if (ok && !text.failed)
        return text.bytes;
    free(text.bytes);
    return NULL;
}
