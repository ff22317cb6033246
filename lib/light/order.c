// order.c - how parallel strands are, where no pass measures their vertices.
//
// The measure is that of light/vertex_transmittance.comp: the distance between two points of a
// strand that are 4 cm apart along it, divided by these 4 cm, to the 16th power.
#include "lib/light/lighting.h"

#include <math.h>

#define REACH 0.02f // m, along the strand to each side of a vertex.
#define GUIDES 256 // Maximum number of guides that are measured.
#define TAU 6.283185307f
#define KNOTS (HAIR_CURVE_INTERVALS + 1) // of a hair_curve
// Mean square of the slope of a cubic B-spline with random control points in the square [-1, 1]^2,
// 1 apart along the strand. Frizz is such a spline.
#define KINK_SLOPE (4 / 9.0f)

static float to_16th_power(float x)
{
    x *= x, x *= x, x *= x;
    return x * x;
}

// Return the measure at vertex k of a guide at rest.
static float order_at_vertex(const struct hair_rest* rest, uint32_t vertices, uint32_t k)
{
    float part = fmaxf(rest[k].position.w, k > 0 ? rest[k - 1].position.w : 0), path = 0;
    uint32_t reach = (uint32_t)fminf(fmaxf(REACH / fmaxf(part, 1e-6f) + 0.5f, 1), 8);
    uint32_t first = k - (reach < k ? reach : k), last = k + reach < vertices ? k + reach : vertices - 1;
    for (uint32_t i = first; i < last; ++i) path += rest[i].position.w;
    const hair_vec4 *a = &rest[first].position, *b = &rest[last].position;
    float straight = hair_length(hair_v3(b->x - a->x, b->y - a->y, b->z - a->z)) / fmaxf(path, 1e-9f);
    return to_16th_power(fminf(straight, 1));
}

void hair_lighting_measure_groom(struct hair_lighting* lighting, const struct hair_groom* groom)
{
    uint32_t guides = groom->info.guide_count, step = guides / GUIDES + 1, measured = 0;
    double sum = 0, count = 0, length = 0;
    for (uint32_t g = 0; g < guides; g += step) {
        const struct hair_guide* guide = &groom->guides[g];
        HAIR_ASSERT(guide->count > 1);
        for (uint32_t k = 0; k < guide->count; ++k)
            sum += (double)order_at_vertex(groom->rest + guide->first, guide->count, k);
        count += guide->count;
        length += (double)guide->arc_length;
        ++measured;
    }
    HAIR_ASSERT(measured > 0);
    lighting->groom_order = (float)(sum / count);
    lighting->groom_length = (float)(length / measured);
}

// Return the mean square of the displacements of a curl, as a multiple of the square of its radius.
static float square_of_curl(const hair_look* look)
{
    float flat = 1 - look->curl.flatness, sum = 0;
    if (look->curl.shape != HAIR_CURL_SHAPE_EXAMPLE) return 0.5f * (1 + flat * flat);
    for (int i = 0; i < 16; ++i)
        sum += look->curl.profile_x[i] * look->curl.profile_x[i] +
               look->curl.profile_z[i] * look->curl.profile_z[i];
    return sum / 16;
}

// Return the measure of a straight strand that a helix displaces. `r2` is the mean square of the
// displacements, m^2, and `slope` the mean square of the slope that frizz adds. Frizz brings points
// that are far apart no nearer to each other.
static float order_of_helix(float r2, float per_metre, float slope)
{
    float longer = sqrtf(1 + r2 * per_metre * per_metre + slope);
    float axial = 2 * REACH / longer, across = 2 * sinf(0.5f * per_metre * axial);
    return to_16th_power(fminf(sqrtf(axial * axial + r2 * across * across) / (2 * REACH), 1));
}

// Return the phase of curls by length along a strand, radians/m.
static float find_curl_rate(const struct hair_lighting* lighting, const hair_look* look)
{
    float length = fmaxf(lighting->groom_length * look->strand.length, 1e-3f);
    return TAU * (1 / look->curl.wavelength + look->curl.turns / length);
}

void hair_lighting_find_curl(const struct hair_lighting* lighting, const hair_look* look, float* slope,
                             float* rate)
{
    float weights = 0, sum = 0;
    *rate = find_curl_rate(lighting, look);
    // An eye sees one of the two directions across a strand.
    float square = 0.5f * square_of_curl(look) * look->curl.radius * look->curl.radius * *rate * *rate;
    for (int i = 0; i < KNOTS; ++i) {
        float own = square * look->curl.profile.at[i] * look->curl.profile.at[i];
        float weight = 1 / sqrtf(1 + own);
        weights += weight, sum += weight * own;
    }
    *slope = sum / weights;
    HAIR_ASSERT(*slope >= 0 && *rate >= 0);
}

float hair_lighting_order(const struct hair_lighting* lighting, const hair_look* look)
{
    float per_metre = find_curl_rate(lighting, look), sum = 0;
    float curl = square_of_curl(look) * look->curl.radius * look->curl.radius;
    float frizzed = look->strays.frizz_fraction;
    for (int i = 0; i < KNOTS; ++i) {
        float r2 = curl * look->curl.profile.at[i] * look->curl.profile.at[i];
        float kink = look->strays.frizz.at[i] / look->strays.frizz_wavelength;
        sum += (1 - frizzed) * order_of_helix(r2, per_metre, 0) +
               frizzed * order_of_helix(r2, per_metre, KINK_SLOPE * kink * kink);
    }
    return lighting->groom_order * sum / (float)KNOTS;
}
