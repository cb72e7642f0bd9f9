// failure.c: reports errors as text and as JSON.
#include "failure.h"

#include <string.h>

#include "command_table.h"
#include "console.h"
#include "option_names.h"
#include "sandbox_start.h"

void report_begin(struct json *json)
{
    json_open(json, NULL, '{');
    const struct sandbox_state *sandbox = sandbox_active();
    json_put(json, TEXT("lambent", lam_version()),
             OBJECT("sandbox", COUNT("landlock", sandbox->landlock), FLAG("seccomp", sandbox->filter)));
}

void json_error(struct json *json, const lam_error *error)
{
    const struct exit_code *code = error && error->code != LAM_OK ? exit_code_of(error->code) : NULL;
    char shown[MESSAGE_SIZE];
    if (code)
        json_put(json, OBJECT("error", TEXT("code", code->name), COUNT("exit", code->code),
                              TEXT("text", name_options(error->text, shown))));
    else
        json_put(json, NONE("error"));
}

FILE *report_stream(const struct options *options)
{
    if (!options->report.json)
        return NULL;
    return options->picture.output && strcmp(options->picture.output, "-") == 0 ? stderr : stdout;
}

// Prints a report in the format of docs/report.schema.json that contains only an error.
static void report_without_job(FILE *file, const lam_error *error)
{
    struct json json = {.file = file};
    report_begin(&json);
    json_put(&json, NONE("model"));
    json_warnings(&json, NULL);
    json_error(&json, error);
    json_close(&json, '}');
    putc('\n', file);
}

// Prints the command that shows the help of an option or a command. `text` is a usage error that starts with its name.
static void say_where_to_look(const char *text)
{
    char name[64];
    static const char before[] = "option '--";
    bool of_option = strncmp(text, before, sizeof before - 1) == 0;
    if (of_option)
        text += sizeof before - 1;
    snprintf(name, sizeof name, "%.*s", (int)strcspn(text, of_option ? "'" : ": "), text);
    if (of_option && option_find(name))
        say_plain("Try 'lambent help %s'.\n", name);
    else if (!of_option && find_command(name))
        say_plain("Try 'lambent %s -h'.\n", name);
    else
        say_plain("Try 'lambent -h'.\n");
}

int report_failure(const lam_error *error, const struct options *options)
{
    FILE *stream = report_stream(options);
    if (stream != stderr)
        say_error(error->text);
    if (stream)
        report_without_job(stream, error);
    else if (error->code == LAM_BAD_ARGUMENT)
        say_where_to_look(error->text);
    return exit_code_of(error->code)->code;
}
