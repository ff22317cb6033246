// pieces.c - what a cut takes away from hair, as an instance of free strands.
//
// Each drawn strand that is cut leaves a strand with the shape that it has on the screen. Curls and
// strays are part of this shape, so the look of the pieces adds none. Guides are chosen among the
// pieces. They start with the velocities of the guides that the strands have followed.
#include "lib/api/pieces.h"

#include "lib/asset/strands.h"

#include <stdio.h>
#include <string.h>

#define SHORTEST 0.003 // Length below which pieces are left out, m. They need short substeps.
#define MAX_VERTICES 64u // Per piece.
#define MIN_GUIDES 16u // Pieces of few strands would fall as one lock.
// Number of guides per strand as a multiple of that of the hair. Pieces scatter.
#define MORE_GUIDES 3

// Arrays from which the groom of pieces is made.
struct arrays {
    float *positions, *radii, *colors;
    uint32_t* vertices;
    uint8_t* groups;
    uint32_t vertex_count;
    double radius; // Mean factor of the radius of strands.
    double start; // Mean place at which the pieces start, [0, 1].
};

static uint32_t segments_of(const struct hair_piece_source* source)
{
    return source->hair->geometry.look.strand.segments;
}

// Write the vertices of a piece as they are drawn. Return their number.
static uint32_t copy_vertices(const struct hair_piece_source* source, const struct hair_piece* piece,
                              float out[3 * (HAIR_MAX_GUIDE_VERTICES + 1)])
{
    uint32_t segments = segments_of(source), count = 1;
    const hair_vec4* vertex = source->vertices + (size_t)piece->follower * (segments + 1);
    hair_vec3 from = hair_load3(&vertex[piece->segment].x), to = hair_load3(&vertex[piece->segment + 1].x);
    hair_store3(out, hair_lerp(from, to, piece->t));
    for (uint32_t k = piece->segment + 1; k <= segments; ++k)
        hair_store3(out + 3 * (size_t)count++, hair_load3(&vertex[k].x));
    return count;
}

double hair_piece_length(const struct hair_piece_source* source, const struct hair_piece* piece)
{
    float positions[3 * (HAIR_MAX_GUIDE_VERTICES + 1)];
    uint32_t count = copy_vertices(source, piece, positions);
    return hair_strand_length(positions, count);
}

// Drop pieces that are too short.
static void drop_short(struct hair_piece_source* source)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < source->count; ++i)
        if (hair_piece_length(source, &source->pieces[i]) >= SHORTEST)
            source->pieces[kept++] = source->pieces[i];
    source->count = kept;
}

// Return the fraction of the length of its follower at which a piece starts.
static float start_of(const struct hair_piece_source* source, const struct hair_piece* piece)
{
    return piece->fraction * ((float)piece->segment + piece->t) / (float)segments_of(source);
}

// Write the colours of a piece at HAIR_STRAND_COLORS points.
static void copy_colors(const struct hair_piece_source* source, const struct hair_piece* piece, float* out)
{
    const uint16_t* from = source->hair->groom->colors + 4 * HAIR_STRAND_COLORS * (size_t)piece->follower;
    float whole[3 * HAIR_STRAND_COLORS], start = start_of(source, piece);
    for (int k = 0; k < HAIR_STRAND_COLORS; ++k)
        for (int c = 0; c < 3; ++c) whole[3 * k + c] = (float)from[4 * k + c] / 65535;
    for (int k = 0; k < HAIR_STRAND_COLORS; ++k)
        hair_strand_color_at(whole, start + (piece->fraction - start) * (float)k / (HAIR_STRAND_COLORS - 1),
                             out + 3 * (size_t)k);
}

static hair_result alloc_arrays(const struct hair_piece_source* source, struct arrays* out)
{
    const hair_host* host = &source->hair->context->host;
    uint32_t count = source->count;
    bool has_colors = source->hair->groom->colors != NULL;
    out->positions = hair_alloc(host, (size_t)count * MAX_VERTICES, 3 * sizeof(float));
    out->vertices = hair_alloc(host, count, sizeof *out->vertices);
    out->radii = hair_alloc(host, count, sizeof *out->radii);
    out->groups = hair_alloc(host, count, sizeof *out->groups);
    if (has_colors) out->colors = hair_alloc(host, count, 3 * HAIR_STRAND_COLORS * sizeof *out->colors);
    return out->positions && out->vertices && out->radii && out->groups && (out->colors || !has_colors)
               ? HAIR_OK
               : hair_fail_memory(host, "the pieces of cut hair");
}

static void fill_arrays(const struct hair_piece_source* source, struct arrays* out)
{
    const struct hair_groom* groom = source->hair->groom;
    for (uint32_t i = 0; i < source->count; ++i) {
        const struct hair_piece* piece = &source->pieces[i];
        const struct hair_follower* follower = &groom->followers[piece->follower];
        float drawn[3 * (HAIR_MAX_GUIDE_VERTICES + 1)], *to = out->positions + 3 * (size_t)out->vertex_count;
        uint32_t count = copy_vertices(source, piece, drawn);
        if (count > MAX_VERTICES)
            hair_strand_resample(drawn, count, to, MAX_VERTICES);
        else
            memcpy(to, drawn, 3 * count * sizeof *to);
        out->vertices[i] = count < MAX_VERTICES ? count : MAX_VERTICES;
        out->vertex_count += out->vertices[i];
        out->radii[i] = follower->offset[0].w;
        out->groups[i] = (uint8_t)groom->guides[follower->guide0].group;
        out->radius += (double)out->radii[i] / source->count;
        out->start += (double)start_of(source, piece) / source->count;
        if (out->colors) copy_colors(source, piece, out->colors + 3 * HAIR_STRAND_COLORS * (size_t)i);
    }
}

static void free_arrays(const hair_host* host, struct arrays* arrays)
{
    hair_free(host, arrays->positions);
    hair_free(host, arrays->vertices);
    hair_free(host, arrays->radii);
    hair_free(host, arrays->groups);
    hair_free(host, arrays->colors);
}

// Return the number of guides of the pieces.
static uint32_t count_piece_guides(const struct hair_piece_source* source)
{
    const hair_groom_info* info = &source->hair->groom->info;
    double per_strand = fmin((double)info->guide_count / info->follower_count, 1);
    uint32_t wanted = (uint32_t)(MORE_GUIDES * per_strand * source->count + 0.5);
    wanted = wanted > MIN_GUIDES ? wanted : MIN_GUIDES;
    return wanted < source->count ? wanted : source->count;
}

static hair_result make_piece_groom(const struct hair_piece_source* source, const struct arrays* arrays,
                                    struct hair_groom_origin* origin, hair_groom** out)
{
    const hair_host* host = &source->hair->context->host;
    hair_groom_desc desc = hair_groom_desc_default();
    hair_import import = hair_import_default();
    desc.positions = arrays->positions;
    desc.strand_vertices = arrays->vertices;
    desc.strand_count = source->count;
    desc.strand_radii = arrays->radii;
    desc.strand_groups = arrays->groups;
    desc.colors = arrays->colors, desc.color_count = arrays->colors ? HAIR_STRAND_COLORS : 0;
    desc.guide_count = count_piece_guides(source);
    desc.guide_vertices = MAX_VERTICES;
    if (source->hair->groom->tasks.run) desc.tasks = &source->hair->groom->tasks;
    HAIR_TRY(hair_groom_build(host, &desc, &import, origin, out));
    HAIR_ASSERT((*out)->info.strand_count == source->count);
    (*out)->head_sphere = (hair_vec4){0, 0, 0, 0};
    for (uint32_t i = 0; i < (*out)->info.follower_count; ++i)
        (*out)->followers[i].seed =
            source->hair->groom->followers[source->pieces[origin->follower[i]].follower].seed;
    return HAIR_OK;
}

// Return a curve along a piece that starts at `start` of the strand.
static hair_curve curve_from(const hair_curve* curve, float start, float scale)
{
    hair_curve out;
    for (int i = 0; i < 8; ++i) {
        float at = 7 * (start + (1 - start) * (float)i / 7);
        int k = at < 6 ? (int)at : 6;
        out.at[i] = scale * (curve->at[k] + (at - (float)k) * (curve->at[k + 1] - curve->at[k]));
    }
    return out;
}

// Return the look of strands that are drawn as they are, with the colours from where they start.
static hair_look look_of(const struct hair_piece_source* source, const struct arrays* arrays)
{
    hair_look look = source->hair->look;
    float start = (float)arrays->start;
    look.curl.radius = look.strays.fraction = look.strays.tip_fraction = 0;
    look.strays.frizz = hair_curve_line(0, 0);
    look.strand.length = 1, look.strand.length_variation = 0;
    look.strand.radius = fminf(fmaxf(look.strand.radius * (float)arrays->radius, 1e-6f), 0.01f);
    look.strand.taper = curve_from(&look.strand.taper, start, 1);
    look.strand.segments = look.strand.segments < MAX_VERTICES ? look.strand.segments : MAX_VERTICES;
    look.color.tint_red = curve_from(&look.color.tint_red, start, 1);
    look.color.tint_green = curve_from(&look.color.tint_green, start, 1);
    look.color.tint_blue = curve_from(&look.color.tint_blue, start, 1);
    for (int c = 0; c < 3; ++c) look.color.root[c] += start * (look.color.tip[c] - look.color.root[c]);
    if (start > look.color.root_darkening_length) look.color.root_darkening = 0;
    return look;
}

// Return physics of strands that nothing holds, and that nothing pulls to a rest pose.
static hair_physics free_physics(const hair_physics* physics)
{
    hair_physics own = *physics;
    own.root = HAIR_ROOT_FREE;
    own.shape.frequency_root = own.shape.frequency_tip = 0;
    return own;
}

static hair_result make_piece_instance(const struct hair_piece_source* source, const struct arrays* arrays,
                                       const hair_groom* groom, hair_instance** out)
{
    const hair_instance* hair = source->hair;
    hair_desc desc = hair_desc_default();
    hair_physics physics = free_physics(&hair->sim.physics);
    hair_look look = look_of(source, arrays);
    struct hair_pose pose = {.rotation = {0, 0, 0, 1}};
    char label[sizeof hair->label + 8];
    snprintf(label, sizeof label, "%s pieces", hair->label);
    memcpy(pose.position, hair->sim.head_at_last_step.position, sizeof pose.position);
    hair_pose_to_matrix(&pose, desc.transform);
    desc.label = label;
    // The solver redblack holds all roots.
    desc.solver = hair->sim.rods ? hair->sim.solver : HAIR_SOLVER_DIRECT;
    desc.substep = hair->sim.rods ? (float)hair->sim.asked_substep : HAIR_AUTO;
    desc.thread_mapping = hair->creation.thread_mapping;
    desc.max_dt = (float)hair->max_dt;
    desc.field_voxel = hair->creation.field_voxel;
    desc.hit_method = hair->creation.uses_prepass ? HAIR_HIT_METHOD_PREPASS : HAIR_HIT_METHOD_AUTO;
    desc.physics = &physics;
    desc.look = &look;
    return hair_create(hair->context, groom, &desc, out);
}

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
    sim->gl->CopyNamedBufferSubData(upload, sim->state, 0, 0, (GLsizeiptr)size);
    hair_gl_free_buffer(sim->gl, &upload);
    return HAIR_OK;
}

// Give the guides of the pieces the velocities of the hair. What is drawn lies one substep behind
// the state.
static hair_result set_piece_motion(const struct hair_piece_source* source, const uint32_t* piece_of,
                                    hair_instance* pieces)
{
    struct hair_sim* sim = &pieces->sim;
    const struct hair_groom* groom = pieces->groom;
    struct hair_state* states = hair_alloc(&sim->gl->host, sim->guide_vertices, sizeof *states);
    if (!states) return hair_fail_memory(&sim->gl->host, "the motion of cut hair");
    for (uint32_t g = 0; g < sim->guides; ++g) {
        const struct hair_guide* guide = &groom->guides[g];
        const struct hair_piece* piece = &source->pieces[piece_of[g]];
        float from = start_of(source, piece), so_far = 0;
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

// Give pieces the settings of the hair that creation does not take.
static hair_result copy_piece_settings(const hair_instance* hair, hair_instance* pieces)
{
    hair_wind wind = hair->sim.wind;
    wind.model = HAIR_WIND_AMBIENT; // The fluid is around the head.
    hair_sim_set_wind(&pieces->sim, &wind);
    for (uint32_t g = 0; g < HAIR_MAX_STRAND_GROUPS; ++g) {
        if (!(hair->sim.groups.own >> g & 1)) continue;
        hair_physics own = free_physics(&hair->sim.groups.physics[g]);
        HAIR_TRY(hair_sim_set_group_physics(&pieces->sim, g, &own));
    }
    if (hair->group_looks) HAIR_TRY(hair_instance_set_group_looks(pieces, hair->group_looks));
    return hair_colliders_copy(&hair->context->host, &pieces->sim.colliders, &hair->sim.colliders);
}

static hair_result make_pieces(struct hair_piece_source* source, struct arrays* arrays,
                               struct hair_groom_origin* origin, hair_instance** out)
{
    hair_groom* groom = NULL;
    hair_instance* pieces = NULL;
    HAIR_TRY(alloc_arrays(source, arrays));
    fill_arrays(source, arrays);
    HAIR_TRY(make_piece_groom(source, arrays, origin, &groom));
    hair_result result = make_piece_instance(source, arrays, groom, &pieces);
    hair_groom_release(groom);
    HAIR_TRY(result);
    hair_enter_unprofiled(pieces);
    result = copy_piece_settings(source->hair, pieces);
    if (!result) result = set_piece_motion(source, origin->guide, pieces);
    result = hair_leave(pieces->context, result);
    if (result)
        hair_destroy(pieces);
    else
        *out = pieces;
    return result;
}

hair_result hair_pieces_create(struct hair_piece_source* source, hair_instance** out)
{
    const hair_host* host = &source->hair->context->host;
    struct arrays arrays = {0};
    struct hair_groom_origin origin = {0};
    *out = NULL;
    drop_short(source);
    if (!source->count) return HAIR_OK;
    hair_result result = make_pieces(source, &arrays, &origin, out);
    free_arrays(host, &arrays);
    hair_free(host, origin.guide);
    hair_free(host, origin.follower);
    return result;
}
