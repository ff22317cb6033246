// scatter.c - Rows of the suite `shadow`. They compare the multiple scattering of drawn hair with
// path tracing. Only means over the visible part of a haircut are compared.
#include "lib/light/fibre.h"
#include "tests/reference/paths.h"
#include "tools/bench/picture.h"
#include "tools/bench/scatter.h"
#include "tools/bench/studio.h"
#include "tools/common/camera.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SIZE 128
#define STRANDS 6000
#define SEGMENTS 24
#define RAYS 100000
#define RAYS_OF_QUICK 20000
#define REFRACTION 1.55f // as in lib/light/fibres.c

static const struct color {
    const char* name;
    hair_color color;
} colors[] = {{"blond", HAIR_COLOR_BLOND}, {"brown", HAIR_COLOR_BROWN}, {"black", HAIR_COLOR_BLACK}};

// Direction to the light in camera space, right, up and out of the picture.
static const struct lit {
    const char* name;
    float way[3];
} lits[] = {{"front", {0.2f, 0.4f, 0.9f}}, {"side", {0.95f, 0.3f, 0}}, {"back", {0.2f, 0.4f, -0.9f}}};

static const struct method {
    const char* name;
    hair_self_shadow shadow;
} methods[] = {{"strands", HAIR_SELF_SHADOW_STRANDS}, {"depth", HAIR_SELF_SHADOW_DEPTH}};

#define COLORS (sizeof colors / sizeof *colors)
#define LITS (sizeof lits / sizeof *lits)
#define METHODS (sizeof methods / sizeof *methods)

struct scatter {
    struct bench* bench;
    struct bench_studio studio;
    struct bench_shot shot;
    float colors[COLORS][3];
    double to_light[LITS][3];
    double* from; // origins of rays
    double* way;
    struct hair_reference_glow glow;
    // `dark` is the picture without light, `covers` the area of hair in pixels, 0 until measured.
    double dark[3], covers;
};

static bool make(struct scatter* scatter)
{
    struct bench_studio* studio = &scatter->studio;
    uint32_t strands = scatter->bench->options.strands, size = scatter->bench->options.size;
    struct bench_studio_desc desc = {
        .scene = "still", .size = size ? size : SIZE, .followers = strands ? strands : STRANDS};
    if (!bench_studio_make(scatter->bench, &desc, studio)) return false;
    hair_set_colliders(studio->hair, NULL, 0, 0); // Paths hit no colliders.
    studio->bare = true;
    scatter->shot = bench_studio_shot(studio);
    hair_look* look = &scatter->shot.look;
    look->strand.taper = hair_curve_line(1, 1);
    look->strand.segments = SEGMENTS;
    look->strand.radius = look->strand.radius * studio->fewer; // Keep the total amount of hair.
    look->shading.cuticle_tilt_spread = 0;
    scatter->shot.samples = 4;
    scatter->shot.supersample = 2;
    memset(scatter->shot.view.ambient, 0, sizeof scatter->shot.view.ambient);
    for (size_t i = 0; i < COLORS; ++i) {
        if (hair_look_color(look, colors[i].color)) return false;
        memcpy(scatter->colors[i], look->color.tip, sizeof look->color.tip);
    }
    look->color.spread = 0;
    return true;
}

// Paths -------------------------------------------------------------------------------------------

// Make rays through random places of the picture.
static bool make_rays(struct scatter* scatter, uint32_t rays)
{
    const struct hair_scene* scene = &scatter->studio.scene;
    struct hair_matrices camera;
    uint64_t random = 1;
    scatter->from = malloc(3 * sizeof *scatter->from * rays);
    scatter->way = malloc(3 * sizeof *scatter->way * rays);
    if (!scatter->from || !scatter->way) return false;
    hair_camera_matrices(scene, scatter->studio.transform, scatter->studio.reach, &camera);
    for (uint32_t i = 0; i < rays; ++i) {
        double in[3] = {0, 0, -1}, length = 0, *way = scatter->way + 3 * (size_t)i;
        for (int k = 0; k < 2; ++k) {
            random = random * 6364136223846793005u + 1442695040888963407u;
            in[k] = (2 * (double)(random >> 11) / 9007199254740992.0 - 1) / (double)camera.projection[5 * k];
        }
        for (int k = 0; k < 3; ++k) {
            way[k] = 0;
            for (int j = 0; j < 3; ++j) way[k] += (double)camera.view[4 * k + j] * in[j];
            length += way[k] * way[k];
        }
        for (int k = 0; k < 3; ++k) {
            way[k] /= sqrt(length);
            scatter->from[3 * (size_t)i + (size_t)k] = (double)scene->eye[k];
        }
    }
    for (size_t l = 0; l < LITS; ++l) {
        double length = 0, *to = scatter->to_light[l];
        for (int k = 0; k < 3; ++k) {
            to[k] = 0;
            for (int j = 0; j < 3; ++j) to[k] += (double)camera.view[4 * k + j] * (double)lits[l].way[j];
            length += to[k] * to[k];
        }
        for (int k = 0; k < 3; ++k) to[k] /= sqrt(length);
    }
    return true;
}

// Return the absorption of a strand with the given reflectance, as absorption_of() in
// glsl/light/fibre.glsl.
static double absorption_of(double reflectance, double roughness)
{
    double b = roughness, d = 5.969 + b * (-0.215 + b * (2.532 + b * (-10.73 + b * (5.574 + 0.245 * b))));
    double l = log(reflectance) / d;
    return l * l;
}

static bool trace(struct scatter* scatter)
{
    static hair_fibre_table table;
    const hair_look* look = &scatter->shot.look;
    struct hair_fibre of = {look->shading.roughness[1], look->shading.roughness[0], REFRACTION,
                            look->flatness};
    uint32_t rays = scatter->bench->options.quick ? RAYS_OF_QUICK : RAYS;
    uint32_t count = scatter->studio.info.follower_count * (SEGMENTS + 1), there = 0;
    float *positions = malloc(3 * sizeof *positions * count), variance[3];
    double mu[3 * COLORS];
    hair_fibre_fill(&of, table);
    hair_fibre_variances(of.along, variance);
    for (size_t i = 0; i < 3 * COLORS; ++i)
        mu[i] = absorption_of((double)scatter->colors[i / 3][i % 3], (double)look->shading.roughness[1]);
    bool ok = positions && make_rays(scatter, rays) && bench_studio_set(&scatter->studio, &scatter->shot) &&
              !hair_read_positions(scatter->studio.hair, HAIR_READ_FOLLOWERS, positions, count, &there) &&
              there == count;
    struct hair_reference_hair hair = {
        .positions = positions,
        .count = scatter->studio.info.follower_count,
        .each = SEGMENTS + 1,
        .radius = (double)look->strand.radius,
        .fibre = {&table[0][0][0], (double)variance[0], (double)look->shading.cuticle_tilt},
        .mu = mu,
        .colors = 3 * COLORS,
        .to_light = scatter->to_light[0],
        .lights = LITS};
    if (ok) hair_reference_paths(&hair, scatter->from, scatter->way, rays, 1, &scatter->glow);
    free(positions);
    return ok && scatter->glow.met > 0;
}

// Pictures ----------------------------------------------------------------------------------------

// Compute the summed radiance of all visible hair, and the area of hair in pixels.
static bool take(struct scatter* scatter, double sum[3], double* covers)
{
    struct bench_picture picture;
    size_t pixels = (size_t)scatter->studio.size * scatter->studio.size;
    bool ok = bench_picture_make(scatter->studio.size, &picture) &&
              bench_studio_set(&scatter->studio, &scatter->shot) &&
              bench_studio_draw(&scatter->studio, NULL) && bench_studio_add(&scatter->studio, picture.rgba);
    sum[0] = sum[1] = sum[2] = *covers = 0;
    for (size_t i = 0; i < pixels && ok; ++i) {
        for (size_t k = 0; k < 3; ++k) sum[k] += picture.rgba[4 * i + k];
        *covers += picture.rgba[4 * i + 3];
    }
    bench_picture_free(&picture);
    return ok;
}

// Compute the mean radiance of hair. The picture without light is subtracted, because it contains
// the background.
static bool measure_light(struct scatter* scatter, float scattering, double mean[3])
{
    hair_light* light = &scatter->studio.scene.settings.light;
    double covers;
    for (int k = 0; k < 3; ++k) light->color[k] = 0;
    if (scatter->covers <= 0 && !take(scatter, scatter->dark, &scatter->covers)) return false;
    for (int k = 0; k < 3; ++k) light->color[k] = 1;
    scatter->shot.look.shading.scattering = scattering;
    if (!take(scatter, mean, &covers)) return false;
    for (int k = 0; k < 3; ++k) mean[k] = (mean[k] - scatter->dark[k]) / covers;
    return true;
}

static bool compare(struct scatter* scatter, const struct method* method, const struct color* color,
                    const struct lit* lit)
{
    static const char* const keys[] = {"bias_red", "bias_green", "bias_blue"};
    hair_look* look = &scatter->shot.look;
    hair_light* light = &scatter->studio.scene.settings.light;
    size_t of = 3 * (size_t)(color - colors), from = (size_t)(lit - lits);
    double all[3], once[3], ground_truth[3], alone[3], error = 0;
    look->self_shadow.method = method->shadow;
    memcpy(look->color.root, scatter->colors[of / 3], sizeof look->color.root);
    memcpy(look->color.tip, scatter->colors[of / 3], sizeof look->color.tip);
    for (int k = 0; k < 3; ++k) light->direction[k] = (float)scatter->to_light[from][k];
    if (!measure_light(scatter, 1, all) || !measure_light(scatter, 0, once)) return false;
    for (size_t k = 0; k < 3; ++k) {
        ground_truth[k] = scatter->glow.often[from][of + k];
        alone[k] = scatter->glow.once[from][of + k];
        error += scatter->glow.error[from][of + k];
    }
    double sum = ground_truth[0] + ground_truth[1] + ground_truth[2];
    json_t* row = bench_rows_add(&scatter->bench->rows);
    bench_set_text(row, "case", "scatter");
    bench_set_text(row, "method", method->name);
    bench_set_text(row, "color", color->name);
    bench_set_text(row, "lit", lit->name);
    bench_set_count(row, "strands", scatter->studio.info.follower_count);
    bench_set_count(row, "size", scatter->studio.size);
    bench_set_count(row, "rays", scatter->glow.met);
    bench_set_number(row, "radiance", sum / 3);
    bench_set_number(row, "error", error / sum);
    bench_set_number(row, "often", 1 - (alone[0] + alone[1] + alone[2]) / sum);
    bench_set_number(row, "bias", (all[0] + all[1] + all[2]) / sum - 1);
    for (size_t k = 0; k < 3; ++k) bench_set_number(row, keys[k], all[k] / ground_truth[k] - 1);
    bench_set_number(row, "bias_once", (once[0] + once[1] + once[2]) / (alone[0] + alone[1] + alone[2]) - 1);
    return true;
}

void bench_measure_scatter(struct bench* bench)
{
    struct scatter scatter = {.bench = bench};
    bool alive = false, tried = false;
    for (size_t m = 0; m < METHODS; ++m)
        for (size_t c = 0; c < COLORS; ++c)
            for (size_t l = 0; l < LITS; ++l) {
                if (!bench_begin(bench, "scatter", methods[m].name)) continue;
                if (!tried) alive = make(&scatter) && trace(&scatter);
                tried = true;
                if (!alive || !compare(&scatter, &methods[m], &colors[c], &lits[l]))
                    bench_refuse(bench, "scatter", methods[m].name);
            }
    free(scatter.from);
    free(scatter.way);
    if (scatter.studio.hair) bench_studio_free(&scatter.studio);
}
