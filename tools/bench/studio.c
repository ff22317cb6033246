// studio.c - A haircut on its head in front of a plain background.
#include "tools/bench/studio.h"

#include "tools/bench/extent.h"
#include "tools/common/camera.h"
#include "tools/common/render_mesh.h"
#include "tools/common/file.h"
#include "tools/common/shaders.h"
#include "tools/common/stats.h"
#include "tools/common/groom_source.h"

#include <epoxy/gl.h>
#include <stdlib.h>
#include <string.h>

enum { MESH, DEPTH, AVERAGE };

// clang-format would merge the lines of GLSL.
// clang-format off
static const char flat_frag[] =
    "#version 450 core\n"
    "layout(location = 0) out vec4 color;\n"
    "void main() { color = vec4(0.22, 0.15, 0.12, 0.0); }\n";

static const char average_frag[] =
    "#version 450 core\n"
    "layout(location = 14) uniform int supersample;\n" // HAIR_AT_SUPERSAMPLE
    "layout(binding = 0) uniform sampler2D drawn;\n"
    "layout(location = 1) out vec4 mean;\n"
    "void main()\n"
    "{\n"
    "    ivec2 at  = supersample * ivec2(gl_FragCoord.xy);\n"
    "    vec4  sum = vec4(0.0);\n"
    "    for (int y = 0; y < supersample; ++y)\n"
    "        for (int x = 0; x < supersample; ++x) sum += texelFetch(drawn, at + ivec2(x, y), 0);\n"
    "    mean = sum / float(supersample * supersample);\n"
    "}\n";
// clang-format on

// Making ------------------------------------------------------------------------------------------

static bool make_programs(struct bench_studio* studio)
{
    studio->programs[MESH] = hair_shaders_link(BENCH_TOOL, hair_mesh_vert, flat_frag);
    studio->programs[DEPTH] = hair_shaders_link(BENCH_TOOL, hair_mesh_vert, hair_nothing_frag);
    studio->programs[AVERAGE] = hair_shaders_link(BENCH_TOOL, hair_whole_vert, average_frag);
    return studio->programs[MESH] && studio->programs[DEPTH] && studio->programs[AVERAGE];
}

static bool make_head(struct bench_studio* studio)
{
    struct head_mesh mesh;
    const struct hair_scene* scene = &studio->scene;
    glCreateVertexArrays(2, studio->arrays);
    glCreateBuffers(2, studio->buffers);
    if (!scene->head && scene->subject != HAIR_SUBJECT_FUR) return true;
    if (scene->head ? head_mesh_create(NULL, &mesh) : hair_head_rig_ball(scene->ball_radius, &mesh))
        return false;
    studio->indices = 3 * mesh.triangle_count;
    glNamedBufferStorage(studio->buffers[0], (GLsizeiptr)(mesh.vertex_count * 3 * sizeof(float)),
                         mesh.positions, 0);
    glNamedBufferStorage(studio->buffers[1], (GLsizeiptr)(studio->indices * sizeof(uint32_t)), mesh.triangles,
                         0);
    head_mesh_free(&mesh);
    glVertexArrayVertexBuffer(studio->arrays[0], 0, studio->buffers[0], 0, 3 * sizeof(float));
    glVertexArrayAttribFormat(studio->arrays[0], 0, 3, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(studio->arrays[0], 0, 0);
    glEnableVertexArrayAttrib(studio->arrays[0], 0);
    glVertexArrayElementBuffer(studio->arrays[0], studio->buffers[1]);
    return true;
}

static bool place(struct bench_studio* studio)
{
    hair_collider colliders[HAIR_HEAD_RIG_COLLIDERS];
    float time = (float)studio->frame / STUDIO_FPS;
    hair_motion_at(&studio->scene.motion, time, studio->transform);
    if (!studio->hair) return true;
    uint32_t count = hair_head_rig_colliders(&studio->scene, NULL, time, studio->transform, colliders);
    return !hair_set_transform(studio->hair, studio->transform) &&
           !hair_set_colliders(studio->hair, colliders, count, sizeof *colliders);
}

static bool bring_to_life(struct bench_studio* studio, const struct bench_studio_desc* asked)
{
    struct hair_scene* scene = &studio->scene;
    hair_desc desc = scene->settings.desc;
    desc.solver = asked->solver;
    desc.substep = (float)asked->substep;
    if (asked->mapping) desc.thread_mapping = asked->mapping;
    desc.physics = &scene->settings.physics;
    desc.look = &scene->settings.look;
    place(studio);
    memcpy(desc.transform, studio->transform, sizeof desc.transform);
    if (hair_create(studio->bench->context, studio->groom, &desc, &studio->hair) ||
        hair_set_wind(studio->hair, &scene->settings.wind) || !place(studio))
        return false;
    for (float time = 0; time < scene->settle; time += 1.0f / STUDIO_FPS)
        if (hair_step(studio->hair, 1.0f / STUDIO_FPS)) return false;
    return true;
}

static bool set(struct bench_studio* studio, const char* key, uint32_t count)
{
    char text[16];
    snprintf(text, sizeof text, "%u", count);
    return !count || hair_settings_set(BENCH_TOOL, &studio->scene.settings, key, text);
}

static bool make_subject(struct bench_studio* studio, const struct bench_studio_desc* desc)
{
    struct hair_scene* scene = &studio->scene;
    hair_scene_default(scene);
    if (!hair_scene_named(BENCH_TOOL, desc->scene, scene)) return false;
    uint32_t followers = scene->settings.groom.follower_count;
    studio->fewer = 1;
    if (!set(studio, "guides", desc->guides) || !set(studio, "followers", desc->followers) ||
        !set(studio, "strand.segments", desc->segments))
        return false;
    scene->width = scene->height = studio->size;
    if (desc->followers) studio->fewer = (float)followers / (float)desc->followers;
    if (hair_groom_source_load(BENCH_TOOL, &studio->bench->host, scene, NULL, &studio->groom)) return false;
    studio->info = hair_groom_info_default();
    if (hair_groom_describe(studio->groom, &studio->info)) return false;
    struct hair_bounds bounds;
    memcpy(bounds.lower, studio->info.lower, sizeof bounds.lower);
    memcpy(bounds.upper, studio->info.upper, sizeof bounds.upper);
    if (!scene->framed) hair_camera_frame(scene, &bounds);
    studio->reach = 1.15f * hair_camera_reach(scene, &bounds);
    return true;
}

bool bench_studio_make(struct bench* bench, const struct bench_studio_desc* desc, struct bench_studio* out)
{
    memset(out, 0, sizeof *out);
    out->bench = bench;
    out->size = desc->size;
    snprintf(bench->sentence, sizeof bench->sentence, "the scene could not be made");
    bench_timer_make(&out->timer, bench->software);
    glCreateQueries(GL_PRIMITIVES_GENERATED, 1, &out->query);
    if (make_programs(out) && make_subject(out, desc) && make_head(out) && bring_to_life(out, desc))
        return true;
    bench_studio_free(out);
    return false;
}

void bench_studio_free(struct bench_studio* studio)
{
    hair_destroy(studio->hair);
    hair_groom_destroy(studio->groom);
    if (studio->shot.samples) hair_targets_delete(&studio->targets);
    hair_shadow_map_delete(&studio->map);
    glUseProgram(0); // A deleted program that is current stays alive until another one is used.
    for (int i = 0; i < 3; ++i) glDeleteProgram(studio->programs[i]);
    glDeleteVertexArrays(2, studio->arrays);
    glDeleteBuffers(2, studio->buffers);
    bench_timer_free(&studio->timer);
    glDeleteQueries(1, &studio->query);
    memset(studio, 0, sizeof *studio);
}

bool bench_studio_step(struct bench_studio* studio, double* ms)
{
    ++studio->frame;
    if (!place(studio)) return false;
    if (ms) bench_timer_start(&studio->timer);
    hair_result result = hair_step(studio->hair, 1.0f / STUDIO_FPS);
    if (ms) bench_timer_stop(&studio->timer);
    if (ms) *ms = bench_timer_take(&studio->timer);
    return !result && !bench_was_interrupted();
}

// Drawing -----------------------------------------------------------------------------------------

struct bench_shot bench_studio_shot(const struct bench_studio* studio)
{
    const struct hair_settings* settings = &studio->scene.settings;
    return (struct bench_shot){.look = settings->look,
                               .view = settings->view,
                               .lod = hair_lod_default(),
                               .samples = 1,
                               .supersample = 1,
                               .away = 1};
}

bool bench_studio_set(struct bench_studio* studio, const struct bench_shot* shot)
{
    struct bench_shot* last = &studio->shot;
    if (hair_set_look(studio->hair, &shot->look)) return false;
    if (last->samples != shot->samples || last->supersample != shot->supersample) {
        if (last->samples) hair_targets_delete(&studio->targets);
        last->samples = 0;
        if (!hair_targets_make(&studio->targets, studio->size, studio->size, shot->supersample,
                               shot->samples)) {
            hair_targets_delete(&studio->targets);
            snprintf(studio->bench->sentence, sizeof studio->bench->sentence,
                     "OpenGL has no memory for %u x %u pixels of %u samples",
                     studio->size * shot->supersample, studio->size * shot->supersample, shot->samples);
            return false;
        }
    }
    *last = *shot;
    studio->goes_on = false;
    return true;
}

static bool shows_head(const struct bench_studio* studio)
{
    return studio->indices && !studio->bare;
}

static void draw_head(const struct bench_studio* studio, unsigned program,
                      const struct hair_matrices* matrices)
{
    bool whole = studio->scene.subject == HAIR_SUBJECT_FUR;
    if (!shows_head(studio)) return;
    struct hair_head_pose pose = hair_head_pose_at(studio->transform, 0, whole);
    hair_render_mesh_set_pose(program, &pose);
    glProgramUniformMatrix4fv(program, HAIR_AT_VIEW, 1, GL_FALSE, matrices->view);
    glProgramUniformMatrix4fv(program, HAIR_AT_PROJECTION, 1, GL_FALSE, matrices->projection);
    glUseProgram(program);
    glBindVertexArray(studio->arrays[0]);
    glEnable(GL_CULL_FACE);
    glDrawElements(GL_TRIANGLES, (GLsizei)studio->indices, GL_UNSIGNED_INT, NULL);
    glDisable(GL_CULL_FACE);
}

static bool draw_hair(struct bench_studio* studio, hair_view* view, const struct hair_matrices* matrices,
                      const struct hair_matrices* light)
{
    hair_light lit = studio->scene.settings.light;
    hair_light_clip(light, lit.shadow_matrix);
    if (view->pass == HAIR_PASS_COLOR && !studio->shot.unmapped) {
        lit.hair_shadow_map = studio->map.texture[HAIR_SHADOW_HAIR];
        lit.opaque_shadow_map = shows_head(studio) ? studio->map.texture[HAIR_SHADOW_BODY] : 0;
    }
    view->lights = &lit;
    memcpy(view->view, matrices->view, sizeof view->view);
    memcpy(view->projection, matrices->projection, sizeof view->projection);
    if (studio->timed) bench_timer_start(&studio->timer);
    hair_result result = hair_draw(studio->hair, view);
    if (studio->timed) bench_timer_stop(&studio->timer);
    view->lights = NULL; // The light is gone with this call.
    return !result;
}

// Draw the shadow map with the picture's primitives. Lines replace ribbons only if strands fill
// texels, because the shadow of thinner lines would differ.
static bool draw_shadow(struct bench_studio* studio, const struct hair_matrices* camera,
                        const struct hair_matrices* light, uint32_t size)
{
    hair_view view = studio->shot.view;
    hair_lod lod = studio->shot.lod;
    view.pass = HAIR_PASS_DEPTH;
    if (studio->shot.map_apart) view.render_path = studio->shot.map_path;
    if (bench_extent_fits(studio, light, size)) view.primitive = HAIR_PRIMITIVE_LINES;
    if (!studio->shot.map_whole) lod.importance *= fminf(1, bench_extent_texel(studio, camera, light, size));
    if (studio->shot.has_lod) view.lod = &lod;
    if (!hair_shadow_map_make(&studio->map, HAIR_SHADOW_OPACITY, (int)size)) return false;
    if (shows_head(studio)) {
        hair_shadow_map_begin(&studio->map, HAIR_SHADOW_BODY);
        draw_head(studio, studio->programs[DEPTH], light);
    }
    hair_shadow_map_begin(&studio->map, HAIR_SHADOW_HAIR);
    return draw_hair(studio, &view, light, light);
}

static bool draw_strands(struct bench_studio* studio, const struct hair_matrices* camera,
                         const struct hair_matrices* light)
{
    GLuint64 primitives = 0;
    hair_view view = studio->shot.view;
    view.pass = HAIR_PASS_COLOR;
    if (studio->shot.has_lod) view.lod = &studio->shot.lod;
    if (studio->counts) glBeginQuery(GL_PRIMITIVES_GENERATED, studio->query);
    bool ok = draw_hair(studio, &view, camera, light);
    if (!studio->counts) return ok;
    glEndQuery(GL_PRIMITIVES_GENERATED);
    glGetQueryObjectui64v(studio->query, GL_QUERY_RESULT, &primitives);
    studio->primitives = primitives;
    return ok;
}

static void average_pixels(const struct bench_studio* studio)
{
    GLsizei size = (GLsizei)studio->size;
    glBindFramebuffer(GL_FRAMEBUFFER, studio->targets.framebuffer[HAIR_TARGET_ENCODED]);
    glViewport(0, 0, size, size);
    glProgramUniform1i(studio->programs[AVERAGE], HAIR_AT_SUPERSAMPLE, (GLint)studio->shot.supersample);
    glUseProgram(studio->programs[AVERAGE]);
    glBindVertexArray(studio->arrays[1]);
    glBindTextureUnit(0, studio->targets.resolved);
    glDisable(GL_DEPTH_TEST);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

// Average the samples, and then the pixels of a supersampled picture.
static void average(struct bench_studio* studio, const struct bench_rectangle* part)
{
    if (studio->timed) bench_timer_start(&studio->timer);
    hair_targets_resolve(&studio->targets, part->lower, part->upper);
    if (studio->shot.supersample > 1) average_pixels(studio);
    if (studio->timed) bench_timer_stop(&studio->timer);
}

// Return the part of the picture to redraw. Without the head, only places with hair now or in the
// last picture change.
static struct bench_rectangle part_of(struct bench_studio* studio, const struct hair_matrices* camera)
{
    uint32_t pixels = studio->size * studio->shot.supersample;
    struct bench_rectangle part = {{0, 0}, {(int)pixels, (int)pixels}}, *last = &studio->drawn, now = part;
    if (!shows_head(studio)) now = bench_extent_hair(studio, camera, pixels);
    if (studio->goes_on)
        for (int i = 0; i < 2; ++i) {
            part.lower[i] = now.lower[i] < last->lower[i] ? now.lower[i] : last->lower[i];
            part.upper[i] = now.upper[i] > last->upper[i] ? now.upper[i] : last->upper[i];
        }
    *last = now;
    studio->goes_on = true;
    return part;
}

static void clear(unsigned framebuffer, const struct bench_rectangle* part)
{
    static const float far = 1, background[4] = {0.04f, 0.042f, 0.048f, 0};
    glEnable(GL_SCISSOR_TEST);
    glScissor(part->lower[0], part->lower[1], part->upper[0] - part->lower[0],
              part->upper[1] - part->lower[1]);
    glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, background);
    glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &far);
    glDisable(GL_SCISSOR_TEST);
}

bool bench_studio_draw(struct bench_studio* studio, double* ms)
{
    struct hair_matrices light, camera;
    unsigned framebuffer = studio->targets.framebuffer[HAIR_TARGET_DRAWN];
    GLsizei size = (GLsizei)(studio->size * studio->shot.supersample);
    studio->timed = ms != NULL;
    hair_light_matrices(&studio->scene, studio->transform, studio->reach, &light);
    bench_extent_aim(studio, &camera);
    uint32_t map = bench_extent_map(studio, &camera, &light);
    bench_extent_shift(&light, studio->shot.shadow_jitter, map);
    if (!draw_shadow(studio, &camera, &light, map)) return false;
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, size, size);
    struct bench_rectangle part = part_of(studio, &camera);
    clear(framebuffer, &part);
    draw_head(studio, studio->programs[MESH], &camera);
    if (!draw_strands(studio, &camera, &light)) return false;
    average(studio, &part);
    if (ms) *ms = bench_timer_take(&studio->timer);
    return !bench_was_interrupted();
}

bool bench_studio_warm_up(struct bench_studio* studio, double enough)
{
    bool ok = bench_studio_draw(studio, NULL); // compiles shaders
    if (studio->bench->software) return ok;
    for (double start = hair_now(); ok && hair_now() - start < enough; glFinish())
        ok = bench_studio_draw(studio, NULL);
    return ok;
}

bool bench_studio_time(struct bench_studio* studio, double enough, struct bench_times* out)
{
    enum { MAX_RUNS = 31, WARM = 100 }; // draws, ms
    double ms[MAX_RUNS], passed = 0;
    uint32_t runs = 0;
    if (!bench_studio_warm_up(studio, WARM)) return false;
    for (double start = hair_now(); bench_times_want_more(runs, MAX_RUNS, passed, enough);
         passed = hair_now() - start)
        if (!bench_studio_draw(studio, &ms[runs++])) return false;
    *out = bench_times_of(ms, runs);
    return true;
}

bool bench_studio_add(struct bench_studio* studio, double* rgba)
{
    size_t values = 4 * (size_t)studio->size * studio->size;
    bool averaged = studio->shot.supersample > 1;
    unsigned framebuffer = studio->targets.framebuffer[averaged ? HAIR_TARGET_ENCODED : HAIR_TARGET_RESOLVED];
    GLsizei size = (GLsizei)studio->size;
    float* read = malloc(values * sizeof *read);
    if (!read) return false;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    glNamedFramebufferReadBuffer(framebuffer, averaged ? GL_COLOR_ATTACHMENT1 : GL_COLOR_ATTACHMENT0);
    glReadPixels(0, 0, size, size, GL_RGBA, GL_FLOAT, read);
    for (size_t i = 0; i < values; ++i) rgba[i] += (double)read[i];
    free(read);
    return !glGetError();
}
