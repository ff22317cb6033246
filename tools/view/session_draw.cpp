// session_draw.cpp - Pictures of the living hair, in several qualities.
#include "tools/view/session.h"

#include <math.h>
#include <string.h>

#include <algorithm>

namespace
{

// Make the renderer of a size, or keep the present one.
int make_render(view_session& session, const hair_scene& scene, const hair_render_desc& desc,
                view_render which)
{
    hair_render*& render = session.renders[which];
    session.render = render;
    if (render && !memcmp(&session.render_descs[which], &desc, sizeof desc)) return HAIR_EXIT_OK;
    if (render) hair_render_destroy(render);
    render = nullptr;
    session.render_descs[which] = desc;
    int code = hair_render_create(TOOL, &desc, &render);
    session.render = render;
    return code ? code : hair_scene_set_mesh(TOOL, &scene, session.groom, session.character, render);
}

// Give the instance the look of a quality.
hair_result set_look(view_session& session, const hair_scene& scene, const view_quality& quality)
{
    hair_look look = hair_every_strand_look(&scene.settings);
    if (!quality.self_shadows) look.self_shadow.method = HAIR_SELF_SHADOW_DEPTH;
    if (!quality.shadows) look.followers.collision = HAIR_FOLLOWER_COLLISION_NONE;
    if (!memcmp(&session.look, &look, sizeof look)) return HAIR_OK;
    hair_result result = hair_set_look(session.hair, &look);
    if (!result) session.look = look;
    return result;
}

void reduce(const view_quality& quality, hair_scene& scene)
{
    hair_lod& lod = scene.settings.lod;
    if (quality.strand_pixels > 0) {
        if (!scene.settings.has_lod) lod = hair_lod_default();
        scene.settings.has_lod = true;
        lod.strand_pixels = std::max(lod.strand_pixels, quality.strand_pixels);
        lod.segment_pixels = std::max(lod.segment_pixels, quality.segment_pixels);
    }
    if (quality.blends) scene.settings.view.coverage = HAIR_COVERAGE_ALPHA;
    if (quality.shadows) return;
    scene.shadow = false;
    for (uint32_t i = 0; i < scene.lights.count; ++i) scene.lights.at[i].shadow = false;
}

} // namespace

static int draw(view_session& session, const hair_scene& scene, uint32_t width, uint32_t height,
                const view_quality& quality, view_render which, const float shift[2])
{
    const hair_image* image;
    hair_scene drawn = view_session_seen(session, scene);
    drawn.width = std::max(1u, (uint32_t)lroundf((float)width * quality.resolution));
    drawn.height = std::max(1u, (uint32_t)lroundf((float)height * quality.resolution));
    reduce(quality, drawn);
    hair_render_desc desc;
    memset(&desc, 0, sizeof desc); // Padding too, because descriptions are compared.
    desc.width = drawn.width;
    desc.height = drawn.height;
    desc.samples = quality.samples;
    desc.supersample = 1;
    desc.on_gpu = true;
    int code = make_render(session, scene, desc, which);
    if (!code) code = hair_exit_for(set_look(session, scene, quality));
    if (code) return code;
    if (session.character) hair_render_move_mesh(session.render, &session.character->mesh);
    hair_render_set_breath(session.render, hair_head_rig_breath(&scene, (float)session.time));
    hair_render_set_shift(session.render, shift);
    hair_render_set_more_hair(session.render, session.pieces.at, session.pieces.count);
    return hair_render_frame(session.render, &drawn, session.transform, session.reach, session.hair, &image);
}

int view_session_draw(view_session& session, const hair_scene& scene, uint32_t width, uint32_t height,
                      const view_quality& quality, view_render which)
{
    static const float none[2] = {0, 0};
    return draw(session, scene, width, height, quality, which, none);
}

int view_session_draw_shifted(view_session& session, const hair_scene& scene, uint32_t width, uint32_t height,
                              const view_quality& quality, const float shift[2])
{
    return draw(session, scene, width, height, quality, VIEW_RENDER_REFERENCE, shift);
}

bool view_session_sleeps(const view_session& session)
{
    hair_report_info info = hair_report_info_default();
    hair_report_row rows[64];
    uint32_t count = 0;
    if (hair_report(session.hair, false, &info, rows, sizeof *rows, 64, &count)) return false;
    for (uint32_t i = 0; i < std::min(count, 64u); ++i)
        if (!strcmp(rows[i].stage, "solve")) return rows[i].skip_reason == HAIR_SKIP_REASON_ASLEEP;
    return false;
}

uint32_t view_session_compiled(const view_session& session)
{
    hair_report_info info = hair_report_info_default();
    uint32_t count = 0;
    if (hair_report(session.hair, false, &info, nullptr, sizeof(hair_report_row), 0, &count)) return 0;
    return info.compiled_programs;
}
