// json_parse.c: parses JSON text into Jansson values.
#include "json_parse.h"

#include "fail.h"
#include "number.h"
#include "shown_name.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct parser {
    const char *begin, *at, *end;
    const char *file;
    struct call_control *call;
    lam_error *error;
    size_t values;   // number of values read so far
    int depth_limit; // the limit of this call
};

// --- errors

static bool fail_as(const struct parser *p, lam_code code, const char *at, const char *sentence)
{
    size_t line = 1, column = 1;
    for (const char *c = p->begin; c < at; c++) {
        if (*c == '\n') {
            line++;
            column = 0;
        }
        column += (*c & 0xc0) != 0x80; // columns are counted in characters, not bytes
    }
    return fail(p->error, code, "%s:%zu: column %zu: %s", p->file, line, column, sentence);
}

static bool fail_at(const struct parser *p, const char *at, const char *sentence)
{
    return fail_as(p, LAM_CANNOT_READ, at, sentence);
}

// Reports an opening bracket that is nested too deeply.
static bool fail_depth(const struct parser *p)
{
    char sentence[120];
    snprintf(sentence, sizeof sentence, "values are nested %d deep, expected at most %d (lam_control.json_depth_limit)",
             p->depth_limit + 1, p->depth_limit);
    return fail_as(p, LAM_LIMIT, p->at, sentence);
}

// Reports the unexpected text: the characters up to the next space or punctuation mark, or one character.
static bool fail_found(const struct parser *p, const char *expected)
{
    static const char *const ends = " \t\r\n{}[]:,\"";
    size_t length = 0;
    while (p->at + length < p->end && !(p->at[length] && strchr(ends, p->at[length])))
        length++;
    char shown[SHOWN_NAME_SIZE], sentence[SHOWN_NAME_SIZE + 120];
    if (p->at == p->end)
        snprintf(sentence, sizeof sentence, "found the end of the file, expected %s", expected);
    else
        snprintf(sentence, sizeof sentence, "found '%s', expected %s", shown_name_of(p->at, length ? length : 1, shown),
                 expected);
    return fail_at(p, p->at, sentence);
}

// Frees a partly built value.
static json_t *drop(json_t *value)
{
    json_decref(value);
    return NULL;
}

static json_t *no_memory(const struct parser *p, json_t *value)
{
    fail_memory(p->error, (size_t)(p->end - p->begin));
    return drop(value);
}

// --- strings

static void skip_space(struct parser *p)
{
    while (p->at < p->end && (*p->at == ' ' || *p->at == '\t' || *p->at == '\n' || *p->at == '\r'))
        p->at++;
}

// Skips spaces. If the next character is `c`, also skips this character and returns true.
static bool accept(struct parser *p, char c)
{
    skip_space(p);
    if (p->at == p->end || *p->at != c)
        return false;
    p->at++;
    return true;
}

// Returns the value of the four digits of \uXXXX at `at`, or −1 if they are invalid.
static int read_unit(const struct parser *p, const char *at)
{
    int unit = 0;
    for (int i = 0; i < 4; i++, at++) {
        int digit = at < p->end ? number_hex_digit(*at) : -1;
        if (digit < 0)
            return -1;
        unit = unit * 16 + digit;
    }
    return unit;
}

static char *put_utf8(char *to, int c)
{
    if (c < 0x80) {
        *to++ = (char)c;
    } else if (c < 0x800) {
        *to++ = (char)(0xc0 | c >> 6);
        *to++ = (char)(0x80 | (c & 0x3f));
    } else if (c < 0x10000) {
        *to++ = (char)(0xe0 | c >> 12);
        *to++ = (char)(0x80 | (c >> 6 & 0x3f));
        *to++ = (char)(0x80 | (c & 0x3f));
    } else {
        *to++ = (char)(0xf0 | c >> 18);
        *to++ = (char)(0x80 | (c >> 12 & 0x3f));
        *to++ = (char)(0x80 | (c >> 6 & 0x3f));
        *to++ = (char)(0x80 | (c & 0x3f));
    }
    return to;
}

// Decodes the escape sequence at the backslash. An escape sequence is never shorter than its character in UTF-8, so
// `to` has enough space. Returns NULL on error.
static char *read_escape(struct parser *p, char *to)
{
    static const char letters[] = "\"\\/bfnrt", characters[] = "\"\\/\b\f\n\r\t";
    const char *letter = p->end - p->at >= 2 && p->at[1] ? strchr(letters, p->at[1]) : NULL;
    if (letter) {
        *to = characters[letter - letters];
        p->at += 2;
        return to + 1;
    }
    int unit = p->end - p->at >= 2 && p->at[1] == 'u' ? read_unit(p, p->at + 2) : -1, length = 6;
    if (unit >= 0xd800 && unit < 0xdc00 && p->end - p->at >= 8 && p->at[6] == '\\' && p->at[7] == 'u') {
        int low = read_unit(p, p->at + 8);
        unit = low >= 0xdc00 && low < 0xe000 ? 0x10000 + (unit - 0xd800) * 0x400 + low - 0xdc00 : -1;
        length = 12;
    }
    if (unit < 1 || (unit >= 0xd800 && unit < 0xe000))
        return fail_at(p, p->at,
                       unit == 0 ? "a string contains a zero character"
                                 : "a string contains an invalid "
                                   "escape"),
               NULL;
    p->at += length;
    return put_utf8(to, unit);
}

// A string: bytes of the file, or a decoded copy if the string contains escapes or characters outside ASCII.
struct text {
    const char *at;
    size_t length;
    char *copy; // the copy, freed with free(); otherwise NULL
};

// Decodes the characters from p->at to `close` into `to`. Returns the end, or NULL on error.
static char *decode_text(struct parser *p, const char *close, char *to)
{
    while (to && p->at < close) {
        int step = *p->at == '\\' ? 0 : lam_utf8_length(p->at, (size_t)(close - p->at));
        if (step == 0 && *p->at == '\\') {
            to = read_escape(p, to);
        } else if (step == 0 || (unsigned char)*p->at < 0x20) {
            fail_at(p, p->at,
                    step ? "a string contains a control character, expected an escape" : "a string is not UTF-8");
            to = NULL;
        } else {
            memcpy(to, p->at, (size_t)step);
            to += step;
            p->at += step;
        }
    }
    return to;
}

// Reads the string at an opening quote. Returns false on error.
static bool read_text(struct parser *p, struct text *text)
{
    const char *start = p->at++, *close = p->at;
    bool plain = true;
    for (; close < p->end && *close != '"'; close += *close == '\\' ? 2 : 1)
        plain &= *close >= 0x20 && *close < 0x7f && *close != '\\';
    if (close >= p->end)
        return fail_at(p, start, "a string without its closing quote");
    *text = (struct text){p->at, (size_t)(close - p->at), NULL};
    if (!plain) {
        text->at = text->copy = malloc(text->length + 1);
        if (!text->copy)
            return fail_memory(p->error, text->length + 1);
        const char *end = decode_text(p, close, text->copy);
        if (!end) {
            free(text->copy);
            return false;
        }
        text->length = (size_t)(end - text->copy);
    }
    p->at = close + 1;
    return true;
}

// --- values

static const char *skip_digits(const struct parser *p, const char *at)
{
    while (at < p->end && *at >= '0' && *at <= '9')
        at++;
    return at;
}

static json_t *read_number(struct parser *p)
{
    const char *at = p->at + (*p->at == '-'), *digits = at;
    at = at < p->end && *at == '0' ? at + 1 : skip_digits(p, at);
    bool good = at > digits, whole = true;
    if (at < p->end && *at == '.') {
        digits = at + 1;
        at = skip_digits(p, digits);
        good &= at > digits;
        whole = false;
    }
    if (at < p->end && (*at == 'e' || *at == 'E')) {
        digits = at + 1;
        digits += digits < p->end && (*digits == '+' || *digits == '-');
        at = skip_digits(p, digits);
        good &= at > digits;
        whole = false;
    }
    int64_t integer;
    double number = 0;
    const uint8_t *from = (const uint8_t *)p->at, *to = (const uint8_t *)at;
    if (!good || (at < p->end && ((*at >= '0' && *at <= '9') || *at == '.')))
        return fail_found(p, "a number"), NULL;
    json_t *value = NULL;
    if (whole && number_int(from, to, &integer) == to)
        value = json_integer(integer);
    else if (number_double(from, to, &number) == to && number - number == 0)
        value = json_real(number);
    else
        fail_found(p, "a number within the range of a double");
    if (!value)
        return number - number == 0 ? no_memory(p, NULL) : NULL;
    p->at = at;
    return value;
}

static json_t *read_word(struct parser *p)
{
    static const struct {
        const char *word;
        json_t *(*make)(void);
    } words[] = {{"true", json_true}, {"false", json_false}, {"null", json_null}};
    for (int i = 0; i < 3; i++) {
        size_t length = strlen(words[i].word);
        if ((size_t)(p->end - p->at) >= length && memcmp(p->at, words[i].word, length) == 0) {
            p->at += length;
            return words[i].make();
        }
    }
    fail_found(p, "a value");
    return NULL;
}

static json_t *read_value(struct parser *p, int depth);

static json_t *read_list(struct parser *p, int depth)
{
    json_t *list = json_array();
    if (!list)
        return no_memory(p, NULL);
    if (accept(p, ']'))
        return list;
    do {
        json_t *value = read_value(p, depth);
        if (!value)
            return drop(list);
        if (json_array_append_new(list, value) != 0)
            return no_memory(p, list);
    } while (accept(p, ','));
    if (accept(p, ']'))
        return list;
    fail_found(p, "',' or ']'");
    return drop(list);
}

static bool fail_twice(struct parser *p, const char *start, const char *key)
{
    char sentence[128];
    snprintf(sentence, sizeof sentence, "the key '%.60s' is given twice", key);
    return fail_at(p, start, sentence);
}

// Adds a value, which `object` then owns. `key` ends with a zero byte. Returns false on error.
static bool add_value(struct parser *p, json_t *object, const char *start, const char *key, json_t *value)
{
    size_t keys = json_object_size(object);
    if (json_object_set_new_nocheck(object, key, value) != 0)
        return fail_memory(p->error, strlen(key));
    return json_object_size(object) > keys || fail_twice(p, start, key);
}

// Reads one key-value pair.
static bool read_pair(struct parser *p, json_t *object, int depth)
{
    struct text key;
    skip_space(p);
    const char *start = p->at;
    if (p->at == p->end || *p->at != '"')
        return fail_found(p, "a key in quotes");
    if (!read_text(p, &key))
        return false;
    char room[32], *name = key.copy ? key.copy : key.length < sizeof room ? room : malloc(key.length + 1);
    if (!name)
        return fail_memory(p->error, key.length + 1);
    if (name != key.copy)
        memcpy(name, key.at, key.length);
    name[key.length] = 0;
    json_t *value = accept(p, ':') ? read_value(p, depth) : (fail_found(p, "':'"), NULL);
    bool ok = value && add_value(p, object, start, name, value);
    if (name != room)
        free(name);
    return ok;
}

static json_t *read_object(struct parser *p, int depth)
{
    json_t *object = json_object();
    if (!object)
        return no_memory(p, NULL);
    if (accept(p, '}'))
        return object;
    do {
        if (!read_pair(p, object, depth))
            return drop(object);
    } while (accept(p, ','));
    if (accept(p, '}'))
        return object;
    fail_found(p, "',' or '}'");
    return drop(object);
}

static json_t *read_string(struct parser *p)
{
    struct text text;
    if (!read_text(p, &text))
        return NULL;
    json_t *value = json_stringn_nocheck(text.at, text.length);
    free(text.copy);
    return value ? value : no_memory(p, NULL);
}

static json_t *read_value(struct parser *p, int depth)
{
    if (++p->values % 4096 == 0 && !call_should_continue(p->call))
        return call_error(p->call, p->error), NULL;
    skip_space(p);
    char first = p->at < p->end ? *p->at : 0;
    if (depth == p->depth_limit && (first == '{' || first == '['))
        return fail_depth(p), NULL;
    if (first == '{' || first == '[') {
        p->at++;
        return first == '{' ? read_object(p, depth + 1) : read_list(p, depth + 1);
    }
    if (first == '"')
        return read_string(p);
    return first == '-' || (first >= '0' && first <= '9') ? read_number(p) : read_word(p);
}

json_t *json_parse(const char *text, size_t size, const char *file, struct call_control *call, lam_error *error)
{
    struct parser p = {.begin = text,
                       .at = text,
                       .end = text + size,
                       .file = file,
                       .call = call,
                       .error = error,
                       .depth_limit = (int)call_json_depth_limit(call)};
    if (size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0)
        p.begin = p.at = text + 3;
    skip_space(&p);
    if (p.at == p.end || (*p.at != '{' && *p.at != '['))
        return fail_found(&p, "'{' or '['"), NULL;
    json_t *root = read_value(&p, 0);
    skip_space(&p);
    if (root && p.at < p.end) {
        fail_found(&p, "the end of the file");
        return drop(root);
    }
    return root;
}
