// scalp.c - followers grown all over the scalp, each between three guides.
#include "lib/groom/groom_builder.h"

#define NONE UINT32_MAX
// Maximum distance between a guide's root and the scalp vertex at which it is rooted, m.
#define COINCIDE 1e-3f
// Number of nearest guides among which three that surround a root are searched.
#define NEAR 8
// Number of nearest guides among which those of one group are searched, where groups are mixed.
#define NEAR_MIXED 24

// Return the area of a triangle, m^2, or 0 if no hair grows on it.
static double fertile_area(const struct hair_groom_builder* builder, uint32_t triangle)
{
    if (builder->density[triangle] <= 0) return 0;
    hair_vec3 a = hair_scalp_corner(builder, triangle, 0);
    hair_vec3 b = hair_sub(hair_scalp_corner(builder, triangle, 1), a),
              c = hair_sub(hair_scalp_corner(builder, triangle, 2), a);
    return 0.5 * (double)hair_length(hair_cross(b, c));
}

// Compute the i-th point of a triangle in barycentric coordinates, by the R2 sequence (Roberts
// 2018, "The unreasonable effectiveness of quasirandom sequences"). Points beyond the diagonal of
// the square are folded back.
static void scatter(uint32_t i, double start_u, double start_v, float out[3])
{
    double u = start_u + 0.7548776662466927 * i, v = start_v + 0.5698402909980532 * i;
    u -= floor(u), v -= floor(v);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    out[0] = (float)(1 - u - v), out[1] = (float)u, out[2] = (float)v;
}

// Return the density of the scalp at a point of a triangle as a fraction of the maximum density of
// its corners.
static float relative_density(const hair_groom_desc* desc, uint32_t triangle, const float weight[3])
{
    const uint32_t* corner = desc->scalp_triangles + 3 * (size_t)triangle;
    float sum = 0, max = 0;
    for (int i = 0; i < 3 && desc->scalp_density; ++i) {
        float density = desc->scalp_density[corner[i]];
        sum += weight[i] * density;
        max = fmaxf(max, density);
    }
    return max > 0 ? sum / max : 1;
}

// Scatter the candidates of a triangle in proportion to the density, which is linear over it.
// Points are rejected at random where the density is lower than elsewhere in the triangle.
static void scatter_triangle(struct hair_groom_builder* builder, uint32_t triangle)
{
    uint32_t random = hair_candidate_random(builder, triangle), count = builder->bin_candidates[triangle];
    double start_u = (double)hair_random(&random), start_v = (double)hair_random(&random);
    struct hair_scalp_point* points = builder->scalp_points + builder->bin_first[triangle];
    for (uint32_t i = 0, kept = 0; kept < count; ++i) {
        points[kept].triangle = triangle;
        scatter(i, start_u, start_v, points[kept].weight);
        float density = relative_density(builder->desc, triangle, points[kept].weight);
        // The mean density is at least a third of the maximum.
        HAIR_ASSERT(i < 1000 + 100 * count);
        if (density >= 0.9999f || hair_random(&random) < density) ++kept;
    }
}

static hair_result scatter_candidates(struct hair_groom_builder* builder)
{
    builder->scalp_points =
        hair_alloc(builder->host, builder->candidate_count, sizeof *builder->scalp_points);
    if (!builder->scalp_points) return hair_fail_memory(builder->host, "the roots of followers");
    builder->is_scattered = true;
    for (uint32_t triangle = 0; triangle < builder->bin_count; ++triangle)
        scatter_triangle(builder, triangle);
    return HAIR_OK;
}

// Distribute the candidates over the triangles by the running sum of areas. Each triangle is at
// most one candidate off its fraction. Small triangles are not all rounded down to none.
hair_result hair_scalp_candidates(struct hair_groom_builder* builder)
{
    uint32_t triangles = builder->desc->scalp_triangle_count;
    HAIR_TRY(hair_scalp_bins(builder));
    double total = 0;
    for (uint32_t i = 0; i < triangles; ++i) total += fertile_area(builder, i);
    if (!(total > 0))
        return hair_fail(
            builder->host, HAIR_ERROR_ARGUMENT,
            "hair_groom_desc.scalp_triangles: none of %u has an area and a scalp_density above 0", triangles);
    uint32_t random = hair_hash(builder->desc->seed);
    double jitter = (double)hair_random(&random), sum = 0, before = 0;
    for (uint32_t i = 0; i < triangles; ++i) {
        sum += fertile_area(builder, i);
        double after = floor(sum / total * builder->desc->follower_count + jitter);
        HAIR_ASSERT(after >= before);
        builder->bin_candidates[i] = (uint32_t)(after - before);
        before = after;
    }
    hair_number_candidates(builder);
    HAIR_ASSERT(builder->candidate_count == builder->desc->follower_count);
    return scatter_candidates(builder);
}

struct scalp {
    struct hair_groom_builder* builder;
    struct hair_kd_tree roots; // of the guides
    uint32_t* guide_at; // guide rooted at each vertex of the scalp, or NONE
    struct hair_strand_mix* mixes; // Receives the guides of each candidate. NULL grows followers.
    struct hair_division division; // of the candidates
};

// Three guides around a root, with barycentric weights.
struct trio {
    uint32_t guide[3];
    float weight[3];
};

// Return the guide rooted at a scalp vertex, or NONE. The guide with the number of the vertex has
// priority, because several vertices of the scalp coincide along a parting.
static uint32_t find_guide_at(const struct scalp* scalp, uint32_t vertex)
{
    const struct hair_groom* groom = scalp->builder->groom;
    const float* p = scalp->builder->scalp + 3 * (size_t)vertex;
    if (vertex < groom->info.guide_count &&
        hair_distance(hair_guide_root(groom, vertex), hair_load3(p)) <= COINCIDE)
        return vertex;
    struct hair_kd_neighbor near;
    hair_kd_tree_nearest(&scalp->roots, p, &near, 0, 1);
    return near.squared <= COINCIDE * COINCIDE ? near.index : NONE;
}

static void normalize(float weight[3])
{
    float sum = 0;
    for (int i = 0; i < 3; ++i) sum += weight[i] = fmaxf(weight[i], 0);
    HAIR_ASSERT(sum > 0);
    for (int i = 0; i < 3; ++i) weight[i] /= sum;
}

// Compute the barycentric coordinates of p, projected onto the plane of the triangle abc. Return
// false for a sliver.
static bool find_barycentric(hair_vec3 a, hair_vec3 b, hair_vec3 c, hair_vec3 p, float out[3])
{
    hair_vec3 u = hair_sub(b, a), v = hair_sub(c, a), w = hair_sub(p, a);
    hair_vec3 normal = hair_cross(u, v);
    float squared = hair_dot(normal, normal);
    float uu = hair_dot(u, u), vv = hair_dot(v, v);
    if (!(squared > 0.01f * uu * vv)) return false; // The edges enclose less than 6 degrees.
    out[1] = hair_dot(hair_cross(w, v), normal) / squared;
    out[2] = hair_dot(hair_cross(u, w), normal) / squared;
    out[0] = 1 - out[1] - out[2];
    return true;
}

// Return the nearest guides, weighted by the inverse square of their distance. Used if no three
// guides surround the root.
static struct trio weigh_by_distance(const struct hair_kd_neighbor* near, uint32_t found)
{
    HAIR_ASSERT(found > 0);
    struct trio trio;
    for (uint32_t i = 0; i < 3; ++i) {
        const struct hair_kd_neighbor* own = near + (i < found ? i : 0);
        trio.guide[i] = own->index;
        trio.weight[i] = i < found ? near[0].squared / fmaxf(own->squared, 1e-20f) : 0;
    }
    trio.weight[0] = 1; // Also correct at the root of a guide.
    normalize(trio.weight);
    return trio;
}

// Return the nearest three of the given guides that surround the root.
static struct trio choose_trio(const struct hair_groom* groom, const struct hair_kd_neighbor* near,
                               uint32_t found, hair_vec3 root)
{
    for (uint32_t k = 2; k < found; ++k)
        for (uint32_t j = 1; j < k; ++j)
            for (uint32_t i = 0; i < j; ++i) {
                struct trio trio = {.guide = {near[i].index, near[j].index, near[k].index}};
                if (!find_barycentric(hair_guide_root(groom, trio.guide[0]),
                                      hair_guide_root(groom, trio.guide[1]),
                                      hair_guide_root(groom, trio.guide[2]), root, trio.weight))
                    continue;
                if (fminf(trio.weight[0], fminf(trio.weight[1], trio.weight[2])) < -0.01f) continue;
                normalize(trio.weight);
                return trio;
            }
    return weigh_by_distance(near, found);
}

static struct trio find_trio(const struct scalp* scalp, hair_vec3 root)
{
    float point[3] = {root.x, root.y, root.z};
    struct hair_kd_neighbor near[NEAR];
    uint32_t found = hair_kd_tree_nearest(&scalp->roots, point, near, 0, NEAR);
    return choose_trio(scalp->builder->groom, near, found, root);
}

static bool is_mixed(const struct hair_groom* groom, const struct trio* trio)
{
    uint32_t group = groom->guides[trio->guide[0]].group;
    return groom->guides[trio->guide[1]].group != group || groom->guides[trio->guide[2]].group != group;
}

// Return three guides of the group of `guide`, or `guide` alone if others surround the root.
static struct trio find_trio_in_group(const struct scalp* scalp, hair_vec3 root, uint32_t guide)
{
    const struct hair_groom* groom = scalp->builder->groom;
    float point[3] = {root.x, root.y, root.z};
    struct hair_kd_neighbor near[NEAR_MIXED];
    uint32_t found = hair_kd_tree_nearest(&scalp->roots, point, near, 0, NEAR_MIXED), kept = 0;
    for (uint32_t i = 0; i < found && kept < NEAR; ++i)
        if (groom->guides[near[i].index].group == groom->guides[guide].group) near[kept++] = near[i];
    if (kept) return choose_trio(groom, near, kept, root);
    return (struct trio){.guide = {guide, guide, guide}, .weight = {1, 0, 0}};
}

// Draw guide 0 at random by weight, so that the borders of clumps are soft.
static void draw_first(struct trio* trio, uint32_t* random)
{
    int heaviest = trio->weight[0] >= trio->weight[1] ? 0 : 1;
    float r = hair_random(random);
    int first = r < trio->weight[0] ? 0 : r < trio->weight[0] + trio->weight[1] ? 1 : 2;
    if (!(trio->weight[first] > 0)) first = heaviest; // Correct rounding.
    uint32_t guide = trio->guide[first];
    float weight = trio->weight[first];
    trio->guide[first] = trio->guide[0];
    trio->weight[first] = trio->weight[0];
    trio->guide[0] = guide;
    trio->weight[0] = weight;
    HAIR_ASSERT(weight > 0);
}

static hair_vec3 root_to_tip(const struct hair_groom* groom, uint32_t guide)
{
    hair_vec4 tip = groom->rest[groom->guides[guide].first + groom->guides[guide].count - 1].position;
    return hair_sub(hair_v3(tip.x, tip.y, tip.z), hair_guide_root(groom, guide));
}

// Return whether two guides lie on different sides of a parting. A blend of the two would hang in
// empty space or pass through the head.
static bool are_parted(const struct hair_groom* groom, uint32_t i, uint32_t j)
{
    hair_vec3 a = root_to_tip(groom, i), b = root_to_tip(groom, j);
    float one = groom->guides[i].arc_length, two = groom->guides[j].arc_length, shorter = fminf(one, two);
    // Guides of different lengths that run in one direction are not parted.
    hair_vec3 apart = hair_sub(hair_scale(a, shorter / one), hair_scale(b, shorter / two));
    if (hair_length(apart) > 0.6f * shorter) return true;
    float product = hair_length(a) * hair_length(b), mean = 0.5f * (one + two);
    // The tip of a curled guide tells little about its direction.
    if (product < 0.01f * mean * mean) return false;
    return hair_dot(a, b) < 0.342f * product; // More than 70 degrees.
}

static void respect_partings(const struct hair_groom* groom, struct trio* trio)
{
    for (int i = 1; i < 3; ++i)
        if (trio->guide[i] == trio->guide[0] || are_parted(groom, trio->guide[0], trio->guide[i])) {
            if (trio->guide[i] == trio->guide[0]) trio->weight[0] += trio->weight[i];
            trio->guide[i] = trio->guide[0];
            trio->weight[i] = 0;
        }
    normalize(trio->weight);
}

static hair_vec3 in_root_frame(const struct hair_groom* groom, uint32_t guide, hair_vec3 v)
{
    hair_vec4 q = groom->guides[guide].root_frame;
    return hair_rotate(hair_quat_conjugate((hair_quat){q.x, q.y, q.z, q.w}), v);
}

static struct hair_follower grow_follower(const struct hair_groom* groom, const struct trio* trio,
                                          hair_vec3 root, uint32_t* random)
{
    uint32_t guide = trio->guide[0];
    hair_vec3 blended = {0};
    HAIR_ASSERT(guide < groom->info.guide_count);
    for (int i = 0; i < 3; ++i)
        blended = hair_add(blended, hair_scale(hair_guide_root(groom, trio->guide[i]), trio->weight[i]));
    hair_vec3 own = in_root_frame(groom, guide, hair_sub(root, hair_guide_root(groom, guide)));
    hair_vec3 multi = in_root_frame(groom, guide, hair_sub(root, blended));

    struct hair_follower follower = hair_grown_follower(guide, own, random);
    follower.guide1 = trio->guide[1], follower.weight1 = trio->weight[1];
    follower.guide2 = trio->guide[2], follower.weight2 = trio->weight[2];
    follower.offset[1].w = multi.x, follower.offset[2].w = multi.y, follower.offset[3].w = multi.z;
    follower.multi = 1;
    return follower;
}

// Find the guides around a candidate. `root` receives its root.
static struct trio find_candidate_trio(const struct scalp* scalp, uint32_t candidate, uint32_t* random,
                                       hair_vec3* root)
{
    const struct hair_groom_builder* builder = scalp->builder;
    const struct hair_scalp_point* point = &builder->scalp_points[candidate];
    const uint32_t* vertex = builder->desc->scalp_triangles + 3 * (size_t)point->triangle;
    struct trio trio;
    bool rooted = true;
    *root = (hair_vec3){0};
    for (uint32_t k = 0; k < 3; ++k) {
        *root = hair_add(*root, hair_scale(hair_scalp_corner(builder, point->triangle, k), point->weight[k]));
        trio.guide[k] = scalp->guide_at[vertex[k]];
        trio.weight[k] = point->weight[k];
        rooted &= trio.guide[k] != NONE;
    }
    if (!rooted) trio = find_trio(scalp, *root);
    draw_first(&trio, random);
    if (is_mixed(builder->groom, &trio)) {
        trio = find_trio_in_group(scalp, *root, trio.guide[0]);
        draw_first(&trio, random);
    }
    respect_partings(builder->groom, &trio);
    return trio;
}

// Grow the follower of a candidate, or only write its guides.
static void grow_candidate(const struct scalp* scalp, uint32_t candidate)
{
    struct hair_groom_builder* builder = scalp->builder;
    uint32_t random = hair_candidate_random(builder, hair_candidate_number(builder, candidate));
    hair_vec3 root;
    struct trio trio = find_candidate_trio(scalp, candidate, &random, &root);
    if (scalp->mixes) {
        scalp->mixes[candidate] = hair_mix_guides(builder, trio.guide, trio.weight[1], trio.weight[2]);
        return;
    }
    HAIR_ASSERT(builder->place[candidate] < builder->groom->info.follower_count);
    builder->groom->followers[builder->place[candidate]] =
        grow_follower(builder->groom, &trio, root, &random);
}

static void grow_some_candidates(uint32_t index, void* data)
{
    const struct scalp* scalp = data;
    uint32_t end = hair_division_end(&scalp->division, index);
    for (uint32_t i = index * scalp->division.each; i < end; ++i) grow_candidate(scalp, i);
}

static hair_result grow_all(struct scalp* scalp)
{
    const struct hair_groom_builder* builder = scalp->builder;
    HAIR_TRY(hair_kd_tree_build(builder->host, (struct hair_point_set){builder->groom->roots, 3},
                                builder->groom->info.guide_count, &scalp->roots));
    for (uint32_t i = 0; i < builder->desc->scalp_vertex_count; ++i)
        scalp->guide_at[i] = find_guide_at(scalp, i);
    hair_run_tasks(&builder->groom->tasks, grow_some_candidates, scalp, scalp->division.tasks);
    hair_kd_tree_free(builder->host, &scalp->roots);
    return HAIR_OK;
}

hair_result hair_scalp_mixes(struct hair_groom_builder* builder, struct hair_strand_mix* out)
{
    struct scalp scalp = {.builder = builder,
                          .mixes = out,
                          .division = hair_divide(builder->candidate_count, HAIR_MIN_TASK_STRANDS)};
    scalp.guide_at = hair_alloc(builder->host, builder->desc->scalp_vertex_count, sizeof *scalp.guide_at);
    hair_result result = scalp.guide_at ? grow_all(&scalp) : hair_fail_memory(builder->host, "followers");
    hair_free(builder->host, scalp.guide_at);
    return result;
}

hair_result hair_scalp_followers(struct hair_groom_builder* builder)
{
    return hair_scalp_mixes(builder, NULL);
}
