// contract_values.c: reads the sections of a contract about varyings, undeclared names, numbers, the engine, and
// metalness and roughness.
#include "contract.h"

#include <stdio.h>
#include <string.h>

// --- varyings

bool contract_read_varyings(struct contract_reader *r, const json_t *root)
{
    static const struct {
        const char *name;
        enum varying_semantic semantic;
        bool in_space; // whether a coordinate space may precede the name: object_position
    } words[] = {{"normal", VARYING_NORMAL, true},      {"position", VARYING_POSITION, true},
                 {"to_light", VARYING_LIGHT, true},     {"to_eye", VARYING_EYE, true},
                 {"distance", VARYING_DISTANCE, false}, {"texture_coordinate", VARYING_TEXCOORD, false}};
    const json_t *object = json_object_get(root, "varyings");
    const struct place *place = KEY_OF(NULL, "varyings");
    if (object && !json_is_object(object))
        return json_unexpected(&r->json, place, object, "an object, { … }");
    struct contract_varying *rows = arena_alloc_zeroed(r->arena, (json_object_size(object) + 1) * sizeof *rows);
    if (!rows)
        return contract_no_memory(r);
    r->contract->varyings = rows;
    const char *key;
    json_t *list;
    json_object_foreach((json_t *)(uintptr_t)object, key, list)
    {
        int space = r->contract->space;
        const char *word = key;
        for (int i = 0; contract_spaces[i].name; i++) {
            size_t length = strlen(contract_spaces[i].name);
            if (strncmp(key, contract_spaces[i].name, length) == 0 && key[length] == '_') {
                space = contract_spaces[i].value;
                word = key + length + 1;
            }
        }
        if (space == LAM_FRAME_OBJECT && strncmp(word, "to_", 3) == 0)
            return json_fail(&r->json, KEY_OF(place, key), "unknown key; %s in object space is not known", word);
        size_t i = 0;
        while (i < sizeof words / sizeof *words &&
               (strcmp(words[i].name, word) != 0 || (word != key && !words[i].in_space)))
            i++;
        if (i == sizeof words / sizeof *words)
            return json_fail(&r->json, KEY_OF(place, key),
                             "unknown key; expected normal, position, to_light or to_eye, alone or after object_, "
                             "world_ or eye_; or distance or texture_coordinate");
        rows->semantic = words[i].semantic;
        rows->space = (lam_light_frame)space;
        if (!contract_read_list(r, KEY_OF(place, key), list, " ", true, true, &rows->names))
            return false;
        rows += rows->names != NULL;
    }
    return true;
}

// --- values of undeclared names

static bool read_color(struct contract_reader *r, const struct place *place, const json_t *object, const char *key,
                       const char *word, enum color_source source, struct default_color *out)
{
    const json_t *value = json_object_get(object, key);
    double v[3];
    if (!value)
        return true;
    if (json_is_string(value)) {
        if (!word || strcmp(json_string_value(value), word) != 0) {
            char expected[80];
            snprintf(expected, sizeof expected, "%s%s%sa list of 3 numbers", word ? "\"" : "", word ? word : "",
                     word ? "\" or " : "");
            return json_unexpected(&r->json, KEY_OF(place, key), value, expected);
        }
        out->source = source;
        return true;
    }
    if (!json_numbers_of(&r->json, KEY_OF(place, key), value, 3, 3, v, NULL))
        return false;
    *out = (struct default_color){COLOR_GIVEN, {(float)v[0], (float)v[1], (float)v[2]}};
    return true;
}

static bool read_number(struct contract_reader *r, const struct place *place, const json_t *object, const char *key,
                        struct default_number *out)
{
    double value = 0;
    if (!json_take_number(&r->json, place, object, key, 0, 1e6, &value))
        return false;
    if (json_object_get(object, key))
        *out = (struct default_number){true, (float)value};
    return true;
}

static bool read_attenuation(struct contract_reader *r, const struct place *place, const json_t *object,
                             struct contract_defaults *d)
{
    double v[3];
    const json_t *list = json_object_get(object, "attenuation");
    if (!list)
        return true;
    if (!json_numbers_of(&r->json, KEY_OF(place, "attenuation"), list, 3, 3, v, NULL))
        return false;
    if (v[0] < 0 || v[1] < 0 || v[2] < 0 || v[0] + v[1] + v[2] <= 0)
        return json_fail(&r->json, KEY_OF(place, "attenuation"),
                         "found %g, %g, %g, expected numbers of at least 0, not all of them 0", v[0], v[1], v[2]);
    d->has_attenuation = true;
    for (int i = 0; i < 3; i++)
        d->attenuation[i] = (float)v[i];
    return true;
}

// Reads the light's direction or its position.
static bool read_light_place(struct contract_reader *r, const struct place *place, const json_t *object,
                             struct contract_defaults *d)
{
    static const char *const keys[] = {"light_direction", "light_position"};
    for (int i = 0; i < 2; i++) {
        double v[3];
        const json_t *list = json_object_get(object, keys[i]);
        if (!list)
            continue;
        if (!json_numbers_of(&r->json, KEY_OF(place, keys[i]), list, 3, 3, v, NULL))
            return false;
        if (i == 0 && v[0] == 0 && v[1] == 0 && v[2] == 0)
            return json_fail(&r->json, KEY_OF(place, keys[i]), "found 0, 0, 0, expected a direction");
        d->has_direction = i == 0;
        d->has_position = i == 1;
        d->direction = (lam_vec3){v[0], v[1], v[2]};
    }
    return true;
}

bool contract_read_defaults(struct contract_reader *r, const json_t *root)
{
    static const char *const keys[] = {"ambient_color",
                                       "diffuse_color",
                                       "specular_color",
                                       "ambient_strength",
                                       "diffuse_strength",
                                       "specular_strength",
                                       "shininess",
                                       "light_color",
                                       "light_specular",
                                       "light_ambient",
                                       "light_direction",
                                       "light_position",
                                       "light_space",
                                       "attenuation",
                                       "spot_exponent",
                                       "comment",
                                       NULL};
    const json_t *object = json_object_get(root, "undeclared");
    const struct place *place = KEY_OF(NULL, "undeclared");
    struct contract_defaults *d = &r->contract->defaults;
    if (!object)
        return true;
    if (!json_check_keys(&r->json, place, object, keys) || !contract_check_comment(r, place, object) ||
        !read_color(r, place, object, "ambient_color", "diffuse", COLOR_OF_DIFFUSE, &d->ambient_color) ||
        !read_color(r, place, object, "diffuse_color", NULL, 0, &d->diffuse_color) ||
        !read_color(r, place, object, "specular_color", "diffuse", COLOR_OF_DIFFUSE, &d->specular_color) ||
        !read_color(r, place, object, "light_color", NULL, 0, &d->light_color) ||
        !read_color(r, place, object, "light_specular", "light", COLOR_OF_LIGHT, &d->light_specular) ||
        !read_color(r, place, object, "light_ambient", "light", COLOR_OF_LIGHT, &d->light_ambient) ||
        !read_number(r, place, object, "ambient_strength", &d->ambient_strength) ||
        !read_number(r, place, object, "diffuse_strength", &d->diffuse_strength) ||
        !read_number(r, place, object, "specular_strength", &d->specular_strength) ||
        !read_number(r, place, object, "shininess", &d->shininess) ||
        !read_number(r, place, object, "spot_exponent", &d->spot_exponent))
        return false;
    d->light_space = r->contract->space;
    return json_take_word(&r->json, place, object, "light_space", contract_spaces, &d->light_space) &&
           read_attenuation(r, place, object, d) && read_light_place(r, place, object, d);
}

// --- constants and the prefix

bool contract_read_constants(struct contract_reader *r, const json_t *root)
{
    const json_t *object = json_object_get(root, "constants");
    const struct place *place = KEY_OF(NULL, "constants");
    if (object && !json_is_object(object))
        return json_unexpected(&r->json, place, object, "an object, { … }");
    struct contract_constant *rows = arena_alloc_zeroed(r->arena, (json_object_size(object) + 1) * sizeof *rows);
    if (!rows)
        return contract_no_memory(r);
    r->contract->constants = rows;
    const char *name;
    json_t *value;
    json_object_foreach((json_t *)(uintptr_t)object, name, value)
    {
        char known[300] = "";
        const char *found = json_is_string(value) ? json_string_value(value) : "";
        for (int i = 0; i < role_count && !rows->name; i++)
            if (roles[i].uses & ROLE_CONSTANT) {
                size_t used = strlen(known);
                snprintf(known + used, sizeof known - used, "%s%s", used ? ", " : "", roles[i].name);
                if (strcmp(roles[i].name, found) == 0) {
                    rows->semantic = roles[i].semantic;
                    rows->name = arena_string(r->arena, name);
                }
            }
        if (!rows->semantic)
            return json_unexpected(&r->json, KEY_OF(place, name), value, known);
        if (!contract_check_name(r, KEY_OF(place, name), name, true))
            return false;
        if (!rows->name)
            return contract_no_memory(r);
        rows++;
    }
    return true;
}

bool contract_read_prefix(struct contract_reader *r, const json_t *root)
{
    static const char *const keys[] = {"vertex", "fragment", NULL};
    const json_t *object = json_object_get(root, "prefix");
    const struct place *place = KEY_OF(NULL, "prefix");
    const char **texts[] = {&r->contract->prefix_vertex, &r->contract->prefix_fragment};
    if (!object)
        return true;
    if (!json_check_keys(&r->json, place, object, keys))
        return false;
    for (int i = 0; i < 2; i++) {
        const json_t *list = json_object_get(object, keys[i]);
        if (!list)
            return json_fail(&r->json, place, "the key '%s' is missing, expected a list of lines", keys[i]);
        if (!contract_read_list(r, KEY_OF(place, keys[i]), list, "\n", false, false, texts[i]))
            return false;
    }
    return true;
}

// --- lighting with metalness and roughness

bool contract_read_physical(struct contract_reader *r, const json_t *root)
{
    static const char *const keys[] = {"masking", "diffuse", "tone", "encoding", NULL};
    static const struct json_choice maskings[] = {{"smith", MASKING_SMITH}, {"schlick", MASKING_SCHLICK}, {NULL, 0}},
                                    shares[] = {{"dielectric", DIFFUSE_OF_DIELECTRIC},
                                                {"mix", DIFFUSE_OF_MIX},
                                                {"whole", DIFFUSE_WHOLE},
                                                {NULL, 0}},
                                    tones[] = {{"none", TONE_NONE}, {"reinhard", TONE_REINHARD}, {NULL, 0}},
                                    encodings[] = {{"none", ENCODING_NONE}, {"gamma", ENCODING_GAMMA}, {NULL, 0}};
    const json_t *object = json_object_get(root, "physical");
    const struct place *place = KEY_OF(NULL, "physical");
    int masking = MASKING_SMITH, diffuse = DIFFUSE_OF_DIELECTRIC, tone = TONE_NONE, encoding = ENCODING_NONE;
    if (!object)
        return true;
    if (!json_check_keys(&r->json, place, object, keys) ||
        !json_take_word(&r->json, place, object, "masking", maskings, &masking) ||
        !json_take_word(&r->json, place, object, "diffuse", shares, &diffuse) ||
        !json_take_word(&r->json, place, object, "tone", tones, &tone) ||
        !json_take_word(&r->json, place, object, "encoding", encodings, &encoding))
        return false;
    r->contract->physical = (struct physical_convention){(enum masking)masking, (enum diffuse_share)diffuse,
                                                         (enum tone_curve)tone, (enum encoding)encoding};
    return true;
}

// --- contents of maps

bool contract_read_maps(struct contract_reader *r, const json_t *root)
{
    static const char *const keys[] = {"colors", "v", NULL};
    static const struct json_choice colors[] = {{"linear", false}, {"gamma", true}, {NULL, 0}},
                                    ways[] = {{"up", false}, {"down", true}, {NULL, 0}};
    const json_t *object = json_object_get(root, "maps");
    const struct place *place = KEY_OF(NULL, "maps");
    int encoded = false, v_down = false;
    if (!object)
        return true;
    if (!json_check_keys(&r->json, place, object, keys) ||
        !json_take_word(&r->json, place, object, "colors", colors, &encoded) ||
        !json_take_word(&r->json, place, object, "v", ways, &v_down))
        return false;
    r->contract->maps = (struct map_convention){encoded != 0, v_down != 0};
    return true;
}
