// companion.h: opens the files that a model or a scene file refers to. Opens them in the folder of the model or scene
// file, or through the caller's function.
#ifndef COMPANION_H
#define COMPANION_H

#include "importer.h"

// The state of import_source.open and import_source.open_of_scene. The state defines where these functions look for
// files.
struct file_list;
struct companions {
    // the folder of the model or scene file, with its '/' ("" is the current folder); NULL if that file is not on disk
    const char *folder;
    const char *inside; // prefix of names for `open`: the folder of a scene's model, with its '/'; otherwise ""
    lam_open_fn *open;  // the caller's function; NULL if files are opened in `folder`
    lam_release_fn *release;
    void *user;
    struct file_list *files; // receives every path that is tried; may be NULL
    int searches;            // the number of names that companion_find has looked for without regard to case
};

// An opened file. The caller releases `file`.
struct companion {
    struct file_bytes file;
    const char *path;  // the file's path; NULL if it came from the caller's function
    const char *name;  // the name under which the file was opened, relative to the model's folder
    const char *real;  // identifies the file: its path after following links, or its name for the caller's function
    const char *shown; // the file's name in messages: the folder, then the name shortened by shown_name
};

// Returns the byte encoded by '%' and two hexadecimal digits, or −1 if the digits are invalid.
int companion_escaped(const char *at);
// Replaces each %XX with the byte that it encodes, and copies all other characters. `out` must be as large as `uri`, or
// `uri` itself.
void companion_unescape(const char *uri, char *out);

// Implements import_source.open. companion_name first confines the name to the model's folder. After following links,
// the file must be in the model's folder or below, or in one of params->allowed_paths. The strings of `out` are in
// `arena`.
bool companion_open(const struct import_source *source, const char *name, struct arena *arena, struct companion *out,
                    lam_error *error);

// Opens a file, such as a texture, that may have moved since the model was written. Tries, in this order: the name; the
// name in the folder `beside` (relative to the model's folder, with its '/', or ""); the name's last component in the
// model's folder, and in `beside`; the same names without regard to case (A to Z), if folders can be listed; all of these with %XX
// decoded. Quotes around the name are ignored. Adds a note to `scene` (may be NULL) if the spelling differs. Fails if two
// files differ only in case; otherwise, if no file is found, with the error for the name itself.
bool companion_find(const struct import_source *source, struct lam_scene *scene, const char *name, const char *beside,
                    struct arena *arena, struct companion *out, lam_error *error);

// Implements import_source.open_of_scene. After following links and "..", the file must be in the scene file's folder
// or below, or in one of params->allowed_paths, unless params->models_anywhere is set. Otherwise the call fails.
bool companion_open_of_scene(const struct import_source *source, const char *name, struct arena *arena,
                             struct companion *out, lam_error *error);

// Initialises the companions of a model that a scene file refers to: open_of_scene must have opened `model` under the
// name `name`. The strings are in `arena`. Returns false if memory runs out.
bool companions_of_model(const struct import_source *scene, const char *name, const struct companion *model,
                         struct arena *arena, struct companions *out, lam_error *error);

// Converts the name of a file that a model refers to. The name is confined to the model's folder: backslashes become
// slashes, "." and empty components are removed, and ".." removes the component before it. A name that begins with a
// root or a drive, or refers to a file outside the folder, is cut to its last component, unless params->allowed_paths
// contains the file. All spellings of a file in the folder are therefore converted to the same name. Sets *cut to true
// if the name was cut, otherwise to false. Returns false if no component is left, or if COMPANION_NAME_SIZE is too
// small.
enum { COMPANION_NAME_SIZE = 4096 };
bool companion_name(const struct import_source *source, const char *name, char out[COMPANION_NAME_SIZE], bool *cut);

#endif
