// formats.h: selects the importer of a file.
#ifndef FORMATS_H
#define FORMATS_H

#include "importer.h"

// Lists the readable formats: ".obj, .stl, .ply, .gltf, .glb, .3mf and scene files (.json)". Returns `out`.
enum { FORMAT_LIST_SIZE = 128 };
const char *format_list(char out[FORMAT_LIST_SIZE]);

// Returns the importer for these bytes: by content, or else by the name's extension; `wanted` selects a format by its
// name. Returns NULL and fills the error if there is none.
const struct importer *importer_for(const char *name, const struct file_bytes *file, const char *wanted,
                                    lam_error *error);

// Returns the importer that may read a file with these first FILE_HEAD bytes and this size in parts: the one that
// importer_for would choose for the whole file. Returns NULL if the file must be read as a whole.
const struct importer *importer_for_parts(const char *name, const uint8_t *head, size_t size, const char *wanted);

#endif
