// bullet_world_test.cpp - objects and worlds of Bullet: selection, order, and cost.
#include "tests/support/bullet.h"

#include <chrono>
#include <vector>

struct world {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btCollisionWorld bullet{&dispatcher, &broadphase, &configuration};

    std::vector<btCollisionObject*> objects;

    btCollisionObject* add(btCollisionShape* shape, const btVector3& at, int group = 1)
    {
        btCollisionObject* object = new btCollisionObject;
        object->setCollisionShape(shape);
        object->setWorldTransform(btTransform(btQuaternion::getIdentity(), at));
        bullet.addCollisionObject(object, group, -1);
        objects.push_back(object);
        return object;
    }
    ~world()
    {
        for (btCollisionObject* object : objects) {
            bullet.removeCollisionObject(object);
            delete object;
        }
    }
};

static const float lower[] = {-0.5f, -0.5f, -0.5f}, upper[] = {0.5f, 0.5f, 0.5f};

static void take(const world& world, int groups)
{
    assert_int_equal(hair_bullet_clear(test.bullet), HAIR_OK);
    assert_int_equal(hair_bullet_add_world(test.bullet, &world.bullet, lower, upper, groups), HAIR_OK);
}

static void only_objects_that_touch_the_bounds_are_added(void**)
{
    world world;
    randoms random;
    btSphereShape ball(btScalar(0.1));
    uint32_t touching = 0;
    for (int i = 0; i < 2000; ++i) {
        const btVector3 at = random.vector(2);
        world.add(&ball, at);
        bool touches = true;
        for (int k = 0; k < 3; ++k) touches = touches && btFabs(at[k]) <= btScalar(0.6);
        touching += touches;
    }
    take(world, -1);
    colliders(touching);
    assert_true(touching > 20 && touching < 200);
}

// Check order and keys also if objects are added and removed, which reorders the world's own list.
static void keys_and_order_stay_when_objects_come_and_go(void**)
{
    world world;
    randoms random;
    btSphereShape ball(btScalar(0.1));
    btBoxShape box(btVector3(btScalar(0.1), btScalar(0.1), btScalar(0.1)));
    btCompoundShape both;
    both.addChildShape(btTransform::getIdentity(), &ball);
    both.addChildShape(btTransform::getIdentity(), &ball);
    for (int i = 0; i < 30; ++i)
        world.add(i % 3 ? static_cast<btCollisionShape*>(&box) : &both, random.vector(btScalar(0.4)));
    take(world, -1);
    const hair_collider* list = colliders(40);
    std::vector<hair_collider> before(list, list + 40);
    for (int i = 0; i < 40; ++i)
        for (int k = 0; k < i; ++k) assert_true(before[i].key != before[k].key);
    btCollisionObject* gone = world.objects[4];
    world.bullet.removeCollisionObject(gone);
    world.add(&ball, btVector3(0, 0, 0));
    world.bullet.updateAabbs();
    take(world, -1);
    list = colliders(40);
    uint32_t at = 0;
    for (const hair_collider& one : before) { // All except the removed object must be in order.
        bool is_gone = true;
        for (uint32_t i = 0; i < 40; ++i) is_gone = is_gone && list[i].key != one.key;
        if (is_gone) continue;
        assert_true(list[at].key == one.key);
        assert_memory_equal(&list[at], &one, sizeof one);
        ++at;
    }
    assert_int_equal(at, 39);
    assert_int_equal(list[39].shape, HAIR_SHAPE_SPHERE);
    world.bullet.addCollisionObject(gone);
}

static void groups_friction_and_contact_response_are_used(void**)
{
    world world;
    btSphereShape ball(btScalar(0.1));
    btCollisionObject* rough = world.add(&ball, btVector3(0, 0, 0), 1);
    btCollisionObject* ghost = world.add(&ball, btVector3(0, 0, 0), 1);
    world.add(&ball, btVector3(0, 0, 0), 64);
    rough->setFriction(btScalar(0.9));
    ghost->setCollisionFlags(ghost->getCollisionFlags() | btCollisionObject::CF_NO_CONTACT_RESPONSE);
    take(world, -1);
    assert_true(colliders(2)[0].friction == 0.9f);
    assert_true(colliders(2)[1].friction == 0.5f); // Bullet's default.
    take(world, 1);
    colliders(1);
    take(world, 64);
    colliders(1);
    rough->setFriction(-1);
    assert_int_equal(hair_bullet_add_object(test.bullet, rough), HAIR_OK);
    assert_true(colliders(2)[1].friction == 0);
}

static void collider_moves_with_its_bullet_object(void**)
{
    world world;
    randoms random;
    btBoxShape box(btVector3(btScalar(0.1), btScalar(0.2), btScalar(0.1)));
    btCollisionObject* object = world.add(&box, btVector3(0, 0, 0));
    for (int i = 0; i < 20; ++i) {
        object->setWorldTransform(random.transform(btScalar(0.4)));
        world.bullet.updateAabbs();
        take(world, -1);
        const hair_collider* collider = colliders(1);
        const btTransform& where = object->getWorldTransform();
        const btQuaternion q(collider->rotation[0], collider->rotation[1], collider->rotation[2],
                             collider->rotation[3]);
        for (int k = 0; k < 3; ++k) assert_true(collider->position[k] == where.getOrigin()[k]);
        assert_true(std::fabs(q.dot(where.getRotation())) > 1 - 1e-6f);
    }
}

struct soft : btSphereShape {
    soft() : btSphereShape(btScalar(0.1)) { m_shapeType = SOFTBODY_SHAPE_PROXYTYPE; }
};

// Check that a warning is logged once, and that the rest of the world still counts.
static void unsupported_objects_are_skipped_with_one_warning(void**)
{
    world world;
    soft body;
    btSphereShape ball(btScalar(0.1));
    world.add(&body, btVector3(0, 0, 0));
    btCollisionObject* other = world.add(&ball, btVector3(0, 0, 0));
    for (int i = 0; i < 5; ++i) {
        take(world, -1);
        colliders(1);
    }
    assert_int_equal(test.host.warnings, 1);
    other->setWorldTransform(
        btTransform(btQuaternion::getIdentity(), btVector3(0, btScalar(0.1), btScalar(NAN))));
    assert_int_equal(hair_bullet_add_object(test.bullet, other), HAIR_ERROR_ARGUMENT);
    assert_non_null(std::strstr(test.host.sentence, "has no place that is finite"));
    test.host.errors = 0;
}

static void invalid_arguments_of_bullet_calls_are_refused(void**)
{
    world world;
    hair_bullet* other = nullptr;
    btCollisionObject bare;
    const float nan[] = {0, NAN, 0}, min_value[] = {1, 1, 1}, far[] = {0, INFINITY, 0};
    const size_t wrong = sizeof(btScalar) == 4 ? 8 : 4;
    assert_int_equal(hair_bullet_create(&test.host.host, wrong, &other), HAIR_ERROR_VERSION);
    assert_non_null(std::strstr(test.host.sentence, "btScalar is of 8 bytes, that of libhair_bullet of 4"));
    assert_null(other);
    assert_int_equal(hair_bullet_create(&test.host.host, sizeof(btScalar), nullptr), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_bullet_add_object(test.bullet, nullptr), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_bullet_add_object(test.bullet, &bare), HAIR_ERROR_ARGUMENT);
    assert_non_null(std::strstr(test.host.sentence, "the object has no shape"));
    assert_int_equal(hair_bullet_add_world(test.bullet, nullptr, lower, upper, -1), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_bullet_add_world(test.bullet, &world.bullet, nullptr, upper, -1),
                     HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_bullet_add_world(test.bullet, &world.bullet, nan, upper, -1), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_bullet_add_world(test.bullet, &world.bullet, min_value, upper, -1),
                     HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_bullet_add_world(test.bullet, &world.bullet, lower, far, -1), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_bullet_set_resolution(test.bullet, 7), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_bullet_set_resolution(test.bullet, 257), HAIR_ERROR_ARGUMENT);
    assert_int_equal(test.host.errors, 11);
    assert_int_equal(hair_bullet_clear(nullptr), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_bullet_invalidate(nullptr, nullptr), HAIR_ERROR_ARGUMENT);
    assert_null(hair_bullet_colliders(nullptr, nullptr));
    hair_bullet_destroy(nullptr);
    test.host.errors = 0;
}

static const btScalar corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};

static void mesh_of_a_shape_is_cached_until_invalidated(void**)
{
    btConvexHullShape hull(corners, 5, 3 * sizeof(btScalar));
    assert_int_equal(hair_bullet_set_resolution(test.bullet, 8), HAIR_OK);
    auto take_hull = [&hull] {
        assert_int_equal(hair_bullet_clear(test.bullet), HAIR_OK);
        assert_int_equal(hair_bullet_add_shape(test.bullet, &hull, nullptr), HAIR_OK);
        return colliders(1)[0].mesh;
    };
    const hair_collision_mesh* collision_mesh = take_hull();
    const uint32_t blocks = test.host.blocks, made = test.host.allocations;
    assert_ptr_equal(take_hull(), collision_mesh);
    assert_true(test.host.allocations - made < 10); // Only its points were allocated.
    hull.setLocalScaling(btVector3(2, 2, 2));
    take_hull();
    assert_int_equal(test.host.blocks, blocks); // The other mesh has been freed.
    hair_collision_mesh_info info = hair_collision_mesh_info_default();
    hair_collision_mesh_describe(colliders(1)[0].mesh, &info);
    assert_true(info.upper[0] > 1.9f);
    hair_bullet_invalidate(test.bullet, &hull);
    assert_true(test.host.blocks < blocks);
    take_hull();
    for (int i = 0; i < 700; ++i) hair_bullet_clear(test.bullet);
    assert_true(test.host.blocks < blocks);
}

static void refused_allocations_of_bullet_calls_are_errors(void**)
{
    world world;
    btConvexHullShape hull(corners, 5, 3 * sizeof(btScalar));
    btSphereShape ball(btScalar(0.1));
    world.add(&hull, btVector3(0, 0, 0));
    for (int i = 0; i < 40; ++i) world.add(&ball, btVector3(0, 0, 0));
    uint32_t n = 0, refusals = 0;
    for (bool goes_on = true; goes_on;) {
        hair_bullet* bullet = nullptr;
        test.host.allocations = 0;
        test.host.refuse = ++n;
        hair_result result = hair_bullet_create(&test.host.host, sizeof(btScalar), &bullet);
        const uint32_t blocks = test.host.blocks;
        if (!result) hair_bullet_set_resolution(bullet, 8);
        if (!result) result = hair_bullet_add_world(bullet, &world.bullet, lower, upper, -1);
        assert_true(result == HAIR_OK || result == HAIR_ERROR_MEMORY);
        refusals += result == HAIR_ERROR_MEMORY;
        goes_on = test.host.allocations >= n;
        test.host.refuse = 0;
        if (bullet) { // The next call succeeds.
            uint32_t count = 0;
            hair_bullet_clear(bullet);
            assert_int_equal(hair_bullet_add_world(bullet, &world.bullet, lower, upper, -1), HAIR_OK);
            hair_bullet_colliders(bullet, &count);
            assert_int_equal(count, 41);
        }
        hair_bullet_destroy(bullet);
        assert_true(blocks >= test.host.blocks);
    }
    print_message("    %u refusals\n", refusals);
    assert_true(refusals > 15);
    test.host.errors = 0;
}

// Return the minimum time of many runs, so that load of the machine has little effect.
static double cost(const world& world)
{
    double min_value = INFINITY;
    for (int round = 0; round < 50; ++round) {
        const auto begun = std::chrono::steady_clock::now();
        for (int i = 0; i < 100; ++i) take(world, -1);
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begun;
        min_value = std::fmin(min_value, passed.count() / 100);
    }
    return min_value;
}

static void cost_is_that_of_the_touching_objects_only(void**)
{
    world few, many;
    randoms random;
    btSphereShape ball(btScalar(0.1));
    for (int i = 0; i < 12; ++i) {
        const btVector3 at = random.vector(btScalar(0.4));
        few.add(&ball, at);
        many.add(&ball, at);
    }
    for (int i = 12; i < 10000; ++i) {
        btVector3 at;
        do at = random.vector(20);
        while (at.length2() < 4);
        many.add(&ball, at);
    }
    const double alone = cost(few), among = cost(many);
    colliders(12);
    print_message("    12 alone %.2f us, among 10,000 %.2f us: %.2f times\n", 1e6 * alone, 1e6 * among,
                  among / alone);
    assert_true(among < 3 * alone);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(only_objects_that_touch_the_bounds_are_added),
        TEST(keys_and_order_stay_when_objects_come_and_go),
        TEST(groups_friction_and_contact_response_are_used),
        TEST(collider_moves_with_its_bullet_object),
        TEST(unsupported_objects_are_skipped_with_one_warning),
        TEST(invalid_arguments_of_bullet_calls_are_refused),
        TEST(mesh_of_a_shape_is_cached_until_invalidated),
        TEST(refused_allocations_of_bullet_calls_are_errors),
        TEST(cost_is_that_of_the_touching_objects_only),
    };
    return cmocka_run_group_tests(tests, nullptr, nullptr);
}
