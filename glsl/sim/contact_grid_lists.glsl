// contact_grid_lists.glsl - lists of the colliders that a vertex can touch, among any number of any
// shape. A vertex reads the list of its cell in the grid.
//
// A vertex goes through its cell's list once, and keeps the result over several substeps. The
// result is valid until the vertex goes where it could touch other colliders. While it stays near
// the place where the list was made, the shorter list `close` is enough.
LOCAL(uint, members);    // Index of the first member of the cell. Bit 0 refers to it.
// xyz: place where the lists were made. w: radius around it in which `close` is enough.
LOCAL(vec4, listed_near);
LOCAL(uvec2, close);
// Radius around that place in which nothing is touched.
LOCAL(float, clear);
#ifdef HAIR_BODIES
// Bits of reachable colliders that are neither spheres nor capsules.
LOCAL(uvec2, walked);
#endif
bool has_lists = false;

// Minimum radius in which `close` is enough.
#define ABOUT 0.001 // m

// Number of members of a list that are read at once. A thread of a GPU waits for one read as long
// as for all of them. With many guides, other guides run while one waits.
#if defined(HAIR_SUBGROUP) && defined(HAIR_FEW_GUIDES)
#define AT_ONCE 4u
#else
#define AT_ONCE 1u
#endif

// Return the middle of the way to `position`, or a later place if the lists do not cover half of
// the way.
vec3 halfway(vec3 position, vec3 way, float far)
{
    return position - way * (min(0.5 * far, params.cells_slack) / max(far, 1e-9));
}

// Return the member of a list for a bit, or 0 for no bit.
uint member_at(uint first, uvec2 at)
{
    return at.y != 0u ? cell_entry(first + 32u * at.x + uint(findLSB(at.y))) : 0u;
}

uvec2 mask_of(uvec2 at) { return at.x == 0u ? uvec2(at.y, 0u) : uvec2(0u, at.y); }

// Return a sphere with the margin, at a fraction of the step.
vec4 sphere_at(uint k, float fraction)
{
    return mix(COLLIDER_START(k, 0), COLLIDER_END(k, 0), fraction) +
           vec4(0.0, 0.0, 0.0, params.collision_margin);
}

struct sphere {
    // The sphere at the end of the step, and its displacement from the time when the list is made.
    vec4  end, moves;
    // Length of this displacement, and distance of a place from the centre at the end.
    float far, away;
    // Minimum distance of the place from the surface during this time.
    float off;
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
    // The ball around a long collider is much larger than the collider.
    if (off >= reach) return off;
    capsule end = collider_at(k, 1.0);
    return length(from_axis(place, end)) - end.radius - (1.0 - fraction_then) * COLLIDER_SPIN(k).w;
}

// Return whether sphere a, and whether sphere b, is covered by the other one. A covered sphere is
// less deep than the other everywhere around a place, during the whole time. It then pushes nothing
// out. The gradient of the difference of depths is the difference of two unit vectors, whose bound
// is from Dunkl and Williams (1964). The motion of both spheres adds to the bound.
bvec2 hidden(sphere a, sphere b, float about)
{
    vec4  between = b.end - a.end, apart = b.moves - a.moves;
    float off = length(between.xyz), less = b.away - a.away - between.w;
    vec2  far = about + vec2(b.far, a.far), min_value = a.away + b.away - 2.0 * far;
    vec2  rate = mix(vec2(2.0), min(2.0 * off / min_value, 2.0), greaterThan(min_value, vec2(0.0)));
    return greaterThan(vec2(-less, less), rate * far + length(apart.xyz) + abs(apart.w));
}

// Return which near colliders are close to a place, in the order of their list. Overlapping
// spheres, of which a body may be made, cover each other. Most of them are covered by their
// neighbour in the list, or by the deepest sphere.
uvec2 find_close(vec3 place, uint first, uvec2 near, float about, float reach)
{
    sphere last  = sphere(vec4(0.0, 0.0, 0.0, -FARTHEST), vec4(0.0), 0.0, 0.0, 0.0), deepest = last;
    uvec2  close = uvec2(0u), by_last = uvec2(0u);
    float  min_value = about;
    EACH_BIT(near) {
        uint   member = member_at(first, at), k = member & HAIR_ENTRY_NUMBER;
        uvec2  mask   = mask_of(at);
        bool   long_  = (member & HAIR_ENTRY_LONG) != 0u;
        sphere ball   = sphere_from(place, sphere_at(k, fraction_then), sphere_at(k, 1.0));
        float  off    = ball.off;
        if (long_) off = off_long(place, k, reach);
        close |= off < about ? mask : uvec2(0u);
        if (off < about && !long_) {
            // x: `last` is covered by `ball`. y: `ball` is covered by `last`.
            bvec2 less = hidden(last, ball, about);
            if (less.x) close &= ~by_last;
            if (less.y || hidden(deepest, ball, about).y) close &= ~mask;
            last    = ball;
            by_last = mask;
            if (off < min_value) {
                min_value   = off;
                deepest = ball;
            }
        }
    }
    return close;
}

// List the colliders near vertex i for the rest of the step. The balls around colliders exclude
// most members of the cell.
void list_colliders(uint i, vec3 middle, float far)
{
    uvec2 list  = cell_members(middle), all = uvec2(0u), near = uvec2(0u), others = uvec2(0u);
    float about = min(ABOUT + 1.5 * far, params.cells_slack);
    float reach = HAIR_CONTACT_FIT + max(0.5 * far, params.cells_slack), nearest = reach;
    uint  count = min(list.y - list.x, uint(HAIR_CELL_COLLIDERS));
    uint  member[AT_ONCE], next[AT_ONCE], end = list.x + count;
    for (uint a = 0u; a < AT_ONCE; ++a) next[a] = cell_entry(min(list.x + a, end - 1u));
    for (uint first = 0u; first < count; first += AT_ONCE) {
        vec4 ball[AT_ONCE];
        for (uint a = 0u; a < AT_ONCE; ++a) {
            member[a] = next[a];
            ball[a]   = BALL(next[a] & HAIR_ENTRY_NUMBER);
            // The next member is read while this one is tested.
            next[a]   = cell_entry(min(list.x + first + AT_ONCE + a, end - 1u));
        }
        for (uint a = 0u; a < AT_ONCE; ++a) {
            uint  n = first + a, bit = 1u << (n & 31u);
            uvec2 mask = n >= count ? uvec2(0u) : n < 32u ? uvec2(bit, 0u) : uvec2(0u, bit);
            float off  = length(middle - ball[a].xyz) - ball[a].w;
            nearest = n < count ? min(nearest, off) : nearest;
            all |= off < reach ? mask : uvec2(0u);
            near |= off < about ? mask : uvec2(0u);
#ifdef HAIR_BODIES
            others |= (member[a] & HAIR_ENTRY_WALKED) != 0u ? mask : uvec2(0u);
#endif
        }
    }
    local(members)     = list.x;
    local(listed_near) = vec4(middle, about);
    local(reachable)   = all;
    local(clear)       = nearest;
    local(close)       = find_close(middle, list.x, near, about, reach);
#ifdef HAIR_BODIES
    local(walked) = others;
#endif
}
