// scene.c: the scene's storage: what it holds, adding to it, looking into it.
#include "scene_store.h"

#include "fail.h"
#include "float_state.h"
#include "linear.h"
#include "normals.h"

#include <stdlib.h>
#include <string.h>

struct lam_scene *scene_make(struct watch *watch, lam_error *error)
{
    struct lam_scene *scene = calloc(1, sizeof *scene);
    if (!scene) {
        fail_memory(error, sizeof *scene);
        return NULL;
    }
    arena_start(&scene->arena, watch);
    scene->up = LAM_UP_Y;
    scene->format = "";
    return scene;
}

void scene_built(struct lam_scene *scene) { scene->arena.watch = NULL; }

lam_scene *lam_scene_make(lam_error *error) { return scene_make(NULL, error); }

void lam_scene_free(lam_scene *scene)
{
    if (!scene)
        return;
    arena_free(&scene->arena);
    free(scene);
}

// Appends an item; −1 when memory is out.
int scene_append(struct lam_scene *scene, struct scene_list *list, const void *item, size_t size, lam_error *error)
{
    if (list->count == list->room) {
        int room = list->room ? list->room * 2 : 8;
        void *items = list->room > INT32_MAX / 4 ? NULL : arena_array(&scene->arena, (size_t)room, size);
        if (!items) {
            watch_memory_error(scene->arena.watch, (size_t)room * size, error);
            return -1;
        }
        if (list->count)
            memcpy(items, list->items, (size_t)list->count * size);
        list->items = items;
        list->room = room;
    }
    memcpy((char *)list->items + (size_t)list->count * size, item, size);
    return list->count++;
}

int scene_take_mesh(struct lam_scene *scene, const lam_mesh *mesh, lam_error *error)
{
    return scene_append(scene, &scene->meshes, mesh, sizeof *mesh, error);
}

int scene_take_material(struct lam_scene *scene, const lam_material *material, lam_error *error)
{
    return scene_append(scene, &scene->materials, material, sizeof *material, error);
}

int scene_take_object(struct lam_scene *scene, const lam_object *object, lam_error *error)
{
    return scene_append(scene, &scene->objects, object, sizeof *object, error);
}

int scene_take_light(struct lam_scene *scene, const lam_light *light, lam_error *error)
{
    return scene_append(scene, &scene->lights, light, sizeof *light, error);
}

void scene_warn(struct lam_scene *scene, const char *format, ...)
{
    if (scene->warnings.count >= SCENE_WARNINGS_MAX)
        return;
    bool full = scene->warnings.count == SCENE_WARNINGS_MAX - 1;
    va_list arguments;
    va_start(arguments, format);
    const char *text = full ? "more warnings follow, which are not kept" : arena_vformat(&scene->arena, format, arguments);
    va_end(arguments);
    if (text)
        scene_append(scene, &scene->warnings, &text, sizeof text, NULL); // without memory a warning is not worth failing for
}

bool scene_prepare(struct lam_scene *scene, lam_normals normals, double crease_angle_rad, struct pool *pool,
                   struct watch *watch, lam_error *error)
{
    if (crease_angle_rad == 0)
        crease_angle_rad = math_radians(40);
    for (int i = 0; i < scene->meshes.count; i++) {
        lam_mesh *mesh = (lam_mesh *)scene->meshes.items + i;
        if (mesh->normals && normals == LAM_NORMALS_FILE)
            continue;
        bool ok = normals == LAM_NORMALS_FACET
                      ? normals_facet(mesh, &scene->arena, pool, watch, error)
                      : normals_smooth(mesh, crease_angle_rad, &scene->arena, pool, watch, error);
        if (!ok)
            return false;
    }
    return true;
}

lam_object lam_object_default(void)
{
    return (lam_object){.transform = lam_mat4_identity(), .material = -1, .back_material = -1};
}

// --- adding by hand: everything is checked and copied

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

// One attribute of a mesh under check: its array, how many there are, its index array.
static bool check_attribute(const char *name, const float *values, uint32_t count, int width, const uint32_t *own,
                            const lam_mesh *mesh, lam_error *error)
{
    size_t corners = (size_t)mesh->triangle_count * 3;
    if (!values)
        return true;
    if (!finite_floats(values, (size_t)count * (size_t)width))
        return fail(error, LAM_BAD_ARGUMENT, "mesh: %s hold a number that is not finite", name);
    if (own ? !indices_below(own, corners, count)
            : count < (mesh->indices ? mesh->vertex_count : corners))
        return fail(error, LAM_BAD_ARGUMENT, "mesh: a corner refers to %s beyond the %u there are", name, count);
    return true;
}

static bool check_mesh(const struct lam_scene *scene, const lam_mesh *mesh, lam_error *error)
{
    size_t corners = (size_t)mesh->triangle_count * 3;
    if (corners > UINT32_MAX)
        return fail(error, LAM_LIMIT, "mesh: %u triangles, at most %u can be held", mesh->triangle_count, UINT32_MAX / 3);
    if (!mesh->positions && mesh->triangle_count)
        return fail(error, LAM_BAD_ARGUMENT, "mesh: positions are NULL");
    if (!math_finite(mesh->origin[0]) || !math_finite(mesh->origin[1]) || !math_finite(mesh->origin[2]))
        return fail(error, LAM_BAD_ARGUMENT, "mesh: the origin is not finite");
    if (mesh->indices && !indices_below(mesh->indices, corners, mesh->vertex_count))
        return fail(error, LAM_BAD_ARGUMENT, "mesh: an index is not below vertex_count, %u", mesh->vertex_count);
    if (!mesh->indices && corners > mesh->vertex_count)
        return fail(error, LAM_BAD_ARGUMENT, "mesh: %u triangles without indices need %zu vertices, found %u",
                    mesh->triangle_count, corners, mesh->vertex_count);
    if (mesh->positions && !finite_floats(mesh->positions, (size_t)mesh->vertex_count * 3))
        return fail(error, LAM_BAD_ARGUMENT, "mesh: positions hold a number that is not finite");
    if (!check_attribute("normals", mesh->normals, mesh->normal_count, 3, mesh->normal_indices, mesh, error) ||
        !check_attribute("texcoords", mesh->texcoords, mesh->texcoord_count, 2, mesh->texcoord_indices, mesh, error) ||
        !check_attribute("tangents", mesh->tangents, mesh->tangent_count, 4, mesh->tangent_indices, mesh, error))
        return false;
    if (mesh->colors) {
        if (mesh->colors_format < LAM_COLORS_SRGB8 || mesh->colors_format > LAM_COLORS_LINEAR_F32)
            return fail(error, LAM_BAD_ARGUMENT, "mesh: colors are given, but colors_format is %d", mesh->colors_format);
        const float *as_floats = mesh->colors_format == LAM_COLORS_LINEAR_F32 ? mesh->colors : NULL;
        if (as_floats && !finite_floats(as_floats, (size_t)mesh->color_count * 4))
            return fail(error, LAM_BAD_ARGUMENT, "mesh: colors hold a number that is not finite");
        size_t needed = mesh->colors_rate == LAM_PER_TRIANGLE ? mesh->triangle_count
                        : mesh->indices                       ? mesh->vertex_count
                                                              : corners;
        bool by_index = mesh->color_indices && mesh->colors_rate == LAM_PER_VERTEX;
        if (by_index ? !indices_below(mesh->color_indices, corners, mesh->color_count) : mesh->color_count < needed)
            return fail(error, LAM_BAD_ARGUMENT, "mesh: a corner refers to colors beyond the %u there are", mesh->color_count);
    }
    uint64_t next = 0;
    for (uint32_t i = 0; i < mesh->part_count; i++) {
        const lam_part *part = &mesh->parts[i];
        if (part->first_triangle != next)
            return fail(error, LAM_BAD_ARGUMENT, "mesh: part %u starts at triangle %u, expected %llu", i,
                        part->first_triangle, (unsigned long long)next);
        next += part->triangle_count;
        if (part->material >= scene->materials.count)
            return fail(error, LAM_BAD_ARGUMENT, "mesh: part %u names material %d of %d", i, part->material,
                        scene->materials.count);
    }
    if (mesh->part_count && next != mesh->triangle_count)
        return fail(error, LAM_BAD_ARGUMENT, "mesh: the parts cover %llu of %u triangles", (unsigned long long)next,
                    mesh->triangle_count);
    return true;
}

// Replaces *pointer by a copy in the scene's arena.
static bool copy_array(struct lam_scene *scene, const void *pointer, size_t count, size_t size)
{
    const void **at = (const void **)(uintptr_t)pointer;
    if (!*at)
        return true;
    void *copy = arena_array(&scene->arena, count, size);
    if (!copy)
        return false;
    if (count)
        memcpy(copy, *at, count * size);
    *at = copy;
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
    size_t corners = (size_t)mesh->triangle_count * 3;
    size_t color_size = mesh->colors_format == LAM_COLORS_LINEAR_F32 ? 16 : 4;
    lam_part *parts = NULL;
    bool ok = copy_text(scene, &mesh->name) && copy_array(scene, &mesh->positions, mesh->vertex_count, 12) &&
              copy_array(scene, &mesh->indices, corners, 4) && copy_array(scene, &mesh->normals, mesh->normal_count, 12) &&
              copy_array(scene, &mesh->normal_indices, corners, 4) &&
              copy_array(scene, &mesh->texcoords, mesh->texcoord_count, 8) &&
              copy_array(scene, &mesh->texcoord_indices, corners, 4) &&
              copy_array(scene, &mesh->tangents, mesh->tangent_count, 16) &&
              copy_array(scene, &mesh->tangent_indices, corners, 4) &&
              copy_array(scene, &mesh->colors, mesh->color_count, color_size) &&
              copy_array(scene, &mesh->color_indices, corners, 4) &&
              copy_array(scene, &mesh->smoothing_groups, mesh->triangle_count, 4) &&
              copy_array(scene, &mesh->parts, mesh->part_count, sizeof *parts);
    parts = (lam_part *)(uintptr_t)mesh->parts;
    for (uint32_t i = 0; ok && i < mesh->part_count; i++)
        ok = copy_text(scene, &parts[i].name);
    return ok;
}

int lam_scene_add_mesh(lam_scene *scene, const lam_mesh *mesh, lam_error *error)
{
    if (!scene || !mesh) {
        fail(error, LAM_BAD_ARGUMENT, "lam_scene_add_mesh: %s is NULL", scene ? "mesh" : "scene");
        return -1;
    }
    uint64_t state = float_state_enter();
    lam_mesh copy = *mesh;
    bool ok = check_mesh(scene, mesh, error);
    if (ok && !copy_mesh(scene, &copy))
        ok = watch_memory_error(scene->arena.watch, 0, error);
    if (ok && !copy.normals)
        ok = normals_smooth(&copy, math_radians(40), &scene->arena, NULL, NULL, error);
    int index = ok ? scene_take_mesh(scene, &copy, error) : -1;
    if (index >= 0 && !scene_measure(scene, NULL, error)) {
        scene->meshes.count--;
        index = -1;
    }
    float_state_leave(state);
    return index;
}

int lam_scene_add_material(lam_scene *scene, const lam_material *material, lam_error *error)
{
    if (!scene || !material) {
        fail(error, LAM_BAD_ARGUMENT, "lam_scene_add_material: %s is NULL", scene ? "material" : "scene");
        return -1;
    }
    lam_material copy = *material;
    if (!finite_floats(&copy.ambient.r, 3) || !finite_floats(&copy.diffuse.r, 4) || !finite_floats(&copy.specular.r, 3) ||
        !finite_floats(&copy.emission.r, 3) || !finite_floats(&copy.reflectivity.r, 3)) {
        fail(error, LAM_BAD_ARGUMENT, "material: a colour is not finite");
        return -1;
    }
    if (!(copy.shininess >= 0) || !finite_floats(&copy.shininess, 1)) {
        fail(error, LAM_BAD_ARGUMENT, "material: shininess is %g, expected a finite number of at least 0",
             (double)copy.shininess);
        return -1;
    }
    if (!(copy.diffuse.a >= 0 && copy.diffuse.a <= 1)) {
        fail(error, LAM_BAD_ARGUMENT, "material: the diffuse alpha is %g, expected 0 to 1", (double)copy.diffuse.a);
        return -1;
    }
    bool ok = copy_text(scene, &copy.name);
    for (int i = 0; ok && i < LAM_MAP_COUNT; i++)
        ok = copy_text(scene, &copy.map_names[i]) && copy_text(scene, &copy.map_options[i]);
    if (!ok) {
        watch_memory_error(scene->arena.watch, 0, error);
        return -1;
    }
    return scene_take_material(scene, &copy, error);
}

int lam_scene_add_light(lam_scene *scene, const lam_light *light, lam_error *error)
{
    if (!scene || !light) {
        fail(error, LAM_BAD_ARGUMENT, "lam_scene_add_light: %s is NULL", scene ? "light" : "scene");
        return -1;
    }
    if (!lam_light_check(light, error))
        return -1;
    lam_light copy = *light;
    if (!copy_text(scene, &copy.name) || !copy_text(scene, &copy.object)) {
        watch_memory_error(scene->arena.watch, 0, error);
        return -1;
    }
    return scene_take_light(scene, &copy, error);
}

static bool check_object(const struct lam_scene *scene, const lam_object *object, lam_error *error)
{
    if (object->mesh < 0 || object->mesh >= scene->meshes.count)
        return fail(error, LAM_BAD_ARGUMENT, "object: mesh %d of %d", object->mesh, scene->meshes.count);
    if (object->material < -1 || object->material >= scene->materials.count)
        return fail(error, LAM_BAD_ARGUMENT, "object: material %d of %d", object->material, scene->materials.count);
    if (object->back_material < -1 || object->back_material >= scene->materials.count)
        return fail(error, LAM_BAD_ARGUMENT, "object: back_material %d of %d", object->back_material,
                    scene->materials.count);
    if ((unsigned)object->cull > LAM_CULL_FRONT)
        return fail(error, LAM_BAD_ARGUMENT, "object: cull is %d, expected 0 to 2", object->cull);
    const double(*m)[4] = object->transform.m;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            if (!math_finite(m[i][j]))
                return fail(error, LAM_BAD_ARGUMENT, "object: transform[%d][%d] is not finite", i, j);
    if (m[3][0] != 0 || m[3][1] != 0 || m[3][2] != 0 || m[3][3] != 1)
        return fail(error, LAM_BAD_ARGUMENT, "object: the transform's last row is %g %g %g %g, expected 0 0 0 1", m[3][0],
                    m[3][1], m[3][2], m[3][3]);
    double determinant = mat4_determinant3(&object->transform);
    if (!(determinant != 0) || !math_finite(determinant))
        return fail(error, LAM_BAD_ARGUMENT, "object: the transform cannot be inverted");
    return true;
}

int lam_scene_add_object(lam_scene *scene, const lam_object *object, lam_error *error)
{
    if (!scene || !object) {
        fail(error, LAM_BAD_ARGUMENT, "lam_scene_add_object: %s is NULL", scene ? "object" : "scene");
        return -1;
    }
    if (!check_object(scene, object, error))
        return -1;
    lam_object copy = *object;
    if (!copy_text(scene, &copy.name)) {
        watch_memory_error(scene->arena.watch, 0, error);
        return -1;
    }
    return scene_take_object(scene, &copy, error);
}

// --- looking

int lam_scene_mesh_count(const lam_scene *scene) { return scene ? scene->meshes.count : 0; }
int lam_scene_material_count(const lam_scene *scene) { return scene ? scene->materials.count : 0; }
int lam_scene_object_count(const lam_scene *scene) { return scene ? scene->objects.count : 0; }
int lam_scene_light_count(const lam_scene *scene) { return scene ? scene->lights.count : 0; }

static const void *item(const struct scene_list *list, int index, size_t size)
{
    return index >= 0 && index < list->count ? (const char *)list->items + (size_t)index * size : NULL;
}

const lam_mesh *lam_scene_mesh(const lam_scene *scene, int index)
{
    return scene ? item(&scene->meshes, index, sizeof(lam_mesh)) : NULL;
}

const lam_material *lam_scene_material(const lam_scene *scene, int index)
{
    return scene ? item(&scene->materials, index, sizeof(lam_material)) : NULL;
}

const lam_object *lam_scene_object(const lam_scene *scene, int index)
{
    return scene ? item(&scene->objects, index, sizeof(lam_object)) : NULL;
}

const lam_light *lam_scene_light(const lam_scene *scene, int index)
{
    return scene ? item(&scene->lights, index, sizeof(lam_light)) : NULL;
}

uint64_t lam_scene_triangle_count(const lam_scene *scene)
{
    uint64_t count = 0;
    for (int i = 0; i < lam_scene_object_count(scene); i++)
        count += scene_mesh(scene, scene_object(scene, i)->mesh)->triangle_count;
    return count;
}

uint64_t lam_scene_vertex_count(const lam_scene *scene)
{
    uint64_t count = 0;
    for (int i = 0; i < lam_scene_object_count(scene); i++)
        count += scene_mesh(scene, scene_object(scene, i)->mesh)->vertex_count;
    return count;
}

const char *lam_scene_format(const lam_scene *scene) { return scene ? scene->format : ""; }

const char *lam_scene_warning(const lam_scene *scene, int index)
{
    const char *const *text = scene ? item(&scene->warnings, index, sizeof(char *)) : NULL;
    return text ? *text : NULL;
}

lam_up lam_scene_up(const lam_scene *scene) { return scene ? scene->up : LAM_UP_Y; }

void lam_scene_set_up(lam_scene *scene, lam_up up)
{
    if (scene)
        scene->up = up == LAM_UP_AUTO ? LAM_UP_Y : up;
}

void lam_scene_set_ambient(lam_scene *scene, lam_rgb ambient)
{
    if (scene && finite_floats(&ambient.r, 3))
        scene->ambient = ambient;
}

lam_rgb lam_scene_ambient(const lam_scene *scene) { return scene ? scene->ambient : (lam_rgb){0, 0, 0}; }

void lam_scene_times(const lam_scene *scene, double *read_ms, double *prepare_ms)
{
    if (read_ms)
        *read_ms = scene ? scene->read_ms : 0;
    if (prepare_ms)
        *prepare_ms = scene ? scene->prepare_ms : 0;
}
