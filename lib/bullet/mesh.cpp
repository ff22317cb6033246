// mesh.cpp - triangle meshes and height fields as collision meshes, and the construction of
// collision meshes for hulls.
#include "lib/bullet/bullet.h"

#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <BulletCollision/CollisionShapes/btScaledBvhTriangleMeshShape.h>

#include <cmath>

// Maximum number of vertices of a collision mesh, which is that of hair_collision_mesh_desc too.
#define MAX_VERTICES 16777216u
#define TRIANGLE_VERTICES 3 // Vertices of a triangle of a mesh. Triangles share none.
#define FIELD_VERTICES 6 // Vertices of a triangle of a height field and of the floor below it.
// Depth of a height field below its lowest point, as a fraction of its longest side.
#define DEPTH 0.1f

// Meshes ------------------------------------------------------------------------------------------

void hair_mesh::add_vertex(const btVector3& at)
{
    void* array = positions;
    if (!result)
        result = hair_bullet_reserve(host, &array, &position_room, vertex_count + 1, 3 * sizeof(float));
    positions = static_cast<float*>(array);
    if (result) return;
    HAIR_ASSERT(vertex_count < position_room);
    for (int k = 0; k < 3; ++k)
        positions[3 * vertex_count + static_cast<uint32_t>(k)] = static_cast<float>(at[k]);
    ++vertex_count;
}

void hair_mesh::add_triangle(uint32_t a, uint32_t b, uint32_t c)
{
    void* array = triangles;
    if (!result)
        result = hair_bullet_reserve(host, &array, &triangle_room, triangle_count + 1, 3 * sizeof(uint32_t));
    triangles = static_cast<uint32_t*>(array);
    if (result) return;
    HAIR_ASSERT(a < vertex_count && b < vertex_count && c < vertex_count);
    HAIR_ASSERT(triangle_count < triangle_room);
    triangles[3 * triangle_count] = a;
    triangles[3 * triangle_count + 1] = b;
    triangles[3 * triangle_count + 2] = c;
    ++triangle_count;
}

void hair_mesh::release()
{
    hair_free(host, positions);
    hair_free(host, triangles);
    positions = nullptr;
    triangles = nullptr;
}

hair_result hair_bullet_make_collision_mesh(hair_bullet* bullet, const btCollisionShape* shape,
                                            uint64_t fingerprint, const hair_mesh& mesh, float room,
                                            const hair_collision_mesh** out)
{
    hair_collision_mesh_desc desc = hair_collision_mesh_desc_default();
    hair_collision_mesh* collision_mesh = nullptr;
    desc.host = &bullet->host;
    desc.positions = mesh.positions;
    desc.triangles = mesh.triangles;
    desc.vertex_count = mesh.vertex_count;
    desc.triangle_count = mesh.triangle_count;
    desc.resolution = bullet->resolution;
    desc.padding = room;
    hair_result result = HAIR_OK;
    if (mesh.triangle_count && mesh.positions) result = hair_collision_mesh_create(&desc, &collision_mesh);
    if (result && result != HAIR_ERROR_ARGUMENT) return result;
    result = hair_bullet_keep(bullet, shape, fingerprint, collision_mesh);
    if (result) hair_collision_mesh_destroy(collision_mesh);
    *out = result ? nullptr : collision_mesh;
    return result;
}

hair_result hair_bullet_add_collision_mesh(hair_bullet* bullet, const btCollisionShape* shape,
                                           const hair_gather& context,
                                           const hair_collision_mesh* collision_mesh, float rounding,
                                           float scale)
{
    if (!collision_mesh)
        return context.log_once
                   ? HAIR_ERROR_ARGUMENT
                   : hair_bullet_wrong(bullet, shape, context, "has triangles that make no collision mesh");
    hair_collider collider = hair_collider_default();
    collider.shape = HAIR_SHAPE_MESH;
    collider.mesh = collision_mesh;
    collider.rounding = rounding;
    collider.scale = scale;
    return hair_bullet_add_collider(bullet, shape, context, collider, btQuaternion::getIdentity());
}

namespace
{
// Count the triangles.
struct counter : btTriangleCallback {
    uint64_t count = 0;

    void processTriangle(btVector3*, int, int) override { ++count; }
};

// Gather the triangles, each with its own vertices.
struct gatherer : btTriangleCallback {
    hair_mesh* mesh = nullptr;

    void processTriangle(btVector3* triangle, int, int) override
    {
        const uint32_t first = mesh->vertex_count;
        for (int k = 0; k < 3; ++k) mesh->add_vertex(triangle[k]);
        mesh->add_triangle(first, first + 1, first + 2);
    }
};
} // namespace

// Height fields -----------------------------------------------------------------------------------

// Add walls below the rim and a floor. The mesh is then closed and has an inside.
static void close_below(const btHeightfieldTerrainShape* field, hair_mesh* mesh)
{
    const uint32_t up = static_cast<uint32_t>(field->getUpAxis()), u = (up + 1) % 3, v = (up + 2) % 3;
    const uint32_t surface = mesh->triangle_count;
    float min_value[3], max_value[3];
    for (uint32_t k = 0; k < 3; ++k) min_value[k] = INFINITY, max_value[k] = -INFINITY;
    for (uint32_t i = 0; i < 3 * mesh->vertex_count; ++i) {
        min_value[i % 3] = std::fmin(min_value[i % 3], mesh->positions[i]);
        max_value[i % 3] = std::fmax(max_value[i % 3], mesh->positions[i]);
    }
    const float floor =
        min_value[up] - DEPTH * std::fmax(max_value[u] - min_value[u], max_value[v] - min_value[v]);
    for (uint32_t t = 0; t < surface && !mesh->result; ++t) {
        const uint32_t below = mesh->vertex_count;
        btVector3 corner[3];
        for (uint32_t k = 0; k < 3; ++k) {
            const float* at = mesh->positions + 3 * mesh->triangles[3 * t + k];
            corner[k] = btVector3(at[0], at[1], at[2]);
        }
        for (int k = 0; k < 3; ++k) {
            btVector3 at = corner[k];
            at[static_cast<int>(up)] = floor;
            mesh->add_vertex(at);
        }
        mesh->add_triangle(below + 2, below + 1, below);
        for (uint32_t k = 0; k < 3; ++k) {
            const btVector3 &a = corner[k], &b = corner[(k + 1) % 3];
            const int i = static_cast<int>(u), j = static_cast<int>(v);
            const bool rim = (a[i] == b[i] && (a[i] == min_value[u] || a[i] == max_value[u])) ||
                             (a[j] == b[j] && (a[j] == min_value[v] || a[j] == max_value[v]));
            if (!rim) continue;
            const uint32_t top = mesh->triangles[3 * t + k], next = mesh->triangles[3 * t + (k + 1) % 3];
            mesh->add_triangle(next, top, below + k);
            mesh->add_triangle(next, below + k, below + (k + 1) % 3);
        }
    }
}

// Forms -------------------------------------------------------------------------------------------

// Return a hash of the properties that are cheap to read: bounds, scale and margin.
static uint64_t fingerprint_of(const btConcaveShape* shape, const btVector3& lower, const btVector3& upper)
{
    float numbers[10];
    for (int k = 0; k < 3; ++k) {
        numbers[k] = static_cast<float>(lower[k]);
        numbers[3 + k] = static_cast<float>(upper[k]);
        numbers[6 + k] = static_cast<float>(shape->getLocalScaling()[k]);
    }
    numbers[9] = static_cast<float>(shape->getMargin());
    uint64_t fingerprint = hair_bullet_fingerprint(0xcbf29ce484222325u, numbers, sizeof numbers);
    return fingerprint > 1 ? fingerprint : 2;
}

// Refuse a shape with too many triangles. It is stored without a collision mesh, so that they are
// not counted again.
static hair_result refuse(hair_bullet* bullet, const btConcaveShape* shape, const hair_gather& context,
                          uint64_t fingerprint, uint64_t count, uint32_t max)
{
    HAIR_TRY(hair_bullet_keep(bullet, shape, fingerprint, nullptr));
    hair_log(&bullet->host, context.log_once ? HAIR_LOG_WARNING : HAIR_LOG_ERROR,
             "Bullet's shape %s of type %d has %llu triangles, more than %u: hair goes through it",
             shape->getName(), shape->getShapeType(), static_cast<unsigned long long>(count), max);
    return HAIR_ERROR_ARGUMENT;
}

static hair_result make(hair_bullet* bullet, const btConcaveShape* shape, const hair_gather& context,
                        uint64_t fingerprint, const btVector3& lower, const btVector3& upper,
                        const hair_collision_mesh** out)
{
    counter triangles;
    shape->processAllTriangles(&triangles, lower, upper);
    const bool is_field = shape->getShapeType() == TERRAIN_SHAPE_PROXYTYPE;
    const uint32_t max = MAX_VERTICES / (is_field ? FIELD_VERTICES : TRIANGLE_VERTICES);
    if (triangles.count > max) return refuse(bullet, shape, context, fingerprint, triangles.count, max);
    hair_mesh mesh = {};
    mesh.host = &bullet->host;
    gatherer gatherer;
    gatherer.mesh = &mesh;
    shape->processAllTriangles(&gatherer, lower, upper);
    if (is_field) close_below(static_cast<const btHeightfieldTerrainShape*>(shape), &mesh);
    hair_result result = mesh.result;
    if (!result)
        result = hair_bullet_make_collision_mesh(bullet, shape, fingerprint, mesh,
                                                 2 * static_cast<float>(shape->getMargin()), out);
    mesh.release();
    return result;
}

hair_result hair_bullet_add_mesh(hair_bullet* bullet, const btConcaveShape* shape, const hair_gather& context)
{
    // All uniformly scaled copies of a mesh use one collision mesh.
    const btConcaveShape* own = shape;
    float scale = 1;
    if (shape->getShapeType() == SCALED_TRIANGLE_MESH_SHAPE_PROXYTYPE) {
        const btVector3& s = shape->getLocalScaling();
        if (s.x() == s.y() && s.y() == s.z() && s.x() > 0) {
            own = static_cast<const btScaledBvhTriangleMeshShape*>(shape)->getChildShape();
            scale = static_cast<float>(s.x());
        }
    }
    btVector3 lower, upper;
    own->getAabb(btTransform::getIdentity(), lower, upper);
    for (int k = 0; k < 3; ++k)
        if (!(lower[k] <= upper[k]) || !(btFabs(lower[k]) <= btScalar(1e6)) ||
            !(btFabs(upper[k]) <= btScalar(1e6)))
            return hair_bullet_wrong(bullet, shape, context, "has bounds that are not within 1e6 m");
    const uint64_t fingerprint = fingerprint_of(own, lower, upper);
    const hair_cached_shape* cached = hair_bullet_find(bullet, own, fingerprint);
    const hair_collision_mesh* collision_mesh = cached ? cached->mesh : nullptr;
    if (!cached) HAIR_TRY(make(bullet, own, context, fingerprint, lower, upper, &collision_mesh));
    return hair_bullet_add_collision_mesh(bullet, shape, context, collision_mesh,
                                          static_cast<float>(shape->getMargin()), scale);
}
