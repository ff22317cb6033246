// bind.c - followers of full strands, each bound to the guide nearest to it along its whole length.
//
// A follower is its guide plus a cubic Bezier curve in the guide's frame. The curve is fitted to
// the strand at rest by least squares. The root is exact.
#include "lib/groom/groom_builder.h"
#include "lib/groom/guide_spline.h"

#include <string.h>

#define SAMPLES 16 // Samples of a strand besides its root. More samples hardly change the fit.
#define AXES (3 * HAIR_SHAPE_SAMPLES)

static float distance_squared(const float* a, const float* b)
{
    float sum = 0;
    for (int i = 0; i < AXES; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

static void gather_shape_samples(const struct hair_groom_builder* builder, float* shape_samples)
{
    for (uint32_t i = 0; i < builder->groom->info.guide_count; ++i)
        memcpy(shape_samples + AXES * (size_t)i, builder->shape_samples + AXES * (size_t)builder->chosen[i],
               AXES * sizeof *shape_samples);
}

static hair_result find_owners(struct hair_groom_builder* builder, const float* shape_samples)
{
    struct hair_kd_tree tree;
    HAIR_TRY(hair_kd_tree_build(builder->host, (struct hair_point_set){shape_samples, AXES},
                                builder->groom->info.guide_count, &tree));
    for (uint32_t i = 0; i < builder->strands.strand_count; ++i) {
        // The guide of the strand's cell is near, so the search only has to find a nearer one.
        HAIR_ASSERT(builder->owner[i] < builder->groom->info.guide_count);
        const float* own = builder->shape_samples + AXES * (size_t)i;
        struct hair_kd_neighbor near = {
            builder->owner[i], distance_squared(own, shape_samples + AXES * (size_t)builder->owner[i])};
        hair_kd_tree_nearest(&tree, own, &near, 1, 1);
        builder->owner[i] = near.index;
    }
    hair_kd_tree_free(builder->host, &tree);
    for (uint32_t i = 0; i < builder->groom->info.guide_count; ++i) builder->owner[builder->chosen[i]] = i;
    return HAIR_OK;
}

// Sort strands by guide with a counting sort.
static void sort_strands(struct hair_groom_builder* builder)
{
    uint32_t strands = builder->strands.strand_count;
    for (uint32_t i = 0; i < strands; ++i) ++builder->bin_candidates[builder->owner[i]];
    hair_number_candidates(builder);
    HAIR_ASSERT(builder->candidate_count == strands);
    for (uint32_t i = 0; i < strands; ++i) builder->strand_of[builder->bin_first[builder->owner[i]]++] = i;
    for (uint32_t i = 0; i < builder->bin_count; ++i) builder->bin_first[i] -= builder->bin_candidates[i];
}

hair_result hair_strand_candidates(struct hair_groom_builder* builder)
{
    uint32_t strands = builder->strands.strand_count, guides = builder->groom->info.guide_count;
    HAIR_TRY(hair_guide_bins(builder));
    float* shape_samples = hair_alloc(builder->host, guides, AXES * sizeof *shape_samples);
    builder->strand_of = hair_alloc(builder->host, strands, sizeof *builder->strand_of);
    if (!shape_samples || !builder->strand_of) {
        hair_free(builder->host, shape_samples);
        return hair_fail_memory(builder->host, "the binding of strands to guides");
    }
    gather_shape_samples(builder, shape_samples);
    hair_result result = find_owners(builder, shape_samples);
    hair_free(builder->host, shape_samples);
    if (!result) sort_strands(builder);
    return result;
}

// Least-squares fit of a cubic Bezier curve to values at even t up to 1, with control point 0
// given. Control points 1 to 3 are `weight` times the values minus the contribution of control
// point 0. `weight` solves the normal equations and is equal for all strands.
struct fit {
    float root[SAMPLES]; // Bernstein polynomial of control point 0
    float weight[3][SAMPLES];
};

static void bernstein(double t, double basis[4])
{
    double s = 1 - t;
    basis[0] = s * s * s, basis[1] = 3 * s * s * t, basis[2] = 3 * s * t * t, basis[3] = t * t * t;
}

// Invert a symmetric matrix by cofactors.
static void invert(double m[3][3], double out[3][3])
{
    double cofactor[3][3];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
            cofactor[i][j] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
        }
    double determinant = m[0][0] * cofactor[0][0] + m[0][1] * cofactor[0][1] + m[0][2] * cofactor[0][2];
    HAIR_ASSERT(determinant > 0);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) out[i][j] = cofactor[i][j] / determinant;
}

static struct fit prepare_fit(void)
{
    struct fit fit;
    double basis[SAMPLES][4], normal[3][3] = {0}, inverse[3][3];
    for (int k = 0; k < SAMPLES; ++k) {
        bernstein((k + 1.0) / SAMPLES, basis[k]);
        fit.root[k] = (float)basis[k][0];
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) normal[i][j] += basis[k][i + 1] * basis[k][j + 1];
    }
    invert(normal, inverse);
    for (int k = 0; k < SAMPLES; ++k)
        for (int i = 0; i < 3; ++i)
            fit.weight[i][k] = (float)(inverse[i][0] * basis[k][1] + inverse[i][1] * basis[k][2] +
                                       inverse[i][2] * basis[k][3]);
    return fit;
}

static hair_vec3 in_frame(struct hair_guide_spline_point guide, hair_vec3 p)
{
    return hair_rotate(hair_quat_conjugate(guide.frame), hair_sub(p, guide.position));
}

static void fit_offset(const struct fit* fit, const struct hair_guide_spline* guide, const float* points,
                       struct hair_follower* follower)
{
    hair_vec3 control[4] = {in_frame(hair_guide_spline_at(guide, 0), hair_load3(points))};
    for (int k = 0; k < SAMPLES; ++k) {
        float u = (float)(k + 1) / SAMPLES * follower->length_ratio;
        hair_vec3 away = in_frame(hair_guide_spline_at(guide, u), hair_load3(points + 3 * (k + 1)));
        away = hair_sub(away, hair_scale(control[0], fit->root[k]));
        for (int i = 0; i < 3; ++i)
            control[i + 1] = hair_add(control[i + 1], hair_scale(away, fit->weight[i][k]));
    }
    for (int i = 0; i < 4; ++i) {
        follower->offset[i].x = control[i].x;
        follower->offset[i].y = control[i].y;
        follower->offset[i].z = control[i].z;
    }
}

static struct hair_follower bind_follower(const struct hair_groom_builder* builder, const struct fit* fit,
                                          uint32_t candidate, uint32_t guide,
                                          const struct hair_guide_spline* spline)
{
    uint32_t strand = builder->strand_of[candidate];
    uint32_t random = hair_candidate_random(builder, strand);
    struct hair_follower follower = hair_own_follower(guide, &random);
    if (strand == builder->chosen[guide]) return follower;
    HAIR_ASSERT(spline->length > 0 && builder->length[strand] > 0);
    follower.length_ratio = builder->length[strand] / spline->length;
    float points[3 * (SAMPLES + 1)];
    hair_strand_resample(builder->strands.positions + 3 * (size_t)builder->first[strand],
                         builder->strands.vertices[strand], points, SAMPLES + 1);
    fit_offset(fit, spline, points, &follower);
    return follower;
}

hair_result hair_strand_followers(struct hair_groom_builder* builder)
{
    struct fit fit = prepare_fit();
    for (uint32_t guide = 0; guide < builder->bin_count; ++guide) {
        struct hair_guide_spline spline;
        hair_guide_spline_fit(builder->groom, guide, &spline);
        for (uint32_t i = 0; i < builder->bin_candidates[guide]; ++i) {
            uint32_t candidate = builder->bin_first[guide] + i;
            HAIR_ASSERT(builder->place[candidate] < builder->groom->info.follower_count);
            builder->groom->followers[builder->place[candidate]] =
                bind_follower(builder, &fit, candidate, guide, &spline);
        }
    }
    return HAIR_OK;
}
