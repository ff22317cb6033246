// contact_lists.glsl - any number of solids of any shape: which a vertex can touch, by the list of the cell it is in.
//
// A list is gone through once for as many substeps as it serves: until the vertex goes where it could touch what is not in
// the list. Of what it can touch, what it can touch near where it was then is enough as long as it stays there.
OWN(uint, members);    // the first of its cell's, of which the bits are
OWN(vec4, listed_near); // xyz: where it was then, halfway; w: how far about there `close` is enough
OWN(uvec2, close);
OWN(float, clear);      // how far about there nothing is touched
#ifdef HAIR_BODIES
OWN(uvec2, walked); // of reachable: no spheres or capsules
#endif
bool has_lists = false;

// A vertex is taken to be moved by the fitting of lengths no more than this farther than it would go freely. Of a way
// longer than the lists are made for its end counts.
#define FIT 0.02    // m
#define ABOUT 0.001 // m

// So many members of a list are read at once: a thread of a GPU waits for each as long as for all of them. Of many guides
// others go on meanwhile.
#if defined(HAIR_SUBGROUP) && defined(HAIR_FEW_GUIDES)
#define AT_ONCE 4u
#else
#define AT_ONCE 1u
#endif

vec3 halfway(vec3 position, vec3 way, float far)
{
    return position - way * (min(0.5 * far, params.cells_give) / max(far, 1e-9));
}

// One of a list, by its bit; of no bit the first solid.
uint member_at(uint first, uvec2 at) { return at.y != 0u ? cell_entry(first + 32u * at.x + uint(findLSB(at.y))) : 0u; }

uvec2 mask_of(uvec2 at) { return at.x == 0u ? uvec2(at.y, 0u) : uvec2(0u, at.y); }

// A sphere at one moment, with the margin.
vec4 sphere_at(uint k, float share) { return mix(SOLID_START(k, 0), SOLID_END(k, 0), share) + vec4(0.0, 0.0, 0.0, params.margin); }

struct sphere {
    vec4  end, moves; // when the step ends; and from when a list is made
    float far, away;  // how far it moves; and a place is from its middle in the end
    float off;        // the place stays from it
};

sphere sphere_from(vec3 place, vec4 then, vec4 end)
{
    vec4  moves = end - then;
    float far = length(moves.xyz), away = length(place - end.xyz);
    return sphere(end, moves, far, away, away - max(then.w, end.w) - far);
}

float off_long(vec3 place, uint k, float reach)
{
    vec4  ball = BALL(k);
    float off  = length(place - ball.xyz) - ball.w;
    if (off >= reach) return off; // Of what is long there is more around.
    capsule end = solid_at(k, 1.0);
    return length(from_axis(place, end)) - end.radius - (1.0 - share_then) * SOLID_SPIN(k).w;
}

// Which of two spheres is hidden: everywhere about a place, and all the time, less deep than the other: then nothing is to be
// got out of it. From place to place the difference of depths changes by that of two directions (Dunkl and Williams 1964), and
// by how both move.
bvec2 hidden(sphere a, sphere b, float about)
{
    vec4  between = b.end - a.end, apart = b.moves - a.moves;
    float off = length(between.xyz), less = b.away - a.away - between.w;
    vec2  far = about + vec2(b.far, a.far), least = a.away + b.away - 2.0 * far;
    vec2  rate = mix(vec2(2.0), min(2.0 * off / least, 2.0), greaterThan(least, vec2(0.0)));
    return greaterThan(vec2(-less, less), rate * far + length(apart.xyz) + abs(apart.w));
}

// Which of those that are near a place are close to it, in the order of their list. Spheres that overlap, of which a body may be
// made, hide each other: most of them by one that is next to them in the list, or by the deepest.
uvec2 find_close(vec3 place, uint first, uvec2 near, float about, float reach)
{
    sphere last  = sphere(vec4(0.0, 0.0, 0.0, -FARTHEST), vec4(0.0), 0.0, 0.0, 0.0), deepest = last;
    uvec2  close = uvec2(0u), by_last = uvec2(0u);
    float  least = about;
    EACH_BIT(near) {
        uint   member = member_at(first, at), k = member & HAIR_MEMBER_NUMBER;
        uvec2  mask   = mask_of(at);
        bool   long_  = (member & HAIR_MEMBER_LONG) != 0u;
        sphere ball   = sphere_from(place, sphere_at(k, share_then), sphere_at(k, 1.0));
        float  off    = ball.off;
        if (long_) off = off_long(place, k, reach);
        close |= off < about ? mask : uvec2(0u);
        if (off < about && !long_) {
            bvec2 less = hidden(last, ball, about); // deep
            if (less.x) close &= ~by_last;
            if (less.y || hidden(deepest, ball, about).y) close &= ~mask;
            last    = ball;
            by_last = mask;
            if (off < least) {
                least   = off;
                deepest = ball;
            }
        }
    }
    return close;
}

// Of the solids around, for the rest of the step: most of a list are off by what is around them.
void list_solids(uint i, vec3 middle, float far)
{
    uvec2 list  = cell_members(middle), all = uvec2(0u), near = uvec2(0u), others = uvec2(0u);
    float about = min(ABOUT + 1.5 * far, params.cells_give);
    float reach = FIT + max(0.5 * far, params.cells_give), nearest = reach;
    uint  count = min(list.y - list.x, uint(HAIR_CELL_SOLIDS));
    uint  member[AT_ONCE], next[AT_ONCE], end = list.x + count;
    for (uint a = 0u; a < AT_ONCE; ++a) next[a] = cell_entry(min(list.x + a, end - 1u));
    for (uint first = 0u; first < count; first += AT_ONCE) {
        vec4 ball[AT_ONCE];
        for (uint a = 0u; a < AT_ONCE; ++a) {
            member[a] = next[a];
            ball[a]   = BALL(next[a] & HAIR_MEMBER_NUMBER);
            next[a]   = cell_entry(min(list.x + first + AT_ONCE + a, end - 1u)); // Is read while this one is looked at.
        }
        for (uint a = 0u; a < AT_ONCE; ++a) {
            uint  n = first + a, bit = 1u << (n & 31u);
            uvec2 mask = n >= count ? uvec2(0u) : n < 32u ? uvec2(bit, 0u) : uvec2(0u, bit);
            float off  = length(middle - ball[a].xyz) - ball[a].w;
            nearest = n < count ? min(nearest, off) : nearest;
            all |= off < reach ? mask : uvec2(0u);
            near |= off < about ? mask : uvec2(0u);
#ifdef HAIR_BODIES
            others |= (member[a] & HAIR_MEMBER_WALKED) != 0u ? mask : uvec2(0u);
#endif
        }
    }
    own(members)     = list.x;
    own(listed_near) = vec4(middle, about);
    own(reachable)   = all;
    own(clear)       = nearest;
    own(close)       = find_close(middle, list.x, near, about, reach);
#ifdef HAIR_BODIES
    own(walked) = others;
#endif
}
