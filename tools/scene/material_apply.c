// material_apply.c: applies --material, --back-material and --hide to a scene's objects.
#include "material_apply.h"

#include <stdio.h>
#include <string.h>

#include "console.h"

static lam_material material_at(const lam_scene *scene, int index)
{
    const lam_material *material = lam_scene_material(scene, index);
    return material ? *material : lam_material_default();
}

// Returns an invisible copy of a material: surfaces with the copy are not drawn and do not block light.
static lam_material clear_copy(lam_material material)
{
    material.diffuse.a = 0;
    material.alpha_mode = LAM_ALPHA_MASK;
    material.alpha_cutoff = 0.5f;
    return material;
}

// Returns the material as changed by the option. An option without a text hides the surface (--hide).
static lam_material changed_by(const struct material_option *option, lam_material material)
{
    return *option->text ? material_option_apply(option, material) : clear_copy(material);
}

// Adds a changed copy of the material and returns its index, or −1 on failure.
static int add_changed(const struct material_option *option, int from, lam_scene *scene, lam_error *error)
{
    lam_material changed = changed_by(option, material_at(scene, from));
    return lam_scene_add_material(scene, &changed, error);
}

// Returns the material on an object's front, or −2 if there are several.
static int front_of(const lam_scene *scene, const lam_object *object)
{
    const lam_mesh *mesh = lam_scene_mesh(scene, object->mesh);
    if (object->material >= 0 || !mesh->part_count)
        return object->material;
    for (uint32_t i = 1; i < mesh->part_count; i++)
        if (mesh->parts[i].material != mesh->parts[0].material)
            return -2;
    return mesh->parts[0].material;
}

// Counts the objects that use a mesh and reports whether the object at `index` is the first of them.
static int users_of(const lam_scene *scene, int mesh, int index, bool *first)
{
    int users = 0;
    *first = false;
    for (int i = 0; i < lam_scene_object_count(scene); i++)
        if (lam_scene_object(scene, i)->mesh == mesh) {
            *first |= users == 0 && i == index;
            users++;
        }
    return users;
}

// Changes the material of each part. Adjacent parts that shared a material share its changed copy.
static bool change_parts(const struct material_option *option, int mesh, lam_scene *scene, lam_error *error)
{
    bool whole = option->named; // the option replaces every field
    int from = -2, changed = -1;
    for (uint32_t i = 0; i < lam_scene_mesh(scene, mesh)->part_count; i++) {
        int material = lam_scene_mesh(scene, mesh)->parts[i].material;
        if (changed < 0 || (material != from && !whole))
            changed = add_changed(option, material, scene, error);
        if (changed < 0 || !lam_scene_set_part_material(scene, mesh, i, changed, error))
            return false;
        from = material;
    }
    return true;
}

static bool set_front(const struct material_option *option, const char *name, int index, lam_scene *scene,
                      lam_error *error)
{
    lam_object object = *lam_scene_object(scene, index);
    bool whole = option->named, first;
    int front = front_of(scene, &object), users = users_of(scene, object.mesh, index, &first);
    bool by_part = object.material < 0 && lam_scene_mesh(scene, object.mesh)->part_count;
    if (by_part && users == 1) // so that a later option can still change a single part
        return change_parts(option, object.mesh, scene, error);
    if (front == -2 && !whole) {
        if (!option->target)
            return !first || change_parts(option, object.mesh, scene, error);
        return complain(
            error, LAM_BAD_ARGUMENT,
            "option '--%s': '%.100s' shares its mesh with other objects and shows several materials; name a "
            "part, or begin with a material's name",
            name, option->target);
    }
    object.material = add_changed(option, front == -2 ? -1 : front, scene, error);
    return object.material >= 0 && lam_scene_set_object(scene, index, &object, error);
}

static bool set_back(const struct material_option *option, const char *name, int index, lam_scene *scene,
                     lam_error *error)
{
    lam_object object = *lam_scene_object(scene, index);
    int front = front_of(scene, &object);
    if (front == -2 && !option->named)
        return complain(error, LAM_BAD_ARGUMENT,
                        "option '--%s': the front of '%.100s' has several materials, so missing keys cannot be copied "
                        "from it; begin with a material's name: %s gold,…",
                        name, object.name ? object.name : "the model", name);
    object.back_material = add_changed(option, front == -2 ? -1 : front, scene, error);
    return object.back_material >= 0 && lam_scene_set_object(scene, index, &object, error);
}

static bool same(const char *a, const char *b) { return a && strcmp(a, b) == 0; }

// Returns whether an object is below an assembly or a node of this name.
static bool is_below(const lam_scene *scene, const lam_object *object, const char *name)
{
    const lam_group *group = lam_scene_group(scene, object->group - 1);
    while (group && !same(group->name, name))
        group = lam_scene_group(scene, group->parent - 1);
    return group;
}

// Returns whether an object has this name, or is below an assembly or a node with it.
static bool belongs_to(const lam_scene *scene, const lam_object *object, const char *name)
{
    return same(object->name, name) || is_below(scene, object, name);
}

// Applies the option to the objects that belong to its target. Returns their number, or −1 on failure.
static int set_objects(const struct material_option *option, bool back, const char *name, lam_scene *scene,
                       lam_error *error)
{
    int found = 0;
    for (int i = 0; i < lam_scene_object_count(scene); i++) {
        if (option->target && !belongs_to(scene, lam_scene_object(scene, i), option->target))
            continue;
        found++;
        if (!(back ? set_back(option, name, i, scene, error) : set_front(option, name, i, scene, error)))
            return -1;
    }
    return found;
}

// Applies the option to the parts with this name, in all meshes.
static int set_parts(const struct material_option *option, lam_scene *scene, lam_error *error)
{
    int found = 0;
    for (int m = 0; m < lam_scene_mesh_count(scene); m++)
        for (uint32_t p = 0; p < lam_scene_mesh(scene, m)->part_count; p++) {
            const lam_part *part = &lam_scene_mesh(scene, m)->parts[p];
            if (!same(part->name, option->target))
                continue;
            int changed = add_changed(option, part->material, scene, error);
            if (changed < 0 || !lam_scene_set_part_material(scene, m, p, changed, error))
                return -1;
            found++;
        }
    return found;
}

static int set_materials(const struct material_option *option, lam_scene *scene, lam_error *error)
{
    int found = 0;
    for (int i = 0; i < lam_scene_material_count(scene); i++) {
        if (!same(lam_scene_material(scene, i)->name, option->target))
            continue;
        lam_material changed = changed_by(option, *lam_scene_material(scene, i));
        changed.name = option->target;
        if (!lam_scene_set_material(scene, i, &changed, error))
            return -1;
        found++;
    }
    return found;
}

// The names in a model, for an error message about an unknown target.
struct target_names {
    struct suggestion nearest;
    char first[200]; // the first few: "'body', 'head'"
    int count;
};

static void offer(struct target_names *names, const char *name)
{
    if (!name || !*name)
        return;
    suggest_try(&names->nearest, name);
    char quoted[50];
    snprintf(quoted, sizeof quoted, "'%.40s'", name);
    size_t used = strlen(names->first);
    if (!strstr(names->first, quoted) && names->count++ < 4)
        snprintf(names->first + used, sizeof names->first - used, "%s%s", used ? ", " : "", quoted);
}

static bool not_found(const struct material_option *option, bool back, const char *name, const lam_scene *scene,
                      lam_error *error)
{
    struct target_names names = {.nearest = suggest_start(option->target)};
    for (int i = 0; i < lam_scene_object_count(scene); i++)
        offer(&names, lam_scene_object(scene, i)->name);
    for (int i = 0; !back && lam_scene_group(scene, i); i++)
        offer(&names, lam_scene_group(scene, i)->name);
    for (int m = 0; !back && m < lam_scene_mesh_count(scene); m++)
        for (uint32_t p = 0; p < lam_scene_mesh(scene, m)->part_count; p++)
            offer(&names, lam_scene_mesh(scene, m)->parts[p].name);
    for (int i = 0; !back && i < lam_scene_material_count(scene); i++)
        offer(&names, lam_scene_material(scene, i)->name);
    char advice[300] = "; the model contains no names";
    if (names.nearest.best)
        snprintf(advice, sizeof advice, "; did you mean '%.60s'?", names.nearest.best);
    else if (names.count)
        snprintf(advice, sizeof advice, "; it has %s%s", names.first, names.count > 4 ? ", ..." : "");
    return complain(error, LAM_BAD_ARGUMENT, "option '--%s': the model has no %s '%.60s'%s", name,
                    back ? "object" : "object, part or material", option->target, advice);
}

bool material_option_set(const struct material_option *option, bool back, const char *name, lam_scene *scene,
                         lam_error *error)
{
    int found = set_objects(option, back, name, scene, error);
    if (found == 0 && !back && option->target)
        found = set_parts(option, scene, error);
    if (found == 0 && !back && option->target)
        found = set_materials(option, scene, error);
    if (found == 0)
        return not_found(option, back, name, scene, error);
    return found > 0;
}

// Hides the objects with this name, and all below an assembly or a node of this name. Returns their number, or −1 and an error.
static int hide_objects(const char *target, lam_scene *scene, lam_error *error)
{
    int found = 0;
    for (int i = 0; i < lam_scene_object_count(scene); i++) {
        if (!belongs_to(scene, lam_scene_object(scene, i), target))
            continue;
        if (!lam_scene_hide_object(scene, i, true, error))
            return -1;
        found++;
    }
    return found;
}

// Hides the objects that show only this material, so that fitting the camera ignores their boxes.
static bool hide_objects_of(int material, lam_scene *scene, lam_error *error)
{
    for (int i = 0; i < lam_scene_object_count(scene); i++)
        if (front_of(scene, lam_scene_object(scene, i)) == material && !lam_scene_hide_object(scene, i, true, error))
            return false;
    return true;
}

bool material_option_hide(const char *target, bool may_lack, lam_scene *scene, lam_error *error)
{
    const struct material_option option = {.target = target};
    int found = hide_objects(target, scene, error);
    if (found == 0)
        found = set_parts(&option, scene, error);
    if (found == 0) {
        found = set_materials(&option, scene, error);
        for (int i = 0; found > 0 && i < lam_scene_material_count(scene); i++)
            if (same(lam_scene_material(scene, i)->name, target) && !hide_objects_of(i, scene, error))
                return false;
    }
    if (found == 0) {
        lam_error reason;
        not_found(&option, false, "hide", scene, &reason);
        if (may_lack)
            lam_scene_add_warning(scene, reason.text);
        return may_lack || complain(error, reason.code, "%s", reason.text);
    }
    return found > 0;
}

// Returns whether an object, its only part or its only material has this name.
static bool is_named(const lam_scene *scene, const lam_object *object, const char *name)
{
    const lam_mesh *mesh = lam_scene_mesh(scene, object->mesh);
    const int material = front_of(scene, object);
    return belongs_to(scene, object, name) || (mesh->part_count == 1 && same(mesh->parts->name, name)) ||
           (material >= 0 && same(lam_scene_material(scene, material)->name, name));
}

bool material_option_only(const struct texts *names, bool may_lack, lam_scene *scene, lam_error *error)
{
    const int count = lam_scene_object_count(scene);
    bool any = false;
    for (int k = 0; k < names->count; k++) {
        const struct material_option option = {.target = names->items[k]};
        bool found = false;
        for (int i = 0; i < count && !found; i++)
            found = is_named(scene, lam_scene_object(scene, i), option.target);
        lam_error reason;
        if (!found && !not_found(&option, false, "only", scene, &reason)) {
            if (!may_lack)
                return complain(error, reason.code, "%s", reason.text);
            lam_scene_add_warning(scene, reason.text);
        }
        any |= found;
    }
    for (int i = 0; any && i < count; i++) {
        bool shown = false;
        for (int k = 0; k < names->count; k++)
            shown |= is_named(scene, lam_scene_object(scene, i), names->items[k]);
        if (!shown && !lam_scene_hide_object(scene, i, true, error))
            return false;
    }
    return true;
}
