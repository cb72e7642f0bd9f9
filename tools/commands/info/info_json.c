// info_json.c: prints a model on one line in the format of docs/info.schema.json.
#include "info.h"

#include <stdlib.h>

#include <lambent/light.h>
#include <lambent/material.h>

#include "json.h"
#include "report.h"
#include "vectors.h"

// Writes the shortest number that parses to the same float.
static void json_float(struct json *json, const char *key, float value)
{
    char text[32];
    shortest_float(value, text);
    json_number(json, key, strtod(text, NULL));
}

static void json_color(struct json *json, const char *key, lam_rgb c)
{
    json_open(json, key, '[');
    json_float(json, NULL, c.r);
    json_float(json, NULL, c.g);
    json_float(json, NULL, c.b);
    json_close(json, ']');
}

// Writes `value`, or null if the value is unknown.
static void json_number_if(struct json *json, const char *key, bool known, double value)
{
    if (known)
        json_number(json, key, value);
    else
        json_none(json, key);
}

static void write_measure(struct json *json, const lam_scene *scene, lam_vec3 size, double millimetres)
{
    struct info_measure measure = info_measure(scene);
    double mm = millimetres, mm2 = mm * mm;
    bool known = mm > 0;
    json_open(json, "measure", '{');
    json_flag(json, "closed", measure.closed);
    json_number(json, "area", measure.area);
    json_number_if(json, "volume", measure.closed, measure.volume);
    if (known)
        json_vector(json, "size_mm", (lam_vec3){size.x * mm, size.y * mm, size.z * mm});
    else
        json_none(json, "size_mm");
    json_number_if(json, "area_mm2", known, measure.area * mm2);
    json_number_if(json, "volume_mm3", known && measure.closed, measure.volume * mm2 * mm);
    json_close(json, '}');
}

static void write_geometry(struct json *json, const struct job *job)
{
    const lam_scene *scene = job->scene;
    struct info_counts stored = info_count(scene);
    lam_vec3 low, high;
    lam_scene_bounds(scene, &low, &high);
    json_open(json, "counts", '{');
    json_count(json, "triangles", lam_scene_triangle_count(scene));
    json_count(json, "lines", lam_scene_line_count(scene));
    json_count(json, "points", lam_scene_point_count(scene));
    json_count(json, "vertices", lam_scene_vertex_count(scene));
    json_count(json, "objects", (uint64_t)lam_scene_object_count(scene));
    json_count(json, "meshes", (uint64_t)lam_scene_mesh_count(scene));
    json_count(json, "parts", stored.parts);
    json_count(json, "stored_triangles", stored.triangles);
    json_count(json, "stored_vertices", stored.vertices);
    json_close(json, '}');
    json_text(json, "up", lam_up_name(lam_scene_up(scene)));
    struct info_unit unit = info_unit(scene);
    json_text(json, "unit", unit.name);
    json_open(json, "bounds", '{');
    json_vector(json, "min", low);
    json_vector(json, "max", high);
    json_close(json, '}');
    lam_vec3 size = {high.x - low.x, high.y - low.y, high.z - low.z};
    json_vector(json, "size", size);
    write_measure(json, scene, size, unit.millimetres);
}

static void write_material(struct json *json, const lam_material *m, const struct info_textures *textures,
                           const char *model)
{
    json_open(json, NULL, '{');
    json_text(json, "name", m->name);
    json_text(json, "kind", info_material_kind(m));
    json_color(json, m->physical ? "base" : "diffuse", (lam_rgb){m->diffuse.r, m->diffuse.g, m->diffuse.b});
    json_float(json, "opacity", m->diffuse.a);
    json_color(json, "emission", m->emission);
    if (m->physical) {
        json_float(json, "metallic", m->metallic);
        json_float(json, "roughness", m->roughness);
    } else {
        json_color(json, "ambient", m->ambient);
        json_color(json, "specular", m->specular);
        json_float(json, "shininess", m->shininess);
    }
    json_text(json, "alpha_mode", info_alpha_mode(m));
    if (m->alpha_mode == LAM_ALPHA_MASK)
        json_float(json, "alpha_cutoff", m->alpha_cutoff);
    json_open(json, "fields", '{');
    for (int i = 0; lam_material_field(i); i++) {
        double numbers[4];
        int count = info_changed_field(lam_material_field(i), m, numbers);
        if (count && lam_material_field(i)->type == LAM_FIELD_FLAG)
            json_flag(json, lam_material_field(i)->key, true);
        else if (count == 3)
            json_vector(json, lam_material_field(i)->key, (lam_vec3){numbers[0], numbers[1], numbers[2]});
        else if (count)
            json_number(json, lam_material_field(i)->key, numbers[0]);
    }
    json_close(json, '}');
    json_open(json, "maps", '[');
    for (int map = 0; map < LAM_MAP_COUNT; map++) {
        int texture = info_texture_find(textures, m->maps[map] ? m->maps[map]->texture : NULL);
        if (!m->map_names[map] && texture < 0)
            continue;
        json_open(json, NULL, '{');
        json_text(json, "slot", lam_map_name((lam_map)map));
        json_text(json, "file",
                  m->map_names[map] ? m->map_names[map] : info_texture_file(&textures->items[texture], model));
        if (texture >= 0)
            json_count(json, "texture", (uint64_t)texture);
        else
            json_none(json, "texture");
        json_close(json, '}');
    }
    json_close(json, ']');
    json_close(json, '}');
}

static void write_texture(struct json *json, const struct info_texture *texture, const char *model)
{
    json_open(json, NULL, '{');
    json_text(json, "name", texture->image ? texture->image->name : NULL);
    json_text(json, "file", info_texture_file(texture, model));
    json_text(json, "format", info_texture_format(texture));
    json_text(json, "color_space", info_color_space(texture));
    json_count(json, "width", (uint64_t)lam_texture_width(texture->texture, 0));
    json_count(json, "height", (uint64_t)lam_texture_height(texture->texture, 0));
    json_count(json, "memory_bytes", lam_texture_memory(texture->texture));
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
    json_text(json, "name", light->name);
    json_text(json, "kind", lam_light_type_describe(light->type)->word);
    json_color(json, "color", color);
    json_float(json, "intensity", (float)intensity);
    if (light->type == LAM_LIGHT_POINT || light->type == LAM_LIGHT_SPOT)
        json_vector(json, "position", light->position);
    if (light->type == LAM_LIGHT_DIRECTIONAL || light->type == LAM_LIGHT_SPOT)
        json_vector(json, "direction", light->direction);
    if (light->range > 0)
        json_float(json, "range", light->range);
    json_close(json, '}');
}

static void write_camera(struct json *json, const lam_scene *scene, int index)
{
    lam_camera camera;
    lam_scene_camera(scene, index, &camera);
    json_open(json, NULL, '{');
    json_text(json, "name", lam_scene_camera_name(scene, index));
    json_vector(json, "eye", camera.eye);
    json_vector(json, "target", camera.target);
    if (camera.ortho_half_height > 0)
        json_number(json, "ortho_half_height", camera.ortho_half_height);
    else
        json_number(json, "fovy_deg", in_degrees(camera.fovy_rad));
    json_close(json, '}');
}

static void write_file(struct json *json, const lam_file_info *info)
{
    json_open(json, "scenes", '[');
    for (int i = 0; i < info->scene_count; i++) {
        json_open(json, NULL, '{');
        json_text(json, "name", info->scenes[i]);
        json_flag(json, "read", i == info->scene);
        json_close(json, '}');
    }
    json_close(json, ']');
    json_open(json, "animations", '[');
    for (int i = 0; i < info->animation_count; i++) {
        json_open(json, NULL, '{');
        json_text(json, "name", info->animations[i].name);
        json_number(json, "seconds", info->animations[i].length_s);
        json_count(json, "channels", (uint64_t)info->animations[i].channel_count);
        json_close(json, '}');
    }
    json_close(json, ']');
    json_open(json, "variants", '[');
    for (int i = 0; i < info->variant_count; i++)
        json_text(json, NULL, info->variants[i]);
    json_close(json, ']');
    json_open(json, "extensions", '[');
    for (int i = 0; i < info->extension_count; i++) {
        json_open(json, NULL, '{');
        json_text(json, "name", info->extensions[i].name);
        json_flag(json, "required", info->extensions[i].required);
        json_text(json, "support", info_support(info->extensions[i].support));
        json_close(json, '}');
    }
    json_close(json, ']');
}

static void write_model(struct json *json, const struct info *info)
{
    const struct job *job = info->job;
    const lam_scene *scene = job->scene;
    const lam_file_info *file = lam_scene_file_info(scene);
    json_text(json, "format", info_format(scene));
    json_text(json, "version", file->version);
    json_text(json, "generator", file->generator);
    json_text(json, "copyright", file->copyright);
    write_geometry(json, job);
    json_open(json, "names", '[');
    for (int i = 0; i < info->names->count; i++) {
        json_open(json, NULL, '{');
        json_text(json, "name", info->names->items[i].name);
        json_count(json, "objects", (uint64_t)info->names->items[i].objects);
        json_count(json, "parts", (uint64_t)info->names->items[i].parts);
        json_close(json, '}');
    }
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
    json_flag(json, "needs_lenient", info->needs_lenient);
    json_count(json, "memory_bytes", lam_scene_memory(scene));
    if (info->drawing_bytes) {
        json_open(json, "drawing", '{');
        json_count(json, "memory_bytes", info->drawing_bytes);
        json_count(json, "width", INFO_SIDE);
        json_count(json, "height", INFO_SIDE);
        json_count(json, "threads", (uint64_t)info->drawing_threads);
        json_close(json, '}');
    } else {
        json_none(json, "drawing");
    }
    json_open(json, "times_ms", '{');
    json_number(json, "read", (double)(int64_t)(job->times.read * 1e3 + 0.5) / 1e3);
    json_number(json, "prepare", (double)(int64_t)(job->times.prepare * 1e3 + 0.5) / 1e3);
    json_close(json, '}');
}

void info_json(const struct info *info)
{
    struct json json = {.file = stdout};
    const struct job *job = info->job;
    json_open(&json, NULL, '{');
    json_text(&json, "lambent", lam_version());
    json_text(&json, "path", job->model);
    if (!info->error->code)
        write_model(&json, info);
    json_open(&json, "warnings", '[');
    for (int i = 0; job->scene && lam_scene_warning(job->scene, i); i++)
        json_message(&json, NULL, lam_scene_warning(job->scene, i));
    json_close(&json, ']');
    json_error(&json, info->error);
    json_close(&json, '}');
    putchar('\n');
}
