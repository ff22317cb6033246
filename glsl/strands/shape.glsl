// shape.glsl - followers with a shape of their own, which move with the displacements of guides, as
// hair_follower says. Only strands/follower.glsl includes this file.

struct shape_point {
    vec3 at, slope; // In the root frame, m. `slope` is the derivative by t.
};

// Return the vertices 2i and 2i + 1 of a shape, of which vertex 0 lies before the root.
void fetch_pair(int texel, out vec3 a, out vec3 b)
{
    uvec4 pair = texelFetch(follower_texture, texel);
    a = vec3(unpackSnorm2x16(pair.x), unpackSnorm2x16(pair.y).x);
    b = vec3(unpackSnorm2x16(pair.z), unpackSnorm2x16(pair.w).x);
}

// Return a point of a follower's shape, by a Catmull-Rom spline.
shape_point find_shape(hair_follower follower, float t)
{
    float along = t * float(draw.shape_vertices - 1u);
    int   k     = min(int(along), int(draw.shape_vertices) - 2);
    float x     = along - float(k);
    int   first = int(draw.followers) * HAIR_FOLLOWER_TEXELS +
                int(follower.offset[3].w) * HAIR_SHAPE_TEXELS(int(draw.shape_vertices)) + k / 2;
    vec3  p[6];
    bool  is_odd = (k & 1) != 0;
    fetch_pair(first, p[0], p[1]);
    fetch_pair(first + 1, p[2], p[3]);
    vec3 a = is_odd ? p[1] : p[0], b = is_odd ? p[2] : p[1], c = is_odd ? p[3] : p[2], d = p[3];
    if (is_odd) {
        fetch_pair(first + 2, p[4], p[5]);
        d = p[4];
    }
    vec3 m0 = 0.5 * (c - a), m1 = 0.5 * (d - b), chord = c - b;
    vec3 bend0 = m0 - chord, bend1 = m1 - chord;
    vec3 at    = b + x * chord + x * (1.0 - x) * ((1.0 - x) * bend0 - x * bend1);
    vec3 slope = chord + (1.0 - x) * (1.0 - 3.0 * x) * bend0 - x * (2.0 - 3.0 * x) * bend1;
    float unit = follower.offset[2].w;
    return shape_point(unit * at, unit * float(draw.shape_vertices - 1u) * slope);
}

// Add the weighted displacement of a guide at t, and its derivative by t.
void add_displacement(uint guide, float weight, guide_place place, inout vec3 position, inout vec3 along)
{
    int  at = int((draw.guides + guide) * draw.smooth_vertices) + place.at;
    vec3 a = fetch_position(at).xyz, b = fetch_position(at + 1).xyz;
    position += weight * mix(a, b, place.fraction);
    along    += weight * float(draw.smooth_vertices - 1u) * (b - a);
}

// Move a point towards guide 0 where the look draws locks together, or away from it.
void gather(hair_follower follower, float t, vec2 width, inout vec3 position, inout vec3 along)
{
    guide_point g = fetch_guide(follower.guide0, t * follower.length_ratio, true);
    vec3        slope = follower.length_ratio * fetch_length(follower.guide0) * g.tangent;
    along    = mix(slope, along, width.x) + width.y * (position - g.position);
    position = mix(g.position, position, width.x);
}

// Offset a point by the look, in the frame of guide 0.
void set_aside(hair_follower follower, float t, aside a, inout vec3 position, inout vec3 along)
{
    float       u      = t * follower.length_ratio;
    guide_point g      = fetch_guide(follower.guide0, u, false);
    vec4        frame  = fetch_frame(follower.guide0, u);
    vec3        turned = rotate(frame, vec3(a.at.x, 0.0, a.at.y));
    position += turned;
    along    += rotate(frame, vec3(a.slope.x, 0.0, a.slope.y)) -
             follower.length_ratio * dot(g.bend, turned) * g.tangent;
}

hair_point interpolate_own(hair_follower follower, float t, repair r)
{
    float       v = min(t, 1.0), drawn = -follower.multi;
    int         root  = int(follower.guide0 * draw.smooth_vertices);
    vec4        frame = fetch_turn(root);
    shape_point shape = find_shape(follower, v * drawn);
    vec3 position     = fetch_position(root).xyz + rotate(frame, follower.offset[0].xyz + shape.at);
    vec3 along        = rotate(frame, shape.slope);

    // A collider frees a follower from guides 1 and 2.
    float       others = 1.0 - r.freed;
    float       w0 = follower.offset[1].w, w1 = follower.weight1, w2 = follower.weight2;
    guide_place place = find_place(0u, v * drawn);
    add_displacement(follower.guide0, w0 + r.freed * (w1 + w2), place, position, along);
    add_displacement(follower.guide1, others * w1, place, position, along);
    add_displacement(follower.guide2, others * w2, place, position, along);
    along *= drawn;
    vec2 width = curve_at(HAIR_CURVE_CLUMP_WIDTH, v);
    if (width != vec2(1.0, 0.0)) gather(follower, v, width, position, along);
    float length_ = follower.length_ratio * fetch_length(follower.guide0);
    aside a       = find_aside(follower, v, length_);
    if (a.at != vec2(0.0) || a.slope != vec2(0.0)) set_aside(follower, v, a, position, along);
    position += max(t - 1.0, 0.0) * along + r.away;
    along    += r.away_slope;
    float radius = draw.radius * follower.offset[0].w * curve_at(HAIR_CURVE_TAPER, v).x;
    return hair_point(position, direction_or(along, rotate(frame, vec3(0.0, 1.0, 0.0))), radius);
}
