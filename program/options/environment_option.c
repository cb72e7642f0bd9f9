// environment_option.c: parses the values of --environment and reads the environments that they name.
#include "environment_option.h"

#include <stdlib.h>
#include <string.h>

#include "options.h"
#include "console.h"

char *environment_option_faces(const char *text, const char *paths[LAM_FACE_COUNT], lam_error *error)
{
    char *copy = strdup(text), *rest = copy;
    if (!copy)
        return complain(error, LAM_MACHINE, "out of memory"), NULL;
    int count = 0;
    bool empty = false;
    for (char *path; (path = strsep(&rest, ",")); count++) {
        if (count < LAM_FACE_COUNT)
            paths[count] = path;
        empty |= !*path;
    }
    if (count == LAM_FACE_COUNT && !empty)
        return copy;
    complain(error, LAM_BAD_ARGUMENT, "found %d names in '%.200s'%s, expected one file or six, px,nx,py,ny,pz,nz",
             count, text, empty ? ", one of them empty" : "");
    free(copy);
    return NULL;
}

const char *environment_option_name(const struct options *o)
{
    return o->shading.reflection_map ? "reflection-map" : "environment";
}

bool environment_option_is_none(const char *text) { return text && strcmp(text, "none") == 0; }

const char *environment_option_built_in(const char *name)
{
    if (environment_option_is_none(name))
        return "none";
    for (int i = 0; lam_environment_built_in_name(i); i++)
        if (strcmp(name, lam_environment_built_in_name(i)) == 0)
            return lam_environment_built_in_name(i);
    return NULL;
}

lam_environment *environment_option_load(const char *text, lam_color_mode color, const lam_control *control,
                                         lam_error *error)
{
    if (environment_option_built_in(text))
        return lam_environment_built_in(text, error);
    if (!strchr(text, ','))
        return lam_environment_load(text, color, control, error);
    const char *paths[LAM_FACE_COUNT];
    char *copy = environment_option_faces(text, paths, error);
    lam_environment *environment = copy ? lam_environment_load_faces(paths, color, control, error) : NULL;
    free(copy);
    return environment;
}
