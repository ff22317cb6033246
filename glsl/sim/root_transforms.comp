// root_transforms.comp - the scalp motion of guide roots in this step, by the triangles to which
// they are bound. A root moves with its closest point on its triangle, and turns with the triangle.
// The turn is the rotation in the polar decomposition of the triangle's deformation. Stretching and
// shearing therefore turn nothing. One thread per guide.
#version 450 core
#include "sim/scalp_buffers.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;
layout(std430, binding = HAIR_BIND_GUIDE) readonly buffer guide_buffer { hair_guide guide[]; };
layout(std430, binding = HAIR_BIND_REST) readonly buffer rest_buffer { hair_rest rest[]; };

// Two sides of a triangle in its own plane: (along, 0) and `other`.
struct flat_triangle {
    vec3  x, y, normal; // Unit vectors
    float along;
    vec2  other;
    bool  sound;
};

flat_triangle flatten(vec3 a, vec3 b, vec3 c)
{
    flat_triangle f;
    vec3  u = b - a, v = c - a, across = cross(u, v);
    float l = length(across);
    f.along  = length(u);
    f.sound  = l > 1e-6 * f.along * length(v);
    f.x      = u / f.along;
    f.normal = across / l;
    f.y      = cross(f.normal, f.x);
    f.other  = vec2(dot(v, f.x), dot(v, f.y));
    return f;
}

// Return the rotation between two triangles: that of the normal, and then about the normal.
vec4 turn_between(flat_triangle rest, flat_triangle now)
{
    // The matrix ((p, q), (0, r)) maps the rest sides to the current sides.
    float p = now.along / rest.along, r = now.other.y / rest.other.y;
    float q = (now.other.x - p * rest.other.x) / rest.other.y;
    vec2  turned = normalize(vec2(p + r, -q)); // Cosine and sine
    vec3  to     = turned.x * now.x + turned.y * now.y;
    vec4  first  = quat_between(rest.normal, now.normal);
    vec3  from   = rotate(first, rest.x);
    float w      = 1.0 + dot(from, to);
    vec4  second = w < 1e-6 ? vec4(now.normal, 0.0) : normalize(vec4(cross(from, to), w));
    return normalize(quat_multiply(second, first));
}

// Return the scalp motion of root g. A result that is not finite, or is too far away, is replaced
// by `before`. A triangle without a plane keeps the turn of `before`.
root_transform find_root_transform(uint g, root_transform before)
{
    hair_root_binding root_binding = root_bindings[g];
    flat_triangle at_rest =
        flatten(vertex_at_rest(root_binding.corner0), vertex_at_rest(root_binding.corner1),
                vertex_at_rest(root_binding.corner2));
    flat_triangle now = flatten(vertex_now(root_binding.corner0), vertex_now(root_binding.corner1),
                                vertex_now(root_binding.corner2));
    root_transform found = before;
    if (at_rest.sound && now.sound) {
        vec4 turn = turn_between(at_rest, now);
        if (is_sound(turn)) found.turn = turn;
    }
    vec3 away   = vec3(root_binding.away_x, root_binding.away_y, root_binding.away_z);
    found.shift = bound_point(root_binding) + rotate(found.turn, away) - rest[guide[g].first].position.xyz;
    return is_sound(vec4(found.shift, 0.0)) ? found : before;
}

root_transform kept(uint g, int which)
{
    return root_transform(root_transforms[g].shift[which].xyz, root_transforms[g].turn[which]);
}

void put(uint g, int which, root_transform r)
{
    root_transforms[g].shift[which] = vec4(r.shift, 0.0);
    root_transforms[g].turn[which]  = r.turn;
}

void main()
{
    uint g = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    if (g >= on.guides) return;
    root_transform then  = kept(g, HAIR_ROOT_TRANSFORM_AFTER);
    root_transform end   = kept(g, HAIR_ROOT_TRANSFORM_END);
    root_transform start = end;
    if ((on.flags & HAIR_SCALP_AGAIN) != 0u) start = kept(g, HAIR_ROOT_TRANSFORM_START);
    if ((on.flags & HAIR_SCALP_CHANGED) != 0u) end = find_root_transform(g, start);
    if ((on.flags & HAIR_SCALP_RESET) != 0u) start = then = end;
    put(g, HAIR_ROOT_TRANSFORM_THEN, then);
    put(g, HAIR_ROOT_TRANSFORM_START, start);
    put(g, HAIR_ROOT_TRANSFORM_END, end);
    bool past = (on.flags & HAIR_SCALP_RESET) == 0u;
    if (!past || on.substeps > 0u) {
        put(g, HAIR_ROOT_TRANSFORM_BEFORE,
            past && on.substeps > 1u ? root_transform_between(start, end, on.fraction_before) : then);
        put(g, HAIR_ROOT_TRANSFORM_AFTER, past ? root_transform_between(start, end, on.fraction_after) : end);
    }
}
