// guide_level.glsl - the level of detail of guides. Small hair simulates one guide of every
// params.guide_stride. The guides between two simulated ones are derived from the one before them,
// in an order in which neighbours stand together. See lib/groom/guide_order.c.

// Return the guide at a place of the order.
uint guide_in_order(uint place) { return solver_stats[params.guide_order + place]; }

// Return the guide that is number k of the simulated guides.
uint simulated_guide(uint k)
{
    return params.guide_stride > 1u ? guide_in_order(k * params.guide_stride) : k;
}
