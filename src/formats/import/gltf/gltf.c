// gltf.c: the glTF importer: recognises the format and runs the steps (see gltf.h for an overview).
#include "gltf.h"

#include "gltf_accessors.h"
#include "gltf_animation.h"
#include "gltf_buffers.h"
#include "gltf_cameras.h"
#include "gltf_container.h"
#include "gltf_extensions.h"
#include "gltf_file_info.h"
#include "gltf_json.h"
#include "gltf_lights.h"
#include "gltf_materials.h"
#include "gltf_nodes.h"
#include "gltf_objects.h"
#include "gltf_primitives.h"
#include "gltf_textures.h"

#include "dynamic_library.h"
#include "fail.h"

#include <string.h>

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
           gltf_accessors_start(gltf) && gltf_meshes_start(gltf) && gltf_textures_start(gltf) &&
           gltf_materials_read(gltf) && gltf_textures_finish(gltf) && gltf_nodes_read(gltf) &&
           gltf_animation_apply(gltf) && gltf_objects_add(gltf) && gltf_lights_add(gltf) && gltf_cameras_add(gltf) &&
           report_skipped(gltf);
}

static bool gltf_load(const struct import_source *source, struct lam_scene *scene, lam_error *error)
{
    struct arena scratch;
    lam_error unwanted;
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
