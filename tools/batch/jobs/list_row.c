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

// Takes a field of a row of CSV, and the comma behind it. Returns NULL if the field is not valid.
static json_t *take_field(const char **at, const char *end, bool *last, lam_error *error)
{
    const char *from = *at;
    char *text = malloc((size_t)(end - from) + 1), *to = text;
    if (!text)
        return complain(error, LAM_MACHINE, "out of memory"), NULL;
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
    json_t *field = closed && (*last || *from == ',') ? json_stringn(text, (size_t)(to - text)) : NULL;
    if (!field)
        complain(error, LAM_BAD_ARGUMENT, "expected fields of CSV in UTF-8, each quoted field on one line");
    free(text);
    return field;
}

// Takes the fields of a row of CSV as a list. Returns NULL on failure.
static json_t *take_fields(const char *text, const char *end, lam_error *error)
{
    json_t *fields = json_array();
    for (bool last = false; fields && !last;) {
        json_t *field = take_field(&text, end, &last, error);
        if (!field || json_array_append_new(fields, field) != 0) {
            json_decref(fields);
            fields = NULL;
        }
    }
    return fields;
}

static bool check_columns(const json_t *columns, lam_error *error)
{
    for (size_t i = 0; i < json_array_size(columns); i++) {
        const json_t *name = json_array_get(columns, i);
        bool twice = json_string_length(name) == 0;
        for (size_t k = 0; k < i; k++)
            twice |= json_equal(name, json_array_get(columns, k));
        if (twice)
            return complain(error, LAM_BAD_ARGUMENT, "column %zu: found '%.60s', expected a name that is used once",
                            i + 1, json_string_value(name));
    }
    return true;
}

// Returns the row as an object: its columns with their values. Empty fields are missing.
static json_t *named_fields(const json_t *columns, const json_t *fields, lam_error *error)
{
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
    void *next;
    json_object_foreach_safe(row, next, column, value) json_object_set(is_own(column) ? made : options, column, value);
    bool ok = row ? json_object_get(made, "output") || complain(error, LAM_BAD_ARGUMENT, "column 'output': is missing")
                  : header && json_array_size(rows->columns);
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
