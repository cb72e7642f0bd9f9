// importer.h: the interface of a model format. To add a format, define its importer and list the importer's name in
// IMPORTERS.
#ifndef IMPORTER_H
#define IMPORTER_H

#include "call_control.h"
#include "file.h"
#include "normals.h"
#include "pool.h"
#include "scene_internal.h"

struct importer;
struct import_source;
struct companion;
typedef bool open_companion(const struct import_source *source, const char *name, struct arena *arena,
                            struct companion *out, lam_error *error);

struct import_source {
    const char *name;        // for messages: the path as the user wrote it
    const char *path;        // the file's path; NULL if the file is in memory or is standard input
    struct file_parts parts; // all bytes, which parallel_rows.h reads
    // The first bytes of the file, at least FILE_HEAD of a larger file; all of them after import_whole. FILE_PADDING zero
    // bytes follow.
    const uint8_t *bytes;
    size_t size; // the number of bytes at `bytes`
    // The owner of `bytes`. An importer whose arrays point into `bytes` may move the owner to the scene's arena
    // (file_move_to_arena).
    struct file_bytes *file;
    const lam_load_params *params;
    struct pool *pool;         // NULL if there are no threads
    struct call_control *call; // never NULL; every long loop checks it
    // These functions open a file that the model or a scene file refers to (companion.h).
    open_companion *open, *open_of_scene;
    // Finds the importer for a model in a scene file (formats.h).
    const struct importer *(*importer_for)(struct import_source *source, const char *wanted, lam_error *error);
    void *open_state; // struct companions
};

struct importer {
    const char *name;       // "obj"
    const char *extensions; // "obj"; several extensions are separated by spaces
    lam_up up;              // the format's up axis
    // the format does not define an up axis; `up` is the most common axis, and the shape of a terrain may override `up`
    bool up_is_habit;
    bool may_lie; // files often contain scans and single parts, which may lie on any side; the shape may override `up`
    // a scene file, which names other models; the importer prepares the normals and origins of these models itself
    bool is_scene_file;
    bool flat_normals; // the format requires flat normals for meshes without normals
    // Returns how certain it is that the bytes are in this format: 0 (no), 1 (possibly; the file's extension decides)
    // or 2 (certainly). `size` is the number of bytes in memory, which may be only the first of a file of `file_size`
    // bytes.
    int (*probe)(const uint8_t *bytes, size_t size, size_t file_size);
    // Fills an empty scene with meshes, materials, and one object per mesh. On failure, the caller frees the scene.
    bool (*load)(struct import_source *source, struct lam_scene *scene, lam_error *error);
    // For a format that a module reads (module_formats.c): the module, and the name of unsupported_formats.c by which
    // files are recognised; `probe` is then NULL.
    const char *module, *described;
};

// The formats, in the order of the lists that users see. tests/fuzz/meson.build reads these names too.
#define IMPORTERS(X) X(obj) X(stl) X(ply) X(gltf) X(3mf) X(scene)

#define IMPORTER(name) extern const struct importer importer_##name;
IMPORTERS(IMPORTER)
#undef IMPORTER

// module_formats.c: the formats that modules read; the last has no name. Static programs, Windows and pages have none.
extern const struct importer module_importers[];
#define MODULES_PACKAGE "lambent-formats"
// Returns whether the program lambent-import and the importer's module are installed.
bool module_is_installed(const struct importer *importer);

// Returns the crease angle that the load parameters select for scene_prepare (0 means the default). Flat normals
// correspond to FACET_CREASE_RAD.
static inline double importer_crease(const struct importer *importer, lam_normals normals, double crease_angle_rad)
{
    return importer->flat_normals && normals == LAM_NORMALS_FILE && crease_angle_rad == 0 ? FACET_CREASE_RAD
                                                                                          : crease_angle_rad;
}

// Makes `bytes` all bytes of the file, for formats that cannot be read in parts.
bool import_whole(struct import_source *source, lam_error *error);

// These functions fail with LAM_CANNOT_READ and the message "NAME:LINE: sentence" or "NAME: byte OFFSET: sentence".
// They return false.
bool fail_line(lam_error *error, const struct import_source *source, size_t line, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
bool fail_byte(lam_error *error, const struct import_source *source, size_t offset, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#endif
