// draft.h - a groom in the making: what the steps of hair_groom_build hand on to each other.
#ifndef HAIR_GROOM_DRAFT_H
#define HAIR_GROOM_DRAFT_H

#include "lib/asset/strands.h"
#include "lib/groom/cloud.h"
#include "lib/groom/groom.h"

// Points of a strand that stand for its shape: at 0, 1/3, 2/3 and 1 of its length.
#define HAIR_MARKS 4

// Where on the scalp a root sits.
struct hair_spot {
    uint32_t triangle;
    float weight[3]; // of its corners
};

struct hair_draft {
    const hair_host* host;
    const hair_groom_desc* desc;
    const hair_import* import;
    struct hair_groom* groom; // what is made

    struct hair_strands strands; // made fit
    uint32_t* first; // vertex of each strand
    float* length; // of each strand. m.
    float* marks; // xyz, HAIR_MARKS per strand

    float* scalp; // xyz per vertex, as the strands. NULL: none
    float* density; // mean over each triangle

    uint32_t* chosen; // strand of each guide
    uint32_t* owner; // guide of each strand, a near one. Only where all strands are given

    // A sprout is a follower before it has its place among the others. It grows on a plot, a scalp triangle
    // or a guide; the sprouts of a plot are neighbours.
    uint32_t plot_count;
    uint32_t* plot_sprouts; // how many, of each plot
    uint32_t* plot_first; // the first of them
    float* plot_centres; // xyz
    const float* plot_density; // NULL: 1
    uint32_t sprout_count;
    bool is_scattered; // any run of a plot's sprouts is spread evenly over it, a triangle
    uint32_t* strand_of; // of each sprout, where all strands are given
    uint32_t* place; // of each sprout: its follower

    struct hair_spot* spots; // of each sprout, where there is a scalp that has a triangle. NULL: none
    hair_vec4* map_density; // of each sprout, by each set of maps. NULL: there are no maps
    float* map_thickness; // of each sprout, the most of all sets
    hair_vec4* map_share; // and of that, by each set
};

// The steps, in order. Each fails with one sentence and leaves what it has made in the draft.
hair_result hair_draft_strands(struct hair_draft* draft);
hair_result hair_draft_scalp(struct hair_draft* draft);
hair_result hair_draft_guides(struct hair_draft* draft);
hair_result hair_draft_rest(struct hair_draft* draft);
// Then of the three sources of followers the one that the desc asks for: full strands (bind.c), the guides
// themselves and what surrounds them (grow.c), the scalp (scalp.c). First all sprouts are counted, by plot;
// patches give them their places; then followers are made of them.
hair_result hair_strand_sprouts(struct hair_draft* draft);
hair_result hair_guide_sprouts(struct hair_draft* draft);
hair_result hair_scalp_sprouts(struct hair_draft* draft);
hair_result
hair_draft_spots(struct hair_draft* draft); // roots of all sprouts, but of scalp.c, which has them
hair_result hair_draft_maps(struct hair_draft* draft); // what maps say of all sprouts
void hair_thicken(struct hair_draft* draft); // followers, by maps
hair_result hair_draft_patches(struct hair_draft* draft);
hair_result hair_strand_followers(struct hair_draft* draft);
hair_result hair_guide_followers(struct hair_draft* draft);
hair_result hair_scalp_followers(struct hair_draft* draft);
hair_result hair_draft_paint(struct hair_draft* draft); // followers, by what strands bring along
hair_result hair_draft_seats(struct hair_draft* draft); // of guides and followers on the scalp

// sorts.c: what maps make of the sprouts that `queue` names, neighbours. Split: reorder them so that those in front
// are to be in another patch than those behind; returns how many are in front, 0: all may be in one. Patch: put what
// is one in the order in which it is cut short, and fill in what its maps say.
uint32_t hair_map_split(const struct hair_draft* draft, uint32_t* queue, uint32_t count);
void hair_map_patch(const struct hair_draft* draft, uint32_t* queue, struct hair_patch* patch);
void hair_sort_queue(uint32_t* queue, float* from, uint32_t count); // both, by where each is to be drawn from

// Plots without sprouts (plots.c); and once these are counted, the first of each.
hair_result hair_guide_plots(struct hair_draft* draft);
hair_result hair_scalp_plots(struct hair_draft* draft);
void hair_number_sprouts(struct hair_draft* draft);

hair_vec3 hair_sprout_root(const struct hair_draft* draft, uint32_t plot, uint32_t sprout); // not of scalp.c
hair_vec3 hair_guide_root(const struct hair_groom* groom, uint32_t guide);
hair_vec3 hair_scalp_corner(const struct hair_draft* draft, uint32_t triangle, uint32_t corner);

// The start of a sprout's random choices.
uint32_t hair_sprout_random(const struct hair_draft* draft, uint32_t sprout);

// A follower that is its guide, but for what is random; and one grown from `offset` off the guide's root, in
// the root frame, that clumps towards it.
struct hair_follower hair_own_follower(uint32_t guide, uint32_t* random);
struct hair_follower hair_grown_follower(uint32_t guide, hair_vec3 offset, uint32_t* random);

#endif
