// self_shadow_test.c - light that hair lets through to itself. The grid holds all hair, and light
// agrees with a reference in double precision. A shadow map shadows what lies behind it, and no
// strand by itself. Without self shadows, nothing runs or uses memory.
#include "tests/support/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/base/math.h"
#include "tests/reference/self_shadow.h"

#define SIZE 64
#define SEGMENTS 8
#define FOLLOWERS 100
#define VERTICES (FOLLOWERS * (SEGMENTS + 1))
#define LIGHTS 2
#define EACH (LIGHTS + 1)
#define WORDS HAIR_NODE_WORDS(EACH) // Words of a node.

struct fixture {
    struct hair_test_scene scene;
    hair_light light[LIGHTS];
    GLuint map;
    // The GPU's data, in the head's frame.
    struct hair_reference_grid grid;
    double *density, *met; // Per node. The last arrays are for the sky and for each light.
    hair_vec4* position; // Per vertex.
    uint32_t numbers[VERTICES * EACH];
};

static const float turned[16] = {0.6f, 0, -0.8f, 0, 0, 1, 0, 0, 0.8f, 0, 0.6f, 0, 0.1f, 0.2f, -0.3f, 1};

static struct fixture start(void** state, uint32_t followers)
{
    struct fixture f = {0};
    struct hair_test_handmade wanted = hair_test_handmade_default();
    hair_look look = hair_look_default();
    wanted.followers = followers;
    wanted.density = 1;
    look.strand.segments = SEGMENTS, look.strand.radius = 0.001f, look.self_shadow.cell = 0.012f;
    look.self_shadow.method = HAIR_SELF_SHADOW_STRANDS;
    f.scene = hair_test_scene_of(*state, &wanted, &look);
    hair_test_ok(f.scene.test, hair_teleport(f.scene.hair, turned));
    hair_test_ok(f.scene.test, hair_step(f.scene.hair, 0));
    hair_test_frame_make(&f.scene.frame, SIZE, SIZE, GL_RGBA32F, 0);
    hair_test_set_orthographic(&f.scene.view, 1 / 0.6f, -0.5f, 0);
    for (int i = 0; i < LIGHTS; ++i) f.light[i] = hair_light_default();
    f.light[1].kind = HAIR_LIGHT_POINT;
    f.light[1].position[0] = 0.3f, f.light[1].position[2] = -0.3f;
    f.scene.view.light_count = LIGHTS;
    return f;
}

static void finish(struct fixture* f)
{
    if (f->map) glDeleteTextures(1, &f->map);
    free(f->density);
    free(f->met);
    free(f->position);
    hair_test_scene_free(&f->scene);
}

static void draw(struct fixture* f)
{
    f->scene.view.lights = f->light;
    hair_test_ok(f->scene.test, hair_draw(f->scene.hair, &f->scene.view));
    glFinish();
}

static float from_float_key(uint32_t u)
{
    uint32_t bits = u & 0x80000000u ? u & 0x7fffffffu : ~u;
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static double half_of(uint32_t h)
{
    uint32_t exponent = h >> 10 & 31, fraction = h & 1023;
    assert_true(exponent < 31); // The number is finite.
    return exponent ? ldexp(1024 + fraction, (int)exponent - 25) : ldexp(fraction, -24);
}

// Convert a position to the head's frame, by the transpose of `turned`.
static void into_head(const float* p, double out[3])
{
    for (int i = 0; i < 3; ++i) {
        out[i] = 0;
        for (int k = 0; k < 3; ++k) out[i] += (double)turned[4 * i + k] * (double)p[k];
    }
}

// Return a value of a node: the visible fraction of the sky, or the strands met towards a light.
static double value_of(const uint32_t* words, uint32_t value)
{
    float met;
    if (value < 2) return half_of(words[0] >> 16 * value & 0xffff);
    memcpy(&met, &words[value - 1], sizeof met);
    return (double)met;
}

static void look_inside(struct fixture* f)
{
    const struct hair_self_shadow_state* own = &f->scene.hair->lighting.self_shadow;
    const struct hair_geometry* geometry = &f->scene.hair->geometry;
    uint32_t box[HAIR_DENSITY_FIRST];
    size_t nodes = 1;
    glGetNamedBufferSubData(own->density, 0, sizeof box, box);
    f->grid.cell = (double)geometry->look.self_shadow.cell;
    for (int i = 0; i < 3; ++i) {
        double low = (double)from_float_key(box[i]), high = (double)from_float_key(~box[3 + i]);
        f->grid.lower[i] = f->grid.cell * floor(low / f->grid.cell);
        f->grid.nodes[i] = (uint32_t)(floor(high / f->grid.cell) - floor(low / f->grid.cell) + 2);
        nodes *= f->grid.nodes[i];
    }
    uint32_t* sums = malloc(nodes * sizeof *sums);
    uint32_t* light = malloc(nodes * WORDS * sizeof *light);
    f->density = calloc(nodes, sizeof *f->density);
    f->met = calloc(nodes * EACH, sizeof *f->met);
    f->position = malloc(VERTICES * sizeof *f->position);
    glGetNamedBufferSubData(own->density, sizeof box, (GLsizeiptr)(nodes * sizeof *sums), sums);
    glGetNamedBufferSubData(own->nodes, 0, (GLsizeiptr)(nodes * WORDS * sizeof *light), light);
    glGetNamedBufferSubData(own->light, 0, sizeof f->numbers, f->numbers);
    glGetNamedBufferSubData(geometry->vertex_cache.position, 0, VERTICES * sizeof *f->position, f->position);
    for (size_t n = 0; n < nodes; ++n) f->density[n] = sums[n] / HAIR_DENSITY_UNITS;
    for (size_t n = 0; n < nodes; ++n)
        for (uint32_t i = 0; i < EACH && sums[n]; ++i) f->met[i * nodes + n] = value_of(light + WORDS * n, i);
    f->grid.density = f->density;
    free(sums);
    free(light);
}

static size_t node_count(const struct fixture* f)
{
    return (size_t)f->grid.nodes[0] * f->grid.nodes[1] * f->grid.nodes[2];
}

static void density_grid_holds_the_area_of_all_strands(void** state)
{
    struct fixture f = start(state, FOLLOWERS);
    draw(&f);
    look_inside(&f);
    double *twin = calloc(node_count(&f), sizeof *twin), sum = 0, area = 0;
    for (int v = 0; v < VERTICES; ++v) {
        const hair_vec4 *p = &f.position[v], *q = p + 1;
        double a[3], b[3];
        if (v % (SEGMENTS + 1) == SEGMENTS) continue;
        into_head(&p->x, a);
        into_head(&q->x, b);
        double width = (double)p->w + (double)q->w;
        area += sqrt(pow(b[0] - a[0], 2) + pow(b[1] - a[1], 2) + pow(b[2] - a[2], 2)) * width;
        hair_reference_fill(&f.grid, a, b, width, twin);
    }
    // Rounding moves positions by 1e-7 m of a cell of 12 mm. Each of about 30 additions rounds to
    // half a unit.
    for (size_t n = 0; n < node_count(&f); ++n) {
        hair_test_near("density", n, f.density[n], twin[n], 1e-4 * (twin[n] + 1) + 30 / HAIR_DENSITY_UNITS);
        sum += f.density[n] * f.grid.cell * f.grid.cell;
    }
    print_message("    %zu nodes, %g m^2\n", node_count(&f), area);
    hair_test_near("area", 0, sum, area, 0.001 * area);
    free(twin);
    finish(&f);
}

static void transmittance_equals_the_reference(void** state)
{
    struct fixture f = start(state, FOLLOWERS);
    draw(&f);
    look_inside(&f);
    size_t nodes = node_count(&f);
    uint32_t held = 0;
    double max = 0, to[3], lamp[3], from_origin[3];
    double l = sqrt(0.4 * 0.4 + 0.8 * 0.8 + 0.45 * 0.45);
    into_head((float[]){(float)(0.4 / l), (float)(0.8 / l), (float)(0.45 / l)}, to);
    for (int i = 0; i < 3; ++i) from_origin[i] = (double)f.light[1].position[i] - (double)turned[12 + i];
    into_head((float[]){(float)from_origin[0], (float)from_origin[1], (float)from_origin[2]}, lamp);
    for (size_t n = 0; n < nodes; ++n) {
        double at[3], way[3], reach = 0;
        if (f.density[n] <= 0) continue;
        ++held;
        for (int i = 0; i < 3; ++i) {
            size_t k = i == 0   ? n % f.grid.nodes[0]
                       : i == 1 ? n / f.grid.nodes[0] % f.grid.nodes[1]
                                : n / f.grid.nodes[0] / f.grid.nodes[1];
            at[i] = f.grid.lower[i] + f.grid.cell * (double)k;
            way[i] = lamp[i] - at[i];
            reach += way[i] * way[i];
        }
        reach = sqrt(reach);
        for (int i = 0; i < 3; ++i) way[i] /= reach;
        double sky = hair_reference_sky(&f.grid, at), met = hair_reference_met(&f.grid, at, to, 1e9, NULL);
        max = fmax(max, met);
        // Rounding decides whether the last step is within the grid, or nearer than the lamp.
        hair_test_near("sky", n, f.met[n], sky, 1e-3);
        hair_test_near("met", n, f.met[nodes + n], met, 1e-3 * (1 + met));
        hair_test_near("met before the lamp", n, f.met[2 * nodes + n],
                       hair_reference_met(&f.grid, at, way, reach, NULL), 0.02);
    }
    print_message("    %u nodes with hair, at most %g met\n", held, max);
    assert_true(held > 100 && max > 0.5);
    for (int v = 0; v < VERTICES; ++v) {
        double at[3], before[3], after[3], along = 0, length = 0;
        int k = v % (SEGMENTS + 1);
        const float* p = &f.position[v].x;
        into_head(p, at);
        into_head(k > 0 ? p - 4 : p, before);
        into_head(k < SEGMENTS ? p + 4 : p, after);
        for (int i = 0; i < 3; ++i)
            along += (after[i] - before[i]) * to[i], length += pow(after[i] - before[i], 2);
        double met = hair_reference_met(&f.grid, at, to, 1e9, f.met + nodes) *
                     sqrt(fmax(1 - along * along / length, 0));
        double sky = hair_reference_around(&f.grid, at, f.met);
        // Half floats have 11 bits.
        hair_test_near("sky at vertex", (size_t)v, half_of(f.numbers[v * EACH] & 0xffff), sky, 0.002);
        hair_test_near("met at vertex", (size_t)v, half_of(f.numbers[v * EACH + 1] >> 16), met,
                       0.002 * (1 + met));
        hair_test_near("open at vertex", (size_t)v, half_of(f.numbers[v * EACH + 1] & 0xffff), exp(-met),
                       0.003);
    }
    finish(&f);
}

// Make a light with a map that looks straight down -z, 1.2 m wide like the picture.
static void light_with_map(struct fixture* f, float depth)
{
    f->light[0].direction[0] = f->light[0].direction[1] = 0, f->light[0].direction[2] = 1;
    f->light[0].shadow_matrix[0] = f->light[0].shadow_matrix[5] = 1 / 0.6f;
    f->light[0].shadow_matrix[10] = -0.5f;
    if (!f->map) {
        glCreateTextures(GL_TEXTURE_2D, 1, &f->map);
        glTextureStorage2D(f->map, 1, GL_DEPTH_COMPONENT32F, 1024, 1024);
    }
    glClearTexImage(f->map, 0, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
    f->light[0].hair_shadow_map = f->map;
}

static double open_on_average(struct fixture* f, uint32_t vertices)
{
    uint32_t* numbers = malloc(vertices * EACH * sizeof *numbers);
    double sum = 0;
    glGetNamedBufferSubData(f->scene.hair->lighting.self_shadow.light, 0,
                            (GLsizeiptr)(vertices * EACH * sizeof *numbers), numbers);
    for (uint32_t v = 0; v < vertices; ++v) sum += half_of(numbers[v * EACH + 1] & 0xffff);
    free(numbers);
    return sum / vertices;
}

static void opaque_shadow_map_darkens_hair_behind_it(void** state)
{
    struct fixture f = start(state, FOLLOWERS);
    light_with_map(&f, 1);
    draw(&f);
    hair_test_near("before it", 0, open_on_average(&f, VERTICES), 1, 0);
    light_with_map(&f, 0);
    draw(&f);
    hair_test_near("behind it", 0, open_on_average(&f, VERTICES), 0, 0);
    finish(&f);
}

static hair_report_row row_of(const struct fixture* f, const char* work)
{
    return hair_test_report_row(f->scene.test, f->scene.hair, work);
}

// Check a collider within the hair. Its shadow does not depend on what becomes of followers in it.
static void colliders_darken_hair_that_passes_through_them(void** state)
{
    struct fixture f = start(state, FOLLOWERS);
    hair_look look = f.scene.hair->geometry.look;
    hair_collider ball = hair_collider_default();
    look.followers.collision = HAIR_FOLLOWER_COLLISION_NONE;
    hair_test_ok(f.scene.test, hair_set_look(f.scene.hair, &look));
    hair_test_ok(f.scene.test, hair_step(f.scene.hair, 1.0f / 60));
    draw(&f);
    double without = open_on_average(&f, VERTICES);
    for (int k = 0; k < 3; ++k) ball.position[k] = turned[12 + k];
    ball.size[0] = 0.09f;
    hair_test_ok(f.scene.test, hair_set_colliders(f.scene.hair, &ball, 1, sizeof ball));
    draw(&f);
    double with = open_on_average(&f, VERTICES);
    print_message("    %g of the light without, %g with the collider\n", without, with);
    assert_true(with < 0.95 * without);
    assert_int_equal(row_of(&f, "hit").runs, 0);
    assert_int_equal(row_of(&f, "hit").skip_reason, HAIR_SKIP_REASON_NOT_WANTED);
    finish(&f);
}

static void strand_does_not_shade_itself(void** state)
{
    struct fixture f = start(state, 1);
    GLuint frame;
    light_with_map(&f, 1);
    glCreateFramebuffers(1, &frame);
    glNamedFramebufferTexture(frame, GL_DEPTH_ATTACHMENT, f.map, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, frame);
    glViewport(0, 0, 1024, 1024);
    glEnable(GL_DEPTH_TEST);
    f.scene.view.pass = HAIR_PASS_DEPTH;
    memcpy(f.scene.view.projection, f.light[0].shadow_matrix, sizeof f.scene.view.projection);
    draw(&f);
    glDeleteFramebuffers(1, &frame);
    glBindFramebuffer(GL_FRAMEBUFFER, f.scene.frame.framebuffer);
    glDisable(GL_DEPTH_TEST);
    f.scene.view.pass = HAIR_PASS_COLOR;
    draw(&f);
    double open = open_on_average(&f, SEGMENTS + 1);
    print_message("    %g\n", open);
    assert_true(open > 0.97);
    finish(&f);
}

static void self_shadow_is_shared_by_views_and_absent_when_off(void** state)
{
    struct fixture f = start(state, FOLLOWERS);
    hair_look look = f.scene.hair->geometry.look;
    f.scene.view.frame_index = 7;
    hair_test_ok(f.scene.test, hair_step(f.scene.hair, 1.0f / 60));
    draw(&f);
    draw(&f);
    assert_int_equal(row_of(&f, "self_shadow").runs, 5);
    assert_true(row_of(&f, "self_shadow").bytes > 0);
    f.light[1].position[1] = 1;
    draw(&f);
    assert_int_equal(row_of(&f, "self_shadow").runs, 7); // The grid does not change.
    look.self_shadow.method = HAIR_SELF_SHADOW_DEPTH;
    hair_test_ok(f.scene.test, hair_set_look(f.scene.hair, &look));
    hair_test_ok(f.scene.test, hair_step(f.scene.hair, 1.0f / 60));
    draw(&f);
    assert_int_equal(row_of(&f, "self_shadow").runs, 0);
    assert_int_equal(row_of(&f, "self_shadow").skip_reason, HAIR_SKIP_REASON_NOT_WANTED);
    assert_int_equal(row_of(&f, "self_shadow").bytes, 0);
    finish(&f);
}

// Check a quarter of the strands. Only these are lit, and the grid holds the same area of hair,
// because strands are wider.
static void self_shadow_lights_only_strands_of_the_level_of_detail(void** state)
{
    static const uint32_t none = 0xffffffffu;
    struct fixture f = start(state, FOLLOWERS);
    hair_lod lod = hair_lod_default();
    double area[2] = {0};
    uint32_t lit = 0;
    lod.per_patch = false;
    lod.strand_fraction = 0.25f;
    lod.light_pixels = 0;
    for (int i = 0; i < 2; ++i) {
        f.scene.view.lod = i ? &lod : NULL;
        hair_test_ok(f.scene.test, hair_step(f.scene.hair, 0.01f));
        if (i)
            glClearNamedBufferData(f.scene.hair->lighting.self_shadow.light, GL_R32UI, GL_RED_INTEGER,
                                   GL_UNSIGNED_INT, &none);
        draw(&f);
        look_inside(&f);
        for (size_t n = 0; n < node_count(&f); ++n) area[i] += f.density[n] * f.grid.cell * f.grid.cell;
        if (i) break;
        free(f.density);
        free(f.met);
        free(f.position);
    }
    for (uint32_t p = 0; p < f.scene.groom->info.patch_count; ++p) {
        const struct hair_patch* patch = &f.scene.groom->patches[p];
        uint32_t drawn = 1 + (uint32_t)(0.25 * patch->count); // The next strand may be fading in.
        for (uint32_t s = 0; s < patch->count; ++s)
            for (uint32_t k = 0; k < (SEGMENTS + 1) * EACH; ++k) {
                int is = f.numbers[(patch->first + s) * (SEGMENTS + 1) * EACH + k] != none;
                assert_int_equal(is, s < drawn);
                lit += (uint32_t)is;
            }
    }
    print_message("    %u of %u lit, %.3f of the hair\n", lit / EACH, VERTICES, area[1] / area[0]);
    hair_test_near("area", 0, area[1] / area[0], 1, 0.1);
    finish(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(density_grid_holds_the_area_of_all_strands),
        HAIR_TEST(transmittance_equals_the_reference),
        HAIR_TEST(opaque_shadow_map_darkens_hair_behind_it),
        HAIR_TEST(colliders_darken_hair_that_passes_through_them),
        HAIR_TEST(strand_does_not_shade_itself),
        HAIR_TEST(self_shadow_lights_only_strands_of_the_level_of_detail),
        HAIR_TEST(self_shadow_is_shared_by_views_and_absent_when_off),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
