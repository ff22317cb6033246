/// reference.h - The equations of the library's shaders in double precision, evaluated serially.
/// Tests compare the shaders with them.
///
/// The code is written from Tariq 2010, "Hair", and from glsl/shared.h, not from the shaders. An
/// independent implementation finds mistakes that a second compilation of the same text would
/// repeat.
///
/// Vectors are xyz, quaternions xyzw. Inputs are the structs of floats that the shaders read.
/// Doubles represent floats exactly.
#ifndef HAIR_TESTS_REFERENCE_REFERENCE_H
#define HAIR_TESTS_REFERENCE_REFERENCE_H

#include <hair/hair.h>

#include "glsl/shared.h"

#ifdef __cplusplus
extern "C" {
#endif

/// One guide and the parameters that move it.
struct hair_reference_guide {
    const struct hair_guide* guide;
    const struct hair_rest* rest; ///< Rest data of its guide->count vertices.
    const struct hair_step_params* params;
};

/// hair_state in double precision.
struct hair_reference_vertex {
    double position[3];
    double displacement[3];
};

// frames.cpp --------------------------------------------------------------------------------------

/// Compute the frames of segments with the unit `directions`. Each frame is carried to the next
/// segment by the smallest rotation (parallel transport). The first frame is `root` rotated onto
/// its segment. y is along the segment.
void hair_reference_frames(uint32_t segments, const double* directions, const double root[4], double* frames);

// redblack.cpp, stages of a substep in order, moving `positions` (xyz per vertex) in place --------

/// Apply external forces, integrate by Verlet, and pull to the rest pose. Pinned vertices move with
/// the scalp.
void hair_reference_integrate(struct hair_reference_guide guide, uint32_t substep,
                              const struct hair_reference_vertex* before, double* positions);
/// Pull every segment to its rest angle with the previous one, by a potential that moves all three
/// vertices.
void hair_reference_angular(struct hair_reference_guide guide, uint32_t substep, double* positions);
/// Move the links (0,1), (2,3), … (red, phase 0) or (1,2), (3,4), … (black, phase 1) to their rest
/// length.
void hair_reference_distance(struct hair_reference_guide guide, uint32_t phase, double* positions);
/// Move links over two segments, (0,2), (1,3), (4,6), … or (2,4), (3,5), (6,8), …, part of the way
/// to their rest length.
void hair_reference_bend(struct hair_reference_guide guide, uint32_t phase, double* positions);
/// Push vertices out of every collider, one after the other.
void hair_reference_collide(struct hair_reference_guide guide, uint32_t substep, double* positions);

/// Run all substeps of a step.
void hair_reference_redblack(struct hair_reference_guide guide, struct hair_reference_vertex* state);

// smooth.cpp --------------------------------------------------------------------------------------

/// One sample of a smoothed guide.
struct hair_reference_sample {
    double position[3];
    double to_root; ///< Distance from the root along the chords, m.
    double tangent[3];
    double stretch; ///< Stretch of the segment.
    double frame[4];
};

/// Compute the derivative at the middle of three points, of the parabola through them.
void hair_reference_slope(const double before[3], const double at[3], const double after[3],
                          double length_before, double length_after, double slope[3]);
/// Evaluate the Hermite cubic from a (w = 0) to b (w = 1). `length` is the difference of the
/// parameter by which the slopes are taken. `tangent` is the derivative by w.
void hair_reference_hermite(const double a[3], const double slope_a[3], const double b[3],
                            const double slope_b[3], double length, double w, double position[3],
                            double tangent[3]);

/// Compute params->smooth_vertices samples at equal distances along the chords.
void hair_reference_smooth(struct hair_reference_guide guide, const struct hair_reference_vertex* state,
                           struct hair_reference_sample* samples);

// follower.cpp, strand.cpp ------------------------------------------------------------------------

struct hair_reference_point {
    double position[3];
    double tangent[3];
    double radius;
};

/// Correction at t of a follower that hits a collider. Slopes are derivatives by t.
struct hair_reference_repair {
    double away[3], away_slope[3]; ///< Displacement, m.
    /// Fraction to which the follower is freed of all guides except its own.
    double freed, freed_slope;
};

/// Compute the correction of Tariq 2010. `hit` is the position of the first vertex inside a
/// collider, as a fraction of the length.
void hair_reference_switch(double t, double hit, struct hair_reference_repair* out);
/// Evaluate the uniform cubic B-splines of these control points, as glsl/strands/repair.glsl does.
/// The first three components are `away`, the last one is `freed`.
void hair_reference_spline(const double controls[HAIR_REPAIR_CONTROLS][4], double t,
                           struct hair_reference_repair* out);

/// Evaluate a follower at t from 0 (root) to 1 (tip). The follower continues straight beyond 1.
/// `samples` has `count` samples of each guide. NULL `repair` disables the correction.
void hair_reference_follower(const struct hair_follower* follower, const hair_look* look, uint32_t count,
                             const struct hair_reference_sample* samples, double t,
                             const struct hair_reference_repair* repair, struct hair_reference_point* out);

// displace.cpp ------------------------------------------------------------------------------------

/// Compute the displacements of a guide from its shape at rest, `count` times xyz, m.
void hair_reference_displacements(const struct hair_reference_sample* samples, const hair_vec4* shape,
                                  uint32_t count, double* out);

/// Input of hair_reference_shaped().
struct hair_reference_shapes {
    uint32_t count; ///< Samples of each guide.
    const struct hair_reference_sample* samples;
    const double* displacements; ///< xyz per sample, m.
    uint32_t shape_vertices;
    const double* vertices; ///< xyz of the follower's shape, with a vertex beyond each end, m.
};

/// Evaluate a follower with a shape of its own at t from 0 to 1. `freed` blends to guide 0 alone.
/// The tangent is that of a look without strays, frizz and curls.
void hair_reference_shaped(const struct hair_follower* follower, const hair_look* look,
                           const struct hair_reference_shapes* shapes, double t, double freed,
                           struct hair_reference_point* out);

// derive.cpp --------------------------------------------------------------------------------------

/// Input of hair_reference_derive().
struct hair_reference_derived {
    const struct hair_guide *own, *parent;
    const struct hair_rest* rest; ///< Rest data of all vertices.
    const struct hair_state* state; ///< States of all vertices, of which those of the parent count.
    const hair_vec4* material; ///< Frames of all segments. NULL turns segments by least rotations.
    double head[4], head_before[4]; ///< Rotation of the head after and before the last substep.
    double head_moved[3]; ///< Displacement of the head's origin in the last substep, m.
};

/// Compute positions and displacements of a guide that turns as its parent does, xyz per vertex.
void hair_reference_derive(const struct hair_reference_derived* in, double* positions, double* displacements);

// skin.cpp ----------------------------------------------------------------------------------------

/// Compute the position of a vertex that four joints move, by linear blend skinning. Matrices are
/// column-major. Weights are divided by their sum.
void hair_reference_skin(const float rest[3], const uint16_t joints[4], const float weights[4],
                         const float* matrices, double position[3]);

#ifdef __cplusplus
}
#endif

#endif
