// body.glsl - solids that are no capsules: how deep in one a vertex comes, by the exact distance to its shape.
#include "solid_distance.glsl"

#define BODY_STEPS 10u // distances taken at most: at both ends, and on the way
#define BODY_NEAR 1e-4 // m: that is on the surface

vec4 body_turn(uint k, float share)
{
    return normalize(mix(params.body[k].rotation[0], params.body[k].rotation[1], share));
}

vec3 body_place(uint k, float share)
{
    return mix(params.body[k].position[0].xyz, params.body[k].position[1].xyz, share);
}

// As depth_in, for a vertex that goes from `start` to `end`. Where it may have gone right through, the way is walked in
// the solid's own space by steps that are as long as the surface is far, and the vertex stopped where it goes in.
float depth_in_body(uint k, vec3 start, vec3 end, vec3 head_moved, out vec3 normal, out vec3 surface)
{
    vec4  turn_then = body_turn(k, share_then), turn_after = body_turn(k, share_now);
    vec3  place_then = body_place(k, share_then), place_after = body_place(k, share_now);
    vec3  a = rotate(quat_conjugate(turn_then), start - place_then);
    vec3  b = rotate(quat_conjugate(turn_after), end - place_after), outwards = vec3(0.0, 1.0, 0.0);
    float around = params.body[k].position[0].w + params.margin, way = length(b - a), t = 1.0, depth = 0.0, was = 0.0;
    for (uint i = 0u; i < BODY_STEPS && t <= 1.0; ++i) {
        vec3  gradient, at = mix(a, b, t);
        float distance = shape_distance(uint(params.body[k].size.w), params.body[k].size.xyz, at, gradient) - around;
        if (i == 0u) {
            depth    = -distance;
            outwards = gradient;
            t        = 0.0;
        } else if (i == 1u) {
            // The side it was on is where it goes out again, also from beyond the middle of what is thin.
            float same  = dot(gradient, outwards);
            bool  holds = distance <= BODY_NEAR && (depth > 0.0 ? same <= 0.5 : same < -0.5);
            was         = -distance;
            depth       = holds ? dot(gradient, at - distance * gradient - b) : depth;
            outwards    = holds ? gradient : outwards;
            t           = same > 0.5 || distance <= BODY_NEAR || distance >= way ? 2.0 : distance / way;
        } else if (distance > BODY_NEAR) {
            t += distance / way;
        } else {
            depth    = dot(gradient, at - b);
            outwards = gradient;
            t        = 2.0;
        }
    }
    vec3 touched = b + depth * outwards;
    normal       = rotate(turn_after, outwards);
    surface      = head_moved + place_after - place_then + rotate(turn_after, touched) - rotate(turn_then, touched);
    // What was inside already comes out no faster than this.
    return depth - max(was - EMERGE * params.gravity.w, 0.0);
}
