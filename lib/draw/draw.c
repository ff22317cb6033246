// draw.c - tessellated strands in batches, as lines or ribbons, in colour or depth; guides for debugging.
#include "lib/draw/draw.h"
#include "lib/draw/params.h"

hair_result hair_draw_create(struct hair_draw* draw, struct hair_gl* gl, const struct hair_groom* groom,
                             const struct hair_sim* sim)
{
    draw->gl              = gl;
    draw->guides          = sim->guides;
    draw->smooth_vertices = sim->smooth_vertices;
    draw->followers       = groom->info.follower_count;
    draw->patches         = groom->info.patch_count;
    draw->map_sets        = groom->map_sets;
    draw->skull           = groom->skull;
    for (uint32_t i = 0; i < draw->patches; ++i)
        if (groom->patches[i].count > draw->most_isolines) draw->most_isolines = groom->patches[i].count;
    hair_result result = hair_gl_buffer(gl, "hair followers", draw->followers * sizeof *groom->followers,
                                        groom->followers, &draw->follower);
    if (!result)
        result = hair_gl_buffer(gl, "hair patches", draw->patches * sizeof *groom->patches, groom->patches,
                                &draw->patch);
    if (!result) result = hair_gl_uniform(gl, "hair draw", sizeof(struct hair_draw_params), &draw->params);
    if (!result)
        result = hair_gl_buffer_texture(gl, "hair followers", GL_RGBA32UI, draw->follower,
                                        &draw->follower_texture);
    if (!result)
        result = hair_gl_buffer_texture(gl, "hair patches", GL_RGBA32UI, draw->patch, &draw->patch_texture);
    return result;
}

void hair_draw_destroy(struct hair_draw* draw)
{
    if (!draw->gl) return;
    hair_draw_free_hits(draw);
    hair_draw_free_fibres(draw);
    hair_gl_free_texture(draw->gl, &draw->follower_texture);
    hair_gl_free_texture(draw->gl, &draw->patch_texture);
    hair_gl_free_buffer(draw->gl, &draw->follower);
    hair_gl_free_buffer(draw->gl, &draw->patch);
    hair_gl_free_buffer(draw->gl, &draw->params);
}

void hair_draw_bind(struct hair_draw* draw, const struct hair_smooth* smooth, GLuint shadow_texture)
{
    struct hair_gl* gl         = draw->gl;
    GLuint          textures[] = {smooth->texture[0],     smooth->texture[1],       smooth->texture[2],
                                  draw->follower_texture, draw->patch_texture,      shadow_texture,
                                  draw->hits.hit_texture, draw->hits.repair_texture};
    if (draw->fibres.texture) gl->BindTextureUnit(HAIR_UNIT_FIBRE, draw->fibres.texture);
    gl->BindSampler(HAIR_UNIT_FIBRE, 0);
    for (GLuint unit = 0; unit <= HAIR_UNIT_REPAIR; ++unit)
        if (textures[unit]) gl->BindTextureUnit(unit, textures[unit]);
    gl->BindSampler(HAIR_UNIT_SHADOW, gl->shadow_sampler);
    gl->BindBuffersBase(GL_UNIFORM_BUFFER, HAIR_BIND_DRAW, 1, &draw->params);
}

// Patches of one draw: as many as generate no more vertices than the driver keeps, all having the most isolines.
static uint32_t batch_size(const struct hair_draw* draw)
{
    uint32_t segments = draw->look.segments;
    if (segments > HAIR_MAX_ISOLINE_SEGMENTS) segments = HAIR_MAX_ISOLINE_SEGMENTS;
    uint32_t patches = draw->gl->max_draw_vertices / (HAIR_MAX_ISOLINES * (segments + 1));
    return patches < 1 ? 1 : patches;
}

void hair_draw_patches(struct hair_draw* draw)
{
    struct hair_gl* gl    = draw->gl;
    uint32_t        batch = batch_size(draw);
    uint32_t        parts = (draw->look.segments + HAIR_MAX_ISOLINE_SEGMENTS - 1) / HAIR_MAX_ISOLINE_SEGMENTS;
    parts *= (draw->most_isolines + HAIR_MAX_ISOLINES - 1) / HAIR_MAX_ISOLINES;
    gl->PatchParameteri(GL_PATCH_VERTICES, 1);
    for (uint32_t first = 0; first < draw->patches; first += batch) {
        uint32_t count = draw->patches - first < batch ? draw->patches - first : batch;
        gl->DrawArraysInstanced(GL_PATCHES, (GLint)first, (GLsizei)count, (GLsizei)parts);
    }
}

// Of the rows of a DRAW_PASS, each of which is two.
static hair_gl_pass pass_of(const struct hair_draw* draw, const hair_view* view)
{
    if (view->pass == HAIR_PASS_GUIDES) return HAIR_GL_GUIDES;
    int depth = view->pass == HAIR_PASS_DEPTH, fibres = !depth && draw->look.shading == HAIR_SHADING_FIBRES;
    int row = (view->primitive == HAIR_LINES) + 2 * depth + 4 * fibres;
    return HAIR_GL_TESSELLATED_RIBBONS + 2 * row;
}

hair_result hair_draw_run(struct hair_draw* draw, const struct hair_smooth* smooth,
                          const struct hair_pose* head, const hair_view* view)
{
    struct hair_gl* gl     = draw->gl;
    hair_gl_pass    pass   = pass_of(draw, view);
    int             guides = pass == HAIR_GL_GUIDES;
    if (!guides && draw->look.density <= 0) return HAIR_OK;
    hair_result result = hair_draw_need(draw, &pass);
    if (result) return result;

    if (view->pass == HAIR_PASS_COLOR && draw->look.shading == HAIR_SHADING_FIBRES) {
        result = hair_draw_need_fibres(draw);
        if (result) return result;
    }

    struct hair_draw_params params;
    hair_draw_write_params(draw, head, view, &params);
    hair_gl_write_uniform(gl, draw->params, sizeof params, &params);

    hair_draw_bind(draw, smooth, view->pass == HAIR_PASS_COLOR ? view->shadow_texture : 0);
    gl->BindVertexArray(gl->vertex_array);
    gl->Disable(GL_CULL_FACE); // A ribbon faces the eye either way round.
    hair_gl_begin(gl, pass);
    if (guides)
        gl->DrawArraysInstanced(GL_LINE_STRIP, 0, (GLsizei)draw->smooth_vertices, (GLsizei)draw->guides);
    else
        hair_draw_patches(draw);
    hair_gl_end(gl, pass);
    return HAIR_OK;
}

hair_result hair_draw_expand(struct hair_draw* draw, const struct hair_smooth* smooth, hair_vec4** out)
{
    struct hair_gl* gl       = draw->gl;
    size_t          count    = (size_t)draw->followers * (draw->look.segments + 1);
    size_t          size     = count * sizeof(hair_vec4);
    GLuint          expanded = 0;
    hair_vec4*      vertices = hair_alloc(&gl->host, count, sizeof *vertices);
    if (!vertices) return hair_fail_memory(&gl->host, "the followers to read");
    hair_gl_pass pass   = HAIR_GL_EXPAND;
    hair_result  result = hair_draw_need(draw, &pass);
    if (!result) result = hair_gl_storage(gl, "hair expanded", size, NULL, &expanded);
    if (!result) {
        struct hair_draw_params params;
        hair_draw_write_params(draw, NULL, NULL, &params);
        hair_gl_write_uniform(gl, draw->params, sizeof params, &params);
        hair_draw_bind(draw, smooth, 0);
        gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_EXPANDED, 1, &expanded);
        hair_gl_run(gl, pass, (uint32_t)((count + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE));
        gl->GetNamedBufferSubData(expanded, 0, (GLsizeiptr)size, vertices);
        // Mesa unbinds a buffer that is deleted by glBindBufferBase, which takes the host's general binding with it.
        gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_EXPANDED, 1, NULL);
    }
    hair_gl_free_buffer(gl, &expanded);
    if (result) {
        hair_free(&gl->host, vertices);
        return result;
    }
    *out = vertices;
    return HAIR_OK;
}
