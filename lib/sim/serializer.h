// serializer.h - a serializer for the fields of a saved state. One list of fields serves to count
// the bytes, to write them, and to read and check them.
#ifndef HAIR_SIM_SERIALIZER_H
#define HAIR_SIM_SERIALIZER_H

#include "lib/base/pose.h"
#include "lib/gl/commands.h"

// Maximum of any number in a buffer. A solver itself resets hair that is too far.
#define HAIR_MAX_STATE 1e9
#define HAIR_MAX_FORCE 1e15 // Maximum force or turn of a segment, which stiff hair reaches.
#define HAIR_SERIALIZER_NEW UINT32_MAX // Name of a buffer that is read before it is created.
#define HAIR_SERIALIZER_BUFFERS 13 // Maximum number of buffers of a state.

struct hair_serializer {
    const hair_host* host;
    struct hair_gl* gl;
    const unsigned char* read; // All bytes of the state to read. NULL reads nothing.
    unsigned char* write; // Room for all bytes of the state. NULL writes nothing.
    // Buffer that receives the contents of buffers at their offsets, instead of `write`. They are
    // there when the GPU has done so. 0 reads buffers at once.
    GLuint copies;
    unsigned char* native; // Numbers read for buffers, in native byte order, at their offsets.
    size_t at, end; // Offset of the next field, and of the end of the fields to read.
    hair_result result; // First failure. Nothing is read after a failure.
    int lacks_bend; // The state that is read has no forces of segments.
    uint32_t buffers; // Number of buffers read or copied so far.
    struct hair_serialized_buffer {
        GLuint buffer;
        size_t at, size;
    } buffer[HAIR_SERIALIZER_BUFFERS];
};

// Serialize a number from 0 to `max`.
void hair_serialize_uint(struct hair_serializer* c, const char* name, uint32_t* value, uint32_t max);
void hair_serialize_flag(struct hair_serializer* c, const char* name, int* flag);
// Serialize a number from -max to `max`.
void hair_serialize_float(struct hair_serializer* c, const char* name, float* value, double max);
void hair_serialize_double(struct hair_serializer* c, const char* name, double* value, double min,
                           double max);
void hair_serialize_vec4(struct hair_serializer* c, const char* name, hair_vec4* v, double max);
void hair_serialize_pose(struct hair_serializer* c, const char* name, struct hair_pose* pose, double max);

// Serialize a number that must equal the instance's. Fail on a state of another instance.
void hair_serialize_same(struct hair_serializer* c, const char* name, double value);

// Serialize a buffer of floats, whatever they mean to a solver. A buffer of 0 is skipped.
void hair_serialize_buffer(struct hair_serializer* c, const char* name, GLuint buffer, size_t size);
// Serialize a buffer whose numbers are in [-max, max].
void hair_serialize_buffer_within(struct hair_serializer* s, const char* name, GLuint buffer, size_t size,
                                  double max);

// Convert `size` bytes of floats from native byte order in place.
void hair_serialize_native(unsigned char* bytes, size_t size);

// Serialize `size` bytes of floats that the instance has no buffer for.
void hair_serialize_skipped(struct hair_serializer* c, const char* name, size_t size, double max);

#endif
