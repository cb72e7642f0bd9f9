// export.c: the front of all writers of model formats: files, losses, the formats.
#include "export.h"

#include "fail.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EXPORTER_ADDRESS(name) &exporter_##name,
static const struct exporter *const exporters[] = {EXPORTERS(EXPORTER_ADDRESS)};
enum { COUNT = (int)(sizeof exporters / sizeof *exporters) };

const char *lam_export_format(int index) { return index >= 0 && index < COUNT ? exporters[index]->ending : NULL; }

const struct exporter *exporter_find(const char *ending, const char *path, lam_error *error)
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

bool export_no_memory(struct exporting *e, size_t bytes) { return fail_memory(e->error, bytes); }

// --- losses

static bool append(struct lam_export *out, struct scene_list *list, const void *item, size_t size)
{
    if (list->count == list->capacity) {
        int capacity = list->capacity ? 2 * list->capacity : 8;
        void *more = arena_array(&out->arena, (size_t)capacity, size);
        if (!more)
            return false;
        if (list->count)
            memcpy(more, list->items, (size_t)list->count * size);
        list->items = more;
        list->capacity = capacity;
    }
    memcpy((char *)list->items + (size_t)list->count++ * size, item, size);
    return true;
}

void export_lose(struct exporting *e, const char *format, ...)
{
    if (!e->out)
        return;
    va_list arguments;
    va_start(arguments, format);
    const char *text = arena_vformat(&e->out->arena, format, arguments);
    va_end(arguments);
    for (int i = 0; text && i < e->out->losses.count; i++)
        if (strcmp(((const char *const *)e->out->losses.items)[i], text) == 0)
            return;
    if (text)
        append(e->out, &e->out->losses, &text, sizeof text);
}

void export_lose_surroundings(struct exporting *e, bool has_lights_and_cameras)
{
    const struct lam_scene *s = e->scene;
    if (!s)
        return;
    if (!has_lights_and_cameras && s->lights.count)
        export_lose(e, "lights are left out (%d): the format has none", s->lights.count);
    if (!has_lights_and_cameras && (s->cameras.count || e->params->camera))
        export_lose(e, "cameras are left out (%d): the format has none",
                    s->cameras.count + (e->params->camera != NULL));
    if (s->environment)
        export_lose(e, "the environment is left out: the format has none");
    if (s->ambient.r > 0 || s->ambient.g > 0 || s->ambient.b > 0)
        export_lose(e, "the ambient light is left out: the format has none");
    if (s->file.animation_count)
        export_lose(e, "animations are left out (%d): the file has the pose that was read", s->file.animation_count);
    if (s->file.variant_count)
        export_lose(e, "variants of materials are left out (%d): the file has those that were read",
                    s->file.variant_count);
}

// --- files

const char *export_add_file(struct exporting *e, const char *ending, lam_bytes bytes)
{
    const char *dot = strrchr(e->name, '.');
    size_t stem = dot ? (size_t)(dot - e->name) : strlen(e->name), length = stem + strlen(ending) + 1;
    struct export_file file = {arena_alloc(e->arena, length), bytes};
    if (file.name)
        snprintf(file.name, length, "%.*s%s", (int)stem, e->name, ending);
    if (file.name && append(e->out, &e->out->files, &file, sizeof file))
        return file.name;
    lam_bytes_free(&bytes);
    export_no_memory(e, length);
    return NULL;
}

static const struct export_file *file_at(const struct lam_export *result, int index)
{
    return result && index >= 0 && index < result->files.count ? (const struct export_file *)result->files.items + index
                                                               : NULL;
}

const char *lam_export_file_name(const lam_export *result, int index)
{
    const struct export_file *file = file_at(result, index);
    return file ? file->name : NULL;
}

lam_bytes lam_export_file(const lam_export *result, int index)
{
    const struct export_file *file = file_at(result, index);
    return file ? file->bytes : (lam_bytes){0};
}

const char *lam_export_loss(const lam_export *result, int index)
{
    return result && index >= 0 && index < result->losses.count ? ((const char *const *)result->losses.items)[index]
                                                                : NULL;
}

void lam_export_free(lam_export *result)
{
    if (!result)
        return;
    for (int i = 0; i < result->files.count; i++)
        lam_bytes_free(&((struct export_file *)result->files.items)[i].bytes);
    struct arena arena = result->arena; // which holds the result itself
    arena_free(&arena);
}

// --- the call

const lam_material *export_material(const struct exporting *e, int index)
{
    const struct lam_scene *s = e->scene;
    return index >= 0 && index < s->materials.count ? (const lam_material *)s->materials.items + index
                                                    : &s->default_material;
}

// Turns the text into the first file.
static bool finish(struct exporting *e, const char *ending)
{
    struct lam_export *out = e->out;
    lam_bytes bytes = {e->text.bytes, e->text.length};
    if (e->text.failed) {
        if (e->error)
            *e->error = e->text.error;
        return false;
    }
    e->text.bytes = NULL;
    char dotted[16];
    snprintf(dotted, sizeof dotted, ".%s", ending);
    if (!export_add_file(e, dotted, bytes))
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
    if (!scene || !format) {
        fail(error, LAM_BAD_ARGUMENT, "lam_scene_export: %s is NULL", scene ? "format" : "scene");
        return NULL;
    }
    if (!check_reserved("lam_export_params", params, error))
        return NULL;
    const struct exporter *exporter = exporter_find(format, format, error);
    if (!exporter)
        return NULL;
    if (params->thumbnail && exporter != &exporter_glb) {
        fail(error, LAM_BAD_ARGUMENT, "lam_scene_export: found a thumbnail, and .%s has none; expected .glb", format);
        return NULL;
    }
    struct arena arena;
    arena_start(&arena, NULL);
    struct lam_export *out = arena_alloc_zeroed(&arena, sizeof *out);
    if (!out) {
        fail_memory(error, sizeof *out);
        return NULL;
    }
    out->arena = arena;
    struct exporting e = {.scene = scene,
                          .params = params,
                          .name = params->name ? params->name : "model",
                          .arena = &out->arena,
                          .out = out,
                          .from = lam_scene_up(scene),
                          .to = exporter->up,
                          .error = error};
    bool ok = (!exporter->flat || export_flatten(&e)) && exporter->write(&e) && finish(&e, format);
    free(e.text.bytes);
    if (ok)
        return out;
    lam_export_free(out);
    return NULL;
}
