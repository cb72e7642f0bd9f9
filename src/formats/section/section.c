// section.c: cuts all objects of a scene by each of its planes in turn.
#include "section.h"

#include "fail.h"
#include "float_state.h"
#include "linear.h"

#include <lambent/material.h>

#include <stdlib.h>
#include <string.h>

// The state while a scene is cut. The new meshes are in `own`.
struct cutting {
    lam_scene *scene;
    lam_object *objects;  // of the scene, with their new meshes
    lam_mesh *meshes;     // of the objects
    bool *changed;        // whether the object has a new mesh
    struct arena scratch; // the arrays of one plane
    struct arena *own;
    lam_section planes[LAM_SECTIONS_MAX]; // in world space
    double areas[LAM_SECTIONS_MAX];
    int open;                  // number of outlines that are not closed
    bool strokes, translucent; // lines, points or transparent parts were cut
    int first_material;        // of the materials of cut surfaces
    struct call_control *call;
    lam_error *error;
};

// Finds the extent of the visible objects along a direction in world space.
static void find_extent(const struct cutting *c, lam_vec3 n, double ends[2])
{
    ends[0] = 1e308;
    ends[1] = -1e308;
    for (int i = 0; i < c->scene->objects.count; i++) {
        const lam_object *object = scene_object(c->scene, i);
        const lam_mesh *mesh = scene_mesh(c->scene, object->mesh);
        const struct scene_extent *extent = scene_extent(c->scene, object->mesh);
        for (uint32_t k = 0; scene_shows(c->scene, i) && k < extent->used_count; k++) {
            const float *p = mesh->positions + 3 * (size_t)(extent->used ? extent->used[k] : k);
            const lam_vec3 q =
                v3((double)p[0] + mesh->origin[0], (double)p[1] + mesh->origin[1], (double)p[2] + mesh->origin[2]);
            const double at = v3_dot(n, mat4_point(&object->transform, q));
            ends[0] = at < ends[0] ? at : ends[0];
            ends[1] = at > ends[1] ? at : ends[1];
        }
    }
}

// Returns the section in world space.
static lam_section place_plane(const struct cutting *c, const lam_section *section)
{
    const lam_mat4 *placement = &c->scene->placement;
    lam_section placed = {.normal = section->normal, .distance = section->distance, .color = section->color};
    double m[3][3], ends[2];
    mat4_normal_matrix(placement, m);
    const double n[3] = {placed.normal.x, placed.normal.y, placed.normal.z}, sign = mat4_determinant3(placement);
    const lam_vec3 turned =
        v3(m[0][0] * n[0] + m[0][1] * n[1] + m[0][2] * n[2], m[1][0] * n[0] + m[1][1] * n[1] + m[1][2] * n[2],
           m[2][0] * n[0] + m[2][1] * n[1] + m[2][2] * n[2]);
    const lam_vec3 at = v3_scale(v3_unit(section->normal), section->distance);
    placed.normal = v3_unit(v3_scale(turned, sign < 0 ? -1 : 1));
    if (section->relative) {
        find_extent(c, placed.normal, ends);
        placed.distance = ends[0] + section->distance * (ends[1] - ends[0]);
    } else if (!mat4_is_identity(placement)) {
        placed.distance = v3_dot(placed.normal, mat4_point(placement, at));
    }
    return placed;
}

static int material_of(const lam_object *object, const lam_mesh *mesh, uint32_t part)
{
    return object->material >= 0 ? object->material : mesh->part_count ? mesh->parts[part].material : -1;
}

static const lam_material *material_at(const struct cutting *c, int index)
{
    return index >= 0 ? lam_scene_material(c->scene, index) : c->scene->default_material;
}

static bool is_opaque(const lam_material *m)
{
    return m->diffuse.a > 0 && !(m->physical && m->transmission > 0) &&
           (m->diffuse.a >= 1 || m->alpha_mode != LAM_ALPHA_BLEND);
}

// Finds the material of a cut surface: the part's material without textures, or in the section's colour. Returns −2 on
// failure.
static int cap_material(struct cutting *c, const lam_section *plane, int index)
{
    lam_material material = *material_at(c, index);
    bool maps = false;
    for (int i = 0; i < LAM_MAP_COUNT; i++) {
        maps |= material.maps[i] != NULL;
        material.maps[i] = NULL;
    }
    if (plane->color.a <= 0 && !maps)
        return index;
    if (plane->color.a > 0) {
        material.diffuse = (lam_rgba){plane->color.r, plane->color.g, plane->color.b, 1};
        material.ambient = (lam_rgb){plane->color.r, plane->color.g, plane->color.b};
    }
    for (int i = c->first_material; i < c->scene->materials.count; i++)
        if (memcmp(lam_scene_material(c->scene, i), &material, sizeof material) == 0)
            return i;
    const int added = scene_adopt_material(c->scene, &material, c->error);
    return added < 0 ? -2 : added;
}

// Finds the objects that a plane cuts.
static bool find_cuts(struct cutting *c, const lam_section *plane, struct cut_object *cuts, int *count)
{
    for (int i = 0; i < c->scene->objects.count; i++) {
        struct cut_object *cut = &cuts[*count];
        lam_mesh *mesh = &c->meshes[i];
        lam_mat4 origin = mat4_translate(mesh->origin[0], mesh->origin[1], mesh->origin[2]);
        *cut = (struct cut_object){.object = i, .to_world = mat4_mul(&c->objects[i].transform, &origin)};
        cut->cut.mesh = mesh;
        const double n[3] = {plane->normal.x, plane->normal.y, plane->normal.z};
        for (int k = 0; k < 4; k++)
            for (int j = 0; j < 3; j++)
                cut->cut.plane[k] += n[j] * cut->to_world.m[j][k];
        cut->cut.plane[3] -= plane->distance;
        if (c->objects[i].hidden || mesh->hidden)
            continue;
        if (!mesh_cut_find(&cut->cut, &c->scratch, c->call, c->error))
            return false;
        if (!cut->cut.removed)
            continue;
        const uint32_t parts = mesh->part_count ? mesh->part_count : 1;
        bool *closes = arena_array(&c->scratch, parts, sizeof *closes);
        if (!closes)
            return call_memory_error(c->call, parts, c->error);
        for (uint32_t part = 0; part < parts; part++) {
            const lam_material *material = material_at(c, material_of(&c->objects[i], mesh, part));
            closes[part] = is_opaque(material);
            c->translucent |= !closes[part] && material->diffuse.a > 0 && cut->cut.edge_count;
        }
        c->strokes |= mesh_is_strokes(mesh) && cut->cut.items;
        cut->closes = closes;
        ++*count;
    }
    return true;
}

// Replaces the mesh of a cut object.
static bool take_cut(struct cutting *c, const lam_section *plane, const struct cut_object *cut)
{
    lam_mesh *mesh = &c->meshes[cut->object];
    lam_object *object = &c->objects[cut->object];
    const uint32_t parts = mesh->part_count ? mesh->part_count : 1;
    int *materials = arena_array(&c->scratch, parts, sizeof *materials);
    if (!materials)
        return call_memory_error(c->call, parts * sizeof *materials, c->error);
    if (!cut->cut.items) {
        object->hidden = true;
        return true;
    }
    for (uint32_t part = 0; part < parts; part++) {
        materials[part] = cut->cut.caps[part].count ? cap_material(c, plane, material_of(object, mesh, part)) : -1;
        if (materials[part] == -2)
            return false;
    }
    lam_mesh made;
    if (!mesh_cut_make(&cut->cut, materials, c->own, &made, c->call, c->error))
        return false;
    for (uint32_t part = 0; object->material >= 0 && part < made.part_count; part++)
        if (part < parts)
            ((lam_part *)(uintptr_t)made.parts)[part].material = object->material;
    object->material = -1;
    *mesh = made;
    c->changed[cut->object] = true;
    return true;
}

static bool cut_all(struct cutting *c, const lam_section *plane, double *area)
{
    arena_start(&c->scratch, c->call);
    struct cut_object *cuts = arena_array(&c->scratch, (size_t)c->scene->objects.count + 1, sizeof *cuts);
    int count = 0;
    struct outline_result result = {0};
    bool ok = cuts || call_memory_error(c->call, sizeof *cuts, c->error);
    ok = ok && find_cuts(c, plane, cuts, &count) &&
         outlines_close(cuts, count, plane, &c->scratch, &result, c->call, c->error);
    for (int i = 0; ok && i < count; i++)
        ok = take_cut(c, plane, &cuts[i]);
    arena_free(&c->scratch);
    *area = result.area;
    c->open += result.open;
    if (ok && !count)
        lam_scene_add_warning(c->scene, "a section removes nothing, because its plane is outside the model");
    return ok;
}

// --- the scene's state

static bool adopt_meshes(struct cutting *c)
{
    lam_scene *scene = c->scene;
    bool any = false;
    for (int i = 0; i < scene->objects.count; i++) {
        any |= !c->objects[i].hidden && !c->meshes[i].hidden && mesh_items(&c->meshes[i]);
        if (!c->changed[i])
            continue;
        struct scene_extent extent;
        struct arena whole = scene->arena; // the mesh is measured in its own memory
        scene->arena = *c->own;
        bool ok = scene_measure_mesh(scene, &c->meshes[i], &extent, NULL, c->error);
        *c->own = scene->arena;
        scene->arena = whole;
        c->objects[i].mesh = scene->meshes.count;
        ok = ok && scene_append(scene, &scene->meshes, &c->meshes[i], sizeof(lam_mesh), c->error) >= 0 &&
             scene_append(scene, &scene->extents, &extent, sizeof extent, c->error) >= 0;
        if (!ok)
            return false;
    }
    return any || fail(c->error, LAM_BAD_ARGUMENT, "the sections remove the whole model");
}

static void warn(const struct cutting *c)
{
    if (c->open)
        lam_scene_add_warning(c->scene, "a cut surface is missing where the surface of the model has holes");
    if (c->strokes)
        lam_scene_add_warning(c->scene, "sections cut lines and points, but add no cut surface to them");
    if (c->translucent)
        lam_scene_add_warning(c->scene, "sections add no cut surface to transparent parts");
}

static bool cut_objects(struct cutting *c, const lam_section *sections, int count)
{
    for (int i = 0; i < c->scene->objects.count; i++) {
        c->objects[i] = *scene_object(c->scene, i);
        c->meshes[i] = *scene_mesh(c->scene, c->objects[i].mesh);
    }
    for (int i = 0; i < count; i++)
        c->planes[i] = place_plane(c, &sections[i]);
    for (int i = 0; i < count; i++)
        if (!cut_all(c, &c->planes[i], &c->areas[i]))
            return false;
    return adopt_meshes(c);
}

// Makes the scene show the cut objects, and keeps the whole ones.
static bool take_objects(struct cutting *c, const lam_section *sections, int count, struct scene_cut *cut)
{
    lam_scene *scene = c->scene;
    const size_t bytes = (size_t)scene->objects.count * sizeof(lam_object);
    cut->objects = arena_alloc(c->own, bytes);
    if (!cut->objects)
        return call_memory_error(c->call, bytes, c->error);
    memcpy(cut->objects, scene->objects.items, bytes);
    memcpy(scene->objects.items, c->objects, bytes);
    memcpy(cut->sections, sections, (size_t)count * sizeof *sections);
    memcpy(cut->placed, c->planes, sizeof cut->placed);
    memcpy(cut->areas, c->areas, sizeof cut->areas);
    cut->object_count = scene->objects.count;
    cut->all = scene->meshes.count + scene->materials.count;
    cut->items = scene->object_items;
    scene->object_items = 0;
    for (int i = 0; i < scene->objects.count; i++)
        scene->object_items += mesh_items(scene_mesh(scene, c->objects[i].mesh));
    c->own->call = NULL;
    scene->cut = cut;
    return true;
}

bool scene_cut(struct lam_scene *scene, const lam_section *sections, int count, struct call_control *call,
               lam_error *error)
{
    if (!scene_uncut(scene, error))
        return false;
    if (!count)
        return true;
    const size_t objects = (size_t)scene->objects.count + 1;
    struct cutting c = {.scene = scene,
                        .objects = calloc(objects, sizeof *c.objects),
                        .meshes = calloc(objects, sizeof *c.meshes),
                        .changed = calloc(objects, sizeof *c.changed),
                        .own = arena_new(call),
                        .first_material = scene->materials.count,
                        .call = call,
                        .error = error};
    const int meshes = scene->meshes.count;
    struct scene_cut *cut = c.own ? arena_alloc_zeroed(c.own, sizeof *cut) : NULL;
    bool ok = (cut && c.objects && c.meshes && c.changed) || fail_memory(error, objects * sizeof *c.meshes);
    if (ok)
        *cut = (struct scene_cut){.count = count, .own = c.own, .meshes = meshes, .materials = c.first_material};
    ok = ok && cut_objects(&c, sections, count) && take_objects(&c, sections, count, cut);
    if (ok) {
        warn(&c);
    } else {
        scene->meshes.count = scene->extents.count = meshes;
        scene->materials.count = c.first_material;
        arena_delete(c.own);
    }
    free(c.objects);
    free(c.meshes);
    free(c.changed);
    return ok;
}

bool lam_scene_set_sections(lam_scene *scene, const lam_section *sections, int count, const lam_control *control,
                            lam_error *error)
{
    if (!scene || (count && !sections))
        return fail(error, LAM_BAD_ARGUMENT, "lam_scene_set_sections: %s is NULL", scene ? "sections" : "scene");
    if (count < 0 || count > LAM_SECTIONS_MAX)
        return fail(error, LAM_BAD_ARGUMENT, "found %d sections, expected at most %d", count, LAM_SECTIONS_MAX);
    for (int i = 0; i < count; i++) {
        const lam_section *s = &sections[i];
        if (!check_reserved("lam_section", s, error))
            return false;
        if (!v3_finite(s->normal) || !(v3_length(s->normal) > 0) || !math_finite(s->distance))
            return fail(error, LAM_BAD_ARGUMENT, "section %d: the normal is zero, or a number is not finite", i);
    }
    struct call_control call;
    call_start(&call, control);
    uint64_t state = float_state_enter();
    bool ok = scene_cut(scene, sections, count, &call, error);
    float_state_leave(state);
    return ok;
}
