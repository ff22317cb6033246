// paths.inl - the fastest drawing path on drivers that were measured with `hair-bench paths`. A row
// has a part of the driver's renderer name, then six paths: for ribbons, for lines, for ribbons
// and lines with levels of detail, for depth, and for vertices that no memory holds.
FASTEST("llvmpipe", CACHED, CACHED, CACHED, CACHED, CACHED, PROCEDURAL)
// Hopper has few graphics units.
FASTEST("NVIDIA H", COMPUTE, CACHED, COMPUTE, CACHED, COMPUTE, TESSELLATION)
FASTEST("NVIDIA", CACHED, CACHED, CACHED, CACHED, TESSELLATION, TESSELLATION)
// Any other driver. Every measured driver draws colour from cached vertices at least as fast as by
// the tessellator. Views of one frame share them.
FASTEST("", CACHED, CACHED, CACHED, CACHED, CACHED, TESSELLATION)
