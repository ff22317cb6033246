// bullet_world.cpp - A curtain of hair among the objects of a Bullet world. The curtain is made of
// plain arrays.
//
//     bullet_world [FILE.ppm [WIDTH]]
#include "camera.h"
#include "common.h"
#include <btBulletCollisionCommon.h>
#include <hair/hair_bullet.h>
#include <hair/hair_egl.h>

enum { GUIDES = 100, VERTICES = 24 };

// Guides reach out horizontally from a line at a height of 1 m. Followers grow around them.
static hair_groom* make_curtain()
{
    static float positions[GUIDES * VERTICES][3];
    static uint32_t sizes[GUIDES];
    for (int i = 0; i < GUIDES; ++i) {
        sizes[i] = VERTICES;
        for (int k = 0; k < VERTICES; ++k) {
            positions[i * VERTICES + k][0] = 0.6f * (float(i) / (GUIDES - 1) - 0.5f);
            positions[i * VERTICES + k][1] = 1 + 0.005f * float(i % 3 - 1);
            positions[i * VERTICES + k][2] = 0.5f * float(k) / (VERTICES - 1);
        }
    }
    hair_groom* groom;
    hair_groom_desc desc = hair_groom_desc_default();
    desc.positions = positions[0];
    desc.strand_vertices = sizes;
    desc.strand_count = GUIDES;
    desc.strand_set = HAIR_STRAND_SET_GUIDES;
    desc.guide_vertices = VERTICES;
    desc.follower_count = 6000;
    desc.clump_radius = 0.012f;
    check(hair_groom_create(&desc, &groom));
    return groom;
}

static hair_instance* make_hair(hair_context* context)
{
    hair_instance* hair;
    hair_groom* groom = make_curtain();
    hair_physics physics = hair_physics_default();
    physics.shape.frequency_root = physics.shape.frequency_tip = 0;
    physics.shape.gravity_preload = 0; // The hair falls instead of keeping its shape.
    hair_look look = hair_look_default();
    check(hair_look_color(&look, HAIR_COLOR_AUBURN));
    look.strand.radius = 4e-4f;
    hair_desc desc = hair_desc_default();
    desc.physics = &physics;
    desc.look = &look;
    check(hair_create(context, groom, &desc, &hair));
    hair_groom_destroy(groom);
    return hair;
}

// Take the objects near the hair as its colliders, then advance the hair.
static void step(hair_instance* hair, hair_bullet* bullet, const btCollisionWorld* world)
{
    float lower[3], upper[3];
    uint32_t count;
    check(hair_get_bounds(hair, lower, upper));
    check(hair_bullet_clear(bullet));
    check(hair_bullet_add_world(bullet, world, lower, upper, -1));
    const hair_collider* colliders = hair_bullet_colliders(bullet, &count);
    check(hair_set_colliders(hair, colliders, count, sizeof *colliders));
    check(hair_step(hair, 1.0f / 60));
}

int main(int argc, char** argv)
{
    hair_egl* egl;
    hair_context* context;
    hair_bullet* bullet;
    hair_host host = {nullptr, nullptr, print_sentence, nullptr};
    check(hair_egl_create(&host, -1, &egl));
    hair_context_desc context_desc = hair_context_desc_default();
    context_desc.host = &host;
    context_desc.get_proc = hair_egl_get_proc;
    check(hair_context_create(&context_desc, &context));
    check(hair_bullet_create(&host, sizeof(btScalar), &bullet));
    hair_instance* hair = make_hair(context);

    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher(&configuration);
    btDbvtBroadphase broadphase;
    btCollisionWorld world(&dispatcher, &broadphase, &configuration);
    btSphereShape sphere(0.09f);
    btBoxShape box(btVector3(0.07f, 0.07f, 0.07f));
    btCollisionShape* shapes[2] = {&sphere, &box};
    btCollisionObject objects[2];
    for (int i = 0; i < 2; ++i) {
        objects[i].setCollisionShape(shapes[i]);
        objects[i].setFriction(3); // times hair_physics.collision.friction
        world.addCollisionObject(&objects[i]);
    }

    // The hair falls on both objects while they rise.
    for (int frame = 0; frame < 60; ++frame) {
        float y = 0.78f + 0.06f * fminf(float(frame) / 30, 1.0f);
        const btQuaternion turned(btVector3(0, 1, 0), 0.3f);
        objects[0].setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(-0.15f, y, 0.14f)));
        objects[1].setWorldTransform(btTransform(turned, btVector3(0.15f, y, 0.14f)));
        world.updateAabbs();
        step(hair, bullet, &world);
    }

    const float eye[3] = {0.9f, 1.25f, 1.6f}, target[3] = {0, 0.80f, 0.1f};
    camera camera = camera_perspective(eye, target, 0.36f, 4.0f / 3);
    picture picture = picture_begin(argc > 2 ? atoi(argv[2]) : 800);
    hair_view view = hair_view_default();
    memcpy(view.view, camera.view, sizeof view.view);
    memcpy(view.projection, camera.projection, sizeof view.projection);
    view.pass = HAIR_PASS_COLLIDERS; // The debug view of what hair collides with.
    check(hair_draw(hair, &view));
    view.pass = HAIR_PASS_COLOR;
    check(hair_draw(hair, &view));
    picture_end(&picture, argc > 1 ? argv[1] : "bullet_world.ppm");

    for (btCollisionObject& object : objects) world.removeCollisionObject(&object);
    hair_destroy(hair);
    hair_bullet_destroy(bullet);
    hair_context_destroy(context);
    hair_egl_destroy(egl);
    return EXIT_SUCCESS;
}
