// frame_lights.c - The lights of a frame and the shadow matrices of those that cast shadows.
#include "tools/common/frame_lights.h"
#include "tools/common/shaders.h"

#include <epoxy/gl.h>

#include <string.h>

void hair_frame_lights_find(const struct hair_scene* scene, const float transform[16], float reach,
                            struct hair_frame_lights* out)
{
    memset(out, 0, sizeof *out);
    out->count = 1 + scene->lights.count;
    for (uint32_t i = 0; i < out->count; ++i) {
        bool casts = i ? scene->lights.at[i - 1].shadow : scene->shadow;
        out->light[i] = i ? scene->lights.at[i - 1].light : scene->settings.light;
        if (!casts || out->shadows == HAIR_SCENE_SHADOWS) continue;
        struct hair_frame_shadow* shadow = &out->shadow[out->shadows++];
        shadow->light = i;
        shadow->texel =
            hair_lamp_matrices(scene, &out->light[i], transform, reach, &shadow->matrices) / HAIR_SHADOW_SIZE;
    }
}

static void set_light(GLuint program, GLint i, const hair_light* light)
{
    struct hair_lit lit = hair_lit_of(light);
    glProgramUniform4fv(program, HAIR_AT_LIGHT_TO + i, 1, lit.to);
    glProgramUniform4fv(program, HAIR_AT_LIGHT + i, 1, lit.color);
    glProgramUniform4fv(program, HAIR_AT_AXIS + i, 1, lit.axis);
    glProgramUniform2fv(program, HAIR_AT_MORE + i, 1, lit.more);
    glProgramUniform1i(program, HAIR_AT_MAP + i, -1);
}

static void set_shadow(GLuint program, GLuint i, const struct hair_frame_shadow* shadow,
                       const struct hair_shadow_map* map, GLuint sampler)
{
    float matrix[16];
    hair_light_texture(&shadow->matrices, matrix);
    glProgramUniformMatrix4fv(program, HAIR_AT_SHADOW + (GLint)i, 1, GL_FALSE, matrix);
    glProgramUniform1f(program, HAIR_AT_TEXEL + (GLint)i, shadow->texel);
    glProgramUniform1i(program, HAIR_AT_MAP + (GLint)shadow->light, (GLint)i);
    glBindTextureUnit(i, map->texture[HAIR_SHADOW_BODY]);
    glBindTextureUnit(HAIR_SCENE_SHADOWS + i, map->texture[HAIR_SHADOW_OPACITY]);
    glBindSampler(i, sampler);
}

void hair_frame_lights_set(unsigned program, const struct hair_frame_lights* lights,
                           const struct hair_shadow_map* maps, unsigned sampler)
{
    for (uint32_t i = 0; i < lights->count; ++i) set_light(program, (GLint)i, &lights->light[i]);
    for (uint32_t i = 0; i < lights->shadows; ++i)
        set_shadow(program, i, &lights->shadow[i], &maps[i], sampler);
    glProgramUniform1i(program, HAIR_AT_LIGHTS, (GLint)lights->count);
}

void hair_frame_lights_unset(const struct hair_frame_lights* lights)
{
    for (uint32_t i = 0; i < lights->shadows; ++i) glBindSampler(i, 0);
}
