// check_pairs.c: pairs vertex shaders with fragment shaders, and names their sheets.
#include "check.h"

#include <stdlib.h>
#include <string.h>

#include "console.h"
#include "output.h"

// The length of a path without its ending: for "a/phong.frag" and "a/phong.frag.glsl" that of "a/phong".
static size_t stem_length(const char *path)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    const char *dot = strrchr(name, '.');
    if (dot > name && strcmp(dot, ".glsl") == 0)
        for (const char *c = name + 1; c < dot; c++)
            if (*c == '.')
                return (size_t)(c - path);
    return dot > name ? (size_t)(dot - path) : strlen(path);
}

static bool is_vertex(const char *path)
{
    static const char *const endings[] = {"vert", "vs", "vsh", "vertex"};
    const char *ending = path + stem_length(path);
    size_t length = *ending ? strcspn(ending + 1, ".") : 0;
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++)
        if (length == strlen(endings[i]) && strncmp(ending + 1, endings[i], length) == 0)
            return true;
    return false;
}

static bool same_stem(const char *a, const char *b)
{
    size_t length = stem_length(a);
    return length == stem_length(b) && strncmp(a, b, length) == 0;
}

int check_pair(int count, char **files, const char *vertex, struct check_pair *pairs, lam_error *error)
{
    int made = 0;
    for (int i = 0; i < count; i++)
        if (!is_vertex(files[i]) || count == 1)
            pairs[made++] = (struct check_pair){files[i], vertex};
    for (int i = 0; i < count; i++) {
        struct check_pair *mine = NULL;
        for (int k = 0; k < made && is_vertex(files[i]) && count > 1; k++)
            if (same_stem(files[i], pairs[k].fragment))
                mine = &pairs[k];
        if (mine)
            mine->vertex = files[i];
        else if (is_vertex(files[i]) && count > 1) {
            complain(error, LAM_BAD_ARGUMENT,
                     "check: '%s' is a vertex shader without a fragment shader of the same name; use --vertex to name "
                     "one of another name",
                     files[i]);
            return -1;
        }
    }
    return made;
}

char *check_sheet_path(const char *output, const char *fragment)
{
    if (output_is_named(output))
        return strdup(output);
    while (strncmp(fragment, "../", 3) == 0 || strncmp(fragment, "./", 2) == 0)
        fragment += fragment[1] == '/' ? 2 : 3;
    while (*fragment == '/')
        fragment++;
    size_t stem = stem_length(fragment), folder = strlen(output);
    char *path = malloc(folder + stem + sizeof "/.png");
    if (!path)
        return NULL;
    sprintf(path, "%s%s%.*s.png", output, folder && output[folder - 1] == '/' ? "" : "/", (int)stem, fragment);
    for (char *c = path + folder + (output[folder - 1] != '/'); *c; c++)
        *c = *c == '/' ? '-' : *c;
    return path;
}
