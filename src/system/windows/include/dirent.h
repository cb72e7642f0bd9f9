// dirent.h: lists the names in a folder, in UTF-8.
#ifndef WINDOWS_DIRENT_H
#define WINDOWS_DIRENT_H

struct dirent {
    char d_name[1024];
};
#include <unistd.h>

DIR *opendir(const char *path);
struct dirent *readdir(DIR *folder);
int closedir(DIR *folder);
#define dirfd(folder) (folder)
int alphasort(const struct dirent **a, const struct dirent **b);
int scandir(const char *path, struct dirent ***list, int filter(const struct dirent *),
            int compare(const struct dirent **, const struct dirent **));

#endif
