// paths.inl - the fastest path of drawing on drivers that were measured, as `hair-bench paths` prints it on them: what the
// driver's name of its renderer holds, then the path of ribbons and of lines, and of both with levels of detail.
FASTEST("llvmpipe", EXPANDED, EXPANDED, TESSELLATION, TESSELLATION)
FASTEST("NVIDIA", TESSELLATION, TESSELLATION, TESSELLATION, TESSELLATION)
FASTEST("", TESSELLATION, TESSELLATION, TESSELLATION, TESSELLATION) // of any other
