// peers.inl - Results of other libraries on problems of the suite `accuracy`. They were measured
// once, on one CPU thread, for 1,000 strands of 32 vertices at 60 frames a second.
//
// The case `swing` is a strand of 0.30 m against each library's own converged chain over the first
// 0.4 s. The case `static` is hair of 4 GPa and 40 micrometres against the elastica.
//
// PEER_SWING(method, substeps, iterations, maximum stretch as a fraction, RMS error in mm, CPU time
// in microseconds per strand and frame)
// PEER_STATIC(method, error of the tip as a fraction of the length, at 0.05, 0.10 and 0.30 m)
// NAN means an unknown value.
PEER_SWING("Jolt Hair, 360 iterations a second", 6, 1, 0.22, 23, 23)
PEER_SWING("Jolt Hair, 5760 iterations a second, at best", 96, 1, 0.002, 2.6, 355)
PEER_SWING("Jolt Hair, 5760 iterations a second, at worst", 96, 1, 0.014, 5.6, 355)
PEER_SWING("Bullet rope", 1, 16, 0.88, 102, 19)
PEER_SWING("Bullet rope", 64, 1, 0.0094, 2.5, 146)
PEER_SWING("PBD distance constraints", 20, 1, 0.096, 12, 20)
PEER_SWING("PBD distance constraints", 40, 1, 0.041, 4.6, 41)
PEER_SWING("PBD distance constraints", 80, 1, 0.0057, 2.0, 82)
PEER_SWING("PBD direct stiff rods (Deul 2018)", 5, 1, 8.69, 75, 249)
PEER_SWING("PBD direct stiff rods (Deul 2018)", 5, 4, 0.00016, 10.9, 768)
PEER_SWING("MuJoCo cable, Runge-Kutta, double", 8, 1, 0, 0.21, 1224)
PEER_SWING("MuJoCo cable, Runge-Kutta, double", 16, 1, 0, 0.013, 2433)
PEER_SWING("Newton VBD", 20, 10, 0.012, 5.6, 3613)
PEER_SWING("TressFX 4.1, 3 length and 3 local iterations", 1, 3, 2.74, NAN, NAN)
PEER_SWING("TressFX 4.1, 64 length iterations", 1, 64, 0.50, NAN, NAN)

PEER_STATIC("Jolt Hair, 360 iterations a second", 1.61, 0.83, 0.071)
PEER_STATIC("Jolt Hair, 5760 iterations a second", 0.26, 0.04, 0.022)
PEER_STATIC("PBD direct stiff rods (Deul 2018)", 0.008, 0.031, 0.024)
PEER_STATIC("MuJoCo cable, Runge-Kutta, double", 0.008, 0.031, 0.026)
PEER_STATIC("Newton VBD, at best", 0.078, 0.025, 0.024)
