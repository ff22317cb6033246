// lanes.h - vectors of doubles in which each lane belongs to another guide.
//
// Each operation is that of a single double, without fused operations. A guide's result depends
// neither on its lane, nor on the other lanes, nor on the instructions of the processor.
#ifndef HAIR_ROD_LANES_H
#define HAIR_ROD_LANES_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

// Number of guides that are computed at once.
#define HAIR_LANES 4

// Functions with vectors as arguments are inlined or static, because processors without such
// registers pass them in another way. Compilers warn of functions that other files might call.
#pragma GCC diagnostic ignored "-Wpsabi"
#define HAIR_LANES_INLINE static inline __attribute__((always_inline))

// Unroll the next loop, over at most 6 components. GCC does so by itself only with -O3.
#ifdef __clang__
#define HAIR_LANES_UNROLL _Pragma("unroll")
#else
#define HAIR_LANES_UNROLL _Pragma("GCC unroll 6")
#endif

typedef double hair_lanes __attribute__((vector_size(8 * HAIR_LANES)));
// Result of a comparison. All bits of a lane are equal.
typedef int64_t hair_lane_mask __attribute__((vector_size(8 * HAIR_LANES)));

struct hair_lanes3 {
    hair_lanes x, y, z;
};
// Quaternion with the real part w.
struct hair_lanes4 {
    hair_lanes x, y, z, w;
};

HAIR_LANES_INLINE hair_lanes hair_lanes_of(double value)
{
    return value - (hair_lanes){0};
}
HAIR_LANES_INLINE hair_lanes hair_lanes_select(hair_lane_mask mask, hair_lanes a, hair_lanes b)
{
    return (hair_lanes)((mask & (hair_lane_mask)a) | (~mask & (hair_lane_mask)b));
}
HAIR_LANES_INLINE hair_lanes hair_lanes_max(hair_lanes a, hair_lanes b)
{
    return hair_lanes_select(a > b, a, b);
}
HAIR_LANES_INLINE hair_lanes hair_lanes_min(hair_lanes a, hair_lanes b)
{
    return hair_lanes_select(a < b, a, b);
}
HAIR_LANES_INLINE hair_lanes hair_lanes_abs(hair_lanes a)
{
    return hair_lanes_select(a < 0, -a, a);
}
// sqrt() may set errno, so compilers do not use vectors for it.
HAIR_LANES_INLINE hair_lanes hair_lanes_sqrt(hair_lanes a)
{
    hair_lanes root;
#ifdef __SSE2__
    for (int k = 0; k < HAIR_LANES; k += 2) {
        __m128d pair = _mm_sqrt_pd(_mm_set_pd(a[k + 1], a[k]));
        root[k] = pair[0];
        root[k + 1] = pair[1];
    }
#else
    for (int k = 0; k < HAIR_LANES; ++k) root[k] = sqrt(a[k]);
#endif
    return root;
}
HAIR_LANES_INLINE bool hair_lanes_any(hair_lane_mask mask)
{
    bool any = false;
    for (int k = 0; k < HAIR_LANES; ++k) any |= mask[k] != 0;
    return any;
}

HAIR_LANES_INLINE struct hair_lanes3 hair_lanes_add(struct hair_lanes3 a, struct hair_lanes3 b)
{
    return (struct hair_lanes3){a.x + b.x, a.y + b.y, a.z + b.z};
}
HAIR_LANES_INLINE struct hair_lanes3 hair_lanes_subtract(struct hair_lanes3 a, struct hair_lanes3 b)
{
    return (struct hair_lanes3){a.x - b.x, a.y - b.y, a.z - b.z};
}
HAIR_LANES_INLINE struct hair_lanes3 hair_lanes_scale(struct hair_lanes3 a, hair_lanes s)
{
    return (struct hair_lanes3){a.x * s, a.y * s, a.z * s};
}
HAIR_LANES_INLINE hair_lanes hair_lanes_dot(struct hair_lanes3 a, struct hair_lanes3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
HAIR_LANES_INLINE hair_lanes hair_lanes_length(struct hair_lanes3 a)
{
    return hair_lanes_sqrt(hair_lanes_dot(a, a));
}
HAIR_LANES_INLINE struct hair_lanes3 hair_lanes_cross(struct hair_lanes3 a, struct hair_lanes3 b)
{
    return (struct hair_lanes3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
HAIR_LANES_INLINE struct hair_lanes4 hair_lanes_conjugate(struct hair_lanes4 q)
{
    return (struct hair_lanes4){-q.x, -q.y, -q.z, q.w};
}
HAIR_LANES_INLINE struct hair_lanes4 hair_lanes_multiply(struct hair_lanes4 a, struct hair_lanes4 b)
{
    return (struct hair_lanes4){
        a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
        a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
HAIR_LANES_INLINE struct hair_lanes3 hair_lanes_rotate(struct hair_lanes4 q, struct hair_lanes3 v)
{
    struct hair_lanes3 u = {q.x, q.y, q.z}, t = hair_lanes_cross(u, v);
    t = hair_lanes_add(t, t);
    return hair_lanes_add(v, hair_lanes_add(hair_lanes_scale(t, q.w), hair_lanes_cross(u, t)));
}
// Return q or -q, so that the real part is not negative.
HAIR_LANES_INLINE struct hair_lanes4 hair_lanes_forward(struct hair_lanes4 q)
{
    hair_lane_mask flip = q.w < 0;
    return (struct hair_lanes4){hair_lanes_select(flip, -q.x, q.x), hair_lanes_select(flip, -q.y, q.y),
                                hair_lanes_select(flip, -q.z, q.z), hair_lanes_select(flip, -q.w, q.w)};
}
HAIR_LANES_INLINE struct hair_lanes4 hair_lanes_select4(hair_lane_mask mask, struct hair_lanes4 a,
                                                        struct hair_lanes4 b)
{
    return (struct hair_lanes4){hair_lanes_select(mask, a.x, b.x), hair_lanes_select(mask, a.y, b.y),
                                hair_lanes_select(mask, a.z, b.z), hair_lanes_select(mask, a.w, b.w)};
}

#endif
