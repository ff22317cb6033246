// motion.c - heads of hair with many random events, all from a seed.
#include "tests/support/motion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct hair_test_subject hair_test_subject_of(uint32_t kind)
{
    struct hair_test_subject subject = {.groom = hair_test_handmade_default(),
                                        .desc = hair_desc_default(),
                                        .physics = hair_physics_default(),
                                        .seed = 7919 * kind};
    subject.groom.seed = kind + 1;
    subject.desc.solver = (hair_solver)(kind % HAIR_TEST_SOLVERS);
    subject.desc.substep = 1.0f / 120;
    if (kind == 1) { // Guides of many lengths, in many short substeps.
        subject.groom.guides = 5, subject.groom.fewest = 4, subject.groom.max = 9;
        subject.desc.substep = 1.0f / 500;
        subject.physics.damping = 12, subject.physics.redblack.bend = 0.4f;
    }
    if (kind == 2) { // Long guides, each in a work group of 64.
        subject.groom.guides = 3, subject.groom.fewest = 40, subject.groom.max = 40;
        subject.groom.segment = 0.004f;
        subject.physics.gravity[0] = 3, subject.physics.redblack.iterations = 7;
    }
    if (kind == 3) // In the solver's own substeps.
        subject.desc.substep = 0, subject.hardens = 1;
    return subject;
}

hair_instance* hair_test_subject_make(struct hair_test* test, const struct hair_test_subject* subject)
{
    hair_instance* hair = NULL;
    hair_groom* groom = hair_test_groom(&test->host.host, subject->groom);
    hair_desc desc = subject->desc;
    hair_look look = hair_look_default();
    look.strand.segments = 8;
    desc.physics = &subject->physics;
    desc.look = &look;
    hair_test_ok(test, hair_create(test->context, groom, &desc, &hair));
    hair_groom_destroy(groom);
    return hair;
}

static hair_quat turn(float angle)
{
    hair_quat q = {0.3f * sinf(angle), sinf(angle), 0.2f, cosf(angle)};
    return hair_quat_normalize(q);
}

void hair_test_pose(float time, float transform[16])
{
    static const hair_vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    memset(transform, 0, 16 * sizeof *transform);
    for (int i = 0; i < 3; ++i) hair_store3(transform + 4 * i, hair_rotate(turn(0.4f * sinf(time)), axes[i]));
    hair_store3(transform + 12, hair_v3(0.1f * sinf(1.3f * time), 0.05f * cosf(time), 0.02f * time));
    transform[15] = 1;
}

void hair_test_set(struct hair_test* test, hair_instance* hair, const struct hair_test_subject* subject,
                   uint32_t i)
{
    hair_physics physics = subject->physics;
    if (subject->hardens && i / 6 % 2) physics.fiber.youngs_modulus *= 5, physics.damping += 1;
    hair_test_ok(test, hair_set_physics(hair, &physics));
}

// Apply the i-th event. Every third step continues with the current state.
void hair_test_move(struct hair_test* test, hair_instance* hair, const struct hair_test_subject* subject,
                    uint32_t i)
{
    float transform[16], time = 0.11f * (float)i + (float)subject->seed;
    hair_quat q = turn(time);
    hair_collider colliders[] = {{HAIR_SHAPE_SPHERE,
                                  {0.15f * cosf(2 * time), 0.1f, 0.15f * sinf(2 * time)},
                                  {0, 0, 0, 1},
                                  {0.08f, NAN},
                                  .scale = 1,
                                  .friction = 1},
                                 {HAIR_SHAPE_CAPSULE,
                                  {0.1f * sinf(time), 0.1f, 0},
                                  {q.x, q.y, q.z, q.w},
                                  {0.05f, 0.04f},
                                  .scale = 1,
                                  .friction = 1},
                                 {HAIR_SHAPE_SPHERE,
                                  {-0.1f, 0.2f * cosf(time), 0.1f},
                                  {0, 0, 0, 1},
                                  {0.07f, 0},
                                  .scale = 1,
                                  .friction = 1}};
    if (i % 6 == 0) hair_test_set(test, hair, subject, i);
    if (i % 3 == 2) return;
    hair_test_pose(time, transform);
    hair_test_ok(test, hair_set_transform(hair, transform));
    hair_test_ok(test, hair_set_colliders(hair, colliders, i / 2 % 4, sizeof *colliders));
    hair_test_pose(time + 2, transform);
    if (i % 13 == 12) hair_test_ok(test, hair_teleport(hair, transform));
    if (i % 29 == 28) hair_test_ok(test, hair_reset(hair));
}

void hair_test_step(struct hair_test* test, hair_instance* hair, const struct hair_test_subject* subject,
                    uint32_t i)
{
    uint32_t random = subject->seed + i;
    hair_test_ok(test, hair_step(hair, 0.0007f + (i % 4 ? 0.03f : 0.002f) * hair_random(&random)));
}

void hair_test_run(struct hair_test* test, hair_instance* hair, const struct hair_test_subject* subject,
                   uint32_t first, uint32_t end)
{
    for (uint32_t i = first; i < end; ++i) {
        hair_test_move(test, hair, subject, i);
        hair_test_step(test, hair, subject, i);
    }
}

static void look_at(GLuint buffer, struct hair_test_seen* out)
{
    GLint64 size = 0;
    if (!buffer) return;
    glGetNamedBufferParameteri64v(buffer, GL_BUFFER_SIZE, &size);
    assert_in_range(out->count + (size_t)size / 4, out->count, HAIR_TEST_SEEN);
    glGetNamedBufferSubData(buffer, 0, (GLsizeiptr)size, out->number + out->count);
    out->count += (size_t)size / 4;
}

void hair_test_look(struct hair_test* test, hair_instance* hair, struct hair_test_seen* out)
{
    out->count = 0;
    look_at(hair->sim.state, out);
    look_at(hair->sim.history, out);
    look_at(hair->sim.material, out);
    for (int what = 0; what <= HAIR_READ_FOLLOWERS; ++what) {
        uint32_t max = (uint32_t)(HAIR_TEST_SEEN - out->count) / 3, count;
        hair_test_ok(
            test, hair_read_positions(hair, (hair_read_source)what, out->number + out->count, max, &count));
        assert_in_range(count, 1, max);
        out->followers = 3 * (size_t)count;
        out->count += out->followers;
    }
}

void hair_test_same(const struct hair_test_seen* a, const struct hair_test_seen* b)
{
    assert_int_equal(a->count, b->count);
    assert_memory_equal(a->number, b->number, a->count * sizeof *a->number);
}

void hair_test_finite(const struct hair_test_seen* seen)
{
    for (size_t i = 0; i < seen->count; ++i)
        if (!isfinite(seen->number[i]))
            fail_msg("number %zu of %zu is %g", i, seen->count, (double)seen->number[i]);
}

struct hair_test_blob hair_test_save(struct hair_test* test, hair_instance* hair)
{
    struct hair_test_blob blob = {NULL, 0};
    hair_test_ok(test, hair_save(hair, NULL, 0, &blob.size));
    blob.bytes = malloc(blob.size);
    hair_test_ok(test, hair_save(hair, blob.bytes, blob.size, &blob.size));
    return blob;
}
