// layout_test.c - C and GLSL have equal layouts of every struct of glsl/shared.h, in storage and in
// uniform buffers.
#include "tests/support/passes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "glsl/shared.h"
#include "lib/api/api.h"

static const struct {
    const char* name;
    size_t size;
} structs[] = {
#define STRUCT(S)                                                                                            \
    {                                                                                                        \
#S, sizeof(struct S)                                                                                 \
    }
    STRUCT(hair_guide),
    STRUCT(hair_rest),
    STRUCT(hair_state),
    STRUCT(hair_history),
    STRUCT(hair_capsule),
    STRUCT(hair_contact_body),
    STRUCT(hair_contact_mesh),
    STRUCT(hair_substep),
    STRUCT(hair_step_params),
    STRUCT(hair_follower),
    STRUCT(hair_patch),
    STRUCT(hair_draw_params),
    STRUCT(hair_field_params),
    STRUCT(hair_body_params),
    STRUCT(hair_body_change),
    STRUCT(hair_field_collider),
    STRUCT(hair_field_brick),
    STRUCT(hair_grid_node),
    STRUCT(hair_grid_params),
    STRUCT(hair_grid_splat),
    STRUCT(hair_strand_look),
    STRUCT(hair_group_factors),
    STRUCT(hair_strand),
    STRUCT(hair_draw_command),
    STRUCT(hair_contact),
    STRUCT(hair_root_binding),
    STRUCT(hair_root_transform),
    STRUCT(hair_scalp_params),
    STRUCT(hair_vertex_joints),
    STRUCT(hair_joint),
    STRUCT(hair_target_params),
    STRUCT(hair_fluid_params),
    STRUCT(hair_fluid_level),
    STRUCT(hair_fluid_motion),
    STRUCT(hair_activity_params),
    STRUCT(hair_occlusion_params),
    STRUCT(hair_wind_params),
    STRUCT(hair_raster_params),
    STRUCT(hair_batch_head),
    STRUCT(hair_motion_params),
    STRUCT(hair_energy_params),
    STRUCT(hair_energy),
    STRUCT(hair_tint),
    STRUCT(hair_debug_params),
    STRUCT(hair_debug_collider),
    STRUCT(hair_held),
    STRUCT(hair_length_change),
};
#define STRUCTS (sizeof structs / sizeof *structs)

// Link a program with two elements of the struct in a storage buffer and two in a uniform buffer.
static GLuint link_program(const hair_host* host, const char* name)
{
    struct hair_gl_source shared;
    assert_int_equal(hair_gl_read_source(host, NULL, "shared.h", "", &shared), HAIR_OK);
    char blocks[512];
    snprintf(blocks, sizeof blocks,
             "layout(local_size_x = 1) in;\n"
             "layout(std430, binding = 0) buffer storage_block { %s storage[]; };\n"
             "layout(std140, binding = 0) uniform uniform_block { %s uniforms[2]; };\n"
             "void main() { storage[0] = uniforms[1]; }\n",
             name, name);
    const char* text[] = {"#version 450 core\n", shared.text, blocks};
    GLuint program = glCreateShaderProgramv(GL_COMPUTE_SHADER, 3, text);
    GLint linked;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (!linked) {
        char message[1024];
        glGetProgramInfoLog(program, sizeof message, NULL, message);
        fail_msg("%s: %s", name, message);
    }
    hair_free(host, shared.text);
    return program;
}

static GLint ask(GLuint program, GLenum interface, GLuint index, GLenum property)
{
    GLint value = -1;
    glGetProgramResourceiv(program, interface, index, 1, &property, 1, NULL, &value);
    return value;
}

// A member in GLSL, within its struct.
struct member {
    size_t offset, size;
    char name[96];
};

static int by_offset(const void* a, const void* b)
{
    const struct member *x = a, *y = b;
    return (x->offset > y->offset) - (x->offset < y->offset);
}

// Return the size of a scalar, vector or matrix of shared.h.
static size_t size_of(GLint type, const char* name)
{
    switch (type) {
    case GL_FLOAT:
    case GL_INT:
    case GL_UNSIGNED_INT: return 4;
    case GL_FLOAT_VEC4: return 16;
    case GL_FLOAT_MAT4: return 64;
    default: fail_msg("%s is neither a 4-byte scalar nor hair_vec4 nor hair_mat4", name); return 0;
    }
}

// Read the members of the first element of an array of structs, in their order. Return their
// number.
static size_t read_members(GLuint program, GLenum interface, const char* array, struct member* members,
                           size_t capacity)
{
    GLint resources;
    size_t count = 0;
    glGetProgramInterfaceiv(program, interface, GL_ACTIVE_RESOURCES, &resources);
    for (GLint i = 0; i < resources; ++i) {
        struct member member;
        glGetProgramResourceName(program, interface, (GLuint)i, sizeof member.name, NULL, member.name);
        if (strncmp(member.name, array, strlen(array))) continue;
        size_t size = size_of(ask(program, interface, (GLuint)i, GL_TYPE), member.name);
        GLint length = ask(program, interface, (GLuint)i, GL_ARRAY_SIZE);
        member.offset = (size_t)ask(program, interface, (GLuint)i, GL_OFFSET);
        member.size = size;
        if (length > 1)
            member.size = (size_t)length * (size_t)ask(program, interface, (GLuint)i, GL_ARRAY_STRIDE);
        assert_true(count < capacity);
        members[count++] = member;
    }
    qsort(members, count, sizeof *members, by_offset);
    return count;
}

// Check that members follow each other without padding in GLSL, up to the size of the struct in C.
// C has no padding either, because all members are aligned to 4 bytes there. So offsets are equal.
static void check_members(GLuint program, GLenum interface, const char* array, size_t index)
{
    static struct member members[4096];
    size_t count = read_members(program, interface, array, members, 4096), end = 0;
    for (size_t m = 0; m < count; ++m) {
        if (members[m].offset != end)
            fail_msg("%s: %s begins at %zu, and the member before it ends at %zu", structs[index].name,
                     members[m].name, members[m].offset, end);
        end = members[m].offset + members[m].size;
    }
    if (end != structs[index].size)
        fail_msg("%s has %zu bytes in GLSL and %zu in C", structs[index].name, end, structs[index].size);
}

static void struct_members_have_equal_offsets_in_glsl_and_c(void** state)
{
    struct hair_test* test = *state;
    for (size_t s = 0; s < STRUCTS; ++s) {
        GLuint program = link_program(&test->host.host, structs[s].name);
        check_members(program, GL_BUFFER_VARIABLE, "storage[0].", s);
        check_members(program, GL_UNIFORM, "uniforms[0].", s);
        GLuint block = glGetProgramResourceIndex(program, GL_UNIFORM_BLOCK, "uniform_block");
        assert_int_equal(ask(program, GL_UNIFORM_BLOCK, block, GL_BUFFER_DATA_SIZE), 2 * structs[s].size);
        glDeleteProgram(program);
    }
}

static void struct_strides_in_glsl_are_sizes_in_c(void** state)
{
    struct hair_test* test = *state;
    for (size_t s = 0; s < STRUCTS; ++s) {
        GLuint program = link_program(&test->host.host, structs[s].name);
        GLint count;
        glGetProgramInterfaceiv(program, GL_BUFFER_VARIABLE, GL_ACTIVE_RESOURCES, &count);
        assert_true(count > 0);
        for (GLint i = 0; i < count; ++i)
            assert_int_equal(ask(program, GL_BUFFER_VARIABLE, (GLuint)i, GL_TOP_LEVEL_ARRAY_STRIDE),
                             structs[s].size);
        glDeleteProgram(program);
    }
}

static void every_struct_of_shared_h_is_tested(void** state)
{
    struct hair_test* test = *state;
    struct hair_gl_source shared;
    assert_int_equal(hair_gl_read_source(&test->host.host, NULL, "shared.h", "", &shared), HAIR_OK);
    for (const char* at = strstr(shared.text, "\nstruct "); at; at = strstr(at + 1, "\nstruct ")) {
        char name[64];
        int is_tested = 0;
        assert_int_equal(sscanf(at, "\nstruct %63s {", name), 1);
        for (size_t s = 0; s < STRUCTS; ++s) is_tested |= !strcmp(structs[s].name, name);
        if (!is_tested) fail_msg("%s is not in the table of this test", name);
    }
    hair_free(&test->host.host, shared.text);
}

#define COLLIDERS HAIR_GL_WITH(COLLIDERS)
#define THREAD HAIR_GL_WITH(THREAD_PER_GUIDE)
#define OPACITY (HAIR_GL_WITH(DEPTH) | HAIR_GL_WITH(ALPHA_COVERAGE))

// Check the binding and size of every buffer. The size of a storage buffer is the size of one
// element.
static void pass_buffers_are_those_of_shared_h(void** state)
{
    struct hair_test* test = *state;
    static const struct {
        hair_gl_pass pass;
        GLenum interface;
        const char* block;
        GLint binding, size;
    } uses[] = {
#define STEP(pass) {pass, GL_UNIFORM_BLOCK, "step_buffer", HAIR_BIND_STEP, sizeof(struct hair_step_params)}
#define DRAW(pass)                                                                                           \
    {                                                                                                        \
        pass, GL_UNIFORM_BLOCK, "draw_buffer", HAIR_BIND_DRAW, sizeof(struct hair_draw_params)               \
    }
#define STORAGE(pass, block, slot, size)                                                                     \
    {                                                                                                        \
        pass, GL_SHADER_STORAGE_BLOCK, block, HAIR_BIND_##slot, size                                         \
    }
#define ROD(pass)                                                                                            \
    STEP(pass), STORAGE(pass, "guide_buffer", GUIDE, sizeof(struct hair_guide)),                             \
        STORAGE(pass, "rest_buffer", REST, sizeof(struct hair_rest)),                                        \
        STORAGE(pass, "state_buffer", STATE, sizeof(struct hair_state)),                                     \
        STORAGE(pass, "rod_buffer", ROD, sizeof(hair_vec4)),                                                 \
        STORAGE(pass, "history_buffer", HISTORY, sizeof(struct hair_history)),                               \
        STORAGE(pass, "solver_stats_buffer", SOLVER_STATS, sizeof(hair_uint))
        STEP(HAIR_GL_REDBLACK),
        STEP(HAIR_GL_REDBLACK | HAIR_GL_SIZE(1)),
        STEP(HAIR_GL_REDBLACK | HAIR_GL_SIZE(2)),
        STEP(HAIR_GL_REDBLACK | HAIR_GL_SIZE(3)),
        STORAGE(HAIR_GL_UNPACK_POSITIONS, "given_buffer", GIVEN, sizeof(float)),
        STORAGE(HAIR_GL_UNPACK_POSITIONS, "scalp_buffer", SCALP, sizeof(float)),
        STORAGE(HAIR_GL_ROOT_TRANSFORMS, "root_transform_buffer", ROOT_TRANSFORM,
                sizeof(struct hair_root_transform)),
        STORAGE(HAIR_GL_ROOT_TRANSFORMS, "scalp_rest_buffer", SCALP_REST, sizeof(float)),
        STORAGE(HAIR_GL_ROOT_TRANSFORMS, "root_binding_buffer", ROOT_BINDING,
                sizeof(struct hair_root_binding)),
        STORAGE(HAIR_GL_BIND_FOLLOWERS, "follower_buffer", FOLLOWER, sizeof(struct hair_follower)),
        STEP(HAIR_GL_BIND_FOLLOWERS),
        ROD(HAIR_GL_DIRECT),
        ROD(HAIR_GL_DIRECT | COLLIDERS | HAIR_GL_SIZE(3)),
        STORAGE(HAIR_GL_DIRECT, "reduction_buffer", REDUCTION, sizeof(hair_vec4)),
        ROD(HAIR_GL_MIXED_SOLVER | THREAD | HAIR_GL_SIZE(1)),
        STORAGE(HAIR_GL_MIXED_SOLVER | COLLIDERS, "material_buffer", MATERIAL, sizeof(hair_vec4)),
        STORAGE(HAIR_GL_FOLLOW | COLLIDERS | HAIR_GL_SIZE(2), "rod_buffer", ROD, sizeof(hair_vec4)),
        STORAGE(HAIR_GL_FOLLOW | COLLIDERS | HAIR_GL_SIZE(2), "material_buffer", MATERIAL, sizeof(hair_vec4)),
        STEP(HAIR_GL_ACCURATE),
        STEP(HAIR_GL_ACCURATE | THREAD | COLLIDERS),
        STORAGE(HAIR_GL_MOTION_OF_GUIDES, "found_buffer", FOUND, sizeof(hair_uint)),
        {HAIR_GL_MOTION_OF_GUIDES, GL_UNIFORM_BLOCK, "motion_params_buffer", HAIR_BIND_MOTION_PARAMS,
         sizeof(struct hair_motion_params)},
        ROD(HAIR_GL_ENERGY | HAIR_GL_WITH(MIXED)),
        STORAGE(HAIR_GL_ENERGY, "energy_buffer", ENERGY, sizeof(struct hair_energy)),
        {HAIR_GL_ENERGY, GL_UNIFORM_BLOCK, "energy_params_buffer", HAIR_BIND_ENERGY_PARAMS,
         sizeof(struct hair_energy_params)},
        STEP(HAIR_GL_SMOOTH),
        STEP(HAIR_GL_SMOOTH | HAIR_GL_SIZE(3)),
        {HAIR_GL_VOXELISE, GL_UNIFORM_BLOCK, "field_buffer", HAIR_BIND_FIELD,
         sizeof(struct hair_field_params)},
        STORAGE(HAIR_GL_VOXELISE, "brick_buffer", BRICK, sizeof(struct hair_field_brick)),
        STORAGE(HAIR_GL_VOXELISE, "member_buffer", BRICK_COLLIDER, sizeof(hair_uint)),
        DRAW(HAIR_GL_EXPAND),
        STORAGE(HAIR_GL_EXPAND, "cached_position_buffer", CACHED_POSITION, sizeof(hair_vec4)),
        STORAGE(HAIR_GL_EXPAND, "cached_tangent_buffer", CACHED_TANGENT, 2 * sizeof(hair_uint)),
        DRAW(HAIR_GL_SCAN_STRANDS),
        STORAGE(HAIR_GL_SCAN_STRANDS, "start_buffer", START, sizeof(hair_uint)),
        STORAGE(HAIR_GL_SCAN_STRANDS, "command_buffer", COMMAND, sizeof(struct hair_draw_command)),
        STORAGE(HAIR_GL_COMPACT_STRANDS, "start_buffer", START, sizeof(hair_uint)),
        STORAGE(HAIR_GL_COMPACT_STRANDS, "strand_buffer", STRAND, sizeof(struct hair_strand)),
        DRAW(HAIR_GL_EXPAND_VIEW),
        STORAGE(HAIR_GL_EXPAND_VIEW, "command_buffer", LIST_COMMAND, sizeof(struct hair_draw_command)),
        STORAGE(HAIR_GL_EXPAND_VIEW, "cached_position_buffer", CACHED_POSITION, sizeof(hair_vec4)),
        STORAGE(HAIR_GL_EXPAND_VIEW, "cached_tangent_buffer", CACHED_TANGENT, 2 * sizeof(hair_uint)),
        STORAGE(HAIR_GL_EXPAND_VIEW, "shaded_buffer", SHADED, 2 * sizeof(hair_uint)),
        DRAW(HAIR_GL_EXPAND_VIEW_SIDES),
        STORAGE(HAIR_GL_EXPAND_VIEW_SIDES, "clip_buffer", CACHED_POSITION, sizeof(hair_vec4)),
        STORAGE(HAIR_GL_EXPAND_VIEW_SIDES, "shaded_buffer", SHADED, 2 * sizeof(hair_uint)),
        {HAIR_GL_RASTER, GL_UNIFORM_BLOCK, "raster_buffer", HAIR_BIND_RASTER,
         sizeof(struct hair_raster_params)},
        STORAGE(HAIR_GL_RASTER, "nearest_buffer", NEAREST, 2 * sizeof(hair_uint)),
        STORAGE(HAIR_GL_RASTER | HAIR_GL_WITH(DEPTH), "nearest_buffer", NEAREST, sizeof(hair_uint)),
        STORAGE(HAIR_GL_RASTER | OPACITY, "nearest_buffer", NEAREST, sizeof(hair_uint)),
        STORAGE(HAIR_GL_RASTER | HAIR_GL_WITH(BATCH), "batch_buffer", BATCH, sizeof(struct hair_batch_head)),
        STORAGE(HAIR_GL_RASTER_CLEAR, "tile_buffer", TILE, sizeof(hair_uint)),
        STORAGE(HAIR_GL_COMPOSE_TILES, "nearest_buffer", NEAREST, 2 * sizeof(hair_uint)),
        STORAGE(HAIR_GL_COMPOSE_TILES | OPACITY, "tile_buffer", TILE, sizeof(hair_uint)),
        DRAW(HAIR_GL_PROCEDURAL | HAIR_GL_WITH(FIBRES)),
        DRAW(HAIR_GL_CACHED | HAIR_GL_WITH(FIBRES)),
        DRAW(HAIR_GL_TESSELLATED | HAIR_GL_WITH(FIBRES))};
    for (size_t i = 0; i < sizeof uses / sizeof *uses; ++i) {
        hair_test_ok(test, hair_gl_ensure_program(&test->context->gl, uses[i].pass));
        GLuint program = hair_test_program(&test->context->gl, uses[i].pass);
        GLuint block = glGetProgramResourceIndex(program, uses[i].interface, uses[i].block);
        if (block == GL_INVALID_INDEX)
            fail_msg("%s has no %s", hair_gl_row_label(uses[i].pass), uses[i].block);
        assert_int_equal(ask(program, uses[i].interface, block, GL_BUFFER_BINDING), uses[i].binding);
        // Some drivers round the size up to a vec4.
        assert_in_range(ask(program, uses[i].interface, block, GL_BUFFER_DATA_SIZE), uses[i].size,
                        (uses[i].size + 15) / 16 * 16);
    }
}

static GLint threads_of(struct hair_test* test, hair_gl_pass pass)
{
    GLint size[3] = {0};
    hair_test_ok(test, hair_gl_ensure_program(&test->context->gl, pass));
    glGetProgramiv(hair_test_program(&test->context->gl, pass), GL_COMPUTE_WORK_GROUP_SIZE, size);
    assert_int_equal(size[1] * size[2], 1);
    return size[0];
}

// Check that a work group has a thread for each vertex of a guide, and is the smallest of the four
// sizes that does.
static void work_group_has_a_thread_per_vertex(void** state)
{
    static const hair_gl_pass groups[] = {HAIR_GL_REDBLACK,
                                          HAIR_GL_SMOOTH,
                                          HAIR_GL_DIRECT,
                                          HAIR_GL_ACCURATE,
                                          HAIR_GL_FOLLOW | COLLIDERS,
                                          HAIR_GL_MIXED_SOLVER | COLLIDERS};
    for (size_t i = 0; i < sizeof groups / sizeof *groups; ++i)
        for (uint32_t vertices = 2; vertices <= HAIR_MAX_GUIDE_VERTICES; ++vertices) {
            hair_gl_pass pass = hair_gl_pass_for(groups[i], vertices);
            assert_in_range(threads_of(*state, pass), vertices, vertices <= 32 ? 32 : 2 * vertices - 2);
            assert_int_equal(pass & ~HAIR_GL_SIZES, groups[i]);
        }
}

// Check the number of guides per work group that sim.c assumes, for any length of guides.
static void thread_per_guide_puts_eight_guides_in_a_work_group(void** state)
{
    static const hair_gl_pass groups[] = {HAIR_GL_DIRECT | THREAD, HAIR_GL_ACCURATE | THREAD,
                                          HAIR_GL_FOLLOW | THREAD | COLLIDERS,
                                          HAIR_GL_MIXED_SOLVER | THREAD | COLLIDERS};
    // Number of sizes for which a GPU has enough memory. See lib/sim/programs.c.
    static const int max[] = {3, 3, 3, 2};
    const struct hair_test* test = *state;
    for (size_t i = 0; i < sizeof groups / sizeof *groups; ++i)
        for (int size = 0; size < (test->context->gl.software ? 4 : max[i]); ++size)
            assert_int_equal(threads_of(*state, groups[i] | HAIR_GL_SIZE(size)), 8);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(struct_members_have_equal_offsets_in_glsl_and_c),
        HAIR_TEST(struct_strides_in_glsl_are_sizes_in_c),
        HAIR_TEST(every_struct_of_shared_h_is_tested),
        HAIR_TEST(pass_buffers_are_those_of_shared_h),
        HAIR_TEST(work_group_has_a_thread_per_vertex),
        HAIR_TEST(thread_per_guide_puts_eight_guides_in_a_work_group),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
