// rest.c - the rest shape of guides: vertices, lengths, frames, and directions in the previous
// segment's frame.
//
//   F_0 = root frame, y along the first segment       direction_0 = (0, 1, 0)
//   F_i = T_i F_(i-1), where T_i is the smallest rotation from segment i-1 to segment i
//   direction_i = F_(i-1)^-1 d_i, where d_i is the unit direction of segment i
//
// No segment begins at the tip, so the tip has the frame of the last segment.
#include "lib/groom/groom_builder.h"

#include <string.h>

// Minimum number of vertices, if guide_vertices allows it. The scalp pins two, and two free
// vertices can bend.
#define MIN_VERTICES 4
// Minimum distance of neighbouring vertices of a guide, as a fraction of the mean distance.
#define CLOSEST 0.1
#define Y_AXIS hair_v3(0, 1, 0)

static hair_vec3 vertex(const float* p, size_t i)
{
    return hair_load3(p + 3 * i);
}

static hair_vec3 segment_vector(const float* p, size_t i)
{
    return hair_normalize(hair_sub(vertex(p, i + 1), vertex(p, i)), Y_AXIS);
}

static uint32_t count_guide_vertices(const struct hair_groom_builder* builder, uint32_t guide)
{
    uint32_t vertices = builder->strands.vertices[builder->chosen[guide]];
    uint32_t max = builder->desc->guide_vertices;
    if (vertices < MIN_VERTICES) vertices = MIN_VERTICES;
    return vertices < max ? vertices : max;
}

// Drop vertices closer to the previous one than a tenth of the mean distance. Keep the tip. Return
// the new count. Solvers cannot determine how shorter segments turn, and would need substeps as
// much shorter.
static uint32_t space_out(float* positions, uint32_t vertices, uint32_t count)
{
    float min = (float)(CLOSEST * hair_strand_length(positions, vertices) / (count - 1));
    uint32_t kept = 1;
    for (uint32_t i = 1; i < vertices; ++i) {
        hair_vec3 at = vertex(positions, i);
        if (hair_distance(vertex(positions, kept - 1), at) >= min)
            hair_store3(positions + 3 * (size_t)kept++, at);
        else if (i + 1 == vertices && kept > 1)
            hair_store3(positions + 3 * (size_t)(kept - 1), at);
    }
    HAIR_ASSERT(2 <= kept && kept <= vertices);
    return kept;
}

// Write a strand as `count` vertices.
//
// If the strand does not have more, the vertices that are far enough apart are kept and segments
// are split. This preserves shape and length. If the strand has more, vertices at equal distances
// replace them. Each arc of length s and radius r is then shortened to its chord, by (s/r)^2 / 24
// of its length.
static void sample_strand(const float* positions, uint32_t vertices, float* out, uint32_t count)
{
    uint32_t have = vertices;
    if (vertices > count) {
        hair_strand_resample(positions, vertices, out, count);
        have = hair_strand_merge(out, count);
        // All samples of a strand that runs back and forth may coincide. Use its first vertices
        // instead.
        if (!hair_strand_is_fit(out, have)) {
            memcpy(out, positions, 3 * (size_t)count * sizeof *out);
            have = count;
        }
    } else {
        memcpy(out, positions, 3 * (size_t)vertices * sizeof *out);
        have = space_out(out, vertices, count);
    }
    hair_strand_split(out, have, count);
}

// Return the mean direction of first segments. Root frames are turned from this direction, so they
// vary smoothly over the scalp. Their only singularity is the opposite direction, in which no hair
// grows.
static hair_vec3 mean_direction(const struct hair_groom_builder* builder)
{
    hair_vec3 sum = {0};
    for (uint32_t i = 0; i < builder->groom->info.guide_count; ++i)
        sum = hair_add(sum, segment_vector(builder->strands.positions, builder->first[builder->chosen[i]]));
    return hair_normalize(sum, Y_AXIS);
}

struct rest_work {
    struct hair_groom_builder* builder;
    struct hair_division division; // of the guides
    hair_vec3 mean; // direction of first segments
};

// Return the frame whose y axis is `to`, by the smallest rotation from the frame of the mean
// direction. Rotate twice, because the first rotation is inaccurate for nearly opposite directions.
static hair_quat find_root_frame(hair_vec3 mean, hair_vec3 to)
{
    hair_quat frame = hair_quat_between(Y_AXIS, mean);
    for (int i = 0; i < 2; ++i) {
        hair_quat turn = hair_quat_between(hair_normalize(hair_rotate(frame, Y_AXIS), Y_AXIS), to);
        frame = hair_quat_normalize(hair_quat_multiply(turn, frame));
    }
    return frame;
}

static void write_rest(const float* p, uint32_t count, struct hair_guide* guide, struct hair_rest* rest)
{
    hair_quat frame = {guide->root_frame.x, guide->root_frame.y, guide->root_frame.z, guide->root_frame.w};
    hair_vec3 before = segment_vector(p, 0);
    double total = 0;
    for (uint32_t i = 0; i < count; ++i) {
        hair_vec3 at = vertex(p, i);
        float length = i + 1 < count ? hair_distance(at, vertex(p, i + 1)) : 0;
        if (i > 0 && i + 1 < count) {
            hair_vec3 direction = segment_vector(p, i);
            frame = hair_quat_normalize(hair_quat_multiply(hair_quat_between(before, direction), frame));
            before = direction;
        }
        rest[i].position = (hair_vec4){at.x, at.y, at.z, length};
        HAIR_ASSERT(hair_quat_is_unit(frame));
        rest[i].frame = (hair_vec4){frame.x, frame.y, frame.z, frame.w};
        total += (double)length;
    }
    guide->arc_length = (float)total;
    HAIR_ASSERT(guide->arc_length > 0);
}

static void write_rest_guide(struct hair_groom_builder* builder, uint32_t number, hair_vec3 mean)
{
    struct hair_guide* guide = &builder->groom->guides[number];
    uint32_t strand = builder->chosen[number];
    HAIR_ASSERT(2 <= guide->count && guide->count <= HAIR_MAX_GUIDE_VERTICES);
    float p[3 * HAIR_MAX_GUIDE_VERTICES];
    sample_strand(builder->strands.positions + 3 * (size_t)builder->first[strand],
                  builder->strands.vertices[strand], p, guide->count);
    hair_quat frame = find_root_frame(mean, segment_vector(p, 0));
    guide->root_frame = (hair_vec4){frame.x, frame.y, frame.z, frame.w};
    write_rest(p, guide->count, guide, builder->groom->rest + guide->first);
}

static void write_rest_guides(uint32_t index, void* data)
{
    const struct rest_work* work = data;
    uint32_t end = hair_division_end(&work->division, index);
    for (uint32_t i = index * work->division.each; i < end; ++i)
        write_rest_guide(work->builder, i, work->mean);
}

hair_result hair_build_rest(struct hair_groom_builder* builder)
{
    struct hair_groom* groom = builder->groom;
    hair_groom_info* info = &groom->info;
    groom->guides = hair_alloc_undefined(builder->host, info->guide_count, sizeof *groom->guides);
    if (!groom->guides) return hair_fail_memory(builder->host, "guides");
    for (uint32_t i = 0; i < info->guide_count; ++i) {
        uint32_t count = count_guide_vertices(builder, i);
        groom->guides[i] = (struct hair_guide){.first = info->guide_vertex_count,
                                               .count = count,
                                               .group = hair_group_of(builder, builder->chosen[i])};
        info->guide_vertex_count += count; // At most HAIR_MAX_GUIDES times 256.
        if (count > groom->max_vertices) groom->max_vertices = count;
    }
    groom->rest = hair_alloc_undefined(builder->host, info->guide_vertex_count, sizeof *groom->rest);
    if (!groom->rest) return hair_fail_memory(builder->host, "guides");
    struct rest_work work = {.builder = builder,
                             .division = hair_divide(info->guide_count, HAIR_MIN_TASK_STRANDS),
                             .mean = mean_direction(builder)};
    hair_run_tasks(&groom->tasks, write_rest_guides, &work, work.division.tasks);
    return hair_measure_rest(groom);
}

struct rest_bounds {
    struct hair_groom* groom;
    struct hair_division division; // of the guides
    hair_vec3 lower[HAIR_MAX_TASKS], upper[HAIR_MAX_TASKS]; // of each task
};

static void measure_rest_guides(uint32_t index, void* data)
{
    struct rest_bounds* bounds = data;
    const struct hair_groom* groom = bounds->groom;
    uint32_t first = index * bounds->division.each, end = hair_division_end(&bounds->division, index);
    hair_vec3 lower = {INFINITY, INFINITY, INFINITY}, upper = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t i = first; i < end; ++i) {
        const struct hair_guide* guide = &groom->guides[i];
        const struct hair_rest* rest = groom->rest + guide->first;
        memcpy(groom->roots + 3 * (size_t)i, &rest->position, 3 * sizeof *groom->roots);
        for (uint32_t k = 0; k < guide->count; ++k) {
            const hair_vec4 at = rest[k].position;
            lower = hair_v3(fminf(lower.x, at.x), fminf(lower.y, at.y), fminf(lower.z, at.z));
            upper = hair_v3(fmaxf(upper.x, at.x), fmaxf(upper.y, at.y), fmaxf(upper.z, at.z));
        }
    }
    bounds->lower[index] = lower;
    bounds->upper[index] = upper;
}

hair_result hair_measure_rest(struct hair_groom* groom)
{
    uint32_t count = groom->info.guide_count;
    struct rest_bounds bounds = {.groom = groom, .division = hair_divide(count, HAIR_MIN_TASK_STRANDS)};
    HAIR_ASSERT(count > 0 && !groom->roots);
    groom->roots = hair_alloc_undefined(&groom->host, count, 3 * sizeof *groom->roots);
    if (!groom->roots) return hair_fail_memory(&groom->host, "guides");
    hair_run_tasks(&groom->tasks, measure_rest_guides, &bounds, bounds.division.tasks);
    groom->lower = bounds.lower[0], groom->upper = bounds.upper[0];
    for (uint32_t i = 1; i < bounds.division.tasks; ++i) {
        const hair_vec3 lower = bounds.lower[i], upper = bounds.upper[i];
        groom->lower = hair_v3(fminf(groom->lower.x, lower.x), fminf(groom->lower.y, lower.y),
                               fminf(groom->lower.z, lower.z));
        groom->upper = hair_v3(fmaxf(groom->upper.x, upper.x), fmaxf(groom->upper.y, upper.y),
                               fmaxf(groom->upper.z, upper.z));
    }
    return HAIR_OK;
}
