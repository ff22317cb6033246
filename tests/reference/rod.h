/// rod.h - One strand in double precision, as a chain of rigid segments that resist bending and
/// twist. The solvers are compared with it.
///
/// Vertices are numbered 0 (root) to N-1 (tip). Segment j connects vertices j and j+1. It has the
/// fixed length l_j and a frame q_j whose y is along it. Joint i, 0 to N-2, is at vertex i, between
/// segments i-1 and i. At joint 0 the scalp is segment -1, with the root frame.
///
/// Let (w, v) = conj(q_{i-1}) q_i with the sign chosen such that w >= 0. The strain of a joint is 2
/// v, named u. Its length is 2 sin(half the angle). With rest strain U the energy of joint i is
///
/// 1 / (2 l_i) [B1 (u - U)_x^2 + C (u - U)_y^2 + B2 (u - U)_z^2 + B2 (2 w - 2 w0)^2]
///
/// with the mean length l_i = (l_{i-1} + l_i) / 2 of its segments, and at the clamp
///
/// 1 / (2 l_0) [k1 B1 (..)_x^2 + 2 C (..)_y^2 + k2 B2 (..)_z^2 + k2 B2 (..)^2].
///
/// k1 and k2 are factors of hair_reference_rod_clamp_factor(). The last term makes the energy grow
/// with the angle from the rest shape up to half a turn. This holds for any bend of the joint at
/// rest. Rotations of the frames about their segments have no inertia. They minimize the energy at
/// every moment.
///
/// Vectors are xyz, quaternions xyzw. Units are SI. Positions are in the world unless they are
/// described as in the head's frame.
#ifndef HAIR_TESTS_REFERENCE_ROD_H
#define HAIR_TESTS_REFERENCE_ROD_H

#include <stdint.h>

#include "tests/reference/drag.h"

#ifdef __cplusplus
extern "C" {
#endif

#define HAIR_REFERENCE_ROD_MAX_VERTICES 256

enum hair_reference_rod_root {
    /// Vertex 0 moves with the head, joint 0 connects segment 0 to the root frame.
    HAIR_REFERENCE_ROD_CLAMPED,
    HAIR_REFERENCE_ROD_HINGED, ///< Vertex 0 moves with the head, there is no joint 0.
    HAIR_REFERENCE_ROD_FREE ///< Vertex 0 is free.
};

struct hair_reference_rod_pose {
    double position[3];
    double rotation[4];
};

/// Description of a rod. Arrays are copied. Start from hair_reference_rod_desc_default().
struct hair_reference_rod_desc {
    uint32_t vertices; ///< [2, 256].
    /// Per vertex, in the head's frame. NULL means straight along the root frame from 0.
    const double* positions;
    const double* lengths; ///< Per segment. NULL uses the distances of `positions`.

    /// Mass per length, rho A, kg/m. Each vertex has half the mass of its segments.
    double line_density;
    const double* masses; ///< Per vertex, instead of line_density, kg.
    double tip_mass; ///< Additional mass at the tip, kg.

    double bend[2]; ///< B1 and B2, about the frame's x and z, N m^2.
    double twist; ///< C, N m^2.
    const double* scale; ///< Per vertex, factor of all three stiffnesses. NULL means 1.
    const double* rest_strain; ///< U of vertices - 1 joints. NULL means 0.
    /// 2 w0 of vertices - 1 joints. NULL means (4 - |U|^2)^(1/2), or 0 if |U| > 2.
    const double* rest_real;
    /// 1 means that u is the difference of unit tangents, with B1 only, without frames, and U = 0.
    int straight;

    enum hair_reference_rod_root root;
    double root_frame[4]; ///< In the head's frame. The strand leaves the scalp along y.
    int plain_clamp; ///< 1 means k = 2 for any weight on the clamp.

    double gravity[3]; ///< m/s^2.
    double damping; ///< c of dv/dt = -c (v - wind), 1/s.
    double wind[3]; ///< m/s.
    /// Drag of the segments, as a multiple of hair_reference_drag. The greater of drag and damping
    /// acts. 0 disables drag.
    double drag;
    double diameter; ///< Diameter for the drag, m.
    struct hair_reference_air air; ///< Air for the drag.

    /// Angular frequency per vertex of a spring to `pull_target`, 1/s. NULL disables it.
    const double* pull;
    const double* pull_target; ///< Per vertex, in the head's frame. NULL uses `positions`.

    struct hair_reference_rod_pose head; ///< Pose at the start.
};

struct hair_reference_rod_energy {
    double kinetic, elastic, gravity, pull; ///< J. `gravity` is 0 at the world's origin.
    double total;
};

struct hair_reference_rod;

/// Return a description without vertices and loads, with unit frames and poses.
struct hair_reference_rod_desc hair_reference_rod_desc_default(void);
/// Create a rod at rest in the pose of `positions`. Return NULL if a value is out of range or not
/// finite.
struct hair_reference_rod* hair_reference_rod_create(const struct hair_reference_rod_desc* desc);
struct hair_reference_rod* hair_reference_rod_copy(const struct hair_reference_rod* rod);
void hair_reference_rod_destroy(struct hair_reference_rod* rod);

// State -------------------------------------------------------------------------------------------

/// Set positions and velocities. NULL leaves the respective one unchanged. Frames follow their
/// segments by the smallest rotation.
void hair_reference_rod_set_state(struct hair_reference_rod* rod, const double* positions,
                                  const double* velocities);
/// Set gravity and update the clamp's factors.
void hair_reference_rod_set_gravity(struct hair_reference_rod* rod, const double gravity[3]);
void hair_reference_rod_set_damping(struct hair_reference_rod* rod, double damping);
/// Set the wind and the factor of its drag, as in the description.
void hair_reference_rod_set_wind(struct hair_reference_rod* rod, const double wind[3], double drag);
uint32_t hair_reference_rod_vertices(const struct hair_reference_rod* rod);
/// Return the positions of all vertices.
void hair_reference_rod_positions(const struct hair_reference_rod* rod, double* positions);
void hair_reference_rod_velocities(const struct hair_reference_rod* rod, double* velocities);
/// Return the frames of all segments, in the world.
void hair_reference_rod_frames(const struct hair_reference_rod* rod, double* frames);
void hair_reference_rod_masses(const struct hair_reference_rod* rod, double* masses);
/// Return the maximum |length / rest length - 1| of a segment.
double hair_reference_rod_stretch(const struct hair_reference_rod* rod);

struct hair_reference_rod_energy hair_reference_rod_energy_of(const struct hair_reference_rod* rod);
/// Compute the forces of bending and twist per vertex, in N. They are minus the gradient of the
/// elastic energy by the positions.
void hair_reference_rod_elastic_forces(const struct hair_reference_rod* rod, double* forces);
/// Return k1 or k2 for the weight T that hangs on the root segment and the bending stiffness B. The
/// root segment of a long chain at an angle a to the clamp then bears the moment a sqrt(B T), like
/// a continuous rod.
double hair_reference_rod_clamp_factor(double length, double weight, double bend);

// rod_dynamics.cpp --------------------------------------------------------------------------------

/// Advance by `dt` in `substeps` equal parts while the head moves to `head`. NULL keeps the head in
/// place. The head moves evenly along a straight line and turns the shortest way. Return 0 if a
/// substep was too long to preserve the lengths.
int hair_reference_rod_advance(struct hair_reference_rod* rod, const struct hair_reference_rod_pose* head,
                               double dt, uint32_t substeps);
/// Return the longest substep, in s, for which bending and pull are stable in small motion. The
/// result is infinite without bending and pull. Large motion requires half of it.
double hair_reference_rod_longest_substep(const struct hair_reference_rod* rod);

struct hair_reference_rod_report {
    int converged;
    uint32_t substeps; ///< Per frame, of the last run.
    /// Maximum distance between vertices of the last two runs at the end of any frame, m.
    double change;
    /// Binary logarithm of the factor by which the last run reduced `change`. NaN after fewer than
    /// three runs.
    double order;
};

/// Simulate `frames` frames of `dt`, repeatedly with doubled numbers of substeps, until `change` <
/// `tolerance` m. The numbers are at least `substeps` and at most `max`. The head is at heads[k]
/// at the end of frame k. NULL keeps the head in place. `positions`, which may be NULL, receives
/// the positions of the last run per frame and vertex. The rod is left at the end of the last run.
struct hair_reference_rod_report hair_reference_rod_converge(struct hair_reference_rod* rod, uint32_t frames,
                                                             const struct hair_reference_rod_pose* heads,
                                                             double dt, uint32_t substeps, uint32_t max,
                                                             double tolerance, double* positions);

// rod_statics.cpp ---------------------------------------------------------------------------------

struct hair_reference_rod_rested {
    int converged;
    uint32_t iterations;
    /// Maximum torque left on a segment, over the maximum of load times length and B / l.
    double residual;
};

/// Move the rod to rest under gravity and pull, downhill in energy from its pose. Free rods are not
/// supported. A rod in an unstable equilibrium stays there. hair_reference_rod_stability() detects
/// this.
struct hair_reference_rod_rested hair_reference_rod_rest(struct hair_reference_rod* rod);
/// Return the minimum second derivative of the energy at rest by rotations b(s) of the segments,
/// over the integral of |b|^2 ds, in N. The rest is stable if the result is positive. A straight
/// rod without load has B (pi / 2 L)^2, or the same with C if that is less. A rod that can rotate
/// about itself, because it is hinged or has no twist stiffness, has 0.
double hair_reference_rod_stability(const struct hair_reference_rod* rod);
/// Compute the lowest angular frequencies of small motion about rest in ascending order, 1/s. A
/// negative value is the growth rate of an unstable mode. Return the number of frequencies, which
/// is 0 for a free rod.
uint32_t hair_reference_rod_modes(const struct hair_reference_rod* rod, uint32_t count, double* frequencies);

// rod_shape.cpp -----------------------------------------------------------------------------------

/// Compute the strain of the joints in the shape `positions`, in its frame. Frames are carried
/// along the shape from the root frame by the smallest rotation. With this rest strain the shape is
/// at rest without load.
void hair_reference_rod_strain(uint32_t vertices, const double* positions, const double root_frame[4],
                               double* strain);
/// Compute the rest strain and `rest_real` with which `desc`, clamped and not straight, is at rest
/// in its own pose. Their values in `desc` are ignored. Gravity and pull are balanced at every
/// joint, stable or not (hair_reference_rod_stability). `real` is the value of the pose itself.
/// Return 0 if there is no solution.
int hair_reference_rod_hold(const struct hair_reference_rod_desc* desc, double* strain, double* real);

#ifdef __cplusplus
}
#endif

#endif
