// browse.cpp - A list of the scenes, haircuts and meshes of a folder.
#include "tools/view/browse.h"

#include <algorithm>
#include <filesystem>

namespace
{

namespace files = std::filesystem;

constexpr size_t max_entries = 5000;
const char* const endings[] = {".json", ".groom", ".hair", ".tfx", ".obj"};

bool is_known(const files::path& path)
{
    std::string ending = path.extension().string();
    return std::any_of(std::begin(endings), std::end(endings), [&](const char* e) { return ending == e; });
}

// List a folder. Names of folders end in a slash.
void list(view_files& state, const std::string& folder)
{
    std::error_code error;
    files::path whole = files::absolute(folder.empty() ? "." : folder, error).lexically_normal();
    state.folder = whole.string();
    state.names.clear();
    for (files::directory_iterator at(whole, error), end; !error && at != end; at.increment(error)) {
        std::string name = at->path().filename().string();
        std::error_code ignored;
        if (name[0] == '.' || state.names.size() == max_entries) continue;
        if (at->is_directory(ignored))
            state.names.push_back(name + "/");
        else if (is_known(at->path()))
            state.names.push_back(name);
    }
    std::sort(state.names.begin(), state.names.end());
    std::stable_partition(state.names.begin(), state.names.end(),
                          [](const std::string& name) { return name.back() != '/'; });
    state.names.insert(state.names.begin(), "../");
}

} // namespace

void view_browse(viewer& viewer)
{
    view_files& state = viewer.files;
    if (ImGui::Button("...")) {
        list(state, files::path(viewer.path).parent_path().string());
        ImGui::OpenPopup("files");
    }
    view_gui_mark(viewer.gui, "Browse");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Open a scene, a haircut or a mesh of a folder.");
    if (!ImGui::BeginPopup("files")) return;
    ImGui::TextDisabled("%s", state.folder.c_str());
    std::string chosen;
    ImGui::BeginChild("names", {24 * ImGui::GetFontSize(), 20 * ImGui::GetFontSize()});
    for (const std::string& name : state.names) {
        if (ImGui::Selectable(name.c_str(), false, ImGuiSelectableFlags_DontClosePopups)) chosen = name;
        view_gui_mark(viewer.gui, name.c_str());
    }
    ImGui::EndChild();
    if (!chosen.empty() && chosen.back() == '/') {
        list(state, (files::path(state.folder) / chosen).string());
    } else if (!chosen.empty()) {
        viewer_open(viewer, (files::path(state.folder) / chosen).string());
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}
