// varyings.glsl - varyings of a strand beside its position and colour.
#if defined(HAIR_IDS) || defined(HAIR_USER_PIXELS)
#define HAIR_NUMBERED 1
#endif

// strand_numbers: strand, guide, seed.
// strand_place: t along the strand, u and v of its root on the scalp, position across a ribbon from
// -1 to 1.
// clip_now, clip_before: x, y and w of clip space, without jitter.
// strand_share: see draw/coverage.glsl.
