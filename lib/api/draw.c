// draw.c - public calls that draw one instance or many.
#include "lib/api/api.h"

// Check the framebuffer. Drawing into an incomplete one would raise the application's error flag
// and draw nothing.
static hair_result check_framebuffer(const hair_instance* hair)
{
    GLenum status = hair->context->gl.CheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
    if (status == GL_FRAMEBUFFER_COMPLETE) return HAIR_OK;
    return hair_fail(&hair->context->host, HAIR_ERROR_OPENGL,
                     "%s: the bound framebuffer is not complete: status 0x%04X%s", hair->label, status,
                     status == GL_FRAMEBUFFER_UNDEFINED ? ", there is none" : "");
}

// Draw the colliders. Only a slice needs the field, and collision meshes, which shaders read from
// the field's copy.
static hair_result draw_colliders(hair_instance* hair, const hair_view* view)
{
    const struct hair_collider_list* list = hair_sim_colliders(&hair->sim);
    int needed = view->slice != HAIR_SLICE_NONE;
    for (uint32_t i = 0; i < list->count; ++i) needed |= list->collider[i].mesh != NULL;
    if (needed) HAIR_TRY(hair_update_field(hair));
    return hair_draw_colliders(&hair->renderer, &hair->field, list->collider, list->count,
                               &hair->sim.head_at_last_step, view);
}

static hair_result draw_air(hair_instance* hair, const hair_view* view)
{
    const struct hair_sim* sim = &hair->sim;
    if (!hair_sim_has_wind(sim)) return HAIR_OK;
    return hair_draw_air(&hair->renderer, &sim->wind_state, &sim->wind, hair_sim_fluid(sim), &hair->field.box,
                         &sim->head_at_last_step, view);
}

hair_result hair_update_follower_collision(hair_instance* hair)
{
    struct hair_geometry* geometry = &hair->geometry;
    const hair_look* look = &geometry->look;
    hair_choose_field_detail(hair);
    if (hair_geometry_has_follower_collision(geometry)) return HAIR_OK;
    bool is_shown = geometry->push_out_weight > 0;
    bool collides =
        is_shown && look->followers.collision != HAIR_FOLLOWER_COLLISION_NONE && geometry->followers;
    bool blocks = look->self_shadow.method == HAIR_SELF_SHADOW_STRANDS;
    hair_geometry_set_blockers(geometry, NULL);
    if (collides || blocks) HAIR_TRY(hair_update_view_field(hair));
    const struct hair_collider_field* field =
        (collides || blocks) && hair_field_is_near(&hair->field) ? &hair->field : NULL;
    if (is_shown) {
        if (!hair_sim_colliders(&hair->sim)->count) hair_geometry_free_follower_collision(geometry);
        HAIR_TRY(hair_geometry_update_follower_collision(geometry, collides ? field : NULL,
                                                         hair->sim.physics.collision.margin));
    }
    hair_geometry_set_blockers(geometry, field);
    return HAIR_OK;
}

// Tell the renderer how far strands may be from where the groom has them. Culling depends on it.
static void update_attachment(hair_instance* hair)
{
    hair_renderer_set_attachment(&hair->renderer, hair_sim_has_fixed_roots(&hair->sim),
                                 hair_sim_has_attached_strands(&hair->sim));
}

static int is_of_surroundings(const hair_view* view)
{
    return view->pass == HAIR_PASS_COLLIDERS || view->pass == HAIR_PASS_WIND;
}

// Return whether a view shows no hair and may be skipped. Velocities must be drawn in every frame.
static int is_out_of_view(const hair_instance* hair, const hair_view* view)
{
    if (is_of_surroundings(view) || hair_draw_has_motion(view)) return 0;
    return hair_sim_has_attached_strands(&hair->sim) &&
           hair_draw_is_out_of_view(&hair->renderer, hair_shown_head(hair), view);
}

// Record the request of a view. Return whether it is to be drawn.
static int is_to_be_drawn(hair_instance* hair, const struct hair_draw_plan* plan)
{
    const hair_view* view = plan->view;
    struct hair_frame_requests* requests = hair_current_requests(hair);
    if (is_of_surroundings(view) || view->pass == HAIR_PASS_GUIDES) return !is_out_of_view(hair, view);
    int kind = view->pass == HAIR_PASS_OPACITY ? 2 : view->pass == HAIR_PASS_DEPTH;
    HAIR_ASSERT(0 <= kind && kind < 3);
    int unseen = is_out_of_view(hair, view);
    ++requests->views[kind];
    requests->unseen[kind] += (uint32_t)unseen;
    requests->strand_list |= !unseen && plan->has_strand_list;
    requests->vertex_cache |= !unseen && plan->vertices == HAIR_VERTICES_CACHED;
    requests->occlusion |= !unseen && hair_draw_uses_occlusion(view);
    return !unseen && hair_geometry_shows_followers(&hair->geometry);
}

void hair_make_plan(const hair_instance* hair, const hair_view* view, struct hair_draw_plan* out)
{
    hair_draw_make_plan(&hair->renderer, view, view->shader ? &view->shader->gl : NULL, out);
}

// Draw everything but strands.
static hair_result draw_surroundings(hair_instance* hair, const hair_view* view)
{
    return view->pass == HAIR_PASS_COLLIDERS ? draw_colliders(hair, view) : draw_air(hair, view);
}

// Do everything before the pass that draws, with the context entered.
static hair_result prepare_draw(hair_instance* hair, struct hair_draw_plan* plan)
{
    const hair_view* view = plan->view;
    const struct hair_pose* head = &hair->sim.head_at_last_step;
    hair_result result = HAIR_OK;
    hair_draw_free_unused(&hair->renderer, hair->profiler.number);
    hair_geometry_ensure_guides(&hair->geometry, &hair->sim);
    hair_draw_select_lod(&hair->renderer, head, plan);
    bool is_new = view->pass != HAIR_PASS_GUIDES && !plan->keeps_vertices;
    if (is_new && hair_geometry_shows_followers(&hair->geometry))
        result = hair_update_follower_collision(hair);
    update_attachment(hair);
    if (!result) result = hair_draw_prepare(&hair->renderer, head, plan);
    if (result == HAIR_ERROR_MEMORY && is_new && hair_draw_avoid_cache(&hair->renderer, plan)) {
        hair_make_plan(hair, view, plan);
        hair_draw_select_lod(&hair->renderer, head, plan);
        result = hair_draw_prepare(&hair->renderer, head, plan);
    }
    return result;
}

static hair_result check_view(hair_instance* hair, const hair_view* view, struct hair_view_copy* own)
{
    HAIR_TRY(hair_copy_view(hair, view, own));
    HAIR_TRY(hair_check_current(hair->context));
    hair_gl_read_draw_state(&hair->context->gl);
    hair_budget_update(&hair->context->gl, &hair->context->budget);
    hair_reduce_view(hair, own);
    hair_result result = hair_check_view_textures(hair, &own->view);
    if (!result) result = check_framebuffer(hair);
    return result ? hair_check_lost(hair->context, result) : HAIR_OK;
}

// Let plans of instances with pending time draw the vertices of an earlier frame. Step those that
// cannot, which changes their plans. Return the first failure.
static hair_result settle(hair_instance* const* list, struct hair_draw_plan* plans, uint32_t count)
{
    hair_instance* late[HAIR_GL_STREAMS];
    const hair_view* view = plans[0].view;
    uint32_t late_count = 0;
    HAIR_ASSERT(0 < count && count <= HAIR_GL_STREAMS);
    if (is_of_surroundings(view)) return HAIR_OK;
    for (uint32_t i = 0; i < count; ++i) {
        hair_instance* hair = list[i];
        if (hair->pace.pending == 0) continue;
        if (hair->geometry.smooth.done &&
            hair_draw_keep_vertices(&hair->renderer, &hair->sim.head_at_last_step, &hair->pace.head,
                                    &plans[i]))
            continue;
        late[late_count++] = hair;
    }
    hair_result result = late_count ? hair_catch_up(late, late_count) : HAIR_OK;
    for (uint32_t i = 0; i < count && late_count; ++i)
        if (!plans[i].keeps_vertices) hair_make_plan(list[i], view, &plans[i]);
    return result;
}

hair_result hair_draw(hair_instance* hair, const hair_view* view)
{
    HAIR_TRY(hair_check_instance(hair));
    struct hair_view_copy own;
    struct hair_draw_plan plan;
    HAIR_TRY(check_view(hair, view, &own));
    hair_make_plan(hair, &own.view, &plan);
    if (!is_to_be_drawn(hair, &plan)) return HAIR_OK;
    hair_pace_note_size(hair, &own);
    hair_result result = settle(&hair, &plan, 1);
    if (result) return result;
    hair_enter_frame(hair);
    if (is_of_surroundings(&own.view)) {
        hair_draw_free_unused(&hair->renderer, hair->profiler.number);
        result = draw_surroundings(hair, &own.view);
    } else {
        result = prepare_draw(hair, &plan);
        if (!result) hair_draw_rasterise(&hair->renderer, &plan, 0);
        if (!result) hair_draw_finish(&hair->renderer, &plan);
    }
    result = hair_leave_frame(hair->context, result);
    if (!result) hair_sim_set_unseen_time(&hair->sim, 0);
    return result;
}

// Lists -------------------------------------------------------------------------------------------

// Instances of a list that are drawn together, with their plans.
struct list_part {
    hair_instance* const* hair;
    uint32_t count;
    struct hair_draw_plan* plan;
    uint32_t drawn; // Number of plans.
    hair_instance* of[HAIR_GL_STREAMS]; // Instance of each plan.
    hair_result result[HAIR_GL_STREAMS];
};

// Let the plans of a part be those of a batch that may be, unless their vertices are kept. A batch
// has at least two heads.
static void find_batch(struct list_part* part)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < part->drawn; ++i) count += hair_batch_accepts(&part->plan[i]);
    bool is_batch = count > 1 && hair_batch_is_possible(&part->of[0]->context->gl);
    for (uint32_t i = 0; i < part->drawn; ++i)
        if (!part->plan[i].keeps_vertices)
            part->plan[i].is_of_batch = is_batch && hair_batch_accepts(&part->plan[i]);
}

// Give all heads of the batch their places. Those that get none are drawn by themselves.
static void give_places(struct list_part* part)
{
    for (uint32_t i = 0; i < part->drawn; ++i) {
        hair_instance* hair = part->of[i];
        struct hair_draw_plan* plan = &part->plan[i];
        if (!plan->is_of_batch || plan->keeps_vertices) continue;
        update_attachment(hair); // The size of a place depends on it.
        plan->is_of_batch = hair_batch_join(&hair->renderer, &hair->sim.head_at_last_step, plan);
    }
}

// Return whether an instance of a part is ready to be drawn with the batch.
static bool is_in_batch(const struct list_part* part, uint32_t i)
{
    return part->plan[i].is_of_batch && !part->result[i] && !part->plan[i].is_empty;
}

// Draw the batch. Its passes are timed for no instance.
static void draw_batch(struct hair_gl* gl, struct list_part* part)
{
    const struct hair_draw_plan* any = NULL;
    for (uint32_t i = 0; i < part->drawn; ++i)
        if (is_in_batch(part, i)) any = &part->plan[i];
    if (!any) return;
    hair_gl_set_owner(gl, NULL, NULL);
    hair_result result = hair_batch_draw(&part->of[0]->context->batch, any);
    for (uint32_t i = 0; i < part->drawn; ++i) {
        if (!is_in_batch(part, i)) continue;
        part->result[i] = result;
        if (!result) hair_gl_profiler_count(&part->of[i]->profiler, any->draw);
    }
}

// Return the numbers that the samples of a prepared instance take. 0 if it has failed.
static size_t count_own_numbers(const struct list_part* part, uint32_t i)
{
    return part->result[i] ? 0 : hair_draw_count_numbers(&part->plan[i]);
}

// Return the end of the instances from `first` on whose samples there is room for. An instance
// without room fails.
static uint32_t find_end_of_samples(struct list_part* part, uint32_t first)
{
    struct hair_batch* batch = &part->of[0]->context->batch;
    size_t numbers = 0, own = count_own_numbers(part, first);
    uint32_t end = first;
    for (; end < part->drawn; ++end) {
        size_t more = count_own_numbers(part, end);
        bool fits = numbers + more <= batch->samples.max &&
                    hair_samples_fit(batch->gl, numbers + more, &batch->samples);
        if (numbers && !fits) break;
        numbers += more;
    }
    if (!hair_samples_ensure(batch->gl, numbers, &batch->samples)) return end;
    if (own) part->result[first] = hair_samples_ensure(batch->gl, own, &batch->samples);
    return first + 1;
}

// Draw prepared instances from `first` to `end` in their order. Find their samples side by side.
static void draw_prepared(struct hair_gl* gl, struct list_part* part, uint32_t first, uint32_t end)
{
    size_t numbers = 0;
    for (uint32_t i = first; i < end; ++i) {
        size_t own = count_own_numbers(part, i);
        if (!own) continue;
        hair_gl_set_owner(gl, &part->of[i]->memory, &part->of[i]->profiler);
        hair_gl_resume_stream(gl, i);
        hair_draw_rasterise(&part->of[i]->renderer, &part->plan[i], numbers);
        numbers += own;
    }
    for (uint32_t i = first; i < end; ++i) {
        if (part->result[i]) continue;
        hair_gl_set_owner(gl, &part->of[i]->memory, &part->of[i]->profiler);
        if (!part->plan[i].is_of_batch) hair_gl_continue_stream(gl, i);
        hair_draw_finish(&part->of[i]->renderer, &part->plan[i]);
    }
}

// Prepare all instances side by side, and then draw them in their order.
static void draw_recorded(struct hair_gl* gl, struct list_part* part)
{
    for (uint32_t i = 0; i < part->drawn; ++i) {
        hair_instance* hair = part->of[i];
        hair_gl_set_owner(gl, &hair->memory, &hair->profiler);
        hair_gl_begin_stream(gl);
        part->result[i] = prepare_draw(hair, &part->plan[i]);
    }
    for (uint32_t first = 0, end; first < part->drawn; first = end) {
        end = find_end_of_samples(part, first);
        draw_prepared(gl, part, first, end);
    }
    hair_gl_end_recording(gl);
}

static void draw_in_turn(struct hair_gl* gl, struct list_part* part, const hair_view* view)
{
    for (uint32_t i = 0; i < part->drawn; ++i) {
        hair_instance* hair = part->of[i];
        hair_gl_set_owner(gl, &hair->memory, &hair->profiler);
        if (is_of_surroundings(view)) {
            part->result[i] = draw_surroundings(hair, view);
            continue;
        }
        part->result[i] = prepare_draw(hair, &part->plan[i]);
        if (part->result[i]) continue;
        hair_draw_rasterise(&hair->renderer, &part->plan[i], 0);
        hair_draw_finish(&hair->renderer, &part->plan[i]);
    }
}

// Draw a part of a list. Return the first failure.
static hair_result draw_all(struct list_part* part, const struct hair_view_copy* copy)
{
    const hair_view* view = &copy->view;
    hair_context* context = part->hair[0]->context;
    struct hair_gl* gl = &context->gl;
    hair_result first = HAIR_OK;
    for (uint32_t i = 0; i < part->count; ++i) {
        hair_make_plan(part->hair[i], view, &part->plan[part->drawn]);
        if (!is_to_be_drawn(part->hair[i], &part->plan[part->drawn])) continue;
        hair_pace_note_size(part->hair[i], copy);
        part->of[part->drawn++] = part->hair[i];
    }
    if (!part->drawn) return HAIR_OK;
    find_batch(part);
    first = settle(part->of, part->plan, part->drawn);
    find_batch(part);
    hair_enter_frame(part->of[0]);
    give_places(part);
    bool has_strands = !is_of_surroundings(view) && view->pass != HAIR_PASS_GUIDES;
    if (has_strands && part->drawn > 1 && hair_gl_begin_recording(gl, part->drawn))
        draw_recorded(gl, part);
    else
        draw_in_turn(gl, part, view);
    draw_batch(gl, part);
    hair_result lost = hair_leave_frame(context, HAIR_OK);
    for (uint32_t i = 0; i < part->drawn; ++i) {
        if (!first) first = part->result[i];
        if (!lost && !part->result[i]) hair_sim_set_unseen_time(&part->of[i]->sim, 0);
    }
    return lost ? lost : first;
}

hair_result hair_draw_list(hair_instance* const* list, uint32_t count, const hair_view* view)
{
    HAIR_TRY(hair_check_list(list, count));
    if (!count) return HAIR_OK;
    struct hair_view_copy own;
    HAIR_TRY(check_view(list[0], view, &own));
    const hair_host* host = &list[0]->context->host;
    uint32_t max = count < HAIR_GL_STREAMS ? count : HAIR_GL_STREAMS;
    struct hair_draw_plan* plans = hair_alloc(host, max, sizeof *plans);
    if (!plans) return hair_fail_memory(host, "a list of instances");
    hair_result first = HAIR_OK;
    for (uint32_t i = 0; i < count && first != HAIR_ERROR_CONTEXT_LOST; i += max) {
        struct list_part part = {.hair = list + i, .count = count - i < max ? count - i : max, .plan = plans};
        hair_result result = draw_all(&part, &own);
        if (!first || result == HAIR_ERROR_CONTEXT_LOST) first = result;
    }
    hair_free(host, plans);
    return first;
}
