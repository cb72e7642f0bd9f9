// view_files.c: opens the files that the viewer serves, below the handle of their folder (lam_path_open).
#include "view_files.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include <lambent/lambent.h>
#include <lambent/path.h>

#include "console.h"
#include "file_io.h"
#include "output.h"

enum { FLAGS = O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK };

bool view_files_start(struct view_files *files, const char *operand, bool is_folder, lam_error *error)
{
    const char *slash = is_folder ? NULL : strrchr(operand, '/');
    *files = (struct view_files){0};
    files->prefix = is_folder ? strdup(operand) : slash ? strndup(operand, (size_t)(slash - operand)) : strdup(".");
    files->model_path = is_folder ? NULL : strdup(operand);
    if (!is_folder && asprintf(&files->model, "/%s", slash ? slash + 1 : operand) < 0)
        files->model = NULL;
    if (!files->prefix || (!is_folder && (!files->model || !files->model_path)))
        return complain(error, LAM_MACHINE, "out of memory");
    for (size_t length = strlen(files->prefix); length > 1 && files->prefix[length - 1] == '/';)
        files->prefix[--length] = 0;
    if (strcmp(files->prefix, "/") == 0)
        *files->prefix = 0; // otherwise a path would begin with two slashes
    return true;
}

void view_files_free(struct view_files *files)
{
    for (int i = 0; i < files->environment_count; i++)
        free(files->environment[i]);
    free(files->environment);
    free(files->prefix);
    free(files->model);
    free(files->model_path);
    *files = (struct view_files){0};
}

// Returns whether a list of extensions, separated by spaces, contains `ending`.
static bool has_ending(const char *endings, const char *ending)
{
    for (size_t length; *endings; endings += length, endings += strspn(endings, " ")) {
        length = strcspn(endings, " ");
        if (strlen(ending) == length && strncasecmp(ending, endings, length) == 0)
            return true;
    }
    return false;
}

// Returns whether the name has the extension of a model or of a file that a model can refer to: a material library, a
// buffer or a picture.
static bool is_served(const char *path)
{
    const char *name = strrchr(path, '/'), *dot = name ? strrchr(name, '.') : NULL;
    if (!dot || strstr(path, "/."))
        return false;
    return is_model_name(path) ||
           has_ending("json mtl bin png jpg jpeg webp bmp tga ppm pgm pbm pnm pfm hdr pic exr", dot + 1);
}

static int open_path(const struct view_files *files, const char *path, int flags)
{
    char *whole = view_files_path(files, path);
    int file = whole ? lam_path_open(whole, flags) : -1;
    free(whole);
    return file;
}

static bool is_regular(int file)
{
    struct stat about;
    return fstat(file, &about) == 0 && S_ISREG(about.st_mode);
}

// Returns the file of --environment for a path in the page, or NULL if there is none.
static const char *environment_of(const struct view_files *files, const char *path)
{
    static const char top[] = "/.environment/";
    if (strncmp(path, top, sizeof top - 1) != 0)
        return NULL;
    char *end;
    long number = strtol(path + sizeof top - 1, &end, 10);
    return *end == '-' && number >= 1 && number <= files->environment_count ? files->environment[number - 1] : NULL;
}

int view_files_open(const struct view_files *files, const char *path)
{
    bool named = environment_of(files, path) || (files->model && strcmp(path, files->model) == 0);
    int file = *path == '/' && (named || (files->prefix && is_served(path))) ? open_path(files, path, FLAGS) : -1;
    if (file >= 0 && !is_regular(file)) {
        close(file);
        file = -1;
    }
    return file;
}

int view_files_open_folder(const struct view_files *files, const char *path)
{
    return files->prefix && *path == '/' && !strstr(path, "/.")
               ? open_path(files, path, O_PATH | O_DIRECTORY | O_CLOEXEC)
               : -1;
}

char *view_files_path(const struct view_files *files, const char *path)
{
    const char *environment = environment_of(files, path);
    char *whole = NULL;
    if (environment)
        return strdup(environment);
    if (files->model && strcmp(path, files->model) == 0)
        return strdup(files->model_path);
    return asprintf(&whole, "%s%s", files->prefix, path) < 0 ? NULL : whole;
}
