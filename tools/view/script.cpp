// script.cpp - Events of mouse and keys from a file, which reach the viewer by the queue of SDL.
#include "tools/view/script.h"
#include "tools/view/common.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <algorithm>

namespace
{

constexpr size_t max_bytes = (size_t)1 << 20;
constexpr int max_tries = 10; // frames that a widget has to appear in

enum form { NUMBERS_1, NUMBERS_2, NUMBERS_3, TEXT, TEXT_AND_2, BUTTON };

const struct {
    const char* verb;
    form arguments;
    const char* usage;
} verbs[] = {{"move", NUMBERS_2, "X Y"},
             {"glide", NUMBERS_3, "X Y N"},
             {"down", BUTTON, "left, middle or right"},
             {"up", BUTTON, "left, middle or right"},
             {"wheel", NUMBERS_1, "N"},
             {"key", TEXT, "NAME"},
             {"press", TEXT, "NAME"},
             {"release", TEXT, "NAME"},
             {"text", TEXT, "WORDS"},
             {"click", TEXT, "LABEL"},
             {"drag", TEXT_AND_2, "LABEL X Y"},
             {"drop", TEXT, "PATH"},
             {"size", NUMBERS_2, "W H"},
             {"save", TEXT, "PATH"},
             {"report", TEXT, "PATH"},
             {"wait", NUMBERS_1, "N"}};

int complain(const view_script& script, int line, const char* what, const std::string& text)
{
    hair_complain(TOOL, "%s:%d: %s%s", script.path.c_str(), line, what, text.c_str());
    return HAIR_EXIT_INPUT;
}

bool parse_number(const std::string& text, float& out)
{
    char* end;
    out = strtof(text.c_str(), &end);
    return end != text.c_str() && !*end && isfinite(out) && fabsf(out) <= 100000;
}

// Remove the last word of `text`, and parse it.
bool take_number(std::string& text, float& out)
{
    size_t space = text.find_last_of(' ');
    if (!parse_number(space == std::string::npos ? text : text.substr(space + 1), out)) return false;
    text.erase(space == std::string::npos ? 0 : space);
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return true;
}

bool parse_arguments(form arguments, view_command& command)
{
    std::string& text = command.text;
    switch (arguments) {
    case NUMBERS_1: return take_number(text, command.x) && text.empty();
    case NUMBERS_2: return take_number(text, command.y) && take_number(text, command.x) && text.empty();
    case NUMBERS_3:
        return take_number(text, command.count) && take_number(text, command.y) &&
               take_number(text, command.x) && text.empty();
    case TEXT_AND_2: return take_number(text, command.y) && take_number(text, command.x) && !text.empty();
    case BUTTON: return text == "left" || text == "middle" || text == "right";
    case TEXT: break;
    }
    return !text.empty();
}

int parse_line(view_script& script, std::string line, int number)
{
    while (!line.empty() && strchr(" \t\r", line.back())) line.pop_back();
    line.erase(0, line.find_first_not_of(" \t"));
    if (line.empty() || line[0] == '#') return HAIR_EXIT_OK;
    view_command command;
    size_t space = line.find(' ');
    command.verb = line.substr(0, space);
    if (space != std::string::npos) command.text = line.substr(line.find_first_not_of(' ', space));
    command.line = number;
    for (const auto& row : verbs) {
        if (command.verb != row.verb) continue;
        if (!parse_arguments(row.arguments, command))
            return complain(script, number, (command.verb + " needs ").c_str(), row.usage);
        script.commands.push_back(command);
        return HAIR_EXIT_OK;
    }
    return complain(script, number, "there is no command ", command.verb);
}

// Events ------------------------------------------------------------------------------------------

void push_mouse(view_script& script, uint32_t type, uint8_t button)
{
    SDL_Event event = {};
    event.type = type;
    if (type == SDL_MOUSEMOTION) {
        event.motion.x = (int)script.mouse[0];
        event.motion.y = (int)script.mouse[1];
    } else {
        event.button.button = button;
        event.button.state = type == SDL_MOUSEBUTTONDOWN ? SDL_PRESSED : SDL_RELEASED;
        event.button.x = (int)script.mouse[0];
        event.button.y = (int)script.mouse[1];
    }
    SDL_PushEvent(&event);
}

uint8_t button_named(const std::string& name)
{
    return name == "left" ? SDL_BUTTON_LEFT : name == "right" ? SDL_BUTTON_RIGHT : SDL_BUTTON_MIDDLE;
}

// Parse a name such as "Ctrl+Shift+Z". Return false if there is no such key.
bool parse_key(std::string name, SDL_Keysym& out)
{
    static const struct {
        const char* prefix;
        uint16_t modifier;
    } prefixes[] = {{"Ctrl+", KMOD_LCTRL}, {"Shift+", KMOD_LSHIFT}, {"Alt+", KMOD_LALT}};
    out = {};
    for (bool found = true; found;) {
        found = false;
        for (const auto& row : prefixes)
            if (name.size() > strlen(row.prefix) && name.compare(0, strlen(row.prefix), row.prefix) == 0) {
                name.erase(0, strlen(row.prefix));
                out.mod |= row.modifier;
                found = true;
            }
    }
    out.sym = SDL_GetKeyFromName(name.c_str());
    out.scancode = SDL_GetScancodeFromKey(out.sym);
    uint16_t held = out.sym == SDLK_LCTRL    ? KMOD_LCTRL
                    : out.sym == SDLK_LSHIFT ? KMOD_LSHIFT
                    : out.sym == SDLK_LALT   ? KMOD_LALT
                                             : 0;
    out.mod |= held;
    return out.sym != SDLK_UNKNOWN;
}

int push_key(view_script& script, const view_command& command, uint32_t type)
{
    SDL_Event event = {};
    event.type = type;
    event.key.state = type == SDL_KEYDOWN ? SDL_PRESSED : SDL_RELEASED;
    if (!parse_key(command.text, event.key.keysym))
        return complain(script, command.line, "there is no key ", command.text);
    bool is_modifier = event.key.keysym.sym == SDLK_LCTRL || event.key.keysym.sym == SDLK_LSHIFT ||
                       event.key.keysym.sym == SDLK_LALT;
    if (is_modifier) {
        script.modifiers = type == SDL_KEYDOWN ? script.modifiers | event.key.keysym.mod
                                               : script.modifiers & ~event.key.keysym.mod;
        SDL_SetModState((SDL_Keymod)script.modifiers);
    }
    // A released key leaves only the modifiers that are held by keys of their own.
    if (is_modifier || type == SDL_KEYUP) event.key.keysym.mod = 0;
    event.key.keysym.mod |= script.modifiers;
    SDL_PushEvent(&event);
    return HAIR_EXIT_OK;
}

// Put a command before the next.
void insert(view_script& script, const char* verb, const std::string& text, float x, float y, int line)
{
    view_command command;
    command.verb = verb;
    command.text = text;
    command.x = x;
    command.y = y;
    command.line = line;
    script.commands.push_front(command);
}

// Move the mouse by the next part of a glide, and put the rest of it before the next command.
void glide(view_script& script, view_command command)
{
    float part = 1 / std::max(command.count, 1.0f);
    script.mouse[0] += part * (command.x - script.mouse[0]);
    script.mouse[1] += part * (command.y - script.mouse[1]);
    push_mouse(script, SDL_MOUSEMOTION, 0);
    if (--command.count >= 1) script.commands.push_front(command);
}

// Replace a command on a label by commands at its place.
int expand(view_script& script, const view_command& command, const view_gui& gui)
{
    auto found = gui.places.find(command.text);
    if (found == gui.places.end()) {
        if (command.tries == max_tries)
            return complain(script, command.line, "no widget is in sight with the label ", command.text);
        script.commands.push_front(command);
        ++script.commands.front().tries;
        insert(script, "wait", "", 1, 0, command.line);
        return HAIR_EXIT_OK;
    }
    const view_place& place = found->second;
    float x = 0.5f * (place.left + place.right), y = 0.5f * (place.top + place.bottom);
    int line = command.line;
    insert(script, "wait", "", 1, 0, line);
    insert(script, "up", "left", 0, 0, line);
    if (command.verb == "drag") insert(script, "move", "", x + command.x, y + command.y, line);
    insert(script, "down", "left", 0, 0, line);
    insert(script, "wait", "", 1, 0, line); // Hovering takes a frame.
    insert(script, "move", "", x, y, line);
    return HAIR_EXIT_OK;
}

void push_text(const std::string& text)
{
    for (size_t at = 0; at < text.size(); at += 31) {
        SDL_Event event = {};
        event.type = SDL_TEXTINPUT;
        snprintf(event.text.text, sizeof event.text.text, "%s", text.substr(at, 31).c_str());
        SDL_PushEvent(&event);
    }
}

void push_drop(const std::string& path)
{
    SDL_Event event = {};
    event.type = SDL_DROPFILE;
    event.drop.file = SDL_strdup(path.c_str());
    SDL_PushEvent(&event);
}

int run(view_script& script, const view_command& command, SDL_Window* window)
{
    const std::string& verb = command.verb;
    if (verb == "move") {
        script.mouse[0] = command.x;
        script.mouse[1] = command.y;
        push_mouse(script, SDL_MOUSEMOTION, 0);
    } else if (verb == "glide") {
        glide(script, command);
    } else if (verb == "down" || verb == "up") {
        push_mouse(script, verb == "down" ? SDL_MOUSEBUTTONDOWN : SDL_MOUSEBUTTONUP,
                   button_named(command.text));
    } else if (verb == "wheel") {
        SDL_Event event = {};
        event.type = SDL_MOUSEWHEEL;
        event.wheel.y = (int)command.x;
        SDL_PushEvent(&event);
    } else if (verb == "press" || verb == "release") {
        return push_key(script, command, verb == "press" ? SDL_KEYDOWN : SDL_KEYUP);
    } else if (verb == "key") {
        insert(script, "release", command.text, 0, 0, command.line);
        return push_key(script, command, SDL_KEYDOWN);
    } else if (verb == "text") {
        push_text(command.text);
    } else if (verb == "drop") {
        push_drop(command.text);
    } else if (verb == "save") {
        script.save = command.text;
    } else if (verb == "report") {
        script.report = command.text;
    } else if (verb == "size") {
        SDL_SetWindowSize(window, std::max(64, (int)command.x), std::max(64, (int)command.y));
    } else {
        script.wait = (uint32_t)std::max(0.0f, command.x - 1);
    }
    return HAIR_EXIT_OK;
}

} // namespace

int view_script_read(const std::string& path, view_script& out)
{
    hair_bytes bytes;
    out.path = path;
    if (!hair_file_read(TOOL, path.c_str(), max_bytes, &bytes)) return HAIR_EXIT_INPUT;
    std::string text((const char*)bytes.data, bytes.size);
    free(bytes.data);
    int code = HAIR_EXIT_OK, number = 1;
    for (size_t at = 0; at < text.size() && !code; ++number) {
        size_t end = std::min(text.find('\n', at), text.size());
        code = parse_line(out, text.substr(at, end - at), number);
        at = end + 1;
    }
    return code;
}

int view_script_feed(view_script& script, const view_gui& gui, SDL_Window* window)
{
    if (script.wait) {
        --script.wait;
        return HAIR_EXIT_OK;
    }
    if (script.commands.empty()) return HAIR_EXIT_OK;
    view_command command = script.commands.front();
    script.commands.pop_front();
    if (command.verb == "click" || command.verb == "drag") {
        int code = expand(script, command, gui);
        if (code) return code;
        command = script.commands.front();
        script.commands.pop_front();
    }
    return run(script, command, window);
}
