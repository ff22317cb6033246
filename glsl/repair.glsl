// repair.glsl - how a follower that meets a solid is led round it: two curves along it, both uniform cubic
// B-splines of few control points, so that nothing about them can kink or jump.
//
//   away(t)  how far the strand is moved, 0 at its root: the control point before the first is minus the one after
//   freed(t) how far it is freed of all guides but its own, from 0 to 1
//
// `repair_control` gives control point i of the strand whose first is at `first`: away in xyz, freed in w. That at 0,
// whose place is the root's, has in x how much longer a stretch of the curve is drawn, in place of away.
#include "spline.glsl"

vec4 repair_control(int first, int i);

// Interval of t, and the share of it that lies before t.
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
