// targets_test.c - target poses: guides at targets, between targets and simulation, and on the way
// from one to the other, by every solver and mapping.
#include "tests/support/live_hair.h"
#include "tests/support/ways.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"

#define FRAME (1.0f / 60)
#define FRAMES 60
#define WAYS (HAIR_TEST_WAYS + 1) // The last is redblack by transform feedback.
#define EXACT 1e-5 // m

// Motion of a shaken head's hair: the positions of all guide vertices in each frame.
struct cache {
    float* frame[FRAMES];
    uint32_t vertices;
};

static void live(struct hair_test* test, int way, struct hair_test_living* out)
{
    struct hair_test_strands strands = hair_test_straight_and_curl();
    hair_desc desc = hair_test_way(way % HAIR_TEST_WAYS);
    if (way == HAIR_TEST_WAYS) {
        desc.solver = HAIR_SOLVER_REDBLACK;
        desc.thread_mapping = HAIR_THREAD_MAPPING_FEEDBACK;
    }
    hair_test_live(test, &strands, &desc, out);
    hair_test_strands_free(&strands);
}

static void shake(struct hair_test_living* living, int frame)
{
    struct hair_reference_rod_pose head = hair_test_shaken(frame * (double)FRAME);
    hair_test_advance(living, &head, (double)FRAME);
    hair_test_read_guides(living);
}

static struct cache record(struct hair_test* test)
{
    struct cache cache;
    struct hair_test_living living;
    live(test, 0, &living);
    cache.vertices = living.vertices;
    for (int i = 0; i < FRAMES; ++i) {
        shake(&living, i);
        cache.frame[i] = malloc(cache.vertices * 3 * sizeof(float));
        memcpy(cache.frame[i], living.positions, cache.vertices * 3 * sizeof(float));
    }
    hair_test_die(&living);
    return cache;
}

static void forget(struct cache* cache)
{
    for (int i = 0; i < FRAMES; ++i) free(cache->frame[i]);
}

static void set_blend(struct hair_test_living* living, float weight, float blend_time)
{
    hair_target_blend blend = hair_target_blend_default();
    blend.weight = weight;
    blend.blend_time = blend_time;
    hair_test_ok(living->test, hair_set_target_blend(living->hair, &blend));
}

static void set_targets(struct hair_test_living* living, const struct cache* cache, int frame)
{
    hair_test_ok(living->test,
                 hair_set_targets(living->hair, cache->frame[frame], cache->vertices, 12, NULL));
}

static void step(struct hair_test_living* living)
{
    hair_test_ok(living->test, hair_step(living->hair, FRAME));
}

// Play a frame of the cache while the head is at rest.
static void play(struct hair_test_living* living, const struct cache* cache, int frame)
{
    set_targets(living, cache, frame);
    step(living);
}

static double distance_of(const float* a, const float* b)
{
    return (double)hair_distance(hair_load3(a), hair_load3(b));
}

static double farthest(const float* a, const float* b, uint32_t vertices)
{
    double max = 0;
    for (uint32_t i = 0; i < vertices; ++i) max = fmax(max, distance_of(a + 3 * i, b + 3 * i));
    return max;
}

// Read the drawn guides. Free the result.
static float* read_drawn(struct hair_test_living* living, uint32_t* count)
{
    hair_test_ok(living->test, hair_read_positions(living->hair, HAIR_READ_SMOOTH, NULL, 0, count));
    float* drawn = malloc(*count * 3 * sizeof *drawn);
    hair_test_ok(living->test, hair_read_positions(living->hair, HAIR_READ_SMOOTH, drawn, *count, count));
    for (uint32_t i = 0; i < 3 * *count; ++i) assert_true(isfinite(drawn[i]));
    return drawn;
}

// Return the displacement of vertex `i` over the last substep, m.
static hair_vec3 displacement_of(struct hair_test_living* living, uint32_t i)
{
    struct hair_state state;
    glGetNamedBufferSubData(living->hair->sim.state, (GLintptr)(i * sizeof state), sizeof state, &state);
    return hair_test_xyz(state.displacement);
}

static void full_weight_follows_a_cache_with_its_velocity(void** state)
{
    struct hair_test* test = *state;
    struct cache cache = record(test);
    for (int way = 0; way < WAYS; ++way) {
        struct hair_test_living living;
        double off = 0, off_drawn = 0, off_speed = 0, went = 0;
        live(test, way, &living);
        set_blend(&living, 1, 0);
        for (int i = 0; i < FRAMES; ++i) {
            uint32_t count, tip = cache.vertices - 1;
            play(&living, &cache, i);
            hair_test_read_guides(&living);
            off = fmax(off, farthest(living.positions, cache.frame[i], cache.vertices));
            float* drawn = read_drawn(&living, &count);
            // The first and last samples of a guide are its vertices.
            off_drawn = fmax(off_drawn, distance_of(drawn, cache.frame[i]));
            off_drawn = fmax(off_drawn, distance_of(drawn + 3 * (count - 1), cache.frame[i] + 3 * tip));
            free(drawn);
            if (i == 0) continue;
            hair_vec3 moved =
                hair_sub(hair_load3(cache.frame[i] + 3 * tip), hair_load3(cache.frame[i - 1] + 3 * tip));
            hair_vec3 own =
                hair_scale(displacement_of(&living, tip), FRAME / (float)living.hair->sim.substep);
            off_speed = fmax(off_speed, (double)hair_distance(moved, own));
            went = fmax(went, (double)hair_length(moved));
        }
        print_message(
            "    way %d: guides within %.2g mm, drawn within %.2g mm, moves within %.2g mm of %.2g\n", way,
            off * 1e3, off_drawn * 1e3, off_speed * 1e3, went * 1e3);
        assert_true(went > 0.003);
        assert_true(off < EXACT && off_drawn < EXACT && off_speed < EXACT);
        hair_test_die(&living);
    }
    forget(&cache);
}

// Return how far `c` is from the way from a to b, as a fraction of the distance of a and b.
static double detour(const float* a, const float* b, const float* c)
{
    double way = distance_of(a, b);
    return way > 1e-3 ? (distance_of(a, c) + distance_of(c, b)) / way - 1 : 0;
}

static void half_weight_draws_between_simulation_and_targets(void** state)
{
    struct hair_test* test = *state;
    struct cache cache = record(test);
    for (int way = 0; way < WAYS; ++way) {
        struct hair_test_living half, free_hair, full;
        double max = 0, apart = 0;
        uint32_t count;
        live(test, way, &half), live(test, way, &free_hair), live(test, way, &full);
        set_blend(&half, 0.5f, 0), set_blend(&full, 1, 0);
        for (int i = 0; i < FRAMES / 2; ++i) {
            play(&half, &cache, i), play(&full, &cache, i), step(&free_hair);
            float *a = read_drawn(&free_hair, &count), *b = read_drawn(&full, &count),
                  *c = read_drawn(&half, &count);
            for (uint32_t k = 0; k < count; ++k) max = fmax(max, detour(a + 3 * k, b + 3 * k, c + 3 * k));
            apart = fmax(apart, farthest(a, b, count));
            free(a), free(b), free(c);
        }
        hair_test_read_guides(&half), hair_test_read_guides(&free_hair);
        print_message("    way %d: apart by %.3g mm, detour of %.3g\n", way, apart * 1e3, max);
        assert_true(apart > 0.01 && max < 0.2);
        // The simulation does not feel such targets.
        assert_memory_equal(half.positions, free_hair.positions, half.vertices * 3 * sizeof(float));
        hair_test_die(&half), hair_test_die(&free_hair), hair_test_die(&full);
    }
    forget(&cache);
}

// Step while the head shakes, with the targets of the cache unless `cache` is NULL. Return the
// greatest speed of the drawn hair, m/s.
static double fastest(struct hair_test_living* living, const struct cache* cache, int begin, int end)
{
    double max = 0;
    float* before = NULL;
    for (int i = begin; i < end; ++i) {
        uint32_t count;
        struct hair_reference_rod_pose head = hair_test_shaken(i * (double)FRAME);
        if (cache) set_targets(living, cache, i % FRAMES);
        hair_test_advance(living, &head, (double)FRAME);
        float* drawn = read_drawn(living, &count);
        if (before) max = fmax(max, farthest(before, drawn, count) / (double)FRAME);
        free(before);
        before = drawn;
    }
    free(before);
    return max;
}

static void switching_adds_at_most_half_of_the_velocity(void** state)
{
    struct hair_test* test = *state;
    struct cache cache = record(test);
    for (int way = 0; way < WAYS; ++way) {
        struct hair_test_living living;
        live(test, way, &living);
        double simulated = fastest(&living, NULL, 0, 20), to = fastest(&living, &cache, 19, 45);
        hair_test_ok(test, hair_set_targets(living.hair, NULL, 0, 0, NULL));
        double from = fastest(&living, NULL, 44, FRAMES);
        print_message("    way %d: %.3g m/s simulated, %.3g to the targets, %.3g from them\n", way, simulated,
                      to, from);
        assert_true(to <= 1.5 * simulated && from <= 1.5 * to);
        assert_false(hair_targets_are_on(&living.hair->sim));
        hair_test_die(&living);
    }
    forget(&cache);
}

static void tip_hangs_from_the_part_that_is_at_its_targets(void** state)
{
    struct hair_test* test = *state;
    struct cache cache = record(test);
    for (int way = 0; way < WAYS; ++way) {
        struct hair_test_living living;
        hair_target_blend blend = hair_target_blend_default();
        double off = 0, tip = 0, stretch = 0;
        live(test, way, &living);
        for (int i = 4; i < 8; ++i) blend.along.at[i] = 0;
        blend.blend_time = 0;
        hair_test_ok(test, hair_set_target_blend(living.hair, &blend));
        uint32_t first = living.groom->guides[0].count;
        for (int i = 0; i < FRAMES; ++i) {
            play(&living, &cache, i);
            hair_test_read_guides(&living);
            off = fmax(off, farthest(living.positions, cache.frame[i], first / 3));
            tip =
                fmax(tip, distance_of(living.positions + 3 * (first - 1), cache.frame[i] + 3 * (first - 1)));
            stretch = fmax(stretch, hair_test_stretch(&living));
        }
        print_message("    way %d: root part within %.2g mm, tip %.3g mm away, stretch %.3g\n", way,
                      off * 1e3, tip * 1e3, stretch);
        assert_true(off < EXACT && tip > 0.003);
        // The solver redblack stretches.
        assert_true(stretch < (living.hair->sim.rods ? 0.02 : 1.5));
        hair_test_die(&living);
    }
    forget(&cache);
}

static void saved_targets_continue_with_the_same_bits(void** state)
{
    struct hair_test* test = *state;
    struct cache cache = record(test);
    for (int way = 0; way < WAYS; ++way) {
        struct hair_test_living a, b;
        size_t size;
        live(test, way, &a), live(test, way, &b);
        set_blend(&a, 1, 0.1f), set_blend(&b, 1, 0.1f);
        for (int i = 0; i < 5; ++i) play(&a, &cache, i);
        set_targets(&a, &cache, 5); // The targets are part of the state before the step too.
        hair_test_ok(test, hair_save(a.hair, NULL, 0, &size));
        unsigned char* bytes = malloc(size);
        hair_test_ok(test, hair_save(a.hair, bytes, size, &size));
        hair_test_ok(test, hair_load(b.hair, bytes, size));
        step(&a), step(&b);
        for (int i = 6; i < 12; ++i) play(&a, &cache, i), play(&b, &cache, i);
        uint32_t count;
        float *drawn = read_drawn(&a, &count), *other = read_drawn(&b, &count);
        assert_memory_equal(drawn, other, count * 3 * sizeof(float));
        free(drawn), free(other), free(bytes);
        // A state without targets ends them.
        hair_test_die(&a);
        live(test, way, &a);
        hair_test_ok(test, hair_save(a.hair, NULL, 0, &size));
        bytes = malloc(size);
        hair_test_ok(test, hair_save(a.hair, bytes, size, &size));
        hair_test_ok(test, hair_load(b.hair, bytes, size));
        assert_false(hair_targets_are_on(&b.hair->sim));
        free(bytes);
        hair_test_die(&a), hair_test_die(&b);
    }
    forget(&cache);
}

static void hair_sleeps_at_targets_and_wakes_for_new_ones(void** state)
{
    struct hair_test* test = *state;
    struct cache cache = record(test);
    struct hair_test_living living;
    live(test, 0, &living);
    for (int i = 0; i < 240 && !living.hair->sim.sleep.asleep; ++i) play(&living, &cache, 10), glFinish();
    assert_true(living.hair->sim.sleep.asleep);
    play(&living, &cache, 10);
    assert_true(hair_sleep_through(&living.hair->sim));
    play(&living, &cache, 20);
    assert_false(living.hair->sim.sleep.asleep);
    hair_test_read_guides(&living);
    assert_true(farthest(living.positions, cache.frame[20], cache.vertices) < EXACT);
    hair_test_die(&living);
    forget(&cache);
}

static void reset_puts_hair_at_its_targets_at_once(void** state)
{
    struct hair_test* test = *state;
    struct cache cache = record(test);
    for (int way = 0; way < WAYS; ++way) {
        struct hair_test_living living;
        float moved[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1};
        live(test, way, &living);
        set_targets(&living, &cache, 30);
        hair_test_ok(test, hair_reset(living.hair));
        hair_test_read_guides(&living);
        assert_true(farthest(living.positions, cache.frame[30], cache.vertices) < EXACT);
        // Targets that are not set again move with the head.
        hair_test_ok(test, hair_teleport(living.hair, moved));
        step(&living);
        hair_test_read_guides(&living);
        for (uint32_t i = 0; i < 3 * cache.vertices; ++i)
            assert_true(fabsf(living.positions[i] - cache.frame[30][i] - moved[12 + i % 3]) < (float)EXACT);
        hair_test_die(&living);
    }
    forget(&cache);
}

// Targets in a buffer of OpenGL, with a gap between them. Some are not finite.
static void buffer_targets_equal_array_targets(void** state)
{
    struct hair_test* test = *state;
    struct cache cache = record(test);
    struct hair_test_living array, buffer;
    float* wide = calloc(cache.vertices * 5 + 2, sizeof *wide);
    float to_world[16] = {0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0.1f, 0, 0, 1};
    GLuint name;
    live(test, 0, &array), live(test, 0, &buffer);
    set_blend(&array, 1, 0), set_blend(&buffer, 1, 0);
    for (uint32_t i = 0; i < cache.vertices; ++i) memcpy(wide + 2 + 5 * i, cache.frame[8] + 3 * i, 12);
    glCreateBuffers(1, &name);
    glNamedBufferData(name, (GLsizeiptr)((cache.vertices * 5 + 2) * sizeof *wide), wide, GL_STATIC_DRAW);
    hair_test_ok(test, hair_set_targets(array.hair, cache.frame[8], cache.vertices, 12, to_world));
    hair_test_ok(test, hair_set_targets_buffer(buffer.hair, name, 8, 20, to_world));
    step(&array), step(&buffer);
    hair_test_read_guides(&array), hair_test_read_guides(&buffer);
    assert_memory_equal(array.positions, buffer.positions, array.vertices * 3 * sizeof(float));
    const float* c = cache.frame[8] + 3;
    assert_true(fabsf(array.positions[3] - (c[2] + 0.1f)) < (float)EXACT);
    assert_true(fabsf(array.positions[5] + c[0]) < (float)EXACT);

    wide[2 + 5 * 3] = NAN, wide[2 + 5 * 4] = INFINITY, wide[2 + 5 * 5] = -3e38f;
    glNamedBufferSubData(name, 0, (GLsizeiptr)((cache.vertices * 5 + 2) * sizeof *wide), wide);
    for (int i = 0; i < 3; ++i) {
        hair_test_ok(test, hair_set_targets_buffer(buffer.hair, name, 8, 20, to_world));
        step(&buffer);
        hair_test_read_guides(&buffer); // Checks that all are finite.
        uint32_t count;
        free(read_drawn(&buffer, &count));
    }
    hair_test_refused(test, hair_set_targets_buffer(buffer.hair, name, 20, 20, NULL), HAIR_ERROR_ARGUMENT,
                      "offset is 20");
    hair_test_refused(test, hair_set_targets_buffer(buffer.hair, name + 77, 0, 12, NULL), HAIR_ERROR_ARGUMENT,
                      "not a buffer");
    glDeleteBuffers(1, &name);
    hair_test_die(&array), hair_test_die(&buffer);
    free(wide);
    forget(&cache);
}

static void wrong_targets_are_refused_with_their_range(void** state)
{
    struct hair_test* test = *state;
    struct cache cache = record(test);
    struct hair_test_living living;
    float weights[2] = {1, -0.5f}, far[16] = {2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    hair_target_blend blend = hair_target_blend_default();
    live(test, 0, &living);
    hair_instance* hair = living.hair;
    uint32_t count = cache.vertices;
    float* at = cache.frame[0];
    hair_test_refused(test, hair_set_targets(hair, at, count - 1, 12, NULL), HAIR_ERROR_ARGUMENT, "count is");
    hair_test_refused(test, hair_set_targets(hair, NULL, 1, 12, NULL), HAIR_ERROR_ARGUMENT,
                      "positions is NULL");
    hair_test_refused(test, hair_set_targets(hair, at, count, 10, NULL), HAIR_ERROR_ARGUMENT, "[12, 4096]");
    hair_test_refused(test, hair_set_targets(hair, at, count, 12, far), HAIR_ERROR_ARGUMENT, "to_world");
    at[7] = NAN;
    hair_test_refused(test, hair_set_targets(hair, at, count, 12, NULL), HAIR_ERROR_ARGUMENT, "vertex 2 is");
    assert_false(hair_targets_are_on(&hair->sim));
    blend.guide_weights = weights;
    hair_test_refused(test, hair_set_target_blend(hair, &blend), HAIR_ERROR_ARGUMENT,
                      "guide_count is 0, not the 2");
    blend.guide_count = 2;
    hair_test_refused(test, hair_set_target_blend(hair, &blend), HAIR_ERROR_ARGUMENT,
                      "guide_weights[1] is -0.5, not in [0, 1]");
    weights[1] = 0;
    hair_test_ok(test, hair_set_target_blend(hair, &blend));
    // One guide follows, and the other is free.
    blend.blend_time = 0;
    hair_test_ok(test, hair_set_target_blend(hair, &blend));
    for (int i = 10; i < 20; ++i) play(&living, &cache, i);
    hair_test_read_guides(&living);
    uint32_t first, both[2];
    hair_test_ok(test, hair_groom_get_guides(living.groom, &first, 1, NULL, 0));
    hair_test_ok(test, hair_groom_get_guides(living.groom, both, 2, at, count));
    assert_true(first == both[0] && both[0] + both[1] == count);
    assert_true(distance_of(at, &living.groom->rest[0].position.x) < EXACT);
    hair_test_refused(test, hair_groom_get_guides(living.groom, NULL, 1, NULL, 0), HAIR_ERROR_ARGUMENT,
                      "guide_capacity is 1");
    assert_true(farthest(living.positions, cache.frame[19], first) < EXACT);
    assert_true(farthest(living.positions + 3 * first, cache.frame[19] + 3 * first, count - first) > 1e-3);
    hair_test_die(&living);
    forget(&cache);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(full_weight_follows_a_cache_with_its_velocity),
        HAIR_TEST(half_weight_draws_between_simulation_and_targets),
        HAIR_TEST(switching_adds_at_most_half_of_the_velocity),
        HAIR_TEST(tip_hangs_from_the_part_that_is_at_its_targets),
        HAIR_TEST(saved_targets_continue_with_the_same_bits),
        HAIR_TEST(hair_sleeps_at_targets_and_wakes_for_new_ones),
        HAIR_TEST(reset_puts_hair_at_its_targets_at_once),
        HAIR_TEST(buffer_targets_equal_array_targets),
        HAIR_TEST(wrong_targets_are_refused_with_their_range),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
