// mesh_save.c: writes one mesh of triangles as a model file, with the writers for scenes.
#include "export.h"

#include "fail.h"
#include "file.h"

#include <stdlib.h>
#include <string.h>

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
