// scene.h - what a capture shows: a haircut, its head, how that moves, camera and light. From JSON, also for
// the scenes that are built in.
#ifndef HAIR_TOOLS_COMMON_SCENE_H
#define HAIR_TOOLS_COMMON_SCENE_H

#include <stdbool.h>
#include <stdio.h>

#include "tools/common/motion.h"
#include "tools/common/scene_bullet.h"
#include "tools/common/scene_lights.h"
#include "tools/common/scene_maps.h"
#include "tools/common/scene_solids.h"
#include "tools/common/scene_wind.h"
#include "tools/common/settings.h"

enum hair_subject { HAIR_SUBJECT_STYLE, HAIR_SUBJECT_FILE, HAIR_SUBJECT_FUR };

// What is drawn, together.
enum hair_show {
    HAIR_SHOW_HAIR = 1,
    HAIR_SHOW_HEAD = 2,
    HAIR_SHOW_GUIDES = 4,
    HAIR_SHOW_SOLIDS = 8,
    HAIR_SHOW_WIND = 16
};

#define HAIR_SCENE_PATH 4096
#define HAIR_SCENE_SOLIDS 32 // The built-in head adds its own.

struct hair_scene {
    enum hair_subject subject;
    char groom[HAIR_SCENE_PATH]; // of HAIR_SUBJECT_FILE
    uint32_t fur_strands; // of HAIR_SUBJECT_FUR, on a ball
    float fur_length; // m
    float ball_radius; // m, around the origin
    bool head; // whether the built-in head is drawn and collided with
    bool head_is_said, pivot_is_said;
    bool framed; // the camera below is set, else it is made to fit the haircut
    float eye[3], target[3]; // m
    float field_of_view; // vertical, degrees
    float background[2][3]; // linear colour at the centre and at the corners
    float exposure;
    struct hair_motion motion;
    uint32_t solid_count;
    struct hair_scene_solid solids[HAIR_SCENE_SOLIDS];
    struct hair_bullet_list bullet;
    struct hair_scene_maps maps;
    bool shadow; // settings.light has one
    struct hair_scene_lights lights; // beside settings.light
    struct hair_scene_wind wind; // beside settings.wind
    float settle; // s of hanging still before frame 0
    float fps;
    uint32_t frames; // of the whole scene
    uint32_t picture; // the frame to take when one is asked for
    uint32_t width, height;
    uint32_t show; // of enum hair_show
    struct hair_settings settings;
};

// A scene with nothing said: the first style, seen from a distance that fits.
void hair_scene_default(struct hair_scene* scene);

// What a scene that was read holds, also where that failed. One of zeros holds nothing.
void hair_scene_free(struct hair_scene* scene);

// False: `tool` has complained. `path` names the scene in that, and is where relative groom paths start.
bool hair_scene_parse(const char* tool, const char* path, const char* text, size_t size,
                      struct hair_scene* scene);
bool hair_scene_read(const char* tool, const char* path, struct hair_scene* scene);

// Of the scenes that are built in; there is one for each style as well. False: no such name.
bool hair_scene_named(const char* tool, const char* name, struct hair_scene* scene);
bool hair_scene_set_style(const char* tool, const char* name, struct hair_scene* scene);
bool hair_scene_set_motion(const char* tool, const char* name, struct hair_scene* scene);
void hair_scene_set_groom(const char* path, struct hair_scene* scene);
void hair_scene_print_names(FILE* file);

#endif
