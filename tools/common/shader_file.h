// shader_file.h - A pixel shader of hair from a file.
#ifndef HAIR_TOOLS_COMMON_SHADER_FILE_H
#define HAIR_TOOLS_COMMON_SHADER_FILE_H

#include <hair/hair.h>

// Create the shader of a file, to be destroyed by hair_shader_destroy(). Return an exit status for
// the tool, after printing any error.
int hair_shader_file_create(const char* tool, const char* path, hair_context* context, hair_shader** out);

#endif
