// glstate_legacy.c - state of the compatibility profile that the core profile does not have.
#include "tests/support/glstate.h"

#include <epoxy/gl.h>

#define NAME(name) #name, name
#define COUNT(rows) (sizeof rows / sizeof *rows)

static const struct {
    const char* name;
    GLenum what;
    int count; // number of its components
} reals[] = {
    {NAME(GL_ALPHA_TEST_FUNC), 1},
    {NAME(GL_ALPHA_TEST_REF), 1},
    {NAME(GL_ATTRIB_STACK_DEPTH), 1},
    {NAME(GL_CLIENT_ACTIVE_TEXTURE), 1},
    {NAME(GL_CLIENT_ATTRIB_STACK_DEPTH), 1},
    {NAME(GL_COLOR_MATERIAL_FACE), 1},
    {NAME(GL_CURRENT_COLOR), 4},
    {NAME(GL_CURRENT_NORMAL), 3},
    {NAME(GL_CURRENT_TEXTURE_COORDS), 4},
    {NAME(GL_FOG_COLOR), 4},
    {NAME(GL_FOG_DENSITY), 1},
    {NAME(GL_FOG_MODE), 1},
    {NAME(GL_LIGHT_MODEL_TWO_SIDE), 1},
    {NAME(GL_LINE_STIPPLE_PATTERN), 1},
    {NAME(GL_LINE_STIPPLE_REPEAT), 1},
    {NAME(GL_MATRIX_MODE), 1},
    {NAME(GL_MODELVIEW_MATRIX), 16},
    {NAME(GL_MODELVIEW_STACK_DEPTH), 1},
    {NAME(GL_PROJECTION_MATRIX), 16},
    {NAME(GL_SHADE_MODEL), 1},
    {NAME(GL_VERTEX_ARRAY_SIZE), 1},
    {NAME(GL_VERTEX_ARRAY_STRIDE), 1},
};

static const struct {
    const char* name;
    GLenum what;
} switches[] = {
    {NAME(GL_ALPHA_TEST)},
    {NAME(GL_COLOR_ARRAY)},
    {NAME(GL_COLOR_MATERIAL)},
    {NAME(GL_FOG)},
    {NAME(GL_LIGHTING)},
    {NAME(GL_LIGHT1)},
    {NAME(GL_LINE_STIPPLE)},
    {NAME(GL_NORMALIZE)},
    {NAME(GL_POINT_SPRITE)},
    {NAME(GL_TEXTURE_2D)},
    {NAME(GL_TEXTURE_GEN_S)},
    {NAME(GL_VERTEX_ARRAY)},
    {NAME(GL_VERTEX_PROGRAM_TWO_SIDE)},
};

int hair_test_glstate_is_legacy(void)
{
    GLint profile = 0;
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    return (profile & GL_CONTEXT_COMPATIBILITY_PROFILE_BIT) != 0;
}

void hair_test_glstate_read_legacy(struct hair_test_glstate* out)
{
    for (size_t i = 0; i < COUNT(reals); ++i) {
        float values[16] = {0};
        glGetFloatv(reals[i].what, values);
        hair_test_glstate_put_reals(out, reals[i].name, reals[i].count, values);
    }
    for (size_t i = 0; i < COUNT(switches); ++i)
        hair_test_glstate_put(out, switches[i].name, -1, glIsEnabled(switches[i].what));
}

void hair_test_glstate_disturb_legacy(void)
{
    static const float matrix[16] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
    static const float points[6] = {0, 1, 2, 3, 4, 5};
    for (size_t i = 0; i < COUNT(switches); ++i)
        if (switches[i].what != GL_VERTEX_ARRAY && switches[i].what != GL_COLOR_ARRAY)
            glEnable(switches[i].what);
    glAlphaFunc(GL_GREATER, 0.25f);
    glPushAttrib(GL_ENABLE_BIT);
    glPushClientAttrib(GL_CLIENT_VERTEX_ARRAY_BIT);
    glClientActiveTexture(GL_TEXTURE2);
    glColorMaterial(GL_BACK, GL_AMBIENT);
    glColor4f(0.1f, 0.2f, 0.3f, 0.4f);
    glNormal3f(0, 0.6f, 0.8f);
    glMultiTexCoord4f(GL_TEXTURE3, 1, 2, 3, 4);
    glFogfv(GL_FOG_COLOR, matrix);
    glFogf(GL_FOG_DENSITY, 0.3f);
    glFogi(GL_FOG_MODE, GL_EXP2);
    glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, 1);
    glLineStipple(3, 0x5a5a);
    glMatrixMode(GL_PROJECTION);
    glLoadMatrixf(matrix);
    glMatrixMode(GL_MODELVIEW);
    glPushMatrix();
    glLoadMatrixf(matrix);
    glMatrixMode(GL_TEXTURE);
    glShadeModel(GL_FLAT);
    // The application's vertex array 0 has pointers to its own memory.
    glBindVertexArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glVertexPointer(3, GL_FLOAT, 12, points);
    glEnableClientState(GL_VERTEX_ARRAY);
    glEnableClientState(GL_COLOR_ARRAY);
}
