// torture_scene.c - the groom, the view, the instance and the colliders of calls that are tortured.
#include "tests/support/torture.h"

#include <string.h>

#include "tests/support/grooms.h"
#include "tests/support/meshes.h"
#include "tests/support/tessellated.h"

static hair_vec3 strand(float t, uint32_t number, const void* user)
{
    (void)user;
    hair_vec3 root = hair_v3(0.1f * (float)(number % 3 + 1), 0, 0.1f * (float)(number / 3 + 1));
    return hair_add(root, hair_v3(0.04f * t, 0.1f * t, 0.03f * t * t));
}

hair_groom* hair_test_torture_groom(struct hair_test* test)
{
    hair_groom* groom = NULL;
    float uvs[2 * 25], colors[9 * 3];
    struct hair_test_strands strands = hair_test_strands_make(9, 8);
    struct hair_test_scalp scalp = hair_test_scalp_make(4, 0.4f);
    for (uint32_t i = 0; i < 9; ++i) hair_test_strands_add(&strands, 8, strand, NULL);
    hair_groom_desc desc = hair_test_groom_desc(&test->host, &strands);
    hair_test_set_scalp(&desc, &scalp);
    assert_int_equal(scalp.vertex_count, 25);
    for (int i = 0; i < 50; ++i) uvs[i] = scalp.positions[3 * (i / 2) + 2 * (i % 2)] / 0.4f;
    for (int i = 0; i < 27; ++i) colors[i] = 0.1f + 0.03f * (float)i;
    desc.scalp_uvs = uvs;
    desc.colors = colors;
    desc.color_count = 1;
    desc.follower_count = 90;
    hair_test_ok(test, hair_groom_create(&desc, &groom));
    hair_test_strands_free(&strands);
    hair_test_scalp_free(&scalp);
    return groom;
}

hair_view hair_test_torture_view(void)
{
    hair_view view = hair_test_tessellated();
    memset(view.view, 0, sizeof view.view); // From above, with x to the right and z down.
    view.view[0] = view.view[6] = view.view[15] = 1;
    view.view[9] = -1;
    view.view[12] = -0.2f, view.view[13] = 0.2f, view.view[14] = -0.5f;
    hair_test_set_orthographic(&view, 4, -1, 0);
    return view;
}

void hair_test_torture_add(struct hair_test_torture* t, const hair_desc* desc)
{
    hair_look look = hair_look_default();
    hair_desc own = desc ? *desc : hair_desc_default();
    look.strand.segments = 6;
    look.strand.radius = 0.003f;
    if (!own.look) own.look = &look;
    hair_test_ok(t->test, hair_create(t->context, t->groom, &own, &t->hair));
}

void hair_test_torture_collide(struct hair_test_torture* t)
{
    hair_collider colliders[8];
    if (!t->mesh) t->mesh = hair_test_collision_mesh(t->test, hair_test_ball_mesh(0.05f, 6, 8), 8);
    for (int i = 0; i < 8; ++i) {
        hair_collider* c = &colliders[i];
        *c = hair_collider_default();
        c->shape = (hair_shape)i;
        c->position[0] = 0.06f * (float)i, c->position[1] = 0.06f, c->position[2] = 0.4f - 0.05f * (float)i;
        if (i == HAIR_SHAPE_PLANE) c->position[1] = -0.1f;
        if (i == HAIR_SHAPE_MESH)
            c->mesh = t->mesh;
        else if (i != HAIR_SHAPE_PLANE)
            c->size[0] = c->size[1] = c->size[2] = 0.03f;
    }
    hair_test_ok(t->test, hair_set_colliders(t->hair, colliders, 8, sizeof *colliders));
}
