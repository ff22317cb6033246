// passed.glsl - what stages pass on of a strand beside where it is and its colour.
#if defined(HAIR_IDS) || defined(HAIR_OWN_PIXELS)
#define HAIR_NUMBERED 1
#endif

// strand_numbers: strand, guide, seed.
// strand_place: along the strand; of its root on the scalp: u, v; of a ribbon from -1 to 1 across it.
// clip_now, clip_before: x, y, w without jitter.
// strand_share: pixels across from the middle, half the width, what coverage_of() makes of the direction.
