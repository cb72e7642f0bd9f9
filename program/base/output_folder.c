// output_folder.c: creates the folder to which a file is written.
#include "output_folder.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <lambent/path.h>

#include "console.h"

char *output_folder_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    while (slash > path && slash[-1] == '/')
        slash--;
    return slash ? strndup(path, slash == path ? 1 : (size_t)(slash - path)) : strdup(".");
}

bool output_make_folder(const char *path, lam_error *error)
{
    char *folder = output_folder_of(path);
    if (!folder)
        return complain(error, LAM_MACHINE, "out of memory");
    bool ok = true;
    for (char *end = folder; ok && *end;) { // starts with the topmost folder
        end += 1 + strcspn(end + 1, "/");
        char kept = *end;
        struct stat found;
        const char *name;
        *end = 0;
        bool missing = lam_path_stat(folder, &found) != 0;
        int parent = missing ? lam_path_parent(folder, &name) : -1;
        if (missing && (parent == -1 || mkdirat(parent, name, 0777) != 0) && errno != EEXIST)
            ok =
                complain(error, LAM_CANNOT_WRITE, "%s: cannot make the folder '%s': %s", path, folder, strerror(errno));
        lam_path_close(parent);
        *end = kept;
    }
    free(folder);
    return ok;
}
