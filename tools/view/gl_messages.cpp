// gl_messages.cpp - Messages of OpenGL in a window.
#include "tools/view/gl_messages.h"
#include "tools/view/gui.h"

#include <epoxy/gl.h>

namespace
{

constexpr size_t max_messages = 200;

struct name {
    GLenum value;
    const char* text;
};

const name kinds[] = {{GL_DEBUG_TYPE_ERROR, "error"},
                      {GL_DEBUG_TYPE_DEPRECATED_BEHAVIOR, "deprecated"},
                      {GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR, "undefined"},
                      {GL_DEBUG_TYPE_PORTABILITY, "portability"},
                      {GL_DEBUG_TYPE_PERFORMANCE, "performance"},
                      {GL_DEBUG_TYPE_MARKER, "marker"},
                      {0, "other"}};
const name sources[] = {{GL_DEBUG_SOURCE_API, "OpenGL"},
                        {GL_DEBUG_SOURCE_SHADER_COMPILER, "compiler"},
                        {GL_DEBUG_SOURCE_WINDOW_SYSTEM, "window"},
                        {GL_DEBUG_SOURCE_THIRD_PARTY, "library"},
                        {GL_DEBUG_SOURCE_APPLICATION, "hair-view"},
                        {0, "other"}};

const char* find(const name* names, GLenum value)
{
    while (names->value && names->value != value) ++names;
    return names->text;
}

void APIENTRY listen(GLenum source, GLenum kind, GLuint id, GLenum severity, GLsizei length,
                     const GLchar* message, const void* user)
{
    (void)id;
    auto& list = const_cast<view_gl_messages*>(static_cast<const view_gl_messages*>(user))->list;
    // The library has a group of messages for each pass.
    if (kind == GL_DEBUG_TYPE_PUSH_GROUP || kind == GL_DEBUG_TYPE_POP_GROUP) return;
    std::string text = std::string(find(kinds, kind)) + " of " + find(sources, source) + ": ";
    text += length > 0 ? std::string(message, (size_t)length) : std::string(message);
    while (!text.empty() && text.back() == '\n') text.pop_back();
    if (!list.empty() && list.back().text == text) {
        ++list.back().count;
        return;
    }
    list.push_back({text, kind == GL_DEBUG_TYPE_MARKER ? GL_DEBUG_SEVERITY_LOW : severity, 1});
    if (list.size() > max_messages) list.pop_front();
}

ImVec4 color_of(unsigned severity)
{
    switch (severity) {
    case GL_DEBUG_SEVERITY_HIGH: return {1, 0.4f, 0.35f, 1};
    case GL_DEBUG_SEVERITY_MEDIUM: return {1, 0.8f, 0.4f, 1};
    case GL_DEBUG_SEVERITY_LOW: return {0.9f, 0.9f, 0.9f, 1};
    default: return {0.62f, 0.64f, 0.67f, 1};
    }
}

} // namespace

void view_gl_messages_listen(view_gl_messages& messages)
{
    static const char hello[] = "Messages of OpenGL appear here.";
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(listen, &messages);
    glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_MARKER, 0, GL_DEBUG_SEVERITY_HIGH,
                         sizeof hello - 1, hello);
}

void view_gl_messages_ignore()
{
    glDebugMessageCallback(nullptr, nullptr);
}

void view_gl_messages_window(view_gl_messages& messages)
{
    if (!messages.shows) return;
    float font = ImGui::GetFontSize();
    ImGui::SetNextWindowSize({38 * font, 14 * font}, ImGuiCond_Appearing);
    ImGui::SetNextWindowPos({18 * font, 2 * font}, ImGuiCond_Appearing);
    if (ImGui::Begin("OpenGL", &messages.shows, ImGuiWindowFlags_NoCollapse)) {
        if (ImGui::Button("Clear")) messages.list.clear();
        ImGui::SameLine();
        ImGui::Checkbox("notifications", &messages.has_notes);
        ImGui::BeginChild("list");
        ImGui::PushTextWrapPos(0);
        for (const view_gl_message& message : messages.list) {
            if (message.severity == GL_DEBUG_SEVERITY_NOTIFICATION && !messages.has_notes) continue;
            ImGui::PushStyleColor(ImGuiCol_Text, color_of(message.severity));
            if (message.count > 1)
                ImGui::TextWrapped("%s (%u times)", message.text.c_str(), message.count);
            else
                ImGui::TextWrapped("%s", message.text.c_str());
            ImGui::PopStyleColor();
        }
        ImGui::PopTextWrapPos();
        ImGui::EndChild();
    }
    ImGui::End();
}
