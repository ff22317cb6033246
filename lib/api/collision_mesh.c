// collision_mesh.c - public calls on collision meshes.
#include "lib/base/schema.h"
#include "lib/collide/collision_mesh.h"

hair_result hair_collision_mesh_create(const hair_collision_mesh_desc* desc, hair_collision_mesh** out)
{
    hair_host host = HAIR_HOST_OF(desc);
    hair_collision_mesh_desc own;
    HAIR_TRY(HAIR_COPY_IN(&host, hair_collision_mesh_desc, desc, &own));
    if (!own.positions)
        return hair_fail(&host, HAIR_ERROR_ARGUMENT, "hair_collision_mesh_desc.positions is NULL");
    if (!own.triangles)
        return hair_fail(&host, HAIR_ERROR_ARGUMENT, "hair_collision_mesh_desc.triangles is NULL");
    if (!out) return hair_fail(&host, HAIR_ERROR_ARGUMENT, "out is NULL");
    return hair_collision_mesh_build(&host, &own, out);
}

void hair_collision_mesh_destroy(hair_collision_mesh* mesh)
{
    hair_collision_mesh_release(mesh);
}

hair_result hair_collision_mesh_describe(const hair_collision_mesh* mesh, hair_collision_mesh_info* out)
{
    if (!mesh) return HAIR_ERROR_ARGUMENT;
    return HAIR_COPY_OUT(&mesh->host, hair_collision_mesh_info, &mesh->info, out);
}
