// snapshot.c - copies of the state of a simulation on the CPU.
#include "lib/sim/save_fields.h"

#include <string.h>

static void drop_copy(struct hair_sim* sim)
{
    struct hair_snapshots* snapshots = &sim->snapshots;
    if (snapshots->fence) sim->gl->DeleteSync(snapshots->fence);
    snapshots->fence = NULL;
}

// Complete the snapshot in progress. The GPU has copied its buffers.
static void complete(struct hair_snapshots* snapshots)
{
    struct hair_snapshot done = snapshots->next;
    for (uint32_t i = 0; i < snapshots->buffers; ++i) {
        const struct hair_serialized_buffer* from = &snapshots->copied[i];
        HAIR_ASSERT(from->at + from->size <= done.size);
        memcpy(done.bytes + from->at, snapshots->mapped + from->at, from->size);
        hair_serialize_native(done.bytes + from->at, from->size);
    }
    snapshots->next = snapshots->last;
    snapshots->last = done;
}

// Ensure that all memory for a state of `size` bytes is there.
static hair_result ensure(struct hair_sim* sim, size_t size)
{
    struct hair_snapshots* snapshots = &sim->snapshots;
    struct hair_snapshot* next = &snapshots->next;
    if (next->room < size) {
        unsigned char* bytes = hair_alloc(&sim->gl->host, 1, size);
        if (!bytes) return hair_fail_memory(&sim->gl->host, "a snapshot");
        hair_free(&sim->gl->host, next->bytes);
        *next = (struct hair_snapshot){.bytes = bytes, .room = size};
    }
    if (snapshots->room >= size) return HAIR_OK;
    GLuint buffer = 0;
    const void* mapped = NULL;
    HAIR_TRY(hair_gl_mapped(sim->gl, HAIR_GL_CATEGORY_SOLVE, "hair snapshot", size, &buffer, &mapped));
    hair_gl_free_buffer(sim->gl, &snapshots->buffer); // Deletion unmaps the buffer.
    snapshots->buffer = buffer;
    snapshots->mapped = mapped;
    snapshots->room = size;
    return HAIR_OK;
}

static void serialize(struct hair_serializer* s, struct hair_sim* sim)
{
    struct hair_loaded none = {0}; // Nothing is read.
    hair_sim_serialize(s, sim, &none);
    HAIR_ASSERT(s->result == HAIR_OK);
}

// Begin a snapshot of the current state.
static hair_result begin_snapshot(struct hair_sim* sim)
{
    struct hair_gl* gl = sim->gl;
    struct hair_snapshots* snapshots = &sim->snapshots;
    struct hair_serializer s = {.host = &gl->host, .gl = gl, .at = HAIR_SAVE_HEADER};
    hair_sleep_settle(sim);
    serialize(&s, sim);
    size_t size = s.at + HAIR_SAVE_TRAILER;
    HAIR_TRY(ensure(sim, size));
    bool was_recording = hair_gl_run_at_once(gl);
    s = (struct hair_serializer){.host = &gl->host,
                                 .gl = gl,
                                 .write = snapshots->next.bytes,
                                 .copies = snapshots->buffer,
                                 .at = HAIR_SAVE_HEADER};
    serialize(&s, sim);
    HAIR_ASSERT(s.at + HAIR_SAVE_TRAILER == size);
    snapshots->next.size = size;
    snapshots->buffers = s.buffers;
    memcpy(snapshots->copied, s.buffer, sizeof snapshots->copied);
    snapshots->fence = gl->FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    hair_gl_record_again(gl, was_recording);
    return HAIR_OK;
}

hair_result hair_snapshots_update(struct hair_sim* sim)
{
    struct hair_snapshots* snapshots = &sim->snapshots;
    if (!snapshots->is_wanted) return HAIR_OK;
    if (snapshots->fence) {
        GLenum status = sim->gl->ClientWaitSync(snapshots->fence, 0, 0);
        if (status == GL_TIMEOUT_EXPIRED) return HAIR_OK;
        drop_copy(sim);
        // The loss of a context passes all fences, whether there is a copy or not.
        bool is_done = status == GL_ALREADY_SIGNALED || status == GL_CONDITION_SATISFIED;
        if (is_done && !hair_gl_find_loss(sim->gl)) complete(snapshots);
    }
    return begin_snapshot(sim);
}

hair_result hair_snapshots_load(struct hair_sim* sim, struct hair_snapshots* from)
{
    const struct hair_snapshot* last = &from->last;
    if (!last->size) return HAIR_OK;
    hair_save_seal(last->bytes, last->size - HAIR_SAVE_TRAILER);
    HAIR_TRY(hair_sim_load(sim, last->bytes, last->size));
    hair_sleep_wake(sim); // The snapshot may wait for a measurement that was lost.
    return HAIR_OK;
}

void hair_snapshots_move(struct hair_snapshots* to, struct hair_snapshots* from)
{
    HAIR_ASSERT(!to->last.bytes);
    to->last = from->last;
    from->last = (struct hair_snapshot){0};
}

void hair_snapshots_free(struct hair_sim* sim)
{
    struct hair_snapshots* snapshots = &sim->snapshots;
    drop_copy(sim);
    hair_gl_free_buffer(sim->gl, &snapshots->buffer);
    hair_free(&sim->gl->host, snapshots->last.bytes);
    hair_free(&sim->gl->host, snapshots->next.bytes);
    *snapshots = (struct hair_snapshots){.is_wanted = snapshots->is_wanted};
}
