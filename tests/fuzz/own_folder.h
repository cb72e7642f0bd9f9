// file_io.h: a folder of the target's own, for inputs that a reader opens by path. The folder is in memory if the
// system has such a file system, and is removed when the target ends.
#ifndef OWN_FOLDER_H
#define OWN_FOLDER_H

#include <dirent.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { OWN_PATH = 80 };
static char own_folder[OWN_PATH];

static inline void empty_folder(void)
{
    DIR *folder = opendir(own_folder);
    for (struct dirent *entry; folder && (entry = readdir(folder));)
        unlinkat(dirfd(folder), entry->d_name, 0);
    if (folder)
        closedir(folder);
}

static inline void remove_folder(void)
{
    empty_folder();
    rmdir(own_folder);
}

static inline void own_path(char path[OWN_PATH], const char *name)
{
    static int owner; // a process that libFuzzer starts for another job has its own folder
    if (owner != (int)getpid()) {
        owner = (int)getpid();
        snprintf(own_folder, sizeof own_folder, "%s/lambent-fuzz-XXXXXX",
                 access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp");
        if (!mkdtemp(own_folder) || atexit(remove_folder) != 0)
            abort();
    }
    if (snprintf(path, OWN_PATH, "%s/%s", own_folder, name) >= OWN_PATH)
        abort();
}

static inline void write_own(const char *path, const void *data, size_t size)
{
    int file = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    for (size_t at = 0; file >= 0 && at < size;) {
        ssize_t put = write(file, (const char *)data + at, size - at);
        if (put <= 0)
            abort();
        at += (size_t)put;
    }
    if (file < 0 || close(file) != 0)
        abort();
}

#endif
