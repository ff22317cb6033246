// accept_impulses.glsl - the impulses of colliders in a substep that is accepted.
//
// A force f moves a vertex of mass m by of_force f / m beyond the way that its past gives, for
// methods with damping c and pull w times 1 / (1 + b c h + b^2 h^2 w^2). A push of a collider
// stands for such a force, whose impulse is h f. SHAKE has guide_kick in place of of_force.
//
// The momentum of BDF2 is m (3/2 v - 1/2 v'), with v' the velocity a substep before. All forces
// change it by h f. Velocities that velocity_history.glsl replaces in contact change it too. The
// sum of these changes over a guide is an impulse of the colliders that the guide touches, or of
// those that it touched in the substep before.

#ifdef KEEPS_RATES
// h times the change of velocity of vertex i that no force explains
LOCAL(vec3, lapse);

// Return h times the momentum of vertex i by its mass.
vec3 momentum_of(uint i)
{
    return known < 2.0 ? local(displacement) : 1.5 * local(rate) - 0.5 * spilled(rate_before);
}

bool has_lapse(int method) { return !IS_SHAKE(method) && !IS_LEADER(method); }

// Begin the lapse of vertex i with its past, before the displacement d is accepted.
void begin_lapse(uint i, int method, vec3 d)
{
    bool back = IS_BACK(method), leaps = LEAPS(method);
    vec3 hv = known < 2.0 ? local(displacement)
              : back      ? (4.0 * local(rate) - spilled(rate_before)) / 3.0
                          : local(rate);
    vec3 free = back && !leaps ? local(displacement) / 3.0 + 2.0 / 3.0 * hv : hv;
    local(lapse) = -momentum_of(i) - SUBSTEP * SUBSTEP / of_force * (d - free);
}

// Add the lapses of the guide to the impulses of vertices that touch, by the lengths of their
// pushes, or to those that touched before.
void accept_lapses()
{
    vec3  sum = vec3(0.0);
    float pushed = 0.0, before = 0.0;
    FOR_VERTICES(guide_count) {
        if (i < guide_count && local(slack) > 0.0) {
            sum += (local(lapse) + momentum_of(i)) / local(slack);
            pushed += local(push_one).w > 0.0 ? length(local(push_one).xyz + local(push_two).xyz) : 0.0;
            before += local(last_touch) > 0.0 ? 1.0 : 0.0;
        }
    }
    sum    = vec3(group_sum(sum.x), group_sum(sum.y), group_sum(sum.z));
    pushed = group_sum(pushed);
    before = group_sum(before);
    FOR_VERTICES(guide_count) {
        float own = length(local(push_one).xyz + local(push_two).xyz);
        float name = pushed > 0.0 ? local(push_one).w : local(last_touch),
              fraction = pushed > 0.0 ? own / pushed : 1.0 / before;
        if (i < guide_count && local(slack) > 0.0 && name > 0.0)
            add_impulse(i, name, fraction / SUBSTEP * sum, vec3(0.0));
    }
}
#else
void begin_lapse(uint i, int method, vec3 d) {}
#endif

// Add the impulses of a substep by `method`.
void accept_impulses(int method)
{
    float h = SUBSTEP, b = IS_SHAKE(method) ? 0.0 : IS_BACK(method) ? 2.0 / 3.0 : 1.0;
#ifdef KEEPS_RATES
    if (has_lapse(method)) accept_lapses();
#endif
    FOR_VERTICES(guide_count) {
        float massive = 1.0 + b * guide_damping * h + b * b * h * h * local(aim).w;
        if (i < guide_count && local(slack) > 0.0) {
            float by = massive * h / (IS_SHAKE(method) ? part_kick : of_force) / local(slack);
            add_impulse(i, local(push_one).w, by * local(push_one).xyz, by * local(normal_one));
            add_impulse(i, local(push_two).w, by * local(push_two).xyz, by * local(normal_two));
        }
        local(last_touch) = local(push_one).w;
    }
}
