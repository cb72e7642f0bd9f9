// draco_header.h: the claims of a mesh compressed by Draco, read before its decoder allocates memory for it.
#ifndef DRACO_HEADER_H
#define DRACO_HEADER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct draco_claim {
    uint32_t faces;
    uint32_t points; // at least: one vertex may become several points
};

// Returns false if the header of a mesh cannot be read, nor could the decoder read it.
bool draco_header_read(const uint8_t *bytes, size_t size, struct draco_claim *out);

// Returns the largest memory of the decoder for a claim: its tables of corners and edges, and the attributes in the
// form of the file and of the mesh.
uint64_t draco_claim_bytes(const struct draco_claim *claim);

#endif
