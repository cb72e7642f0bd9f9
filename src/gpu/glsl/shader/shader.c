// shader.c: implements lam_shader_make, which generates a scene's shaders and the value of every uniform.
#include <lambent/shader.h>

#include "arena.h"
#include "fail.h"
#include "float_state.h"
#include "glsl_declarations.h"
#include "lecture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *lam_glsl_name(lam_glsl version)
{
    static const char *const names[LAM_GLSL_COUNT] = {"330", "120", "300es"};
    return (unsigned)version < LAM_GLSL_COUNT ? names[version] : NULL;
}

// The public shader and its memory.
struct shader {
    lam_shader result; // must come first, because lam_shader_free casts its pointer to the struct
    struct arena arena;
    struct glsl_text text;
    char *application;
};

struct build {
    struct shader *shader;
    const lam_scene *scene;
    struct frame frame;
    struct glsl_choices choices;
    struct glsl_stage stage;
    struct glsl_row rows[GLSL_ROWS_MAX];
    int row_count;
    int *order; // the shader's light i is the frame's light order[i]
    int width, height;
};

// --- choices for all ranges of a scene

// Shaders of lines and points are not exported, because the rectangles of lines and points depend on the camera.
static bool is_selected(const struct frame *frame, const struct frame_draw_range *range, int object)
{
    const struct frame_draw *draw = &frame->draws[range->draw];
    return !draw->strokes && (object < 0 || draw->object == object);
}

// Merges the maps of another material. If one of the materials lacks a map, the map's value is 1 everywhere for that
// material (glsl_map_values). Returns false if one shader cannot use the maps of both materials.
static bool merge_maps(struct glsl_choices *all, const struct glsl_choices *own)
{
    bool same = true;
    for (int side = 0; side < 2; side++) {
        uint8_t *alpha = &all->alpha[side];
        same &= all->converted[side] == own->converted[side];
        same &= (*alpha == LAM_ALPHA_BLEND) == (own->alpha[side] == LAM_ALPHA_BLEND);
        if (own->alpha[side] == LAM_ALPHA_MASK) // opaque materials have a cutoff of 0
            *alpha = LAM_ALPHA_MASK;
        for (int i = 0; i < LAM_MAP_COUNT; i++) {
            struct glsl_map *a = &all->maps[side][i], b = own->maps[side][i];
            a->texels = b.texels = (uint8_t)(side * LAM_MAP_COUNT + i); // each side has its own sampler
            same &= !a->used || !b.used || memcmp(a, &b, sizeof b) == 0;
            if (!a->used)
                *a = b;
        }
    }
    return same;
}

// Fails with the reason why no range is selected.
static bool fail_nothing_selected(const struct build *m, int object, lam_error *error)
{
    bool strokes = false;
    for (int i = 0; i < m->frame.range_count; i++) {
        const struct frame_draw *draw = &m->frame.draws[m->frame.ranges[i].draw];
        strokes |= draw->strokes && (object < 0 || draw->object == object);
    }
    if (object < 0)
        return fail(error, LAM_UNSUPPORTED,
                    strokes ? "the model contains only lines and points, which have no shader; expected a model with "
                              "triangles"
                            : "the model has no triangles that a shader could draw");
    if (strokes)
        return fail(error, LAM_UNSUPPORTED,
                    "object %d contains only lines and points, which have no shader; expected an object with triangles",
                    object);
    return fail(error, LAM_BAD_ARGUMENT, "object is %d, expected an object with triangles, 0 to %d", object,
                lam_scene_object_count(m->scene) - 1);
}

// Merges the choices of all ranges, for one pair of sources. A range may use vertex colours, back materials or the
// environment, even if other ranges do not. All ranges must have the same number of sides. Either all ranges or none
// must have tangents.
static bool merge_choices(struct build *m, lam_stage stage, int object, bool hardware_filter, lam_error *error)
{
    const struct frame *frame = &m->frame;
    int first = -1;
    bool mapped = false;
    for (int i = 0; i < frame->range_count; i++)
        mapped |= is_selected(frame, &frame->ranges[i], object) &&
                  (frame_maps(frame, frame->materials[frame->ranges[i].front]) ||
                   frame_maps(frame, frame->materials[frame->ranges[i].back]));
    for (int i = 0; i < frame->range_count; i++) {
        const struct frame_draw_range *range = &frame->ranges[i];
        if (!is_selected(frame, range, object))
            continue;
        struct glsl_choices own;
        glsl_choose(&own, frame, range, stage);
        if (hardware_filter)
            glsl_use_hardware_filter(&own);
        for (int side = 0; side < 2 && mapped && !range->translucent; side++)
            if (own.alpha[side] == LAM_ALPHA_BLEND) // all opacities of this range are 1, so it is opaque
                own.alpha[side] = LAM_ALPHA_OPAQUE;
        if (first < 0) {
            m->choices = own;
            first = i;
            continue;
        }
        const int a = frame->draws[frame->ranges[first].draw].object, b = frame->draws[range->draw].object;
        if (own.two_sided != m->choices.two_sided)
            return fail(error, LAM_BAD_ARGUMENT,
                        "objects %d and %d: one is one-sided, the other is not, and one shader cannot draw both; "
                        "expected the number of one object",
                        a, b);
        struct glsl_stage own_stage = glsl_stage_of(&own);
        if (own_stage.needs_tangent && own.tangents != m->choices.tangents)
            return fail(error, LAM_BAD_ARGUMENT,
                        "objects %d and %d: one has tangents, the other has none, and one shader cannot draw both; "
                        "expected the number of one object",
                        a, b);
        if (!merge_maps(&m->choices, &own))
            return fail(
                error, LAM_BAD_ARGUMENT,
                "objects %d and %d: their materials blend, wrap, filter or convert differently, and one shader cannot "
                "draw both; expected the number of one object",
                a, b);
        m->choices.colors |= own.colors;
        m->choices.back_material |= own.back_material;
        if (own.environment)
            m->choices.environment = own.environment;
        m->choices.environment_light |= own.environment_light;
        m->choices.layers |= own.layers;
    }
    return first >= 0 || fail_nothing_selected(m, object, error);
}

static bool choose(struct build *m, const lam_draw_params *draw, int object, const lam_shader_params *params,
                   lam_error *error)
{
    static const enum glsl_version versions[] = {GLSL_330, GLSL_120, GLSL_300_ES};
    static const enum glsl_storage storages[] = {GLSL_BLOCK, GLSL_ARRAY, GLSL_BLOCK, GLSL_TEXTURE};
    if ((unsigned)params->glsl >= LAM_GLSL_COUNT || (unsigned)params->lights >= LAM_SHADER_LIGHTS_COUNT)
        return fail(error, LAM_BAD_ARGUMENT, "shader parameters: glsl or lights is out of range");
    if ((unsigned)params->style >= LAM_SHADER_STYLE_COUNT)
        return fail(error, LAM_BAD_ARGUMENT, "shader parameters: style is out of range");
    if (params->mistake && params->style != LAM_SHADER_STYLE_LECTURE)
        return fail(error, LAM_BAD_ARGUMENT, "mistake '%.60s' requires the lecture style", params->mistake);
    if (params->mistake && !mistake_find(params->mistake))
        return fail(error, LAM_BAD_ARGUMENT, "mistake '%.60s' is not known; expected one of lam_shader_mistake_row",
                    params->mistake);
    if (!merge_choices(m, draw->stage, object, params->hardware_filter, error))
        return false;
    struct glsl_choices *c = &m->choices;
    c->version = versions[params->glsl];
    c->style = params->style == LAM_SHADER_STYLE_LECTURE ? &lecture_style : NULL;
    c->mistake = mistake_find(params->mistake);
    bool array = c->version == GLSL_120 || c->style;
    c->storage = !params->lights && array ? GLSL_ARRAY : storages[params->lights];
    c->encoding = m->frame.settings.color == LAM_COLOR_RAW ? GLSL_STRAIGHT : GLSL_ENCODED;
    c->exposes = m->frame.exposure != 1;
    if (c->encoding == GLSL_ENCODED)
        c->tone = m->frame.settings.tone;
    c->products = params->products;
    c->widens = draw->specular_aa == LAM_SPECULAR_AA_ON && frame_is_physical(c->reflection);
    if (c->widens && c->version == GLSL_120)
        return fail(error, LAM_UNSUPPORTED,
                    "GLSL 120 cannot ask for the size of a texture, which specular antialiasing needs; expected 330 or "
                    "300es, or specular antialiasing off");
    c->passed = m->frame.settings.shadows && c->light_count && c->reflection != LAM_REFLECTION_NONE;
    if (c->environment)
        c->environment = GLSL_CUBE;
    m->stage = glsl_stage_of(c);
    m->row_count = glsl_declarations(&m->stage, m->rows);
    return true;
}

// --- values

// Writes the matrix from mesh positions to clip space in column-major order. The frame's rows are in pixels, with y
// downwards.
static int put_projection(float out[16], const struct frame_draw *draw, int width, int height)
{
    for (int j = 0; j < 4; j++) {
        double w = (double)draw->pixel[3][j];
        out[4 * j] = (float)(2 * (double)draw->pixel[0][j] / width - w);
        out[4 * j + 1] = (float)(w - 2 * (double)draw->pixel[1][j] / height);
        out[4 * j + 2] = draw->pixel[2][j];
        out[4 * j + 3] = draw->pixel[3][j];
    }
    return 16;
}

static int value_of(const struct build *m, const struct frame_draw_range *range, const struct glsl_row *row,
                    const struct glsl_row *member, int index, float out[16])
{
    const struct glsl_uniform_source from = {&m->frame, range, m->order};
    if (row->semantic == GLSL_MODEL_VIEW_PROJECTION)
        return put_projection(out, &m->frame.draws[range->draw], m->width, m->height);
    return glsl_uniform_value(&m->choices, &from, row, member, index, out);
}

// --- the public arrays

static bool is_per_draw(enum glsl_semantic semantic)
{
    return semantic == GLSL_MODEL_VIEW_PROJECTION || semantic == GLSL_MODEL_VIEW || semantic == GLSL_NORMAL_MATRIX ||
           semantic == GLSL_OBJECT || semantic == GLSL_FIRST_PRODUCT || semantic == GLSL_MATERIAL ||
           semantic >= GLSL_MAP || (semantic >= GLSL_HEAD && semantic <= GLSL_GROUND_PRODUCT);
}

static char *name_of(struct arena *arena, const struct glsl_row *row, const struct glsl_row *member, int index)
{
    char name[96], index_text[24] = "";
    if (row->count)
        snprintf(index_text, sizeof index_text, "[%d]", index);
    snprintf(name, sizeof name, "%s%s%s%s", row->name, index_text, member ? "." : "", member ? member->name : "");
    return arena_string(arena, name);
}

// Returns the offset of the next value in its std140 block (OpenGL 4.6, 7.6.2.2), and updates the end of the block.
static int block_offset(int *end, const char *type)
{
    bool single = strcmp(type, "float") == 0;
    int at = single ? *end : (*end + 15) & ~15;
    *end = at + (single ? 4 : 16);
    return at;
}

struct uniform_list {
    lam_shader_uniform *out;
    int count;
    int end; // the end of the block's values so far
    const char *block;
    bool failed;
};

static void add_uniform(const struct build *m, struct uniform_list *t, const struct frame_draw_range *range,
                        const struct glsl_row *row, const struct glsl_row *member, int index)
{
    lam_shader_uniform *u = &t->out[t->count++];
    *u = (lam_shader_uniform){.type = member ? member->type : row->type,
                              .block = row->block,
                              .meaning = member ? member->meaning : row->meaning};
    if (row->block)
        u->offset = block_offset(&t->end, u->type);
    u->count = value_of(m, range, row, member, index, u->value);
    if (row->semantic == GLSL_MAP && range)
        u->map = m->frame.materials[row->back ? range->back : range->front]->maps[row->map];
    u->name = name_of(&m->shader->arena, row, member, index);
    t->failed |= !u->name;
}

// Lists the uniforms of a draw or, with NULL, of the frame. In a block, array elements begin at multiples of 16 bytes.
static bool list_uniforms(const struct build *m, const struct frame_draw_range *range, const lam_shader_uniform **out,
                          int *count)
{
    struct glsl_row members[GLSL_ROWS_MAX];
    size_t capacity = 0;
    for (int i = 0; i < m->row_count; i++) {
        int fields = glsl_members(&m->stage, m->rows[i].type, members);
        capacity += (size_t)(m->rows[i].count ? m->rows[i].count : 1) * (size_t)(fields ? fields : 1);
    }
    struct uniform_list t = {.out = arena_array(&m->shader->arena, capacity, sizeof *t.out)};
    if (!t.out)
        return false;
    for (int i = 0; i < m->row_count; i++) {
        const struct glsl_row *row = &m->rows[i];
        if (is_per_draw(row->semantic) != (range != NULL))
            continue;
        if (!row->block || !t.block || strcmp(row->block, t.block) != 0)
            t.end = 0;
        t.block = row->block;
        int fields = glsl_members(&m->stage, row->type, members);
        for (int k = 0; k < (row->count ? row->count : 1); k++) {
            if (fields || row->count)
                t.end = (t.end + 15) & ~15;
            for (int f = 0; f < (fields ? fields : 1); f++)
                add_uniform(m, &t, range, row, fields ? &members[f] : NULL, k);
        }
        if (fields)
            t.end = (t.end + 15) & ~15;
    }
    *out = t.out;
    *count = t.count;
    return !t.failed;
}

static bool list_draws(const struct build *m, int object)
{
    const struct frame *frame = &m->frame;
    lam_shader *result = &m->shader->result;
    lam_shader_draw *draws = arena_array(&m->shader->arena, (size_t)frame->range_count, sizeof *draws);
    if (!draws)
        return false;
    for (int i = 0; i < frame->range_count; i++) {
        const struct frame_draw_range *s = &frame->ranges[i];
        if (!is_selected(frame, s, object))
            continue;
        const struct frame_draw *draw = &frame->draws[s->draw];
        lam_shader_draw *out = &draws[result->draw_count++];
        *out = (lam_shader_draw){.object = draw->object,
                                 .object_name = lam_scene_object(m->scene, draw->object)->name,
                                 .first_triangle = s->first_id - draw->first_id,
                                 .triangle_count = s->count,
                                 .material_name = frame->materials[s->front]->name,
                                 .clockwise = draw->mirrored,
                                 .cull = draw->cull,
                                 .translucent = s->translucent,
                                 .has_colors = draw->mesh->colors != NULL,
                                 .has_tangents = draw->mesh->tangents != NULL};
        memcpy(out->origin, draw->mesh->origin, sizeof out->origin);
        if (!list_uniforms(m, s, &out->uniforms, &out->uniform_count))
            return false;
    }
    result->draws = draws;
    return true;
}

static bool list_attributes(const struct build *m)
{
    struct glsl_attribute rows[GLSL_ATTRIBUTES_MAX];
    int count = glsl_attributes(&m->stage, rows);
    lam_shader *result = &m->shader->result;
    lam_shader_attribute *out = arena_array(&m->shader->arena, (size_t)count, sizeof *out);
    for (int i = 0; out && i < count; i++)
        out[i] = (lam_shader_attribute){
            .name = rows[i].name, .type = rows[i].type, .location = rows[i].location, .meaning = rows[i].meaning};
    result->attributes = out;
    result->attribute_count = count;
    return out != NULL;
}

static bool list_textures(const struct build *m)
{
    const struct glsl_choices *c = &m->choices;
    lam_shader *result = &m->shader->result;
    lam_shader_texture *lists = arena_array(&m->shader->arena, 2, sizeof *lists);
    if (!lists)
        return false;
    result->textures = lists;
    if (c->storage != GLSL_TEXTURE || (!m->stage.has_lights && !m->stage.has_hemispheres))
        return true;
    size_t bytes = glsl_lights_bytes(c), each = glsl_products_bytes(c), materials = (size_t)m->frame.material_count;
    float *values = arena_alloc(&m->shader->arena, bytes);
    if (!values)
        return false;
    glsl_pack_lights(c, &m->frame, values);
    lists[result->texture_count++] =
        (lam_shader_texture){.name = "light_list", .texels = (int)(bytes / 16), .values = values};
    if (!c->products)
        return true;
    values = arena_array(&m->shader->arena, materials, each);
    if (!values || materials * each / 16 > (size_t)INT32_MAX)
        return false;
    for (size_t i = 0; i < materials; i++)
        glsl_pack_products(c, &m->frame, m->frame.materials[i], values + i * (each / sizeof *values));
    lists[result->texture_count++] =
        (lam_shader_texture){.name = "product_list", .texels = (int)(materials * each / 16), .values = values};
    return true;
}

static bool order_lights(struct build *m)
{
    const struct frame *frame = &m->frame;
    m->order = arena_array(&m->shader->arena, (size_t)frame->light_count + 1, sizeof *m->order);
    struct glsl_light_cursor cursor = {0, 0};
    for (int i = 0; m->order && i < m->choices.light_count; i++)
        m->order[i] = glsl_next_light(&m->choices, frame, &cursor);
    return m->order != NULL;
}

// Makes the C function of the application stage in the lecture style.
static bool make_application(struct build *m, int object, lam_error *error)
{
    const struct frame_draw_range **ranges =
        arena_array(&m->shader->arena, (size_t)m->frame.range_count, sizeof(*ranges));
    int count = 0;
    for (int i = 0; ranges && i < m->frame.range_count; i++)
        if (is_selected(&m->frame, &m->frame.ranges[i], object))
            ranges[count++] = &m->frame.ranges[i];
    if (!ranges)
        return fail(error, LAM_MACHINE, "out of memory");
    m->shader->application = lecture_application(&m->choices, &m->frame, m->order, ranges, count, error);
    return m->shader->application != NULL;
}

static bool make(struct build *m, const lam_camera *camera, const lam_draw_params *draw, int object,
                 const lam_shader_params *params, lam_error *error)
{
    struct call_control call;
    call_start(&call, NULL);
    lam_draw_params without = draw ? *draw : (lam_draw_params){0};
    without.shadows |=
        without.ground != LAM_GROUND_NONE; // a ground plane implies shadows, but is not part of the scene
    without.ground = LAM_GROUND_NONE;
    without.brighten = LAM_BRIGHTEN_OFF;
    if (!without.tone && params && params->style == LAM_SHADER_STYLE_LECTURE)
        without.tone = LAM_TONE_NONE; // lecture shaders have no tone curve
    if (!frame_build(&m->frame, m->scene, camera, &without, m->width, m->height, &call, error) ||
        !choose(m, draw, object, params, error))
        return false;
    if (!order_lights(m))
        return fail(error, LAM_MACHINE, "out of memory");
    struct glsl_choices shaders = m->choices;
    if (m->choices.style && m->stage.application) {
        if (!make_application(m, object, error))
            return false;
        shaders.mistake = 0; // the mistake is in the C function, which computes the light
    }
    if (!glsl_make(&shaders, &m->shader->text, error))
        return false;
    static const lam_shader_lights storages[] = {[GLSL_ARRAY] = LAM_SHADER_LIGHTS_ARRAY,
                                                 [GLSL_BLOCK] = LAM_SHADER_LIGHTS_BLOCK,
                                                 [GLSL_TEXTURE] = LAM_SHADER_LIGHTS_TEXTURE};
    lam_shader *result = &m->shader->result;
    *result = (lam_shader){.glsl = params->glsl,
                           .lights = storages[m->choices.storage],
                           .products = m->choices.products,
                           .vertex = m->shader->text.vertex,
                           .fragment = m->shader->text.fragment,
                           .application = m->shader->application,
                           .flat = m->stage.shading == LAM_SHADING_FLAT};
    if (!list_attributes(m) || !list_uniforms(m, NULL, &result->uniforms, &result->uniform_count) ||
        !list_draws(m, object) || !list_textures(m))
        return fail(error, LAM_MACHINE, "out of memory for the values of the uniforms");
    return true;
}

lam_shader *lam_shader_make(const lam_scene *scene, const lam_camera *camera, const lam_draw_params *draw, int width,
                            int height, int object, const lam_shader_params *params, lam_error *error)
{
    static const lam_draw_params plain_draw = {0};
    static const lam_shader_params plain = {0};
    draw = draw ? draw : &plain_draw;
    if (params && !check_reserved("lam_shader_params", params, error))
        return NULL;
    if (!scene || !camera)
        return fail(error, LAM_BAD_ARGUMENT, "lam_shader_make: %s is NULL", scene ? "camera" : "scene"), NULL;
    if (width < 1 || height < 1 || width > 65535 || height > 65535) {
        fail(error, LAM_BAD_ARGUMENT, "lam_shader_make: %d×%d pixels, expected 1 to 65535 each way", width, height);
        return NULL;
    }
    if (!lam_output_is_light(draw->output)) {
        fail(error, LAM_UNSUPPORTED, "shader: the output is %s, expected the picture, one of its terms or a light",
             lam_output_name(draw->output) ? lam_output_name(draw->output) : "out of range");
        return NULL;
    }
    struct shader *shader = calloc(1, sizeof *shader);
    struct build *build = calloc(1, sizeof *build);
    if (!shader || !build) {
        fail(error, LAM_MACHINE, "out of memory");
        free(shader);
        free(build);
        return NULL;
    }
    arena_start(&shader->arena, NULL);
    *build = (struct build){.shader = shader, .scene = scene, .width = width, .height = height};
    uint64_t state = float_state_enter();
    bool ok = make(build, camera, draw, object, params ? params : &plain, error);
    float_state_leave(state);
    frame_free(&build->frame);
    free(build);
    if (ok)
        return &shader->result;
    lam_shader_free(&shader->result);
    return NULL;
}

void lam_shader_free(lam_shader *shader)
{
    if (!shader)
        return;
    struct shader *owner = (struct shader *)shader;
    glsl_free(&owner->text);
    free(owner->application);
    arena_free(&owner->arena);
    free(owner);
}
