// session.h - The living hair of a document: groom, instance, motion, and the drawn picture.
#ifndef HAIR_TOOLS_VIEW_SESSION_H
#define HAIR_TOOLS_VIEW_SESSION_H

#include "tools/view/common.h"
#include "tools/view/quality.h"

#include <memory>
#include <string>
#include <vector>

// Renderers, each with the size of its last picture.
enum view_render {
    VIEW_RENDER_MOVING,
    VIEW_RENDER_FULL,
    VIEW_RENDER_REFERENCE,
    VIEW_RENDER_COMPARED,
    VIEW_RENDERS
};

struct view_session {
    hair_host host = {};
    hair_context* context = nullptr;
    hair_groom* groom = nullptr;
    hair_instance* hair = nullptr;
    hair_instance* twin = nullptr; // hair of motion_error.h, which moves alike
    hair_character* character = nullptr; // null if the scene has none
    hair_world* world = nullptr;
    std::unique_ptr<hair_scene> world_scene; // scene that the world was made of
    hair_render* renders[VIEW_RENDERS] = {};
    hair_render_desc render_descs[VIEW_RENDERS] = {};
    hair_render* render = nullptr; // renderer of the last picture
    hair_look look = {}; // look that the instance has now, which depends on the quality
    hair_groom_info info = {};
    std::unique_ptr<hair_scene> applied; // scene that the hair has now
    std::string name; // name of the scene, for messages
    hair_live_colliders live_colliders = {};
    std::vector<hair_collider> colliders; // with keys of this generation
    std::vector<hair_pin> pins; // strands that the mouse holds
    hair_cut_pieces pieces = {}; // strands that were cut off, oldest first
    float fall_times[HAIR_SCENE_CUTS] = {}; // since the cut of each of them, s
    uint32_t cut_strands = 0; // strands that were cut since all were whole
    float reach = 1; // radius of the head's reach, m
    float transform[16] = {}; // of the head
    float way[3] = {}; // of the camera that follows a character, m
    double time = 0; // of the motion, s
    uint32_t generation = 0; // number of times that the hair was put at rest
};

// Create the context of the library, with the shaders of a folder unless `glsl` is "". Return an
// exit status, after printing any error.
int view_session_open(const hair_host& host, void* (*get_proc)(const char*, void*), const std::string& glsl,
                      view_session& out);
void view_session_close(view_session& session);

// Make the hair follow a scene. Only what differs is made anew. The camera of a scene without one
// is set. On failure the hair keeps the scene that it had. Return an exit status.
int view_session_apply(view_session& session, hair_scene& scene, const std::string& name);

// Return the scene with the camera where it follows the character.
hair_scene view_session_seen(const view_session& session, const hair_scene& scene);

// Advance the hair by a time, in s. With `plays`, the head follows its motion.
int view_session_step(view_session& session, const hair_scene& scene, float dt, bool plays);
// Cut the hair. `strands` receives the number of strands. What falls off lives for a few seconds.
int view_session_cut(view_session& session, const hair_cut_desc& cut, uint32_t& strands);
// Begin again, with the hair at rest and whole.
int view_session_reset(view_session& session, const hair_scene& scene);

// Draw a picture of `width` by `height` pixels or fewer by one of the renderers. Return an exit
// status.
int view_session_draw(view_session& session, const hair_scene& scene, uint32_t width, uint32_t height,
                      const view_quality& quality, view_render which);

// Draw a picture that is shifted by fractions of a pixel, by a renderer of its own.
int view_session_draw_shifted(view_session& session, const hair_scene& scene, uint32_t width, uint32_t height,
                              const view_quality& quality, const float shift[2]);

// Return the colliders whose distances the CPU knows. Capsules stand for the body of the built-in
// head. Other bodies are left out.
std::vector<hair_collider> view_session_known_colliders(const view_session& session, const hair_scene& scene);

// Return whether the hair sleeps, because it is in equilibrium.
bool view_session_sleeps(const view_session& session);

// Return the number of programs that the driver has compiled.
uint32_t view_session_compiled(const view_session& session);

#endif
