// gltf_file_info.h: collects information about the file (lam_file_info).
#ifndef GLTF_FILE_INFO_H
#define GLTF_FILE_INFO_H

#include "gltf.h"

// Stores the file's information in the scene; gltf_nodes_read stores the index of the selected scene. No buffers are
// read. Returns false if memory runs out.
bool gltf_file_info_note(struct gltf *gltf);

#endif
