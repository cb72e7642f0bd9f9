// materials.c: reads a material of a description. The rules between its fields are only here.
#include "description.h"

#include "fail.h"
#include "spelling.h"

#include <lambent/material.h>
#include <lambent/words.h>

#include <string.h>
#include <strings.h>

// --- names

// Materials that are not in the table of classic materials, and the words that define them.
static const struct {
    const char *name, *words;
} others[] = {{"glass", "color=white,roughness=0,transmission=1"}};
enum { OTHERS = sizeof others / sizeof *others };

const char *lam_material_metal(lam_material_id id)
{
    // The linear reflectance of metals at normal incidence, from Akenine-Möller et al., Real-Time Rendering, 4th
    // edition, table 9.2. Bronze is the mean of copper and brass.
    static const char *const metals[LAM_MATERIAL_COUNT] = {
        [LAM_MATERIAL_BRASS] = "diffuse=0.910/0.778/0.423,metallic=1,roughness=0.25",
        [LAM_MATERIAL_BRONZE] = "diffuse=0.933/0.708/0.481,metallic=1,roughness=0.35",
        [LAM_MATERIAL_CHROME] = "diffuse=0.549/0.556/0.554,metallic=1,roughness=0.06",
        [LAM_MATERIAL_COPPER] = "diffuse=0.955/0.638/0.538,metallic=1,roughness=0.25",
        [LAM_MATERIAL_GOLD] = "diffuse=1/0.782/0.344,metallic=1,roughness=0.2",
        [LAM_MATERIAL_SILVER] = "diffuse=0.972/0.960/0.915,metallic=1,roughness=0.2",
    };
    return (unsigned)id < LAM_MATERIAL_COUNT ? metals[id] : NULL;
}

bool lam_scene_mirror_metals(lam_scene *scene, const lam_draw_params *draw, lam_error *error)
{
    if (!scene || !draw)
        return fail(error, LAM_BAD_ARGUMENT, "lam_scene_mirror_metals: %s is NULL", scene ? "draw" : "scene");
    if (draw->rig || draw->reflection || draw->shading || draw->stage || draw->gl1 || draw->color != LAM_COLOR_SRGB ||
        scene->lights.count)
        return true;
    for (int i = 0; i < scene->materials.count; i++) {
        const lam_material *metal = lam_scene_material(scene, i);
        lam_material physical = lam_material_default();
        if (!metal->metal)
            continue;
        physical.name = metal->name;
        if (!lam_material_parse(lam_material_metal((lam_material_id)(metal->metal - 1)), draw->color, &physical,
                                error) ||
            !lam_scene_set_material(scene, i, &physical, error))
            return false;
    }
    return true;
}

static bool unknown_name(struct reader *r, const struct place *place, const char *name)
{
    struct spelling spelling = spelling_of(name);
    const char *key;
    json_t *value;
    char shown[2][SHOWN_NAME_SIZE];
    json_object_foreach(r->named_materials, key, value)
    {
        if (strlen(key) <= 60)
            spelling_try(&spelling, key);
    }
    for (int i = 0; i < LAM_MATERIAL_COUNT; i++)
        spelling_try(&spelling, lam_material_name((lam_material_id)i));
    for (int i = 0; i < OTHERS; i++)
        spelling_try(&spelling, others[i].name);
    for (int i = 0; lam_color_name(i); i++)
        spelling_try(&spelling, lam_color_name(i));
    shown_name(name, shown[0]);
    if (spelling.nearest)
        return json_fail(&r->json, place,
                         "no material is named '%s'; did you mean '%s'? `lambent materials` lists the names", shown[0],
                         shown_name(spelling.nearest, shown[1]));
    return json_fail(&r->json, place,
                     "no material is named '%s'; expected a name of `lambent materials`, a colour or "
                     "key=value",
                     shown[0]);
}

// Sets the material to the material or colour `name`.
static bool set_named(struct reader *r, const struct place *place, const json_t *object, lam_material *material)
{
    const char *name = json_string_value(json_object_get(object, "name"));
    lam_material_id id = lam_material_find(name);
    int own = r->source ? name_table_find(&r->materials, name) : -1;
    lam_rgba color;
    if (own >= 0) {
        *material = ((const lam_material *)r->scene->materials.items)[own];
        return true;
    }
    if (id != LAM_MATERIAL_COUNT) {
        *material = lam_material_named(id, r->color);
        material->metal = json_object_size(object) == 1 && lam_material_metal(id) ? (int)id + 1 : 0;
        return true;
    }
    for (int i = 0; i < OTHERS; i++)
        if (strcasecmp(others[i].name, name) == 0) {
            *material = lam_material_default();
            return lam_material_parse(others[i].words, r->color, material, r->json.error);
        }
    // A number alone is more likely a value whose key was forgotten.
    bool digit = (*name >= '0' && *name <= '9') || *name == '.';
    if ((digit && !strchr(name, '/')) ||
        (!lam_color_parse(name, r->color, &color, NULL) && *name != '#' && !strchr(name, '/')))
        return unknown_name(r, place, name);
    if (json_object_get(object, "color"))
        return json_fail(&r->json, place, "'color' is given twice");
    json_t *alone = json_object();
    bool ok = alone && json_object_set_new_nocheck(alone, "color", json_string_nocheck(name)) == 0;
    ok = ok ? read_material_keys(r, place, alone, material) : fail_memory(r->json.error, strlen(name));
    json_decref(alone);
    return ok;
}

// --- keys

static bool is_color(const lam_field *field) { return field->type == LAM_FIELD_RGB || field->type == LAM_FIELD_RGBA; }

// Lists the keys, ended by NULL: the fields, the factors of their colours (ka, kd, ks and kr), and keys that set several
// fields. "name" is last, because options write it differently. Of the colours, only those that scale light have a
// symbol.
static int keys_of(const char *keys[2 * LAM_FIELDS_MAX])
{
    static const char *const more[] = {"color", "specular_color", "name"};
    int count = 0;
    for (int i = 0; lam_material_field(i); i++)
        keys[count++] = lam_material_field(i)->key;
    for (int i = 0; lam_material_field(i); i++)
        if (is_color(lam_material_field(i)) && lam_material_field(i)->symbol)
            keys[count++] = lam_material_field(i)->symbol;
    for (int i = 0; i < 3; i++)
        keys[count++] = more[i];
    keys[count] = NULL;
    return count;
}

const char *lam_material_key(int index)
{
    const char *keys[2 * LAM_FIELDS_MAX];
    return index >= 0 && index < keys_of(keys) - 1 ? keys[index] : NULL;
}

static bool is_flag(const char *key)
{
    for (int i = 0; lam_material_field(i); i++)
        if (lam_material_field(i)->type == LAM_FIELD_FLAG && strcmp(lam_material_field(i)->key, key) == 0)
            return true;
    return false;
}

// Multiplies a colour by its factor. A colour that is black by default has no value to multiply, so its factor multiplies
// `specular_color`, or white.
static bool set_factor(struct reader *r, const struct place *place, const json_t *object, const lam_field *field,
                       lam_material *material)
{
    double factor, color[4];
    if (!json_take_number(&r->json, place, object, field->symbol, 0, 1e30, &factor))
        return false;
    if (field->standard[0] == 0 && !json_object_get(object, field->key)) {
        lam_rgb white = {1, 1, 1};
        if (!take_rgb(r, place, object, "specular_color", &white))
            return false;
        lam_field_set(field, material, (double[4]){(double)white.r, (double)white.g, (double)white.b, 1});
    }
    lam_field_get(field, material, color);
    for (int i = 0; i < 3; i++)
        color[i] *= factor;
    lam_field_set(field, material, color);
    return true;
}

// Reads the fields. `opacity` sets the alpha, or multiplies the alpha that `diffuse` sets.
static bool set_fields(struct reader *r, const struct place *place, const json_t *object, lam_material *material)
{
    const json_t *ambient = json_object_get(object, "ambient"), *diffuse = json_object_get(object, "diffuse");
    bool as_diffuse = json_is_string(ambient) && strcmp(json_string_value(ambient), "diffuse") == 0;
    const lam_material plain = lam_material_default();
    bool is_plain = memcmp(&material->ambient, &plain.ambient, sizeof plain.ambient) == 0 &&
                    memcmp(&material->diffuse, &plain.diffuse, sizeof plain.diffuse) == 0;
    const struct material_field *row;
    for (int i = 0; (row = material_field(i)); i++) {
        if (!json_object_get(object, row->field.key))
            continue;
        material_note_written(material, i);
        bool elsewhere = row->reader == FIELD_NEVER || (as_diffuse && strcmp(row->field.key, "ambient") == 0);
        if (!elsewhere && !take_field(r, place, object, &row->field, material))
            return false;
    }
    if (json_object_get(object, "opacity")) {
        double opacity = 1;
        if (!json_take_number(&r->json, place, object, "opacity", 0, 1, &opacity))
            return false;
        material->diffuse.a = diffuse ? material->diffuse.a * (float)opacity : (float)opacity;
        if (material->alpha_mode == LAM_ALPHA_OPAQUE)
            material->alpha_mode = LAM_ALPHA_BLEND; // an opaque material would ignore the alpha
    }
    for (int i = 0; (row = material_field(i)); i++)
        if (is_color(&row->field) && row->field.symbol && json_object_get(object, row->field.symbol) &&
            !set_factor(r, place, object, &row->field, material))
            return false;
    // A material without an ambient colour reflects ambient light like other light.
    if (as_diffuse || (is_plain && diffuse && !ambient))
        material->ambient = (lam_rgb){material->diffuse.r, material->diffuse.g, material->diffuse.b};
    return true;
}

bool read_material_keys(struct reader *r, const struct place *place, const json_t *object, lam_material *material)
{
    const char *keys[2 * LAM_FIELDS_MAX], *name = NULL;
    keys_of(keys);
    if (!json_check_keys(&r->json, place, object, keys) || !json_take_text(&r->json, place, object, "name", &name))
        return false;
    if (json_object_size(object) > (name != NULL))
        material->metal = 0;
    if (name && !set_named(r, r->json.file ? KEY_OF(place, "name") : place, object, material))
        return false;
    lam_rgb color = material->ambient;
    if (!take_rgb(r, place, object, "color", &color) ||
        !take_rgb(r, place, object, "specular_color", &material->specular))
        return false;
    if (json_object_get(object, "color")) {
        material->ambient = color;
        material->diffuse = (lam_rgba){color.r, color.g, color.b, material->diffuse.a};
    }
    return set_fields(r, place, object, material);
}

// Reads the words of an option, or a name.
static bool read_words(struct reader *r, const struct place *place, const char *text, lam_material *material)
{
    lam_error reason;
    json_t *object = words_parse(text, "name", ',', is_flag, &reason);
    if (!object)
        return json_fail(&r->json, place, "%s", reason.text);
    bool named = json_object_get(object, "name");
    // The name is not a key of the text, so an error about it names only the place of the text.
    bool ok = named && json_object_size(object) == 1 ? set_named(r, place, object, material)
                                                     : read_material_keys(r, place, object, material);
    json_decref(object);
    return ok;
}

bool read_material(struct reader *r, const struct place *place, const json_t *value, const lam_material *base,
                   int *index)
{
    lam_material material = base ? *base : lam_material_default();
    if (json_is_string(value)) {
        *index = name_table_find(&r->materials, json_string_value(value));
        if (*index >= 0)
            return true;
    }
    if (!(json_is_string(value) ? read_words(r, place, json_string_value(value), &material)
                                : read_material_keys(r, place, value, &material)))
        return false;
    *index = scene_adopt_material(r->scene, &material, r->json.error);
    return *index >= 0;
}

bool read_materials(struct reader *r, const json_t *root)
{
    json_t *list = json_object_get(root, "materials"), *value;
    const struct place *place = KEY_OF(NULL, "materials");
    const char *key;
    if (!list)
        return true;
    if (!json_is_object(list))
        return json_unexpected(&r->json, place, list, "an object of named materials");
    r->materials.memory = &r->scene->arena;
    json_object_foreach(list, key, value)
    {
        int index;
        if (!json_is_object(value))
            return json_unexpected(&r->json, KEY_OF(place, key), value, "an object, { … }");
        if (!read_material(r, KEY_OF(place, key), value, NULL, &index))
            return false;
        const char *name = arena_string(&r->scene->arena, key);
        if (!name || !name_table_add(&r->materials, name, index))
            return call_memory_error(r->source->call, strlen(key), r->json.error);
        ((lam_material *)r->scene->materials.items)[index].name = name;
    }
    r->named_materials = list;
    return true;
}

// --- the public function

bool lam_material_parse(const char *text, lam_color_mode mode, lam_material *material, lam_error *error)
{
    if (!text || !material)
        return fail(error, LAM_BAD_ARGUMENT, "lam_material_parse: %s is NULL", text ? "material" : "text");
    if (!*text)
        return fail(error, LAM_BAD_ARGUMENT, "the value is empty, expected a material's name or key=value");
    lam_material changed = *material;
    struct reader r = {.json = {.error = error}, .color = mode};
    bool ok = read_words(&r, NULL, text, &changed);
    if (ok)
        *material = changed;
    return ok;
}
