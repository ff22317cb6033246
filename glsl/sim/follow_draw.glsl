// follow_draw.glsl - draw a strand after its root, segment by segment, as follow.comp explains.
bool is_direction(vec3 to, float len)
{
    float l = length(to);
    return bits_of(l) < 0x7f800000u && l > 1e-3 * len;
}

// Compute where vertices go by inertia, wind, the pull to the rest pose and the hair around them.
void predict()
{
    float h   = params.gravity.w;
    clamp_way = rotate(turn_now, clamp_at_rest);
#ifdef HAIR_WIND
    FOR_VERTICES(guide_count) { PUT(moved, vec3(0.0)); }
    find_edges();
    GROUP_BARRIER;
#endif
    FOR_VERTICES(guide_count) {
        vec3 d = local(displacement), force = vec3(0.0);
#ifdef HAIR_GRID
        force = local(hair_acceleration);
#endif
#ifdef HAIR_WIND
        vec3 before = BEFORE_VEC3(edge);
        feel_air(i, before, 1.0, d);
        d += dragged_on(d, force);
#else
        d = guide_keep * d + guide_kick * force;
#endif
        float k = local(aim).w * h * h;
        d += k / (1.0 + k) * (rotate(turn_now, local(aim).xyz) + root_moved - GET(place) - d);
        PUT(lever, d);
        PUT(edge, local(plane));
        PUT(handed, root_moved);
        local(touch) = vec4(0.0);
        PUT(moved, local(slack) > 0.0 ? d + guide_kick * params.gravity.xyz : held_move(i));
    }
    GROUP_BARRIER;
}

// Keep a vertex that goes to d above its plane. Contact has moved it to a place on the plane, or
// else it is moved along the normal.
vec3 kept_above(uint k, vec3 d, bool met)
{
    vec3  normal = GET_AT(edge, k), on = GET_AT(handed, k);
    float depth  = dot(on - d, normal);
    if (!COLLIDERS || depth <= 0.0) return d;
    return met ? on : d + depth * normal;
}

// Return the direction near `way` in which vertex k, at its length from its leader, is not below
// its plane.
vec3 direction_above(uint k, vec3 leader, vec3 between, vec3 way, float len, bool met)
{
    vec3 normal = GET_AT(edge, k), d = leader + len * way - between,
         to = between + kept_above(k, d, met) - leader;
    PUT_AT(handed, k, d);
    if (!COLLIDERS) return way;
    float up = dot(to, normal), across = length(to - up * normal);
    if (dot(normal, normal) > 0.0 && abs(up) < len && across > 1e-3 * len)
        to = up * normal + sqrt(len * len - up * up) / across * (to - up * normal);
    return is_direction(to, len) ? normalize(to) : way;
}

// Draw every segment after the one before it.
void draw_strand_after_root(bool met)
{
    vec4 turn   = turn_now;
    vec3 last   = rotate(turn, rod_factor_euler(guide_first).xyz);
    vec3 root   = root_is_free ? GET_AT(lever, 0u) + guide_kick * params.gravity.xyz : GET_AT(moved, 0u);
    vec3 leader = kept_above(0u, root, met);
    PUT_AT(handed, 0u, root);
    PUT_AT(moved, 0u, leader);
    vec4 swung = vec4(0.0, 0.0, 0.0, 1.0); // Turn of the segment before in this substep
    for (uint k = 0u; k + 1u < guide_count; ++k) {
        uint  at         = guide_first + k;
        vec4  strain     = rod_strain(at), segment = rod_segment(at), along = rod_factor_euler(at);
        float len        = segment.x;
        vec3  between = GET_AT(place, k + 1u) - GET_AT(place, k), way = rotate(turn, along.xyz);
        // Nothing determines the segment's angle.
        if (dot(strain.xyz, strain.xyz) == 0.0) {
            turn = quat_multiply(quat_between(way, normalize(between)), turn);
            way  = normalize(between);
        }
        vec3 inertial = GET_AT(lever, k), relative = GET_AT(lever, k + 1u) - inertial;
        vec3 felt = guide_kick * params.gravity.xyz + inertial - leader;
        vec3 pull = guide_kick * rotate(turn, strain.xyz) + strain.w * felt -
                    dot(felt, way) * rotate(turn, rod_factor(at).xyz);
        vec3 led  = segment.w * params.gravity.w * (rotate(swung, between) - between);
        vec3 to   = between + (relative + led) / (1.0 + along.w * params.gravity.w) + len * pull;
        last      = is_direction(to, len) ? normalize(to) : last;
        // A contact does not turn the segments beyond it, so the turn is taken before contact.
        swung     = quat_between(direction_or(between, last), last);
        last      = direction_above(k + 1u, leader, between, last, len, met);
        turn      = quat_multiply(quat_between(way, last), turn);
        leader += len * last - between;
        PUT_AT(moved, k + 1u, leader);
    }
}

void draw(bool met)
{
    GROUP_BARRIER;
    SINGLE_THREAD { draw_strand_after_root(met); }
    GROUP_BARRIER;
    RELOAD(moved)
    RELOAD(handed)
#ifdef HAIR_PINNED
    FOR_VERTICES(guide_count) {
        if (local(slack) == 0.0) PUT(moved, held_move(i));
    }
    GROUP_BARRIER;
    give_length();
    SINGLE_THREAD { draw_strand(); }
    GROUP_BARRIER;
    RELOAD(moved)
#endif
}
