// apply.cpp - impulses of hair on rigid bodies.
#include "lib/bullet/bullet.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <cmath>
#include <cstdlib>

namespace
{
// Collider of a body, by its key.
struct keyed {
    uint64_t key;
    uint32_t collider;
};
} // namespace

static int compare_keys(const void* a, const void* b)
{
    const uint64_t x = static_cast<const keyed*>(a)->key, y = static_cast<const keyed*>(b)->key;
    return (x > y) - (x < y);
}

// Return the body of a collider, or NULL if it is none that moves.
static btRigidBody* body_of(const hair_bullet* bullet, uint32_t collider)
{
    // The application lets this call move its bodies.
    btCollisionObject* object = const_cast<btCollisionObject*>(bullet->objects[collider]);
    btRigidBody* body = object ? btRigidBody::upcast(object) : nullptr;
    return body && body->getInvMass() > 0 ? body : nullptr;
}

static btVector3 load(const float v[3])
{
    return btVector3(v[0], v[1], v[2]);
}

static bool is_finite(const hair_collider_contact& contact)
{
    bool finite = true;
    for (int k = 0; k < 3; ++k)
        finite = finite && std::isfinite(contact.impulse[k]) && std::isfinite(contact.angular_impulse[k]);
    return finite;
}

// Apply the impulses of a contact to the body of a collider. The angular impulse is about the
// collider, and the body turns about its centre of mass.
static void push(btRigidBody* body, const hair_collider& collider, const hair_collider_contact& contact)
{
    const btVector3 impulse = load(contact.impulse), at = load(collider.position);
    body->applyCentralImpulse(impulse);
    body->applyTorqueImpulse(load(contact.angular_impulse) +
                             (at - body->getCenterOfMassPosition()).cross(impulse));
    body->activate();
}

hair_result hair_bullet_apply(hair_bullet* bullet, const hair_collider_contact* contacts, size_t stride,
                              uint32_t count)
{
    if (!bullet) return HAIR_ERROR_ARGUMENT;
    const hair_host* host = &bullet->host;
    if (!contacts && count) return hair_fail(host, HAIR_ERROR_ARGUMENT, "contacts is NULL");
    if (stride != sizeof *contacts)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "stride is %zu, not sizeof(hair_collider_contact)",
                         stride);
    for (uint32_t i = 0; i < count; ++i)
        if (!is_finite(contacts[i]))
            return hair_fail(host, HAIR_ERROR_ARGUMENT, "contacts[%u] is not finite", i);
    if (!count || !bullet->count) return HAIR_OK;
    keyed* all = static_cast<keyed*>(hair_alloc(host, bullet->count, sizeof *all));
    if (!all) return hair_fail_memory(host, "the keys of Bullet's colliders");
    for (uint32_t i = 0; i < bullet->count; ++i) all[i] = {bullet->colliders[i].key, i};
    std::qsort(all, bullet->count, sizeof *all, compare_keys);
    for (uint32_t i = 0; i < count; ++i) {
        const keyed wanted = {contacts[i].key, 0};
        const keyed* found =
            static_cast<const keyed*>(std::bsearch(&wanted, all, bullet->count, sizeof *all, compare_keys));
        btRigidBody* body = found ? body_of(bullet, found->collider) : nullptr;
        if (body) push(body, bullet->colliders[found->collider], contacts[i]);
    }
    hair_free(host, all);
    return HAIR_OK;
}
