// feedback.c - the solver redblack by transform feedback. Every phase draws all guide vertices as
// points, from one buffer into another.
#include "lib/gl/capture.h"
#include "lib/sim/sim.h"

#define GUIDES 2 // Index of the guides' state among HAIR_FEEDBACK_STATES.

static hair_result make_owners(struct hair_sim* sim, const struct hair_guide* guides)
{
    struct hair_gl* gl = sim->gl;
    struct hair_feedback* feedback = &sim->feedback;
    uint32_t* owners = hair_alloc(&gl->host, sim->guide_vertices, sizeof *owners);
    if (!owners) return hair_fail_memory(&gl->host, "the guides of vertices");
    for (uint32_t g = 0; g < sim->guides; ++g) {
        HAIR_ASSERT(guides[g].first + guides[g].count <= sim->guide_vertices);
        for (uint32_t i = 0; i < guides[g].count; ++i) owners[guides[g].first + i] = g;
    }
    hair_result result = hair_gl_buffer(gl, HAIR_GL_CATEGORY_SOLVE, "hair owners",
                                        sim->guide_vertices * sizeof *owners, owners, &feedback->owner);
    hair_free(&gl->host, owners);
    HAIR_TRY(result);
    return hair_gl_buffer_texture(gl, "hair owners", GL_R32UI, feedback->owner, &feedback->owner_texture);
}

hair_result hair_feedback_create(struct hair_sim* sim, const struct hair_guide* guides)
{
    struct hair_gl* gl = sim->gl;
    struct hair_feedback* feedback = &sim->feedback;
    size_t size = sim->guide_vertices * sizeof(struct hair_state);
    HAIR_TRY(make_owners(sim, guides));
    gl->CreateTransformFeedbacks(HAIR_FEEDBACK_STATES, feedback->captured);
    feedback->framebuffer = hair_gl_blank_framebuffer(gl);
    bool is_whole = feedback->framebuffer != 0;
    for (int i = 0; i < HAIR_FEEDBACK_STATES; ++i) is_whole &= feedback->captured[i] != 0;
    if (!is_whole) return hair_fail(&gl->host, HAIR_ERROR_OPENGL, "the driver makes no transform feedback");
    for (int i = 0; i < HAIR_FEEDBACK_STATES; ++i) {
        if (i != GUIDES)
            HAIR_TRY(hair_gl_buffer(gl, HAIR_GL_CATEGORY_SOLVE, "hair feedback", size, NULL,
                                    &feedback->buffer[i]));
        GLuint buffer = i == GUIDES ? sim->state : feedback->buffer[i];
        HAIR_TRY(hair_gl_buffer_texture(gl, "hair feedback", GL_RGBA32F, buffer, &feedback->texture[i]));
        gl->TransformFeedbackBufferBase(feedback->captured[i], 0, buffer);
    }
    HAIR_TRY(hair_gl_buffer_texture(gl, "hair rest", GL_RGBA32F, sim->rest, &feedback->rest_texture));
    HAIR_TRY(hair_gl_buffer_texture(gl, "hair guides", GL_RGBA32UI, sim->guide, &feedback->guide_texture));
    return hair_gl_ensure_programs(gl, HAIR_GL_FEEDBACK_INTEGRATE, HAIR_GL_FEEDBACK_END, 0);
}

void hair_feedback_free(struct hair_sim* sim)
{
    struct hair_gl* gl = sim->gl;
    struct hair_feedback* feedback = &sim->feedback;
    if (!feedback->wanted) return;
    if (feedback->captured[0]) gl->DeleteTransformFeedbacks(HAIR_FEEDBACK_STATES, feedback->captured);
    if (feedback->framebuffer) gl->DeleteFramebuffers(1, &feedback->framebuffer);
    for (int i = 0; i < HAIR_FEEDBACK_STATES; ++i) hair_gl_free_buffer_texture(gl, &feedback->texture[i]);
    hair_gl_free_buffer_texture(gl, &feedback->rest_texture);
    hair_gl_free_buffer_texture(gl, &feedback->guide_texture);
    hair_gl_free_buffer_texture(gl, &feedback->owner_texture);
    hair_gl_free_buffer(gl, &feedback->buffer[0]);
    hair_gl_free_buffer(gl, &feedback->buffer[1]);
    hair_gl_free_buffer(gl, &feedback->owner);
}

// Run a phase from state *at, which the last phase wrote, into the other of the two alternating
// states. At the end of a substep, run it into the guides' state. Set *at to the state written.
static void run_phase(struct hair_sim* sim, hair_gl_pass pass, int* at)
{
    struct hair_gl* gl = sim->gl;
    int to = pass == HAIR_GL_FEEDBACK_END ? GUIDES : *at == 0;
    HAIR_ASSERT(0 <= *at && *at < HAIR_FEEDBACK_STATES && to != *at);
    hair_gl_bind_texture(gl, HAIR_UNIT_STATE, sim->feedback.texture[*at]);
    gl->BindTransformFeedback(GL_TRANSFORM_FEEDBACK, sim->feedback.captured[to]);
    hair_gl_begin(gl, pass);
    gl->BeginTransformFeedback(GL_POINTS);
    gl->DrawArrays(GL_POINTS, 0, (GLsizei)sim->guide_vertices);
    gl->EndTransformFeedback();
    hair_gl_end(gl, pass);
    *at = to;
}

static void run_substep(struct hair_sim* sim, const struct hair_step_params* params)
{
    int at = GUIDES;
    run_phase(sim, HAIR_GL_FEEDBACK_INTEGRATE, &at);
    if (params->angular > 0) run_phase(sim, HAIR_GL_FEEDBACK_ANGULAR, &at);
    for (uint32_t i = 0; i < params->iterations; ++i) {
        run_phase(sim, HAIR_GL_FEEDBACK_RED, &at);
        run_phase(sim, HAIR_GL_FEEDBACK_BLACK, &at);
        if (params->bend > 0) run_phase(sim, HAIR_GL_FEEDBACK_BEND_RED, &at);
        if (params->bend > 0) run_phase(sim, HAIR_GL_FEEDBACK_BEND_BLACK, &at);
        if (params->colliders > 0) run_phase(sim, HAIR_GL_FEEDBACK_COLLIDE, &at);
    }
    run_phase(sim, HAIR_GL_FEEDBACK_END, &at);
}

void hair_feedback_run(struct hair_sim* sim, const struct hair_step_params* params)
{
    struct hair_gl* gl = sim->gl;
    HAIR_ASSERT(sim->feedback.wanted && params->substeps <= HAIR_STEP_SUBSTEPS);
    struct hair_step_params own = *params;
    struct hair_gl_capture was;
    hair_gl_begin_capture(gl, sim->feedback.framebuffer, &was);
    hair_gl_bind_texture(gl, HAIR_UNIT_REST, sim->feedback.rest_texture);
    hair_gl_bind_texture(gl, HAIR_UNIT_GUIDE, sim->feedback.guide_texture);
    hair_gl_bind_texture(gl, HAIR_UNIT_OWNER, sim->feedback.owner_texture);
    for (uint32_t i = 0; i < params->substeps; ++i) {
        own.substep[0] = params->substep[i];
        hair_gl_write_uniform(gl, sim->step, sizeof own, &own);
        run_substep(sim, &own);
    }
    hair_gl_write_uniform(gl, sim->step, sizeof *params, params); // Other passes read it.
    hair_gl_end_capture(gl, &was);
}
