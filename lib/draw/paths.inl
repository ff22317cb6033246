// paths.inl - the fastest path of drawing on drivers that were measured, as `hair-bench paths` prints it on them: what the
// driver's name of its renderer holds, then the path of ribbons and of lines, of both with levels of detail, and of
// depth.
FASTEST("llvmpipe", EXPANDED, EXPANDED, EXPANDED, EXPANDED, EXPANDED)
FASTEST("NVIDIA H", COMPUTED, EXPANDED, COMPUTED, EXPANDED, COMPUTED) // few units of Hopper draw
FASTEST("NVIDIA", EXPANDED, EXPANDED, EXPANDED, EXPANDED, TESSELLATION)
FASTEST("", TESSELLATION, TESSELLATION, TESSELLATION, TESSELLATION, TESSELLATION) // of any other
