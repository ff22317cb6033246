// follow_the_leader.glsl - follow-the-leader. It always restores lengths, but not by the laws of
// motion.
#define HEAVY_ROUNDS 6u
#define PINNED_ROUNDS 8u

// Place vertex k at its length from its leader, in its present direction from there. If that
// direction is undefined, use the last one.
void draw_along(uint k, uint leader, float len, inout vec3 last)
{
    vec3  moved_leader = GET_AT(moved, leader), between = GET_AT(place, k) - GET_AT(place, leader);
    vec3  to = between + (GET_AT(moved, k) - moved_leader);
    float l  = length(to);
    if (bits_of(l) < 0x7f800000u && l > 1e-3 * len) last = to / l;
    PUT_AT(moved, k, moved_leader - between + len * last);
}

float length_of(uint k) { return rod_segment(guide_first + k).x; }

// Draw the vertices from `from` to `to`, each after the one before it (Mueller et al. 2012). `from`
// is already at its place.
void draw_on(uint from, uint to, float more, inout vec3 last)
{
    for (uint k = from + 1u; k <= to; ++k) draw_along(k, k - 1u, more * length_of(k - 1u), last);
}

void draw_back(uint from, uint to, float more, inout vec3 last)
{
    for (uint k = from; k-- > to;) draw_along(k, k + 1u, more * length_of(k), last);
}

#ifdef HAIR_PINNED

// Draw a span between two held vertices from both ends in turn (Aristidou and Lasenby 2011).
// Distribute the remaining error of the far end along the span.
void draw_span(vec4 span, inout vec3 last)
{
    uint  from = uint(span.x), to = uint(span.y);
    vec3  goal = GET_AT(moved, to);
    float more = given(span, (GET_AT(place, to) - GET_AT(place, from)) + (goal - GET_AT(moved, from))),
          done = 0.0;
    for (uint n = 0u; n < PINNED_ROUNDS; ++n) {
        draw_on(from, to, more, last);
        PUT_AT(moved, to, goal);
        draw_back(to, from + 1u, more, last);
    }
    draw_on(from, to, more, last);
    vec3 lacks = goal - GET_AT(moved, to);
    for (uint k = from + 1u; k <= to; ++k) {
        done += length_of(k - 1u);
        vec3 at = GET_AT(moved, k) + (done / span.z) * lacks;
        PUT_AT(moved, k, k == to ? goal : at);
    }
}

void draw_strand()
{
    float number = pin_beyond(guide_first);
    vec3  last   = clamp_way;
    uint  from   = 0u;
    for (bool more = number > 0.0; more; number += 1.0) {
        vec4 span = pin_span(number);
        if (span.z > 0.0) draw_span(span, last);
        else draw_back(uint(span.y), 0u, 1.0, last); // The root is free.
        from = uint(span.y);
        more = span.w > 0.0;
    }
    draw_on(from, guide_count - 1u, 1.0, last);
}

#else

// Draw the strand. A strand must not throw a tip that outweighs it about. The strand of such a tip
// is first drawn from both ends in turn (Aristidou and Lasenby 2011).
void draw_strand()
{
    uint tip  = guide_count - 1u, rounds = heavy ? HEAVY_ROUNDS : 0u;
    vec3 goal = GET_AT(moved, tip), last = clamp_way;
    for (uint n = 0u;; ++n) {
        draw_on(0u, tip, 1.0, last);
        if (n == rounds) break;
        PUT_AT(moved, tip, goal);
        draw_back(tip, 1u, 1.0, last);
    }
}

#endif

// Draw the strand towards `moved`, as colliders allow it, and take the result as `wanted`.
void follow_leader()
{
    FOR_VERTICES(guide_count) {
        if (COLLIDERS) local(touch) = vec4(0.0);
    }
    GROUP_BARRIER;
    SINGLE_THREAD { draw_strand(); }
    GROUP_BARRIER;
    RELOAD(moved)
    FOR_VERTICES(guide_count) { local(wanted) = GET(moved); }
}
