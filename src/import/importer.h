// importer.h: the interface of a model format. One format, one file, one row in load/formats.c.
#ifndef IMPORTER_H
#define IMPORTER_H

#include "call_control.h"
#include "file.h"
#include "pool.h"
#include "scene_internal.h"

struct importer;

struct import_source {
    const char *name;     // for messages: the path as the user gave it
    const char *path;     // of the file, as it can be opened from here; NULL: it came from memory or standard input
    const uint8_t *bytes; // FILE_PADDING zero bytes follow the last one
    size_t size;
    const lam_load_params *params;
    struct pool *pool;         // may be NULL: no threads
    struct call_control *call; // never NULL; check it in every long loop
    // Opens a companion file by the name that the model uses, confined to the model's folder. The caller releases it.
    bool (*open)(const struct import_source *source, const char *name, struct file_bytes *out, lam_error *error);
    // Opens a model that a scene file names: as above, or anywhere where the caller allows it. *path is where it lies,
    // as it can be opened from here, in `arena`; NULL: not on disk.
    bool (*open_model)(const struct import_source *source, const char *name, struct arena *arena, const char **path,
                       struct file_bytes *out, lam_error *error);
    // Which importer reads a model that a scene file names: formats.h.
    const struct importer *(*importer_for)(const char *name, const struct file_bytes *file, const char *wanted,
                                           lam_error *error);
    void *open_state; // struct companions
};

struct importer {
    const char *name;       // "obj"
    const char *extensions; // "obj", several with spaces
    lam_up up;              // the format's up axis
    bool is_scene_file;     // names other models, whose normals and origins it prepares itself
    // How sure the format is of these bytes: 0 no, 1 could be (then the name's ending decides), 2 certain.
    int (*probe)(const uint8_t *bytes, size_t size);
    // Fills an empty scene: meshes, materials, one object a mesh. The arena is the scene's; on failure the caller frees
    // it.
    bool (*load)(const struct import_source *source, struct lam_scene *scene, lam_error *error);
    // NULL, or: the same from a large file whose first FILE_HEAD bytes are the source's, without holding it
    // whole. False where it is not of a layout that this serves, or something is wrong: then `load` is asked,
    // with a fresh scene and the whole file.
    bool (*load_parts)(const struct import_source *source, const struct file_parts *file, struct lam_scene *scene);
};

extern const struct importer importer_obj, importer_stl, importer_ply, importer_scene;

// LAM_CANNOT_READ with "NAME:LINE: sentence" or "NAME: byte OFFSET: sentence". Return false.
bool fail_line(lam_error *error, const struct import_source *source, size_t line, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
bool fail_byte(lam_error *error, const struct import_source *source, size_t offset, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#endif
