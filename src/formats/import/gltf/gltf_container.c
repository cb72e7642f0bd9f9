// gltf_container.c: reads .glb files: a header, and chunks that contain the JSON text and the binary buffer (section
// 4).
#include "gltf_container.h"

#include <string.h>
#include <strings.h>

#include "fail.h"
#include "file.h"

enum { HEADER = 12, CHUNK = 8, CHUNK_JSON = 0x4e4f534a, CHUNK_BIN = 0x004e4942 };

static uint32_t number_at(const uint8_t *at)
{
    return (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

static bool check_header(struct gltf *gltf, size_t *end)
{
    const struct import_source *source = gltf->source;
    const uint8_t *bytes = source->bytes;
    lam_error *error = gltf->json.error;
    if (source->size < HEADER + CHUNK)
        return fail(error, LAM_CANNOT_READ, "%s: the file is truncated: found %zu bytes, expected at least %d",
                    source->name, source->size, HEADER + CHUNK);
    uint32_t version = number_at(bytes + 4), length = number_at(bytes + 8);
    if (version != 2)
        return fail(error, LAM_UNSUPPORTED, "%s: byte 4: this is binary glTF %u.0, expected glTF 2.0", source->name,
                    version);
    if (length > source->size)
        return fail(error, LAM_CANNOT_READ, "%s: the file is truncated: its header declares %u bytes, found %zu",
                    source->name, length, source->size);
    if (length < HEADER + CHUNK)
        return fail_byte(error, source, 8, "the header declares %u bytes, expected at least %d", length,
                         HEADER + CHUNK);
    if (length < source->size)
        scene_warn(gltf->scene, "%s: %zu bytes after the %u of the file are ignored", source->name,
                   source->size - length, length);
    *end = length;
    return true;
}

bool gltf_container_read(struct gltf *gltf, const uint8_t **text, size_t *size)
{
    const struct import_source *source = gltf->source;
    *text = source->bytes;
    *size = source->size;
    if (!gltf_is_binary(source->bytes, source->size)) // a file of JSON text may have this ending too
        return strcasecmp(path_ending(source->name), "glb") != 0 || !source->size ||
               memchr("{ \t\r\n\xef", source->bytes[0], 6) ||
               fail_byte(gltf->json.error, source, 0, "found no binary glTF file, which begins with 'glTF'");
    size_t end = 0, at = HEADER;
    if (!check_header(gltf, &end))
        return false;
    for (int chunk = 0; end - at >= CHUNK; chunk++) {
        uint32_t length = number_at(source->bytes + at), type = number_at(source->bytes + at + 4);
        size_t begin = at + CHUNK;
        if (length > end - begin)
            return fail_byte(gltf->json.error, source, at,
                             "chunk %d declares %u bytes, but only %zu are left in the file", chunk, length,
                             end - begin);
        if (chunk == 0 && type != CHUNK_JSON)
            return fail_byte(gltf->json.error, source, at + 4,
                             "the first chunk is of type 0x%08x, expected the JSON text (0x%08x)", type, CHUNK_JSON);
        if (chunk == 0) {
            *text = source->bytes + begin;
            *size = length;
        } else if (chunk == 1 && type == CHUNK_BIN) {
            gltf->binary = source->bytes + begin;
            gltf->binary_size = length;
        } // other chunks belong to extensions
        // The padding of the last chunk may be missing. Some programs (trimesh) pad no chunk.
        size_t padded = ((size_t)length + 3) & ~(size_t)3, left = end - begin;
        bool unpadded = left - length >= CHUNK && number_at(source->bytes + begin + length + 4) == CHUNK_BIN;
        at = unpadded ? begin + length : padded < left ? begin + padded : end;
    }
    return true;
}
