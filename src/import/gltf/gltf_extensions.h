// gltf_extensions.h: checks the extensions that a file names, and reports their support.
#ifndef GLTF_EXTENSIONS_H
#define GLTF_EXTENSIONS_H

#include "gltf.h"

// Checks "asset" (section 3.2), and the extensions that the file requires (section 3.12). Returns false if the file
// needs a later version, or an extension that is not known here (unless the load is lenient): LAM_UNSUPPORTED.
bool gltf_check_asset(struct gltf *gltf);
bool gltf_check_extensions(struct gltf *gltf);

lam_extension_support gltf_extension_support(const char *name);

#endif
