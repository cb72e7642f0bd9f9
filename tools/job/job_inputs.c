// job_inputs.c: prevents outputs from replacing the files of the model.
#include "job_inputs.h"

#include <string.h>
#include <sys/stat.h>

#include "console.h"

bool job_is_same_file(const char *a, const char *b)
{
    struct stat one, other;
    return stat(a, &one) == 0 && stat(b, &other) == 0 && one.st_dev == other.st_dev && one.st_ino == other.st_ino;
}

bool job_check_inputs(const lam_scene *scene, const char *path, bool own, lam_error *error)
{
    bool may = own && strcmp(lam_scene_format(scene), "scene") == 0;
    for (int i = may ? 1 : 0; lam_scene_file(scene, i); i++)
        if (job_is_same_file(path, lam_scene_file(scene, i)))
            return complain(error, LAM_BAD_ARGUMENT,
                            "%.300s: the output would replace a file that the model uses; name another output", path);
    return true;
}
