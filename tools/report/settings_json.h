// settings_json.h: prints the section of a report about the user's settings file.
#ifndef SETTINGS_JSON_H
#define SETTINGS_JSON_H

#include "json.h"
#include "options.h"

// Returns whether the settings file changed an option.
bool settings_are_used(const struct options *options);

// Prints "settings", which lists the options from the settings file with their values. Prints nothing if there are no
// such options.
void settings_json(struct json *json, const struct options *options);

// Prints the name and the value of an option.
void option_json(struct json *json, const char *name, const char *value);

#endif
