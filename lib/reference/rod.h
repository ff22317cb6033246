/// rod.h - one strand as a chain of rigid segments that resist bending and twist, in double precision: what
/// the solvers are compared with.
///
/// Vertices 0 (root) to N-1 (tip); segment j, of fixed length l_j, from vertex j to j+1, with a frame q_j
/// whose y is along it. A joint i, 0 to N-2, lies at vertex i, between segments i-1 and i; at joint 0 the
/// scalp is segment -1, with the root frame. With (w, v) = conj(q_{i-1}) q_i, sign chosen so that w >= 0, the
/// strain of a joint is u = 2 v: by length 2 sin(half the angle). With rest strain U its energy is
///
///   1 / (2 l_i) [B1 (u - U)_x^2 + C (u - U)_y^2 + B2 (u - U)_z^2 + B2 (2 w - 2 w0)^2],
///
/// l_i = (l_{i-1} + l_i) / 2, at the clamp
///
///   1 / (2 l_0) [k1 B1 (..)_x^2 + 2 C (..)_y^2 + k2 B2 (..)_z^2 + k2 B2 (..)^2],
///
/// k1 and k2 being of hair_reference_rod_clamp_factor(). The last term makes the energy grow with the angle
/// from the rest shape up to half a turn, however bent the joint is at rest. The angles of the frames about
/// their segments have no inertia: they minimise the energy at every moment.
///
/// Vectors are xyz, quaternions xyzw; SI units. Positions are in the world where not in the head's frame.
#ifndef HAIR_REFERENCE_ROD_H
#define HAIR_REFERENCE_ROD_H

#include <stdint.h>

#include "lib/reference/drag.h"

#ifdef __cplusplus
extern "C" {
#endif

#define HAIR_REFERENCE_ROD_MOST_VERTICES 256

enum hair_reference_rod_root {
    HAIR_REFERENCE_ROD_CLAMPED, ///< Vertex 0 goes with the head, joint 0 ties segment 0 to the root frame.
    HAIR_REFERENCE_ROD_HINGED, ///< Vertex 0 goes with the head, there is no joint 0.
    HAIR_REFERENCE_ROD_FREE ///< Nothing holds vertex 0.
};

struct hair_reference_rod_pose {
    double position[3];
    double rotation[4];
};

/// Arrays are copied. Start from hair_reference_rod_desc_default().
struct hair_reference_rod_desc {
    uint32_t vertices; ///< [2, 256].
    const double* positions; ///< Per vertex, in the head's frame. NULL: straight along the root frame from 0.
    const double* lengths; ///< Per segment. NULL: as `positions` has them.

    double line_density; ///< Mass per length, rho A. kg/m. Vertices have half of each segment they end.
    const double* masses; ///< Per vertex, instead of line_density. kg.
    double tip_mass; ///< On top, at the tip. kg.

    double bend[2]; ///< B1 and B2: about the frame's x and z. N m^2.
    double twist; ///< C. N m^2.
    const double* scale; ///< Per vertex, of all three. NULL: 1.
    const double* rest_strain; ///< U, of vertices - 1 joints. NULL: 0.
    const double* rest_real; ///< 2 w0, of vertices - 1 joints. NULL: (4 - |U|^2)^(1/2), 0 if |U| > 2.
    int straight; ///< 1: u is the difference of the unit tangents, B1 alone, no frames, U = 0.

    enum hair_reference_rod_root root;
    double root_frame[4]; ///< In the head's frame: y is where the strand leaves the scalp.
    int plain_clamp; ///< 1: k = 2 whatever hangs on the clamp.

    double gravity[3]; ///< m/s^2.
    double damping; ///< c of dv/dt = -c (v - wind). 1/s.
    double wind[3]; ///< m/s.
    double drag; ///< Of the segments, as a multiple of hair_reference_drag. 0: none.
    double diameter; ///< For that. m.
    struct hair_reference_air air; ///< Likewise.

    const double* pull; ///< Angular frequency per vertex of a spring to `pull_target`. NULL: none. 1/s.
    const double* pull_target; ///< Per vertex, in the head's frame. NULL: `positions`.

    struct hair_reference_rod_pose head; ///< At the start.
};

struct hair_reference_rod_energy {
    double kinetic, elastic, gravity, pull; ///< J. gravity: 0 at the world's origin.
    double total;
};

struct hair_reference_rod;

/// No vertices, no loads; unit frames and poses.
struct hair_reference_rod_desc hair_reference_rod_desc_default(void);
/// Without velocity, in the pose of `positions`. NULL when a value is out of range or not finite.
struct hair_reference_rod* hair_reference_rod_create(const struct hair_reference_rod_desc* desc);
struct hair_reference_rod* hair_reference_rod_copy(const struct hair_reference_rod* rod);
void hair_reference_rod_destroy(struct hair_reference_rod* rod);

// State -----------------------------------------------------------------------------------------------------

/// Either may be NULL: then it stays. Frames follow their segments by the least rotation.
void hair_reference_rod_set_state(struct hair_reference_rod* rod, const double* positions,
                                  const double* velocities);
/// The clamp's factors follow.
void hair_reference_rod_set_gravity(struct hair_reference_rod* rod, const double gravity[3]);
void hair_reference_rod_set_damping(struct hair_reference_rod* rod, double damping);
uint32_t hair_reference_rod_vertices(const struct hair_reference_rod* rod);
void hair_reference_rod_positions(const struct hair_reference_rod* rod, double* positions);
void hair_reference_rod_velocities(const struct hair_reference_rod* rod, double* velocities);
/// Per segment, in the world.
void hair_reference_rod_frames(const struct hair_reference_rod* rod, double* frames);
void hair_reference_rod_masses(const struct hair_reference_rod* rod, double* masses);
/// Largest |length / rest length - 1| of a segment.
double hair_reference_rod_stretch(const struct hair_reference_rod* rod);

struct hair_reference_rod_energy hair_reference_rod_energy(const struct hair_reference_rod* rod);
/// Of bending and twist, per vertex, N: minus the gradient of the elastic energy by the positions.
void hair_reference_rod_elastic_forces(const struct hair_reference_rod* rod, double* forces);
/// k1 and k2, given the weight that hangs on the root segment. Under the tension T = `weight` the root segment
/// of a long chain at an angle a to the clamp then bears the moment a sqrt(B T), as a continuous rod does.
double hair_reference_rod_clamp_factor(double length, double weight, double bend);

// rod_dynamics.cpp ------------------------------------------------------------------------------------------

/// `dt` in `substeps` equal parts, while the head goes to `head` (NULL: stays), evenly along the straight line
/// and turning the shortest way. Returns 0 when a substep was too long for the lengths to be kept.
int hair_reference_rod_advance(struct hair_reference_rod* rod, const struct hair_reference_rod_pose* head,
                               double dt, uint32_t substeps);
/// The longest substep for which bending and pull are sure to be stable in small motion, s; infinite without
/// them. In large motion half of it is.
double hair_reference_rod_longest_substep(const struct hair_reference_rod* rod);

struct hair_reference_rod_report {
    int converged;
    uint32_t substeps; ///< Per frame, of the last run.
    double change; ///< Farthest that a vertex was from where it was with half, at any frame's end. m.
    double order; ///< log2 of how much less that was than the time before. NaN of fewer than three runs.
};

/// `frames` frames of `dt`, the head at heads[k] (NULL: stays) at the end of frame k, with ever twice as many
/// substeps, at least `substeps` and at most `most`, until `change` < `tolerance` m. `positions`: per frame and
/// vertex, of the last run; may be NULL. The rod is left at the end of the last run.
struct hair_reference_rod_report hair_reference_rod_converge(struct hair_reference_rod* rod, uint32_t frames,
                                                             const struct hair_reference_rod_pose* heads,
                                                             double dt, uint32_t substeps, uint32_t most,
                                                             double tolerance, double* positions);

// rod_statics.cpp -------------------------------------------------------------------------------------------

struct hair_reference_rod_rested {
    int converged;
    uint32_t iterations;
    double residual; ///< Largest torque left on a segment, over the largest of load times length and B / l.
};

/// To rest under gravity and pull, downhill in energy from the pose it has. Not of free rods.
/// What is balanced on an edge stays there: hair_reference_rod_stability() tells.
struct hair_reference_rod_rested hair_reference_rod_rest(struct hair_reference_rod* rod);
/// At rest: the least of the second derivatives of the energy by turns b(s) of the segments over the integral
/// of |b|^2 ds, N. Stable when positive. A straight rod without load has B (pi / 2 L)^2, or that of C if it is
/// less. One that can turn about itself, for it is hinged or has no twist, has 0.
double hair_reference_rod_stability(const struct hair_reference_rod* rod);
/// The lowest angular frequencies of small motion about rest, rising, 1/s; negative: of the growth of what is
/// unstable. Returns how many; of a free rod none.
uint32_t hair_reference_rod_modes(const struct hair_reference_rod* rod, uint32_t count, double* frequencies);

// rod_shape.cpp ---------------------------------------------------------------------------------------------

/// The strain of the joints in the shape `positions`, in its frame, when frames are carried along it from
/// the root frame by the least rotation: with this as rest strain the shape is that without load.
void hair_reference_rod_strain(uint32_t vertices, const double* positions, const double root_frame[4],
                               double* strain);
/// Find the rest strain and `rest_real` with which `desc`, clamped and not straight, is at rest in its own
/// pose, whatever those of `desc` are. Gravity and pull are in balance at every joint, stable or not
/// (hair_reference_rod_stability). `real` is that of the pose itself. Return 0 when there are none.
int hair_reference_rod_hold(const struct hair_reference_rod_desc* desc, double* strain, double* real);

#ifdef __cplusplus
}
#endif

#endif
