// render.c - The picture around the hair, with background, head, shadow maps, multisampling and
// tone mapping to 8 bits.
#include "tools/common/render.h"
#include "tools/common/file.h"
#include "tools/common/frame_lights.h"
#include "tools/common/render_mesh.h"
#include "tools/common/shaders.h"
#include "tools/common/targets.h"

#include <epoxy/gl.h>

#include <stdlib.h>
#include <string.h>

#define TAPS 16 // Taps of a shadow map. Supersampled pixels need fewer.
#define MAX_TILE 4096 // Pixels drawn at once in each direction. Any OpenGL 4.5 supports this size.

enum program { BACKGROUND, SKIN, DEPTH, TONE, PROGRAM_COUNT };

struct hair_render {
    const char* tool;
    struct hair_render_desc desc;
    struct hair_image image;
    uint32_t tile; // side in pixels of the picture
    GLuint program[PROGRAM_COUNT];
    struct hair_targets targets;
    struct hair_shadow_map map[HAIR_SCENE_SHADOWS]; // allocated as lights need them
    GLuint shadow_sampler;
    GLuint nothing; // vertex array without vertices
    struct hair_render_mesh mesh;
    hair_instance* const* more_hair;
    uint32_t more_count;
    float breath; // of the bust, m
    uint32_t frames; // drawn so far
    float shift[2]; // of the picture to the left and up, pixels
};

// Making ------------------------------------------------------------------------------------------

static bool make_programs(struct hair_render* render)
{
    static const char* const text[PROGRAM_COUNT][2] = {[BACKGROUND] = {hair_whole_vert, hair_background_frag},
                                                       [SKIN] = {hair_mesh_vert, hair_scalp_motion_frag},
                                                       [DEPTH] = {hair_mesh_vert, hair_nothing_frag},
                                                       [TONE] = {hair_whole_vert, hair_tone_frag}};
    for (int i = 0; i < PROGRAM_COUNT; ++i) {
        render->program[i] = hair_shaders_link(render->tool, text[i][0], text[i][1]);
        if (!render->program[i]) return false;
    }
    return true;
}

static bool make_image(struct hair_render* render)
{
    const struct hair_render_desc* desc = &render->desc;
    size_t values = (size_t)3 * desc->width * desc->height;
    render->image = (struct hair_image){.width = desc->width, .height = desc->height};
    if (desc->on_gpu) return true;
    render->image.encoded = malloc(values);
    if (desc->linear) render->image.linear = malloc(values * sizeof *render->image.linear);
    return render->image.encoded && (!desc->linear || render->image.linear);
}

static int make(struct hair_render* render)
{
    const struct hair_render_desc* desc = &render->desc;
    if (!make_programs(render)) return HAIR_EXIT_OPENGL;
    glCreateVertexArrays(1, &render->nothing);
    render->shadow_sampler = hair_shadow_sampler();
    uint32_t width = desc->width < render->tile ? desc->width : render->tile;
    uint32_t height = desc->height < render->tile ? desc->height : render->tile;
    if (!hair_targets_make(&render->targets, width, height, desc->supersample, desc->samples)) {
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
    render->tile = desc->on_gpu ? UINT32_MAX : MAX_TILE / desc->supersample;
    int code = make(render);
    if (code)
        hair_render_destroy(render);
    else
        *out = render;
    return code;
}

void hair_render_destroy(struct hair_render* render)
{
    if (!render) return;
    for (int i = 0; i < PROGRAM_COUNT; ++i) glDeleteProgram(render->program[i]);
    glDeleteVertexArrays(1, &render->nothing);
    hair_targets_delete(&render->targets);
    for (int i = 0; i < HAIR_SCENE_SHADOWS; ++i) hair_shadow_map_delete(&render->map[i]);
    glDeleteSamplers(1, &render->shadow_sampler);
    hair_render_mesh_delete(&render->mesh);
    hair_render_abandon(render);
}

void hair_render_abandon(struct hair_render* render)
{
    if (!render) return;
    free(render->image.encoded);
    free(render->image.linear);
    free(render);
}

void hair_render_set_mesh(struct hair_render* render, const struct head_mesh* mesh, bool whole)
{
    hair_render_mesh_make(mesh, whole, &render->mesh);
}

void hair_render_move_mesh(struct hair_render* render, const struct head_mesh* mesh)
{
    hair_render_mesh_move(&render->mesh, mesh);
}

void hair_render_set_breath(struct hair_render* render, float breath)
{
    render->breath = breath;
}

void hair_render_set_more_hair(struct hair_render* render, hair_instance* const* hair, uint32_t count)
{
    render->more_hair = hair;
    render->more_count = count;
}

// Frames ------------------------------------------------------------------------------------------

// The picture, or one tile of it.
struct tile {
    uint32_t x, y, width, height; // in pixels of the picture, from its upper left
    float at[2], size[2]; // as fractions of the picture
    struct hair_matrices camera;
};

struct frame {
    const struct hair_scene* scene;
    const float* transform;
    struct hair_frame_lights lights;
    uint32_t number;
    hair_instance* hair;
    GLuint depth; // depth of opaque geometry for occlusion culling, 0 disables it
};

static bool shows_mesh(const struct hair_render* render, const struct frame* frame)
{
    return render->mesh.indices && (frame->scene->show & HAIR_SHOW_HEAD);
}

static void draw_mesh(const struct hair_render* render, GLuint program, const struct frame* frame,
                      const struct hair_matrices* matrices)
{
    if (!shows_mesh(render, frame)) return;
    // Fine hairs are dots at four samples a pixel or fewer.
    bool has_fine = render->desc.samples * render->desc.supersample * render->desc.supersample > 4;
    hair_render_mesh_draw(&render->mesh, program, frame->transform, render->breath, matrices, has_fine);
}

// Draw one pass of the hair. Only the colour pass, seen from the camera, gets the lights' shadow
// maps.
static hair_result draw_hair(const struct hair_render* render, const struct frame* frame,
                             const struct hair_matrices* matrices, hair_pass pass)
{
    hair_view view = frame->scene->settings.view;
    hair_light light[HAIR_SCENE_LIGHTS];
    view.pass = pass;
    view.frame_index = frame->number; // Tiles of one frame share the lights' data.
    view.lod = frame->scene->settings.has_lod ? &frame->scene->settings.lod : NULL;
    view.light_count = frame->lights.count;
    view.lights = light;
    memcpy(light, frame->lights.light, sizeof light);
    for (uint32_t i = 0; i < frame->lights.shadows && pass == HAIR_PASS_COLOR; ++i) {
        hair_light* of = &light[frame->lights.shadow[i].light];
        of->hair_shadow_map = render->map[i].texture[HAIR_SHADOW_HAIR];
        of->opaque_shadow_map = shows_mesh(render, frame) ? render->map[i].texture[HAIR_SHADOW_BODY] : 0;
        hair_light_clip(&frame->lights.shadow[i].matrices, of->shadow_matrix);
    }
    view.occluder_depth = pass == HAIR_PASS_COLOR ? frame->depth : 0;
    memcpy(view.view, matrices->view, sizeof view.view);
    memcpy(view.projection, matrices->projection, sizeof view.projection);
    hair_result result = hair_draw(frame->hair, &view);
    for (uint32_t i = 0; i < render->more_count && !result; ++i)
        result = hair_draw(render->more_hair[i], &view);
    return result;
}

// Draw the shadow maps of light i, which are the depth of the mesh, the depth of hair and the
// opacity of hair. Maps of parts that are not shown are skipped or left empty. The opacity map is
// skipped without a mesh that receives the shadow.
static hair_result draw_shadow(const struct hair_render* render, const struct frame* frame, uint32_t i)
{
    const struct hair_shadow_map* map = &render->map[i];
    const struct hair_matrices* matrices = &frame->lights.shadow[i].matrices;
    bool mesh = shows_mesh(render, frame), hair = frame->scene->show & HAIR_SHOW_HAIR;
    hair_result result = HAIR_OK;
    if (mesh) {
        hair_shadow_map_begin(map, HAIR_SHADOW_BODY);
        glEnable(GL_POLYGON_OFFSET_FILL); // The offset keeps a surface from shadowing itself.
        glPolygonOffset(2, 4);
        draw_mesh(render, render->program[DEPTH], frame, matrices);
        glDisable(GL_POLYGON_OFFSET_FILL);
    }
    hair_shadow_map_begin(map, HAIR_SHADOW_HAIR);
    if (hair) result = draw_hair(render, frame, matrices, HAIR_PASS_DEPTH);
    if (!mesh || result) return result;
    hair_shadow_map_begin(map, HAIR_SHADOW_OPACITY);
    return hair ? draw_hair(render, frame, matrices, HAIR_PASS_OPACITY) : HAIR_OK;
}

static hair_result draw_shadows(struct hair_render* render, const struct frame* frame)
{
    hair_result result = HAIR_OK;
    for (uint32_t i = 0; i < frame->lights.shadows && !result; ++i) {
        bool mesh = shows_mesh(render, frame);
        if (!hair_shadow_map_make(&render->map[i], mesh ? HAIR_SHADOW_PARTS : HAIR_SHADOW_OPACITY,
                                  HAIR_SHADOW_SIZE)) {
            hair_complain(render->tool, "OpenGL has no memory for the shadow maps of %u lights",
                          frame->lights.shadows);
            return HAIR_ERROR_MEMORY;
        }
        result = draw_shadow(render, frame, i);
    }
    return result;
}

static void draw_background(const struct hair_render* render, const struct frame* frame,
                            const struct tile* tile)
{
    GLuint program = render->program[BACKGROUND];
    glProgramUniform4f(program, HAIR_AT_TILE, tile->at[0], tile->at[1], tile->size[0], tile->size[1]);
    glProgramUniform1f(program, HAIR_AT_ASPECT, (float)render->desc.width / (float)render->desc.height);
    glProgramUniform3fv(program, HAIR_AT_CENTRE, 1, frame->scene->background[0]);
    glProgramUniform3fv(program, HAIR_AT_EDGE, 1, frame->scene->background[1]);
    glUseProgram(program);
    glBindVertexArray(render->nothing);
    glDisable(GL_DEPTH_TEST);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glEnable(GL_DEPTH_TEST);
}

static void draw_skin(const struct hair_render* render, const struct frame* frame, const struct tile* tile)
{
    GLuint program = render->program[SKIN];
    const hair_view* view = &frame->scene->settings.view;
    glProgramUniform3fv(program, HAIR_AT_EYE, 1, frame->scene->eye);
    glProgramUniform1i(program, HAIR_AT_TAPS, render->desc.supersample > 2 ? TAPS / 2 : TAPS);
    glProgramUniform3fv(program, HAIR_AT_AMBIENT, 1, view->ambient);
    float root[3], tip[3];
    hair_look_find_colors(&frame->scene->settings.look, root, tip); // The settings are valid.
    glProgramUniform3fv(program, HAIR_AT_HAIR, 1, root);
    hair_frame_lights_set(program, &frame->lights, render->map, render->shadow_sampler);
    draw_mesh(render, program, frame, &tile->camera);
    hair_frame_lights_unset(&frame->lights);
}

// Copy the head's depth, one sample per pixel, for occlusion culling. Return 0 if culling is
// disabled or the tile does not fill the render target.
static GLuint copy_depth(const struct hair_render* render, const struct frame* frame, const struct tile* tile)
{
    const struct hair_targets* targets = &render->targets;
    GLint width = 0, height = 0, scale = (GLint)render->desc.supersample;
    glGetTextureLevelParameteriv(targets->depth, 0, GL_TEXTURE_WIDTH, &width);
    glGetTextureLevelParameteriv(targets->depth, 0, GL_TEXTURE_HEIGHT, &height);
    bool whole = width == (GLint)tile->width * scale && height == (GLint)tile->height * scale;
    if (!frame->scene->settings.hides || !shows_mesh(render, frame) || !whole) return 0;
    glBlitNamedFramebuffer(targets->framebuffer[HAIR_TARGET_DRAWN],
                           targets->framebuffer[HAIR_TARGET_RESOLVED], 0, 0, width, height, 0, 0, width,
                           height, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
    return targets->depth;
}

// Average the samples, then the pixels of a supersampled one, and encode the result.
static void develop(const struct hair_render* render, const struct frame* frame, const struct tile* tile)
{
    GLuint program = render->program[TONE];
    GLsizei width = (GLsizei)tile->width, height = (GLsizei)tile->height,
            scale = (GLsizei)render->desc.supersample;
    hair_targets_resolve(&render->targets, (const int[]){0, 0}, (const int[]){width * scale, height * scale});
    glBindFramebuffer(GL_FRAMEBUFFER, render->targets.framebuffer[HAIR_TARGET_ENCODED]);
    glViewport(0, 0, width, height);
    glProgramUniform1i(program, HAIR_AT_SUPERSAMPLE, scale);
    glProgramUniform1f(program, HAIR_AT_EXPOSURE, frame->scene->exposure);
    glProgramUniform1i(program, HAIR_AT_HEIGHT, height);
    glUseProgram(program);
    glBindVertexArray(render->nothing);
    glBindTextureUnit(0, render->targets.resolved);
    glDisable(GL_DEPTH_TEST);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

static void read_pixels(struct hair_render* render, const struct tile* tile)
{
    size_t first = 3 * ((size_t)tile->y * render->desc.width + tile->x);
    GLsizei width = (GLsizei)tile->width, height = (GLsizei)tile->height;
    GLuint encoded = render->targets.framebuffer[HAIR_TARGET_ENCODED];
    glBindFramebuffer(GL_READ_FRAMEBUFFER, encoded);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glPixelStorei(GL_PACK_ROW_LENGTH, (GLint)render->desc.width);
    glNamedFramebufferReadBuffer(encoded, GL_COLOR_ATTACHMENT0);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, render->image.encoded + first);
    if (!render->image.linear) return;
    glNamedFramebufferReadBuffer(encoded, GL_COLOR_ATTACHMENT1);
    glReadPixels(0, 0, width, height, GL_RGB, GL_HALF_FLOAT, render->image.linear + first);
}

static hair_result draw_tile(struct hair_render* render, struct frame* frame, const struct tile* tile)
{
    static const float far = 1;
    GLsizei scale = (GLsizei)render->desc.supersample;
    glBindFramebuffer(GL_FRAMEBUFFER, render->targets.framebuffer[HAIR_TARGET_DRAWN]);
    glViewport(0, 0, (GLsizei)tile->width * scale, (GLsizei)tile->height * scale);
    glClearNamedFramebufferfv(render->targets.framebuffer[HAIR_TARGET_DRAWN], GL_DEPTH, 0, &far);
    draw_background(render, frame, tile);
    draw_skin(render, frame, tile);
    frame->depth = copy_depth(render, frame, tile);
    static const struct {
        uint32_t show;
        hair_pass pass;
    } passes[] = {{HAIR_SHOW_COLLIDERS, HAIR_PASS_COLLIDERS},
                  {HAIR_SHOW_WIND, HAIR_PASS_WIND},
                  {HAIR_SHOW_HAIR, HAIR_PASS_COLOR},
                  {HAIR_SHOW_GUIDES, HAIR_PASS_GUIDES}};
    hair_result result = HAIR_OK;
    for (size_t i = 0; i < sizeof passes / sizeof *passes && !result; ++i)
        if (frame->scene->show & passes[i].show)
            result = draw_hair(render, frame, &tile->camera, passes[i].pass);
    if (result) return result;
    develop(render, frame, tile);
    if (!render->desc.on_gpu) read_pixels(render, tile);
    return HAIR_OK;
}

// Return the distance of tiles without overflow.
static uint32_t tile_step(uint32_t size, uint32_t side)
{
    return size < side ? size : side;
}

static hair_result draw_tiles(struct hair_render* render, struct frame* frame,
                              const struct hair_matrices* camera)
{
    uint32_t width = render->desc.width, height = render->desc.height, side = render->tile;
    for (uint32_t y = 0; y < height; y += tile_step(height, side))
        for (uint32_t x = 0; x < width; x += tile_step(width, side)) {
            struct tile tile = {.x = x, .y = y, .camera = *camera};
            tile.width = width - x < side ? width - x : side;
            tile.height = height - y < side ? height - y : side;
            tile.at[0] = ((float)x + render->shift[0]) / (float)width;
            tile.at[1] = ((float)y + render->shift[1]) / (float)height;
            tile.size[0] = (float)tile.width / (float)width;
            tile.size[1] = (float)tile.height / (float)height;
            hair_camera_crop(camera->projection, tile.at, tile.size, tile.camera.projection);
            hair_result result = draw_tile(render, frame, &tile);
            if (result) return result;
        }
    return HAIR_OK;
}

int hair_render_frame(struct hair_render* render, const struct hair_scene* scene, const float transform[16],
                      float reach, hair_instance* hair, const struct hair_image** out)
{
    struct frame frame = {.scene = scene, .transform = transform, .hair = hair};
    struct hair_matrices camera;
    frame.number = ++render->frames;
    hair_frame_lights_find(scene, transform, reach, &frame.lights);
    hair_camera_matrices(scene, transform, reach, &camera);
    hair_result result = draw_shadows(render, &frame);
    if (!result) result = draw_tiles(render, &frame, &camera);
    // Epoxy aborts if a function is first called in a lost context.
    GLenum error = result == HAIR_ERROR_CONTEXT_LOST ? GL_NO_ERROR : glGetError();
    if (!result && error) hair_complain(render->tool, "OpenGL error 0x%04x while drawing", error);
    *out = &render->image;
    return error && !result ? HAIR_EXIT_OPENGL : hair_exit_for(result);
}

unsigned hair_render_texture(const struct hair_render* render)
{
    return render->targets.encoded;
}

void hair_render_depth(const struct hair_render* render, const struct hair_scene* scene,
                       const float transform[16], const struct hair_matrices* matrices)
{
    struct frame frame = {.scene = scene, .transform = transform};
    glEnable(GL_DEPTH_TEST);
    draw_mesh(render, render->program[DEPTH], &frame, matrices);
}

unsigned hair_render_linear_texture(const struct hair_render* render)
{
    return render->targets.linear;
}

void hair_render_set_shift(struct hair_render* render, const float shift[2])
{
    memcpy(render->shift, shift, sizeof render->shift);
}
