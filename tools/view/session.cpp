// session.cpp - The living hair of a document: groom, instance, motion, and the drawn picture.
#include "tools/view/session.h"

extern "C" {
#include "tools/view/guides.h"
}

#include <epoxy/gl.h>

#include <math.h>
#include <string.h>

#include <algorithm>
#include <iterator>

namespace
{

constexpr float longest_step = 1.0f / 30; // s, so that a slow frame slows the motion
constexpr float longest_fall = 3; // of what is cut off, s

template <class T> bool differs(const T& a, const T& b)
{
    return memcmp(&a, &b, sizeof a) != 0;
}

bool groom_differs(const hair_scene& a, const hair_scene& b)
{
    return a.subject != b.subject || strcmp(a.groom, b.groom) || a.fur_strands != b.fur_strands ||
           a.fur_length != b.fur_length || a.ball_radius != b.ball_radius ||
           differs(a.settings.import, b.settings.import) || differs(a.settings.style, b.settings.style) ||
           differs(a.settings.groom, b.settings.groom) || a.maps.count != b.maps.count ||
           hair_every_strand_differs(&a.settings, &b.settings) || differs(a.maps, b.maps) ||
           differs(a.attributes, b.attributes) || differs(a.character, b.character);
}

// Set what depends on the size of the haircut.
void fit(view_session& session, hair_scene& scene)
{
    hair_bounds bounds = hair_camera_measure(&session.info, &scene, &session.reach);
    if (session.character) hair_character_bounds(session.character, &bounds);
    if (!scene.framed) hair_camera_frame(&scene, &bounds);
}

hair_result set_colliders(view_session& session, const hair_scene& scene)
{
    const hair_collider* others = nullptr;
    uint32_t other_count = 0;
    float lower[3], upper[3], time = (float)session.time;
    hair_result result = hair_get_bounds(session.hair, lower, upper);
    if (!result)
        result =
            hair_world_colliders(session.world, time, session.transform, lower, upper, &others, &other_count);
    hair_live_colliders& live = session.live_colliders;
    if (!result)
        result = hair_live_colliders_place(&live, &scene, session.character, time, session.transform, others,
                                           other_count);
    if (result) return result;
    uint32_t count = live.count;
    session.colliders.assign(live.at, live.at + count);
    // Keys of a new generation, because colliders must not sweep through hair that was put at rest.
    for (uint32_t i = 0; i < count; ++i) {
        uint64_t& key = session.colliders[i].key;
        key = (key ? key : i + 1) ^ ((uint64_t)session.generation << 40);
    }
    result = hair_set_colliders(session.hair, session.colliders.data(), count, sizeof(hair_collider));
    if (result || !session.twin) return result;
    return hair_set_colliders(session.twin, session.colliders.data(), count, sizeof(hair_collider));
}

// Destroy what has been cut off for the longest time.
void drop_oldest_piece(view_session& session)
{
    hair_cut_pieces& pieces = session.pieces;
    hair_destroy(pieces.at[0]);
    --pieces.count;
    std::copy(pieces.at + 1, pieces.at + pieces.count + 1, pieces.at);
    std::copy(session.fall_times + 1, session.fall_times + pieces.count + 1, session.fall_times);
}

hair_result step_pieces(view_session& session, float dt)
{
    hair_cut_pieces& pieces = session.pieces;
    for (uint32_t i = 0; i < pieces.count; ++i) session.fall_times[i] += dt;
    while (pieces.count && session.fall_times[0] > longest_fall) drop_oldest_piece(session);
    return hair_cuts_step(&pieces, session.colliders.data(), (uint32_t)session.colliders.size(), dt);
}

void destroy_renders(view_session& session)
{
    for (hair_render*& render : session.renders) {
        if (render) hair_render_destroy(render);
        render = nullptr;
    }
    session.render = nullptr;
}

// Make the body of a character, unless there is one.
hair_result create_body(view_session& session, hair_scene& scene, const hair_groom* groom,
                        hair_character& character)
{
    if (character.body) return HAIR_OK;
    float reach;
    hair_groom_info info = hair_groom_info_default();
    hair_groom_describe(groom, &info);
    hair_camera_measure(&info, &scene, &reach);
    return hair_character_create_body(&character, session.context, scene.motion.pivot, reach);
}

hair_result create_hair(view_session& session, hair_scene& scene, hair_groom* groom,
                        hair_character* character, hair_instance** out)
{
    hair_desc desc = scene.settings.desc;
    hair_wind wind = hair_scene_wind_of(&scene.settings, &scene.wind);
    hair_look look = hair_every_strand_look(&scene.settings);
    desc.label = session.name.c_str();
    desc.physics = &scene.settings.physics;
    desc.look = &look;
    hair_result result = character ? create_body(session, scene, groom, *character) : HAIR_OK;
    if (!result && !hair_character_pose_head(character, &scene.motion, (float)session.time, desc.transform))
        result = HAIR_ERROR_FILE;
    if (!result) result = hair_create(session.context, groom, &desc, out);
    if (!result) result = hair_groups_apply(*out, &scene.settings, nullptr);
    if (!result) result = hair_set_wind(*out, &wind);
    return !result && character ? hair_character_attach(character, *out) : result;
}

// Let a character take the place of the present one. Strands that were cut off may touch its body.
void replace_character(view_session& session, hair_character* character)
{
    if (character == session.character) return;
    hair_cuts_destroy(&session.pieces);
    destroy_renders(session);
    hair_character_destroy(session.character);
    session.character = character;
}

// Make the instance anew, of a groom and a character that become the session's.
int replace_hair(view_session& session, hair_scene& scene, hair_groom* groom, hair_character* character)
{
    hair_instance* hair = nullptr;
    hair_world* world = nullptr;
    auto world_scene = std::make_unique<hair_scene>(scene);
    int code = hair_exit_for(create_hair(session, scene, groom, character, &hair));
    if (!code) code = hair_world_create(TOOL, session.name.c_str(), world_scene.get(), &session.host, &world);
    if (code) {
        hair_destroy(hair);
        if (groom != session.groom) hair_groom_destroy(groom);
        if (character != session.character) hair_character_destroy(character);
        return code;
    }
    hair_destroy(session.hair);
    hair_destroy(session.twin);
    session.twin = nullptr;
    hair_world_destroy(session.world);
    if (groom != session.groom) hair_groom_destroy(session.groom);
    replace_character(session, character);
    session.hair = hair;
    session.world = world;
    session.world_scene = std::move(world_scene);
    session.groom = groom;
    session.look = hair_every_strand_look(&scene.settings);
    session.info = hair_groom_info_default();
    hair_groom_describe(groom, &session.info);
    session.pins.clear();
    session.cut_strands = 0;
    ++session.generation;
    return HAIR_EXIT_OK;
}

// Set what the instance takes while it lives.
hair_result change_hair(view_session& session, const hair_scene& scene)
{
    const hair_scene& old = *session.applied;
    hair_result result = HAIR_OK;
    if (differs(old.settings.physics, scene.settings.physics))
        result = hair_set_physics(session.hair, &scene.settings.physics);
    if (!result && session.twin) result = hair_set_physics(session.twin, &scene.settings.physics);
    hair_look look = hair_every_strand_look(&scene.settings);
    if (!result && differs(old.settings.look, scene.settings.look))
        result = hair_set_look(session.hair, &look);
    session.look = look;
    if (!result) result = hair_groups_apply(session.hair, &scene.settings, &old.settings);
    if (!result && session.twin) result = hair_groups_apply(session.twin, &scene.settings, &old.settings);
    if (!result && (differs(old.settings.wind, scene.settings.wind) || differs(old.wind, scene.wind))) {
        hair_wind wind = hair_scene_wind_of(&scene.settings, &scene.wind);
        result = hair_set_wind(session.hair, &wind);
        if (!result && session.twin) result = hair_set_wind(session.twin, &wind);
    }
    return result;
}

// Restore the settings of the instance after a refusal of the settings of `scene`.
void restore(view_session& session, const hair_scene& scene)
{
    hair_wind wind = hair_scene_wind_of(&session.applied->settings, &session.applied->wind);
    hair_set_physics(session.hair, &session.applied->settings.physics);
    session.look = hair_every_strand_look(&session.applied->settings);
    hair_set_look(session.hair, &session.look);
    hair_groups_apply(session.hair, &session.applied->settings, &scene.settings);
    hair_set_wind(session.hair, &wind);
}

int remake(view_session& session, hair_scene& scene, bool with_groom)
{
    hair_groom* groom = session.groom;
    hair_character* character = session.character;
    int code = hair_character_check_solver(TOOL, &scene);
    if (code) return code;
    if (!with_groom) return replace_hair(session, scene, groom, character);
    code = hair_character_create(TOOL, &scene, &character);
    if (code) return code;
    code = hair_groom_source_load(TOOL, &session.host, &scene, character, &groom);
    if (!code) {
        code = hair_every_strand_make(TOOL, &session.host, session.context, &scene, &groom);
        if (!code) return replace_hair(session, scene, groom, character);
        hair_groom_destroy(groom);
    }
    hair_character_destroy(character);
    return code;
}

// Compute the pose of the head at the time of the session, and that of the character.
hair_result pose(view_session& session, const hair_scene& scene)
{
    float time = (float)session.time;
    std::fill(session.way, session.way + 3, 0.0f);
    if (!hair_character_pose_head(session.character, &scene.motion, time, session.transform))
        return HAIR_ERROR_FILE;
    if (session.character && scene.character.follow) hair_character_way(session.character, time, session.way);
    return HAIR_OK;
}

// Put the hair of an instance at rest in the present pose.
hair_result begin_again(view_session& session, hair_instance* hair)
{
    hair_result result = hair_teleport(hair, session.transform);
    if (result) return result;
    return session.character ? hair_character_attach(session.character, hair) : hair_reset(hair);
}

// Step the second head, which moves and is held like the first.
hair_result step_twin(view_session& session, float dt)
{
    hair_result result = session.character ? hair_character_move_hair(session.character, session.twin)
                                           : hair_set_transform(session.twin, session.transform);
    if (!result)
        result =
            hair_set_pins(session.twin, session.pins.data(), (uint32_t)session.pins.size(), sizeof(hair_pin));
    return result ? result : hair_step(session.twin, dt);
}

} // namespace

std::vector<hair_collider> view_session_known_colliders(const view_session& session, const hair_scene& scene)
{
    std::vector<hair_collider> known;
    std::remove_copy_if(session.colliders.begin(), session.colliders.end(), std::back_inserter(known),
                        [](const hair_collider& collider) { return view_is_body(&collider); });
    if (!scene.head || known.size() == session.colliders.size()) return known;
    hair_collider rest[HEAD_COLLIDERS], moved[HAIR_HEAD_RIG_COLLIDERS];
    uint32_t count = head_colliders(rest, HEAD_COLLIDERS);
    hair_head_rig_colliders(&scene, nullptr, (float)session.time, session.transform, moved);
    // The head above the neck has a mesh.
    for (uint32_t i = 0; i < count; ++i)
        if (rest[i].position[1] < HAIR_HEAD_MOVES) known.push_back(moved[i]);
    return known;
}

int view_session_open(const hair_host& host, void* (*get_proc)(const char*, void*), const std::string& glsl,
                      view_session& out)
{
    hair_context_desc desc = hair_context_desc_default();
    out.host = host;
    out.live_colliders.tool = TOOL;
    out.live_colliders.host = &out.host;
    desc.host = &out.host;
    desc.get_proc = get_proc;
    desc.timings = true;
    desc.glsl_dir = glsl.empty() ? nullptr : glsl.c_str();
    int code = hair_exit_for(hair_context_create(&desc, &out.context));
    out.live_colliders.context = out.context;
    return code;
}

// Return whether another mesh is drawn beside the hair. Only some haircuts have a hair tie.
static bool mesh_differs(const hair_scene& a, const hair_scene& b)
{
    return a.head != b.head || a.subject != b.subject || a.ball_radius != b.ball_radius ||
           a.settings.style.style != b.settings.style.style || strcmp(a.groom, b.groom) != 0;
}

void view_session_close(view_session& session)
{
    hair_cuts_destroy(&session.pieces);
    hair_destroy(session.hair);
    hair_destroy(session.twin);
    hair_world_destroy(session.world);
    destroy_renders(session);
    hair_character_destroy(session.character);
    hair_live_colliders_free(&session.live_colliders);
    hair_context_destroy(session.context);
    hair_groom_destroy(session.groom);
}

int view_session_apply(view_session& session, hair_scene& scene, const std::string& name)
{
    bool is_first = !session.applied;
    session.name = name;
    if (*scene.character.file) scene.head = false;
    bool with_groom = is_first || groom_differs(*session.applied, scene);
    bool with_world = !is_first && session.applied->bullet.object != scene.bullet.object;
    int code = HAIR_EXIT_OK;
    if (with_groom || with_world || differs(session.applied->settings.desc, scene.settings.desc)) {
        code = remake(session, scene, with_groom);
    } else {
        code = hair_exit_for(change_hair(session, scene));
        if (code) restore(session, scene);
    }
    if (code) return code;
    if (!is_first && mesh_differs(*session.applied, scene)) destroy_renders(session);
    fit(session, scene);
    if (is_first) session.applied = std::make_unique<hair_scene>();
    *session.applied = scene;
    hair_result result = pose(session, scene);
    return hair_exit_for(result ? result : set_colliders(session, scene));
}

hair_scene view_session_seen(const view_session& session, const hair_scene& scene)
{
    hair_scene seen = scene;
    for (int i = 0; i < 3; ++i) {
        seen.eye[i] += session.way[i];
        seen.target[i] += session.way[i];
    }
    return seen;
}

int view_session_step(view_session& session, const hair_scene& scene, float dt, bool plays)
{
    float step = std::min(dt, longest_step);
    if (plays) session.time += step;
    hair_result result = pose(session, scene);
    if (!result)
        result = session.character ? hair_character_move(session.character, session.hair)
                                   : hair_set_transform(session.hair, session.transform);
    if (!result) result = set_colliders(session, scene);
    if (!result)
        result =
            hair_set_pins(session.hair, session.pins.data(), (uint32_t)session.pins.size(), sizeof(hair_pin));
    if (!result) result = hair_step(session.hair, step);
    if (!result && session.twin) result = step_twin(session, step);
    if (!result) result = step_pieces(session, step);
    return hair_exit_for(result);
}

int view_session_cut(view_session& session, const hair_cut_desc& cut, uint32_t& strands)
{
    hair_instance* fallen = nullptr;
    hair_cut_info info = hair_cut_info_default();
    hair_result result = hair_cut(session.hair, &cut, &info, &fallen);
    if (result) return hair_exit_for(result);
    strands = info.strands;
    session.cut_strands += strands;
    if (!fallen) return HAIR_EXIT_OK;
    if (session.pieces.count == HAIR_SCENE_CUTS) drop_oldest_piece(session);
    session.fall_times[session.pieces.count] = 0;
    session.pieces.at[session.pieces.count++] = fallen;
    return HAIR_EXIT_OK;
}

int view_session_reset(view_session& session, const hair_scene& scene)
{
    session.time = 0;
    ++session.generation;
    session.pins.clear();
    hair_result result = pose(session, scene);
    hair_cuts_destroy(&session.pieces);
    if (!result && session.cut_strands)
        result = hair_set_lengths(session.hair, 0, session.info.guide_count, nullptr);
    if (!result) session.cut_strands = 0;
    if (!result) result = begin_again(session, session.hair);
    if (!result && session.twin) result = begin_again(session, session.twin);
    if (!result) result = set_colliders(session, scene);
    return hair_exit_for(result);
}
