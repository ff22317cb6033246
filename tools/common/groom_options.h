// groom_options.h - Command line of hair-groom.
#ifndef HAIR_TOOLS_COMMON_GROOM_OPTIONS_H
#define HAIR_TOOLS_COMMON_GROOM_OPTIONS_H

#include <hair/hair_asset.h>

enum hair_groom_command { HAIR_GROOM_INFO = 1, HAIR_GROOM_CONVERT = 2, HAIR_GROOM_GENERATE = 4 };

struct hair_groom_options {
    enum hair_groom_command command;
    const char* operand[2];
    hair_import import;
    hair_style_desc style;
    hair_format format; // HAIR_FORMAT_NONE chooses by the end of OUT
};

// Parse the command line. Return an exit status if the tool must exit at once, after printing the
// reason. Return -1 to continue.
int hair_groom_parse(int count, char** arguments, struct hair_groom_options* out);

// Say where help is. Return the exit status of wrong use.
int hair_groom_misuse(void);

#endif
