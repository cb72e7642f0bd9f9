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

void json_numbers(struct json *json, const char *key, const double *values, int count)
{
    json_open(json, key, '[');
    for (int i = 0; i < count; i++)
        json_number(json, NULL, values[i]);
    json_close(json, ']');
}

void json_message(struct json *json, const char *key, const char *text)
{
    char shown[MESSAGE_SIZE];
    json_text(json, key, text ? name_options(text, shown) : NULL);
}

void json_values(struct json *json, const struct result_value *values)
{
    for (const struct result_value *v = values; v->kind != RESULT_END; v++)
        switch (v->kind) {
        case RESULT_COUNT:
            before(json, v->key);
            fprintf(json->file, "%" PRIu64, v->whole);
            break;
        case RESULT_FLAG:
            before(json, v->key);
            fputs(v->whole ? "true" : "false", json->file);
            break;
        case RESULT_NUMBER:
            json_number(json, v->key, v->numbers[0]);
            break;
        case RESULT_NUMBERS:
            json_numbers(json, v->key, v->numbers, v->count);
            break;
        case RESULT_OBJECT:
        case RESULT_LIST:
            json_open(json, v->key, v->kind == RESULT_LIST ? '[' : '{');
            json_values(json, v->values);
            json_close(json, v->kind == RESULT_LIST ? ']' : '}');
            break;
        default:
            json_text(json, v->key, v->kind == RESULT_TEXT ? v->text : NULL);
        }
}

void json_warnings(struct json *json, const lam_scene *scene)
{
    json_open(json, "warnings", '[');
    for (int i = 0; scene && lam_scene_warning(scene, i); i++)
        json_message(json, NULL, lam_scene_warning(scene, i));
    json_close(json, ']');
}
