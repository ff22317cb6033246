// lengths.c - lengths of guides and followers.
#include "lib/sim/sim.h"

#include <string.h>

void hair_lengths_init(struct hair_lengths* lengths, const struct hair_groom* groom)
{
    *lengths = (struct hair_lengths){.groom = groom};
}

static void free_lengths(struct hair_gl* gl, struct hair_lengths* lengths)
{
    hair_free(&gl->host, lengths->guides);
    hair_free(&gl->host, lengths->rest);
    hair_free(&gl->host, lengths->guide_fraction);
    hair_free(&gl->host, lengths->follower_fraction);
    hair_gl_free_array(gl, &lengths->follower, &lengths->follower_texture);
}

void hair_lengths_free(struct hair_sim* sim)
{
    free_lengths(sim->gl, &sim->lengths);
    hair_lengths_init(&sim->lengths, NULL);
}

void hair_lengths_discard(struct hair_sim* sim, struct hair_new_lengths* made)
{
    free_lengths(sim->gl, &made->lengths);
    hair_gl_free_buffer(sim->gl, &made->guide);
    hair_gl_free_buffer(sim->gl, &made->rest);
    hair_gl_free_buffer(sim->gl, &made->change);
}

static const struct hair_guide* guides_with(const struct hair_lengths* lengths)
{
    return lengths->guides ? lengths->guides : lengths->groom->guides;
}

static const struct hair_rest* rest_with(const struct hair_lengths* lengths)
{
    return lengths->guides ? lengths->rest : lengths->groom->rest;
}

// Allocate and cut guides and followers.
static hair_result cut_all(const struct hair_sim* sim, const float* guide_fraction,
                           const float* follower_fraction, struct hair_lengths* out)
{
    const hair_host* host = &sim->gl->host;
    const struct hair_groom* groom = out->groom;
    uint32_t followers = groom->info.follower_count;
    out->guides = hair_alloc(host, sim->guides, sizeof *out->guides);
    out->rest = hair_alloc(host, sim->guide_vertices, sizeof *out->rest);
    out->guide_fraction = hair_alloc(host, sim->guides, sizeof *out->guide_fraction);
    out->follower_fraction = hair_alloc(host, followers, sizeof *out->follower_fraction);
    if (!out->guides || !out->rest || !out->guide_fraction || !out->follower_fraction)
        return hair_fail_memory(host, "the lengths of strands");
    memcpy(out->guide_fraction, guide_fraction, sim->guides * sizeof *guide_fraction);
    memcpy(out->follower_fraction, follower_fraction, followers * sizeof *follower_fraction);
    for (uint32_t i = 0; i < sim->guides; ++i)
        hair_groom_cut_guide(groom, i, guide_fraction[i], &out->guides[i],
                             out->rest + groom->guides[i].first);
    HAIR_TRY(hair_gl_buffer(sim->gl, HAIR_GL_CATEGORY_SOLVE, "hair lengths",
                            followers * sizeof *follower_fraction, follower_fraction, &out->follower));
    return hair_gl_buffer_texture(sim->gl, "hair lengths", GL_R32F, out->follower, &out->follower_texture);
}

static struct hair_length_change change_of(const struct hair_lengths* lengths, uint32_t i)
{
    const struct hair_guide* guide = guides_with(lengths) + i;
    const struct hair_rest* rest = rest_with(lengths) + guide->first;
    return (struct hair_length_change){
        .guide = i, .count = guide->count, .last = rest[guide->count - 2].position.w};
}

// Make the list of guides that change.
static hair_result list_changes(struct hair_sim* sim, struct hair_new_lengths* made)
{
    const hair_host* host = &sim->gl->host;
    struct hair_length_change* change = hair_alloc(host, sim->guides, sizeof *change);
    if (!change) return hair_fail_memory(host, "the lengths of strands");
    for (uint32_t i = 0; i < sim->guides; ++i) {
        struct hair_length_change was = change_of(&sim->lengths, i), is = change_of(&made->lengths, i);
        if (was.count != is.count || was.last != is.last) change[made->changed++] = was;
    }
    hair_result result = HAIR_OK;
    if (made->changed)
        result = hair_gl_storage(sim->gl, HAIR_GL_CATEGORY_SOLVE, "hair length changes",
                                 made->changed * sizeof *change, change, &made->change);
    hair_free(host, change);
    return result;
}

static hair_gl_pass change_pass(const struct hair_sim* sim)
{
    hair_gl_pass pass = HAIR_GL_CHANGE_LENGTHS;
    if (sim->rods) pass |= HAIR_GL_WITH(ROD);
    return hair_sim_is_mixed(sim) ? pass | HAIR_GL_WITH(MIXED) : pass;
}

static hair_result make_lengths(struct hair_sim* sim, const float* guide_fraction,
                                const float* follower_fraction, struct hair_new_lengths* made)
{
    struct hair_gl* gl = sim->gl;
    if (guide_fraction) HAIR_TRY(cut_all(sim, guide_fraction, follower_fraction, &made->lengths));
    HAIR_TRY(hair_gl_storage(gl, HAIR_GL_CATEGORY_SOLVE, "hair guides",
                             sim->guides * sizeof(struct hair_guide), guides_with(&made->lengths),
                             &made->guide));
    HAIR_TRY(hair_gl_storage(gl, HAIR_GL_CATEGORY_SOLVE, "hair rest",
                             sim->guide_vertices * sizeof(struct hair_rest), rest_with(&made->lengths),
                             &made->rest));
    HAIR_TRY(list_changes(sim, made));
    return hair_gl_ensure_program(gl, change_pass(sim));
}

hair_result hair_lengths_make(struct hair_sim* sim, const float* guide_fraction,
                              const float* follower_fraction, struct hair_new_lengths* out)
{
    const struct hair_lengths* now = &sim->lengths;
    struct hair_new_lengths made = {.lengths = {.groom = now->groom, .version = now->version + 1}};
    HAIR_ASSERT(!guide_fraction == !follower_fraction && now->groom);
    hair_result result = make_lengths(sim, guide_fraction, follower_fraction, &made);
    if (result)
        hair_lengths_discard(sim, &made);
    else
        *out = made;
    return result;
}

// Change the state of the guides, whose new buffers are in use.
static void change_state(struct hair_sim* sim, const struct hair_new_lengths* made)
{
    struct hair_gl* gl = sim->gl;
    if (!made->changed) return;
    hair_sim_bind(sim);
    if (sim->rods) hair_sim_bind_rods(sim);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_LENGTH_CHANGE, 1, &made->change);
    hair_gl_run(gl, change_pass(sim), (made->changed + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE);
}

void hair_lengths_use(struct hair_sim* sim, struct hair_new_lengths* made, bool moves_state)
{
    const struct hair_lengths was = sim->lengths;
    const GLuint guide = sim->guide, rest = sim->rest;
    sim->lengths = made->lengths, made->lengths = was;
    sim->guide = made->guide, made->guide = guide;
    sim->rest = made->rest, made->rest = rest;
    if (moves_state) change_state(sim, made);
    hair_lengths_discard(sim, made);
    hair_pins_drop_lost(sim);
    // Both weigh the guides again in the next step.
    hair_grid_free_weights(sim);
    hair_wind_coupling_free_hair(sim);
    if (moves_state) hair_sleep_wake(sim);
    hair_diagnosis_reset(sim);
}

// Return the new fraction of a follower, whose guides change the fraction that they give it. A
// follower that has been cut by itself reaches its full length when its guides do.
static float follow_guides(float fraction, float before, float after)
{
    if (after >= 1) return 1;
    if (after <= before) return before > 0 ? fraction * (after / before) : 0;
    return 1 - (1 - fraction) * ((1 - after) / (1 - before));
}

static bool are_whole(const float* fractions, uint32_t count)
{
    for (uint32_t i = 0; i < count; ++i)
        if (fractions[i] < 1) return false;
    return true;
}

// Fractions before and after a change.
struct fractions {
    float *before, *after, *follower;
};

static void fill_fractions(const struct hair_sim* sim, uint32_t first, uint32_t count, const float* given,
                           const struct fractions* f)
{
    const struct hair_groom* groom = sim->lengths.groom;
    for (uint32_t i = 0; i < sim->guides; ++i) f->before[i] = f->after[i] = hair_sim_length_fraction(sim, i);
    for (uint32_t i = 0; i < count; ++i) f->after[first + i] = given[i];
    for (uint32_t i = 0; i < groom->info.follower_count; ++i) {
        float own = sim->lengths.guides ? sim->lengths.follower_fraction[i] : 1;
        float before = hair_groom_follower_fraction(groom, i, f->before);
        float after = hair_groom_follower_fraction(groom, i, f->after);
        f->follower[i] = before == after ? own : follow_guides(own, before, after);
    }
}

hair_result hair_sim_copy_lengths(struct hair_sim* sim, const struct hair_lengths* from)
{
    struct hair_new_lengths made;
    if (!from->guides && !sim->lengths.guides) return HAIR_OK;
    HAIR_TRY(hair_lengths_make(sim, from->guide_fraction, from->follower_fraction, &made));
    hair_lengths_use(sim, &made, true);
    return HAIR_OK;
}

hair_result hair_sim_set_strand_lengths(struct hair_sim* sim, const float* guide_fraction,
                                        const float* follower_fraction)
{
    struct hair_new_lengths made;
    bool whole = are_whole(guide_fraction, sim->guides) &&
                 are_whole(follower_fraction, sim->lengths.groom->info.follower_count);
    HAIR_TRY(hair_lengths_make(sim, whole ? NULL : guide_fraction, whole ? NULL : follower_fraction, &made));
    hair_lengths_use(sim, &made, true);
    return HAIR_OK;
}

hair_result hair_sim_set_lengths(struct hair_sim* sim, uint32_t first, uint32_t count, const float* fractions,
                                 bool* changes)
{
    const hair_host* host = &sim->gl->host;
    uint32_t followers = sim->lengths.groom->info.follower_count;
    HAIR_ASSERT(first <= sim->guides && count <= sim->guides - first);
    *changes = false;
    for (uint32_t i = 0; i < count; ++i) *changes |= fractions[i] != hair_sim_length_fraction(sim, first + i);
    if (!*changes) return HAIR_OK;
    struct fractions f = {.before = hair_alloc(host, sim->guides, sizeof(float)),
                          .after = hair_alloc(host, sim->guides, sizeof(float)),
                          .follower = hair_alloc(host, followers, sizeof(float))};
    hair_result result =
        f.before && f.after && f.follower ? HAIR_OK : hair_fail_memory(host, "the lengths of strands");
    if (!result) {
        fill_fractions(sim, first, count, fractions, &f);
        result = hair_sim_set_strand_lengths(sim, f.after, f.follower);
    }
    hair_free(host, f.before);
    hair_free(host, f.after);
    hair_free(host, f.follower);
    return result;
}

void hair_lengths_move_lost(const struct hair_sim* sim, float* positions, uint32_t count)
{
    const struct hair_lengths* lengths = &sim->lengths;
    for (uint32_t g = 0; lengths->guides && g < sim->guides; ++g) {
        const struct hair_guide* guide = &lengths->guides[g];
        uint32_t tip = guide->first + guide->count - 1;
        uint32_t end = guide->first + lengths->groom->guides[g].count;
        for (uint32_t i = tip + 1; i < end && i < count; ++i)
            memcpy(positions + 3 * (size_t)i, positions + 3 * (size_t)tip, 3 * sizeof *positions);
    }
}
