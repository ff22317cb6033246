// cut_pieces_test.c - what a cut takes away is hair of free strands, which starts where and as fast
// as the hair was.
#include "tests/support/cut_scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/asset/strands.h"
#include "tests/support/grooms.h"
#include "tests/support/ways.h"

#define FRAME (1.0f / 60)

static hair_cut_desc level_plane(float kept)
{
    hair_cut_desc cut = hair_cut_desc_default();
    cut.start[1] = HAIR_TEST_CUT_HEIGHT - kept * HAIR_TEST_CUT_LENGTH;
    return cut;
}

static hair_look straight_look(void)
{
    hair_look look = hair_look_default();
    look.strays.fraction = look.strays.tip_fraction = 0;
    return look;
}

static hair_look curly_look(void)
{
    hair_look look = straight_look();
    look.strand.segments = 96;
    look.curl.radius = 0.006f, look.curl.wavelength = 0.05f;
    return look;
}

static hair_instance* cut_off(const struct hair_test_scene* scene, const hair_cut_desc* cut)
{
    hair_instance* pieces = NULL;
    hair_test_ok(scene->test, hair_cut(scene->hair, cut, NULL, &pieces));
    assert_non_null(pieces);
    return pieces;
}

static double distance_from_segment(hair_vec3 p, hair_vec3 a, hair_vec3 b)
{
    hair_vec3 way = hair_sub(b, a), arm = hair_sub(p, a);
    float along = fminf(fmaxf(hair_dot(arm, way) / fmaxf(hair_dot(way, way), 1e-20f), 0), 1);
    return (double)hair_distance(arm, hair_scale(way, along));
}

// Return the distance of a place from the nearest strand, m.
static double distance_from_strands(const struct hair_test_drawn* drawn, hair_vec3 p)
{
    double min = 1;
    for (uint32_t s = 0; s < drawn->count; ++s)
        for (uint32_t k = 0; k + 1 < drawn->vertices; ++k)
            min = fmin(min, distance_from_segment(p, hair_test_drawn_at(drawn, s, k),
                                                  hair_test_drawn_at(drawn, s, k + 1)));
    return min;
}

// Return the mean place of all drawn hair below a height, by length.
static hair_vec3 mean_place(const struct hair_test_drawn* drawn, float below)
{
    double sum[3] = {0}, length = 0;
    for (uint32_t s = 0; s < drawn->count; ++s)
        for (uint32_t k = 0; k + 1 < drawn->vertices; ++k) {
            hair_vec3 a = hair_test_drawn_at(drawn, s, k), b = hair_test_drawn_at(drawn, s, k + 1);
            hair_vec3 at = hair_lerp(a, b, 0.5f);
            double own = at.y < below ? (double)hair_distance(a, b) : 0;
            sum[0] += own * (double)at.x, sum[1] += own * (double)at.y, sum[2] += own * (double)at.z;
            length += own;
        }
    return hair_v3((float)(sum[0] / length), (float)(sum[1] / length), (float)(sum[2] / length));
}

static hair_vec3 read_mean(const struct hair_test* test, hair_instance* hair)
{
    struct hair_test_drawn drawn = hair_test_read_drawn(test, hair);
    hair_vec3 mean = mean_place(&drawn, INFINITY);
    free(drawn.positions);
    return mean;
}

static void pieces_start_where_the_hair_was(void** state)
{
    hair_look looks[2] = {straight_look(), curly_look()};
    for (int i = 0; i < 4; ++i) {
        struct hair_test_scene scene = hair_test_cut_scene(
            *state, i & 1 ? HAIR_STRAND_SET_FULL : HAIR_STRAND_SET_GUIDES, NULL, &looks[i >> 1], NULL);
        hair_cut_desc cut = level_plane(0.55f);
        hair_test_cut_swing(&scene, 33);
        struct hair_test_drawn before = hair_test_read_drawn(*state, scene.hair);
        hair_instance* pieces = cut_off(&scene, &cut);
        struct hair_test_drawn kept = hair_test_read_drawn(*state, scene.hair);
        struct hair_test_drawn fallen = hair_test_read_drawn(*state, pieces);
        double jump = 0, top = 0;
        for (uint32_t s = 0; s < fallen.count; ++s)
            for (uint32_t k = 0; k < fallen.vertices; ++k) {
                hair_vec3 at = hair_test_drawn_at(&fallen, s, k);
                jump = fmax(jump, distance_from_strands(&before, at));
                if (k == 0) top = fmax(top, fabs((double)(at.y - cut.start[1])));
            }
        double all = hair_test_drawn_length_of_all(&before);
        double both = hair_test_drawn_length_of_all(&kept) + hair_test_drawn_length_of_all(&fallen);
        print_message("    %u pieces by %u guides are within %.3f mm of the hair, %.3f mm of the plane\n",
                      fallen.count, pieces->groom->info.guide_count, jump * 1e3, top * 1e3);
        print_message("    the length of all is %.6f of that before\n", both / all);
        assert_true(fallen.count > 8 && jump < (i >> 1 ? 1e-3 : 1e-4) && top < 1e-4);
        assert_true(fabs(both / all - 1) < (i >> 1 ? 1e-2 : 1e-4));
        free(before.positions), free(kept.positions), free(fallen.positions);
        hair_destroy(pieces);
        hair_test_scene_free(&scene);
    }
}

// Hair behind a head of constant velocity has this velocity. The air then slows its pieces.
static void pieces_start_with_the_velocity_of_the_hair(void** state)
{
    const float speed = 0.6f, damping = 3;
    hair_look look = straight_look();
    for (int way = 0; way < HAIR_TEST_WAYS; way += 2) {
        float transform[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        hair_physics physics = hair_physics_default();
        hair_desc desc = hair_test_way(way);
        physics.gravity[1] = 0, physics.damping = damping;
        desc.physics = &physics;
        struct hair_test_scene scene = hair_test_cut_scene(
            *state, way & 2 ? HAIR_STRAND_SET_FULL : HAIR_STRAND_SET_GUIDES, &desc, &look, NULL);
        hair_cut_desc cut = level_plane(0.6f);
        for (int i = 0; i < 120; ++i) {
            transform[12] += speed * FRAME;
            hair_test_ok(*state, hair_set_transform(scene.hair, transform));
            hair_test_ok(*state, hair_step(scene.hair, FRAME));
        }
        hair_instance* pieces = cut_off(&scene, &cut);
        hair_vec3 start = read_mean(*state, pieces);
        for (int i = 0; i < 12; ++i) hair_test_ok(*state, hair_step(pieces, FRAME));
        hair_vec3 moved = hair_sub(read_mean(*state, pieces), start);
        float wanted = speed * (1 - expf(-damping * 12 * FRAME)) / damping;
        print_message("    %s: pieces move by %.4f m, not %.4f m\n", hair_test_way_name(way), (double)moved.x,
                      (double)wanted);
        assert_true(fabsf(moved.x / wanted - 1) < 0.03f && fabsf(moved.y) + fabsf(moved.z) < 0.03f * wanted);
        hair_destroy(pieces);
        hair_test_scene_free(&scene);
    }
}

// The mean place of free hair without damping falls by g t^2 / 2.
static void pieces_fall_as_gravity_has_it(void** state)
{
    hair_look look = curly_look();
    hair_physics physics = hair_physics_default();
    hair_desc desc = hair_desc_default();
    physics.damping = 0;
    desc.physics = &physics;
    struct hair_test_scene scene = hair_test_cut_scene(*state, HAIR_STRAND_SET_GUIDES, &desc, &look, NULL);
    hair_cut_desc cut = level_plane(0.3f);
    hair_test_ok(*state, hair_step(scene.hair, FRAME));
    hair_instance* pieces = cut_off(&scene, &cut);
    hair_vec3 start = read_mean(*state, pieces), kept = read_mean(*state, scene.hair);
    for (int i = 0; i < 24; ++i) {
        hair_test_ok(*state, hair_step(pieces, FRAME));
        hair_test_ok(*state, hair_step(scene.hair, FRAME));
    }
    double fallen = (double)(start.y - read_mean(*state, pieces).y), time = 24 * (double)FRAME;
    // The drawn hair lies up to one substep behind.
    double most = 9.81 * time * time / 2, least = 9.81 * pow(time - pieces->sim.substep, 2) / 2;
    print_message("    after %.3f s the pieces are %.4f m lower, not %.4f to %.4f m\n", time, fallen, least,
                  most);
    assert_true(0.99 * least < fallen && fallen < 1.01 * most);
    assert_true(hair_distance(read_mean(*state, scene.hair), kept) < 0.01f);
    hair_destroy(pieces);
    hair_test_scene_free(&scene);
}

// Return the colour of a follower at one of its points.
static hair_vec3 color_of(const hair_groom* groom, uint32_t follower, uint32_t point)
{
    const uint16_t* c = groom->colors + 4 * (HAIR_STRAND_COLORS * (size_t)follower + point);
    return hair_scale(hair_v3((float)c[0], (float)c[1], (float)c[2]), 1.0f / 65535);
}

// Radii are those of one of the strands. Green grows from 0 at the root to 1 at the tip, and red is
// that of the strand.
static void pieces_keep_groups_radii_and_colours(void** state)
{
    hair_look look = straight_look();
    hair_physics physics = hair_physics_default();
    hair_group_look group = hair_group_look_default();
    struct hair_test_scene scene = hair_test_cut_scene(*state, HAIR_STRAND_SET_FULL, NULL, &look, NULL);
    group.radius = 2;
    physics.damping = 9;
    hair_test_ok(*state, hair_set_group_look(scene.hair, 1, &group));
    hair_test_ok(*state, hair_set_group_physics(scene.hair, 1, &physics));
    hair_cut_desc cut = level_plane(0.5f);
    hair_instance* pieces = cut_off(&scene, &cut);
    const hair_groom* groom = pieces->groom;
    hair_look own = hair_look_default();
    hair_test_ok(*state, hair_get_look(pieces, &own));
    hair_test_ok(*state, hair_get_group_look(pieces, 1, &group));
    hair_test_ok(*state, hair_get_group_physics(pieces, 1, &physics));
    assert_true(group.radius == 2 && physics.damping == 9 && physics.root == HAIR_ROOT_FREE);
    assert_int_equal(groom->info.follower_count, HAIR_TEST_CUT_GUIDES);
    for (uint32_t f = 0; f < groom->info.follower_count; ++f) {
        uint32_t strand = (uint32_t)(color_of(groom, f, 0).x * HAIR_TEST_CUT_GUIDES + 0.5f);
        float radius = groom->followers[f].offset[0].w * own.strand.radius;
        assert_int_equal(groom->guides[groom->followers[f].guide0].group, strand % 2);
        float mean = (6 * 1 + 5 * 1.5f + 5 * 2) / 16;
        assert_true(fabsf(radius / look.strand.radius * mean / (1 + 0.5f * (float)(strand % 3)) - 1) < 1e-3f);
        for (uint32_t k = 0; k < HAIR_STRAND_COLORS; ++k)
            assert_true(fabsf(color_of(groom, f, k).y - (0.5f + 0.5f * (float)k / 7)) < 2e-3f);
    }
    hair_destroy(pieces);
    hair_test_scene_free(&scene);
}

// Attributes that are linear in the number of the strand, as red is, on a scalp at the roots.
struct linear {
    hair_strand_attribute attributes[3];
    float values[2][HAIR_TEST_CUT_GUIDES], uvs[50];
    struct hair_test_scalp scalp;
    hair_groom_desc desc;
};

static void fill_linear(struct linear* linear)
{
    static const hair_strand_attribute_kind kinds[3] = {
        HAIR_STRAND_ATTRIBUTE_STIFFNESS, HAIR_STRAND_ATTRIBUTE_ROUGHNESS, HAIR_STRAND_ATTRIBUTE_DAMPING};
    linear->desc = hair_groom_desc_default();
    linear->scalp = hair_test_scalp_make(4, 0.06f);
    for (uint32_t i = 0; i < linear->scalp.vertex_count; ++i) {
        float* p = linear->scalp.positions + 3 * (size_t)i;
        linear->uvs[2 * i] = p[0] / 0.06f, linear->uvs[2 * i + 1] = p[2] / 0.06f;
        p[1] = HAIR_TEST_CUT_HEIGHT;
    }
    for (int i = 0; i < HAIR_TEST_CUT_GUIDES; ++i) {
        linear->values[0][i] = 1 + (float)i / HAIR_TEST_CUT_GUIDES;
        linear->values[1][i] = 2 - (float)i / HAIR_TEST_CUT_GUIDES;
    }
    for (int k = 0; k < 3; ++k) {
        linear->attributes[k] = hair_strand_attribute_default();
        linear->attributes[k].kind = kinds[k];
        linear->attributes[k].strand_values = linear->values[k == 2];
    }
    hair_test_set_scalp(&linear->desc, &linear->scalp);
    linear->desc.scalp_uvs = linear->uvs;
    linear->desc.strand_attributes = linear->attributes, linear->desc.strand_attribute_count = 3;
}

// Return the root uv of the strand with a seed.
static const float* uv_of(const hair_groom* groom, uint32_t seed)
{
    for (uint32_t i = 0; i < groom->info.follower_count; ++i)
        if (groom->followers[i].seed == seed) return groom->root_uvs + 2 * (size_t)i;
    return NULL;
}

static void pieces_keep_the_attributes_of_their_strands(void** state)
{
    struct linear linear;
    hair_look look = straight_look();
    fill_linear(&linear);
    for (int set = 0; set < 2; ++set) {
        struct hair_test_scene scene = hair_test_cut_scene_with(
            *state, set ? HAIR_STRAND_SET_FULL : HAIR_STRAND_SET_GUIDES, NULL, &look, NULL, &linear.desc);
        hair_cut_desc cut = level_plane(0.5f);
        hair_instance* pieces = cut_off(&scene, &cut);
        const hair_groom* groom = pieces->groom;
        double off[3] = {0};
        uint32_t own = 0;
        assert_non_null(groom->guide_factors);
        for (uint32_t f = 0; f < groom->info.follower_count; ++f) {
            const struct hair_follower* follower = &groom->followers[f];
            float red = color_of(groom, f, 0).x;
            float roughness = sqrtf(hair_groom_follower_factor(groom, f, HAIR_FACTOR_VARIANCE));
            const float* uv = uv_of(scene.groom, follower->seed);
            assert_memory_equal(groom->root_uvs + 2 * (size_t)f, uv, 2 * sizeof *uv);
            off[0] = fmax(off[0], fabs((double)(roughness - 1 - red)));
            if (follower->multi != 0 || set) continue;
            const struct hair_guide_factors* factors = &groom->guide_factors[follower->guide0];
            off[1] = fmax(off[1], fabs((double)(factors->stiffness - 1 - red)));
            off[2] = fmax(off[2], fabs((double)(factors->damping - 2 + red)));
            ++own;
        }
        print_message(
            "    roughness, stiffness and damping of %u pieces and %u guides: %.1e, %.1e, %.1e off\n",
            groom->info.follower_count, own, off[0], off[1], off[2]);
        assert_true(set || own > 8);
        assert_true(off[0] < 2e-3 && off[1] < 1e-4 && off[2] < 1e-4);
        hair_destroy(pieces);
        hair_test_scene_free(&scene);
    }
    hair_test_scalp_free(&linear.scalp);
}

// Strands that swing do not stand on their tips.
static void colliders_hold_pieces(void** state)
{
    hair_look look = straight_look();
    hair_collider floor = hair_collider_default();
    struct hair_test_scene scene = hair_test_cut_scene(*state, HAIR_STRAND_SET_GUIDES, NULL, &look, NULL);
    struct hair_test_points points;
    floor.shape = HAIR_SHAPE_PLANE, floor.position[1] = 1.2f;
    hair_test_ok(*state, hair_set_colliders(scene.hair, &floor, 1, sizeof floor));
    hair_test_cut_swing(&scene, 20);
    hair_cut_desc cut = level_plane(0.5f);
    hair_instance* pieces = cut_off(&scene, &cut);
    for (int i = 0; i < 120; ++i) hair_test_ok(*state, hair_step(pieces, FRAME));
    hair_test_read_points(*state, pieces, HAIR_READ_GUIDES, &points);
    float low = 2, high = 0;
    for (uint32_t i = 0; i < points.count; ++i) {
        low = fminf(low, points.at[3 * i + 1]);
        high = fmaxf(high, points.at[3 * i + 1]);
    }
    print_message("    the guides lie at heights of %.4f to %.4f m\n", (double)low, (double)high);
    assert_true(low > 1.199f && high < 1.23f);
    hair_destroy(pieces);
    hair_test_scene_free(&scene);
}

static void crumbs_are_no_pieces_and_failures_change_nothing(void** state)
{
    hair_look look = straight_look();
    struct hair_test_scene scene = hair_test_cut_scene(*state, HAIR_STRAND_SET_GUIDES, NULL, &look, NULL);
    struct hair_test* test = *state;
    hair_memory memory = hair_memory_default();
    hair_cut_desc cut = level_plane(0.5f);
    hair_cut_info info = hair_cut_info_default();
    hair_instance* pieces = scene.hair;
    struct hair_test_drawn drawn = hair_test_read_drawn(*state, scene.hair);
    hair_test_ok(test, hair_get_memory(test->context, &memory));
    hair_test_ok(test, hair_set_memory_limit(test->context, memory.bytes + 40000));
    hair_test_refused(test, hair_cut(scene.hair, &cut, &info, &pieces), HAIR_ERROR_MEMORY, "");
    hair_test_ok(test, hair_set_memory_limit(test->context, 0));
    assert_true(pieces == scene.hair && info.strands == 0);
    assert_null(scene.hair->sim.lengths.guides);
    cut.start[1] = HAIR_TEST_CUT_HEIGHT - HAIR_TEST_CUT_LENGTH + 0.002f;
    hair_test_ok(test, hair_cut(scene.hair, &cut, &info, &pieces));
    assert_true(!pieces && info.strands > 0);
    free(drawn.positions);
    hair_test_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(pieces_start_where_the_hair_was),
        HAIR_TEST(pieces_start_with_the_velocity_of_the_hair),
        HAIR_TEST(pieces_fall_as_gravity_has_it),
        HAIR_TEST(pieces_keep_groups_radii_and_colours),
        HAIR_TEST(pieces_keep_the_attributes_of_their_strands),
        HAIR_TEST(colliders_hold_pieces),
        HAIR_TEST(crumbs_are_no_pieces_and_failures_change_nothing),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
