// render_path.h - the render path that applications do not select.
#ifndef HAIR_DRAW_RENDER_PATH_H
#define HAIR_DRAW_RENDER_PATH_H

#include <hair/hair_view.h>

// Private value of hair_view.render_path, which hair_draw() accepts beside the public values. The
// vertex shader computes vertices from their index, for the drawn strands only. Views with a
// hair_lod that cannot use a cache fall back to this path. The bench, the capture tool and tests
// select it to compare it with other paths.
#define HAIR_RENDER_PATH_PROCEDURAL ((hair_render_path)(HAIR_RENDER_PATH_AUTO + 1))

#endif
