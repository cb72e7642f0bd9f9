// sys/stat.h: POSIX file information for Windows: names in UTF-8, times in nanoseconds, and a number that identifies a
// file on its volume.
#ifndef WINDOWS_STAT_H
#define WINDOWS_STAT_H

#include_next <sys/stat.h>
#include <time.h>

#undef stat
#undef fstat
#undef lstat

struct windows_stat {
    unsigned st_dev; // number of the volume
    unsigned long long st_ino;
    unsigned short st_mode;
    unsigned st_nlink;
    unsigned st_uid, st_gid; // 0
    long long st_size;
    struct timespec st_mtim, st_ctim; // times of the last change of the contents and of the file's metadata
};
#define st_mtime st_mtim.tv_sec
#define st_ctime st_ctim.tv_sec

int windows_stat(const char *path, struct windows_stat *about);
int windows_fstat(int file, struct windows_stat *about);
int windows_mkdir(const char *path);

#define stat                                windows_stat
#define fstat                               windows_fstat
#define lstat                               windows_stat // stat and lstat follow links
#define mkdir(path, mode)                   windows_mkdir(path)
#define fstatat(folder, path, about, flags) windows_stat(path, about)
#define mkdirat(folder, path, mode)         windows_mkdir(path)

#define S_ISLNK(mode)  0
#define S_ISSOCK(mode) 0

#endif
