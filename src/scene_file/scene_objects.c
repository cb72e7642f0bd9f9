// scene_objects.c: the objects of a scene file: built-in shapes, and models read by the other importers.
#include "companion.h"
#include "scene_reader.h"

#include "fail.h"
#include "linear.h"

#include <string.h>

#define EVERY_OBJECT                                                                                                   \
    "name", "transform", "material", "back_material", "two_sided", "cull", "tangents", "normals", "crease_angle"
static const char *const shape_keys[] = {EVERY_OBJECT, "shape", "radius", "slices", "stacks", NULL};
static const char *const file_keys[] = {EVERY_OBJECT, "file", "materials", "parts", NULL};
static const char *const any_keys[] = {EVERY_OBJECT, "shape",     "radius", "slices", "stacks",
                                       "file",       "materials", "parts",  NULL};

// --- a model file, read into the scene

struct nested {
    const struct import_source *outer;
    char folder[4096]; // of the model, as the scene file names it, with its '/'
};

// A companion of the model: in the model's folder.
static bool open_nested(const struct import_source *source, const char *name, struct file_bytes *out, lam_error *error)
{
    const struct nested *nested = source->open_state;
    char inside[4096], path[8192];
    const char *unused;
    if (!confine(name, inside, sizeof inside) || !*inside || strcmp(inside, "..") == 0)
        return fail(error, LAM_CANNOT_READ, "%s: names a file '%.80s' that cannot be looked for", source->name, name);
    strcpy(path, nested->folder);
    strcat(path, inside);
    struct arena scratch;
    arena_start(&scratch, NULL);
    bool ok = nested->outer->open_model(nested->outer, path, &scratch, &unused, out, error);
    arena_free(&scratch);
    return ok;
}

// Appends the inner scene's items to those of the outer one, their indices shifted.
static bool merge(struct scene_reader *r, struct lam_scene *inner)
{
    struct lam_scene *scene = r->scene;
    int meshes = scene->meshes.count, materials = scene->materials.count;
    bool ok = true;
    for (int i = 0; ok && i < inner->materials.count; i++)
        ok = scene_adopt_material(scene, (lam_material *)inner->materials.items + i, r->error) >= 0;
    for (int i = 0; ok && i < inner->meshes.count; i++) {
        const lam_mesh *mesh = scene_mesh(inner, i);
        for (uint32_t p = 0; p < mesh->part_count; p++) {
            lam_part *part = (lam_part *)(uintptr_t)&mesh->parts[p]; // in the scene's arena
            part->material += part->material >= 0 ? materials : 0;
        }
        ok = scene_adopt_mesh(scene, mesh, r->error) >= 0;
    }
    for (int i = 0; ok && i < inner->objects.count; i++) {
        lam_object object = *scene_object(inner, i);
        object.mesh += meshes;
        object.material += object.material >= 0 ? materials : 0;
        object.back_material += object.back_material >= 0 ? materials : 0;
        ok = scene_adopt_object(scene, &object, r->error) >= 0;
    }
    for (int i = 0; ok && !r->has_lights && i < inner->lights.count; i++)
        ok = scene_adopt_light(scene, (lam_light *)inner->lights.items + i, r->error) >= 0;
    for (int i = 0; ok && i < inner->warnings.count; i++)
        scene_warn(scene, "%s", ((const char **)inner->warnings.items)[i]);
    return ok;
}

static bool import_bytes(struct scene_reader *r, const struct place *place, const struct import_source *source,
                         const struct file_bytes *file, struct scene_origin *origin)
{
    const struct importer *importer = source->importer_for(source->name, file, NULL, r->error);
    if (!importer)
        return false;
    if (importer->is_scene_file)
        return fail_place(r, place, "'%.200s' is a scene file, expected a model", source->name);
    // The inner scene lives in the outer one's arena.
    struct lam_scene inner = {
        .arena = r->scene->arena, .up = importer->up, .format = importer->name, .color = r->color};
    bool ok = importer->load(source, &inner, r->error) &&
              scene_prepare(&inner, origin->normals, origin->crease_angle_rad, source->pool, source->call, r->error);
    r->scene->arena = inner.arena;
    uint64_t triangles = 0;
    for (int i = 0; ok && i < inner.meshes.count; i++)
        triangles += scene_mesh(&inner, i)->triangle_count;
    if (ok && !triangles)
        return fail(r->error, LAM_CANNOT_READ, "%s: holds no triangles", source->name);
    return ok && merge(r, &inner);
}

static bool add_file(struct scene_reader *r, const struct place *place, const char *name, struct scene_origin *origin)
{
    struct nested nested = {.outer = r->source};
    size_t folder = (size_t)(path_name(name) - name);
    struct file_bytes file = {0};
    if (strlen(name) >= sizeof nested.folder)
        return fail_place(r, KEY_OF(place, "file"), "the name is too long");
    memcpy(nested.folder, name, folder);
    lam_load_params params = *r->source->params;
    params.color = r->color;
    params.format = NULL;
    params.normals = origin->normals;
    params.crease_angle_rad = origin->crease_angle_rad;
    lam_error reason = {0};
    if (!r->source->open_model(r->source, name, &r->scene->arena, &origin->path, &file, &reason)) {
        if (r->error)
            *r->error = reason;
        return reason.code == LAM_CANNOT_READ ? fail_place(r, KEY_OF(place, "file"), "%s", reason.text) : false;
    }
    struct import_source source = *r->source;
    source.name = origin->path ? origin->path : name;
    source.path = origin->path;
    source.bytes = file.data;
    source.size = file.size;
    source.params = &params;
    source.open = open_nested;
    source.open_state = &nested;
    bool ok = import_bytes(r, KEY_OF(place, "file"), &source, &file, origin);
    file_release(&file);
    return ok;
}

// --- keys of all objects

// "materials": changes of the model's own materials, by their names.
static bool change_materials(struct scene_reader *r, const struct place *place, const json_t *value,
                             const struct scene_origin *origin)
{
    const char *key;
    json_t *change, *list = json_object_get(value, "materials");
    const struct place *here = KEY_OF(place, "materials");
    if (list && !json_is_object(list)) {
        char kind[32];
        return fail_place(r, here, "found %s, expected an object of the model's materials", json_kind(list, kind));
    }
    json_object_foreach(list, key, change)
    {
        bool found = false;
        for (int i = origin->first_material; i < r->scene->materials.count; i++) {
            lam_material *material = (lam_material *)r->scene->materials.items + i;
            if (!material->name || strcmp(material->name, key) != 0)
                continue;
            found = true;
            if (!read_material_keys(r, KEY_OF(here, key), change, false, material))
                return false;
        }
        if (!found)
            return fail_place(r, KEY_OF(here, key), "the model has no material of this name");
    }
    return true;
}

// "parts": a material for each part of the model, in order; null: the model's own.
static bool replace_parts(struct scene_reader *r, const struct place *place, const json_t *value,
                          const struct scene_origin *origin)
{
    const json_t *list = json_object_get(value, "parts");
    const struct place *here = KEY_OF(place, "parts");
    char kind[32];
    size_t n = 0;
    if (!list)
        return true;
    if (!json_is_array(list) || json_array_size(list) != (size_t)origin->part_count)
        return fail_place(r, here, "found %s, expected a list of %d, one material or null for each part of the model",
                          json_kind(list, kind), origin->part_count);
    for (int i = origin->first_mesh; i < origin->first_mesh + origin->mesh_count; i++)
        for (uint32_t k = 0; k < scene_mesh(r->scene, i)->part_count; k++, n++) {
            lam_part *part = (lam_part *)(uintptr_t)&scene_mesh(r->scene, i)->parts[k]; // in the scene's arena
            const json_t *material = json_array_get(list, n);
            int index = part->material;
            if (!json_is_null(material) && !read_material_value(r, ELEMENT_OF(here, n), material, NULL, &index))
                return false;
            part->material = index;
        }
    return true;
}

// The material that a back side's missing keys come from: the object's, else that of its first part.
static lam_material front_of(const struct lam_scene *scene, const lam_object *object)
{
    const lam_mesh *mesh = scene_mesh(scene, object->mesh);
    int index = object->material >= 0 ? object->material : mesh->part_count ? mesh->parts[0].material : -1;
    return index >= 0 ? ((const lam_material *)scene->materials.items)[index] : lam_material_default();
}

static bool read_sides(struct scene_reader *r, const struct place *place, const json_t *value, lam_object *object)
{
    bool two_sided = !object->one_sided;
    int cull = (int)object->cull;
    if (!take_bool(r, place, value, "two_sided", &two_sided) || !take_word(r, place, value, "cull", cull_words, &cull))
        return false;
    object->one_sided = !two_sided;
    object->cull = (lam_cull)cull;
    const json_t *back = json_object_get(value, "back_material");
    lam_material front = front_of(r->scene, object);
    front.name = NULL;
    return !back || read_material_value(r, KEY_OF(place, "back_material"), back, &front, &object->back_material);
}

static bool is_identity(const lam_mat4 *m)
{
    lam_mat4 identity = lam_mat4_identity();
    return memcmp(m, &identity, sizeof identity) == 0;
}

// Applies the keys that shapes and files share to the objects from `first` on.
static bool finish(struct scene_reader *r, const struct place *place, const json_t *value, int first, const char *name)
{
    lam_mat4 transform = lam_mat4_identity();
    const json_t *steps = json_object_get(value, "transform"), *material = json_object_get(value, "material");
    int front = -1;
    if (steps && !read_transform(r, KEY_OF(place, "transform"), steps, &transform))
        return false;
    if (material && !read_material_value(r, KEY_OF(place, "material"), material, NULL, &front))
        return false;
    for (int i = first; i < r->scene->objects.count; i++) {
        lam_object *object = (lam_object *)r->scene->objects.items + i;
        // not through a product where there is nothing to multiply: it would lose the signs of zeros
        if (steps)
            object->transform = is_identity(&object->transform) ? transform : mat4_mul(&transform, &object->transform);
        if (front >= 0)
            object->material = front;
        if (name && (i == first || !object->name))
            object->name = name;
        if (!read_sides(r, place, value, object))
            return false;
    }
    return true;
}

static bool add_shape(struct scene_reader *r, const struct place *place, const json_t *value, const char *shape,
                      const struct scene_origin *origin)
{
    lam_shape_params segments = {0};
    lam_object object = lam_object_default();
    lam_error reason;
    if (lam_shape_find(shape) >= 0 && (!take_number(r, place, value, "radius", 1e-30, 1e30, &segments.radius) ||
                                       !take_whole(r, place, value, "slices", 3, 16384, &segments.slices) ||
                                       !take_whole(r, place, value, "stacks", 1, 16384, &segments.stacks)))
        return false;
    int meshes = r->scene->meshes.count;
    object.name = shape;
    object.mesh = scene_add_shape(r->scene, shape, &segments, r->source->call, &reason);
    if (object.mesh < 0) {
        if (r->error)
            *r->error = reason;
        return reason.code == LAM_BAD_ARGUMENT ? fail_place(r, KEY_OF(place, "shape"), "%s", reason.text) : false;
    }
    // Normals are made as scene_prepare makes them, of this mesh alone.
    struct lam_scene one = {.arena = r->scene->arena};
    lam_mesh *mesh = (lam_mesh *)r->scene->meshes.items + meshes;
    bool ok =
        scene_adopt_mesh(&one, mesh, r->error) >= 0 &&
        scene_prepare(&one, origin->normals, origin->crease_angle_rad, r->source->pool, r->source->call, r->error);
    if (ok)
        *mesh = *scene_mesh(&one, 0);
    r->scene->arena = one.arena;
    return ok && scene_adopt_object(r->scene, &object, r->error) >= 0;
}

static bool read_object(struct scene_reader *r, const struct place *place, const json_t *value)
{
    const char *shape = NULL, *file = NULL, *name = NULL;
    int normals = LAM_NORMALS_FILE, field = false;
    double crease_deg = -1;
    bool is_file = json_is_object(value) && json_object_get(value, "file");
    bool is_shape = json_is_object(value) && json_object_get(value, "shape");
    if (!check_keys(r, place, value, is_file == is_shape ? any_keys : is_file ? file_keys : shape_keys))
        return false;
    if (is_file == is_shape)
        return fail_place(r, place,
                          is_file ? "has both shape and file, expected one of them"
                                  : "has neither shape nor file, expected one of them");
    if (!take_text(r, place, value, "shape", &shape) || !take_text(r, place, value, "file", &file) ||
        !take_text(r, place, value, "name", &name) || !take_word(r, place, value, "normals", normals_words, &normals) ||
        !take_number(r, place, value, "crease_angle", 0, 180, &crease_deg) ||
        !take_word(r, place, value, "tangents", tangent_words, &field))
        return false;
    struct lam_scene *scene = r->scene;
    int first = scene->objects.count;
    struct scene_origin origin = {
        .normals = (lam_normals)normals,
        // The importers take 0 for their own angle: a negligible one splits at every edge.
        .crease_angle_rad = crease_deg < 0   ? 0
                            : crease_deg > 0 ? math_radians(crease_deg)
                                             : 1e-6,
        .field_tangents = field,
        .first_mesh = scene->meshes.count,
        .first_material = scene->materials.count,
    };
    if (is_file ? !add_file(r, place, file, &origin) || !scene_note_origin(scene, origin, first, r->error)
                : !add_shape(r, place, value, shape, &origin))
        return false;
    // A shape has noted its own origin, without how it was asked to be made.
    struct scene_origin *noted = (struct scene_origin *)scene->origins.items + scene->origins.count - 1;
    noted->normals = origin.normals;
    noted->crease_angle_rad = origin.crease_angle_rad;
    noted->field_tangents = field;
    for (int i = origin.first_mesh; field && i < scene->meshes.count; i++)
        ((lam_mesh *)scene->meshes.items)[i].tangents = NULL;
    return change_materials(r, place, value, noted) && replace_parts(r, place, value, noted) &&
           finish(r, place, value, first, name);
}

bool read_objects(struct scene_reader *r, const json_t *root)
{
    const json_t *list = json_object_get(root, "objects");
    const struct place *place = KEY_OF(NULL, "objects");
    if (!list)
        return fail_place(r, NULL, "'objects' is missing, expected a list of at least one object");
    if (!json_is_array(list) || !json_array_size(list)) {
        char kind[32];
        return fail_place(r, place, "found %s, expected a list of at least one object", json_kind(list, kind));
    }
    for (size_t i = 0; i < json_array_size(list); i++) {
        if (!call_should_continue(r->source->call))
            return call_error(r->source->call, r->error);
        if (!read_object(r, ELEMENT_OF(place, i), json_array_get(list, i)))
            return false;
    }
    return true;
}
