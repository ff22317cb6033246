// contact_any.glsl - any number of solids of any shape: which a vertex can touch, by the list of the cell it is in, and out
// of them, one after the other.
OWN(uint, members); // the first of its cell's, of which the bits are
OWN(uvec2, walked); // of reachable: no spheres or capsules

// A vertex is taken to be moved by the fitting of lengths no more than 2 cm farther than it would go freely. Of a way
// longer than the lists are made for its end counts.
void find_solids(vec3 head_moved)
{
    EACH(guide_count) {
        own(reachable) = own(met) = own(walked) = uvec2(0u);
        if (own(slack) > 0.0) {
            vec3  way    = own(wanted) - head_moved, position = root_now + GET(place) + own(wanted) - root_moved;
            float far    = length(way), reach = 0.02 + far;
            vec3  middle = position - way * (min(0.5 * far, params.cells_give) / max(far, 1e-9));
            uvec2 list   = cell_members(middle);
            own(members) = list.x;
            for (uint n = 0u; n < min(list.y - list.x, uint(HAIR_CELL_SOLIDS)); ++n) {
                uint    member = cell_entry(list.x + n), k = member & HAIR_MEMBER_NUMBER, bit = 1u << (n & 31u);
                capsule solid  = solid_at(k, share_now);
                if (length(from_axis(position, solid)) < solid.radius + reach + swept_by(k, solid)) {
                    own(reachable)[n / 32u] |= bit;
                    own(walked)[n / 32u] |= (member & HAIR_MEMBER_WALKED) != 0u ? bit : 0u;
                }
            }
        }
    }
}

uint member_at(uint first, uint word, uint bit) { return cell_entry(first + 32u * word + uint(findLSB(bit))) & HAIR_MEMBER_NUMBER; }

// What is far from all that is around a solid need not be walked.
bool is_around(uint k, vec3 end, vec3 way)
{
    capsule around = solid_at(k, share_now);
    return length(from_axis(end, around)) <= around.radius + length(way) + swept_by(k, around);
}

uvec2 first_of(uvec2 bits) { return bits.x != 0u ? uvec2(0u, bits.x & -bits.x) : uvec2(1u, bits.y & -bits.y); }

// One loop for both words: a software rasteriser goes once through what is in one that nobody enters.
#define EACH_BIT(bits)                                                                                       \
    for (uvec2 left = bits, at = first_of(left); at.y != 0u; left[at.x] &= ~at.y, at = first_of(left))

// Out of one solid after the other, capsules first; returns of how many.
uint push_out(uint i, vec3 start, uvec2 solids, uvec2 kept, vec3 head_moved, inout vec3 d, inout vec4 freedom, inout uvec2 met)
{
    uint contacts = 0u;
    vec3 normal, surface;
    EACH_BIT(solids & ~own(walked)) {
        uint  k     = member_at(own(members), at.x, at.y);
        float depth = depth_in(k, start, d, head_moved, normal, surface);
        contacts += push_from(at.x, at.y, BODY_POSITION(k, 1).w, depth, normal, surface, kept, d, freedom, met);
    }
    EACH_BIT(solids & own(walked)) {
        uint k    = member_at(own(members), at.x, at.y);
        vec3 way  = d - head_moved;
        if ((kept[at.x] & at.y) != 0u || is_around(k, start + way, way)) {
            float depth = depth_in_body(k, start, start + way, head_moved, normal, surface);
            contacts += push_from(at.x, at.y, BODY_POSITION(k, 1).w, depth, normal, surface, kept, d, freedom, met);
        }
    }
    return contacts;
}
