// gui.cpp - Dear ImGui over events of SDL, and the places of all widgets by their labels.
//
// The backend for SDL of Dear ImGui asks SDL for the state of the mouse, which events of a script
// do not change. The functions below use events only.
#include "tools/view/gui.h"

#include <backends/imgui_impl_opengl3.h>

#include <unistd.h>

#include <algorithm>

namespace
{

const char* const fonts[] = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                             "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                             "/usr/share/fonts/TTF/DejaVuSans.ttf"};
constexpr float font_size = 16; // pixels at scale 1

const struct {
    int key;
    SDL_Scancode code;
} keys[] = {{ImGuiKey_Tab, SDL_SCANCODE_TAB},
            {ImGuiKey_LeftArrow, SDL_SCANCODE_LEFT},
            {ImGuiKey_RightArrow, SDL_SCANCODE_RIGHT},
            {ImGuiKey_UpArrow, SDL_SCANCODE_UP},
            {ImGuiKey_DownArrow, SDL_SCANCODE_DOWN},
            {ImGuiKey_PageUp, SDL_SCANCODE_PAGEUP},
            {ImGuiKey_PageDown, SDL_SCANCODE_PAGEDOWN},
            {ImGuiKey_Home, SDL_SCANCODE_HOME},
            {ImGuiKey_End, SDL_SCANCODE_END},
            {ImGuiKey_Insert, SDL_SCANCODE_INSERT},
            {ImGuiKey_Delete, SDL_SCANCODE_DELETE},
            {ImGuiKey_Backspace, SDL_SCANCODE_BACKSPACE},
            {ImGuiKey_Space, SDL_SCANCODE_SPACE},
            {ImGuiKey_Enter, SDL_SCANCODE_RETURN},
            {ImGuiKey_Escape, SDL_SCANCODE_ESCAPE},
            {ImGuiKey_KeyPadEnter, SDL_SCANCODE_KP_ENTER},
            {ImGuiKey_A, SDL_SCANCODE_A},
            {ImGuiKey_C, SDL_SCANCODE_C},
            {ImGuiKey_V, SDL_SCANCODE_V},
            {ImGuiKey_X, SDL_SCANCODE_X},
            {ImGuiKey_Y, SDL_SCANCODE_Y},
            {ImGuiKey_Z, SDL_SCANCODE_Z}};

void set_style(float scale)
{
    ImGuiStyle style;
    ImGui::StyleColorsDark(&style);
    style.WindowRounding = 6;
    style.FrameRounding = 4;
    style.GrabRounding = 4;
    style.ScrollbarSize = 14;
    style.FramePadding = {7, 3};
    style.ItemSpacing = {8, 4};
    style.WindowBorderSize = 0;
    ImVec4* colors = style.Colors;
    colors[ImGuiCol_WindowBg] = {0.07f, 0.075f, 0.085f, 0.94f};
    colors[ImGuiCol_PopupBg] = {0.09f, 0.095f, 0.105f, 0.98f};
    colors[ImGuiCol_FrameBg] = {0.17f, 0.18f, 0.2f, 1};
    colors[ImGuiCol_Button] = {0.2f, 0.22f, 0.25f, 1};
    colors[ImGuiCol_Header] = {0.2f, 0.22f, 0.25f, 1};
    colors[ImGuiCol_TextDisabled] = {0.62f, 0.64f, 0.67f, 1};
    style.ScaleAllSizes(scale);
    ImGui::GetStyle() = style;
}

void load_font(view_gui& gui, float scale)
{
    ImGuiIO& io = ImGui::GetIO();
    float size = font_size * scale;
    const char* file = nullptr;
    for (const char* font : fonts)
        if (!file && !access(font, R_OK)) file = font;
    if (gui.scale != 0) ImGui_ImplOpenGL3_DestroyFontsTexture();
    io.Fonts->Clear();
    if (!file || !io.Fonts->AddFontFromFileTTF(file, size)) {
        ImFontConfig config;
        config.SizePixels = size;
        io.Fonts->AddFontDefault(&config);
    }
    set_style(scale);
    ImGui_ImplOpenGL3_CreateFontsTexture();
    gui.scale = scale;
}

int button_of(const SDL_MouseButtonEvent& event)
{
    return event.button == SDL_BUTTON_LEFT     ? 0
           : event.button == SDL_BUTTON_RIGHT  ? 1
           : event.button == SDL_BUTTON_MIDDLE ? 2
                                               : -1;
}

const char* get_clipboard(void* user)
{
    static char* text;
    (void)user;
    SDL_free(text);
    text = SDL_GetClipboardText();
    return text;
}

void set_clipboard(void* user, const char* text)
{
    (void)user;
    SDL_SetClipboardText(text);
}

void set_key(const SDL_KeyboardEvent& event)
{
    ImGuiIO& io = ImGui::GetIO();
    int code = event.keysym.scancode;
    if (code >= 0 && code < IM_ARRAYSIZE(io.KeysDown)) io.KeysDown[code] = event.type == SDL_KEYDOWN;
    io.KeyShift = event.keysym.mod & KMOD_SHIFT;
    io.KeyCtrl = event.keysym.mod & KMOD_CTRL;
    io.KeyAlt = event.keysym.mod & KMOD_ALT;
}

} // namespace

bool view_gui_open(view_gui& gui)
{
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.GetClipboardTextFn = get_clipboard;
    io.SetClipboardTextFn = set_clipboard;
    for (const auto& row : keys) io.KeyMap[row.key] = row.code;
    if (!ImGui_ImplOpenGL3_Init("#version 450")) return false;
    load_font(gui, 1);
    SDL_StartTextInput();
    return true;
}

void view_gui_close(view_gui& gui)
{
    if (!ImGui::GetCurrentContext()) return;
    if (gui.scale != 0) ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext();
}

bool view_gui_event(view_gui& gui, const SDL_Event& event)
{
    ImGuiIO& io = ImGui::GetIO();
    int button;
    switch (event.type) {
    case SDL_MOUSEMOTION:
        io.MousePos = {(float)event.motion.x, (float)event.motion.y};
        return io.WantCaptureMouse;
    case SDL_MOUSEWHEEL:
        io.MouseWheel += (float)event.wheel.y;
        io.MouseWheelH += (float)event.wheel.x;
        return io.WantCaptureMouse;
    case SDL_MOUSEBUTTONDOWN:
    case SDL_MOUSEBUTTONUP:
        button = button_of(event.button);
        io.MousePos = {(float)event.button.x, (float)event.button.y};
        if (button >= 0) gui.held[button] = event.type == SDL_MOUSEBUTTONDOWN;
        if (button >= 0 && gui.held[button]) gui.pressed[button] = true;
        return io.WantCaptureMouse;
    case SDL_TEXTINPUT: io.AddInputCharactersUTF8(event.text.text); return io.WantTextInput;
    case SDL_KEYDOWN:
    case SDL_KEYUP: set_key(event.key); return io.WantTextInput && event.type == SDL_KEYDOWN;
    case SDL_WINDOWEVENT:
        if (event.window.event == SDL_WINDOWEVENT_LEAVE) io.MousePos = {-FLT_MAX, -FLT_MAX};
        if (event.window.event == SDL_WINDOWEVENT_FOCUS_LOST) io.AddFocusEvent(false);
        return false;
    default: return false;
    }
}

void view_gui_begin(view_gui& gui, int width, int height, float density, float scale, float dt)
{
    ImGuiIO& io = ImGui::GetIO();
    float unit_scale = scale / density; // Widgets are measured in units of mouse positions.
    if (unit_scale != gui.scale) load_font(gui, unit_scale);
    io.DisplaySize = {(float)width / density, (float)height / density};
    io.DisplayFramebufferScale = {density, density};
    io.DeltaTime = std::max(dt, 1e-4f);
    for (int i = 0; i < 3; ++i) {
        io.MouseDown[i] = gui.held[i] || gui.pressed[i];
        gui.pressed[i] = false;
    }
    gui.next_places.clear();
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
}

void view_gui_end(view_gui& gui, bool draws)
{
    ImGui::Render();
    if (draws) ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    gui.places.swap(gui.next_places);
}

void view_gui_mark(view_gui& gui, const char* label)
{
    ImVec2 lower = ImGui::GetItemRectMin(), upper = ImGui::GetItemRectMax();
    if (ImGui::IsItemVisible()) gui.next_places[label] = {lower.x, lower.y, upper.x, upper.y};
}
