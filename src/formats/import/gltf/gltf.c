// gltf.c: the glTF importer: recognises the format and runs the steps (see gltf.h for an overview).
#include "gltf.h"
#include "dynamic_library.h"
#include "fail.h"
#include "file.h"
#include "gltf_data.h"
#include "gltf_meshes.h"
#include "gltf_json.h"
#include "gltf_materials.h"

#include <string.h>
#include <strings.h>

// --- reads .glb files: a header, and chunks that contain the JSON text and the binary buffer (section 4).

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

// Finds the JSON text: a chunk of a .glb file, or the whole of any other file. Sets gltf->binary.
static bool gltf_container_read(struct gltf *gltf, const uint8_t **text, size_t *size)
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

// Recognises a binary file, or a JSON object with the key "asset".
static int gltf_probe(const uint8_t *bytes, size_t size, size_t file_size)
{
    (void)file_size;
    static const char key[] = "\"asset\"";
    size_t at = size >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    if (gltf_is_binary(bytes, size))
        return 2;
    while (at < size && (bytes[at] == ' ' || bytes[at] == '\t' || bytes[at] == '\r' || bytes[at] == '\n'))
        at++;
    if (at >= size || bytes[at] != '{')
        return 0;
    return memmem(bytes + at, size - at, key, sizeof key - 1) ? 2 : 0;
}

// Warns about problems, and about primitives that are not drawn. Fails if the file contains no other primitives.
static bool report_skipped(struct gltf *gltf)
{
    struct lam_scene *scene = gltf->scene;
    const char *name = gltf->source->name;
    if (!scene->objects.count && gltf->without_positions)
        return fail(gltf->json.error, LAM_CANNOT_READ,
                    "%s: contains nothing to draw: its primitives (%zu) have no attribute POSITION", name,
                    gltf->without_positions);
    if (!gltf_warn_problems(gltf, "contains no triangles in its scene"))
        return false;
    if (gltf->without_positions)
        scene_warn(scene, "%s: not drawn: primitives without the attribute POSITION (%zu)", name,
                   gltf->without_positions);
    if (gltf->flattened)
        scene_warn(scene, "%s: not drawn: meshes flattened by a node's scale of 0 (%zu)", name, gltf->flattened);
    return true;
}

static bool build(struct gltf *gltf)
{
    const uint8_t *text;
    size_t size;
    return gltf_container_read(gltf, &text, &size) && gltf_json_parse(gltf, text, size) && gltf_check_asset(gltf) &&
           gltf_file_info_note(gltf) && gltf_check_extensions(gltf) && gltf_buffers_start(gltf) &&
           gltf_accessors_start(gltf) && gltf_animation_apply(gltf) && gltf_meshes_start(gltf) &&
           gltf_textures_start(gltf) && gltf_materials_read(gltf) && gltf_textures_finish(gltf) &&
           gltf_nodes_read(gltf) && gltf_objects_add(gltf) && gltf_lights_add(gltf) && gltf_cameras_add(gltf) &&
           report_skipped(gltf);
}

static bool gltf_load(struct import_source *source, struct lam_scene *scene, lam_error *error)
{
    struct arena scratch;
    lam_error unwanted;
    if (!import_whole(source, error))
        return false;
    arena_start(&scratch, source->call);
    struct gltf gltf = {.source = source,
                        .scene = scene,
                        .scratch = &scratch,
                        .json = {.file = source->name, .error = error ? error : &unwanted}};
    bool ok = build(&gltf);
    scene->shared_arrays = true;
    ok = gltf_buffers_end(&gltf) && ok;
    gltf_json_free(&gltf);
    library_close(gltf.meshopt);
    library_close(gltf.draco);
    arena_free(&scratch);
    return ok;
}

const struct importer importer_gltf = {
    .name = "gltf",
    .extensions = "gltf glb",
    .up = LAM_UP_Y,
    .flat_normals = true,
    .probe = gltf_probe,
    .load = gltf_load,
};
