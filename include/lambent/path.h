// lambent/path.h: folders that a process holds open, so that nobody can exchange them.
//
// A program that reads untrusted folders holds each folder that its user names, once, before it starts threads. From
// then on, the library opens every file whose path begins with the path of a held folder below this folder's handle. It
// resolves the path by text (".." removes the component before it), and the kernel follows no link on the way. A path
// that contains a link is resolved again; the file must then be below the same folder, or below one that is held with
// `links_may_lead_here`. Renaming folders and replacing them by links therefore never leads out of the held folders.
// Paths that begin with no held folder are opened as usual. Without openat2 (before Linux 5.6), the library opens
// component by component. On Windows and WebAssembly, it checks the resolved path and then opens it.
//
// This table is the one state that the library keeps for the whole process. Calls that change it must not run at the
// same time as other calls of the library. Functions that return int fail like open(2): they return −1 and set errno,
// to EMLINK if a link is in the way, and to EXDEV if it leads out of the held folder.
#ifndef LAMBENT_PATH_H
#define LAMBENT_PATH_H

#include <dirent.h>
#include <sys/stat.h>

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

// Holds a folder, the folder of a file, or the nearest existing folder above a path that does not exist. If `path` is a
// link to a file, the link is resolved once, now. The folders stay open until the process ends. Fails with LAM_MACHINE.
LAM_API bool lam_path_hold(const char *path, bool links_may_lead_here, lam_error *error);

// From now on, no link below a held folder is followed.
LAM_API void lam_path_refuse_links(void);

// Returns whether the text of `path` is the folder or below it. Both paths begin with a held folder, or the result is
// false. The file need not exist.
LAM_API bool lam_path_is_below(const char *path, const char *folder);

// Returns the handle of the held folder that contains a path, or −1 if there is none. The table owns it.
LAM_API int lam_path_held(const char *path);

// Like open(2) with the mode 0666. The caller closes the file.
LAM_API int lam_path_open(const char *path, int flags);

// Like stat(2).
LAM_API int lam_path_stat(const char *path, struct stat *about);

// Opens the folder that contains the file at `path`, and sets *name to the file's name in this folder, for calls such
// as unlinkat(2). The name is part of `path`, or of the table. The caller closes the folder with lam_path_close. On
// Windows and WebAssembly, the name is the whole path, and the folder is AT_FDCWD.
LAM_API int lam_path_parent(const char *path, const char **name);
LAM_API void lam_path_close(int folder);

// Like opendir(3).
LAM_API DIR *lam_path_list(const char *path);

#ifdef __cplusplus
}
#endif
#endif
