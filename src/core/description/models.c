// models.c: loads the models of a scene file's objects: built-in shapes, formulas, and files that other importers
// read.
//
// A model is read once for each kind of normals, even if several objects use it or spell its file name differently. All
// objects that do not change the model share its meshes and materials. Objects that change the model in the same way
// share the changed version. An object with other changes gets its own list of parts and materials, but shares the
// arrays of vertices.
#include "models.h"

#include "companion.h"
#include "fail.h"
#include "prepare.h"

#include <lambent/material.h>

#include <stdio.h>
#include <string.h>

enum { KEY_SIZE = COMPANION_NAME_SIZE + 4096, VARIANTS = 8 };

// A version of the model in the scene.
struct variant {
    bool field_tangents;
    const json_t *materials, *parts;
    int origin; // in scene->origins
};

struct model {
    struct lam_scene inner;            // the model as it was read; its lists and arrays are in the outer scene's arena
    lam_material inner_material;       // the default material of `inner`, which importers may set
    struct scene_origin origin;        // the model's origin, without its counts and copies
    double crease_angle_rad;           // the angle for its normals; 0 means the default
    struct variant variants[VARIANTS]; // the most recent variants
    int variant_count;                 // number of variants created so far
};

static bool no_memory(const struct reader *r, size_t bytes)
{
    return call_memory_error(r->source->call, bytes, r->json.error);
}

// --- reading

// Builds the shape or formula surface in model->inner, whose memory comes from the outer scene's arena.
static bool make_shape(struct reader *r, const struct model_wanted *wanted, struct model *model)
{
    lam_error reason = {0};
    lam_object object = lam_object_default();
    object.name = !wanted->origin.formula            ? wanted->origin.shape
                  : wanted->origin.formula->implicit ? "implicit"
                                                     : "parametric";
    object.mesh =
        wanted->origin.formula
            ? scene_add_formula(&model->inner, wanted->origin.formula, r->source->call, &reason)
            : scene_add_shape(&model->inner, wanted->origin.shape, &wanted->origin.segments, r->source->call, &reason);
    if (object.mesh < 0) {
        if (reason.code == LAM_BAD_ARGUMENT) // also for formulas, whose text may contain errors
            return json_fail(&r->json, KEY_OF(wanted->place, "shape"), "%s", reason.text);
        *r->json.error = reason;
        return false;
    }
    const struct scene_origin *made = model->inner.origins.items;
    model->origin.shape = made->shape;
    model->origin.formula = made->formula;
    model->origin.segments = made->segments;
    return scene_adopt_object(&model->inner, &object, r->json.error) >= 0;
}

static bool import_file(struct reader *r, const struct model_wanted *wanted, struct companion *file,
                        struct model *model)
{
    struct lam_scene *inner = &model->inner;
    struct companions companions;
    lam_load_params params = *r->source->params;
    params.color = r->color;
    params.format = NULL;
    params.normals = wanted->origin.normals;
    params.polygon_edges |= r->settings->draw.wireframe || r->settings->draw.edges;
    params.crease_angle_rad = wanted->origin.crease_angle_rad;
    params.scene = wanted->origin.scene;
    params.variant = wanted->origin.variant;
    params.animation = wanted->origin.animation;
    params.time_s = wanted->origin.time_s;
    struct import_source source = *r->source;
    source.name = file->shown;
    source.path = file->path;
    source.bytes = file->file.data;
    source.size = file->file.size;
    source.parts = (struct file_parts){.file = -1, .memory = file->file.data, .size = file->file.size};
    source.file = &file->file;
    source.params = &params;
    source.open_state = &companions;
    if (!companions_of_model(r->source, wanted->file, file, &inner->arena, &companions, r->json.error))
        return false;
    const struct importer *importer = source.importer_for(&source, NULL, r->json.error);
    if (!importer)
        return false;
    if (importer->is_scene_file)
        return json_fail(&r->json, KEY_OF(wanted->place, "file"), "'%s' is a scene file, expected a model",
                         source.name);
    inner->up = importer->up;
    inner->format = importer->name;
    inner->color = r->color;
    model->crease_angle_rad = importer_crease(importer, wanted->origin.normals, wanted->origin.crease_angle_rad);
    if (!importer->load(&source, inner, r->json.error) ||
        !scene_repair(inner, source.name, wanted->origin.normals, wanted->origin.crease_angle_rad, source.pool,
                      r->json.error))
        return false;
    uint64_t items = 0;
    for (int i = 0; i < inner->meshes.count; i++)
        items += mesh_items(scene_mesh(inner, i));
    return (items || fail(r->json.error, LAM_CANNOT_READ, "%s: contains no triangles, lines or points", source.name)) &&
           scene_give_colors_white(inner, r->json.error);
}

static bool open_file(struct reader *r, const struct model_wanted *wanted, struct companion *file)
{
    lam_error reason = {0};
    if (r->source->open_of_scene(r->source, wanted->file, &r->scene->arena, file, &reason))
        return true;
    if (reason.code == LAM_CANNOT_READ)
        return json_fail(&r->json, KEY_OF(wanted->place, "file"), "%s", reason.text);
    *r->json.error = reason;
    return false;
}

// Computes normals, tangents (whose direction depends on the model's format) and extents.
static bool complete(struct reader *r, const struct model_wanted *wanted, struct model *model)
{
    struct lam_scene *inner = &model->inner;
    return scene_prepare(inner, wanted->origin.normals, model->crease_angle_rad, r->source->pool, r->source->call,
                         r->json.error) &&
           scene_make_tangents(inner, false, r->source->call, r->json.error) &&
           scene_measure(inner, r->source->pool, r->json.error);
}

static struct model *read_model(struct reader *r, const struct model_wanted *wanted, struct companion *file)
{
    struct model *model = arena_alloc_zeroed(&r->scene->arena, sizeof *model);
    if (!model)
        return no_memory(r, sizeof *model), NULL;
    model->origin = wanted->origin;
    model->origin.path = file ? file->path : NULL;
    model->crease_angle_rad = wanted->origin.crease_angle_rad;
    model->inner.arena = r->scene->arena;
    model->inner.default_material = &model->inner_material;
    bool ok = (file ? import_file(r, wanted, file, model) : make_shape(r, wanted, model)) && complete(r, wanted, model);
    r->scene->arena = model->inner.arena;
    // Even after an error, the outer scene adopts the textures and thereby becomes responsible for freeing them.
    for (int i = 0; i < model->inner.textures.count; i++) {
        lam_texture *texture = ((lam_texture **)model->inner.textures.items)[i];
        ok = scene_adopt_texture(r->scene, texture, ok ? r->json.error : NULL) && ok;
    }
    for (int i = 0; ok && i < model->inner.warnings.count; i++)
        scene_warn(r->scene, "%s", ((const char **)model->inner.warnings.items)[i]);
    if (ok && !r->scene->clear_materials)
        r->scene->first_clear = model->inner.first_clear;
    r->scene->clear_materials += model->inner.clear_materials;
    return ok ? model : NULL;
}

// --- finding

// Makes the key that identifies the surface of a formula. Returns false if the key is too long.
static bool key_of_formula(const struct model_wanted *wanted, char key[KEY_SIZE])
{
    const lam_formula *f = wanted->origin.formula;
    int length =
        snprintf(key, KEY_SIZE, "formula %d %a %d %d %d %d %s\n%s\n%s\n%s\n%s\n%s", (int)wanted->origin.normals,
                 wanted->origin.crease_angle_rad, f->u_segments, f->v_segments, f->flip, f->implicit, f->u ? f->u : "",
                 f->v ? f->v : "", f->x ? f->x : "", f->y ? f->y : "", f->z ? f->z : "", f->text);
    return length > 0 && length < KEY_SIZE;
}

// Makes the key that identifies a model: the kind of normals, and the shape, the formula or the file.
static bool key_of(const struct model_wanted *wanted, const char *file, char key[KEY_SIZE])
{
    if (wanted->origin.formula)
        return key_of_formula(wanted, key);
    const lam_shape_params *s = &wanted->origin.segments;
    int length = file
                     ? snprintf(key, KEY_SIZE, "file %d %a %a %s\n%s\n%s\n%s", (int)wanted->origin.normals,
                                wanted->origin.crease_angle_rad, wanted->origin.time_s, file,
                                wanted->origin.scene ? wanted->origin.scene : "",
                                wanted->origin.variant ? wanted->origin.variant : "",
                                wanted->origin.animation ? wanted->origin.animation : "")
                     : snprintf(key, KEY_SIZE, "shape %d %a %a %d %d %s", (int)wanted->origin.normals,
                                wanted->origin.crease_angle_rad, s->radius, s->slices, s->stacks, wanted->origin.shape);
    return length > 0 && length < KEY_SIZE;
}

static struct model *known(const struct reader *r, const char *key)
{
    int index = name_table_find(&r->models_by_key, key);
    return index >= 0 ? ((struct model **)r->models.items)[index] : NULL;
}

// Registers the model under one more key.
static bool note(struct reader *r, struct model *model, const char *key)
{
    const char *kept = arena_string(&r->scene->arena, key);
    if (!kept)
        return no_memory(r, strlen(key));
    int index = scene_append(r->scene, &r->models, &model, sizeof(struct model *), r->json.error);
    return index >= 0 && (name_table_add(&r->models_by_key, kept, index) || no_memory(r, KEY_SIZE));
}

static struct model *find_file(struct reader *r, const struct model_wanted *wanted, const char *key)
{
    struct companion file;
    char real_key[KEY_SIZE];
    if (!open_file(r, wanted, &file))
        return NULL;
    bool fits = key_of(wanted, file.real, real_key);
    struct model *model = fits ? known(r, real_key) : NULL;
    if (!model) {
        model = read_model(r, wanted, &file);
        if (model && fits && strcmp(key, real_key) != 0 && !note(r, model, real_key))
            model = NULL;
    }
    file_release(&file.file);
    return model;
}

static struct model *find_model(struct reader *r, const struct model_wanted *wanted)
{
    char key[KEY_SIZE];
    if (!key_of(wanted, wanted->file, key)) {
        json_fail(&r->json, KEY_OF(wanted->place, wanted->file ? "file" : "shape"),
                  wanted->origin.formula ? "the formula is too long" : "the name is too long");
        return NULL;
    }
    struct model *model = known(r, key);
    if (model)
        return model;
    model = wanted->file ? find_file(r, wanted, key) : read_model(r, wanted, NULL);
    return model && note(r, model, key) ? model : NULL;
}

// --- adding to the scene

static bool add_mesh(struct reader *r, const struct model *model, int index, int materials, bool field_tangents)
{
    struct lam_scene *scene = r->scene;
    lam_mesh mesh = *scene_mesh(&model->inner, index);
    lam_part *parts = arena_array(&scene->arena, mesh.part_count, sizeof *parts);
    if (!parts)
        return no_memory(r, mesh.part_count * sizeof *parts);
    for (uint32_t i = 0; i < mesh.part_count; i++) {
        parts[i] = mesh.parts[i];
        parts[i].material += parts[i].material >= 0 ? materials : 0;
    }
    if (mesh.part_count)
        mesh.parts = parts;
    if (field_tangents)
        mesh.tangents = NULL;
    return scene_append(scene, &scene->extents, scene_extent(&model->inner, index), sizeof(struct scene_extent),
                        r->json.error) >= 0 &&
           scene_adopt_mesh(scene, &mesh, r->json.error) >= 0;
}

// Appends the model's items to the scene, with shifted indices.
static bool add_items(struct reader *r, const struct model *model, bool field_tangents, int *index)
{
    struct lam_scene *scene = r->scene;
    const struct lam_scene *inner = &model->inner;
    int meshes = scene->meshes.count, materials = scene->materials.count, objects = scene->objects.count,
        groups = scene->groups.count;
    bool ok = true;
    for (int i = 0; ok && i < inner->materials.count; i++)
        ok = scene_adopt_material(scene, (const lam_material *)inner->materials.items + i, r->json.error) >= 0;
    for (int i = 0; ok && i < inner->meshes.count; i++)
        ok = add_mesh(r, model, i, materials, field_tangents);
    for (int i = 0; ok && i < inner->groups.count; i++) {
        lam_group group = ((const lam_group *)inner->groups.items)[i];
        group.parent += group.parent ? groups : 0;
        ok = scene_append(scene, &scene->groups, &group, sizeof group, r->json.error) >= 0;
    }
    for (int i = 0; ok && i < inner->objects.count; i++) {
        lam_object object = *scene_object(inner, i);
        object.group += object.group ? groups : 0;
        object.mesh += meshes;
        object.material += object.material >= 0 ? materials : 0;
        object.back_material += object.back_material >= 0 ? materials : 0;
        ok = scene_adopt_object(scene, &object, r->json.error) >= 0;
    }
    struct scene_origin origin = model->origin;
    origin.field_tangents = field_tangents;
    origin.first_mesh = meshes;
    origin.first_material = materials;
    *index = scene->origins.count;
    return ok && scene_note_origin(scene, origin, objects, r->json.error);
}

// Adds copies of the model's objects, with the same meshes and materials.
static bool add_objects(struct reader *r, int origin_index)
{
    const struct scene_origin *origin = (const struct scene_origin *)r->scene->origins.items + origin_index;
    for (int i = 0; i < origin->object_count; i++)
        if (scene_adopt_object(r->scene, &origin->objects[i], r->json.error) < 0)
            return false;
    return true;
}

static bool same_json(const json_t *a, const json_t *b) { return a == b || (a && b && json_equal(a, b)); }

static const struct variant *find_variant(const struct model *model, const struct model_wanted *wanted)
{
    for (int i = 0; i < model->variant_count && i < VARIANTS; i++) {
        const struct variant *variant = &model->variants[i];
        if (variant->field_tangents == wanted->origin.field_tangents &&
            same_json(variant->materials, wanted->materials) && same_json(variant->parts, wanted->parts))
            return variant;
    }
    return NULL;
}

bool add_model(struct reader *r, const struct model_wanted *wanted, int *origin, bool *own)
{
    struct lam_scene *scene = r->scene;
    r->models_by_key.memory = &scene->arena;
    struct model *model = find_model(r, wanted);
    if (!model)
        return false;
    const struct variant *variant = find_variant(model, wanted);
    *own = !variant;
    bool ok;
    if (variant) {
        *origin = variant->origin;
        ok = add_objects(r, *origin);
    } else {
        ok = add_items(r, model, wanted->origin.field_tangents, origin);
        model->variants[model->variant_count++ % VARIANTS] =
            (struct variant){wanted->origin.field_tangents, wanted->materials, wanted->parts, *origin};
    }
    for (int i = 0; ok && !r->has_lights && i < model->inner.lights.count; i++)
        ok = scene_adopt_light(scene, (const lam_light *)model->inner.lights.items + i, r->json.error) >= 0;
    for (int i = 0; ok && i < model->inner.cameras.count; i++)
        ok = scene_append(scene, &scene->cameras, (const struct scene_camera *)model->inner.cameras.items + i,
                          sizeof(struct scene_camera), r->json.error) >= 0;
    return ok;
}
