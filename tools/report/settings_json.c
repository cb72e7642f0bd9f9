// settings_json.c: prints the values of the user's settings file as a section of a report.
#include "settings_json.h"

bool settings_are_used(const struct options *options)
{
    for (int i = 0; option_table[i].name; i++)
        if (options->by_config[i])
            return true;
    return false;
}

void option_json(struct json *json, const char *name, const char *value)
{
    json_put(json, OBJECT(NULL, TEXT("name", name), TEXT("value", value)));
}

void settings_json(struct json *json, const struct options *options)
{
    if (!settings_are_used(options))
        return;
    json_open(json, "settings", '[');
    for (int i = 0; option_table[i].name; i++)
        if (options->by_config[i])
            option_json(json, option_table[i].name, options->values[i]);
    json_close(json, ']');
}
