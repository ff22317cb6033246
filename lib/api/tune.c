// tune.c - public calls that measure the fastest render paths of a driver, and take those of an
// earlier measurement.
#include <hair/hair_instance.h>
#include <math.h>
#include <string.h>

#include "lib/api/api.h"

#define GUIDES 24u
#define VERTICES 12u
#define MIN_FOLLOWERS 1024u
#define MAX_FOLLOWERS 65536u
#define SEGMENTS 16u
#define SAMPLES 4
#define SIZE 512 // Pixels of a side.
#define SOFTWARE_SIZE 256
#define DURATION 500.0 // Time of all measurements, ms.
#define MIN_MS 16.0 // Time that a draw is to take, if there are enough strands, ms.
#define MIN_ROUNDS 2
#define GAIN 0.95 // Fraction of the time of the path before that a better path takes at most.
#define PATHS ((int)HAIR_RENDER_PATH_PROCEDURAL + 1)
#define AWAY 4.0f // Distance of views with level of detail, as a multiple of that of others.

// State of the application that would change what is measured.
static const GLenum capabilities[] = {GL_BLEND,       GL_SCISSOR_TEST,       GL_STENCIL_TEST, GL_DEPTH_TEST,
                                      GL_DEPTH_CLAMP, GL_RASTERIZER_DISCARD, GL_MULTISAMPLE};
#define CAPABILITIES (sizeof capabilities / sizeof *capabilities)

struct state {
    GLint framebuffer;
    GLfloat viewport[4];
    GLboolean depth_mask, is_on[CAPABILITIES];
};

struct tuner {
    hair_context* context;
    hair_groom* groom;
    hair_instance* hair;
    uint32_t followers;
    GLuint color, depth, framebuffer;
    GLsizei size;
    struct state was;
};

// The target --------------------------------------------------------------------------------------

// Depth clamp and the like have no index. Those with an index are set for the first viewport or
// buffer only.
static bool has_index(GLenum capability)
{
    return capability == GL_BLEND || capability == GL_SCISSOR_TEST;
}

static void set_capability(const struct hair_gl* gl, GLenum capability, bool is_on)
{
    if (has_index(capability))
        (is_on ? gl->Enablei : gl->Disablei)(capability, 0);
    else
        (is_on ? gl->Enable : gl->Disable)(capability);
}

static void begin_state(struct tuner* tuner)
{
    const struct hair_gl* gl = &tuner->context->gl;
    struct state* was = &tuner->was;
    gl->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &was->framebuffer);
    gl->GetFloati_v(GL_VIEWPORT, 0, was->viewport);
    gl->GetBooleanv(GL_DEPTH_WRITEMASK, &was->depth_mask);
    for (size_t i = 0; i < CAPABILITIES; ++i) {
        GLenum capability = capabilities[i];
        was->is_on[i] = has_index(capability) ? gl->IsEnabledi(capability, 0) : gl->IsEnabled(capability);
        set_capability(gl, capability, capability == GL_DEPTH_TEST || capability == GL_MULTISAMPLE);
    }
    gl->DepthMask(GL_TRUE);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, tuner->framebuffer);
    gl->ViewportIndexedf(0, 0, 0, (GLfloat)tuner->size, (GLfloat)tuner->size);
}

static void end_state(const struct tuner* tuner)
{
    const struct hair_gl* gl = &tuner->context->gl;
    const struct state* was = &tuner->was;
    for (size_t i = 0; i < CAPABILITIES; ++i) set_capability(gl, capabilities[i], was->is_on[i]);
    gl->DepthMask(was->depth_mask);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, (GLuint)was->framebuffer);
    gl->ViewportIndexedf(0, was->viewport[0], was->viewport[1], was->viewport[2], was->viewport[3]);
}

static hair_result make_target(struct tuner* tuner)
{
    struct hair_gl* gl = &tuner->context->gl;
    tuner->size = gl->software ? SOFTWARE_SIZE : SIZE;
    gl->CreateTextures(GL_TEXTURE_2D_MULTISAMPLE, 1, &tuner->color);
    gl->CreateTextures(GL_TEXTURE_2D_MULTISAMPLE, 1, &tuner->depth);
    gl->CreateFramebuffers(1, &tuner->framebuffer);
    if (!tuner->color || !tuner->depth || !tuner->framebuffer)
        return hair_fail(&gl->host, HAIR_ERROR_OPENGL, "the driver makes no target for hair_context_tune()");
    gl->TextureStorage2DMultisample(tuner->color, SAMPLES, GL_RGBA8, tuner->size, tuner->size, GL_TRUE);
    gl->TextureStorage2DMultisample(tuner->depth, SAMPLES, GL_DEPTH_COMPONENT32F, tuner->size, tuner->size,
                                    GL_TRUE);
    gl->NamedFramebufferTexture(tuner->framebuffer, GL_COLOR_ATTACHMENT0, tuner->color, 0);
    gl->NamedFramebufferTexture(tuner->framebuffer, GL_DEPTH_ATTACHMENT, tuner->depth, 0);
    if (gl->CheckNamedFramebufferStatus(tuner->framebuffer, GL_DRAW_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE)
        return HAIR_OK;
    return hair_fail(&gl->host, HAIR_ERROR_MEMORY, "the driver has no memory for hair_context_tune()");
}

static void free_target(const struct tuner* tuner)
{
    const struct hair_gl* gl = &tuner->context->gl;
    if (tuner->framebuffer) gl->DeleteFramebuffers(1, &tuner->framebuffer);
    if (tuner->color) gl->DeleteTextures(1, &tuner->color);
    if (tuner->depth) gl->DeleteTextures(1, &tuner->depth);
}

// The hair ----------------------------------------------------------------------------------------

// Make strands that leave a skull of 0.1 m and fall by up to 0.25 m.
static hair_result make_groom(struct tuner* tuner)
{
    float positions[3 * GUIDES * VERTICES];
    uint32_t vertices[GUIDES];
    for (uint32_t i = 0; i < GUIDES; ++i) {
        float angle = 2.399963f * (float)i, up = 1 - ((float)i + 0.5f) / (float)GUIDES;
        float beside = sqrtf(1 - up * up);
        vertices[i] = VERTICES;
        for (uint32_t k = 0; k < VERTICES; ++k) {
            float* at = positions + 3 * (i * VERTICES + k);
            float t = (float)k / (VERTICES - 1), out = 0.1f * beside + 0.06f * t;
            at[0] = out * cosf(angle), at[2] = out * sinf(angle);
            at[1] = 0.1f * up - 0.25f * t * t + 0.02f * t;
        }
    }
    hair_groom_desc desc = hair_groom_desc_default();
    desc.host = &tuner->context->host;
    desc.positions = positions;
    desc.strand_vertices = vertices;
    desc.strand_count = GUIDES;
    desc.strand_set = HAIR_STRAND_SET_GUIDES;
    desc.guide_vertices = VERTICES;
    desc.follower_count = tuner->followers;
    return hair_groom_create(&desc, &tuner->groom);
}

static hair_result make_hair(struct tuner* tuner)
{
    hair_desc desc = hair_desc_default();
    hair_physics physics = hair_physics_default();
    physics.sleep_threshold = 0; // Hair at rest would keep its cached vertices.
    hair_look look = hair_look_default();
    look.strand.segments = SEGMENTS;
    desc.physics = &physics;
    desc.look = &look;
    desc.label = "hair of hair_context_tune()";
    HAIR_TRY(make_groom(tuner));
    return hair_create(tuner->context, tuner->groom, &desc, &tuner->hair);
}

static void free_tuned(struct tuner* tuner)
{
    hair_destroy(tuner->hair);
    hair_groom_destroy(tuner->groom);
    tuner->hair = NULL;
    tuner->groom = NULL;
}

static hair_view view_of(enum hair_path_use use, hair_render_path path, const hair_lod* lod)
{
    bool has_lod = use == HAIR_USE_LOD_RIBBONS || use == HAIR_USE_LOD_LINES;
    hair_view view = hair_view_default();
    view.render_path = path;
    view.pass = use == HAIR_USE_DEPTH ? HAIR_PASS_DEPTH : HAIR_PASS_COLOR;
    if (use == HAIR_USE_LINES || use == HAIR_USE_LOD_LINES) view.primitive = HAIR_PRIMITIVE_LINES;
    if (has_lod) view.lod = lod;
    view.view[14] = has_lod ? -AWAY : -1;
    view.view[13] = 0.1f;
    view.projection[0] = view.projection[5] = 4;
    view.projection[10] = view.projection[11] = -1;
    view.projection[14] = -0.02f;
    view.projection[15] = 0;
    return view;
}

// Measurement -------------------------------------------------------------------------------------

static void wait(const struct hair_gl* gl)
{
    GLsync fence = gl->FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    while (gl->ClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, 1000000000u) == GL_TIMEOUT_EXPIRED)
        ;
    gl->DeleteSync(fence);
}

// Measure a draw of hair that has moved. Views of depth follow one of colour, as in a frame.
static hair_result measure(struct tuner* tuner, enum hair_path_use use, hair_render_path path, double* ms)
{
    const struct hair_gl* gl = &tuner->context->gl;
    static const GLfloat far_away = 1;
    hair_lod lod = hair_lod_default();
    hair_view view = view_of(use, path, &lod),
              before = view_of(HAIR_USE_RIBBONS, HAIR_RENDER_PATH_AUTO, NULL);
    HAIR_TRY(hair_step(tuner->hair, 1.0f / 60));
    if (use == HAIR_USE_DEPTH) HAIR_TRY(hair_draw(tuner->hair, &before));
    gl->ClearTexImage(tuner->color, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    gl->ClearTexImage(tuner->depth, 0, GL_DEPTH_COMPONENT, GL_FLOAT, &far_away);
    wait(gl);
    double start = hair_gl_now();
    HAIR_TRY(hair_draw(tuner->hair, &view));
    wait(gl);
    *ms = hair_gl_now() - start;
    return HAIR_OK;
}

// Make hair of so many strands that a draw takes long enough to be measured. The cache has the
// vertices of all strands, so fewer strands of a groom would not do.
static hair_result find_load(struct tuner* tuner)
{
    double ms = 0;
    for (tuner->followers = MIN_FOLLOWERS;; tuner->followers *= 4) {
        HAIR_TRY(make_hair(tuner));
        for (int i = 0; i < 2; ++i) // The first draw compiles programs.
            HAIR_TRY(measure(tuner, HAIR_USE_RIBBONS, HAIR_RENDER_PATH_TESSELLATION, &ms));
        if (ms >= MIN_MS || tuner->followers >= MAX_FOLLOWERS) return HAIR_OK;
        free_tuned(tuner);
    }
}

// Find the fastest path of a use. Paths take turns, so that a slowdown of the machine affects all
// of them. The path of before stays unless another is clearly faster.
static hair_result find_path(struct tuner* tuner, enum hair_path_use use)
{
    double best[PATHS], ms = 0;
    uint8_t* path = &tuner->context->fastest.path[use];
    double start = 0;
    for (int i = 0; i < PATHS; ++i) best[i] = INFINITY;
    // The first round compiles programs.
    for (int round = -1; round < MIN_ROUNDS || hair_gl_now() - start < DURATION / HAIR_PATH_USES; ++round) {
        if (round == 0) start = hair_gl_now();
        for (int i = 0; i < PATHS; ++i) {
            if (!hair_fastest_allows(use, (hair_render_path)i)) continue;
            HAIR_TRY(measure(tuner, use, (hair_render_path)i, &ms));
            if (round >= 0) best[i] = fmin(best[i], ms);
        }
    }
    double limit = GAIN * best[*path];
    for (int i = 0; i < PATHS; ++i)
        if (best[i] < limit) *path = (uint8_t)i, limit = best[i];
    return HAIR_OK;
}

static hair_result find_paths(struct tuner* tuner)
{
    HAIR_TRY(find_load(tuner));
    for (int use = 0; use < HAIR_PATH_USES; ++use) HAIR_TRY(find_path(tuner, (enum hair_path_use)use));
    return HAIR_OK;
}

hair_result hair_context_tune(hair_context* context, char* out, size_t capacity)
{
    HAIR_TRY(hair_check_context(context));
    const hair_host* host = &context->host;
    if (!out) return hair_fail(host, HAIR_ERROR_ARGUMENT, "out is NULL");
    if (capacity < HAIR_TUNING_SIZE)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "capacity is %zu, less than HAIR_TUNING_SIZE, %d",
                         capacity, HAIR_TUNING_SIZE);
    HAIR_TRY(hair_check_current(context));
    struct tuner tuner = {.context = context};
    struct hair_fastest was = context->fastest;
    hair_gl_state policy = context->gl.state_policy;
    context->gl.state_policy = HAIR_GL_STATE_RESTORE;
    hair_result result = make_target(&tuner);
    if (!result) {
        begin_state(&tuner);
        result = find_paths(&tuner);
        end_state(&tuner);
    }
    free_tuned(&tuner);
    free_target(&tuner);
    context->gl.state_policy = policy;
    if (result)
        context->fastest = was;
    else
        hair_fastest_write(&context->gl, &context->fastest, out, capacity);
    return hair_check_lost(context, result);
}

hair_result hair_context_set_tuning(hair_context* context, const char* tuning)
{
    HAIR_TRY(hair_check_context(context));
    HAIR_TRY(hair_check_current(context));
    if (tuning) return hair_fastest_read(&context->gl, tuning, &context->fastest);
    hair_fastest_find(&context->gl, &context->fastest);
    return HAIR_OK;
}
