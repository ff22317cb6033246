// render.c - the picture around the hair: background, head, shadow map, many samples, and the way to 8 bits.
#include "tools/common/render.h"
#include "tools/common/file.h"
#include "tools/common/shaders.h"
#include "tools/common/subject.h"

#include <epoxy/gl.h>

#include <stdlib.h>
#include <string.h>

#define SHADOW_SIZE 2048
#define MAX_TILE 4096 // Pixels drawn at once, in each direction: what any OpenGL 4.5 can hold.

enum program { BACKGROUND, SKIN, DEPTH, TONE, PROGRAM_COUNT };
enum buffer { POSITIONS, NORMALS, COLORS, TRIANGLES, BUFFER_COUNT }; // the first three are attributes too
enum target { SHADOW, DRAWN, RESOLVED, ENCODED, TARGET_COUNT };

struct hair_render {
    const char*             tool;
    struct hair_render_desc desc;
    struct hair_image       image;
    uint32_t                tile; // side, in the picture's pixels
    GLuint                  program[PROGRAM_COUNT];
    GLuint                  framebuffer[TARGET_COUNT];
    GLuint                  color_samples, depth_samples;          // renderbuffers
    GLuint                  shadow, resolved, encoded, linear;     // textures
    GLuint                  shadow_sampler, vertex_array, nothing; // nothing: a vertex array without vertices
    GLuint                  buffer[BUFFER_COUNT];
    uint32_t                indices;
    float                   bend[2];
};

// Programs --------------------------------------------------------------------------------------------------

static GLuint compile(const char* tool, GLenum stage, const char* text)
{
    GLuint shader = glCreateShader(stage);
    GLint  good;
    glShaderSource(shader, 1, &text, NULL);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good) return shader;
    char reason[512] = "";
    glGetShaderInfoLog(shader, sizeof reason, NULL, reason);
    hair_complain(tool, "a shader does not compile: %s", reason);
    glDeleteShader(shader);
    return 0;
}

static GLuint link_program(const char* tool, const char* vert, const char* frag)
{
    GLuint vertex = compile(tool, GL_VERTEX_SHADER, vert), fragment = compile(tool, GL_FRAGMENT_SHADER, frag);
    GLuint program = glCreateProgram();
    GLint  good    = 0;
    if (vertex && fragment) {
        glAttachShader(program, vertex);
        glAttachShader(program, fragment);
        glLinkProgram(program);
        glGetProgramiv(program, GL_LINK_STATUS, &good);
        if (!good) hair_complain(tool, "a program does not link");
    }
    glDeleteShader(vertex);
    glDeleteShader(fragment);
    if (good) return program;
    glDeleteProgram(program);
    return 0;
}

static bool make_programs(struct hair_render* render)
{
    static const char* const text[PROGRAM_COUNT][2] = {[BACKGROUND] = {hair_whole_vert, hair_background_frag},
                                                       [SKIN]       = {hair_mesh_vert, hair_skin_frag},
                                                       [DEPTH]      = {hair_mesh_vert, hair_nothing_frag},
                                                       [TONE]       = {hair_whole_vert, hair_tone_frag}};
    for (int i = 0; i < PROGRAM_COUNT; ++i) {
        render->program[i] = link_program(render->tool, text[i][0], text[i][1]);
        if (!render->program[i]) return false;
    }
    return true;
}

// Targets ---------------------------------------------------------------------------------------------------

static GLuint make_texture(GLenum format, GLsizei width, GLsizei height)
{
    GLuint texture;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, format, width, height);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

static GLuint make_samples(GLenum format, GLsizei samples, GLsizei width, GLsizei height)
{
    GLuint buffer;
    glCreateRenderbuffers(1, &buffer);
    glNamedRenderbufferStorageMultisample(buffer, samples, format, width, height);
    return buffer;
}

// What the hair's own shadows and the head's share: depth from the light, compared only for the head.
static void make_shadow(struct hair_render* render)
{
    render->shadow = make_texture(GL_DEPTH_COMPONENT32F, SHADOW_SIZE, SHADOW_SIZE);
    glCreateSamplers(1, &render->shadow_sampler);
    GLuint sampler = render->shadow_sampler;
    glSamplerParameteri(sampler, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glSamplerParameteri(sampler, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    glSamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glSamplerParameteri(sampler, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glSamplerParameteri(sampler, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(sampler, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glNamedFramebufferTexture(render->framebuffer[SHADOW], GL_DEPTH_ATTACHMENT, render->shadow, 0);
    glNamedFramebufferDrawBuffer(render->framebuffer[SHADOW], GL_NONE);
}

static bool make_targets(struct hair_render* render)
{
    const struct hair_render_desc* desc   = &render->desc;
    GLsizei                        tile   = (GLsizei)render->tile;
    GLsizei                        width  = (GLsizei)desc->width < tile ? (GLsizei)desc->width : tile;
    GLsizei                        height = (GLsizei)desc->height < tile ? (GLsizei)desc->height : tile;
    GLsizei wide = width * (GLsizei)desc->supersample, high = height * (GLsizei)desc->supersample;
    GLint   most = 1;
    glGetIntegerv(GL_MAX_SAMPLES, &most);
    GLsizei samples = (GLint)desc->samples < most ? (GLsizei)desc->samples : most;
    if (samples == 1) samples = 0;

    glCreateFramebuffers(TARGET_COUNT, render->framebuffer);
    make_shadow(render);
    render->color_samples = make_samples(GL_RGBA16F, samples, wide, high);
    render->depth_samples = make_samples(GL_DEPTH_COMPONENT32F, samples, wide, high);
    render->resolved      = make_texture(GL_RGBA16F, wide, high);
    render->encoded       = make_texture(GL_RGBA8, width, height);
    render->linear        = make_texture(GL_RGBA16F, width, height);

    static const GLenum both[]      = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    const GLuint*       framebuffer = render->framebuffer;
    glNamedFramebufferRenderbuffer(framebuffer[DRAWN], GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                   render->color_samples);
    glNamedFramebufferRenderbuffer(framebuffer[DRAWN], GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                   render->depth_samples);
    glNamedFramebufferTexture(framebuffer[RESOLVED], GL_COLOR_ATTACHMENT0, render->resolved, 0);
    glNamedFramebufferTexture(framebuffer[ENCODED], GL_COLOR_ATTACHMENT0, render->encoded, 0);
    glNamedFramebufferTexture(framebuffer[ENCODED], GL_COLOR_ATTACHMENT1, render->linear, 0);
    glNamedFramebufferDrawBuffers(framebuffer[ENCODED], 2, both);
    for (int i = 0; i < TARGET_COUNT; ++i)
        if (glCheckNamedFramebufferStatus(framebuffer[i], GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
            return false;
    return true;
}

static bool make_image(struct hair_render* render)
{
    const struct hair_render_desc* desc   = &render->desc;
    size_t                         values = (size_t)3 * desc->width * desc->height;
    render->image                         = (struct hair_image){.width = desc->width, .height = desc->height};
    render->image.encoded                 = malloc(values);
    if (desc->linear) render->image.linear = malloc(values * sizeof *render->image.linear);
    return render->image.encoded && (!desc->linear || render->image.linear);
}

static int make(struct hair_render* render)
{
    const struct hair_render_desc* desc = &render->desc;
    if (!make_programs(render)) return HAIR_EXIT_OPENGL;
    glCreateVertexArrays(1, &render->vertex_array);
    glCreateVertexArrays(1, &render->nothing);
    bool complete = make_targets(render);
    if (glGetError() || !complete) {
        hair_complain(render->tool, "OpenGL has no memory for %u x %u pixels of %u samples", desc->width,
                      desc->height, desc->samples);
        return HAIR_EXIT_OPENGL;
    }
    if (make_image(render)) return HAIR_EXIT_OK;
    hair_complain(render->tool, "out of memory for a picture of %u x %u", desc->width, desc->height);
    return HAIR_EXIT_RUNTIME;
}

int hair_render_create(const char* tool, const struct hair_render_desc* desc, struct hair_render** out)
{
    struct hair_render* render = calloc(1, sizeof *render);
    if (!render) {
        hair_complain(tool, "out of memory");
        return HAIR_EXIT_RUNTIME;
    }
    render->tool = tool;
    render->desc = *desc;
    render->tile = MAX_TILE / desc->supersample;
    int code     = make(render);
    if (code)
        hair_render_destroy(render);
    else
        *out = render;
    return code;
}

static void delete_mesh(struct hair_render* render)
{
    glDeleteBuffers(BUFFER_COUNT, render->buffer);
    memset(render->buffer, 0, sizeof render->buffer);
    render->indices = 0;
}

void hair_render_destroy(struct hair_render* render)
{
    if (!render) return;
    const GLuint textures[]      = {render->shadow, render->resolved, render->encoded, render->linear};
    const GLuint renderbuffers[] = {render->color_samples, render->depth_samples};
    const GLuint vertex_arrays[] = {render->vertex_array, render->nothing};
    for (int i = 0; i < PROGRAM_COUNT; ++i) glDeleteProgram(render->program[i]);
    glDeleteFramebuffers(TARGET_COUNT, render->framebuffer);
    glDeleteTextures(4, textures);
    glDeleteRenderbuffers(2, renderbuffers);
    glDeleteVertexArrays(2, vertex_arrays);
    glDeleteSamplers(1, &render->shadow_sampler);
    delete_mesh(render);
    free(render->image.encoded);
    free(render->image.linear);
    free(render);
}

// Mesh ------------------------------------------------------------------------------------------------------

static GLuint make_buffer(const void* bytes, size_t size)
{
    GLuint buffer;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, (GLsizeiptr)size, bytes, 0);
    return buffer;
}

static void attach(struct hair_render* render, GLuint attribute)
{
    GLuint array = render->vertex_array;
    glVertexArrayVertexBuffer(array, attribute, render->buffer[attribute], 0, 3 * sizeof(float));
    glVertexArrayAttribFormat(array, attribute, 3, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(array, attribute, attribute);
    glEnableVertexArrayAttrib(array, attribute);
}

void hair_render_set_mesh(struct hair_render* render, const struct head_mesh* mesh, bool whole)
{
    delete_mesh(render);
    size_t bytes              = (size_t)mesh->vertex_count * 3 * sizeof(float);
    render->indices           = 3 * mesh->triangle_count;
    render->buffer[POSITIONS] = make_buffer(mesh->positions, bytes);
    render->buffer[NORMALS]   = make_buffer(mesh->normals, bytes);
    render->buffer[COLORS]    = make_buffer(mesh->colors, bytes);
    render->buffer[TRIANGLES] = make_buffer(mesh->triangles, render->indices * sizeof(uint32_t));
    render->bend[0]           = whole ? -1e9f : HAIR_RIG_MOVES;
    render->bend[1]           = HAIR_RIG_RESTS;
    for (GLuint i = POSITIONS; i <= COLORS; ++i) attach(render, i);
    glVertexArrayElementBuffer(render->vertex_array, render->buffer[TRIANGLES]);
}

// Frames ----------------------------------------------------------------------------------------------------

// One picture, or one tile of it.
struct tile {
    uint32_t             x, y, width, height; // in the picture's pixels, from its upper left
    float                at[2], size[2];      // the same as shares
    struct hair_matrices camera;
};

struct frame {
    const struct hair_scene* scene;
    const float*             transform;
    struct hair_matrices     light;
    float                    texel; // of the shadow map, m
    hair_instance*           hair;
};

static void set_vec3(GLuint program, GLint at, const float value[3])
{
    glProgramUniform3fv(program, at, 1, value);
}

static void set_mat4(GLuint program, GLint at, const float value[16])
{
    glProgramUniformMatrix4fv(program, at, 1, GL_FALSE, value);
}

static void draw_mesh(const struct hair_render* render, GLuint program, const struct frame* frame,
                      const struct hair_matrices* matrices)
{
    if (!render->indices) return;
    set_mat4(program, HAIR_AT_HEAD, frame->transform);
    set_mat4(program, HAIR_AT_VIEW, matrices->view);
    set_mat4(program, HAIR_AT_PROJECTION, matrices->projection);
    glProgramUniform2fv(program, HAIR_AT_BEND, 1, render->bend);
    glUseProgram(program);
    glBindVertexArray(render->vertex_array);
    glEnable(GL_CULL_FACE);
    glDrawElements(GL_TRIANGLES, (GLsizei)render->indices, GL_UNSIGNED_INT, NULL);
    glDisable(GL_CULL_FACE);
}

static hair_result draw_hair(const struct frame* frame, const struct hair_matrices* matrices, hair_pass pass,
                             GLuint shadow)
{
    hair_view view      = frame->scene->settings.view;
    view.pass           = pass;
    view.shadow_texture = shadow;
    hair_light_clip(&frame->light, view.shadow_matrix);
    memcpy(view.view, matrices->view, sizeof view.view);
    memcpy(view.projection, matrices->projection, sizeof view.projection);
    return hair_draw(frame->hair, &view);
}

static hair_result draw_shadow(const struct hair_render* render, const struct frame* frame)
{
    static const float far = 1;
    glBindFramebuffer(GL_FRAMEBUFFER, render->framebuffer[SHADOW]);
    glViewport(0, 0, SHADOW_SIZE, SHADOW_SIZE);
    glClearNamedFramebufferfv(render->framebuffer[SHADOW], GL_DEPTH, 0, &far);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_POLYGON_OFFSET_FILL); // A surface does not shade itself.
    glPolygonOffset(2, 4);
    draw_mesh(render, render->program[DEPTH], frame, &frame->light);
    glDisable(GL_POLYGON_OFFSET_FILL);
    return draw_hair(frame, &frame->light, HAIR_PASS_DEPTH, 0);
}

static void draw_background(const struct hair_render* render, const struct frame* frame,
                            const struct tile* tile)
{
    GLuint program = render->program[BACKGROUND];
    glProgramUniform4f(program, HAIR_AT_TILE, tile->at[0], tile->at[1], tile->size[0], tile->size[1]);
    glProgramUniform1f(program, HAIR_AT_ASPECT, (float)render->desc.width / (float)render->desc.height);
    set_vec3(program, HAIR_AT_CENTRE, frame->scene->background[0]);
    set_vec3(program, HAIR_AT_EDGE, frame->scene->background[1]);
    glUseProgram(program);
    glBindVertexArray(render->nothing);
    glDisable(GL_DEPTH_TEST);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glEnable(GL_DEPTH_TEST);
}

static void draw_skin(const struct hair_render* render, const struct frame* frame, const struct tile* tile)
{
    GLuint           program = render->program[SKIN];
    const hair_view* view    = &frame->scene->settings.view;
    float            shadow[16], light_to[3];
    hair_light_texture(&frame->light, shadow);
    hair_light_direction(frame->scene, light_to);
    set_vec3(program, HAIR_AT_EYE, frame->scene->eye);
    set_vec3(program, HAIR_AT_LIGHT_TO, light_to);
    set_vec3(program, HAIR_AT_LIGHT, view->light);
    set_vec3(program, HAIR_AT_AMBIENT, view->ambient);
    set_mat4(program, HAIR_AT_SHADOW, shadow);
    glProgramUniform1f(program, HAIR_AT_TEXEL, frame->texel);
    glBindTextureUnit(0, render->shadow);
    glBindSampler(0, render->shadow_sampler);
    draw_mesh(render, program, frame, &tile->camera);
    glBindSampler(0, 0);
}

// Average the samples, then the pixels of a supersampled one, and encode.
static void develop(const struct hair_render* render, const struct frame* frame, const struct tile* tile)
{
    GLuint program = render->program[TONE], drawn = render->framebuffer[DRAWN],
           resolved = render->framebuffer[RESOLVED];
    GLsizei width = (GLsizei)tile->width, height = (GLsizei)tile->height,
            scale = (GLsizei)render->desc.supersample;
    glBlitNamedFramebuffer(drawn, resolved, 0, 0, width * scale, height * scale, 0, 0, width * scale,
                           height * scale, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, render->framebuffer[ENCODED]);
    glViewport(0, 0, width, height);
    glProgramUniform1i(program, HAIR_AT_SUPERSAMPLE, scale);
    glProgramUniform1f(program, HAIR_AT_EXPOSURE, frame->scene->exposure);
    glProgramUniform1i(program, HAIR_AT_HEIGHT, height);
    glUseProgram(program);
    glBindVertexArray(render->nothing);
    glBindTextureUnit(0, render->resolved);
    glDisable(GL_DEPTH_TEST);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

static void read_pixels(struct hair_render* render, const struct tile* tile)
{
    size_t  first = 3 * ((size_t)tile->y * render->desc.width + tile->x);
    GLsizei width = (GLsizei)tile->width, height = (GLsizei)tile->height;
    GLuint  encoded = render->framebuffer[ENCODED];
    glBindFramebuffer(GL_READ_FRAMEBUFFER, encoded);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glPixelStorei(GL_PACK_ROW_LENGTH, (GLint)render->desc.width);
    glNamedFramebufferReadBuffer(encoded, GL_COLOR_ATTACHMENT0);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, render->image.encoded + first);
    if (!render->image.linear) return;
    glNamedFramebufferReadBuffer(encoded, GL_COLOR_ATTACHMENT1);
    glReadPixels(0, 0, width, height, GL_RGB, GL_HALF_FLOAT, render->image.linear + first);
}

static hair_result draw_tile(struct hair_render* render, const struct frame* frame, const struct tile* tile)
{
    static const float far   = 1;
    GLsizei            scale = (GLsizei)render->desc.supersample;
    glBindFramebuffer(GL_FRAMEBUFFER, render->framebuffer[DRAWN]);
    glViewport(0, 0, (GLsizei)tile->width * scale, (GLsizei)tile->height * scale);
    glClearNamedFramebufferfv(render->framebuffer[DRAWN], GL_DEPTH, 0, &far);
    draw_background(render, frame, tile);
    draw_skin(render, frame, tile);
    hair_result result = draw_hair(frame, &tile->camera, HAIR_PASS_COLOR, render->shadow);
    if (result) return result;
    develop(render, frame, tile);
    read_pixels(render, tile);
    return HAIR_OK;
}

static hair_result draw_tiles(struct hair_render* render, const struct frame* frame,
                              const struct hair_matrices* camera)
{
    uint32_t width = render->desc.width, height = render->desc.height, side = render->tile;
    for (uint32_t y = 0; y < height; y += side)
        for (uint32_t x = 0; x < width; x += side) {
            struct tile tile = {.x = x, .y = y, .camera = *camera};
            tile.width       = width - x < side ? width - x : side;
            tile.height      = height - y < side ? height - y : side;
            tile.at[0]       = (float)x / (float)width;
            tile.at[1]       = (float)y / (float)height;
            tile.size[0]     = (float)tile.width / (float)width;
            tile.size[1]     = (float)tile.height / (float)height;
            hair_camera_crop(camera->projection, tile.at, tile.size, tile.camera.projection);
            hair_result result = draw_tile(render, frame, &tile);
            if (result) return result;
        }
    return HAIR_OK;
}

int hair_render_frame(struct hair_render* render, const struct hair_scene* scene, const float transform[16],
                      float reach, hair_instance* hair, const struct hair_image** out)
{
    struct frame         frame = {.scene = scene, .transform = transform, .hair = hair};
    struct hair_matrices camera;
    frame.texel = 2 * reach / SHADOW_SIZE;
    hair_light_matrices(scene, transform, reach, &frame.light);
    hair_camera_matrices(scene, transform, reach, &camera);
    hair_result result = draw_shadow(render, &frame);
    if (!result) result = draw_tiles(render, &frame, &camera);
    GLenum error = glGetError();
    if (!result && error) hair_complain(render->tool, "OpenGL error 0x%04x while drawing", error);
    *out = &render->image;
    return error && !result ? HAIR_EXIT_OPENGL : hair_exit_for(result);
}
