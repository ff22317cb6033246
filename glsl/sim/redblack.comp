// redblack.comp - the solver of Tariq 2010, "Hair". It applies external and angular forces and
// Verlet integration. It then iterates red/black distance, angular and collision constraints. A
// work group has a guide, and a thread has a vertex. The whole strand is in shared memory. A
// dispatch does all substeps of a step.
//
// Positions are relative to the head's origin, which moves by D over a substep: x' = x + keep d + g
// dt^2 - D. The displacement d is in the world, and is kept beside the positions. The velocity is d
// / dt.
//
// A pull to a target with angular frequency w is implicit: p = (p + (w dt)^2 target) / (1 + (w
// dt)^2). No frequency is therefore unstable at any substep.
//
// The angular force has a potential, which sim/angular.glsl explains. Not handled: convergence,
// friction, twist.
#version 450 core
#include "sim/buffers.glsl"
layout(local_size_x = HAIR_GUIDE_THREADS) in;
#include "rotation.glsl"
#include "sim/constraints.glsl"
#include "sim/angular.glsl"
#include "sim/root_transforms.glsl"

shared uint broken;
// Angular_moves of each vertex.
shared vec3 move_end[HAIR_GUIDE_THREADS], move_couple[HAIR_GUIDE_THREADS];

vec3 pull(vec3 position, vec3 target, float frequency_squared, float dt)
{
    float k = frequency_squared * dt * dt;
    return position + (target - position) * (k / (1.0 + k));
}

// Return whether v is finite. The test is by bits, because compilers may remove comparisons with
// NaN.
bool is_finite(vec3 v)
{
    return all(notEqual(floatBitsToUint(v) & 0x7f800000u, uvec3(0x7f800000u)));
}

void main()
{
    uint g = hair_group();
    if (g >= params.guides) return;
    uint i      = gl_LocalInvocationID.x;
    uint first  = guide[g].first;
    uint count  = guide[g].count;
    bool here   = i < count;
    bool pinned = i < 2u;
    uint own    = first + min(i, count - 1u);

    hair_rest at_rest      = rest[own];
    vec3      x            = state[own].position.xyz;
    vec3      displacement = state[own].displacement.xyz;
    float     dt           = params.gravity.w;
    float     fraction        = float(i) / float(count - 1u);
    float     frequency    = mix(params.shape_frequency_root, params.shape_frequency_tip, fraction);
    // Rest links before vertex i and before vertex i-1.
    vec3 before = rest[first + max(min(i, count - 1u), 1u) - 1u].position.xyz,
         next = at_rest.position.xyz - before;
    vec3 link   = before - rest[first + max(min(i, count - 1u), 2u) - 2u].position.xyz;
    if (i == 0u) broken = 0u;
    synchronise();

    for (uint s = 0u; s < params.substeps; ++s) {
        vec4 rotation = params.substep[s].rotation;
        vec3 head     = params.substep[s].displacement.xyz;
        vec3 target   = rotate(rotation, at_rest.position.xyz);
        vec3 start    = x;
#ifdef HAIR_SKINNED
        root_transform r   = root_transform_at(g, params.substep[s].displacement.w);
        target   = rotate(rotation, carry(r, rest[first].position.xyz, at_rest.position.xyz));
        rotation = quat_multiply(rotation, r.turn);
#endif

        vec3 p = x - head + params.keep * displacement + params.gravity.xyz * (dt * dt);
        p      = pull(p, target, frequency * frequency, dt);
        if (pinned) p = target;
        synchronise();
        vertex[i] = here ? p : vec3(0.0);

        if (params.angular > 0.0) {
            synchronise();
            angular_moves moves = angular_moves(vec3(0.0), vec3(0.0));
            if (here && !pinned)
                moves = angular_force(rotation, vertex[i - 2u], vertex[i - 1u], p, link, next,
                                      params.angular * dt * dt);
            move_end[i]    = moves.end;
            move_couple[i] = moves.couple;
            synchronise();
            if (here && !pinned) {
                vec3 moved = moves.end;
                if (i + 1u < count) moved -= move_end[i + 1u] + move_couple[i + 1u];
                if (i + 2u < count) moved += move_couple[i + 2u];
                vertex[i] = p + moved;
            }
        }
        synchronise();

        float time   = params.substep[s].displacement.w;
        uvec2 colliders = here && !pinned ? find_colliders(vertex[i], time) : uvec2(0u);
        for (uint n = 0u; n < params.iterations; ++n) {
            relax_distance(i, count, 0u, first);
            synchronise();
            relax_distance(i, count, 1u, first);
            synchronise();
            if (params.bend > 0.0) {
                relax_bend(i, count, 0u, first, params.bend);
                synchronise();
                relax_bend(i, count, 1u, first, params.bend);
                synchronise();
            }
            if (params.colliders > 0u) {
                if (here && !pinned) vertex[i] = collide(vertex[i], colliders, time);
                synchronise();
            }
        }

        x            = vertex[i];
        displacement = x - start + head;
        // A strand that is not finite, or is farther away than any hair, returns to its rest pose.
        // It moves with the head unless the head's own motion is too large.
        if (here && (!is_finite(x) || !is_finite(displacement) || dot(x, x) > 1e8 ||
                     dot(displacement, displacement) > 1e8))
            broken = 1u;
        synchronise();
        if (broken != 0u) {
            x            = target;
            displacement = dot(head, head) < 1e8 ? head : vec3(0.0);
        }
        synchronise();
        if (i == 0u && broken != 0u) {
            atomicAdd(solver_stats[HAIR_SOLVER_STATS_RESET], 1u);
            broken = 0u;
        }
    }

    if (here) {
        state[own].position     = vec4(x, 0.0);
        state[own].displacement = vec4(displacement, 0.0);
    }
}
