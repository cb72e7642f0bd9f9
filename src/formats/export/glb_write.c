// glb_write.c: writes a scene as a binary glTF 2.0 file.
#include "glb.h"

#include "fail.h"

#include <stdlib.h>

static bool start(struct glb *glb)
{
    struct exporting *e = glb->e;
    int meshes = e->scene->meshes.count, materials = e->scene->materials.count + 1;
    json_t **lists[] = {&glb->accessors, &glb->views,    &glb->meshes, &glb->materials, &glb->nodes, &glb->images,
                        &glb->textures,  &glb->samplers, &glb->lights, &glb->cameras,   &glb->used};
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
        glb->failed |= !(*lists[i] = json_array());
    glb->failed |= !(glb->root = json_object());
    glb->arrays = arena_alloc_zeroed(e->arena, (size_t)(meshes + 1) * sizeof *glb->arrays);
    for (int side = 0; side < 2; side++) {
        glb->material_index[side] = arena_array(e->arena, (size_t)materials, sizeof(int));
        if (!glb->material_index[side])
            return export_no_memory(e, (size_t)materials * sizeof(int));
        for (int i = 0; i < materials; i++)
            glb->material_index[side][i] = -1;
    }
    for (int i = 0; glb->arrays && i < meshes; i++)
        glb->arrays[i].first_mesh = -1;
    return (glb->arrays && !glb->failed) || export_no_memory(e, (size_t)meshes * sizeof *glb->arrays);
}

static void stop(struct glb *glb)
{
    json_t *lists[] = {glb->accessors, glb->views,    glb->meshes, glb->materials, glb->nodes, glb->images,
                       glb->textures,  glb->samplers, glb->lights, glb->cameras,   glb->used,  glb->root};
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
        json_decref(lists[i]);
    free(glb->bytes.bytes);
}

static void set_list(struct glb *glb, json_t *object, const char *key, json_t *list)
{
    if (json_array_size(list))
        glb_set(glb, object, key, json_incref(list));
}

// Adds asset.thumbnail: an index into `images` (draft of glTF 2.1).
static bool add_thumbnail(struct glb *glb)
{
    const lam_image *picture = glb->e->params->thumbnail;
    lam_save_params params = {.control = glb->e->params->control};
    lam_bytes png;
    if (!picture)
        return true;
    if (!lam_image_encode(picture, "png", &params, &png, glb->e->error))
        return false;
    int view = glb_add_view(glb, png.data, png.size, 0);
    lam_bytes_free(&png);
    glb->thumbnail =
        glb_add(glb, glb->images,
                json_pack("{s:s, s:i, s:s}", "name", "thumbnail", "bufferView", view, "mimeType", "image/png"));
    return true;
}

static void fill_root(struct glb *glb)
{
    const lam_file_info *file = &glb->e->scene->file;
    json_t *root = glb->root,
           *asset = json_pack("{s:s, s:s+}", "version", "2.0", "generator", "lambent ", lam_version());
    json_t *scene = json_object(), *numbers = json_array();
    if (file->copyright)
        glb_set(glb, asset, "copyright", json_string(file->copyright));
    if (glb->e->params->thumbnail)
        glb_set(glb, asset, "thumbnail", json_integer(glb->thumbnail));
    glb_set(glb, root, "asset", asset);
    for (size_t i = 0; i < json_array_size(glb->nodes); i++)
        glb_add(glb, numbers, json_integer((json_int_t)i));
    glb_set(glb, scene, "nodes", numbers);
    glb_set(glb, root, "scene", json_integer(0));
    glb_set(glb, root, "scenes", json_pack("[o]", scene));
    set_list(glb, root, "nodes", glb->nodes);
    set_list(glb, root, "meshes", glb->meshes);
    set_list(glb, root, "accessors", glb->accessors);
    set_list(glb, root, "bufferViews", glb->views);
    set_list(glb, root, "materials", glb->materials);
    set_list(glb, root, "textures", glb->textures);
    set_list(glb, root, "images", glb->images);
    set_list(glb, root, "samplers", glb->samplers);
    set_list(glb, root, "cameras", glb->cameras);
    if (json_array_size(glb->lights))
        glb_set(glb, glb_extension(glb, root, "KHR_lights_punctual"), "lights", json_incref(glb->lights));
    set_list(glb, root, "extensionsUsed", glb->used);
    glb_set(glb, root, "buffers", json_pack("[{s:I}]", "byteLength", (json_int_t)glb->bytes.length));
}

static void add_chunk(struct text *text, const char *kind, const char *bytes, size_t size, char padding)
{
    size_t padded = (size + 3) / 4 * 4;
    export_word(text, (uint32_t)padded);
    text_add_part(text, kind, 4);
    text_add_part(text, bytes, size);
    for (size_t i = size; i < padded; i++)
        text_add_part(text, &padding, 1);
}

static bool finish(struct glb *glb)
{
    struct exporting *e = glb->e;
    struct text json = {.call = e->call};
    while (glb->bytes.length % 4 && !glb->bytes.failed)
        text_add_part(&glb->bytes, "\0", 1);
    fill_root(glb);
    if (glb->failed || glb->bytes.failed ||
        json_dump_callback(glb->root, text_add_chunk, &json, JSON_COMPACT | JSON_REAL_PRECISION(17)) != 0) {
        free(json.bytes);
        return export_text_is_whole(e, &json) && glb_error(glb);
    }
    size_t whole = 28 + (json.length + 3) / 4 * 4 + glb->bytes.length;
    bool fits = whole <= UINT32_MAX;
    if (fits) {
        text_add_part(&e->text, "glTF\2\0\0\0", 8);
        export_word(&e->text, (uint32_t)whole);
        add_chunk(&e->text, "JSON", json.bytes, json.length, ' ');
        add_chunk(&e->text, "BIN\0", glb->bytes.bytes, glb->bytes.length, 0);
    }
    free(json.bytes);
    return fits || fail(e->error, LAM_LIMIT, "%s: the file would have %zu bytes, and GLB has at most %lu", e->name,
                        whole, (unsigned long)UINT32_MAX);
}

static bool write(struct exporting *e)
{
    struct glb glb = {.e = e, .bytes.call = e->call};
    bool ok = start(&glb) && glb_nodes(&glb);
    if (ok && !json_array_size(glb.meshes))
        ok = fail(e->error, LAM_BAD_ARGUMENT, "%s: found no triangles, lines or points", e->name);
    ok = ok && add_thumbnail(&glb) && finish(&glb);
    stop(&glb);
    export_lose_surroundings(e, true);
    return ok;
}

const struct exporter exporter_glb = {"glb", LAM_UP_Y, false, write};
