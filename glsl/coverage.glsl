// coverage.glsl - how much of a pixel a strand covers. strand_share: pixels across from its middle, half its width, what is made
// of its direction: a square pixel seen along it is a trapezoid, of half so wide below and half so wide above.
layout(location = 7) noperspective in vec4 strand_share;

// Of the projection of a square pixel onto a line: how much of it lies before x.
float share_before(float x, float outer, float inner)
{
    float y = min(abs(x), outer), ramp = max(outer - inner, 1e-4), left = outer - y;
    float tail = y > inner ? 0.5 * left * left / ramp : 0.5 * ramp + inner - y;
    tail /= outer + inner;
    return x < 0.0 ? tail : 1.0 - tail;
}

float coverage_of(vec4 s) { return clamp(share_before(s.x + s.y, s.z, s.w) - share_before(s.x - s.y, s.z, s.w), 0.0, 1.0); }
