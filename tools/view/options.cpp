// options.cpp - Command line of hair-view. One table serves getopt and --help.
#include "tools/view/options.h"

#include <getopt.h>
#include <stdlib.h>
#include <string.h>

#include <vector>

namespace
{

enum option_name {
    SCENE = 256,
    STYLE,
    MOTION,
    HEAD,
    SET,
    SIZE,
    SCALE,
    SCRIPT,
    FRAMES,
    SHOT,
    FILM,
    QUALITY,
    SAVE,
    GLSL,
    DEVICE,
    DEBUG,
    FPS,
    VERSION
};

struct row {
    const char* name;
    int option;
    const char* argument; // null if the option takes no argument
    const char* about;
};

const row rows[] = {
    {"scene", SCENE, "NAME", "a built-in scene, below; without it, \"demo\""},
    {"style", STYLE, "NAME", "show a built-in haircut, below"},
    {"motion", MOTION, "NAME", "move the head so, below"},
    {"head", HEAD, nullptr, "draw the built-in head under the haircut of a file"},
    {"set", SET, "KEY=VALUE", "change one of the settings, below; may be repeated"},
    {"size", SIZE, "WxH", "of the window, pixels; that of the last window, or 1280x720"},
    {"scale", SCALE, "X", "of text and panels, 0.5 to 8; without it, as the display asks"},
    {"script", SCRIPT, "FILE", "run without a display, with the events of a file"},
    {"frames", FRAMES, "N", "end after this number of frames of 1/60 s"},
    {"shot", SHOT, "OUT.png", "write the picture of the last frame"},
    {"film", FILM, "OUT.mp4", "write a film of the window"},
    {"quality", QUALITY, "N", "of pictures at rest and of scripts, 0 full to 4 coarse; 0"},
    {"save", SAVE, "FILE.json", "file that Save writes; without it, the opened file or a new one"},
    {"glsl", GLSL, "FOLDER", "read the shaders of the library from a folder, and follow its changes"},
    {"device", DEVICE, "N", "run a script on the EGL device of that index; without it, the first that works"},
    {"fps", FPS, nullptr, "draw every frame of a script, and print the times of frames at the end"},
    {"debug", DEBUG, nullptr, "let OpenGL check all calls of a window, and tell in its messages"},
    {"help", 'h', nullptr, "(also -h) this"},
    {"version", VERSION, nullptr, "the version of the library"},
};
constexpr int row_count = sizeof rows / sizeof *rows;

// Raw values of the command line.
struct said_options {
    const char *scene = nullptr, *style = nullptr, *motion = nullptr, *file = nullptr;
    bool head = false;
    std::vector<const char*> changes;
};

int print_help()
{
    printf("%s - show hair in a window, with every option in a panel\n\n"
           "  %s [SCENE.json | HAIRCUT] [OPTION]...\n\n",
           TOOL, TOOL);
    for (const row& row : rows) {
        char left[64];
        snprintf(left, sizeof left, "--%s%s%s", row.name, row.argument ? " " : "",
                 row.argument ? row.argument : "");
        printf("  %-22s %s\n", left, row.about);
    }
    printf("\n");
    hair_scene_print_names(stdout);
    printf("\nSettings for --set and for \"settings\" in scene files, with their defaults:\n");
    hair_settings_print(stdout);
    printf("\nThe key ? in the window lists the keys and the mouse controls.\n"
           "\nExit status: 0 done, 1 failed while running, 2 wrong use, 3 no display or no OpenGL 4.5,"
           " 4 unusable input.\n");
    return hair_flush(TOOL);
}

bool parse_whole(const char* option, const char* text, uint32_t min, uint32_t max, uint32_t& out)
{
    char* end;
    unsigned long long value = *text >= '0' && *text <= '9' ? strtoull(text, &end, 10) : (end = nullptr, 0);
    if (end && !*end && value >= min && value <= max) {
        out = (uint32_t)value;
        return true;
    }
    hair_complain(TOOL, "--%s is %s, not a whole number in [%u, %u]", option, text, min, max);
    return false;
}

bool parse_size(const char* text, view_options& out)
{
    unsigned width, height;
    char after;
    bool is_plain = *text && strspn(text, "0123456789x") == strlen(text) && strlen(text) < 12;
    if (is_plain && sscanf(text, "%ux%u%c", &width, &height, &after) == 2 && width >= 64 && width <= 8192 &&
        height >= 64 && height <= 8192) {
        out.width = width;
        out.height = height;
        out.has_size = true;
        return true;
    }
    hair_complain(TOOL, "--size is %s, not WxH with both in [64, 8192]", text);
    return false;
}

bool parse_scale(const char* text, float& out)
{
    char* end;
    float value = strtof(text, &end);
    bool ok = end != text && !*end && value >= 0.5f && value <= 8;
    if (ok)
        out = value;
    else
        hair_complain(TOOL, "--scale is %s, not a number in [0.5, 8]", text);
    return ok;
}

bool take(const row& row, const char* value, said_options& said, view_options& out)
{
    uint32_t number = 0;
    switch (row.option) {
    case SCENE: said.scene = value; break;
    case STYLE: said.style = value; break;
    case MOTION: said.motion = value; break;
    case DEBUG: out.debug = true; break;
    case FPS: out.fps = true; break;
    case HEAD: said.head = true; break;
    case SET: said.changes.push_back(value); break;
    case SIZE: return parse_size(value, out);
    case SCALE: return parse_scale(value, out.scale);
    case SCRIPT: out.script = value; break;
    case FRAMES: return parse_whole(row.name, value, 1, 1000000, out.frames);
    case SHOT: out.shot = value; return hair_output_has_ending(TOOL, value, ".png");
    case FILM: out.film = value; return hair_output_has_ending(TOOL, value, ".mp4");
    case QUALITY: return parse_whole(row.name, value, 0, 4, out.quality);
    case SAVE: out.save = value; return hair_output_has_ending(TOOL, value, ".json");
    case GLSL: out.glsl = value; break;
    case DEVICE:
        if (!parse_whole(row.name, value, 0, 1000, number)) return false;
        out.device = (int)number;
        break;
    default: break;
    }
    return true;
}

// Parse the arguments. Return an exit status, or -1 to continue.
int read_line(int count, char** arguments, said_options& said, view_options& out)
{
    option table[row_count + 1] = {};
    for (int i = 0; i < row_count; ++i)
        table[i] = {rows[i].name, rows[i].argument ? required_argument : no_argument, nullptr, 1000 + i};
    optind = opterr = 0;
    for (int found; (found = getopt_long(count, arguments, "h", table, nullptr)) != -1;) {
        if (found == '?') {
            hair_complain_option(TOOL, arguments[optind - 1]);
            hair_complain(TOOL, "--help lists the options");
            return HAIR_EXIT_USAGE;
        }
        const row letter = {nullptr, found, nullptr, nullptr};
        const row& row = found >= 1000 ? rows[found - 1000] : letter;
        if (row.option == 'h') return print_help();
        if (row.option == VERSION) {
            uint32_t version = hair_version();
            printf("%s %u.%u.%u\n", TOOL, version / 10000, version / 100 % 100, version % 100);
            return hair_flush(TOOL);
        }
        if (!take(row, optarg, said, out)) return HAIR_EXIT_USAGE;
    }
    if (optind < count) said.file = arguments[optind++];
    if (optind == count) return -1;
    hair_complain(TOOL, "%s is one argument too many", arguments[optind]);
    return HAIR_EXIT_USAGE;
}

int open_scene(const said_options& said, view_options& out)
{
    static const char alone[] = "{\"motion\": \"turn\"}"; // scene for a haircut file
    if (!said.file) {
        out.name = said.scene ? said.scene : "demo";
        return hair_scene_named(TOOL, out.name.c_str(), &out.scene) ? -1 : HAIR_EXIT_USAGE;
    }
    out.name = said.file;
    if (view_is_scene(out.name)) {
        out.file = out.name;
        return hair_scene_read(TOOL, said.file, &out.scene) ? -1 : HAIR_EXIT_INPUT;
    }
    if (!hair_scene_parse(TOOL, said.file, alone, sizeof alone - 1, &out.scene)) return HAIR_EXIT_RUNTIME;
    hair_scene_set_groom(said.file, &out.scene);
    return -1;
}

bool set(const char* text, hair_scene& scene)
{
    const char* equals = strchr(text, '=');
    if (!equals) {
        hair_complain(TOOL, "--set is %s, not KEY=VALUE", text);
        return false;
    }
    return hair_settings_set(TOOL, &scene.settings, std::string(text, equals).c_str(), equals + 1);
}

bool change_scene(const said_options& said, hair_scene& scene)
{
    if (said.head) scene.head = scene.head_is_said = true;
    if (said.style && !hair_scene_set_style(TOOL, said.style, &scene)) return false;
    if (said.motion && !hair_scene_set_motion(TOOL, said.motion, &scene)) return false;
    for (const char* change : said.changes)
        if (!set(change, scene)) return false;
    return true;
}

const char* find_clash(const said_options& said, const view_options& out)
{
    bool is_scripted = !out.script.empty();
    if (said.file && said.scene) return "a file and --scene are one too many";
    if (is_scripted && !out.frames) return "--script needs --frames N, which ends the program";
    if (!is_scripted && (!out.shot.empty() || out.device >= 0))
        return "--shot and --device need --script FILE";
    return nullptr;
}

} // namespace

bool view_is_scene(const std::string& path)
{
    return path.size() >= 5 && path.compare(path.size() - 5, 5, ".json") == 0;
}

int view_options_parse(int count, char** arguments, view_options& out)
{
    said_options said;
    hair_scene_default(&out.scene);
    int code = read_line(count, arguments, said, out);
    if (code >= 0) return code;
    const char* clash = find_clash(said, out);
    if (clash) {
        hair_complain(TOOL, "%s", clash);
        return HAIR_EXIT_USAGE;
    }
    code = open_scene(said, out);
    if (code >= 0) return code;
    return change_scene(said, out.scene) ? -1 : HAIR_EXIT_USAGE;
}
