// bullet.cpp - a program that takes the colliders of a Bullet world.
#include <btBulletCollisionCommon.h>
#include <hair/hair_bullet.h>

#include <cstdio>

int main()
{
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher(&configuration);
    btDbvtBroadphase broadphase;
    btCollisionWorld world(&dispatcher, &broadphase, &configuration);
    btBoxShape box(btVector3(1, 1, 1));
    btCollisionObject object;
    object.setCollisionShape(&box);
    world.addCollisionObject(&object);

    hair_bullet* bullet;
    if (hair_bullet_create(nullptr, sizeof(btScalar), &bullet)) return 1;
    const float lower[] = {0, 0, 0}, upper[] = {2, 2, 2};
    uint32_t count = 0;
    hair_bullet_clear(bullet);
    hair_bullet_add_world(bullet, &world, lower, upper, -1);
    const hair_collider* colliders = hair_bullet_colliders(bullet, &count);
    std::printf("%u collider, of shape %d\n", count, count ? static_cast<int>(colliders[0].shape) : -1);
    hair_bullet_destroy(bullet);
    world.removeCollisionObject(&object);
    return count != 1;
}
