// builtin.h - JSON text of the built-in scenes, styles and motions.
#ifndef HAIR_TOOLS_COMMON_BUILTIN_H
#define HAIR_TOOLS_COMMON_BUILTIN_H

struct hair_builtin {
    const char* name;
    const char* text; // JSON
};

// Tables of built-in texts. A row of NULL ends each table. The texts use ' in place of ".
extern const struct hair_builtin hair_builtin_scenes[];
extern const struct hair_builtin hair_builtin_styles[]; // settings
extern const struct hair_builtin hair_builtin_motions[];

#endif
