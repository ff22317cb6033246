// guide_level_test.c - small hair simulates some of its guides, and derives the others.
#include "tests/support/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/hair_grid.h"

#define SIDE 64
#define GUIDES 21
#define DT (1.0f / 60)
#define ALL 1e4f // guide_pixels for which one of eight guides is simulated.

// Kinds of hair, by the method that solves it.
static const struct kind {
    const char* name;
    hair_solver solver;
    float turn; // of hair_test_handmade
    bool is_mixed;
} kinds[] = {{"direct", HAIR_SOLVER_DIRECT, 0, false},
             {"curled", HAIR_SOLVER_DIRECT, 0.3f, true},
             {"accurate", HAIR_SOLVER_ACCURATE, 0, false},
             {"follow", HAIR_SOLVER_FOLLOW, 0.3f, false}};
#define KINDS (sizeof kinds / sizeof *kinds)

struct level_scene {
    struct hair_test_scene base;
    hair_lod lod;
    uint32_t frame;
};

static void start(void** state, const struct kind* kind, struct level_scene* out)
{
    struct hair_test_handmade groom = hair_test_handmade_default();
    hair_desc desc = hair_desc_default();
    hair_physics physics = hair_physics_default();
    groom.guides = GUIDES;
    groom.turn = kind->turn;
    groom.fewest = 9;
    physics.sleep_threshold = 0;
    physics.shape.gravity_preload = kind->is_mixed ? 1 : 0; // It curves straight guides.
    desc.solver = kind->solver;
    desc.physics = &physics;
    *out = (struct level_scene){.base = hair_test_scene_make(*state, NULL), .lod = hair_lod_default()};
    hair_test_scene_add(&out->base, &groom, &desc);
    hair_test_frame_make(&out->base.frame, SIDE, SIDE, GL_RGBA32F, 0);
    out->lod.guide_pixels = ALL;
    out->base.view.lod = &out->lod;
    hair_test_set_perspective(&out->base.view, 2, 1);
    out->base.view.view[14] = -1;
    assert_int_equal(hair_sim_is_mixed(&out->base.hair->sim), kind->is_mixed);
}

static const struct hair_sim* sim_of(const struct level_scene* scene)
{
    return &scene->base.hair->sim;
}

static void draw(const struct level_scene* scene)
{
    static float pixels[4 * SIDE * SIDE];
    hair_test_draw_in(&scene->base.frame, scene->base.test, scene->base.hair, &scene->base.view, pixels);
}

// Draw, move the head and step. The number of guides follows from the view that was drawn.
static void run(struct level_scene* scene, uint32_t frames)
{
    for (uint32_t i = 0; i < frames; ++i) {
        float a = 0.1f * sinf(0.2f * (float)scene->frame++);
        const float at[16] = {cosf(a), 0, -sinf(a), 0, 0, 1, 0, 0, sinf(a), 0, cosf(a), 0, 0.2f * a, 0, 0, 1};
        draw(scene);
        hair_test_ok(scene->base.test, hair_set_transform(scene->base.hair, at));
        hair_test_ok(scene->base.test, hair_step(scene->base.hair, DT));
    }
}

static struct hair_state* read_state(const struct level_scene* scene)
{
    return hair_test_buffer(sim_of(scene)->state, sim_of(scene)->guide_vertices * sizeof(struct hair_state));
}

static double apart(hair_vec4 a, hair_vec4 b)
{
    return (double)hair_distance(hair_v3(a.x, a.y, a.z), hair_v3(b.x, b.y, b.z));
}

// Return the maximum distance of a vertex of the guides at places of the order that are multiples
// of `stride`, or of the others.
static double distance_of(const struct level_scene* scene, const struct hair_state* a,
                          const struct hair_state* b, uint32_t stride, bool simulated)
{
    const hair_groom* groom = scene->base.groom;
    double worst = 0;
    for (uint32_t k = 0; k < GUIDES; ++k) {
        const struct hair_guide* guide = &groom->guides[groom->guide_order[k]];
        if ((k % stride == 0) != simulated) continue;
        for (uint32_t i = 0; i < guide->count; ++i)
            worst = fmax(worst, apart(a[guide->first + i].position, b[guide->first + i].position));
    }
    return worst;
}

// Guides do not act on each other, so those that are simulated must have the same bits.
static void simulated_guides_are_as_among_all(void** state)
{
    for (size_t k = 0; k < KINDS; ++k) {
        struct level_scene scene[2];
        struct hair_state* at[2];
        for (int few = 0; few < 2; ++few) {
            start(state, &kinds[k], &scene[few]);
            if (!few) scene[few].lod.guide_pixels = 0;
            run(&scene[few], 30);
            at[few] = read_state(&scene[few]);
        }
        assert_int_equal(hair_guide_simulated(sim_of(&scene[0])), GUIDES);
        assert_int_equal(hair_guide_simulated(sim_of(&scene[1])), 3);
        assert_true(distance_of(&scene[0], at[0], at[1], 8, true) == 0);
        double derived = distance_of(&scene[0], at[0], at[1], 8, false);
        print_message("    %s: derived guides are at most %.1f mm away\n", kinds[k].name, 1e3 * derived);
        assert_true(0 < derived && derived < 0.1);
        for (int few = 0; few < 2; ++few) {
            free(at[few]);
            hair_test_scene_free(&scene[few].base);
        }
    }
}

// Return the parameters of the last substep for a derived guide.
static struct hair_reference_derived reference_of(const struct level_scene* scene, uint32_t place)
{
    const struct hair_sim* sim = sim_of(scene);
    const hair_groom* groom = scene->base.groom;
    struct hair_reference_derived in = {.own = &groom->guides[groom->guide_order[place]],
                                        .parent = &groom->guides[groom->guide_order[place - place % 8]],
                                        .rest = groom->rest};
    hair_quat after = sim->last_after.rotation, before = sim->last_before.rotation;
    memcpy(in.head, (double[4]){after.x, after.y, after.z, after.w}, sizeof in.head);
    memcpy(in.head_before, (double[4]){before.x, before.y, before.z, before.w}, sizeof in.head_before);
    for (int k = 0; k < 3; ++k) in.head_moved[k] = sim->last_after.position[k] - sim->last_before.position[k];
    return in;
}

// Differences of derived guides from the reference, m.
struct difference {
    double positions, displacements, longest; // `longest` is the greatest displacement
};

static void compare_guide(const struct level_scene* scene, uint32_t place, const struct hair_state* at,
                          const hair_vec4* material, struct difference* out)
{
    double positions[3 * 16], moved[3 * 16];
    struct hair_reference_derived in = reference_of(scene, place);
    in.state = at;
    in.material = hair_sim_is_mixed(sim_of(scene)) ? material : NULL;
    hair_reference_derive(&in, positions, moved);
    for (uint32_t i = 0; i < 3 * in.own->count; ++i) {
        const struct hair_state* own = &at[in.own->first + i / 3];
        const float position[3] = {own->position.x, own->position.y, own->position.z};
        const float displacement[3] = {own->displacement.x, own->displacement.y, own->displacement.z};
        out->positions = fmax(out->positions, fabs((double)position[i % 3] - positions[i]));
        out->displacements = fmax(out->displacements, fabs((double)displacement[i % 3] - moved[i]));
        out->longest = fmax(out->longest, fabs(moved[i]));
    }
}

static struct difference compare_all(const struct level_scene* scene, const struct hair_state* at)
{
    struct difference all = {0};
    const struct hair_sim* sim = sim_of(scene);
    hair_vec4* material = hair_test_buffer(sim->material, sim->guide_vertices * sizeof *material);
    for (uint32_t place = 0; place < GUIDES; ++place)
        if (place % 8) compare_guide(scene, place, at, material, &all);
    free(material);
    return all;
}

static void derived_guides_turn_as_the_reference_does(void** state)
{
    for (size_t k = 0; k < KINDS; ++k) {
        struct level_scene scene;
        start(state, &kinds[k], &scene);
        run(&scene, 120); // The difference from the parents decays.
        struct hair_state* at = read_state(&scene);
        struct difference d = compare_all(&scene, at);
        print_message("    %s: positions differ by %.2g m, displacements of %.2g m by %.2g m\n",
                      kinds[k].name, d.positions, d.longest, d.displacements);
        assert_true(d.positions < 2e-6 && d.displacements < 2e-6 && d.longest > 1e-4);
        free(at);
        hair_test_scene_free(&scene.base);
    }
}

// Return the maximum error of a segment's length, m.
static double length_error(const struct level_scene* scene, const struct hair_state* at)
{
    const hair_groom* groom = scene->base.groom;
    double worst = 0;
    for (uint32_t g = 0; g < GUIDES; ++g)
        for (uint32_t i = groom->guides[g].first; i + 1 < groom->guides[g].first + groom->guides[g].count;
             ++i)
            worst = fmax(worst,
                         fabs(apart(at[i].position, at[i + 1].position) - (double)groom->rest[i].position.w));
    return worst;
}

// Return the maximum change of a derived vertex's motion from one frame to the next, m.
static double jerk_of(const struct level_scene* scene, struct hair_state* const at[3])
{
    double worst = 0;
    for (uint32_t i = 0; i < sim_of(scene)->guide_vertices; ++i) {
        hair_vec4 a = at[0][i].position, b = at[1][i].position, c = at[2][i].position;
        hair_vec4 ahead = {2 * b.x - a.x, 2 * b.y - a.y, 2 * b.z - a.z, 0};
        worst = fmax(worst, apart(c, ahead));
    }
    return worst;
}

// A change of the level must not be seen: vertices go on from where they are, and lengths stay.
static void change_of_level_does_not_leap(void** state)
{
    for (size_t k = 0; k < KINDS; ++k) {
        struct level_scene scene;
        double leap = 0, usual = 0, stretch = 0, far = 0;
        start(state, &kinds[k], &scene);
        scene.lod.guide_pixels = 0;
        run(&scene, 120);
        struct hair_state* at[3] = {read_state(&scene), read_state(&scene), read_state(&scene)};
        for (uint32_t i = 0; i < 60; ++i) {
            // All guides, one of eight, all, and again one of eight.
            uint32_t part = i / 15, since = i % 15;
            scene.lod.guide_pixels = part % 2 ? ALL : 0;
            free(at[0]);
            at[0] = at[1], at[1] = at[2];
            run(&scene, 1);
            at[2] = read_state(&scene);
            double jerk = jerk_of(&scene, at);
            if (i > 2 && since < 3) leap = fmax(leap, jerk);
            if (i > 2 && since > 10) usual = fmax(usual, jerk);
            if (i == 14) far = compare_all(&scene, at[2]).positions;
            stretch = fmax(stretch, length_error(&scene, at[2]));
        }
        print_message("    %s: motion changes by %.2f mm in frames after a change, %.2f mm in others; "
                      "%.0f mm from the shape of the parents; lengths %.2g m\n",
                      kinds[k].name, 1e3 * leap, 1e3 * usual, 1e3 * far, stretch);
        assert_true(usual > 0 && leap < 0.15 * far + 2 * usual);
        for (int i = 0; i < 3; ++i) free(at[i]);
        hair_test_scene_free(&scene.base);
    }
}

static void level_follows_the_size_on_the_screen(void** state)
{
    struct level_scene scene;
    start(state, &kinds[0], &scene);
    struct hair_test_scene* base = &scene.base;
    const hair_vec3 size = base->hair->renderer.rest_size;
    static const struct {
        float limit; // in sizes on the screen
        uint32_t simulated;
    } levels[] = {{0.9f, GUIDES}, {1.1f, 11}, {2.2f, 6}, {4.4f, 3},
                  {100, 3},       {3.9f, 3},  {3.2f, 6}, {0.5f, GUIDES}};
    for (size_t i = 0; i < sizeof levels / sizeof *levels; ++i) {
        for (int k = 0; k < 2; ++k) {
            float scale =
                hair_draw_pixels_per_metre(&base->hair->renderer, hair_shown_head(base->hair), &base->view);
            scene.lod.guide_pixels = levels[i].limit * scale * fmaxf(size.x, fmaxf(size.y, size.z));
            draw(&scene);
            hair_test_ok(base->test, hair_step(base->hair, DT));
        }
        print_message("    limit of %.1f sizes: %u guides\n", (double)levels[i].limit,
                      hair_guide_simulated(sim_of(&scene)));
        assert_int_equal(hair_guide_simulated(sim_of(&scene)), levels[i].simulated);
    }
    base->view.lod = NULL;
    run(&scene, 2);
    assert_int_equal(hair_guide_simulated(sim_of(&scene)), GUIDES);
    hair_test_scene_free(base);
}

static void pinned_and_recorded_hair_simulates_all_guides(void** state)
{
    struct level_scene scene;
    start(state, &kinds[1], &scene);
    run(&scene, 4);
    assert_int_equal(hair_guide_simulated(sim_of(&scene)), 3);
    hair_pin pin = hair_pin_default();
    hair_test_ok(scene.base.test, hair_set_pins(scene.base.hair, &pin, 1, sizeof pin));
    run(&scene, 2);
    assert_int_equal(hair_guide_simulated(sim_of(&scene)), GUIDES);
    hair_test_ok(scene.base.test, hair_set_pins(scene.base.hair, NULL, 0, 0));
    run(&scene, 2);
    assert_int_equal(hair_guide_simulated(sim_of(&scene)), 3);
    hair_test_scene_free(&scene.base);
}

static void saved_state_continues_with_equal_bits(void** state)
{
    struct level_scene scene;
    size_t size = 0;
    start(state, &kinds[1], &scene);
    scene.lod.guide_pixels = 0;
    run(&scene, 10);
    scene.lod.guide_pixels = ALL;
    run(&scene, 3); // The difference from the parents is decaying.
    hair_instance* hair = scene.base.hair;
    hair_test_ok(scene.base.test, hair_save(hair, NULL, 0, &size));
    unsigned char* bytes = malloc(size);
    hair_test_ok(scene.base.test, hair_save(hair, bytes, size, &size));
    uint32_t frame = scene.frame;
    struct hair_state* at[2];
    for (int again = 0; again < 2; ++again) {
        scene.frame = frame;
        if (again) hair_test_ok(scene.base.test, hair_load(hair, bytes, size));
        run(&scene, 5);
        at[again] = read_state(&scene);
        run(&scene, 7);
    }
    assert_memory_equal(at[0], at[1], sim_of(&scene)->guide_vertices * sizeof **at);
    free(at[0]);
    free(at[1]);
    free(bytes);
    hair_test_scene_free(&scene.base);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(simulated_guides_are_as_among_all),
        HAIR_TEST(derived_guides_turn_as_the_reference_does),
        HAIR_TEST(change_of_level_does_not_leap),
        HAIR_TEST(level_follows_the_size_on_the_screen),
        HAIR_TEST(pinned_and_recorded_hair_simulates_all_guides),
        HAIR_TEST(saved_state_continues_with_equal_bits),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
