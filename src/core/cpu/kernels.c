// kernels.c: all kernels. This file is compiled once for each instruction set, with LANES and ISA defined
// (meson.build), and once with RECORDING, to shade one pixel and record its values. In the version with RECORDING, many
// functions are unused, and the compiler removes them.
#include "kernels.h"

#include "clip.h"
#include "coverage.h"
#include "fragment_store.h"
#include "fragments.h"
#include "light_bounds.h"
#include "resolve.h"
#include "screen_occlusion.h"
#include "shade_frame.h"
#include "shading_batch.h"
#include "translucent_fragments.h"
#include "vertex_colors.h"
#include "behind.h"
#include "blend.h"

#include "arena.h"
#include "triples.h"

#include <stdlib.h>
#include <string.h>

#ifndef RECORDING
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
#include "tile_depth.inc"
#endif
#include "shade.inc"
#include "resolve.inc"
#include "record_pixel.inc"

#ifdef RECORDING
const struct recording_kernels recording_kernels = {.record_fragments = record_fragments, .record_pixel = record_pixel};
#else
#define JOIN(a, b) a##b
#define NAME(isa)  JOIN(kernels_, isa)
#define TEXT(x)    #x
#define STRING(x)  TEXT(x)

const struct kernels NAME(ISA) = {
    .name = STRING(ISA),
    .lanes = LANES,
    .vertex_transform = vertex_transform,
    .bin_triangles = bin_triangles,
    .cover_tile = cover_tile,
    .translucent_fragments = translucent_fragments,
    .mask_fragments = mask_fragments,
    .visibility_resolve = visibility_resolve,
    .save_fragments = save_fragments,
    .load_fragments = load_fragments,
    .shade_fragments = shade_fragments,
    .light_vertices = light_vertices,
    .depth_of_tile = depth_of_tile,
    .occlusion = &occlusion_kernels,
    .resolve = resolve,
    .resolve_empty = resolve_empty,
};
#endif
