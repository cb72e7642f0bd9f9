// scene_add.c: public functions that add something to a scene or change the scene. These functions check and copy their
// arguments.
#include "scene_internal.h"

#include "fail.h"
#include "fields.h"
#include "float_state.h"
#include "linear.h"
#include "normals.h"

#include <lambent/light.h>
#include <lambent/material.h>

#include <stdio.h>
#include <string.h>

static bool finite_floats(const float *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!(numbers[i] - numbers[i] == 0))
            return false;
    return true;
}

static bool indices_below(const uint32_t *indices, size_t count, uint32_t limit)
{
    for (size_t i = 0; i < count; i++)
        if (indices[i] >= limit)
            return false;
    return true;
}

// Checks the values and the indices of a mesh's attribute. If `own` is NULL, the attribute uses the indices of the
// positions.
static bool check_attribute(const char *name, const float *values, uint32_t count, int width, const uint32_t *own,
                            const lam_mesh *mesh, lam_error *error)
{
    size_t corners = mesh_corners(mesh);
    if (!values)
        return true;
    if (!finite_floats(values, (size_t)count * (size_t)width))
        return fail(error, LAM_BAD_ARGUMENT, "mesh: %s contain a number that is not finite", name);
    if (own ? !indices_below(own, corners, count) : count < (mesh->indices ? mesh->vertex_count : corners))
        return fail(error, LAM_BAD_ARGUMENT, "mesh: a corner's index of %s is not below their count, %u", name, count);
    return true;
}

// Returns the noun that messages use for the items of a mesh.
static const char *items_word(const lam_mesh *mesh)
{
    return mesh->line_count ? "lines" : mesh->point_count ? "points" : "triangles";
}

static bool check_colors(const lam_mesh *mesh, lam_error *error)
{
    if (!mesh->colors)
        return true;
    if (mesh->colors_format < LAM_COLORS_SRGB8 || mesh->colors_format > LAM_COLORS_LINEAR_F32)
        return fail(error, LAM_BAD_ARGUMENT, "mesh: colors are given, but colors_format is %d", mesh->colors_format);
    const float *as_floats = mesh->colors_format == LAM_COLORS_LINEAR_F32 ? mesh->colors : NULL;
    if (as_floats && !finite_floats(as_floats, (size_t)mesh->color_count * 4))
        return fail(error, LAM_BAD_ARGUMENT, "mesh: colors contain a number that is not finite");
    size_t corners = mesh_corners(mesh);
    size_t needed = mesh->colors_rate == LAM_PER_TRIANGLE ? mesh_items(mesh)
                    : mesh->indices                       ? mesh->vertex_count
                                                          : corners;
    bool by_index = mesh->color_indices && mesh->colors_rate == LAM_PER_VERTEX;
    if (by_index ? !indices_below(mesh->color_indices, corners, mesh->color_count) : mesh->color_count < needed)
        return fail(error, LAM_BAD_ARGUMENT, "mesh: a corner's index of colors is not below their count, %u",
                    mesh->color_count);
    return true;
}

static bool check_parts(const struct lam_scene *scene, const lam_mesh *mesh, lam_error *error)
{
    if (mesh->part_count && !mesh->parts)
        return fail(error, LAM_BAD_ARGUMENT, "mesh: part_count is %u, but parts is NULL", mesh->part_count);
    uint64_t next = 0;
    for (uint32_t i = 0; i < mesh->part_count; i++) {
        const lam_part *part = &mesh->parts[i];
        if (!check_reserved("part", part, error))
            return false;
        if (part->first_triangle != next)
            return fail(error, LAM_BAD_ARGUMENT, "mesh: part %u starts at triangle %u, expected %llu", i,
                        part->first_triangle, (unsigned long long)next);
        next += part->triangle_count;
        if (part->material >= scene->materials.count)
            return fail(error, LAM_BAD_ARGUMENT, "mesh: part %u names material %d of %d", i, part->material,
                        scene->materials.count);
    }
    if (mesh->part_count && next != mesh_items(mesh))
        return fail(error, LAM_BAD_ARGUMENT, "mesh: the parts cover %llu of %u %s", (unsigned long long)next,
                    mesh_items(mesh), items_word(mesh));
    return true;
}

static bool check_mesh(const struct lam_scene *scene, const lam_mesh *mesh, lam_error *error)
{
    if (!check_reserved("mesh", mesh, error))
        return false;
    size_t corners = mesh_corners(mesh);
    const char *items = items_word(mesh);
    if ((mesh->triangle_count != 0) + (mesh->line_count != 0) + (mesh->point_count != 0) > 1)
        return fail(error, LAM_BAD_ARGUMENT, "mesh: %u triangles, %u lines and %u points, expected one kind",
                    mesh->triangle_count, mesh->line_count, mesh->point_count);
    if (corners > UINT32_MAX)
        return fail(error, LAM_LIMIT, "mesh: %u %s, expected at most %u", mesh_items(mesh), items,
                    UINT32_MAX / (mesh->line_count ? 2 : 3));
    if (!mesh->positions && corners)
        return fail(error, LAM_BAD_ARGUMENT, "mesh: positions are NULL");
    if (!math_finite(mesh->origin[0]) || !math_finite(mesh->origin[1]) || !math_finite(mesh->origin[2]))
        return fail(error, LAM_BAD_ARGUMENT, "mesh: the origin is not finite");
    if (mesh->indices && !indices_below(mesh->indices, corners, mesh->vertex_count))
        return fail(error, LAM_BAD_ARGUMENT, "mesh: an index is not below vertex_count, %u", mesh->vertex_count);
    if (!mesh->indices && corners > mesh->vertex_count)
        return fail(error, LAM_BAD_ARGUMENT, "mesh: %u %s without indices need %zu vertices, found %u",
                    mesh_items(mesh), items, corners, mesh->vertex_count);
    if (mesh->positions && !finite_floats(mesh->positions, (size_t)mesh->vertex_count * 3))
        return fail(error, LAM_BAD_ARGUMENT, "mesh: positions contain a number that is not finite");
    if (!check_attribute("normals", mesh->normals, mesh->normal_count, 3, mesh->normal_indices, mesh, error) ||
        !check_attribute("texcoords", mesh->texcoords, mesh->texcoord_count, 2, mesh->texcoord_indices, mesh, error) ||
        !check_attribute("second_texcoords", mesh->second_texcoords, mesh->second_texcoord_count, 2,
                         mesh->second_texcoord_indices, mesh, error) ||
        !check_attribute("tangents", mesh->tangents, mesh->tangent_count, 4, mesh->tangent_indices, mesh, error))
        return false;
    return check_colors(mesh, error) && check_parts(scene, mesh, error);
}

// Replaces *pointer with a copy in the scene's arena.
static bool copy_array(struct lam_scene *scene, const void *pointer, size_t count, size_t size)
{
    const void **target = (const void **)(uintptr_t)pointer;
    if (!*target)
        return true;
    void *copy = arena_array(&scene->arena, count, size);
    if (!copy)
        return false;
    if (count)
        memcpy(copy, *target, count * size);
    *target = copy;
    return true;
}

static bool copy_text(struct lam_scene *scene, const char **text)
{
    if (!*text)
        return true;
    *text = arena_string(&scene->arena, *text);
    return *text != NULL;
}

static bool copy_mesh(struct lam_scene *scene, lam_mesh *mesh)
{
    size_t corners = mesh_corners(mesh);
    size_t color_size = mesh->colors_format == LAM_COLORS_LINEAR_F32 ? 16 : 4;
    lam_part *parts = NULL;
    bool ok = copy_text(scene, &mesh->name) && copy_array(scene, &mesh->positions, mesh->vertex_count, 12) &&
              copy_array(scene, &mesh->indices, corners, 4) &&
              copy_array(scene, &mesh->normals, mesh->normal_count, 12) &&
              copy_array(scene, &mesh->normal_indices, corners, 4) &&
              copy_array(scene, &mesh->texcoords, mesh->texcoord_count, 8) &&
              copy_array(scene, &mesh->texcoord_indices, corners, 4) &&
              copy_array(scene, &mesh->second_texcoords, mesh->second_texcoord_count, 8) &&
              copy_array(scene, &mesh->second_texcoord_indices, corners, 4) &&
              copy_array(scene, &mesh->tangents, mesh->tangent_count, 16) &&
              copy_array(scene, &mesh->tangent_indices, corners, 4) &&
              copy_array(scene, &mesh->colors, mesh->color_count, color_size) &&
              copy_array(scene, &mesh->color_indices, corners, 4) &&
              copy_array(scene, &mesh->smoothing_groups, mesh->triangle_count, 4) &&
              copy_array(scene, &mesh->inner_edges, mesh->triangle_count, 1) &&
              copy_array(scene, &mesh->parts, mesh->part_count, sizeof *parts);
    parts = (lam_part *)(uintptr_t)mesh->parts;
    for (uint32_t i = 0; ok && i < mesh->part_count; i++)
        ok = copy_text(scene, &parts[i].name);
    return ok;
}

bool scene_copy_mesh(struct lam_scene *scene, const lam_mesh *mesh, lam_mesh *copy, lam_error *error)
{
    *copy = *mesh;
    if (!check_mesh(scene, mesh, error))
        return false;
    if (!copy_mesh(scene, copy))
        return call_memory_error(scene->arena.call, 0, error);
    return copy->normals || !mesh_corners(copy) || mesh_is_strokes(copy) ||
           normals_smooth(copy, math_radians(40), &scene->arena, NULL, NULL, error);
}

int lam_scene_add_mesh(lam_scene *scene, const lam_mesh *mesh, lam_error *error)
{
    if (!scene || !mesh)
        return fail(error, LAM_BAD_ARGUMENT, "lam_scene_add_mesh: %s is NULL", scene ? "mesh" : "scene"), -1;
    uint64_t state = float_state_enter();
    lam_mesh copy;
    int index = scene_copy_mesh(scene, mesh, &copy, error) ? scene_adopt_mesh(scene, &copy, error) : -1;
    if (index >= 0 && !scene_measure(scene, NULL, error)) {
        scene->meshes.count--;
        index = -1;
    }
    float_state_leave(state);
    return index;
}

static bool copy_maps(lam_scene *scene, lam_material *material, lam_error *error)
{
    for (int i = 0; i < LAM_MAP_COUNT; i++) {
        char name[64];
        if (!material->maps[i])
            continue;
        snprintf(name, sizeof name, "material: %s map", lam_map_name((lam_map)i));
        if (!texture_map_check(material->maps[i], name, error))
            return false;
        if (!copy_array(scene, &material->maps[i], 1, sizeof **material->maps))
            return call_memory_error(scene->arena.call, sizeof **material->maps, error);
        if (!scene_share_texture(scene, material->maps[i]->texture, error))
            return false;
    }
    return true;
}

// Checks a material and copies it with its strings and maps. Returns false on error.
static bool copy_material(lam_scene *scene, const lam_material *material, lam_material *out, lam_error *error)
{
    if (!scene || !material)
        return fail(error, LAM_BAD_ARGUMENT, "material: the %s is NULL", scene ? "material" : "scene");
    if (!check_reserved("material", material, error))
        return false;
    struct field_fault fault;
    for (int i = 0; lam_material_field(i); i++)
        if (!field_fits(lam_material_field(i), material, &fault))
            return fail(error, LAM_BAD_ARGUMENT, "material: %s is %g, expected %s", fault.name, fault.found,
                        fault.expected);
    if ((unsigned)material->alpha_mode >= LAM_ALPHA_COUNT)
        return fail(error, LAM_BAD_ARGUMENT, "material: alpha_mode is %d, expected 0 to %d", (int)material->alpha_mode,
                    LAM_ALPHA_COUNT - 1);
    *out = *material;
    bool ok = copy_text(scene, &out->name);
    for (int i = 0; ok && i < LAM_MAP_COUNT; i++)
        ok = copy_text(scene, &out->map_names[i]) && copy_text(scene, &out->map_options[i]);
    if (!ok)
        return call_memory_error(scene->arena.call, 0, error);
    return copy_maps(scene, out, error);
}

int lam_scene_add_material(lam_scene *scene, const lam_material *material, lam_error *error)
{
    lam_material own;
    return copy_material(scene, material, &own, error) ? scene_adopt_material(scene, &own, error) : -1;
}

bool lam_scene_set_material(lam_scene *scene, int index, const lam_material *material, lam_error *error)
{
    lam_material own;
    if (index < 0 || index >= lam_scene_material_count(scene))
        return fail(error, LAM_BAD_ARGUMENT, "material: %d of %d", index, lam_scene_material_count(scene));
    if (!copy_material(scene, material, &own, error))
        return false;
    ((lam_material *)scene->materials.items)[index] = own;
    return true;
}

bool lam_scene_set_part_material(lam_scene *scene, int mesh, uint32_t part, int material, lam_error *error)
{
    const lam_mesh *m = lam_scene_mesh(scene, mesh);
    if (!m)
        return fail(error, LAM_BAD_ARGUMENT, "part: mesh %d of %d", mesh, lam_scene_mesh_count(scene));
    if (part >= m->part_count)
        return fail(error, LAM_BAD_ARGUMENT, "part: %u of the %u that mesh %d has", part, m->part_count, mesh);
    if (material < -1 || material >= scene->materials.count)
        return fail(error, LAM_BAD_ARGUMENT, "part: material %d of %d", material, scene->materials.count);
    ((lam_part *)(uintptr_t)m->parts)[part].material = material; // the scene owns the array
    return true;
}

bool lam_scene_set_default_material(lam_scene *scene, const lam_material *material, lam_error *error)
{
    lam_material own;
    if (!copy_material(scene, material, &own, error))
        return false;
    *scene->default_material = own;
    return true;
}

static bool copy_light(lam_scene *scene, const lam_light *light, lam_light *out, lam_error *error)
{
    if (!scene || !light)
        return fail(error, LAM_BAD_ARGUMENT, "light: the %s is NULL", scene ? "light" : "scene");
    if (!lam_light_check(light, error))
        return false;
    *out = *light;
    return (copy_text(scene, &out->name) && copy_text(scene, &out->object)) ||
           call_memory_error(scene->arena.call, 0, error);
}

int lam_scene_add_light(lam_scene *scene, const lam_light *light, lam_error *error)
{
    lam_light own;
    return copy_light(scene, light, &own, error) ? scene_adopt_light(scene, &own, error) : -1;
}

bool lam_scene_set_light(lam_scene *scene, int index, const lam_light *light, lam_error *error)
{
    lam_light own;
    if (index < 0 || index >= lam_scene_light_count(scene))
        return fail(error, LAM_BAD_ARGUMENT, "light: %d of %d", index, lam_scene_light_count(scene));
    if (!copy_light(scene, light, &own, error))
        return false;
    ((lam_light *)scene->lights.items)[index] = own;
    return true;
}

void lam_scene_clear_lights(lam_scene *scene)
{
    if (scene)
        scene->lights.count = 0;
}

static bool check_object(const struct lam_scene *scene, const lam_object *object, lam_error *error)
{
    if (!check_reserved("object", object, error))
        return false;
    if (object->mesh < 0 || object->mesh >= scene->meshes.count)
        return fail(error, LAM_BAD_ARGUMENT, "object: mesh %d of %d", object->mesh, scene->meshes.count);
    if (object->material < -1 || object->material >= scene->materials.count)
        return fail(error, LAM_BAD_ARGUMENT, "object: material %d of %d", object->material, scene->materials.count);
    if (object->back_material < -1 || object->back_material >= scene->materials.count)
        return fail(error, LAM_BAD_ARGUMENT, "object: back_material %d of %d", object->back_material,
                    scene->materials.count);
    if (object->group < 0 || object->group > scene->groups.count)
        return fail(error, LAM_BAD_ARGUMENT, "object: group %d of %d", object->group, scene->groups.count);
    if ((unsigned)object->cull > LAM_CULL_FRONT)
        return fail(error, LAM_BAD_ARGUMENT, "object: cull is %d, expected 0 to 2", object->cull);
    const double(*m)[4] = object->transform.m;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            if (!math_finite(m[i][j]))
                return fail(error, LAM_BAD_ARGUMENT, "object: transform[%d][%d] is not finite", i, j);
    if (m[3][0] != 0 || m[3][1] != 0 || m[3][2] != 0 || m[3][3] != 1)
        return fail(error, LAM_BAD_ARGUMENT, "object: the transform's last row is %g %g %g %g, expected 0 0 0 1",
                    m[3][0], m[3][1], m[3][2], m[3][3]);
    double determinant = mat4_determinant3(&object->transform);
    if (!(determinant != 0) || !math_finite(determinant))
        return fail(error, LAM_BAD_ARGUMENT, "object: the transform cannot be inverted");
    return true;
}

static bool copy_object(lam_scene *scene, const lam_object *object, lam_object *out, lam_error *error)
{
    if (!scene || !object)
        return fail(error, LAM_BAD_ARGUMENT, "object: the %s is NULL", scene ? "object" : "scene");
    if (!check_object(scene, object, error))
        return false;
    *out = *object;
    return copy_text(scene, &out->name) || call_memory_error(scene->arena.call, 0, error);
}

int lam_scene_add_object(lam_scene *scene, const lam_object *object, lam_error *error)
{
    lam_object own;
    return copy_object(scene, object, &own, error) ? scene_adopt_object(scene, &own, error) : -1;
}

bool lam_scene_set_object(lam_scene *scene, int index, const lam_object *object, lam_error *error)
{
    lam_object own;
    if (index < 0 || index >= lam_scene_object_count(scene))
        return fail(error, LAM_BAD_ARGUMENT, "object: %d of %d", index, lam_scene_object_count(scene));
    if (!copy_object(scene, object, &own, error))
        return false;
    ((lam_object *)scene->objects.items)[index] = own;
    return true;
}
