// walk.h - over the fields of a saved state, to count, write or read and check them: one list of them serves all three.
#ifndef HAIR_SIM_WALK_H
#define HAIR_SIM_WALK_H

#include "lib/base/pose.h"
#include "lib/gl/gl.h"

#define HAIR_MOST_STATE 1e9 // any number in a buffer: a solver itself resets what is too far for hair
#define HAIR_WALK_BUFFERS 10 // that are walked, at most

struct hair_walk {
    const hair_host* host;
    struct hair_gl* gl;
    const unsigned char* read; // all the bytes, or
    unsigned char* write; // all the bytes, or neither: count only
    unsigned char* own; // as many; what is read of buffers, in the machine's order
    size_t at, end;
    hair_result result; // the first failure's; nothing is read after it
    int lacks_bend; // The state that is read has no forces of segments.
    uint32_t buffers;
    struct {
        GLuint buffer;
        size_t at, size;
    } buffer[HAIR_WALK_BUFFERS]; // read so far
};

void hair_walk_uint(struct hair_walk* c, const char* name, uint32_t* value, uint32_t most);
void hair_walk_flag(struct hair_walk* c, const char* name, int* flag);
void hair_walk_float(struct hair_walk* c, const char* name, float* value, double most); // from -most on
void hair_walk_double(struct hair_walk* c, const char* name, double* value, double least, double most);
void hair_walk_vec4(struct hair_walk* c, const char* name, hair_vec4* v, double most);
void hair_walk_pose(struct hair_walk* c, const char* name, struct hair_pose* pose, double most);

// What must be as the instance has it: else the state is another's.
void hair_walk_same(struct hair_walk* c, const char* name, double value);

// Floats, whatever they are to a solver. A buffer that the instance has no use for is 0.
void hair_walk_buffer(struct hair_walk* c, const char* name, GLuint buffer, size_t size);

// As many bytes of floats that the instance has no place for.
void hair_walk_over(struct hair_walk* c, const char* name, size_t size);

#endif
