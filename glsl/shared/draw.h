// draw.h - views: lists of strands, culling, rasterisation and debug views.
#ifndef HAIR_SHARED_DRAW_H
#define HAIR_SHARED_DRAW_H

#define HAIR_INSTANCE_STRANDS 64     // Strands per instance, when drawn without a tessellator.
#define HAIR_SORT_BUCKETS 16384      // Bins of the depth histogram, from far to near.
#define HAIR_RASTER_SAMPLES 16       // Maximum per pixel.
#define HAIR_RASTER_SMALL 256.0      // Pixels that a thread may cover of a segment.
#define HAIR_RASTER_TILE 16          // Side of a tile, pixels. Tiles without hair are not composed.
#define HAIR_RASTER_PIECE 32         // Pixels of a line that a thread covers at a time.
#define HAIR_CLEARED_BY_GROUP 256u   // Vectors that a work group of draw/raster_clear.comp clears.
// The list of tiles begins with the command that draws them. Then come their numbers.
#define HAIR_TILE_VERTICES 0u        // Index of the number of vertices.
#define HAIR_TILE_INSTANCES 1u       // Index of the number of instances, which is 1.
#define HAIR_TILE_START 2u           // Index of the first vertex.
#define HAIR_TILE_FIRST 4u           // Index of the first tile.
#define HAIR_TILE_CORNERS 6u         // Vertices of a tile.
// Heads of a batch have their commands before all tiles. A tile has its head in the upper bits.
#define HAIR_BATCH_HEADS 128         // Maximum heads of a batch.
#define HAIR_BATCH_TILE_BITS 20      // Bits of a tile's number.
// Depths in the window that pass a test of the application, as bits.
#define HAIR_TEST_NEARER 1u // Less than that of the framebuffer.
#define HAIR_TEST_FARTHER 2u // Greater.
#define HAIR_TEST_EQUAL 4u
// Opacities are added as binary logarithms of the light that is left, in units of 1 / SCALE. A sum
// from FULL on leaves no light. A strand leaves at least MIN_LEFT, so that sums do not overflow.
#define HAIR_OPACITY_SCALE 4096.0
#define HAIR_OPACITY_FULL 98304u
#define HAIR_OPACITY_MIN_LEFT 0.000244140625
#define HAIR_NOBODY 0xffffffffu      // Value of a sample in which no ribbon is visible.
#define HAIR_COUNT_THREADS 256       // Threads of the work group that counts the drawn strands.

#define HAIR_OCCLUSION_PARTS 4 // Parts of a strand that are tested separately.
// Texels of the application's depth along each axis that form one texel of the first Hi-Z level.
#define HAIR_HIZ_FIRST 8
#define HAIR_HIZ_NEXT 4  // Texels of a level along each axis that form one texel of the next.
#define HAIR_HIZ_TEXELS 8 // Maximum texels along each axis in which a box is looked up.

// A strand that is drawn without a tessellator.
struct hair_strand {
    hair_uint follower;
    float     width;   // Factor of its own width.
    float     widened; // Factor within `width` that compensates for strands that are left out.
    float     whole;   // Number of segments. The fraction is that of the last one.
    hair_uint cached; // Number of the strand in the vertex cache.
    hair_uint unused0, unused1, unused2;
};
HAIR_SIZE(hair_strand)

#define HAIR_STRAND_TEXELS 2 // Per hair_strand.

// An indirect command. A draw begins with what OpenGL reads of an indexed indirect draw. The
// dispatch that writes per-view vertices begins with three work group counts.
struct hair_draw_command {
    hair_uint count, instances, first, base_vertex, base_instance;
    hair_uint strands; // Strands in the list. Written in command 0 and in the dispatch.
    hair_uint each;    // Vertices per strand, in the dispatch.
    hair_uint unused0;
};
HAIR_SIZE(hair_draw_command)

// Parameters of occlusion culling against the application's depth.
struct hair_occlusion_params {
    // Matrix from positions relative to the head's origin: xy are texture coordinates, z is signed
    // depth, all times w.
    hair_mat4 to_texture;
    hair_uint width, height;   // Size of the application's texture.
    // Texel at which the first level begins, in a first level of the whole texture.
    hair_uint first_x, first_y;
    hair_uint columns, rows;   // Size of the first level.
    hair_uint levels;
    hair_uint level;    // Level that is made from the one before it.
    float     sign;     // 1, or -1 where the application's depth decreases with distance.
    float     max_size;     // Farthest signed depth.
    float     slack;    // Rounding error of depth.
    float     thick;    // Maximum radius of strands before the factors of maps and groom, m.
    // Texture coordinates by which strands are drawn beyond their geometry.
    float     beside_x, beside_y;
    hair_uint clips;    // 1 if geometry outside the texture is not visible.
    hair_uint guides;
};
HAIR_SIZE(hair_occlusion_params)

// Parameters of the compute rasteriser. Pixels are in row order. The samples of a pixel are
// adjacent.
struct hair_raster_params {
    // Matrix from positions relative to the head's origin: xy are pixels from the first pixel's
    // corner, z is depth in [0, 1], all times w.
    hair_mat4 to_window;
    // Part of clip space that can contain hair. xy: lower corner. zw: upper corner.
    hair_vec4 part;
    hair_uint columns, rows, samples;
    hair_uint flips;     // All bits where depth decreases with distance. Otherwise 0.
    hair_uint first_x, first_y; // First pixel, in the window.
    // 1 if segments claim the samples at which they are nearest. 0 if the nearest depth is to be
    // found.
    hair_uint claims;
    hair_uint clamps;    // 1 if depth is clamped and not clipped.
    float     depth_from, depth_by; // Written depth at 0, and its increase up to 1.
    hair_uint across, tiles; // Tiles in a row, and all tiles.
    // Bits of the fraction in a number that holds a vertex and the fraction from there to the next.
    hair_uint fraction_bits;
    hair_uint tests; // HAIR_TEST_NEARER, ... of the application's depth, for opacity. 0 for none.
    hair_uint split; // Threads of a segment.
    hair_uint encode; // hair_encoding.
    // Positions in the pixel of samples 2 i and 2 i + 1: xy and zw.
    hair_vec4 at[HAIR_RASTER_SAMPLES / 2];
};
HAIR_SIZE(hair_raster_params)

// A head of a batch, whose heads are rasterised together. Numbers that begin with `first` are those
// of the head in the buffers of the batch.
struct hair_batch_head {
    HAIR_STRUCT(hair_raster_params) raster;
    hair_vec4 eye;      // Member of hair_draw_params, like `segments`.
    hair_uint segments;
    hair_uint first_vertex, first_sample, first_tile;
    // Work groups that rasterise and that compose this head and those before it.
    hair_uint raster_end, compose_end;
    hair_uint heads, samples; // Numbers of the whole batch.
    // Vertex that is none: x is the number of listed strands, and y that of the written vertices of
    // each.
    hair_uint strands_at;
    hair_uint unused0, unused1, unused2;
};
HAIR_SIZE(hair_batch_head)

// Parameters of a draw. Positions are from the head's origin, as in the smoothed guides.
struct hair_draw_params {
    hair_mat4 view; // To view space.
    hair_mat4 view_to_clip;
    // xyz: position of the eye. With w = 0, in an orthographic view, the direction to the eye.
    hair_vec4 eye;
    hair_vec4 specular;   // Strengths of both highlights, then their exponents.
    // Longitudinal variance, absorption per squared log of reflectance, tilt in radians,
    // scattering.
    hair_vec4 fibre;
    float     radius;     // m.
    float     density;
    hair_uint segments;
    hair_uint smooth_vertices;
    hair_uint colored; // 0 if only depth is drawn and nothing is shaded.
    // Parameters of follower collision.
    hair_uint followers; // Number of all followers.
    hair_uint follower_collision; // hair_follower_collision.
    hair_uint parity;      // 0 or 1. The count at HAIR_BIND_LIST that is current.
    float     collision_margin;    // Distance from a collider to which followers are pushed, m.
    hair_uint lights;    // Number of lights.
    hair_uint textured;  // 1 if there is a colour texture.
    hair_uint light_values;       // Numbers per vertex at HAIR_UNIT_LIGHT. 0 if there are none.
    hair_uint culls;     // 1 if patches that are wholly outside `sides` are left out.
    hair_uint chunks;     // Work groups per patch in passes over follower vertices.
    float     push_out_weight;        // Fraction of the push out of colliders that the view shows.
    hair_uint reversed_maps; // Bit per shadow map. 1 if its depth falls away from the light.
    hair_uint guides;         // Number of guides.
    hair_uint shape_vertices; // Vertices of a follower's shape. 0 if followers have none.
    hair_uint encode; // hair_encoding.
    float     max_radius; // Maximum radius of a drawn strand, m.
    // Parallelism of the strands where no pass measures their vertices, from 0 for curls to 1.
    float     order;
    hair_uint draw_instances; // Instances of listed strands in a draw.
    float     curl_slope;  // Mean square slope of curls, see hair_lighting_find_curl().
    float     curl_rate;   // Phase of curls by length along a strand, radians/m.
    hair_uint grid_has_all; // 1 if the density grid has the strands that the view leaves out too.
    hair_uint strands_at; // Per-view vertex with the number of listed strands. 0 if there is none.
    // Fraction of all strands for which the vertex cache has room, times 2^32. 0 if it has all.
    hair_uint cache_fraction;
    hair_uint unused0;
    hair_vec4 map_weights; // Weights of the sets of maps. Their sum is 1.
    // Parameters of the level of detail.

    // Planes of the view frustum. xyz: unit normals, inwards. w: distance, m.
    hair_mat4 sides;
    // Sphere that occludes what is behind it. xyz: centre. w: radius, m. 0 disables it.
    hair_vec4 head_sphere;
    float     strand_fraction;    // Maximum fraction of the strands.
    float     segment_fraction;   // Maximum fraction of the segments.
    float     width_power;     // Strands are (1 / fraction) to this power times as wide.
    // Pixels per metre where w of clip space is 1. 0 disables detail by size on the screen.
    float     pixels_per_unit;
    float     strand_pixels;   // Wanted width of a strand, pixels.
    float     segment_pixels;  // Wanted length of a segment, pixels.
    float     min_strand_fraction; // Minimum fraction of the strands of a patch.
    float     occluded_importance; // Factor of the size of strands behind the skull.
    hair_mat4 now_to_clip;    // From the head's origin, without jitter.
    // From the head's origin in the previous frame that was drawn.
    hair_mat4 before_to_clip;
    // xyz: the head's origin in the world, m. w: cell of the density grid, m.
    hair_vec4 origin;
    hair_vec4 head;           // Rotation of the head, unit quaternion.
    // xy: size in pixels. z: widening of ribbons to each side, in pixels, by which they reach all
    // pixels that they partly cover. w: opacity.
    hair_vec4 viewport;
    // x: distance from the eye at which the nearest histogram bin begins, m. y: bins per metre.
    hair_vec4 sort;
    HAIR_STRUCT(hair_tint) tint;
    HAIR_STRUCT(hair_strand_look) strand;
    // Vectors of each light, indexed by HAIR_LIGHT_.
    hair_vec4 light[HAIR_LIGHTS * HAIR_LIGHT_VECTORS];
    // Matrix to each map: xy are texture coordinates and z is depth, both in [0, 1], all times w.
    hair_mat4 shadow[HAIR_SHADOW_MAPS];
    // Rectangles of hair shadow maps, then of opaque shadow maps, as fractions of the texture. xy:
    // lower left corner. zw: size.
    hair_vec4 map_part[2 * HAIR_SHADOW_MAPS];
    // Matrices of r, g and b. The irradiance on a plane of unit normal n is (n, 1) sky (n, 1).
    hair_mat4 sky[3];
};
HAIR_SIZE(hair_draw_params)

#define HAIR_DEBUG_COLLIDERS 96    // Colliders drawn at once.

// A collider to be drawn, and its bounding box in its own axes.
struct hair_debug_collider {
    HAIR_STRUCT(hair_field_collider) collider;
    hair_vec4 lower; // xyz: m.
    hair_vec4 upper; // xyz: m.
};
HAIR_SIZE(hair_debug_collider)

// Parameters of colliders that are drawn for debugging, cut open at a slice of the distance field.
struct hair_debug_params {
    hair_vec4 rotation; // Head rotation, unit quaternion.
    // Plane of the slice in the head's frame. xyz: unit normal. 0 if there is no slice. w: distance
    // of the plane, m.
    hair_vec4 plane;
    hair_vec4 corner;  // xyz: corner of the slice, m.
    hair_vec4 side[2]; // xyz: sides of the slice from its corner, m.
    // Map from depth d in normalised device coordinates to the framebuffer: x + y d.
    hair_vec4 depth;
    // Arrows of the wind. x, y: number along each side. z: spacing, m. w: speed that is drawn grey,
    // m/s.
    hair_vec4 air;
    HAIR_STRUCT(hair_debug_collider) shown[HAIR_DEBUG_COLLIDERS];
};
HAIR_SIZE(hair_debug_params)

#endif
