// formats.h: selects the importer of a file.
#ifndef FORMATS_H
#define FORMATS_H

#include "importer.h"

// ".obj, .stl, .ply, .gltf, .glb, .3mf and scene files (.json)": the formats that can be read. Returns `out`.
enum { FORMAT_LIST_SIZE = 128 };
const char *format_list(char out[FORMAT_LIST_SIZE]);

// Returns the importer for these bytes: by content, else by the name's ending; `wanted`: by this name of a format. NULL
// and the reason if there is none.
const struct importer *importer_for(const char *name, const struct file_bytes *file, const char *wanted,
                                    lam_error *error);

// Returns the importer that reads a file of this beginning (FILE_HEAD bytes) and size as a stream: the one that
// importer_for would choose for the whole file. Returns NULL if the file is read as a whole.
const struct importer *importer_for_stream(const char *name, const uint8_t *head, size_t size, const char *wanted);

#endif
