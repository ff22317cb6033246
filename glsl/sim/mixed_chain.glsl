// mixed_chain.glsl - displacements of vertices by the turns of the segments between them.
OWN(vec3, chain);          // Displacement of vertex i by the turns of segments
// Reaction of colliders on vertex i at the end of the last substep, m/s^2.
OWN(vec3, reaction);
OWN(vec3, reaction_found); // Reaction that the last Newton step found, m/s^2

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
        lend(sum);
        vec3 more = lent_by(lane - reach); // All threads must take part in a shuffle.
        sum += lane >= reach ? more : vec3(0.0);
    }
    lend(sum);
    vec3 before = lent_by(lane - 1u);
    chain = start + (lane > 0u ? before : vec3(0.0));
#endif
}

// Return the displacement of a free root. It leaves the guide the momentum that external forces
// give it. Forces of segments cancel, and would leave the rounding of stiff ones.
vec3 free_root_moved()
{
    vec3  momentum = vec3(0.0);
    float mass     = 0.0;
    EACH(guide_count) {
        float m = i < guide_count && own(slack) > 0.0 ? 1.0 / own(slack) : 0.0;
        mass += m;
        momentum += m * (own(reached) + of_force * own(reaction_found) - own(chain));
    }
    return vec3(sum_of(momentum.x), sum_of(momentum.y), sum_of(momentum.z)) / sum_of(mass);
}

// Find the displacements of vertices by the turns of segments. Return the root's displacement.
vec3 find_chain()
{
    EACH(guide_count) {
        vec3 then  = along_of(seen(section));
        own(chain) = own(rest_length) * change_by(own(turn), then);
#ifdef HAIR_PINNED
        vec3 between = BETWEEN;
        own(chain) += i + 1u < guide_count ? own(rest_length) * then - between : vec3(0.0);
#endif
    }
    vec3 start = root_is_free ? vec3(0.0) : root_moved;
    sum_along(start);
    if (root_is_free) {
        start = free_root_moved();
        EACH(guide_count) { own(chain) += start; }
    }
    return start;
}

#ifdef HAIR_PINNED
// Distribute the remaining errors of held vertices along their spans.
void close_spans()
{
    EACH(guide_count) { PUT(lever, own(slack) == 0.0 ? held_move(i) - GET(moved) : vec3(0.0)); }
    MEET;
    EACH(guide_count) {
        vec4  s = own(span);
        float far = s.z > 0.0 ? (float(i) - s.x) / max(s.y - s.x, 1.0) : 0.0;
        vec3  from = GET_AT(lever, uint(s.x)), to = GET_AT(lever, uint(s.y));
        vec3  lack = own(slack) == 0.0 ? GET(lever) : s.z > 0.0 ? mix(from, to, far) : vec3(0.0);
        PUT(moved, GET(moved) + lack);
    }
    MEET;
}
#endif

// Find displacements as sums over the turned segments, and places from the displacements.
void place_vertices()
{
    vec3 start = find_chain(), root_place = GET_AT(place, 0u);
    EACH(guide_count) {
        PUT(moved, own(chain));
        own(chain) = own(rest_length) * along_of(seen(tried));
    }
    sum_along(root_place + (start - root_moved));
    EACH(guide_count) { PUT(place, own(chain) - (GET(moved) - root_moved)); }
    MEET;
#ifdef HAIR_PINNED
    close_spans();
#endif
}
