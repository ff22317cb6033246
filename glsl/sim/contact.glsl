// contact.glsl - what solids make of a displacement: out of them, and held by friction as far as Coulomb allows.
//
// The reaction of a solid is what is done minus what is wanted. Its part along the normal may only push; its part
// along the surface is at most `friction` times that, and against the slip. Where that suffices there is no slip at
// all: a strand at rest does not creep.
#define FREE 0.0
#define SLIDES 1.0
#define STICKS 2.0

#define touch row_next // xyz: normal, w: FREE, SLIDES or STICKS. Written anew before lengths are fitted.

#ifdef HAIR_THREAD_PER_GUIDE
vec4 row_next[MOST];
uint near[2];
#else
shared uint near[2];
#endif
OWN(uvec2, reachable); // solids, one bit each
float share_then, share_now; // of the step that is done at the substep's start and end

struct capsule { // a solid at one moment
    vec3  start, axis;
    float radius;
};

capsule solid_at(uint k, float share)
{
    vec4 a = mix(params.solid[k].start[0], params.solid[k].end[0], share);
    vec4 b = mix(params.solid[k].start[1], params.solid[k].end[1], share);
    return capsule(a.xyz, b.xyz - a.xyz, a.w + params.margin);
}

float nearest_share(vec3 position, capsule solid)
{
    return clamp(dot(position - solid.start, solid.axis) / max(dot(solid.axis, solid.axis), 1e-12), 0.0, 1.0);
}

vec3 from_axis(vec3 position, capsule solid)
{
    return position - solid.start - nearest_share(position, solid) * solid.axis;
}

// The solids that the guide can touch in this substep, of them those that a vertex can: others are not looked at
// again. A vertex is taken to be moved by the fitting of lengths no more than 2 cm farther than it would go freely.
void find_solids(vec3 head_moved)
{
    if (!SOLIDS) return;
    EACH(1u) { near[0] = near[1] = 0u; }
    MEET;
    float longest = guide_length + length(root_moved - head_moved) + 0.02;
    for (uint k = 0u; k < params.solids; ++k) {
#ifndef HAIR_THREAD_PER_GUIDE
        if (k % MOST != gl_LocalInvocationID.x) continue;
#endif
        capsule solid = solid_at(k, share_now);
        bool    met   = length(from_axis(root_now, solid)) < solid.radius + longest;
#ifdef HAIR_THREAD_PER_GUIDE
        if (met) near[k / 32u] |= 1u << (k % 32u);
#else
        if (met) atomicOr(near[k / 32u], 1u << (k % 32u));
#endif
    }
    MEET;
    EACH(guide_count) {
        own(reachable) = uvec2(0u);
        if (slack[i] > 0.0) {
            vec3  position = root_now + place[i] + own(wanted) - root_moved;
            float reach    = 0.02 + length(own(wanted) - head_moved);
            for (int word = 0; word < 2; ++word)
                for (uint bits = near[word]; bits != 0u; bits &= bits - 1u) {
                    uint    k     = 32u * uint(word) + uint(findLSB(bits));
                    capsule solid = solid_at(k, share_now);
                    vec3    swept = solid.start - solid_at(k, share_then).start;
                    if (length(from_axis(position, solid)) < solid.radius + reach + length(swept))
                        own(reachable)[word] |= bits & -bits;
                }
        }
    }
}

// One solid: normal and depth of the displacement d from `start`, both from the head's origin; and what the surface
// there does. Depth 0: no contact. A vertex that goes right through is stopped where it goes in.
float depth_in(uint k, vec3 start, vec3 d, vec3 head_moved, out vec3 normal, out vec3 surface)
{
    capsule now   = solid_at(k, share_now);
    vec3    end   = start + d - head_moved;
    vec3    out_b = from_axis(end, now);
    float   away  = length(out_b);
    normal        = away > 1e-9 ? out_b / away : vec3(0.0, 1.0, 0.0);
    surface       = vec3(0.0);
    capsule then  = solid_at(k, share_then);
    vec3    out_a = from_axis(start, then);
    vec3    pass  = out_b - out_a;
    float   depth = now.radius - away;
    float   c     = dot(out_a, out_a) - now.radius * now.radius;
    if (c > 0.0 && dot(out_b, out_a) < 0.0) {
        float a = dot(pass, pass), b = dot(out_a, pass), root = b * b - a * c;
        if (root > 0.0 && b < 0.0) {
            normal = normalize(out_a + pass * ((-b - sqrt(root)) / a));
            depth  = now.radius - dot(normal, out_b);
        }
    }
    if (depth <= 0.0) return 0.0;
    float along = nearest_share(end, now);
    surface = head_moved + (now.start - then.start) + along * (now.axis - then.axis) +
              cross(params.solid[k].spin.xyz * (share_now - share_then), normal * now.radius);
    return depth;
}

// What solids make of what is wanted, and what freedom they leave.
vec3 allowed(uint i, vec3 want, uvec2 solids, vec3 head_moved, out vec4 freedom)
{
    vec3 d     = want;
    vec3 start = root_now - root_moved + head_moved + place[i];
    freedom    = vec4(0.0, 0.0, 0.0, FREE);
    for (int word = 0; word < 2; ++word)
        for (uint bits = solids[word]; bits != 0u; bits &= bits - 1u) {
            vec3  normal, surface;
            float depth = depth_in(32u * uint(word) + uint(findLSB(bits)), start, d, head_moved, normal, surface);
            if (depth > 0.0) {
                vec3  slip  = d - surface;
                slip -= dot(slip, normal) * normal;
                float speed = length(slip), grip = params.friction * depth;
                bool  stuck = speed <= grip;
                d += depth * normal - (stuck ? slip : slip * (grip / speed));
                freedom = vec4(normal, stuck || freedom.w != FREE ? STICKS : SLIDES);
            }
        }
    return d;
}

// The part of a displacement that a contact lets pass.
vec3 pass_on(vec4 freedom, vec3 d)
{
    return freedom.w == FREE ? d : freedom.w == STICKS ? vec3(0.0) : d - dot(d, freedom.xyz) * freedom.xyz;
}
