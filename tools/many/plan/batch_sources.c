// batch_sources.c: collects the models of `batch`.
#include "batch_sources.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "console.h"
#include "file_io.h"
#include "output.h"

static int by_name(const struct dirent **a, const struct dirent **b) { return strcmp((*a)->d_name, (*b)->d_name); }

// Names that begin with a dot are hidden.
static int is_visible(const struct dirent *entry) { return entry->d_name[0] != '.'; }

// Returns whether a link leads outside the given folder and outside all folders of --allow-path. Returns false for a
// broken link.
static bool leads_out(const struct batch_plan *plan, const char *path, const char *root)
{
    const struct texts *allowed = &plan->options->limits.allow_paths;
    char *real = realpath(path, NULL);
    bool out = real && !path_is_below(real, root, false);
    for (int i = 0; i < allowed->count && out; i++)
        out = !path_is_below(real, allowed->items[i], false);
    free(real);
    return out;
}

// Adds a file without opening it, so the errors for pipes and broken links appear only when the file is read.
static bool add_file(struct batch_plan *plan, const char *path, const char *root, bool is_link, lam_error *error)
{
    if (!is_model_name(path) || (is_link && path_is_folder(path)))
        return true;
    if (!batch_plan_add(plan, path, root, error))
        return false;
    plan->models[plan->count - 1].leads_out = is_link && leads_out(plan, path, root);
    return true;
}

// Adds the models of a folder and its subfolders, in alphabetical order. Links to folders are not followed, because
// they may form a cycle.
static bool add_folder(struct batch_plan *plan, const char *folder, const char *root, lam_error *error)
{
    struct dirent **entries;
    int count = scandir(folder, &entries, is_visible, by_name);
    if (count < 0)
        return complain(error, LAM_CANNOT_READ, "%s: cannot read the folder: %s", folder, strerror(errno));
    bool ok = true;
    for (int i = 0; i < count; i++) {
        char *path = NULL;
        struct stat own;
        bool slash = folder[strlen(folder) - 1] != '/';
        if (ok && asprintf(&path, "%s%s%s", folder, slash ? "/" : "", entries[i]->d_name) < 0) {
            path = NULL;
            ok = complain(error, LAM_MACHINE, "out of memory");
        }
        if (ok && lstat(path, &own) == 0) {
            if (S_ISDIR(own.st_mode))
                ok = add_folder(plan, path, root, error);
            else
                ok = add_file(plan, path, root, S_ISLNK(own.st_mode), error);
        }
        free(path);
        free(entries[i]);
    }
    free(entries);
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
            ok = batch_plan_add(plan, line, NULL, error) &&
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
