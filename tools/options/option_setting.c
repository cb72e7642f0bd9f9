// option_setting.c: the row of the library's table of settings that an option stores.
#include "options.h"

#include <stdio.h>

const lam_setting *option_setting(const struct option *option)
{
    char key[40]; // which has _ in place of -
    snprintf(key, sizeof key, "%s", option->name);
    for (char *at = key; *at; at++)
        *at = *at == '-' ? '_' : *at;
    return lam_draw_setting(lam_draw_setting_find(key));
}
