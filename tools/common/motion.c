// motion.c - Pose of a head over time, by keyframes and a smooth curve through them.
#include "tools/common/motion.h"

#include <cglm/cglm.h>

#include <string.h>

#define CHANNELS 6

static float channel(const struct hair_key* key, int i)
{
    return i < 3 ? key->rotation[i] : key->position[i - 3];
}

// Return the slope of a channel at key k, the slope of the chord between its neighbours. The slope
// is 0 at either end, so that the head starts and stops softly.
static float slope(const struct hair_motion* motion, uint32_t k, int i)
{
    if (k == 0 || k + 1 >= motion->count) return 0;
    const struct hair_key* before = &motion->key[k - 1];
    const struct hair_key* after = &motion->key[k + 1];
    return (channel(after, i) - channel(before, i)) / (after->time - before->time);
}

// Interpolate between keys k and k + 1 with a cubic Hermite curve.
static float between(const struct hair_motion* motion, uint32_t k, float time, int i)
{
    const struct hair_key* a = &motion->key[k];
    const struct hair_key* b = &motion->key[k + 1];
    float h = b->time - a->time, t = (time - a->time) / h, t2 = t * t, t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * channel(a, i) + (t3 - 2 * t2 + t) * h * slope(motion, k, i) +
           (3 * t2 - 2 * t3) * channel(b, i) + (t3 - t2) * h * slope(motion, k + 1, i);
}

static void pose_at(const struct hair_motion* motion, float time, float pose[CHANNELS])
{
    uint32_t k = 0;
    while (k + 1 < motion->count && motion->key[k + 1].time <= time) ++k;
    bool held = k + 1 == motion->count || time <= motion->key[0].time;
    for (int i = 0; i < CHANNELS; ++i)
        pose[i] = held ? channel(&motion->key[k], i) : between(motion, k, time, i);
}

void hair_motion_at(const struct hair_motion* motion, float time, float transform[16])
{
    float pose[CHANNELS] = {0};
    if (motion->count) pose_at(motion, time, pose);
    for (int i = 0; i < 3; ++i) {
        pose[i] += motion->pose.rotation[i];
        pose[3 + i] += motion->pose.position[i];
    }

    vec3 pivot = {motion->pivot[0], motion->pivot[1], motion->pivot[2]}, back;
    mat4 m = GLM_MAT4_IDENTITY_INIT;
    versor yaw, pitch, roll, turn;
    glm_quat(yaw, glm_rad(pose[0]), 0, 1, 0);
    glm_quat(pitch, glm_rad(pose[1]), 1, 0, 0);
    glm_quat(roll, glm_rad(pose[2]), 0, 0, 1);
    glm_quat_mul(yaw, pitch, turn);
    glm_quat_mul(turn, roll, turn);

    glm_translate(m, (vec3){pose[3], pose[4], pose[5]});
    glm_translate(m, pivot);
    glm_quat_rotate(m, turn, m);
    glm_vec3_negate_to(pivot, back);
    glm_translate(m, back);
    memcpy(transform, m, sizeof m);
}
