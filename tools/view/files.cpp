// files.cpp - Scenes and haircuts that are opened and saved while the window is open.
#include "tools/view/viewer.h"

#include <jansson.h>

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <algorithm>

namespace
{

// Take a scene, or keep the present one if the hair cannot be made.
void take(viewer& viewer, std::unique_ptr<hair_scene> scene, const std::string& name, const std::string& file)
{
    if (view_session_apply(viewer.session, *scene, name)) {
        hair_scene_free(scene.get());
        return;
    }
    view_document_open(viewer.document, *scene, name, file);
    viewer.path = file.empty() ? viewer.path : file;
    view_session_reset(viewer.session, *scene);
    viewer_say(viewer, "Opened " + name + ".");
}

bool has_ending(const std::string& path, const char* ending)
{
    size_t length = strlen(ending);
    return path.size() > length && !strcasecmp(path.c_str() + path.size() - length, ending);
}

// Return the length of the longest side of the box around a mesh, in its own unit.
float size_of(const hair_obj& mesh)
{
    float size = 0;
    for (int k = 0; k < 3; ++k) {
        float lower = INFINITY, upper = -INFINITY;
        for (uint32_t i = 0; i < mesh.vertex_count; ++i) {
            lower = std::min(lower, mesh.positions[3 * (size_t)i + (size_t)k]);
            upper = std::max(upper, mesh.positions[3 * (size_t)i + (size_t)k]);
        }
        size = std::max(size, upper - lower);
    }
    return size;
}

// Return the unit by which a mesh is not much larger than the hair: 1, 0.01 or 0.001 m.
double unit_of(const view_session& session, float size)
{
    float hair = 0;
    for (int k = 0; k < 3; ++k) hair = std::max(hair, session.info.upper[k] - session.info.lower[k]);
    double unit = 1;
    for (double smaller : {0.01, 0.001})
        if ((double)size * unit > 20 * (double)hair) unit = smaller;
    return unit;
}

// Return the scene file of a scene with the same objects and one of a mesh.
std::string objects_with(const hair_scene& scene, const char* path, double unit)
{
    json_t* objects = scene.bullet.text ? json_loads(scene.bullet.text, 0, nullptr) : json_array();
    json_array_append_new(objects, json_pack("{s:s, s:s, s:[f, f, f]}", "shape", "mesh", "mesh", path,
                                             "scale", unit, unit, unit));
    json_t* root = json_pack("{s:o}", "bullet", objects);
    char* text = root ? json_dumps(root, 0) : nullptr;
    std::string result = text ? text : "";
    free(text);
    json_decref(root);
    return result;
}

// Add a mesh to what hair collides with. It moves with the head.
void add_mesh(viewer& viewer, const std::string& path)
{
    hair_obj mesh = {};
    hair_scene& scene = *viewer.document.scene;
    if (!hair_obj_read(TOOL, path.c_str(), &mesh)) return;
    float size = size_of(mesh);
    double unit = unit_of(viewer.session, size);
    hair_obj_free(&mesh);
    char* full = realpath(path.c_str(), nullptr);
    std::string text = full ? objects_with(scene, full, unit) : "";
    free(full);
    auto added = std::make_unique<hair_scene>();
    hair_scene_default(added.get());
    if (!hair_scene_parse(TOOL, path.c_str(), text.c_str(), text.size(), added.get())) {
        hair_scene_free(added.get());
        return;
    }
    viewer.document.lists.push_back(added->bullet);
    scene.bullet = added->bullet;
    scene.show |= HAIR_SHOW_COLLIDERS;
    char sentence[160];
    snprintf(sentence, sizeof sentence,
             "Hair collides with the mesh now, which is %.3g m large in units of %g m.", (double)size * unit,
             unit);
    viewer_say(viewer, sentence);
}

} // namespace

void viewer_open(viewer& viewer, const std::string& path)
{
    auto scene = std::make_unique<hair_scene>();
    if (view_is_scene(path)) {
        hair_scene_default(scene.get());
        if (hair_scene_read(TOOL, path.c_str(), scene.get()))
            take(viewer, std::move(scene), path, path);
        else
            hair_scene_free(scene.get());
        return;
    }
    if (has_ending(path, ".obj")) {
        add_mesh(viewer, path);
        return;
    }
    // A haircut is a change of the document, which can be taken back.
    hair_scene& present = *viewer.document.scene;
    if (access(path.c_str(), R_OK) || path.size() >= sizeof present.groom) {
        viewer_say(viewer, "The file " + path + " cannot be read.");
        return;
    }
    hair_scene_set_groom(path.c_str(), &present);
    present.framed = false;
}

void viewer_open_named(viewer& viewer, const char* name)
{
    auto scene = std::make_unique<hair_scene>();
    hair_scene_default(scene.get());
    if (hair_scene_named(TOOL, name, scene.get()))
        take(viewer, std::move(scene), name, "");
    else
        hair_scene_free(scene.get());
}

void viewer_save(viewer& viewer)
{
    const std::string& path = viewer.path;
    if (!hair_output_has_ending(TOOL, path.c_str(), ".json")) return;
    if (hair_scene_write(TOOL, path.c_str(), viewer.document.scene.get()))
        viewer_say(viewer, "Saved " + path + ".");
}
