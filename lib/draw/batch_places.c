// batch_places.c - places for the vertices of heads in the buffers of a batch, in blocks.
#include "lib/draw/batch.h"

#include <string.h>

#define BLOCK 4096u // Vertices of a block. Parts of buffers begin at multiples of 256 bytes.
#define MIN_BLOCKS 64u // Blocks that there is memory for at first.
#define GROWTH 8 // Buffers grow by this part at least.
#define MAX_NUMBERS 8000000u // Numbers of the samples that are drawn at once. A sample has two.
#define SHRINKS 3 // Heads get new places once many views in turn need less than a third of them.

static const size_t size_of_vertex[HAIR_VIEW_CACHE_PARTS] = {[HAIR_VIEW_CACHE_POSITION] = sizeof(hair_vec4),
                                                             [HAIR_VIEW_CACHE_TANGENT] = 8,
                                                             [HAIR_VIEW_CACHE_SHADED] = 8};

void hair_batch_init(struct hair_batch* batch, struct hair_gl* gl)
{
    memset(batch, 0, sizeof *batch);
    batch->gl = gl;
    batch->samples.max = MAX_NUMBERS;
}

static void free_vertices(struct hair_batch* batch)
{
    hair_gl_free_buffer_texture(batch->gl, &batch->shaded_texture);
    for (int i = 0; i < HAIR_VIEW_CACHE_PARTS; ++i) hair_gl_free_buffer(batch->gl, &batch->vertices[i]);
    hair_free(&batch->gl->host, batch->is_taken);
    batch->is_taken = NULL;
    batch->blocks = 0;
}

// Free what no head needs.
static void free_unused_batch(struct hair_batch* batch)
{
    struct hair_gl* gl = batch->gl;
    if (batch->places) return;
    free_vertices(batch);
    hair_raster_free(gl, &batch->raster);
    hair_free(&gl->host, batch->head);
    batch->head = NULL;
    if (!batch->samples.users) hair_samples_free(gl, &batch->samples);
}

void hair_batch_free(struct hair_batch* batch)
{
    batch->places = batch->samples.users = 0;
    free_unused_batch(batch);
}

void hair_batch_leave_samples(struct hair_batch* batch)
{
    HAIR_ASSERT(batch->samples.users > 0);
    --batch->samples.users;
    free_unused_batch(batch);
}

// Return the size of blocks in a part, in bytes.
static size_t size_of_blocks(int part, uint32_t blocks)
{
    return (size_t)blocks * BLOCK * size_of_vertex[part];
}

// Make the buffers of a number of blocks. On failure nothing is left.
static hair_result make_vertices(struct hair_batch* out, uint32_t blocks)
{
    struct hair_gl* gl = out->gl;
    hair_result result = HAIR_OK;
    out->is_taken = hair_alloc(&gl->host, blocks, sizeof *out->is_taken);
    if (!out->is_taken) result = hair_fail_memory(&gl->host, "a batch");
    for (int i = 0; i < HAIR_VIEW_CACHE_PARTS && !result; ++i)
        result = hair_gl_undefined_storage(gl, HAIR_GL_NO_CATEGORY, "hair batch", size_of_blocks(i, blocks),
                                           &out->vertices[i]);
    if (!result)
        result = hair_gl_buffer_texture(gl, "hair batch", GL_RGBA16F, out->vertices[HAIR_VIEW_CACHE_SHADED],
                                        &out->shaded_texture);
    out->blocks = blocks;
    if (result) free_vertices(out);
    return result;
}

// Make room for `count` more blocks in a row. Heads keep their places.
static hair_result grow(struct hair_batch* batch, uint32_t count)
{
    struct hair_gl* gl = batch->gl;
    struct hair_batch more = {.gl = gl};
    uint32_t blocks = batch->blocks + (count > batch->blocks / GROWTH ? count : batch->blocks / GROWTH);
    HAIR_ASSERT(!hair_gl_is_recording(gl));
    if (!batch->head) batch->head = hair_alloc(&gl->host, HAIR_BATCH_HEADS, sizeof *batch->head);
    if (!batch->head) return hair_fail_memory(&gl->host, "a batch");
    HAIR_TRY(make_vertices(&more, blocks < MIN_BLOCKS ? MIN_BLOCKS : blocks));
    for (int i = 0; i < HAIR_VIEW_CACHE_PARTS && batch->blocks; ++i)
        hair_gl_copy_buffer(gl, batch->vertices[i], more.vertices[i], 0, 0,
                            (GLsizeiptr)size_of_blocks(i, batch->blocks));
    if (batch->blocks) memcpy(more.is_taken, batch->is_taken, batch->blocks);
    free_vertices(batch);
    memcpy(batch->vertices, more.vertices, sizeof batch->vertices);
    batch->shaded_texture = more.shaded_texture;
    batch->is_taken = more.is_taken;
    batch->blocks = more.blocks;
    return HAIR_OK;
}

// Return whether the buffers may grow by a number of blocks, and be copied meanwhile.
static bool may_grow(const struct hair_batch* batch, uint32_t count)
{
    uint64_t blocks = (uint64_t)batch->blocks + batch->blocks / GROWTH + count + MIN_BLOCKS;
    uint64_t bytes = blocks * BLOCK * size_of_vertex[HAIR_VIEW_CACHE_POSITION];
    return hair_gl_fits(batch->gl, bytes, 8) && hair_gl_memory_allows(&batch->gl->memory, 2 * bytes);
}

// Return the first of `count` free blocks in a row, or the number of all blocks.
static uint32_t find_free(const struct hair_batch* batch, uint32_t count)
{
    uint32_t free = 0;
    for (uint32_t i = 0; i < batch->blocks; ++i) {
        free = batch->is_taken[i] ? 0 : free + 1;
        if (free == count) return i + 1 - count;
    }
    return batch->blocks;
}

static void mark(struct hair_batch* batch, struct hair_batch_place place, bool is_taken)
{
    HAIR_ASSERT(place.first + place.blocks <= batch->blocks);
    for (uint32_t i = place.first; i < place.first + place.blocks; ++i) {
        HAIR_ASSERT(batch->is_taken[i] != is_taken);
        batch->is_taken[i] = is_taken;
    }
}

static void give_up(struct hair_batch* batch, struct hair_batch_place* place)
{
    mark(batch, *place, false);
    *place = (struct hair_batch_place){0};
    --batch->places;
}

bool hair_batch_take_place(struct hair_batch* batch, struct hair_batch_place* place, size_t vertices)
{
    uint32_t blocks = (uint32_t)(vertices / BLOCK) + 1;
    bool is_spare = hair_gl_count_spare(&place->spare, place->blocks / SHRINKS > blocks);
    if (place->blocks >= blocks && !is_spare) return true;
    if (place->blocks) give_up(batch, place);
    uint32_t first = find_free(batch, blocks);
    if (first == batch->blocks && (!may_grow(batch, blocks) || grow(batch, blocks))) {
        free_unused_batch(batch);
        return false;
    }
    *place = (struct hair_batch_place){.first = find_free(batch, blocks), .blocks = blocks};
    mark(batch, *place, true);
    ++batch->places;
    return true;
}

void hair_batch_leave_place(struct hair_batch* batch, struct hair_batch_place* place)
{
    if (!place->blocks) return;
    give_up(batch, place);
    free_unused_batch(batch);
}

uint32_t hair_batch_first_vertex(struct hair_batch_place place)
{
    return place.first * BLOCK;
}

uint32_t hair_batch_count_vertices(struct hair_batch_place place)
{
    return place.blocks * BLOCK;
}

void hair_batch_bind_place(const struct hair_batch* batch, struct hair_batch_place place)
{
    GLintptr at[HAIR_VIEW_CACHE_PARTS];
    GLsizeiptr size[HAIR_VIEW_CACHE_PARTS];
    HAIR_ASSERT(place.blocks > 0 && place.first + place.blocks <= batch->blocks);
    for (int i = 0; i < HAIR_VIEW_CACHE_PARTS; ++i) {
        at[i] = (GLintptr)size_of_blocks(i, place.first);
        size[i] = (GLsizeiptr)size_of_blocks(i, place.blocks);
    }
    hair_gl_bind_ranges(batch->gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_CACHED_POSITION, HAIR_VIEW_CACHE_PARTS,
                        batch->vertices, at, size);
}
