// stage.cpp - What the viewer draws into: a window, or a texture without a display.
#include "tools/view/stage.h"

#include <epoxy/gl.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <algorithm>
#include <string>

namespace
{

void* find_function(const char* name, void* user)
{
    (void)user;
    return SDL_GL_GetProcAddress(name);
}

int complain_of_display(const char* reason)
{
    hair_complain(TOOL,
                  "there is no display with OpenGL 4.5 (%s); without one, run a script: "
                  "hair-view --script FILE --frames N --shot OUT.png",
                  reason);
    return HAIR_EXIT_OPENGL;
}

// Return whether the video driver shows windows to nobody. SDL falls back to such drivers.
bool is_blind()
{
    const char* driver = SDL_GetCurrentVideoDriver();
    return !driver || !strcmp(driver, "offscreen") || !strcmp(driver, "dummy") || !strcmp(driver, "evdev");
}

// Return the file that keeps the place of the window, or "".
std::string memory_path()
{
    char* folder = SDL_GetPrefPath("hair", "hair-view");
    std::string path = folder ? std::string(folder) + "window.txt" : "";
    SDL_free(folder);
    return path;
}

// Read the place of the window of the last run. `place` keeps its values without one.
void remember(int place[4])
{
    FILE* file = fopen(memory_path().c_str(), "r");
    int read[4];
    if (!file) return;
    bool ok = fscanf(file, "%d %d %d %d", &read[0], &read[1], &read[2], &read[3]) == 4;
    fclose(file);
    ok = ok && read[2] >= 64 && read[2] <= 8192 && read[3] >= 64 && read[3] <= 8192 && abs(read[0]) < 32768 &&
         abs(read[1]) < 32768;
    if (ok) std::copy(read, read + 4, place);
}

void keep(SDL_Window* window)
{
    int place[4];
    SDL_GetWindowPosition(window, &place[0], &place[1]);
    SDL_GetWindowSize(window, &place[2], &place[3]);
    FILE* file = fopen(memory_path().c_str(), "w");
    if (!file) return; // The next window has the usual place.
    fprintf(file, "%d %d %d %d\n", place[0], place[1], place[2], place[3]);
    fclose(file);
}

int open_window(const view_options& options, view_stage& out)
{
    if (SDL_Init(SDL_INIT_VIDEO)) return complain_of_display(SDL_GetError());
    if (is_blind()) return complain_of_display("no video driver has a screen");
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, SDL_GL_CONTEXT_PROFILE_CORE);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 4);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, 5);
    if (options.debug) SDL_GL_SetAttribute(SDL_GL_CONTEXT_FLAGS, SDL_GL_CONTEXT_DEBUG_FLAG);
    int place[4] = {SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, (int)options.width, (int)options.height};
    if (!options.has_size) remember(place);
    out.window = SDL_CreateWindow("hair-view", place[0], place[1], place[2], place[3],
                                  SDL_WINDOW_OPENGL | SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI);
    if (out.window) out.context = SDL_GL_CreateContext(out.window);
    if (!out.context) return complain_of_display(SDL_GetError());
    SDL_GL_SetSwapInterval(options.fps ? 0 : 1);
    return HAIR_EXIT_OK;
}

// The window of the dummy driver takes events but has no OpenGL.
int open_texture(const view_options& options, const hair_host& host, view_stage& out)
{
    SDL_SetHint(SDL_HINT_VIDEODRIVER, "dummy");
    SDL_setenv("SDL_VIDEODRIVER", "dummy", 1);
    if (!SDL_Init(SDL_INIT_VIDEO))
        out.window = SDL_CreateWindow("hair-view", 0, 0, (int)options.width, (int)options.height,
                                      SDL_WINDOW_RESIZABLE);
    if (!out.window) {
        hair_complain(TOOL, "SDL has no dummy window: %s", SDL_GetError());
        return HAIR_EXIT_RUNTIME;
    }
    hair_result result = hair_egl_create(&host, options.device, &out.egl);
    return hair_exit_for(result);
}

void make_texture(view_stage& stage)
{
    if (stage.texture_size[0] == stage.width && stage.texture_size[1] == stage.height) return;
    glDeleteFramebuffers(1, &stage.framebuffer);
    glDeleteTextures(1, &stage.texture);
    glCreateTextures(GL_TEXTURE_2D, 1, &stage.texture);
    glTextureStorage2D(stage.texture, 1, GL_RGBA8, stage.width, stage.height);
    glCreateFramebuffers(1, &stage.framebuffer);
    glNamedFramebufferTexture(stage.framebuffer, GL_COLOR_ATTACHMENT0, stage.texture, 0);
    stage.texture_size[0] = stage.width;
    stage.texture_size[1] = stage.height;
}

} // namespace

int view_stage_open(const view_options& options, const hair_host& host, view_stage& out)
{
    bool is_scripted = !options.script.empty();
    int code = is_scripted ? open_texture(options, host, out) : open_window(options, out);
    if (!code) view_stage_measure(out);
    return code;
}

void view_stage_close(view_stage& stage)
{
    if (stage.texture) {
        glDeleteFramebuffers(1, &stage.framebuffer);
        glDeleteTextures(1, &stage.texture);
    }
    if (stage.context) keep(stage.window);
    hair_egl_destroy(stage.egl);
    if (stage.context) SDL_GL_DeleteContext(stage.context);
    if (stage.window) SDL_DestroyWindow(stage.window);
    SDL_Quit();
    stage = {};
}

void* (*view_stage_get_proc(const view_stage& stage))(const char* name, void* user)
{
    return stage.egl ? hair_egl_get_proc : find_function;
}

void view_stage_measure(view_stage& stage)
{
    int width, height;
    float dpi = 96;
    SDL_GetWindowSize(stage.window, &width, &height);
    stage.width = width;
    stage.height = height;
    if (stage.context) {
        SDL_GL_GetDrawableSize(stage.window, &stage.width, &stage.height);
        SDL_GetDisplayDPI(std::max(SDL_GetWindowDisplayIndex(stage.window), 0), nullptr, &dpi, nullptr);
    }
    stage.width = std::max(stage.width, 1);
    stage.height = std::max(stage.height, 1);
    stage.density = (float)stage.width / (float)std::max(width, 1);
    // A window of many pixels is on a dense display, or is seen from afar.
    float wanted = std::max(stage.density * dpi / 96, (float)stage.height / 900);
    stage.scale = std::min(std::max(roundf(4 * wanted) / 4, 1.0f), 4.0f);
}

void view_stage_begin(view_stage& stage)
{
    if (stage.egl) make_texture(stage);
    glBindFramebuffer(GL_FRAMEBUFFER, stage.framebuffer);
    glViewport(0, 0, stage.width, stage.height);
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
}

void view_stage_read(const view_stage& stage, std::vector<unsigned char>& out)
{
    size_t row = 3 * (size_t)stage.width;
    out.resize(row * (size_t)stage.height);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, stage.framebuffer);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glPixelStorei(GL_PACK_ROW_LENGTH, 0);
    glReadPixels(0, 0, stage.width, stage.height, GL_RGB, GL_UNSIGNED_BYTE, out.data());
    for (int y = 0; y < stage.height / 2; ++y)
        std::swap_ranges(out.data() + row * (size_t)y, out.data() + row * (size_t)(y + 1),
                         out.data() + row * (size_t)(stage.height - 1 - y));
}

void view_stage_end(view_stage& stage)
{
    if (stage.context) SDL_GL_SwapWindow(stage.window);
}
