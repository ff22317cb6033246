// follow.comp - dynamic follow-the-leader (Mueller et al. 2012). A dispatch does all substeps of a
// step for every guide, each in one pass.
//
// Each segment is drawn after the one before it, so that lengths are exact. A segment carries all
// vertices beyond it as a rigid body of inertia I and centre of mass C about its first vertex. Let
// l be its length, d_0 and d_1 the inertial displacements of its vertices, and D the displacement
// of its first vertex. u = h^2 g + d_0 - D is the displacement that acts on all vertices beyond.
// The direction t of the segment becomes
//
//   t' ~ t + (d_1 - d_0) / l + h^2 Q a / I + (c u - (u . Q r) Q p) / I,   C = c r + p, p across r
//
// r is the rest direction, and Q the rotation of the segment before it from the rest pose. a
// contains the stiffness K and the rest shape, which bears part of gravity
// (lib/rod/follow_segments.c). Normalising t' makes the pull to the rest direction implicit, so
// that any stiffness is stable. A segment is affected only by the segments before it. Its
// oscillation cannot feed theirs. The shape at rest follows from the root on, whatever came before.
//
// A collider keeps a vertex above the plane of its contact. The direction is turned until the
// vertex lies on the plane, where friction holds the vertex if it can. The planes of a substep are
// the first guess of the next one.
//
// Not handled: Motion of the tip does not move the root. A segment carries all vertices beyond it,
// although a collider may support them. A strand whose root is beside a box therefore slides off
// its top. A strand whose root is above the box stays. Twist follows the rest shape. Bending is
// that of a round section.
#version 450 core
#ifdef HAIR_SUBGROUP
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#endif
#include "sim/rod.glsl"
layout(local_size_x = GROUP_THREADS) in;
#include "sim/contact.glsl"
#include "sim/root_transforms.glsl"

#ifdef HAIR_WIND
#include "sim/drag.glsl"
#endif
#ifdef HAIR_PINNED
#include "sim/pins.glsl"
#include "sim/follow_the_leader.glsl"
#endif
#include "sim/follow_state.glsl"

// Number of rounds that push vertices out of colliders and draw the strand again.
#define CONTACT_ROUNDS 3u

LOCAL(vec3, pushed); // Displacement by colliders in the last round

#include "sim/follow_draw.glsl"

// Find the planes above which colliders keep vertices. Return false if no vertex touches a
// collider.
bool resolve_contact(vec3 head_moved)
{
    bool touches = false;
    FOR_VERTICES(guide_count) { local(touch) = local(slip) = vec4(0.0); }
    EACH_REACHING {
        if (local(reachable) != BITS(0u)) {
            outcome made = allowed(i, local(wanted), local(reachable), BITS(0u), head_moved, local(met));
            local(touch)   = made.freedom;
            local(slip)    = made.slip;
            local(pushed)  = made.d - local(wanted);
            local(wanted)  = made.d;
            touches      = touches || (i < guide_count && made.freedom.w != FREE);
        }
    }
    FOR_VERTICES(guide_count) {
        // The plane is then normal to the push of both colliders together.
        bool glides = local(touch).w == GLIDES;
        PUT(handed, local(wanted));
        PUT(edge, glides ? direction_or(local(pushed), vec3(0.0, 1.0, 0.0)) : local(touch).xyz);
    }
    return group_any(bvec2(touches, false)).x;
}

void attempt_all(vec3 head_moved)
{
    predict();
    draw(false);
    if (COLLIDERS) {
        FOR_VERTICES(guide_count) { local(wanted) = GET(handed); }
        find_colliders(head_moved);
        list_reaching();
        for (uint n = 0u; n < CONTACT_ROUNDS && resolve_contact(head_moved); ++n) {
            draw(true);
            FOR_VERTICES(guide_count) { local(wanted) = GET(handed); }
        }
    }
#ifdef HAIR_PINNED
    if (group_any(bvec2(taut, false)).x) count_in(HAIR_SOLVER_STATS_OVEREXTENDED);
#endif
    finish(head_moved);
}

#include "sim/substeps.glsl"
#include "sim/guide_level.glsl"

void main()
{
    uint k = hair_guide_number();
    if (k < params.simulated) {
        guide_number = simulated_guide(k);
        solve();
    }
}
