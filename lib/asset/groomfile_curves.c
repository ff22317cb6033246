// groomfile_curves.c - positions of strands in .groom files, as whole numbers of a unit that fits
// the length of the strand.
#include "lib/asset/groomfile.h"
#include "lib/asset/track.h"

#include <math.h>

// Maximum error of a position as a fraction of the length of the strand. A strand that goes through
// several files changes again only if its unit does, so the sum stays below 1e-5.
#define MAX_ERROR 5e-6
// A unit of this fraction gives errors of at most half the diagonal of a cube, which is less than
// MAX_ERROR.
#define UNIT 5.7e-6
#define FARTHEST 1e6 // Maximum distance from the origin, m, as for strands.
#define STEP_BIAS 128
#define MIN_STEP 64
#define MAX_STEP 160
#define ATTEMPTS 3 // Units that are tried, each half of the one before.
#define FIXED 13 // bytes of a strand before its widths

// A strand as it is in a file.
struct packed_strand {
    int32_t points[3 * HAIR_STRAND_MAX_VERTICES]; // in units from the root, or bits of floats
    uint32_t widths;
    uint8_t step;
};

// Return the position of a coordinate that is a whole number of units from the root.
static float place_on_strand(float root, int step, int32_t point)
{
    return (float)(root + ldexp(1, step - STEP_BIAS) * point);
}

static bool is_near(const float* a, const float* b, uint32_t count, double max)
{
    for (uint32_t i = 0; i < count; ++i, a += 3, b += 3) {
        // NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult): `a` is filled.
        double x = (double)a[0] - b[0], y = (double)a[1] - b[1], z = (double)a[2] - b[2];
        double far = (double)a[0] * a[0] + (double)a[1] * a[1] + (double)a[2] * a[2];
        if (!(x * x + y * y + z * z <= max * max && far <= FARTHEST * FARTHEST)) return false;
    }
    return true;
}

// Round a strand to units. Return whether a reader gets as many vertices, all of them near.
static bool round_strand(const float* p, uint32_t vertices, double length, int step,
                         struct packed_strand* out)
{
    float again[3 * HAIR_STRAND_MAX_VERTICES];
    if (step < MIN_STEP || step > MAX_STEP) return false;
    double scale = ldexp(1, STEP_BIAS - step);
    for (uint32_t i = 0; i < 3 * vertices; ++i) {
        float root = p[i % 3];
        out->points[i] = (int32_t)floor(((double)p[i] - root) * scale + 0.5);
        again[i] = place_on_strand(root, step, out->points[i]);
    }
    return is_near(again, p, vertices, MAX_ERROR * length) && hair_strand_is_fit(again, vertices);
}

static void pack_strand(const float* p, uint32_t vertices, struct packed_strand* out)
{
    HAIR_ASSERT(vertices >= 2 && vertices <= HAIR_STRAND_MAX_VERTICES);
    double length = hair_strand_length(p, vertices);
    int exponent = 0;
    frexp(UNIT * length, &exponent);
    for (int attempt = 0; attempt < ATTEMPTS; ++attempt) {
        int step = STEP_BIAS + exponent - 1 - attempt;
        if (!round_strand(p, vertices, length, step, out)) continue;
        out->widths = hair_track_find_widths(out->points, vertices);
        out->step = (uint8_t)step;
        return;
    }
    // Rounding would merge vertices, so the numbers are kept as they are.
    memcpy(out->points, p, 3 * (size_t)vertices * sizeof *p);
    out->widths = 0;
    out->step = 0;
}

static void write_bits(struct hair_bit_writer* writer, const struct packed_strand* strand, uint32_t vertices)
{
    if (strand->step) {
        hair_track_write(writer, strand->widths, strand->points, vertices);
        return;
    }
    for (uint32_t k = 0; k < 3; ++k)
        for (uint32_t i = 1; i < vertices; ++i)
            hair_bits_write(writer, (uint32_t)strand->points[3 * i + k], 32);
}

uint64_t hair_write_curves(const struct hair_strands* strands, unsigned char* at)
{
    size_t count = strands->strand_count, fixed = (FIXED + 4) * count;
    struct hair_bit_writer writer = {.at = at ? at + fixed : NULL};
    struct packed_strand strand;
    const float* p = strands->positions;
    for (size_t i = 0; i < count; ++i) {
        uint32_t vertices = strands->vertices[i];
        pack_strand(p, vertices, &strand);
        write_bits(&writer, &strand, vertices);
        if (at) {
            for (size_t k = 0; k < 3; ++k) hair_write_float(at + 12 * i + 4 * k, p[k]);
            at[12 * count + i] = strand.step;
            hair_write_u32(at + FIXED * count + 4 * i, strand.widths);
        }
        p += 3 * (size_t)vertices;
    }
    hair_bits_finish(&writer);
    return fixed + writer.count / 8;
}

// Reading -----------------------------------------------------------------------------------------

hair_result hair_check_curves(const struct hair_groom_chunk* chunk, uint32_t strands,
                              const unsigned char* counts)
{
    HAIR_TRY(hair_check_tracks(chunk, strands, counts, FIXED));
    const unsigned char* steps = chunk->content + 12 * (size_t)strands;
    for (size_t i = 0; i < strands; ++i)
        if (steps[i] && (steps[i] < MIN_STEP || steps[i] > MAX_STEP))
            return HAIR_FAIL_CHUNK(chunk, "has the step %u of strand %zu, not 0 or in [%d, %d]", steps[i], i,
                                   MIN_STEP, MAX_STEP);
    return HAIR_OK;
}

static void read_packed_strand(struct hair_bit_reader* reader, uint32_t step, uint32_t widths, float* p,
                               uint32_t vertices)
{
    int32_t points[3 * HAIR_STRAND_MAX_VERTICES];
    points[0] = points[1] = points[2] = 0;
    if (step) {
        hair_track_read(reader, widths, points, vertices);
        double unit = ldexp(1, (int)step - STEP_BIAS);
        for (uint32_t i = 3; i < 3 * vertices; ++i) p[i] = (float)(p[i % 3] + unit * points[i]);
        return;
    }
    for (uint32_t k = 0; k < 3; ++k)
        for (uint32_t i = 1; i < vertices; ++i) {
            uint32_t bits = hair_bits_read(reader, 32);
            memcpy(&p[3 * i + k], &bits, sizeof bits);
        }
}

void hair_read_curves(const struct hair_groom_chunk* chunk, struct hair_strands* strands)
{
    size_t count = strands->strand_count;
    const unsigned char *roots = chunk->content, *steps = roots + 12 * count, *widths = steps + count;
    struct hair_bit_reader reader = {.at = widths + 4 * count, .end = chunk->content + chunk->size};
    float* p = strands->positions;
    for (size_t i = 0; i < count; ++i) {
        for (size_t k = 0; k < 3; ++k) p[k] = hair_read_float(roots + 12 * i + 4 * k);
        read_packed_strand(&reader, steps[i], hair_read_u32(widths + 4 * i), p, strands->vertices[i]);
        p += 3 * (size_t)strands->vertices[i];
    }
}
