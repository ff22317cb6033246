// kd_tree.c - the k-d tree: splitting points into halves, and searching the tree for the nearest
// points.
#include "lib/groom/kd_tree.h"

#include "lib/base/math.h"

#include <float.h>
#include <stdbool.h>

// Maximum number of points in a leaf, which are scanned. Smaller leaves are no faster, larger ones
// are slower.
#define LEAF 8

static float coordinate(struct hair_point_set point_set, uint32_t point, uint32_t axis)
{
    return point_set.points[(size_t)point * point_set.dimensions + axis];
}

static void swap_points(uint32_t* order, uint32_t i, uint32_t j)
{
    uint32_t kept = order[i];
    order[i] = order[j];
    order[j] = kept;
}

uint32_t hair_kd_widest_axis(struct hair_point_set point_set, const uint32_t* order, uint32_t count)
{
    HAIR_ASSERT(0 < point_set.dimensions && point_set.dimensions <= HAIR_KD_MAX_DIMENSIONS);
    float lower[HAIR_KD_MAX_DIMENSIONS], upper[HAIR_KD_MAX_DIMENSIONS];
    for (uint32_t axis = 0; axis < point_set.dimensions; ++axis) {
        lower[axis] = FLT_MAX;
        upper[axis] = -FLT_MAX;
    }
    for (uint32_t i = 0; i < count; ++i)
        for (uint32_t axis = 0; axis < point_set.dimensions; ++axis) {
            float x = coordinate(point_set, order[i], axis);
            lower[axis] = fminf(lower[axis], x);
            upper[axis] = fmaxf(upper[axis], x);
        }
    uint32_t widest = 0;
    for (uint32_t axis = 1; axis < point_set.dimensions; ++axis)
        if (upper[axis] - lower[axis] > upper[widest] - lower[widest]) widest = axis;
    return widest;
}

// Result of a partition. Points [low, equal) lie before the pivot, [equal, after) on it and [after,
// high) behind it.
struct thirds {
    uint32_t equal, after;
    uint64_t weight_before, weight_equal;
};

static struct thirds divide(struct hair_point_set point_set, uint32_t* order, uint32_t low, uint32_t high,
                            uint32_t axis, const uint32_t* weights)
{
    HAIR_ASSERT(low < high && axis < point_set.dimensions);
    // Use a random pivot, so that no order of the points is slow.
    uint32_t at = low + hair_hash(low ^ hair_hash(high)) % (high - low);
    float pivot = coordinate(point_set, order[at], axis);
    struct thirds thirds = {.equal = low, .after = high};
    for (uint32_t i = low; i < thirds.after;) {
        float x = coordinate(point_set, order[i], axis);
        uint32_t weight = weights ? weights[order[i]] : 1;
        if (x < pivot) {
            thirds.weight_before += weight;
            swap_points(order, i++, thirds.equal++);
        } else if (x > pivot) {
            swap_points(order, i, --thirds.after);
        } else {
            thirds.weight_equal += weight;
            ++i;
        }
    }
    HAIR_ASSERT(thirds.equal < thirds.after && thirds.after <= high);
    return thirds;
}

uint32_t hair_kd_split(struct hair_point_set point_set, uint32_t* order, uint32_t count, uint32_t axis,
                       const uint32_t* weights, uint64_t target)
{
    HAIR_ASSERT(count >= 2 && axis < point_set.dimensions);
    // Hoare's selection divides only the part that contains the target.
    uint32_t low = 0, high = count;
    while (low < high) {
        struct thirds thirds = divide(point_set, order, low, high, axis, weights);
        if (thirds.weight_before > target) {
            high = thirds.equal;
            continue;
        }
        target -= thirds.weight_before;
        if (thirds.weight_equal <= target) {
            target -= thirds.weight_equal;
            low = thirds.after;
            continue;
        }
        low = thirds.equal;
        for (uint32_t i = low; i < thirds.after; ++i) {
            uint32_t weight = weights ? weights[order[i]] : 1;
            if (weight > target) break;
            target -= weight;
            ++low;
        }
        break;
    }
    if (low == 0) return 1;
    return low < count ? low : count - 1;
}

static void build_nodes(struct hair_kd_tree* tree, uint32_t low, uint32_t high)
{
    while (high - low > LEAF) {
        uint32_t middle = low + (high - low) / 2;
        HAIR_ASSERT(low < middle && middle < high);
        uint32_t axis = hair_kd_widest_axis(tree->point_set, tree->order + low, high - low);
        hair_kd_split(tree->point_set, tree->order + low, high - low, axis, NULL, middle - low);
        tree->plane[middle] =
            (struct hair_kd_plane){coordinate(tree->point_set, tree->order[middle], axis), axis};
        build_nodes(tree, low, middle);
        low = middle;
    }
}

hair_result hair_kd_tree_build(const hair_host* host, struct hair_point_set point_set, uint32_t count,
                               struct hair_kd_tree* tree)
{
    *tree = (struct hair_kd_tree){.point_set = point_set, .count = count};
    tree->order = hair_alloc(host, count, sizeof *tree->order);
    tree->plane = hair_alloc(host, count, sizeof *tree->plane);
    if (!tree->order || !tree->plane) {
        hair_kd_tree_free(host, tree);
        return hair_fail_memory(host, "the search for near strands");
    }
    for (uint32_t i = 0; i < count; ++i) tree->order[i] = i;
    build_nodes(tree, 0, count);
    return HAIR_OK;
}

void hair_kd_tree_free(const hair_host* host, struct hair_kd_tree* tree)
{
    hair_free(host, tree->order);
    hair_free(host, tree->plane);
    *tree = (struct hair_kd_tree){0};
}

struct tree_search {
    const struct hair_kd_tree* tree;
    const float* point;
    struct hair_kd_neighbor* near;
    uint32_t found, wanted;
};

static float farthest(const struct tree_search* search)
{
    return search->found < search->wanted ? FLT_MAX : search->near[search->found - 1].squared;
}

static void consider(struct tree_search* search, uint32_t index)
{
    HAIR_ASSERT(index < search->tree->count);
    const struct hair_point_set point_set = search->tree->point_set;
    float limit = farthest(search);
    float squared = 0;
    for (uint32_t axis = 0; axis < point_set.dimensions && squared <= limit; ++axis) {
        float d = coordinate(point_set, index, axis) - search->point[axis];
        squared += d * d;
    }
    if (!(squared < limit)) return;
    for (uint32_t i = 0; i < search->found; ++i)
        if (search->near[i].index == index) return; // Found before the search.
    if (search->found < search->wanted) ++search->found;
    uint32_t i = search->found - 1;
    for (; i > 0 && search->near[i - 1].squared > squared; --i) search->near[i] = search->near[i - 1];
    search->near[i] = (struct hair_kd_neighbor){index, squared};
    HAIR_ASSERT(i + 1 == search->found || squared <= search->near[i + 1].squared);
}

static void search_nodes(struct tree_search* search, uint32_t low, uint32_t high)
{
    const struct hair_kd_tree* tree = search->tree;
    while (high - low > LEAF) {
        uint32_t middle = low + (high - low) / 2;
        float d = search->point[tree->plane[middle].axis] - tree->plane[middle].at;
        bool front = d < 0;
        search_nodes(search, front ? low : middle, front ? middle : high);
        if (d * d >= farthest(search)) return;
        if (front)
            low = middle;
        else
            high = middle;
    }
    for (uint32_t i = low; i < high; ++i) consider(search, tree->order[i]);
}

uint32_t hair_kd_tree_nearest(const struct hair_kd_tree* tree, const float* point,
                              struct hair_kd_neighbor* near, uint32_t found, uint32_t wanted)
{
    HAIR_ASSERT(found <= wanted && wanted > 0);
    struct tree_search search = {tree, point, near, found, wanted};
    search_nodes(&search, 0, tree->count);
    return search.found;
}
