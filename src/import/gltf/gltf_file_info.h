// gltf_file_info.h: collects information about the file (lam_file_info).
#ifndef GLTF_FILE_INFO_H
#define GLTF_FILE_INFO_H

#include "gltf.h"

// Notes the file's facts in the scene; which scene is read is noted by gltf_nodes_read. Reads no buffers. Returns false
// if memory runs out.
bool gltf_file_info_note(struct gltf *gltf);

#endif
