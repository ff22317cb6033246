// redblack.comp - the solver of Tariq 2010, "Hair": external and angular forces, Verlet integration, then
// iterations of red/black distance, angular and collision constraints. One work group per guide, one thread per
// vertex, the whole strand in shared memory, all substeps of a step.
//
// Positions are from the head's origin, which moves by D over a substep: x' = x + keep d + g dt^2 - D. The
// displacement d, in the world, is kept beside them (the velocity is d / dt).
//
// A force that pulls to a target with angular frequency w is taken implicitly, p = (p + (w dt)^2 target) / (1 +
// (w dt)^2), so that no frequency is unstable at any substep.
//
// Not handled: convergence (use another solver for that); friction; twist.
#version 450 core
#include "buffers.glsl"
layout(local_size_x = HAIR_GUIDE_THREADS) in;
#include "frames.glsl"
#include "constraints.glsl"
#include "sim/ride.glsl"

shared uint broken;

vec3 pull(vec3 position, vec3 target, float frequency_squared, float dt)
{
    float k = frequency_squared * dt * dt;
    return position + (target - position) * (k / (1.0 + k));
}

// By the bits: comparisons with NaN may be compiled away.
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
    float     share        = float(i) / float(count - 1u);
    float     frequency    = mix(params.pull_root, params.pull_tip, share);
    if (i == 0u) broken = 0u;
    synchronise();

    for (uint s = 0u; s < params.substeps; ++s) {
        vec4 rotation = params.substep[s].rotation;
        vec3 head     = params.substep[s].displacement.xyz;
        vec3 target   = rotate(rotation, at_rest.position.xyz);
        vec3 before   = x;
#ifdef HAIR_SKINNED
        ride r   = ride_at(g, params.substep[s].displacement.w);
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
            vec3 link = i + 1u < count ? vertex[i + 1u] - vertex[i] : vec3(0.0);
            carry_frames(i, count - 1u, direction_or(link, vec3(0.0, 1.0, 0.0)),
                         quat_multiply(rotation, guide[g].root_frame));
            vec3 aimed = p;
            if (here && !pinned)
                aimed = vertex[i - 1u] +
                        rest[own - 1u].position.w * rotate(scan_frame[i - 2u], rest[own - 1u].direction.xyz);
            synchronise();
            if (here && !pinned) vertex[i] = pull(p, aimed, params.angular, dt);
        }
        synchronise();

        float time   = params.substep[s].displacement.w;
        uvec2 solids = here && !pinned ? find_solids(vertex[i], time) : uvec2(0u);
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
            if (params.solids > 0u) {
                if (here && !pinned) vertex[i] = collide(vertex[i], solids, time);
                synchronise();
            }
        }

        x            = vertex[i];
        displacement = x - before + head;
        // A strand that is not finite, or far beyond any hair, goes back to its rest pose, and along with the head
        // unless that was what went too far.
        if (here && (!is_finite(x) || !is_finite(displacement) || dot(x, x) > 1e8 || dot(displacement, displacement) > 1e8))
            broken = 1u;
        synchronise();
        if (broken != 0u) {
            x            = target;
            displacement = dot(head, head) < 1e8 ? head : vec3(0.0);
        }
        synchronise();
        if (i == 0u && broken != 0u) {
            atomicAdd(health[HAIR_HEALTH_RESET], 1u);
            broken = 0u;
        }
    }

    if (here) {
        state[own].position     = vec4(x, 0.0);
        state[own].displacement = vec4(displacement, 0.0);
    }
}
