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

// Attributes that pieces have from their strands. The shape of pieces has all others.
static const hair_strand_attribute_kind piece_kinds[] = {
    HAIR_STRAND_ATTRIBUTE_STIFFNESS, HAIR_STRAND_ATTRIBUTE_DAMPING, HAIR_STRAND_ATTRIBUTE_ROUGHNESS};
#define PIECE_KINDS (sizeof piece_kinds / sizeof *piece_kinds)

// Arrays from which the groom of pieces is made.
struct arrays {
    float *positions, *radii, *colors;
    float* factors[PIECE_KINDS]; // NULL for an attribute that the strands do not have.
    uint32_t* vertices;
    uint8_t* groups;
    uint32_t vertex_count;
    double radius; // Mean factor of the radius of strands.
    double start; // Mean place at which the pieces start, [0, 1].
};

// Write the vertices of a piece as they are drawn. Return their number.
static uint32_t copy_vertices(const struct hair_piece_source* source, const struct hair_piece* piece,
                              float out[3 * (HAIR_MAX_GUIDE_VERTICES + 1)])
{
    uint32_t segments = hair_piece_segments(source), count = 1;
    const hair_vec4* vertex = piece->vertices;
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

// Write the colours of a piece at HAIR_STRAND_COLORS points.
static void copy_colors(const struct hair_piece_source* source, const struct hair_piece* piece, float* out)
{
    const uint16_t* from = source->hair->groom->colors + 4 * HAIR_STRAND_COLORS * (size_t)piece->follower;
    float whole[3 * HAIR_STRAND_COLORS], start = hair_piece_start(source, piece);
    for (int k = 0; k < HAIR_STRAND_COLORS; ++k)
        for (int c = 0; c < 3; ++c) whole[3 * k + c] = (float)from[4 * k + c] / 65535;
    for (int k = 0; k < HAIR_STRAND_COLORS; ++k)
        hair_strand_color_at(whole, start + (piece->fraction - start) * (float)k / (HAIR_STRAND_COLORS - 1),
                             out + 3 * (size_t)k);
}

// Return whether the strands have an attribute.
static bool has_kind(const struct hair_groom* groom, hair_strand_attribute_kind kind)
{
    const struct hair_guide_factors *min = &groom->min_factors, *max = &groom->max_factors;
    if (kind == HAIR_STRAND_ATTRIBUTE_ROUGHNESS) return groom->factor_slots >> 4 * HAIR_FACTOR_VARIANCE & 15;
    if (!groom->guide_factors) return false;
    return kind == HAIR_STRAND_ATTRIBUTE_STIFFNESS ? min->stiffness != 1 || max->stiffness != 1
                                                   : min->damping != 1 || max->damping != 1;
}

// Return the factor of a follower, or the mean of its guides.
static float find_factor(const struct hair_groom* groom, uint32_t follower, hair_strand_attribute_kind kind)
{
    const uint32_t stride = sizeof *groom->guide_factors / sizeof(float);
    if (kind == HAIR_STRAND_ATTRIBUTE_ROUGHNESS)
        return sqrtf(hair_groom_follower_factor(groom, follower, HAIR_FACTOR_VARIANCE));
    const float* first = kind == HAIR_STRAND_ATTRIBUTE_STIFFNESS ? &groom->guide_factors->stiffness
                                                                 : &groom->guide_factors->damping;
    return hair_groom_follower_mean(groom, follower, first, stride);
}

static hair_result alloc_factors(const struct hair_piece_source* source, struct arrays* out)
{
    const hair_host* host = &source->hair->context->host;
    for (size_t k = 0; k < PIECE_KINDS; ++k) {
        if (!has_kind(source->hair->groom, piece_kinds[k])) continue;
        out->factors[k] = hair_alloc(host, source->count, sizeof *out->factors[k]);
        if (!out->factors[k]) return hair_fail_memory(host, "the attributes of cut hair");
    }
    return HAIR_OK;
}

// Write the factors of piece i within the ranges of their kinds.
static void copy_factors(const struct hair_piece_source* source, uint32_t i, struct arrays* out)
{
    for (size_t k = 0; k < PIECE_KINDS; ++k) {
        struct hair_attribute_range range = hair_attribute_range_of(piece_kinds[k]);
        if (!out->factors[k]) continue;
        float factor = find_factor(source->hair->groom, source->pieces[i].follower, piece_kinds[k]);
        out->factors[k][i] = fminf(fmaxf(factor, range.min), range.max);
    }
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
    if (!out->positions || !out->vertices || !out->radii || !out->groups || (has_colors && !out->colors))
        return hair_fail_memory(host, "the pieces of cut hair");
    return alloc_factors(source, out);
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
        out->start += (double)hair_piece_start(source, piece) / source->count;
        copy_factors(source, i, out);
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
    for (size_t k = 0; k < PIECE_KINDS; ++k) hair_free(host, arrays->factors[k]);
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

// Write the attributes of the groom. Return their number.
static uint32_t write_attributes(const struct arrays* arrays, hair_strand_attribute out[PIECE_KINDS])
{
    uint32_t count = 0;
    for (size_t k = 0; k < PIECE_KINDS; ++k) {
        if (!arrays->factors[k]) continue;
        out[count] = hair_strand_attribute_default();
        out[count].kind = piece_kinds[k];
        out[count++].strand_values = arrays->factors[k];
    }
    return count;
}

// Give the followers of pieces the seeds and the root uvs of their strands.
static hair_result copy_roots(const struct hair_piece_source* source, const struct hair_groom_origin* origin,
                              struct hair_groom* groom)
{
    const struct hair_groom* from = source->hair->groom;
    if (from->root_uvs) {
        groom->root_uvs = hair_alloc(&groom->host, groom->info.follower_count, 2 * sizeof *groom->root_uvs);
        if (!groom->root_uvs) return hair_fail_memory(&groom->host, "the places of roots");
    }
    for (uint32_t i = 0; i < groom->info.follower_count; ++i) {
        uint32_t follower = source->pieces[origin->follower[i]].follower;
        groom->followers[i].seed = from->followers[follower].seed;
        for (size_t k = 0; from->root_uvs && k < 2; ++k)
            groom->root_uvs[2 * (size_t)i + k] = from->root_uvs[2 * (size_t)follower + k];
    }
    return HAIR_OK;
}

static hair_result make_piece_groom(const struct hair_piece_source* source, const struct arrays* arrays,
                                    struct hair_groom_origin* origin, hair_groom** out)
{
    const hair_host* host = &source->hair->context->host;
    hair_groom_desc desc = hair_groom_desc_default();
    hair_import import = hair_import_default();
    hair_strand_attribute attributes[PIECE_KINDS];
    desc.positions = arrays->positions;
    desc.strand_vertices = arrays->vertices;
    desc.strand_count = source->count;
    desc.strand_radii = arrays->radii;
    desc.strand_groups = arrays->groups;
    desc.colors = arrays->colors, desc.color_count = arrays->colors ? HAIR_STRAND_COLORS : 0;
    desc.guide_count = count_piece_guides(source);
    desc.guide_vertices = MAX_VERTICES;
    desc.strand_attribute_count = write_attributes(arrays, attributes), desc.strand_attributes = attributes;
    if (source->hair->groom->tasks.run) desc.tasks = &source->hair->groom->tasks;
    HAIR_TRY(hair_groom_build(host, &desc, &import, origin, out));
    HAIR_ASSERT((*out)->info.strand_count == source->count);
    (*out)->head_sphere = (hair_vec4){0, 0, 0, 0};
    return copy_roots(source, origin, *out);
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
    hair_look_apply_pigment(&look);
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
    hair_result result = make_piece_groom(source, arrays, origin, &groom);
    if (!result) result = make_piece_instance(source, arrays, groom, &pieces);
    hair_groom_release(groom);
    HAIR_TRY(result);
    hair_enter_unprofiled(pieces);
    result = copy_piece_settings(source->hair, pieces);
    if (!result) result = hair_pieces_set_motion(source, origin->guide, pieces);
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
