// variant.c - passes of a view, in the variants that its plan and the look need.
#include "lib/draw/draw.h"

// Features of shading, for views that shade vertices in a separate pass.
#define SHADE_FEATURES                                                                                       \
    (HAIR_GL_WITH(FIBRES) | HAIR_GL_WITH(ROOT_UV) | HAIR_GL_WITH(GROOM_COLORS) | HAIR_GL_WITH(OPAQUE_SHADOWS))

static hair_gl_pass find_features(const struct hair_renderer* renderer, const struct hair_draw_plan* plan)
{
    const hair_view* view = plan->view;
    const hair_look* look = &renderer->geometry->look;
    hair_gl_pass features = 0;
    if (view->pass == HAIR_PASS_DEPTH || view->pass == HAIR_PASS_OPACITY) features |= HAIR_GL_WITH(DEPTH);
    if (view->pass == HAIR_PASS_ID) features |= HAIR_GL_WITH(IDS);
    if (hair_draw_has_motion(view)) features |= HAIR_GL_WITH(MOTION);
    if (plan->has_motion_output) features |= HAIR_GL_WITH(MOTION_OUTPUT);
    if (view->pass == HAIR_PASS_COLOR && look->shading.model == HAIR_SHADING_FIBRES)
        features |= HAIR_GL_WITH(FIBRES);
    if (plan->blending)
        features |= HAIR_GL_WITH(ALPHA_COVERAGE);
    else if (view->primitive == HAIR_PRIMITIVE_LINES)
        features |= HAIR_GL_WITH(LINES);
    if (view->lod) features |= HAIR_GL_WITH(WIDENED);
    if (plan->is_of_batch) features |= HAIR_GL_WITH(BATCH);
    if (hair_lighting_is_blocked(view)) features |= HAIR_GL_WITH(OPAQUE_SHADOWS);
    if (plan->has_root_uvs) features |= HAIR_GL_WITH(ROOT_UV);
    if (plan->is_painted) features |= HAIR_GL_WITH(GROOM_COLORS);
    if (hair_look_is_styled(look)) features |= HAIR_GL_WITH(STYLED);
    if (hair_geometry_has_lengths(renderer->geometry)) features |= HAIR_GL_WITH(LENGTHS);
    if (renderer->geometry->groups.factors) features |= HAIR_GL_WITH(GROUP_LOOKS);
    if (renderer->geometry->factors.texture) features |= HAIR_GL_WITH(STRAND_FACTORS);
    return features;
}

// Return the row of the pass that shades or writes vertices before they are drawn, or -1.
static int find_shade_row(const struct hair_draw_plan* plan)
{
    const hair_view* view = plan->view;
    bool shades_pixels = plan->shader && plan->shader->pixels;
    if (plan->vertices == HAIR_VERTICES_PER_VIEW)
        return plan->has_sides ? HAIR_GL_EXPAND_VIEW_SIDES : HAIR_GL_EXPAND_VIEW;
    if (plan->vertices == HAIR_VERTICES_CACHED && view->pass == HAIR_PASS_COLOR && !view->lod &&
        !shades_pixels)
        return HAIR_GL_SHADE;
    return -1;
}

static hair_gl_pass find_draw_row(const struct hair_draw_plan* plan)
{
    if (plan->is_computed) return HAIR_GL_RESOLVE_TILES;
    switch (plan->vertices) {
    case HAIR_VERTICES_TESSELLATED: return HAIR_GL_TESSELLATED;
    case HAIR_VERTICES_PROCEDURAL: return HAIR_GL_PROCEDURAL;
    case HAIR_VERTICES_PER_VIEW: return HAIR_GL_VIEW_CACHED;
    default: return plan->is_paired ? HAIR_GL_CACHED_PAIRED : HAIR_GL_CACHED;
    }
}

// Add all rows from `first` to `last`, each with the features that it supports.
static void add_rows(struct hair_draw_plan* plan, hair_gl_pass first, hair_gl_pass last,
                     hair_gl_pass features)
{
    for (hair_gl_pass row = first; row <= last; ++row) {
        HAIR_ASSERT(plan->pass_count < HAIR_DRAW_MAX_PASSES);
        plan->pass[plan->pass_count++] = hair_gl_add_features(row, features);
    }
}

void hair_draw_find_passes(const struct hair_renderer* renderer, hair_gl_pass state,
                           struct hair_draw_plan* plan)
{
    hair_gl_pass features = find_features(renderer, plan) | state, row = find_draw_row(plan);
    int shade_row = find_shade_row(plan);
    plan->pass_count = 0;
    plan->features = features;
    if (state & HAIR_GL_WITH(OCCLUSION))
        add_rows(plan, HAIR_GL_HIZ_REDUCE_DEPTH, HAIR_GL_CULL_PATCHES, features);
    if (plan->vertices == HAIR_VERTICES_CACHED || plan->light_values)
        add_rows(plan, HAIR_GL_EXPAND, HAIR_GL_EXPAND, features);
    if (plan->light_values && plan->view->lod)
        add_rows(plan, HAIR_GL_EXPAND_DRAWN, HAIR_GL_EXPAND_DRAWN, features);
    if (plan->light_values) add_rows(plan, HAIR_GL_DENSITY_CLEAR, HAIR_GL_VERTEX_TRANSMITTANCE, features);
    if (plan->light_values && plan->view->lod)
        add_rows(plan, HAIR_GL_VERTEX_TRANSMITTANCE_DRAWN, HAIR_GL_VERTEX_TRANSMITTANCE_DRAWN, features);
    if (plan->has_strand_list) add_rows(plan, HAIR_GL_SCAN_STRANDS, HAIR_GL_COMPACT_STRANDS, features);
    if (shade_row >= 0) add_rows(plan, (hair_gl_pass)shade_row, (hair_gl_pass)shade_row, features);
    plan->shade = shade_row >= 0 ? plan->pass[plan->pass_count - 1] : 0;
    if (plan->is_computed) add_rows(plan, HAIR_GL_RASTER_CLEAR, HAIR_GL_COMPOSE_TILES, features);
    if (plan->blending == HAIR_BLENDING_SORTED) add_rows(plan, HAIR_GL_HISTOGRAM, HAIR_GL_SCATTER, features);
    if (shade_row == HAIR_GL_SHADE) features = (features & ~SHADE_FEATURES) | HAIR_GL_WITH(SHADED);
    add_rows(plan, row, row, features);
    plan->draw = plan->pass[plan->pass_count - 1];
}

hair_result hair_draw_compile(struct hair_renderer* renderer, struct hair_draw_plan* plan)
{
    struct hair_gl* gl = renderer->gl;
    // The application's shader runs here.
    hair_gl_pass shaded = plan->shade ? plan->shade : plan->draw;
    for (uint32_t i = 0; i < plan->pass_count; ++i) {
        hair_gl_pass pass = plan->pass[i];
        GLuint program = 0;
        if (plan->shader && pass == shaded) {
            HAIR_TRY(hair_gl_ensure_user_program(gl, plan->shader, pass, &program));
        } else {
            HAIR_TRY(hair_gl_ensure_program(gl, pass));
            program = hair_gl_find(gl, pass)->program;
        }
        if (pass == plan->draw) plan->draw_program = program;
        if (pass == plan->shade) plan->shade_program = program;
    }
    return HAIR_OK;
}

// Compile the passes for a state of the hair, with and without occlusion culling. Only the draw
// knows whether the depth function and the window of the hair allow culling.
static hair_result compile_state(struct hair_renderer* renderer, hair_gl_pass state,
                                 struct hair_draw_plan* plan)
{
    if (hair_draw_uses_occlusion(plan->view)) {
        hair_draw_find_passes(renderer, state | HAIR_GL_WITH(OCCLUSION), plan);
        HAIR_TRY(hair_draw_compile(renderer, plan));
    }
    // Lists may draw the view in a batch.
    plan->is_of_batch = hair_batch_accepts(plan);
    for (int i = plan->is_of_batch; i >= 0; --i) {
        plan->is_of_batch = i > 0;
        hair_draw_find_passes(renderer, state, plan);
        HAIR_TRY(hair_draw_compile(renderer, plan));
    }
    return HAIR_OK;
}

hair_result hair_draw_precompile(struct hair_renderer* renderer, struct hair_draw_plan* plan,
                                 bool may_collide)
{
    bool hits = renderer->geometry->look.followers.collision != HAIR_FOLLOWER_COLLISION_NONE;
    HAIR_TRY(compile_state(renderer, 0, plan));
    if (!may_collide) return HAIR_OK;
    // Colliders block light also where followers pass through them, and where a level of detail
    // shows no displacement of followers.
    if (plan->view->lod || !hits) HAIR_TRY(compile_state(renderer, HAIR_GL_WITH(COLLIDERS), plan));
    if (!hits) return HAIR_OK;
    HAIR_TRY(hair_geometry_ensure_hit_programs(renderer->geometry));
    return compile_state(renderer, HAIR_GL_WITH(HITS) | HAIR_GL_WITH(COLLIDERS), plan);
}
