// capture_options.c - Command line of hair-capture. One table serves getopt and --help.
#include "tools/common/capture_options.h"
#include "tools/common/file.h"
#include "tools/common/frame_writer.h"
#include "tools/common/settings_keys.h"

#include <errno.h>
#include <getopt.h>
#include <stdlib.h>
#include <string.h>

enum name {
    SCENE = 256,
    GROOM,
    STYLE,
    MOTION,
    HEAD,
    SHOW,
    FRAMES,
    FPS,
    SIZE,
    SAMPLES,
    SUPERSAMPLE,
    SET,
    DEVICE,
    STATS,
    CACHE,
    DUMP_GUIDES,
    DUMP_FOLLOWERS,
    SHADER,
    HASH,
    QUIET,
    VERBOSE,
    VERSION,
    SETTING, // sets the setting of the same name
};

struct row {
    const char* name;
    int option;
    const char* argument; // NULL if the option takes no argument
    const char* about;
};

static const struct row rows[] = {
    {"scene", SCENE, "NAME", "a built-in scene, below; without it, \"demo\""},
    {"groom", GROOM, "FILE", "show this haircut (.groom, .hair, .tfx), without a head, framed to fit"},
    {"style", STYLE, "NAME", "show a built-in haircut, below"},
    {"motion", MOTION, "NAME", "move the head so, below"},
    {"head", HEAD, NULL, "draw the built-in head under the haircut of a file"},
    {"show", SHOW, "WHAT", "draw some of hair, head, guides, colliders, wind, by commas; hair,head"},
    {"frames", FRAMES, "A:B", "draw frames A up to, not including, B; those before are simulated only"},
    {"fps", FPS, "N", "frames a second"},
    {"size", SIZE, "WxH", "of the picture, pixels"},
    {"solver", SETTING, "NAME", "direct, accurate, follow or redblack"},
    {"render-path", SETTING, "NAME", "tessellation, cached, compute, auto or procedural"},
    {"primitive", SETTING, "NAME", "ribbons or lines"},
    {"samples", SAMPLES, "N", "a pixel, as many as the driver has; 4"},
    {"supersample", SUPERSAMPLE, "N", "pixels drawn for one, in each direction, 1 to 8; 2"},
    {"set", SET, "KEY=VALUE", "change one of the settings, below; may be repeated"},
    {"scale", SETTING, "X", "of the file's units to metres"},
    {"up", SETTING, "AXIS", "of the file that points up: x, y or z"},
    {"tip-first", SETTING, NULL, "strands of the file run from tip to root"},
    {"keep-fraction", SETTING, "X", "of the file's strands to keep"},
    {"vertices", SETTING, "N", "of every strand, resampled"},
    {"seed", SETTING, "N", "of every random choice"},
    {"guides", SETTING, "N", "strands to simulate"},
    {"followers", SETTING, "N", "strands to grow between guides"},
    {"device", DEVICE, "N", "the EGL device of that index; without it, the first that works"},
    {"shader", SHADER, "FILE.glsl", "shade pixels of strands by this: hair_shader_desc in hair.h says how"},
    {"stats", STATS, "FILE.json", "write what was drawn and how long it took"},
    {"cache", CACHE, "FILE.dump", "play back guides of --dump-guides; the simulation goes on after the last"},
    {"dump-guides", DUMP_GUIDES, "FILE.dump", "write the guides of each frame, for hair-convert"},
    {"dump-followers", DUMP_FOLLOWERS, "FILE.dump", "write the followers of each frame, for hair-convert"},
    {"hash", HASH, NULL, "print a hash of the strands and one of the pixels of the frames drawn"},
    {"quiet", QUIET, NULL, "no progress"},
    {"verbose", VERBOSE, NULL, "say more, such as which device was taken"},
    {"output", 'o', "OUT", "(also -o) .png, name_%04d.png, .exr, .y4m, .mp4, or - for .y4m to a pipe"},
    {"help", 'h', NULL, "(also -h) this"},
    {"version", VERSION, NULL, "the version of the library"},
};

#define ROW_COUNT ((int)(sizeof rows / sizeof *rows))
#define MAX_CHANGES 256

struct change {
    const struct row* row;
    const char* value;
};

// Raw values of the command line. The scene that they change is read later.
struct said {
    const char* scene_name;
    const char* scene_file;
    const char* groom;
    const char* style;
    const char* motion;
    const char* show;
    const char* frames;
    const char* fps;
    const char* size;
    bool head;
    struct change change[MAX_CHANGES];
    int changes;
};

static int print_help(const char* tool)
{
    printf("%s - simulate hair and draw it off-screen\n\n"
           "  %s [SCENE.json | --scene NAME] [OPTION]... [-o OUT]\n\n",
           tool, tool);
    for (int i = 0; i < ROW_COUNT; ++i) {
        char left[64];
        snprintf(left, sizeof left, "--%s%s%s", rows[i].name, rows[i].argument ? " " : "",
                 rows[i].argument ? rows[i].argument : "");
        printf("  %-22s %s\n", left, rows[i].about);
    }
    printf("\n");
    hair_scene_print_names(stdout);
    printf("\nSettings for --set and for \"settings\" in scene files, with their defaults:\n");
    hair_settings_print(stdout);
    printf(
        "\nExit status: 0 done, 1 failed while running, 2 wrong use, 3 no OpenGL 4.5, 4 unusable input.\n");
    return hair_flush(tool);
}

// Values ------------------------------------------------------------------------------------------

// Parse a whole number. `end` receives the position after the number.
static bool parse_count(const char* text, uint32_t min, uint32_t max, const char** end, uint32_t* out)
{
    char* after;
    errno = 0;
    if (*text < '0' || *text > '9') return false;
    unsigned long long value = strtoull(text, &after, 10);
    *end = after;
    *out = (uint32_t)value;
    return !errno && value >= min && value <= max;
}

static bool parse_whole(const char* tool, const char* option, const char* text, uint32_t min, uint32_t max,
                        uint32_t* out)
{
    const char* end;
    if (parse_count(text, min, max, &end, out) && !*end) return true;
    hair_complain(tool, "--%s is %s, not a whole number in [%u, %u]", option, text, min, max);
    return false;
}

static bool parse_frames(const char* tool, const char* text, struct hair_capture_options* out)
{
    const char* end;
    bool ok = parse_count(text, 0, 1000000, &end, &out->first) && *end == ':' &&
              parse_count(end + 1, 0, 1000000, &end, &out->end) && !*end && out->first < out->end;
    if (!ok) hair_complain(tool, "--frames is %s, not A:B with A less than B, both up to 1000000", text);
    return ok;
}

static bool parse_size(const char* tool, const char* text, struct hair_scene* scene)
{
    const char* end;
    bool ok = parse_count(text, 1, 16384, &end, &scene->width) && *end == 'x' &&
              parse_count(end + 1, 1, 16384, &end, &scene->height) && !*end;
    if (!ok) hair_complain(tool, "--size is %s, not WxH with both in [1, 16384]", text);
    return ok;
}

static bool parse_fps(const char* tool, const char* text, struct hair_scene* scene)
{
    char* end;
    double fps = strtod(text, &end);
    bool ok = end != text && !*end && fps >= 1 && fps <= 1000;
    if (!ok) hair_complain(tool, "--fps is %s, not a number in [1, 1000]", text);
    scene->fps = ok ? (float)fps : scene->fps;
    return ok;
}

static bool parse_show(const char* tool, const char* text, struct hair_scene* scene)
{
    bool ok = hair_scene_set_show(text, scene);
    if (!ok) hair_complain(tool, "--show is %s, not " HAIR_SCENE_SHOWN, text);
    return ok;
}

// Apply "--set key=value" or an option such as "--tip-first", which sets tip_first to 1. Clear
// *in_range if the library will refuse the value.
static bool apply_change(const char* tool, const struct change* change, struct hair_scene* scene,
                         bool* in_range)
{
    bool set = change->row->option == SET;
    const char* name = set ? change->value : change->row->name;
    const char* equals = set ? strchr(name, '=') : name + strlen(name);
    char key[64];
    if (!equals || (size_t)(equals - name) >= sizeof key) {
        hair_complain(tool, "--set is %s, not KEY=VALUE", name);
        return false;
    }
    snprintf(key, sizeof key, "%.*s", (int)(equals - name), name);
    for (char* c = key; *c && !set; ++c)
        if (*c == '-') *c = '_';
    const char* value = set ? equals + 1 : change->value ? change->value : "1";
    if (!hair_settings_set(tool, &scene->settings, key, value)) return false;
    *in_range = *in_range && hair_setting_is_in_range(&scene->settings, key);
    return true;
}

// The command line --------------------------------------------------------------------------------

static bool add_change(const char* tool, struct said* said, const struct row* row, const char* value)
{
    if (said->changes == MAX_CHANGES) {
        hair_complain(tool, "more than %d settings", MAX_CHANGES);
        return false;
    }
    said->change[said->changes++] = (struct change){row, value};
    return true;
}

static bool take(const char* tool, const struct row* row, const char* value, struct said* said,
                 struct hair_capture_options* out)
{
    uint32_t device = 0;
    switch (row->option) {
    case SCENE: said->scene_name = value; break;
    case GROOM: said->groom = value; break;
    case STYLE: said->style = value; break;
    case MOTION: said->motion = value; break;
    case HEAD: said->head = true; break;
    case SHOW: said->show = value; break;
    case FRAMES: said->frames = value; break;
    case FPS: said->fps = value; break;
    case SIZE: said->size = value; break;
    case SAMPLES: return parse_whole(tool, row->name, value, 1, 64, &out->samples);
    case SUPERSAMPLE: return parse_whole(tool, row->name, value, 1, 8, &out->supersample);
    case SET:
    case SETTING: return add_change(tool, said, row, value);
    case DEVICE:
        if (!parse_whole(tool, row->name, value, 0, 1000, &device)) return false;
        out->device = (int)device;
        break;
    case STATS: out->stats = value; return hair_output_has_ending(tool, value, ".json");
    case DUMP_GUIDES: out->dump_guides = value; return hair_output_has_ending(tool, value, ".dump");
    case DUMP_FOLLOWERS: out->dump_followers = value; return hair_output_has_ending(tool, value, ".dump");
    case CACHE: out->cache = value; break;
    case SHADER: out->shader = value; break;
    case HASH: out->hash = true; break;
    case QUIET: out->quiet = true; break;
    case VERBOSE: out->verbose = true; break;
    default: out->out = value; break;
    }
    return true;
}

// Parse the arguments. Return an exit status, or -1 to continue.
static int read_line(const char* tool, int count, char** arguments, struct said* said,
                     struct hair_capture_options* out)
{
    struct option table[ROW_COUNT + 1];
    memset(table, 0, sizeof table);
    for (int i = 0; i < ROW_COUNT; ++i)
        table[i] =
            (struct option){rows[i].name, rows[i].argument ? required_argument : no_argument, NULL, 1000 + i};
    optind = opterr = 0;
    for (int found; (found = getopt_long(count, arguments, "ho:", table, NULL)) != -1;) {
        if (found == '?') {
            hair_complain_option(tool, arguments[optind - 1]);
            hair_complain(tool, "--help lists the options");
            return HAIR_EXIT_USAGE;
        }
        struct row letter = {.option = found};
        const struct row* row = found >= 1000 ? &rows[found - 1000] : &letter;
        if (row->option == 'h') return print_help(tool);
        if (row->option == VERSION) {
            uint32_t version = hair_version();
            printf("%s %u.%u.%u\n", tool, version / 10000, version / 100 % 100, version % 100);
            return hair_flush(tool);
        }
        if (!take(tool, row, optarg, said, out)) return HAIR_EXIT_USAGE;
    }
    if (optind < count) said->scene_file = arguments[optind++];
    if (optind == count) return -1;
    hair_complain(tool, "%s is one argument too many", arguments[optind]);
    return HAIR_EXIT_USAGE;
}

// The scene ---------------------------------------------------------------------------------------

static int open_scene(const char* tool, const struct said* said, struct hair_capture_options* out)
{
    // Scene for a haircut file given without a scene.
    static const char alone[] = "{\"motion\": \"turn\"}";
    const char* path = said->scene_file;
    if (path) {
        out->name = path;
        return hair_scene_read(tool, path, &out->scene) ? -1 : HAIR_EXIT_INPUT;
    }
    bool none = !said->scene_name && said->groom;
    out->name = none ? said->groom : said->scene_name ? said->scene_name : "demo";
    bool ok = none ? hair_scene_parse(tool, out->name, alone, sizeof alone - 1, &out->scene)
                   : hair_scene_named(tool, out->name, &out->scene);
    return ok ? -1 : HAIR_EXIT_USAGE;
}

static bool change_scene(const char* tool, const struct said* said, struct hair_capture_options* out)
{
    struct hair_scene* scene = &out->scene;
    bool in_range = true;
    if (said->head) scene->head = scene->head_is_said = true;
    if (said->groom) hair_scene_set_groom(said->groom, scene);
    if (said->style && !hair_scene_set_style(tool, said->style, scene)) return false;
    if (said->motion && !hair_scene_set_motion(tool, said->motion, scene)) return false;
    if (said->show && !parse_show(tool, said->show, scene)) return false;
    if (said->fps && !parse_fps(tool, said->fps, scene)) return false;
    if (said->size && !parse_size(tool, said->size, scene)) return false;
    for (int i = 0; i < said->changes; ++i)
        if (!apply_change(tool, &said->change[i], scene, &in_range)) return false;
    out->is_of_file = said->scene_file && in_range;
    return true;
}

// Choose the frames to draw. Without --frames, a picture gets the scene's picture frame, and a
// video gets all frames.
static bool choose_frames(const char* tool, const struct said* said, struct hair_capture_options* out)
{
    if (said->frames) return parse_frames(tool, said->frames, out);
    bool one = out->out && hair_frame_writer_is_picture(out->out);
    out->first = one ? out->scene.picture : 0;
    out->end = one ? out->scene.picture + 1 : out->scene.frames;
    return true;
}

static const char* find_clash(const struct said* said, const struct hair_capture_options* options)
{
    const char* outputs[] = {options->out, options->stats, options->dump_guides, options->dump_followers};
    int piped = options->hash, asked = piped;
    for (size_t i = 0; i < sizeof outputs / sizeof *outputs; ++i) {
        piped += outputs[i] && !strcmp(outputs[i], "-");
        asked += outputs[i] != NULL;
    }
    if (said->scene_file && said->scene_name) return "a scene file and --scene are one too many";
    if (said->groom && said->style) return "--groom and --style are one too many";
    if (piped > 1)
        return "only one of -o -, --stats -, --dump-guides -, --dump-followers - and --hash can have the "
               "standard output";
    if (!asked)
        return "nothing to do: give -o OUT, --hash, --stats FILE.json or --dump-guides FILE.dump (--help "
               "says "
               "more)";
    return NULL;
}

int hair_capture_parse(const char* tool, int count, char** arguments, struct hair_capture_options* out)
{
    struct said said = {0};
    *out = (struct hair_capture_options){.samples = 4, .supersample = 2, .device = -1};
    int code = read_line(tool, count, arguments, &said, out);
    if (code >= 0) return code;
    const char* clash = find_clash(&said, out);
    if (clash) {
        hair_complain(tool, "%s", clash);
        return HAIR_EXIT_USAGE;
    }
    code = open_scene(tool, &said, out);
    if (code >= 0) return code;
    return change_scene(tool, &said, out) && choose_frames(tool, &said, out) ? -1 : HAIR_EXIT_USAGE;
}
