// raster.c: finds the visible surfaces of a tile, and writes its pixels. This file is compiled once for each instruction
// set, with LANES and ISA defined (kernels.h).
#include "kernels.h"

#include "arena.h"
#include "clip.h"
#include "coverage.h"
#include "fragment_store.h"
#include "fragments.h"
#include "light_bounds.h"
#include "occlusion.h"
#include "translucent_fragments.h"
#include "triples.h"

#include <stdlib.h>
#include <string.h>

#include "vertex_transform.inc"

#include "corners.inc"
#include "occlusion.inc"
#include "bin_triangles.inc"
#include "cover.inc"
#include "cover_packet.inc"
#include "cover_tile.inc"
#include "translucent_fragments.inc"
#include "visibility_resolve.inc"
#include "fragment_store.inc"
#include "resolve.inc"

const struct raster_kernels FOR_ISA(raster_kernels) = {
    .vertex_transform = vertex_transform,
    .bin_triangles = bin_triangles,
    .cover_tile = cover_tile,
    .translucent_fragments = translucent_fragments,
    .visibility_resolve = visibility_resolve,
    .save_fragments = save_fragments,
    .load_fragments = load_fragments,
    .depth_of_tile = depth_of_tile,
    .layers_of_tile = layers_of_tile,
    .resolve = resolve,
    .resolve_empty = resolve_empty,
};
