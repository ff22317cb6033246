// repair.glsl - the two curves that push a follower out of colliders. Both are uniform cubic
// B-splines of few control points. They therefore have no kinks or jumps.
//
//   away(t)   displacement, 0 at the root
//   freed(t)  blend from all guides, 0, to its own guide alone, 1
//
// To make away(0) 0, the control point before the first is minus the one after it. `repair_control`
// returns control point i of the strand whose first control point is `first`, with away in xyz and
// freed in w. Control point 0 lies at the root, where away is 0. Its x therefore stores the
// relative increase of the length of curve that is drawn.
#include "strands/spline.glsl"

vec4 repair_control(int first, int i);

// Return the interval of t. x is the fraction of the interval before t.
int spline_place(float t, out float x)
{
    float at = clamp(t, 0.0, 1.0) * float(HAIR_REPAIR_INTERVALS);
    int   k  = min(int(at), HAIR_REPAIR_INTERVALS - 1);
    x        = at - float(k);
    return k;
}

repair repair_at(int first, float t)
{
    float x;
    int   k = spline_place(t, x);
    mat4  c;
    for (int i = 0; i < 4; ++i) {
        int j = k - 1 + i;
        c[i]  = repair_control(first, abs(j));
        if (j < 0) c[i] = vec4(-c[i].xyz, repair_control(first, 0).w);
        if (j == 0) c[i].xyz = vec3(0.0);
    }
    vec4 value = c * spline(x);
    vec4 slope = t > 1.0 ? vec4(0.0) : float(HAIR_REPAIR_INTERVALS) * (c * spline_slope(x));
    return repair(value.xyz, slope.xyz, value.w, slope.w);
}
