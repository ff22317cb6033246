// passes.inl - every shader program: its name in code, its name in reports, what it defines, its stages
// under glsl/.
// Read by the enum, the compiler loop, the timers, the OpenGL labels and the tests.
PASS(RESET, "sim/reset", "sim/reset.comp")
PASS(TURN, "sim/turn", "sim/turn.comp")
PASS(REDBLACK, "sim/redblack", "HAIR_GUIDE_THREADS=64 sim/redblack.comp")
PASS(REDBLACK_32, "sim/redblack_32", "HAIR_GUIDE_THREADS=32 sim/redblack.comp")
PASS(SMOOTH, "interpolate/smooth", "interpolate/smooth.comp")
PASS(EXPAND, "interpolate/expand", "interpolate/expand.comp")
PASS(RIBBONS, "draw/ribbons", "draw/patch.vert draw/patch.tesc draw/strand.tese draw/ribbon.geom draw/strand.frag")
PASS(LINES, "draw/lines", "draw/patch.vert draw/patch.tesc draw/strand.tese draw/strand.frag")
PASS(DEPTH_RIBBONS, "draw/depth_ribbons", "draw/patch.vert draw/patch.tesc draw/strand.tese draw/ribbon.geom draw/depth.frag")
PASS(DEPTH_LINES, "draw/depth_lines", "draw/patch.vert draw/patch.tesc draw/strand.tese draw/depth.frag")
PASS(GUIDES, "draw/guides", "draw/guides.vert draw/guides.frag")
