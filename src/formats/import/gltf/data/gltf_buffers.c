// gltf_buffers.c: reads buffers (section 3.6.1) on first use, and moves a buffer to the scene if arrays of the scene
// point into it.
#include "gltf_buffers.h"

#include "gltf_json.h"
#include "gltf_uri.h"

#include "fail.h"

bool gltf_buffers_start(struct gltf *gltf)
{
    size_t buffers = gltf_list_size(gltf, "buffers"), views = gltf_list_size(gltf, "bufferViews");
    gltf->buffers = GLTF_ALLOC(gltf, buffers, struct gltf_buffer);
    gltf->views = GLTF_ALLOC(gltf, views, struct gltf_view);
    return (gltf->buffers && gltf->views) || gltf_no_memory(gltf, views * sizeof *gltf->views);
}

static bool read_buffer(struct gltf *gltf, int index)
{
    struct gltf_buffer *buffer = &gltf->buffers[index];
    const struct place *place = ELEMENT_OF(KEY_OF(NULL, "buffers"), (size_t)index);
    const json_t *object = gltf_list_item(gltf, "buffers", index);
    const char *uri = NULL;
    size_t length = 0;
    if (buffer->data)
        return true;
    if (!json_object_get(object, "byteLength"))
        return json_fail(&gltf->json, place, "byteLength is missing");
    if (!gltf_take_whole(gltf, place, object, "byteLength", 1, 9e15, &length) ||
        (!json_is_null(json_object_get(object, "uri")) && !json_take_text(&gltf->json, place, object, "uri", &uri)))
        return false;
    const uint8_t *data = gltf->binary;
    size_t size = gltf->binary_size;
    if (uri) {
        if (!gltf_uri_read(gltf, KEY_OF(place, "uri"), uri, &buffer->file))
            return false;
        data = buffer->file.data;
        size = buffer->file.size;
    } else if (index != 0 || !data) {
        return json_fail(&gltf->json, place, "found no uri, %s",
                         index == 0 ? "and the file contains no binary chunk"
                                    : "but only the first buffer may be the file's binary chunk");
    }
    if (size < length)
        return json_fail(&gltf->json, KEY_OF(place, "byteLength"), "found %zu, but %s only %zu bytes", length,
                         uri ? "its data are" : "the binary chunk contains", size);
    buffer->data = data;
    buffer->size = length;
    return true;
}

bool gltf_buffer_bytes(struct gltf *gltf, const struct place *place, int index, size_t offset, size_t length,
                       const uint8_t **out)
{
    if (!read_buffer(gltf, index))
        return false;
    const struct gltf_buffer *buffer = &gltf->buffers[index];
    if (offset > buffer->size || length > buffer->size - offset)
        return json_fail(&gltf->json, place, "found bytes %zu to %zu, but buffer %d has only %zu", offset,
                         offset + length, index, buffer->size);
    *out = buffer->data + offset;
    return true;
}

void gltf_buffer_keep(struct gltf *gltf, int buffer)
{
    if (buffer < 0)
        return; // decoded bytes already belong to the scene
    gltf->buffers[buffer].kept = true;
    gltf->source_kept |= gltf->buffers[buffer].data == gltf->binary;
}

bool gltf_buffers_end(struct gltf *gltf)
{
    bool ok = true;
    for (size_t i = 0; gltf->buffers && i < gltf_list_size(gltf, "buffers"); i++) {
        struct gltf_buffer *buffer = &gltf->buffers[i];
        if (buffer->kept && ok)
            ok = file_move_to_arena(&buffer->file, &gltf->scene->arena) || gltf_no_memory(gltf, sizeof *buffer);
        file_release(&buffer->file);
    }
    if (gltf->source_kept && ok)
        ok = file_move_to_arena(gltf->source->file, &gltf->scene->arena) || gltf_no_memory(gltf, sizeof *gltf->buffers);
    return ok;
}
