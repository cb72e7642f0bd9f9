// view_watch.h: which files of the viewer's folder have changed, as the kernel reports it (inotify).
#ifndef VIEW_WATCH_H
#define VIEW_WATCH_H

#include "view_files.h"

struct view_watched {
    int number;   // the kernel's; −1: the folder has gone, and may come back
    char *place;  // on this machine
    char *folder; // a path of the page: "", "/textures"
    char *only;   // the one name that counts there, which means the model; NULL: all do
};

struct view_watch {
    int file; // −1: the kernel watches none
    struct view_watched *items;
    int count;
};

void view_watch_start(struct view_watch *watch);
void view_watch_end(struct view_watch *watch);

// Watches the folder of a file, by its path in the page. Paths that cannot be watched are skipped. A folder that is
// removed or replaced is watched again once one of its name exists.
void view_watch_add(struct view_watch *watch, const struct view_files *files, const char *path);

// Calls `changed` for each file that was written, replaced or removed since the last call, by its path in the page; for the folder,
// with "/" at its end, where any file in it may have changed: it was replaced, or there were more changes than the kernel keeps.
void view_watch_read(struct view_watch *watch, const struct view_files *files,
                     void (*changed)(void *user, const char *path), void *user);

#endif
