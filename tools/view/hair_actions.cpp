// hair_actions.cpp - Actions that change the hair of the document: look, wind, detail and
// simulation.
#include "tools/view/hair_actions.h"
#include "tools/view/camera.h"

#include <math.h>
#include <string.h>

#include <algorithm>

namespace
{

constexpr float short_length = 0.45f, curl_radius = 0.012f, curl_wavelength = 0.045f;
constexpr uint32_t curl_segments = 64;
constexpr float usual_wind = 4, strongest_wind = 50; // m/s

hair_settings& settings_of(viewer& viewer)
{
    return viewer.document.scene->settings;
}
const hair_settings& settings_of(const viewer& viewer)
{
    return viewer.document.scene->settings;
}

// Return the index of the preset of colours that the look has, or -1.
int find_color(const hair_look& look)
{
    for (int i = 0; hair_color_name((hair_color)i); ++i) {
        hair_look other = look;
        hair_look_color(&other, (hair_color)i);
        if (!memcmp(&other.color.root, &look.color.root, sizeof look.color.root) &&
            !memcmp(&other.color.tip, &look.color.tip, sizeof look.color.tip))
            return i;
    }
    return -1;
}

void toggle_interpolation(viewer& viewer, hair_interpolation wanted)
{
    hair_interpolation& now = settings_of(viewer).look.clump.interpolation;
    now = now == wanted ? HAIR_INTERPOLATION_MIXED : wanted;
}

} // namespace

// Look --------------------------------------------------------------------------------------------

void view_next_color(viewer& viewer)
{
    hair_look& look = settings_of(viewer).look;
    int next = find_color(look) + 1;
    hair_look_color(&look, (hair_color)(hair_color_name((hair_color)next) ? next : 0));
}

void view_toggle_short(viewer& viewer)
{
    settings_of(viewer).look.strand.length = view_is_short(viewer) ? 1 : short_length;
}

bool view_is_short(const viewer& viewer)
{
    return settings_of(viewer).look.strand.length < 1;
}

void view_toggle_curly(viewer& viewer)
{
    hair_look& look = settings_of(viewer).look;
    if (look.curl.radius > 0) {
        look.curl.radius = 0;
        return;
    }
    look.curl.radius = curl_radius;
    look.curl.wavelength = curl_wavelength;
    look.strand.segments = std::max(look.strand.segments, curl_segments);
}

bool view_is_curly(const viewer& viewer)
{
    return settings_of(viewer).look.curl.radius > 0;
}

void view_toggle_multi(viewer& viewer)
{
    toggle_interpolation(viewer, HAIR_INTERPOLATION_MULTI);
}

bool view_is_multi(const viewer& viewer)
{
    return settings_of(viewer).look.clump.interpolation == HAIR_INTERPOLATION_MULTI;
}

void view_toggle_single(viewer& viewer)
{
    toggle_interpolation(viewer, HAIR_INTERPOLATION_SINGLE);
}

bool view_is_single(const viewer& viewer)
{
    return settings_of(viewer).look.clump.interpolation == HAIR_INTERPOLATION_SINGLE;
}

// Detail ------------------------------------------------------------------------------------------

void view_toggle_tessellation(viewer& viewer)
{
    settings_of(viewer).view.render_path =
        view_is_tessellated(viewer) ? HAIR_RENDER_PATH_AUTO : HAIR_RENDER_PATH_TESSELLATION;
}

bool view_is_tessellated(const viewer& viewer)
{
    return settings_of(viewer).view.render_path == HAIR_RENDER_PATH_TESSELLATION;
}

void view_toggle_lod(viewer& viewer)
{
    settings_of(viewer).has_lod = !settings_of(viewer).has_lod;
}

bool view_has_lod(const viewer& viewer)
{
    return settings_of(viewer).has_lod;
}

void view_toggle_dynamic(viewer& viewer)
{
    hair_settings& settings = settings_of(viewer);
    settings.lod.per_patch = !view_is_dynamic(viewer);
    settings.has_lod = true;
}

bool view_is_dynamic(const viewer& viewer)
{
    return settings_of(viewer).has_lod && settings_of(viewer).lod.per_patch;
}

view_levels view_present_levels(const viewer& viewer)
{
    const hair_scene& scene = *viewer.document.scene;
    const hair_lod& lod = scene.settings.lod;
    const hair_look& look = scene.settings.look;
    view_levels levels = {1, 1};
    if (!scene.settings.has_lod) return levels;
    levels = {lod.strand_fraction, lod.segment_fraction};
    if (!lod.per_patch) return levels;
    float height = viewer.stage.density * (viewer.picture.bottom - viewer.picture.top);
    float scale = lod.importance * height / view_camera_height(scene); // pixels per metre
    float segments = levels.segments * (float)look.strand.segments;
    float length = viewer.session.info.length[1] * look.strand.length;
    levels.strands *=
        std::clamp(2 * look.strand.radius * scale / lod.strand_pixels, lod.min_strand_fraction, 1.0f);
    levels.segments *= std::clamp(length * scale / lod.segment_pixels / std::max(segments, 1.0f), 0.0f, 1.0f);
    return levels;
}

// Simulation --------------------------------------------------------------------------------------

void view_toggle_passes(viewer& viewer)
{
    hair_desc& desc = settings_of(viewer).desc;
    bool is_on = view_has_passes(viewer);
    desc.solver = is_on ? HAIR_SOLVER_DIRECT : HAIR_SOLVER_REDBLACK;
    desc.thread_mapping = is_on ? HAIR_THREAD_MAPPING_AUTO : HAIR_THREAD_MAPPING_FEEDBACK;
}

bool view_has_passes(const viewer& viewer)
{
    return settings_of(viewer).desc.thread_mapping == HAIR_THREAD_MAPPING_FEEDBACK;
}

void view_toggle_simulation_lod(viewer& viewer)
{
    hair_physics& physics = settings_of(viewer).physics;
    bool is_on = view_has_simulation_lod(viewer);
    physics.substep_rate = is_on ? 1 : 0.25f;
    physics.offscreen_substep_rate = is_on ? 1 : 0.0625f;
}

bool view_has_simulation_lod(const viewer& viewer)
{
    return settings_of(viewer).physics.substep_rate < 1;
}

// Wind --------------------------------------------------------------------------------------------

float view_wind_speed(const hair_scene& scene)
{
    const float* v = scene.settings.wind.velocity;
    return sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

void view_set_wind_speed(viewer& viewer, float speed)
{
    hair_scene& scene = *viewer.document.scene;
    float old = view_wind_speed(scene);
    for (int i = 0; i < 3; ++i) {
        float& v = scene.settings.wind.velocity[i];
        if (old > 0) viewer.wind_direction[i] = v / old;
        v = speed * viewer.wind_direction[i];
    }
}

void view_toggle_wind(viewer& viewer)
{
    float speed = view_wind_speed(*viewer.document.scene);
    if (speed > 0) viewer.wind_speed = speed;
    view_set_wind_speed(viewer, speed > 0 ? 0 : viewer.wind_speed > 0 ? viewer.wind_speed : usual_wind);
}

bool view_has_wind(const viewer& viewer)
{
    return view_wind_speed(*viewer.document.scene) > 0;
}

void view_stronger_wind(viewer& viewer)
{
    view_set_wind_speed(viewer, std::min(view_wind_speed(*viewer.document.scene) + 1, strongest_wind));
}

void view_weaker_wind(viewer& viewer)
{
    view_set_wind_speed(viewer, std::max(view_wind_speed(*viewer.document.scene) - 1, 0.0f));
}
