// groom.c - hair-groom, which describes haircuts, converts them between formats, and makes the
// built-in ones.
#define _GNU_SOURCE
#include <hair/hair_asset.h>
#include "tools/common/file.h"

#include <errno.h>
#include <getopt.h>
#include <limits.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

#define TOOL "hair-groom"
#define MAX_BYTES ((size_t)4 << 30)

enum { INFO = 1, CONVERT = 2, GENERATE = 4 };

static const struct command {
    const char* name;
    int bit, operands;
    const char* use;
    const char* about;
} commands[] = {
    {"info", INFO, 1, "info FILE", "what is in a haircut, what was repaired, what groom it makes"},
    {"convert", CONVERT, 2, "convert IN OUT", "read any format, write .hair or .tfx (version 4)"},
    {"generate", GENERATE, 2, "generate STYLE OUT", "write a built-in haircut"},
};

enum choice { SCALE = 256, UP, TIP_FIRST, FRACTION, VERTICES, GUIDES, LENGTH, SEED, FORMAT, HELP, VERSION };

static const struct row {
    const char* name;
    int option, commands;
    const char* argument; // NULL if the option takes no argument
    const char* about;
} rows[] = {
    {"scale", SCALE, INFO | CONVERT, "X", "metres per unit of the file; 1"},
    {"up", UP, INFO | CONVERT, "AXIS", "of the file that points up: y, z or x; turned to y"},
    {"tip-first", TIP_FIRST, INFO | CONVERT, NULL, "strands of the file run from tip to root"},
    {"keep-fraction", FRACTION, INFO | CONVERT, "X", "of the strands to keep; 1"},
    {"vertices", VERTICES, INFO | CONVERT | GENERATE, "N", "of every strand, resampled; as they are"},
    {"guides", GUIDES, GENERATE, "N", "strands to make; 166"},
    {"length", LENGTH, GENERATE, "X", "times the style's own lengths; 1"},
    {"seed", SEED, INFO | CONVERT | GENERATE, "N", "of every random choice; 1"},
    {"format", FORMAT, CONVERT | GENERATE, "NAME", "of OUT: hair or tfx4; as its name ends"},
    {"help", HELP, INFO | CONVERT | GENERATE, NULL, "(also -h) this"},
    {"version", VERSION, INFO | CONVERT | GENERATE, NULL, "the version of the library"},
};

#define COMMANDS (sizeof commands / sizeof *commands)
#define ROWS (sizeof rows / sizeof *rows)

// Parsed command line.
struct said {
    const struct command* command;
    const char* operand[2];
    hair_import import;
    hair_style_desc style;
    hair_format format; // HAIR_FORMAT_NONE chooses by the end of OUT
    int given; // commands that accept all given options
    const char* wrong; // first option that some command does not accept
};

static const hair_host host = {NULL, NULL, hair_print_log, TOOL};

static void print_names(FILE* out)
{
    for (int i = 0; i < HAIR_STYLE_COUNT; ++i)
        fprintf(out, "%s%s", i ? ", " : "", hair_style_name((hair_style)i));
}

static int print_help(void)
{
    printf(TOOL " - look into haircuts, convert them, make built-in ones\n\n");
    for (size_t i = 0; i < COMMANDS; ++i) printf("  " TOOL " %-20s %s\n", commands[i].use, commands[i].about);
    printf("\nFILE and IN are .hair or .tfx (2, 3, 4); \"-\" is the standard input or output.\nSTYLE is one "
           "of ");
    print_names(stdout);
    printf(".\n\n");
    for (size_t i = 0; i < ROWS; ++i) {
        char left[32];
        snprintf(left, sizeof left, "--%s %s", rows[i].name, rows[i].argument ? rows[i].argument : "");
        printf("  %-16s %s", left, rows[i].about);
        for (size_t j = 0; j < COMMANDS && rows[i].option < HELP; ++j)
            if (rows[i].commands & commands[j].bit) printf(" [%s]", commands[j].name);
        printf("\n");
    }
    printf("\nExit status: 0 done, 1 failed while running, 2 wrong use, 4 unusable input.\n");
    return HAIR_EXIT_OK;
}

static int print_version(void)
{
    uint32_t version = hair_version();
    printf(TOOL " %u.%u.%u\n", version / 10000, version / 100 % 100, version % 100);
    return HAIR_EXIT_OK;
}

// The command line --------------------------------------------------------------------------------

// Parse a number. The library checks ranges.
static bool parse_number(const char* name, const char* text, float* out)
{
    char* end;
    *out = strtof(text, &end);
    if (*text && !*end) return true;
    hair_complain(TOOL, "--%s is %s, not a number", name, text);
    return false;
}

static bool parse_count(const char* name, const char* text, uint32_t* out)
{
    char* end;
    errno = 0;
    unsigned long long value = strtoull(text, &end, 10);
    *out = (uint32_t)value;
    if (*text >= '0' && *text <= '9' && !*end && !errno && value <= UINT32_MAX) return true;
    hair_complain(TOOL, "--%s is %s, not a whole number in [0, %u]", name, text, UINT32_MAX);
    return false;
}

static bool parse_up(const char* text, hair_up* out)
{
    static const char axes[] = "yzx"; // in the order of hair_up
    const char* axis = text[0] && !text[1] ? strchr(axes, text[0]) : NULL;
    if (axis) *out = (hair_up)(axis - axes);
    if (!axis) hair_complain(TOOL, "--up is %s, not y, z or x", text);
    return axis != NULL;
}

static bool parse_format(const char* text, hair_format* out)
{
    for (hair_format format = HAIR_FORMAT_HAIR; format <= HAIR_FORMAT_TFX4; ++format)
        if (!strcmp(text, hair_format_name(format))) {
            *out = format;
            return true;
        }
    hair_complain(TOOL, "--format is %s, not hair or tfx4", text);
    return false;
}

static bool parse_style(const char* text, hair_style* out)
{
    for (int i = 0; i < HAIR_STYLE_COUNT; ++i)
        if (!strcmp(text, hair_style_name((hair_style)i))) {
            *out = (hair_style)i;
            return true;
        }
    char escaped[256];
    hair_escape(text, escaped, sizeof escaped);
    fprintf(stderr, TOOL ": %s is not a style; there are ", escaped);
    print_names(stderr);
    fprintf(stderr, "\n");
    return false;
}

static bool take_option(const struct row* row, const char* text, struct said* said)
{
    if (!said->wrong && row->commands != (INFO | CONVERT | GENERATE)) said->wrong = row->name;
    said->given &= row->commands;
    switch ((enum choice)row->option) {
    case SCALE: return parse_number(row->name, text, &said->import.scale);
    case UP: return parse_up(text, &said->import.up);
    case TIP_FIRST: said->import.tip_first = true; return true;
    case FRACTION: return parse_number(row->name, text, &said->import.keep_fraction);
    case VERTICES:
        if (!parse_count(row->name, text, &said->import.strand_vertices)) return false;
        said->style.strand_vertices = said->import.strand_vertices;
        return true;
    case GUIDES: return parse_count(row->name, text, &said->style.guide_count);
    case LENGTH: return parse_number(row->name, text, &said->style.length);
    case SEED:
        if (!parse_count(row->name, text, &said->import.seed)) return false;
        said->style.seed = said->import.seed;
        return true;
    case FORMAT: return parse_format(text, &said->format);
    case HELP:
    case VERSION: break;
    }
    return true;
}

static int misuse(void)
{
    fprintf(stderr, "Try '" TOOL " --help'.\n");
    return HAIR_EXIT_USAGE;
}

static int take_operands(int count, char** operands, struct said* said)
{
    if (count == 0) {
        hair_complain(TOOL, "no command is given");
        return misuse();
    }
    for (size_t i = 0; i < COMMANDS; ++i)
        if (!strcmp(operands[0], commands[i].name)) said->command = &commands[i];
    if (!said->command) {
        hair_complain(TOOL, "%s is not a command", operands[0]);
        return misuse();
    }
    if (count - 1 != said->command->operands) {
        hair_complain(TOOL, "usage: " TOOL " %s", said->command->use);
        return misuse();
    }
    if (!(said->given & said->command->bit)) {
        hair_complain(TOOL, "--%s is not an option of %s", said->wrong, said->command->name);
        return misuse();
    }
    for (int i = 0; i + 1 < count; ++i) said->operand[i] = operands[i + 1];
    return -1;
}

// Parse the arguments. Return an exit status, or -1 to continue.
static int parse(int count, char** arguments, struct said* said)
{
    struct option options[ROWS + 1];
    memset(options, 0, sizeof options);
    for (size_t i = 0; i < ROWS; ++i)
        options[i] = (struct option){rows[i].name, rows[i].argument ? required_argument : no_argument, NULL,
                                     rows[i].option};

    *said = (struct said){.import = hair_import_default(),
                          .style = hair_style_desc_default(),
                          .given = INFO | CONVERT | GENERATE};
    said->style.host = &host;
    opterr = 0;
    int index;
    for (int option; (option = getopt_long(count, arguments, "h", options, &index)) != -1;) {
        if (option == 'h' || option == HELP) return print_help();
        if (option == VERSION) return print_version();
        if (option == '?') {
            hair_complain_option(TOOL, arguments[optind - 1]);
            return misuse();
        }
        if (!take_option(&rows[option - SCALE], optarg, said)) return misuse();
    }
    return take_operands(count - optind, arguments + optind, said);
}

// Reading and writing -----------------------------------------------------------------------------

static int exit_code(hair_result result)
{
    switch (result) {
    case HAIR_OK: return HAIR_EXIT_OK;
    case HAIR_ERROR_ARGUMENT: return HAIR_EXIT_USAGE;
    case HAIR_ERROR_FILE: return HAIR_EXIT_INPUT;
    case HAIR_ERROR_CONTEXT_LOST:
    case HAIR_ERROR_OPENGL: return HAIR_EXIT_OPENGL;
    case HAIR_ERROR_MEMORY:
    case HAIR_ERROR_VERSION: break;
    }
    return HAIR_EXIT_RUNTIME;
}

static int read_asset(const char* path, const struct said* said, hair_asset** out)
{
    struct hair_bytes bytes;
    if (!hair_file_read_haircut(TOOL, path, MAX_BYTES, &bytes)) return HAIR_EXIT_INPUT;
    hair_host named = {NULL, NULL, hair_print_log, (void*)hair_log_name(TOOL, path)};
    hair_asset_desc desc = hair_asset_desc_default();
    desc.host = &named;
    desc.import = &said->import;
    hair_result result = hair_asset_read(&desc, bytes.data, bytes.size, out);
    free(bytes.data);
    return exit_code(result);
}

// Find the format by the end of a name. A name without an end is taken for .hair.
static bool find_format(const char* path, hair_format* out)
{
    const char *slash = strrchr(path, '/'), *end = strrchr(slash ? slash : path, '.');
    bool is_tfx = end && !strcasecmp(end, ".tfx"), is_hair = !end || !strcasecmp(end, ".hair");
    *out = is_tfx ? HAIR_FORMAT_TFX4 : HAIR_FORMAT_HAIR;
    if (!is_tfx && !is_hair)
        hair_complain(TOOL, "%s ends in neither .hair nor .tfx: --format names the format", path);
    return is_tfx || is_hair;
}

static int write_bytes(const char* path, const void* bytes, size_t size)
{
    struct hair_output output;
    if (!hair_output_open(TOOL, path, &output)) return HAIR_EXIT_RUNTIME;
    fwrite(bytes, 1, size, output.file); // hair_output_commit() reports a failed write.
    return hair_output_commit(&output) ? HAIR_EXIT_OK : HAIR_EXIT_RUNTIME;
}

static int write_asset(const hair_asset* asset, const struct said* said)
{
    const char* path = said->operand[1];
    hair_format format = said->format;
    if (!format && !find_format(path, &format)) return misuse();
    size_t size = 0;
    hair_result result = hair_asset_write(asset, format, NULL, 0, &size);
    if (result == HAIR_ERROR_ARGUMENT)
        hair_complain(TOOL, "%s was not written: give --vertices 4, 8, 16, 32 or 64", path);
    if (result) return exit_code(result);

    void* bytes = malloc(size);
    if (!bytes) {
        hair_complain(TOOL, "out of memory for the %zu bytes of %s", size, path);
        return HAIR_EXIT_RUNTIME;
    }
    result = hair_asset_write(asset, format, bytes, size, &size);
    int code = result ? exit_code(result) : write_bytes(path, bytes, size);
    free(bytes);
    return code;
}

// Commands ----------------------------------------------------------------------------------------

static void print_repairs(const hair_import_stats* repairs)
{
    const struct {
        uint32_t count;
        const char* one;
        const char* many;
        const char* what;
    } lines[] = {
        {repairs->dropped_single, "strand", "strands", "of fewer than two vertices dropped"},
        {repairs->dropped_short, "strand", "strands", "shorter than 10 micrometres dropped"},
        {repairs->removed_nonfinite, "vertex", "vertices", "not finite or too far away removed"},
        {repairs->removed_repeated, "vertex", "vertices", "repeated removed"},
        {repairs->resampled, "strand", "strands", "of more than 256 vertices brought down to 256"},
    };
    bool any = false;
    for (size_t i = 0; i < sizeof lines / sizeof *lines; ++i) {
        if (!lines[i].count) continue;
        printf("%-10s %u %s %s\n", any ? "" : "repairs:", lines[i].count,
               lines[i].count == 1 ? lines[i].one : lines[i].many, lines[i].what);
        any = true;
    }
    if (!any) printf("%-10s nothing repaired\n", "repairs:");
}

static void print_asset(const hair_asset_info* info)
{
    const float *l = info->lower, *u = info->upper;
    printf("%-10s %s, %s\n", "format:", hair_format_name(info->format),
           info->strand_set == HAIR_STRAND_SET_FULL ? "all strands" : "guides");
    printf("%-10s %u, of %u in the file\n", "strands:", info->strand_count, info->file_strands);
    printf("%-10s %u, of %u in the file; fewest %u, most %u to a strand\n", "vertices:", info->vertex_count,
           info->file_vertices, info->min_vertices, info->max_vertices);
    printf("%-10s least %.6g, mean %.6g, greatest %.6g m\n", "length:", (double)info->length[0],
           (double)info->length[1], (double)info->length[2]);
    // Adding 0 turns the -0 of a rotated axis into 0.
    printf("%-10s x %.6g to %.6g, y %.6g to %.6g, z %.6g to %.6g m\n", "bounds:", l[0] + 0.0, u[0] + 0.0,
           l[1] + 0.0, u[1] + 0.0, l[2] + 0.0, u[2] + 0.0);
    printf("%-10s %s\n", "radii:", info->strand_radii ? "of every strand" : "none");
    printf("%-10s %s\n", "colours:", info->strand_colors ? "of every strand" : "none");
    print_repairs(&info->import_stats);
}

static hair_result print_groom(const hair_asset* asset)
{
    hair_groom_desc desc = hair_groom_desc_default();
    hair_groom_info info = hair_groom_info_default();
    hair_groom* groom = NULL;
    desc.host = &host;
    hair_result result = hair_asset_to_groom_desc(asset, &desc);
    if (!result) result = hair_groom_create(&desc, &groom);
    if (!result) result = hair_groom_describe(groom, &info);
    hair_groom_destroy(groom);
    if (result) return result;
    printf("%-10s %u guides of %u vertices, %u followers, %u patches\n", "groom:", info.guide_count,
           info.guide_vertex_count, info.follower_count, info.patch_count);
    return HAIR_OK;
}

static int run_info(const struct said* said)
{
    hair_asset* asset = NULL;
    int code = read_asset(said->operand[0], said, &asset);
    if (code) return code;
    hair_asset_info info = hair_asset_info_default();
    hair_result result = hair_asset_describe(asset, &info);
    if (!result) {
        print_asset(&info);
        result = print_groom(asset);
    }
    hair_asset_destroy(asset);
    return exit_code(result);
}

static int run_convert(const struct said* said)
{
    hair_asset* asset = NULL;
    int code = read_asset(said->operand[0], said, &asset);
    if (!code) code = write_asset(asset, said);
    hair_asset_destroy(asset);
    return code;
}

static int run_generate(struct said* said)
{
    hair_asset* asset = NULL;
    if (!parse_style(said->operand[0], &said->style.style)) return misuse();
    hair_result result = hair_asset_generate(&said->style, &asset);
    int code = result ? exit_code(result) : write_asset(asset, said);
    hair_asset_destroy(asset);
    return code;
}

static int run(int count, char** arguments)
{
    struct said said;
    int code = parse(count, arguments, &said);
    if (code >= 0) return code;
    switch (said.command->bit) {
    case INFO: return run_info(&said);
    case CONVERT: return run_convert(&said);
    default: return run_generate(&said);
    }
}

int main(int count, char** arguments)
{
    signal(SIGPIPE, SIG_IGN); // A write to a closed pipe must fail instead of ending the program.
    int code = run(count, arguments), printed = hair_flush(TOOL);
    return code ? code : printed;
}
