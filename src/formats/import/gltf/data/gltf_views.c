// gltf_views.c: reads bufferViews (section 3.6.1): ranges of a buffer's bytes, decoded if they are compressed.
#include "gltf_buffers.h"
#include "gltf_json.h"
#include "gltf_meshopt.h"

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
