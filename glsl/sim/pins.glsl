// pins.glsl - vertices that pins hold to the head or to the world, as the scalp holds the root.
//
// A span lies between one held vertex and the next. If these are farther apart than the span is
// long, its segments are lengthened evenly. They then cover the distance and a thousandth more.
// Lengths cannot be found in a quite straight strand. In a nearly straight strand, lengths give way
// a little, so that each step finds what it can without a long way.
layout(binding = HAIR_UNIT_PIN) uniform samplerBuffer pin_texture; // hair_held[]
LOCAL(vec4, target); // hair_held.place of a pinned vertex
LOCAL(float, gives); // Fraction by which the length of segment i gives way
// hair_held.span of the pin at which the span of segment i ends, or 0.
LOCAL(vec4, span);
// Rotation of the head at the start and end of the substep.
vec4 head_then, head_now;
bool taut;                // A span is stretched beyond its length.

#define GIVEN 1.001
// Distance of the ends from which a span gives way, as a fraction of its length.
#define NEARLY 0.98
// Compliance added to a length, as a fraction of its own.
#define GIVES_WAY 0.01

// Return data of a pin by its number. See pin_beyond().
vec4 pin_place(float number) { return texelFetch(pin_texture, 2 * int(number) - 2); }
vec4 pin_span(float number) { return texelFetch(pin_texture, 2 * int(number) - 1); }

// Load the pin of vertex i. Writes are unconditional, because one driver loses conditional writes
// to arrays other than the first.
void load_pin(uint i)
{
    uint  at   = guide_first + min(i, guide_count - 1u);
    float here = pin_beyond(max(at, 1u) - 1u), beyond = pin_beyond(at);
    local(target) = pin_place(max(here, 1.0));
    local(span)   = min(beyond, 1.0) * pin_span(max(beyond, 1.0));
}

// Return the displacement of held vertex i. The vertex moves evenly to its place at the end of the
// step, in the head's frame or in the world.
vec3 held_move(uint i)
{
    if (i == 0u) return root_moved;
    float left  = 1.0 - fraction_then;
    float part  = left > 1e-6 ? clamp((fraction_now - fraction_then) / left, 0.0, 1.0) : 1.0;
    vec3  start = root_then + GET(place), aimed = local(target).xyz, end = start + part * (aimed - start);
    if (local(target).w == 0.0) {
        vec3 seen_so = rotate(quat_conjugate(head_then), start);
        end          = rotate(head_now, seen_so + part * (aimed - seen_so));
    }
    return (end - root_now) - GET(place) + root_moved;
}

float given(vec4 span, vec3 apart)
{
    float needed = length(apart) / span.z;
    return span.z > 0.0 && bits_of(needed) < 0x7f800000u ? max(GIVEN * needed, 1.0) : 1.0;
}

// Lengthen all segments for the distances of held vertices after `moved`.
void give_length()
{
    taut = false;
    FOR_VERTICES(guide_count - 1u) {
        uint  from = uint(local(span).x), to = uint(local(span).y);
        vec3  apart = (GET_AT(place, to) - GET_AT(place, from)) + (GET_AT(moved, to) - GET_AT(moved, from));
        float more  = given(local(span), apart);
        taut        = taut || more > GIVEN;
        local(gives)  = length(apart) > NEARLY * local(span).z ? GIVES_WAY : 0.0;
        if (i + 1u < guide_count) local(rest_length) = more * rod_segment(guide_first + i).x;
    }
}
