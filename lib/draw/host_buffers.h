// host_buffers.h - buffers of strands for the application, beyond those that drawing has.
#ifndef HAIR_DRAW_HOST_BUFFERS_H
#define HAIR_DRAW_HOST_BUFFERS_H

#include "lib/gl/commands.h"

// Index of the strand of each vertex, of guides or of followers.
struct hair_strand_index {
    GLuint buffer; // 0 until needed.
    size_t vertices;
    uint32_t each; // Number of vertices of a strand.
};

struct hair_host_buffers {
    GLuint color; // Reflectance of followers, as at HAIR_BIND_SHADED. 0 until needed.
    size_t color_vertices;
    hair_look color_look; // Look with which the reflectance was written.
    uint32_t color_generation; // Value of hair_gl.program_generation at the last write. 0 for none.
    uint32_t color_lengths; // Value of hair_lengths.version for `color`.
    struct hair_strand_index guide_index, follower_index;
};

#endif
