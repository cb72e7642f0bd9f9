// facets.h: computes facet normals.
#ifndef FACETS_H
#define FACETS_H

#include "visible_normals.h"

// Computes the normal of one triangle; zero if it has no area.
void facet_normal(const lam_mesh *mesh, size_t triangle, float normal[3]);

// Computes the normals that make_visible_normals would compute if every edge were a crease.
bool make_visible_facets(const lam_mesh *mesh, uint32_t first, struct visible_normals *visible, struct pool *pool,
                         struct call_control *call, lam_error *error);

#endif
