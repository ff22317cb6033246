// walk.c - serialization of the fields of a saved state.
#include "lib/sim/walk.h"

#include <math.h>
#include <string.h>

#include "lib/base/bytes.h"

// Return whether the next `size` bytes can be read. Fail if the state ends before them.
static bool can_read(struct hair_walk* c, const char* name, size_t size)
{
    if (!c->read || c->result) return false;
    if (size <= c->end - c->at) return true;
    c->result = hair_fail(c->host, HAIR_ERROR_FILE,
                          "the fields of the saved state end at byte %zu, within the %s at byte %zu", c->end,
                          name, c->at);
    return false;
}

static void check(struct hair_walk* c, const char* name, double value, double least, double most)
{
    if (c->result || (value >= least && value <= most)) return; // NaN fails this test too.
    c->result = hair_fail(c->host, HAIR_ERROR_FILE,
                          "the %s at byte %zu of the saved state is %.9g, not in [%.9g, %.9g]", name, c->at,
                          value, least, most);
}

void hair_walk_uint(struct hair_walk* c, const char* name, uint32_t* value, uint32_t most)
{
    HAIR_ASSERT(!c->write || !c->read);
    if (c->write) hair_write_u32(c->write + c->at, *value);
    if (can_read(c, name, 4)) {
        uint32_t read = hair_read_u32(c->read + c->at);
        check(c, name, read, 0, most);
        if (!c->result) *value = read;
    }
    c->at += 4;
}

void hair_walk_flag(struct hair_walk* c, const char* name, int* flag)
{
    uint32_t value = *flag != 0;
    hair_walk_uint(c, name, &value, 1);
    *flag = (int)value;
}

void hair_walk_float(struct hair_walk* c, const char* name, float* value, double most)
{
    if (c->write) hair_write_float(c->write + c->at, *value);
    if (can_read(c, name, 4)) {
        *value = hair_read_float(c->read + c->at);
        check(c, name, (double)*value, -most, most);
    }
    c->at += 4;
}

void hair_walk_double(struct hair_walk* c, const char* name, double* value, double least, double most)
{
    if (c->write) hair_write_double(c->write + c->at, *value);
    if (can_read(c, name, 8)) {
        *value = hair_read_double(c->read + c->at);
        check(c, name, *value, least, most);
    }
    c->at += 8;
}

void hair_walk_same(struct hair_walk* c, const char* name, double value)
{
    if (c->write) hair_write_double(c->write + c->at, value);
    if (can_read(c, name, 8)) {
        double saved = hair_read_double(c->read + c->at);
        if (!(saved == value))
            c->result = hair_fail(c->host, HAIR_ERROR_ARGUMENT,
                                  "the saved state is another's: its %s is %.9g, the instance's %.9g", name,
                                  saved, value);
    }
    c->at += 8;
}

void hair_walk_pose(struct hair_walk* c, const char* name, struct hair_pose* pose, double most)
{
    float* rotation[] = {&pose->rotation.x, &pose->rotation.y, &pose->rotation.z, &pose->rotation.w};
    float norm = 0;
    for (int i = 0; i < 3; ++i) hair_walk_double(c, name, &pose->position[i], -most, most);
    for (int i = 0; i < 4; ++i) {
        hair_walk_float(c, name, rotation[i], 2);
        norm += *rotation[i] * *rotation[i];
    }
    if (c->read && !c->result && !(fabsf(norm - 1) <= 1e-3f))
        c->result =
            hair_fail(c->host, HAIR_ERROR_FILE,
                      "the rotation of the %s, before byte %zu of the saved state, has norm %g, not 1", name,
                      c->at, (double)sqrtf(norm));
}

void hair_walk_vec4(struct hair_walk* c, const char* name, hair_vec4* v, double most)
{
    float* number[] = {&v->x, &v->y, &v->z, &v->w};
    for (int k = 0; k < 4; ++k) hair_walk_float(c, name, number[k], most);
}

void hair_walk_over(struct hair_walk* c, const char* name, size_t size)
{
    HAIR_ASSERT(size % 4 == 0);
    for (size_t i = 0; i < size && !c->result; i += 4) {
        float number = 0;
        hair_walk_float(c, name, &number, HAIR_MOST_STATE);
    }
}

void hair_walk_buffer(struct hair_walk* c, const char* name, GLuint buffer, size_t size)
{
    HAIR_ASSERT(size % 4 == 0 && c->buffers < HAIR_WALK_BUFFERS);
    size_t end = c->at + size;
    if (!buffer) return;
    if (c->write) {
        unsigned char* at = c->write + c->at;
        c->gl->GetNamedBufferSubData(buffer, 0, (GLsizeiptr)size, at);
        for (size_t i = 0; i < size / 4; ++i) { // Convert from native byte order in place.
            uint32_t bits;
            memcpy(&bits, at, sizeof bits);
            at = hair_write_u32(at, bits);
        }
    }
    if (c->read) {
        c->buffer[c->buffers].buffer = buffer;
        c->buffer[c->buffers].at = c->at;
        c->buffer[c->buffers].size = size;
        ++c->buffers;
        while (c->at < end && !c->result) {
            float number = 0;
            size_t at = c->at;
            hair_walk_float(c, name, &number, HAIR_MOST_STATE);
            if (!c->result) memcpy(c->own + at, &number, sizeof number);
        }
    }
    c->at = end;
}
