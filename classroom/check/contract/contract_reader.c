// contract_reader.c: reads lists and names in a contract's file.
#include "contract.h"

#include <ctype.h>
#include <string.h>

#include "fail.h"

bool contract_no_memory(const struct contract_reader *r) { return fail_memory(r->json.error, 1); }

const struct json_choice contract_spaces[] = {
    {"eye", LAM_FRAME_CAMERA}, {"world", LAM_FRAME_WORLD}, {"object", LAM_FRAME_OBJECT}, {NULL, 0}};

// Returns whether a text is a name in GLSL: identifiers joined by dots. "[]" after the first identifier
// means that it is an array.
static bool is_name(const char *text, bool plain)
{
    for (bool first = true;; first = false) {
        if (!isalpha((unsigned char)*text) && *text != '_')
            return false;
        while (isalnum((unsigned char)*text) || *text == '_')
            text++;
        if (first && !plain && strncmp(text, "[]", 2) == 0)
            text += 2;
        if (!*text)
            return true;
        if (plain || *text++ != '.')
            return false;
    }
}

bool contract_check_name(const struct contract_reader *r, const struct place *place, const char *name, bool plain)
{
    return (strlen(name) < 64 && is_name(name, plain)) ||
           json_fail(&r->json, place, "found \"%.40s\", expected a name of GLSL%s", name,
                     plain ? "" : " such as \"color\", \"light.color\" or \"lights[].color\"");
}

bool contract_check_comment(struct contract_reader *r, const struct place *place, const json_t *object)
{
    const json_t *comment = json_object_get(object, "comment");
    const char *unused;
    return !comment || json_is_string(comment) ||
           (json_is_array(comment)
                ? contract_read_list(r, KEY_OF(place, "comment"), comment, " ", false, false, &unused)
                : json_unexpected(&r->json, KEY_OF(place, "comment"), comment, "a string or a list of strings"));
}

bool contract_read_list(struct contract_reader *r, const struct place *place, const json_t *list, const char *between,
                        bool of_names, bool plain, const char **out)
{
    if (!json_is_array(list))
        return json_unexpected(&r->json, place, list, "a list of strings");
    size_t length = 1;
    for (size_t i = 0; i < json_array_size(list); i++) {
        const json_t *item = json_array_get(list, i);
        if (!json_is_string(item) || !json_string_length(item))
            return json_unexpected(&r->json, ELEMENT_OF(place, i), item, "a string that is not empty");
        if (of_names && !contract_check_name(r, ELEMENT_OF(place, i), json_string_value(item), plain))
            return false;
        length += json_string_length(item) + strlen(between);
    }
    char *text = arena_alloc_zeroed(r->arena, length);
    if (!text)
        return contract_no_memory(r);
    for (size_t i = 0; i < json_array_size(list); i++) {
        strcat(text, i ? between : "");
        strcat(text, json_string_value(json_array_get(list, i)));
    }
    *out = *text ? text : NULL;
    return true;
}
