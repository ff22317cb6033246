// scalp.c - public calls on scalp motion, for a scalp that the application skins.
#include "lib/api/api.h"
#include "lib/asset/asset.h"

#define MAX_JOINTS 65536u // Indices of joints have 16 bits.
#define FARTHEST 1e9f // Maximum magnitude of a number in a matrix.

static hair_result check_has_scalp(const hair_instance* hair)
{
    if (hair_scalp_motion_vertex_count(&hair->sim)) return HAIR_OK;
    return hair_fail(&hair->context->host, HAIR_ERROR_ARGUMENT, "%s: its groom has no scalp", hair->label);
}

static hair_result check_scalp(hair_instance* hair, size_t stride, const float* to_world,
                               struct hair_pose* space)
{
    HAIR_TRY(check_has_scalp(hair));
    return hair_check_positions(hair, stride, to_world, space);
}

static hair_result check_count(const hair_instance* hair, const char* name, uint32_t count)
{
    uint32_t vertices = hair_scalp_motion_vertex_count(&hair->sim);
    if (count == vertices) return HAIR_OK;
    return hair_fail(&hair->context->host, HAIR_ERROR_ARGUMENT,
                     "%s: %s is %u, not the %u of the groom's scalp", hair->label, name, count, vertices);
}

hair_result hair_set_scalp(hair_instance* hair, const float* positions, uint32_t count, size_t stride,
                           const float to_world[16])
{
    HAIR_TRY(hair_check_instance(hair));
    const hair_host* host = &hair->context->host;
    struct hair_pose space;
    if (!positions) return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: positions is NULL", hair->label);
    HAIR_TRY(check_scalp(hair, stride, to_world, &space));
    HAIR_TRY(check_count(hair, "count", count));
    hair_result result;
    float* packed = hair_copy_positions(hair, "the scalp", positions, count, stride, &result);
    if (!packed) return result;
    hair_enter(hair);
    result = hair_geometry_create_scalp_roots(&hair->geometry, &hair->sim);
    if (!result) hair_scalp_motion_set(&hair->sim, packed, &space);
    hair_free(host, packed);
    return hair_leave(hair->context, result);
}

hair_result hair_set_scalp_buffer(hair_instance* hair, uint32_t gl_buffer, size_t offset, size_t stride,
                                  const float to_world[16])
{
    HAIR_TRY(hair_check_instance(hair));
    struct hair_pose space;
    size_t from = 0, size = 0;
    HAIR_TRY(check_scalp(hair, stride, to_world, &space));
    hair_result result =
        hair_check_position_buffer(hair->context, hair->label, "scalp", gl_buffer, offset, stride,
                                   hair_scalp_motion_vertex_count(&hair->sim), &from, &size);
    if (result) return hair_check_lost(hair->context, result);
    hair_enter(hair);
    result = hair_geometry_create_scalp_roots(&hair->geometry, &hair->sim);
    if (!result)
        hair_scalp_motion_set_buffer(&hair->sim, gl_buffer, from, size, (uint32_t)((offset - from) / 4),
                                     (uint32_t)(stride / 4), &space);
    return hair_leave(hair->context, result);
}

// Joints, which the library skins -----------------------------------------------------------------

static hair_result remove_joints(hair_instance* hair, const float* weights, uint32_t vertex_count,
                                 uint32_t joint_count)
{
    if (weights || vertex_count || joint_count)
        return hair_fail(&hair->context->host, HAIR_ERROR_ARGUMENT,
                         "%s: joints is NULL, but weights, vertex_count or joint_count is not", hair->label);
    HAIR_TRY(hair_check_current(hair->context));
    hair_enter(hair);
    hair_scalp_skin_adopt(&hair->context->gl, &hair->sim.scalp_motion.skin, NULL, 0);
    return hair_leave(hair->context, HAIR_OK);
}

// Check the joints and weights of a vertex, and pack them.
static hair_result pack_vertex(const hair_instance* hair, uint32_t vertex, const uint16_t* joints,
                               const float* weights, uint32_t joint_count, struct hair_vertex_joints* out)
{
    const hair_host* host = &hair->context->host;
    float sum = 0;
    for (size_t i = 4 * (size_t)vertex, k = 0; k < 4; ++k, ++i) {
        if (joints[i] >= joint_count)
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "%s: joints[%zu] is %u, not less than joint_count, %u", hair->label, i,
                             joints[i], joint_count);
        if (!(weights[i] >= 0 && weights[i] <= 1)) // NaN fails too.
            return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: weights[%zu] is %g, not in [0, 1]", hair->label,
                             i, (double)weights[i]);
        sum += weights[i];
    }
    if (!(fabsf(sum - 1) <= HAIR_MAX_WEIGHT_ERROR))
        return hair_fail(host, HAIR_ERROR_ARGUMENT,
                         "%s: the sum of the weights of vertex %u is %g, not in [%g, %g]", hair->label,
                         vertex, (double)sum, 1 - (double)HAIR_MAX_WEIGHT_ERROR,
                         1 + (double)HAIR_MAX_WEIGHT_ERROR);
    joints += 4 * (size_t)vertex;
    weights += 4 * (size_t)vertex;
    *out =
        (struct hair_vertex_joints){joints[0],
                                    joints[1],
                                    joints[2],
                                    joints[3],
                                    {weights[0] / sum, weights[1] / sum, weights[2] / sum, weights[3] / sum}};
    return HAIR_OK;
}

// Return the joints of all vertices packed. Return NULL and set `result` on failure.
static struct hair_vertex_joints* pack_vertices(const hair_instance* hair, const uint16_t* joints,
                                                const float* weights, uint32_t vertex_count,
                                                uint32_t joint_count, hair_result* result)
{
    const hair_host* host = &hair->context->host;
    struct hair_vertex_joints* packed = hair_alloc(host, vertex_count, sizeof *packed);
    *result = packed ? HAIR_OK : hair_fail_memory(host, "the joints of vertices");
    for (uint32_t i = 0; i < vertex_count && !*result; ++i)
        *result = pack_vertex(hair, i, joints, weights, joint_count, &packed[i]);
    if (!*result) return packed;
    hair_free(host, packed);
    return NULL;
}

hair_result hair_set_scalp_weights(hair_instance* hair, const uint16_t* joints, const float* weights,
                                   uint32_t vertex_count, uint32_t joint_count)
{
    HAIR_TRY(hair_check_instance(hair));
    const hair_host* host = &hair->context->host;
    if (!joints) return remove_joints(hair, weights, vertex_count, joint_count);
    if (!weights) return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: weights is NULL", hair->label);
    HAIR_TRY(check_has_scalp(hair));
    HAIR_TRY(check_count(hair, "vertex_count", vertex_count));
    if (joint_count < 1 || joint_count > MAX_JOINTS)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: joint_count is %u, not in [1, %u]", hair->label,
                         joint_count, MAX_JOINTS);
    HAIR_TRY(hair_check_current(hair->context));
    hair_result result;
    struct hair_vertex_joints* packed =
        pack_vertices(hair, joints, weights, vertex_count, joint_count, &result);
    if (!packed) return result;
    hair_enter(hair);
    hair_scalp_skin_adopt(&hair->context->gl, &hair->sim.scalp_motion.skin, packed, joint_count);
    return hair_leave(hair->context, HAIR_OK);
}

// Check the matrix of a joint, and pack its first three rows.
static hair_result pack_joint(const hair_instance* hair, uint32_t joint, const float* m,
                              struct hair_joint* out)
{
    const hair_host* host = &hair->context->host;
    for (int i = 0; i < 16; ++i) {
        float last = i < 15 ? 0 : 1;
        if (!(fabsf(m[i]) <= FARTHEST)) // NaN fails too.
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "%s: matrices: joint %u has %g at %d, not in [-%g, %g]", hair->label, joint,
                             (double)m[i], i, (double)FARTHEST, (double)FARTHEST);
        if (i % 4 == 3 && m[i] != last)
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "%s: matrices: joint %u has %g at %d, not %g as an affine matrix has",
                             hair->label, joint, (double)m[i], i, (double)last);
    }
    *out =
        (struct hair_joint){{m[0], m[4], m[8], m[12]}, {m[1], m[5], m[9], m[13]}, {m[2], m[6], m[10], m[14]}};
    return HAIR_OK;
}

// Create what skinning needs. On failure nothing has changed.
static hair_result create_skin(hair_instance* hair)
{
    struct hair_scalp_skin* skin = &hair->sim.scalp_motion.skin;
    bool is_new = !skin->upload;
    HAIR_TRY(hair_scalp_skin_create(&hair->context->gl, skin, hair_scalp_motion_vertex_count(&hair->sim)));
    hair_result result = hair_geometry_create_scalp_roots(&hair->geometry, &hair->sim);
    if (result && is_new) hair_scalp_skin_free_buffers(&hair->context->gl, skin);
    return result;
}

hair_result hair_set_scalp_joints(hair_instance* hair, const float* matrices, uint32_t joint_count,
                                  const float to_world[16])
{
    HAIR_TRY(hair_check_instance(hair));
    const hair_host* host = &hair->context->host;
    const struct hair_scalp_skin* skin = &hair->sim.scalp_motion.skin;
    struct hair_pose space;
    if (!matrices) return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: matrices is NULL", hair->label);
    HAIR_TRY(check_scalp(hair, 12, to_world, &space));
    if (!skin->vertex_joints)
        return hair_fail(host, HAIR_ERROR_ARGUMENT,
                         "%s: the scalp has no joints. Call hair_set_scalp_weights() first", hair->label);
    if (joint_count != skin->joint_count)
        return hair_fail(host, HAIR_ERROR_ARGUMENT,
                         "%s: joint_count is %u, not the %u of hair_set_scalp_weights()", hair->label,
                         joint_count, skin->joint_count);
    struct hair_joint* joints = hair_alloc(host, joint_count, sizeof *joints);
    hair_result result = joints ? HAIR_OK : hair_fail_memory(host, "the joints");
    for (uint32_t i = 0; i < joint_count && !result; ++i)
        result = pack_joint(hair, i, matrices + 16 * (size_t)i, &joints[i]);
    if (!result) {
        hair_enter(hair);
        result = create_skin(hair);
        if (!result) hair_scalp_motion_set_joints(&hair->sim, joints, &space);
        result = hair_leave(hair->context, result);
    }
    hair_free(host, joints);
    return result;
}
