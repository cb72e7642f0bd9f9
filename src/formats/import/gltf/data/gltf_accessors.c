// gltf_accessors.c: reads accessors (section 3.6.2): their types, and their ranges in the file's buffers.
#include "gltf_data.h"
#include "gltf_json.h"

#include <stdio.h>
#include <string.h>

static const struct {
    const char *name;
    int width, columns;
} types[] = {{"SCALAR", 1, 1}, {"VEC2", 2, 1}, {"VEC3", 3, 1}, {"VEC4", 4, 1},
             {"MAT2", 4, 2},   {"MAT3", 9, 3}, {"MAT4", 16, 4}};

static const struct json_choice component_words[] = {{"BYTE", GLTF_I8},
                                                     {"UNSIGNED_BYTE", GLTF_U8},
                                                     {"SHORT", GLTF_I16},
                                                     {"UNSIGNED_SHORT", GLTF_U16},
                                                     {"UNSIGNED_INT", GLTF_U32},
                                                     {"FLOAT", GLTF_F32},
                                                     {NULL, 0}};

const char *gltf_accessor_words(const struct gltf_accessor *accessor, char out[64])
{
    int i = 0;
    while (component_words[i].name && component_words[i].value != accessor->component)
        i++;
    snprintf(out, 64, "%s of %s%s", accessor->type, accessor->normalized ? "normalized " : "", component_words[i].name);
    return out;
}

bool gltf_accessors_start(struct gltf *gltf)
{
    size_t count = gltf_list_size(gltf, "accessors");
    gltf->accessors = GLTF_ALLOC(gltf, count, struct gltf_accessor);
    return gltf->accessors || gltf_no_memory(gltf, count * sizeof *gltf->accessors);
}

// Gets the required "componentType".
static bool take_component(struct gltf *gltf, const struct place *place, const json_t *object, int *component)
{
    const json_t *value = json_object_get(object, "componentType");
    if (!value)
        return json_fail(&gltf->json, place, "componentType is missing");
    double number = json_is_number(value) ? json_number_value(value) : 0;
    for (int i = 0; component_words[i].name; i++)
        if (number == component_words[i].value) {
            *component = component_words[i].value;
            return true;
        }
    return json_unexpected(&gltf->json, KEY_OF(place, "componentType"), value,
                           "5120, 5121, 5122, 5123, 5125 or 5126 (BYTE, UNSIGNED_BYTE, SHORT, UNSIGNED_SHORT, "
                           "UNSIGNED_INT or FLOAT)");
}

static bool take_type(struct gltf *gltf, const struct place *place, const json_t *object,
                      struct gltf_accessor *accessor, size_t *element)
{
    const json_t *value = json_object_get(object, "type");
    const char *name = json_string_value(value);
    if (!value)
        return json_fail(&gltf->json, place, "type is missing");
    for (size_t i = 0; name && i < sizeof types / sizeof *types; i++) {
        if (strcmp(types[i].name, name) != 0)
            continue;
        accessor->type = types[i].name;
        accessor->width = types[i].width;
        // Each column of a matrix begins at a multiple of four bytes.
        size_t column = (size_t)(types[i].width / types[i].columns) * gltf_component_size(accessor->component);
        *element = types[i].columns > 1 ? (column + 3) / 4 * 4 * (size_t)types[i].columns : column;
        return true;
    }
    return json_unexpected(&gltf->json, KEY_OF(place, "type"), value, "SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 or MAT4");
}

// Returns the range of `count` elements of `element` bytes in the bufferView that `object` refers to. Returns NULL on
// error, or if `object` names no bufferView.
static const uint8_t *take_run(struct gltf *gltf, const struct place *place, const json_t *object, size_t count,
                               size_t element, bool strided, size_t *stride, int *buffer)
{
    int index;
    size_t offset = 0;
    if (!gltf_take_index(gltf, place, object, "bufferView", "bufferViews", &index) ||
        !gltf_take_whole(gltf, place, object, "byteOffset", 0, 9e15, &offset))
        return NULL;
    if (index < 0)
        return json_fail(&gltf->json, place, "bufferView is missing"), NULL;
    const struct gltf_view *view = gltf_view_at(gltf, index);
    if (!view)
        return NULL;
    *stride = strided && view->stride ? view->stride : element;
    *buffer = view->buffer;
    if (*stride < element) {
        json_fail(&gltf->json, place, "its elements are %zu bytes long, but bufferView %d has byteStride %zu", element,
                  index, *stride);
        return NULL;
    }
    size_t left = offset > view->size ? 0 : view->size - offset;
    if (left < element || (left - element) / *stride < count - 1) {
        json_fail(&gltf->json, place,
                  "%zu elements from byte %zu on, %zu apart, do not fit the %zu bytes of bufferView %d", count, offset,
                  *stride, view->size, index);
        return NULL;
    }
    return view->data + offset;
}

static bool take_sparse(struct gltf *gltf, const struct place *place, const json_t *sparse, size_t element,
                        struct gltf_accessor *accessor)
{
    size_t stride;
    int buffer;
    const json_t *indices = json_object_get(sparse, "indices"), *values = json_object_get(sparse, "values");
    if (!indices || !values)
        return json_fail(&gltf->json, place, "%s is missing", indices ? "values" : "indices");
    accessor->sparse_count = 0;
    if (!gltf_take_whole(gltf, place, sparse, "count", 1, (double)accessor->count, &accessor->sparse_count))
        return false;
    if (!accessor->sparse_count)
        return json_fail(&gltf->json, place, "count is missing");
    const struct place *at_indices = KEY_OF(place, "indices");
    if (!take_component(gltf, at_indices, indices, &accessor->sparse_component))
        return false;
    int component = accessor->sparse_component;
    if (component != GLTF_U8 && component != GLTF_U16 && component != GLTF_U32)
        return json_fail(&gltf->json, KEY_OF(at_indices, "componentType"),
                         "found %d, expected 5121, 5123 or 5125 (UNSIGNED_BYTE, UNSIGNED_SHORT or UNSIGNED_INT)",
                         component);
    accessor->sparse_indices = take_run(gltf, at_indices, indices, accessor->sparse_count,
                                        gltf_component_size(component), false, &stride, &buffer);
    if (!accessor->sparse_indices)
        return false;
    accessor->sparse_values =
        take_run(gltf, KEY_OF(place, "values"), values, accessor->sparse_count, element, false, &stride, &buffer);
    return accessor->sparse_values != NULL;
}

// Returns the accessor with this index, which must be valid. Checks that the accessor's elements are inside the buffer.
// Returns NULL on error.
static struct gltf_accessor *gltf_accessor_at(struct gltf *gltf, int index)
{
    struct gltf_accessor *accessor = &gltf->accessors[index];
    const struct place *place = ELEMENT_OF(KEY_OF(NULL, "accessors"), (size_t)index);
    const json_t *object = gltf_list_item(gltf, "accessors", index);
    size_t element = 0;
    if (accessor->ready)
        return accessor;
    *accessor = (struct gltf_accessor){.buffer = -1};
    if (!json_object_get(object, "count") || json_is_null(json_object_get(object, "count")))
        return json_fail(&gltf->json, place, "count is missing"), NULL;
    if (!take_component(gltf, place, object, &accessor->component) ||
        !take_type(gltf, place, object, accessor, &element) ||
        !gltf_take_whole(gltf, place, object, "count", 1, 4294967295.0, &accessor->count))
        return NULL;
    accessor->stride = element;
    accessor->normalized = gltf_take_flag(gltf, place, object, "normalized", false) && accessor->component != GLTF_F32;
    if (json_object_get(object, "bufferView")) {
        accessor->data =
            take_run(gltf, place, object, accessor->count, element, true, &accessor->stride, &accessor->buffer);
        if (!accessor->data)
            return NULL;
    }
    const json_t *sparse = gltf_take_object(gltf, place, object, "sparse");
    if (sparse && !take_sparse(gltf, KEY_OF(place, "sparse"), sparse, element, accessor))
        return NULL;
    accessor->ready = true;
    return accessor;
}

bool gltf_take_accessor(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                        struct gltf_accessor **out)
{
    int index;
    *out = NULL;
    if (!gltf_take_index(gltf, place, object, key, "accessors", &index))
        return false;
    *out = index >= 0 ? gltf_accessor_at(gltf, index) : NULL;
    return index < 0 || *out;
}

// --- reads bufferViews (section 3.6.1): ranges of a buffer's bytes, decoded if they are compressed.

const struct gltf_view *gltf_view_at(struct gltf *gltf, int index)
{
    struct gltf_view *view = &gltf->views[index];
    const struct place *place = ELEMENT_OF(KEY_OF(NULL, "bufferViews"), (size_t)index);
    const json_t *object = gltf_list_item(gltf, "bufferViews", index);
    size_t offset = 0, length = 0, stride = 0;
    bool decoded;
    if (view->data)
        return view;
    if (!gltf_meshopt_decode(gltf, place, object, view, &decoded))
        return NULL;
    if (decoded)
        return view;
    if (!gltf_take_index(gltf, place, object, "buffer", "buffers", &view->buffer) ||
        !gltf_take_whole(gltf, place, object, "byteOffset", 0, 9e15, &offset) ||
        !gltf_take_whole(gltf, place, object, "byteLength", 1, 9e15, &length) ||
        !gltf_take_whole(gltf, place, object, "byteStride", 0, 1 << 20, &stride))
        return NULL;
    if (view->buffer < 0 || !length)
        return json_fail(&gltf->json, place, "%s is missing", view->buffer < 0 ? "buffer" : "byteLength"), NULL;
    const uint8_t *data;
    if (!gltf_buffer_bytes(gltf, place, view->buffer, offset, length, &data))
        return NULL;
    view->data = data;
    view->size = length;
    view->stride = stride;
    return view;
}
