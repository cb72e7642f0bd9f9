// gltf_animation.c: evaluates an animation at one time (section 3.11, KHR_animation_pointer). The results replace values
// of the JSON tree before the readers of nodes, materials, lights and cameras get them.
#include "gltf_meshes.h"

#include "gltf_data.h"
#include "gltf_json.h"
#include "gltf.h"

#include "khr_layers.h"
#include "linear.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STEP, LINEAR, CUBIC_SPLINE };
static const struct json_choice interpolation_words[] = {
    {"STEP", STEP}, {"LINEAR", LINEAR}, {"CUBICSPLINE", CUBIC_SPLINE}, {NULL, 0}};

// A sampler: the times of the keyframes, and `width` numbers for each keyframe (three times as many for splines).
struct sampler {
    int interpolation;
    const float *times, *values;
    size_t keys, width;
};

// --- properties (https://github.com/KhronosGroup/glTF/blob/main/specification/2.0/ObjectModel.adoc)

enum kind { NUMBERS, ROTATION, WEIGHTS, FLAG };

// The properties that a channel can animate, and their numbers. In a pattern, # is an index, and * is any text before the
// end. The numbers in khr_layers.h are properties too.
struct property {
    const char *pattern;
    enum kind kind;
    int width;
};
static const struct property properties[] = {
    {"/nodes/#/translation", NUMBERS, 3},
    {"/nodes/#/rotation", ROTATION, 4},
    {"/nodes/#/scale", NUMBERS, 3},
    {"/nodes/#/weights", WEIGHTS, 1},
    {"/nodes/#/weights/#", NUMBERS, 1},
    {"/nodes/#/extensions/KHR_node_visibility/visible", FLAG, 1},
    {"/materials/#/pbrMetallicRoughness/baseColorFactor", NUMBERS, 4},
    {"/materials/#/pbrMetallicRoughness/metallicFactor", NUMBERS, 1},
    {"/materials/#/pbrMetallicRoughness/roughnessFactor", NUMBERS, 1},
    {"/materials/#/emissiveFactor", NUMBERS, 3},
    {"/materials/#/extensions/KHR_materials_emissive_strength/emissiveStrength", NUMBERS, 1},
    {"/materials/#/alphaCutoff", NUMBERS, 1},
    {"/materials/#/occlusionTexture/strength", NUMBERS, 1},
    {"/materials/#/normalTexture/scale", NUMBERS, 1},
    {"/materials/#/extensions/KHR_materials_clearcoat/clearcoatNormalTexture/scale", NUMBERS, 1},
    {"/materials/#/*Texture/extensions/KHR_texture_transform/offset", NUMBERS, 2},
    {"/materials/#/*Texture/extensions/KHR_texture_transform/rotation", NUMBERS, 1},
    {"/materials/#/*Texture/extensions/KHR_texture_transform/scale", NUMBERS, 2},
    {"/cameras/#/perspective/yfov", NUMBERS, 1},
    {"/cameras/#/perspective/znear", NUMBERS, 1},
    {"/cameras/#/perspective/zfar", NUMBERS, 1},
    {"/cameras/#/orthographic/ymag", NUMBERS, 1},
    {"/cameras/#/orthographic/znear", NUMBERS, 1},
    {"/cameras/#/orthographic/zfar", NUMBERS, 1},
    {"/extensions/KHR_lights_punctual/lights/#/color", NUMBERS, 3},
    {"/extensions/KHR_lights_punctual/lights/#/intensity", NUMBERS, 1},
    {"/extensions/KHR_lights_punctual/lights/#/range", NUMBERS, 1},
    {"/extensions/KHR_lights_punctual/lights/#/spot/innerConeAngle", NUMBERS, 1},
    {"/extensions/KHR_lights_punctual/lights/#/spot/outerConeAngle", NUMBERS, 1},
};

static bool matches(const char *pattern, const char *pointer)
{
    for (; *pattern; pattern++) {
        const size_t left = strlen(pattern + 1), length = strlen(pointer), digits = strspn(pointer, "0123456789");
        if (*pattern == '*')
            return length >= left && strcmp(pointer + length - left, pattern + 1) == 0;
        if (*pattern == '#' ? digits == 0 : *pointer != *pattern)
            return false;
        pointer += *pattern == '#' ? digits : 1;
    }
    return !*pointer;
}

static bool find_property(const char *pointer, struct property *out)
{
    char pattern[100];
    for (size_t i = 0; i < sizeof properties / sizeof *properties; i++) {
        *out = properties[i];
        if (matches(out->pattern, pointer))
            return true;
    }
    for (size_t i = 0; i < KHR_NUMBERS; i++) {
        snprintf(pattern, sizeof pattern, "/materials/#/extensions/%s/%s", khr_numbers[i].extension,
                 khr_numbers[i].key);
        *out = (struct property){NULL, NUMBERS, khr_numbers[i].count};
        if (matches(pattern, pointer))
            return true;
    }
    return false;
}

// Returns the weights of a node's mesh, which are the defaults of the node's weights.
static json_t *default_weights(const struct gltf *gltf, const json_t *node)
{
    const double index = json_number_value(json_object_get(node, "mesh"));
    const json_t *mesh = gltf_list_item(gltf, "meshes", index >= 0 && index < INT_MAX ? (int)index : -1);
    const json_t *targets = json_object_get(json_array_get(json_object_get(mesh, "primitives"), 0), "targets");
    json_t *weights = json_deep_copy(json_object_get(mesh, "weights"));
    weights = weights ? weights : json_array();
    while (json_array_size(weights) < json_array_size(targets) && json_array_append_new(weights, json_real(0)) == 0)
        continue;
    return weights;
}

// Returns the object or list with the pointer's property, and the property's key or index in it. Adds missing objects
// that have defaults. Returns NULL if the file does not contain the owner.
static json_t *find_owner(const struct gltf *gltf, const char *pointer, char key[64])
{
    json_t *owner = gltf->root;
    for (;;) {
        const size_t length = strcspn(++pointer, "/");
        snprintf(key, 64, "%.*s", (int)length, pointer);
        pointer += length;
        const bool list = json_is_array(owner);
        json_t *next = list ? json_array_get(owner, strtoul(key, NULL, 10)) : json_object_get(owner, key);
        if (!*pointer)
            return json_is_object(owner) || next ? owner : NULL;
        if (!next && json_is_object(owner) && owner != gltf->root && !strstr(key, "Texture") &&
            strcmp(key, "lights") != 0) {
            next = strcmp(key, "weights") == 0 ? default_weights(gltf, owner) : json_object();
            json_object_set_new(owner, key, next);
        }
        owner = next;
    }
}

// Puts a value into the tree.
static bool set_property(struct gltf *gltf, const struct place *place, const char *pointer, json_t *value)
{
    char key[64], shown[SHOWN_NAME_SIZE];
    json_t *owner = find_owner(gltf, pointer, key);
    if (!owner) {
        json_decref(value);
        return json_fail(&gltf->json, place, "'%s' names nothing in the file", shown_file(pointer, shown));
    }
    int failed = json_is_array(owner) ? json_array_set_new(owner, strtoul(key, NULL, 10), value)
                                      : json_object_set_new(owner, key, value);
    return !failed || gltf_no_memory(gltf, sizeof *value);
}

// --- samplers

static bool take_times(struct gltf *gltf, const struct place *place, const json_t *object, struct sampler *sampler)
{
    struct gltf_accessor *input;
    char words[64];
    const struct place *here = KEY_OF(place, "input");
    if (!gltf_take_accessor(gltf, place, object, "input", &input))
        return false;
    if (!input)
        return json_fail(&gltf->json, place, "input is missing");
    if (input->width != 1 || input->component != GLTF_F32)
        return json_fail(&gltf->json, here, "found %s, expected SCALAR of FLOAT", gltf_accessor_words(input, words));
    sampler->times = gltf_floats(gltf, here, input, GLTF_REQUIRED);
    sampler->keys = input->count;
    for (size_t i = 1; sampler->times && i < sampler->keys; i++)
        if (sampler->times[i] < sampler->times[i - 1])
            return json_fail(&gltf->json, here, "key %zu is at %g s, before key %zu at %g s", i,
                             (double)sampler->times[i], i - 1, (double)sampler->times[i - 1]);
    return sampler->times;
}

static bool take_values(struct gltf *gltf, const struct place *place, const json_t *object,
                        const struct property *property, struct sampler *sampler)
{
    static const char *const expected[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    struct gltf_accessor *output;
    char words[64];
    const struct place *here = KEY_OF(place, "output");
    bool list = property->kind == WEIGHTS;
    if (!gltf_take_accessor(gltf, place, object, "output", &output))
        return false;
    if (!output)
        return json_fail(&gltf->json, place, "output is missing");
    if (output->width != property->width || output->type[0] == 'M' || output->component == GLTF_U32)
        return json_fail(&gltf->json, here, "found %s, expected %s of FLOAT", gltf_accessor_words(output, words),
                         expected[property->width - 1]);
    size_t entries = sampler->keys * (sampler->interpolation == CUBIC_SPLINE ? 3 : 1);
    if (list ? output->count % entries != 0 : output->count != entries)
        return json_fail(&gltf->json, here, "found %zu elements for %zu keys, expected %s%zu", output->count,
                         sampler->keys, list ? "a multiple of " : "", entries);
    sampler->values = gltf_floats(gltf, here, output, GLTF_REQUIRED);
    sampler->width = list ? output->count / entries : (size_t)property->width;
    return sampler->values;
}

static bool take_sampler(struct gltf *gltf, const struct place *place, const json_t *animation, size_t index,
                         const struct property *property, struct sampler *sampler)
{
    const json_t *list = json_object_get(animation, "samplers");
    const struct place *here = ELEMENT_OF(KEY_OF(place, "samplers"), index);
    sampler->interpolation = LINEAR;
    if (index >= json_array_size(list))
        return json_fail(&gltf->json, place, "a channel names sampler %zu of %zu", index, json_array_size(list));
    const json_t *object = json_array_get(list, index);
    return json_take_word(&gltf->json, here, object, "interpolation", interpolation_words, &sampler->interpolation) &&
           take_times(gltf, here, object, sampler) && take_values(gltf, here, object, property, sampler);
}

// --- evaluation (appendix C)

// Returns the keyframe at or before the time, and the fraction of the way to the next keyframe.
static size_t find_key(const struct sampler *s, double time, double *fraction, double *length)
{
    size_t low = 0, high = s->keys - 1;
    *fraction = *length = 0;
    if (time <= (double)s->times[0])
        return 0;
    if (time >= (double)s->times[high])
        return high;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        if ((double)s->times[middle] <= time)
            low = middle;
        else
            high = middle;
    }
    *length = (double)s->times[high] - (double)s->times[low];
    *fraction = *length > 0 ? (time - (double)s->times[low]) / *length : 0;
    return low;
}

static double value_of(const struct sampler *s, size_t key, size_t part, size_t i)
{
    size_t parts = s->interpolation == CUBIC_SPLINE ? 3 : 1;
    return (double)s->values[(key * parts + part) * s->width + i];
}

static void slerp(const double a[4], const double b[4], double t, double out[4])
{
    double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3], sign = dot < 0 ? -1 : 1;
    double angle = math_acos(dot * sign), sine = math_sin(angle);
    double from = sine > 1e-6 ? math_sin(angle * (1 - t)) / sine : 1 - t;
    double to = sign * (sine > 1e-6 ? math_sin(angle * t) / sine : t);
    for (int i = 0; i < 4; i++)
        out[i] = from * a[i] + to * b[i];
}

// Evaluates a sampler at a time. Before the first keyframe, the result is the first keyframe's value; after the last
// keyframe, it is the last keyframe's value.
static void evaluate(const struct sampler *s, double time, enum kind kind, double *out)
{
    double t, length;
    size_t key = find_key(s, time, &t, &length);
    size_t middle = s->interpolation == CUBIC_SPLINE, next = key + 1 < s->keys ? key + 1 : key;
    double t2 = t * t, t3 = t2 * t;
    for (size_t i = 0; i < s->width; i++) {
        double a = value_of(s, key, middle, i), b = value_of(s, next, middle, i);
        out[i] = s->interpolation == LINEAR ? a + (b - a) * t : a;
        if (s->interpolation == CUBIC_SPLINE)
            out[i] = (2 * t3 - 3 * t2 + 1) * a + length * (t3 - 2 * t2 + t) * value_of(s, key, 2, i) +
                     (3 * t2 - 2 * t3) * b + length * (t3 - t2) * value_of(s, next, 0, i);
    }
    if (kind == ROTATION && s->interpolation == LINEAR) {
        double a[4], b[4];
        for (size_t i = 0; i < 4; i++) {
            a[i] = value_of(s, key, 0, i);
            b[i] = value_of(s, next, 0, i);
        }
        gltf_unit_quaternion(a);
        gltf_unit_quaternion(b);
        slerp(a, b, t, out); // read_node normalizes the rotation
    }
}

// --- channels

// Converts the numbers of a property to JSON.
static bool value_at(struct gltf *gltf, const struct place *place, const struct sampler *sampler,
                     const struct property *property, json_t **value)
{
    enum { BYTES_OF_A_NUMBER = 64 };
    const size_t bytes = sampler->width * BYTES_OF_A_NUMBER;
    const bool list = property->kind == WEIGHTS || property->width > 1;
    const double time = gltf->source->params->time_s;
    double *numbers = GLTF_ALLOC(gltf, sampler->width, double);
    if (!numbers || !call_charge(gltf->source->call, bytes))
        return gltf_no_memory(gltf, bytes);
    gltf->json_bytes += bytes;
    evaluate(sampler, time, property->kind, numbers);
    for (size_t i = 0; i < sampler->width; i++)
        if (!math_finite(numbers[i]))
            return json_fail(&gltf->json, place, "its value at %g s is not finite", time);
    *value = list ? json_array() : property->kind == FLAG ? json_boolean(numbers[0] != 0) : json_real(numbers[0]);
    for (size_t i = 0; list && i < sampler->width; i++)
        json_array_append_new(*value, json_real(numbers[i]));
    if (*value && json_array_size(*value) == (list ? sampler->width : 0))
        return true;
    json_decref(*value);
    return gltf_no_memory(gltf, bytes);
}

// Finds the property of a channel. Sets *pointer to NULL if the channel names none, or one of an unknown extension.
static bool take_target(struct gltf *gltf, const struct place *place, const json_t *channel, char own[64],
                        const char **pointer)
{
    const json_t *target = gltf_take_object(gltf, place, channel, "target"),
                 *extension = gltf_extension(target, "KHR_animation_pointer");
    const struct place *here = KEY_OF(place, "target");
    const char *path = json_string_value(json_object_get(target, "path"));
    int node = gltf_take_link(gltf, here, target, "node", "nodes");
    *pointer = NULL;
    if (extension)
        return json_take_text(&gltf->json, KEY_OF(KEY_OF(here, "extensions"), "KHR_animation_pointer"), extension,
                              "pointer", pointer);
    if (node < 0 || !path || strlen(path) > 20)
        return true;
    snprintf(own, 64, "/nodes/%d/%s", node, path);
    *pointer = own;
    if (strcmp(path, "weights") != 0 && json_is_array(json_object_get(gltf_list_item(gltf, "nodes", node), "matrix")))
        return json_fail(&gltf->json, KEY_OF(here, "node"),
                         "node %d has a matrix, expected translation, rotation and scale", node);
    return true;
}

static bool apply_channel(struct gltf *gltf, const struct place *place, const json_t *animation, const json_t *channel,
                          const struct place *here)
{
    char own[64], shown[SHOWN_NAME_SIZE];
    const char *pointer;
    size_t index = SIZE_MAX;
    struct property property;
    struct sampler sampler;
    json_t *value = NULL;
    if (!gltf_take_whole(gltf, here, channel, "sampler", 0, 1e9, &index) ||
        !take_target(gltf, here, channel, own, &pointer))
        return false;
    if (!pointer)
        return true;
    if (!find_property(pointer, &property))
        return pointer == own ||
               json_fail(&gltf->json, KEY_OF(here, "target"), "'%s' is no property that this version animates",
                         shown_file(pointer, shown));
    if (index == SIZE_MAX)
        return json_fail(&gltf->json, here, "sampler is missing");
    return take_sampler(gltf, place, animation, index, &property, &sampler) &&
           value_at(gltf, here, &sampler, &property, &value) &&
           set_property(gltf, KEY_OF(here, "target"), pointer, value);
}

bool gltf_animation_apply(struct gltf *gltf)
{
    const char *wanted = gltf->source->params->animation;
    if (!wanted)
        return true;
    int index = gltf_find_named(gltf, json_object_get(gltf->root, "animations"), wanted, "animation");
    if (index < 0)
        return false;
    const json_t *animation = gltf_list_item(gltf, "animations", index);
    const struct place *place = ELEMENT_OF(KEY_OF(NULL, "animations"), (size_t)index);
    const json_t *channels = gltf_take_list(gltf, place, animation, "channels");
    gltf_take_list(gltf, place, animation, "samplers");
    for (size_t i = 0; i < json_array_size(channels); i++)
        if (!apply_channel(gltf, place, animation, json_array_get(channels, i),
                           ELEMENT_OF(KEY_OF(place, "channels"), i)) &&
            !gltf_forgive(gltf))
            return false;
    return true;
}
