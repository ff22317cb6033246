// bindings.c - bindings of buffers and textures that several passes read.
#include "lib/draw/draw.h"
#include "lib/draw/params.h"

void hair_draw_bind(struct hair_draw* draw, const struct hair_smooth* smooth)
{
    struct hair_gl* gl = draw->gl;
    GLuint textures[] = {smooth->texture[0],
                         smooth->texture[1],
                         smooth->texture[2],
                         draw->follower_texture,
                         draw->patch_texture,
                         0,
                         draw->follower_collision.hit_texture,
                         draw->follower_collision.repair_texture};
    for (GLuint unit = 0; unit <= HAIR_UNIT_REPAIR; ++unit)
        if (textures[unit]) gl->BindTextureUnit(unit, textures[unit]);
    gl->BindBuffersBase(GL_UNIFORM_BUFFER, HAIR_BIND_DRAW, 1, &draw->params);
}

void hair_draw_bind_vertex_cache(struct hair_draw* draw)
{
    HAIR_ASSERT(draw->vertex_cache.position_texture && draw->vertex_cache.tangent_texture);
    draw->gl->BindTextureUnit(HAIR_UNIT_CACHED_POSITION, draw->vertex_cache.position_texture);
    draw->gl->BindTextureUnit(HAIR_UNIT_CACHED_TANGENT, draw->vertex_cache.tangent_texture);
}

void hair_draw_bind_motion(struct hair_draw* draw)
{
    GLuint texture = draw->motion.still ? draw->vertex_cache.position_texture : draw->motion.texture;
    HAIR_ASSERT(texture);
    draw->gl->BindTextureUnit(HAIR_UNIT_BEFORE, texture);
}

uint32_t hair_view_maps(const hair_view* view, struct hair_light_maps out[HAIR_SHADOW_MAPS])
{
    HAIR_ASSERT(view->light_count <= HAIR_LIGHTS);
    uint32_t maps = 0;
    for (uint32_t i = 0; i < view->light_count && maps < HAIR_SHADOW_MAPS; ++i) {
        const hair_light* light = &view->lights[i];
        if (light->hair_shadow_map || light->opaque_shadow_map)
            out[maps++] = (struct hair_light_maps){i, light->hair_shadow_map, light->opaque_shadow_map};
    }
    return maps;
}

static void bind_map(struct hair_gl* gl, GLuint unit, GLuint texture)
{
    if (!texture) return;
    gl->BindTextureUnit(unit, texture);
    gl->BindSampler(unit, gl->shadow_sampler);
}

void hair_draw_bind_shadows(struct hair_draw* draw, const hair_view* view)
{
    struct hair_light_maps maps[HAIR_SHADOW_MAPS];
    uint32_t count = hair_view_maps(view, maps);
    HAIR_ASSERT(count <= HAIR_SHADOW_MAPS);
    for (GLuint i = 0; i < count; ++i) {
        bind_map(draw->gl, HAIR_UNIT_SHADOW + i, maps[i].shadow);
        bind_map(draw->gl, HAIR_UNIT_BODY + i, maps[i].body);
    }
}
