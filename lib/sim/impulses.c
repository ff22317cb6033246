// impulses.c - impulses between hair and colliders: the record, its sums, and their read-back.
#include "lib/sim/sim.h"

#include <stdlib.h>
#include <string.h>

#define BYTES (HAIR_IMPULSE_WORDS * sizeof(uint32_t)) // Sums of a collider.
#define LONGEST_WAIT 1000000000u // Wait for a step in one call of OpenGL, ns.
#define SPARE 1024 // Totals that may be appended before they are merged.
#define PI 3.141592653589793

// Setup -------------------------------------------------------------------------------------------

bool hair_impulses_are_on(const struct hair_sim* sim)
{
    return sim->impulses.strands > 0 && hair_sim_contacts(sim) > 0;
}

static void free_impulses(struct hair_sim* sim)
{
    struct hair_impulses* impulses = &sim->impulses;
    for (int i = 0; i < HAIR_IMPULSE_SLOTS; ++i) {
        struct hair_impulse_slot* slot = &impulses->slot[i];
        if (slot->fence) sim->gl->DeleteSync(slot->fence);
        hair_free(&sim->gl->host, slot->collider);
        *slot = (struct hair_impulse_slot){0};
    }
    hair_gl_free_array(sim->gl, &impulses->record, &impulses->texture);
    hair_gl_free_buffer(sim->gl, &impulses->sum);
    hair_gl_free_buffer(sim->gl, &impulses->readback); // Deletion unmaps the buffer.
    impulses->mapped = NULL;
    impulses->room = impulses->first = impulses->used = 0;
}

void hair_impulses_free(struct hair_sim* sim)
{
    free_impulses(sim);
    hair_free(&sim->gl->host, sim->impulses.total);
    sim->impulses = (struct hair_impulses){0};
}

void hair_impulses_set(struct hair_sim* sim, double strands)
{
    HAIR_ASSERT(strands >= 0);
    if (strands == 0) hair_impulses_free(sim);
    sim->impulses.strands = strands;
}

static uint32_t count_pressed(const struct hair_sim* sim)
{
    uint32_t few = hair_sim_contacts(sim);
    return sim->contacts.any           ? sim->contacts.grid.contacts
           : few < HAIR_STEP_COLLIDERS ? few
                                       : HAIR_STEP_COLLIDERS;
}

static hair_result ensure_record(struct hair_sim* sim)
{
    struct hair_impulses* impulses = &sim->impulses;
    size_t size = (size_t)sim->guide_vertices * HAIR_IMPULSE_TEXELS * sizeof(hair_vec4);
    return hair_gl_ensure_array(sim->gl, HAIR_GL_CATEGORY_IMPULSES, "hair impulses", size, &impulses->record,
                                GL_RGBA32F, &impulses->texture);
}

// Make the buffers of sums for `room` colliders. All slots must be free.
static hair_result make_sums(struct hair_sim* sim, uint32_t room)
{
    struct hair_impulses* impulses = &sim->impulses;
    struct hair_gl* gl = sim->gl;
    GLuint sum = 0, readback = 0;
    const void* mapped = NULL;
    HAIR_ASSERT(!impulses->used);
    HAIR_TRY(hair_gl_storage(gl, HAIR_GL_CATEGORY_IMPULSES, "hair impulse sums", room * BYTES, NULL, &sum));
    hair_result result = hair_gl_mapped(gl, HAIR_GL_CATEGORY_IMPULSES, "hair impulse sums",
                                        HAIR_IMPULSE_SLOTS * room * BYTES, &readback, &mapped);
    if (result) {
        hair_gl_free_buffer(gl, &sum);
        return result;
    }
    hair_gl_free_buffer(gl, &impulses->sum);
    hair_gl_free_buffer(gl, &impulses->readback);
    impulses->sum = sum, impulses->readback = readback;
    impulses->mapped = mapped, impulses->room = room;
    return HAIR_OK;
}

static hair_result reserve_slot(struct hair_sim* sim, uint32_t count)
{
    struct hair_impulses* impulses = &sim->impulses;
    struct hair_impulse_slot* slot = &impulses->slot[(impulses->first + impulses->used) % HAIR_IMPULSE_SLOTS];
    if (count <= slot->room) return HAIR_OK;
    struct hair_impulse_collider* own = hair_alloc(&sim->gl->host, count, sizeof *own);
    if (!own) return hair_fail_memory(&sim->gl->host, "the impulses of colliders");
    hair_free(&sim->gl->host, slot->collider);
    slot->collider = own, slot->room = count;
    return HAIR_OK;
}

// Totals ------------------------------------------------------------------------------------------

// Return one of the sums of a collider, in units of HAIR_IMPULSE_UNIT.
static double read_sum(const uint32_t* words, int i)
{
    return (double)(int32_t)words[2 * i + 1] * 4294967296.0 + (double)words[2 * i];
}

// Return the impulses of a slot on a collider. Hair pushes against what pushes it.
static struct hair_impulse read_impulse(const struct hair_impulse_slot* slot, uint32_t k,
                                        const uint32_t* words)
{
    const struct hair_impulse_collider* collider = &slot->collider[k];
    struct hair_impulse out = {.key = collider->key, .collider = collider->collider, .vertices = words[26]};
    double arm[3];
    out.size = slot->scale * read_sum(words, 12);
    for (int i = 0; i < 3; ++i) {
        arm[i] = slot->head[i] - (double)collider->position[i];
        out.impulse[i] = -slot->scale * read_sum(words, i);
        out.normal[i] = slot->scale * read_sum(words, 6 + i);
        out.place[i] = slot->scale * read_sum(words, 9 + i) + out.size * slot->head[i];
    }
    for (int i = 0; i < 3; ++i) {
        int a = (i + 1) % 3, b = (i + 2) % 3;
        out.moment[i] =
            -slot->scale * read_sum(words, 3 + i) + arm[a] * out.impulse[b] - arm[b] * out.impulse[a];
    }
    return out;
}

static int by_collider(const void* a, const void* b)
{
    const struct hair_impulse *x = a, *y = b;
    if (x->key != y->key) return x->key < y->key ? -1 : 1;
    return (x->collider > y->collider) - (x->collider < y->collider);
}

static void add_impulse(struct hair_impulse* to, const struct hair_impulse* from)
{
    to->vertices += from->vertices;
    to->size += from->size;
    for (int i = 0; i < 3; ++i) {
        to->impulse[i] += from->impulse[i];
        to->moment[i] += from->moment[i];
        to->normal[i] += from->normal[i];
        to->place[i] += from->place[i];
    }
}

static void merge_totals(struct hair_impulses* impulses)
{
    uint32_t count = 0;
    // Sums of equal colliders are added in an order that is always the same up to rounding.
    if (impulses->totals) qsort(impulses->total, impulses->totals, sizeof *impulses->total, by_collider);
    for (uint32_t i = 0; i < impulses->totals; ++i) {
        if (count && !by_collider(&impulses->total[count - 1], &impulses->total[i]))
            add_impulse(&impulses->total[count - 1], &impulses->total[i]);
        else
            impulses->total[count++] = impulses->total[i];
    }
    impulses->totals = impulses->merged = count;
}

static hair_result reserve_totals(struct hair_sim* sim, uint32_t more)
{
    struct hair_impulses* impulses = &sim->impulses;
    if (impulses->totals - impulses->merged + more > SPARE + impulses->merged) merge_totals(impulses);
    if (impulses->totals + more <= impulses->total_room) return HAIR_OK;
    uint32_t room = 2 * (impulses->totals + more);
    struct hair_impulse* own = hair_alloc(&sim->gl->host, room, sizeof *own);
    if (!own) return hair_fail_memory(&sim->gl->host, "the impulses of colliders");
    if (impulses->totals) memcpy(own, impulses->total, impulses->totals * sizeof *own);
    hair_free(&sim->gl->host, impulses->total);
    impulses->total = own, impulses->total_room = room;
    return HAIR_OK;
}

// Add the sums of the oldest step, which is done, to the totals, and free its slot.
static hair_result take_oldest(struct hair_sim* sim)
{
    struct hair_impulses* impulses = &sim->impulses;
    struct hair_impulse_slot* slot = &impulses->slot[impulses->first];
    const uint32_t* words =
        (const uint32_t*)(const void*)(impulses->mapped + impulses->first * impulses->room * BYTES);
    uint32_t touched = 0;
    for (uint32_t k = 0; k < slot->count; ++k) touched += words[HAIR_IMPULSE_WORDS * k + 26] > 0;
    HAIR_TRY(reserve_totals(sim, touched));
    for (uint32_t k = 0; k < slot->count; ++k, words += HAIR_IMPULSE_WORDS)
        if (words[26]) impulses->total[impulses->totals++] = read_impulse(slot, k, words);
    sim->gl->DeleteSync(slot->fence);
    slot->fence = NULL;
    impulses->first = (impulses->first + 1) % HAIR_IMPULSE_SLOTS;
    --impulses->used;
    return HAIR_OK;
}

// Return whether the GPU is done with the oldest step. `waits` waits for it.
static bool is_summed(struct hair_sim* sim, bool waits)
{
    GLsync fence = sim->impulses.slot[sim->impulses.first].fence;
    GLenum status;
    do
        status =
            sim->gl->ClientWaitSync(fence, waits ? GL_SYNC_FLUSH_COMMANDS_BIT : 0, waits ? LONGEST_WAIT : 0);
    while (waits && status == GL_TIMEOUT_EXPIRED);
    return status == GL_ALREADY_SIGNALED || status == GL_CONDITION_SATISFIED;
}

// Add the sums of finished steps to the totals, until at most `left` steps are on their way. Those
// of a lost context are dropped with everything else.
static hair_result take_done(struct hair_sim* sim, uint32_t left)
{
    struct hair_impulses* impulses = &sim->impulses;
    while (impulses->used && is_summed(sim, impulses->used > left)) HAIR_TRY(take_oldest(sim));
    if (impulses->used <= left) return HAIR_OK;
    return hair_fail(&sim->gl->host, HAIR_ERROR_OPENGL,
                     "the driver does not finish the impulses of colliders");
}

hair_result hair_impulses_collect(struct hair_sim* sim, bool waits)
{
    HAIR_TRY(take_done(sim, waits ? 0 : HAIR_IMPULSE_SLOTS));
    merge_totals(&sim->impulses);
    return HAIR_OK;
}

// Steps -------------------------------------------------------------------------------------------

hair_result hair_impulses_ensure(struct hair_sim* sim)
{
    struct hair_impulses* impulses = &sim->impulses;
    if (!hair_impulses_are_on(sim)) return HAIR_OK;
    uint32_t count = count_pressed(sim);
    HAIR_TRY(hair_gl_ensure_program(sim->gl, HAIR_GL_SUM_IMPULSES));
    HAIR_TRY(ensure_record(sim));
    HAIR_TRY(take_done(sim, count > impulses->room ? 0 : HAIR_IMPULSE_SLOTS - 1));
    if (count > impulses->room) HAIR_TRY(make_sums(sim, count + count / 2));
    return reserve_slot(sim, count);
}

void hair_impulses_bind(struct hair_sim* sim)
{
    HAIR_ASSERT(sim->impulses.texture);
    hair_gl_bind_image(sim->gl, HAIR_IMAGE_IMPULSE, sim->impulses.texture, false, GL_READ_WRITE, GL_RGBA32F);
}

void hair_impulses_end_dispatch(struct hair_sim* sim)
{
    hair_gl_barrier(sim->gl, GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

// Note the colliders of the step, in the order of the solver.
static void note_colliders(struct hair_sim* sim, struct hair_impulse_slot* slot)
{
    const struct hair_collider_list* list = &sim->colliders.current;
    uint32_t nearest[HAIR_STEP_COLLIDERS];
    const uint32_t* index = sim->contacts.any ? sim->contacts.grid.collider : nearest;
    slot->count = sim->contacts.any ? sim->contacts.grid.contacts
                                    : hair_colliders_nearest(&sim->colliders, &sim->head, nearest);
    HAIR_ASSERT(slot->count <= slot->room && slot->count <= sim->impulses.room);
    for (uint32_t k = 0; k < slot->count; ++k) {
        const hair_collider* collider = &list->collider[index[k]];
        slot->collider[k] = (struct hair_impulse_collider){.key = collider->key, .collider = index[k]};
        memcpy(slot->collider[k].position, collider->position, sizeof collider->position);
    }
}

void hair_impulses_end_step(struct hair_sim* sim)
{
    struct hair_impulses* impulses = &sim->impulses;
    struct hair_gl* gl = sim->gl;
    if (!hair_impulses_are_on(sim)) return;
    uint32_t number = (impulses->first + impulses->used) % HAIR_IMPULSE_SLOTS;
    struct hair_impulse_slot* slot = &impulses->slot[number];
    const double radius = (double)sim->physics.fiber.radius;
    HAIR_ASSERT(impulses->used < HAIR_IMPULSE_SLOTS && !slot->fence);
    bool was_recording = hair_gl_run_at_once(gl);
    note_colliders(sim, slot);
    memcpy(slot->head, sim->last_after.position, sizeof slot->head);
    slot->scale =
        HAIR_IMPULSE_UNIT * PI * radius * radius * (double)sim->physics.fiber.density * impulses->strands;
    hair_sim_bind(sim);
    hair_impulses_bind(sim);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_IMPULSE_SUM, 1, &impulses->sum);
    hair_gl_run(gl, HAIR_GL_SUM_IMPULSES, (sim->guide_vertices + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE);
    GLsizeiptr bytes = (GLsizeiptr)(slot->count * BYTES);
    if (slot->count)
        hair_gl_copy_buffer(gl, impulses->sum, impulses->readback, 0,
                            (GLintptr)(number * impulses->room * BYTES), bytes);
    hair_gl_clear_buffer(gl, impulses->sum);
    slot->fence = gl->FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    if (slot->fence) ++impulses->used; // The driver may refuse a fence. The step is then not told.
    hair_gl_record_again(gl, was_recording);
}
