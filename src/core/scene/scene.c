// scene.c: the scene's storage: creation, growth, preparation and access.
#include "scene_internal.h"

#include "environment.h"
#include "fail.h"
#include "linear.h"
#include "normals.h"

#include <lambent/light.h>
#include <lambent/material.h>
#include <lambent/text.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct scene_token *scene_token_make(lam_error *error)
{
    struct scene_token *token = malloc(sizeof *token);
    if (!token)
        fail_memory(error, sizeof *token);
    else
        *token = (struct scene_token){.references = 1};
    return token;
}

struct lam_scene *scene_make(struct call_control *call, lam_error *error)
{
    struct {
        struct lam_scene scene;
        lam_material default_material;
        uint64_t known_form;
    } *memory = calloc(1, sizeof *memory);
    if (!memory)
        return fail_memory(error, sizeof *memory), NULL;
    struct lam_scene *scene = &memory->scene;
    scene->token = scene_token_make(error);
    if (!scene->token) {
        free(scene);
        return NULL;
    }
    scene->studio = lazy_environment_make();
    if (!scene->studio) {
        fail_memory(error, sizeof *scene);
        free(scene->token);
        free(scene);
        return NULL;
    }
    arena_start(&scene->arena, call);
    scene->up = LAM_UP_Y;
    scene->placement = lam_mat4_identity();
    scene->format = "";
    scene->default_material = &memory->default_material;
    *scene->default_material = lam_material_default();
    scene->known_form = &memory->known_form;
    return scene;
}

void scene_built(struct lam_scene *scene) { scene->arena.call = NULL; }

lam_scene *lam_scene_make(lam_error *error) { return scene_make(NULL, error); }

void lam_scene_free(lam_scene *scene)
{
    if (!scene)
        return;
    for (int i = 0; i < scene->textures.count; i++)
        lam_texture_free(((lam_texture **)scene->textures.items)[i]);
    for (int i = 0; i < scene->extents.count; i++)
        arena_delete(scene_extent(scene, i)->own);
    for (int i = 0; i < scene->kept.count; i++)
        arena_delete(((struct arena **)scene->kept.items)[i]);
    if (scene->cut && !scene->cut->kept)
        arena_delete(scene->cut->own);
    arena_free(&scene->arena);
    lam_environment_free(scene->environment);
    lazy_environment_free(scene->studio);
    __atomic_store_n(&scene->token->gone, 1, __ATOMIC_RELEASE);
    scene_token_release(scene->token);
    free(scene);
}

struct scene_token *scene_token_hold(struct scene_token *token)
{
    __atomic_add_fetch(&token->references, 1, __ATOMIC_RELAXED);
    return token;
}

void scene_token_release(struct scene_token *token)
{
    if (token && __atomic_sub_fetch(&token->references, 1, __ATOMIC_ACQ_REL) == 0)
        free(token);
}

bool scene_list_append(struct scene_list *list, const void *item, size_t size, struct arena *arena)
{
    if (list->count == list->capacity) {
        int capacity = list->capacity ? list->capacity * 2 : 8;
        void *items = list->capacity > INT32_MAX / 4 ? NULL : arena_array(arena, (size_t)capacity, size);
        if (!items)
            return false;
        if (list->count)
            memcpy(items, list->items, (size_t)list->count * size);
        list->items = items;
        list->capacity = capacity;
    }
    memcpy((char *)list->items + (size_t)list->count++ * size, item, size);
    return true;
}

int scene_append(struct lam_scene *scene, struct scene_list *list, const void *item, size_t size, lam_error *error)
{
    if (!scene_list_append(list, item, size, &scene->arena))
        return call_memory_error(scene->arena.call, 2 * (size_t)list->capacity * size, error), -1;
    return list->count - 1;
}

// This limit applies only to files. A scene that a program builds is checked when it is drawn.
static bool check_items(const struct lam_scene *scene, const char *what, uint64_t items, lam_error *error)
{
    return !scene->arena.call ||
           call_check_triangles(scene->arena.call, what, items, "triangles, lines and points", error);
}

int scene_adopt_mesh(struct lam_scene *scene, const lam_mesh *mesh, lam_error *error)
{
    if (!check_items(scene, "a mesh", mesh_items(mesh), error))
        return -1;
    return scene_append(scene, &scene->meshes, mesh, sizeof *mesh, error);
}

int scene_adopt_material(struct lam_scene *scene, const lam_material *material, lam_error *error)
{
    return scene_append(scene, &scene->materials, material, sizeof *material, error);
}

bool scene_adopt_texture(struct lam_scene *scene, lam_texture *texture, lam_error *error)
{
    if (scene_append(scene, &scene->textures, &texture, sizeof texture, error) >= 0)
        return true;
    lam_texture_free(texture);
    return false;
}

bool scene_share_texture(struct lam_scene *scene, const lam_texture *texture, lam_error *error)
{
    lam_texture *const *have = scene->textures.items;
    for (int i = 0; i < scene->textures.count; i++)
        if (have[i] == texture)
            return true;
    return scene_adopt_texture(scene, texture_share(texture), error);
}

int scene_adopt_object(struct lam_scene *scene, const lam_object *object, lam_error *error)
{
    scene->object_items += mesh_items(scene_mesh(scene, object->mesh));
    if (!check_items(scene, "the objects so far", scene->object_items, error))
        return -1;
    if (scene->arena.call &&
        !call_check_objects(scene->arena.call, "the model", (uint64_t)scene->objects.count + 1, error))
        return -1;
    return scene_append(scene, &scene->objects, object, sizeof *object, error);
}

int scene_adopt_light(struct lam_scene *scene, const lam_light *light, lam_error *error)
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
    char sentence[2048], shown[2048];
    vsnprintf(sentence, sizeof sentence, full ? "further warnings are omitted" : format, arguments);
    va_end(arguments);
    lam_utf8_show(sentence, shown, sizeof shown);
    const char *text = arena_string(&scene->arena, shown);
    if (text)
        scene_append(scene, &scene->warnings, &text, sizeof text,
                     NULL); // the call must succeed even if the warning is lost
}

void scene_note_clear(struct lam_scene *scene, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    if (scene->clear_materials++ == 0)
        scene->first_clear = arena_vformat(&scene->arena, format, arguments);
    va_end(arguments);
}

bool scene_note_origin(struct lam_scene *scene, struct scene_origin origin, int first_object, lam_error *error)
{
    origin.mesh_count = scene->meshes.count - origin.first_mesh;
    origin.material_count = scene->materials.count - origin.first_material;
    origin.object_count = scene->objects.count - first_object;
    lam_material *materials = arena_array(&scene->arena, (size_t)origin.material_count, sizeof *materials);
    lam_object *objects = arena_array(&scene->arena, (size_t)origin.object_count, sizeof *objects);
    for (int i = origin.first_mesh; i < scene->meshes.count; i++)
        origin.part_count += (int)scene_mesh(scene, i)->part_count;
    int *parts = arena_array(&scene->arena, (size_t)origin.part_count, sizeof *parts);
    if (!materials || !objects || !parts)
        return call_memory_error(scene->arena.call, 0, error);
    if (origin.material_count)
        memcpy(materials, (lam_material *)scene->materials.items + origin.first_material,
               (size_t)origin.material_count * sizeof *materials);
    if (origin.object_count)
        memcpy(objects, (lam_object *)scene->objects.items + first_object,
               (size_t)origin.object_count * sizeof *objects);
    for (int i = origin.first_mesh, n = 0; i < scene->meshes.count; i++)
        for (uint32_t k = 0; k < scene_mesh(scene, i)->part_count; k++)
            parts[n++] = scene_mesh(scene, i)->parts[k].material;
    origin.part_materials = parts;
    origin.materials = materials;
    origin.objects = objects;
    return scene_append(scene, &scene->origins, &origin, sizeof origin, error) >= 0;
}

bool scene_prepare(struct lam_scene *scene, lam_normals normals, double crease_angle_rad, struct pool *pool,
                   struct call_control *call, lam_error *error)
{
    for (int i = 0; normals != LAM_NORMALS_FILE && i < scene->origins.count; i++) {
        struct scene_origin *origin = (struct scene_origin *)scene->origins.items + i;
        origin->normals = normals;
        origin->crease_angle_rad = crease_angle_rad;
    }
    if (crease_angle_rad == 0)
        crease_angle_rad = scene->deferred_crease_rad > 0 && normals == LAM_NORMALS_FILE ? scene->deferred_crease_rad
                                                                                         : math_radians(40);
    for (int i = 0; i < scene->meshes.count; i++) {
        lam_mesh *mesh = (lam_mesh *)scene->meshes.items + i;
        if ((mesh->normals && normals == LAM_NORMALS_FILE) || mesh_is_strokes(mesh))
            continue;
        bool ok = normals == LAM_NORMALS_FACET
                      ? normals_facet(mesh, &scene->arena, pool, call, error)
                      : normals_smooth(mesh, crease_angle_rad, &scene->arena, pool, call, error);
        if (!ok)
            return false;
    }
    scene->deferred_crease_rad = 0;
    return true;
}

void scene_defer_normals(struct lam_scene *scene, lam_normals normals, double crease_angle_rad)
{
    if (normals == LAM_NORMALS_FACET)
        crease_angle_rad = FACET_CREASE_RAD;
    for (int i = 0; i < scene->meshes.count; i++) {
        lam_mesh *mesh = (lam_mesh *)scene->meshes.items + i;
        if (mesh_is_strokes(mesh))
            continue;
        if (normals != LAM_NORMALS_FILE) {
            mesh->normals = NULL;
            mesh->normal_count = 0;
            mesh->normal_indices = NULL;
        }
        if (!mesh->normals)
            scene->deferred_crease_rad = crease_angle_rad > 0 ? crease_angle_rad : math_radians(40);
    }
}

lam_object lam_object_default(void)
{
    return (lam_object){.transform = lam_mat4_identity(), .material = -1, .back_material = -1};
}

// --- access

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

const lam_group *lam_scene_group(const lam_scene *scene, int index)
{
    return scene ? item(&scene->groups, index, sizeof(lam_group)) : NULL;
}

// Returns the sum of a count, such as the number of a mesh's triangles, over all objects. `offset` is the position of
// the count in lam_mesh.
static uint64_t sum_of(const lam_scene *scene, size_t offset)
{
    uint64_t count = 0;
    for (int i = 0; i < lam_scene_object_count(scene); i++)
        count += *(const uint32_t *)((const char *)scene_mesh(scene, scene_object(scene, i)->mesh) + offset);
    return count;
}

uint64_t lam_scene_triangle_count(const lam_scene *scene) { return sum_of(scene, offsetof(lam_mesh, triangle_count)); }
uint64_t lam_scene_line_count(const lam_scene *scene) { return sum_of(scene, offsetof(lam_mesh, line_count)); }
uint64_t lam_scene_point_count(const lam_scene *scene) { return sum_of(scene, offsetof(lam_mesh, point_count)); }
uint64_t lam_scene_vertex_count(const lam_scene *scene) { return sum_of(scene, offsetof(lam_mesh, vertex_count)); }

const lam_file_info *lam_scene_file_info(const lam_scene *scene) { return scene ? &scene->file : NULL; }

uint64_t lam_scene_memory(const lam_scene *scene)
{
    uint64_t bytes = scene ? scene->arena.total : 0;
    for (int i = 0; scene && i < scene->extents.count; i++)
        bytes += scene_extent(scene, i)->own ? scene_extent(scene, i)->own->total : 0;
    for (int i = 0; scene && i < scene->kept.count; i++)
        bytes += ((struct arena *const *)scene->kept.items)[i]->total;
    for (int i = 0; scene && i < scene->textures.count; i++)
        bytes += lam_texture_memory(((lam_texture *const *)scene->textures.items)[i]);
    return bytes;
}

const char *lam_scene_format(const lam_scene *scene) { return scene ? scene->format : ""; }

const char *lam_scene_warning(const lam_scene *scene, int index)
{
    const char *const *text = scene ? item(&scene->warnings, index, sizeof(char *)) : NULL;
    return text ? *text : NULL;
}

const char *lam_scene_file(const lam_scene *scene, int index)
{
    const char *const *path = scene ? item(&scene->files, index, sizeof(char *)) : NULL;
    return path ? *path : NULL;
}

void lam_scene_add_warning(lam_scene *scene, const char *text)
{
    for (int i = 0; scene && text && i < scene->warnings.count; i++)
        if (strcmp(((const char **)scene->warnings.items)[i], text) == 0)
            return;
    if (scene && text)
        scene_warn(scene, "%s", text);
}

bool lam_scene_picture_settings(const lam_scene *scene, lam_picture_settings *settings)
{
    bool present = scene && scene->settings;
    if (settings)
        *settings = present ? *scene->settings : (lam_picture_settings){0};
    return present;
}

lam_up lam_scene_up(const lam_scene *scene) { return scene ? scene->up : LAM_UP_Y; }

void lam_scene_set_up(lam_scene *scene, lam_up up)
{
    if (scene && (unsigned)up < LAM_UP_COUNT)
        scene->up = up == LAM_UP_AUTO || up == LAM_UP_FILE ? LAM_UP_Y : up;
}

void lam_scene_set_ambient(lam_scene *scene, lam_rgb ambient)
{
    if (scene && math_finite((double)ambient.r) && math_finite((double)ambient.g) && math_finite((double)ambient.b))
        scene->ambient = ambient;
}

lam_rgb lam_scene_ambient(const lam_scene *scene) { return scene ? scene->ambient : (lam_rgb){0, 0, 0}; }

bool lam_scene_set_environment(lam_scene *scene, const lam_environment *environment, double rotation_rad,
                               lam_error *error)
{
    if (!scene || !math_finite(rotation_rad))
        return fail(error, LAM_BAD_ARGUMENT, "environment: %s",
                    scene ? "the rotation is not finite" : "the scene is NULL");
    struct lam_environment *previous = scene->environment;
    scene->environment = cube_share(environment);
    scene->environment_rotation_rad = rotation_rad;
    scene->reflection_map = false;
    lam_environment_free(previous);
    return true;
}

bool lam_scene_set_reflection_map(lam_scene *scene, const lam_environment *environment, double rotation_rad,
                                  lam_error *error)
{
    bool ok = lam_scene_set_environment(scene, environment, rotation_rad, error);
    if (ok)
        scene->reflection_map = environment != NULL;
    return ok;
}

bool lam_scene_has_reflection_map(const lam_scene *scene) { return scene && scene->reflection_map; }

const lam_environment *lam_scene_environment(const lam_scene *scene) { return scene ? scene->environment : NULL; }

const lam_material *lam_scene_default_material(const lam_scene *scene)
{
    return scene ? scene->default_material : NULL;
}

void lam_scene_times(const lam_scene *scene, double *read_ms, double *prepare_ms)
{
    if (read_ms)
        *read_ms = scene ? scene->read_ms : 0;
    if (prepare_ms)
        *prepare_ms = scene ? scene->prepare_ms : 0;
}
