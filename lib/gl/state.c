// state.c - the application's OpenGL state, saved and restored. Everything that draws and
// dispatches change is saved only here. Objects are edited without binding them. Slots and units
// are saved when something is first bound there, because most passes bind few.
#include "lib/gl/gl.h"

// Return the bits of the slots from `first` to `first + count`.
static uint32_t bits_of(GLuint first, GLsizei count)
{
    HAIR_ASSERT(count > 0 && first + (GLuint)count <= 32);
    return (UINT32_MAX >> (32 - count)) << first;
}

static void save_slot(struct hair_gl* gl, GLenum binding, GLenum first, GLenum size, GLuint slot,
                      struct hair_gl_saved_slots* saved)
{
    GLint buffer = 0;
    GLint64 first_64 = 0, size_64 = 0;
    gl->GetIntegeri_v(binding, slot, &buffer);
    if (buffer) {
        gl->GetInteger64i_v(first, slot, &first_64);
        gl->GetInteger64i_v(size, slot, &size_64);
    }
    saved->buffer[slot] = (GLuint)buffer;
    saved->first[slot] = (GLintptr)first_64;
    saved->size[slot] = (GLsizeiptr)size_64;
}

void hair_gl_save_slots(struct hair_gl* gl, GLenum target, GLuint first, GLsizei count)
{
    bool is_uniform = target == GL_UNIFORM_BUFFER;
    struct hair_gl_saved_slots* saved = is_uniform ? &gl->saved.uniform : &gl->saved.storage;
    uint32_t missing = bits_of(first, count) & ~saved->slots;
    if (!missing || gl->state_policy == HAIR_GL_STATE_CLOBBER) return;
    saved->slots |= missing;
    for (GLuint slot = first; slot < first + (GLuint)count; ++slot) {
        if (!(missing >> slot & 1)) continue;
        HAIR_ASSERT(slot < HAIR_GL_SAVED_SLOTS);
        if (is_uniform)
            save_slot(gl, GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE, slot,
                      saved);
        else
            save_slot(gl, GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_START,
                      GL_SHADER_STORAGE_BUFFER_SIZE, slot, saved);
    }
}

// Return whether a slot is saved that had a whole buffer or none, of which the size is 0.
static bool was_whole(const struct hair_gl_saved_slots* saved, GLuint slot)
{
    return slot < HAIR_GL_SAVED_SLOTS && saved->slots >> slot & 1 && saved->size[slot] == 0;
}

static void restore_slots(struct hair_gl* gl, GLenum target, const struct hair_gl_saved_slots* saved)
{
    for (GLuint i = 0; i < HAIR_GL_SAVED_SLOTS; ++i) {
        GLuint end = i;
        while (was_whole(saved, end)) ++end;
        if (end > i) {
            gl->BindBuffersBase(target, i, (GLsizei)(end - i), &saved->buffer[i]);
            i = end - 1;
        } else if (saved->slots >> i & 1) {
            gl->BindBuffersRange(target, i, 1, &saved->buffer[i], &saved->first[i], &saved->size[i]);
        }
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

void hair_gl_save_units(struct hair_gl* gl, GLuint first, GLsizei count)
{
    struct hair_gl_saved* saved = &gl->saved;
    uint32_t missing = bits_of(first, count) & ~saved->units;
    if (!missing || gl->state_policy == HAIR_GL_STATE_CLOBBER) return;
    if (!saved->units) gl->GetIntegerv(GL_ACTIVE_TEXTURE, &saved->active_texture);
    saved->units |= missing;
    for (GLuint unit = first; unit < first + (GLuint)count; ++unit) {
        if (!(missing >> unit & 1)) continue;
        GLenum target = target_of(unit);
        GLenum binding = target == GL_TEXTURE_2D   ? GL_TEXTURE_BINDING_2D
                         : target == GL_TEXTURE_3D ? GL_TEXTURE_BINDING_3D
                                                   : GL_TEXTURE_BINDING_BUFFER;
        gl->GetIntegeri_v(binding, unit, &saved->texture[unit]);
        if (target != GL_TEXTURE_BUFFER) gl->GetIntegeri_v(GL_SAMPLER_BINDING, unit, &saved->sampler[unit]);
    }
}

static void restore_units(struct hair_gl* gl)
{
    const struct hair_gl_saved* saved = &gl->saved;
    for (GLuint unit = 0; unit < HAIR_GL_UNITS; ++unit) {
        if (!(saved->units >> unit & 1)) continue;
        // Bind by target, because glBindTextureUnit(unit, 0) would also clear the other targets of
        // the unit.
        gl->ActiveTexture(GL_TEXTURE0 + unit);
        gl->BindTexture(target_of(unit), (GLuint)saved->texture[unit]);
        if (target_of(unit) != GL_TEXTURE_BUFFER) gl->BindSampler(unit, (GLuint)saved->sampler[unit]);
    }
    if (saved->units) gl->ActiveTexture((GLenum)saved->active_texture);
}

void hair_gl_save_image(struct hair_gl* gl, GLuint unit)
{
    static const GLenum parts[] = {GL_IMAGE_BINDING_NAME,  GL_IMAGE_BINDING_LEVEL,  GL_IMAGE_BINDING_LAYERED,
                                   GL_IMAGE_BINDING_LAYER, GL_IMAGE_BINDING_ACCESS, GL_IMAGE_BINDING_FORMAT};
    HAIR_ASSERT(unit <= HAIR_IMAGE_COLLIDER);
    if (gl->saved.images >> unit & 1 || gl->state_policy == HAIR_GL_STATE_CLOBBER) return;
    gl->saved.images |= 1u << unit;
    for (int i = 0; i < 6; ++i) gl->GetIntegeri_v(parts[i], unit, &gl->saved.image[unit][i]);
}

void hair_gl_save_all_slots(struct hair_gl* gl)
{
    hair_gl_save_slots(gl, GL_SHADER_STORAGE_BUFFER, 0, HAIR_BIND_REDUCTION + 1);
    hair_gl_save_slots(gl, GL_UNIFORM_BUFFER, 0, HAIR_BIND_FIELD + 1);
    for (GLuint unit = 0; unit <= HAIR_IMAGE_COLLIDER; ++unit) hair_gl_save_image(gl, unit);
}

static void restore_images(struct hair_gl* gl)
{
    for (GLuint unit = 0; unit <= HAIR_IMAGE_COLLIDER; ++unit) {
        const GLint* i = gl->saved.image[unit];
        if (gl->saved.images >> unit & 1)
            gl->BindImageTexture(unit, (GLuint)i[0], i[1], (GLboolean)i[2], i[3], (GLenum)i[4], (GLenum)i[5]);
    }
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
    saved->storage.slots = saved->uniform.slots = saved->units = saved->images = 0;
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
    hair_gl_save_all_slots(gl);
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
    restore_images(gl);
    restore_slots(gl, GL_SHADER_STORAGE_BUFFER, &saved->storage);
    restore_slots(gl, GL_UNIFORM_BUFFER, &saved->uniform);
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
