// list_row.c: makes jobs from the rows of a list (--list): CSV (RFC 4180) or JSON Lines.
#include "batch_job.h"

#include <stdlib.h>
#include <string.h>

#include "console.h"

// Columns that are keys of a job. All others are options of the picture.
static const char *const own_columns[] = {"model", "output"};

static bool is_own(const char *column)
{
    for (size_t i = 0; i < sizeof own_columns / sizeof *own_columns; i++)
        if (strcmp(column, own_columns[i]) == 0)
            return true;
    return false;
}

// Takes a field of a row of CSV, and the comma behind it. `text` has space for the row. Returns NULL if the field is not
// valid.
static json_t *take_field(const char **at, const char *end, char *text, bool *last, lam_error *error)
{
    const char *from = *at;
    char *to = text;
    const bool quoted = from < end && *from == '"';
    from += quoted;
    while (from < end && (quoted ? *from != '"' || (from + 1 < end && from[1] == '"') : *from != ',')) {
        from += quoted && *from == '"';
        *to++ = *from++;
    }
    const bool closed = !quoted || from < end;
    from += quoted && closed;
    *last = from == end;
    *at = from + !*last;
    const size_t size = (size_t)(to - text);
    json_t *field = closed && (*last || *from == ',') && !memchr(text, 0, size) ? json_stringn(text, size) : NULL;
    if (!field)
        complain(error, LAM_BAD_ARGUMENT, "expected fields of CSV in UTF-8, each quoted field on one line");
    return field;
}

// Takes the fields of a row of CSV as a list. Returns NULL on failure.
static json_t *take_fields(const char *row, const char *end, lam_error *error)
{
    json_t *fields = json_array();
    char *text = malloc((size_t)(end - row) + 1);
    if (!text || !fields) {
        json_decref(fields);
        free(text);
        return complain(error, LAM_MACHINE, "out of memory"), NULL;
    }
    for (bool last = false; fields && !last;) {
        json_t *field = take_field(&row, end, text, &last, error);
        if (!field || json_array_append_new(fields, field) != 0) {
            json_decref(fields);
            fields = NULL;
        }
    }
    free(text);
    return fields;
}

static bool check_columns(const json_t *columns, lam_error *error)
{
    json_t *seen = json_object();
    const json_t *column = NULL;
    size_t i = 0;
    for (; i < json_array_size(columns); i++) {
        column = json_array_get(columns, i);
        if (json_string_length(column) == 0 || json_object_get(seen, json_string_value(column)))
            break;
        json_object_set_new(seen, json_string_value(column), json_true());
    }
    const bool unique = i == json_array_size(columns),
               complete = json_object_get(seen, "model") && json_object_get(seen, "output");
    json_decref(seen);
    if (!unique)
        return complain(error, LAM_BAD_ARGUMENT, "column %zu: found '%.60s', expected a name that is used once", i + 1,
                        json_string_value(column));
    return complete ||
           complain(error, LAM_BAD_ARGUMENT,
                    "found the column%s '%.60s'%s, expected names separated by commas, with 'model' and 'output'",
                    i > 1 ? "s" : "", json_string_value(json_array_get(columns, 0)), i > 1 ? ", …" : "");
}

// Notes the name of a picture. Fails if an earlier row has the same, because its picture would be replaced.
static bool note_output(struct list_rows *rows, const json_t *output, uint64_t line, lam_error *error)
{
    const char *name = json_string_value(output);
    if (!rows->outputs)
        rows->outputs = json_object();
    const json_t *before = name ? json_object_get(rows->outputs, name) : NULL;
    if (before)
        return complain(error, LAM_BAD_ARGUMENT, "column 'output': line %lld names '%.200s', too",
                        (long long)json_integer_value(before), name);
    return !name || json_object_set_new(rows->outputs, name, json_integer((json_int_t)line)) == 0 ||
           complain(error, LAM_MACHINE, "out of memory");
}

// Returns the row as an object: its columns with their values. Empty fields are missing.
static json_t *named_fields(const json_t *columns, const json_t *fields, lam_error *error)
{
    if (json_array_size(columns) == 0)
        return complain(error, LAM_BAD_ARGUMENT, "the first line names no valid columns"), NULL;
    json_t *row = json_object();
    if (json_array_size(fields) > json_array_size(columns)) {
        complain(error, LAM_BAD_ARGUMENT, "found %zu fields, expected at most %zu, the columns of the first line",
                 json_array_size(fields), json_array_size(columns));
        json_decref(row);
        return NULL;
    }
    for (size_t i = 0; i < json_array_size(fields); i++) {
        const char *text = json_string_value(json_array_get(fields, i));
        json_t *value =
            strcmp(text, "true") == 0 || strcmp(text, "false") == 0 ? json_boolean(*text == 't') : json_string(text);
        if (*text)
            json_object_set_new(row, json_string_value(json_array_get(columns, i)), value);
        else
            json_decref(value);
    }
    return row;
}

static json_t *read_row(struct list_rows *rows, const char *text, size_t size, lam_error *error)
{
    json_error_t reason;
    json_t *row = NULL;
    if (!rows->is_csv) {
        row = json_loadb(text, size, JSON_REJECT_DUPLICATES, &reason);
        if (!json_is_object(row)) {
            json_decref(row);
            return complain(error, LAM_BAD_ARGUMENT, "expected an object of JSON with the columns of a picture"), NULL;
        }
        return row;
    }
    json_t *fields = take_fields(text, text + size, error);
    if (fields && !rows->columns) {
        rows->columns = fields;
        if (!check_columns(fields, error))
            json_array_clear(fields); // so that no row is valid
        return NULL;
    }
    if (fields)
        row = named_fields(rows->columns, fields, error);
    json_decref(fields);
    return row;
}

bool list_rows_take(struct list_rows *rows, const char *text, size_t size, uint64_t line, char **job, lam_error *error)
{
    static const char mark[] = "\xEF\xBB\xBF"; // a byte order mark
    const size_t skipped = line == 1 && size >= 3 && memcmp(text, mark, 3) == 0 ? 3 : 0;
    const bool header = rows->is_csv && !rows->columns;
    *job = NULL;
    size -= size > skipped && text[size - 1] == '\r';
    json_t *row = read_row(rows, text + skipped, size - skipped, error), *options = json_object(), *value;
    json_t *made = json_pack("{s:I}", "id", (json_int_t)line);
    const char *column;
    json_object_foreach(row, column, value) json_object_set(is_own(column) ? made : options, column, value);
    const json_t *output = json_object_get(made, "output");
    bool ok = !row     ? header && json_array_size(rows->columns)
              : output ? note_output(rows, output, line, error)
                       : complain(error, LAM_BAD_ARGUMENT, "column 'output': is missing");
    if (row && ok) {
        json_object_set(made, "options", options);
        *job = json_dumps(made, JSON_COMPACT);
        ok = *job || complain(error, LAM_MACHINE, "out of memory");
    }
    json_decref(row);
    json_decref(options);
    json_decref(made);
    return ok;
}
