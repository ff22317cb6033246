// refused_calls.c - every call that needs the OpenGL context of a hair_context, each of which must
// be refused.
#include "tests/support/refused_calls.h" // before what includes OpenGL's own header
#include "tests/support/tessellated.h"

#include "lib/api/api.h"

#define refused(result) hair_test_refused(test, result, expected, words)

static void refuse_motion(struct hair_test* test, hair_instance* hair, hair_result expected,
                          const char* words)
{
    hair_desc desc = hair_desc_default();
    hair_cut_desc cut = hair_cut_desc_default();
    const float half = 0.5f;
    refused(hair_step(hair, 1.0f / 60));
    refused(hair_step_list(&hair, 1, 1.0f / 60));
    refused(hair_reset(hair));
    refused(hair_teleport(hair, desc.transform));
    refused(hair_set_lengths(hair, 0, 1, &half));
    refused(hair_cut(hair, &cut, NULL, NULL));
    // The other solvers refuse to record contacts.
    if (hair->sim.solver == HAIR_SOLVER_DIRECT || hair->sim.solver == HAIR_SOLVER_ACCURATE)
        refused(hair_record_contacts(hair, 100));
    refused(hair_set_targets_buffer(hair, 1, 0, 12, NULL));
}

void hair_test_refuse_calls(struct hair_test* test, hair_instance* hair, hair_result expected,
                            const char* words)
{
    hair_view view = hair_test_tessellated();
    hair_solver_stats stats = hair_solver_stats_default();
    hair_field_info field = hair_field_info_default();
    hair_report_info report = hair_report_info_default();
    hair_buffers buffers = hair_buffers_default();
    float positions[30] = {0};
    uint32_t count = 0;
    size_t size = 0;
    bool is_ready = false;
    refuse_motion(test, hair, expected, words);
    refused(hair_draw(hair, &view));
    refused(hair_draw_list(&hair, 1, &view));
    refused(hair_precompile(hair, &view, &is_ready));
    refused(hair_get_buffers(hair, HAIR_READ_FOLLOWERS, &buffers));
    refused(hair_read_positions(hair, HAIR_READ_GUIDES, positions, 10, &count));
    refused(hair_get_solver_stats(hair, &stats));
    refused(hair_get_field(hair, &field));
    refused(hair_report(hair, true, &report, NULL, 0, 0, &count));
    refused(hair_save(hair, NULL, 0, &size));
    refused(hair_load(hair, positions, sizeof positions));
}

void hair_test_refuse_context_calls(struct hair_test* test, hair_context* context, const hair_groom* groom,
                                    hair_result expected, const char* words)
{
    const float positions[9] = {0, 0, 0, 0.1f, 0, 0, 0, 0.1f, 0};
    const uint32_t triangle[3] = {0, 1, 2};
    hair_desc desc = hair_desc_default();
    hair_shader_desc shader_desc = hair_shader_desc_default();
    hair_body_desc body_desc = hair_body_desc_default();
    hair_instance* hair = NULL;
    hair_shader* shader = NULL;
    hair_body* body = NULL;
    char tuning[1000];
    shader_desc.glsl = "vec4 hair_shade(hair_fragment f) { return vec4(f.t); }\n";
    body_desc.positions = positions, body_desc.triangles = triangle;
    body_desc.vertex_count = 3, body_desc.triangle_count = 1;
    body_desc.upper[0] = body_desc.upper[1] = body_desc.upper[2] = 1;
    refused(hair_create(context, groom, &desc, &hair));
    refused(hair_shader_create(context, &shader_desc, &shader));
    refused(hair_body_create(context, &body_desc, &body));
    refused(hair_context_reload(context));
    refused(hair_context_tune(context, tuning, sizeof tuning));
    assert_true(!hair && !shader && !body);
}
