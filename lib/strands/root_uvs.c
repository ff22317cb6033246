// root_uvs.c - scalp uvs of roots, for textures and shaders.
#include "lib/strands/geometry.h"

bool hair_geometry_has_uvs(const struct hair_geometry* geometry)
{
    return geometry->groom->root_uvs != NULL;
}

hair_result hair_geometry_ensure_uvs(struct hair_geometry* geometry)
{
    HAIR_ASSERT(hair_geometry_has_uvs(geometry));
    struct hair_gl* gl = geometry->gl;
    hair_result result = HAIR_OK;
    if (!geometry->uv)
        result = hair_gl_shared_buffer(gl, "hair root uvs", (size_t)geometry->followers * 2 * sizeof(float),
                                       geometry->groom->root_uvs, &geometry->uv);
    if (!result && !geometry->uv_texture)
        result = hair_gl_buffer_texture(gl, "hair root uvs", GL_RG32F, geometry->uv, &geometry->uv_texture);
    return result;
}

void hair_geometry_free_uvs(struct hair_geometry* geometry)
{
    hair_gl_free_array(geometry->gl, &geometry->uv, &geometry->uv_texture);
}
