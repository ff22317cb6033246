// style_scalp.c - an even mesh of the hair-bearing part of the skull: outline, inner vertices,
// triangles.
//
// The outline is spaced evenly along the hairline and along both sides of the parting. Inner
// vertices are added at the largest gap, then moved a few times to the centroid of their triangles.
// Based on Gonzalez 1985, "Clustering to minimize the maximum intercluster distance", for the
// farthest points.
#include "lib/groom/style_scalp.h"
#include "lib/groom/style_body.h"

#include <string.h>

#define PI 3.14159265f
#define FINE 1024 // Number of samples of the hairline, by which the outline is measured.
#define CANDIDATES 4 // Positions tried per vertex.
// Number of relaxations. They make the spacing of 166 vertices even within a fifth.
#define RELAXATIONS 6
// Minimum distance of inner vertices from the ends and the middle of an outline edge, as a fraction
// of its length.
#define CLEARANCE 0.65f
#define PARTING_HALF 0.0010f // Half the width of a parting at the hairline, m. A comb's line.

struct build {
    const hair_host* host;
    struct hair_parting parting;
    uint32_t seed;
    float spacing;
    struct hair_scalp scalp;
    // Number of vertices of the outline. They are the first of the scalp, clockwise seen from
    // above.
    uint32_t outline_count;
    hair_vec3* candidates;
    float* gap; // squared distance from each candidate to the nearest vertex, m^2
    uint32_t candidate_count;
    hair_vec3* sum; // sum of the centroids of each vertex's triangles, weighted by area
    float* area;
    double* plane;
};

// Knots of the hairline: azimuth in degrees, height in metres. They follow the forehead, the corner
// above the temple, the sideburn, the ear and the nape.
static const float hairline[][2] = {{0, 1.692f},   {22, 1.693f},  {40, 1.694f},  {52, 1.679f},
                                    {62, 1.652f},  {71, 1.624f},  {80, 1.609f},  {89, 1.620f},
                                    {98, 1.625f},  {108, 1.606f}, {117, 1.584f}, {127, 1.575f},
                                    {142, 1.564f}, {160, 1.559f}, {180, 1.558f}};
#define HAIRLINE_KNOTS ((int)(sizeof hairline / sizeof *hairline))

float hair_scalp_hairline(float azimuth)
{
    float degrees = fabsf(remainderf(azimuth, 2 * PI)) * (180 / PI);
    int i = 0;
    while (i < HAIRLINE_KNOTS - 2 && hairline[i + 1][0] < degrees) ++i;
    HAIR_ASSERT(i + 1 < HAIRLINE_KNOTS);
    // Interpolate by the spline of Catmull and Rom (1974), with level ends.
    float p = hairline[i > 0 ? i - 1 : 1][1], q = hairline[i][1], r = hairline[i + 1][1];
    float s = hairline[i + 2 < HAIRLINE_KNOTS ? i + 2 : i][1];
    float t = (degrees - hairline[i][0]) / (hairline[i + 1][0] - hairline[i][0]);
    return q + 0.5f * t * (r - p + t * (2 * p - 5 * q + 4 * r - s + t * (3 * (q - r) + s - p)));
}

static hair_vec3 hairline_point(float azimuth)
{
    float y = (hair_scalp_hairline(azimuth) - HAIR_SKULL_HEIGHT) / HAIR_SKULL_Y;
    float r = sqrtf(1 - y * y);
    return hair_skull_point(hair_v3(r * sinf(azimuth), y, r * cosf(azimuth)));
}

static int bears_hair(hair_vec3 unit)
{
    return hair_skull_point(unit).y > hair_scalp_hairline(atan2f(unit.x, unit.z));
}

// Outline -----------------------------------------------------------------------------------------

static void add_vertex(struct build* build, hair_vec3 p)
{
    hair_store3(build->scalp.positions + 3 * build->scalp.vertex_count++, p);
}

// Return the azimuth at which the parting meets the hairline. `side` selects the edge of the
// parting.
static float parting_azimuth(const struct build* build, float side)
{
    float x = build->parting.front + side * PARTING_HALF;
    float azimuth = 0;
    // The hairline is nearly level there, so this converges to a micrometre.
    for (int i = 0; i < 4; ++i) {
        float y = (hair_scalp_hairline(azimuth) - HAIR_SKULL_HEIGHT) / HAIR_SKULL_Y;
        azimuth = asinf(x / (HAIR_SKULL_X * sqrtf(1 - y * y)));
    }
    return azimuth;
}

static uint32_t pieces(float length, float spacing, uint32_t min)
{
    uint32_t count = (uint32_t)(length / spacing + 0.5f);
    return count > min ? count : min;
}

// Add the hairline from one azimuth up to another, with the first end and without the last.
static void add_hairline(struct build* build, float from, float to)
{
    float along[FINE + 1] = {0};
    hair_vec3 last = hairline_point(from);
    for (int i = 1; i <= FINE; ++i) {
        hair_vec3 p = hairline_point(from + (to - from) * (float)i / FINE);
        along[i] = along[i - 1] + hair_distance(p, last);
        last = p;
    }
    uint32_t count = pieces(along[FINE], build->spacing, 7);
    int i = 0;
    for (uint32_t k = 0; k < count; ++k) {
        float target = along[FINE] * (float)k / (float)count;
        while (along[i + 1] < target) ++i;
        HAIR_ASSERT(i < FINE);
        float t = ((float)i + (target - along[i]) / (along[i + 1] - along[i])) / FINE;
        add_vertex(build, hairline_point(from + (to - from) * t));
    }
}

float hair_parting_x(struct hair_parting parting, float z)
{
    float t = (HAIR_PARTING_FRONT_Z - z) / (HAIR_PARTING_FRONT_Z - parting.crown_z);
    return parting.front + (parting.crown - parting.front) * fminf(fmaxf(t, 0), 1);
}

// Return a point of the parting. The parameter t is 0 at the hairline and 1 at the crown. `side` is
// -1 or 1 for an edge and 0 for the centre line.
static hair_vec3 parting_point(const struct build* build, float t, float side)
{
    float front = hairline_point(parting_azimuth(build, side)).z;
    float z = front + (build->parting.crown_z - front) * t;
    float x = (hair_parting_x(build->parting, z) + side * PARTING_HALF) / HAIR_SKULL_X;
    z /= HAIR_SKULL_Z;
    return hair_skull_point(hair_v3(x, sqrtf(1 - x * x - z * z), z));
}

static void add_outline(struct build* build)
{
    uint32_t seed = build->seed;
    if (!build->parting.exists) {
        float start = 2 * PI * hair_random(&seed);
        add_hairline(build, start - 2 * PI, start);
        build->outline_count = build->scalp.vertex_count;
        return;
    }
    add_hairline(build, parting_azimuth(build, 1), 2 * PI + parting_azimuth(build, -1));
    float length = hair_distance(parting_point(build, 0, 0), parting_point(build, 1, 0));
    uint32_t count = pieces(length, build->spacing, 1);
    for (uint32_t k = 0; k < count; ++k) add_vertex(build, parting_point(build, (float)k / (float)count, -1));
    add_vertex(build, parting_point(build, 1, 0));
    for (uint32_t k = count - 1; k > 0; --k)
        add_vertex(build, parting_point(build, (float)k / (float)count, 1));
    build->outline_count = build->scalp.vertex_count;
}

// Inner vertices ----------------------------------------------------------------------------------

// Draw candidates evenly by area: keep a direction in proportion to the area stretch of the skull
// there. `fraction` receives the fraction of directions that were kept.
static void draw_candidates(struct build* build, float* fraction)
{
    const float max = HAIR_SKULL_Y * HAIR_SKULL_Z;
    uint32_t seed = hair_hash(build->seed + 17u), tried = 0, kept = 0;
    while (kept < build->candidate_count) {
        float y = 2 * hair_random(&seed) - 1, azimuth = 2 * PI * hair_random(&seed);
        float r = sqrtf(fmaxf(1 - y * y, 0));
        hair_vec3 unit = {r * sinf(azimuth), y, r * cosf(azimuth)};
        hair_vec3 stretch = {HAIR_SKULL_Y * HAIR_SKULL_Z * unit.x, HAIR_SKULL_X * HAIR_SKULL_Z * unit.y,
                             HAIR_SKULL_X * HAIR_SKULL_Y * unit.z};
        ++tried;
        if (hair_random(&seed) * max > hair_length(stretch) || !bears_hair(unit)) continue;
        build->candidates[kept++] = hair_skull_point(unit);
    }
    *fraction = (float)kept / (float)tried;
}

static hair_vec3 vertex_at(const struct build* build, uint32_t i)
{
    return hair_load3(build->scalp.positions + 3 * (size_t)i);
}

// Update the gaps for a new vertex p. Return the candidate with the widest gap.
static uint32_t shrink_gaps(struct build* build, hair_vec3 p)
{
    uint32_t widest = 0;
    for (uint32_t i = 0; i < build->candidate_count; ++i) {
        hair_vec3 d = hair_sub(build->candidates[i], p);
        float square = hair_dot(d, d);
        if (square < build->gap[i]) build->gap[i] = square;
        if (build->gap[i] > build->gap[widest]) widest = i;
    }
    return widest;
}

static void fill_gaps(struct build* build, uint32_t vertex_count)
{
    uint32_t widest = 0;
    for (uint32_t i = 0; i < build->candidate_count; ++i) build->gap[i] = INFINITY;
    for (uint32_t i = 0, j = build->outline_count - 1; i < build->outline_count; j = i++) {
        shrink_gaps(build, vertex_at(build, i));
        widest = shrink_gaps(build, hair_lerp(vertex_at(build, i), vertex_at(build, j), 0.5f));
    }
    while (build->scalp.vertex_count < vertex_count) {
        HAIR_ASSERT(widest < build->candidate_count);
        add_vertex(build, build->candidates[widest]);
        widest = shrink_gaps(build, build->candidates[widest]);
    }
}

// Triangles ---------------------------------------------------------------------------------------

// Project the vertices stereographically from below. This preserves angles and places all of the
// scalp on the near side. The first coordinate is z, so that counter-clockwise in the plane is
// counter-clockwise from outside.
static void project(struct build* build)
{
    for (uint32_t i = 0; i < build->scalp.vertex_count; ++i) {
        hair_vec3 u = hair_skull_unit(hair_load3(build->scalp.positions + 3 * i));
        build->plane[2 * i] = (double)u.z / (1.0 + (double)u.y);
        build->plane[2 * i + 1] = (double)u.x / (1.0 + (double)u.y);
    }
}

static int is_inside_outline(const struct build* build, double x, double y)
{
    int inside = 0;
    for (uint32_t i = 0, j = build->outline_count - 1; i < build->outline_count; j = i++) {
        const double *p = build->plane + 2 * i, *q = build->plane + 2 * j;
        if ((p[1] > y) != (q[1] > y) && x < p[0] + (q[0] - p[0]) * (y - p[1]) / (q[1] - p[1]))
            inside = !inside;
    }
    return inside;
}

static hair_result triangulate_scalp(struct build* build)
{
    uint32_t* triangles = build->scalp.triangles;
    project(build);
    uint32_t count = hair_triangulate(build->host, build->plane, build->scalp.vertex_count, triangles);
    if (!count) return hair_fail_memory(build->host, "the scalp's triangles");

    HAIR_ASSERT(count <= 2 * build->scalp.vertex_count);
    build->scalp.triangle_count = 0;
    for (uint32_t i = 0; i < count; ++i) {
        const double* p = build->plane + 2 * (size_t)triangles[3 * i];
        const double* q = build->plane + 2 * (size_t)triangles[3 * i + 1];
        const double* r = build->plane + 2 * (size_t)triangles[3 * i + 2];
        if (is_inside_outline(build, (p[0] + q[0] + r[0]) / 3, (p[1] + q[1] + r[1]) / 3))
            memmove(triangles + 3 * build->scalp.triangle_count++, triangles + 3 * i, 3 * sizeof *triangles);
    }
    return HAIR_OK;
}

static hair_vec3 keep_away(hair_vec3 p, hair_vec3 from, float distance)
{
    if (hair_distance(p, from) >= distance) return p;
    hair_vec3 away = hair_normalize(hair_sub(p, from), hair_v3(0, 1, 0));
    return hair_add(from, hair_scale(away, distance));
}

// Move p out of the circles around the edges of the outline and around their ends. An edge of the
// outline is in the triangulation if no vertex lies in the circle around it.
static hair_vec3 clear_outline(const struct build* build, hair_vec3 p)
{
    for (uint32_t i = 0, j = build->outline_count - 1; i < build->outline_count; j = i++) {
        hair_vec3 a = vertex_at(build, i), b = vertex_at(build, j);
        float length = hair_distance(a, b);
        p = keep_away(p, a, CLEARANCE * length);
        p = keep_away(p, hair_lerp(a, b, 0.5f), CLEARANCE * length);
    }
    return hair_skull_point(hair_skull_unit(p));
}

static void relax(struct build* build)
{
    memset(build->sum, 0, build->scalp.vertex_count * sizeof *build->sum);
    memset(build->area, 0, build->scalp.vertex_count * sizeof *build->area);
    for (uint32_t i = 0; i < build->scalp.triangle_count; ++i) {
        const uint32_t* corner = build->scalp.triangles + 3 * i;
        hair_vec3 a = hair_load3(build->scalp.positions + 3 * corner[0]);
        hair_vec3 b = hair_load3(build->scalp.positions + 3 * corner[1]);
        hair_vec3 c = hair_load3(build->scalp.positions + 3 * corner[2]);
        float area = hair_length(hair_cross(hair_sub(b, a), hair_sub(c, a)));
        hair_vec3 middle = hair_scale(hair_add(a, hair_add(b, c)), area / 3);
        for (int k = 0; k < 3; ++k) {
            HAIR_ASSERT(corner[k] < build->scalp.vertex_count);
            build->sum[corner[k]] = hair_add(build->sum[corner[k]], middle);
            build->area[corner[k]] += area;
        }
    }
    for (uint32_t i = build->outline_count; i < build->scalp.vertex_count; ++i)
        if (build->area[i] > 0)
            hair_store3(build->scalp.positions + 3 * i,
                        clear_outline(build, hair_scale(build->sum[i], 1 / build->area[i])));
}

// Whole -------------------------------------------------------------------------------------------

// Choose the spacing. In a hexagonal lattice a vertex covers sqrt(3)/2 spacing^2. A vertex on the
// outline covers half of that.
static void choose_spacing(struct build* build, float area, uint32_t vertex_count)
{
    build->spacing = sqrtf(area * 1.1547f / (float)vertex_count);
    for (int i = 0; i < 8; ++i) {
        build->scalp.vertex_count = 0;
        add_outline(build);
        float inner =
            fmaxf((float)vertex_count - 0.5f * (float)build->outline_count, 0.3f * (float)vertex_count);
        build->spacing = sqrtf(area * 1.1547f / inner);
    }
    build->scalp.vertex_count = 0;
    add_outline(build);
}

static hair_result fill_scalp(struct build* build, uint32_t vertex_count)
{
    float fraction;
    draw_candidates(build, &fraction);
    // The area is the kept fraction of a sphere of directions, stretched everywhere as much as at
    // the maximum.
    float area = fraction * 4 * PI * HAIR_SKULL_Y * HAIR_SKULL_Z;
    choose_spacing(build, area, vertex_count);
    fill_gaps(build, vertex_count);
    HAIR_TRY(triangulate_scalp(build));
    for (int i = 0; i < RELAXATIONS; ++i) {
        relax(build);
        HAIR_TRY(triangulate_scalp(build));
    }
    return HAIR_OK;
}

// Move vertices outwards until the centroids of triangles lie on the skull. Triangles are flat and
// the skull is round, so roots would lie under the skin otherwise.
static void lift(struct build* build)
{
    const float radius = 0.088f; // approximate radius of the skull, m
    float by = build->spacing * build->spacing / (6 * radius);
    for (uint32_t i = 0; i < build->scalp.vertex_count; ++i) {
        hair_vec3 p = vertex_at(build, i);
        hair_store3(build->scalp.positions + 3 * (size_t)i,
                    hair_add(p, hair_scale(hair_skull_normal(p), by)));
    }
}

hair_result hair_scalp_build(const hair_host* host, uint32_t vertex_count, struct hair_parting parting,
                             uint32_t seed, struct hair_scalp* out)
{
    HAIR_ASSERT(vertex_count >= 16);
    struct build build = {.host = host, .parting = parting, .seed = seed};
    size_t max = (size_t)vertex_count + 64; // The minimum outline may have more vertices.
    build.candidate_count = CANDIDATES * vertex_count + 2048;
    build.scalp.positions = hair_alloc(host, max, 3 * sizeof(float));
    build.scalp.triangles = hair_alloc(host, 2 * max, 3 * sizeof(uint32_t));
    build.candidates = hair_alloc(host, build.candidate_count, sizeof(hair_vec3));
    build.gap = hair_alloc(host, build.candidate_count, sizeof(float));
    build.sum = hair_alloc(host, max, sizeof(hair_vec3));
    build.area = hair_alloc(host, max, sizeof(float));
    build.plane = hair_alloc(host, 2 * max, sizeof(double));

    hair_result result = HAIR_OK;
    if (!build.scalp.positions || !build.scalp.triangles || !build.candidates || !build.gap || !build.sum ||
        !build.area || !build.plane)
        result = hair_fail_memory(host, "the scalp");
    else
        result = fill_scalp(&build, vertex_count);
    HAIR_ASSERT(build.scalp.vertex_count <= max);
    if (!result) lift(&build);

    hair_free(host, build.plane);
    hair_free(host, build.area);
    hair_free(host, build.sum);
    hair_free(host, build.gap);
    hair_free(host, build.candidates);
    if (result)
        hair_scalp_free(host, &build.scalp);
    else
        *out = build.scalp;
    return result;
}

void hair_scalp_free(const hair_host* host, struct hair_scalp* scalp)
{
    hair_free(host, scalp->triangles);
    hair_free(host, scalp->positions);
}
