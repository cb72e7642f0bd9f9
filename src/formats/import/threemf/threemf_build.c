// threemf_build.c: adds the objects of the build items to the scene, and the components of these objects.
#include "threemf.h"

#include "fail.h"
#include "linear.h"
#include "shown_name.h"

#ifdef HAVE_3MF

enum { DEPTH_MAX = 100 };

// An object in a part, and its transform.
struct instance {
    struct threemf_part *part;
    struct threemf_object *object;
    lam_mat4 transform;
    int depth;
    uint32_t extruder;
};

static bool fail_reference(struct threemf *file, const struct threemf_part *part,
                           const struct threemf_component *component, const char *sentence)
{
    char shown[SHOWN_NAME_SIZE];
    return fail(file->error, LAM_CANNOT_READ, "%s: %s:%zu: found objectid=\"%d\", %s", file->source->name,
                shown_name(part->path, shown), component->line, component->id, sentence);
}

// Returns whether the limits allow following one more reference. References to missing objects are counted too.
static bool check_limits(struct threemf *file)
{
    struct call_control *call = file->source->call;
    return call_check_objects(call, file->source->name, ++file->placed, file->error) &&
           (file->placed % 1024 || call_should_continue(call) || call_error(call, file->error));
}

static bool find(struct threemf *file, struct threemf_part *from, const struct threemf_component *component,
                 struct instance *out)
{
    out->part = component->path ? threemf_part_at(file, component->path) : from;
    if (!out->part)
        return false;
    const struct threemf_resource *resource = threemf_resource_at(out->part, component->id);
    if (!resource || resource->kind != RESOURCE_OBJECT || !resource->object)
        return fail_reference(file, from, component, "expected the id of an object");
    out->object = resource->object;
    double scale = out->part->unit_m / from->unit_m;
    out->transform = component->transform;
    for (int i = 0; i < 9; i++)
        out->transform.m[i / 3][i % 3] *= scale;
    return true;
}

static bool add_object(struct threemf *file, const struct instance *instance)
{
    lam_object object = lam_object_default();
    double determinant = mat4_determinant3(&instance->transform);
    if (!threemf_mesh_make(file, instance->part, instance->object, instance->extruder, &object.mesh))
        return false;
    if (object.mesh < 0)
        return true;
    bool fits = true; // positions beyond this size leave the range of float
    for (int i = 0; i < 12; i++)
        fits &= instance->transform.m[i / 4][i % 4] > -1e30 && instance->transform.m[i / 4][i % 4] < 1e30;
    if (determinant == 0 || !math_finite(determinant) || !fits) {
        file->flattened++;
        return true;
    }
    object.name = instance->object->name;
    object.transform = instance->transform;
    return scene_adopt_object(file->scene, &object, file->error) >= 0;
}

// Places an object and, recursively, its components. // NOLINTNEXTLINE(misc-no-recursion): bounded by DEPTH_MAX
static bool place(struct threemf *file, const struct instance *instance)
{
    struct threemf_object *object = instance->object;
    bool ok = add_object(file, instance);
    object->visiting = true;
    for (size_t i = 0; ok && i < object->component_count; i++) {
        const struct threemf_component *component = &object->components[i];
        struct instance below = {.depth = instance->depth + 1};
        ok = check_limits(file) && find(file, instance->part, component, &below);
        const struct threemf_volume *volume =
            ok ? threemf_volume_at(file, instance->part, object->id, component->id, 0) : NULL;
        enum threemf_role role = volume ? volume->role : ok ? below.object->role : ROLE_PRINTS;
        below.extruder = volume && volume->extruder ? volume->extruder : instance->extruder;
        if (role != ROLE_PRINTS) {
            file->left_out[role]++;
            continue;
        }
        if (ok && below.object->visiting)
            ok = fail_reference(file, instance->part, component, "an object that contains this one");
        if (ok && below.depth > DEPTH_MAX)
            ok = fail_reference(file, instance->part, component, "nested in more than 100 components");
        if (ok) {
            below.transform = mat4_mul(&instance->transform, &below.transform);
            ok = place(file, &below);
        }
    }
    object->visiting = false;
    return ok;
}

bool threemf_build(struct threemf *file, struct threemf_part *root)
{
    const struct threemf_component *items = root->items.items;
    for (size_t i = 0; i < root->items.count; i++) {
        struct instance instance = {.depth = 0};
        if (!check_limits(file) || !find(file, root, &items[i], &instance))
            return false;
        const struct threemf_volume *whole = threemf_volume_at(file, root, items[i].id, WHOLE_OBJECT, 0);
        enum threemf_role role = items[i].off ? SWITCHED_OFF : instance.object->role;
        instance.extruder = whole ? whole->extruder : 0;
        file->left_out[role]++;
        if (role == ROLE_PRINTS && !place(file, &instance))
            return false;
    }
    return true;
}

#endif
