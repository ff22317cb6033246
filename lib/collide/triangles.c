// triangles.c - the tree of boxes over triangles: sorted along a Morton curve, then built as a
// complete binary tree.
#include "lib/collide/triangles.h"

#include <math.h>
#include <string.h>

#define DIGIT 10 // Bits of a Morton code along an axis, and of one round of the radix sort.
#define ROUNDS 3

static hair_vec3 corner(const struct hair_triangles* t, uint32_t place, int k)
{
    return hair_sub(hair_load3(t->positions + 3 * (size_t)t->indices[place][k]), t->center);
}

// fminf() and fmaxf() are calls of libm, because they must skip NaN. Corners and points are finite.
static float min_of(float a, float b)
{
    return a < b ? a : b;
}

static float max_of(float a, float b)
{
    return a > b ? a : b;
}

static hair_vec3 min(hair_vec3 a, hair_vec3 b)
{
    return (hair_vec3){min_of(a.x, b.x), min_of(a.y, b.y), min_of(a.z, b.z)};
}

static hair_vec3 max(hair_vec3 a, hair_vec3 b)
{
    return (hair_vec3){max_of(a.x, b.x), max_of(a.y, b.y), max_of(a.z, b.z)};
}

static int same(hair_vec3 a, hair_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

// Order -------------------------------------------------------------------------------------------

// Spread the lowest ten bits to every third bit.
static uint32_t spread_bits(uint32_t x)
{
    x = (x | x << 16) & 0x030000ffu;
    x = (x | x << 8) & 0x0300f00fu;
    x = (x | x << 4) & 0x030c30c3u;
    return (x | x << 2) & 0x09249249u;
}

static uint32_t cell(float value, float lower, float scale)
{
    return (uint32_t)fminf(fmaxf((value - lower) * scale, 0), (1 << DIGIT) - 1);
}

static uint32_t code_of(const struct hair_triangles* t, uint32_t place, float scale)
{
    hair_vec3 sum = hair_add(hair_add(corner(t, place, 0), corner(t, place, 1)), corner(t, place, 2));
    hair_vec3 at = hair_scale(sum, 1.0f / 3), lower = t->bounds.lower;
    return spread_bits(cell(at.x, lower.x, scale)) | spread_bits(cell(at.y, lower.y, scale)) << 1 |
           spread_bits(cell(at.z, lower.z, scale)) << 2;
}

// Sort by the upper half of the keys, with the least significant digit first. The sort is stable.
static void sort_keys(uint64_t* keys, uint64_t* other, uint32_t count)
{
    for (int round = 0; round < ROUNDS; ++round) {
        uint32_t start[1 << DIGIT] = {0}, at = 0;
        int shift = 32 + DIGIT * round;
        for (uint32_t i = 0; i < count; ++i) ++start[keys[i] >> shift & ((1 << DIGIT) - 1)];
        for (uint32_t k = 0; k < 1 << DIGIT; ++k) {
            uint32_t size = start[k];
            start[k] = at;
            at += size;
        }
        for (uint32_t i = 0; i < count; ++i) other[start[keys[i] >> shift & ((1 << DIGIT) - 1)]++] = keys[i];
        uint64_t* swap = keys;
        keys = other;
        other = swap;
    }
}

static hair_result put_in_order(const hair_host* host, struct hair_triangles* t)
{
    uint64_t* keys = hair_alloc(host, 2 * (size_t)t->count, sizeof *keys);
    uint32_t(*sorted)[3] = hair_alloc(host, t->count, sizeof *sorted);
    hair_vec3 size = hair_sub(t->bounds.upper, t->bounds.lower);
    float scale = (float)(1 << DIGIT) / fmaxf(fmaxf(size.x, size.y), fmaxf(size.z, 1e-30f));
    if (!keys || !sorted) {
        hair_free(host, keys);
        hair_free(host, sorted);
        return hair_fail_memory(host, "the order of a collision mesh's triangles");
    }
    uint64_t* other = keys + t->count;
    for (uint32_t i = 0; i < t->count; ++i) keys[i] = (uint64_t)code_of(t, i, scale) << 32 | i;
    sort_keys(keys, other, t->count);
    // After an odd number of rounds, they are in the other half.
    for (uint32_t i = 0; i < t->count; ++i) memcpy(sorted[i], t->indices[(uint32_t)other[i]], sizeof *sorted);
    hair_free(host, keys);
    hair_free(host, t->indices);
    t->indices = sorted;
    return HAIR_OK;
}

// Nodes -------------------------------------------------------------------------------------------

// Return the number of a leaf along the curve. The leaves of a complete tree lie on two levels.
// Leaves of the lower level come first.
static uint32_t leaf_of(const struct hair_triangles* t, uint32_t node)
{
    HAIR_ASSERT(node >= t->leaves - 1 && node < 2 * t->leaves - 1);
    return node + 1 >= t->lowest ? node + 1 - t->lowest : node + 1 + t->leaves - t->lowest;
}

static void make_leaf(struct hair_triangles* t, uint32_t node)
{
    uint32_t first = leaf_of(t, node) * HAIR_TRIANGLES_PER_LEAF;
    HAIR_ASSERT(first < t->count);
    struct hair_box box = {corner(t, first, 0), corner(t, first, 0)};
    hair_vec3 area = {0, 0, 0}, center = {0, 0, 0};
    float weight = 0;
    for (uint32_t i = first; i < first + HAIR_TRIANGLES_PER_LEAF && i < t->count; ++i) {
        hair_vec3 a = corner(t, i, 0), b = corner(t, i, 1), c = corner(t, i, 2);
        hair_vec3 own = hair_scale(hair_cross(hair_sub(b, a), hair_sub(c, a)), 0.5f);
        float size = hair_length(own);
        box.lower = min(min(box.lower, a), min(b, c));
        box.upper = max(max(box.upper, a), max(b, c));
        area = hair_add(area, own);
        center = hair_add(center, hair_scale(hair_add(a, hair_add(b, c)), size / 3));
        weight += size;
    }
    t->box[node] = box;
    t->dipole[node].area = area;
    t->dipole[node].radius = weight; // The weight is kept here until the boxes are done.
    t->dipole[node].center = weight > 0 ? hair_scale(center, 1 / weight) : box.lower;
}

static void join(struct hair_triangles* t, uint32_t node)
{
    HAIR_ASSERT(2 * node + 2 < 2 * t->leaves - 1);
    const struct hair_box *a = &t->box[2 * node + 1], *b = &t->box[2 * node + 2];
    const struct hair_dipole *x = &t->dipole[2 * node + 1], *y = &t->dipole[2 * node + 2];
    float weight = x->radius + y->radius;
    t->box[node] = (struct hair_box){min(a->lower, b->lower), max(a->upper, b->upper)};
    t->dipole[node].area = hair_add(x->area, y->area);
    t->dipole[node].radius = weight;
    t->dipole[node].center = weight > 0 ? hair_lerp(x->center, y->center, y->radius / weight) : x->center;
}

static void make_nodes(struct hair_triangles* t)
{
    uint32_t nodes = 2 * t->leaves - 1;
    for (uint32_t node = nodes; node-- > 0;)
        if (node >= t->leaves - 1)
            make_leaf(t, node);
        else
            join(t, node);
    for (uint32_t node = 0; node < nodes; ++node) {
        hair_vec3 center = t->dipole[node].center;
        t->dipole[node].radius =
            hair_length(max(hair_sub(t->box[node].upper, center), hair_sub(center, t->box[node].lower)));
    }
}

static void find_mesh_bounds(struct hair_triangles* t)
{
    HAIR_ASSERT(t->count > 0);
    struct hair_box bounds = {corner(t, 0, 0), corner(t, 0, 0)};
    for (uint32_t i = 0; i < t->count; ++i)
        for (int k = 0; k < 3; ++k) {
            bounds.lower = min(bounds.lower, corner(t, i, k));
            bounds.upper = max(bounds.upper, corner(t, i, k));
        }
    hair_vec3 half = hair_scale(hair_sub(bounds.upper, bounds.lower), 0.5f);
    t->center = hair_add(bounds.lower, half);
    t->bounds = (struct hair_box){hair_sub(bounds.lower, t->center), hair_sub(bounds.upper, t->center)};
}

hair_result hair_triangles_build(const hair_host* host, const float* positions, const uint32_t* indices,
                                 uint32_t count, struct hair_triangles* out)
{
    struct hair_triangles t = {.positions = positions};
    t.indices = hair_alloc(host, count, sizeof *t.indices);
    if (!t.indices) return hair_fail_memory(host, "a collision mesh's triangles");
    for (uint32_t i = 0; i < count; ++i) {
        memcpy(t.indices[t.count], indices + 3 * (size_t)i, sizeof *t.indices);
        hair_vec3 a = corner(&t, t.count, 0), b = corner(&t, t.count, 1), c = corner(&t, t.count, 2);
        t.count += !same(a, b) && !same(b, c) && !same(c, a);
    }
    if (t.count) {
        find_mesh_bounds(&t);
        t.leaves = (t.count + HAIR_TRIANGLES_PER_LEAF - 1) / HAIR_TRIANGLES_PER_LEAF;
        for (t.lowest = 1; 2 * t.lowest <= 2 * t.leaves - 1;) t.lowest *= 2;
        HAIR_ASSERT((t.lowest & (t.lowest - 1)) == 0 && t.lowest <= 2 * t.leaves - 1);
        t.box = hair_alloc(host, 2 * (size_t)t.leaves - 1, sizeof *t.box);
        t.dipole = hair_alloc(host, 2 * (size_t)t.leaves - 1, sizeof *t.dipole);
        hair_result result = t.box && t.dipole ? put_in_order(host, &t)
                                               : hair_fail_memory(host, "a collision mesh's triangles");
        if (result) {
            hair_triangles_free(host, &t);
            return result;
        }
        make_nodes(&t);
    }
    *out = t;
    return HAIR_OK;
}

void hair_triangles_free(const hair_host* host, struct hair_triangles* triangles)
{
    hair_free(host, triangles->indices);
    hair_free(host, triangles->box);
    hair_free(host, triangles->dipole);
    *triangles = (struct hair_triangles){0};
}

// Distance ----------------------------------------------------------------------------------------

static float squared_to_segment(hair_vec3 p, hair_vec3 a, hair_vec3 b)
{
    hair_vec3 d = hair_sub(b, a), out = hair_sub(p, a);
    float t = hair_dot(out, d) / max_of(hair_dot(d, d), 1e-37f);
    out = hair_sub(out, hair_scale(d, min_of(max_of(t, 0), 1)));
    return hair_dot(out, out);
}

static float squared_to_triangle(const struct hair_triangles* t, uint32_t place, hair_vec3 p)
{
    hair_vec3 a = corner(t, place, 0), b = corner(t, place, 1), c = corner(t, place, 2);
    hair_vec3 ab = hair_sub(b, a), bc = hair_sub(c, b), ca = hair_sub(a, c);
    hair_vec3 normal = hair_cross(ca, ab);
    float size = hair_dot(normal, normal), nearest = INFINITY;
    int narrow = !(size > 1e-37f);
    int past_ab = narrow || !(hair_dot(hair_cross(normal, ab), hair_sub(p, a)) >= 0);
    int past_bc = narrow || !(hair_dot(hair_cross(normal, bc), hair_sub(p, b)) >= 0);
    int past_ca = narrow || !(hair_dot(hair_cross(normal, ca), hair_sub(p, c)) >= 0);
    if (!past_ab && !past_bc && !past_ca) {
        float height = hair_dot(normal, hair_sub(p, a));
        return height * height / size;
    }
    // An edge that has the point on its inner side has no point that is nearer than all others.
    if (past_ab) nearest = squared_to_segment(p, a, b);
    if (past_bc) nearest = min_of(nearest, squared_to_segment(p, b, c));
    if (past_ca) nearest = min_of(nearest, squared_to_segment(p, c, a));
    return nearest;
}

static float squared_to_box(const struct hair_box* box, hair_vec3 p)
{
    hair_vec3 zero = {0, 0, 0};
    hair_vec3 out = max(max(hair_sub(box->lower, p), hair_sub(p, box->upper)), zero);
    return hair_dot(out, out);
}

float hair_triangles_distance(const struct hair_triangles* t, uint32_t place, hair_vec3 point)
{
    HAIR_ASSERT(place < t->count);
    return sqrtf(squared_to_triangle(t, place, point));
}

void hair_triangles_find(struct hair_triangles* t, hair_vec3 point, float* distance, uint32_t* nearest)
{
    HAIR_ASSERT(t->count > 0 && t->box && t->dipole);
    struct {
        uint32_t node;
        float squared;
    } stack[64] = {{0, 0}};
    uint32_t depth = 1, found = UINT32_MAX;
    float squared = *distance * *distance;
    while (depth > 0) {
        uint32_t node = stack[--depth].node;
        if (stack[depth].squared >= squared) continue;
        ++t->work;
        if (node < t->leaves - 1) {
            HAIR_ASSERT(depth + 2 <= sizeof stack / sizeof *stack);
            uint32_t a = 2 * node + 1, b = a + 1;
            float to_a = squared_to_box(&t->box[a], point), to_b = squared_to_box(&t->box[b], point);
            int b_first = to_b < to_a; // The nearer child goes on top.
            stack[depth].node = b_first ? a : b;
            stack[depth++].squared = b_first ? to_a : to_b;
            stack[depth].node = b_first ? b : a;
            stack[depth++].squared = b_first ? to_b : to_a;
            continue;
        }
        uint32_t first = leaf_of(t, node) * HAIR_TRIANGLES_PER_LEAF;
        for (uint32_t i = first; i < first + HAIR_TRIANGLES_PER_LEAF && i < t->count; ++i) {
            float own = squared_to_triangle(t, i, point);
            ++t->work;
            if (own < squared) squared = own, found = i;
        }
    }
    if (found == UINT32_MAX) return;
    *distance = sqrtf(squared);
    *nearest = found;
}

// Winding -----------------------------------------------------------------------------------------

#define FROM_AFAR 3.0f // Distance, in radii, from which a dipole stands for its triangles.
#define PI_4 12.56637061f

// Return the solid angle of a triangle (van Oosterom and Strackee 1983).
static float solid_angle(const struct hair_triangles* t, uint32_t place, hair_vec3 p)
{
    hair_vec3 a = hair_sub(corner(t, place, 0), p), b = hair_sub(corner(t, place, 1), p),
              c = hair_sub(corner(t, place, 2), p);
    float la = hair_length(a), lb = hair_length(b), lc = hair_length(c);
    float above = hair_dot(a, hair_cross(b, c));
    float below = la * lb * lc + hair_dot(a, b) * lc + hair_dot(b, c) * la + hair_dot(c, a) * lb;
    return above == 0 && below == 0 ? 0 : 2 * atan2f(above, below);
}

float hair_triangles_winding(struct hair_triangles* t, hair_vec3 point)
{
    uint32_t stack[64] = {0}, depth = 1;
    float sum = 0;
    while (depth > 0) {
        uint32_t node = stack[--depth];
        const struct hair_dipole* dipole = &t->dipole[node];
        hair_vec3 to = hair_sub(dipole->center, point);
        ++t->work;
        float far = hair_length(to);
        if (far > FROM_AFAR * dipole->radius) {
            sum += hair_dot(dipole->area, to) / (far * far * far);
        } else if (node < t->leaves - 1) {
            HAIR_ASSERT(depth + 2 <= sizeof stack / sizeof *stack);
            stack[depth++] = 2 * node + 1;
            stack[depth++] = 2 * node + 2;
        } else {
            uint32_t first = leaf_of(t, node) * HAIR_TRIANGLES_PER_LEAF;
            for (uint32_t i = first; i < first + HAIR_TRIANGLES_PER_LEAF && i < t->count; ++i)
                sum += solid_angle(t, i, point), ++t->work;
        }
    }
    return sum / PI_4;
}

// Closed ------------------------------------------------------------------------------------------

// Mix bits by the final step of Murmur3.
static uint64_t mix_bits(uint64_t x)
{
    x = (x ^ x >> 33) * 0xff51afd7ed558ccdu;
    x = (x ^ x >> 33) * 0xc4ceb9fe1a85ec53u;
    return x ^ x >> 33;
}

static uint64_t hash_of_point(hair_vec3 p)
{
    uint64_t hash = 0x9e3779b97f4a7c15u;
    float v[3] = {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}; // Turns -0 into 0.
    for (int k = 0; k < 3; ++k) {
        uint32_t bits;
        memcpy(&bits, &v[k], sizeof bits);
        hash = mix_bits(hash ^ bits) + 0x9e3779b97f4a7c15u;
    }
    return hash;
}

// Return whether the triangles are closed. Every edge has a random number, which is added in one
// direction and subtracted in the other. An open mesh gives 0 with a probability of 2^-64, and then
// only a sign would be wrong.
int hair_triangles_are_closed(const struct hair_triangles* t)
{
    uint64_t sum = 0;
    for (uint32_t i = 0; i < t->count; ++i) {
        uint64_t v[4] = {hash_of_point(corner(t, i, 0)), hash_of_point(corner(t, i, 1)),
                         hash_of_point(corner(t, i, 2))};
        v[3] = v[0];
        for (int k = 0; k < 3; ++k) {
            uint64_t edge =
                mix_bits(mix_bits(v[k] < v[k + 1] ? v[k] : v[k + 1]) + (v[k] < v[k + 1] ? v[k + 1] : v[k]));
            sum += v[k] < v[k + 1] ? edge : 0 - edge;
        }
    }
    return sum == 0;
}
