// json_reader.c: positions in a JSON file, and error messages about values.
#include "json_reader.h"

#include "fail.h"
#include "spelling.h"

#include <stdio.h>
#include <string.h>

static size_t print_place(const struct place *place, char *out, size_t capacity)
{
    if (!place)
        return 0;
    size_t used = print_place(place->within, out, capacity);
    if (used >= capacity)
        return used;
    char shown[SHOWN_NAME_SIZE]; // keys of materials, and unknown keys, are names from the file
    int length = place->key
                     ? snprintf(out + used, capacity - used, "%s%s", used ? "." : "", shown_name(place->key, shown))
                     : snprintf(out + used, capacity - used, "[%zu]", place->index);
    return used + (length > 0 ? (size_t)length : 0);
}

bool json_vfail(const struct json_reader *r, const struct place *place, const char *format, va_list arguments)
{
    char where[200] = "", sentence[sizeof r->error->text];
    print_place(place, where, sizeof where);
    vsnprintf(sentence, sizeof sentence, format, arguments);
    if (!r->file)
        return fail(r->error, LAM_BAD_ARGUMENT, "%s%s%s", where, *where ? ": " : "", sentence);
    int line = r->text ? json_line_of(r->text, r->size, place) : 0;
    char number[16] = "";
    if (line)
        snprintf(number, sizeof number, ":%d", line);
    return fail(r->error, LAM_CANNOT_READ, "%s%s: %s%s%s", r->file, number, where, *where ? ": " : "", sentence);
}

bool json_fail(const struct json_reader *r, const struct place *place, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    json_vfail(r, place, format, arguments);
    va_end(arguments);
    return false;
}

const char *json_kind(const json_t *value, char out[JSON_KIND_SIZE])
{
    char shown[SHOWN_NAME_SIZE];
    switch (json_typeof(value)) {
    case JSON_OBJECT:
        return "an object";
    case JSON_ARRAY:
        snprintf(out, JSON_KIND_SIZE, "a list of %zu", json_array_size(value));
        return out;
    case JSON_STRING:
        snprintf(out, JSON_KIND_SIZE, "\"%s\"", shown_name(json_string_value(value), shown));
        return out;
    case JSON_TRUE:
        return "true";
    case JSON_FALSE:
        return "false";
    case JSON_NULL:
        return "null";
    default:
        snprintf(out, JSON_KIND_SIZE, "%.10g", json_number_value(value));
        return out;
    }
}

// Prints a value in the spelling of options: 1/2/3, yes.
static void print_word(const json_t *value, char *out, size_t capacity)
{
    char shown[SHOWN_NAME_SIZE];
    size_t used = 0;
    *out = 0;
    if (json_is_array(value))
        for (size_t i = 0; i < json_array_size(value) && used + 1 < capacity; used = strlen(out), i++) {
            used += (size_t)snprintf(out + used, capacity - used, "%s", i ? "/" : "");
            print_word(json_array_get(value, i), out + used, capacity - used);
        }
    else if (json_is_number(value))
        snprintf(out, capacity, "%.10g", json_number_value(value));
    else if (json_is_string(value))
        snprintf(out, capacity, "%s", shown_name(json_string_value(value), shown));
    else
        snprintf(out, capacity, "%s", json_is_true(value) ? "yes" : "no");
}

bool json_unexpected(const struct json_reader *r, const struct place *place, const json_t *found, const char *expected)
{
    char kind[JSON_KIND_SIZE], word[200];
    if (!r->file && place && place->key) {
        print_word(found, word, sizeof word);
        return fail(r->error, LAM_BAD_ARGUMENT, "found '%s=%.60s', expected %s", place->key, word, expected);
    }
    return json_fail(r, place, "found %s, expected %s", json_kind(found, kind), expected);
}

bool json_check_keys(const struct json_reader *r, const struct place *place, const json_t *object,
                     const char *const *keys)
{
    if (!json_is_object(object))
        return json_unexpected(r, place, object, "an object, { … }");
    int count = 0;
    while (keys[count])
        count++;
    const char *key;
    json_t *value;
    json_object_foreach((json_t *)(uintptr_t)object, key, value)
    {
        int i = 0;
        while (i < count && strcmp(keys[i], key) != 0)
            i++;
        if (i < count)
            continue;
        const char *nearest = strlen(key) <= 40 ? meant_word(key, keys, count) : NULL;
        char known[300] = "";
        for (i = 0; !nearest && i < count; i++) {
            size_t used = strlen(known);
            snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : "", keys[i]);
        }
        char quoted[SHOWN_NAME_SIZE + 3] = "", shown[SHOWN_NAME_SIZE];
        if (!r->file)
            snprintf(quoted, sizeof quoted, " '%s'", shown_name(key, shown));
        return json_fail(r, r->file ? KEY_OF(place, key) : NULL,
                         nearest ? "unknown key%s; did you mean '%s'?" : "unknown key%s; expected %s", quoted,
                         nearest ? nearest : known);
    }
    return true;
}

bool json_number_of(const struct json_reader *r, const struct place *place, const json_t *value, double min, double max,
                    double *out)
{
    char expected[100];
    if (!json_is_number(value))
        return json_unexpected(r, place, value, "a number");
    double number = json_number_value(value);
    if (number >= min && number <= max) {
        *out = number;
        return true;
    }
    if (min == max)
        snprintf(expected, sizeof expected, "%.10g", min);
    else if (min > -1e30 && max < 1e30)
        snprintf(expected, sizeof expected, "a number from %.10g to %.10g", min, max);
    else if (min > -1e30)
        snprintf(expected, sizeof expected, "a number of at least %.10g", min);
    else
        snprintf(expected, sizeof expected, "a number of at most %.10g", max);
    return json_unexpected(r, place, value, expected);
}

bool json_numbers_of(const struct json_reader *r, const struct place *place, const json_t *list, size_t min, size_t max,
                     double *out, size_t *count)
{
    char expected[60];
    size_t size = json_is_array(list) ? json_array_size(list) : 0;
    const char *list_of = r->file ? "a list of " : "";
    if (min == max)
        snprintf(expected, sizeof expected, "%s%zu numbers", list_of, min);
    else
        snprintf(expected, sizeof expected, "%s%zu to %zu numbers", list_of, min, max);
    if (!json_is_array(list) || size < min || size > max)
        return json_unexpected(r, place, list, expected);
    for (size_t i = 0; i < size; i++)
        if (!json_number_of(r, ELEMENT_OF(place, i), json_array_get(list, i), -1e30, 1e30, &out[i]))
            return false;
    if (count)
        *count = size;
    return true;
}

// --- the keys of an object

bool json_take_number(const struct json_reader *r, const struct place *place, const json_t *object, const char *key,
                      double min, double max, double *out)
{
    const json_t *value = json_object_get(object, key);
    return !value || json_number_of(r, KEY_OF(place, key), value, min, max, out);
}

bool json_take_bool(const struct json_reader *r, const struct place *place, const json_t *object, const char *key,
                    bool *out)
{
    const json_t *value = json_object_get(object, key);
    if (!value)
        return true;
    *out = json_is_true(value);
    return json_is_boolean(value) ||
           json_unexpected(r, KEY_OF(place, key), value, r->file ? "true or false" : "yes or no");
}

bool json_take_text(const struct json_reader *r, const struct place *place, const json_t *object, const char *key,
                    const char **out)
{
    const json_t *value = json_object_get(object, key);
    if (!value)
        return true;
    if (!json_is_string(value) || !json_string_length(value))
        return json_unexpected(r, KEY_OF(place, key), value, "a string that is not empty");
    *out = json_string_value(value);
    return true;
}

bool json_choice_of(const struct json_reader *r, const struct place *place, const json_t *value,
                    const struct json_choice *words, int *out)
{
    const char *names[16];
    int count = 0;
    char known[160] = "";
    for (; words[count].name; count++) {
        names[count] = words[count].name;
        if (json_is_string(value) && strcmp(json_string_value(value), words[count].name) == 0) {
            *out = words[count].value;
            return true;
        }
        size_t used = strlen(known);
        snprintf(known + used, sizeof known - used, "%s%s",
                 !count                  ? ""
                 : words[count + 1].name ? ", "
                                         : " or ",
                 names[count]);
    }
    bool text = json_is_string(value) && json_string_length(value) <= 40;
    const char *nearest = text ? meant_word(json_string_value(value), names, count) : NULL;
    char expected[240];
    snprintf(expected, sizeof expected, "%s%s%s%s", known, nearest ? "; did you mean '" : "", nearest ? nearest : "",
             nearest ? "'?" : "");
    return json_unexpected(r, place, value, expected);
}

bool json_take_word(const struct json_reader *r, const struct place *place, const json_t *object, const char *key,
                    const struct json_choice *words, int *out)
{
    const json_t *value = json_object_get(object, key);
    return !value || json_choice_of(r, KEY_OF(place, key), value, words, out);
}
