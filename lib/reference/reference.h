/// reference.h - the equations of the library's shaders once more, in double precision and one after the
/// other: what tests hold the shaders to. Written from Tariq 2010, "Hair", and from what glsl/shared.h
/// promises, not from the shaders: an independent text finds mistakes that the same text compiled twice would
/// share.
///
/// Vectors are xyz, quaternions xyzw. Inputs are the structs that the shaders read: floats, which doubles
/// hold exactly.
#ifndef HAIR_REFERENCE_REFERENCE_H
#define HAIR_REFERENCE_REFERENCE_H

#include <hair/hair.h>

#include "glsl/shared.h"

#ifdef __cplusplus
extern "C" {
#endif

/// One guide and what moves it.
struct hair_reference_guide {
    const struct hair_guide* guide;
    const struct hair_rest* rest; ///< Of its own vertices: guide->count of them.
    const struct hair_step_params* params;
};

/// As hair_state.
struct hair_reference_vertex {
    double position[3];
    double displacement[3];
};

// frames.cpp ------------------------------------------------------------------------------------------------

/// Frames of segments with the unit `directions`, carried from each to the next by the least rotation
/// (parallel transport); the first is `root` turned to lie along its segment. y is along the segment.
void hair_reference_frames(uint32_t segments, const double* directions, const double root[4], double* frames);

// redblack.cpp: the stages of a substep, in order. `positions`: xyz per vertex, moved in place --------------

/// External forces, Verlet integration, pull to the rest pose; pinned vertices go with the scalp.
void hair_reference_integrate(struct hair_reference_guide guide, uint32_t substep,
                              const struct hair_reference_vertex* before, double* positions);
/// Pull of every segment to its rest angle with the one before, from a potential that all three vertices feel.
void hair_reference_angular(struct hair_reference_guide guide, uint32_t substep, double* positions);
/// Links (0,1), (2,3), … (red, phase 0) or (1,2), (3,4), … (black, phase 1) to their rest length.
void hair_reference_distance(struct hair_reference_guide guide, uint32_t phase, double* positions);
/// Links over two segments: (0,2), (1,3), (4,6), … or (2,4), (3,5), (6,8), …, part of the way.
void hair_reference_bend(struct hair_reference_guide guide, uint32_t phase, double* positions);
/// Out of every solid, one after the other.
void hair_reference_collide(struct hair_reference_guide guide, uint32_t substep, double* positions);

/// All substeps of a step.
void hair_reference_redblack(struct hair_reference_guide guide, struct hair_reference_vertex* state);

// smooth.cpp ------------------------------------------------------------------------------------------------

/// One sample of a smoothed guide.
struct hair_reference_sample {
    double position[3];
    double to_root; ///< Along the chords. m.
    double tangent[3];
    double stretch; ///< Of the segment.
    double frame[4];
};

/// Derivative by parameter at the middle of three points: that of the parabola through them.
void hair_reference_slope(const double before[3], const double at[3], const double after[3],
                          double length_before, double length_after, double slope[3]);
/// The cubic of Hermite from a (w = 0) to b (w = 1), `length` apart in the parameter by which the slopes are
/// taken. tangent: the derivative by w.
void hair_reference_hermite(const double a[3], const double slope_a[3], const double b[3],
                            const double slope_b[3], double length, double w, double position[3],
                            double tangent[3]);

/// params->smooth_vertices samples at equal distances along the chords.
void hair_reference_smooth(struct hair_reference_guide guide, const struct hair_reference_vertex* state,
                           struct hair_reference_sample* samples);

// follower.cpp, strand.cpp ----------------------------------------------------------------------------------------------

struct hair_reference_point {
    double position[3];
    double tangent[3];
    double radius;
};

/// What is done at t to a follower that meets a solid: slopes are by t.
struct hair_reference_repair {
    double away[3], away_slope[3]; ///< How far it is moved. m.
    double freed, freed_slope; ///< Share to which it is freed of all guides but its own.
};

/// Of Tariq 2010: `hit` is where the first vertex inside is, as a share of the length.
void hair_reference_switch(double t, double hit, struct hair_reference_repair* out);
/// Of the uniform cubic B-splines with these control points, as glsl/repair.glsl has them: away in the first three,
/// freed in the last.
void hair_reference_spline(const double controls[HAIR_REPAIR_CONTROLS][4], double t,
                           struct hair_reference_repair* out);

/// A follower at t from 0 (root) to 1 (tip), beyond 1 straight on. `samples`: of all guides, `count` each. `repair`: NULL:
/// none.
void hair_reference_follower(const struct hair_follower* follower, const hair_look* look, uint32_t count,
                             const struct hair_reference_sample* samples, double t,
                             const struct hair_reference_repair* repair, struct hair_reference_point* out);

#ifdef __cplusplus
}
#endif

#endif
