// info_json.c: prints a model on one line in the format of docs/info.schema.json.
#include "info.h"

#include <math.h>
#include <stdlib.h>

#include <lambent/light.h>
#include <lambent/material.h>

#include "json.h"
#include "report.h"
#include "vectors.h"

// Returns the number with the fewest digits that parse to the same float.
static double shortest(float value)
{
    char text[32];
    shortest_float(value, text);
    return strtod(text, NULL);
}

#define FLOATS(key, c)  NUMBERS(key, 3, shortest((c).r), shortest((c).g), shortest((c).b))
#define KNOWN(known, x) ((known) ? (x) : (double)NAN)

static void write_geometry(struct json *json, const struct info *info)
{
    const struct job *job = info->job;
    const lam_scene *scene = job->scene;
    struct info_counts stored = info_count(scene);
    struct info_unit unit = info_unit(scene);
    struct info_measure measure = info_measure(scene);
    lam_vec3 low, high;
    lam_scene_bounds(scene, &low, &high);
    const lam_vec3 size = {high.x - low.x, high.y - low.y, high.z - low.z};
    const double mm = unit.millimetres, mm2 = mm * mm;
    const bool known = mm > 0;
    json_put(json,
             OBJECT("counts", COUNT("triangles", lam_scene_triangle_count(scene)),
                    COUNT("lines", lam_scene_line_count(scene)), COUNT("points", lam_scene_point_count(scene)),
                    COUNT("vertices", lam_scene_vertex_count(scene)), COUNT("objects", lam_scene_object_count(scene)),
                    COUNT("meshes", lam_scene_mesh_count(scene)), COUNT("parts", stored.parts),
                    COUNT("stored_triangles", stored.triangles), COUNT("stored_vertices", stored.vertices)),
             TEXT("up", lam_up_name(lam_scene_up(scene))), TEXT("unit", unit.name),
             OBJECT("bounds", VECTOR("min", low), VECTOR("max", high)), VECTOR("size", size));
    json_open(json, "measure", '{');
    json_put(json, FLAG("closed", measure.closed), FLAG("exact", measure.exact), NUMBER("area", measure.area),
             NUMBER("volume", KNOWN(measure.closed, measure.volume)));
    if (known)
        json_put(json, NUMBERS("size_mm", 3, size.x * mm, size.y * mm, size.z * mm));
    else
        json_put(json, NONE("size_mm"));
    json_put(json, NUMBER("area_mm2", KNOWN(known, measure.area * mm2)),
             NUMBER("volume_mm3", KNOWN(known && measure.closed, measure.volume * mm2 * mm)));
    json_close(json, '}');
    if (info->print) {
        const struct info_print *p = info->print;
        json_open(json, "print", '{');
        json_put(json, FLAG("printable", p->printable), COUNT("holes", p->holes), COUNT("open_edges", p->open_edges),
                 COUNT("shared_edges", p->shared_edges), COUNT("turned_edges", p->turned_edges),
                 NUMBER("volume", p->volume), NUMBER("overhang_degrees", p->overhang_deg),
                 NUMBER("overhang_area", p->overhang_area));
        if (p->printable)
            json_put(json, VECTOR("center_of_mass", p->mass));
        else
            json_put(json, NONE("center_of_mass"));
        json_open(json, "longest_holes", '[');
        for (int i = 0; i < p->holes && i < INFO_HOLES; i++)
            json_put(json, OBJECT(NULL, VECTOR("middle", p->longest[i].middle), NUMBER("length", p->longest[i].length),
                                  COUNT("edges", p->longest[i].edges)));
        json_close(json, ']');
        json_close(json, '}');
    }
    json_open(json, "sections", '[');
    for (int i = 0; i < info->section_count; i++) {
        const lam_section *s = &info->sections[i];
        json_put(json, OBJECT(NULL, VECTOR("normal", s->normal), NUMBER("distance", s->distance),
                              FLAG("relative", s->relative), NUMBER("area", info->section_areas[i]),
                              NUMBER("area_mm2", KNOWN(known, info->section_areas[i] * mm2))));
    }
    json_close(json, ']');
}

static void write_material(struct json *json, const lam_material *m, const struct info_textures *textures,
                           const char *model)
{
    json_open(json, NULL, '{');
    json_put(json, TEXT("name", m->name), TEXT("kind", info_material_kind(m)),
             FLOATS(m->physical ? "base" : "diffuse", m->diffuse), NUMBER("opacity", shortest(m->diffuse.a)),
             FLOATS("emission", m->emission));
    if (m->physical)
        json_put(json, NUMBER("metallic", shortest(m->metallic)), NUMBER("roughness", shortest(m->roughness)));
    else
        json_put(json, FLOATS("ambient", m->ambient), FLOATS("specular", m->specular),
                 NUMBER("shininess", shortest(m->shininess)));
    json_put(json, TEXT("alpha_mode", info_alpha_mode(m)));
    if (m->alpha_mode == LAM_ALPHA_MASK)
        json_put(json, NUMBER("alpha_cutoff", shortest(m->alpha_cutoff)));
    json_open(json, "fields", '{');
    for (int i = 0; lam_material_field(i); i++) {
        double numbers[4];
        int count = info_changed_field(lam_material_field(i), m, numbers);
        if (count && lam_material_field(i)->type == LAM_FIELD_FLAG)
            json_put(json, FLAG(lam_material_field(i)->key, true));
        else if (count == 3)
            json_numbers(json, lam_material_field(i)->key, numbers, 3);
        else if (count)
            json_number(json, lam_material_field(i)->key, numbers[0]);
    }
    json_close(json, '}');
    json_open(json, "maps", '[');
    for (int map = 0; map < LAM_MAP_COUNT; map++) {
        int texture = info_texture_find(textures, m->maps[map] ? m->maps[map]->texture : NULL);
        const char *name = m->map_names[map];
        if (name || texture >= 0)
            json_put(json, OBJECT(NULL, TEXT("slot", lam_map_name((lam_map)map)),
                                  TEXT("file", name ? name : info_texture_file(&textures->items[texture], model)),
                                  INDEX("texture", texture)));
    }
    json_close(json, ']');
    json_close(json, '}');
}

static void write_texture(struct json *json, const struct info_texture *texture, const char *model)
{
    json_open(json, NULL, '{');
    json_put(json, TEXT("name", texture->image ? texture->image->name : NULL),
             TEXT("file", info_texture_file(texture, model)), TEXT("format", info_texture_format(texture)),
             TEXT("color_space", info_color_space(texture)), COUNT("width", lam_texture_width(texture->texture, 0)),
             COUNT("height", lam_texture_height(texture->texture, 0)),
             COUNT("memory_bytes", lam_texture_memory(texture->texture)));
    json_open(json, "slots", '[');
    for (int map = 0; map < LAM_MAP_COUNT; map++)
        if (texture->slots >> map & 1)
            json_text(json, NULL, lam_map_name((lam_map)map));
    json_close(json, ']');
    json_close(json, '}');
}

static void write_light(struct json *json, const lam_light *light)
{
    double intensity;
    lam_rgb color = info_light_color(light, &intensity);
    json_open(json, NULL, '{');
    json_put(json, TEXT("name", light->name), TEXT("kind", lam_light_type_describe(light->type)->word),
             FLOATS("color", color), NUMBER("intensity", shortest((float)intensity)));
    if (light->type == LAM_LIGHT_POINT || light->type == LAM_LIGHT_SPOT)
        json_put(json, VECTOR("position", light->position));
    if (light->type == LAM_LIGHT_DIRECTIONAL || light->type == LAM_LIGHT_SPOT)
        json_put(json, VECTOR("direction", light->direction));
    if (light->range > 0)
        json_put(json, NUMBER("range", shortest(light->range)));
    json_close(json, '}');
}

static void write_camera(struct json *json, const lam_scene *scene, int index)
{
    lam_camera camera;
    lam_scene_camera(scene, index, &camera);
    const bool flat = camera.ortho_half_height > 0;
    json_put(json, OBJECT(NULL, TEXT("name", lam_scene_camera_name(scene, index)), VECTOR("eye", camera.eye),
                          VECTOR("target", camera.target),
                          NUMBER(flat ? "ortho_half_height" : "fovy_deg",
                                 flat ? camera.ortho_half_height : in_degrees(camera.fovy_rad))));
}

static void write_file(struct json *json, const lam_file_info *info)
{
    json_open(json, "scenes", '[');
    for (int i = 0; i < info->scene_count; i++)
        json_put(json, OBJECT(NULL, TEXT("name", info->scenes[i]), FLAG("read", i == info->scene)));
    json_close(json, ']');
    json_open(json, "animations", '[');
    for (int i = 0; i < info->animation_count; i++)
        json_put(json,
                 OBJECT(NULL, TEXT("name", info->animations[i].name), NUMBER("seconds", info->animations[i].length_s),
                        COUNT("channels", info->animations[i].channel_count)));
    json_close(json, ']');
    json_open(json, "variants", '[');
    for (int i = 0; i < info->variant_count; i++)
        json_text(json, NULL, info->variants[i]);
    json_close(json, ']');
    json_open(json, "extensions", '[');
    for (int i = 0; i < info->extension_count; i++)
        json_put(json,
                 OBJECT(NULL, TEXT("name", info->extensions[i].name), FLAG("required", info->extensions[i].required),
                        TEXT("support", info_support(info->extensions[i].support))));
    json_close(json, ']');
}

static void write_model(struct json *json, const struct info *info)
{
    const struct job *job = info->job;
    const lam_scene *scene = job->scene;
    const lam_file_info *file = lam_scene_file_info(scene);
    json_put(json, TEXT("format", info_format(scene)), TEXT("version", file->version),
             TEXT("generator", file->generator), TEXT("copyright", file->copyright));
    write_geometry(json, info);
    json_open(json, "names", '[');
    for (int i = 0; i < info->names->count; i++)
        json_put(json,
                 OBJECT(NULL, TEXT("name", info->names->items[i].name), COUNT("objects", info->names->items[i].objects),
                        COUNT("parts", info->names->items[i].parts), COUNT("groups", info->names->items[i].groups)));
    json_close(json, ']');
    json_open(json, "materials", '[');
    for (int i = 0; i < lam_scene_material_count(scene); i++)
        write_material(json, lam_scene_material(scene, i), info->textures, job->model);
    json_close(json, ']');
    json_open(json, "textures", '[');
    for (int i = 0; i < info->textures->count; i++)
        write_texture(json, &info->textures->items[i], job->model);
    json_close(json, ']');
    json_open(json, "lights", '[');
    for (int i = 0; i < lam_scene_light_count(scene); i++)
        write_light(json, lam_scene_light(scene, i));
    json_close(json, ']');
    json_open(json, "cameras", '[');
    for (int i = 0; i < lam_scene_camera_count(scene); i++)
        write_camera(json, scene, i);
    json_close(json, ']');
    write_file(json, file);
    json_put(json, FLAG("needs_lenient", info->needs_lenient), COUNT("memory_bytes", lam_scene_memory(scene)));
    if (lam_scene_file_info(scene)->reader_memory)
        json_put(json, COUNT("reader_memory_bytes", lam_scene_file_info(scene)->reader_memory));
    if (info->drawing_bytes)
        json_put(json, OBJECT("drawing", COUNT("memory_bytes", info->drawing_bytes), COUNT("width", INFO_SIDE),
                              COUNT("height", INFO_SIDE), COUNT("threads", info->drawing_threads)));
    else
        json_put(json, NONE("drawing"));
    json_put(json,
             OBJECT("times_ms", MILLISECONDS("read", job->times.read), MILLISECONDS("prepare", job->times.prepare)));
}

void info_json(const struct info *info)
{
    struct json json = {.file = stdout};
    const struct job *job = info->job;
    json_open(&json, NULL, '{');
    json_put(&json, TEXT("lambent", lam_version()), TEXT("path", job->model));
    if (!info->error->code)
        write_model(&json, info);
    json_warnings(&json, job->scene);
    json_error(&json, info->error);
    json_close(&json, '}');
    putchar('\n');
}
