// fault_shader.c: a program that computes the lighting with faults switched on or off (fault_light.glsl,
// fault_physical.glsl).
#include "fault_shader.h"
#include "contract.h"
#include "reference_scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fail.h"
#include "linear.h"
#include "fault_texts.inc"

enum switch_group { GROUP_VECTORS, GROUP_OUTPUT, GROUP_TERMS, GROUP_COUNT };

// The constants that select a variant of the program. They are part of the source, so that the program computes only
// the terms that a picture needs. With uniforms instead, a software driver would compute both sides of every branch.
struct specialization {
    bool in_vertex, physical, phong, products, ambient_by_light, flat, two_sided;
    int masking, diffuse_share, tone, encoding;
    int maps; // bits of the maps (map_bit)
    bool encoded_maps, tints_ambient;
    int lamps;
    bool spots;               // a light may have a cone
    bool groups[GROUP_COUNT]; // whether switches of these groups may be on
};

struct program {
    struct specialization made_for;
    lam_check_program *built; // allocated with malloc
};
enum { MAX_PROGRAMS = 32 };

enum { MAX_VALUES = 64, MAX_FLOATS = 512 };

struct fault_shader {
    struct canvas canvas;
    struct program programs[MAX_PROGRAMS]; // most recently used first
    int program_count;
    const lam_check_program *program; // the current program
    int size, stride;
    bool rests; // the program's context is not current
    // The uniform values of the current picture.
    lam_check_value values[MAX_VALUES];
    int value_count;
    float numbers[MAX_FLOATS];
    int number_count;
    bool full; // set if `values` or `numbers` is full
};

static const char *const bit_names[FAULT_BIT_COUNT] = {"NONE",
#define BIT_NAME(name) #name,
                                                       FAULT_BITS(BIT_NAME)
#undef BIT_NAME
};

static enum switch_group group_of(int bit)
{
    return bit <= BIT_MEAN_DISTANCE ? GROUP_VECTORS : bit <= BIT_USE_ACES ? GROUP_OUTPUT : GROUP_TERMS;
}

// Returns whether a switch can be on in a program. Shaders with an exponent and shaders with metalness and roughness
// have different switches.
static bool is_possible(const struct specialization *made_for, int bit)
{
    if (!made_for->groups[group_of(bit)])
        return false;
    for (int m = 0; m < fault_count; m++)
        for (int k = 0; k < MAX_FAULT_BITS && faults[m].bits[k] != BIT_NONE; k++)
            if (faults[m].bits[k] == bit && (made_for->maps || !(faults[m].maps & ~(unsigned)MAPS_ABSENT)) &&
                !(faults[m].where & (made_for->physical ? WHERE_CLASSIC : WHERE_PHYSICAL)))
                return true;
    return false;
}

static size_t write_constants(const struct specialization *s, bool es, char *out, size_t capacity)
{
    const struct {
        const char *name;
        bool value;
    } flags[] = {{"physical", s->physical},
                 {"phong_lobe", s->phong},
                 {"products", s->products},
                 {"ambient_by_light", s->ambient_by_light},
                 {"flat_shading", s->flat},
                 {"two_sided", s->two_sided},
                 {"encoded_maps", s->encoded_maps},
                 {"tints_ambient", s->tints_ambient},
                 {"spots", s->spots}};
    const struct {
        const char *name;
        int value;
    } numbers[] = {{"masking", s->masking}, {"diffuse_share", s->diffuse_share},
                   {"tone", s->tone},       {"encoding", s->encoding},
                   {"maps", s->maps},       {"lamp_count", s->lamps}};
    size_t at =
        (size_t)snprintf(out, capacity, "#version %s\n%s#define FAULT_BITS %d\n#define LAMPS %d\n",
                         es ? "300 es\nprecision highp float;\nprecision highp int;" : "330 core",
                         s->in_vertex ? "#define IN_VERTEX\n" : "", FAULT_BIT_COUNT, s->lamps > 0 ? s->lamps : 1);
    for (int i = 0; i < FAULT_BIT_COUNT; i++)
        at += (size_t)snprintf(out + at, capacity - at, "#define %s %d\n", bit_names[i], is_possible(s, i) ? i : -1);
    for (size_t i = 0; i < sizeof flags / sizeof *flags; i++)
        at += (size_t)snprintf(out + at, capacity - at, "const bool %s = %s;\n", flags[i].name,
                               flags[i].value ? "true" : "false");
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        at += (size_t)snprintf(out + at, capacity - at, "const int %s = %d;\n", numbers[i].name, numbers[i].value);
    return at;
}

// Returns the source of a stage, allocated with malloc.
static char *write_text(const struct specialization *made_for, bool es, bool fragment, lam_error *error)
{
    const char *body = fragment ? text_fault_fragment_glsl : text_fault_vertex_glsl;
    size_t capacity = strlen(text_fault_maps_glsl) + strlen(text_fault_physical_glsl) + strlen(text_fault_light_glsl) +
                      strlen(body) + 40 * FAULT_BIT_COUNT + 800;
    char *text = malloc(capacity);
    if (!text)
        return fail_memory(error, capacity), NULL;
    size_t at = write_constants(made_for, es, text, capacity);
    snprintf(text + at, capacity - at, "%s%s%s%s%s%s", made_for->maps ? "#define MAPS\n" : "",
             fragment ? "#define FRAGMENT\n" : "", text_fault_maps_glsl, text_fault_physical_glsl,
             text_fault_light_glsl, body);
    return text;
}

struct fault_shader *fault_shader_open(const lam_check_painter *painter, int size, int stride, lam_error *error)
{
    struct fault_shader *m = calloc(1, sizeof *m);
    if (!m)
        return fail_memory(error, sizeof *m), NULL;
    m->size = size;
    m->stride = stride;
    if (!canvas_open(&m->canvas, painter, LAM_CHECK_LANGUAGE_CORE, fault_shader_size(size, stride), error)) {
        free(m);
        return NULL;
    }
    return m;
}

static bool is_same(const struct specialization *a, const struct specialization *b)
{
    return a->in_vertex == b->in_vertex && a->physical == b->physical && a->phong == b->phong &&
           a->products == b->products && a->ambient_by_light == b->ambient_by_light && a->flat == b->flat &&
           a->two_sided == b->two_sided && a->masking == b->masking && a->diffuse_share == b->diffuse_share &&
           a->tone == b->tone && a->encoding == b->encoding && a->maps == b->maps &&
           a->encoded_maps == b->encoded_maps && a->tints_ambient == b->tints_ambient && a->lamps == b->lamps &&
           a->spots == b->spots && memcmp(a->groups, b->groups, sizeof a->groups) == 0;
}

static void forget(struct fault_shader *m, lam_check_program *program)
{
    if (program)
        m->canvas.painter.forget(m->canvas.context, program);
    free(program);
}

static lam_check_program *make_program(struct fault_shader *m, const struct specialization *made_for, lam_error *error)
{
    bool es = m->canvas.painter.es_only;
    char *vertex = write_text(made_for, es, false, error),
         *fragment = vertex ? write_text(made_for, es, true, error) : NULL;
    lam_check_program *program = fragment ? calloc(1, sizeof *program) : NULL;
    if (fragment && !program)
        fail_memory(error, sizeof *program);
    bool ok = program && m->canvas.painter.compile(m->canvas.context, vertex, fragment, program, error);
    if (ok && !program->program)
        ok = fail(error, LAM_UNSUPPORTED, "%s does not build the check's own shaders: %.300s", m->canvas.renderer,
                  program->refused_vertex     ? program->vertex_log
                  : program->refused_fragment ? program->fragment_log
                                              : program->link_log);
    free(vertex);
    free(fragment);
    if (ok)
        return program;
    free(program);
    return NULL;
}

// Selects the program for these constants, and builds it if necessary. If there are more than MAX_PROGRAMS, the least
// recently used program is freed.
static bool build(struct fault_shader *m, const struct specialization *made_for, lam_error *error)
{
    int at = 0;
    while (at < m->program_count && !is_same(&m->programs[at].made_for, made_for))
        at++;
    struct program found = {.made_for = *made_for};
    if (at < m->program_count) {
        found = m->programs[at];
    } else {
        found.built = make_program(m, made_for, error);
        if (!found.built)
            return false;
        if (m->program_count < MAX_PROGRAMS)
            m->program_count++;
        else
            forget(m, m->programs[--at].built);
    }
    memmove(&m->programs[1], &m->programs[0], (size_t)at * sizeof found);
    m->programs[0] = found;
    m->program = found.built;
    return true;
}

bool fault_shader_draws(const struct fault_shader *m, int size, int stride)
{
    return m->size == size && m->stride == stride;
}

void fault_shader_rest(struct fault_shader *m)
{
    m->canvas.painter.rest(m->canvas.context);
    m->rests = true;
}

bool fault_shader_wake(struct fault_shader *m, lam_error *error)
{
    bool ok = m->canvas.painter.wake(m->canvas.context, error);
    m->rests = m->rests && !ok;
    return ok;
}

void fault_shader_close(struct fault_shader *m)
{
    if (!m)
        return;
    lam_error unused;
    if (m->rests)
        fault_shader_wake(m, &unused); // the context is closed even if it cannot be made current
    for (int i = 0; i < m->program_count; i++)
        forget(m, m->programs[i].built);
    canvas_close(&m->canvas);
    free(m);
}

// Sets the elements of a uniform, but only the elements that the program reads. Each element consists of `each` floats.
static void set(struct fault_shader *m, const char *name, int count, int each, const float *numbers)
{
    int input = canvas_input(m->program, name, false);
    if (input < 0)
        return;
    if (count > m->program->inputs[input].elements) // a compiler may shorten an array
        count = m->program->inputs[input].elements;
    m->full = m->full || m->value_count == MAX_VALUES || m->number_count + count * each > MAX_FLOATS;
    if (m->full)
        return;
    float *own = m->numbers + m->number_count;
    memcpy(own, numbers, (size_t)(count * each) * sizeof *own);
    m->number_count += count * each;
    m->values[m->value_count++] = (lam_check_value){.input = input, .count = count, .numbers = own};
}

static void set_number(struct fault_shader *m, const char *name, float x) { set(m, name, 1, 1, &x); }

static void set_lamp_member(struct fault_shader *m, int i, const char *member, int each, const float *numbers)
{
    char name[64];
    snprintf(name, sizeof name, "lamps[%d].%s", i, member);
    set(m, name, 1, each, numbers);
}

static void set_lamp(struct fault_shader *m, int i, const struct shader_interface *interface, lam_light_frame frame,
                     const struct reference_scene *reference_scene, const struct reference_matrices *matrices)
{
    const struct reference_light *light = &reference_scene->lights[i];
    lam_light_frame space = interface->space;
    // A direction has unit length, but a position whose w is 0 does not.
    bool unit = light->type == LAM_LIGHT_DIRECTIONAL && !shader_interface_uses(interface, SEMANTIC_LIGHT_POSITION) &&
                !shader_interface_uses(interface, SEMANTIC_LIGHT_X);
    enum uniform_semantic position = unit ? SEMANTIC_LIGHT_DIRECTION : SEMANTIC_LIGHT_POSITION;
    const struct {
        const char *member;
        enum uniform_semantic semantic;
        lam_light_frame frame;
    } members[] = {{"position", position, space},
                   {"given", position, frame},
                   {"axis", SEMANTIC_LIGHT_TRAVEL, space},
                   {"cone", SEMANTIC_CONE, frame}};
    for (int k = 0; k < 4; k++) {
        struct uniform_value value =
            uniform_semantic_value(members[k].semantic, i, members[k].frame, reference_scene, matrices);
        set_lamp_member(m, i, members[k].member, 4, value.v);
    }
    lam_rgb a = reference_scene->ambient;
    float ka = reference_scene->ka;
    set_lamp_member(m, i, "attenuation", 3, light->attenuation);
    set_lamp_member(m, i, "diffuse", 3, (float[]){light->color.r, light->color.g, light->color.b});
    set_lamp_member(m, i, "specular", 3, (float[]){light->specular.r, light->specular.g, light->specular.b});
    set_lamp_member(m, i, "ambient", 3,
                    (float[]){a.r * ka * light->ambient.r, a.g * ka * light->ambient.g, a.b * ka * light->ambient.b});
}

static void set_color(struct fault_shader *m, const char *name, lam_rgb c, float k)
{
    set(m, name, 1, 3, (float[]){c.r * k, c.g * k, c.b * k});
}

// Sets the factors of a colour, and the texel of its map.
static void set_map(struct fault_shader *m, const char *factor, const char *texel, enum map_number number, lam_rgb c,
                    enum uniform_semantic map, const struct reference_scene *s)
{
    set(m, factor, 1, 3, (float[]){map_factor(s, number, c.r), map_factor(s, number, c.g), map_factor(s, number, c.b)});
    set(m, texel, 1, 3, map_texel(map, s).v);
}

static void set_maps(struct fault_shader *m, const struct reference_scene *s)
{
    if (!s->maps)
        return;
    set_map(m, "base_factor", "base_texel", NUMBER_BASE_COLOR, s->diffuse, SEMANTIC_BASE_COLOR_MAP, s);
    set_map(m, "emission_factor", "emission_texel", NUMBER_EMISSION, s->emission, SEMANTIC_EMISSION_MAP, s);
    set(m, "normal_texel", 1, 3, map_texel(SEMANTIC_NORMAL_MAP, s).v);
    set(m, "metallic_roughness_texel", 1, 4, map_texel(SEMANTIC_METALLIC_ROUGHNESS_MAP, s).v);
    set_number(m, "metallic_factor", map_factor(s, NUMBER_METALLIC, s->metallic));
    set_number(m, "roughness_factor", map_factor(s, NUMBER_ROUGHNESS, s->roughness));
    set_number(m, "occlusion", s->occlusion);
}

// Returns the specialization for a scene and a set of faults. bits[b] receives 1 if the set contains fault b, else 0.
static struct specialization specialization_of(const struct reference_scene *reference_scene,
                                               const struct fault_model *model, const fault_set *set_of_faults,
                                               float bits[FAULT_BIT_COUNT])
{
    const struct shader_interface *interface = model->interface;
    bool smooth = fault_set_has(set_of_faults, BIT_SMOOTH_FOR_FLAT);
    const struct physical_convention *physical = &interface->contract->physical;
    struct specialization made_for = {.in_vertex = interface->vertex_lit || (reference_scene->flat && !smooth),
                                      .physical = interface->physical,
                                      .phong = model->reflection == LAM_REFLECTION_PHONG,
                                      .products = shader_interface_declares(interface, SEMANTIC_DIFFUSE_PRODUCT),
                                      .ambient_by_light = shader_interface_declares(interface, SEMANTIC_LIGHT_AMBIENT),
                                      .flat = reference_scene->flat,
                                      .two_sided = (interface->supports & NEED_TWO_SIDES) != 0,
                                      .masking = (int)physical->masking,
                                      .diffuse_share = (int)physical->diffuse,
                                      .tone = (int)physical->tone,
                                      .encoding = (int)physical->encoding,
                                      .maps = (int)reference_scene->maps,
                                      .encoded_maps = reference_scene->encoded_maps,
                                      .tints_ambient = reference_scene->tints_ambient,
                                      .lamps = reference_scene->light_count};
    made_for.spots = fault_set_has(set_of_faults, BIT_EVERY_LIGHT_A_SPOT);
    for (int i = 0; i < reference_scene->light_count; i++)
        made_for.spots |= reference_scene->lights[i].type == LAM_LIGHT_SPOT;
    for (int i = 0; i < FAULT_BIT_COUNT; i++) {
        bool on = fault_set_has(set_of_faults, (enum fault_bit)i);
        bits[i] = on ? 1 : 0;
        made_for.groups[group_of(i)] |= on;
    }
    return made_for;
}

// Sets the matrices, and the position and axis of the eye.
static void set_spaces(struct fault_shader *m, lam_light_frame space, const struct reference_scene *reference_scene,
                       const struct reference_matrices *matrices)
{
    const struct {
        const char *name;
        enum uniform_semantic eye, world; // the semantics for lighting in eye space and in world space
    } values[] = {{"to_lighting", SEMANTIC_MODEL_VIEW, SEMANTIC_MODEL},
                  {"to_clip", SEMANTIC_PROJECTION, SEMANTIC_VIEW_PROJECTION},
                  {"to_eye_space", SEMANTIC_NONE, SEMANTIC_VIEW},
                  {"normal_matrix4", SEMANTIC_NORMAL_MATRIX, SEMANTIC_NORMAL_MATRIX}};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        enum uniform_semantic semantic = space == LAM_FRAME_WORLD ? values[i].world : values[i].eye;
        if (space == LAM_FRAME_OBJECT && semantic == SEMANTIC_PROJECTION)
            semantic = SEMANTIC_MODEL_VIEW_PROJECTION;
        if (space == LAM_FRAME_OBJECT && semantic == SEMANTIC_MODEL_VIEW) {
            const lam_mat4 identity = lam_mat4_identity();
            set(m, values[i].name, 1, 16, matrix_value(&identity).v);
        } else if (semantic != SEMANTIC_NONE)
            set(m, values[i].name, 1, 16, uniform_semantic_value(semantic, 0, space, reference_scene, matrices).v);
    }
    set(m, "eye_position", 1, 4, uniform_semantic_value(SEMANTIC_EYE_POSITION, 0, space, reference_scene, matrices).v);
    // The third row of the view matrix is the eye's axis in world space.
    const lam_mat4 *view = &matrices->view;
    if (space == LAM_FRAME_WORLD)
        set(m, "eye_axis", 1, 4, (float[]){(float)view->m[2][0], (float)view->m[2][1], (float)view->m[2][2], 0});
    else
        set(m, "eye_axis", 1, 4, (float[]){0, 0, 1, 0});
}

// Sets the material. `separate`: the contract has separate strengths and colours.
static void set_material(struct fault_shader *m, bool separate, const struct reference_scene *reference_scene,
                         const fault_set *set_of_faults)
{
    set_color(m, "ka", reference_scene->ambient, reference_scene->ka);
    set_color(m, "kd", reference_scene->diffuse, reference_scene->kd);
    set_color(m, "ks", reference_scene->specular, reference_scene->ks);
    set_color(m, "bare_ka", reference_scene->ambient, 1);
    set_color(m, "bare_kd", reference_scene->diffuse, 1);
    set_color(m, "bare_ks", reference_scene->specular, 1);
    // In contracts with separate strengths and colours, the fault swaps the strengths or the colours. In other
    // contracts, the fault swaps the products.
    set_color(m, "kd_with_ks", separate ? reference_scene->diffuse : reference_scene->specular, reference_scene->ks);
    set_color(m, "ks_with_kd", separate ? reference_scene->specular : reference_scene->diffuse, reference_scene->kd);
    set_color(m, "specular_as_diffuse", reference_scene->diffuse, separate ? reference_scene->ks : reference_scene->kd);
    set_color(m, "tint", reference_scene->diffuse, separate ? 1 : reference_scene->kd);
    set_number(m, "opacity", reference_scene->alpha);
    set_number(m, "shininess", reference_scene->shininess);
    set_number(m, "exponent_factor", set_of_faults->factor);
    set_number(m, "exponent_constant", set_of_faults->constant);
    set_color(m, "base_color", reference_scene->diffuse, 1);
    set_number(m, "metallic", reference_scene->metallic);
    set_number(m, "roughness", reference_scene->roughness);
    set_maps(m, reference_scene);
}

bool fault_shader_draw(struct fault_shader *m, const struct reference_scene *reference_scene,
                       const struct fault_model *model, const fault_set *set_of_faults, float *pixels, lam_error *error)
{
    const struct shader_interface *interface = model->interface;
    lam_light_frame frame = model->light_frame;
    struct reference_matrices matrices;
    reference_matrices(reference_scene, &matrices);
    float bits[FAULT_BIT_COUNT];
    struct specialization made_for = specialization_of(reference_scene, model, set_of_faults, bits);
    if (!build(m, &made_for, error))
        return false;
    m->value_count = m->number_count = 0;
    set(m, "fault_on[0]", FAULT_BIT_COUNT, 1, bits);
    set_spaces(m, interface->space, reference_scene, &matrices);
    float small = (float)(m->stride * m->canvas.size), scale = (float)m->size / small;
    float offset = scale + (float)(m->stride - 1) / small - 1;
    set(m, "window", 1, 4, (float[]){scale, scale, offset, offset});
    for (int i = 0; i < reference_scene->light_count; i++)
        set_lamp(m, i, interface, frame, reference_scene, &matrices);
    set(m, "ambient_light", 1, 3,
        uniform_semantic_value(SEMANTIC_AMBIENT_LIGHT, 0, frame, reference_scene, &matrices).v);
    set_number(m, "light_capacity", (float)shader_interface_light_count(interface));
    set_material(m, interface->contract->material_strengths, reference_scene, set_of_faults);
    // The inside of a closed mesh is not visible. In an upside-down picture, front faces are reversed.
    bool closed = reference_scene->mesh == MESH_SPHERE || reference_scene->mesh == MESH_COARSE;
    if (m->full)
        return fail(error, LAM_LIMIT, "check: more than %d values for its own shader", MAX_VALUES);
    bool upside_down = fault_set_has(set_of_faults, BIT_UPSIDE_DOWN);
    lam_check_drawing drawing = {.program = m->program,
                                 .position = canvas_input(m->program, "position", true),
                                 .normal = canvas_input(m->program, "normal", true),
                                 .tangent = -1,
                                 .values = m->values,
                                 .value_count = m->value_count,
                                 .cull = !closed       ? LAM_CHECK_CULL_NONE
                                         : upside_down ? LAM_CHECK_CULL_FRONT
                                                       : LAM_CHECK_CULL_BACK};
    const struct map_inputs inputs = {{canvas_input(m->program, "texture_coordinate", true), -1},
                                      canvas_input(m->program, "tangent", true),
                                      -1,
                                      {-1, -1}};
    return canvas_draw(&m->canvas, reference_scene->mesh, &drawing, &inputs, pixels, error);
}
