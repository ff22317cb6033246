// builtin.h - the text of the scenes and motions that are built in.
#ifndef HAIR_TOOLS_COMMON_BUILTIN_H
#define HAIR_TOOLS_COMMON_BUILTIN_H

struct hair_builtin {
    const char* name;
    const char* text; // JSON
};

// Each ends with a row of NULL. Quotes stand as '.
extern const struct hair_builtin hair_builtin_scenes[];
extern const struct hair_builtin hair_builtin_styles[]; // settings
extern const struct hair_builtin hair_builtin_motions[];

#endif
