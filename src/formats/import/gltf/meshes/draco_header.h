// draco_header.h: reads the declared sizes of a mesh compressed with Draco, before the decoder allocates memory for the
// mesh.
#ifndef DRACO_HEADER_H
#define DRACO_HEADER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct draco_claim {
    uint32_t faces;
    uint32_t points; // a lower bound: one vertex may become several points
};

// Returns false if the header cannot be read. The decoder would also fail on such a file.
bool draco_header_read(const uint8_t *bytes, size_t size, struct draco_claim *out);

// Returns an upper bound on the memory that the decoder needs for the declared sizes. The decoder needs tables of
// corners and edges, and stores the attributes twice: as in the file and as in the mesh.
uint64_t draco_claim_bytes(const struct draco_claim *claim);

#endif
