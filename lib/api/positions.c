// positions.c - checks and copies of positions that the application passes each frame, in arrays or
// in an OpenGL buffer.
#include "lib/api/api.h"

#define FARTHEST 1e9f // Maximum coordinate of a position, m.
#define LONGEST 4096u // Maximum stride, bytes.

hair_result hair_check_positions(hair_instance* hair, size_t stride, const float* to_world,
                                 struct hair_pose* space)
{
    *space = (struct hair_pose){.rotation = {0, 0, 0, 1}};
    if (stride < 12 || stride > LONGEST || stride % 4)
        return hair_fail(&hair->context->host, HAIR_ERROR_ARGUMENT,
                         "%s: stride is %zu, not a multiple of 4 in [12, %u]", hair->label, stride, LONGEST);
    if (to_world) HAIR_TRY(hair_check_transform(hair, "to_world", to_world, space));
    return hair_check_current(hair->context);
}

float* hair_copy_positions(const hair_instance* hair, const char* what, const float* positions,
                           uint32_t count, size_t stride, hair_result* result)
{
    const hair_host* host = &hair->context->host;
    HAIR_ASSERT(stride >= 12 && stride % sizeof *positions == 0);
    float* packed = hair_alloc(host, count, 3 * sizeof *packed);
    *result = packed ? HAIR_OK : hair_fail_memory(host, what);
    for (uint32_t i = 0; i < count && !*result; ++i) {
        const float* p = positions + i * (stride / sizeof *positions);
        for (int k = 0; k < 3; ++k) packed[3 * (size_t)i + (size_t)k] = p[k];
        // NaN fails too.
        if (!(fabsf(p[0]) <= FARTHEST && fabsf(p[1]) <= FARTHEST && fabsf(p[2]) <= FARTHEST))
            *result = hair_fail(host, HAIR_ERROR_ARGUMENT,
                                "%s: positions: vertex %u is (%g, %g, %g), not within %g m of the origin",
                                hair->label, i, (double)p[0], (double)p[1], (double)p[2], (double)FARTHEST);
    }
    if (!*result) return packed;
    hair_free(host, packed);
    return NULL;
}

hair_result hair_check_position_buffer(const hair_context* context, const char* label, const char* what,
                                       uint32_t buffer, size_t offset, size_t stride, uint32_t count,
                                       size_t* from, size_t* size)
{
    const struct hair_gl* gl = &context->gl;
    GLint64 has = 0, mapped = 0, access = 0;
    GLint align = 1;
    // Queries of another object would raise the application's error flag.
    if (!buffer || !gl->IsBuffer(buffer))
        return hair_fail(&gl->host, HAIR_ERROR_ARGUMENT, "%s: gl_buffer is %u, not a buffer", label, buffer);
    gl->GetNamedBufferParameteri64v(buffer, GL_BUFFER_SIZE, &has);
    gl->GetNamedBufferParameteri64v(buffer, GL_BUFFER_MAPPED, &mapped);
    gl->GetNamedBufferParameteri64v(buffer, GL_BUFFER_ACCESS_FLAGS, &access);
    if (mapped && !(access & GL_MAP_PERSISTENT_BIT))
        return hair_fail(&gl->host, HAIR_ERROR_ARGUMENT, "%s: gl_buffer %u is mapped, and not persistently",
                         label, buffer);
    uint64_t needed = (uint64_t)stride * (count - 1) + 12, there = (uint64_t)has;
    if (offset % 4 || offset > there || needed > there - offset)
        return hair_fail(&gl->host, HAIR_ERROR_ARGUMENT,
                         "%s: offset is %zu, not a multiple of 4 from which on gl_buffer's %llu bytes hold "
                         "the %llu of the %s",
                         label, offset, (unsigned long long)there, (unsigned long long)needed, what);
    gl->GetIntegerv(GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT, &align);
    *from = offset - offset % (size_t)align;
    *size = (size_t)needed + (offset - *from);
    HAIR_ASSERT(*from <= offset && (offset - *from) % 4 == 0);
    if (*size > (size_t)gl->max_storage_bytes)
        return hair_fail(&gl->host, HAIR_ERROR_OPENGL,
                         "%s: the %s takes %zu bytes, more than the driver's %d", label, what, *size,
                         gl->max_storage_bytes);
    return HAIR_OK;
}
