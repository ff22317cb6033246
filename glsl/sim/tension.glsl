// tension.glsl - the tension of the last substep, applied in advance as a force.

// Return the fraction of the last substep's tension that is applied in advance. pull_on() applies
// the tension along the directions that segments will have if they continue their motion.
// fit_lengths() finds the rest along the resulting directions.
//
// Tension applied in advance feeds transverse oscillations of frequency w. The tension from
// fit_lengths() damps them. Half of each does not feed them up to w h = 3, and damps them by (w
// h)^4 / 100 per substep. fit_lengths() alone feeds them from w h = 1.6 on, and damps them by (w
// h)^4 / 5. The whole tension in advance is right to a higher order, and keeps a strand at rest
// where its forces balance. The whole tension feeds oscillations soonest, and lets vertices creep
// that friction holds. It is therefore applied where a strand oscillates slowly, and if the strand
// touches a collider, only to vertices that move.
//
// The frequency is that of waves of tension as short as those of bending, tension /
// sqrt(stiffness). Bending itself is implicit.
float guessed_part(uint i, float stiffness, bool touches)
{
    float h = params.gravity.w, w = abs(local(tension)) * inversesqrt(max(stiffness, 1e-20)),
          d = length(local(displacement) - root_moved),
          still = touches ? 1.0 - smoothstep(STILL * h, MOVING * h, d) : 0.0;
    return mix(1.0, GUESSED, max(smoothstep(SLOW, FAST, w * h), still));
}

void pull_on()
{
    bool touches = false;
    FOR_VERTICES(guide_count) {
        PUT(moved, local(slack) == 0.0 ? held_move(i) : local(displacement));
        touches = touches || (COLLIDERS && i < guide_count && local(touched) > 0.0);
    }
    GROUP_BARRIER;
    if (COLLIDERS) touches = group_any(bvec2(touches, false)).x;
    FOR_VERTICES(guide_count - 1u) {
        vec3  to = BETWEEN + (AFTER_VEC3(moved) - GET(moved));
        float stiffness = local(strain).w * local(rest_length) * min(params.ratio.x, params.ratio.z);
        // Bending that is implicit bears what would be too much for a chain.
        float max_value =
            max(MAX_GUESSED * local(rest_length) * local(rest_length) / of_force, sqrt(stiffness / of_force));
        // An impact leaves no tension.
        local(tension) = known < 2.0 ? 0.0
                                     : clamp(guessed_part(i, stiffness, touches) * local(tension), -max_value,
                                             max_value);
        PUT(handed, GET(handed) + local(tension) / max(length(to), 1e-9) * to);
    }
    GROUP_BARRIER;
}
