// character.c - The mesh of a skinned character, in every pose.
#include "tools/common/character.h"
#include "tools/common/file.h"

#include <cglm/cglm.h>

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#define MAX_JOINTS 65535u
#define FAR 1e5f // maximum of any coordinate in a pose, m

// Joints ------------------------------------------------------------------------------------------

static bool contains_head(const char* name)
{
    for (; *name; ++name)
        if (tolower((unsigned char)name[0]) == 'h' && tolower((unsigned char)name[1]) == 'e' &&
            tolower((unsigned char)name[2]) == 'a' && tolower((unsigned char)name[3]) == 'd')
            return true;
    return false;
}

// Find the joint of the head by its name, or the first joint with a name that contains "head".
static bool find_head(struct hair_character* character, const char* name)
{
    const struct hair_gltf* gltf = &character->gltf;
    for (uint32_t k = 0; k < gltf->node_count; ++k) {
        uint32_t i = gltf->order[k];
        bool found = *name ? !strcmp(gltf->nodes[i].name, name)
                           : contains_head(gltf->nodes[i].name) && gltf->nodes[i].mesh == HAIR_GLTF_NONE;
        if (!found) continue;
        character->head = i;
        return true;
    }
    if (*name)
        hair_complain(character->tool, "%s: there is no node %s", character->path, name);
    else
        hair_complain(character->tool,
                      "%s: no node has a name with \"head\"; character.head names the joint of the head",
                      character->path);
    return false;
}

static bool find_animation(struct hair_character* character, const struct hair_scene_character* from)
{
    const struct hair_gltf* gltf = &character->gltf;
    uint32_t i = from->animation;
    character->animation = HAIR_GLTF_NONE;
    if (*from->animation_name)
        for (i = 0; i < gltf->animation_count && strcmp(gltf->animations[i].name, from->animation_name);) ++i;
    else if (!gltf->animation_count && i == 0)
        return true;
    if (i >= gltf->animation_count) {
        hair_complain(character->tool, "%s: character.animation is %s%.0u, but the file has %u animations",
                      character->path, from->animation_name, *from->animation_name ? 0 : i,
                      gltf->animation_count);
        return false;
    }
    character->animation = i;
    character->duration = gltf->animations[i].duration;
    return true;
}

// Mesh --------------------------------------------------------------------------------------------

// Count vertices, triangles and joints of the nodes that are drawn.
static void count_parts(struct hair_character* character, uint64_t* vertices, uint64_t* triangles,
                        uint64_t* joints)
{
    const struct hair_gltf* gltf = &character->gltf;
    for (uint32_t i = 0; i < gltf->node_count; ++i) {
        const struct hair_gltf_node* node = &gltf->nodes[i];
        if (!node->is_drawn || node->mesh == HAIR_GLTF_NONE) continue;
        *joints += node->skin == HAIR_GLTF_NONE ? 1 : gltf->skins[node->skin].joint_count;
        for (uint32_t k = 0; k < gltf->meshes[node->mesh].primitive_count; ++k) {
            *vertices += gltf->meshes[node->mesh].primitives[k].vertex_count;
            *triangles += gltf->meshes[node->mesh].primitives[k].triangle_count;
        }
    }
}

static bool allocate(struct hair_character* character)
{
    uint64_t vertices = 0, triangles = 0, joints = 0;
    count_parts(character, &vertices, &triangles, &joints);
    if (!triangles || vertices > 16777216 || triangles > 16777216 || joints > MAX_JOINTS) {
        hair_complain(character->tool,
                      "%s: the scene has %llu vertices, %llu triangles and %llu joints, not 1 to 16777216 of "
                      "each, and at most %u joints",
                      character->path, (unsigned long long)vertices, (unsigned long long)triangles,
                      (unsigned long long)joints, MAX_JOINTS);
        return false;
    }
    struct head_mesh* mesh = &character->mesh;
    float** const vectors[] = {&character->bind_positions,
                               &character->bind_normals,
                               &character->rest_positions,
                               &mesh->positions,
                               &mesh->normals,
                               &mesh->colors,
                               &mesh->surface,
                               &character->clamped};
    float** const matrices[] = {&character->inverse_binds, &character->rest_inverses, &character->matrices,
                                &character->scalp_matrices};
    bool ok = true;
    for (size_t i = 0; i < sizeof vectors / sizeof *vectors; ++i)
        ok &= (*vectors[i] = calloc(vertices, 3 * sizeof(float))) != NULL;
    for (size_t i = 0; i < sizeof matrices / sizeof *matrices; ++i)
        ok &= (*matrices[i] = calloc(joints, sizeof(mat4))) != NULL;
    ok &= (character->joints = calloc(vertices, 4 * sizeof *character->joints)) != NULL;
    ok &= (character->weights = calloc(vertices, 4 * sizeof *character->weights)) != NULL;
    ok &= (character->joint_nodes = calloc(joints, sizeof *character->joint_nodes)) != NULL;
    ok &= (character->nodes = calloc(character->gltf.node_count, sizeof(mat4))) != NULL;
    ok &= (mesh->triangles = calloc(triangles, 3 * sizeof *mesh->triangles)) != NULL;
    if (!ok) hair_complain(character->tool, "%s: out of memory", character->path);
    return ok;
}

// Add the vertices of a primitive, whose joints begin at `first` among all joints.
static void add_primitive(struct hair_character* character, const struct hair_gltf_primitive* from,
                          bool is_skinned, uint32_t first)
{
    static const float surface[3] = {0, 0.25f, 1}; // no skin, a faint highlight
    struct head_mesh* mesh = &character->mesh;
    size_t at = mesh->vertex_count, bytes = 3 * (size_t)from->vertex_count * sizeof(float);
    memcpy(character->bind_positions + 3 * at, from->positions, bytes);
    memcpy(character->bind_normals + 3 * at, from->normals, bytes);
    for (size_t i = 0; i < from->vertex_count; ++i) {
        memcpy(mesh->colors + 3 * (at + i), from->color, sizeof from->color);
        memcpy(mesh->surface + 3 * (at + i), surface, sizeof surface);
        for (size_t k = 0; k < 4; ++k) {
            size_t to = 4 * (at + i) + k;
            character->joints[to] = (uint16_t)(first + (is_skinned ? from->joints[4 * i + k] : 0));
            character->weights[to] = is_skinned ? from->weights[4 * i + k] : k == 0;
        }
    }
    for (size_t i = 0; i < 3 * (size_t)from->triangle_count; ++i)
        mesh->triangles[3 * (size_t)mesh->triangle_count + i] = mesh->vertex_count + from->triangles[i];
    mesh->vertex_count += from->vertex_count;
    mesh->triangle_count += from->triangle_count;
}

static void add_node(struct hair_character* character, uint32_t i)
{
    const struct hair_gltf* gltf = &character->gltf;
    const struct hair_gltf_node* node = &gltf->nodes[i];
    bool is_skinned = node->skin != HAIR_GLTF_NONE;
    const struct hair_gltf_skin* skin = is_skinned ? &gltf->skins[node->skin] : NULL;
    uint32_t first = character->joint_count, count = skin ? skin->joint_count : 1;
    for (uint32_t k = 0; k < count; ++k) {
        mat4 identity = GLM_MAT4_IDENTITY_INIT;
        character->joint_nodes[first + k] = skin ? skin->joints[k] : i;
        memcpy(character->inverse_binds + 16 * (size_t)(first + k),
               skin ? skin->inverse_binds + 16 * (size_t)k : (const float*)identity, sizeof identity);
    }
    character->joint_count += count;
    for (uint32_t k = 0; k < gltf->meshes[node->mesh].primitive_count; ++k)
        add_primitive(character, &gltf->meshes[node->mesh].primitives[k], is_skinned, first);
}

// Poses -------------------------------------------------------------------------------------------

static void load(const float* from, mat4 to)
{
    memcpy(to, from, sizeof(mat4));
}

// Compute the matrices of all joints.
static void pose_joints(struct hair_character* character, uint32_t animation, float time)
{
    hair_gltf_pose(&character->gltf, animation, time, character->nodes);
    for (uint32_t i = 0; i < character->joint_count; ++i) {
        mat4 node, bind, scale = GLM_MAT4_IDENTITY_INIT;
        load(character->nodes + 16 * (size_t)character->joint_nodes[i], node);
        load(character->inverse_binds + 16 * (size_t)i, bind);
        for (int k = 0; k < 3; ++k) scale[k][k] = character->scale;
        glm_mat4_mul(node, bind, node);
        glm_mat4_mul(scale, node, node);
        memcpy(character->matrices + 16 * (size_t)i, node, sizeof node);
    }
}

// Compute positions, and normals unless they are NULL, in the world. Return false if a position is
// not finite.
static bool skin_vertices(const struct hair_character* character, float* positions, float* normals)
{
    for (size_t i = 0; i < character->mesh.vertex_count; ++i) {
        mat4 sum = GLM_MAT4_ZERO_INIT;
        const float *p = character->bind_positions + 3 * i, *n = character->bind_normals + 3 * i;
        vec3 place = {p[0], p[1], p[2]}, normal = {n[0], n[1], n[2]};
        for (size_t k = 0; k < 4; ++k) {
            float weight = character->weights[4 * i + k];
            const float* joint = character->matrices + 16 * (size_t)character->joints[4 * i + k];
            if (weight > 0)
                for (int e = 0; e < 16; ++e) ((float*)sum)[e] += weight * joint[e];
        }
        glm_mat4_mulv3(sum, place, 1, place);
        for (int k = 0; k < 3; ++k)
            if (!(fabsf(place[k]) <= FAR)) return false;
        memcpy(positions + 3 * i, place, sizeof place);
        if (!normals) continue;
        glm_mat4_mulv3(sum, normal, 0, normal);
        glm_vec3_normalize(normal);
        memcpy(normals + 3 * i, normal, sizeof normal);
    }
    return true;
}

// Compute the matrix of the head's joint without its scale, in m.
static void head_matrix(const struct hair_character* character, mat4 out)
{
    versor turn;
    mat4 node;
    load(character->nodes + 16 * (size_t)character->head, node);
    for (int k = 0; k < 3; ++k) glm_vec3_normalize(node[k]);
    glm_mat4_quat(node, turn);
    glm_quat_normalize(turn);
    glm_quat_mat4(turn, out);
    for (int k = 0; k < 3; ++k) out[3][k] = character->scale * node[3][k];
}

// Return the time within the animation, and the number of repetitions before.
static float wrap(const struct hair_character* character, float time, float* cycles)
{
    *cycles = character->duration > 0 ? floorf(time / character->duration) : 0;
    return character->duration > 0 ? time - *cycles * character->duration : 0;
}

bool hair_character_pose(struct hair_character* character, float time)
{
    float cycles, within = wrap(character, time, &cycles);
    mat4 head, rest, inverse;
    pose_joints(character, character->animation, within);
    head_matrix(character, head);
    load(character->head_at_rest, rest);
    glm_mat4_inv_fast(rest, rest);
    glm_mat4_mul(head, rest, head);
    bool ok = skin_vertices(character, character->mesh.positions, character->mesh.normals);
    for (int k = 0; k < 16; ++k) ok &= fabsf(((float*)head)[k]) <= FAR;
    if (!ok) {
        hair_complain(character->tool, "%s: at %g s a vertex or the head is more than %g m away",
                      character->path, (double)within, (double)FAR);
        return false;
    }
    glm_mat4_inv(head, inverse);
    for (size_t i = 0; i < character->mesh.vertex_count; ++i) {
        float *p = character->mesh.positions + 3 * i, *n = character->mesh.normals + 3 * i;
        vec3 place = {p[0], p[1], p[2]}, normal = {n[0], n[1], n[2]};
        glm_mat4_mulv3(inverse, place, 1, place);
        glm_mat4_mulv3(inverse, normal, 0, normal);
        memcpy(p, place, sizeof place);
        memcpy(n, normal, sizeof normal);
    }
    // Each repetition begins where the last one ended.
    for (int k = 0; k < 3; ++k) {
        float shift = cycles * character->travel[k];
        head[3][k] += shift;
        for (uint32_t i = 0; i < character->joint_count; ++i)
            character->matrices[16 * (size_t)i + 12 + (size_t)k] += shift;
    }
    memcpy(character->transform, head, sizeof head);
    return true;
}

bool hair_character_pose_head(struct hair_character* character, const struct hair_motion* motion, float time,
                              float transform[16])
{
    if (!character) {
        hair_motion_at(motion, time, transform);
        return true;
    }
    if (!hair_character_pose(character, time)) return false;
    memcpy(transform, character->transform, 16 * sizeof *transform);
    return true;
}

int hair_character_check_solver(const char* tool, const struct hair_scene* scene)
{
    if (!*scene->character.file || scene->settings.desc.solver != HAIR_SOLVER_REDBLACK) return HAIR_EXIT_OK;
    hair_complain(tool, "the solver redblack knows no bodies that deform, which a character needs");
    return HAIR_EXIT_USAGE;
}

void hair_character_way(const struct hair_character* character, float time, float out[3])
{
    for (int k = 0; k < 3; ++k)
        out[k] = character->duration > 0 ? character->travel[k] * (time / character->duration) : 0;
}

// Compute the pose at rest, and the way of the head from the begin of the animation to its end.
static bool measure(struct hair_character* character)
{
    mat4 head, first, last;
    pose_joints(character, HAIR_GLTF_NONE, 0);
    head_matrix(character, head);
    memcpy(character->head_at_rest, head, sizeof head);
    for (uint32_t i = 0; i < character->joint_count; ++i) {
        mat4 inverse;
        load(character->matrices + 16 * (size_t)i, inverse);
        if (fabsf(glm_mat4_det(inverse)) > 1e-20f)
            glm_mat4_inv(inverse, inverse);
        else
            glm_mat4_identity(inverse);
        memcpy(character->rest_inverses + 16 * (size_t)i, inverse, sizeof inverse);
    }
    if (!skin_vertices(character, character->rest_positions, NULL)) {
        hair_complain(character->tool, "%s: at rest a vertex is more than %g m away", character->path,
                      (double)FAR);
        return false;
    }
    if (character->animation == HAIR_GLTF_NONE) return true;
    pose_joints(character, character->animation, 0);
    head_matrix(character, first);
    pose_joints(character, character->animation, character->duration);
    head_matrix(character, last);
    float x = last[3][0] - first[3][0], z = last[3][2] - first[3][2];
    if (x * x + z * z > 0.01f) character->travel[0] = x, character->travel[2] = z;
    return true;
}

int hair_character_create(const char* tool, const struct hair_scene* scene, struct hair_character** out)
{
    const struct hair_scene_character* from = &scene->character;
    *out = NULL;
    if (!*from->file) return HAIR_EXIT_OK;
    struct hair_character* character = calloc(1, sizeof *character);
    if (!character) {
        hair_complain(tool, "out of memory");
        return HAIR_EXIT_RUNTIME;
    }
    *character = (struct hair_character){.tool = tool, .path = from->file, .scale = from->scale};
    bool ok = hair_gltf_read(tool, from->file, &character->gltf) && find_head(character, from->head) &&
              find_animation(character, from) && allocate(character);
    for (uint32_t i = 0; i < character->gltf.node_count && ok; ++i)
        if (character->gltf.nodes[i].is_drawn && character->gltf.nodes[i].mesh != HAIR_GLTF_NONE)
            add_node(character, i);
    if (ok && measure(character) && hair_character_pose(character, 0)) {
        *out = character;
        return HAIR_EXIT_OK;
    }
    hair_character_destroy(character);
    return HAIR_EXIT_INPUT;
}

void hair_character_destroy(struct hair_character* character)
{
    if (!character) return;
    if (character->body) hair_body_destroy(character->body);
    hair_gltf_free(&character->gltf);
    head_mesh_free(&character->mesh);
    void* const owned[] = {character->joint_nodes,    character->inverse_binds,  character->rest_inverses,
                           character->matrices,       character->nodes,          character->joints,
                           character->weights,        character->bind_positions, character->bind_normals,
                           character->rest_positions, character->scalp_joints,   character->scalp_weights,
                           character->scalp_matrices, character->clamped};
    for (size_t i = 0; i < sizeof owned / sizeof *owned; ++i) free(owned[i]);
    free(character);
}
