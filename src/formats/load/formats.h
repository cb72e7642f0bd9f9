// formats.h: selects the importer of a file.
#ifndef FORMATS_H
#define FORMATS_H

#include "importer.h"

// Lists the readable formats: ".obj, .stl, .ply, .gltf, .glb, .3mf and scene files (.json)". Returns `out`.
enum { FORMAT_LIST_SIZE = 128 };
const char *format_list(char out[FORMAT_LIST_SIZE]);

// Returns the importer for a file. If `wanted` is not NULL, it names the format. Otherwise, the content of the file
// determines the format. If the content is ambiguous, the extension of `name` determines the format. Returns NULL and
// fills the error if no format matches.
const struct importer *importer_for(const char *name, const struct file_bytes *file, const char *wanted,
                                    lam_error *error);

// Returns the importer that importer_for would choose for the whole file, if this importer can read the file in parts.
// `head` contains the first FILE_HEAD bytes of the file. Returns NULL if the file must be read as a whole.
const struct importer *importer_for_parts(const char *name, const uint8_t *head, size_t size, const char *wanted);

#endif
