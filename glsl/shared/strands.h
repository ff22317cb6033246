// strands.h - followers as drawn: their look and their collision.
#ifndef HAIR_SHARED_STRANDS_H
#define HAIR_SHARED_STRANDS_H

#define HAIR_NO_HIT 1e9 // First vertex inside a collider, for followers that have none.
#define HAIR_HIT_FOLLOWERS 32    // Followers per work group of hit.comp.
#define HAIR_HIT_THREADS 4       // Threads per follower.
// Columns of the texture with one texel per follower into which a prepass draws hits.
#define HAIR_HIT_COLUMNS 4096u
// Blend zone above the first vertex inside, as a fraction of the length.
#define HAIR_SWITCH_ZONE 0.2
#define HAIR_REPAIR_INTERVALS 8  // Intervals of a follower in the curves of strands/repair.glsl.
#define HAIR_REPAIR_CONTROLS 10  // Control points stored per follower.
#define HAIR_REPAIR_ALONE 16     // Followers of a work group with one thread each.
#define HAIR_REPAIR_THREADS 32   // Threads of a follower that has a work group.
#define HAIR_REPAIR_TURNS 8      // Followers per work group, if all are in colliders.
#define HAIR_CACHE_MORE 2        // Strands of each patch that a small vertex cache has besides.
#define HAIR_REPAIR_SAMPLES 64   // Maximum segments of a follower that are tested.
// HAIR_FOLLOWER_COLLISION_SINGLE_GUIDE of hair_follower_collision.
#define HAIR_COLLISION_IS_SINGLE_GUIDE 1

#define HAIR_TURN_PLACES 16    // Samples of one turn of a curl.

// Curves of a look along a strand.
#define HAIR_CURVE_TAPER 0
#define HAIR_CURVE_CLUMP 1
#define HAIR_CURVE_CLUMP_WIDTH 2
#define HAIR_CURVE_TIP_STRAY 3
#define HAIR_CURVE_STRAY 4
#define HAIR_CURVE_FRIZZ 5
#define HAIR_CURVE_CURL 6
#define HAIR_CURVES 7

// Parameters by which a look shapes a strand, from hair_look.
struct hair_strand_look {
    // Intervals of each curve. An interval is a cubic c.x + x (c.y + x (c.z + x c.w)), with x from
    // 0 to 1.
    hair_vec4 curve[HAIR_CURVES * HAIR_CURVE_INTERVALS];
    // Cubics of one turn of a curl of radius 1, in the same form: those of x, then those of z.
    hair_vec4 loop[2 * HAIR_TURN_PLACES];
    float tip_stray_fraction, stray_fraction;
    float kinks; // 1/m.
    float drawn; // Fraction of the length.
    float length_variation;
    float curl_radius; // m.
    float curl_waves;  // 1/m.
    float curl_turns;
    float curl_guide_phase, curl_strand_phase, curl_spread, curl_left_fraction;
    // Bounds of how far the look moves a strand.
    float     max_stray; // Fraction of the length.
    float     max_offset; // m.
    float     max_width; // Factor of the offsets, at least 1.
    float     curl_guide_spread, curl_variation;
    float     frizz_fraction;
    hair_uint factor_slots; // Slots of the factors of strands, see strands/strand_factors.glsl.
    hair_uint factor_count; // Number of factors per follower.
};
HAIR_SIZE(hair_strand_look)

// Factors of single strands.
#define HAIR_FACTOR_CLUMP 0
#define HAIR_FACTOR_CURL_RADIUS 1
#define HAIR_FACTOR_CURL_TURNS 2
#define HAIR_FACTOR_FRIZZ 3
#define HAIR_FACTOR_VARIANCE 4 // Variance of the longitudinal lobes.
#define HAIR_FACTORS 5

#define HAIR_STRAND_GROUPS 8 // HAIR_MAX_STRAND_GROUPS.

// Factors of a group of strands.
struct hair_group_factors {
    float curl_radius, curl_turns, frizz, clump;
    float variance; // Variance of the longitudinal lobes.
    hair_uint unused0, unused1, unused2;
};
HAIR_SIZE(hair_group_factors)

#endif
