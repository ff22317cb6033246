// bind.c - followers of full strands, each bound to the guide nearest to it along its whole length.
//
// A follower is its guide plus a cubic Bezier curve in the guide's frame. The curve is fitted to
// the strand at rest by least squares. The root is exact.
#include "lib/groom/draft.h"
#include "lib/groom/smoothed.h"

#include <string.h>

#define SAMPLES 16 // Samples of a strand besides its root. More samples hardly change the fit.
#define AXES (3 * HAIR_MARKS)

static float distance_squared(const float* a, const float* b)
{
    float sum = 0;
    for (int i = 0; i < AXES; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

static void gather_marks(const struct hair_draft* draft, float* marks)
{
    for (uint32_t i = 0; i < draft->groom->info.guide_count; ++i)
        memcpy(marks + AXES * (size_t)i, draft->marks + AXES * (size_t)draft->chosen[i],
               AXES * sizeof *marks);
}

static hair_result find_owners(struct hair_draft* draft, const float* marks)
{
    struct hair_tree tree;
    hair_result result =
        hair_tree_build(draft->host, (struct hair_cloud){marks, AXES}, draft->groom->info.guide_count, &tree);
    if (result) return result;
    for (uint32_t i = 0; i < draft->strands.strand_count; ++i) {
        // The guide of the strand's cell is near, so the search only has to find a nearer one.
        HAIR_ASSERT(draft->owner[i] < draft->groom->info.guide_count);
        const float* own = draft->marks + AXES * (size_t)i;
        struct hair_near near = {draft->owner[i],
                                 distance_squared(own, marks + AXES * (size_t)draft->owner[i])};
        hair_tree_nearest(&tree, own, &near, 1, 1);
        draft->owner[i] = near.index;
    }
    hair_tree_free(draft->host, &tree);
    for (uint32_t i = 0; i < draft->groom->info.guide_count; ++i) draft->owner[draft->chosen[i]] = i;
    return HAIR_OK;
}

// Sort strands by guide with a counting sort.
static void sort_strands(struct hair_draft* draft)
{
    uint32_t strands = draft->strands.strand_count;
    for (uint32_t i = 0; i < strands; ++i) ++draft->plot_sprouts[draft->owner[i]];
    hair_number_sprouts(draft);
    HAIR_ASSERT(draft->sprout_count == strands);
    for (uint32_t i = 0; i < strands; ++i) draft->strand_of[draft->plot_first[draft->owner[i]]++] = i;
    for (uint32_t i = 0; i < draft->plot_count; ++i) draft->plot_first[i] -= draft->plot_sprouts[i];
}

hair_result hair_strand_sprouts(struct hair_draft* draft)
{
    uint32_t strands = draft->strands.strand_count, guides = draft->groom->info.guide_count;
    hair_result result = hair_guide_plots(draft);
    if (result) return result;
    float* marks = hair_alloc(draft->host, guides, AXES * sizeof *marks);
    draft->strand_of = hair_alloc(draft->host, strands, sizeof *draft->strand_of);
    if (!marks || !draft->strand_of) {
        hair_free(draft->host, marks);
        return hair_fail_memory(draft->host, "the binding of strands to guides");
    }
    gather_marks(draft, marks);
    result = find_owners(draft, marks);
    hair_free(draft->host, marks);
    if (!result) sort_strands(draft);
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

static hair_vec3 in_frame(struct hair_smoothed_point guide, hair_vec3 p)
{
    return hair_rotate(hair_quat_conjugate(guide.frame), hair_sub(p, guide.position));
}

static void fit_offset(const struct fit* fit, const struct hair_smoothed* guide, const float* points,
                       struct hair_follower* follower)
{
    hair_vec3 control[4] = {in_frame(hair_smoothed_at(guide, 0), hair_load3(points))};
    for (int k = 0; k < SAMPLES; ++k) {
        float u = (float)(k + 1) / SAMPLES * follower->length_ratio;
        hair_vec3 away = in_frame(hair_smoothed_at(guide, u), hair_load3(points + 3 * (k + 1)));
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

static struct hair_follower bind(const struct hair_draft* draft, const struct fit* fit, uint32_t sprout,
                                 uint32_t guide, const struct hair_smoothed* smoothed)
{
    uint32_t strand = draft->strand_of[sprout];
    uint32_t random = hair_sprout_random(draft, strand);
    struct hair_follower follower = hair_own_follower(guide, &random);
    if (strand == draft->chosen[guide]) return follower;
    HAIR_ASSERT(smoothed->length > 0 && draft->length[strand] > 0);
    follower.length_ratio = draft->length[strand] / smoothed->length;
    float points[3 * (SAMPLES + 1)];
    hair_strand_resample(draft->strands.positions + 3 * (size_t)draft->first[strand],
                         draft->strands.vertices[strand], points, SAMPLES + 1);
    fit_offset(fit, smoothed, points, &follower);
    return follower;
}

hair_result hair_strand_followers(struct hair_draft* draft)
{
    struct fit fit = prepare_fit();
    for (uint32_t guide = 0; guide < draft->plot_count; ++guide) {
        struct hair_smoothed smoothed;
        hair_smooth_guide(draft->groom, guide, &smoothed);
        for (uint32_t i = 0; i < draft->plot_sprouts[guide]; ++i) {
            uint32_t sprout = draft->plot_first[guide] + i;
            HAIR_ASSERT(draft->place[sprout] < draft->groom->info.follower_count);
            draft->groom->followers[draft->place[sprout]] = bind(draft, &fit, sprout, guide, &smoothed);
        }
    }
    return HAIR_OK;
}
