// hair_body_input_test.c - bodies refuse hostile inputs by a sentence. Refused memory leaves
// nothing behind, and the state of the application is kept.
#include "tests/support/deforming.h"
#include "tests/support/glstate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"

static void state_of_the_application_is_kept(void** state)
{
    static struct hair_test_glstate before, after;
    struct hair_test* test = *state;
    struct hair_test_mesh mesh = hair_test_lump(12, 16, 0, 0), next = hair_test_lump(12, 16, 1, 0);
    GLuint buffer;
    hair_egl* egl = NULL;
    hair_context *context = NULL, *own = test->context;
    hair_context_desc desc = hair_context_desc_default();
    desc.host = &test->host.host;
    desc.get_proc = hair_egl_get_proc;
    hair_test_ok(test, hair_egl_create(&test->host.host, -1, &egl));
    hair_test_ok(test, hair_context_create(&desc, &context));
    test->context = context;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, (GLsizeiptr)(12 * (size_t)next.vertex_count), next.positions, 0);
    hair_test_glstate_disturb();
    while (glGetError()) {}
    hair_test_glstate_read(&before);
    hair_body* body = hair_test_deforming(test, &mesh, 0.16f, 16);
    hair_test_deform(test, body, &next);
    hair_test_ok(test, hair_body_set_position_buffer(body, buffer, 0, 12));
    hair_body_destroy(body);
    hair_test_glstate_read(&after);
    size_t wrong = hair_test_glstate_differ(&before, &after, 0);
    if (wrong < before.count) fail_msg("%s has changed", before.values[wrong].name);
    assert_int_equal(glGetError(), GL_NO_ERROR);
    hair_context_destroy(context);
    hair_egl_destroy(egl);
    hair_egl_make_current(test->egl);
    test->context = own;
    hair_test_mesh_free(&mesh);
    hair_test_mesh_free(&next);
}

// Refuse every allocation in turn.
static void refused_memory_leaves_nothing(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_mesh mesh = hair_test_lump(12, 16, 0, 0);
    hair_body_desc desc = hair_test_body_desc(&mesh, 0.16f, 16);
    hair_body* body = hair_test_deforming(test, &mesh, 0.16f, 16);
    hair_body_destroy(body); // The context keeps the passes of the first body.
    body = NULL;
    uint32_t refused = 0, objects = hair_test_count_objects();
    size_t bytes = test->host.live;
    for (;; ++refused) {
        test->host.refuse = test->host.allocations + 1 + refused;
        hair_result result = hair_body_create(test->context, &desc, &body);
        test->host.refuse = 0;
        if (result == HAIR_OK) break;
        hair_test_refused(test, result, HAIR_ERROR_MEMORY, "out of memory for");
        assert_null(body);
        assert_int_equal(test->host.live, bytes);
        assert_int_equal(hair_test_count_objects(), objects);
    }
    assert_true(refused > 5);
    hair_body_destroy(body);
    assert_int_equal(hair_test_count_objects(), objects);
    hair_test_mesh_free(&mesh);
}

static void refused(struct hair_test* test, const hair_body_desc* desc, const char* words)
{
    hair_body* body = NULL;
    hair_test_refused(test, hair_body_create(test->context, desc, &body), HAIR_ERROR_ARGUMENT, words);
    assert_null(body);
}

static void hostile_inputs_are_refused_by_a_sentence(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_mesh mesh = hair_test_lump(12, 16, 0, 0);
    hair_body_desc good = hair_test_body_desc(&mesh, 0.16f, 16), desc = good;
    desc.positions = NULL;
    refused(test, &desc, "hair_body_desc.positions is NULL");
    desc = good, desc.triangles = NULL;
    refused(test, &desc, "hair_body_desc.triangles is NULL");
    desc = good, desc.triangle_count = 262145;
    refused(test, &desc, "hair_body_desc.triangle_count is 262145, not in [1, 262144]");
    desc = good, desc.upper[1] = desc.lower[1];
    refused(test, &desc, "hair_body_desc.upper[1] is -0.16, not above lower[1], which is -0.16");
    desc = good, desc.lower[0] = 1000, desc.upper[0] = 1000.0001f;
    desc.lower[1] = desc.lower[2] = 0, desc.upper[1] = desc.upper[2] = 1e-4f;
    refused(test, &desc, "too small for voxels of");
    desc = good, desc.upper[2] = 0.02f;
    refused(test, &desc, "outside the box of its hair_body_desc from (-0.16, -0.16, -0.16) to");
    uint32_t index = mesh.triangles[4];
    mesh.triangles[4] = mesh.vertex_count;
    refused(test, &good, "hair_body_desc.triangles[4] is ");
    mesh.triangles[4] = index;
    float was = mesh.positions[7];
    mesh.positions[7] = NAN;
    refused(test, &good, "hair_body: vertex 2 is at (");
    mesh.positions[7] = was;

    hair_body* body = hair_test_deforming(test, &mesh, 0.16f, 16);
    float* before = hair_test_body_nodes(body);
    struct {
        const float* positions;
        uint32_t count;
        size_t stride;
        const char* words;
    } bad[] = {
        {NULL, mesh.vertex_count, 12, "hair_body: positions is NULL"},
        {mesh.positions, 3, 12, "hair_body: count is 3, not the "},
        {mesh.positions, mesh.vertex_count, 13, "hair_body: stride is 13, not a multiple of 4 in [12, 4096]"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i)
        hair_test_refused(test, hair_body_set_positions(body, bad[i].positions, bad[i].count, bad[i].stride),
                          HAIR_ERROR_ARGUMENT, bad[i].words);
    mesh.positions[7] = NAN;
    hair_test_refused(test, hair_body_set_positions(body, mesh.positions, mesh.vertex_count, 12),
                      HAIR_ERROR_ARGUMENT, "hair_body: vertex 2 is at (");
    mesh.positions[7] = was;
    float* after = hair_test_body_nodes(body);
    const uint32_t* size = body->mesh->size;
    assert_memory_equal(after, before, (size_t)size[0] * size[1] * size[2] * sizeof *after);
    free(before), free(after);
    hair_body_destroy(body);
    hair_test_mesh_free(&mesh);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(state_of_the_application_is_kept),
        HAIR_TEST(refused_memory_leaves_nothing),
        HAIR_TEST(hostile_inputs_are_refused_by_a_sentence),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
