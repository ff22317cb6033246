// rods_sag_test.c - equilibria of guides under gravity: in their groom, or as far from it as
// reported.
#include "tests/support/support.h"

#include <hair/hair_asset.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "lib/groom/groom.h"
#include "lib/sim/pins.h"
#include "tests/support/rod_statics.h"
#include "tests/support/rods.h"

#define PI 3.141592653589793
#define MAX HAIR_MAX_GUIDE_VERTICES

struct rested {
    double left; // Remaining torque, relative.
    double away; // Distance from the groom, in metres.
    int stable; // Stability under the actual gravity.
    double length;
};

// Release a guide from its groom, with the rest strain and stiffness of the solvers.
static struct rested rest_of(const struct hair_guide* guide, const struct hair_rest* rest,
                             const hair_physics* physics, const struct hair_rod_borne* borne,
                             const struct hair_rod* rod)
{
    struct hair_rod_shape shape;
    struct hair_rod_pose* pose = malloc(sizeof *pose);
    hair_rod_rest at_rest[MAX];
    struct rested r = {.length = (double)guide->arc_length};
    hair_rod_shape_of(guide, rest, physics, &shape);
    hair_rod_bear(&shape, borne);
    hair_rod_pose_at(&shape, shape.frame, pose);
    for (uint32_t i = 0; i < guide->count; ++i) {
        hair_vec4 u = rod[i].strain;
        at_rest[i] = (hair_rod_rest){(double)u.x, (double)u.y, (double)u.z, shape.rest_real[i]};
        hair_test_near("stiffness", i, hair_rod_stiffness(&shape, i), (double)rod[i].strain.w,
                       1e-6 * (double)rod[i].strain.w);
    }
    r.left = hair_rod_settle(&shape, at_rest, 1, 500, pose);
    r.stable = hair_rod_is_stable(&shape, pose, 0);
    for (uint32_t i = 0; i < guide->count; ++i)
        r.away = fmax(r.away, hair_dlength(hair_dadd(pose->place[i], hair_dscale(shape.place[i], -1))));
    free(pose);
    return r;
}

static hair_groom* haircut(hair_style style, uint32_t vertices)
{
    hair_style_desc of = hair_style_desc_default();
    hair_groom_desc desc = hair_groom_desc_default();
    hair_asset* asset = NULL;
    hair_groom* groom = NULL;
    of.style = style;
    of.strand_vertices = vertices;
    assert_int_equal(hair_asset_generate(&of, &asset), HAIR_OK);
    assert_int_equal(hair_asset_to_groom_desc(asset, &desc), HAIR_OK);
    desc.follower_count = 0;
    desc.guide_vertices = vertices;
    assert_int_equal(hair_groom_create(&desc, &groom), HAIR_OK);
    hair_asset_destroy(asset);
    return groom;
}

static void compare(const char* name, const hair_groom* groom, const hair_physics* physics)
{
    uint32_t count = groom->info.guide_count, sagging = 0, stiffened = 0;
    struct hair_rod_borne* borne = calloc(groom->info.guide_vertex_count, sizeof *borne);
    struct hair_rod* rod = calloc(groom->info.guide_vertex_count, sizeof *rod);
    struct hair_rods_report all, own;
    assert_int_equal(hair_rods_preload_gravity(NULL, groom->guides, groom->rest, count, physics, borne, &all),
                     HAIR_OK);
    for (uint32_t k = 0; k < count; ++k)
        hair_rods_write(&groom->guides[k], groom->rest, borne, physics, HAIR_SOLVER_DIRECT, 1, 1.0 / 240,
                        rod + groom->guides[k].first);
    assert_true(all.stiffest >= 1 && all.stiffest <= 3);
    double farthest = 0, stiffen = 0;
    for (uint32_t k = 0; k < count; ++k) {
        const struct hair_guide* guide = groom->guides + k;
        assert_int_equal(hair_rods_preload_gravity(NULL, guide, groom->rest, 1, physics, borne, &own),
                         HAIR_OK);
        for (uint32_t i = 0; i < guide->count; ++i)
            assert_true(borne[guide->first + i].stiffen >= 1 && borne[guide->first + i].stiffen <= 3);
        for (uint32_t i = 0; i + 1 < guide->count; ++i)
            stiffen += borne[guide->first + i].stiffen / (guide->count - 1) / count;
        for (uint32_t i = guide->first; i < guide->first + guide->count; ++i)
            hair_test_near("real part", i, (double)rod[i].segment.w, borne[i].rest_real, 1e-6);
        struct rested r =
            rest_of(guide, groom->rest + guide->first, physics, borne + guide->first, rod + guide->first);
        assert_true(r.stable && r.left < 1e-6);
        assert_true(own.sagging || r.away < 1e-4 * r.length);
        hair_test_near("sag", k, (double)own.farthest_sag, r.away, 1e-4 * r.length);
        sagging += own.sagging;
        stiffened += own.stiffened;
        farthest = fmax(farthest, r.away);
    }
    assert_true(sagging == all.sagging && stiffened == all.stiffened);
    hair_test_near("farthest", 0, (double)all.farthest_sag, sagging ? farthest : 0, 1e-4);
    printf(
        "%s, %u vertices: %u of %u stiffened, up to %.2f times, %.3f on average; %u sag, by up to %.1f mm\n",
        name, groom->guides[0].count, stiffened, count, (double)all.stiffest, stiffen, sagging,
        1e3 * (double)all.farthest_sag);
    free(borne);
    free(rod);
}

static void built_in_haircuts_rest_as_groomed_or_as_reported(void** state)
{
    (void)state;
    for (uint32_t vertices = 32; vertices <= 64; vertices += 16)
        for (int style = 0; hair_style_name((hair_style)style); ++style) {
            hair_groom* groom = haircut((hair_style)style, vertices);
            hair_physics physics = hair_physics_default();
            compare(hair_style_name((hair_style)style), groom, &physics);
            // Without pull, a bun and a braid unwind into one of several poses.
            bool is_wound = style == HAIR_STYLE_BUN || style == HAIR_STYLE_BRAID;
            if (vertices == 32 && !is_wound) {
                physics.shape.frequency_root = physics.shape.frequency_tip = 0;
                physics.fiber.flatness = 0.6f;
                physics.tip_mass = 0.1f;
                compare("without pull, flat, with tips", groom, &physics);
            }
            hair_groom_destroy(groom);
        }
}

// Check an upright strand, which has no preferred direction.
static void too_long_upright_strand_leans(void** state)
{
    (void)state;
    struct hair_test_rod* f = hair_test_rod_make();
    f->physics.shape.frequency_root = f->physics.shape.frequency_tip = 0;
    for (int k = 0; k < 2; ++k) {
        hair_test_rod_straight(f, 32, k ? 0.3 : 0.21, PI);
        hair_test_rod_write(f, HAIR_SOLVER_DIRECT, 1.0 / 240);
        struct rested r = rest_of(&f->guide, f->rest, &f->physics, f->borne, f->rod);
        printf("%.2f m: it rests %.3f m away, %.3f m by the report\n", r.length, r.away,
               (double)f->report.farthest_sag);
        assert_true(f->report.sagging == 1 && r.stable && r.left < 1e-6);
        assert_true(f->report.farthest_sag > 0.1f * (float)r.length);
        hair_test_near("sag", (size_t)k, (double)f->report.farthest_sag, r.away, 1e-3 * r.length);
    }
    free(f);
}

static void sagging_guide_keeps_its_rest_strain_when_pinned(void** state)
{
    (void)state;
    struct hair_test_rod* f = hair_test_rod_make();
    struct hair_resolved_pin resolved_pin = {.vertex = 20};
    hair_test_rod_straight(f, 32, 0.3, PI / 2);
    hair_test_rod_write(f, HAIR_SOLVER_DIRECT, 1.0 / 240);
    assert_int_equal(f->report.sagging, 1);
    struct hair_rod* rod = calloc(MAX, sizeof *rod);
    hair_rods_pin(&f->guide, f->rest, f->borne, &resolved_pin, 0, 1, &f->physics, HAIR_SOLVER_DIRECT, 0,
                  1.0 / 240, rod);
    for (uint32_t i = 0; i < 32; ++i) assert_memory_equal(&rod[i].strain, &f->rod[i].strain, 16);
    free(rod);
    free(f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(built_in_haircuts_rest_as_groomed_or_as_reported),
        cmocka_unit_test(too_long_upright_strand_leans),
        cmocka_unit_test(sagging_guide_keeps_its_rest_strain_when_pinned),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
