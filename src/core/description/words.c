// words.c: the spelling of options: "key=value,key=value" becomes the tree that JSON would make.
#include "description.h"

#include "fail.h"
#include "number.h"

#include <errno.h>
#include <string.h>

// Parses a number, or a number in radii ("2r"), which remains a string. Returns NULL for other texts.
static json_t *number_of(const char *text)
{
    const char *digits = text + (*text == '-' || *text == '+');
    size_t length = strlen(text);
    double number;
    if (!((*digits >= '0' && *digits <= '9') || *digits == '.'))
        return NULL; // also "inf" and "nan"
    const char *end = (const char *)number_double((const uint8_t *)text, (const uint8_t *)text + length, &number);
    if (!end || number - number != 0 || (strcmp(end, "r") != 0 && *end))
        return NULL;
    return *end ? json_string_nocheck(text) : json_real(number);
}

// Makes the value of a key. Some keys are texts even if their values look like numbers.
static json_t *value_of(const char *key, char *text)
{
    static const char *const texts[] = {"name", "object", "frame", "type"};
    static const char *const flags[] = {"no", "yes", "off", "on"};
    for (int i = 0; i < 4; i++)
        if (strcmp(key, texts[i]) == 0)
            return json_string_nocheck(text);
    for (int i = 0; i < 4; i++)
        if (strcmp(text, flags[i]) == 0)
            return json_boolean(i & 1);
    json_t *number = number_of(text);
    if (number || !strchr(text, '/'))
        return number ? number : json_string_nocheck(text);
    char parts[WORDS_MAX], *rest = parts;
    json_t *list = json_array();
    strcpy(parts, text);
    for (char *part; list && (part = strsep(&rest, "/"));)
        if (!(number = number_of(part)) || json_array_append_new(list, number) != 0) {
            json_decref(list);
            return json_string_nocheck(text);
        }
    return list;
}

static bool put_pair(json_t *object, char *pair, bool (*is_flag)(const char *key), lam_error *error)
{
    char *value = strchr(pair, '=');
    if (!value && !(is_flag && is_flag(pair)))
        return fail(error, LAM_BAD_ARGUMENT, "found '%.60s', expected key=value", pair);
    if (value)
        *value++ = 0;
    if (json_object_get(object, pair))
        return fail(error, LAM_BAD_ARGUMENT, "'%s' is given twice", pair);
    return json_object_set_new_nocheck(object, pair, value ? value_of(pair, value) : json_true()) == 0 ||
           fail_memory(error, WORDS_MAX);
}

json_t *words_parse(const char *text, const char *first_key, char end, bool (*is_flag)(const char *key),
                    lam_error *error)
{
    char copy[WORDS_MAX], *rest = copy;
    size_t length = strlen(text);
    if (length >= WORDS_MAX) {
        fail(error, LAM_BAD_ARGUMENT, "it is %zu letters long, expected less than %d", length, WORDS_MAX);
        return NULL;
    }
    memcpy(copy, text, length + 1);
    errno = 0;
    json_t *object = json_object();
    bool ok = object || fail_memory(error, length);
    size_t first = strcspn(copy, (char[]){end, 0});
    char after = copy[first];
    copy[first] = 0;
    if (first_key && !(is_flag && (strchr(copy, '=') || is_flag(copy)))) {
        ok = ok && (json_object_set_new_nocheck(object, first_key, json_string_nocheck(copy)) == 0 ||
                    fail_memory(error, length));
        rest = after ? copy + first + 1 : NULL;
    } else {
        copy[first] = after;
    }
    for (char *pair; ok && (pair = strsep(&rest, ","));)
        ok = put_pair(object, pair, is_flag, error);
    if (ok && errno == ENOMEM) // a number has become a text
        ok = fail_memory(error, length);
    if (ok)
        return object;
    json_decref(object);
    return NULL;
}
