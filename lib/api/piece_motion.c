// piece_motion.c - motion of pieces, which start with the velocities of the guides that their
// strands have followed.
#include "lib/api/pieces.h"

// Return the velocity of a guide at a fraction of its length in the groom, m/s.
static hair_vec3 guide_velocity(const struct hair_piece_source* source, uint32_t g, float fraction)
{
    const struct hair_sim* sim = &source->hair->sim;
    const struct hair_groom* groom = source->hair->groom;
    const struct hair_guide* guide = (sim->lengths.guides ? sim->lengths.guides : groom->guides) + g;
    const struct hair_rest* rest = (sim->lengths.guides ? sim->lengths.rest : groom->rest) + guide->first;
    const struct hair_state* at = source->states + guide->first;
    float left = fraction * groom->guides[g].arc_length;
    uint32_t k = 0;
    for (; k + 2 < guide->count && left > rest[k].position.w; ++k) left -= rest[k].position.w;
    float t = fminf(fmaxf(left / rest[k].position.w, 0), 1);
    hair_vec3 moved = hair_lerp(hair_load3(&at[k].displacement.x), hair_load3(&at[k + 1].displacement.x), t);
    return hair_scale(moved, sim->last_substep > 0 ? (float)(1 / sim->last_substep) : 0);
}

// Return the velocity of a follower at a fraction of its length, m/s. See glsl/shared/groom.h.
static hair_vec3 follower_velocity(const struct hair_piece_source* source, uint32_t follower, float fraction)
{
    const struct hair_follower* f = &source->hair->groom->followers[follower];
    const uint32_t guides[3] = {f->guide0, f->guide1, f->guide2};
    float u = f->multi < 0 ? fraction : fminf(fraction * f->length_ratio, 1);
    if (f->multi == 0) return guide_velocity(source, f->guide0, u);
    const float weights[3] = {f->multi < 0 ? f->offset[1].w : 1 - f->weight1 - f->weight2, f->weight1,
                              f->weight2};
    hair_vec3 sum = f->multi < 0 ? guide_velocity(source, f->guide0, 0) : hair_v3(0, 0, 0);
    for (int i = 0; i < 3; ++i) {
        hair_vec3 own = guide_velocity(source, guides[i], u);
        if (f->multi < 0) own = hair_sub(own, guide_velocity(source, guides[i], 0));
        sum = hair_add(sum, hair_scale(own, weights[i]));
    }
    return sum;
}

// Replace the state that creation wrote. The driver of an H100 lost what glNamedBufferSubData wrote
// after a shader, so the GPU copies.
static hair_result write_states(const struct hair_sim* sim, const struct hair_state* states)
{
    GLuint upload = 0;
    size_t size = sim->guide_vertices * sizeof *states;
    HAIR_TRY(hair_gl_buffer(sim->gl, HAIR_GL_CATEGORY_SOLVE, "motion of cut hair", size, states, &upload));
    hair_gl_copy_buffer(sim->gl, upload, sim->state, 0, 0, (GLsizeiptr)size);
    hair_gl_free_buffer(sim->gl, &upload);
    return HAIR_OK;
}

// The drawn hair lies one substep behind the state.
hair_result hair_pieces_set_motion(const struct hair_piece_source* source, const uint32_t* piece_of,
                                   hair_instance* pieces)
{
    struct hair_sim* sim = &pieces->sim;
    const struct hair_groom* groom = pieces->groom;
    struct hair_state* states = hair_alloc(&sim->gl->host, sim->guide_vertices, sizeof *states);
    if (!states) return hair_fail_memory(&sim->gl->host, "the motion of cut hair");
    for (uint32_t g = 0; g < sim->guides; ++g) {
        const struct hair_guide* guide = &groom->guides[g];
        const struct hair_piece* piece = &source->pieces[piece_of[g]];
        float from = hair_piece_start(source, piece), so_far = 0;
        for (uint32_t i = guide->first; i < guide->first + guide->count; ++i) {
            float at = from + (piece->fraction - from) * fminf(so_far / guide->arc_length, 1);
            hair_vec3 moved = hair_scale(follower_velocity(source, piece->follower, at), (float)sim->substep);
            hair_vec3 place = hair_add(hair_load3(&groom->rest[i].position.x), moved);
            states[i].position = (hair_vec4){place.x, place.y, place.z, i == guide->first ? 1 : 0};
            states[i].displacement = (hair_vec4){moved.x, moved.y, moved.z, 0};
            so_far += groom->rest[i].position.w;
        }
    }
    hair_result result = write_states(sim, states);
    if (!result) hair_geometry_invalidate_guides(&pieces->geometry);
    hair_free(&sim->gl->host, states);
    return result;
}
