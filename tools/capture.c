// capture.c - hair-capture, which simulates and draws a scene off-screen into pictures, videos and
// hashes.
#define _POSIX_C_SOURCE 200809L
#include <hair/hair_egl.h>

#include "tools/bullet/world.h"
#include "tools/common/capture_options.h"
#include "tools/common/capture_outputs.h"
#include "tools/common/character.h"
#include "tools/common/cuts.h"
#include "tools/common/every_strand.h"
#include "tools/common/frame_hash.h"
#include "tools/common/interrupt.h"
#include "tools/common/live_colliders.h"
#include "tools/common/playback.h"
#include "tools/common/scene_mesh.h"
#include "tools/common/shader_file.h"
#include "tools/common/stats.h"
#include "tools/common/groom_source.h"
#include "tools/common/groups.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define TOOL "hair-capture"
// Maximum step, s, the default of hair_desc.max_dt. A longer frame is stepped in parts.
#define LONGEST_STEP 0.1f

struct capture {
    struct hair_capture_options options;
    hair_host host;
    hair_groom* groom;
    hair_egl* egl;
    hair_context* context;
    hair_instance* hair;
    hair_shader* shader; // NULL uses the library's shading
    struct hair_world* world; // NULL if the scene has no Bullet objects
    struct hair_live_colliders colliders;
    struct hair_cut_pieces pieces;
    struct hair_character* character; // NULL if the scene has none
    float eye[3], target[3]; // of the camera at the start of the scene, m
    struct hair_render* render;
    struct hair_capture_outputs outputs;
    struct hair_stats stats;
    float reach; // radius of the head's reach, m
    struct hair_frame_hash hash;
    struct hair_playback cache;
    double started; // ms
};

static void say_all(hair_log_level level, const char* sentence, void* tool)
{
    (void)level;
    hair_complain(tool, "%s", sentence);
}

// Return the exit status for a status of a call that applies settings. If the library refuses what
// a scene file says, the input cannot be used.
static int exit_for_settings(const struct capture* capture, int status)
{
    return status == HAIR_EXIT_USAGE && capture->options.is_of_file ? HAIR_EXIT_INPUT : status;
}

// Compute the pose of the head, and of the character if there is one. Return false after printing
// an error.
static bool pose_at(struct capture* capture, float time, float transform[16])
{
    return hair_character_pose_head(capture->character, &capture->options.scene.motion, time, transform);
}

// Making ------------------------------------------------------------------------------------------

static int make_character(struct capture* capture)
{
    struct hair_scene* scene = &capture->options.scene;
    int code = hair_character_create(TOOL, scene, &capture->character);
    if (code || !capture->character) return code;
    scene->head = false;
    return hair_character_check_solver(TOOL, scene);
}

// Create the body of the character, and bind the hair to it.
static hair_result attach_character(struct capture* capture)
{
    const float* pivot = capture->options.scene.motion.pivot;
    hair_result result =
        hair_character_create_body(capture->character, capture->context, pivot, capture->reach);
    return result ? result : hair_character_attach(capture->character, capture->hair);
}

static int make_groom(struct capture* capture)
{
    struct hair_scene* scene = &capture->options.scene;
    int code = hair_groom_source_load(TOOL, &capture->host, scene, capture->character, &capture->groom);
    if (code) return exit_for_settings(capture, code);
    hair_groom_info* info = &capture->stats.groom;
    *info = hair_groom_info_default();
    hair_groom_describe(capture->groom, info);
    if (!hair_groups_check(TOOL, &scene->settings, info->group_count))
        return exit_for_settings(capture, HAIR_EXIT_USAGE);

    struct hair_bounds bounds = hair_camera_measure(info, scene, &capture->reach);
    if (capture->character) hair_character_bounds(capture->character, &bounds);
    if (!scene->framed) hair_camera_frame(scene, &bounds);
    memcpy(capture->eye, scene->eye, sizeof capture->eye);
    memcpy(capture->target, scene->target, sizeof capture->target);
    return HAIR_EXIT_OK;
}

static int make_opengl(struct capture* capture)
{
    hair_result result = hair_egl_create(&capture->host, capture->options.device, &capture->egl);
    if (result) return hair_exit_for(result);
    hair_context_desc desc = hair_context_desc_default();
    desc.host = &capture->host;
    desc.get_proc = hair_egl_get_proc;
    desc.timings = capture->options.stats ? 1 : 0;
    int code = hair_exit_for(hair_context_create(&desc, &capture->context));
    capture->colliders.context = capture->context;
    return code;
}

static int make_every_strand(struct capture* capture)
{
    int code = hair_every_strand_make(TOOL, &capture->host, capture->context, &capture->options.scene,
                                      &capture->groom);
    if (!code) hair_groom_describe(capture->groom, &capture->stats.groom);
    return exit_for_settings(capture, code);
}

static int make_render(struct capture* capture)
{
    const struct hair_capture_options* options = &capture->options;
    struct hair_render_desc desc = {.width = options->scene.width,
                                    .height = options->scene.height,
                                    .samples = options->samples,
                                    .supersample = options->supersample,
                                    .linear = capture->outputs.frames.kind == HAIR_FRAME_WRITER_EXR};
    int code = hair_render_create(TOOL, &desc, &capture->render);
    if (code) return code;
    return hair_scene_set_mesh(TOOL, &options->scene, capture->groom, capture->character, capture->render);
}

// Set the scene's colliders and those of Bullet objects that the hair can reach.
static hair_result set_colliders(struct capture* capture, float time, const float transform[16])
{
    const hair_collider* others = NULL;
    uint32_t other_count = 0;
    float lower[3], upper[3];
    hair_result result = hair_get_bounds(capture->hair, lower, upper);
    if (!result)
        result = hair_world_colliders(capture->world, time, transform, lower, upper, &others, &other_count);
    struct hair_live_colliders* colliders = &capture->colliders;
    if (!result)
        result = hair_live_colliders_place(colliders, &capture->options.scene, capture->character, time,
                                           transform, others, other_count);
    if (result) return result;
    return hair_set_colliders(capture->hair, colliders->at, colliders->count, sizeof *colliders->at);
}

static int make_shader(struct capture* capture)
{
    const char* path = capture->options.shader;
    if (!path) return HAIR_EXIT_OK;
    int code = hair_shader_file_create(TOOL, path, capture->context, &capture->shader);
    capture->options.scene.settings.view.shader = capture->shader;
    return code;
}

static int make_hair(struct capture* capture)
{
    const struct hair_scene* scene = &capture->options.scene;
    hair_desc desc = scene->settings.desc;
    hair_wind wind = hair_scene_wind_of(&scene->settings, &scene->wind);
    hair_look look = hair_every_strand_look(&scene->settings);
    desc.label = capture->options.name;
    desc.physics = &scene->settings.physics;
    desc.look = &look;
    pose_at(capture, 0, desc.transform);
    hair_result result = hair_create(capture->context, capture->groom, &desc, &capture->hair);
    if (!result) result = hair_groups_apply(capture->hair, &scene->settings, NULL);
    if (!result) result = hair_set_wind(capture->hair, &wind);
    if (!result && capture->character) result = attach_character(capture);
    if (!result) result = set_colliders(capture, 0, desc.transform);
    if (!result) result = hair_playback_play(&capture->cache, capture->hair, 0);
    return exit_for_settings(capture, hair_exit_for(result));
}

static int make_hash(struct capture* capture)
{
    if (!capture->options.hash) return HAIR_EXIT_OK;
    return hair_frame_hash_create(TOOL, capture->stats.groom.guide_vertex_count, &capture->hash);
}

// Frames ------------------------------------------------------------------------------------------

static float time_of(const struct capture* capture, double frame)
{
    return (float)(frame / (double)capture->options.scene.fps);
}

// Simulate with the head at rest, so that the hair settles.
static hair_result settle(struct capture* capture)
{
    const struct hair_scene* scene = &capture->options.scene;
    hair_result result = HAIR_OK;
    for (float time = 0; time < scene->settle && !result && !hair_interrupted(); time += LONGEST_STEP)
        result = hair_step(capture->hair, fminf(LONGEST_STEP, scene->settle - time));
    return result;
}

// Step from the previous frame to this one.
static hair_result step(struct capture* capture, uint32_t frame)
{
    const struct hair_scene* scene = &capture->options.scene;
    int parts = (int)ceilf(1 / (scene->fps * LONGEST_STEP) - 1e-4f);
    hair_result result = HAIR_OK;
    for (int i = 1; i <= parts && !result; ++i) {
        float transform[16], time = time_of(capture, frame - 1 + (double)i / parts);
        if (!pose_at(capture, time, transform)) return HAIR_ERROR_FILE;
        result = capture->character ? hair_character_move(capture->character, capture->hair)
                                    : hair_set_transform(capture->hair, transform);
        if (!result) result = set_colliders(capture, time, transform);
        if (!result) result = hair_playback_play(&capture->cache, capture->hair, (double)time);
        float dt = 1 / (scene->fps * (float)parts);
        if (!result) result = hair_step(capture->hair, dt);
        if (!result)
            result = hair_cuts_step(&capture->pieces, capture->colliders.at, capture->colliders.count, dt);
    }
    return result;
}

// Draw the mesh of the character in its pose, from a camera that follows.
static void move_picture(struct capture* capture, float time)
{
    struct hair_scene* scene = &capture->options.scene;
    float way[3];
    hair_render_move_mesh(capture->render, &capture->character->mesh);
    hair_character_way(capture->character, time, way);
    for (int i = 0; i < 3 && scene->character.follow; ++i) {
        scene->eye[i] = capture->eye[i] + way[i];
        scene->target[i] = capture->target[i] + way[i];
    }
}

static int show(struct capture* capture, uint32_t frame)
{
    const struct hair_capture_options* options = &capture->options;
    const struct hair_scene* scene = &options->scene;
    const struct hair_image* image;
    float transform[16];
    double before = hair_now();
    if (!options->out && !options->stats && !options->hash)
        return hair_capture_outputs_dump(&capture->outputs, capture->hair);
    if (!pose_at(capture, time_of(capture, frame), transform)) return HAIR_EXIT_INPUT;
    if (capture->character) move_picture(capture, time_of(capture, frame));
    hair_render_set_breath(capture->render, hair_head_rig_breath(scene, time_of(capture, frame)));
    int code = hair_render_frame(capture->render, scene, transform, capture->reach, capture->hair, &image);
    code = exit_for_settings(capture, code);
    if (code) return code;
    hair_clock_add(&capture->stats.draw, hair_now() - before);
    if (capture->options.hash)
        code = hair_exit_for(hair_frame_hash_add(&capture->hash, capture->hair, image));
    if (!code) code = hair_capture_outputs_dump(&capture->outputs, capture->hair);
    if (!code && !hair_frame_writer_put(&capture->outputs.frames, image, frame)) code = HAIR_EXIT_RUNTIME;
    return code;
}

static void show_progress(const struct capture* capture, uint32_t done)
{
    uint32_t end = capture->options.end;
    double elapsed = 1e-3 * (hair_now() - capture->started);
    if (capture->options.quiet || !isatty(STDERR_FILENO)) return;
    fprintf(stderr, "\r%s: frame %u of %u, %.0f s left   %s", TOOL, done, end, elapsed / done * (end - done),
            done == end ? "\n" : "");
}

// Make the cuts of a frame.
static int cut(struct capture* capture, uint32_t frame)
{
    hair_result result = hair_cuts_run(&capture->options.scene.cuts, frame, capture->hair, &capture->pieces);
    if (capture->render)
        hair_render_set_more_hair(capture->render, capture->pieces.at, capture->pieces.count);
    return exit_for_settings(capture, hair_exit_for(result));
}

static int run_frames(struct capture* capture)
{
    const struct hair_capture_options* options = &capture->options;
    capture->started = hair_now();
    int settled = exit_for_settings(capture, hair_exit_for(settle(capture)));
    if (settled) return settled;
    for (uint32_t frame = 0; frame < options->end; ++frame) {
        double before = hair_now();
        int code = frame ? exit_for_settings(capture, hair_exit_for(step(capture, frame))) : HAIR_EXIT_OK;
        if (!code && frame && options->stats) {
            glFinish();
            hair_clock_add(&capture->stats.step, hair_now() - before);
        }
        if (!code) code = cut(capture, frame);
        if (!code && frame >= options->first) code = show(capture, frame);
        if (code) return code;
        show_progress(capture, frame + 1);
        if (hair_interrupted()) {
            hair_complain(TOOL, "interrupted after frame %u", frame);
            return HAIR_EXIT_RUNTIME;
        }
    }
    return HAIR_EXIT_OK;
}

// Main program ------------------------------------------------------------------------------------

static int make(struct capture* capture)
{
    int code = make_character(capture);
    if (!code) code = make_groom(capture);
    if (!code) code = make_opengl(capture);
    if (!code) code = make_every_strand(capture);
    if (!code) code = make_render(capture);
    if (!code)
        code = hair_world_create(TOOL, capture->options.name, &capture->options.scene, &capture->host,
                                 &capture->world);
    if (!code) code = make_shader(capture);
    if (!code) code = hair_playback_open(TOOL, capture->options.cache, capture->groom, &capture->cache);
    if (!code) code = make_hair(capture);
    if (!code) code = make_hash(capture);
    return code;
}

static int write_stats(struct capture* capture)
{
    const struct hair_capture_options* options = &capture->options;
    if (!options->stats) return HAIR_EXIT_OK;
    capture->stats.name = options->name;
    capture->stats.renderer = (const char*)glGetString(GL_RENDERER);
    capture->stats.width = options->scene.width;
    capture->stats.height = options->scene.height;
    capture->stats.first = options->first;
    capture->stats.end = options->end;
    capture->stats.solver_stats = hair_solver_stats_default();
    hair_result result = hair_get_solver_stats(capture->hair, &capture->stats.solver_stats);
    if (result) return hair_exit_for(result);
    bool ok = hair_stats_write(TOOL, options->stats, &capture->stats, capture->context, capture->hair);
    return ok ? HAIR_EXIT_OK : HAIR_EXIT_RUNTIME;
}

static int run(struct capture* capture)
{
    const struct hair_capture_options* options = &capture->options;
    int code = hair_capture_outputs_plan(TOOL, options, &capture->outputs);
    if (!code) code = make(capture);
    if (code) return code;
    code = hair_capture_outputs_open(TOOL, options, capture->hair, &capture->outputs);
    if (!code) code = run_frames(capture);
    if (code)
        hair_capture_outputs_discard(&capture->outputs);
    else
        code = hair_capture_outputs_commit(&capture->outputs);
    if (!code) code = write_stats(capture);
    return code || !options->hash ? code : hair_frame_hash_print(TOOL, &capture->hash);
}

static void destroy(struct capture* capture)
{
    hair_cuts_destroy(&capture->pieces);
    hair_destroy(capture->hair);
    hair_world_destroy(capture->world);
    hair_character_destroy(capture->character);
    hair_live_colliders_free(&capture->colliders);
    // The context may be lost, and Epoxy aborts if a function is first called in a lost context.
    hair_render_abandon(capture->render);
    hair_shader_destroy(capture->shader);
    hair_context_destroy(capture->context);
    hair_egl_destroy(capture->egl);
    hair_groom_destroy(capture->groom);
    hair_playback_free(&capture->cache);
    hair_stats_free(&capture->stats);
    hair_frame_hash_free(&capture->hash);
    hair_scene_free(&capture->options.scene);
    free(capture);
}

int main(int count, char** arguments)
{
    struct capture* capture = calloc(1, sizeof *capture);
    if (!capture) {
        hair_complain(TOOL, "out of memory");
        return HAIR_EXIT_RUNTIME;
    }
    hair_interrupt_catch(TOOL);
    int code = hair_capture_parse(TOOL, count, arguments, &capture->options);
    if (code < 0) {
        capture->host.log = capture->options.verbose ? say_all : hair_print_log;
        capture->host.user = (void*)(uintptr_t)TOOL;
        capture->colliders.tool = TOOL;
        capture->colliders.host = &capture->host;
        code = run(capture);
    }
    destroy(capture);
    return code;
}
