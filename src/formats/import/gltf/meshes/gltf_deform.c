// gltf_deform.c: applies morph targets (section 3.7.2.2) and skins (section 3.7.3.3) to a primitive.
#include "gltf.h"
#include "gltf_data.h"
#include "gltf_json.h"
#include "gltf_materials.h"
#include "gltf_meshes.h"
#include "linear.h"
#include "parallel_rows.h"

#include <stdio.h>
#include <string.h>

// --- morph targets

struct addition {
    struct gltf *gltf;
    const struct place *place; // the position of the target's accessor in the file
    bool positions;            // scene_repair needs sums that are not finite; otherwise, they become 0
    const float *base, *target;
    float *out; // may be `base`
    int base_width, width;
    size_t count;
    double weight;
};

static bool add_chunk(void *user, size_t index, lam_error *error)
{
    const struct addition *a = user;
    (void)error;
    size_t first, last, wide = (size_t)a->base_width, narrow = (size_t)a->width;
    parallel_rows_range(a->count, index, &first, &last);
    for (size_t i = first; i < last; i++)
        for (size_t c = 0; c < wide; c++) {
            float more = c < narrow ? (float)(a->weight * (double)a->target[narrow * i + c]) : 0.0f;
            float sum = a->base[wide * i + c] + more;
            a->out[wide * i + c] = a->positions || sum - sum == 0 ? sum : 0;
        }
    return true;
}

// A morph target that is added to a mesh.
struct morph_target {
    struct gltf *gltf;
    const struct place *place; // the position of the target in the file
    const json_t *target;
    double weight;
    size_t count; // the number of vertices
};

// Adds one attribute of a target to an array of the mesh. The first addition replaces the shared array with the mesh's
// own copy. `width` and `base_width` are the numbers of values per vertex in the target and in the mesh.
static bool add_target(const struct morph_target *t, const char *name, int width, int base_width, const float **values,
                       bool *own)
{
    struct gltf *gltf = t->gltf;
    size_t count = t->count;
    struct gltf_accessor *accessor;
    char words[64];
    const struct place *here = KEY_OF(t->place, name);
    if (!gltf_take_accessor(gltf, t->place, t->target, name, &accessor))
        return gltf_forgive(gltf);
    if (!accessor || !*values)
        return true;
    if (accessor->width != width || accessor->type[0] == 'M' || accessor->component == GLTF_U32 ||
        accessor->count != count)
        return json_fail(&gltf->json, here, "found %zu elements of %s, expected %zu of VEC%d of FLOAT", accessor->count,
                         gltf_accessor_words(accessor, words), count, width) ||
               gltf_forgive(gltf);
    gltf->morphed += count;
    if (!call_check_triangles(gltf->source->call, gltf->source->name, gltf->morphed, "vertices of morph targets",
                              gltf->json.error))
        return false;
    struct addition addition = {.gltf = gltf,
                                .place = here,
                                .positions = strcmp(name, "POSITION") == 0,
                                .base = *values,
                                .target = gltf_floats(gltf, here, accessor, GLTF_REQUIRED),
                                .out = (float *)(uintptr_t)*values,
                                .base_width = base_width,
                                .width = width,
                                .count = count,
                                .weight = t->weight};
    if (!addition.target)
        return gltf_forgive(gltf);
    if (!*own && !(addition.out = arena_array(&gltf->scene->arena, count * (size_t)base_width, sizeof(float))))
        return gltf_no_memory(gltf, count * (size_t)base_width * sizeof(float));
    *own = true;
    *values = addition.out;
    return parallel_rows_run(gltf->source, parallel_rows_count(count), add_chunk, &addition, gltf->json.error);
}

// Whether the mesh owns the array of each attribute. Only such an array may be changed in place.
struct owned {
    bool positions, normals, tangents, colors, texcoords[2];
};

// Morphs the colours, which become four floats each.
static bool morph_colors(const struct morph_target *t, lam_mesh *mesh, bool *own)
{
    struct gltf_accessor *accessor = NULL;
    const float *values = mesh->colors;
    if (!values || !gltf_take_accessor(t->gltf, t->place, t->target, "COLOR_0", &accessor))
        return !values || gltf_forgive(t->gltf);
    if (!accessor)
        return true;
    if (mesh->colors_format == LAM_COLORS_LINEAR8) {
        float *floats = arena_array(&t->gltf->scene->arena, t->count, 4 * sizeof *floats);
        if (!floats)
            return gltf_no_memory(t->gltf, t->count * 4 * sizeof *floats);
        for (size_t i = 0; i < 4 * t->count; i++)
            floats[i] = (float)((const uint8_t *)mesh->colors)[i] / 255.0f;
        values = floats;
        *own = true;
    }
    bool ok = add_target(t, "COLOR_0", accessor->width == 3 ? 3 : 4, 4, &values, own);
    mesh->colors = values;
    mesh->colors_format = LAM_COLORS_LINEAR_F32;
    return ok;
}

// Clamps morphed colours to 0…1 (section 3.7.2.2).
static void clamp_colors(lam_mesh *mesh, bool opaque)
{
    float *colors = (float *)(uintptr_t)mesh->colors;
    for (size_t i = 0; i < 4 * (size_t)mesh->color_count; i++)
        colors[i] = opaque && i % 4 == 3 ? 1.0f : colors[i] < 0.0f ? 0.0f : colors[i] > 1.0f ? 1.0f : colors[i];
}

// Morphs the mesh's sets of texture coordinates.
static bool morph_texcoords(const struct morph_target *target, lam_mesh *mesh, struct owned *own)
{
    bool ok = true;
    for (int which = 0; ok && which < 2; which++) {
        char name[32];
        int set = gltf_texcoord_set(target->gltf, mesh->parts->material, which);
        snprintf(name, sizeof name, "TEXCOORD_%d", set);
        ok = set < 0 ||
             add_target(target, name, 2, 2, which ? &mesh->second_texcoords : &mesh->texcoords, &own->texcoords[which]);
    }
    return ok;
}

static bool morph(struct gltf *gltf, const struct place *place, const json_t *primitive,
                  const struct gltf_deformation *deformation, lam_mesh *mesh, struct owned *own)
{
    bool ok = true;
    const json_t *targets = gltf_take_list(gltf, place, primitive, "targets");
    for (size_t i = 0; ok && i < json_array_size(targets) && i < deformation->weight_count; i++) {
        struct morph_target target = {.gltf = gltf,
                                      .place = ELEMENT_OF(KEY_OF(place, "targets"), i),
                                      .target = json_array_get(targets, i),
                                      .weight = deformation->weights[i],
                                      .count = mesh->vertex_count};
        ok = target.weight == 0 || (add_target(&target, "POSITION", 3, 3, &mesh->positions, &own->positions) &&
                                    add_target(&target, "NORMAL", 3, 3, &mesh->normals, &own->normals) &&
                                    add_target(&target, "TANGENT", 3, 4, &mesh->tangents, &own->tangents) &&
                                    morph_colors(&target, mesh, &own->colors) && morph_texcoords(&target, mesh, own));
    }
    if (ok && own->colors)
        clamp_colors(mesh, gltf_material_is_opaque(gltf, mesh->parts->material));
    return ok;
}

// --- skins

enum { SETS_MAX = 16 }; // each with four joints

struct skinning {
    struct gltf *gltf;
    const struct place *place; // the position of the attributes in the file
    const struct gltf_skin *skin;
    const float *joints[SETS_MAX], *weights[SETS_MAX]; // four for each vertex
    int sets;
    const lam_mesh *mesh;
    float *positions, *normals, *tangents;
};

static bool fail_joint(const struct skinning *s, int set, size_t vertex, size_t joint)
{
    char name[20];
    snprintf(name, sizeof name, "JOINTS_%d", set);
    return json_fail(&s->gltf->json, KEY_OF(s->place, name), "element %zu: found joint %zu, expected one below %zu",
                     vertex, joint, s->skin->count);
}

// Blends the matrices of the joints by weight. Weights are normalized to a sum of 1; if all are 0, the first joint gets
// the weight 1.
static bool blend(const struct skinning *s, size_t vertex, lam_mat4 *out, lam_error *error)
{
    double sum = 0;
    memset(out, 0, sizeof *out);
    size_t first = 0;
    for (int set = 0; set < s->sets; set++) {
        const float *joints = s->joints[set] + 4 * vertex, *weights = s->weights[set] + 4 * vertex;
        for (int k = 0; k < 4; k++) {
            size_t joint = (size_t)joints[k];
            double weight = weights[k] > 0 ? (double)weights[k] : 0;
            if (set == 0 && k == 0)
                first = joint;
            if (weight == 0 && !(set == 0 && k == 0))
                continue;
            if (joint >= s->skin->count)
                return error && fail_joint(s, set, vertex, joint);
            for (int i = 0; i < 12; i++)
                out->m[i / 4][i % 4] += weight * s->skin->joints[joint].m[i / 4][i % 4];
            sum += weight;
        }
    }
    for (int i = 0; i < 12; i++)
        out->m[i / 4][i % 4] = sum > 0 ? out->m[i / 4][i % 4] / sum : s->skin->joints[first].m[i / 4][i % 4];
    out->m[3][3] = 1;
    return true;
}

static lam_vec3 vector_at(const float *values, size_t i, size_t width)
{
    const float *at = values + width * i;
    return v3((double)at[0], (double)at[1], (double)at[2]);
}

// Stores a vector. Returns false and stores nothing if a number is out of range.
static bool store(float *out, lam_vec3 v)
{
    const float x = (float)v.x, y = (float)v.y, z = (float)v.z;
    if (!(x - x == 0 && y - y == 0 && z - z == 0))
        return false;
    out[0] = x;
    out[1] = y;
    out[2] = z;
    return true;
}

// Stores a direction. A direction that is out of range becomes 0, which means that there is no direction.
static void store_direction(float *out, lam_vec3 v)
{
    if (!store(out, v3_unit(v)))
        store(out, v3(0, 0, 0));
}

static bool skin_chunk(void *user, size_t index, lam_error *error)
{
    const struct skinning *s = user;
    size_t first, last;
    parallel_rows_range(s->mesh->vertex_count, index, &first, &last);
    for (size_t i = first; i < last; i++) {
        lam_mat4 m;
        if (!blend(s, i, &m, error))
            return false;
        if (!store(s->positions + 3 * i, mat4_point(&m, vector_at(s->mesh->positions, i, 3))))
            return error && json_fail(&s->gltf->json, KEY_OF(s->place, "POSITION"),
                                      "element %zu: its joints take the vertex out of the range of numbers", i);
        if (s->normals) { // transformed by the inverse transpose
            double cofactors[3][3], sign = mat4_determinant3(&m) < 0 ? -1 : 1;
            mat4_normal_matrix(&m, cofactors);
            lam_vec3 n = vector_at(s->mesh->normals, i, 3);
            const double *c = &cofactors[0][0];
            store_direction(s->normals + 3 * i, v3(sign * (c[0] * n.x + c[1] * n.y + c[2] * n.z),
                                                   sign * (c[3] * n.x + c[4] * n.y + c[5] * n.z),
                                                   sign * (c[6] * n.x + c[7] * n.y + c[8] * n.z)));
        }
        if (s->tangents) {
            store_direction(s->tangents + 4 * i, mat4_vector(&m, vector_at(s->mesh->tangents, i, 4)));
            s->tangents[4 * i + 3] = s->mesh->tangents[4 * i + 3];
        }
    }
    return true;
}

static bool take_set(struct gltf *gltf, const struct place *place, const json_t *attributes, int set, size_t count,
                     struct skinning *s)
{
    char joints[20], weights[20], words[64];
    struct gltf_accessor *j, *w;
    snprintf(joints, sizeof joints, "JOINTS_%d", set);
    snprintf(weights, sizeof weights, "WEIGHTS_%d", set);
    if (!gltf_take_accessor(gltf, place, attributes, joints, &j) ||
        !gltf_take_accessor(gltf, place, attributes, weights, &w))
        return false;
    if (!j || !w)
        return true;
    if (j->width != 4 || j->type[0] != 'V' || j->normalized || (j->component != GLTF_U8 && j->component != GLTF_U16))
        return json_fail(&gltf->json, KEY_OF(place, joints),
                         "found %s, expected VEC4 of UNSIGNED_BYTE or UNSIGNED_SHORT", gltf_accessor_words(j, words));
    bool numbers = w->component == GLTF_U8 || w->component == GLTF_U16;
    if (w->width != 4 || w->type[0] != 'V' || (w->component != GLTF_F32 && !numbers))
        return json_fail(&gltf->json, KEY_OF(place, weights),
                         "found %s, expected VEC4 of FLOAT, or of normalized UNSIGNED_BYTE or UNSIGNED_SHORT",
                         gltf_accessor_words(w, words));
    if (j->count != count || w->count != count)
        return json_fail(&gltf->json, KEY_OF(place, j->count != count ? joints : weights),
                         "found %zu elements, expected %zu, one for each POSITION",
                         j->count != count ? j->count : w->count, count);
    s->joints[s->sets] = gltf_floats(gltf, KEY_OF(place, joints), j, GLTF_REQUIRED);
    s->weights[s->sets] = gltf_floats(gltf, KEY_OF(place, weights), w, GLTF_REQUIRED);
    return s->joints[s->sets] && s->weights[s->sets++];
}

static bool apply_skin(struct gltf *gltf, const struct place *place, const json_t *primitive,
                       const struct gltf_skin *skin, lam_mesh *mesh, bool *skinned)
{
    struct skinning s = {.gltf = gltf, .place = KEY_OF(place, "attributes"), .skin = skin, .mesh = mesh};
    const json_t *attributes = json_object_get(primitive, "attributes");
    struct arena *arena = &gltf->scene->arena;
    size_t count = mesh->vertex_count;
    for (int set = 0; set < SETS_MAX; set++)
        if (!take_set(gltf, s.place, attributes, set, count, &s))
            return gltf_forgive(gltf);
    if (!s.sets)
        return true;
    s.positions = arena_array(arena, count, 3 * sizeof(float));
    s.normals = mesh->normals ? arena_array(arena, count, 3 * sizeof(float)) : NULL;
    s.tangents = mesh->tangents ? arena_array(arena, count, 4 * sizeof(float)) : NULL;
    if (!s.positions || !s.normals != !mesh->normals || !s.tangents != !mesh->tangents)
        return gltf_no_memory(gltf, count * 4 * sizeof(float));
    if (!parallel_rows_run(gltf->source, parallel_rows_count(count), skin_chunk, &s, gltf->json.error))
        return gltf_forgive(gltf);
    mesh->positions = s.positions;
    mesh->normals = s.normals;
    mesh->tangents = s.tangents;
    *skinned = true;
    return true;
}

bool gltf_deform(struct gltf *gltf, const struct place *place, const json_t *primitive,
                 const struct gltf_deformation *deformation, lam_mesh *mesh, bool *skinned)
{
    struct owned own = {0};
    *skinned = false;
    return morph(gltf, place, primitive, deformation, mesh, &own) &&
           (!deformation->skin || apply_skin(gltf, place, primitive, deformation->skin, mesh, skinned));
}

// --- reads skins (section 3.7.3): the matrices of a skin's joints.

static bool take_inverse_matrices(struct gltf *gltf, const struct place *place, const json_t *object, size_t count,
                                  const float **out)
{
    struct gltf_accessor *accessor;
    char words[64];
    const struct place *here = KEY_OF(place, "inverseBindMatrices");
    *out = NULL;
    if (!gltf_take_accessor(gltf, place, object, "inverseBindMatrices", &accessor))
        return false;
    if (!accessor)
        return true;
    if (accessor->width != 16 || accessor->component != GLTF_F32)
        return json_fail(&gltf->json, here, "found %s, expected MAT4 of FLOAT", gltf_accessor_words(accessor, words));
    if (accessor->count < count)
        return json_fail(&gltf->json, here, "found %zu matrices, expected %zu, one for each joint", accessor->count,
                         count);
    *out = gltf_floats(gltf, here, accessor, GLTF_REQUIRED);
    return *out;
}

const struct gltf_skin *gltf_skin_at(struct gltf *gltf, int index)
{
    const json_t *object = gltf_list_item(gltf, "skins", index), *joints = json_object_get(object, "joints");
    const struct place *place = ELEMENT_OF(KEY_OF(NULL, "skins"), (size_t)index), *here = KEY_OF(place, "joints");
    struct gltf_skin *skin = GLTF_ALLOC(gltf, 1, struct gltf_skin);
    const float *inverse;
    if (!json_array_size(joints))
        return json_fail(&gltf->json, here, "expected a list of at least one node"), NULL;
    if (!skin || !(skin->joints = GLTF_ALLOC(gltf, json_array_size(joints), lam_mat4)))
        return gltf_no_memory(gltf, json_array_size(joints) * sizeof *skin->joints), NULL;
    skin->count = json_array_size(joints);
    if (!take_inverse_matrices(gltf, place, object, skin->count, &inverse))
        return NULL;
    for (size_t i = 0; i < skin->count; i++) {
        int node;
        if (!gltf_index_of(gltf, ELEMENT_OF(here, i), json_array_get(joints, i), "nodes", &node))
            return NULL;
        lam_mat4 bind = lam_mat4_identity();
        for (int k = 0; inverse && k < 16; k++)
            if (k % 4 < 3) // the last row is 0 0 0 1
                bind.m[k % 4][k / 4] = (double)inverse[16 * i + (size_t)k];
        skin->joints[i] = mat4_mul(&gltf->nodes[node].world, &bind);
    }
    return skin;
}
