// random_calls_test.c - calls in any order, with values in and out of their ranges. A call that
// fails changes nothing. A call that succeeds keeps the hair finite, and getters return what it has
// set.
//
// The environment variables HAIR_TEST_SEED and HAIR_TEST_LAST select a range of seeds.
#include "tests/support/kinds.h"
#include "tests/support/scene.h"
#include "tests/support/ways.h"

#include "lib/sim/save_fields.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CALLS 24 // Number of calls by each solver and mapping.
#define BYTES (1 << 18) // Upper bound on the size of a state.
#define GUIDES 12

// State and settings that a failing call must keep.
struct seen {
    unsigned char state[BYTES];
    size_t size;
    hair_physics physics;
    hair_look look;
    hair_wind wind;
    float transform[16], lengths[GUIDES];
};

struct run {
    struct hair_test_scene scene;
    struct seen before, after;
    uint32_t random, failures, successes;
    GLuint buffer; // Buffer of positions, 4 KiB.
    char call[128]; // Name of the present call.
};

static uint32_t any(struct run* run, uint32_t count)
{
    run->random = run->random * 1664525u + 1013904223u;
    return (run->random >> 8) % count;
}

static float any_float(struct run* run)
{
    static const float values[] = {0,     -0.0f, 1,      -1,   0.01f,    1e-9f,     1e9f,
                                   1e30f, NAN,   1e-40f, 0.1f, INFINITY, -INFINITY, 3e38f};
    return any(run, 3) ? 0.001f * (float)any(run, 2000) - 1
                       : values[any(run, sizeof values / sizeof *values)];
}

// Change some members of a struct, within their ranges or not.
static void vary(struct run* run, hair_struct kind, void* desc)
{
    hair_member members[HAIR_TEST_MEMBERS];
    uint32_t count = hair_test_describe(kind, members);
    for (uint32_t i = any(run, 3) ? 1 + any(run, 4) : count; i > 0; --i) {
        const hair_member* member = &members[any(run, count)];
        char* at = (char*)desc + member->offset;
        if (member->type == HAIR_MEMBER_POINTER || member->type == HAIR_MEMBER_TEXTURE) continue;
        if (strstr(member->name, "count")) continue; // Counts belong to pointers.
        // Large fluids and many segments would take long.
        if (strstr(member->name, "resolution") || strstr(member->name, "segments")) continue;
        hair_test_vary(desc, member, &run->random);
        if (any(run, 6) || member->type != HAIR_MEMBER_FLOAT) continue;
        float value = any_float(run);
        memcpy(at + member->size * any(run, member->count), &value, sizeof value);
    }
}

static void look_at(struct run* run, struct seen* out)
{
    hair_instance* hair = run->scene.hair;
    struct hair_test* test = run->scene.test;
    memset(out, 0, sizeof *out);
    hair_test_ok(test, hair_save(hair, out->state, BYTES, &out->size));
    out->physics = hair_physics_default();
    out->look = hair_look_default();
    out->wind = hair_wind_default();
    hair_test_ok(test, hair_get_physics(hair, &out->physics));
    hair_test_ok(test, hair_get_look(hair, &out->look));
    hair_test_ok(test, hair_get_wind(hair, &out->wind));
    hair_test_ok(test, hair_get_transform(hair, out->transform));
    hair_test_ok(test, hair_get_lengths(hair, 0, GUIDES, out->lengths));
}

static void check_finite(struct run* run)
{
    static struct hair_test_points points;
    for (int source = 0; source < 3; ++source)
        hair_test_read_points(run->scene.test, run->scene.hair, (hair_read_source)source, &points);
}

// Calls -------------------------------------------------------------------------------------------

static void any_transform(struct run* run, float out[16])
{
    float angle = any_float(run);
    memset(out, 0, 16 * sizeof *out);
    out[0] = out[10] = cosf(angle), out[8] = sinf(angle), out[2] = -out[8];
    out[5] = out[15] = 1;
    for (int i = 12; i < 15; ++i) out[i] = any(run, 8) ? 0.1f * any_float(run) : any_float(run);
    if (!any(run, 8)) out[any(run, 16)] = any_float(run);
}

static hair_result set_physics(struct run* run)
{
    hair_physics physics = hair_physics_default();
    if (any(run, 2)) physics = run->before.physics;
    vary(run, HAIR_STRUCT_PHYSICS, &physics);
    hair_result result = hair_set_physics(run->scene.hair, &physics);
    hair_physics now = hair_physics_default();
    if (!result) hair_test_ok(run->scene.test, hair_get_physics(run->scene.hair, &now));
    if (!result) assert_memory_equal(&now, &physics, sizeof now);
    return result;
}

static hair_result set_look(struct run* run)
{
    hair_look look = hair_look_default();
    if (any(run, 2)) look = run->before.look;
    vary(run, HAIR_STRUCT_LOOK, &look);
    hair_result result = hair_set_look(run->scene.hair, &look);
    hair_look now = hair_look_default();
    if (!result) hair_test_ok(run->scene.test, hair_get_look(run->scene.hair, &now));
    if (!result) assert_memory_equal(&now, &look, sizeof now);
    return result;
}

static hair_result set_wind(struct run* run)
{
    hair_wind wind = hair_wind_default();
    vary(run, HAIR_STRUCT_WIND, &wind);
    wind.fluid.resolution = 16;
    return hair_set_wind(run->scene.hair, any(run, 5) ? &wind : NULL);
}

static hair_result set_transform(struct run* run)
{
    float to[16];
    any_transform(run, to);
    return any(run, 3) ? hair_set_transform(run->scene.hair, to) : hair_teleport(run->scene.hair, to);
}

static hair_result set_lengths(struct run* run)
{
    float fractions[GUIDES];
    for (int i = 0; i < GUIDES; ++i)
        fractions[i] = any(run, 20) ? 0.05f * (float)any(run, 21) : any_float(run);
    uint32_t first = any(run, GUIDES + 2),
             count = any(run, 5) ? any(run, GUIDES + 1 - first % GUIDES) : any(run, 99);
    return hair_set_lengths(run->scene.hair, first, count, any(run, 4) ? fractions : NULL);
}

static hair_result set_colliders(struct run* run)
{
    hair_collider colliders[6];
    uint32_t count = any(run, 7);
    for (uint32_t i = 0; i < 6; ++i) {
        colliders[i] = hair_collider_default();
        colliders[i].size[0] = colliders[i].size[1] = colliders[i].size[2] = 0.02f;
        colliders[i].shape = (hair_shape)any(run, 6);
        for (int k = 0; k < 3; ++k) colliders[i].position[k] = 0.1f * any_float(run);
        if (!any(run, 8)) vary(run, HAIR_STRUCT_COLLIDER, &colliders[i]);
    }
    static const size_t strides[] = {sizeof *colliders, sizeof *colliders, sizeof *colliders, 0, 4, 13};
    return hair_set_colliders(run->scene.hair, colliders, count, strides[any(run, 6)]);
}

static hair_result set_pins(struct run* run)
{
    hair_pin pins[6];
    uint32_t count = any(run, 7);
    for (uint32_t i = 0; i < 6; ++i) {
        pins[i] = hair_pin_default();
        pins[i].guide = any(run, GUIDES);
        pins[i].position[any(run, 3)] = any_float(run);
        if (!any(run, 6)) vary(run, HAIR_STRUCT_PIN, &pins[i]);
    }
    return hair_set_pins(run->scene.hair, pins, count, sizeof *pins);
}

static hair_result set_targets(struct run* run)
{
    float positions[3 * 256];
    hair_groom_info info = hair_groom_info_default();
    hair_test_ok(run->scene.test, hair_groom_describe(run->scene.groom, &info));
    uint32_t count = any(run, 5) ? info.guide_vertex_count : any(run, 256);
    assert_in_range(info.guide_vertex_count, 1, 256);
    for (int i = 0; i < 3 * 256; ++i) positions[i] = 0.3f * ((float)any(run, 1000) / 1000 - 0.5f);
    if (!any(run, 5)) positions[any(run, 3 * count + 1)] = any_float(run);
    if (!any(run, 4)) return hair_set_targets(run->scene.hair, NULL, 0, 0, NULL);
    if (any(run, 2)) return hair_set_targets(run->scene.hair, positions, count, any(run, 6) ? 12 : 10, NULL);
    glNamedBufferSubData(run->buffer, 0, sizeof positions, positions);
    return hair_set_targets_buffer(run->scene.hair, any(run, 6) ? run->buffer : any(run, 99),
                                   any(run, 5) ? 0 : any(run, 5000), 12, NULL);
}

static hair_result set_blend(struct run* run)
{
    hair_target_blend blend = hair_target_blend_default();
    vary(run, HAIR_STRUCT_TARGET_BLEND, &blend);
    return hair_set_target_blend(run->scene.hair, &blend);
}

static hair_result cut(struct run* run)
{
    hair_cut_desc desc = hair_cut_desc_default();
    hair_cut_info info = hair_cut_info_default();
    hair_instance* pieces = NULL;
    bool wants = any(run, 2);
    for (int i = 0; i < 3; ++i) {
        desc.start[i] = 0.1f * any_float(run), desc.end[i] = 0.1f * any_float(run);
        desc.last_start[i] = 0.1f * any_float(run), desc.last_end[i] = 0.1f * any_float(run);
    }
    desc.shape = (hair_cut_shape)any(run, 3);
    if (!any(run, 4)) vary(run, HAIR_STRUCT_CUT_DESC, &desc);
    hair_result result = hair_cut(run->scene.hair, &desc, &info, wants ? &pieces : NULL);
    if (result || !wants) return result;
    if (pieces) hair_test_ok(run->scene.test, hair_step(pieces, 0.01f));
    hair_destroy(pieces);
    return result;
}

// Step, sometimes while no memory of the GPU may be added.
static hair_result step(struct run* run)
{
    hair_context* context = run->scene.test->context;
    hair_test_ok(run->scene.test, hair_set_memory_limit(context, any(run, 6) ? 0 : 1));
    if (!any(run, 20)) hair_test_ok(run->scene.test, hair_set_budget(context, any(run, 2) ? 0.01f : 0));
    hair_result result =
        hair_step(run->scene.hair, any(run, 4) ? 0.001f * (float)any(run, 30) : any_float(run));
    hair_test_ok(run->scene.test, hair_set_memory_limit(context, 0));
    return result;
}

static hair_result draw(struct run* run)
{
    hair_view view = hair_test_view_by((hair_render_path)any(run, 5));
    vary(run, HAIR_STRUCT_VIEW, &view);
    view.header = hair_view_default().header;
    return hair_draw(run->scene.hair, &view);
}

static hair_result load(struct run* run)
{
    static unsigned char bytes[BYTES];
    memcpy(bytes, run->before.state, BYTES);
    size_t size = run->before.size;
    if (any(run, 2)) bytes[any(run, (uint32_t)size)] ^= (unsigned char)(1 << any(run, 8));
    if (!any(run, 4)) size = any(run, (uint32_t)size + 64);
    if (any(run, 3) && size >= HAIR_SAVE_HEADER + HAIR_SAVE_TRAILER)
        hair_save_seal(bytes, size - HAIR_SAVE_TRAILER); // The fields then decide.
    return hair_load(run->scene.hair, bytes, size);
}

static hair_result reset(struct run* run)
{
    return hair_reset(run->scene.hair);
}

static hair_result record(struct run* run)
{
    return hair_record_contacts(run->scene.hair, any(run, 2) ? any_float(run) : 0);
}

static hair_result get_contacts(struct run* run)
{
    hair_collider_contact contacts[4];
    uint32_t count = 77;
    hair_result result = hair_get_contacts(run->scene.hair, any(run, 2), contacts,
                                           any(run, 5) ? sizeof *contacts : 4, 4, &count);
    if (result) assert_int_equal(count, 77);
    return result;
}

static hair_result set_group(struct run* run)
{
    hair_physics physics = hair_physics_default();
    vary(run, HAIR_STRUCT_PHYSICS, &physics);
    return hair_set_group_physics(run->scene.hair, any(run, 3), any(run, 3) ? &physics : NULL);
}

static hair_result set_scalp(struct run* run)
{
    float positions[3 * 30] = {0};
    return any(run, 2) ? hair_set_scalp(run->scene.hair, positions, any(run, 31), 12, NULL)
                       : hair_set_scalp_buffer(run->scene.hair, run->buffer, any(run, 5000), 12, NULL);
}

static hair_result reload(struct run* run)
{
    return hair_context_reload(run->scene.test->context);
}

static const struct {
    const char* name;
    hair_result (*call)(struct run* run);
} calls[] = {{"set_physics", set_physics},
             {"set_look", set_look},
             {"set_wind", set_wind},
             {"set_transform", set_transform},
             {"set_lengths", set_lengths},
             {"set_colliders", set_colliders},
             {"set_pins", set_pins},
             {"set_targets", set_targets},
             {"set_blend", set_blend},
             {"cut", cut},
             {"step", step},
             {"step", step},
             {"step", step},
             {"draw", draw},
             {"load", load},
             {"reset", reset},
             {"record", record},
             {"get_contacts", get_contacts},
             {"set_group", set_group},
             {"set_scalp", set_scalp},
             {"reload", reload}};

static void compare(struct run* run, uint32_t seed)
{
    const struct seen *a = &run->before, *b = &run->after;
    const char* what = a->size != b->size                                        ? "the size of the state"
                       : memcmp(a->state, b->state, a->size)                     ? "the state"
                       : memcmp(&a->physics, &b->physics, sizeof a->physics)     ? "physics"
                       : memcmp(&a->look, &b->look, sizeof a->look)              ? "the look"
                       : memcmp(&a->wind, &b->wind, sizeof a->wind)              ? "the wind"
                       : memcmp(a->transform, b->transform, sizeof a->transform) ? "the transform"
                       : memcmp(a->lengths, b->lengths, sizeof a->lengths)       ? "lengths"
                                                                                 : NULL;
    if (what)
        fail_msg("seed %u, %s failed (%s) and changed %s", seed, run->call, run->scene.test->host.sentence,
                 what);
}

static void live(struct hair_test* test, int way, uint32_t seed)
{
    static struct run run;
    struct hair_test_handmade groom = hair_test_handmade_default();
    hair_desc desc = hair_test_way(way);
    memset(&run, 0, sizeof run);
    run.random = seed * 2654435761u + 12345 * (uint32_t)way;
    groom.guides = GUIDES, groom.followers = 60;
    groom.seed = seed;
    run.scene = hair_test_scene_make(test, NULL);
    hair_test_scene_add(&run.scene, &groom, &desc);
    hair_test_frame_make(&run.scene.frame, 24, 24, GL_RGBA32F, 0);
    glCreateBuffers(1, &run.buffer);
    glNamedBufferData(run.buffer, 4096, NULL, GL_DYNAMIC_DRAW);
    look_at(&run, &run.before);
    for (uint32_t i = 0; i < CALLS; ++i) {
        uint32_t which = any(&run, sizeof calls / sizeof *calls);
        snprintf(run.call, sizeof run.call, "%s, call %u, %s", hair_test_way_name(way), i, calls[which].name);
        hair_result result = calls[which].call(&run);
        uint32_t logged = hair_test_forgive(test);
        GLenum error = glGetError();
        if (error) fail_msg("seed %u, %s left the OpenGL error 0x%x", seed, run.call, error);
        if (result && !logged) fail_msg("seed %u, %s failed silently", seed, run.call);
        run.failures += result != HAIR_OK, run.successes += result == HAIR_OK;
        if (!result) check_finite(&run); // Reading counts as seeing, which is part of the state.
        look_at(&run, &run.after);
        if (result) compare(&run, seed);
        run.before = run.after;
    }
    print_message("    %s, seed %u: %u calls done, %u refused\n", hair_test_way_name(way), seed,
                  run.successes, run.failures);
    glDeleteBuffers(1, &run.buffer);
    hair_test_scene_free(&run.scene);
}

static void random_calls_keep_or_change_the_hair_as_they_say(void** state)
{
    const char *first = getenv("HAIR_TEST_SEED"), *last = getenv("HAIR_TEST_LAST");
    uint32_t from = first ? (uint32_t)atoi(first) : 1;
    uint32_t to = last ? (uint32_t)atoi(last) : from + (getenv("HAIR_TEST_FULL") ? 39 : 2);
    for (uint32_t seed = from; seed <= to; ++seed)
        for (int way = 0; way < HAIR_TEST_WAYS; ++way) live(*state, way, seed);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {HAIR_TEST(random_calls_keep_or_change_the_hair_as_they_say)};
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
