// coverage.glsl - how much of a pixel a strand covers.
//
// Seen along a strand, a square pixel projects to a trapezoid: a density that is constant in the
// middle and falls linearly to 0 at both sides.
#ifndef HAIR_COVERAGE_GLSL
#define HAIR_COVERAGE_GLSL

// Return the fraction of a square pixel's projection onto a line that lies before x. `outer` and
// `inner` are half the widths of the trapezoid's base and top.
float fraction_before(float x, float outer, float inner)
{
    float y = min(abs(x), outer), ramp = max(outer - inner, 1e-4), left = outer - y;
    float tail = y > inner ? 0.5 * left * left / ramp : 0.5 * ramp + inner - y;
    tail /= outer + inner;
    return x < 0.0 ? tail : 1.0 - tail;
}

// Return the covered fraction of a pixel. s.x: distance of its centre from the strand's middle,
// pixels. y: half the strand's width, pixels. z, w: half the widths of the trapezoid's base and
// top, which depend on the strand's direction.
float coverage_of(vec4 s)
{
    return clamp(fraction_before(s.x + s.y, s.z, s.w) - fraction_before(s.x - s.y, s.z, s.w), 0.0, 1.0);
}

#endif
