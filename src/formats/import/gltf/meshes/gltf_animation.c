// gltf_animation.c: evaluates an animation at one time (section 3.11) and stores the results in the nodes.
#include "gltf_meshes.h"

#include "gltf_data.h"
#include "gltf_json.h"
#include "gltf.h"

#include "linear.h"

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

// The property that a channel animates.
enum path { TRANSLATION, ROTATION, SCALE, WEIGHTS };

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

static bool take_values(struct gltf *gltf, const struct place *place, const json_t *object, enum path path,
                        struct sampler *sampler)
{
    struct gltf_accessor *output;
    char words[64];
    const struct place *here = KEY_OF(place, "output");
    int width = path == ROTATION ? 4 : path == WEIGHTS ? 1 : 3;
    if (!gltf_take_accessor(gltf, place, object, "output", &output))
        return false;
    if (!output)
        return json_fail(&gltf->json, place, "output is missing");
    bool floats = output->component == GLTF_F32,
         numbers = output->normalized && output->component != GLTF_U32 && (path == ROTATION || path == WEIGHTS);
    if (output->width != width || output->type[0] == 'M' || (!floats && !numbers))
        return json_fail(&gltf->json, here, "found %s, expected %s", gltf_accessor_words(output, words),
                         path == ROTATION  ? "VEC4 of FLOAT or of a normalized type"
                         : path == WEIGHTS ? "SCALAR of FLOAT or of a normalized type"
                                           : "VEC3 of FLOAT");
    size_t entries = sampler->keys * (sampler->interpolation == CUBIC_SPLINE ? 3 : 1);
    bool fits = path == WEIGHTS ? output->count % entries == 0 : output->count == entries;
    if (!fits)
        return json_fail(&gltf->json, here, "found %zu elements for %zu keys, expected %s%zu", output->count,
                         sampler->keys, path == WEIGHTS ? "a multiple of " : "", entries);
    sampler->values = gltf_floats(gltf, here, output, GLTF_REQUIRED);
    sampler->width = path == WEIGHTS ? output->count / entries : (size_t)width;
    return sampler->values;
}

static bool take_sampler(struct gltf *gltf, const struct place *place, const json_t *animation, size_t index,
                         enum path path, struct sampler *sampler)
{
    const json_t *list = json_object_get(animation, "samplers");
    const struct place *here = ELEMENT_OF(KEY_OF(place, "samplers"), index);
    sampler->interpolation = LINEAR;
    if (index >= json_array_size(list))
        return json_fail(&gltf->json, place, "a channel names sampler %zu of %zu", index, json_array_size(list));
    const json_t *object = json_array_get(list, index);
    return json_take_word(&gltf->json, here, object, "interpolation", interpolation_words, &sampler->interpolation) &&
           take_times(gltf, here, object, sampler) && take_values(gltf, here, object, path, sampler);
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
static void evaluate(const struct sampler *s, double time, enum path path, double *out)
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
    if (path == ROTATION && s->interpolation == LINEAR) {
        double a[4], b[4];
        for (size_t i = 0; i < 4; i++) {
            a[i] = value_of(s, key, 0, i);
            b[i] = value_of(s, next, 0, i);
        }
        gltf_unit_quaternion(a);
        gltf_unit_quaternion(b);
        slerp(a, b, t, out);
    }
    if (path == ROTATION)
        gltf_unit_quaternion(out);
}

// --- channels

static bool set_weights(struct gltf *gltf, const struct sampler *sampler, double time, struct gltf_node *node)
{
    node->weights = GLTF_ALLOC(gltf, sampler->width, double);
    if (!node->weights)
        return gltf_no_memory(gltf, sampler->width * sizeof *node->weights);
    node->weight_count = sampler->width;
    evaluate(sampler, time, WEIGHTS, node->weights);
    return true;
}

static bool apply_channel(struct gltf *gltf, const struct place *place, const json_t *animation, const json_t *channel,
                          const struct place *here)
{
    static const char *const paths[] = {"translation", "rotation", "scale", "weights"};
    size_t index = SIZE_MAX;
    const json_t *target = gltf_take_object(gltf, here, channel, "target");
    const struct place *in_target = KEY_OF(here, "target");
    const char *name = json_string_value(json_object_get(target, "path"));
    int node_index = gltf_take_link(gltf, in_target, target, "node", "nodes");
    if (!gltf_take_whole(gltf, here, channel, "sampler", 0, 1e9, &index))
        return false;
    enum path path = TRANSLATION;
    while (name && path <= WEIGHTS && strcmp(paths[path], name) != 0)
        path++;
    if (node_index < 0 || !name || path > WEIGHTS) // the target belongs to an extension
        return true;
    if (index == SIZE_MAX)
        return json_fail(&gltf->json, here, "sampler is missing");
    struct gltf_node *node = &gltf->nodes[node_index];
    if (path != WEIGHTS && node->has_matrix)
        return json_fail(&gltf->json, KEY_OF(in_target, "node"),
                         "node %d has a matrix, expected translation, rotation and scale", node_index);
    struct sampler sampler;
    if (!take_sampler(gltf, place, animation, index, path, &sampler))
        return false;
    double time = gltf->source->params->time_s;
    if (path == WEIGHTS)
        return set_weights(gltf, &sampler, time, node);
    evaluate(&sampler, time, path,
             path == TRANSLATION ? node->translation
             : path == ROTATION  ? node->rotation
                                 : node->scale);
    return true;
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
