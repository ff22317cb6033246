// bullet.cpp - public calls on Bullet's shapes, objects and worlds.
#include "lib/bullet/bullet.h"

#include <cmath>
#include <cstdlib>
#include <cstring>

#define ROUNDS 600 // as hair_bullet_clear() promises

hair_result hair_bullet_create(const hair_host* host, size_t scalar_size, hair_bullet** out)
{
    const hair_host own = hair_host_or_default(host);
    if (scalar_size != sizeof(btScalar))
        return hair_fail(
            &own, HAIR_ERROR_VERSION,
            "the program's btScalar is of %zu bytes, that of libhair_bullet of %zu: it is for another "
            "Bullet",
            scalar_size, sizeof(btScalar));
    if (!out) return hair_fail(&own, HAIR_ERROR_ARGUMENT, "out is NULL");
    hair_bullet* bullet = static_cast<hair_bullet*>(hair_alloc(&own, 1, sizeof *bullet));
    if (!bullet) return hair_fail_memory(&own, "Bullet's colliders");
    bullet->host = own;
    bullet->resolution = 64;
    *out = bullet;
    return HAIR_OK;
}

void hair_bullet_destroy(hair_bullet* bullet)
{
    if (!bullet) return;
    const hair_host host = bullet->host;
    for (uint32_t i = 0; i < bullet->cached_capacity; ++i)
        hair_collision_mesh_destroy(bullet->cached[i].mesh);
    hair_free(&host, bullet->cached);
    hair_free(&host, bullet->colliders);
    hair_free(&host, bullet->objects);
    hair_free(&host, bullet->hits);
    hair_free(&host, bullet);
}

hair_result hair_bullet_reserve(const hair_host* host, void** array, uint32_t* capacity, uint32_t count,
                                size_t size)
{
    HAIR_ASSERT(size > 0 && (*array || !*capacity));
    if (count <= *capacity) return HAIR_OK;
    const uint32_t max_value = count < 32 ? 32 : count + count / 2;
    void* grown = hair_alloc(host, max_value, size);
    if (!grown) return hair_fail_memory(host, "Bullet's colliders");
    if (*array) std::memcpy(grown, *array, *capacity * size);
    hair_free(host, *array);
    *array = grown;
    *capacity = max_value;
    return HAIR_OK;
}

hair_result hair_bullet_set_resolution(hair_bullet* bullet, uint32_t resolution)
{
    if (!bullet) return HAIR_ERROR_ARGUMENT;
    if (resolution < 8 || resolution > 256)
        return hair_fail(&bullet->host, HAIR_ERROR_ARGUMENT, "resolution is %u, not in [8, 256]", resolution);
    bullet->resolution = resolution;
    return HAIR_OK;
}

hair_result hair_bullet_clear(hair_bullet* bullet)
{
    if (!bullet) return HAIR_ERROR_ARGUMENT;
    bullet->count = 0;
    if (++bullet->round % 64 == 0) hair_bullet_free_old(bullet, ROUNDS, nullptr);
    return HAIR_OK;
}

hair_result hair_bullet_invalidate(hair_bullet* bullet, const btCollisionShape* shape)
{
    if (!bullet) return HAIR_ERROR_ARGUMENT;
    for (uint32_t i = 0; i < bullet->cached_capacity && !shape; ++i) bullet->cached[i].fingerprint = 0;
    if (shape) hair_bullet_free_old(bullet, UINT32_MAX, shape);
    return HAIR_OK;
}

const hair_collider* hair_bullet_colliders(const hair_bullet* bullet, uint32_t* count)
{
    if (count) *count = bullet ? bullet->count : 0;
    return bullet ? bullet->colliders : nullptr;
}

// Take a shape. On failure nothing of it stays in the list, unless failures are only warned about.
static hair_result add_all(hair_bullet* bullet, const btCollisionShape* shape, const hair_gather& context)
{
    const uint32_t before = bullet->count;
    bullet->visits = 0;
    hair_result result = hair_bullet_add(bullet, shape, context);
    HAIR_ASSERT(before <= bullet->count && bullet->count <= bullet->capacity);
    if (result && !context.log_once) bullet->count = before;
    return result;
}

hair_result hair_bullet_add_shape(hair_bullet* bullet, const btCollisionShape* shape,
                                  const float transform[16])
{
    if (!bullet) return HAIR_ERROR_ARGUMENT;
    if (!shape) return hair_fail(&bullet->host, HAIR_ERROR_ARGUMENT, "shape is NULL");
    hair_gather context = {btTransform::getIdentity(), 1, 0xcbf29ce484222325u, 0, false, nullptr};
    if (transform) context.transform.setFromOpenGLMatrix(transform);
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) {
            const btScalar off =
                context.transform.getBasis().getRow(i).dot(context.transform.getBasis().getRow(k)) - (i == k);
            if (!(std::fabs(off) <= btScalar(1e-3)))
                return hair_fail(&bullet->host, HAIR_ERROR_ARGUMENT,
                                 "transform is not a rigid motion to 1e-3");
        }
    context.key = hair_bullet_fingerprint(context.key, &bullet->count, sizeof bullet->count);
    return add_all(bullet, shape, context);
}

static hair_result gather_object(hair_bullet* bullet, const btCollisionObject* object, bool log_once)
{
    const btBroadphaseProxy* proxy = object->getBroadphaseHandle();
    const int unique = proxy ? proxy->m_uniqueId : 0;
    const btCollisionShape* shape = object->getCollisionShape();
    float friction = object->getFriction();
    hair_gather context = {
        object->getWorldTransform(), friction >= 0 ? std::fmin(friction, 100.0f) : 0, 0, 0, log_once, object};
    context.key = hair_bullet_fingerprint(0xcbf29ce484222325u, &object, sizeof object);
    context.key = hair_bullet_fingerprint(context.key, &unique, sizeof unique);
    if (!shape) return hair_fail(&bullet->host, HAIR_ERROR_ARGUMENT, "the object has no shape");
    return add_all(bullet, shape, context);
}

hair_result hair_bullet_add_object(hair_bullet* bullet, const btCollisionObject* object)
{
    if (!bullet) return HAIR_ERROR_ARGUMENT;
    if (!object) return hair_fail(&bullet->host, HAIR_ERROR_ARGUMENT, "object is NULL");
    return gather_object(bullet, object, false);
}

// Worlds ------------------------------------------------------------------------------------------

namespace
{
struct hits : btBroadphaseAabbCallback {
    hair_bullet* bullet = nullptr;
    hair_result result = HAIR_OK;
    btVector3 lower, upper;
    int groups = -1;

    // Collect an object. Return whether to go on.
    bool process(const btBroadphaseProxy* proxy) override
    {
        const btCollisionObject* object = static_cast<const btCollisionObject*>(proxy->m_clientObject);
        if (!(proxy->m_collisionFilterGroup & groups) || !object->getCollisionShape() ||
            !object->hasContactResponse())
            return true;
        // The boxes of the tree are larger than those of objects.
        btVector3 own_lower, own_upper;
        object->getCollisionShape()->getAabb(object->getWorldTransform(), own_lower, own_upper);
        if (!TestAabbAgainstAabb2(own_lower, own_upper, lower, upper)) return true;
        void* memory = bullet->hits;
        result = hair_bullet_reserve(&bullet->host, &memory, &bullet->hit_capacity, bullet->hit_count + 1,
                                     sizeof *bullet->hits);
        bullet->hits = static_cast<const void**>(memory);
        HAIR_ASSERT(result || bullet->hit_count < bullet->hit_capacity);
        if (!result) bullet->hits[bullet->hit_count++] = proxy;
        return !result;
    }
};
} // namespace

static int compare(const void* a, const void* b)
{
    const int x = (*static_cast<const btBroadphaseProxy* const*>(a))->m_uniqueId;
    const int y = (*static_cast<const btBroadphaseProxy* const*>(b))->m_uniqueId;
    return (x > y) - (x < y);
}

hair_result hair_bullet_add_world(hair_bullet* bullet, const btCollisionWorld* world, const float lower[3],
                                  const float upper[3], int groups)
{
    if (!bullet) return HAIR_ERROR_ARGUMENT;
    if (!world) return hair_fail(&bullet->host, HAIR_ERROR_ARGUMENT, "world is NULL");
    if (!lower || !upper) return hair_fail(&bullet->host, HAIR_ERROR_ARGUMENT, "bounds are NULL");
    for (int k = 0; k < 3; ++k)
        if (!(lower[k] <= upper[k]) || !std::isfinite(lower[k]) || !std::isfinite(upper[k]))
            return hair_fail(&bullet->host, HAIR_ERROR_ARGUMENT, "bounds are from %g to %g along axis %d",
                             static_cast<double>(lower[k]), static_cast<double>(upper[k]), k);
    hits found;
    found.bullet = bullet;
    found.groups = groups;
    found.lower = btVector3(lower[0], lower[1], lower[2]);
    found.upper = btVector3(upper[0], upper[1], upper[2]);
    bullet->hit_count = 0;
    // Bullet's broadphase is not const, but a test changes nothing in it.
    const_cast<btCollisionWorld*>(world)->getBroadphase()->aabbTest(found.lower, found.upper, found);
    if (found.result) return found.result;
    HAIR_ASSERT(bullet->hit_count <= bullet->hit_capacity);
    if (bullet->hit_count) std::qsort(bullet->hits, bullet->hit_count, sizeof *bullet->hits, compare);
    for (uint32_t i = 0; i < bullet->hit_count; ++i) {
        const btBroadphaseProxy* proxy = static_cast<const btBroadphaseProxy*>(bullet->hits[i]);
        hair_result result =
            gather_object(bullet, static_cast<const btCollisionObject*>(proxy->m_clientObject), true);
        if (result && result != HAIR_ERROR_ARGUMENT) return result;
    }
    return HAIR_OK;
}
