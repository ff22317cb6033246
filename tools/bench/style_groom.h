// style_groom.h - Grooms of built-in haircuts, whose strands are the guides.
#ifndef HAIR_TOOLS_BENCH_STYLE_GROOM_H
#define HAIR_TOOLS_BENCH_STYLE_GROOM_H

#include <hair/hair_asset.h>

#include "tools/bench/bench.h"

// Create the groom of a haircut. The host of `style` is set. 0 guide vertices are the library's
// default.
hair_result bench_style_groom(struct bench* bench, hair_style_desc* style, uint32_t guide_vertices,
                              uint32_t followers, hair_groom** out);

#endif
