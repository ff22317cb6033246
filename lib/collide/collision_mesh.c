// collision_mesh.c - distances to a triangle mesh at the nodes of a grid.
//
// A tree of triangles gives the distance near triangles. From there the nearest triangle is passed
// on from node to node (Tsai 2002). Two neighbouring nodes are on the same side if their distances
// add up to more than the distance between them, because no surface fits between. Nodes thus fall
// into few sets of one sign each. One winding number per set is enough (Jacobson et al. 2013).
#include "lib/collide/collision_mesh.h"
#include "lib/base/bytes.h"
#include "lib/collide/triangles.h"

#define MIN_SIZE 1e-6f // Minimum size of a mesh, m.
// Minimum size of a voxel as a fraction of the coordinates, of which floats resolve 6e-8.
#define FINEST_VOXEL 2.5e-7f
#define MAX_VOXELS 256 // Maximum number along the longest side.
#define MAX_WORK 500000000 // Maximum number of triangles and boxes visited.
#define SWEEPS 8 // One per combination of directions along the three axes.

static hair_result check_mesh_arrays(const hair_host* host, const hair_collision_mesh_desc* desc)
{
    for (size_t i = 0; i < 3 * (size_t)desc->vertex_count; ++i)
        if (!(fabsf(desc->positions[i]) <= 1e6f))
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "hair_collision_mesh_desc.positions[%zu] is %g, not in [-1e6, 1e6]", i,
                             (double)desc->positions[i]);
    for (size_t i = 0; i < 3 * (size_t)desc->triangle_count; ++i)
        if (desc->triangles[i] >= desc->vertex_count)
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "hair_collision_mesh_desc.triangles[%zu] is %u, but there are %u vertices", i,
                             desc->triangles[i], desc->vertex_count);
    return HAIR_OK;
}

// The grid ----------------------------------------------------------------------------------------

static float longest(hair_vec3 size)
{
    return fmaxf(size.x, fmaxf(size.y, size.z));
}

static float farthest_from_origin(const struct hair_triangles* t)
{
    return longest((hair_vec3){fabsf(t->center.x), fabsf(t->center.y), fabsf(t->center.z)}) +
           longest(t->bounds.upper);
}

// Choose the voxel size and the thickness of a shell. The mesh with its shell fits into the
// resolution. With the padding around it, the mesh fits into MAX_VOXELS.
static void choose_voxel(const hair_collision_mesh_desc* desc, const struct hair_triangles* t,
                         hair_collision_mesh_info* info)
{
    float side = longest(hair_sub(t->bounds.upper, t->bounds.lower));
    float voxels = (float)(desc->voxel_size > 0 ? MAX_VOXELS : desc->resolution);
    float thickness = info->is_closed ? 0 : desc->thickness;
    info->voxel_size = fmaxf(desc->voxel_size, (side + thickness) / voxels);
    if (!info->is_closed && thickness < 2 * info->voxel_size) {
        info->voxel_size = fmaxf(desc->voxel_size, side / (voxels - 2));
        thickness = 2 * info->voxel_size;
    }
    info->voxel_size = fmaxf(info->voxel_size, (side + thickness + 2 * desc->padding) / MAX_VOXELS);
    info->thickness = fmaxf(thickness, info->is_closed ? 0 : 2 * info->voxel_size);
    HAIR_ASSERT(info->voxel_size > 0 && info->thickness >= 0);
}

static hair_result build_mesh_grid(const hair_collision_mesh_desc* desc, const struct hair_triangles* t,
                                   hair_collision_mesh* mesh)
{
    const hair_host* host = &mesh->host;
    float side = longest(hair_sub(t->bounds.upper, t->bounds.lower)), far = farthest_from_origin(t);
    if (!(side >= MIN_SIZE))
        return hair_fail(host, HAIR_ERROR_ARGUMENT,
                         "hair_collision_mesh_desc: the mesh is %g m long, which is less than %g m",
                         (double)side, (double)MIN_SIZE);
    choose_voxel(desc, t, &mesh->info);
    mesh->voxel = mesh->info.voxel_size;
    if (mesh->voxel < FINEST_VOXEL * far)
        return hair_fail(
            host, HAIR_ERROR_ARGUMENT,
            "hair_collision_mesh_desc: the mesh is %g m long but up to %g m from its origin: too far for "
            "voxels of %g m",
            (double)side, (double)far, (double)mesh->voxel);
    float room = mesh->info.thickness / 2 + desc->padding + HAIR_COLLISION_MESH_PADDING * mesh->voxel;
    const float lower[3] = {t->bounds.lower.x, t->bounds.lower.y, t->bounds.lower.z};
    const float upper[3] = {t->bounds.upper.x, t->bounds.upper.y, t->bounds.upper.z};
    const float center[3] = {t->center.x, t->center.y, t->center.z};
    for (int k = 0; k < 3; ++k) {
        mesh->size[k] = (uint32_t)ceilf((upper[k] - lower[k] + 2 * room) / mesh->voxel) + 1;
        HAIR_ASSERT(mesh->size[k] > 2 * HAIR_COLLISION_MESH_PADDING);
        mesh->info.size[k] = mesh->size[k];
        mesh->info.lower[k] = center[k] + lower[k] - mesh->info.thickness / 2;
        mesh->info.upper[k] = center[k] + upper[k] + mesh->info.thickness / 2;
        // The mesh is centred in the grid.
        mesh->origin[k] = center[k] - mesh->voxel * (float)(mesh->size[k] - 1) / 2;
    }
    size_t nodes = (size_t)mesh->size[0] * mesh->size[1] * mesh->size[2];
    mesh->distance = hair_alloc(host, nodes, sizeof *mesh->distance);
    mesh->info.bytes = sizeof *mesh + nodes * sizeof *mesh->distance;
    return mesh->distance ? HAIR_OK : hair_fail_memory(host, "a collision mesh's distances");
}

static hair_vec3 place_of(const hair_collision_mesh* mesh, const struct hair_triangles* t,
                          const uint32_t at[3])
{
    return (hair_vec3){mesh->origin[0] - t->center.x + mesh->voxel * (float)at[0],
                       mesh->origin[1] - t->center.y + mesh->voxel * (float)at[1],
                       mesh->origin[2] - t->center.z + mesh->voxel * (float)at[2]};
}

static size_t node_of(const hair_collision_mesh* mesh, const uint32_t at[3])
{
    HAIR_ASSERT(at[0] < mesh->size[0] && at[1] < mesh->size[1] && at[2] < mesh->size[2]);
    return at[0] + mesh->size[0] * (at[1] + (size_t)mesh->size[1] * at[2]);
}

static hair_result too_much(const hair_collision_mesh* mesh, const struct hair_triangles* t)
{
    return hair_fail(
        &mesh->host, HAIR_ERROR_ARGUMENT,
        "hair_collision_mesh_desc: its %u triangles cross each other so much that no distance can be found "
        "in bounded time",
        t->count);
}

// Measure exact distances near triangles. Elsewhere `nearest` becomes UINT32_MAX.
static hair_result measure_near(hair_collision_mesh* mesh, struct hair_triangles* t, uint32_t* nearest)
{
    uint32_t at[3], last = UINT32_MAX;
    for (at[2] = 0; at[2] < mesh->size[2]; ++at[2])
        for (at[1] = 0; at[1] < mesh->size[1]; ++at[1]) {
            if (t->work > MAX_WORK) return too_much(mesh, t);
            // Back and forth, so that the next is a neighbour.
            for (uint32_t i = 0; i < mesh->size[0]; ++i) {
                at[0] = (at[1] + at[2]) % 2 ? mesh->size[0] - 1 - i : i;
                hair_vec3 place = place_of(mesh, t, at);
                float distance = HAIR_COLLISION_MESH_BAND * mesh->voxel;
                uint32_t found = UINT32_MAX;
                if (last != UINT32_MAX) {
                    float guess = hair_triangles_distance(t, last, place);
                    if (guess < distance) distance = guess, found = last;
                }
                hair_triangles_find(t, place, &distance, &found);
                size_t node = node_of(mesh, at);
                nearest[node] = last = found;
                mesh->distance[node] = found == UINT32_MAX ? INFINITY : distance;
            }
        }
    return HAIR_OK;
}

// Give a node the triangle of node `from`, one step before it, if that triangle is nearer than its
// own.
static void improve_nearest(hair_collision_mesh* mesh, const struct hair_triangles* t, uint32_t* nearest,
                            size_t node, size_t from, hair_vec3 place)
{
    if (nearest[from] == nearest[node] || mesh->distance[from] - mesh->voxel >= mesh->distance[node]) return;
    HAIR_ASSERT(nearest[from] < t->count);
    float distance = hair_triangles_distance(t, nearest[from], place);
    if (distance >= mesh->distance[node]) return;
    mesh->distance[node] = distance;
    nearest[node] = nearest[from];
}

// Propagate triangles from the preceding nodes along each axis. Each bit of `backwards` reverses an
// axis.
static void sweep_axis(hair_collision_mesh* mesh, const struct hair_triangles* t, uint32_t* nearest,
                       int backwards)
{
    const size_t step[3] = {1, mesh->size[0], (size_t)mesh->size[0] * mesh->size[1]};
    uint32_t i[3], at[3];
    for (i[2] = 0; i[2] < mesh->size[2]; ++i[2])
        for (i[1] = 0; i[1] < mesh->size[1]; ++i[1])
            for (i[0] = 0; i[0] < mesh->size[0]; ++i[0]) {
                for (int k = 0; k < 3; ++k) at[k] = backwards >> k & 1 ? mesh->size[k] - 1 - i[k] : i[k];
                size_t node = node_of(mesh, at);
                hair_vec3 place = place_of(mesh, t, at);
                for (int k = 0; k < 3; ++k)
                    if (i[k])
                        improve_nearest(mesh, t, nearest, node,
                                        backwards >> k & 1 ? node + step[k] : node - step[k], place);
            }
}

static hair_result measure_mesh(hair_collision_mesh* mesh, struct hair_triangles* t)
{
    size_t nodes = (size_t)mesh->size[0] * mesh->size[1] * mesh->size[2];
    uint32_t* nearest = hair_alloc(&mesh->host, nodes, sizeof *nearest);
    hair_result result = nearest ? measure_near(mesh, t, nearest)
                                 : hair_fail_memory(&mesh->host, "a collision mesh's triangles");
    for (int i = 0; i < SWEEPS && !result; ++i) sweep_axis(mesh, t, nearest, i % 8);
    hair_free(&mesh->host, nearest);
    return result;
}

// Sides -------------------------------------------------------------------------------------------

enum { UNKNOWN, OUTSIDE, INSIDE };

struct sides {
    const hair_collision_mesh* form;
    unsigned char* side; // of each node
    uint32_t* stack; // nodes whose neighbours are still to be visited
    size_t depth;
};

static void tell(struct sides* sides, size_t node, unsigned char side)
{
    HAIR_ASSERT(sides->side[node] == UNKNOWN && side != UNKNOWN);
    sides->side[node] = side;
    // Each node is pushed once, since it was unknown.
    sides->stack[sides->depth++] = (uint32_t)node;
}

// Find all nodes on the same side as the nodes on the stack.
static void flood_side(struct sides* sides)
{
    const hair_collision_mesh* mesh = sides->form;
    const size_t step[3] = {1, mesh->size[0], (size_t)mesh->size[0] * mesh->size[1]};
    while (sides->depth > 0) {
        size_t node = sides->stack[--sides->depth];
        HAIR_ASSERT(sides->side[node] != UNKNOWN);
        const size_t at[3] = {node % step[1], node / step[1] % mesh->size[1], node / step[2]};
        for (int k = 0; k < 6; ++k) {
            int axis = k / 2;
            if (at[axis] == (k % 2 ? mesh->size[axis] - 1 : 0)) continue;
            size_t next = k % 2 ? node + step[axis] : node - step[axis];
            if (sides->side[next] == UNKNOWN &&
                mesh->distance[node] + mesh->distance[next] > 1.0001f * mesh->voxel)
                tell(sides, next, sides->side[node]);
        }
    }
}

static hair_result find_sides(hair_collision_mesh* mesh, struct hair_triangles* t)
{
    size_t nodes = (size_t)mesh->size[0] * mesh->size[1] * mesh->size[2], node = 0;
    struct sides sides = {.form = mesh};
    sides.side = hair_alloc(&mesh->host, nodes, sizeof *sides.side);
    sides.stack = hair_alloc(&mesh->host, nodes, sizeof *sides.stack);
    hair_result result =
        sides.side && sides.stack ? HAIR_OK : hair_fail_memory(&mesh->host, "the inside of a collision mesh");
    uint32_t at[3];
    for (at[2] = 0; at[2] < mesh->size[2] && !result; ++at[2])
        for (at[1] = 0; at[1] < mesh->size[1]; ++at[1])
            for (at[0] = 0; at[0] < mesh->size[0]; ++at[0], ++node) {
                if (sides.side[node] != UNKNOWN || result) continue;
                if (t->work > MAX_WORK) result = too_much(mesh, t);
                int is_inside = fabsf(hair_triangles_winding(t, place_of(mesh, t, at))) > 0.5f;
                tell(&sides, node, is_inside ? INSIDE : OUTSIDE);
                flood_side(&sides);
            }
    for (node = 0; node < nodes && !result; ++node)
        if (sides.side[node] == INSIDE) mesh->distance[node] = -mesh->distance[node];
    hair_free(&mesh->host, sides.side);
    hair_free(&mesh->host, sides.stack);
    return result;
}

static void thicken(hair_collision_mesh* mesh)
{
    size_t nodes = (size_t)mesh->size[0] * mesh->size[1] * mesh->size[2];
    HAIR_ASSERT(mesh->info.thickness > 0);
    for (size_t i = 0; i < nodes; ++i) mesh->distance[i] -= mesh->info.thickness / 2;
}

// The whole ---------------------------------------------------------------------------------------

static uint64_t hash_content(const hair_collision_mesh* mesh)
{
    uint64_t hash = hair_hash_words(HAIR_HASH_BEGIN, mesh->size, 3);
    hash = hair_hash_words(hash, mesh->origin, 3);
    hash = hair_hash_words(hash, &mesh->voxel, 1);
    hash = hair_hash_words(hash, mesh->distance, (size_t)mesh->size[0] * mesh->size[1] * mesh->size[2]);
    return hash ? hash : 1;
}

static hair_result fill_mesh(const hair_collision_mesh_desc* desc, struct hair_triangles* t,
                             hair_collision_mesh* mesh)
{
    HAIR_TRY(hair_triangles_build(&mesh->host, desc->positions, desc->triangles, desc->triangle_count, t));
    if (!t->count)
        return hair_fail(&mesh->host, HAIR_ERROR_ARGUMENT,
                         "hair_collision_mesh_desc: none of %u triangles has three different corners",
                         desc->triangle_count);
    mesh->info.unused = desc->triangle_count - t->count;
    mesh->info.is_closed = (uint32_t)hair_triangles_are_closed(t);
    HAIR_TRY(build_mesh_grid(desc, t, mesh));
    HAIR_TRY(measure_mesh(mesh, t));
    if (mesh->info.is_closed) return find_sides(mesh, t);
    thicken(mesh);
    hair_log(&mesh->host, HAIR_LOG_WARNING, "a collision mesh of %u triangles is not closed: a shell of %g m",
             t->count, (double)mesh->info.thickness);
    return HAIR_OK;
}

hair_result hair_collision_mesh_build(const hair_host* host, const hair_collision_mesh_desc* desc,
                                      hair_collision_mesh** out)
{
    HAIR_TRY(check_mesh_arrays(host, desc));
    hair_collision_mesh* mesh = hair_alloc(host, 1, sizeof *mesh);
    if (!mesh) return hair_fail_memory(host, "a collision mesh");
    struct hair_triangles triangles = {0};
    mesh->host = *host;
    mesh->info = hair_collision_mesh_info_default();
    atomic_init(&mesh->holders, 1);
    hair_result result = fill_mesh(desc, &triangles, mesh);
    hair_triangles_free(host, &triangles);
    if (result) {
        hair_collision_mesh_release(mesh);
        return result;
    }
    mesh->content_hash = hash_content(mesh);
    *out = mesh;
    return HAIR_OK;
}

// Cast away const. Holders may not change a collision mesh, but may release it.
static hair_collision_mesh* own(const hair_collision_mesh* mesh)
{
    return (hair_collision_mesh*)(uintptr_t)mesh;
}

void hair_collision_mesh_hold(const hair_collision_mesh* mesh)
{
    HAIR_ASSERT(!mesh || atomic_load(&own(mesh)->holders) > 0);
    if (mesh) atomic_fetch_add_explicit(&own(mesh)->holders, 1, memory_order_relaxed);
}

uint32_t hair_collision_mesh_holders(const hair_collision_mesh* mesh)
{
    return atomic_load(&own(mesh)->holders);
}

void hair_collision_mesh_release(const hair_collision_mesh* mesh)
{
    HAIR_ASSERT(!mesh || atomic_load(&own(mesh)->holders) > 0);
    if (!mesh || atomic_fetch_sub_explicit(&own(mesh)->holders, 1, memory_order_acq_rel) != 1) return;
    hair_host host = mesh->host;
    hair_free(&host, mesh->distance);
    hair_free(&host, own(mesh));
}
