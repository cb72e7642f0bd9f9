// canvas.c: makes the meshes for a painter on first use.
#include "reference_scene.h"
#include "contract.h"

#include <stdlib.h>
#include <string.h>

#include "fail.h"

struct type_shape type_shape(lam_check_type type)
{
    static const struct type_shape shapes[] = {
        [LAM_CHECK_TYPE_OTHER] = {"another type", 0, 0},
        [LAM_CHECK_TYPE_FLOAT] = {"float", 1, 1},
        [LAM_CHECK_TYPE_INT] = {"int", 1, 1},
        [LAM_CHECK_TYPE_BOOL] = {"bool", 1, 1},
        [LAM_CHECK_TYPE_VEC2] = {"vec2", 1, 2},
        [LAM_CHECK_TYPE_VEC3] = {"vec3", 1, 3},
        [LAM_CHECK_TYPE_VEC4] = {"vec4", 1, 4},
        [LAM_CHECK_TYPE_MAT3] = {"mat3", 3, 3},
        [LAM_CHECK_TYPE_MAT4] = {"mat4", 4, 4},
        [LAM_CHECK_TYPE_SAMPLER2D] = {"sampler2D", 1, 4},
    };
    return (size_t)type < sizeof shapes / sizeof *shapes ? shapes[type] : shapes[LAM_CHECK_TYPE_OTHER];
}

bool canvas_open(struct canvas *p, const lam_check_painter *painter, lam_check_language language, int size,
                 lam_error *error)
{
    *p = (struct canvas){.painter = *painter, .size = size};
    if (!check_reserved("lam_check_painter", painter, error))
        return false;
    if (painter->es_only)
        language = LAM_CHECK_LANGUAGE_ES;
    p->context = painter->open(painter->user, language, size, p->renderer, error);
    return p->context != NULL;
}

void canvas_close(struct canvas *p)
{
    if (p->context)
        p->painter.close(p->context);
    for (int i = 0; i < MESH_COUNT; i++) {
        if (p->meshes[i].index_count)
            reference_points_free(&p->points[i]);
        free(p->normals[i]);
        free(p->factors[i]);
    }
    *p = (struct canvas){0};
}

static bool make_mesh(struct canvas *p, enum reference_mesh mesh, lam_error *error)
{
    struct reference_points *points = &p->points[mesh];
    if (p->meshes[mesh].index_count)
        return true;
    if (!reference_points(mesh, points, error))
        return false;
    size_t count = (size_t)points->vertex_count;
    float *four = p->normals[mesh] = malloc(count * 4 * sizeof *four);
    if (!four) {
        reference_points_free(points);
        return fail_memory(error, count * 4 * sizeof *four);
    }
    for (size_t i = 0; i < count; i++) {
        memcpy(four + 4 * i, points->normals + 3 * i, 3 * sizeof *four);
        four[4 * i + 3] = 0;
    }
    p->meshes[mesh] = (lam_check_mesh){.number = (int)mesh,
                                       .vertex_count = points->vertex_count,
                                       .index_count = points->count,
                                       .positions = points->positions,
                                       .normals = four,
                                       .tangents = points->tangents,
                                       .indices = points->indices};
    return true;
}

const struct map_inputs no_map_inputs = {{-1, -1}, -1, -1, {-1, -1}};

static bool make_factors(struct canvas *p, enum reference_mesh mesh, lam_error *error)
{
    size_t count = (size_t)p->points[mesh].vertex_count;
    struct reference_matrices none = {0};
    struct reference_scene empty = {0};
    struct uniform_value value = uniform_semantic_value(SEMANTIC_FACTOR, 0, LAM_FRAME_WORLD, &empty, &none);
    if (p->factors[mesh])
        return true;
    float *all = p->factors[mesh] = malloc(count * 4 * sizeof *all);
    for (size_t i = 0; all && i < count; i++)
        memcpy(all + 4 * i, value.v, 4 * sizeof *all);
    return all || fail_memory(error, count * 4 * sizeof *all);
}

bool canvas_draw(struct canvas *p, enum reference_mesh mesh, const lam_check_drawing *drawing,
                 const struct map_inputs *inputs, float *pixels, lam_error *error)
{
    if (!make_mesh(p, mesh, error) || (inputs->factors[0] >= 0 && !make_factors(p, mesh, error)))
        return false;
    const struct reference_points *points = &p->points[mesh];
    const lam_check_stream all[] = {
        {.input = inputs->texture_coordinates[0], .components = 2, .numbers = points->texture_coordinates},
        {.input = inputs->texture_coordinates[1], .components = 2, .numbers = points->texture_coordinates},
        {.input = inputs->tangent, .components = 4, .numbers = points->surface_tangents},
        {.input = inputs->bitangent, .components = 3, .numbers = points->bitangents},
        {.input = inputs->factors[0], .components = 4, .numbers = p->factors[mesh]},
        {.input = inputs->factors[1], .components = 4, .numbers = p->factors[mesh]}};
    enum { STREAMS = sizeof all / sizeof *all };
    lam_check_stream streams[STREAMS];
    lam_check_drawing whole = *drawing;
    whole.mesh = &p->meshes[mesh];
    whole.streams = streams;
    for (size_t i = 0; i < STREAMS; i++)
        if (all[i].input >= 0)
            streams[whole.stream_count++] = all[i];
    return p->painter.draw(p->context, &whole, pixels, error);
}

int canvas_input(const lam_check_program *program, const char *name, bool attribute)
{
    for (int i = 0; i < program->input_count; i++)
        if (program->inputs[i].attribute == attribute && strcmp(program->inputs[i].name, name) == 0)
            return i;
    return -1;
}
