// gltf_skins.c: reads skins (section 3.7.3): the matrices of a skin's joints.
#include "gltf_skins.h"

#include "gltf_accessors.h"
#include "gltf_json.h"
#include "gltf_nodes.h"
#include "gltf_numbers.h"

#include "linear.h"

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
