// groom_options.c - Command line of hair-groom. One table serves getopt and --help.
#define _GNU_SOURCE
#include "tools/common/groom_options.h"
#include "tools/common/file.h"

#include <errno.h>
#include <getopt.h>
#include <stdlib.h>
#include <string.h>

#define TOOL "hair-groom"

static const struct command {
    const char* name;
    int bit; // of enum hair_groom_command
    int operands;
    const char* use;
    const char* about;
} commands[] = {
    {"info", HAIR_GROOM_INFO, 1, "info FILE", "what is in a haircut, what was repaired, what groom it makes"},
    {"convert", HAIR_GROOM_CONVERT, 2, "convert IN OUT",
     "read any format, write .groom, .hair or .tfx (version 4)"},
    {"generate", HAIR_GROOM_GENERATE, 2, "generate STYLE OUT", "write a built-in haircut"},
};

enum choice { SCALE = 256, UP, TIP_FIRST, FRACTION, VERTICES, GUIDES, LENGTH, SEED, FORMAT, HELP, VERSION };

static const struct row {
    const char* name;
    int option, commands;
    const char* argument; // NULL if the option takes no argument
    const char* about;
} rows[] = {
    {"scale", SCALE, HAIR_GROOM_INFO | HAIR_GROOM_CONVERT, "X", "metres per unit of the file; 1"},
    {"up", UP, HAIR_GROOM_INFO | HAIR_GROOM_CONVERT, "AXIS",
     "of the file that points up: y, z or x; turned to y"},
    {"tip-first", TIP_FIRST, HAIR_GROOM_INFO | HAIR_GROOM_CONVERT, NULL,
     "strands of the file run from tip to root"},
    {"keep-fraction", FRACTION, HAIR_GROOM_INFO | HAIR_GROOM_CONVERT, "X", "of the strands to keep; 1"},
    {"vertices", VERTICES, HAIR_GROOM_INFO | HAIR_GROOM_CONVERT | HAIR_GROOM_GENERATE, "N",
     "of every strand, resampled; as they are"},
    {"guides", GUIDES, HAIR_GROOM_GENERATE, "N", "strands to make; 166"},
    {"length", LENGTH, HAIR_GROOM_GENERATE, "X", "times the style's own lengths; 1"},
    {"seed", SEED, HAIR_GROOM_INFO | HAIR_GROOM_CONVERT | HAIR_GROOM_GENERATE, "N",
     "of every random choice; 1"},
    {"format", FORMAT, HAIR_GROOM_CONVERT | HAIR_GROOM_GENERATE, "NAME",
     "of OUT: groom, hair or tfx4; as its name ends"},
    {"help", HELP, HAIR_GROOM_INFO | HAIR_GROOM_CONVERT | HAIR_GROOM_GENERATE, NULL, "(also -h) this"},
    {"version", VERSION, HAIR_GROOM_INFO | HAIR_GROOM_CONVERT | HAIR_GROOM_GENERATE, NULL,
     "the version of the library"},
};

#define COMMANDS (sizeof commands / sizeof *commands)
#define ROWS (sizeof rows / sizeof *rows)

#define EVERY (HAIR_GROOM_INFO | HAIR_GROOM_CONVERT | HAIR_GROOM_GENERATE)

// Commands that accept the given options.
struct said {
    int given; // commands that accept all given options
    const char* wrong; // first option that some command does not accept
};

static void print_names(FILE* out)
{
    for (int i = 0; i < HAIR_STYLE_COUNT; ++i)
        fprintf(out, "%s%s", i ? ", " : "", hair_style_name((hair_style)i));
}

static int print_help(void)
{
    printf(TOOL " - look into haircuts, convert them, make built-in ones\n\n");
    for (size_t i = 0; i < COMMANDS; ++i) printf("  " TOOL " %-20s %s\n", commands[i].use, commands[i].about);
    printf("\nFILE and IN are .groom, .hair or .tfx (2, 3, 4); \"-\" is the standard input or output.\nSTYLE "
           "is one "
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
    static const hair_format formats[] = {HAIR_FORMAT_GROOM, HAIR_FORMAT_HAIR, HAIR_FORMAT_TFX4};
    for (size_t i = 0; i < sizeof formats / sizeof *formats; ++i)
        if (!strcmp(text, hair_format_name(formats[i]))) {
            *out = formats[i];
            return true;
        }
    hair_complain(TOOL, "--format is %s, not groom, hair or tfx4", text);
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

static bool take_option(const struct row* row, const char* text, struct said* said,
                        struct hair_groom_options* out)
{
    if (!said->wrong && row->commands != EVERY) said->wrong = row->name;
    said->given &= row->commands;
    switch ((enum choice)row->option) {
    case SCALE: return parse_number(row->name, text, &out->import.scale);
    case UP: return parse_up(text, &out->import.up);
    case TIP_FIRST: out->import.tip_first = true; break;
    case FRACTION: return parse_number(row->name, text, &out->import.keep_fraction);
    case VERTICES:
        if (!parse_count(row->name, text, &out->import.strand_vertices)) return false;
        out->style.strand_vertices = out->import.strand_vertices;
        return true;
    case GUIDES: return parse_count(row->name, text, &out->style.guide_count);
    case LENGTH: return parse_number(row->name, text, &out->style.length);
    case SEED:
        if (!parse_count(row->name, text, &out->import.seed)) return false;
        out->style.seed = out->import.seed;
        return true;
    case FORMAT: return parse_format(text, &out->format);
    case HELP:
    case VERSION: break;
    }
    return true;
}

int hair_groom_misuse(void)
{
    fprintf(stderr, "Try '" TOOL " --help'.\n");
    return HAIR_EXIT_USAGE;
}

static int take_operands(int count, char** operands, const struct said* said, struct hair_groom_options* out)
{
    const struct command* command = NULL;
    if (count == 0) {
        hair_complain(TOOL, "no command is given");
        return hair_groom_misuse();
    }
    for (size_t i = 0; i < COMMANDS; ++i)
        if (!strcmp(operands[0], commands[i].name)) command = &commands[i];
    if (!command) {
        hair_complain(TOOL, "%s is not a command", operands[0]);
        return hair_groom_misuse();
    }
    if (count - 1 != command->operands) {
        hair_complain(TOOL, "usage: " TOOL " %s", command->use);
        return hair_groom_misuse();
    }
    if (!(said->given & command->bit)) {
        hair_complain(TOOL, "--%s is not an option of %s", said->wrong, command->name);
        return hair_groom_misuse();
    }
    out->command = (enum hair_groom_command)command->bit;
    for (int i = 0; i + 1 < count; ++i) out->operand[i] = operands[i + 1];
    if (out->command != HAIR_GROOM_GENERATE || parse_style(out->operand[0], &out->style.style)) return -1;
    return hair_groom_misuse();
}

int hair_groom_parse(int count, char** arguments, struct hair_groom_options* out)
{
    struct option options[ROWS + 1];
    memset(options, 0, sizeof options);
    for (size_t i = 0; i < ROWS; ++i)
        options[i] = (struct option){rows[i].name, rows[i].argument ? required_argument : no_argument, NULL,
                                     rows[i].option};

    struct said said = {.given = EVERY};
    *out = (struct hair_groom_options){.import = hair_import_default(), .style = hair_style_desc_default()};
    optind = opterr = 0;
    for (int option; (option = getopt_long(count, arguments, "h", options, NULL)) != -1;) {
        if (option == 'h' || option == HELP) return print_help();
        if (option == VERSION) return print_version();
        if (option == '?') {
            hair_complain_option(TOOL, arguments[optind - 1]);
            return hair_groom_misuse();
        }
        if (!take_option(&rows[option - SCALE], optarg, &said, out)) return hair_groom_misuse();
    }
    return take_operands(count - optind, arguments + optind, &said, out);
}
