// view_events.h: informs pages about changed files with server-sent events
// (https://html.spec.whatwg.org/#server-sent-events).
#ifndef VIEW_EVENTS_H
#define VIEW_EVENTS_H

#include "http.h"
#include "view_files.h"

struct view;
struct view_connection;
struct view_listener;

// Answers a request that waits for changes.
enum MHD_Result view_events_answer(struct view_connection *connection);

// Informs all listeners that the file with this path in the page has changed.
void view_events_changed(struct view *view, const char *path);

// Sends a comment at intervals, since only sending reveals that a page was closed.
void view_events_keep(struct view *view);

// Sends a comment to one listener.
void view_events_wake(struct view_listener *listener);

// Removes a listener whose connection has ended.
void view_events_forget(struct view *view, struct view_listener *listener);

// Ends all listeners.
void view_events_end(struct view *view);

// --- uses the kernel's inotify to report changed files in the viewer's folder.

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
