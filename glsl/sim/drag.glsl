// drag.glsl - drag of the wind on strands, which are treated as cylinders. The drag across and
// along a strand has two rates at which the relative velocity decays. The rates are those of the
// velocity before the substep. The decay is implicit for BDF2 and Euler, and exact for SHAKE, so
// that the wind never makes a strand faster than itself. Drag is applied in each direction
// separately, before the implicit bending.
#ifndef HAIR_DRAG_GLSL
#define HAIR_DRAG_GLSL

#include "wind/air.glsl"
#include "wind/cylinder.glsl"

vec3 along; // Unit direction of the strand
uint substep_number; // Index of the substep in the dispatch
// Substep h times the rates across and along by which the law exceeds guide_damping.
vec2 drags;
// Displacement by the velocity of the wind through damping and drag, as h^2 times an acceleration.
vec3 drifts;

// Scale the parts of v across and along the strand.
vec3 by_parts(vec2 fraction, vec3 v)
{
    float a = dot(v, along);
    return fraction.x * (v - a * along) + fraction.y * a * along;
}

// Compute drags and drifts at vertex i, whose velocity is about hv / h. Drag moves a strand by at
// most its length in a substep. `fraction` is the part of the vertex's inertia that has weight.
void feel_air(uint i, vec3 before, float fraction, vec3 hv)
{
    float h     = SUBSTEP;
    vec3  after = GET(edge);
    vec3  sum   = (i > 0u ? before : after) + (i + 1u < guide_count ? after : before);
    float size  = length(sum), beside = i > 0u ? rod_segment(guide_first + i - 1u).x : 0.0;
    along       = size > 1e-3 ? sum / size : vec3(0.0, 1.0, 0.0);
    vec3  air   = h * air_at(root_then + GET(place), substep_number), past = air - hv;
    float faces = dot(past, along), across = length(past - faces * along);
    // A mass that hangs on a tip has no drag.
    float light = min(0.5 * (beside + local(rest_length)) * local(slack), 1.0);
    vec2  max_value  = guide_length / max(vec2(across, abs(faces)), vec2(1e-9));
    vec2  law   = min(h * (wind.viscous * drag_of(across / h * wind.per_speed)), max_value);
    // Damping and the law are drag by one air, so the greater of both acts.
    drags       = light * max(law - guide_damping * h, 0.0);
    drifts      = fraction * guide_damping * h * air + by_parts(drags, air);
}

// SHAKE: return the change of d in a substep by an acceleration and the wind.
vec3 dragged_on(vec3 d, vec3 push)
{
    float h     = SUBSTEP, c = guide_damping * h;
    vec2  x     = vec2(c) + drags;
    // The series of (1 - exp(-x)) / x is used where x is small, because rounding spoils the
    // difference.
    vec2  small = 1.0 - x / 2.0 * (1.0 - x / 3.0 * (1.0 - x / 4.0 * (1.0 - x / 5.0)));
    vec2  fraction = mix((1.0 - exp(-x)) / max(x, 0.1), small, lessThan(x, vec2(0.1)));
    return by_parts(fraction, h * h * push + drifts - by_parts(x, d));
}

// BDF2 and Euler: return the part of `sum` that remains with implicit drag on the strand's own
// velocity.
vec3 dragged_back(uint i, float b, vec3 sum)
{
    float h       = SUBSTEP;
    float massive = 1.0 + b * guide_damping * h + b * b * h * h * local(aim).w;
    return by_parts(1.0 / (1.0 + b * drags / massive), sum);
}

#endif
