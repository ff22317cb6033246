// shape.c - followers with the shape of their own strand, which move with several guides.
//
// A follower of full strands is its own strand at rest plus the weighted displacements of the
// guides that are most like it. glsl/shared/groom.h has the formula. A displacement is scaled by
// the ratio of the lengths, because a shorter strand that turns by the same angles moves less.
#include "lib/groom/groom_builder.h"

// Maximum ratio of the lengths of a follower and a guide. Guides that are much shorter tell little.
#define MAX_SCALE 2.0f
// Weight of the distances of guides against the error of the combination of their features. This
// weight gave the smallest error of followers in hair-bench.
#define DISTANCE_WEIGHT 0.3

static hair_vec3 in_frame_at_root(const struct hair_guide_spline* spline, hair_vec3 v)
{
    return hair_rotate(hair_quat_conjugate(spline->frame[0]), v);
}

void hair_shape_guide(struct hair_groom* groom, uint32_t guide, const struct hair_guide_spline* spline)
{
    hair_vec4* out = groom->guide_shapes + (size_t)spline->count * guide;
    for (uint32_t k = 0; k < spline->count; ++k) {
        hair_vec3 at = in_frame_at_root(spline, hair_sub(spline->position[k], spline->position[0]));
        out[k] = (hair_vec4){at.x, at.y, at.z, 0};
    }
}

// Solve m x = (1, 1, 1) by Cholesky's method. m is symmetric and positive definite.
static void solve_for_ones(double m[HAIR_FOLLOWED][HAIR_FOLLOWED], double x[HAIR_FOLLOWED])
{
    for (int i = 0; i < HAIR_FOLLOWED; ++i) {
        x[i] = 1;
        for (int j = 0; j <= i; ++j) {
            for (int k = 0; k < j; ++k) m[i][j] -= m[i][k] * m[j][k];
            m[i][j] = i == j ? sqrt(m[i][i]) : m[i][j] / m[j][j];
            if (j < i) x[i] -= m[i][j] * x[j];
        }
        x[i] /= m[i][i];
    }
    for (int i = HAIR_FOLLOWED - 1; i >= 0; --i) {
        for (int k = i + 1; k < HAIR_FOLLOWED; ++k) x[i] -= m[k][i] * x[k];
        x[i] /= m[i][i];
    }
}

// Weigh guides so that the combination of their features is near to the strand's (Roweis and Saul
// 2000, "Nonlinear dimensionality reduction by locally linear embedding"). The weights minimize
//
//   |sum w_i (f_i - f)|^2 + DISTANCE_WEIGHT sum w_i^2 |f_i - f|^2
//
// with the sum 1. Guides from which the strand diverges are far away and hardly count.
static void combine_features(const struct hair_groom_builder* builder, uint32_t strand,
                             double weight[HAIR_FOLLOWED])
{
    const struct hair_kd_neighbor* near = builder->near + HAIR_FOLLOWED * (size_t)strand;
    const float* own = builder->features + HAIR_FEATURES * (size_t)strand;
    double away[HAIR_FOLLOWED][HAIR_FEATURES], m[HAIR_FOLLOWED][HAIR_FOLLOWED] = {{0}}, trace = 0, sum = 0;
    for (int i = 0; i < HAIR_FOLLOWED; ++i) {
        const float* guide = builder->features + HAIR_FEATURES * (size_t)builder->chosen[near[i].index];
        for (int a = 0; a < HAIR_FEATURES; ++a) away[i][a] = (double)guide[a] - (double)own[a];
    }
    for (int i = 0; i < HAIR_FOLLOWED; ++i) {
        for (int j = 0; j < HAIR_FOLLOWED; ++j)
            for (int a = 0; a < HAIR_FEATURES; ++a) m[i][j] += away[i][a] * away[j][a];
        trace += m[i][i];
    }
    for (int i = 0; i < HAIR_FOLLOWED; ++i) m[i][i] += DISTANCE_WEIGHT * m[i][i] + 1e-6 * trace + 1e-12;
    solve_for_ones(m, weight);
    for (int i = 0; i < HAIR_FOLLOWED; ++i) sum += weight[i];
    HAIR_ASSERT(sum > 0);
    for (int i = 0; i < HAIR_FOLLOWED; ++i) weight[i] /= sum;
}

static void weigh_guides(const struct hair_groom_builder* builder, uint32_t strand,
                         struct hair_follower* follower)
{
    const struct hair_kd_neighbor* near = builder->near + HAIR_FOLLOWED * (size_t)strand;
    double combined[HAIR_FOLLOWED];
    float weight[HAIR_FOLLOWED];
    combine_features(builder, strand, combined);
    for (int i = 0; i < HAIR_FOLLOWED; ++i) {
        float scale = builder->length[strand] / builder->groom->guides[near[i].index].arc_length;
        weight[i] = (float)combined[i] * fminf(scale, MAX_SCALE);
    }
    HAIR_ASSERT(follower->guide0 == near[0].index);
    follower->guide1 = near[1].index;
    follower->guide2 = near[2].index;
    follower->offset[1].w = weight[0];
    follower->weight1 = weight[1];
    follower->weight2 = weight[2];
}

// Put a number in [-1, 1] into 16 bits, as unpackSnorm2x16() of GLSL reads it.
static uint32_t pack(float x)
{
    return (uint32_t)(int32_t)lroundf(32767 * fminf(fmaxf(x, -1), 1)) & 0xffffu;
}

// Write the vertices in units of `unit`, in pairs. A vertex beyond each end continues the shape.
static void pack_shape(const hair_vec3* vertex, uint32_t count, float unit, uint32_t* out)
{
    for (uint32_t k = 0; k < 2 * HAIR_SHAPE_TEXELS(count); ++k) {
        hair_vec3 at = vertex[k < count + 2 ? k : count + 1];
        out[2 * k] = pack(at.x / unit) | pack(at.y / unit) << 16;
        out[2 * k + 1] = pack(at.z / unit);
    }
}

void hair_shape_follower(const struct hair_groom_builder* builder, uint32_t strand, uint32_t place,
                         const struct hair_guide_spline* spline, struct hair_follower* follower)
{
    struct hair_groom* groom = builder->groom;
    uint32_t count = groom->shape_vertices;
    const float* positions = builder->strands.positions + 3 * (size_t)builder->first[strand];
    float points[3 * HAIR_MAX_GUIDE_VERTICES], unit = 0;
    hair_vec3 vertex[HAIR_MAX_GUIDE_VERTICES + 2];
    HAIR_ASSERT(2 <= count && count <= HAIR_MAX_GUIDE_VERTICES);
    hair_strand_resample(positions, builder->strands.vertices[strand], points, count);
    for (uint32_t k = 0; k < count; ++k)
        vertex[k + 1] =
            in_frame_at_root(spline, hair_sub(hair_load3(points + 3 * (size_t)k), hair_load3(points)));
    vertex[0] = hair_sub(hair_scale(vertex[1], 2), vertex[2]);
    vertex[count + 1] = hair_sub(hair_scale(vertex[count], 2), vertex[count - 1]);
    for (uint32_t k = 0; k < count + 2; ++k)
        unit = fmaxf(unit, fmaxf(fabsf(vertex[k].x), fmaxf(fabsf(vertex[k].y), fabsf(vertex[k].z))));
    HAIR_ASSERT(unit > 0 && spline->length > 0);
    hair_vec3 root = in_frame_at_root(spline, hair_sub(hair_load3(points), spline->position[0]));
    follower->multi = -1;
    follower->length_ratio = builder->length[strand] / spline->length;
    follower->offset[0].x = root.x;
    follower->offset[0].y = root.y;
    follower->offset[0].z = root.z;
    follower->offset[2].w = unit;
    follower->offset[3].w = (float)place;
    weigh_guides(builder, strand, follower);
    uint32_t* shapes = (uint32_t*)(groom->followers + groom->info.follower_count);
    pack_shape(vertex, count, unit, shapes + (size_t)4 * HAIR_SHAPE_TEXELS(count) * place);
}
