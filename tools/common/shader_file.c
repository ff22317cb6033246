// shader_file.c - A pixel shader of hair from a file.
#include "tools/common/shader_file.h"

#include <stdlib.h>
#include <string.h>

#include "tools/common/file.h"

#define MAX_SIZE ((size_t)1 << 20) // bytes

int hair_shader_file_create(const char* tool, const char* path, hair_context* context, hair_shader** out)
{
    hair_shader_desc desc = hair_shader_desc_default();
    struct hair_bytes bytes;
    if (!hair_file_read(tool, path, MAX_SIZE, &bytes)) return HAIR_EXIT_INPUT;
    char* text = calloc(1, bytes.size + 1);
    if (text) memcpy(text, bytes.data, bytes.size);
    free(bytes.data);
    if (!text) {
        hair_complain(tool, "%s: out of memory", path);
        return HAIR_EXIT_RUNTIME;
    }
    desc.label = path;
    desc.glsl = text;
    desc.at = HAIR_SHADE_PIXELS;
    hair_result result = hair_shader_create(context, &desc, out);
    free(text);
    return result == HAIR_ERROR_OPENGL ? HAIR_EXIT_INPUT : hair_exit_for(result);
}
