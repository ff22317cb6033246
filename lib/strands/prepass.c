// prepass.c - first vertex of each follower inside a collider, by the method of Tariq 2010.
// Vertices are drawn as points, with one texel per follower, and blending keeps the minimum.
//
// Only this file draws into a framebuffer of the library's own, with blending. It restores that
// state of the application at once.
#include "lib/strands/geometry.h"

#define CLIP_DISTANCES 8

hair_result hair_geometry_ensure_prepass(struct hair_geometry* geometry)
{
    struct hair_gl* gl = geometry->gl;
    struct hair_follower_collision_state* follower_collision = &geometry->follower_collision;
    GLsizei rows = (GLsizei)((geometry->followers + HAIR_HIT_COLUMNS - 1) / HAIR_HIT_COLUMNS);
    hair_result result = HAIR_OK;
    if (!follower_collision->image)
        result = hair_gl_texture_2d(gl, HAIR_GL_CATEGORY_HIT, "hair hits", GL_R32F, HAIR_HIT_COLUMNS,
                                    (uint32_t)rows, &follower_collision->image);
    if (result) return result;
    if (!follower_collision->frame) {
        gl->CreateFramebuffers(1, &follower_collision->frame);
        if (follower_collision->frame)
            gl->NamedFramebufferTexture(follower_collision->frame, GL_COLOR_ATTACHMENT0,
                                        follower_collision->image, 0);
    }
    GLenum status = follower_collision->frame
                        ? gl->CheckNamedFramebufferStatus(follower_collision->frame, GL_DRAW_FRAMEBUFFER)
                        : GL_FRAMEBUFFER_UNDEFINED;
    if (status != GL_FRAMEBUFFER_COMPLETE)
        return hair_fail(&gl->host, HAIR_ERROR_MEMORY,
                         "the driver has no framebuffer of %u by %d for hair hits", HAIR_HIT_COLUMNS,
                         (int)rows);
    return HAIR_OK;
}

struct saved {
    GLint frame, equation[2], clip_origin, clip_depth;
    GLfloat viewport[4], point_size;
    GLboolean mask[4], blends, scissors, discards, sizes_points, operates, clips[CLIP_DISTANCES];
};

static void set(struct hair_gl* gl, GLenum what, GLboolean on)
{
    (on ? gl->Enable : gl->Disable)(what);
}

static void enter(struct hair_gl* gl, struct saved* saved)
{
    gl->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &saved->frame);
    gl->GetIntegeri_v(GL_BLEND_EQUATION_RGB, 0, &saved->equation[0]);
    gl->GetIntegeri_v(GL_BLEND_EQUATION_ALPHA, 0, &saved->equation[1]);
    gl->GetIntegerv(GL_CLIP_ORIGIN, &saved->clip_origin);
    gl->GetIntegerv(GL_CLIP_DEPTH_MODE, &saved->clip_depth);
    gl->GetFloati_v(GL_VIEWPORT, 0, saved->viewport);
    gl->GetFloatv(GL_POINT_SIZE, &saved->point_size);
    gl->GetBooleani_v(GL_COLOR_WRITEMASK, 0, saved->mask);
    saved->blends = gl->IsEnabledi(GL_BLEND, 0);
    saved->scissors = gl->IsEnabledi(GL_SCISSOR_TEST, 0);
    saved->discards = gl->IsEnabled(GL_RASTERIZER_DISCARD);
    saved->sizes_points = gl->IsEnabled(GL_PROGRAM_POINT_SIZE);
    saved->operates = gl->IsEnabled(GL_COLOR_LOGIC_OP);
    for (GLenum i = 0; i < CLIP_DISTANCES; ++i) {
        saved->clips[i] = gl->IsEnabled(GL_CLIP_DISTANCE0 + i);
        set(gl, GL_CLIP_DISTANCE0 + i, 0);
    }
    gl->BlendEquationSeparatei(0, GL_MIN, GL_MIN);
    gl->ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    gl->PointSize(1);
    gl->ColorMaski(0, 1, 1, 1, 1);
    gl->Enablei(GL_BLEND, 0);
    gl->Disablei(GL_SCISSOR_TEST, 0);
    set(gl, GL_RASTERIZER_DISCARD, 0);
    set(gl, GL_PROGRAM_POINT_SIZE, 0);
    set(gl, GL_COLOR_LOGIC_OP, 0);
}

static void leave(struct hair_gl* gl, const struct saved* saved)
{
    const GLfloat* v = saved->viewport;
    const GLboolean* m = saved->mask;
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, (GLuint)saved->frame);
    gl->BlendEquationSeparatei(0, (GLenum)saved->equation[0], (GLenum)saved->equation[1]);
    gl->ClipControl((GLenum)saved->clip_origin, (GLenum)saved->clip_depth);
    gl->ViewportIndexedf(0, v[0], v[1], v[2], v[3]);
    gl->PointSize(saved->point_size);
    gl->ColorMaski(0, m[0], m[1], m[2], m[3]);
    (saved->blends ? gl->Enablei : gl->Disablei)(GL_BLEND, 0);
    (saved->scissors ? gl->Enablei : gl->Disablei)(GL_SCISSOR_TEST, 0);
    set(gl, GL_RASTERIZER_DISCARD, saved->discards);
    set(gl, GL_PROGRAM_POINT_SIZE, saved->sizes_points);
    set(gl, GL_COLOR_LOGIC_OP, saved->operates);
    for (GLenum i = 0; i < CLIP_DISTANCES; ++i) set(gl, GL_CLIP_DISTANCE0 + i, saved->clips[i]);
}

void hair_geometry_run_prepass(struct hair_geometry* geometry)
{
    static const GLfloat none = HAIR_NO_HIT;
    struct hair_gl* gl = geometry->gl;
    struct saved saved;
    uint32_t rows = (geometry->followers + HAIR_HIT_COLUMNS - 1) / HAIR_HIT_COLUMNS;
    HAIR_ASSERT(geometry->follower_collision.image && geometry->follower_collision.frame);
    bool was_recording = hair_gl_run_at_once(gl);
    enter(gl, &saved);
    gl->ClearTexImage(geometry->follower_collision.image, 0, GL_RED, GL_FLOAT, &none);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, geometry->follower_collision.frame);
    gl->ViewportIndexedf(0, 0, 0, HAIR_HIT_COLUMNS, (GLfloat)rows);
    gl->BindVertexArray(gl->vertex_array);
    hair_gl_pass pass = hair_geometry_add_style(geometry, HAIR_GL_PREPASS);
    hair_gl_begin(gl, pass);
    hair_geometry_draw_patches(geometry);
    hair_gl_end(gl, pass);
    leave(gl, &saved);
    hair_gl_record_again(gl, was_recording);
    hair_gl_bind_sampler(gl, HAIR_UNIT_SHADOW, 0);
    hair_gl_bind_texture(gl, HAIR_UNIT_SHADOW, geometry->follower_collision.image);
}
