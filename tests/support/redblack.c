// redblack.c - hair with a state and parameters for the solver redblack and for its reference.
#include "tests/support/redblack.h"

#include <math.h>

static hair_quat turn_about(hair_vec3 axis, float angle)
{
    axis = hair_scale(hair_normalize(axis, hair_v3(0, 1, 0)), sinf(angle / 2));
    return (hair_quat){axis.x, axis.y, axis.z, cosf(angle / 2)};
}

static hair_vec4 vec4_of_quat(hair_quat q)
{
    return (hair_vec4){q.x, q.y, q.z, q.w};
}

void hair_test_redblack_scatter(struct hair_test_redblack* f, float away, float moved)
{
    hair_test_scatter(f->scene.groom, away, moved, &f->random, f->state);
}

struct hair_test_redblack hair_test_redblack_start_with(struct hair_test* test,
                                                        struct hair_test_handmade wanted)
{
    struct hair_test_redblack f = {.scene = hair_test_scene_make(test, NULL), .random = 12345};
    hair_desc desc = hair_desc_default();
    desc.solver = HAIR_SOLVER_REDBLACK;
    hair_test_scene_add(&f.scene, &wanted, &desc);
    f.params.gravity.w = 1.0f / 120;
    f.params.substeps = 1;
    f.params.guides = f.scene.groom->info.guide_count;
    for (int i = 0; i < HAIR_STEP_SUBSTEPS; ++i)
        f.params.substep[i] =
            (struct hair_substep){{0, 0, 0, 1}, {0, 0, 0, (float)(i + 1) / HAIR_STEP_SUBSTEPS}};
    hair_test_redblack_scatter(&f, 0.2f * wanted.segment, 0.1f * wanted.segment);
    return f;
}

struct hair_test_redblack hair_test_redblack_start(struct hair_test* test, uint32_t max)
{
    struct hair_test_handmade wanted = hair_test_handmade_default();
    wanted.guides = max - 1, wanted.fewest = 2, wanted.max = max;
    return hair_test_redblack_start_with(test, wanted);
}

void hair_test_redblack_move_head(struct hair_test_redblack* f)
{
    for (int i = 0; i < HAIR_STEP_SUBSTEPS; ++i) {
        float fraction = (float)(i + 1) / 5;
        f->params.substep[i] = (struct hair_substep){
            vec4_of_quat(turn_about(hair_v3(1, 2, 3), 0.2f * fraction)), {0.005f, -0.002f, 0.003f, fraction}};
    }
}

void hair_test_redblack_add_colliders(struct hair_test_redblack* f)
{
    f->params.collision_margin = 0.001f;
    f->params.colliders = 3;
    f->params.collider[0] = (struct hair_capsule){.start = {{0, 0, 0, 0.09f}, {0, 0, 0, 0.09f}},
                                                  .end = {{0, 0, 0, 0.09f}, {0, 0, 0, 0.09f}}};
    f->params.collider[1] =
        (struct hair_capsule){.start = {{-0.2f, 0.2f, 0, 0.05f}, {0.2f, 0.25f, 0, 0.05f}},
                              .end = {{-0.2f, 0.25f, 0.01f, 0.05f}, {0.2f, 0.22f, 0.03f, 0.05f}}};
    f->params.collider[2] =
        (struct hair_capsule){.start = {{0.1f, 0.3f, 0.1f, 0.04f}, {0.1f, 0.3f, 0.1f, 0.04f}},
                              .end = {{0.1f, 0.28f, 0.08f, 0.04f}, {0.1f, 0.28f, 0.08f, 0.04f}}};
}

void hair_test_redblack_switch_on(struct hair_test_redblack* f)
{
    f->params.gravity = (hair_vec4){0.5f, -9.81f, -0.25f, 1.0f / 120};
    f->params.keep = 0.97f;
    f->params.shape_frequency_root = 25;
    f->params.shape_frequency_tip = 3;
    f->params.angular = 150;
    f->params.bend = 0.1f;
    f->params.iterations = 20;
    hair_test_redblack_move_head(f);
    hair_test_redblack_add_colliders(f);
}

double hair_test_redblack_tolerance(const struct hair_test_redblack* f)
{
    const struct hair_step_params* params = &f->params;

    double substep = 4 + (params->angular > 0 ? 4 : 0);
    double iteration = (params->bend > 0 ? 4 : 2) + 2 * params->colliders;
    return 2 * 6 * sqrt(params->substeps * (substep + params->iterations * iteration)) / 16777216;
}

void hair_test_redblack_run_pass(struct hair_test_redblack* f, hair_gl_pass pass)
{
    struct hair_gl* gl = &f->scene.test->context->gl;
    size_t size = f->scene.groom->info.guide_vertex_count * sizeof *f->state;
    hair_test_ok(f->scene.test, hair_gl_ensure_program(gl, pass));
    // One driver loses data that is written to a buffer while a dispatch writes the buffer.
    glFinish();
    glNamedBufferSubData(f->scene.hair->sim.state, 0, (GLsizeiptr)size, f->state);
    glNamedBufferSubData(f->scene.hair->sim.step, 0, sizeof f->params, &f->params);
    hair_gl_enter(gl);
    hair_sim_bind(&f->scene.hair->sim);
    hair_gl_run(gl, pass, f->params.guides);
    hair_gl_leave(gl);
    glGetNamedBufferSubData(f->scene.hair->sim.state, 0, (GLsizeiptr)size, f->state);
}

void hair_test_redblack_run(struct hair_test_redblack* f)
{
    hair_test_redblack_run_pass(f, hair_gl_pass_for(HAIR_GL_REDBLACK, f->scene.groom->max_vertices));
}

static double largest(const hair_vec4* a, const double* b)
{
    double x = fabs(a->x - b[0]), y = fabs(a->y - b[1]), z = fabs(a->z - b[2]);
    return x + y + z == x + y + z ? fmax(x, fmax(y, z)) : INFINITY;
}

struct hair_reference_vertex hair_test_redblack_vertex(const struct hair_state* state)
{
    hair_vec4 p = state->position, d = state->displacement;
    return (struct hair_reference_vertex){{p.x, p.y, p.z}, {d.x, d.y, d.z}};
}

void hair_test_redblack_compare(struct hair_test_redblack* f, const char* what)
{
    static struct hair_reference_vertex expected[HAIR_TEST_REDBLACK_STATES];
    uint32_t vertices = f->scene.groom->info.guide_vertex_count;
    double limit = hair_test_redblack_tolerance(f), worst = 0, moved = 0;
    for (uint32_t i = 0; i < vertices; ++i) expected[i] = hair_test_redblack_vertex(&f->state[i]);
    for (uint32_t g = 0; g < f->params.guides; ++g) {
        const struct hair_guide* guide = &f->scene.groom->guides[g];
        hair_reference_redblack(
            (struct hair_reference_guide){guide, f->scene.groom->rest + guide->first, &f->params},
            expected + guide->first);
    }
    for (uint32_t i = 0; i < vertices; ++i)
        moved = fmax(moved, largest(&f->state[i].position, expected[i].position));
    hair_test_redblack_run(f);
    for (uint32_t i = 0; i < vertices; ++i) {
        double error = fmax(largest(&f->state[i].position, expected[i].position),
                            largest(&f->state[i].displacement, expected[i].displacement));
        worst = fmax(worst, error);
        if (!(error <= limit)) {
            print_message("    %s: vertex %u\n", what, i);
            hair_test_near("x", i, f->state[i].position.x, expected[i].position[0], limit);
            hair_test_near("y", i, f->state[i].position.y, expected[i].position[1], limit);
            hair_test_near("z", i, f->state[i].position.z, expected[i].position[2], limit);
            fail_msg("its displacement is wrong by %g", error);
        }
    }
    print_message("    %s: moved up to %.2g m, off by up to %.2g m of %.2g m\n", what, moved, worst, limit);
}
