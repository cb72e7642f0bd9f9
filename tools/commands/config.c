// config.c: the command `config`: prints the effective settings and the file from which they were read.
#include "command.h"

#include <stdio.h>
#include <stdlib.h>

#include "json.h"
#include "report.h"
#include "settings_file.h"

static const char *const states[][2] = {[SETTINGS_READ] = {"read", "read"},
                                        [SETTINGS_MISSING] = {"missing", "no such file"},
                                        [SETTINGS_CI] = {"ci", "not read: the environment variable CI is set"},
                                        [SETTINGS_OFF] = {"off", "not read: --no-config"}};

static void print_json(const struct options *options, const struct settings_source *source)
{
    struct json json = {.file = stdout};
    json_open(&json, NULL, '{');
    json_put(&json, TEXT("lambent", lam_version()), TEXT("file", *source->path ? source->path : NULL),
             TEXT("state", states[source->state][0]));
    json_open(&json, "settings", '[');
    for (int i = 0; option_table[i].name; i++) {
        if (!options->by_config[i])
            continue;
        json_put(&json, OBJECT(NULL, TEXT("name", option_table[i].name), TEXT("value", options->values[i]),
                               COUNT("line", options->by_config[i])));
    }
    json_close(&json, ']');
    json_close(&json, '}');
    putchar('\n');
}

int run_config(int operand_count, char **operands, const struct options *options)
{
    (void)operand_count, (void)operands;
    struct options own = *options, before; // `options` owns the lists in these copies
    struct settings_source source;
    lam_error error = {0};
    bool ok = settings_apply(&own, &before, &source, &error);
    if (ok && options->report.json) {
        print_json(&own, &source);
    } else if (ok) {
        if (*source.path)
            printf("%s: %s\n", source.path, states[source.state][1]);
        else
            puts("no settings file: neither XDG_CONFIG_HOME nor HOME names a folder");
        for (int i = 0; option_table[i].name; i++)
            if (own.by_config[i])
                printf("  line %-4d --%s%s%s\n", own.by_config[i], option_table[i].name, own.values[i] ? " " : "",
                       own.values[i] ? own.values[i] : "");
    }
    int code = ok ? 0 : report_failure(&error, options);
    free(own.settings.values);
    return code;
}
