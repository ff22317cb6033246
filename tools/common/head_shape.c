// head_shape.c - Distance function of a mannequin with skull, face, ears, neck, shoulders, and a
// garment below the collar.
// Based on Quilez, "Distance functions" and "Smooth minimum". The face follows the canon of thirds
// (hairline to brow, brow to nose, nose to chin), with the eyes half-way up the head.
#include "tools/common/head_shape.h"

#include <math.h>

typedef struct head_point point;

#define PI 3.14159265f

static float clamp(float x, float from, float to)
{
    return fminf(fmaxf(x, from), to);
}

static float smooth(float from, float to, float x)
{
    float t = clamp((x - from) / (to - from), 0, 1);
    return t * t * (3 - 2 * t);
}

static float mix(float a, float b, float t)
{
    return a + (b - a) * t;
}
static point sub(point a, point b)
{
    return (point){a.x - b.x, a.y - b.y, a.z - b.z};
}
static float dot(point a, point b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static float length(point a)
{
    return sqrtf(dot(a, a));
}

// Compute the union of two distances with a fillet of about k metres.
static float join(float a, float b, float k)
{
    float h = fmaxf(k - fabsf(a - b), 0) / k;
    return fminf(a, b) - h * h * k * 0.25f;
}

// Compute the difference of two distances with a fillet of about k metres.
static float carve(float a, float b, float k)
{
    return -join(-a, b, k);
}

// Compute the distance to an ellipsoid to first order. The distance is exact on the surface.
static float ellipsoid(point p, point center, point axes)
{
    point q = sub(p, center);
    point once = {q.x / axes.x, q.y / axes.y, q.z / axes.z};
    point twice = {once.x / axes.x, once.y / axes.y, once.z / axes.z};
    float k = length(once), slope = length(twice);
    return slope > 1e-6f ? k * (k - 1) / slope : -fminf(axes.x, fminf(axes.y, axes.z));
}

// Compute the distance to a capsule whose radius changes linearly from r to s.
static float limb(point p, point a, point b, float r, float s)
{
    point axis = sub(b, a), q = sub(p, a);
    float t = clamp(dot(q, axis) / dot(axis, axis), 0, 1);
    return length(sub(q, (point){axis.x * t, axis.y * t, axis.z * t})) - mix(r, s, t);
}

// Skull and scalp ---------------------------------------------------------------------------------

static float head_sphere(point p)
{
    return ellipsoid(p, (point){0, 1.63f, 0}, (point){0.077f, 0.098f, 0.096f});
}

// Return the height of p above the hairline of the built-in haircuts, in m.
static float above_hairline(point p)
{
    // Azimuth from the face, in degrees, and height, in m.
    static const float hairline[][2] = {{0, 1.692f},   {22, 1.693f},  {40, 1.694f},  {52, 1.679f},
                                        {62, 1.652f},  {71, 1.624f},  {80, 1.611f},  {89, 1.626f},
                                        {98, 1.639f},  {108, 1.634f}, {117, 1.608f}, {127, 1.580f},
                                        {142, 1.564f}, {160, 1.559f}, {180, 1.558f}};
    float azimuth = atan2f(p.x / 0.077f, p.z / 0.096f) * (180 / PI);
    int i = 0;
    while (i < 13 && hairline[i + 1][0] < azimuth) ++i;
    float t = (azimuth - hairline[i][0]) / (hairline[i + 1][0] - hairline[i][0]);
    return p.y - mix(hairline[i][1], hairline[i + 1][1], clamp(t, 0, 1));
}

// Mirror p to x > 0 with a rounded crease, so that two mirrored halves meet smoothly.
static point fold(point p, float radius)
{
    return (point){sqrtf(p.x * p.x + radius * radius), p.y, p.z};
}

// Face: its left half (x > 0) ---------------------------------------------------------------------

static float bones(point p, float d)
{
    d = join(d, ellipsoid(p, (point){0, 1.580f, 0.038f}, (point){0.0590f, 0.062f, 0.052f}), 0.020f);
    d = join(d,
             limb(fold(p, 0.010f), (point){0.039f, 1.545f, 0.012f}, (point){0.012f, 1.519f, 0.070f}, 0.014f,
                  0.013f),
             0.030f);
    d = join(d, ellipsoid(p, (point){0, 1.550f, 0.043f}, (point){0.045f, 0.038f, 0.045f}), 0.024f);
    d = join(d, ellipsoid(p, (point){0, 1.518f, 0.0735f}, (point){0.019f, 0.0145f, 0.0165f}), 0.016f);
    d = join(d, ellipsoid(p, (point){0.041f, 1.588f, 0.053f}, (point){0.020f, 0.017f, 0.022f}), 0.034f);
    return join(d,
                limb(fold(p, 0.010f), (point){0.006f, 1.637f, 0.0850f}, (point){0.044f, 1.638f, 0.0575f},
                     0.0075f, 0.006f),
                0.016f);
}

// The eyes are closed. The upper lid overlaps the lower lid slightly along the lashes.
#define EYE_X 0.0310f
#define EYE_Y 1.6120f

static float lash_height(float x)
{
    float across = (x - EYE_X) / 0.0155f; // -1 at the inner corner, 1 at the outer
    return EYE_Y - 0.0018f + 0.0010f * across - 0.0042f * fmaxf(1 - across * across, 0);
}

static float eye(point p, float d)
{
    d = carve(d, ellipsoid(p, (point){EYE_X, EYE_Y + 0.002f, 0.0960f}, (point){0.0180f, 0.0115f, 0.0130f}),
              0.020f);
    float ball = ellipsoid(p, (point){EYE_X, EYE_Y, 0.0720f}, (point){0.0150f, 0.0128f, 0.0138f});
    float upper = smooth(-0.0004f, 0.0006f, p.y - lash_height(p.x));
    return join(d, ball - 0.0009f * upper, 0.004f);
}

static float nose(point p, float d)
{
    float n = limb(p, (point){0, 1.622f, 0.0830f}, (point){0, 1.590f, 0.1005f}, 0.0062f, 0.0078f);
    n = join(n, ellipsoid(p, (point){0, 1.5870f, 0.1015f}, (point){0.0090f, 0.0080f, 0.0090f}), 0.008f);
    n = join(n, ellipsoid(p, (point){0.0095f, 1.5835f, 0.0955f}, (point){0.0068f, 0.0062f, 0.0090f}), 0.007f);
    d = join(d, n, 0.012f);
    return carve(d, ellipsoid(p, (point){0.0058f, 1.5772f, 0.0990f}, (point){0.0030f, 0.0026f, 0.0050f}),
                 0.004f);
}

static float mouth(point p, float d)
{
    d = join(d, ellipsoid(p, (point){0, 1.556f, 0.068f}, (point){0.032f, 0.026f, 0.0245f}), 0.018f);
    d = carve(d, limb(p, (point){0, 1.574f, 0.0980f}, (point){0, 1.565f, 0.0980f}, 0.0016f, 0.0026f), 0.006f);
    // Lips are thick in the middle and thin out to the corners.
    point q = fold(p, 0.004f);
    d = join(
        d, limb(q, (point){0.0050f, 1.5582f, 0.0868f}, (point){0.0225f, 1.5545f, 0.0775f}, 0.0054f, 0.0024f),
        0.006f);
    d = join(
        d, limb(q, (point){0.0040f, 1.5502f, 0.0862f}, (point){0.0205f, 1.5532f, 0.0780f}, 0.0058f, 0.0024f),
        0.006f);
    d = carve(
        d, limb(q, (point){0.0040f, 1.5545f, 0.0962f}, (point){0.0250f, 1.5535f, 0.0825f}, 0.0005f, 0.0004f),
        0.005f);
    return carve(d, ellipsoid(p, (point){0, 1.5375f, 0.0965f}, (point){0.016f, 0.004f, 0.006f}), 0.012f);
}

// Return the distance to an ear, turned out by 25 degrees and back by 12. The ear's own axes are
// out of the head, up and back.
static float ear(point p)
{
    point q = sub(p, (point){0.0735f, 1.6030f, -0.008f});
    float out = 0.906f * q.x + 0.423f * q.z, rear = 0.423f * q.x - 0.906f * q.z;
    point e = {out, 0.978f * q.y + 0.208f * rear, 0.978f * rear - 0.208f * q.y};
    float d = ellipsoid(e, (point){0, 0.005f, 0.003f}, (point){0.0075f, 0.0245f, 0.0165f});
    d = join(d, ellipsoid(e, (point){0, -0.019f, -0.003f}, (point){0.0050f, 0.0085f, 0.0075f}), 0.008f);
    float bowl = ellipsoid(e, (point){0.0085f, -0.001f, 0.000f}, (point){0.0065f, 0.0120f, 0.0085f});
    bowl = join(bowl, ellipsoid(e, (point){0.0085f, 0.014f, 0.003f}, (point){0.0040f, 0.0085f, 0.0085f}),
                0.004f);
    d = carve(d, bowl, 0.004f);
    return join(d, ellipsoid(e, (point){0.003f, -0.005f, -0.0105f}, (point){0.0035f, 0.006f, 0.004f}),
                0.004f);
}

// Neck and shoulders ------------------------------------------------------------------------------

static float trunk(point p)
{
    float d = ellipsoid(p, (point){0, 1.270f, -0.015f}, (point){0.163f, 0.150f, 0.098f});
    point q = fold(p, 0.02f);
    d = join(d, limb(q, (point){0.162f, 1.362f, -0.025f}, (point){0.182f, 1.200f, -0.020f}, 0.043f, 0.040f),
             0.05f);
    d = join(d, limb(q, (point){0.030f, 1.434f, -0.032f}, (point){0.158f, 1.370f, -0.025f}, 0.040f, 0.044f),
             0.06f);
    d = join(d, ellipsoid(q, (point){0.062f, 1.330f, 0.045f}, (point){0.080f, 0.075f, 0.035f}), 0.07f);
    d = join(d, ellipsoid(q, (point){0.055f, 1.345f, -0.062f}, (point){0.085f, 0.085f, 0.036f}), 0.04f);
    return join(d, limb(q, (point){0.024f, 1.407f, 0.020f}, (point){0.140f, 1.410f, -0.008f}, 0.006f, 0.006f),
                0.03f);
}

static float neck(point p, float d)
{
    d = join(d, limb(p, (point){0, 1.380f, -0.030f}, (point){0, 1.550f, -0.004f}, 0.049f, 0.046f), 0.05f);
    d = join(d, limb(p, (point){0.050f, 1.560f, -0.018f}, (point){0.012f, 1.412f, 0.018f}, 0.008f, 0.007f),
             0.03f);
    return carve(d, ellipsoid(p, (point){0, 1.404f, 0.034f}, (point){0.010f, 0.010f, 0.008f}), 0.020f);
}

// Return the depth of p below the collar of the garment, in m.
float head_below_collar(point p)
{
    return 1.437f - 0.36f * (p.z + 0.03f) - p.y;
}

float head_distance(point p)
{
    p.x = fabsf(p.x);
    float d = trunk(p);
    float bone = head_sphere(p);
    if (p.y > 1.36f) {
        float head = bone;
        if (p.z > -0.03f && p.y < 1.70f) head = bones(p, head);
        d = p.y < 1.62f ? join(neck(p, d), head, 0.016f) : head;
        if (p.z > 0.04f && p.y > 1.48f && p.y < 1.68f) d = mouth(p, nose(p, eye(p, d)));
        // Only the skull is exposed where hair grows, so that roots lie on the skin.
        if (p.y > 1.52f) d = mix(d, bone, smooth(-0.010f, -0.002f, above_hairline(p)));
        if (p.x > 0.05f && fabsf(p.z) < 0.06f && p.y > 1.53f && p.y < 1.68f) d = join(d, ear(p), 0.005f);
    }
    if (p.y < 1.50f) d -= 0.0025f * smooth(0, 0.004f, head_below_collar(p));
    return fmaxf(d, HEAD_BOTTOM - p.y);
}

void head_color(point p, int is_worn, float rgb[3])
{
    const float skin[3] = {0.39f, 0.255f, 0.195f}, lips[3] = {0.30f, 0.135f, 0.115f},
                hair[3] = {0.11f, 0.07f, 0.055f};
    const float cloth[3] = {0.030f, 0.036f, 0.048f};
    p.x = fabsf(p.x);
    float low = mix(1.5440f, 1.5525f, smooth(0.004f, 0.024f, p.x));
    float high = mix(1.5630f, 1.5560f, smooth(0.004f, 0.025f, p.x));
    float lip = p.z > 0.072f
                    ? smooth(low - 0.001f, low + 0.001f, p.y) * smooth(high + 0.001f, high - 0.001f, p.y)
                    : 0;
    float brow = smooth(0.0032f, 0.0012f, fabsf(p.y - (1.6405f + 0.0035f * sinf((p.x - 0.014f) * 65))));
    float lash = smooth(0.0014f, 0.0004f, fabsf(p.y - lash_height(p.x))) *
                 smooth(0.0165f, 0.0145f, fabsf(p.x - EYE_X));
    float front = smooth(0.045f, 0.055f, p.z);
    brow *= smooth(0.011f, 0.018f, p.x) * smooth(0.051f, 0.044f, p.x) * 0.6f;
    lip *= smooth(0.0255f, 0.0225f, p.x);
    // Hair darkens the skin that it grows from, as on a shaved head.
    float dark = fmaxf(front * fmaxf(brow, 0.8f * lash), 0.88f * smooth(0, 0.010f, above_hairline(p)));
    for (int i = 0; i < 3; ++i) rgb[i] = is_worn ? cloth[i] : mix(mix(skin[i], lips[i], lip), hair[i], dark);
}
