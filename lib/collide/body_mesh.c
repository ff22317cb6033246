// body_mesh.c - the collision mesh of a body, on the CPU.
#include "lib/collide/body_mesh.h"
#include "lib/base/bytes.h"
#include "lib/collide/triangles.h"

#define SHORTEST 1e-5f // Minimum of the longest side of the box, m.
// Minimum size of a voxel as a fraction of the coordinates, of which floats resolve 6e-8.
#define FINEST 2.5e-7f

static hair_result check_box(const hair_host* host, const hair_body_desc* desc, float* longest)
{
    float far = 0;
    *longest = 0;
    for (int k = 0; k < 3; ++k) {
        if (!(desc->upper[k] > desc->lower[k]))
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "hair_body_desc.upper[%d] is %g, not above lower[%d], which is %g", k,
                             (double)desc->upper[k], k, (double)desc->lower[k]);
        *longest = fmaxf(*longest, desc->upper[k] - desc->lower[k]);
        far = fmaxf(far, fmaxf(fabsf(desc->lower[k]), fabsf(desc->upper[k])));
    }
    float voxel = *longest / (float)desc->resolution;
    if (*longest >= SHORTEST && voxel >= FINEST * far) return HAIR_OK;
    return hair_fail(host, HAIR_ERROR_ARGUMENT,
                     "hair_body_desc: the box is %g m long and up to %g m from its origin: too small for "
                     "voxels of %g m",
                     (double)*longest, (double)far, (double)voxel);
}

static hair_result check_body_triangles(const hair_host* host, const hair_body_desc* desc)
{
    for (size_t i = 0; i < 3 * (size_t)desc->triangle_count; ++i)
        if (desc->triangles[i] >= desc->vertex_count)
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "hair_body_desc.triangles[%zu] is %u, but there are %u vertices", i,
                             desc->triangles[i], desc->vertex_count);
    return HAIR_OK;
}

// Choose the voxel size and the thickness of a shell, so that the box with the shell has
// `resolution` voxels along its longest side.
static void choose_size(const hair_body_desc* desc, float longest, hair_collision_mesh_info* info)
{
    float voxels = (float)desc->resolution, thickness = info->is_closed ? 0 : desc->thickness;
    info->voxel_size = (longest + thickness) / voxels;
    if (!info->is_closed && thickness < 2 * info->voxel_size) {
        info->voxel_size = longest / (voxels - 2);
        thickness = 2 * info->voxel_size;
    }
    info->thickness = thickness;
}

static void lay_grid(const hair_body_desc* desc, hair_collision_mesh* mesh)
{
    float margin = mesh->info.thickness / 2 + HAIR_COLLISION_MESH_PADDING * mesh->info.voxel_size;
    mesh->voxel = mesh->info.voxel_size;
    for (int k = 0; k < 3; ++k) {
        float side = desc->upper[k] - desc->lower[k] + 2 * margin;
        mesh->size[k] = (uint32_t)ceilf(side / mesh->voxel - 1e-3f) + 1;
        mesh->info.size[k] = mesh->size[k];
        mesh->info.lower[k] = desc->lower[k];
        mesh->info.upper[k] = desc->upper[k];
        float middle = 0.5f * (desc->lower[k] + desc->upper[k]);
        mesh->origin[k] = middle - mesh->voxel * (float)(mesh->size[k] - 1) / 2;
    }
    mesh->info.bytes = sizeof *mesh;
}

// Return a hash of what the application describes a body with, except its vertices. The key stands
// for everything else.
static uint64_t hash_desc(const hair_body_desc* desc)
{
    uint64_t hash = HAIR_HASH_BEGIN;
    if (!desc->key) {
        hash = hair_hash_words(hash, desc->triangles, 3 * (size_t)desc->triangle_count);
        hash = hair_hash_words(hash, &desc->vertex_count, 1);
        hash = hair_hash_words(hash, &desc->resolution, 1);
        hash = hair_hash_words(hash, desc->lower, 3);
        hash = hair_hash_words(hash, desc->upper, 3);
        hash = hair_hash_words(hash, &desc->thickness, 1);
        if (desc->two_sided) hash = hair_hash_words(hash, &(uint32_t){1}, 1);
    }
    hash = hair_hash_words(hash, &desc->key, 2);
    return hash ? hash : 1;
}

static hair_result find_closed(const hair_host* host, const hair_body_desc* desc,
                               hair_collision_mesh_info* info)
{
    struct hair_triangles triangles = {0};
    HAIR_TRY(hair_triangles_build(host, desc->positions, desc->triangles, desc->triangle_count, &triangles));
    info->unused = desc->triangle_count - triangles.count;
    info->is_closed = !desc->two_sided && triangles.count && hair_triangles_are_closed(&triangles);
    hair_triangles_free(host, &triangles);
    return HAIR_OK;
}

hair_result hair_body_mesh_measure(const hair_host* host, const hair_body_desc* desc, const float* positions,
                                   size_t stride, float lower[3], float upper[3])
{
    HAIR_ASSERT(stride >= 12 && stride % sizeof *positions == 0);
    for (int k = 0; k < 3; ++k) lower[k] = INFINITY, upper[k] = -INFINITY;
    for (uint32_t i = 0; i < desc->vertex_count; ++i) {
        const float* p = positions + i * (stride / sizeof *positions);
        for (int k = 0; k < 3; ++k) {
            if (!(desc->lower[k] <= p[k] && p[k] <= desc->upper[k])) // NaN fails too.
                return hair_fail(host, HAIR_ERROR_ARGUMENT,
                                 "hair_body: vertex %u is at (%g, %g, %g), outside the box of its "
                                 "hair_body_desc from (%g, %g, %g) to (%g, %g, %g)",
                                 i, (double)p[0], (double)p[1], (double)p[2], (double)desc->lower[0],
                                 (double)desc->lower[1], (double)desc->lower[2], (double)desc->upper[0],
                                 (double)desc->upper[1], (double)desc->upper[2]);
            lower[k] = fminf(lower[k], p[k]);
            upper[k] = fmaxf(upper[k], p[k]);
        }
    }
    return HAIR_OK;
}

hair_result hair_body_mesh_build(const hair_host* host, const hair_body_desc* desc, float lower[3],
                                 float upper[3], hair_collision_mesh** out)
{
    hair_collision_mesh_info info = hair_collision_mesh_info_default();
    float longest;
    HAIR_TRY(check_box(host, desc, &longest));
    HAIR_TRY(check_body_triangles(host, desc));
    HAIR_TRY(hair_body_mesh_measure(host, desc, desc->positions, 3 * sizeof(float), lower, upper));
    HAIR_TRY(find_closed(host, desc, &info));
    hair_collision_mesh* mesh = hair_alloc(host, 1, sizeof *mesh);
    if (!mesh) return hair_fail_memory(host, "a body");
    choose_size(desc, longest, &info);
    mesh->host = *host;
    mesh->info = info;
    mesh->content_hash = hash_desc(desc);
    atomic_init(&mesh->holders, 1);
    lay_grid(desc, mesh);
    if (!info.is_closed && !desc->two_sided)
        hair_log(host, HAIR_LOG_WARNING, "a body of %u triangles is not closed: a shell of %g m",
                 desc->triangle_count, (double)info.thickness);
    *out = mesh;
    return HAIR_OK;
}

void hair_body_mesh_place(const hair_collision_mesh* mesh, const float* positions, uint32_t count,
                          size_t stride, float* out)
{
    for (uint32_t i = 0; i < count; ++i) {
        const float* p = positions + i * (stride / sizeof *positions);
        for (int k = 0; k < 3; ++k)
            *out++ = (float)(((double)p[k] - (double)mesh->origin[k]) / (double)mesh->voxel);
    }
}

void hair_body_mesh_change(hair_collision_mesh* mesh, const float lower[3], const float upper[3])
{
    float shell = mesh->info.thickness / 2;
    for (int k = 0; k < 3; ++k) {
        // Hair meets the body on its way from the last shape to this one.
        float first = mesh->generation ? mesh->shape_lower[k] : lower[k];
        float last = mesh->generation ? mesh->shape_upper[k] : upper[k];
        mesh->info.lower[k] = fminf(first, lower[k]) - shell;
        mesh->info.upper[k] = fmaxf(last, upper[k]) + shell;
        mesh->shape_lower[k] = lower[k];
        mesh->shape_upper[k] = upper[k];
    }
    ++mesh->generation;
}
