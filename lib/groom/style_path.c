// style_path.c - points of a growing guide: added, trimmed, wound into curls.
#include "lib/groom/style_path.h"
#include "lib/groom/style_body.h"

#define PI 3.14159265f
// Number of turns over which a curl changes.
#define VARIATION_TURNS 1.3f
#define DRIFT_TURNS 2.2f // Number of turns over which the axis of a curl drifts.

static float lattice(int x, int y, int z, uint32_t seed)
{
    uint32_t h = hair_hash(seed ^ hair_hash((uint32_t)x ^ hair_hash((uint32_t)y ^ hair_hash((uint32_t)z))));
    return (float)(h >> 8) * (2.0f / 16777216.0f) - 1;
}

float hair_noise(hair_vec3 p, float scale, uint32_t seed)
{
    hair_vec3 q = hair_scale(p, 1 / scale);
    hair_vec3 f = {floorf(q.x), floorf(q.y), floorf(q.z)};
    float u = hair_smooth(0, 1, q.x - f.x), v = hair_smooth(0, 1, q.y - f.y),
          w = hair_smooth(0, 1, q.z - f.z);
    int x = (int)f.x, y = (int)f.y, z = (int)f.z;
    float sum = 0;
    for (int i = 0; i < 8; ++i) {
        int a = i & 1, b = i >> 1 & 1, c = i >> 2;
        sum += (a ? u : 1 - u) * (b ? v : 1 - v) * (c ? w : 1 - w) * lattice(x + a, y + b, z + c, seed);
    }
    return sum;
}

void hair_style_path_add(struct hair_style_path* path, hair_vec3 p)
{
    HAIR_ASSERT(path->count <= HAIR_STYLE_PATH_POINTS);
    if (path->count > 0) {
        float step = hair_distance(p, path->point[path->count - 1]);
        if (step < 1e-6f || path->count == HAIR_STYLE_PATH_POINTS) return;
        path->length += step;
    }
    path->point[path->count++] = p;
}

void hair_style_path_trim(struct hair_style_path* path, float max)
{
    float over = path->length - max;
    if (over <= 0 || path->count < 3) return;
    hair_vec3 *tip = &path->point[path->count - 1], *before = tip - 1;
    float step = hair_distance(*tip, *before);
    *tip = hair_lerp(*tip, *before, fminf(over / step, 0.99f));
    path->length -= fminf(over, 0.99f * step);
}

void hair_style_path_smooth(struct hair_style_path* path, uint32_t rounds)
{
    for (uint32_t round = 0; round < rounds; ++round) {
        hair_vec3 last = path->point[0];
        for (uint32_t i = 1; i + 1 < path->count; ++i) {
            hair_vec3 p = path->point[i];
            path->point[i] = hair_lerp(p, hair_lerp(last, path->point[i + 1], 0.5f), 0.5f);
            last = p;
        }
    }
    path->length = 0;
    for (uint32_t i = 1; i < path->count; ++i)
        path->length += hair_distance(path->point[i], path->point[i - 1]);
}

// Return the relative deviation of a curl at the distance s from the root. `which` selects the
// pitch or the radius, which vary independently.
static float vary(const struct hair_curl* curl, float s, uint32_t which)
{
    if (!(curl->variation > 0)) return 0;
    return curl->variation * hair_noise(hair_v3(s, 0, 0), VARIATION_TURNS * curl->pitch, curl->seed + which);
}

// Return a random number in [-1, 1] that changes slowly along the curl.
static float drift(const struct hair_curl* curl, float s, uint32_t which)
{
    return hair_noise(hair_v3(s, 0, 0), DRIFT_TURNS * curl->pitch, curl->seed + which);
}

void hair_style_path_add_curl(struct hair_style_path* path, const struct hair_curl* curl)
{
    HAIR_ASSERT(path->count >= 2 && curl->pitch > 0);
    hair_vec3 tangent = hair_normalize(hair_sub(path->point[1], path->point[0]), hair_v3(0, -1, 0));
    hair_vec3 across = hair_normalize(hair_tangential(hair_skull_normal(path->point[0]), tangent),
                                      hair_perpendicular(tangent));
    uint32_t count = path->count;
    float s = 0, angle = curl->phase;
    path->count = 1, path->length = 0;
    hair_vec3 last = path->point[0];
    for (uint32_t i = 1; i < count; ++i) {
        hair_vec3 p = path->point[i];
        float step = hair_distance(p, last);
        hair_vec3 next = hair_normalize(hair_sub(p, last), tangent);
        across = hair_normalize(hair_tangential(hair_rotate(hair_quat_between(tangent, next), across), next),
                                across);
        tangent = next, last = p;
        s += step;
        angle += 2 * PI * step / (curl->pitch * (1 + vary(curl, s, 0)));
        float grown = hair_smooth(curl->start, curl->full, s), swell = curl->swell * drift(curl, s, 2);
        float radius = curl->radius * (1 + vary(curl, s, 1) + swell) * grown;
        float x = radius * cosf(angle) + grown * curl->drift * drift(curl, s, 3);
        float z = curl->flat * radius * sinf(angle) + grown * curl->drift * drift(curl, s, 4);
        hair_vec3 along = hair_scale(hair_cross(tangent, across), z);
        hair_vec3 q = hair_add(p, hair_add(hair_scale(across, x), along));
        float inside = hair_body_distance(q);
        if (inside < 0.002f) q = hair_add(q, hair_scale(hair_body_normal(q), fminf(0.002f - inside, radius)));
        hair_style_path_add(path, q);
    }
}
