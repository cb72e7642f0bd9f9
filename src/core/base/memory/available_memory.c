// available_memory.c: the memory and the processors available to this process: the machine's or the smallest limit,
// whichever is less.
//
// Control groups limit memory in a container or under a batch system. The limit is in the file memory.max (cgroup v2)
// or memory.limit_in_bytes (v1), and applies to a group and its descendants. In a container, /proc/self/cgroup may
// contain a path on the host that does not exist in the container. The code then reads only the files of the parent
// groups in this path, up to the root of the mount. https://docs.kernel.org/admin-guide/cgroup-v2.html,
// .../cgroup-v1/memory.html
#include "available_memory.h"

#include "pages.h"

#include <lambent/base.h>

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if defined(__wasm__)

uint64_t memory_of_groups(const char *root)
{
    (void)root;
    return UINT64_MAX;
}

uint64_t processors_of_groups(const char *root) { return memory_of_groups(root); }

uint64_t lam_memory_available(void) { return UINT64_MAX; }

#else

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

enum { PATH_BYTES = 4096 };

// Reads the first bytes of a file as text. Returns false if the file cannot be read.
static bool read_head(const char *path, char *text, size_t size)
{
    int file = open(path, O_RDONLY | O_CLOEXEC);
    size_t used = 0;
    if (file < 0)
        return false;
    for (ssize_t got = 1; got > 0 && used < size - 1; used += got > 0 ? (size_t)got : 0)
        got = read(file, text + used, size - 1 - used);
    close(file);
    text[used] = 0;
    return used > 0;
}

static uint64_t smaller(uint64_t a, uint64_t b) { return a < b ? a : b; }

// Reads a limit: a number of bytes, or the microseconds of processor time in a period and the length of the period.
static uint64_t limit_of_text(const char *text)
{
    char *end;
    if (*text < '0' || *text > '9')
        return UINT64_MAX;
    uint64_t number = strtoull(text, &end, 10), period = *end == ' ' ? strtoull(end, NULL, 10) : 0;
    return period ? number / period + (number % period > 0) : number;
}

// Returns the smallest limit of a group and its parents. `path` is the path of the group below `mount`. "max" means no
// limit.
static uint64_t limit_of_group(const char *root, const char *mount, const char *path, const char *file)
{
    char name[PATH_BYTES + 200], text[64];
    uint64_t limit = UINT64_MAX;
    size_t length = strlen(path);
    for (;;) {
        while (length > 0 && path[length - 1] == '/')
            length--;
        snprintf(name, sizeof name, "%s%s%.*s/%s", root, mount, (int)length, path, file);
        if (read_head(name, text, sizeof text))
            limit = smaller(limit, limit_of_text(text));
        if (length == 0)
            return limit;
        while (length > 0 && path[length - 1] != '/')
            length--;
    }
}

// Returns whether a comma-separated list of controllers contains "memory".
static bool names_memory(const char *list, size_t length)
{
    static const char word[] = "memory";
    for (const char *at = list; (size_t)(at - list) + sizeof word - 1 <= length; at++)
        if (memcmp(at, word, sizeof word - 1) == 0 && (at == list || at[-1] == ',') &&
            ((size_t)(at - list) + sizeof word - 1 == length || at[sizeof word - 1] == ','))
            return true;
    return false;
}

// Returns the limit for the group in a line of /proc/self/cgroup. The line has the form "number:controllers:path"; for
// cgroup v2, the number is 0 and there are no controllers.
static uint64_t limit_of_line(const char *root, char *line, bool processors)
{
    char *list = strchr(line, ':'), *path = list ? strchr(list + 1, ':') : NULL;
    if (!path)
        return UINT64_MAX;
    list++;
    if (path == list)
        return smaller(limit_of_group(root, "/sys/fs/cgroup", path + 1, processors ? "cpu.max" : "memory.max"),
                       limit_of_group(root, "/sys/fs/cgroup/unified", path + 1, processors ? "cpu.max" : "memory.max"));
    return !processors && names_memory(list, (size_t)(path - list))
               ? limit_of_group(root, "/sys/fs/cgroup/memory", path + 1, "memory.limit_in_bytes")
               : UINT64_MAX;
}

static uint64_t limit_of_groups(const char *root, bool processors)
{
    char name[PATH_BYTES], text[PATH_BYTES];
    uint64_t limit = UINT64_MAX;
    snprintf(name, sizeof name, "%s/proc/self/cgroup", root);
    if (!read_head(name, text, sizeof text))
        return UINT64_MAX;
    for (char *line = text, *next; line && *line; line = next) {
        next = strchr(line, '\n');
        if (next)
            *next++ = 0;
        limit = smaller(limit, limit_of_line(root, line, processors));
    }
    return limit;
}

uint64_t memory_of_groups(const char *root) { return limit_of_groups(root, false); }
uint64_t processors_of_groups(const char *root) { return limit_of_groups(root, true); }

static uint64_t limit_of_process(int resource)
{
    struct rlimit limit;
    return getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY ? limit.rlim_cur : UINT64_MAX;
}

uint64_t lam_memory_available(void)
{
    size_t machine = pages_of_machine();
    uint64_t bytes = machine == SIZE_MAX ? UINT64_MAX : machine;
    bytes = smaller(bytes, memory_of_groups(""));
    return smaller(bytes, smaller(limit_of_process(RLIMIT_AS), limit_of_process(RLIMIT_DATA)));
}

#endif
