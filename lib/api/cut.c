// cut.c - public calls that cut hair and let it grow.
#include "lib/api/pieces.h"

// Check a range of guides.
static hair_result check_range(const hair_instance* hair, uint32_t first, uint32_t count)
{
    uint32_t guides = hair->sim.guides;
    if (first <= guides && count <= guides - first) return HAIR_OK;
    return hair_fail(&hair->context->host, HAIR_ERROR_ARGUMENT,
                     "%s: first is %u and count is %u, but there are %u guides", hair->label, first, count,
                     guides);
}

static hair_result check_fractions(const hair_instance* hair, uint32_t count, const float* fractions)
{
    for (uint32_t i = 0; i < count; ++i)
        if (!(fractions[i] >= 0 && fractions[i] <= 1)) // NaN fails too.
            return hair_fail(&hair->context->host, HAIR_ERROR_ARGUMENT,
                             "%s: fractions[%u] is %g, not in [0, 1]", hair->label, i, (double)fractions[i]);
    return HAIR_OK;
}

// Check that lengths can change, and that OpenGL is current.
static hair_result check_changes(const hair_instance* hair)
{
    if (hair->creation.thread_mapping == HAIR_THREAD_MAPPING_FEEDBACK)
        return hair_fail(&hair->context->host, HAIR_ERROR_ARGUMENT,
                         "%s: lengths cannot change with HAIR_THREAD_MAPPING_FEEDBACK", hair->label);
    return hair_check_current(hair->context);
}

// Discard what has been computed from strands of other lengths. A strand that becomes shorter does
// not move, so that there is no velocity of this change.
static void invalidate(hair_instance* hair)
{
    hair_geometry_invalidate_guides(&hair->geometry);
    hair_geometry_invalidate(&hair->geometry);
    hair_geometry_forget_history(&hair->geometry);
}

static hair_result set_lengths(hair_instance* hair, uint32_t first, uint32_t count, const float* fractions)
{
    bool changes = false;
    hair_enter(hair);
    hair_result result = hair_sim_set_lengths(&hair->sim, first, count, fractions, &changes);
    if (!result && changes) invalidate(hair);
    return hair_leave(hair->context, result);
}

hair_result hair_set_lengths(hair_instance* hair, uint32_t first, uint32_t count, const float* fractions)
{
    HAIR_TRY(hair_check_instance(hair));
    const hair_host* host = &hair->context->host;
    HAIR_TRY(check_range(hair, first, count));
    if (fractions) HAIR_TRY(check_fractions(hair, count, fractions));
    HAIR_TRY(check_changes(hair));
    if (fractions || !count) return set_lengths(hair, first, count, fractions);
    float* whole = hair_alloc(host, count, sizeof *whole);
    if (!whole) return hair_fail_memory(host, "the lengths of guides");
    for (uint32_t i = 0; i < count; ++i) whole[i] = 1;
    hair_result result = set_lengths(hair, first, count, whole);
    hair_free(host, whole);
    return result;
}

hair_result hair_get_lengths(const hair_instance* hair, uint32_t first, uint32_t count, float* fractions)
{
    HAIR_TRY(hair_check_instance(hair));
    HAIR_TRY(check_range(hair, first, count));
    if (!fractions && count)
        return hair_fail(&hair->context->host, HAIR_ERROR_ARGUMENT, "%s: fractions is NULL but count is %u",
                         hair->label, count);
    for (uint32_t i = 0; i < count; ++i) fractions[i] = hair_sim_length_fraction(&hair->sim, first + i);
    return HAIR_OK;
}

// A cut by a shape, and the fractions of the lengths of all guides and followers after it.
struct cut {
    hair_instance* hair;
    const hair_cut_desc* desc;
    struct hair_state* states; // Guides at the end of the last substep.
    struct hair_nearby_vertices near; // Followers as they are drawn.
    float *guide, *follower;
    float* needed; // Fraction of each guide that its followers need.
    struct hair_piece* pieces; // Ends of followers that are cut off. NULL if they are discarded.
    uint32_t piece_count;
    hair_cut_info info;
};

static bool is_in_groups(const struct cut* cut, uint32_t guide)
{
    return cut->desc->groups >> cut->hair->groom->guides[guide].group & 1;
}

// Cut guides where they meet the shape themselves.
static void cut_guides(struct cut* cut)
{
    const struct hair_sim* sim = &cut->hair->sim;
    const struct hair_groom* groom = cut->hair->groom;
    const struct hair_guide* guides = sim->lengths.guides ? sim->lengths.guides : groom->guides;
    const struct hair_rest* all = sim->lengths.guides ? sim->lengths.rest : groom->rest;
    struct hair_cutter cutter = hair_cutter_from(cut->desc, sim->last_after.position);
    for (uint32_t g = 0; g < sim->guides; ++g) {
        const struct hair_rest* rest = all + guides[g].first;
        const struct hair_state* at = cut->states + guides[g].first;
        double kept = 0;
        float t;
        cut->guide[g] = hair_sim_length_fraction(sim, g);
        for (uint32_t i = 0; is_in_groups(cut, g) && i + 1 < guides[g].count; ++i) {
            hair_vec3 from = hair_load3(&at[i].position.x), to = hair_load3(&at[i + 1].position.x);
            if (hair_cutter_meets(&cutter, from, to, &t)) {
                kept += (double)(t * rest[i].position.w);
                cut->guide[g] = fminf(cut->guide[g], (float)(kept / (double)groom->guides[g].arc_length));
                break;
            }
            kept += (double)rest[i].position.w;
        }
    }
}

// Keep the length of the guides of a follower that it needs.
static void keep_guides(struct cut* cut, uint32_t follower)
{
    const struct hair_follower* f = &cut->hair->groom->followers[follower];
    const uint32_t guides[3] = {f->guide0, f->guide1, f->guide2};
    float needed = fminf(cut->follower[follower] * (f->multi < 0 ? 1 : f->length_ratio), 1);
    for (int i = 0; i < (f->multi == 0 ? 1 : 3); ++i)
        cut->needed[guides[i]] = fmaxf(cut->needed[guides[i]], needed);
}

// Cut a follower where its vertices first meet the shape.
static void cut_follower(struct cut* cut, const struct hair_cutter* cutter, uint32_t follower,
                         const hair_vec4* vertex)
{
    uint32_t segments = cut->hair->geometry.look.strand.segments;
    struct hair_piece piece = {.vertices = vertex, .follower = follower, .fraction = cut->follower[follower]};
    for (; piece.segment < segments; ++piece.segment) {
        hair_vec3 from = hair_load3(&vertex[piece.segment].x);
        if (hair_cutter_meets(cutter, from, hair_load3(&vertex[piece.segment + 1].x), &piece.t)) break;
    }
    if (piece.segment == segments) return;
    const struct hair_piece_source source = {.hair = cut->hair};
    double lost = hair_piece_length(&source, &piece);
    if (!(lost > 0)) return;
    cut->follower[follower] *= ((float)piece.segment + piece.t) / (float)segments;
    ++cut->info.strands;
    cut->info.length += lost;
    if (cut->pieces) cut->pieces[cut->piece_count++] = piece;
}

// Return the shape from the origin of the drawn strands.
static struct hair_cutter drawn_cutter(const struct cut* cut)
{
    return hair_cutter_from(cut->desc, cut->hair->sim.head_at_last_step.position);
}

// Cut the followers of the patches that were read.
static void cut_patches(struct cut* cut)
{
    const struct hair_groom* groom = cut->hair->groom;
    size_t each = cut->hair->geometry.look.strand.segments + 1;
    struct hair_cutter cutter = drawn_cutter(cut);
    for (uint32_t p = 0; p < groom->info.patch_count; ++p) {
        const struct hair_patch* patch = &groom->patches[p];
        for (uint32_t i = 0; i < patch->count && cut->near.first[p] != SIZE_MAX; ++i) {
            const hair_vec4* vertices = cut->near.vertices + cut->near.first[p] + i * each;
            if (is_in_groups(cut, groom->followers[patch->first + i].guide0))
                cut_follower(cut, &cutter, patch->first + i, vertices);
        }
    }
}

static void cut_followers(struct cut* cut)
{
    const hair_instance* hair = cut->hair;
    const struct hair_lengths* lengths = &hair->sim.lengths;
    uint32_t followers = hair->groom->info.follower_count;
    for (uint32_t i = 0; i < followers; ++i)
        cut->follower[i] = lengths->guides ? lengths->follower_fraction[i] : 1;
    cut_patches(cut);
    for (uint32_t i = 0; i < followers; ++i) keep_guides(cut, i);
    for (uint32_t g = 0; g < hair->sim.guides; ++g) {
        float before = hair_sim_length_fraction(&hair->sim, g);
        cut->guide[g] = fminf(fmaxf(cut->guide[g], cut->needed[g]), before);
        cut->info.guides += cut->guide[g] < before;
    }
}

// Read the strands where they are.
static hair_result read_strands(struct cut* cut)
{
    hair_instance* hair = cut->hair;
    const hair_host* host = &hair->context->host;
    uint32_t vertices = hair->sim.guide_vertices;
    cut->states = hair_alloc(host, vertices, sizeof *cut->states);
    cut->guide = hair_alloc(host, hair->sim.guides, sizeof *cut->guide);
    cut->needed = hair_alloc(host, hair->sim.guides, sizeof *cut->needed);
    cut->follower = hair_alloc(host, hair->groom->info.follower_count, sizeof *cut->follower);
    if (!cut->states || !cut->guide || !cut->needed || !cut->follower)
        return hair_fail_memory(host, "the strands to cut");
    struct hair_cutter cutter = drawn_cutter(cut);
    HAIR_TRY(hair_read_nearby_vertices(hair, &cutter, &cut->near));
    hair_gl_read(&hair->context->gl, hair->sim.state, vertices * sizeof *cut->states, cut->states);
    return hair_check_lost(hair->context, HAIR_OK);
}

static hair_result use_lengths(struct cut* cut)
{
    hair_instance* hair = cut->hair;
    hair_enter(hair);
    hair_result result = hair_sim_set_strand_lengths(&hair->sim, cut->guide, cut->follower);
    if (!result) invalidate(hair);
    return hair_leave(hair->context, result);
}

// Return whether any guide is in the groups that are cut.
static bool has_guides(const struct cut* cut)
{
    for (uint32_t g = 0; g < cut->hair->sim.guides; ++g)
        if (is_in_groups(cut, g)) return true;
    return false;
}

// Cut the strands. `pieces` receives an instance of what falls off, or NULL. NULL discards it.
static hair_result cut_strands(struct cut* cut, hair_instance** pieces)
{
    hair_instance* hair = cut->hair;
    hair_instance* made = NULL;
    if (!has_guides(cut)) {
        if (pieces) *pieces = NULL;
        return HAIR_OK;
    }
    if (pieces) {
        cut->pieces = hair_alloc(&hair->context->host, hair->groom->info.follower_count, sizeof *cut->pieces);
        if (!cut->pieces) return hair_fail_memory(&hair->context->host, "the pieces of cut hair");
    }
    HAIR_TRY(read_strands(cut));
    cut_guides(cut);
    cut_followers(cut);
    struct hair_piece_source source = {hair, cut->states, cut->pieces, cut->piece_count};
    if (pieces) HAIR_TRY(hair_pieces_create(&source, &made));
    hair_result result = cut->info.strands || cut->info.guides ? use_lengths(cut) : HAIR_OK;
    if (result)
        hair_destroy(made);
    else if (pieces)
        *pieces = made;
    return result;
}

static hair_result check_cut(const hair_instance* hair, const hair_cut_desc* desc)
{
    bool has_normal = desc->normal[0] != 0 || desc->normal[1] != 0 || desc->normal[2] != 0;
    if (desc->shape == HAIR_CUT_SHAPE_PLANE && !has_normal)
        return hair_fail(&hair->context->host, HAIR_ERROR_ARGUMENT,
                         "hair_cut_desc.normal is (0, 0, 0), which is no direction");
    return HAIR_OK;
}

hair_result hair_cut(hair_instance* hair, const hair_cut_desc* cut, hair_cut_info* info,
                     hair_instance** pieces)
{
    HAIR_TRY(hair_check_instance(hair));
    const hair_host* host = &hair->context->host;
    hair_cut_desc own;
    HAIR_TRY(HAIR_COPY_IN(host, hair_cut_desc, cut, &own));
    if (info) HAIR_TRY(hair_check_header(host, "hair_cut_info", info->header));
    HAIR_TRY(check_cut(hair, &own));
    HAIR_TRY(check_changes(hair));
    HAIR_TRY(hair_catch_up(&hair, 1));
    struct cut work = {.hair = hair, .desc = &own, .info = hair_cut_info_default()};
    hair_result result = cut_strands(&work, pieces);
    hair_free(host, work.states);
    hair_free(host, work.near.vertices);
    hair_free(host, work.near.first);
    hair_free(host, work.guide);
    hair_free(host, work.needed);
    hair_free(host, work.follower);
    hair_free(host, work.pieces);
    if (result || !info) return result;
    return HAIR_COPY_OUT(host, hair_cut_info, &work.info, info);
}
