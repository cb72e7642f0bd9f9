// export.c: selects and calls the writer of a model format.
#include "export.h"
#include "fail.h"
#include "file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EXPORTER_ADDRESS(name) &exporter_##name,
static const struct exporter *const exporters[] = {EXPORTERS(EXPORTER_ADDRESS)};
enum { COUNT = (int)(sizeof exporters / sizeof *exporters) };

const char *lam_export_format(int index) { return index >= 0 && index < COUNT ? exporters[index]->ending : NULL; }

// Returns the exporter for a file extension. Returns NULL if no format uses this extension; the error then names
// `path`.
static const struct exporter *exporter_find(const char *ending, const char *path, lam_error *error)
{
    char list[8 * COUNT + 8] = "";
    for (int i = 0; i < COUNT; i++) {
        if (strcmp(ending, exporters[i]->ending) == 0)
            return exporters[i];
        snprintf(list + strlen(list), sizeof list - strlen(list), "%s.%s",
                 i == 0           ? ""
                 : i + 1 == COUNT ? " or "
                                  : ", ",
                 exporters[i]->ending);
    }
    fail(error, LAM_UNSUPPORTED, "%s: found the ending '%.20s', expected %s", path, ending, list);
    return NULL;
}

// --- the public function

// Stores the text as the first file.
static bool finish(struct exporting *e, const char *ending)
{
    struct lam_export *out = e->out;
    lam_bytes bytes = {e->text.bytes, e->text.length};
    if (!export_text_is_whole(e, &e->text))
        return false;
    e->text.bytes = NULL;
    char dotted[16];
    snprintf(dotted, sizeof dotted, ".%s", ending);
    if (!export_add_file(e, dotted, false, bytes))
        return false;
    struct export_file *files = out->files.items, model = files[out->files.count - 1];
    memmove(files + 1, files, (size_t)(out->files.count - 1) * sizeof *files);
    files[0] = model;
    return true;
}

lam_export *lam_scene_export(const lam_scene *scene, const char *format, const lam_export_params *params,
                             lam_error *error)
{
    static const lam_export_params none;
    params = params ? params : &none;
    if (!scene || !format)
        return fail(error, LAM_BAD_ARGUMENT, "lam_scene_export: %s is NULL", scene ? "format" : "scene"), NULL;
    if (!check_reserved("lam_export_params", params, error) ||
        (params->camera && !check_reserved("lam_camera", params->camera, error)))
        return NULL;
    const struct exporter *exporter = exporter_find(format, format, error);
    if (!exporter)
        return NULL;
    if (params->thumbnail && exporter != &exporter_glb) {
        fail(error, LAM_BAD_ARGUMENT, "lam_scene_export: found a thumbnail, and .%s has none; expected .glb", format);
        return NULL;
    }
    struct call_control call;
    call_start(&call, params->control);
    call_add_input(&call, scene->input_bytes);
    struct arena arena;
    arena_start(&arena, &call);
    struct lam_export *out = arena_alloc_zeroed(&arena, sizeof *out);
    if (!out)
        return call_memory_error(&call, sizeof *out, error), NULL;
    out->arena = arena;
    struct exporting e = {.scene = scene,
                          .params = params,
                          .name = params->name ? params->name : "model",
                          .arena = &out->arena,
                          .out = out,
                          .from = lam_scene_up(scene),
                          .to = exporter->up,
                          .text.call = &call,
                          .call = &call,
                          .error = error};
    bool ok = export_is_whole(&e) && (!exporter->flat || export_flatten(&e)) && exporter->write(&e) &&
              export_is_whole(&e) && finish(&e, format);
    out->arena.call = NULL; // the arena is used after the call ends
    free(e.text.bytes);
    if (ok)
        return out;
    lam_export_free(out);
    return NULL;
}

// --- writes one mesh of triangles as a model file, with the writers for scenes.

// The formats that can store a single mesh.
static const struct exporter *const formats[] = {&exporter_obj, &exporter_stl, &exporter_ply};
enum { FORMATS = (int)(sizeof formats / sizeof *formats) };

const char *lam_mesh_format(int index) { return index >= 0 && index < FORMATS ? formats[index]->ending : NULL; }

static const struct exporter *find(const char *path, lam_error *error)
{
    const char *ending = path_ending(path);
    for (int i = 0; i < FORMATS; i++)
        if (strcmp(ending, formats[i]->ending) == 0)
            return formats[i];
    fail(error, LAM_UNSUPPORTED, "%s: found the ending '%.20s', expected .obj, .stl or .ply", path, ending);
    return NULL;
}

bool lam_mesh_save(const lam_mesh *mesh, const char *path, lam_up up, lam_error *error)
{
    if (!mesh || !path)
        return fail(error, LAM_BAD_ARGUMENT, "lam_mesh_save: %s is NULL", mesh ? "path" : "mesh");
    if (!check_reserved("lam_mesh", mesh, error))
        return false;
    if (!mesh->triangle_count || !mesh->positions)
        return fail(error, LAM_BAD_ARGUMENT, "%s: the mesh has no triangles", path);
    const struct exporter *format = find(path, error);
    if (!format)
        return false;
    struct arena arena;
    arena_start(&arena, NULL);
    struct exporting e = {.name = path, .arena = &arena, .from = up, .to = format->up, .error = error};
    e.flat[EXPORT_TRIANGLES] = *mesh;
    e.flat[EXPORT_TRIANGLES].colors = NULL; // only scenes have materials and colours
    e.flat[EXPORT_TRIANGLES].parts = NULL;
    e.flat[EXPORT_TRIANGLES].second_texcoords = NULL;
    e.flat[EXPORT_TRIANGLES].tangents = NULL;
    bool ok = format->write(&e) && export_text_is_whole(&e, &e.text);
    ok = ok && file_write(path, e.text.bytes, e.text.length, false, NULL, error);
    free(e.text.bytes);
    arena_free(&arena);
    return ok;
}
