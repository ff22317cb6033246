// bullet_contacts_test.cpp - rigid bodies of Bullet that hair pushes: momentum, and a ball that
// lies on long hair.
#include "tests/support/bullet.h"

#include <btBulletDynamicsCommon.h>
#include <hair/hair_egl.h>

#include <vector>

extern "C" int hair_test_skips(void);

#define VERTICES 16
#define LENGTH 0.3f
#define FRAME (1.0f / 60)
#define STRANDS 300.0f // Strands whose mass a guide has.

// A world with a ball, and strands along x around the origin. Their roots are at one end.
struct tuft {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
    btSphereShape shape{btScalar(0.03)};
    btRigidBody* ball = nullptr;
    hair_egl* egl = nullptr;
    hair_context* context = nullptr;
    hair_groom* groom = nullptr;
    hair_instance* hair = nullptr;
    hair_physics physics = hair_physics_default();
    uint32_t guides;

    tuft(uint32_t count, float mass, const btVector3& at, const btVector3& velocity, bool floats)
        : guides(count)
    {
        const btScalar inertia = btScalar(0.4) * mass * btScalar(0.03 * 0.03);
        const btScalar gravity = btScalar(floats ? 0 : -9.81);
        ball = new btRigidBody(mass, nullptr, &shape, btVector3(inertia, inertia, inertia));
        ball->setWorldTransform(btTransform(btQuaternion::getIdentity(), at));
        ball->setLinearVelocity(velocity);
        world.setGravity(btVector3(0, gravity, 0));
        world.addRigidBody(ball);
        // Hair that lies keeps its groom, and hair that floats does not.
        physics.shape.frequency_root = physics.shape.frequency_tip = floats ? 0 : 8;
        if (floats) physics.shape.gravity_preload = 0;
        if (floats) physics.root = HAIR_ROOT_FREE, physics.gravity[1] = 0, physics.damping = 0;
        grow();
    }
    ~tuft()
    {
        hair_destroy(hair);
        hair_groom_destroy(groom);
        hair_context_destroy(context);
        hair_egl_destroy(egl);
        world.removeRigidBody(ball);
        delete ball;
    }

    // Make strands along x, side by side.
    void grow()
    {
        std::vector<float> positions;
        std::vector<uint32_t> sizes(guides, VERTICES);
        for (uint32_t g = 0; g < guides; ++g)
            for (int i = 0; i < VERTICES; ++i) {
                positions.push_back(LENGTH * (float(i) / (VERTICES - 1) - 0.5f));
                positions.push_back(0);
                positions.push_back(guides > 1 ? 0.05f * (float(g) / float(guides - 1) - 0.5f) : 0.001f);
            }
        hair_groom_desc desc = hair_groom_desc_default();
        desc.host = &test.host.host;
        desc.positions = positions.data(), desc.strand_vertices = sizes.data();
        desc.strand_count = guides, desc.strand_set = HAIR_STRAND_SET_GUIDES;
        desc.guide_vertices = VERTICES, desc.follower_count = guides;
        hair_context_desc own = hair_context_desc_default();
        hair_desc of = hair_desc_default();
        own.host = &test.host.host, own.get_proc = hair_egl_get_proc;
        of.physics = &physics, of.thread_mapping = HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE;
        assert_int_equal(hair_egl_create(&test.host.host, -1, &egl), HAIR_OK);
        assert_int_equal(hair_context_create(&own, &context), HAIR_OK);
        assert_int_equal(hair_groom_create(&desc, &groom), HAIR_OK);
        assert_int_equal(hair_create(context, groom, &of, &hair), HAIR_OK);
        assert_int_equal(hair_record_contacts(hair, STRANDS), HAIR_OK);
    }

    // Step ball and hair. Return the impulse of the hair on the ball.
    btVector3 step()
    {
        uint32_t count = 0;
        hair_collider_contact contact;
        world.stepSimulation(FRAME, 0);
        assert_int_equal(hair_bullet_clear(test.bullet), HAIR_OK);
        assert_int_equal(hair_bullet_add_object(test.bullet, ball), HAIR_OK);
        const hair_collider* list = colliders(1);
        assert_int_equal(hair_set_colliders(hair, list, 1, sizeof *list), HAIR_OK);
        assert_int_equal(hair_step(hair, FRAME), HAIR_OK);
        assert_int_equal(hair_get_contacts(hair, true, &contact, sizeof contact, 1, &count), HAIR_OK);
        assert_int_equal(hair_bullet_apply(test.bullet, &contact, sizeof contact, count), HAIR_OK);
        return count ? btVector3(contact.impulse[0], contact.impulse[1], contact.impulse[2])
                     : btVector3(0, 0, 0);
    }

    // Return the centre of mass of the first guide.
    btVector3 center()
    {
        float at[3 * VERTICES];
        uint32_t count;
        assert_int_equal(hair_read_positions(hair, HAIR_READ_GUIDES, at, VERTICES, &count), HAIR_OK);
        btVector3 sum(0, 0, 0);
        for (int i = 0; i < VERTICES; ++i)
            sum += btVector3(at[3 * i], at[3 * i + 1], at[3 * i + 2]) *
                   btScalar(i == 0 || i + 1 == VERTICES ? 0.5 : 1);
        return sum / btScalar(VERTICES - 1);
    }

    btScalar mass_of_guide() const
    {
        const btScalar radius = physics.fiber.radius;
        return SIMD_PI * radius * radius * physics.fiber.density * STRANDS * LENGTH;
    }
};

// Let a ball of a few times the mass strike a strand that floats.
static void ball_and_strand_keep_their_momentum(void**)
{
    tuft all(1, 3e-3f, btVector3(btScalar(0.02), btScalar(-0.06), 0), btVector3(0, btScalar(0.5), 0), true);
    const btVector3 before = all.ball->getLinearVelocity() * btScalar(3e-3);
    for (int i = 0; i < 40; ++i) all.step();
    const btVector3 from = all.center();
    const btVector3 ball = all.ball->getLinearVelocity() * btScalar(3e-3);
    btVector3 left(0, 0, 0);
    for (int i = 0; i < 6; ++i) left += all.step();
    const btVector3 strand = (all.center() - from) * (all.mass_of_guide() / (6 * btScalar(FRAME)));
    print_message("    the ball keeps %.3f of its momentum, the strand has %.3f, %.3f %% are lost\n",
                  double(ball.y() / before.y()), double(strand.y() / before.y()),
                  double(100 * (1 - (ball.y() + strand.y()) / before.y())));
    assert_true(left.length() == 0); // They have parted.
    assert_true(strand.y() > btScalar(0.05) * before.y());
    assert_true((ball + strand - before).length() < btScalar(0.01) * before.length());
}

static void light_ball_lies_on_long_hair(void**)
{
    const float mass = 2e-3f;
    tuft all(12, mass, btVector3(0, btScalar(0.031), 0), btVector3(0, 0, 0), false);
    // The ball does not roll off the edge of the hair.
    all.ball->setLinearFactor(btVector3(0, 1, 0));
    btVector3 sum(0, 0, 0);
    for (int i = 0; i < 150; ++i) all.step();
    const btScalar height = all.ball->getWorldTransform().getOrigin().y();
    for (int i = 0; i < 60; ++i) sum += all.step();
    const btScalar moved = all.ball->getWorldTransform().getOrigin().y() - height;
    const double force = double(sum.y()), weight = 9.81 * double(mass);
    print_message(
        "    the ball lies at %.4f m, moves by %.5f m in a second, and is held by %.4f of its weight\n",
        double(height), double(moved), force / weight);
    assert_true(height > btScalar(-0.1) && btFabs(moved) < btScalar(1e-3));
    assert_true(std::fabs(force / weight - 1) < 0.01);
}

static void wrong_contacts_are_refused_and_strange_ones_ignored(void**)
{
    btSphereShape shape(btScalar(0.1));
    btRigidBody body(1, nullptr, &shape, btVector3(1, 1, 1));
    btCollisionObject object;
    object.setCollisionShape(&shape);
    hair_collider_contact contact = {};
    contact.impulse[0] = 3;
    assert_int_equal(hair_bullet_apply(nullptr, &contact, sizeof contact, 1), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_bullet_apply(test.bullet, &contact, sizeof contact, 1), HAIR_OK);
    assert_int_equal(hair_bullet_add_object(test.bullet, &object), HAIR_OK);
    take(shape, btTransform::getIdentity());
    assert_int_equal(hair_bullet_add_object(test.bullet, &object), HAIR_OK);
    assert_int_equal(hair_bullet_add_object(test.bullet, &body), HAIR_OK);
    const hair_collider* list = colliders(3);
    for (int i = 0; i < 3; ++i) {
        contact.key = list[i].key;
        assert_int_equal(hair_bullet_apply(test.bullet, &contact, sizeof contact, 1), HAIR_OK);
        assert_true(body.getLinearVelocity().x() == btScalar(i == 2 ? 3 : 0));
    }
    assert_int_equal(test.host.errors, 0);
    contact.angular_impulse[1] = NAN;
    assert_int_equal(hair_bullet_apply(test.bullet, &contact, sizeof contact, 1), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_bullet_apply(test.bullet, &contact, 8, 1), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_bullet_apply(test.bullet, nullptr, sizeof contact, 1), HAIR_ERROR_ARGUMENT);
    assert_true(body.getLinearVelocity().x() == btScalar(3));
    assert_int_equal(test.host.errors, 3);
    test.host.errors = 0;
}

int main()
{
    if (hair_test_skips()) return 0;
    const CMUnitTest tests[] = {
        TEST(ball_and_strand_keep_their_momentum),
        TEST(light_ball_lies_on_long_hair),
        TEST(wrong_contacts_are_refused_and_strange_ones_ignored),
    };
    return cmocka_run_group_tests(tests, nullptr, nullptr);
}
