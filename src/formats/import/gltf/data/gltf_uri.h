// gltf_uri.h: decodes file names given as URIs, and data URIs.
#ifndef GLTF_URI_H
#define GLTF_URI_H

#include "gltf.h"

// Returns whether the URI itself contains the bytes ("data:…").
bool gltf_is_data_uri(const char *uri);

// Reads the target of a URI: a file in the model's folder, or the bytes of a data URI. The caller releases `out`.
bool gltf_uri_read(struct gltf *gltf, const struct place *place, const char *uri, struct file_bytes *out);

#endif
