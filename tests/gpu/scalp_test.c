// scalp_test.c - roots follow a scalp that the application skins, passed from memory or in a
// buffer.
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"
#include "tests/support/glstate.h"
#include "tests/support/grooms.h"

#define CELLS 4
#define VERTICES ((CELLS + 1) * (CELLS + 1))
#define SIDE 0.2f // Metres.
#define GUIDES 37 // Guides are at the scalp's vertices and between some of them.
#define FOLLOWERS 300
#define SEGMENTS 8
#define STEP (1.0f / 30)

struct skinned {
    hair_groom* groom;
    hair_instance* hair;
    float rest[3 * VERTICES], positions[3 * VERTICES]; // Vertices of the scalp.
};

// Evaluate a strand upwards from the level scalp, at a slant.
static hair_vec3 strand(float t, uint32_t number, const void* user)
{
    (void)user;
    uint32_t random = hair_hash(number);
    float step = SIDE / CELLS, x = SIDE * hair_random(&random), z = SIDE * hair_random(&random);
    hair_vec3 root = {x, 0, z};
    if (number < VERTICES)
        root = hair_v3(step * (float)(number % (CELLS + 1)), 0, step * (float)(number / (CELLS + 1)));
    return hair_add(root, hair_v3(0.03f * t, 0.12f * t, 0.04f * t * t));
}

static hair_groom* make_groom(struct hair_test* test, float* rest)
{
    struct hair_test_strands strands = hair_test_strands_make(GUIDES, 10);
    struct hair_test_scalp scalp = hair_test_scalp_make(CELLS, SIDE);
    for (uint32_t i = 0; i < GUIDES; ++i) hair_test_strands_add(&strands, 10, strand, NULL);
    hair_groom_desc desc = hair_test_groom_desc(&test->host, &strands);
    hair_test_set_scalp(&desc, &scalp);
    desc.follower_count = FOLLOWERS;
    hair_groom* groom = NULL;
    hair_test_ok(test, hair_groom_create(&desc, &groom));
    memcpy(rest, scalp.positions, 3 * VERTICES * sizeof *rest);
    hair_test_strands_free(&strands);
    hair_test_scalp_free(&scalp);
    return groom;
}

static struct skinned make_by(struct hair_test* test, hair_solver solver, hair_thread_mapping mapping)
{
    struct skinned s = {0};
    hair_desc desc = hair_desc_default();
    desc.thread_mapping = mapping;
    hair_look look = hair_look_default();
    look.strand.segments = SEGMENTS;
    // Rounding may decide whether a follower hits a collider.
    look.followers.collision = HAIR_FOLLOWER_COLLISION_NONE;
    desc.look = &look;
    desc.solver = solver;
    s.groom = make_groom(test, s.rest);
    hair_test_ok(test, hair_create(test->context, s.groom, &desc, &s.hair));
    hair_groom_destroy(s.groom); // An instance keeps what it needs of the groom.
    memcpy(s.positions, s.rest, sizeof s.positions);
    return s;
}

static struct skinned make(struct hair_test* test, hair_solver solver)
{
    return make_by(test, solver, HAIR_THREAD_MAPPING_AUTO);
}

static void drop(struct skinned* s)
{
    hair_destroy(s->hair);
}

static void give(struct hair_test* test, struct skinned* s)
{
    hair_test_ok(test, hair_set_scalp(s->hair, s->positions, VERTICES, 12, NULL));
}

#define MAX 8192
struct seen {
    float at[3 * MAX];
    uint32_t count;
};

static void look(struct hair_test* test, const struct skinned* s, hair_read_source what, struct seen* seen)
{
    hair_test_ok(test, hair_read_positions(s->hair, what, seen->at, MAX, &seen->count));
    assert_in_range(seen->count, 1, MAX);
    for (uint32_t i = 0; i < 3 * seen->count; ++i) assert_true(isfinite(seen->at[i]));
}

static double farthest(const struct seen* a, const struct seen* b)
{
    double max = 0;
    assert_int_equal(a->count, b->count);
    for (uint32_t i = 0; i < a->count; ++i)
        max = fmax(max, (double)hair_distance(hair_load3(a->at + 3 * i), hair_load3(b->at + 3 * i)));
    return max;
}

// Make a nod about an axis beside the scalp, and a walk.
static void pose_at(float time, float m[16])
{
    float turn = 0.5f * sinf(4 * time), c = cosf(turn), s = sinf(turn);
    float own[16] = {1, 0, 0, 0, 0, c, s, 0, 0, -s, c, 0, 0.3f * time, 0.05f * sinf(9 * time), 0, 1};
    memcpy(m, own, sizeof own);
}

static void carry(const float m[16], const float* from, float* out)
{
    for (int i = 0; i < VERTICES; ++i)
        for (int k = 0; k < 3; ++k)
            out[3 * i + k] =
                m[k] * from[3 * i] + m[4 + k] * from[3 * i + 1] + m[8 + k] * from[3 * i + 2] + m[12 + k];
}

// Maximum distance between both instances, in metres. In a step a head moves its origin along a
// line and rotates about the origin. Every root of a scalp moves along its own line. Both differ by
// at most r (1 - cos(half the rotation)). Here that is 0.2 m (1 - cos 0.034) = 0.12 mm in the
// middle of a step, and 0 at its ends. Hair with roots jerked by this distance is apart by a few
// times the distance.
#define CHORD 1e-3

static void rigidly_moved_scalp_equals_a_moved_head(void** state)
{
    static const hair_solver solvers[] = {HAIR_SOLVER_DIRECT, HAIR_SOLVER_ACCURATE, HAIR_SOLVER_FOLLOW,
                                          HAIR_SOLVER_REDBLACK};
    struct hair_test* test = *state;
    static struct seen a, b;
    for (int i = 0; i < 5; ++i) {
        hair_thread_mapping mapping =
            i == 4 ? HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE : HAIR_THREAD_MAPPING_AUTO;
        struct skinned head = make_by(test, solvers[i % 4], mapping),
                       scalp = make_by(test, solvers[i % 4], mapping);
        double max = 0, went = 0, apart[2] = {0};
        float time = 0;
        for (int frame = 1; frame <= 25; ++frame) {
            float m[16];
            float dt = frame % 5 == 4 ? 0.001f : STEP; // The step has several substeps, or none.
            time += dt;
            pose_at(time, m);
            hair_test_ok(test, hair_set_transform(head.hair, m));
            carry(m, scalp.rest, scalp.positions);
            give(test, &scalp);
            hair_test_ok(test, hair_step(head.hair, dt));
            hair_test_ok(test, hair_step(scalp.hair, dt));
            look(test, &head, HAIR_READ_FOLLOWERS, &a);
            look(test, &scalp, HAIR_READ_FOLLOWERS, &b);
            max = fmax(max, farthest(&a, &b));
            for (uint32_t k = 0; k < FOLLOWERS; ++k)
                apart[0] = fmax(apart[0], (double)hair_distance(hair_load3(a.at + 3 * k * (SEGMENTS + 1)),
                                                                hair_load3(b.at + 3 * k * (SEGMENTS + 1))));
            look(test, &head, HAIR_READ_GUIDES, &a);
            look(test, &scalp, HAIR_READ_GUIDES, &b);
            apart[1] = fmax(apart[1], farthest(&a, &b));
            if (frame == 1) continue;
            went = fmax(went, (double)hair_distance(hair_load3(a.at), hair_v3(0, 0, 0)));
        }
        print_message(
            "    way %d: followers within %.2g mm, their roots within %.2g mm, guides within %.2g mm\n", i,
            max * 1e3, apart[0] * 1e3, apart[1] * 1e3);
        assert_true(went > 0.2);
        assert_true(max < CHORD && apart[1] < CHORD);
        assert_true(apart[0] < 2e-6);
        drop(&head), drop(&scalp);
    }
}

// Check substeps that become longer and shorter, either between two substeps or at once. Some of
// them end before a step begins.
static void rigid_scalp_equals_a_head_when_substeps_change(void** state)
{
    static const float rates[] = {1, 0.25f, 0.5f, 1, 1, 0.0625f};
    struct hair_test* test = *state;
    static struct seen a, b;
    float time = 0;
    struct skinned head = make(test, HAIR_SOLVER_DIRECT), scalp = make(test, HAIR_SOLVER_DIRECT);
    hair_physics physics = hair_physics_default();
    double max[2] = {0};
    for (int frame = 1; frame <= 90; ++frame) {
        float m[16];
        physics.substep_rate = rates[frame / 5 % 6];
        // This change does not wait for the end of a substep.
        if (frame % 30 == 0) physics.fiber.youngs_modulus *= 1.1f;
        float dt = frame % 10 == 5 ? STEP : 1.0f / 250;
        time += dt;
        pose_at(time, m);
        carry(m, scalp.rest, scalp.positions);
        hair_test_ok(test, hair_set_transform(head.hair, m));
        give(test, &scalp);
        for (int i = 0; i < 2; ++i) {
            struct skinned* s = i ? &scalp : &head;
            hair_test_ok(test, hair_set_physics(s->hair, &physics));
            hair_test_ok(test, hair_step(s->hair, dt));
        }
        for (int i = 0; i < 2; ++i) {
            look(test, &head, i ? HAIR_READ_SMOOTH : HAIR_READ_GUIDES, &a);
            look(test, &scalp, i ? HAIR_READ_SMOOTH : HAIR_READ_GUIDES, &b);
            max[i] = fmax(max[i], farthest(&a, &b));
        }
    }
    print_message("    guides within %.2g mm, drawn within %.2g mm\n", max[0] * 1e3, max[1] * 1e3);
    assert_true(max[0] < CHORD && max[1] < CHORD);
    drop(&head), drop(&scalp);
}

// Check a scalp at rest, passed in the head's space. It changes nothing, with any collider.
// Followers are an exception, because the first segments of guides are slightly bent, and followers
// would leave the scalp by this distance.
static void scalp_at_rest_in_a_moving_head_changes_nothing(void** state)
{
    struct hair_test* test = *state;
    static struct seen a, b, c, d;
    double max[2] = {0};
    struct skinned head = make(test, HAIR_SOLVER_DIRECT), scalp = make(test, HAIR_SOLVER_DIRECT);
    hair_physics physics = hair_physics_default();
    hair_collider colliders[2] = {hair_collider_default(), hair_collider_default()};
    physics.hair_hair.cohesion = 5;
    colliders[0].size[0] = 0.04f;
    colliders[1].shape = HAIR_SHAPE_BOX;
    for (int i = 0; i < 2; ++i) {
        colliders[i].position[0] = 0.15f * (float)i, colliders[i].position[1] = 0.08f,
        colliders[i].position[2] = 0.1f;
        if (i) colliders[i].size[0] = colliders[i].size[1] = colliders[i].size[2] = 0.03f;
    }
    for (int frame = 1; frame <= 12; ++frame) {
        float m[16];
        pose_at(STEP * (float)frame, m);
        for (int i = 0; i < 2; ++i) {
            struct skinned* s = i ? &scalp : &head;
            hair_test_ok(test, hair_set_physics(s->hair, &physics));
            hair_test_ok(test, hair_set_colliders(s->hair, colliders, 2, sizeof *colliders));
            hair_test_ok(test, hair_set_transform(s->hair, m));
            if (i) hair_test_ok(test, hair_set_scalp(s->hair, s->rest, VERTICES, 12, m));
            hair_test_ok(test, hair_step(s->hair, STEP));
            look(test, s, HAIR_READ_GUIDES, i ? &b : &a);
            look(test, s, HAIR_READ_FOLLOWERS, i ? &d : &c);
        }
        max[0] = fmax(max[0], farthest(&a, &b)), max[1] = fmax(max[1], farthest(&c, &d));
    }
    print_message("    guides within %.2g mm, followers within %.2g mm\n", max[0] * 1e3, max[1] * 1e3);
    assert_true(max[0] < 1e-4 && max[1] < 4e-3);
    drop(&head), drop(&scalp);
}

// Check more colliders than a step's parameters hold. They are searched where the hair may be,
// which the head does not determine.
static void scalp_far_from_the_head_meets_colliders_there(void** state)
{
    struct hair_test* test = *state;
    static struct seen a, b, free;
    struct skinned near = make(test, HAIR_SOLVER_DIRECT), far = make(test, HAIR_SOLVER_DIRECT),
                   none = make(test, HAIR_SOLVER_DIRECT);
    hair_collider colliders[HAIR_STEP_COLLIDERS + 8];
    float m[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 4, 0, 0, 1};
    for (int at = 0; at < 2; ++at) {
        for (int i = 0; i < HAIR_STEP_COLLIDERS + 8; ++i) {
            colliders[i] = hair_collider_default();
            colliders[i].size[0] = 0.01f;
            colliders[i].position[0] = (float)(4 * at) + 0.025f * (float)(i % 9);
            colliders[i].position[1] = 0.08f;
            colliders[i].position[2] = 0.025f * (float)(i / 9);
        }
        struct skinned* s = at ? &far : &near;
        hair_test_ok(test,
                     hair_set_colliders(s->hair, colliders, HAIR_STEP_COLLIDERS + 8, sizeof *colliders));
        hair_test_ok(test, hair_set_scalp(s->hair, s->rest, VERTICES, 12, at ? m : NULL));
        hair_test_ok(test, hair_reset(s->hair));
    }
    for (int frame = 0; frame < 6; ++frame) {
        hair_test_ok(test, hair_step(near.hair, STEP));
        hair_test_ok(test, hair_step(far.hair, STEP));
        hair_test_ok(test, hair_step(none.hair, STEP));
    }
    look(test, &near, HAIR_READ_GUIDES, &a);
    look(test, &far, HAIR_READ_GUIDES, &b);
    look(test, &none, HAIR_READ_GUIDES, &free);
    for (uint32_t i = 0; i < b.count; ++i) b.at[3 * i] -= 4;
    print_message("    within %.2g mm of hair near the head, which colliders move by %.2g mm\n",
                  farthest(&a, &b) * 1e3, farthest(&a, &free) * 1e3);
    assert_true(farthest(&a, &free) > 0.02 && farthest(&a, &b) < 0.02);
    drop(&near), drop(&far), drop(&none);
}

static void stretch(const struct skinned* s, float by, float* out)
{
    for (int i = 0; i < 3 * VERTICES; ++i) out[i] = s->rest[i] * by;
}

// Check that roots move with the scalp, and that hair keeps its shape and direction.
static void stretched_scalp_takes_every_root_along(void** state)
{
    struct hair_test* test = *state;
    static struct seen rest[3], now[3];
    for (int redblack = 0; redblack < 2; ++redblack) {
        struct skinned s = make(test, redblack ? HAIR_SOLVER_REDBLACK : HAIR_SOLVER_DIRECT);
        for (int i = 0; i < 3; ++i) look(test, &s, (hair_read_source)i, &rest[i]);
        stretch(&s, 1.1f, s.positions);
        give(test, &s);
        hair_test_ok(test, hair_reset(s.hair));
        for (int stepped = 0; stepped < 2; ++stepped) {
            for (int i = 0; i < 3; ++i) look(test, &s, (hair_read_source)i, &now[i]);
            const uint32_t each[3] = {10, 2 * 9 + 1, SEGMENTS + 1};
            for (int i = 0; i < 3; ++i)
                for (uint32_t k = 0; k < now[i].count / each[i]; ++k)
                    for (uint32_t c = 0; c < 3; ++c)
                        hair_test_near("root", k, (double)now[i].at[3 * k * each[i] + c],
                                       1.1 * (double)rest[i].at[3 * k * each[i] + c], 1e-6);
            if (stepped) break;
            for (uint32_t k = 0; k < 3 * now[0].count; ++k) {
                uint32_t root = k / 30 * 30 + k % 3;
                hair_test_near("guide", k, (double)(now[0].at[k] - now[0].at[root]),
                               (double)(rest[0].at[k] - rest[0].at[root]), 1e-6);
            }
            for (int i = 0; i < 5; ++i) hair_test_ok(test, hair_step(s.hair, STEP));
        }
        drop(&s);
    }
}

// Move waves over the scalp.
static void bulge(struct skinned* s, float time)
{
    for (int i = 0; i < VERTICES; ++i) {
        s->positions[3 * i] = s->rest[3 * i] + 0.1f * time;
        s->positions[3 * i + 1] = 0.02f * sinf(20 * s->rest[3 * i] + 15 * s->rest[3 * i + 2] + 8 * time);
        s->positions[3 * i + 2] = s->rest[3 * i + 2] * (1 + 0.1f * sinf(5 * time));
    }
}

struct given {
    GLuint buffer;
    size_t offset, stride;
};

static struct given put_in_buffer(const struct skinned* s, size_t offset, size_t stride)
{
    struct given given = {0, offset, stride};
    size_t size = offset + stride * (VERTICES - 1) + 12;
    char* bytes = calloc(1, size);
    for (size_t i = 0; i < VERTICES; ++i) memcpy(bytes + offset + i * stride, s->positions + 3 * i, 12);
    glCreateBuffers(1, &given.buffer);
    glNamedBufferStorage(given.buffer, (GLsizeiptr)size, bytes, 0);
    free(bytes);
    return given;
}

static void scalp_from_a_buffer_equals_scalp_from_memory(void** state)
{
    struct hair_test* test = *state;
    static struct seen a, b;
    struct skinned memory = make(test, HAIR_SOLVER_DIRECT), buffer = make(test, HAIR_SOLVER_DIRECT);
    static const size_t layouts[3][2] = {{0, 12}, {20, 32}, {1028, 28}};
    for (int frame = 1; frame <= 9; ++frame) {
        bulge(&memory, STEP * (float)frame);
        give(test, &memory);
        memcpy(buffer.positions, memory.positions, sizeof memory.positions);
        struct given given = put_in_buffer(&buffer, layouts[frame % 3][0], layouts[frame % 3][1]);
        hair_test_ok(test,
                     hair_set_scalp_buffer(buffer.hair, given.buffer, given.offset, given.stride, NULL));
        glDeleteBuffers(1, &given.buffer); // The library has read the buffer.
        hair_test_ok(test, hair_step(memory.hair, STEP));
        hair_test_ok(test, hair_step(buffer.hair, STEP));
        look(test, &memory, HAIR_READ_GUIDES, &a);
        look(test, &buffer, HAIR_READ_GUIDES, &b);
        assert_memory_equal(a.at, b.at, 12 * a.count);
        look(test, &memory, HAIR_READ_FOLLOWERS, &a);
        look(test, &buffer, HAIR_READ_FOLLOWERS, &b);
        assert_memory_equal(a.at, b.at, 12 * a.count);
    }
    drop(&memory), drop(&buffer);
}

// Check that steps queued without waiting for the GPU equal steps with a wait after each. NVIDIA's
// driver let a new scalp overtake dispatches that had yet to read an earlier one.
static void scalps_of_queued_steps_do_not_overtake_each_other(void** state)
{
    struct hair_test* test = *state;
    static struct seen waited, queued;
    for (int kind = 0; kind < 2; ++kind) {
        struct skinned s[2] = {make(test, HAIR_SOLVER_DIRECT), make(test, HAIR_SOLVER_DIRECT)};
        for (int waits = 0; waits < 2; ++waits)
            for (int frame = 1; frame <= 8; ++frame) {
                bulge(&s[waits], STEP * (float)frame);
                struct given given = put_in_buffer(&s[waits], 0, 12);
                if (kind == 0)
                    give(test, &s[waits]);
                else
                    hair_test_ok(test, hair_set_scalp_buffer(s[waits].hair, given.buffer, 0, 12, NULL));
                glDeleteBuffers(1, &given.buffer);
                hair_test_ok(test, hair_step(s[waits].hair, STEP));
                if (waits) glFinish();
            }
        look(test, &s[0], HAIR_READ_FOLLOWERS, &queued);
        look(test, &s[1], HAIR_READ_FOLLOWERS, &waited);
        assert_memory_equal(queued.at, waited.at, 12 * waited.count);
        drop(&s[0]), drop(&s[1]);
    }
}

// Check a scalp that is passed in a moving space, far away or near. The head sees no difference.
static void scalp_far_from_the_origin_moves_hair_equally(void** state)
{
    struct hair_test* test = *state;
    static struct seen a, b;
    struct skinned near = make(test, HAIR_SOLVER_DIRECT), far = make(test, HAIR_SOLVER_DIRECT);
    float m[16] = {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 4096, -2048, 512, 1}, own[16];
    float away[16];
    memcpy(away, m, sizeof m);
    hair_physics physics = hair_physics_default();
    physics.gravity[1] = 0; // Gravity has a fixed direction in the world.
    hair_test_ok(test, hair_set_physics(near.hair, &physics));
    hair_test_ok(test, hair_set_physics(far.hair, &physics));
    hair_test_ok(test, hair_teleport(far.hair, m));
    for (int frame = 1; frame <= 8; ++frame) {
        if (frame == 5) {
            away[12] += 1024;
            hair_test_ok(test, hair_teleport(far.hair, away));
        }
        bulge(&near, STEP * (float)frame);
        give(test, &near);
        hair_test_ok(test, hair_set_scalp(far.hair, near.positions, VERTICES, 12, away));
        hair_test_ok(test, hair_step(near.hair, STEP));
        hair_test_ok(test, hair_step(far.hair, STEP));
    }
    look(test, &near, HAIR_READ_FOLLOWERS, &a);
    look(test, &far, HAIR_READ_FOLLOWERS, &b);
    // Moves positions back to the other instance. Floats at 5 km are spaced by 0.5 mm.
    for (uint32_t i = 0; i < b.count; ++i) {
        hair_vec3 p = hair_sub(hair_load3(b.at + 3 * i), hair_v3(away[12], away[13], away[14]));
        hair_store3(b.at + 3 * i, hair_v3(p.y, -p.x, p.z));
    }
    double apart = farthest(&a, &b);
    if (!(apart < 4e-3)) fail_msg("%g m apart", apart);
    memcpy(own, m, sizeof own);
    drop(&near), drop(&far);
}

// Check scalps that are not finite or degenerate. Hair on them stays where it is relative to the
// head, and the rest continues.
static void scalp_buffer_of_any_bytes_keeps_hair_finite(void** state)
{
    struct hair_test* test = *state;
    static struct seen seen, before;
    for (int redblack = 0; redblack < 2; ++redblack) {
        struct skinned s = make(test, redblack ? HAIR_SOLVER_REDBLACK : HAIR_SOLVER_DIRECT);
        for (int frame = 1; frame <= 12; ++frame) {
            bulge(&s, STEP * (float)frame);
            float* p = s.positions;
            if (frame % 4 == 1) p[7] = NAN, p[20] = INFINITY, p[33] = 3e38f;
            // Makes triangles that are points.
            if (frame % 4 == 2) memcpy(p + 3, p, 12), memcpy(p + 12, p, 12);
            if (frame % 4 == 3)
                // All on one line.
                for (int i = 0; i < VERTICES; ++i) p[3 * i + 1] = p[3 * i + 2] = p[3 * i];
            if (frame > 8)
                for (int i = 0; i < 3 * VERTICES; ++i) p[i] = frame % 2 ? NAN : -3e38f;
            struct given given = put_in_buffer(&s, 0, 12);
            hair_test_ok(test, hair_set_scalp_buffer(s.hair, given.buffer, given.offset, given.stride, NULL));
            glDeleteBuffers(1, &given.buffer);
            if (frame == 9) look(test, &s, HAIR_READ_GUIDES, &before);
            hair_test_ok(test, hair_step(s.hair, STEP));
            look(test, &s, HAIR_READ_GUIDES, &seen);
            look(test, &s, HAIR_READ_FOLLOWERS, &seen);
            if (frame == 6) hair_test_ok(test, hair_reset(s.hair));
        }
        look(test, &s, HAIR_READ_GUIDES, &seen);
        for (uint32_t k = 0; k < GUIDES; ++k) // The root is still where the last good scalp had it.
            assert_true(hair_distance(hair_load3(seen.at + 30 * k), hair_load3(before.at + 30 * k)) < 0.03f);
        drop(&s);
    }
}

static void invalid_scalp_is_refused_by_name_value_and_range(void** state)
{
    struct hair_test* test = *state;
    struct skinned s = make(test, HAIR_SOLVER_DIRECT);
    float m[16] = {2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    hair_instance* h = s.hair;
    float* p = s.positions;
    hair_result bad = HAIR_ERROR_ARGUMENT;
    assert_int_equal(hair_set_scalp(NULL, p, VERTICES, 12, NULL), bad);
    assert_int_equal(hair_set_scalp_buffer(NULL, 1, 0, 12, NULL), bad);
    hair_test_refused(test, hair_set_scalp(h, NULL, VERTICES, 12, NULL), bad, "positions is NULL");
    hair_test_refused(test, hair_set_scalp(h, p, 24, 12, NULL), bad,
                      "count is 24, not the 25 of the groom's scalp");
    hair_test_refused(test, hair_set_scalp(h, p, VERTICES, 8, NULL), bad,
                      "stride is 8, not a multiple of 4 in [12, 4096]");
    hair_test_refused(test, hair_set_scalp(h, p, VERTICES, 14, NULL), bad, "stride is 14");
    hair_test_refused(test, hair_set_scalp(h, p, VERTICES, 4100, NULL), bad, "stride is 4100");
    hair_test_refused(test, hair_set_scalp(h, p, VERTICES, 12, m), bad, "to_world is not a rigid motion");
    p[7] = NAN;
    hair_test_refused(test, hair_set_scalp(h, p, VERTICES, 12, NULL), bad, "positions: vertex 2 is (");
    p[7] = 0;
    struct given in = put_in_buffer(&s, 8, 16);
    GLuint of[2];
    glGenBuffers(2, of); // The names have no buffers yet.
    hair_test_refused(test, hair_set_scalp_buffer(h, 0, 0, 12, NULL), bad, "gl_buffer is 0, not a buffer");
    hair_test_refused(test, hair_set_scalp_buffer(h, of[0], 0, 12, NULL), bad, "not a buffer");
    hair_test_refused(test, hair_set_scalp_buffer(h, in.buffer, 8, 10, NULL), bad, "stride is 10");
    hair_test_refused(test, hair_set_scalp_buffer(h, in.buffer, 6, 16, NULL), bad,
                      "offset is 6, not a multiple of 4");
    hair_test_refused(test, hair_set_scalp_buffer(h, in.buffer, 12, 16, NULL), bad,
                      "404 bytes hold the 396 of the scalp");
    hair_test_refused(test, hair_set_scalp_buffer(h, in.buffer, SIZE_MAX - 3, 16, NULL), bad, "offset is");
    hair_test_ok(test, hair_set_scalp_buffer(h, in.buffer, 8, 16, NULL));
    GLuint mapped;
    glCreateBuffers(1, &mapped);
    glNamedBufferData(mapped, 4096, NULL, GL_STREAM_DRAW);
    assert_non_null(glMapNamedBuffer(mapped, GL_WRITE_ONLY));
    hair_test_refused(test, hair_set_scalp_buffer(h, mapped, 0, 12, NULL), bad, "is mapped");
    glUnmapNamedBuffer(mapped);
    glDeleteBuffers(1, &mapped);
    glDeleteBuffers(1, &in.buffer);
    glDeleteBuffers(2, of);
    drop(&s);
}

static void groom_without_a_scalp_refuses_skinning(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_strands strands = hair_test_fur(20);
    hair_groom_desc groom = hair_test_groom_desc(&test->host, &strands);
    hair_desc desc = hair_desc_default();
    hair_groom* plain = NULL;
    hair_instance* hair = NULL;
    float p[9] = {0};
    hair_test_ok(test, hair_groom_create(&groom, &plain));
    hair_test_ok(test, hair_create(test->context, plain, &desc, &hair));
    hair_test_refused(test, hair_set_scalp(hair, p, 3, 12, NULL), HAIR_ERROR_ARGUMENT,
                      "its groom has no scalp");
    hair_destroy(hair);
    hair_groom_destroy(plain);
    hair_test_strands_free(&strands);
}

static void run(struct hair_test* test, struct skinned* s, int from, int to)
{
    for (int frame = from; frame < to; ++frame) {
        bulge(s, STEP * (float)frame);
        give(test, s);
        hair_test_ok(test, hair_step(s->hair, frame % 3 ? STEP : 0.002f));
    }
}

// Save between a scalp and its step. Load into the same instance, another one, and one that has
// never had a scalp.
static void saved_run_with_a_scalp_continues_bit_for_bit(void** state)
{
    struct hair_test* test = *state;
    static struct seen straight[2], again[2];
    struct skinned s = make(test, HAIR_SOLVER_DIRECT);
    size_t size = 0, plain_size = 0;
    hair_test_ok(test, hair_save(s.hair, NULL, 0, &plain_size));
    char* plain = malloc(plain_size);
    hair_test_ok(test, hair_save(s.hair, plain, plain_size, &plain_size));
    run(test, &s, 1, 7);
    bulge(&s, 7 * STEP);
    give(test, &s);
    hair_test_ok(test, hair_save(s.hair, NULL, 0, &size));
    char* bytes = malloc(size);
    hair_test_ok(test, hair_save(s.hair, bytes, size, &size));
    for (int k = 0; k < 3; ++k) {
        struct skinned other = make(test, HAIR_SOLVER_DIRECT);
        struct skinned* in = k == 2 ? &other : &s;
        struct seen* to = k ? again : straight;
        if (k) hair_test_ok(test, hair_load(in->hair, bytes, size));
        hair_test_ok(test, hair_step(in->hair, STEP));
        look(test, in, HAIR_READ_FOLLOWERS, &to[0]);
        run(test, in, 8, 11);
        look(test, in, HAIR_READ_GUIDES, &to[1]);
        for (int i = 0; i < 2 && k; ++i)
            assert_memory_equal(again[i].at, straight[i].at, 12 * again[i].count);
        drop(&other);
    }
    // A state saved before there was a scalp has a scalp at rest.
    hair_test_ok(test, hair_load(s.hair, plain, plain_size));
    look(test, &s, HAIR_READ_FOLLOWERS, &straight[0]);
    struct skinned fresh = make(test, HAIR_SOLVER_DIRECT);
    look(test, &fresh, HAIR_READ_FOLLOWERS, &again[0]);
    assert_true(farthest(&straight[0], &again[0]) < 1e-6);
    drop(&fresh), drop(&s);
    free(bytes), free(plain);
}

static void skinned_scalp_changes_no_opengl_state(void** state)
{
    struct hair_test* test = *state;
    struct skinned s = make(test, HAIR_SOLVER_DIRECT);
    struct given in = put_in_buffer(&s, 0, 12);
    static struct hair_test_glstate before, after;
    static struct seen seen;
    hair_test_glstate_disturb();
    hair_test_glstate_read(&before);
    hair_test_ok(test, hair_set_scalp_buffer(s.hair, in.buffer, 0, 12, NULL));
    hair_test_ok(test, hair_step(s.hair, STEP));
    look(test, &s, HAIR_READ_FOLLOWERS, &seen);
    hair_test_glstate_read(&after);
    size_t other = hair_test_glstate_differ(&before, &after, 0);
    if (other < before.count) fail_msg("%s has changed", before.values[other].name);
    glDeleteBuffers(1, &in.buffer);
    drop(&s);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(rigidly_moved_scalp_equals_a_moved_head),
        HAIR_TEST(rigid_scalp_equals_a_head_when_substeps_change),
        HAIR_TEST(scalp_at_rest_in_a_moving_head_changes_nothing),
        HAIR_TEST(scalp_far_from_the_head_meets_colliders_there),
        HAIR_TEST(stretched_scalp_takes_every_root_along),
        HAIR_TEST(scalp_from_a_buffer_equals_scalp_from_memory),
        HAIR_TEST(scalps_of_queued_steps_do_not_overtake_each_other),
        HAIR_TEST(scalp_far_from_the_origin_moves_hair_equally),
        HAIR_TEST(scalp_buffer_of_any_bytes_keeps_hair_finite),
        HAIR_TEST(invalid_scalp_is_refused_by_name_value_and_range),
        HAIR_TEST(groom_without_a_scalp_refuses_skinning),
        HAIR_TEST(saved_run_with_a_scalp_continues_bit_for_bit),
        HAIR_TEST(skinned_scalp_changes_no_opengl_state),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
