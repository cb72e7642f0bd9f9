// job_roots.c: restricts the files of jobs to the folders of --allow-path.
//
// The check in this file produces the error message. Files are then opened below the handles of these folders
// (lam_path_open), so it does not matter if somebody exchanges folders after the check.
#include "batch_job.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/stat.h>

#include <lambent/path.h>

#include "console.h"
#include "file_io.h"

bool job_roots_check(const struct options *options, lam_error *error)
{
    const struct texts *given = &options->limits.allow_paths;
    for (int i = 0; i < given->count; i++)
        if (!path_is_folder(given->items[i]))
            return complain(error, LAM_BAD_ARGUMENT,
                            "option '--allow-path': found '%.200s', with --jobs expected a folder", given->items[i]);
    return true;
}

bool job_roots_have(const struct options *options, const char *path, bool writes, lam_error *error)
{
    const struct texts *given = &options->limits.allow_paths;
    lam_code code = writes ? LAM_CANNOT_WRITE : LAM_CANNOT_READ;
    if (!given->count)
        return complain(error, code, "%.400s: jobs may not use files; --allow-path DIR allows files below DIR", path);
    struct stat about;
    bool below = false, found = lam_path_stat(path, &about) == 0, link = !found && (errno == EMLINK || errno == EXDEV);
    for (int i = 0; i < given->count; i++)
        below |= lam_path_is_below(path, given->items[i]);
    if (!below || link)
        return complain(error, code, "%.400s: %sis outside the folders that jobs may access (--allow-path)", path,
                        below ? "a link is in the way, and what it leads to " : "");
    return !writes || !found || S_ISREG(about.st_mode) ||
           complain(error, code, "%.400s: cannot write: is not a regular file", path);
}
