// check_write.c: writes a contract as a readable file: one entry per line, with its meaning and possible corrections.
#include <lambent/check.h>

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "check_run.h"
#include "fail.h"
#include "prefix.h"
#include "json_parse.h"

// The advice on how to correct an entry with this role. The advice is "" if only the role can be wrong.
static const struct {
    const char *role, *correct;
} corrections[] = {
    {"zero", "its value is 0, because its role is unknown or the shaders do not use it; set its role if necessary"},
    {"factor", "its value is free. If the exercise prescribes the value, use a role such as color, light_color or "
               "diffuse_strength, and "
               "\"strengths\": \"given\""},
    {"light_position", "correct `space` if the program uses another space"},
    {"light_direction",
     "it points to the light; if yours points away from the light, use light_travel. Correct `space` too"},
    {"light_travel",
     "it points away from the light; if yours points to the light, use light_direction. Correct `space` too"},
    {"eye_position", "correct `space` if the program uses another space"},
    {"normal_matrix", "correct `space` if the matrix transforms to another space"},
    {"shininess", "the highlight's exponent, which each scene sets"},
};

static const char *const root_comment[] = {
    "Written by `lambent check --write-contract`; docs/check/contract-file.md explains every key and every role.",
    "Correct `name` and `title` first, then `space`: the space in which lighting is computed (eye or world).",
    "\"strengths\": \"any\" accepts every colour and strength. With \"given\", each name needs a role, and mistakes in "
    "colours are found.",
    "If the exercise demands them, add \"gate\": \"required\", \"unit_normals\": \"required\", \"bare_ambient\": "
    "\"required\".",
    "`weights` sets the points of a scene: {\"gate\": 2}. Comments may be removed."};

static const char *meaning_of(const char *role)
{
    for (int i = 0; i < role_count; i++)
        if (strcmp(roles[i].name, role) == 0)
            return roles[i].meaning;
    return "";
}

static json_t *comment_of(const json_t *entry)
{
    const char *role = json_string_value(json_object_get(entry, "role")), *correct = NULL;
    for (size_t i = 0; role && i < sizeof corrections / sizeof *corrections; i++)
        if (strcmp(corrections[i].role, role) == 0)
            correct = corrections[i].correct;
    return json_sprintf("%s%s%s", role ? meaning_of(role) : "", correct ? "; " : "", correct ? correct : "");
}

// Adds a comment to each entry that lacks one. Restores names such as gl_LightSource, which checks rename to
// fixed_LightSource.
static json_t *comment_entries(const json_t *entries)
{
    json_t *out = json_object();
    const char *name;
    json_t *entry;
    json_object_foreach((json_t *)(uintptr_t)entries, name, entry)
    {
        char own[80];
        snprintf(own, sizeof own, "gl_%.70s", strncmp(name, "fixed_", 6) == 0 ? name + 6 : "");
        json_t *copy = json_copy(entry);
        if (!json_object_get(copy, "comment"))
            json_object_set_new(copy, "comment", comment_of(entry));
        json_object_set_new(out, fixed_state_has(own) ? own : name, copy);
    }
    return out;
}

static json_t *lines_of(const char *const *lines, int count)
{
    json_t *list = json_array();
    for (int i = 0; i < count; i++)
        json_array_append_new(list, json_string(lines[i]));
    return list;
}

static void put_line(struct text *t, int indent, const char *key, const json_t *value, bool last)
{
    text_print(t, "%*s", indent, "");
    if (key) {
        json_t *name = json_string(key);
        json_dump_callback(name, text_add_chunk, t, JSON_ENCODE_ANY);
        json_decref(name);
        text_add(t, ": ");
    }
    json_dump_callback(value, text_add_chunk, t, JSON_ENCODE_ANY | JSON_REAL_PRECISION(9));
    text_add(t, last ? "\n" : ",\n");
}

// Writes an object or an array on several lines, with one member per line.
static void put_members(struct text *t, const char *key, const json_t *value, bool last)
{
    bool list = json_is_array(value);
    size_t count = list ? json_array_size(value) : json_object_size(value), i = 0;
    text_print(t, "  \"%s\": %c\n", key, list ? '[' : '{');
    const char *name;
    json_t *member;
    if (list)
        json_array_foreach(value, i, member) put_line(t, 4, NULL, member, i + 1 == count);
    else
        json_object_foreach((json_t *)(uintptr_t)value, name, member) put_line(t, 4, name, member, ++i == count);
    text_print(t, "  %c%s\n", list ? ']' : '}', last ? "" : ",");
}

static bool write_contract(const char *contract, const char *found, lam_bytes *out, lam_error *error)
{
    static const char *const wide[] = {"comment", "attributes", "uniforms", "undeclared", "constants", "prefix"};
    json_t *from = json_parse(contract, strlen(contract), "contract", NULL, error), *root = from ? json_object() : NULL;
    struct text t = {0};
    if (!root)
        return false;
    json_t *comment = lines_of(root_comment, sizeof root_comment / sizeof *root_comment);
    if (found[0])
        json_array_append_new(comment, json_sprintf("Not understood: %s.", found));
    json_object_set_new(root, "comment", comment);
    const char *key;
    json_t *value;
    json_object_foreach(from, key, value)
    {
        if (strcmp(key, "attributes") == 0 || strcmp(key, "uniforms") == 0)
            json_object_set_new(root, key, comment_entries(value));
        else if (!json_object_get(root, key))
            json_object_set(root, key, value);
    }
    json_t *undeclared = json_object_get(root, "undeclared");
    if (undeclared && !json_object_get(undeclared, "comment"))
        json_object_set_new(
            undeclared, "comment",
            json_string("values that a shader does not declare, because the exercise writes them as numbers"));
    size_t i = 0, count = json_object_size(root);
    text_add(&t, "{\n");
    json_object_foreach(root, key, value)
    {
        bool is_wide = false;
        for (size_t k = 0; k < sizeof wide / sizeof *wide; k++)
            is_wide = is_wide || strcmp(wide[k], key) == 0;
        if (is_wide)
            put_members(&t, key, value, ++i == count);
        else
            put_line(&t, 2, key, value, ++i == count);
    }
    text_add(&t, "}\n");
    json_decref(root);
    json_decref(from);
    if (t.failed) {
        free(t.bytes);
        return fail_memory(error, t.capacity);
    }
    *out = (lam_bytes){(uint8_t *)t.bytes, t.length};
    return true;
}

bool lam_check_contract_write(const lam_check_params *params, const lam_check_report *report, lam_bytes *out,
                              lam_error *error)
{
    *out = (lam_bytes){0};
    if (!check_reserved("lam_check_params", params, error))
        return false;
    if (report)
        return write_contract(report->contract_text, "", out, error);
    if (!params->vertex || !params->fragment)
        return fail(error, LAM_BAD_ARGUMENT,
                    "a contract is written for a fragment shader and its vertex shader; one is missing");
    struct own_texts own;
    char why[300] = "";
    bool ok = own_texts_make(params->vertex, params->fragment, &own, error);
    struct complete_texts texts = {.vertex = own.vertex, .fragment = own.fragment};
    ok = ok && check_read_texts((void *)params, &texts, error);
    char *text = ok ? contract_infer(&texts.sides[0], &texts.sides[1], NULL, NULL, 0, "eye", why, sizeof why) : NULL;
    ok = ok && (text ? write_contract(text, why, out, error) : fail(error, LAM_BAD_ARGUMENT, "no contract: %s", why));
    free(text);
    own_texts_free(&own);
    prefix_free(&texts);
    return ok;
}
