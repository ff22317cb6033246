// layout_test.c - C and GLSL have equal layouts of every struct of glsl/shared.h, in storage and in
// uniform buffers.
#include "tests/support/passes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "glsl/shared.h"
#include "lib/api/api.h"

struct member {
    const char* owner;
    // Name in GLSL's interface query. An array of structs is represented by a member of its
    // element.
    const char* name;
    size_t offset, size;
    GLenum type;
};

// clang-format off
#define ROW(S, name, type) {#S, #name, offsetof(struct S, name), sizeof(((struct S*)0)->name), type}
#define VEC4(S, name) ROW(S, name, GL_FLOAT_VEC4)
#define MAT4(S, name) ROW(S, name, GL_FLOAT_MAT4)
#define FLOAT(S, name) ROW(S, name, GL_FLOAT)
#define UINT(S, name) ROW(S, name, GL_UNSIGNED_INT)
// clang-format on

// Members in order. Each begins where the previous one ends, so that none is missing.
static const struct member members[] = {
    VEC4(hair_guide, root_frame),
    UINT(hair_guide, first),
    UINT(hair_guide, count),
    FLOAT(hair_guide, arc_length),
    UINT(hair_guide, unused),
    VEC4(hair_rest, position),
    VEC4(hair_rest, direction),
    VEC4(hair_rest, frame),
    VEC4(hair_rod, strain),
    VEC4(hair_rod, segment),
    VEC4(hair_rod, factor),
    VEC4(hair_rod, factor_euler),
    VEC4(hair_state, position),
    VEC4(hair_state, displacement),
    VEC4(hair_history, rate),
    VEC4(hair_history, rate_before),
    VEC4(hair_capsule, start[0]),
    VEC4(hair_capsule, start[1]),
    VEC4(hair_capsule, end[0]),
    VEC4(hair_capsule, end[1]),
    VEC4(hair_capsule, spin),
    VEC4(hair_body, position[0]),
    VEC4(hair_body, position[1]),
    VEC4(hair_body, rotation[0]),
    VEC4(hair_body, rotation[1]),
    VEC4(hair_body, size),
    VEC4(hair_contact, around.start[0]),
    VEC4(hair_contact, around.start[1]),
    VEC4(hair_contact, around.end[0]),
    VEC4(hair_contact, around.end[1]),
    VEC4(hair_contact, around.spin),
    VEC4(hair_contact, body.position[0]),
    VEC4(hair_contact, body.position[1]),
    VEC4(hair_contact, body.rotation[0]),
    VEC4(hair_contact, body.rotation[1]),
    VEC4(hair_contact, body.size),
    VEC4(hair_contact, grid),
    UINT(hair_contact, nodes_x),
    UINT(hair_contact, nodes_y),
    UINT(hair_contact, nodes_z),
    UINT(hair_contact, first),
    VEC4(hair_contact, ball),
    VEC4(hair_substep, rotation),
    VEC4(hair_substep, displacement),
    VEC4(hair_step_params, gravity),
    FLOAT(hair_step_params, keep),
    FLOAT(hair_step_params, shape_frequency_root),
    FLOAT(hair_step_params, shape_frequency_tip),
    FLOAT(hair_step_params, angular),
    FLOAT(hair_step_params, bend),
    FLOAT(hair_step_params, collision_margin),
    UINT(hair_step_params, iterations),
    UINT(hair_step_params, substeps),
    UINT(hair_step_params, guides),
    UINT(hair_step_params, colliders),
    UINT(hair_step_params, smooth_vertices),
    FLOAT(hair_step_params, alpha),
    VEC4(hair_step_params, rotation_before),
    VEC4(hair_step_params, rotation_after),
    VEC4(hair_step_params, rotation_now),
    VEC4(hair_step_params, last_displacement),
    VEC4(hair_step_params, rotation_start),
    VEC4(hair_step_params, ratio),
    FLOAT(hair_step_params, kick),
    FLOAT(hair_step_params, damping),
    FLOAT(hair_step_params, friction),
    FLOAT(hair_step_params, fraction_start),
    FLOAT(hair_step_params, rescale),
    UINT(hair_step_params, vertices),
    UINT(hair_step_params, bodies),
    UINT(hair_step_params, rounds),
    UINT(hair_step_params, list),
    UINT(hair_step_params, substep_first),
    UINT(hair_step_params, part_rounds),
    UINT(hair_step_params, unused0),
    VEC4(hair_step_params, cells_lower),
    UINT(hair_step_params, cells_x),
    UINT(hair_step_params, cells_y),
    UINT(hair_step_params, cells_z),
    FLOAT(hair_step_params, cells_slack),
    VEC4(hair_step_params, substep[0].rotation),
    VEC4(hair_step_params, substep[0].displacement),
    VEC4(hair_step_params, substep[1].rotation),
    VEC4(hair_step_params, substep[63].displacement),
    VEC4(hair_step_params, collider[0].start[0]),
    VEC4(hair_step_params, collider[0].end[1]),
    VEC4(hair_step_params, collider[63].end[1]),
    VEC4(hair_step_params, collider[63].spin),
    VEC4(hair_step_params, body[0].position[0]),
    VEC4(hair_step_params, body[63].size),
    UINT(hair_grid_splat, mass),
    UINT(hair_grid_splat, volume),
    UINT(hair_grid_splat, first),
    UINT(hair_grid_splat, end),
    VEC4(hair_grid_params, rotation),
    VEC4(hair_grid_params, moved),
    VEC4(hair_grid_params, lower),
    UINT(hair_grid_params, nodes_x),
    UINT(hair_grid_params, nodes_y),
    UINT(hair_grid_params, nodes_z),
    UINT(hair_grid_params, vertices),
    FLOAT(hair_grid_params, cohesion),
    FLOAT(hair_grid_params, pressure_stiffness),
    FLOAT(hair_grid_params, ahead),
    FLOAT(hair_grid_params, per_strand),
    MAT4(hair_occlusion_params, to_texture),
    UINT(hair_occlusion_params, width),
    UINT(hair_occlusion_params, height),
    UINT(hair_occlusion_params, first_x),
    UINT(hair_occlusion_params, first_y),
    UINT(hair_occlusion_params, columns),
    UINT(hair_occlusion_params, rows),
    UINT(hair_occlusion_params, levels),
    UINT(hair_occlusion_params, level),
    FLOAT(hair_occlusion_params, sign),
    FLOAT(hair_occlusion_params, max_size),
    FLOAT(hair_occlusion_params, slack),
    FLOAT(hair_occlusion_params, thick),
    FLOAT(hair_occlusion_params, beside_x),
    FLOAT(hair_occlusion_params, beside_y),
    UINT(hair_occlusion_params, clips),
    UINT(hair_occlusion_params, guides),
    MAT4(hair_raster_params, to_window),
    VEC4(hair_raster_params, part),
    UINT(hair_raster_params, columns),
    UINT(hair_raster_params, rows),
    UINT(hair_raster_params, samples),
    UINT(hair_raster_params, flips),
    UINT(hair_raster_params, first_x),
    UINT(hair_raster_params, first_y),
    UINT(hair_raster_params, claims),
    UINT(hair_raster_params, clamps),
    FLOAT(hair_raster_params, depth_from),
    FLOAT(hair_raster_params, depth_by),
    UINT(hair_raster_params, across),
    UINT(hair_raster_params, tiles),
    VEC4(hair_raster_params, at[0]),
    VEC4(hair_raster_params, at[7]),
    UINT(hair_activity_params, vertices),
    UINT(hair_activity_params, parity),
    UINT(hair_activity_params, anchors),
    FLOAT(hair_activity_params, rate),
    VEC4(hair_motion_params, turn),
    VEC4(hair_motion_params, moved),
    UINT(hair_motion_params, guides),
    FLOAT(hair_motion_params, calm),
    FLOAT(hair_motion_params, wait),
    FLOAT(hair_motion_params, creep),
    UINT(hair_energy_params, begins),
    UINT(hair_energy_params, ends),
    FLOAT(hair_energy_params, time),
    FLOAT(hair_energy_params, rate),
    VEC4(hair_energy, now),
    VEC4(hair_energy, window),
    UINT(hair_follower, guide0),
    UINT(hair_follower, guide1),
    UINT(hair_follower, guide2),
    UINT(hair_follower, seed),
    FLOAT(hair_follower, weight1),
    FLOAT(hair_follower, weight2),
    FLOAT(hair_follower, length_ratio),
    FLOAT(hair_follower, multi),
    VEC4(hair_follower, offset[0]),
    VEC4(hair_follower, offset[1]),
    VEC4(hair_follower, offset[2]),
    VEC4(hair_follower, offset[3]),
    UINT(hair_root_binding, corner0),
    UINT(hair_root_binding, corner1),
    UINT(hair_root_binding, corner2),
    FLOAT(hair_root_binding, weight1),
    FLOAT(hair_root_binding, weight2),
    FLOAT(hair_root_binding, away_x),
    FLOAT(hair_root_binding, away_y),
    FLOAT(hair_root_binding, away_z),
    VEC4(hair_root_transform, shift[0]),
    VEC4(hair_root_transform, shift[1]),
    VEC4(hair_root_transform, shift[2]),
    VEC4(hair_root_transform, shift[3]),
    VEC4(hair_root_transform, shift[4]),
    VEC4(hair_root_transform, turn[0]),
    VEC4(hair_root_transform, turn[1]),
    VEC4(hair_root_transform, turn[2]),
    VEC4(hair_root_transform, turn[3]),
    VEC4(hair_root_transform, turn[4]),
    VEC4(hair_scalp_params, rotation),
    VEC4(hair_scalp_params, offset),
    UINT(hair_scalp_params, vertices),
    UINT(hair_scalp_params, guides),
    UINT(hair_scalp_params, followers),
    UINT(hair_scalp_params, first),
    UINT(hair_scalp_params, stride),
    UINT(hair_scalp_params, flags),
    UINT(hair_scalp_params, substeps),
    FLOAT(hair_scalp_params, fraction_before),
    FLOAT(hair_scalp_params, fraction_after),
    UINT(hair_scalp_params, smooth_vertices),
    UINT(hair_scalp_params, unused0),
    UINT(hair_scalp_params, unused1),
    UINT(hair_patch, first),
    UINT(hair_patch, count),
    FLOAT(hair_patch, density),
    UINT(hair_patch, guide),
    VEC4(hair_patch, map_density),
    VEC4(hair_patch, map_thickness),
    FLOAT(hair_patch, reach),
    FLOAT(hair_patch, length),
    FLOAT(hair_patch, importance),
    UINT(hair_patch, occluded),
    VEC4(hair_field_params, rotation),
    VEC4(hair_field_params, lower),
    VEC4(hair_field_params, inverse),
    VEC4(hair_wind_params, velocity),
    VEC4(hair_wind_params, box),
    VEC4(hair_wind_params, gust_turn),
    VEC4(hair_wind_params, gust_from),
    FLOAT(hair_wind_params, per_speed),
    FLOAT(hair_wind_params, viscous),
    FLOAT(hair_wind_params, shelter),
    UINT(hair_wind_params, balls),
    UINT(hair_wind_params, sources),
    UINT(hair_wind_params, volume),
    UINT(hair_wind_params, unused0),
    UINT(hair_wind_params, unused1),
    MAT4(hair_wind_params, to_volume),
    VEC4(hair_wind_params, ball[0]),
    VEC4(hair_wind_params, ball[3]),
    VEC4(hair_wind_params, source[0]),
    VEC4(hair_wind_params, source[3]),
    VEC4(hair_wind_params, jet[0]),
    VEC4(hair_wind_params, jet[3]),
    VEC4(hair_wind_params, at[0]),
    VEC4(hair_wind_params, at[63]),
    VEC4(hair_fluid_params, lower),
    VEC4(hair_fluid_params, shift),
    VEC4(hair_fluid_params, wind),
    VEC4(hair_fluid_params, gain),
    VEC4(hair_fluid_params, rotation),
    VEC4(hair_fluid_params, gust_turn),
    VEC4(hair_fluid_params, gust_from),
    UINT(hair_fluid_params, cells),
    UINT(hair_fluid_params, colliders),
    UINT(hair_fluid_params, open),
    UINT(hair_fluid_params, nodes),
    FLOAT(hair_fluid_params, thick),
    FLOAT(hair_fluid_params, per_speed),
    FLOAT(hair_fluid_params, viscous),
    UINT(hair_fluid_params, unused),
    UINT(hair_fluid_level, cells),
    UINT(hair_fluid_level, slot),
    UINT(hair_fluid_level, cell),
    UINT(hair_fluid_level, coarse_slot),
    UINT(hair_fluid_level, coarse_cell),
    UINT(hair_fluid_level, color),
    FLOAT(hair_fluid_level, relax),
    UINT(hair_fluid_level, unused),
    VEC4(hair_fluid_motion, velocity),
    VEC4(hair_fluid_motion, spin),
    VEC4(hair_field_collider, position),
    VEC4(hair_field_collider, rotation),
    VEC4(hair_field_collider, size),
    VEC4(hair_field_collider, grid),
    UINT(hair_field_collider, nodes_x),
    UINT(hair_field_collider, nodes_y),
    UINT(hair_field_collider, nodes_z),
    UINT(hair_field_collider, first),
    UINT(hair_field_collider, shape),
    UINT(hair_field_collider, number),
    UINT(hair_field_collider, unused0),
    UINT(hair_field_collider, unused1),
    UINT(hair_field_brick, at),
    UINT(hair_field_brick, first),
    UINT(hair_field_brick, count),
    UINT(hair_field_brick, unused),
    VEC4(hair_strand_look, curve[0]),
    VEC4(hair_strand_look, curve[48]),
    VEC4(hair_strand_look, loop[0]),
    VEC4(hair_strand_look, loop[31]),
    FLOAT(hair_strand_look, tip_stray_fraction),
    FLOAT(hair_strand_look, stray_fraction),
    FLOAT(hair_strand_look, kinks),
    FLOAT(hair_strand_look, drawn),
    FLOAT(hair_strand_look, length_variation),
    FLOAT(hair_strand_look, curl_radius),
    FLOAT(hair_strand_look, curl_waves),
    FLOAT(hair_strand_look, curl_turns),
    FLOAT(hair_strand_look, curl_guide_phase),
    FLOAT(hair_strand_look, curl_strand_phase),
    FLOAT(hair_strand_look, curl_spread),
    FLOAT(hair_strand_look, curl_left_fraction),
    FLOAT(hair_strand_look, max_stray),
    FLOAT(hair_strand_look, max_offset),
    FLOAT(hair_strand_look, max_width),
    UINT(hair_strand_look, unused),
    UINT(hair_strand, follower),
    FLOAT(hair_strand, width),
    FLOAT(hair_strand, widened),
    FLOAT(hair_strand, whole),
    UINT(hair_draw_command, count),
    UINT(hair_draw_command, instances),
    UINT(hair_draw_command, first),
    UINT(hair_draw_command, base_vertex),
    UINT(hair_draw_command, base_instance),
    UINT(hair_draw_command, strands),
    UINT(hair_draw_command, each),
    UINT(hair_draw_command, unused0),
    MAT4(hair_draw_params, view),
    MAT4(hair_draw_params, view_to_clip),
    VEC4(hair_draw_params, eye),
    VEC4(hair_draw_params, specular),
    VEC4(hair_draw_params, fibre),
    FLOAT(hair_draw_params, radius),
    FLOAT(hair_draw_params, density),
    UINT(hair_draw_params, segments),
    UINT(hair_draw_params, smooth_vertices),
    UINT(hair_draw_params, colored),
    UINT(hair_draw_params, followers),
    UINT(hair_draw_params, follower_collision),
    UINT(hair_draw_params, parity),
    FLOAT(hair_draw_params, collision_margin),
    UINT(hair_draw_params, lights),
    UINT(hair_draw_params, textured),
    UINT(hair_draw_params, light_values),
    UINT(hair_draw_params, culls),
    UINT(hair_draw_params, drawn_only),
    UINT(hair_draw_params, chunks),
    FLOAT(hair_draw_params, push_out_weight),
    VEC4(hair_draw_params, map_weights),
    MAT4(hair_draw_params, sides),
    VEC4(hair_draw_params, head_sphere),
    FLOAT(hair_draw_params, strand_fraction),
    FLOAT(hair_draw_params, segment_fraction),
    FLOAT(hair_draw_params, width_power),
    FLOAT(hair_draw_params, pixels_per_unit),
    FLOAT(hair_draw_params, strand_pixels),
    FLOAT(hair_draw_params, segment_pixels),
    FLOAT(hair_draw_params, min_strand_fraction),
    FLOAT(hair_draw_params, occluded_importance),
    MAT4(hair_draw_params, now_to_clip),
    MAT4(hair_draw_params, before_to_clip),
    VEC4(hair_draw_params, origin),
    VEC4(hair_draw_params, head),
    VEC4(hair_draw_params, viewport),
    VEC4(hair_draw_params, sort),
    VEC4(hair_draw_params, tint.ramp[0]),
    VEC4(hair_draw_params, tint.streak),
    FLOAT(hair_draw_params, tint.brightness),
    FLOAT(hair_draw_params, tint.hue),
    FLOAT(hair_draw_params, tint.roughness),
    FLOAT(hair_draw_params, tint.tilt),
    FLOAT(hair_draw_params, tint.root_darkening),
    FLOAT(hair_draw_params, tint.root_recovery),
    FLOAT(hair_draw_params, tint.streak_clumping),
    FLOAT(hair_draw_params, tint.sparkle),
    VEC4(hair_draw_params, strand.curve[0]),
    UINT(hair_draw_params, strand.unused),
    VEC4(hair_draw_params, light[0]),
    VEC4(hair_draw_params, light[79]),
    MAT4(hair_draw_params, shadow[0]),
    MAT4(hair_draw_params, shadow[1]),
    MAT4(hair_draw_params, shadow[2]),
    MAT4(hair_draw_params, shadow[3]),
    MAT4(hair_draw_params, sky[0]),
    MAT4(hair_draw_params, sky[1]),
    MAT4(hair_draw_params, sky[2]),
};

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
    STRUCT(hair_rod),
    STRUCT(hair_state),
    STRUCT(hair_history),
    STRUCT(hair_capsule),
    STRUCT(hair_body),
    STRUCT(hair_substep),
    STRUCT(hair_step_params),
    STRUCT(hair_follower),
    STRUCT(hair_patch),
    STRUCT(hair_draw_params),
    STRUCT(hair_field_params),
    STRUCT(hair_field_collider),
    STRUCT(hair_field_brick),
    STRUCT(hair_grid_params),
    STRUCT(hair_grid_splat),
    STRUCT(hair_strand_look),
    STRUCT(hair_strand),
    STRUCT(hair_draw_command),
    STRUCT(hair_contact),
    STRUCT(hair_root_binding),
    STRUCT(hair_root_transform),
    STRUCT(hair_scalp_params),
    STRUCT(hair_fluid_params),
    STRUCT(hair_fluid_level),
    STRUCT(hair_fluid_motion),
    STRUCT(hair_activity_params),
    STRUCT(hair_occlusion_params),
    STRUCT(hair_wind_params),
    STRUCT(hair_raster_params),
    STRUCT(hair_motion_params),
    STRUCT(hair_energy_params),
    STRUCT(hair_energy),
};
#define STRUCTS (sizeof structs / sizeof *structs)
#define MEMBERS (sizeof members / sizeof *members)

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

static void compare(GLuint program, GLenum interface, const char* array, size_t size,
                    const struct member* member)
{
    for (size_t i = 0; i < 2; ++i) {
        char name[128];
        if (interface == GL_BUFFER_VARIABLE && i)
            continue; // Only the first element of the outermost array is listed.
        snprintf(name, sizeof name, "%s[%zu].%s", array, i, member->name);
        GLuint index = glGetProgramResourceIndex(program, interface, name);
        // An array of vectors is one resource, named by its first element. The others follow at its
        // stride.
        char* bracket = strrchr(name, '[');
        size_t element = 0;
        if (index == GL_INVALID_INDEX && bracket && name[strlen(name) - 1] == ']') {
            element = (size_t)atoi(bracket + 1);
            strcpy(bracket, "[0]");
            index = glGetProgramResourceIndex(program, interface, name);
        }
        if (index == GL_INVALID_INDEX) fail_msg("GLSL has no %s.%s (%s)", member->owner, member->name, name);
        GLint offset = ask(program, interface, index, GL_OFFSET);
        if (element) offset += (GLint)element * ask(program, interface, index, GL_ARRAY_STRIDE);
        if ((size_t)offset != i * size + member->offset)
            fail_msg("%s.%s is at %zu in C and at %d in GLSL (%s)", member->owner, member->name,
                     i * size + member->offset, offset, name);
        assert_int_equal(ask(program, interface, index, GL_TYPE), member->type);
    }
}

static void struct_members_have_equal_offsets_in_glsl_and_c(void** state)
{
    struct hair_test* test = *state;
    for (size_t s = 0; s < STRUCTS; ++s) {
        GLuint program = link_program(&test->host.host, structs[s].name);
        for (size_t m = 0; m < MEMBERS; ++m) {
            if (strcmp(members[m].owner, structs[s].name)) continue;
            compare(program, GL_BUFFER_VARIABLE, "storage", structs[s].size, &members[m]);
            compare(program, GL_UNIFORM, "uniforms", structs[s].size, &members[m]);
        }
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

// Check that the table above has every member: none begins after the end of the previous one. For
// an array of structs the table has only some members, and for an array only some elements. They
// count for the whole array.
static void struct_tables_list_every_member(void** state)
{
    (void)state;
    for (size_t s = 0; s < STRUCTS; ++s) {
        size_t end = 0;
        for (size_t m = 0; m < MEMBERS; ++m) {
            if (strcmp(members[m].owner, structs[s].name)) continue;
            const char* bracket = strchr(members[m].name, '[');
            int further = strchr(members[m].name, '.') || (bracket && atoi(bracket + 1) > 0);
            if (!further && members[m].offset != end)
                fail_msg("%s.%s begins at %zu, %zu are named before it", members[m].owner, members[m].name,
                         members[m].offset, end);
            end = members[m].offset + members[m].size;
        }
        assert_int_equal(end, structs[s].size);
    }
}

#define COLLIDERS HAIR_GL_WITH(COLLIDERS)
#define THREAD HAIR_GL_WITH(THREAD_PER_GUIDE)

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
        STORAGE(pass, "rod_buffer", ROD, sizeof(struct hair_rod)),                                           \
        STORAGE(pass, "history_buffer", HISTORY, sizeof(struct hair_history)),                               \
        STORAGE(pass, "solver_stats_buffer", SOLVER_STATS, sizeof(hair_uint))
        STEP(HAIR_GL_REDBLACK),
        STEP(HAIR_GL_REDBLACK | HAIR_GL_SIZE(1)),
        STEP(HAIR_GL_REDBLACK | HAIR_GL_SIZE(2)),
        STEP(HAIR_GL_REDBLACK | HAIR_GL_SIZE(3)),
        STORAGE(HAIR_GL_UNPACK_SCALP, "given_buffer", GIVEN, sizeof(float)),
        STORAGE(HAIR_GL_UNPACK_SCALP, "scalp_buffer", SCALP, sizeof(float)),
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
        STORAGE(HAIR_GL_FOLLOW | COLLIDERS | HAIR_GL_SIZE(2), "rod_buffer", ROD, sizeof(struct hair_rod)),
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
        STORAGE(HAIR_GL_RASTER, "tile_buffer", TILE, sizeof(hair_uint)),
        DRAW(HAIR_GL_INSTANCED | HAIR_GL_WITH(FIBRES)),
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
        HAIR_TEST(struct_tables_list_every_member),
        HAIR_TEST(pass_buffers_are_those_of_shared_h),
        HAIR_TEST(work_group_has_a_thread_per_vertex),
        HAIR_TEST(thread_per_guide_puts_eight_guides_in_a_work_group),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
