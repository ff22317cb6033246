// bounds.c - bounds of the hair: the reach of each patch, and the sphere inside the head. They tell
// where no hair is visible.
#include "lib/groom/groom_builder.h"

#include <string.h>

// Radius of the sphere as a fraction of the distance of the nearest root.
#define WITHIN 0.95
// Minimum distance of a root from the centre, as a fraction of the mean. Nearer roots lie on no
// sphere.
#define UNEVEN 0.5

static hair_vec3 xyz(hair_vec4 v)
{
    return hair_v3(v.x, v.y, v.z);
}

// Return a bound of the distance of a follower from `from`, along one of its guides.
static float reach_along(const struct hair_groom* groom, const struct hair_follower* follower, uint32_t guide,
                         hair_vec3 from)
{
    HAIR_ASSERT(guide < groom->info.guide_count);
    return hair_distance(hair_guide_root(groom, guide), from) +
           follower->length_ratio * groom->guides[guide].arc_length;
}

// Return a bound of the distance of a follower from `from`. The follower is at most as far from its
// guides as its control points. A follower with a shape of its own is at most its length from its
// root.
static float follower_reach(const struct hair_groom* groom, const struct hair_follower* follower,
                            hair_vec3 from)
{
    const hair_vec4* offset = follower->offset;
    float max = reach_along(groom, follower, follower->guide0, from), away = 0;
    for (int i = 0; i < 4; ++i) away = fmaxf(away, hair_length(xyz(offset[i])));
    if (follower->multi > 0) {
        max = fmaxf(max, reach_along(groom, follower, follower->guide1, from));
        max = fmaxf(max, reach_along(groom, follower, follower->guide2, from));
        away = fmaxf(away, hair_length(hair_v3(offset[1].w, offset[2].w, offset[3].w)));
    }
    return max + away;
}

static void measure_patch(const struct hair_groom* groom, struct hair_patch* patch)
{
    const struct hair_follower* follower = groom->followers + patch->first;
    HAIR_ASSERT(patch->count > 0 && patch->first + patch->count <= groom->info.follower_count);
    patch->guide = follower->guide0;
    patch->importance = 1;
    hair_vec3 from = hair_guide_root(groom, patch->guide);
    for (uint32_t j = 0; j < patch->count; ++j) {
        float length = follower[j].length_ratio * groom->guides[follower[j].guide0].arc_length;
        patch->reach = fmaxf(patch->reach, follower_reach(groom, &follower[j], from));
        patch->longest = fmaxf(patch->longest, length);
    }
}

struct patch_work {
    struct hair_groom* groom;
    struct hair_division division; // of the patches
};

static void measure_patches(uint32_t index, void* data)
{
    const struct patch_work* work = data;
    uint32_t end = hair_division_end(&work->division, index);
    for (uint32_t i = index * work->division.each; i < end; ++i)
        measure_patch(work->groom, &work->groom->patches[i]);
}

void hair_measure_patches(struct hair_groom* groom)
{
    struct patch_work work = {.groom = groom, .division = hair_divide(groom->info.patch_count, 1)};
    hair_run_tasks(&groom->tasks, measure_patches, &work, work.division.tasks);
}

// Solve by Gaussian elimination with pivoting. Return false if there is no unique solution.
static bool solve(double m[4][5], double out[4])
{
    for (int k = 0; k < 4; ++k) {
        int pivot = k;
        for (int i = k + 1; i < 4; ++i)
            if (fabs(m[i][k]) > fabs(m[pivot][k])) pivot = i;
        if (!(fabs(m[pivot][k]) > 1e-9)) return false;
        for (int j = 0; j < 5; ++j) {
            double kept = m[k][j];
            m[k][j] = m[pivot][j];
            m[pivot][j] = kept;
        }
        for (int i = k + 1; i < 4; ++i)
            for (int j = 4; j >= k; --j) m[i][j] -= m[i][k] / m[k][k] * m[k][j];
    }
    for (int k = 3; k >= 0; --k) {
        out[k] = m[k][4];
        for (int j = k + 1; j < 4; ++j) out[k] -= m[k][j] * out[j];
        out[k] /= m[k][k];
    }
    return true;
}

// Fit a sphere to all roots by least squares. With the centre c and the radius r its equation is
// |x|^2 = 2 c x + k, where k = r^2 - |c|^2. Roots are taken relative to the first root and in units
// of the greatest distance from it, which limits rounding.
static bool fit(const struct hair_groom* groom, double center[3])
{
    double m[4][5] = {{0}}, x[4], unit = 0;
    hair_vec3 first = hair_guide_root(groom, 0);
    uint32_t count = groom->info.guide_count;
    for (uint32_t i = 0; i < count; ++i)
        unit = fmax(unit, (double)hair_distance(hair_guide_root(groom, i), first));
    if (!(unit > 0)) return false;
    for (uint32_t i = 0; i < count; ++i) {
        hair_vec3 p = hair_sub(hair_guide_root(groom, i), first);
        double row[5] = {(double)p.x / unit, (double)p.y / unit, (double)p.z / unit, 1, 0};
        for (int k = 0; k < 3; ++k) row[4] += row[k] * row[k];
        for (int k = 0; k < 4; ++k)
            for (int j = 0; j < 5; ++j) m[k][j] += row[k] * row[j] / count;
    }
    HAIR_ASSERT(count > 0);
    if (!solve(m, x)) return false;
    const float from[3] = {first.x, first.y, first.z};
    for (int k = 0; k < 3; ++k) center[k] = (double)from[k] + 0.5 * unit * x[k];
    return true;
}

hair_vec4 hair_find_head_sphere(const struct hair_groom* groom)
{
    double center[3], min = INFINITY, sum = 0;
    uint32_t count = groom->info.guide_count;
    if (!fit(groom, center)) return (hair_vec4){0, 0, 0, 0};
    hair_vec3 middle = {(float)center[0], (float)center[1], (float)center[2]};
    for (uint32_t i = 0; i < count; ++i) {
        double away = (double)hair_distance(hair_guide_root(groom, i), middle);
        min = fmin(min, away);
        sum += away;
    }
    if (!(min >= UNEVEN * sum / count) || !isfinite(sum)) return (hair_vec4){0, 0, 0, 0};
    return (hair_vec4){middle.x, middle.y, middle.z, (float)(WITHIN * min)};
}
