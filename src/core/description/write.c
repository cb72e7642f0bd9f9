// write.c: writes a scene and its settings as a scene file that reproduces the picture. A reader recovers the
// exact bits of every number.
//
// This source file is longer than 600 lines, because it contains one function for each section of a scene file, in the
// order of these sections.
#include "write.h"

#include "fail.h"
#include "float_state.h"
#include "linear.h"

#include <lambent/material.h>

#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

// --- JSON values; a failed allocation clears `ok`

void put(struct scene_writer *w, json_t *object, const char *key, json_t *value)
{
    w->ok &= json_object_set_new(object, key, value) == 0;
}

void append(struct scene_writer *w, json_t *list, json_t *value) { w->ok &= json_array_append_new(list, value) == 0; }

// Makes a JSON number; whole numbers are written without a decimal point.
static json_t *number(double x)
{
    bool whole = x > -1e15 && x < 1e15 && x == (double)(json_int_t)x && !(x == 0 && 1 / x < 0);
    return whole ? json_integer((json_int_t)x) : json_real(x);
}

// Finds the number with the fewest decimals that a reader converts to the same value. Returns false if there is none.
static bool find_decimal(double x, double wanted, double (*read)(double decimal), double *decimal)
{
    double power = 1, size = x < 0 ? -x : x;
    for (int decimals = 0; decimals <= 15 && size * power < 1e15; decimals++, power *= 10) {
        *decimal = (double)(int64_t)(x * power + (x < 0 ? -0.5 : 0.5)) / power;
        if (read(*decimal) == wanted)
            return true;
    }
    *decimal = x;
    return false;
}

static double read_float(double decimal) { return (double)(float)decimal; }
static double read_degrees(double decimal) { return math_radians(decimal); }
static double read_degrees_float(double decimal) { return (double)(float)math_radians(decimal); }

static json_t *number_float(float f)
{
    double decimal;
    find_decimal((double)f, (double)f, read_float, &decimal);
    return number(f == 0 ? (double)f : decimal);
}

static json_t *list_of(struct scene_writer *w, const double *numbers, int count)
{
    json_t *list = json_array();
    for (int i = 0; i < count; i++)
        append(w, list, number(numbers[i]));
    return list;
}

static json_t *vector(struct scene_writer *w, lam_vec3 v) { return list_of(w, (double[]){v.x, v.y, v.z}, 3); }

static json_t *color(struct scene_writer *w, const float *parts, int count)
{
    json_t *list = json_array();
    for (int i = 0; i < count; i++)
        append(w, list, number_float(parts[i]));
    return list;
}

// Converts an angle to degrees. The result converts back to the same value in radians, and has few decimals if
// possible.
static json_t *degrees(double radians)
{
    double plain = math_degrees(radians), best, error = 1e300;
    if (find_decimal(plain, radians, read_degrees, &best))
        return number(best);
    int64_t bits;
    memcpy(&bits, &plain, sizeof bits);
    for (int step = -4; step <= 4; step++) {
        int64_t near_bits = bits + step;
        double candidate;
        memcpy(&candidate, &near_bits, sizeof candidate);
        double off = math_radians(candidate) - radians;
        off = off < 0 ? -off : off;
        if (off < error) {
            error = off;
            best = candidate;
        }
    }
    return number(best);
}

static double degrees_float(float radians)
{
    double decimal;
    find_decimal(math_degrees((double)radians), (double)radians, read_degrees_float, &decimal);
    return decimal;
}

static json_t *word(const struct json_choice *words, int value)
{
    while (words->name && words->value != value)
        words++;
    return json_string(words->name ? words->name : "");
}

// Omits names that are not UTF-8, because JSON cannot store them.
static void put_name(struct scene_writer *w, json_t *object, const char *key, const char *name)
{
    json_t *text = name && *name ? json_string(name) : NULL;
    if (text)
        put(w, object, key, text);
}

// --- paths

// Makes the relative path from `folder` to `file`. Both arguments must be absolute paths without links.
static bool relative_path(const char *folder, const char *file, char *out, size_t capacity)
{
    size_t common = 0, i = 0, used = 0;
    for (; folder[i] && folder[i] == file[i]; i++)
        if (folder[i] == '/')
            common = i + 1;
    if (!folder[i] && file[i] == '/')
        common = i + 1;
    if (strcmp(folder, "/") == 0)
        common = 1;
    const char *rest = common <= strlen(folder) ? folder + common : "";
    int up = *rest != 0;
    for (const char *c = rest; *c; c++)
        up += *c == '/' && c[1];
    for (; up > 0; up--, used += 3) {
        if (used + 4 > capacity)
            return false;
        memcpy(out + used, "../", 4);
    }
    size_t length = strlen(file + common);
    if (used + length + 1 > capacity)
        return false;
    memcpy(out + used, file + common, length + 1);
    return true;
}

static bool put_path(struct scene_writer *w, json_t *object, const char *key, const char *path)
{
    char real[PATH_MAX], relative[2 * PATH_MAX];
    if (!realpath(path, real))
        return fail(w->error, LAM_CANNOT_WRITE, "%s: names '%.200s', which cannot be found: %s", w->path, path,
                    strerror(errno));
    json_t *text = relative_path(w->folder, real, relative, sizeof relative) ? json_string(relative) : NULL;
    if (!text)
        return fail(w->error, LAM_UNSUPPORTED,
                    "%s: the path of '%.200s' is too long or not UTF-8, which JSON cannot store", w->path, path);
    if (key)
        put(w, object, key, text);
    else
        append(w, object, text);
    return true;
}

// --- fields of materials and lights

static void put_field(struct scene_writer *w, json_t *out, const lam_field *field, const void *object)
{
    double numbers[4];
    int count = lam_field_get_written(field, object, numbers);
    const float *floats = (const float *)((const char *)object + field->offset);
    switch (field->type) {
    case LAM_FIELD_NUMBER:
        put(w, out, field->key, number_float(*floats));
        break;
    case LAM_FIELD_ANGLE:
        put(w, out, field->key, number(numbers[0]));
        break;
    case LAM_FIELD_FLAG:
        put(w, out, field->key, json_boolean(numbers[0] != 0));
        break;
    case LAM_FIELD_POINT:
    case LAM_FIELD_DIRECTION:
        put(w, out, field->key, list_of(w, numbers, count));
        break;
    case LAM_FIELD_RGB:
    case LAM_FIELD_RGBA:
    case LAM_FIELD_TRIPLE:
        put(w, out, field->key, color(w, floats, count));
        break;
    }
}

// Writes every field if `whole` is set, because a reader would copy missing keys from another material. Otherwise,
// omits fields with default values.
static json_t *material_json(struct scene_writer *w, const lam_material *m, bool whole)
{
    json_t *out = json_object();
    for (int i = 0; material_field(i); i++) {
        const struct material_field *row = material_field(i);
        bool has = row->reader != FIELD_NEVER && (m->physical || !row->physical);
        bool implied = (row->optional || row->layer) && field_is_standard(&row->field, m);
        if (has && (whole || !implied))
            put_field(w, out, &row->field, m);
    }
    if (!whole && m->diffuse.a == 1)
        put(w, out, "diffuse", color(w, &m->diffuse.r, 3));
    return out;
}

static bool same_material(const lam_material *a, const lam_material *b)
{
    for (int i = 0; lam_material_field(i); i++)
        if (!field_equal(lam_material_field(i), a, b))
            return false;
    return true;
}

// Returns true if at most one material has this name, so that the name identifies this material.
static bool is_only_name(const struct scene_origin *origin, const char *name)
{
    int count = 0;
    for (int i = 0; i < origin->material_count; i++)
        count += origin->materials[i].name && strcmp(origin->materials[i].name, name) == 0;
    return count <= 1;
}

// Writes the changes to the model's own materials since the model was read.
static bool put_changes(struct scene_writer *w, json_t *entry, const struct scene_origin *origin)
{
    json_t *changes = NULL;
    for (int i = 0; i < origin->material_count; i++) {
        const lam_material *now = lam_scene_material(w->scene, origin->first_material + i);
        if (!now || same_material(now, &origin->materials[i]))
            continue;
        const char *name = origin->materials[i].name;
        char number[16], shown[SHOWN_NAME_SIZE];
        snprintf(number, sizeof number, "#%d", i);
        name = name ? name : number;
        if (!*name || !is_only_name(origin, name))
            return fail(w->error, LAM_UNSUPPORTED,
                        "%s: the material '%s' of '%.200s' was changed, but its name is empty or not unique", w->path,
                        shown_name(name, shown), origin->path);
        changes = changes ? changes : json_object();
        bool whole = origin->materials[i].diffuse.a != 1 || origin->materials[i].fibre;
        put(w, changes, name, material_json(w, now, whole));
    }
    if (changes)
        put(w, entry, "materials", changes);
    return true;
}

// If the material of any part differs from the part's material in the model file, writes the materials of all parts.
// Parts with unchanged materials are written as null.
static void put_parts(struct scene_writer *w, json_t *entry, const struct scene_origin *origin)
{
    json_t *list = json_array();
    bool changed = false;
    for (int i = origin->first_mesh, n = 0; i < origin->first_mesh + origin->mesh_count; i++) {
        const lam_mesh *mesh = lam_scene_mesh(w->scene, i);
        for (uint32_t k = 0; k < mesh->part_count; k++, n++) {
            int material = mesh->parts[k].material;
            bool own = material == origin->part_materials[n];
            lam_material plain = lam_material_default();
            const lam_material *shown = material >= 0 ? lam_scene_material(w->scene, material) : &plain;
            append(w, list, own ? json_null() : material_json(w, shown, false));
            changed |= !own;
        }
    }
    if (changed)
        put(w, entry, "parts", list);
    else
        json_decref(list);
}

// --- objects

static const struct scene_origin *origin_of(const struct lam_scene *scene, int mesh)
{
    for (int i = 0; i < scene->origins.count; i++) {
        const struct scene_origin *origin = (const struct scene_origin *)scene->origins.items + i;
        if (mesh >= origin->first_mesh && mesh < origin->first_mesh + origin->mesh_count)
            return origin;
    }
    return NULL;
}

static bool is_identity(const lam_mat4 *m)
{
    lam_mat4 identity = lam_mat4_identity();
    for (int i = 0; i < 16; i++)
        if (m->m[i / 4][i % 4] != identity.m[i / 4][i % 4])
            return false;
    return true;
}

// The changes to an object since it was read.
enum { MATERIAL, BACK_MATERIAL, ONE_SIDED, CULL, CHANGES };
struct change {
    lam_mat4 transform;  // applied after the object's transform in the file
    int values[CHANGES]; // −1 means unchanged
};

static void values_of(const lam_object *object, int values[CHANGES])
{
    values[MATERIAL] = object->material;
    values[BACK_MATERIAL] = object->back_material;
    values[ONE_SIDED] = object->one_sided;
    values[CULL] = (int)object->cull;
}

static struct change change_of(const struct scene_writer *w, const lam_object *object, const lam_object *own)
{
    struct change change = {.transform = object->transform};
    int own_values[CHANGES];
    lam_mat4 inverse, placed = mat4_mul(&w->scene->placement, &own->transform);
    // The model file still contains the object's own transform. A reader that applies the scene's placement to this
    // transform obtains the same bits.
    if (memcmp(&object->transform, &own->transform, sizeof own->transform) == 0)
        change.transform = lam_mat4_identity();
    else if (memcmp(&object->transform, &placed, sizeof placed) == 0)
        change.transform = w->scene->placement;
    else if (!is_identity(&own->transform) && mat4_inverse_affine(&own->transform, &inverse))
        change.transform = mat4_mul(&object->transform, &inverse);
    values_of(object, change.values);
    values_of(own, own_values);
    for (int k = 0; k < CHANGES; k++)
        change.values[k] = change.values[k] != own_values[k] ? change.values[k] : -1;
    return change;
}

// Gets the change that all objects of a file share, so that one entry can describe them. Returns false if the changes
// differ.
static bool common_change(const struct scene_writer *w, const struct scene_origin *origin, int first,
                          struct change *common)
{
    bool same[CHANGES] = {true, true, true, true}, changed[CHANGES] = {0}, shared = true;
    int wanted[CHANGES], values[CHANGES];
    values_of(lam_scene_object(w->scene, first), wanted);
    for (int i = 0; i < origin->object_count; i++) {
        const lam_object *object = lam_scene_object(w->scene, first + i);
        if (!object || origin_of(w->scene, object->mesh) != origin)
            return false;
        struct change change = change_of(w, object, &origin->objects[i]);
        if (i == 0)
            *common = change;
        shared &= memcmp(&change.transform, &common->transform, sizeof change.transform) == 0;
        values_of(object, values);
        for (int k = 0; k < CHANGES; k++) {
            same[k] &= values[k] == wanted[k];
            changed[k] |= change.values[k] >= 0;
        }
    }
    for (int k = 0; k < CHANGES; k++) {
        common->values[k] = changed[k] ? wanted[k] : -1;
        shared &= same[k] || !changed[k];
    }
    return shared;
}

static json_t *formula_json(struct scene_writer *w, const lam_formula *formula)
{
    json_t *shape = json_object(), *out = json_object();
    const char *const names[] = {"u", "v", "x", "y", "z"};
    const char *const ranges[] = {formula->u, formula->v, formula->x, formula->y, formula->z};
    put(w, out, "formula", json_string(formula->text));
    for (int i = 0; i < 5; i++)
        if (ranges[i])
            put(w, out, names[i], json_string(ranges[i]));
    if (formula->implicit && formula->u_segments)
        put(w, out, "segments", json_integer(formula->u_segments));
    else if (formula->u_segments || formula->v_segments)
        put(w, out, "segments", json_pack("[ii]", formula->u_segments, formula->v_segments));
    if (formula->flip)
        put(w, out, "flip", json_true());
    put(w, shape, formula->implicit ? "implicit" : "parametric", out);
    return shape;
}

static bool put_object(struct scene_writer *w, json_t *list, const lam_object *object,
                       const struct scene_origin *origin, const struct change *change)
{
    json_t *entry = json_object();
    append(w, list, entry);
    if (!entry)
        return true;
    // The key "name" would set the name of all unnamed objects of a file.
    const char *own_name = origin->object_count > 1 ? origin->objects[0].name : NULL;
    if (!own_name || !object->name || strcmp(own_name, object->name) != 0)
        put_name(w, entry, "name", object->name);
    if (origin->formula) {
        put(w, entry, "shape", formula_json(w, origin->formula));
    } else if (origin->shape) {
        put(w, entry, "shape", json_string(origin->shape));
        if (origin->segments.radius > 0)
            put(w, entry, "radius", number(origin->segments.radius));
        if (origin->segments.slices)
            put(w, entry, "slices", json_integer(origin->segments.slices));
        if (origin->segments.stacks)
            put(w, entry, "stacks", json_integer(origin->segments.stacks));
    } else if (!put_path(w, entry, "file", origin->path)) {
        return false;
    }
    if (origin->normals != LAM_NORMALS_FILE)
        put(w, entry, "normals", word(normals_words, (int)origin->normals));
    if (origin->crease_angle_rad > 0)
        put(w, entry, "crease_angle",
            origin->crease_angle_rad <= 1e-6 ? json_integer(0) : degrees(origin->crease_angle_rad));
    if (origin->field_tangents)
        put(w, entry, "tangents", json_string("field"));
    put_name(w, entry, "scene", origin->scene);
    put_name(w, entry, "variant", origin->variant);
    put_name(w, entry, "animation", origin->animation);
    if (origin->time_s != 0)
        put(w, entry, "time", number(origin->time_s));
    if (!is_identity(&change->transform))
        put(w, entry, "transform", list_of(w, &change->transform.m[0][0], 16));
    const int *values = change->values;
    if (values[MATERIAL] >= 0)
        put(w, entry, "material", material_json(w, lam_scene_material(w->scene, values[MATERIAL]), false));
    if (values[BACK_MATERIAL] >= 0)
        put(w, entry, "back_material", material_json(w, lam_scene_material(w->scene, values[BACK_MATERIAL]), true));
    if (values[ONE_SIDED] >= 0)
        put(w, entry, "two_sided", json_boolean(!values[ONE_SIDED]));
    if (values[CULL] >= 0)
        put(w, entry, "cull", word(cull_words, values[CULL]));
    put_parts(w, entry, origin);
    return put_changes(w, entry, origin);
}

// Returns the number of hidden objects among the `count` objects from `first`.
static int hidden_from(const struct lam_scene *scene, int first, int count)
{
    int hidden = 0;
    for (int i = first; i < first + count && i < scene->objects.count; i++)
        hidden += !scene_shows(scene, i);
    return hidden;
}

static bool put_objects(struct scene_writer *w, json_t *root)
{
    json_t *list = json_array();
    put(w, root, "objects", list);
    for (int i = 0; i < lam_scene_object_count(w->scene); i++) {
        const lam_object *object = lam_scene_object(w->scene, i);
        const struct scene_origin *origin = origin_of(w->scene, object->mesh);
        char shown[SHOWN_NAME_SIZE];
        if (!origin || (!origin->path && !origin->shape && !origin->formula))
            return fail(w->error, LAM_UNSUPPORTED,
                        "%s: the mesh of object %d ('%s') is not from a file, a built-in shape or a formula, so a "
                        "scene file cannot describe it",
                        w->path, i, shown_name(object->name ? object->name : "", shown));
        const lam_object plain = lam_object_default();
        // a single entry in the scene file describes all objects of a model file
        bool several = origin->object_count > 1;
        int hidden = hidden_from(w->scene, i, several ? origin->object_count : 1);
        if (hidden == (several ? origin->object_count : 1)) {
            i += hidden - 1;
            continue;
        }
        if (hidden || origin->edited)
            return fail(w->error, LAM_UNSUPPORTED,
                        "%s: object %d ('%s') belongs to a model whose meshes or objects were replaced, removed or "
                        "hidden, so a scene file cannot describe it",
                        w->path, i, shown_name(object->name ? object->name : "", shown));
        struct change change =
            several ? (struct change){0} : change_of(w, object, origin->object_count ? origin->objects : &plain);
        if (several && !common_change(w, origin, i, &change))
            return fail(w->error, LAM_UNSUPPORTED,
                        "%s: the objects of '%.200s' were changed in different ways, so one entry of a scene file "
                        "cannot describe them",
                        w->path, origin->path);
        i += several ? origin->object_count - 1 : 0;
        if (!put_object(w, list, object, origin, &change))
            return false;
    }
    return true;
}

// --- lights

static json_t *light_json(struct scene_writer *w, const lam_light *given)
{
    lam_light placed_light = *given, *l = &placed_light;
    // The model in the file keeps its original position, so the light is moved with the scene's placement instead. Without
    // a name, an object is the first one.
    bool first = l->frame == LAM_FRAME_OBJECT && !l->object && w->scene->objects.count;
    if (l->frame == LAM_FRAME_MODEL || first) {
        const lam_mat4 *m = first ? &scene_object(w->scene, 0)->transform : &w->scene->placement;
        l->frame = LAM_FRAME_WORLD;
        l->position = mat4_point(m, l->position);
        l->direction = mat4_vector(m, l->direction);
        l->up = mat4_vector(m, l->up);
    }
    json_t *out = json_object();
    put_name(w, out, "name", l->name);
    put(w, out, "type", json_string(lam_light_type_describe(l->type)->word));
    if (l->frame != LAM_FRAME_WORLD)
        put(w, out, "frame", word(frame_words, (int)l->frame));
    if (l->frame == LAM_FRAME_OBJECT)
        put_name(w, out, "object", l->object);
    if (l->attenuation.constant == 0 && l->attenuation.linear == 0 && l->attenuation.quadratic == 0)
        l->attenuation.constant = 1; // three zeros mean 1, 0, 0
    int cone = l->outer_rad > 0 ? SOFT_CONE : HARD_CONE;
    for (int i = 0; light_field(i); i++) {
        const struct light_field *row = light_field(i);
        if (field_is_of(&row->field, l->type) && (row->cone == ANY_CONE || (int)row->cone == cone) &&
            !(row->optional && field_is_zero(&row->field, l)))
            put_field(w, out, &row->field, l);
    }
    return out;
}

static void put_lights(struct scene_writer *w, json_t *root, lam_rig rig, bool ground)
{
    lam_rgb ambient = lam_scene_ambient(w->scene);
    lam_light lights[LAM_RIG_LIGHTS_MAX];
    json_t *list = json_array();
    put(w, root, "ambient", color(w, &ambient.r, 3));
    put(w, root, "lights", list);
    for (int i = 0; i < lam_scene_light_count(w->scene); i++)
        append(w, list, light_json(w, lam_scene_light(w->scene, i)));
    int count = lam_scene_rig_lights(w->scene, rig, ground, lights);
    for (int i = 0; i < count; i++)
        append(w, list, light_json(w, &lights[i]));
}

// --- settings of the picture

static json_t *setting_word(const lam_setting *setting, int value)
{
    const char *word;
    for (int i = 0, named; (word = setting->word(i, &named)); i++)
        if (named == value)
            return json_string(word);
    return NULL;
}

static void put_camera(struct scene_writer *w, json_t *root, const lam_camera *camera)
{
    json_t *out = json_object();
    put(w, root, "camera", out);
    put(w, out, "eye", vector(w, camera->eye));
    put(w, out, "target", vector(w, camera->target));
    put(w, out, "up", vector(w, camera->up));
    if (camera->fx > 0) {
        put(w, out, "fx", number(camera->fx));
        put(w, out, "fy", number(camera->fy));
        put(w, out, "cx", number(camera->cx));
        put(w, out, "cy", number(camera->cy));
        if (camera->width) {
            put(w, out, "width", json_integer(camera->width));
            put(w, out, "height", json_integer(camera->height));
        }
        put(w, out, "convention", json_string("opengl")); // cx and cy then need no rounding
    } else if (camera->ortho_half_height > 0)
        put(w, out, "ortho_half_height", number(camera->ortho_half_height));
    else
        put(w, out, "fovy", degrees(camera->fovy_rad));
    if (camera->near_plane != 0 || camera->far_plane != 0) {
        put(w, out, "near", number(camera->near_plane));
        put(w, out, "far", number(camera->far_plane));
    }
}

static void put_image(struct scene_writer *w, json_t *root, const lam_picture_settings *s)
{
    json_t *out = json_object();
    if (s->present & LAM_SETTING_SIZE)
        put(w, out, "size", list_of(w, (double[]){s->width, s->height}, 2));
    // if `samples` is missing, readers choose the number of samples by the picture's size
    if (s->present & LAM_SETTING_SAMPLES && s->draw.samples)
        put(w, out, "samples", json_integer(s->draw.samples));
    if (s->present & LAM_SETTING_BACKGROUND)
        put(w, out, "background", color(w, &s->draw.background.r, 4));
    if (s->present & LAM_SETTING_COLOR)
        put(w, out, "color_mode", word(color_words, (int)s->draw.color));
    if (s->present & LAM_SETTING_EXPOSURE)
        put(w, out, "exposure", number(s->draw.exposure));
    if (s->present & LAM_SETTING_TONE)
        put(w, out, "tone", json_string(lam_tone_name(s->draw.tone)));
    if (json_object_size(out))
        put(w, root, "image", out);
    else
        json_decref(out);
}

static bool put_environment(struct scene_writer *w, json_t *root, const lam_picture_settings *s)
{
    json_t *out = json_object(), *faces = s->environment_picture || s->environment_built_in ? NULL : json_array();
    put(w, root, s->reflection_map ? "reflection_map" : "environment", out);
    if (s->environment_built_in)
        put(w, out, "builtin", json_string(s->environment_built_in));
    if (faces)
        put(w, out, "faces", faces);
    for (int i = 0; faces && i < 6; i++)
        if (!put_path(w, faces, NULL, s->environment_faces[i] ? s->environment_faces[i] : ""))
            return false;
    if (s->environment_picture && !put_path(w, out, "equirectangular", s->environment_picture))
        return false;
    put(w, out, "rotation", degrees(s->environment_rotation_rad));
    return true;
}

static json_t *words_of(struct scene_writer *w, const lam_setting *setting, int bits)
{
    json_t *list = json_array();
    const char *word;
    int value;
    for (int i = 0; (word = setting->word(i, &value)); i++)
        if (bits & value)
            append(w, list, json_string(word));
    return list;
}

// Writes a row of the table of settings. Default values that are not keywords are omitted, because reading them would
// change nothing.
static void put_setting(struct scene_writer *w, json_t *root, const lam_setting *setting, const lam_draw_params *draw)
{
    const void *member = (const char *)draw + setting->offset;
    json_t *value = NULL;
    if (setting->type == LAM_SETTING_WORD)
        value = setting_word(setting, *(const int *)member);
    else if (lam_setting_is_default(setting, draw))
        return;
    else if (setting->type == LAM_SETTING_FLAG || setting->type == LAM_SETTING_NOT_FLAG)
        value = json_boolean(setting->type == LAM_SETTING_FLAG);
    else if (setting->type == LAM_SETTING_WHOLE)
        value = json_integer(*(const int *)member);
    else if (setting->type == LAM_SETTING_RGB || setting->type == LAM_SETTING_RGBA)
        value = color(w, member, setting->type == LAM_SETTING_RGB ? 3 : 4);
    else if (setting->type == LAM_SETTING_WORDS)
        value = words_of(w, setting, *(const int *)member);
    else if (setting->type == LAM_SETTING_ANGLE)
        value = number(degrees_float(*(const float *)member));
    else
        value = number_float(*(const float *)member > 0 ? *(const float *)member : 0);
    put(w, root, setting->key, value);
}

static bool put_settings(struct scene_writer *w, json_t *root, const lam_picture_settings *s)
{
    put_image(w, root, s);
    if (s->present & LAM_SETTING_CAMERA)
        put_camera(w, root, &s->camera);
    if ((s->present & LAM_SETTING_ENVIRONMENT) && !put_environment(w, root, s))
        return false;
    for (int i = 0; lam_draw_setting(i); i++)
        if (s->draw_present >> i & 1)
            put_setting(w, root, lam_draw_setting(i), &s->draw);
    return true;
}

// Writes a number with the fewest of 15 or 17 digits that give the same number, behind a text.
static int put_number(char *out, const char *before, double x)
{
    char text[40];
    snprintf(text, sizeof text, "%.15g", x);
    return sprintf(out, strtod(text, NULL) == x ? "%s%.15g" : "%s%.17g", before, x);
}

// Writes the sections in world space, like the transforms of the objects.
static void put_sections(struct scene_writer *w, json_t *root)
{
    json_t *list = json_array();
    for (int i = 0; w->scene->cut && i < w->scene->cut->count; i++) {
        const lam_section *s = &w->scene->cut->placed[i];
        char text[300], *at = text;
        at += put_number(at, "normal=", s->normal.x);
        at += put_number(at, "/", s->normal.y);
        at += put_number(at, "/", s->normal.z);
        at += put_number(at, ",distance=", s->distance);
        if (s->color.a > 0)
            sprintf(at, ",color=%.9g/%.9g/%.9g", (double)s->color.r, (double)s->color.g, (double)s->color.b);
        append(w, list, json_string(text));
    }
    if (json_array_size(list))
        put(w, root, "sections", list);
    else
        json_decref(list);
}

// --- public functions

static bool memory_or(struct scene_writer *w, bool ok) { return ok && (w->ok || fail_memory(w->error, 0)); }

// Finds the absolute path of the file's folder.
static bool find_folder(struct scene_writer *w, const char *path, char folder[PATH_MAX])
{
    char given[PATH_MAX];
    size_t length = (size_t)(path_name(path) - path);
    if (length >= sizeof given)
        return fail(w->error, LAM_CANNOT_WRITE, "%.200s…: the path is too long", path);
    memcpy(given, length ? path : ".", length ? length : 1);
    given[length ? length : 1] = 0;
    w->folder = folder;
    return realpath(given, folder) ||
           fail(w->error, LAM_CANNOT_WRITE, "%s: cannot write: the folder '%.200s': %s", path, given, strerror(errno));
}

// Sets the tone curve that the rig selects, because the written lights no longer select it.
static void set_tone(const struct scene_writer *w, lam_picture_settings *settings)
{
    settings->draw.tone = lam_draw_tone(w->scene, &settings->draw);
    settings->present |= settings->draw.tone ? LAM_SETTING_TONE : 0;
}

static bool encode(struct scene_writer *w, const lam_picture_settings *settings, const char *path, lam_bytes *out)
{
    static const lam_picture_settings none;
    char folder[PATH_MAX];
    lam_picture_settings own = settings ? *settings : none;
    set_tone(w, &own);
    if (!find_folder(w, path, folder))
        return false;
    json_t *root = json_object();
    put(w, root, "lambent", json_integer(1));
    bool ok = put_settings(w, root, &own);
    lam_up up = lam_scene_up(w->scene);
    if (up != LAM_UP_Y && up != LAM_UP_AUTO)
        put(w, root, "up", word(up_words, (int)up));
    put_sections(w, root);
    struct lam_scene whole = *w->scene; // describes the objects before they were cut
    struct scene_writer objects = *w;
    if (whole.cut) {
        whole.objects = (struct scene_list){.items = whole.cut->objects, .count = whole.cut->object_count};
        whole.meshes.count = whole.extents.count = whole.cut->meshes;
        whole.materials.count = whole.cut->materials;
        objects.scene = &whole;
    }
    ok = ok && put_objects(&objects, root);
    w->ok &= objects.ok;
    put_lights(w, root, own.draw.rig, own.draw.ground);
    ok = memory_or(w, ok) && scene_print(root, out, w->error);
    json_decref(root);
    return ok;
}

bool lam_scene_encode(const lam_scene *scene, const lam_picture_settings *settings, const char *path, lam_bytes *out,
                      lam_error *error)
{
    if (!scene || !path || !*path || !out)
        return fail(error, LAM_BAD_ARGUMENT, "a scene file: the %s missing",
                    !scene ? "scene is"
                    : out  ? "path is"
                           : "pointer for the bytes is");
    *out = (lam_bytes){0};
    if (settings && (!check_reserved("lam_picture_settings", settings, error) ||
                     !check_reserved("lam_picture_settings.camera", &settings->camera, error) ||
                     !check_reserved("lam_picture_settings.draw", &settings->draw, error)))
        return false;
    struct scene_writer writer = {.scene = scene, .path = path, .ok = true, .error = error};
    uint64_t state = float_state_enter();
    bool ok = encode(&writer, settings, path, out);
    float_state_leave(state);
    return ok;
}

bool lam_scene_save(const lam_scene *scene, const lam_picture_settings *settings, const char *path, lam_error *error)
{
    lam_bytes bytes = {0};
    bool ok = lam_scene_encode(scene, settings, path, &bytes, error) &&
              file_write(path, bytes.data, bytes.size, false, NULL, error);
    lam_bytes_free(&bytes);
    return ok;
}

bool lam_lights_encode(const lam_scene *scene, lam_rig rig, bool ground, lam_bytes *out, lam_error *error)
{
    if (!scene || !out)
        return fail(error, LAM_BAD_ARGUMENT, "lam_lights_encode: %s is NULL", scene ? "out" : "scene");
    struct scene_writer writer = {.scene = scene, .path = "lights", .ok = true, .error = error};
    uint64_t state = float_state_enter();
    json_t *root = json_object();
    put(&writer, root, "lambent", json_integer(1));
    lam_picture_settings settings = {.draw = {.rig = rig, .ground = ground}};
    set_tone(&writer, &settings);
    put_image(&writer, root, &settings);
    put_lights(&writer, root, rig, ground);
    bool ok = memory_or(&writer, root != NULL) && scene_print(root, out, error);
    json_decref(root);
    float_state_leave(state);
    return ok;
}
