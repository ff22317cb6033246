// tie.glsl - vertices that ties hold, to the head or to the world, as the scalp holds the root.
//
// A span is what lies between one held vertex and the next. Where they are farther apart than it is long it is given
// the length that it lacks, evenly, and a thousandth more: of a strand that is quite straight no lengths can be found.
// Of one that nearly is, each step finds what it can without going far: its lengths give way a little.
layout(binding = HAIR_UNIT_TIE) uniform samplerBuffer tie_texture; // hair_held[]
OWN(vec4, target); // of a tied vertex: hair_held.place
OWN(float, gives); // of segment i: share by which its length gives way
OWN(vec4, span);   // of segment i: hair_held.span of the tie that its span ends at; 0: none
vec4 head_then, head_now; // how the head is turned
bool taut;                // a span is longer than it can be

#define GIVEN 1.001
#define NEARLY 0.98     // apart, by its length, from where on a span gives way,
#define GIVES_WAY 0.01  // by this share of what a length has against change

// What rod[].factor.w says is the first tie beyond a vertex, counted from 1.
vec4 tie_place(float number) { return texelFetch(tie_texture, 2 * int(number) - 2); }
vec4 tie_span(float number) { return texelFetch(tie_texture, 2 * int(number) - 1); }

// Written whatever the vertex is, once: one driver loses what conditions write into an array that is not the first of
// it.
void load_tie(uint i)
{
    uint  at   = guide_first + min(i, guide_count - 1u);
    float here = rod[max(at, 1u) - 1u].factor.w, beyond = rod[at].factor.w;
    own(target) = tie_place(max(here, 1.0));
    own(span)   = min(beyond, 1.0) * tie_span(max(beyond, 1.0));
}

// Evenly from where it is to where it is to be at the end of the step: in the head's frame, or in the world.
vec3 held_move(uint i)
{
    if (i == 0u) return root_moved;
    float left  = 1.0 - share_then;
    float part  = left > 1e-6 ? clamp((share_now - share_then) / left, 0.0, 1.0) : 1.0;
    vec3  start = root_then + GET(place), aimed = own(target).xyz, end = start + part * (aimed - start);
    if (own(target).w == 0.0) {
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

// Of all segments, by where `moved` leads what is held.
void give_length()
{
    taut = false;
    EACH(guide_count - 1u) {
        uint  from = uint(own(span).x), to = uint(own(span).y);
        vec3  apart = (GET_AT(place, to) - GET_AT(place, from)) + (GET_AT(moved, to) - GET_AT(moved, from));
        float more  = given(own(span), apart);
        taut        = taut || more > GIVEN;
        own(gives)  = length(apart) > NEARLY * own(span).z ? GIVES_WAY : 0.0;
        if (i + 1u < guide_count) own(rest_length) = more * rod[guide_first + i].segment.x;
    }
}
