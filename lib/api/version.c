// version.c - the version of the library, and the names of results.
#include <hair/hair.h>

uint32_t hair_version(void)
{
    return HAIR_VERSION;
}

const char* hair_result_string(hair_result result)
{
    switch (result) {
    case HAIR_OK: return "no error";
    case HAIR_ERROR_ARGUMENT: return "a value outside its documented range";
    case HAIR_ERROR_MEMORY: return "out of memory";
    case HAIR_ERROR_OPENGL:
        return "no OpenGL context that can be used, or OpenGL refused an object or a shader";
    case HAIR_ERROR_FILE: return "the file is unreadable or not in the format it claims";
    case HAIR_ERROR_VERSION: return "a struct is not from its default function, or is from another version";
    case HAIR_ERROR_CONTEXT_LOST: return "the OpenGL context is lost";
    }
    return "an unknown result";
}
