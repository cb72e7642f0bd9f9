// check_find.c: finds the submissions of a class in a folder.
//
// A folder with one fragment shader is one submission, named after the folder. If the folder has a single vertex
// shader, the submission uses it. In other folders, and in the class's folder, each fragment shader is a submission
// named after the file. This submission uses the vertex shader with the same name in the same folder. If there is no
// such shader, but exactly one vertex shader in the folder has no fragment shader of the same name, the submission uses
// this vertex shader. Hidden files and links are ignored. Folders nested more than MAX_DEPTH deep are reported as a
// problem.
#include "check.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "console.h"

enum { MAX_DEPTH = 16 };

struct finding {
    struct check_submission *items;
    int count;
};

static bool add(struct finding *f, char *name, const char *fragment, const char *vertex, const char *problem)
{
    if (name &&
        (f->count & (f->count - 1)) == 0) { // the list is full at each power of two; its capacity is then doubled
        void *more = realloc(f->items, (f->count ? 2 * (size_t)f->count : 1) * sizeof *f->items);
        if (more)
            f->items = more;
        else {
            free(name);
            name = NULL;
        }
    }
    if (!name)
        return false;
    struct check_submission *s = &f->items[f->count++];
    *s = (struct check_submission){{name}, fragment ? strdup(fragment) : NULL, vertex ? strdup(vertex) : NULL, problem};
    return (!fragment || s->fragment) && (!vertex || s->vertex);
}

static char *joined(const char *folder, const char *name)
{
    char *out = NULL;
    size_t length = strlen(folder);
    bool slash = length && folder[length - 1] != '/';
    return asprintf(&out, "%s%s%s", folder, slash ? "/" : "", name) < 0 ? NULL : out;
}

static void free_paths(char **paths, int count)
{
    for (int i = 0; i < count; i++)
        free(paths[i]);
    free(paths);
}

static int by_name(const void *a, const void *b) { return strcmp(*(char *const *)a, *(char *const *)b); }

// Returns the paths of a folder's entries in alphabetical order, without hidden entries. Returns −1 on failure.
static int list_folder(const char *folder, char ***paths, lam_error *error)
{
    DIR *open = opendir(folder);
    int count = 0;
    *paths = NULL;
    if (!open)
        return complain(error, LAM_CANNOT_READ, "%s: %s", folder, strerror(errno)), -1;
    for (struct dirent *entry; (entry = readdir(open));) {
        if (entry->d_name[0] == '.' || strcmp(entry->d_name, "__MACOSX") == 0)
            continue;
        char *path = joined(folder, entry->d_name);
        void *more = count & (count - 1) ? *paths : realloc(*paths, (count ? 2 * (size_t)count : 1) * sizeof **paths);
        if (more)
            *paths = more;
        if (!path || !more) {
            free(path);
            free_paths(*paths, count);
            closedir(open);
            complain(error, LAM_MACHINE, "out of memory");
            return -1;
        }
        (*paths)[count++] = path;
    }
    closedir(open);
    if (count)
        qsort(*paths, (size_t)count, sizeof **paths, by_name);
    return count;
}

// Returns a path relative to the class's folder, without the extension of a shader.
static char *name_of(const char *top, const char *path, bool is_file)
{
    const char *name = path + strlen(top);
    while (*name == '/')
        name++;
    return strndup(name, is_file ? check_stem_length(name) : strlen(name));
}

// Returns the vertex shader for a fragment shader in the same folder, or NULL if there is none.
static const char *vertex_for(const char *fragment, char **fragments, int fragment_count, char **vertices,
                              int vertex_count)
{
    const char *free_one = NULL;
    int free_count = 0;
    for (int i = 0; i < vertex_count; i++) {
        if (check_same_stem(fragment, vertices[i]))
            return vertices[i];
        bool taken = false;
        for (int k = 0; k < fragment_count; k++)
            taken = taken || check_same_stem(fragments[k], vertices[i]);
        if (!taken) {
            free_one = vertices[i];
            free_count++;
        }
    }
    return free_count == 1 ? free_one : NULL;
}

static bool add_files(struct finding *f, const char *top, const char *folder, char **fragments, int fragment_count,
                      char **vertices, int vertex_count)
{
    bool whole = strcmp(top, folder) != 0 && fragment_count == 1 && vertex_count <= 1, ok = true;
    for (int i = 0; ok && i < fragment_count; i++) {
        const char *vertex = whole ? (vertex_count ? vertices[0] : NULL)
                                   : vertex_for(fragments[i], fragments, fragment_count, vertices, vertex_count);
        ok = add(f, whole ? name_of(top, folder, false) : name_of(top, fragments[i], true), fragments[i], vertex, NULL);
    }
    for (int i = 0; ok && i < vertex_count && !fragment_count; i++)
        ok = add(f, name_of(top, vertices[i], true), NULL, vertices[i], "there is no fragment shader beside it");
    return ok;
}

static bool search(struct finding *f, const char *top, const char *folder, int depth, lam_error *error)
{
    char **paths;
    int count = list_folder(folder, &paths, error), fragment_count = 0, vertex_count = 0;
    if (count < 0)
        return false;
    char **fragments = calloc((size_t)count + 1, sizeof *fragments),
         **vertices = calloc((size_t)count + 1, sizeof *vertices);
    bool ok = fragments && vertices;
    for (int i = 0; ok && i < count; i++) {
        struct stat found;
        if (lstat(paths[i], &found) != 0 || !S_ISREG(found.st_mode))
            continue;
        if (check_is_vertex(paths[i]))
            vertices[vertex_count++] = paths[i];
        else if (check_is_fragment(paths[i]))
            fragments[fragment_count++] = paths[i];
        else if (strlen(paths[i]) > 5 && strcasecmp(paths[i] + strlen(paths[i]) - 5, ".glsl") == 0)
            ok = add(
                f, name_of(top, paths[i], false), NULL, NULL,
                "left out: the name does not say whether it is a vertex or a fragment shader, such as phong.frag or "
                "fragmentShader.glsl");
    }
    ok = ok && add_files(f, top, folder, fragments, fragment_count, vertices, vertex_count);
    free(fragments);
    free(vertices);
    if (!ok)
        complain(error, LAM_MACHINE, "out of memory");
    for (int i = 0; ok && i < count; i++) {
        struct stat found;
        if (lstat(paths[i], &found) != 0 || !S_ISDIR(found.st_mode))
            continue;
        if (depth == MAX_DEPTH) {
            if (!add(f, name_of(top, paths[i], false), NULL, NULL,
                     "the folder is nested too deeply, so it was not searched"))
                ok = complain(error, LAM_MACHINE, "out of memory");
            continue;
        }
        int before = f->count;
        ok = search(f, top, paths[i], depth + 1, error);
        // A folder without shaders is listed too, so that no submission is overlooked.
        if (ok && depth == 0 && f->count == before &&
            !add(f, name_of(top, paths[i], false), NULL, NULL,
                 "there is no shader in this folder: expected a file that ends in .frag, .fs, .fsh or .fragment, or "
                 "fragmentShader.glsl"))
            ok = complain(error, LAM_MACHINE, "out of memory");
    }
    free_paths(paths, count);
    return ok;
}

static int by_submission(const void *a, const void *b)
{
    return strcmp(((const struct check_submission *)a)->name.text, ((const struct check_submission *)b)->name.text);
}

int check_find(const char *folder, struct check_submission **submissions, lam_error *error)
{
    struct finding f = {0};
    bool ok = search(&f, folder, folder, 0, error);
    if (ok && !f.count)
        ok = complain(error, LAM_BAD_ARGUMENT,
                      "%s: there is no submission in this folder: expected fragment shaders (.frag, .fs, .fsh or "
                      ".fragment), or folders with them",
                      folder);
    if (!ok) {
        check_free_submissions(f.items, f.count);
        return -1;
    }
    qsort(f.items, (size_t)f.count, sizeof *f.items, by_submission);
    *submissions = f.items;
    return f.count;
}
