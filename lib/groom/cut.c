// cut.c - guides and followers of a groom that have been cut to a fraction of their length.
//
// A guide that is cut keeps the vertices before its new tip, so that nothing changes for them. The
// tip lies on the line of its last segment. A last segment of less than SHORTEST of that in the
// groom would need much shorter substeps. The segment before it is then longer instead.
#include "lib/groom/groom.h"

#include "lib/base/math.h"

#include <float.h>
#include <string.h>

#define SHORTEST 0.25f

// Return the last segment of a guide that keeps `kept` metres, and set `last` to its length, m.
static uint32_t find_last_segment(const struct hair_guide* guide, const struct hair_rest* rest, double kept,
                                  float* last)
{
    double start = 0;
    uint32_t k = 0;
    for (; k + 2 < guide->count && start + (double)rest[k].position.w < kept; ++k)
        start += (double)rest[k].position.w;
    *last = (float)fmax(kept - start, 0);
    float shortest = SHORTEST * rest[k].position.w;
    if (*last >= shortest) return k;
    if (k == 0) {
        *last = shortest;
        return 0;
    }
    *last += rest[k - 1].position.w;
    return k - 1;
}

void hair_groom_cut_guide(const struct hair_groom* groom, uint32_t guide, float fraction,
                          struct hair_guide* out, struct hair_rest* rest)
{
    const struct hair_guide* whole = &groom->guides[guide];
    const struct hair_rest* from = groom->rest + whole->first;
    HAIR_ASSERT(0 <= fraction && fraction <= 1);
    *out = *whole;
    memcpy(rest, from, whole->count * sizeof *rest);
    if (fraction >= 1) return;
    float last;
    uint32_t k = find_last_segment(whole, from, (double)fraction * (double)whole->arc_length, &last);
    hair_vec3 at = hair_v3(from[k].position.x, from[k].position.y, from[k].position.z);
    hair_vec3 to = hair_v3(from[k + 1].position.x, from[k + 1].position.y, from[k + 1].position.z);
    hair_vec3 tip = hair_add(at, hair_scale(hair_normalize(hair_sub(to, at), hair_v3(0, 1, 0)), last));
    double length = (double)last;
    for (uint32_t i = 0; i < k; ++i) length += (double)from[i].position.w;
    out->count = k + 2;
    out->arc_length = (float)length;
    rest[k].position.w = last;
    rest[k + 1] = (struct hair_rest){.position = {tip.x, tip.y, tip.z, 0}, .frame = from[k].frame};
    rest[k + 1].position.w = fmaxf(whole->arc_length - out->arc_length, FLT_MIN);
}

float hair_groom_follower_mean(const struct hair_groom* groom, uint32_t follower, const float* guide_values,
                               uint32_t stride)
{
    const struct hair_follower* f = &groom->followers[follower];
    float own = guide_values[(size_t)stride * f->guide0];
    if (f->multi == 0) return own;
    float w1 = f->weight1, w2 = f->weight2, w0 = f->multi < 0 ? f->offset[1].w : 1 - w1 - w2;
    float sum = w0 + w1 + w2;
    if (!(sum > 0)) return own;
    // Weights that are rounded must not change the value of equal guides.
    float other1 = guide_values[(size_t)stride * f->guide1],
          other2 = guide_values[(size_t)stride * f->guide2];
    return own + (w1 * (other1 - own) + w2 * (other2 - own)) / sum;
}

float hair_groom_follower_fraction(const struct hair_groom* groom, uint32_t follower,
                                   const float* guide_fraction)
{
    return fminf(fmaxf(hair_groom_follower_mean(groom, follower, guide_fraction, 1), 0), 1);
}
