// quad.h: a rectangle of two triangles with two sets of texture coordinates, for tests of textures.
#ifndef QUAD_H
#define QUAD_H

#include <lambent/lambent.h>

// Four corners in order; the mesh points to its data. `second` and `part` may be NULL.
static inline lam_mesh quad_mesh(const float positions[12], const float normals[12], const float texcoords[8],
                                 const float second[8], const lam_part *part)
{
    static const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    return (lam_mesh){.positions = positions,
                      .vertex_count = 4,
                      .indices = indices,
                      .triangle_count = 2,
                      .normals = normals,
                      .normal_count = 4,
                      .texcoords = texcoords,
                      .texcoord_count = 4,
                      .second_texcoords = second,
                      .second_texcoord_count = second ? 4 : 0,
                      .parts = part,
                      .part_count = part != NULL};
}

#endif
