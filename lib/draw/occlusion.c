// occlusion.c - occlusion culling of patches by the application's depth texture.
#include "lib/draw/draw.h"
#include "lib/draw/params.h"

#include <string.h>

#define BESIDE 2.0f // Pixels by which a drawn strand may be wider than the strand.
// 2^-22, the rounding error of depth arithmetic. A depth texture may be coarser.
#define ROUNDED 2.3841858e-7f

void hair_draw_free_occlusion(struct hair_renderer* renderer)
{
    struct hair_occlusion* occlusion = &renderer->occlusion;
    hair_gl_free_buffer(renderer->gl, &occlusion->params);
    hair_gl_free_buffer(renderer->gl, &occlusion->depth);
    hair_gl_free_buffer(renderer->gl, &occlusion->box);
    occlusion->room = 0;
}

// Write the matrix from clip space to the texture. xy map to [0, 1], z to the depth that the
// application stores.
static void write_texture(const struct hair_gl* gl, float to_texture[16], float range[2])
{
    memcpy(range, gl->draw_state.depth_range, sizeof gl->draw_state.depth_range);
    hair_draw_clip_to_unit_matrix(gl, to_texture);
    float far = range[1] - range[0];
    to_texture[10] *= far;
    to_texture[14] = far * to_texture[14] + range[0];
}

static bool is_given(const float matrix[16])
{
    for (int i = 0; i < 16; ++i)
        if (matrix[i] != 0) return true;
    return false;
}

// Compute the matrix from the head's origin to the clip space that the texture was drawn with.
static void find_clip(const struct hair_renderer* renderer, const struct hair_pose* head,
                      const hair_view* view, const hair_mat4* own, float clip[16])
{
    float projection[16], placed[16];
    hair_mat4 given = hair_mat4_from_head(view->occluder_matrix, head);
    memcpy(placed, own, sizeof placed);
    hair_draw_project(renderer, view, projection);
    if (is_given(view->occluder_matrix))
        memcpy(clip, &given, sizeof given);
    else
        hair_mat4_multiply(projection, placed, clip);
}

static void find_size(struct hair_gl* gl, GLuint texture, struct hair_occlusion_params* out)
{
    GLint base = 0, size[2] = {0}, bits = 0;
    gl->GetTextureParameteriv(texture, GL_TEXTURE_BASE_LEVEL, &base);
    gl->GetTextureLevelParameteriv(texture, base, GL_TEXTURE_WIDTH, &size[0]);
    gl->GetTextureLevelParameteriv(texture, base, GL_TEXTURE_HEIGHT, &size[1]);
    gl->GetTextureLevelParameteriv(texture, base, GL_TEXTURE_DEPTH_SIZE, &bits);
    out->width = (uint32_t)size[0];
    out->height = (uint32_t)size[1];
    out->slack = fmaxf(ROUNDED, ldexpf(1, -bits));
}

// Find the texels of the first Hi-Z level that hair can cover. Take all texels if the extent is
// unknown. Return false if there are none.
static bool find_texels(const struct hair_renderer* renderer, const struct hair_pose* head,
                        const hair_view* view, struct hair_occlusion_params* out)
{
    float window[4] = {0, 0, 1, 1};
    const float beside[2] = {out->beside_x, out->beside_y};
    const uint32_t size[2] = {out->width, out->height};
    uint32_t first[2], end[2];
    if (renderer->has_attached_roots)
        hair_draw_find_window(renderer, head, view->lod, &out->to_texture, window);
    for (int k = 0; k < 2; ++k) {
        float texels = (float)size[k] / HAIR_HIZ_FIRST;
        uint32_t max = (size[k] + HAIR_HIZ_FIRST - 1) / HAIR_HIZ_FIRST;
        float from = fmaxf(window[k] - beside[k], 0), to = fminf(window[2 + k] + beside[k], 1);
        if (!(from < to)) return false;
        first[k] = (uint32_t)(from * texels);
        end[k] = (uint32_t)(to * texels) + 1;
        if (end[k] > max) end[k] = max;
        if (first[k] >= end[k]) first[k] = end[k] - 1;
        HAIR_ASSERT(first[k] < end[k] && end[k] <= max);
    }
    out->first_x = first[0], out->first_y = first[1];
    out->columns = end[0] - first[0], out->rows = end[1] - first[1];
    out->levels = hair_hiz_levels(out->columns, out->rows);
    return true;
}

bool hair_draw_find_occlusion(const struct hair_renderer* renderer, const struct hair_pose* head,
                              const hair_view* view, struct hair_occlusion_params* out)
{
    struct hair_gl* gl = renderer->gl;
    hair_mat4 own = hair_mat4_from_head(view->view, head);
    float clip[16], to_texture[16], matrix[16], range[2];
    const GLfloat* viewport = gl->draw_state.viewport;
    memset(out, 0, sizeof *out);
    if (!hair_draw_uses_occlusion(view)) return false;
    find_size(gl, view->occluder_depth, out);
    if (!out->width || !out->height) return false; // A lost context answers nothing.
    find_clip(renderer, head, view, &own, clip);
    write_texture(gl, to_texture, range);
    hair_mat4_multiply(to_texture, clip, matrix);
    out->sign = hair_draw_depth_direction(gl);
    for (int i = 2; i < 16; i += 4) matrix[i] *= out->sign;
    memcpy(&out->to_texture, matrix, sizeof matrix);
    out->max_size = fmaxf(out->sign * range[0], out->sign * range[1]);
    out->thick = (float)hair_draw_max_look_radius(renderer, view->lod);
    out->beside_x = BESIDE / fmaxf(viewport[2], 1) + 1 / (float)out->width;
    out->beside_y = BESIDE / fmaxf(viewport[3], 1) + 1 / (float)out->height;
    out->clips = !is_given(view->occluder_matrix);
    out->guides = renderer->geometry->guides;
    return out->sign != 0 && find_texels(renderer, head, view, out);
}

hair_result hair_draw_ensure_occlusion(struct hair_renderer* renderer, struct hair_draw_plan* plan)
{
    const struct hair_occlusion_params* params = &plan->occlusion;
    struct hair_gl* gl = renderer->gl;
    struct hair_occlusion* occlusion = &renderer->occlusion;
    HAIR_ASSERT(params->columns > 0 && params->rows > 0);
    size_t texels = hair_hiz_texels(params->columns, params->rows);
    size_t boxes = (size_t)renderer->geometry->guides * HAIR_OCCLUSION_PARTS * 2;
    hair_result result = HAIR_OK;
    if (!result && texels > occlusion->room) {
        // Make room for the whole texture, so that hair that comes nearer does not reallocate the
        // buffer.
        uint32_t columns = (params->width + HAIR_HIZ_FIRST - 1) / HAIR_HIZ_FIRST;
        uint32_t rows = (params->height + HAIR_HIZ_FIRST - 1) / HAIR_HIZ_FIRST;
        size_t room = hair_hiz_texels(columns, rows);
        hair_gl_free_buffer(gl, &occlusion->depth);
        occlusion->room = 0;
        result = hair_gl_storage(gl, HAIR_GL_CATEGORY_OCCLUSION, "hair Hi-Z", room * sizeof(float), NULL,
                                 &occlusion->depth);
        if (!result) occlusion->room = room;
    }
    if (!result)
        result = hair_gl_ensure_array(gl, HAIR_GL_CATEGORY_OCCLUSION, "hair guide bounds",
                                      boxes * sizeof(hair_vec4), &occlusion->box, 0, NULL);
    if (!result && !occlusion->params)
        result = hair_gl_uniform(gl, HAIR_GL_CATEGORY_OCCLUSION, "hair occlusion", sizeof *params,
                                 &occlusion->params);
    return result;
}

void hair_draw_cull_occluded(struct hair_renderer* renderer, struct hair_draw_plan* plan)
{
    struct hair_occlusion_params* params = &plan->occlusion;
    struct hair_gl* gl = renderer->gl;
    struct hair_occlusion* occlusion = &renderer->occlusion;
    HAIR_ASSERT(occlusion->room >= hair_hiz_texels(params->columns, params->rows));
    GLuint buffers[] = {occlusion->depth, occlusion->box};
    uint32_t parts = renderer->geometry->guides * HAIR_OCCLUSION_PARTS;
    hair_gl_pass patches = HAIR_GL_CULL_PATCHES;
    if (hair_geometry_has_hits(renderer->geometry))
        patches = hair_gl_add_features(patches, HAIR_GL_WITH(HITS));
    hair_gl_bind_buffers(gl, GL_UNIFORM_BUFFER, HAIR_BIND_OCCLUSION, 1, &occlusion->params);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_HIZ, 2, buffers);
    hair_gl_bind_texture(gl, HAIR_UNIT_OCCLUSION, plan->view->occluder_depth);
    hair_gl_bind_sampler(gl, HAIR_UNIT_OCCLUSION, gl->shadow_sampler[0]);
    hair_hiz_run(gl, occlusion->params, params);
    hair_gl_run(gl, HAIR_GL_GUIDE_BOUNDS, (parts + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE);
    hair_gl_run(gl, patches, renderer->geometry->patches);
}
