// mixed_chain.glsl - displacements of vertices by the turns of the segments between them.
LOCAL(vec3, chain);          // Displacement of vertex i by the turns of segments
// Reaction of colliders on vertex i at the end of the last substep, m/s^2.
LOCAL(vec3, reaction);
LOCAL(vec3, reaction_found); // Reaction that the last Newton step found, m/s^2

// Replace `chain` of every vertex by `start` and the sum of all values before it.
void sum_along(vec3 start)
{
#ifdef HAIR_THREAD_PER_GUIDE
    for (uint k = 0u; k < guide_count; ++k) {
        vec3 v   = chain[k];
        chain[k] = start;
        start += v;
    }
#else
    vec3 sum = lane + 1u < guide_count ? chain : vec3(0.0);
    for (uint reach = 1u; reach < lanes; reach *= 2u) {
        broadcast(sum);
        vec3 more = broadcast_from(lane - reach); // All threads must take part in a shuffle.
        sum += lane >= reach ? more : vec3(0.0);
    }
    broadcast(sum);
    vec3 before = broadcast_from(lane - 1u);
    chain = start + (lane > 0u ? before : vec3(0.0));
#endif
}

// Return the displacement of a free root. It leaves the guide the momentum that external forces
// give it. Forces of segments cancel, and would leave the rounding of stiff ones.
vec3 free_root_moved()
{
    vec3  momentum = vec3(0.0);
    float mass     = 0.0;
    FOR_VERTICES(guide_count) {
        float m = i < guide_count && local(slack) > 0.0 ? 1.0 / local(slack) : 0.0;
        mass += m;
        momentum += m * (local(reached) + of_force * local(reaction_found) - local(chain));
    }
    return vec3(group_sum(momentum.x), group_sum(momentum.y), group_sum(momentum.z)) / group_sum(mass);
}

// Find the displacements of vertices by the turns of segments. Return the root's displacement.
vec3 find_chain()
{
    FOR_VERTICES(guide_count) {
        vec3 then  = along_of(SHARED_READ(section));
        local(chain) = local(rest_length) * change_by(local(turn), then);
#ifdef HAIR_PINNED
        vec3 between = BETWEEN;
        local(chain) += i + 1u < guide_count ? local(rest_length) * then - between : vec3(0.0);
#endif
    }
    vec3 start = root_is_free ? vec3(0.0) : root_moved;
    sum_along(start);
    if (root_is_free) {
        start = free_root_moved();
        FOR_VERTICES(guide_count) { local(chain) += start; }
    }
    return start;
}

#ifdef HAIR_PINNED
// Distribute the remaining errors of held vertices along their spans.
void close_spans()
{
    FOR_VERTICES(guide_count) { PUT(lever, local(slack) == 0.0 ? held_move(i) - GET(moved) : vec3(0.0)); }
    GROUP_BARRIER;
    FOR_VERTICES(guide_count) {
        vec4  s = local(span);
        float far = s.z > 0.0 ? (float(i) - s.x) / max(s.y - s.x, 1.0) : 0.0;
        vec3  from = GET_AT(lever, uint(s.x)), to = GET_AT(lever, uint(s.y));
        vec3  lack = local(slack) == 0.0 ? GET(lever) : s.z > 0.0 ? mix(from, to, far) : vec3(0.0);
        PUT(moved, GET(moved) + lack);
    }
    GROUP_BARRIER;
}
#endif

// Find displacements as sums over the turned segments, and places from the displacements.
void place_vertices()
{
    vec3 start = find_chain(), root_place = GET_AT(place, 0u);
    FOR_VERTICES(guide_count) {
        PUT(moved, local(chain));
        local(chain) = local(rest_length) * along_of(SHARED_READ(tried));
    }
    sum_along(root_place + (start - root_moved));
    FOR_VERTICES(guide_count) { PUT(place, local(chain) - (GET(moved) - root_moved)); }
    GROUP_BARRIER;
#ifdef HAIR_PINNED
    close_spans();
#endif
}
