// check_pairs.c: recognises shader files by their extension, pairs the files of a command line and names their sheets.
#include "check.h"

#include <stdlib.h>
#include <string.h>

#include "console.h"
#include "output.h"

size_t check_stem_length(const char *path)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    const char *dot = strrchr(name, '.');
    if (dot > name && strcmp(dot, ".glsl") == 0)
        for (const char *c = name + 1; c < dot; c++)
            if (*c == '.')
                return (size_t)(c - path);
    return dot > name ? (size_t)(dot - path) : strlen(path);
}

// Returns whether a file is a shader of one stage. The stage is the extension, in any case, or a word in the name of a
// file that ends in .glsl or .txt: vertexShader.glsl, fragment-shader.txt.
static bool is_stage(const char *path, const char *const endings[4])
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    const char *ending = path + check_stem_length(path);
    size_t length = *ending ? strcspn(ending + 1, ".") : 0;
    bool named = strcasecmp(ending, ".glsl") == 0 || strcasecmp(ending, ".txt") == 0;
    for (size_t i = 0; i < 4; i++)
        if ((length == strlen(endings[i]) && strncasecmp(ending + 1, endings[i], length) == 0) ||
            (named && i == 0 && strcasestr(name, endings[i])))
            return true;
    return false;
}

bool check_is_vertex(const char *path) { return is_stage(path, (const char *const[]){"vert", "vs", "vsh", "vertex"}); }

bool check_is_fragment(const char *path)
{
    return is_stage(path, (const char *const[]){"frag", "fs", "fsh", "fragment"}) && !check_is_vertex(path);
}

bool check_same_stem(const char *a, const char *b)
{
    size_t length = check_stem_length(a);
    return length == check_stem_length(b) && strncmp(a, b, length) == 0;
}

void check_free_submissions(struct check_submission *submissions, int count)
{
    for (int i = 0; submissions && i < count; i++) {
        free((void *)(uintptr_t)submissions[i].name.text);
        free(submissions[i].fragment);
        free(submissions[i].vertex);
    }
    free(submissions);
}

static bool fill(struct check_submission *s, const char *fragment, const char *vertex)
{
    *s = (struct check_submission){{strdup(fragment)}, strdup(fragment), vertex ? strdup(vertex) : NULL, NULL};
    return s->name.text && s->fragment && (s->vertex || !vertex);
}

int check_pair(int count, char **files, const char *vertex, struct check_submission **submissions, lam_error *error)
{
    int made = 0;
    struct check_submission *out = calloc((size_t)count + 1, sizeof *out);
    bool ok = out != NULL;
    for (int i = 0; ok && i < count; i++)
        if (!check_is_vertex(files[i]) || count == 1)
            ok = fill(&out[made++], files[i], vertex);
    for (int i = 0; ok && i < count; i++) {
        struct check_submission *mine = NULL;
        for (int k = 0; k < made && check_is_vertex(files[i]) && count > 1; k++)
            if (check_same_stem(files[i], out[k].fragment))
                mine = &out[k];
        if (mine) {
            free(mine->vertex);
            ok = (mine->vertex = strdup(files[i])) != NULL;
        } else if (check_is_vertex(files[i]) && count > 1) {
            complain(error, LAM_BAD_ARGUMENT,
                     "check: '%s' is a vertex shader without a fragment shader of the same name; use --vertex to name "
                     "one of another name",
                     files[i]);
            check_free_submissions(out, made);
            return -1;
        }
    }
    if (!ok) {
        check_free_submissions(out, made);
        complain(error, LAM_MACHINE, "out of memory");
        return -1;
    }
    *submissions = out;
    return made;
}

// Converts "ann/phong.frag" to "ann-phong".
static char *flat_name(const struct check_submission *s, bool in_class)
{
    const char *name = s->name.text;
    while (strncmp(name, "../", 3) == 0 || strncmp(name, "./", 2) == 0)
        name += name[1] == '/' ? 2 : 3;
    while (*name == '/')
        name++;
    char *out = strndup(name, in_class ? strlen(name) : check_stem_length(name));
    for (char *c = out; c && *c; c++)
        *c = *c == '/' ? '-' : *c;
    return out;
}

char *check_sheet_path(const char *output, const struct check_submission *submissions, int index, bool in_class)
{
    if (!in_class && output_is_named(output))
        return strdup(output);
    char *path = NULL, *name = flat_name(&submissions[index], in_class);
    int same = 1; // of the two names "a-b" and "a/b", the second becomes "a-b-2"
    for (int i = 0; name && i < index; i++) {
        char *other = flat_name(&submissions[i], in_class);
        same += other && strcmp(other, name) == 0;
        free(other);
    }
    bool slash = *output && output[strlen(output) - 1] != '/';
    char number[16] = "";
    if (same > 1)
        snprintf(number, sizeof number, "-%d", same);
    if (!name || asprintf(&path, "%s%s%s%s.png", output, slash ? "/" : "", name, number) < 0)
        path = NULL;
    free(name);
    return path;
}
