// build.c - construction of a groom from strands, step by step.
#include "lib/groom/draft.h"

#include <float.h>

// Source of followers.
enum source { FROM_STRANDS, FROM_GUIDES, FROM_SCALP };

static enum source find_source(const hair_groom_desc* desc)
{
    if (desc->strand_set == HAIR_STRAND_SET_FULL) return FROM_STRANDS;
    return desc->scalp_positions && desc->follower_count ? FROM_SCALP : FROM_GUIDES;
}

static hair_result count_sprouts(struct hair_draft* draft)
{
    switch (find_source(draft->desc)) {
    case FROM_STRANDS: return hair_strand_sprouts(draft);
    case FROM_SCALP: return hair_scalp_sprouts(draft);
    case FROM_GUIDES: break;
    }
    return hair_guide_sprouts(draft);
}

static hair_result make_followers(struct hair_draft* draft)
{
    struct hair_groom* groom = draft->groom;
    HAIR_ASSERT(draft->sprout_count > 0 && draft->place);
    groom->info.follower_count = draft->sprout_count;
    groom->followers = hair_alloc(draft->host, draft->sprout_count, sizeof *groom->followers);
    if (!groom->followers) return hair_fail_memory(draft->host, "followers");
    switch (find_source(draft->desc)) {
    case FROM_STRANDS: return hair_strand_followers(draft);
    case FROM_SCALP: return hair_scalp_followers(draft);
    case FROM_GUIDES: break;
    }
    return hair_guide_followers(draft);
}

static void describe(struct hair_draft* draft)
{
    hair_groom_info* info = &draft->groom->info;
    const struct hair_strands* strands = &draft->strands;
    double sum = 0;
    info->strand_count = strands->strand_count;
    info->length[0] = FLT_MAX;
    for (uint32_t i = 0; i < strands->strand_count; ++i) {
        info->length[0] = fminf(info->length[0], draft->length[i]);
        info->length[2] = fmaxf(info->length[2], draft->length[i]);
        sum += (double)draft->length[i];
    }
    HAIR_ASSERT(0 < info->length[0] && info->length[0] <= info->length[2]);
    info->length[1] = (float)(sum / strands->strand_count);
    for (size_t a = 0; a < 3; ++a) {
        info->lower[a] = info->upper[a] = strands->positions[a];
        for (size_t i = 1; i < strands->vertex_count; ++i) {
            info->lower[a] = fminf(info->lower[a], strands->positions[3 * i + a]);
            info->upper[a] = fmaxf(info->upper[a], strands->positions[3 * i + a]);
        }
    }
}

static hair_result build(struct hair_draft* draft)
{
    hair_result result = hair_draft_strands(draft);
    if (!result) result = hair_draft_scalp(draft);
    if (!result) result = hair_draft_guides(draft);
    if (!result) result = hair_draft_rest(draft);
    if (!result) result = count_sprouts(draft);
    if (!result) result = hair_draft_spots(draft);
    if (!result) result = hair_draft_maps(draft);
    if (!result) result = hair_draft_patches(draft);
    if (!result) result = make_followers(draft);
    if (!result) result = hair_draft_paint(draft);
    if (!result) result = hair_draft_seats(draft);
    if (result) return result;
    hair_thicken(draft);
    hair_measure_patches(draft->groom);
    draft->groom->skull = hair_find_skull(draft->groom);
    describe(draft);
    return HAIR_OK;
}

static void free_draft(struct hair_draft* draft)
{
    hair_strands_free(draft->host, &draft->strands);
    hair_free(draft->host, draft->first);
    hair_free(draft->host, draft->length);
    hair_free(draft->host, draft->marks);
    hair_free(draft->host, draft->scalp);
    hair_free(draft->host, draft->density);
    hair_free(draft->host, draft->chosen);
    hair_free(draft->host, draft->owner);
    hair_free(draft->host, draft->plot_sprouts);
    hair_free(draft->host, draft->plot_first);
    hair_free(draft->host, draft->plot_centres);
    hair_free(draft->host, draft->strand_of);
    hair_free(draft->host, draft->place);
    hair_free(draft->host, draft->spots);
    hair_free(draft->host, draft->map_density);
    hair_free(draft->host, draft->map_thickness);
    hair_free(draft->host, draft->map_share);
}

hair_result hair_groom_build(const hair_host* host, const hair_groom_desc* desc, const hair_import* import,
                             hair_groom** out)
{
    struct hair_groom* groom = hair_alloc(host, 1, sizeof *groom);
    if (!groom) return hair_fail_memory(host, "a groom");
    groom->host = *host;
    struct hair_draft draft = {.host = &groom->host, .desc = desc, .import = import, .groom = groom};
    hair_result result = build(&draft);
    free_draft(&draft);
    if (result)
        hair_groom_free(groom);
    else
        *out = groom;
    return result;
}

void hair_groom_free(hair_groom* groom)
{
    if (!groom) return;
    hair_host host = groom->host;
    hair_free(&host, groom->guides);
    hair_free(&host, groom->rest);
    hair_free(&host, groom->followers);
    hair_free(&host, groom->patches);
    hair_free(&host, groom->paint);
    hair_seats_release(groom->seats);
    hair_free(&host, groom);
}
