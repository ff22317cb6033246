// head_rig.c - Meshes and colliders of a scene, which move with the head or stay on the shoulders.
#include "tools/common/head_rig.h"

#include <cglm/cglm.h>

#include <stdlib.h>
#include <string.h>

#define COLUMNS 96u
#define ROWS 48u
#define BREATH_TIME 4.0f // s, of a breath

static void place(float radius, struct head_mesh* mesh)
{
    static const float dark[3] = {0.05f, 0.035f, 0.03f}, matte[3] = {1, 0.4f, 1};
    for (uint32_t i = 0; i < mesh->vertex_count; ++i) {
        float polar = GLM_PIf * (float)(i / (COLUMNS + 1)) / (float)ROWS;
        float turn = 2 * GLM_PIf * (float)(i % (COLUMNS + 1)) / (float)COLUMNS;
        float at[3] = {sinf(polar) * sinf(turn), cosf(polar), sinf(polar) * cosf(turn)};
        for (uint32_t k = 0; k < 3; ++k) {
            mesh->normals[3 * i + k] = at[k];
            mesh->positions[3 * i + k] = radius * at[k];
            mesh->colors[3 * i + k] = dark[k];
            mesh->surface[3 * i + k] = matte[k];
        }
    }
}

static void join(struct head_mesh* mesh)
{
    uint32_t* out = mesh->triangles;
    for (uint32_t row = 0; row < ROWS; ++row)
        for (uint32_t column = 0; column < COLUMNS; ++column) {
            uint32_t a = row * (COLUMNS + 1) + column, below = a + COLUMNS + 1;
            uint32_t quad[6] = {a, below, a + 1, a + 1, below, below + 1};
            for (int k = 0; k < 6; ++k) *out++ = quad[k];
        }
}

int hair_head_rig_ball(float radius, struct head_mesh* out)
{
    struct head_mesh mesh = {.vertex_count = (COLUMNS + 1) * (ROWS + 1),
                             .triangle_count = 2 * COLUMNS * ROWS};
    size_t size = (size_t)mesh.vertex_count * 3 * sizeof(float);
    mesh.positions = malloc(size);
    mesh.normals = malloc(size);
    mesh.colors = malloc(size);
    mesh.surface = malloc(size);
    mesh.triangles = malloc(mesh.triangle_count * 3 * sizeof *mesh.triangles);
    if (!mesh.positions || !mesh.normals || !mesh.colors || !mesh.surface || !mesh.triangles) {
        head_mesh_free(&mesh);
        return -1;
    }
    place(radius, &mesh);
    join(&mesh);
    *out = mesh;
    return 0;
}

// Colliders ---------------------------------------------------------------------------------------

float hair_head_rig_breath(const struct hair_scene* scene, float time)
{
    return scene->breath * 0.5f * (1 - cosf(2 * GLM_PIf * time / BREATH_TIME));
}

static uint32_t place_meshes(const struct hair_head_meshes* meshes, const float transform[16],
                             hair_collider out[2])
{
    out[0] = out[1] = hair_collider_default();
    out[0].shape = out[1].shape = HAIR_SHAPE_MESH;
    out[0].mesh = meshes->head, out[1].mesh = meshes->body;
    hair_collider_carry(transform, 1, &out[0]);
    return 2;
}

static uint32_t place_head(const struct hair_head_meshes* meshes, const float transform[16],
                           hair_collider* out)
{
    if (meshes) return place_meshes(meshes, transform, out);
    uint32_t count = head_colliders(out, HEAD_COLLIDERS);
    for (uint32_t i = 0; i < count; ++i)
        hair_collider_carry(transform, hair_head_pose_weight(out[i].position[1]), &out[i]);
    return count;
}

uint32_t hair_head_rig_colliders(const struct hair_scene* scene, const struct hair_head_meshes* meshes,
                                 float time, const float transform[16],
                                 hair_collider out[HAIR_HEAD_RIG_COLLIDERS])
{
    uint32_t count = scene->head ? place_head(meshes, transform, out) : 0;
    if (scene->subject == HAIR_SUBJECT_FUR) {
        out[count] = hair_collider_default();
        out[count].size[0] = scene->ball_radius;
        hair_collider_carry(transform, 1, &out[count++]);
    }
    for (uint32_t i = 0; i < scene->collider_count; ++i) {
        out[count] = hair_scene_collider_at(&scene->colliders[i], time);
        if (!scene->colliders[i].stays) hair_collider_carry(transform, 1, &out[count]);
        ++count;
    }
    return count;
}
