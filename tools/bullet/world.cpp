// world.cpp - Objects of a scene in a world of Bullet.
#include <btBulletCollisionCommon.h>
#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <hair/hair_bullet.h>

#include <algorithm>
#include <memory>
#include <vector>

extern "C" {
#include "tools/bullet/world.h"
#include "tools/common/file.h"
}

struct hair_world {
    const char* tool;
    const hair_scene* scene;
    hair_bullet* bullet = nullptr;

    std::vector<std::unique_ptr<btStridingMeshInterface>> meshes;
    std::vector<std::unique_ptr<btCollisionShape>> shapes;
    std::vector<std::unique_ptr<btCollisionObject>> objects;
    std::vector<uint32_t> moving; // indices of objects that move

    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btCollisionWorld world{&dispatcher, &broadphase, &configuration};

    ~hair_world()
    {
        for (auto& object : objects) world.removeCollisionObject(object.get());
        hair_bullet_destroy(bullet);
    }
};

// Shapes ------------------------------------------------------------------------------------------

static btVector3 vector(const float* v)
{
    return btVector3(v[0], v[1], v[2]);
}

static btTransform pose(const float position[3], const float rotation[4])
{
    const btQuaternion turn(rotation[0], rotation[1], rotation[2], rotation[3]);
    return btTransform(turn.normalized(), vector(position));
}

// Create one of three shapes that differ by their axis.
template <class X, class Y, class Z, class... A> static btCollisionShape* along(uint32_t axis, A... a)
{
    if (axis == 0) return new X(a...);
    if (axis == 1) return new Y(a...);
    return new Z(a...);
}

static btVector3 cylinder_size(const hair_bullet_shape& from)
{
    btVector3 size(from.radius, from.radius, from.radius);
    size[static_cast<int>(from.axis)] = from.half_length;
    return size;
}

static btCollisionShape* make_hull(const hair_bullet_shape& from)
{
    btConvexHullShape* hull = new btConvexHullShape;
    const float* points = from.points.values ? from.points.values : from.mesh.positions;
    const uint32_t count = from.points.values ? from.points.rows : from.mesh.vertex_count;
    for (uint32_t i = 0; i < count; ++i) hull->addPoint(vector(points + 3 * size_t(i)), false);
    hull->recalcLocalAabb();
    return hull;
}

static btCollisionShape* make_spheres(const hair_bullet_shape& from)
{
    std::vector<btVector3> centres;
    std::vector<btScalar> radii;
    for (uint32_t i = 0; i < from.spheres.rows; ++i) {
        centres.push_back(vector(from.spheres.values + 4 * i));
        radii.push_back(from.spheres.values[4 * i + 3]);
    }
    return new btMultiSphereShape(centres.data(), radii.data(), static_cast<int>(centres.size()));
}

// Create a triangle mesh. Bullet reads the vertices from the scene's memory.
static btCollisionShape* make_mesh(hair_world* world, const hair_bullet_shape& from)
{
    btIndexedMesh mesh;
    mesh.m_numTriangles = static_cast<int>(from.mesh.triangle_count);
    mesh.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(from.mesh.triangles);
    mesh.m_triangleIndexStride = 3 * sizeof(uint32_t);
    mesh.m_numVertices = static_cast<int>(from.mesh.vertex_count);
    mesh.m_vertexBase = reinterpret_cast<const unsigned char*>(from.mesh.positions);
    mesh.m_vertexStride = 3 * sizeof(float);
    mesh.m_vertexType = PHY_FLOAT;
    auto array = std::make_unique<btTriangleIndexVertexArray>();
    array->addIndexedMesh(mesh, PHY_INTEGER);
    btCollisionShape* shape = new btBvhTriangleMeshShape(array.get(), true);
    world->meshes.push_back(std::move(array));
    return shape;
}

static btCollisionShape* make_height_field(const hair_bullet_shape& from)
{
    const hair_bullet_table& table = from.heights;
    const auto range = std::minmax_element(table.values, table.values + size_t(table.rows) * table.columns);
    return new btHeightfieldTerrainShape(static_cast<int>(table.columns), static_cast<int>(table.rows),
                                         table.values, 1, *range.first, *range.second,
                                         static_cast<int>(from.axis), PHY_FLOAT, false);
}

static btCollisionShape* make_shape(hair_world* world, const hair_bullet_shape& from);

static btCollisionShape* make_compound(hair_world* world, const hair_bullet_shape& from)
{
    btCompoundShape* compound = new btCompoundShape;
    for (uint32_t i = 0; i < from.child_count; ++i) {
        const hair_bullet_shape& child = from.children[i];
        compound->addChildShape(pose(child.position, child.rotation), make_shape(world, child));
    }
    return compound;
}

static btCollisionShape* make_kind(hair_world* world, const hair_bullet_shape& from)
{
    switch (from.kind) {
    case HAIR_BULLET_SPHERE: return new btSphereShape(from.radius);
    case HAIR_BULLET_BOX: return new btBoxShape(vector(from.size));
    case HAIR_BULLET_CAPSULE:
        return along<btCapsuleShapeX, btCapsuleShape, btCapsuleShapeZ>(from.axis, from.radius,
                                                                       2 * from.half_length);
    case HAIR_BULLET_CYLINDER:
        return along<btCylinderShapeX, btCylinderShape, btCylinderShapeZ>(from.axis, cylinder_size(from));
    case HAIR_BULLET_CONE:
        return along<btConeShapeX, btConeShape, btConeShapeZ>(from.axis, from.radius, 2 * from.half_length);
    case HAIR_BULLET_PLANE: return new btStaticPlaneShape(vector(from.normal).normalized(), from.distance);
    case HAIR_BULLET_HULL: return make_hull(from);
    case HAIR_BULLET_MULTI_SPHERE: return make_spheres(from);
    case HAIR_BULLET_MESH: return make_mesh(world, from);
    case HAIR_BULLET_HEIGHT_FIELD: return make_height_field(from);
    case HAIR_BULLET_COMPOUND: return make_compound(world, from);
    }
    return nullptr;
}

static btCollisionShape* make_shape(hair_world* world, const hair_bullet_shape& from)
{
    btCollisionShape* shape = make_kind(world, from);
    btVector3 scale = vector(from.scale);
    if (from.kind == HAIR_BULLET_HEIGHT_FIELD)
        for (int k = 0; k < 3; ++k) scale[k] *= k == static_cast<int>(from.axis) ? 1 : from.spacing;
    if (from.margin >= 0) shape->setMargin(from.margin);
    if (scale != btVector3(1, 1, 1)) shape->setLocalScaling(scale);
    world->shapes.emplace_back(shape);
    return shape;
}

// Objects -----------------------------------------------------------------------------------------

static bool moves(const hair_scene_collider& body)
{
    const bool runs = vector(body.velocity) != btVector3(0, 0, 0) || vector(body.spin) != btVector3(0, 0, 0);
    return runs || body.key_count || !body.stays;
}

static btTransform place_of(const hair_scene_collider& body, float time, const float transform[16])
{
    hair_collider at = hair_scene_collider_at(&body, time);
    if (!body.stays) hair_collider_carry(transform, 1, &at);
    return pose(at.position, at.rotation);
}

static void move(hair_world* world, float time, const float transform[16])
{
    for (uint32_t i : world->moving) {
        btCollisionObject* object = world->objects[i].get();
        object->setWorldTransform(place_of(world->scene->bullet.object[i].body, time, transform));
        world->world.updateSingleAabb(object);
    }
}

// Check that hair can collide with every object, wherever it is.
static int try_objects(hair_world* world, const char* name)
{
    for (uint32_t i = 0; i < world->objects.size(); ++i) {
        hair_result result = hair_bullet_clear(world->bullet);
        if (!result) result = hair_bullet_add_object(world->bullet, world->objects[i].get());
        if (result == HAIR_ERROR_ARGUMENT)
            hair_complain(world->tool, "%s: bullet[%u] must be a shape that hair can collide with", name, i);
        if (result) return result == HAIR_ERROR_ARGUMENT ? HAIR_EXIT_INPUT : HAIR_EXIT_RUNTIME;
    }
    return HAIR_EXIT_OK;
}

static int fill(hair_world* world, const char* name, const hair_host* host)
{
    if (hair_bullet_create(host, sizeof(btScalar), &world->bullet)) return HAIR_EXIT_RUNTIME;
    const float here[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    for (uint32_t i = 0; i < world->scene->bullet.count; ++i) {
        const hair_bullet_object& from = world->scene->bullet.object[i];
        auto object = std::make_unique<btCollisionObject>();
        object->setCollisionShape(make_shape(world, from.shape));
        object->setFriction(from.body.collider.friction);
        object->setWorldTransform(place_of(from.body, 0, here));
        if (moves(from.body)) world->moving.push_back(i);
        world->world.addCollisionObject(object.get());
        world->objects.push_back(std::move(object));
    }
    return try_objects(world, name);
}

int hair_world_create(const char* tool, const char* name, const hair_scene* scene, const hair_host* host,
                      hair_world** out)
{
    *out = nullptr;
    if (!scene->bullet.count) return HAIR_EXIT_OK;
    hair_world* world = new hair_world;
    world->tool = tool;
    world->scene = scene;
    int code = fill(world, name, host);
    if (code)
        delete world;
    else
        *out = world;
    return code;
}

void hair_world_destroy(hair_world* world)
{
    delete world;
}

hair_result hair_world_colliders(hair_world* world, float time, const float transform[16],
                                 const float lower[3], const float upper[3], const hair_collider** colliders,
                                 uint32_t* count)
{
    *count = 0;
    if (!world) return HAIR_OK;
    move(world, time, transform);
    hair_result result = hair_bullet_clear(world->bullet);
    if (!result) result = hair_bullet_add_world(world->bullet, &world->world, lower, upper, -1);
    *colliders = hair_bullet_colliders(world->bullet, count);
    return result;
}
