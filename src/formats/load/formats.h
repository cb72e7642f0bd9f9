// formats.h: selects the importer of a file.
#ifndef FORMATS_H
#define FORMATS_H

#include "importer.h"

// Lists the readable formats: ".obj, .stl, .ply, .gltf, .glb, .3mf and scene files (.json)". Returns `out`.
enum { FORMAT_LIST_SIZE = 128 };
const char *format_list(char out[FORMAT_LIST_SIZE]);

// Returns the importer for a file. If `wanted` is not NULL, it names the format. Otherwise, the content of the file
// determines the format: its first bytes, or the whole file if they are ambiguous. If the whole file is also ambiguous,
// the extension of the source's name determines the format. Returns NULL and fills the error if no format matches.
const struct importer *importer_for(struct import_source *source, const char *wanted, lam_error *error);

#endif
