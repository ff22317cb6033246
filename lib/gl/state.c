// state.c - the application's OpenGL state, saved and restored. Everything that draws and
// dispatches change is saved only here. Objects are edited without binding them.
#include "lib/gl/gl.h"

static void save_buffers(struct hair_gl* gl, GLenum binding, GLenum first, GLenum size, GLsizei count,
                         GLuint* buffers, GLintptr* firsts, GLsizeiptr* sizes)
{
    for (GLsizei i = 0; i < count; ++i) {
        GLint buffer = 0;
        GLint64 first_64 = 0, size_64 = 0;
        gl->GetIntegeri_v(binding, (GLuint)i, &buffer);
        gl->GetInteger64i_v(first, (GLuint)i, &first_64);
        gl->GetInteger64i_v(size, (GLuint)i, &size_64);
        buffers[i] = (GLuint)buffer;
        firsts[i] = (GLintptr)first_64;
        sizes[i] = (GLsizeiptr)size_64;
    }
}

static void restore_buffers(struct hair_gl* gl, GLenum target, GLsizei count, const GLuint* buffers,
                            const GLintptr* firsts, const GLsizeiptr* sizes)
{
    for (GLsizei i = 0; i < count; ++i) {
        if (sizes[i] > 0) // A size of 0 means the whole buffer.
            gl->BindBuffersRange(target, (GLuint)i, 1, &buffers[i], &firsts[i], &sizes[i]);
        else
            gl->BindBuffersBase(target, (GLuint)i, 1, &buffers[i]);
    }
}

// Return the texture target that the library binds at a unit.
static GLenum target_of(GLuint unit)
{
    HAIR_ASSERT(unit < HAIR_GL_UNITS);
    if (unit == HAIR_UNIT_GROOM_COLOR || unit == HAIR_UNIT_LIGHT) return GL_TEXTURE_BUFFER;
    if (unit >= HAIR_UNIT_SHADOW) return GL_TEXTURE_2D;
    return unit >= HAIR_UNIT_FIELD ? GL_TEXTURE_3D : GL_TEXTURE_BUFFER;
}

static void save_units(struct hair_gl* gl)
{
    struct hair_gl_saved* saved = &gl->saved;
    gl->GetIntegerv(GL_ACTIVE_TEXTURE, &saved->active_texture);
    for (GLuint unit = 0; unit < HAIR_GL_UNITS; ++unit) {
        GLenum target = target_of(unit);
        GLenum binding = target == GL_TEXTURE_2D   ? GL_TEXTURE_BINDING_2D
                         : target == GL_TEXTURE_3D ? GL_TEXTURE_BINDING_3D
                                                   : GL_TEXTURE_BINDING_BUFFER;
        gl->GetIntegeri_v(binding, unit, &saved->texture[unit]);
        if (target != GL_TEXTURE_BUFFER) gl->GetIntegeri_v(GL_SAMPLER_BINDING, unit, &saved->sampler[unit]);
    }
    static const GLenum parts[] = {GL_IMAGE_BINDING_NAME,  GL_IMAGE_BINDING_LEVEL,  GL_IMAGE_BINDING_LAYERED,
                                   GL_IMAGE_BINDING_LAYER, GL_IMAGE_BINDING_ACCESS, GL_IMAGE_BINDING_FORMAT};
    for (GLuint unit = 0; unit <= HAIR_IMAGE_COLLIDER; ++unit)
        for (int i = 0; i < 6; ++i) gl->GetIntegeri_v(parts[i], unit, &saved->image[unit][i]);
}

static void restore_units(struct hair_gl* gl)
{
    const struct hair_gl_saved* saved = &gl->saved;
    for (GLuint unit = 0; unit < HAIR_GL_UNITS; ++unit) {
        // Bind by target, because glBindTextureUnit(unit, 0) would also clear the other targets of
        // the unit.
        gl->ActiveTexture(GL_TEXTURE0 + unit);
        gl->BindTexture(target_of(unit), (GLuint)saved->texture[unit]);
        if (target_of(unit) != GL_TEXTURE_BUFFER) gl->BindSampler(unit, (GLuint)saved->sampler[unit]);
    }
    gl->ActiveTexture((GLenum)saved->active_texture);
    for (GLuint unit = 0; unit <= HAIR_IMAGE_COLLIDER; ++unit) {
        const GLint* i = saved->image[unit];
        gl->BindImageTexture(unit, (GLuint)i[0], i[1], (GLboolean)i[2], i[3], (GLenum)i[4], (GLenum)i[5]);
    }
}

hair_result hair_gl_check_capture(const struct hair_gl* gl, const char* name)
{
    GLint is_active = 0;
    gl->GetIntegerv(GL_TRANSFORM_FEEDBACK_ACTIVE, &is_active);
    if (!is_active) return HAIR_OK;
    return hair_fail(&gl->host, HAIR_ERROR_OPENGL,
                     "%s captures by transform feedback itself, but that of the application is active", name);
}

// Put active transform feedback of the application aside. Programs cannot change while it is not
// paused, and cannot be linked for transform feedback while it is bound.
static void put_feedback_aside(struct hair_gl* gl)
{
    struct hair_gl_saved* saved = &gl->saved;
    GLint is_active = 0;
    gl->GetIntegerv(GL_TRANSFORM_FEEDBACK_ACTIVE, &is_active);
    saved->is_feedback_aside = is_active != 0;
    if (!is_active) return;
    gl->GetIntegerv(GL_TRANSFORM_FEEDBACK_PAUSED, &saved->feedback_paused);
    gl->GetIntegerv(GL_TRANSFORM_FEEDBACK_BINDING, &saved->feedback);
    gl->GetIntegerv(GL_CURRENT_PROGRAM, &saved->program);
    if (!saved->feedback_paused) gl->PauseTransformFeedback();
    if (!gl->idle_feedback) gl->CreateTransformFeedbacks(1, &gl->idle_feedback);
    gl->BindTransformFeedback(GL_TRANSFORM_FEEDBACK, gl->idle_feedback);
}

// Restore transform feedback of the application. OpenGL resumes it only with its program.
static void restore_feedback(struct hair_gl* gl)
{
    const struct hair_gl_saved* saved = &gl->saved;
    if (!saved->is_feedback_aside) return;
    gl->BindTransformFeedback(GL_TRANSFORM_FEEDBACK, (GLuint)saved->feedback);
    gl->UseProgram((GLuint)saved->program);
    if (!saved->feedback_paused) gl->ResumeTransformFeedback();
}

void hair_gl_enter(struct hair_gl* gl)
{
    put_feedback_aside(gl);
    if (gl->state_policy == HAIR_GL_STATE_CLOBBER) return;
    struct hair_gl_saved* saved = &gl->saved;
    gl->GetIntegerv(GL_CURRENT_PROGRAM, &saved->program);
    gl->GetIntegerv(GL_VERTEX_ARRAY_BINDING, &saved->vertex_array);
    gl->GetIntegerv(GL_PATCH_VERTICES, &saved->patch_vertices);
    gl->GetIntegerv(GL_DRAW_INDIRECT_BUFFER_BINDING, &saved->draw_indirect);
    gl->GetIntegerv(GL_DISPATCH_INDIRECT_BUFFER_BINDING, &saved->dispatch_indirect);
    saved->cull = gl->IsEnabled(GL_CULL_FACE);
    saved->restarts = gl->IsEnabled(GL_PRIMITIVE_RESTART);
    save_units(gl);
    save_buffers(gl, GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_START,
                 GL_SHADER_STORAGE_BUFFER_SIZE, HAIR_BIND_REDUCTION + 1, saved->storage, saved->storage_first,
                 saved->storage_size);
    save_buffers(gl, GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE,
                 HAIR_BIND_FIELD + 1, saved->uniform, saved->uniform_first, saved->uniform_size);
}

void hair_gl_enter_for(struct hair_gl* gl, struct hair_gl_owner* owner, struct hair_gl_profiler* profiler)
{
    HAIR_ASSERT(!gl->owner && !gl->profiler);
    hair_gl_enter(gl);
    hair_gl_set_owner(gl, owner, profiler);
}

void hair_gl_set_owner(struct hair_gl* gl, struct hair_gl_owner* owner, struct hair_gl_profiler* profiler)
{
    gl->owner = owner;
    gl->profiler = profiler;
}

// Unbind everything that the library may delete. A program that is deleted while current cannot be
// made current again by an application that restores it. Mesa unbinds a deleted buffer with
// glBindBufferBase, which also clears the application's generic binding.
void hair_gl_unbind(struct hair_gl* gl)
{
    gl->UseProgram(0);
    gl->BindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
    gl->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, 0, HAIR_BIND_REDUCTION + 1, NULL);
    gl->BindBuffersBase(GL_UNIFORM_BUFFER, 0, HAIR_BIND_FIELD + 1, NULL);
    for (GLuint unit = 0; unit <= HAIR_IMAGE_COLLIDER; ++unit)
        gl->BindImageTexture(unit, 0, 0, GL_FALSE, 0, GL_READ_ONLY, GL_R8);
}

void hair_gl_leave(struct hair_gl* gl)
{
    gl->profiler = NULL;
    gl->owner = NULL;
    if (gl->state_policy == HAIR_GL_STATE_CLOBBER) {
        hair_gl_unbind(gl);
        restore_feedback(gl);
        return;
    }
    struct hair_gl_saved* saved = &gl->saved;
    gl->UseProgram((GLuint)saved->program);
    gl->BindVertexArray((GLuint)saved->vertex_array);
    gl->PatchParameteri(GL_PATCH_VERTICES, saved->patch_vertices);
    gl->BindBuffer(GL_DRAW_INDIRECT_BUFFER, (GLuint)saved->draw_indirect);
    gl->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, (GLuint)saved->dispatch_indirect);
    (saved->cull ? gl->Enable : gl->Disable)(GL_CULL_FACE);
    (saved->restarts ? gl->Enable : gl->Disable)(GL_PRIMITIVE_RESTART);
    restore_units(gl);
    restore_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_REDUCTION + 1, saved->storage,
                    saved->storage_first, saved->storage_size);
    restore_buffers(gl, GL_UNIFORM_BUFFER, HAIR_BIND_FIELD + 1, saved->uniform, saved->uniform_first,
                    saved->uniform_size);
    restore_feedback(gl);
}

GLint hair_gl_begin_query_reads(struct hair_gl* gl)
{
    GLint buffer = 0;
    gl->GetIntegerv(GL_QUERY_BUFFER_BINDING, &buffer);
    if (buffer) gl->BindBuffer(GL_QUERY_BUFFER, 0);
    return buffer;
}

void hair_gl_end_query_reads(struct hair_gl* gl, GLint buffer)
{
    if (buffer) gl->BindBuffer(GL_QUERY_BUFFER, (GLuint)buffer);
}

GLuint hair_gl_blank_framebuffer(struct hair_gl* gl)
{
    GLuint framebuffer = 0;
    gl->CreateFramebuffers(1, &framebuffer);
    if (!framebuffer) return 0;
    gl->NamedFramebufferParameteri(framebuffer, GL_FRAMEBUFFER_DEFAULT_WIDTH, 1);
    gl->NamedFramebufferParameteri(framebuffer, GL_FRAMEBUFFER_DEFAULT_HEIGHT, 1);
    return framebuffer;
}

void hair_gl_begin_capture(struct hair_gl* gl, GLuint framebuffer, struct hair_gl_capture* was)
{
    was->discard = gl->IsEnabled(GL_RASTERIZER_DISCARD);
    gl->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &was->framebuffer);
    gl->GetIntegerv(GL_TRANSFORM_FEEDBACK_BINDING, &was->feedback);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    gl->BindVertexArray(gl->vertex_array);
    gl->Enable(GL_RASTERIZER_DISCARD);
}

void hair_gl_end_capture(struct hair_gl* gl, const struct hair_gl_capture* was)
{
    if (!was->discard) gl->Disable(GL_RASTERIZER_DISCARD);
    gl->BindTransformFeedback(GL_TRANSFORM_FEEDBACK, (GLuint)was->feedback);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, (GLuint)was->framebuffer);
}
