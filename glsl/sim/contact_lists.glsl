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
#define FIT 0.02   // m
#define ABOUT 0.004 // m

vec3 halfway(vec3 position, vec3 way, float far)
{
    return position - way * (min(0.5 * far, params.cells_give) / max(far, 1e-9));
}

uint member_at(uint first, uint word, uint bit) { return cell_entry(first + 32u * word + uint(findLSB(bit))) & HAIR_MEMBER_NUMBER; }

// Of the solids around, for the rest of the step.
void list_solids(uint i, vec3 middle, float far)
{
    uvec2 list       = cell_members(middle), all = uvec2(0u), few = uvec2(0u), others = uvec2(0u);
    float about      = min(ABOUT + 2.0 * far, params.cells_give);
    float reach      = FIT + max(0.5 * far, params.cells_give), nearest = reach;
    for (uint n = 0u; n < min(list.y - list.x, uint(HAIR_CELL_SOLIDS)); ++n) {
        uint    member = cell_entry(list.x + n), k = member & HAIR_MEMBER_NUMBER, bit = 1u << (n & 31u);
        vec4    ball = BALL(k);
        float   off  = length(middle - ball.xyz) - ball.w;
        if (off < reach) { // Of what is long there is more around.
            capsule then = solid_at(k, share_then), end = solid_at(k, 1.0);
            vec3    start = end.start - then.start;
            float   moves = max(length(start), length(start + end.axis - then.axis));
            off = length(from_axis(middle, end)) - end.radius - moves;
        }
        uvec2   mask  = uvec2(n < 32u ? bit : 0u, n < 32u ? 0u : bit);
        nearest = min(nearest, off);
        all |= off < reach ? mask : uvec2(0u);
        few |= off < about ? mask : uvec2(0u);
#ifdef HAIR_BODIES
        others |= (member & HAIR_MEMBER_WALKED) != 0u ? mask : uvec2(0u);
#endif
    }
    own(members)     = list.x;
    own(listed_near) = vec4(middle, about);
    own(reachable)   = all;
    own(clear)       = nearest;
    own(close)       = few;
#ifdef HAIR_BODIES
    own(walked) = others;
#endif
}

void find_root()
{
    uvec2 list = cell_members(root_now);
    sunk       = 0.0;
    if (root_is_free) return;
    for (uint n = list.x; n < min(list.y, list.x + uint(HAIR_CELL_SOLIDS)); ++n) {
        uint member = cell_entry(n), k = member & HAIR_MEMBER_NUMBER;
        vec4 ball   = BALL(k);
        if (length(root_now - ball.xyz) < ball.w + params.margin) sunk = max(sunk, root_depth_in(k, (member & HAIR_MEMBER_WALKED) != 0u));
    }
}

void find_solids(vec3 head_moved)
{
    bool serves = has_lists;
    EACH(guide_count) {
        vec3  way = own(wanted) - head_moved, position = root_now + GET(place) + own(wanted) - root_moved;
        float far = length(way);
        own(met)  = uvec2(0u);
        if (own(slack) > 0.0 && has_lists)
            serves = serves && length(halfway(position, way, far) - own(listed_near).xyz) + 0.5 * far <= params.cells_give;
    }
    if (!any_of(bvec2(!serves, false)).x) return;
    find_root();
    EACH(guide_count) {
        vec3  way = own(wanted) - head_moved, position = root_now + GET(place) + own(wanted) - root_moved;
        float far = length(way);
        own(reachable) = uvec2(0u);
        if (own(slack) > 0.0) list_solids(i, halfway(position, way, far), far);
    }
    has_lists = true;
}

// Of them those that are enough for a way.
uvec2 enough(uint i, vec3 start, vec3 end)
{
    vec4  near = own(listed_near);
    float far  = max(length(start - near.xyz), length(end - near.xyz));
    return far < own(clear) ? uvec2(0u) : far <= near.w ? own(close) : own(reachable);
}
