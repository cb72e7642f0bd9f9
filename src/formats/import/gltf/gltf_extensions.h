// gltf_extensions.h: checks the extensions that a file uses, and reports which of them are supported.
#ifndef GLTF_EXTENSIONS_H
#define GLTF_EXTENSIONS_H

#include "gltf.h"

// Checks "asset" (section 3.2), and the extensions (section 3.12) that gltf_file_info_note found. Fails with LAM_UNSUPPORTED if
// the file requires a later version, or (unless the load is lenient) an unknown extension.
bool gltf_check_asset(struct gltf *gltf);
bool gltf_check_extensions(struct gltf *gltf);

lam_extension_support gltf_extension_support(const char *name);

#endif
