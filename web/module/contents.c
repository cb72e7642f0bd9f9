// contents.c: lists the objects, materials, animations and measures of a model for the page.
#include "contents.h"

static void write_part(struct json *json, const lam_part *part)
{
    json_put(json, OBJECT(NULL, TEXT("name", part->name), COUNT("triangles", part->triangle_count),
                          NUMBER("material", part->material)));
}

static void write_object(struct json *json, const lam_scene *scene, int index)
{
    const lam_object *object = lam_scene_object(scene, index);
    const lam_mesh *mesh = lam_scene_mesh(scene, object->mesh);
    json_open(json, NULL, '{');
    json_put(json, TEXT("name", object->name), COUNT("triangles", mesh->triangle_count),
             NUMBER("material", object->material));
    json_open(json, "parts", '[');
    for (uint32_t i = 0; mesh->parts && i < mesh->part_count && i < CONTENTS_MOST; i++)
        write_part(json, &mesh->parts[i]);
    json_close(json, ']');
    json_close(json, '}');
}

static void write_material(struct json *json, const lam_material *m)
{
    json_open(json, NULL, '{');
    json_put(json, TEXT("name", m->name), FLAG("physical", m->physical), COLOR("color", m->diffuse),
             NUMBER("opacity", m->diffuse.a));
    if (m->physical) {
        json_put(json, NUMBER("metallic", m->metallic), NUMBER("roughness", m->roughness));
    } else {
        json_number(json, "shininess", (double)m->shininess);
    }
    json_open(json, "maps", '[');
    for (int map = 0; map < LAM_MAP_COUNT; map++)
        if (m->maps[map])
            json_text(json, NULL, lam_map_name((lam_map)map));
    json_close(json, ']');
    json_close(json, '}');
}

static void write_file(struct json *json, const lam_scene *scene)
{
    const lam_file_info *file = lam_scene_file_info(scene);
    json_number(json, "unit_m", file->unit_m);
    json_open(json, "animations", '[');
    for (int i = 0; i < file->animation_count; i++) {
        json_put(json,
                 OBJECT(NULL, TEXT("name", file->animations[i].name), NUMBER("seconds", file->animations[i].length_s)));
    }
    json_close(json, ']');
    json_open(json, "variants", '[');
    for (int i = 0; i < file->variant_count; i++)
        json_text(json, NULL, file->variants[i]);
    json_close(json, ']');
    json_open(json, "cameras", '[');
    for (int i = 0; i < lam_scene_camera_count(scene); i++)
        json_text(json, NULL, lam_scene_camera_name(scene, i));
    json_close(json, ']');
}

void contents_json(struct json *json, const lam_scene *scene)
{
    int objects = lam_scene_object_count(scene), materials = lam_scene_material_count(scene);
    lam_vec3 low, high;
    lam_scene_bounds(scene, &low, &high);
    json_put(json, NUMBERS("size", 3, high.x - low.x, high.y - low.y, high.z - low.z),
             COUNT("triangles", lam_scene_triangle_count(scene)), COUNT("vertices", lam_scene_vertex_count(scene)),
             COUNT("object_count", objects), COUNT("material_count", materials));
    json_open(json, "objects", '[');
    for (int i = 0; i < objects && i < CONTENTS_MOST; i++)
        write_object(json, scene, i);
    json_close(json, ']');
    json_open(json, "materials", '[');
    for (int i = 0; i < materials && i < CONTENTS_MOST; i++)
        write_material(json, lam_scene_material(scene, i));
    json_close(json, ']');
    write_file(json, scene);
}
