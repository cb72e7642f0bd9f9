// batch_sources.c: collects the models of `batch`.
#include "batch_shard.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lambent/path.h>

#include "console.h"
#include "file_io.h"
#include "output.h"

static int by_name(const void *a, const void *b) { return strcmp(*(char *const *)a, *(char *const *)b); }

// Lists the names in a folder in alphabetical order. Names that begin with a dot are hidden. The caller frees the names
// and the list, also on failure.
static bool list_names(const char *folder, char ***names, size_t *count, lam_error *error)
{
    DIR *list = lam_path_list(folder);
    bool ok = list || complain(error, LAM_CANNOT_READ, "%s: cannot read the folder: %s", folder, strerror(errno));
    errno = 0;
    for (struct dirent *entry; ok && (entry = readdir(list)); errno = 0) {
        if (entry->d_name[0] == '.')
            continue;
        char **more = realloc(*names, (*count + 1) * sizeof *more);
        *names = more ? more : *names;
        ok = (more && (more[*count] = strdup(entry->d_name))) || complain(error, LAM_MACHINE, "out of memory");
        *count += ok;
    }
    if (ok && errno)
        ok = complain(error, LAM_CANNOT_READ, "%s: cannot read the folder: %s", folder, strerror(errno));
    if (list)
        closedir(list);
    if (*count)
        qsort(*names, *count, sizeof **names, by_name);
    return ok;
}

static bool add_folder(struct batch_plan *plan, const char *folder, const char *root, lam_error *error);

// Adds a model, or the models of a subfolder. Links to folders are not followed, because they may form a cycle. Does not
// open the file, so the errors for pipes and links that lead nowhere appear only when the file is read.
static bool add_entry(struct batch_plan *plan, const char *path, const char *root, lam_error *error)
{
    struct stat own;
    const char *name;
    int parent = lam_path_parent(path, &name);
    bool found = fstatat(parent, name, &own, AT_SYMLINK_NOFOLLOW) == 0;
    lam_path_close(parent);
    if (!found) // ENOENT: somebody has removed it
        return errno == ENOENT || complain(error, LAM_CANNOT_READ, "%s: cannot read: %s", path, strerror(errno));
    if (S_ISDIR(own.st_mode))
        return add_folder(plan, path, root, error);
    return !is_model_name(path) || (S_ISLNK(own.st_mode) && path_is_folder(path)) ||
           batch_plan_add(plan, path, root, error);
}

// Adds the models of a folder and its subfolders, in alphabetical order.
static bool add_folder(struct batch_plan *plan, const char *folder, const char *root, lam_error *error)
{
    char **names = NULL;
    size_t count = 0;
    bool ok = list_names(folder, &names, &count, error), slash = folder[strlen(folder) - 1] != '/';
    for (size_t i = 0; i < count; i++) {
        char *path = NULL;
        if (ok && asprintf(&path, "%s%s%s", folder, slash ? "/" : "", names[i]) < 0) {
            path = NULL;
            ok = complain(error, LAM_MACHINE, "out of memory");
        }
        ok = ok && add_entry(plan, path, root, error);
        free(path);
        free(names[i]);
    }
    free(names);
    return ok;
}

// --- lists

// For --shard-by list: seeks to the first line that begins in this shard's section of the file. Sets `at` to the
// position of this line, and `end` to the position of the next shard's section.
static bool find_part(struct batch_plan *plan, FILE *file, const char *path, uint64_t *at, uint64_t *end,
                      lam_error *error)
{
    struct stat about;
    const struct batch_shard *shard = &plan->shard;
    if (fstat(fileno(file), &about) != 0 || !S_ISREG(about.st_mode))
        return complain(error, LAM_BAD_ARGUMENT, "option '--shard-by list': %s is not a regular file", path);
    if (plan->list_bytes)
        return complain(error, LAM_BAD_ARGUMENT, "option '--shard-by list' divides a single list, and %s is another",
                        path);
    uint64_t size = (uint64_t)about.st_size, count = (uint64_t)shard->count;
    plan->list_bytes = size;
    *at = size * (uint64_t)(shard->number - 1) / count;
    *end = size * (uint64_t)shard->number / count;
    if (!*at)
        return true;
    // Skips the rest of a line that begins earlier, because this line belongs to another shard.
    bool ok = fseeko(file, (off_t)(*at - 1), SEEK_SET) == 0;
    for (int c = 0; ok && c != '\n' && c != EOF;)
        c = getc(file);
    *at = (uint64_t)ftello(file);
    return ok || complain(error, LAM_CANNOT_READ, "%s: cannot read the list: %s", path, strerror(errno));
}

// For --shard-by list: checks that the names of the last two pictures are in ascending order. If the names ascend in
// every shard, no two pictures of the whole list have the same name, even though no shard reads the whole list.
static bool check_order(const struct batch_plan *plan, const char *path, lam_error *error)
{
    char *before = batch_plan_output(plan, plan->count - 2, 0), *now = batch_plan_output(plan, plan->count - 1, 0);
    const char *model = plan->models[plan->count - 1].path;
    int order = before && now ? strcmp(before, now) : -1;
    bool ok = before && now ? true : complain(error, LAM_MACHINE, "out of memory");
    if (order == 0)
        ok = batch_same_output(plan->models[plan->count - 2].path, model, now, error);
    else if (order > 0)
        ok = complain(error, LAM_BAD_ARGUMENT,
                      "option '--shard-by list': %.100s is not in the order of the pictures (LC_ALL=C sort): '%.120s' "
                      "comes after '%.120s'",
                      path, now, before);
    free(before);
    free(now);
    return ok;
}

bool batch_add_list(struct batch_plan *plan, const char *path, lam_error *error)
{
    bool standard = strcmp(path, "-") == 0;
    FILE *file = standard ? stdin : fopen(path, "r");
    if (!file)
        return complain(error, LAM_CANNOT_READ, "%s: cannot read the list: %s", path, strerror(errno));
    char *line = NULL;
    size_t capacity = 0;
    ssize_t length;
    size_t first = plan->count;
    uint64_t at = 0, end = UINT64_MAX;
    bool ok = !plan->by_list || find_part(plan, file, path, &at, &end, error), past = false;
    while (ok && !past && (length = getline(&line, &capacity, file)) > 0) {
        bool ours = at < end;
        at += (uint64_t)length;
        while (length && (line[length - 1] == '\n' || line[length - 1] == '\r'))
            line[--length] = 0;
        if (strlen(line) != (size_t)length)
            ok = complain(error, LAM_CANNOT_READ, "%s: expected names, one on each line, found a zero byte", path);
        else if (length) {
            ok = lam_path_hold(line, false, error) && batch_plan_add(plan, line, NULL, error) &&
                 (!plan->by_list || plan->count - first < 2 || check_order(plan, path, error));
            past = !ours;
        }
    }
    if (ok && past) // the next shard's first model, read only to check the order
        batch_plan_drop_last(plan);
    plan->listed += plan->count - first;
    if (ok && !past && !feof(file)) // getline also fails if memory runs out
        ok = complain(error, errno == ENOMEM ? LAM_MACHINE : LAM_CANNOT_READ, "%s: cannot read the list: %s", path,
                      strerror(errno));
    free(line);
    if (!standard)
        fclose(file);
    return ok;
}

bool batch_add_folder(struct batch_plan *plan, const char *folder, lam_error *error)
{
    size_t before = plan->count;
    return add_folder(plan, folder, folder, error) &&
           (plan->count > before ||
            complain(error, LAM_CANNOT_READ, "%s: found no model in the folder or below it", folder));
}

bool batch_add_folder_if_any(struct batch_plan *plan, const char *folder, lam_error *error)
{
    return add_folder(plan, folder, folder, error);
}

bool batch_add_operand(struct batch_plan *plan, const char *operand, lam_error *error)
{
    if (!*operand)
        return complain(error, LAM_BAD_ARGUMENT, "a model's name is empty");
    if (strcmp(operand, "-") == 0 || operand[0] == '@')
        return batch_add_list(plan, operand + (operand[0] == '@'), error);
    if (lam_shape_find(operand) < 0 && path_is_folder(operand))
        return batch_add_folder(plan, operand, error);
    return batch_plan_add(plan, operand, NULL, error);
}
