// serializer.c - serialization of the fields of a saved state.
#include "lib/sim/serializer.h"

#include <math.h>
#include <string.h>

#include "lib/base/bytes.h"

// Return whether the next `size` bytes can be read. Fail if the state ends before them.
static bool can_read(struct hair_serializer* s, const char* name, size_t size)
{
    if (!s->read || s->result) return false;
    if (size <= s->end - s->at) return true;
    s->result = hair_fail(s->host, HAIR_ERROR_FILE,
                          "the fields of the saved state end at byte %zu, within the %s at byte %zu", s->end,
                          name, s->at);
    return false;
}

static void check_value(struct hair_serializer* s, const char* name, double value, double min, double max)
{
    if (s->result || (value >= min && value <= max)) return; // NaN fails this test too.
    s->result = hair_fail(s->host, HAIR_ERROR_FILE,
                          "the %s at byte %zu of the saved state is %.9g, not in [%.9g, %.9g]", name, s->at,
                          value, min, max);
}

void hair_serialize_uint(struct hair_serializer* s, const char* name, uint32_t* value, uint32_t max)
{
    HAIR_ASSERT(!s->write || !s->read);
    if (s->write) hair_write_u32(s->write + s->at, *value);
    if (can_read(s, name, 4)) {
        uint32_t read = hair_read_u32(s->read + s->at);
        check_value(s, name, read, 0, max);
        if (!s->result) *value = read;
    }
    s->at += 4;
}

void hair_serialize_flag(struct hair_serializer* s, const char* name, int* flag)
{
    uint32_t value = *flag != 0;
    hair_serialize_uint(s, name, &value, 1);
    *flag = (int)value;
}

void hair_serialize_float(struct hair_serializer* s, const char* name, float* value, double max)
{
    if (s->write) hair_write_float(s->write + s->at, *value);
    if (can_read(s, name, 4)) {
        *value = hair_read_float(s->read + s->at);
        check_value(s, name, (double)*value, -max, max);
    }
    s->at += 4;
}

void hair_serialize_double(struct hair_serializer* s, const char* name, double* value, double min, double max)
{
    if (s->write) hair_write_double(s->write + s->at, *value);
    if (can_read(s, name, 8)) {
        *value = hair_read_double(s->read + s->at);
        check_value(s, name, *value, min, max);
    }
    s->at += 8;
}

void hair_serialize_same(struct hair_serializer* s, const char* name, double value)
{
    if (s->write) hair_write_double(s->write + s->at, value);
    if (can_read(s, name, 8)) {
        double saved = hair_read_double(s->read + s->at);
        if (!(saved == value) || signbit(saved) != signbit(value))
            s->result = hair_fail(s->host, HAIR_ERROR_ARGUMENT,
                                  "the saved state is another's: its %s is %.9g, the instance's %.9g", name,
                                  saved, value);
    }
    s->at += 8;
}

void hair_serialize_pose(struct hair_serializer* s, const char* name, struct hair_pose* pose, double max)
{
    float* rotation[] = {&pose->rotation.x, &pose->rotation.y, &pose->rotation.z, &pose->rotation.w};
    float norm = 0;
    for (int i = 0; i < 3; ++i) hair_serialize_double(s, name, &pose->position[i], -max, max);
    for (int i = 0; i < 4; ++i) {
        hair_serialize_float(s, name, rotation[i], 2);
        norm += *rotation[i] * *rotation[i];
    }
    if (s->read && !s->result && !(fabsf(norm - 1) <= 1e-3f))
        s->result =
            hair_fail(s->host, HAIR_ERROR_FILE,
                      "the rotation of the %s, before byte %zu of the saved state, has norm %g, not 1", name,
                      s->at, (double)sqrtf(norm));
}

void hair_serialize_vec4(struct hair_serializer* s, const char* name, hair_vec4* v, double max)
{
    float* number[] = {&v->x, &v->y, &v->z, &v->w};
    for (int k = 0; k < 4; ++k) hair_serialize_float(s, name, number[k], max);
}

void hair_serialize_skipped(struct hair_serializer* s, const char* name, size_t size, double max)
{
    HAIR_ASSERT(size % 4 == 0);
    for (size_t i = 0; i < size && !s->result; i += 4) {
        float number = 0;
        hair_serialize_float(s, name, &number, max);
    }
}

void hair_serialize_native(unsigned char* bytes, size_t size)
{
    HAIR_ASSERT(size % 4 == 0);
    for (size_t i = 0; i < size / 4; ++i) {
        uint32_t bits;
        memcpy(&bits, bytes, sizeof bits);
        bytes = hair_write_u32(bytes, bits);
    }
}

static void add_buffer(struct hair_serializer* s, GLuint buffer, size_t size)
{
    HAIR_ASSERT(s->buffers < HAIR_SERIALIZER_BUFFERS);
    s->buffer[s->buffers++] = (struct hair_serialized_buffer){buffer, s->at, size};
}

void hair_serialize_buffer(struct hair_serializer* s, const char* name, GLuint buffer, size_t size)
{
    hair_serialize_buffer_within(s, name, buffer, size, HAIR_MAX_STATE);
}

void hair_serialize_buffer_within(struct hair_serializer* s, const char* name, GLuint buffer, size_t size,
                                  double max)
{
    HAIR_ASSERT(size % 4 == 0);
    size_t end = s->at + size;
    if (!buffer) return;
    if (s->write && s->copies) {
        add_buffer(s, buffer, size);
        hair_gl_copy_buffer(s->gl, buffer, s->copies, 0, (GLintptr)s->at, (GLsizeiptr)size);
    } else if (s->write) {
        hair_gl_read(s->gl, buffer, size, s->write + s->at);
        hair_serialize_native(s->write + s->at, size);
    }
    if (s->read) {
        add_buffer(s, buffer, size);
        while (s->at < end && !s->result) {
            float number = 0;
            size_t at = s->at;
            hair_serialize_float(s, name, &number, max);
            if (!s->result) memcpy(s->native + at, &number, sizeof number);
        }
    }
    s->at = end;
}
