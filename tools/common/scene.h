// scene.h - Content of a capture, with haircut, head, motion, camera and lights. Scenes are read
// from JSON, including the built-in scenes.
#ifndef HAIR_TOOLS_COMMON_SCENE_H
#define HAIR_TOOLS_COMMON_SCENE_H

#include <stdbool.h>
#include <stdio.h>

#include "tools/common/motion.h"
#include "tools/common/scene_bullet.h"
#include "tools/common/scene_character.h"
#include "tools/common/scene_cuts.h"
#include "tools/common/scene_lights.h"
#include "tools/common/scene_maps.h"
#include "tools/common/scene_colliders.h"
#include "tools/common/scene_wind.h"
#include "tools/common/settings.h"

enum hair_subject { HAIR_SUBJECT_STYLE, HAIR_SUBJECT_FILE, HAIR_SUBJECT_FUR };

// Bit mask of parts to draw.
enum hair_show {
    HAIR_SHOW_HAIR = 1,
    HAIR_SHOW_HEAD = 2,
    HAIR_SHOW_GUIDES = 4,
    HAIR_SHOW_COLLIDERS = 8,
    HAIR_SHOW_WIND = 16
};

#define HAIR_SCENE_COLLIDERS 32 // The built-in head adds its own colliders.

struct hair_scene {
    enum hair_subject subject;
    char groom[HAIR_SCENE_PATH]; // file of HAIR_SUBJECT_FILE
    uint32_t fur_strands; // strands of HAIR_SUBJECT_FUR, on a ball
    float fur_length; // m
    float fur_comb[3]; // lean of its tips, as a fraction of their direction from the ball
    float ball_radius; // m, around the origin
    bool head; // draws the built-in head and its colliders
    bool head_is_said, pivot_is_said;
    struct hair_scene_character character; // replaces the built-in head
    bool framed; // The camera below is set. Otherwise it is made to fit the haircut.
    float eye[3], target[3]; // m
    float field_of_view; // vertical, degrees
    float background[2][3]; // linear colours at the centre and at the corners
    float exposure;
    struct hair_motion motion;
    float breath; // how far breath moves the front of the built-in head's chest forwards, m
    uint32_t collider_count;
    struct hair_scene_collider colliders[HAIR_SCENE_COLLIDERS];
    struct hair_bullet_list bullet;
    struct hair_scene_cuts cuts;
    struct hair_scene_maps maps;
    struct hair_scene_attributes attributes;
    bool shadow; // settings.light casts a shadow
    struct hair_scene_lights lights; // in addition to settings.light
    struct hair_scene_wind wind; // sources in addition to settings.wind
    float settle; // simulated time at rest before frame 0, s
    float fps;
    uint32_t frames; // number of frames of the whole scene
    uint32_t picture; // frame to take when a single picture is requested
    uint32_t width, height;
    uint32_t show; // bit mask of enum hair_show
    struct hair_settings settings;
};

// Initialize a default scene, the first style with a camera that frames it.
void hair_scene_default(struct hair_scene* scene);

// Free what a scene holds, also if reading it failed. A scene of zeros is allowed.
void hair_scene_free(struct hair_scene* scene);

// Read a scene. Return false after printing an error. `path` names the scene in error messages.
// Relative groom paths start at the folder of `path`.
bool hair_scene_parse(const char* tool, const char* path, const char* text, size_t size,
                      struct hair_scene* scene);
bool hair_scene_read(const char* tool, const char* path, struct hair_scene* scene);

// Load a built-in scene, of which each style has one too. Return false if the name is unknown.
bool hair_scene_named(const char* tool, const char* name, struct hair_scene* scene);
// Set the haircut to a built-in style. Return false if the name is unknown.
bool hair_scene_set_style(const char* tool, const char* name, struct hair_scene* scene);
// Set the motion to a built-in one. Return false if the name is unknown.
bool hair_scene_set_motion(const char* tool, const char* name, struct hair_scene* scene);
// Set the parts to draw from a text such as "hair,head". Return false if a name is unknown.
bool hair_scene_set_show(const char* text, struct hair_scene* scene);
#define HAIR_SCENE_SHOWN "some of hair, head, guides, colliders and wind"
// Name of the part of bit i of scene.show, or NULL beyond the last.
const char* hair_scene_part(int i);
// Set the haircut to a file.
void hair_scene_set_groom(const char* path, struct hair_scene* scene);
// Print the names of all built-in scenes, styles and motions.
void hair_scene_print_names(FILE* file);

#endif
