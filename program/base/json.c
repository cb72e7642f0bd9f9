// json.c: writes JSON values one after the other, on one line.
#include "json.h"

#include <inttypes.h>
#include <stdlib.h>
#include <lambent/base.h>

#include <string.h>

#include "foreign.h"
#include "option_names.h"

static void quoted(FILE *file, const char *text) { print_foreign(file, FOREIGN_JSON, FOREIGN(text)); }

static void before(struct json *json, const char *key)
{
    if (json->comma)
        fputs(", ", json->file);
    json->comma = true;
    if (key) {
        quoted(json->file, key);
        fputs(": ", json->file);
    }
}

void json_open(struct json *json, const char *key, char bracket)
{
    before(json, key);
    putc(bracket, json->file);
    json->comma = false;
}

void json_close(struct json *json, char bracket)
{
    putc(bracket, json->file);
    json->comma = true;
}

void json_text(struct json *json, const char *key, const char *text)
{
    before(json, key);
    if (text)
        quoted(json->file, text);
    else
        fputs("null", json->file);
}

void shortest_number(double value, char text[32])
{
    // This program never sets a locale, so the decimal separator is a point.
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, 32, "%.*g", digits, value);
        if (strtod(text, NULL) == value)
            return;
    }
}

void shortest_float(float value, char text[32])
{
    for (int digits = 1; digits <= 9; digits++) {
        snprintf(text, 32, "%.*g", digits, (double)value);
        if (strtof(text, NULL) == value)
            return;
    }
}

void json_number(struct json *json, const char *key, double value)
{
    before(json, key);
    if (!(value - value == 0)) {
        fputs("null", json->file);
        return;
    }
    char text[32];
    shortest_number(value, text);
    fputs(text, json->file);
}

void json_count(struct json *json, const char *key, uint64_t value)
{
    before(json, key);
    fprintf(json->file, "%" PRIu64, value);
}

void json_none(struct json *json, const char *key)
{
    before(json, key);
    fputs("null", json->file);
}

void json_flag(struct json *json, const char *key, bool value)
{
    before(json, key);
    fputs(value ? "true" : "false", json->file);
}

void json_numbers(struct json *json, const char *key, const double *values, int count)
{
    json_open(json, key, '[');
    for (int i = 0; i < count; i++)
        json_number(json, NULL, values[i]);
    json_close(json, ']');
}

void json_vector(struct json *json, const char *key, lam_vec3 v)
{
    json_numbers(json, key, (double[]){v.x, v.y, v.z}, 3);
}

void json_message(struct json *json, const char *key, const char *text)
{
    char shown[MESSAGE_SIZE];
    json_text(json, key, text ? name_options(text, shown) : NULL);
}
