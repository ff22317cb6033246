// character_test.c - hair on a skinned character that walks and nods: strands stay outside its
// body, and the scalp follows the head.
#include "tests/support/support.h"
#include "tools/common/character.h"
#include "tools/common/groom_source.h"

#include "lib/collide/triangles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FPS 30
#define DEEP 1e-3 // m, that no strand may be inside

struct walk {
    struct hair_test* test;
    struct hair_scene scene;
    struct hair_character* character;
    hair_groom* groom;
    hair_instance* hair;
    float* positions; // of drawn followers
    uint32_t strands, each, step; // vertices of a strand
};

static void set_colliders(struct walk* walk)
{
    hair_collider collider = hair_character_collider(walk->character);
    hair_test_ok(walk->test, hair_set_colliders(walk->hair, &collider, 1, sizeof collider));
}

static void begin(struct hair_test* test, const char* text, struct walk* walk)
{
    *walk = (struct walk){.test = test};
    struct hair_scene* scene = &walk->scene;
    assert_true(hair_scene_parse("test", "tests.json", text, strlen(text), scene));
    assert_int_equal(hair_character_create("test", scene, &walk->character), 0);
    assert_int_equal(hair_groom_source_load("test", &test->host.host, scene, walk->character, &walk->groom),
                     0);
    hair_desc desc = scene->settings.desc;
    desc.physics = &scene->settings.physics;
    desc.look = &scene->settings.look;
    memcpy(desc.transform, walk->character->transform, sizeof desc.transform);
    hair_test_ok(test, hair_create(test->context, walk->groom, &desc, &walk->hair));
    hair_groom_info info = hair_groom_info_default();
    hair_groom_describe(walk->groom, &info);
    struct hair_bounds bounds;
    memcpy(bounds.lower, info.lower, sizeof bounds.lower);
    memcpy(bounds.upper, info.upper, sizeof bounds.upper);
    float reach = 1.15f * hair_camera_reach(scene, &bounds);
    hair_test_ok(test,
                 hair_character_create_body(walk->character, test->context, scene->motion.pivot, reach));
    hair_test_ok(test, hair_character_attach(walk->character, walk->hair));
    set_colliders(walk);
    uint32_t count;
    walk->each = scene->settings.look.strand.segments + 1;
    hair_test_ok(test, hair_read_positions(walk->hair, HAIR_READ_FOLLOWERS, NULL, 0, &count));
    walk->strands = count / walk->each;
    walk->positions = malloc(3 * (size_t)count * sizeof *walk->positions);
    assert_true(walk->positions && walk->strands > 0);
}

static void end(struct walk* walk)
{
    hair_destroy(walk->hair);
    hair_groom_destroy(walk->groom);
    hair_character_destroy(walk->character);
    hair_scene_free(&walk->scene);
    free(walk->positions);
}

// Step to a frame.
static void step(struct walk* walk, uint32_t frame)
{
    assert_true(hair_character_pose(walk->character, (float)((double)frame / FPS)));
    hair_test_ok(walk->test, hair_character_move(walk->character, walk->hair));
    set_colliders(walk);
    hair_test_ok(walk->test, hair_step(walk->hair, 1.0f / FPS));
}

static void read_followers(struct walk* walk)
{
    uint32_t count, all = walk->strands * walk->each;
    hair_test_ok(walk->test,
                 hair_read_positions(walk->hair, HAIR_READ_FOLLOWERS, walk->positions, all, &count));
    assert_int_equal(count, all);
}

// Return a point of the world in the space of the groom.
static hair_vec3 to_groom(const struct walk* walk, const float* p)
{
    const float* m = walk->character->transform;
    float d[3] = {p[0] - m[12], p[1] - m[13], p[2] - m[14]}, out[3];
    for (int k = 0; k < 3; ++k) out[k] = m[4 * k] * d[0] + m[4 * k + 1] * d[1] + m[4 * k + 2] * d[2];
    return hair_v3(out[0], out[1], out[2]);
}

// Build the tree of the mesh in the space of the groom.
static struct hair_triangles build_triangles(const struct walk* walk)
{
    struct hair_triangles triangles = {0};
    const struct head_mesh* mesh = &walk->character->mesh;
    hair_test_ok(walk->test, hair_triangles_build(&walk->test->host.host, mesh->positions, mesh->triangles,
                                                  mesh->triangle_count, &triangles));
    return triangles;
}

// Count the strands with a vertex after the root that is deeper in the mesh than DEEP, by exact
// distances. Update the maximum depth.
static uint32_t count_inside(struct walk* walk, double* deepest)
{
    struct hair_triangles triangles = build_triangles(walk);
    uint32_t count = 0;
    read_followers(walk);
    for (uint32_t i = 0; i < walk->strands; ++i) {
        bool is_inside = false;
        for (uint32_t k = 1; k < walk->each; ++k) {
            hair_vec3 at = to_groom(walk, walk->positions + 3 * ((size_t)i * walk->each + k));
            at = hair_sub(at, triangles.center);
            if (fabsf(hair_triangles_winding(&triangles, at)) < 0.5f) continue;
            float distance = INFINITY;
            uint32_t nearest = UINT32_MAX;
            hair_triangles_find(&triangles, at, &distance, &nearest);
            *deepest = fmax(*deepest, (double)distance);
            is_inside |= (double)distance > DEEP;
        }
        count += is_inside;
    }
    hair_triangles_free(&walk->test->host.host, &triangles);
    return count;
}

static const char walking[] =
    "{\"style\": \"long\", \"character\": {\"file\": \"tools/scenes/walker.glb\"}, \"pivot\": [0, 1.5, 0], "
    "\"settings\": {\"guides\": 64, \"followers\": 100, \"strand.segments\": 16, \"guide_vertices\": 16}}";

static const char many_guides[] =
    "{\"style\": \"bob\", \"character\": {\"file\": \"tools/scenes/walker.glb\"}, \"pivot\": [0, 1.5, 0], "
    "\"settings\": {\"guides\": 400, \"followers\": 400, \"strand.segments\": 8, \"guide_vertices\": 8}}";

// HAIR_TEST_FULL=1 walks 10,000 frames, about 150 times the animation.
static void strands_stay_outside_of_a_walking_and_nodding_body(void** state)
{
    struct walk walk;
    begin(*state, walking, &walk);
    uint32_t frames = getenv("HAIR_TEST_FULL") ? 10000 : 100, inside = 0;
    double deepest = 0;
    for (uint32_t frame = 1; frame <= frames; ++frame) {
        step(&walk, frame);
        inside += count_inside(&walk, &deepest);
        if (frame % 500 == 0)
            print_message(
                "    after %u frames %u of %u strands were inside by more than 1 mm, at most %.2f mm\n",
                frame, inside, frame * walk.strands, 1e3 * deepest);
    }
    print_message("    %u frames: %u of %u strands were inside by more than 1 mm, at most %.2f mm\n", frames,
                  inside, frames * walk.strands, 1e3 * deepest);
    assert_int_equal(inside, 0);
    end(&walk);
}

// Write the distance of each root from the skin, m.
static void measure_roots(struct walk* walk, float* distances)
{
    struct hair_triangles triangles = build_triangles(walk);
    read_followers(walk);
    for (uint32_t i = 0; i < walk->strands; ++i) {
        hair_vec3 root = to_groom(walk, walk->positions + 3 * (size_t)i * walk->each);
        uint32_t nearest = UINT32_MAX;
        distances[i] = INFINITY;
        hair_triangles_find(&triangles, hair_sub(root, triangles.center), &distances[i], &nearest);
    }
    hair_triangles_free(&walk->test->host.host, &triangles);
}

// The scalp is skinned with the head and the nape, so that roots keep their distance from the skin.
static void roots_follow_the_skin(void** state)
{
    struct walk walk;
    begin(*state, many_guides, &walk);
    float* first = malloc(2 * (size_t)walk.strands * sizeof *first);
    float most = 0, farthest = 0;
    assert_non_null(first);
    measure_roots(&walk, first);
    float start = walk.positions[2];
    for (uint32_t frame = 1; frame <= 80; ++frame) { // The animation ends after 66.
        step(&walk, frame);
        if (frame % 16) continue;
        measure_roots(&walk, first + walk.strands);
        for (uint32_t i = 0; i < walk.strands; ++i) {
            farthest = fmaxf(farthest, first[walk.strands + i]);
            most = fmaxf(most, fabsf(first[walk.strands + i] - first[i]));
        }
    }
    float way = walk.positions[2] - start;
    print_message(
        "    roots moved %.2f m, were at most %.2f mm from the skin, and %.2f mm other than at first\n",
        (double)way, 1e3 * (double)farthest, 1e3 * (double)most);
    free(first);
    // 80 frames at 1.2 m/s, while the head nods.
    assert_float_equal(way, 1.2f * 80 / FPS, 0.15f);
    assert_true(farthest < 2.5e-3f && most < 1e-3f);
    end(&walk);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(strands_stay_outside_of_a_walking_and_nodding_body),
        HAIR_TEST(roots_follow_the_skin),
    };
    return hair_test_skips() ? 0 : cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
