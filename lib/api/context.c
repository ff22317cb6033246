// context.c - public calls on contexts. A context holds the library's objects in one OpenGL
// context.
#include "lib/api/api.h"

hair_result hair_context_create(const hair_context_desc* desc, hair_context** out)
{
    hair_host host = HAIR_HOST_OF(desc);
    hair_context_desc own;
    HAIR_TRY(HAIR_COPY_IN(&host, hair_context_desc, desc, &own));
    if (!out) return hair_fail(&host, HAIR_ERROR_ARGUMENT, "out is NULL");
    if (!own.get_proc) return hair_fail(&host, HAIR_ERROR_ARGUMENT, "hair_context_desc.get_proc is NULL");
    if (own.cache && (!own.cache->get || !own.cache->put))
        return hair_fail(&host, HAIR_ERROR_ARGUMENT, "hair_cache.%s is NULL", own.cache->get ? "put" : "get");
    hair_context* context = hair_alloc(&host, 1, sizeof *context);
    if (!context) return hair_fail_memory(&host, "a context");
    context->host = host;
    context->holder_count = 1;
    hair_sdf_pool_init(&context->sdf_pool, &context->gl);
    hair_batch_init(&context->batch, &context->gl);
    context->desc = own;
    hair_result result = hair_gl_create(&context->gl, &host, &own);
    if (result) {
        hair_free(&host, context);
        return result;
    }
    hair_fastest_find(&context->gl, &context->fastest);
    *out = context;
    return HAIR_OK;
}

void hair_context_add(hair_context* context, struct hair_context_member* member,
                      void (*empty)(struct hair_context_member* member))
{
    HAIR_ASSERT(!context->is_dead && context->holder_count > 0);
    *member = (struct hair_context_member){.next = context->members, .empty = empty};
    if (member->next) member->next->prev = member;
    context->members = member;
    ++context->holder_count;
}

static void empty_member(hair_context* context, struct hair_context_member* member)
{
    *(member->prev ? &member->prev->next : &context->members) = member->next;
    if (member->next) member->next->prev = member->prev;
    member->empty(member);
}

// Let go of a context. The last holder frees its struct.
static void drop_holder(hair_context* context)
{
    HAIR_ASSERT(context->holder_count > 0);
    if (--context->holder_count) return;
    hair_host host = context->host;
    HAIR_ASSERT(context->is_dead);
    hair_free(&host, context);
}

void hair_context_remove(hair_context* context, struct hair_context_member* member)
{
    if (!context->is_dead) {
        struct hair_gl was = context->gl;
        // Names of the OpenGL objects mean others in another OpenGL context.
        if (context->gl.is_lost || !hair_gl_is_current(&context->gl)) hair_gl_ignore_deletions(&context->gl);
        empty_member(context, member);
        hair_gl_copy_deletions(&was, &context->gl);
    }
    drop_holder(context);
}

// Free everything in a context but the structs that the application knows.
static void end(hair_context* context)
{
    while (context->members) empty_member(context, context->members);
    hair_sdf_pool_free(&context->sdf_pool);
    hair_batch_free(&context->batch);
    hair_gl_frame_timer_free(&context->gl, &context->budget.timer);
    hair_gl_destroy(&context->gl);
    context->is_dead = true;
}

void hair_context_tell_left(hair_context* context)
{
    if (!context->is_dead && !context->gl.is_lost) hair_check_current(context);
}

void hair_context_destroy(hair_context* context)
{
    if (!context) return;
    if (!context->is_dead) {
        if (context->gl.is_lost || hair_check_current(context)) hair_gl_ignore_deletions(&context->gl);
        end(context);
    }
    drop_holder(context);
}

void hair_context_abandon(hair_context* context)
{
    if (!context || context->is_dead) return;
    hair_gl_ignore_deletions(&context->gl);
    end(context);
}

hair_result hair_check_context(const hair_context* context)
{
    if (!context) return HAIR_ERROR_ARGUMENT;
    if (!context->is_dead) return HAIR_OK;
    return hair_fail(&context->host, HAIR_ERROR_ARGUMENT, "the context is abandoned");
}

hair_result hair_check_instance(const hair_instance* hair)
{
    if (!hair) return HAIR_ERROR_ARGUMENT;
    if (!hair->context->is_dead) return HAIR_OK;
    return hair_fail(&hair->context->host, HAIR_ERROR_ARGUMENT, "%s: its context is destroyed or abandoned",
                     hair->label);
}

static hair_result fail_lost(const hair_context* context)
{
    return hair_fail(&context->host, HAIR_ERROR_CONTEXT_LOST,
                     "the OpenGL context is lost: see hair_context_restore()");
}

hair_result hair_check_current(hair_context* context)
{
    if (context->gl.is_lost) return fail_lost(context);
    if (hair_gl_is_current(&context->gl)) return hair_check_lost(context, HAIR_OK);
    if (!context->gl.GetString(GL_VERSION))
        return hair_fail(&context->host, HAIR_ERROR_OPENGL, "no OpenGL context is current on this thread");
    return hair_fail(&context->host, HAIR_ERROR_OPENGL,
                     "the current OpenGL context is not that of hair_context_create()");
}

hair_result hair_check_lost(hair_context* context, hair_result result)
{
    return hair_gl_find_loss(&context->gl) ? fail_lost(context) : result;
}

hair_result hair_leave(hair_context* context, hair_result result)
{
    hair_gl_leave(&context->gl);
    return hair_check_lost(context, result);
}

hair_result hair_context_reload(hair_context* context)
{
    HAIR_TRY(hair_check_context(context));
    HAIR_TRY(hair_check_current(context));
    hair_gl_enter(&context->gl);
    return hair_leave(context, hair_gl_compile(&context->gl));
}

hair_result hair_get_memory(const hair_context* context, hair_memory* out)
{
    HAIR_TRY(hair_check_context(context));
    const struct hair_gl_memory* memory = &context->gl.memory;
    hair_memory own = hair_memory_default();
    own.bytes = memory->bytes;
    own.peak = memory->peak;
    own.limit = memory->limit;
    return HAIR_COPY_OUT(&context->host, hair_memory, &own, out);
}

hair_result hair_set_memory_limit(hair_context* context, uint64_t bytes)
{
    HAIR_TRY(hair_check_context(context));
    hair_gl_memory_set_limit(&context->gl, bytes);
    return HAIR_OK;
}

hair_result hair_set_budget(hair_context* context, float ms)
{
    HAIR_TRY(hair_check_context(context));
    if (!(ms >= 0 && ms <= 1000)) // NaN fails.
        return hair_fail(&context->host, HAIR_ERROR_ARGUMENT, "hair_set_budget: ms is %g, not in [0, 1000]",
                         (double)ms);
    hair_budget_start(&context->budget, ms);
    return HAIR_OK;
}

uint32_t hair_get_timings(hair_context* context, hair_timing* out, uint32_t capacity)
{
    if (hair_check_context(context) || (out && hair_check_current(context))) return 0;
    for (uint32_t i = 0; out && i < capacity && i < context->gl.programs; ++i) {
        struct hair_gl_program* of = context->gl.program[i];
        out[i].pass = of->label;
        out[i].ms = hair_gl_pass_ms(&context->gl, of);
        out[i].runs = of->timer.begun;
        out[i].total_ms = of->timer.total;
    }
    return context->gl.programs;
}
