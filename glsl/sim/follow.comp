// follow.comp - dynamic follow-the-leader (Müller et al. 2012): all substeps of a step for every guide, one pass each.
//
// Each segment is drawn after the one before it, so that lengths are exact. It carries all beyond it, of inertia I
// and centre of mass C about its first vertex, as a rigid body. With d the inertial displacements of its vertices,
// D the displacement of its first one and u = h^2 g + d_0 - D what acts on all beyond it, its direction becomes
//
//   t' ~ t + (d_1 - d_0) / l + h^2 Q a / I + (c u - (u . Q r) Q p) / I,   C = c r + p, p across r
//
// where r is its rest direction and Q the rotation of the segment before it from the rest pose. The stiffness K and
// the rest shape, which bears part of gravity, are in a (lib/sim/follow.c). To normalise t' is to take the pull
// to the direction of rest implicitly, so that any stiffness is stable. A segment feels only those before it: its
// oscillation cannot feed theirs, and the shape at rest follows from the root on, whatever was before.
//
// A solid keeps a vertex above the plane of its contact: the direction is turned until the vertex lies on it, where
// friction holds it if it can. The planes of a substep are the first guess of the next.
//
// Not handled: what moves the tip does not move the root. A segment carries all beyond it, though a solid
// may bear it: a strand whose root is beside a box slides off its top, while one whose root is above it
// stays. Twist follows the rest shape. Bending is that of a round section.
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
#include "sim/ride.glsl"

#ifdef HAIR_WIND
#include "sim/drag.glsl"
#endif
#ifdef HAIR_TIED
#include "sim/tie.glsl"
#include "sim/leader.glsl"
#endif
#include "sim/follow_state.glsl"

#define CONTACT_ROUNDS 3u // of pushing vertices out of solids and drawing the strand again

OWN(vec3, pushed); // by solids, in the last look at them

#include "sim/follow_draw.glsl"

// Find the planes that solids keep vertices above. False: none touches any.
bool meet_solids(vec3 head_moved)
{
    bool touches = false;
    EACH(guide_count) { own(touch) = own(slip) = vec4(0.0); }
    EACH_REACHING {
        if (own(reachable) != BITS(0u)) {
            outcome made = allowed(i, own(wanted), own(reachable), BITS(0u), head_moved, own(met));
            own(touch)   = made.freedom;
            own(slip)    = made.slip;
            own(pushed)  = made.d - own(wanted);
            own(wanted)  = made.d;
            touches      = touches || (i < guide_count && made.freedom.w != FREE);
        }
    }
    EACH(guide_count) {
        bool glides = own(touch).w == GLIDES; // The plane is then across the push by both solids.
        PUT(handed, own(wanted));
        PUT(edge, glides ? direction_or(own(pushed), vec3(0.0, 1.0, 0.0)) : own(touch).xyz);
    }
    return any_of(bvec2(touches, false)).x;
}

void attempt_all(vec3 head_moved)
{
    predict();
    draw(false);
    if (SOLIDS) {
        EACH(guide_count) { own(wanted) = GET(handed); }
        find_solids(head_moved);
        list_reaching();
        for (uint n = 0u; n < CONTACT_ROUNDS && meet_solids(head_moved); ++n) {
            draw(true);
            EACH(guide_count) { own(wanted) = GET(handed); }
        }
    }
#ifdef HAIR_TIED
    if (any_of(bvec2(taut, false)).x) count_in(HAIR_HEALTH_TAUT);
#endif
    finish(head_moved);
}

#include "sim/substeps.glsl"

void main()
{
    guide_number = hair_guide_number();
    if (guide_number < params.guides) solve();
}
