// texture_target.c - the target of a texture of the application, found without an OpenGL error in
// the core profile and in the compatibility profile.
#include "lib/gl/gl.h"

#define UNIT 0 // Texture unit that is borrowed. Every driver has it.

static const GLenum targets[][2] = {
    {GL_TEXTURE_2D, GL_TEXTURE_BINDING_2D},
    {GL_TEXTURE_3D, GL_TEXTURE_BINDING_3D},
    {GL_TEXTURE_BUFFER, GL_TEXTURE_BINDING_BUFFER},
    {GL_TEXTURE_1D, GL_TEXTURE_BINDING_1D},
    {GL_TEXTURE_1D_ARRAY, GL_TEXTURE_BINDING_1D_ARRAY},
    {GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BINDING_2D_ARRAY},
    {GL_TEXTURE_CUBE_MAP, GL_TEXTURE_BINDING_CUBE_MAP},
    {GL_TEXTURE_CUBE_MAP_ARRAY, GL_TEXTURE_BINDING_CUBE_MAP_ARRAY},
    {GL_TEXTURE_RECTANGLE, GL_TEXTURE_BINDING_RECTANGLE},
    {GL_TEXTURE_2D_MULTISAMPLE, GL_TEXTURE_BINDING_2D_MULTISAMPLE},
    {GL_TEXTURE_2D_MULTISAMPLE_ARRAY, GL_TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY},
};
#define TARGETS (sizeof targets / sizeof *targets)

// Find the binding of the unit that has the texture. A texture can be bound to its own target only.
// Return TARGETS if there is none. `bound` receives the textures of the unit.
static size_t find_binding(const struct hair_gl* gl, GLuint texture, GLint bound[TARGETS])
{
    size_t found = TARGETS;
    for (size_t i = 0; i < TARGETS; ++i) {
        bound[i] = 0;
        gl->GetIntegeri_v(targets[i][1], UNIT, &bound[i]);
        if ((GLuint)bound[i] == texture) found = i;
    }
    return found;
}

// Bind the texture, see which target has it, and restore that binding.
static GLenum find_by_binding(const struct hair_gl* gl, GLuint texture)
{
    GLint bound[TARGETS], now[TARGETS], active = GL_TEXTURE0;
    size_t found = find_binding(gl, texture, bound);
    if (found < TARGETS) return targets[found][0];
    gl->BindTextureUnit(UNIT, texture);
    found = find_binding(gl, texture, now);
    if (found == TARGETS) return 0;
    gl->GetIntegerv(GL_ACTIVE_TEXTURE, &active);
    gl->ActiveTexture(GL_TEXTURE0 + UNIT);
    gl->BindTexture(targets[found][0], (GLuint)bound[found]);
    gl->ActiveTexture((GLenum)active);
    return targets[found][0];
}

GLenum hair_gl_find_texture_target(const struct hair_gl* gl, GLuint texture)
{
    GLint profile = 0, width = 0, buffer = 0, target = 0;
    if (!texture || !gl->IsTexture(texture)) return 0;
    gl->GetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    gl->GetTextureLevelParameteriv(texture, 0, GL_TEXTURE_WIDTH, &width);
    gl->GetTextureLevelParameteriv(texture, 0, GL_TEXTURE_BUFFER_DATA_STORE_BINDING, &buffer);
    if (buffer) return GL_TEXTURE_BUFFER;
    // Mesa raises an error if asked for the target in the compatibility profile, or for that of a
    // buffer texture. A texture without a size may be a buffer texture without its buffer.
    if (!(profile & GL_CONTEXT_CORE_PROFILE_BIT) || !width) return find_by_binding(gl, texture);
    gl->GetTextureParameteriv(texture, GL_TEXTURE_TARGET, &target);
    return (GLenum)target;
}
