// files.cpp - Scenes and haircuts that are opened and saved while the window is open.
#include "tools/view/viewer.h"

#include <string.h>
#include <unistd.h>

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
