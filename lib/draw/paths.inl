// paths.inl - the fastest drawing path on drivers that were measured with `hair-bench paths`. A row
// has a part of the driver's renderer name, then five paths: for ribbons, for lines, for ribbons
// and lines with levels of detail, and for depth.
FASTEST("llvmpipe", CACHED, CACHED, CACHED, CACHED, CACHED)
// Hopper has few graphics units.
FASTEST("NVIDIA H", COMPUTE, CACHED, COMPUTE, CACHED, COMPUTE)
FASTEST("NVIDIA", CACHED, CACHED, CACHED, CACHED, TESSELLATION)
// Any other driver.
FASTEST("", TESSELLATION, TESSELLATION, TESSELLATION, TESSELLATION, TESSELLATION)
