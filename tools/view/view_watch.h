// view_watch.h: uses the kernel's inotify to report changed files in the viewer's folder.
#ifndef VIEW_WATCH_H
#define VIEW_WATCH_H

#include "view_files.h"

struct view_watched {
    int number;      // inotify's number for the watch; −1 if the folder is missing
    char *real_path; // the path on this machine
    char *folder;    // the path in the page: "", "/textures"
    char *only;      // the only relevant name in the folder, for the model; NULL means all names
};

struct view_watch {
    int file; // −1 if the kernel has no inotify
    struct view_watched *items;
    int count;
};

void view_watch_start(struct view_watch *watch);
void view_watch_end(struct view_watch *watch);

// Watches the folder of a file. `path` is the file's path in the page. Ignores paths that cannot be watched. A folder
// that is removed or replaced is watched again when it reappears.
void view_watch_add(struct view_watch *watch, const struct view_files *files, const char *path);

// For each file that was written, replaced or removed since the last call, calls `changed` with the file's path in the
// page. The path of a folder, with a '/' at its end, means that any file in the folder may have changed, because the
// folder was replaced or the kernel's queue overflowed.
void view_watch_read(struct view_watch *watch, const struct view_files *files,
                     void (*changed)(void *user, const char *path), void *user);

#endif
