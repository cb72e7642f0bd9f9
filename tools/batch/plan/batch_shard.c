// batch_shard.c: selects this process's models if several processes share the work.
//
// A model's shard depends only on its name, so shards need no communication, and adding a model does not move other
// models to another shard. The program reads environment variables only with --shard auto, and accepts only unambiguous
// variables: a wrong guess would silently skip models.
#include "batch_shard.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console.h"
#include "xxh64.h"

enum { SHARDS_MAX = 1000000 };

// --- numbers

// Parses a number without a sign. Returns false if the text is not such a number, or if the number is above `max`.
static bool parse_number(const char *text, size_t length, long max, long *number)
{
    *number = 0;
    for (size_t i = 0; i < length; i++) {
        if (text[i] < '0' || text[i] > '9')
            return false;
        *number = 10 * *number + text[i] - '0';
        if (*number > max)
            return false;
    }
    return length > 0;
}

// Reads an environment variable that must be a number.
static bool read_variable(const char *name, long *number, lam_error *error)
{
    const char *text = getenv(name);
    if (!text)
        return complain(error, LAM_BAD_ARGUMENT, "option '--shard': %s is not set", name);
    return parse_number(text, strlen(text), 2000000000, number) ||
           complain(error, LAM_BAD_ARGUMENT, "option '--shard': expected a number in %s, found '%.40s'", name, text);
}

// --- cluster environments

static const char task_id[] = "SLURM_ARRAY_TASK_ID", completion[] = "JOB_COMPLETION_INDEX",
                  rank[] = "OMPI_COMM_WORLD_RANK";

// Selects shard `index`, counted from 0, of `count` shards.
static bool set_index(struct batch_shard *shard, const char *variable, long index, long count, lam_error *error)
{
    if (index >= count)
        return complain(error, LAM_BAD_ARGUMENT,
                        "option '--shard': %s is %ld, expected 0 to %ld: of %ld shards the first has the index 0",
                        variable, index, count - 1, count);
    *shard = (struct batch_shard){(int)index + 1, (int)count};
    return true;
}

// Accepts only a complete job array, whose indices begin at 0 or 1 and have no gaps. If only some tasks are submitted
// again (--array=17,23), the array reports fewer tasks. This smaller number would assign the models to different
// shards.
static bool slurm_array(struct batch_shard *shard, lam_error *error)
{
    long id, first, last, count, step;
    if (!read_variable(task_id, &id, error) || !read_variable("SLURM_ARRAY_TASK_MIN", &first, error) ||
        !read_variable("SLURM_ARRAY_TASK_MAX", &last, error) || !read_variable("SLURM_ARRAY_TASK_COUNT", &count, error))
        return false;
    if (!getenv("SLURM_ARRAY_TASK_STEP"))
        step = 1;
    else if (!read_variable("SLURM_ARRAY_TASK_STEP", &step, error))
        return false;
    bool whole = first <= 1 && step > 0 && count > 0 && count <= SHARDS_MAX && (last - first) / step + 1 == count &&
                 (last - first) % step == 0 && id >= first && id <= last && (id - first) % step == 0;
    if (!whole)
        return complain(
            error, LAM_BAD_ARGUMENT,
            "option '--shard': the job array has %ld tasks from %ld to %ld, which is not all tasks from 0 or 1 on; "
            "name the number of shards, --shard auto/N with --array=0-(N-1)",
            count, first, last);
    return set_index(shard, task_id, (id - first) / step, count, error);
}

// If `count` is 0, the environment must contain the number of shards.
static bool from_environment(struct batch_shard *shard, long count, lam_error *error)
{
    const char *const names[] = {task_id, completion, rank}, *found = NULL;
    for (int i = 0; i < 3; i++) {
        if (!getenv(names[i]))
            continue;
        if (found)
            return complain(error, LAM_BAD_ARGUMENT,
                            "option '--shard auto': both %s and %s are set; name the shard, --shard K/N", found,
                            names[i]);
        found = names[i];
    }
    if (!found)
        return complain(error, LAM_BAD_ARGUMENT,
                        "option '--shard auto': none of %s, %s and %s is set; name the shard, --shard K/N", task_id,
                        completion, rank);
    long index, ranks;
    if (found == rank) { // mpirun reports the number of ranks; with any other number, some models would not be drawn
        if (!read_variable(rank, &index, error) || !read_variable("OMPI_COMM_WORLD_SIZE", &ranks, error))
            return false;
        if (ranks < 1 || ranks > SHARDS_MAX || (count && ranks != count))
            return complain(error, LAM_BAD_ARGUMENT, "option '--shard auto/%ld': OMPI_COMM_WORLD_SIZE is %ld", count,
                            ranks);
        return set_index(shard, rank, index, ranks, error);
    }
    if (count)
        return read_variable(found, &index, error) && set_index(shard, found, index, count, error);
    if (found == completion)
        return complain(
            error, LAM_BAD_ARGUMENT,
            "option '--shard auto': Kubernetes does not report the number of completions; give this number N, "
            "--shard auto/N");
    return slurm_array(shard, error);
}

bool batch_shard_of(const char *text, struct batch_shard *shard, lam_error *error)
{
    const char *slash = strchr(text, '/');
    size_t length = slash ? (size_t)(slash - text) : strlen(text);
    bool is_auto = length == 4 && memcmp(text, "auto", 4) == 0;
    long number = 0, count = 0;
    bool ok = slash ? parse_number(slash + 1, strlen(slash + 1), SHARDS_MAX, &count) && count > 0 : is_auto;
    ok = ok && (is_auto || parse_number(text, length, SHARDS_MAX, &number));
    if (!ok)
        return complain(error, LAM_BAD_ARGUMENT,
                        "option '--shard': expected K/N, auto or auto/N, N at most %d, such as 1/4, found '%.60s'",
                        SHARDS_MAX, text);
    if (is_auto)
        return from_environment(shard, count, error);
    if (number < 1 || number > count)
        return complain(error, LAM_BAD_ARGUMENT, "option '--shard': expected 1/%ld to %ld/%ld, found '%.60s'", count,
                        count, count, text);
    *shard = (struct batch_shard){(int)number, (int)count};
    return true;
}

// --- names

// Returns the path relative to a folder, or the whole path if the path is not below the folder.
static const char *below(const char *path, const char *root)
{
    size_t length = root ? strlen(root) : 0;
    return length && strncmp(path, root, length) == 0 && (root[length - 1] == '/' || path[length] == '/')
               ? path + length
               : path;
}

char *batch_shard_name(const char *path, const char *root)
{
    const char *at = below(path, root);
    char *name = malloc(strlen(at) + 1), *end = name;
    while (name && *at) {
        size_t length = strcspn(at, "/");
        char *slash = end;
        while (slash > name && slash[-1] != '/')
            slash--;
        bool up = length == 2 && at[0] == '.' && at[1] == '.';
        if (up && end > name && strncmp(slash, "..", (size_t)(end - slash)) != 0) {
            end = slash > name ? slash - 1 : name; // removes the folder before the ".."
        } else if (length && !(length == 1 && *at == '.')) {
            if (end > name)
                *end++ = '/';
            memmove(end, at, length);
            end += length;
        }
        at += length + (at[length] == '/');
    }
    if (name)
        *end = 0;
    return name;
}

int batch_shard_of_name(const char *name, int count)
{
    struct xxh64 hash;
    xxh64_start(&hash);
    xxh64_add(&hash, name, strlen(name));
    return (int)(xxh64_end(&hash) % (uint64_t)count) + 1;
}

// Returns the position of a path's extension, such as ".jsonl", or the end of the path if there is no extension.
static const char *ending_of(const char *path)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path, *dot = strrchr(name, '.');
    return dot && dot != name ? dot : path + strlen(path);
}

char *batch_shard_path(const char *path, const struct batch_shard *shard)
{
    const char *ending = ending_of(path);
    char *out = NULL;
    int digits = snprintf(NULL, 0, "%d", shard->count);
    return asprintf(&out, "%.*s-%0*d-of-%d%s", (int)(ending - path), path, digits, shard->number, shard->count,
                    ending) < 0
               ? NULL
               : out;
}

int batch_shard_count_of(const char *path)
{
    const char *end = ending_of(path), *at = end;
    long count, number;
    while (at > path && at[-1] >= '0' && at[-1] <= '9')
        at--;
    if (!parse_number(at, (size_t)(end - at), SHARDS_MAX, &count) || at - path < 4 || memcmp(at - 4, "-of-", 4) != 0)
        return 0;
    const char *last = at - 4, *first = last;
    while (first > path && first[-1] >= '0' && first[-1] <= '9')
        first--;
    bool ok =
        first > path && first[-1] == '-' && parse_number(first, (size_t)(last - first), count, &number) && number > 0;
    return ok ? (int)count : 0;
}

bool batch_shard_check_folder(const char *path, const struct batch_shard *shard, lam_error *error)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path, *ending = ending_of(path);
    size_t stem = (size_t)(ending - name);
    char *folder = slash ? strndup(path, (size_t)(slash - path) + 1) : strdup(".");
    if (!folder)
        return complain(error, LAM_MACHINE, "out of memory");
    DIR *list = opendir(folder); // a folder that does not exist yet contains no journals
    bool ok = true;
    for (struct dirent *entry; ok && list && (entry = readdir(list));) {
        const char *found = entry->d_name;
        bool ours = strncmp(found, name, stem) == 0 && found[stem] == '-' && strcmp(ending_of(found), ending) == 0;
        int count = ours ? batch_shard_count_of(found) : 0;
        if (count && count != shard->count)
            ok = complain(error, LAM_BAD_ARGUMENT,
                          "option '--shard': %.200s%.200s belongs to a run with %d shards, and this run has %d; "
                          "continue with %d, or move the journals away",
                          slash ? folder : "", found, count, shard->count, count);
    }
    if (list)
        closedir(list);
    free(folder);
    return ok;
}
