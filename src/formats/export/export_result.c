// export_result.c: the result of an export: its files, and a sentence for each loss.
#include "export.h"

#include "fail.h"

#include <lambent/material.h>

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- the call

bool export_no_memory(struct exporting *e, size_t bytes) { return call_memory_error(e->call, bytes, e->error); }

void *export_memory(struct exporting *e, size_t bytes)
{
    if (e->call && !call_charge(e->call, bytes))
        return NULL;
    void *memory = malloc(bytes ? bytes : 1);
    if (!memory && e->call)
        call_refund(e->call, bytes);
    return memory;
}

void export_memory_free(struct exporting *e, void *memory, size_t bytes)
{
    if (memory && e->call)
        call_refund(e->call, bytes);
    free(memory);
}

bool export_asks(struct exporting *e)
{
    e->stopped |= !call_should_continue(e->call);
    return !e->stopped;
}

bool export_is_whole(struct exporting *e) { return export_asks(e) || call_error(e->call, e->error); }

bool export_text_is_whole(struct exporting *e, const struct text *text)
{
    if (text->failed && e->error)
        *e->error = text->error;
    return !text->failed;
}

// --- losses

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
        scene_list_append(&e->out->losses, &text, sizeof text, &e->out->arena);
}

void export_lose_surroundings(struct exporting *e, bool has_lights_and_cameras)
{
    const struct lam_scene *s = e->scene;
    if (!s)
        return;
    if (!has_lights_and_cameras && s->lights.count)
        export_lose(e, "lights are omitted (%d): the format does not support them", s->lights.count);
    if (!has_lights_and_cameras && (s->cameras.count || e->params->camera))
        export_lose(e, "cameras are omitted (%d): the format does not support them",
                    s->cameras.count + (e->params->camera != NULL));
    if (s->environment)
        export_lose(e, "the environment is omitted: the format does not support it");
    if (s->ambient.r > 0 || s->ambient.g > 0 || s->ambient.b > 0)
        export_lose(e, "the ambient light is omitted: the format does not support it");
    if (s->file.animation_count)
        export_lose(e, "animations are omitted (%d): the file contains the pose that was read",
                    s->file.animation_count);
    if (s->file.variant_count)
        export_lose(e, "variants of materials are omitted (%d): the file contains the variant that was read",
                    s->file.variant_count);
}

void export_lose_objects(struct exporting *e, const char *reason)
{
    int names = 0;
    const char *last = NULL;
    for (int kind = 0; kind < EXPORT_KINDS; kind++)
        for (uint32_t i = 0; i < e->flat[kind].part_count; i++) {
            const char *name = e->flat[kind].parts[i].name;
            names += name && name != last;
            last = name;
        }
    if (e->scene->objects.count > 1)
        export_lose(e, "objects become one mesh (%d): %s", e->scene->objects.count, reason);
    else if (names > 1)
        export_lose(e, "names of parts are omitted (%d): %s", names, reason);
}

void export_lose_digits(struct exporting *e, const lam_mesh *mesh)
{
    if (mesh->origin[0] != 0 || mesh->origin[1] != 0 || mesh->origin[2] != 0)
        export_lose(e, "coordinates far from zero are rounded to floats");
}

bool export_has_usual_normals(const struct exporting *e)
{
    const struct scene_origin *origins = e->scene->origins.items;
    const char *format = e->scene->format;
    bool usual = format && (strcmp(format, "stl") == 0 || strcmp(format, "3mf") == 0);
    for (int i = 0; i < e->scene->origins.count; i++)
        usual &= origins[i].normals != LAM_NORMALS_FACET && origins[i].crease_angle_rad == 0;
    return usual;
}

// --- files

// OBJ and MTL files name other files without quotes. A name must not begin with a space or a '-', and must not contain
// a backslash, a control character, or bytes that are not UTF-8. Such characters become _.
static void make_nameable(char *stem)
{
    if (*stem == ' ' || *stem == '-')
        *stem = '_';
    for (char *c = stem; *c;) {
        int length = lam_utf8_length(c, strlen(c));
        if (length == 0 || (unsigned char)*c < ' ' || *c == 0x7f || *c == '\\')
            *c = '_';
        c += length > 0 ? length : 1;
    }
}

const char *export_add_file(struct exporting *e, const char *ending, bool beside, lam_bytes bytes)
{
    const char *dot = strrchr(e->name, '.');
    size_t stem = dot ? (size_t)(dot - e->name) : strlen(e->name), length = stem + strlen(ending) + 1;
    struct export_file file = {arena_alloc(e->arena, length), bytes};
    if (file.name)
        snprintf(file.name, length, "%.*s", (int)stem, e->name);
    if (file.name && beside)
        make_nameable(file.name);
    if (file.name)
        strcat(file.name, ending);
    // the model's own text already counts towards the memory limit
    bool charged = !beside || !e->call || call_charge(e->call, bytes.size);
    if (charged && file.name && scene_list_append(&e->out->files, &file, sizeof file, &e->out->arena))
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
    struct arena arena = result->arena; // a copy, because the arena contains `result` itself
    arena_free(&arena);
}

bool export_is_white(const lam_material *m)
{
    const lam_rgb e = m->emission;
    return !m->name && !m->physical && !m->unlit && m->diffuse.r == 1 && m->diffuse.g == 1 && m->diffuse.b == 1 &&
           m->diffuse.a == 1 && e.r == 0 && e.g == 0 && e.b == 0 && !m->maps[LAM_MAP_DIFFUSE];
}

int export_material_count(const struct exporting *e)
{
    int count = 0;
    for (int i = 0; i < e->scene->materials.count; i++)
        count += !export_is_white(export_material(e, i));
    return count;
}

const lam_material *export_material(const struct exporting *e, int index)
{
    const struct lam_scene *s = e->scene;
    return index >= 0 && index < s->materials.count ? (const lam_material *)s->materials.items + index
                                                    : s->default_material;
}
