// kernels.c: the template of all kernels, compiled once for each instruction set with LANES and ISA defined
// (meson.build).
#include "kernels.h"

#include "triples.h"

#include <string.h>

#include "vertex_transform.inc"
#include "corners.inc"
#include "occlusion.inc"
#include "bin.inc"
#include "cover.inc"
#include "cover_packet.inc"
#include "cover_tile.inc"
#include "translucent_fragments.inc"
#include "visibility_resolve.inc"
#include "fragment_store.inc"
#include "shade.inc"
#include "resolve.inc"
#include "record_pixel.inc"

#define JOIN(a, b) a##b
#define NAME(isa)  JOIN(kernels_, isa)
#define TEXT(x)    #x
#define STRING(x)  TEXT(x)

const struct kernels NAME(ISA) = {
    .name = STRING(ISA),
    .lanes = LANES,
    .project = project,
    .bin = bin,
    .cover = cover,
    .gather_layers = gather_layers,
    .collect = collect,
    .save_fragment_store = save_fragment_store,
    .load_fragment_store = load_fragment_store,
    .light = light,
    .resolve = resolve_and_record,
    .resolve_empty = resolve_empty,
};
