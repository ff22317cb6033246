// batch.h - small heads of a list, whose segments are rasterised together. Their per-view vertices
// are in common buffers, so that a head takes no call of its own from vertices to pixels.
#ifndef HAIR_DRAW_BATCH_H
#define HAIR_DRAW_BATCH_H

#include "lib/draw/raster.h"
#include "lib/draw/view_cache.h"

struct hair_draw_plan;
struct hair_pose;
struct hair_renderer;

// The batch of a context. It has memory only while heads have places in it, or are drawn alone by
// compute rasterisation.
struct hair_batch {
    struct hair_gl* gl;
    // Vertices of all places, as in hair_view_cache. 0 until needed.
    GLuint vertices[HAIR_VIEW_CACHE_PARTS];
    GLuint shaded_texture; // Buffer texture of the last part.
    uint32_t places; // Number of heads with a place.
    uint32_t blocks; // Capacity in blocks of vertices.
    bool* is_taken; // True for each block that a head has.
    struct hair_batch_head* head; // Heads that are drawn next, with room for HAIR_BATCH_HEADS.
    uint32_t heads;
    struct hair_raster raster; // Buffers of the batch.
    struct hair_samples samples; // Samples of the batch, or of heads that are drawn alone.
};

// Functions of batch_places.c.

// Set up a batch, without memory or OpenGL.
void hair_batch_init(struct hair_batch* batch, struct hair_gl* gl);
// Free a batch whose heads are gone or do not matter any more.
void hair_batch_free(struct hair_batch* batch);
// Let a place hold more than a number of vertices. Return false if there is no memory, and leave no
// place. A place that moves loses its vertices.
bool hair_batch_take_place(struct hair_batch* batch, struct hair_batch_place* place, size_t vertices);
// Free a place, if there is one. The last place takes the memory along.
void hair_batch_leave_place(struct hair_batch* batch, struct hair_batch_place* place);
// Note that a head is not drawn alone any more. The last takes the samples along.
void hair_batch_leave_samples(struct hair_batch* batch);
uint32_t hair_batch_first_vertex(struct hair_batch_place place);
uint32_t hair_batch_count_vertices(struct hair_batch_place place);
// Bind the vertices of a place, as at HAIR_BIND_CACHED_POSITION.
void hair_batch_bind_place(const struct hair_batch* batch, struct hair_batch_place place);

// Functions of batch.c.

// Return whether the driver and the application's state let heads be drawn in any order.
bool hair_batch_is_possible(struct hair_gl* gl);
// Return whether a plan may be that of a head in a batch.
bool hair_batch_accepts(const struct hair_draw_plan* plan);
// Let a head take a place for a plan that is accepted. Return false if the head is too large, or if
// there is no memory.
bool hair_batch_join(struct hair_renderer* renderer, const struct hair_pose* head,
                     const struct hair_draw_plan* plan);
// Add a head to those that are drawn next. Its vertices must be written.
void hair_batch_add(struct hair_renderer* renderer, const struct hair_draw_plan* plan);
// Draw all heads that were added, by the plan of any of them, and forget them.
hair_result hair_batch_draw(struct hair_batch* batch, const struct hair_draw_plan* plan);

#endif
