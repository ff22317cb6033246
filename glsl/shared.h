// shared.h - constants, binding slots and struct layouts that C, C++ and GLSL share.
//
// Members are 4-byte scalars, hair_vec4, hair_mat4, or arrays of structs of these. The size of a
// struct is a multiple of 16 bytes. With these rules std430, std140, C and C++ give the same layout
// without padding. A vec3 must never be used here, because it is aligned as a vec4 but takes 12
// bytes. The asserts below and tests/gpu/layout_test.c check the rules.
#ifndef HAIR_SHARED_H
#define HAIR_SHARED_H

#ifdef GL_core_profile
#define hair_vec4 vec4
#define hair_mat4 mat4
#define hair_uint uint
#define HAIR_STRUCT(T) T
#define HAIR_SIZE(T)
#else
#include <stdint.h>
typedef struct hair_vec4 {
    float x, y, z, w;
} hair_vec4;
typedef struct hair_mat4 {
    hair_vec4 column[4];
} hair_mat4;
typedef uint32_t hair_uint;
#define HAIR_STRUCT(T) struct T
#ifdef __cplusplus
#define HAIR_SIZE(T) static_assert(sizeof(struct T) % 16 == 0, #T " needs members unused0, ... at its end");
#else
#define HAIR_SIZE(T) _Static_assert(sizeof(struct T) % 16 == 0, #T " needs members unused0, ... at its end");
#endif
#endif

// Storage buffers of compute passes. OpenGL 4.5 guarantees only eight to a compute shader.
#define HAIR_BIND_GUIDE 0    // hair_guide[] per guide. Read-only.
#define HAIR_BIND_REST 1     // hair_rest[] per guide vertex. Read-only.
#define HAIR_BIND_STATE 2    // hair_state[] per guide vertex.
// hair_vec4[] per smoothed vertex. xyz: position from the head's origin, m. w: length from the
// root, m.
#define HAIR_BIND_POSITION 3
// hair_vec4[] per smoothed vertex. xyz: unit tangent. w: stretch of the segment.
#define HAIR_BIND_TANGENT 4
// hair_vec4[] per smoothed vertex. Unit quaternion, y along the strand.
#define HAIR_BIND_FRAME 5
// Buffers of the rod solvers, in place of those of smoothed vertices, which they neither read nor
// write.
#define HAIR_BIND_ROD 3     // hair_rod[] per guide vertex. Read-only.
#define HAIR_BIND_HISTORY 4 // hair_history[] per guide vertex.
// hair_vec4[] per guide vertex. Frame of its segment, unit quaternion, y along the segment.
#define HAIR_BIND_MATERIAL 5
// uint[] of every solver. It begins with HAIR_SOLVER_STATS_COUNT counters. For solvers that run as
// two programs, the two headers and the numbers of HAIR_SOLVER_STATS_LISTS follow.
#define HAIR_BIND_SOLVER_STATS 6
// hair_vec4[] of the mixed scheme, in place of HAIR_BIND_REDUCTION. See bend_size() in
// lib/sim/rods.c.
#define HAIR_BIND_BEND 7
// hair_vec4[] per round of cyclic reduction and guide vertex. Read-only. See
// lib/rod/cyclic_reduction.c.
#define HAIR_BIND_REDUCTION 7
// Buffers of the pass that writes the distance field. It has none of the buffers above.
#define HAIR_BIND_BRICK 0  // hair_field_brick[] per work group.
// uint[]. Indices in HAIR_UNIT_WORK of the colliders that reach into each brick.
#define HAIR_BIND_BRICK_COLLIDER 1
#define HAIR_BIND_NODE 3   // float[]. Distances at the grid nodes of collision meshes, m.
// Additional buffers of the hair-hair grid, whose passes also read the state and the history. The
// grid gives each guide vertex the effect of the hair around it.

// int[]. HAIR_GRID_NODE_NUMBERS per grid node. The grid of the fluid has four per node: mass and
// momentum.
#define HAIR_BIND_HAIR_GRID 3
#define HAIR_BIND_SPLAT 5    // hair_grid_splat[] per guide vertex. Read-only.
// float[] per node. Volume above which the node exerts pressure. Read-only.
#define HAIR_BIND_REST_DENSITY 6
#define HAIR_BIND_ACCELERATION 7     // hair_vec4[] per guide vertex. Acceleration, m/s^2.

// Buffers of the pass that measures the activity of guides. It also reads the state.

// hair_vec4[] per guide vertex. Earlier position, from the head's origin.
#define HAIR_BIND_ANCHOR 3
// uint[4]. Two answers that are written alternately. Each holds the greatest distance from the
// anchor, m, and the greatest speed, m/s, as bits of floats.
#define HAIR_BIND_ACTIVITY 4

// Additional buffers of the passes that diagnose hair, which also have those of the rod solvers.
#define HAIR_BIND_FOUND 3  // uint[HAIR_FOUND_COUNT] of motion.comp.
#define HAIR_BIND_ENERGY 7 // hair_energy[] per guide, of energy.comp.

// Buffers of the scalp motion passes, which also have guides and the rest shape.

// float[]. The application's buffer, which contains the scalp's positions.
#define HAIR_BIND_GIVEN 2
#define HAIR_BIND_ROOT_TRANSFORM 3       // hair_root_transform[] per guide.
#define HAIR_BIND_SCALP 4      // float[]. xyz per scalp vertex, in the space of the application.
#define HAIR_BIND_SCALP_REST 5 // float[]. xyz per scalp vertex at rest, in groom space. Read-only.
// hair_root_binding[] of guides, then of followers. Read-only.
#define HAIR_BIND_ROOT_BINDING 6
#define HAIR_BIND_FOLLOWER 7   // hair_follower[]

// Buffers of the passes that find followers inside colliders.
#define HAIR_BIND_HIT 3    // float[] per follower. First vertex inside, or HAIR_NO_HIT.
// uvec2[] per follower and control point of strands/repair.glsl. Four halves.
#define HAIR_BIND_REPAIR 4
#define HAIR_BIND_LIST 5 // uint[]. Two counts, used alternately, then the followers to be repaired.
// Read-only buffers of hit.comp with HAIR_HIT_GROUP and of the pass that writes the vertex cache.
// They have these in place of textures of guides and followers.
#define HAIR_BIND_STORED_POSITION 0 // hair_vec4[] per smoothed vertex, as at HAIR_BIND_POSITION.
#define HAIR_BIND_STORED_TANGENT 1  // hair_vec4[] per smoothed vertex, as at HAIR_BIND_TANGENT.
#define HAIR_BIND_STORED_FRAME 2    // hair_vec4[] per smoothed vertex, as at HAIR_BIND_FRAME.
#define HAIR_BIND_STORED_FOLLOWER 6 // hair_follower[] per follower.

// Buffers of the vertex cache of followers.

// hair_vec4[] per follower vertex. xyz: position from the head's origin, m. w: radius, m.
#define HAIR_BIND_CACHED_POSITION 4
#define HAIR_BIND_SHADED 6           // uvec2[] per follower vertex. Light to the eye, as halves.
// uvec2[] per follower vertex. Unit tangent, three 16-bit numbers that map to [-1, 1].
#define HAIR_BIND_CACHED_TANGENT 5

// Buffers of the passes that write the strand list, which is drawn without a tessellator.
#define HAIR_BIND_START 3   // uint[] per patch. Index of its first strand in the list.
#define HAIR_BIND_STRAND 4  // hair_strand[] per drawn strand.
// hair_draw_command[HAIR_COMMANDS]. Commands 0 and 1 draw segments by their two ends. Command
// HAIR_SORTED_COMMAND draws sorted segments. Command HAIR_PAIRED_COMMAND and the one after it draw
// segments by pairs of vertices. Command HAIR_EXPAND_VIEW_COMMAND dispatches the pass that writes
// the per-view vertices.
#define HAIR_BIND_COMMAND 5
#define HAIR_COMMANDS 6
#define HAIR_SORTED_COMMAND 2
#define HAIR_PAIRED_COMMAND 3
#define HAIR_EXPAND_VIEW_COMMAND 5
#define HAIR_PAIRED_INDICES 6 // Per segment.
// Buffers of the pass that writes the per-view vertices, in the order of the strand list. It writes
// to HAIR_BIND_CACHED_POSITION and the two slots after it, in their formats. With HAIR_SIDES it
// writes clip-space positions to HAIR_BIND_CACHED_POSITION: one hair_vec4 per side of a ribbon
// vertex, or one per line vertex.
#define HAIR_BIND_LIST_COMMAND 3  // hair_draw_command[HAIR_COMMANDS]. Read-only.
// Additional buffers of the passes that sort the segments of listed strands.
#define HAIR_BIND_HISTOGRAM 0 // uint[HAIR_SORT_BUCKETS]. Depth histogram, later its prefix sum.
#define HAIR_BIND_SORTED_SEGMENTS 1 // uvec2[] per segment. Indices of its two vertices.

// Buffers of the compute rasteriser.

// uvec2[] per sample. x: segment number of the visible ribbon. y: its depth as bits of a float,
// inverted where depth decreases with distance. HAIR_NOBODY means that no ribbon is visible.
// Depth-only passes have a uint[] with y alone.
#define HAIR_BIND_NEAREST 0
#define HAIR_BIND_TILE 1    // uint[] per tile. 1 if the tile contains hair.
// Buffers of the self-shadowing passes.
#define HAIR_BIND_DENSITY 0        // uint[] per node of the density grid. Amount of hair.
// uint[6]. Bounding box of all hair, in the encoding of light/float_key.glsl.
#define HAIR_BIND_DENSITY_BOX 1
// float[] per node. Visible fraction of the sky, then the strands met on the way to each light.
#define HAIR_BIND_DENSITY_LIGHT 3
#define HAIR_BIND_DENSITY_STRAND 4 // hair_vec4[] as at HAIR_BIND_CACHED_POSITION. Read-only.
// uint[] per follower vertex. One number for the sky, then one per light. See
// vertex_transmittance.comp.
#define HAIR_BIND_LIGHT 5

// Buffers of occlusion culling against the application's depth.

// float[]. Hi-Z: farthest depth of every texel of every level. See glsl/draw/hiz.glsl.
#define HAIR_BIND_HIZ 0
// hair_vec4[] per guide and part. Lower corner, then upper corner, m.
#define HAIR_BIND_GUIDE_BOUNDS 1
#define HAIR_BIND_OCCLUSION_PATCH 2 // hair_patch[]

// Buffers of the fluid passes. They read what they do not write as textures.

// float[] per axis and slot. Velocity of the face along the axis, m/s. See glsl/wind/fluid.glsl.
#define HAIR_BIND_VELOCITY 0
// float[] per axis and slot. Velocity along the axis of what closes the face, m/s.
#define HAIR_BIND_WALL_VELOCITY 1
// uint[] per slot of every level. Open fractions of its three faces, 10 bits each, in 1023rds.
#define HAIR_BIND_FACE_FRACTION 2
// float[] per cell of every level. Pressure in m/s: a difference of pressure is a change of
// velocity.
#define HAIR_BIND_PRESSURE 3
// float[] per cell of every level. Right side of the pressure equation, m/s.
#define HAIR_BIND_RHS 4
#define HAIR_BIND_MOTION 5   // hair_fluid_motion[] per collider. Read-only.

#define HAIR_LIGHTS 16     // Maximum per view.
#define HAIR_SHADOW_MAPS 4 // Maximum for all lights of a view.
// Maximum of a drawn colour. Half-float formats can hold it.
#define HAIR_MAX_LIGHT 64000.0

// Maximum Newton steps of the mixed scheme in a substep. The first is for a work group, the second
// for a thread that solves a guide of n vertices.
#define HAIR_MIXED_STEPS 16u
#define HAIR_MIXED_STEPS_BY_THREAD(n) ((n) <= 32 ? 16u : (n) <= 64 ? 12u : (n) <= 128 ? 8u : 5u)
// Vectors in a row of the mixed scheme. See glsl/sim/mixed_rows.glsl.
#define HAIR_MIXED_ROW_VECTORS 14u

// Counters at HAIR_BIND_SOLVER_STATS. hair_solver_stats defines what they count.
#define HAIR_SOLVER_STATS_EULER_FALLBACKS 0
#define HAIR_SOLVER_STATS_FOLLOW_FALLBACKS 1
#define HAIR_SOLVER_STATS_RESET 2
#define HAIR_SOLVER_STATS_OVEREXTENDED 3
#define HAIR_SOLVER_STATS_PARTS 4
#define HAIR_SOLVER_STATS_GAINING 5
#define HAIR_SOLVER_STATS_COUNT 6
// Results of motion.comp at HAIR_BIND_FOUND. hair_solver_stats defines them.
#define HAIR_FOUND_RESTLESS 0
#define HAIR_FOUND_OVERSTRETCHED 1
#define HAIR_FOUND_FASTEST 2 // m/s, as bits of a float.
#define HAIR_FOUND_STRETCH 3 // Relative error of a length, as bits of a float.
#define HAIR_FOUND_COUNT 4
// Assumed maximum distance by which the fitting of lengths moves a vertex beyond its free motion,
// in metres.
#define HAIR_CONTACT_FIT 0.02
// Guides per work group in programs with HAIR_PASS1, one subgroup per guide.
#define HAIR_PASS1_GUIDES 28
// Two headers, used alternately, follow the counters at HAIR_SOLVER_STATS_COUNT. A header holds the
// work group counts x, y and z of an indirect dispatch over a list of guides, then the list's
// length. The guide numbers of the current dispatch's list begin at HAIR_SOLVER_STATS_LISTS.
#define HAIR_SOLVER_STATS_LIST 4 // Numbers in a header.
#define HAIR_SOLVER_STATS_LISTS (HAIR_SOLVER_STATS_COUNT + 2 * HAIR_SOLVER_STATS_LIST)

// Uniform buffers.
#define HAIR_BIND_STEP 0         // hair_step_params.
#define HAIR_BIND_DRAW 1         // hair_draw_params.
#define HAIR_BIND_FIELD 2        // hair_field_params.
// hair_wind_params, of the rod solvers and of the pass that draws the wind.
#define HAIR_BIND_WIND 2
#define HAIR_BIND_HAIR_GRID_PARAMS 1 // hair_grid_params, of passes that draw nothing.
#define HAIR_BIND_SCALP_PARAMS 1 // hair_scalp_params, of passes that draw nothing.
#define HAIR_BIND_FLUID 0        // hair_fluid_params, of the fluid passes.
#define HAIR_BIND_LEVEL 1        // hair_fluid_level, of the fluid passes.
#define HAIR_BIND_ACTIVITY_PARAMS 1  // hair_activity_params, of passes that draw nothing.
#define HAIR_BIND_ENERGY_PARAMS 1 // hair_energy_params, of passes that draw nothing.
#define HAIR_BIND_MOTION_PARAMS 1 // hair_motion_params, of passes that draw nothing.
// hair_debug_params, of the passes that draw colliders, the distance field and the wind.
#define HAIR_BIND_DEBUG 0
#define HAIR_BIND_OCCLUSION 0         // hair_occlusion_params, of occlusion culling.
#define HAIR_BIND_RASTER 0       // hair_raster_params, of the compute rasteriser.

// Texture units. Vertex and tessellation stages use them because OpenGL guarantees those stages no
// storage buffers.
#define HAIR_UNIT_POSITION 0
#define HAIR_UNIT_TANGENT 1
#define HAIR_UNIT_FRAME 2
// hair_follower[] as unsigned integers, because float textures may flush small integers to 0.
#define HAIR_UNIT_FOLLOWER 3
#define HAIR_UNIT_PATCH 4    // hair_patch[], unsigned.
// hair_strand[], unsigned. Without a tessellator, in place of patches.
#define HAIR_UNIT_STRAND 4
#define HAIR_UNIT_TILE 2     // HAIR_BIND_TILE, for the pass that composes tiles.
// Textures of redblack by transform feedback.
#define HAIR_UNIT_STATE 0 // hair_state[].
#define HAIR_UNIT_REST 1     // hair_rest[].
#define HAIR_UNIT_GUIDE 2    // hair_guide[], unsigned.
#define HAIR_UNIT_OWNER 3    // uint per guide vertex. Its guide.
// Textures of the rod solvers, whose storage slots are all taken.
#define HAIR_UNIT_ACCELERATION 0 // HAIR_BIND_ACCELERATION.
#define HAIR_UNIT_CONTACT 1  // hair_contact[], unsigned as followers are.
#define HAIR_UNIT_PIN 2      // hair_held[], where guides are pinned.
// uint[]. For each grid cell, the index of its first member in this array. After the last cell, the
// index at which its members end. Then the members.
#define HAIR_UNIT_CELL 3
#define HAIR_UNIT_NODE 4     // float[]. HAIR_BIND_NODE.
// HAIR_BIND_ROOT_TRANSFORM, for passes that need the scalp motion.
#define HAIR_UNIT_ROOT_TRANSFORM 6
#define HAIR_UNIT_HIT 6      // float per follower, as at HAIR_BIND_HIT.
#define HAIR_UNIT_REPAIR 7   // vec4 per follower and control point.
// Textures of the vertex cache, for draws from it, in place of what it was computed from.
#define HAIR_UNIT_CACHED_POSITION 6 // vec4 per vertex, as at HAIR_BIND_CACHED_POSITION.
#define HAIR_UNIT_SHADED 1           // vec4 per vertex, as at HAIR_BIND_SHADED.
#define HAIR_UNIT_CACHED_TANGENT 7 // vec4 per vertex. xyz in [0, 1] stand for [-1, 1].
#define HAIR_UNIT_FIELD 8    // Distance field: signed distance, m.
#define HAIR_UNIT_COLLIDER 9    // Number of the nearest collider.
#define HAIR_UNIT_FIBRE 10   // Table of lib/light/fibre.h.
#define HAIR_UNIT_AIR 11     // Velocity of the fluid at the centres of its cells, m/s.
// Textures of the fluid passes. The others are bound as their slots say.
#define HAIR_UNIT_VELOCITY 0 // HAIR_BIND_VELOCITY before the step.
#define HAIR_UNIT_ADVECTED 1  // HAIR_BIND_VELOCITY after advection.
#define HAIR_UNIT_FACE_FRACTION 2
#define HAIR_UNIT_PRESSURE 3
// HAIR_BIND_HAIR_GRID in fours, of a grid over the whole box. For porous.comp, in place of
// pressure.
#define HAIR_UNIT_THICKET 3
#define HAIR_UNIT_RHS 4
#define HAIR_UNIT_WALL_VELOCITY 6
// HAIR_BIND_FACE_FRACTION and HAIR_BIND_WALL_VELOCITY as colliders alone leave them. The buffers at
// HAIR_UNIT_FACE_FRACTION and HAIR_UNIT_WALL_VELOCITY include the effect of hair.
#define HAIR_UNIT_BARE_FACE_FRACTION 5
#define HAIR_UNIT_BARE_WALL_VELOCITY 7
// Vertex cache of the previous frame, as HAIR_UNIT_CACHED_POSITION. For velocity passes, in place
// of frames.
#define HAIR_UNIT_BEFORE 2
#define HAIR_UNIT_UV 5       // vec2 per follower. Texture coordinates of its root on the scalp.
#define HAIR_UNIT_COLOR 16 // The application's colour texture, at the coordinates of HAIR_UNIT_UV.
#define HAIR_UNIT_GROOM_COLOR 17   // vec4 per follower and sample along it. Colours of the groom.
#define HAIR_UNIT_SHADOW 12 // First of HAIR_SHADOW_MAPS units. The application's shadow maps.
#define HAIR_UNIT_LIGHT 18   // uint per follower vertex and light, unsigned. HAIR_BIND_LIGHT.
// First of HAIR_SHADOW_MAPS units. The application's depth maps of opaque geometry.
#define HAIR_UNIT_BODY 19
#define HAIR_UNIT_OCCLUSION 23  // The application's depth, for occlusion culling.
// Gusts of standard deviation 1. For passes that evaluate the wind, in place of the distance field.
#define HAIR_UNIT_GUST 8
// The application's wind velocities, m/s. In place of HAIR_UNIT_COLLIDER.
#define HAIR_UNIT_VOLUME 9
// hair_field_collider[]. For the pass that writes the distance field, in place of
// HAIR_UNIT_POSITION.
#define HAIR_UNIT_WORK 0

// Image units.
#define HAIR_IMAGE_FIELD 0 // Signed distance, of the pass that writes the distance field.
#define HAIR_IMAGE_COLLIDER 1 // Number of the nearest collider.
#define HAIR_IMAGE_AIR 0 // Texture at HAIR_UNIT_AIR, of the pass that writes it.

#define HAIR_MAX_GROUPS 65535u      // Work groups in one dimension that OpenGL guarantees.
// Threads of a work group, except in passes with a work group per guide. See lib/gl/passes.inl.
#define HAIR_GROUP_SIZE 64
#define HAIR_MAX_GUIDES 262144       // Per groom.
#define HAIR_MAX_GUIDE_VERTICES 256  // Per guide. A work group has one thread per vertex.
#define HAIR_MAX_SMOOTH_VERTICES 511 // Per guide. Two samples per segment of the longest guide.
// Isolines per tessellated patch and segments per isoline that OpenGL guarantees.
#define HAIR_MAX_ISOLINES 64
#define HAIR_MAX_ISOLINE_SEGMENTS 64
#define HAIR_INSTANCE_STRANDS 64     // Strands per instance, when drawn without a tessellator.
#define HAIR_SORT_BUCKETS 16384      // Bins of the depth histogram, from far to near.
#define HAIR_RASTER_SAMPLES 16       // Maximum per pixel.
#define HAIR_RASTER_SEGMENTS 16      // Per work group.
#define HAIR_RASTER_TILE 32          // Side of a tile, pixels. Tiles without hair are not composed.
#define HAIR_RASTER_PIECE 32         // Pixels of a row that a thread covers at a time.
#define HAIR_NOBODY 0xffffffffu      // Value of a sample in which no ribbon is visible.
#define HAIR_COUNT_THREADS 256       // Threads of the work group that counts the drawn strands.
#define HAIR_STEP_SUBSTEPS 64        // Maximum per dispatch.
#define HAIR_STEP_COLLIDERS 64        // Maximum colliders in the parameters of a dispatch.
// Maximum colliders that the rod solvers test one by one. Grids are faster for more.
#define HAIR_FEW_COLLIDERS 16
#define HAIR_CELL_COLLIDERS 64        // Maximum colliders of a grid cell.
// Loop iterations over the colliders of a cell in a substep, where a thread counts them. See
// lib/sim/loop_budget.c.
#define HAIR_CONTACT_ROUNDS 4000
#define HAIR_CONTACT_TEXELS 13 // Per hair_contact.
// Bits of a cell member that are the number of its hair_contact.
#define HAIR_ENTRY_NUMBER 1048575u
#define HAIR_ENTRY_WALKED 16777216u // Bit of a cell member that is neither a sphere nor a capsule.
#define HAIR_ENTRY_LONG 33554432u   // Bit of a cell member that is not a sphere.
#define HAIR_FOLLOWER_TEXELS 6 // Per hair_follower.
#define HAIR_PATCH_TEXELS 4 // Per hair_patch.
#define HAIR_MAP_SETS 4 // Maximum per groom.
#define HAIR_CURVE_INTERVALS 7 // Per curve along a strand.
#define HAIR_TURN_PLACES 16    // Samples of one turn of a curl.
// Side of a brick, voxels. A work group writes one brick of the distance field.
#define HAIR_BRICK 8
#define HAIR_DEBUG_COLLIDERS 96    // Colliders drawn at once.
#define HAIR_COLLIDER_TEXELS 6 // Per hair_field_collider.
#define HAIR_WIND_BALLS 4    // Maximum spheres that shelter hair from the wind.
#define HAIR_WIND_SOURCES 4  // Maximum local wind sources per instance.
#define HAIR_GUST_NODES 32   // Texels of the gust texture along each axis.
#define HAIR_GUST_LENGTHS 8  // Side of the gust texture, in integral length scales.
#define HAIR_NO_COLLIDER 4294967295u // A collider's number that means that no collider is near.
#define HAIR_GRID_NODES 32       // Maximum along an axis.
// Integers per node of the hair-hair grid. Index 0 is the mass. The constants below are the other
// indices. Positions are relative to the node, in cells.
#define HAIR_GRID_NODE_NUMBERS 18
#define HAIR_GRID_MOMENTUM 1u    // Three.
#define HAIR_GRID_VOLUME 4u      // One.
#define HAIR_GRID_MOMENT 5u      // Three: mass times position.
#define HAIR_GRID_ANGULAR 8u     // Three: angular momentum.
#define HAIR_GRID_SQUARES 11u    // Three: mass times position squared, xx, yy and zz.
#define HAIR_GRID_PRODUCTS 14u   // Three: mass times position squared, yz, zx and xy.
// Sum of mass times the mass of the same guide at the node, times hair_grid_params.per_strand.
#define HAIR_GRID_ALIKE 17u
// Maximum speed along an axis relative to the head, m/s. Greater speeds are clamped to it.
#define HAIR_GRID_SPEED 16.0f

// Maximum cells along an axis of the coarsest level. See glsl/wind/coarse_solve.comp.
#define HAIR_FLUID_COARSEST 8
#define HAIR_FLUID_COARSEST_THREADS 256
#define HAIR_FLUID_FASTEST 1e4 // m/s. A greater speed counts as not finite.

// Size of the fibre table.
#define HAIR_FIBRE_COLUMNS 64
#define HAIR_FIBRE_ROWS 16
#define HAIR_FIBRE_LAYERS 3
#define HAIR_FIBRE_MU 0.5 // Absorption per radius at the middle of the columns.

#define HAIR_DENSITY_NODES 1048576u // Maximum nodes of the density grid.
// Units of hair whose projected area equals one face of a cell.
#define HAIR_DENSITY_UNITS 65536.0

#define HAIR_OCCLUSION_PARTS 4 // Parts of a strand that are tested separately.
// Texels of the application's depth along each axis that form one texel of the first Hi-Z level.
#define HAIR_HIZ_FIRST 8
#define HAIR_HIZ_NEXT 4  // Texels of a level along each axis that form one texel of the next.
#define HAIR_HIZ_TEXELS 8 // Maximum texels along each axis in which a box is looked up.

#define HAIR_NO_HIT 1e9 // First vertex inside a collider, for followers that have none.
#define HAIR_HIT_FOLLOWERS 32    // Followers per work group of hit.comp.
#define HAIR_HIT_THREADS 4       // Threads per follower.
// Columns of the texture with one texel per follower into which a prepass draws hits.
#define HAIR_HIT_COLUMNS 4096u
// Blend zone above the first vertex inside, as a fraction of the length.
#define HAIR_SWITCH_ZONE 0.2
#define HAIR_REPAIR_INTERVALS 8  // Intervals of a follower in the curves of strands/repair.glsl.
#define HAIR_REPAIR_CONTROLS 10  // Control points stored per follower.
#define HAIR_REPAIR_THREADS 32   // Threads of a work group.
#define HAIR_REPAIR_SAMPLES 64   // Maximum segments of a follower that are tested.
// HAIR_FOLLOWER_COLLISION_SINGLE_GUIDE of hair_follower_collision.
#define HAIR_COLLISION_IS_SINGLE_GUIDE 1

// A guide at rest, in groom space.
struct hair_guide {
    hair_vec4 root_frame; // Unit quaternion of the first segment, y along the segment.
    hair_uint first;      // Index of the first vertex.
    hair_uint count; // Number of vertices.
    float     arc_length; // m.
    hair_uint unused;
};
HAIR_SIZE(hair_guide)

// A guide vertex at rest, in groom space.
struct hair_rest {
    hair_vec4 position; // xyz: m. w: distance to the next vertex, m. 0 for the tip.
    // xyz: unit direction to the next vertex, in the frame that is parallel-transported here from
    // the previous segment. At the root it is in the root frame. w: distance to the vertex after
    // the next, m.
    hair_vec4 direction;
    // Frame of the segment to the next vertex, parallel-transported from the root's frame. Unit
    // quaternion, y along the segment.
    hair_vec4
        frame;
};
HAIR_SIZE(hair_rest)

// A guide vertex as part of a rod, for the solvers of Kirchhoff's equations. All quantities are
// divided by the mass of one metre of hair, which makes masses lengths. Follow-the-leader uses
// strain and factors differently, with the symbols of lib/rod/follow_segments.c. Its strain holds K
// r + a' and c, and its factor holds p, all divided by the inertia. Its factor_euler holds r and a
// damping rate. Its segment.w is the part of this rate that acts against the turn of the segment
// before, 1/s.
struct hair_rod {
    // xyz: rest strain 2 Im(conj(q_(i-1)) q_i) at vertex i, with q_i the frame of segment i. At the
    // root q_(i-1) is the frame of the scalp. w: bending stiffness divided by the length that it
    // acts over, m^3/s^2.
    hair_vec4 strain;
    // x: length of segment i, m. 0 for the tip. y: 1 / mass, 1/m. z: square of the angular
    // frequency of the pull to the rest pose, 1/s^2. w of a first vertex: method of the accurate
    // solver. 0 is explicit, 1 is BDF2, and 2 is implicit Euler, for a guide that a heavy tip pulls
    // taut. w of every vertex in the mixed scheme: 2 w0, twice the real part of conj(q_(i-1)) q_i
    // at rest. 0 for the tip.
    hair_vec4 segment;
    // Row of L D L^T of the implicit system of the solver's own method. x: 1/D. y: L(i+1,i). z:
    // L(i+2,i). w: number of the first pin beyond this vertex, counted from 1. 0 if there is none.
    hair_vec4 factor;
    // Row of L D L^T of implicit Euler, the fallback method.
    hair_vec4 factor_euler;
};
HAIR_SIZE(hair_rod)

// A guide vertex in motion. Positions are relative to the head's origin, because floats then
// resolve micrometres far from the world's origin. The displacement is stored and not differenced,
// for the same reason.
struct hair_state {
    // xyz: position along the world's axes from the head's origin, at the end of the substep, m. w
    // of a guide's first vertex: known history. 0 means none, and the guide is at rest. 1 means the
    // displacement. 2 means hair_history as well. See predict.glsl.
    hair_vec4 position;
    // xyz: displacement over the last substep, in the world, m. w: tension / line density, m^2/s^2.
    hair_vec4 displacement;
};
HAIR_SIZE(hair_state)

// A pin of a guide vertex, beside the scalp. Pins are in the order of guides and their vertices.
struct hair_held {
    // xyz: target at the end of the step, m. w: 0 if the target is in groom space, -1 if it is in
    // the world, from the head's origin.
    hair_vec4 place;
    // Span that ends at this pin. x, y: pinned vertices at its ends, counted from the guide's root.
    // z: length between them at rest, m. 0 if nothing holds the guide before this pin. w: 1 if the
    // next pin in the list is of the same guide.
    hair_vec4 span;
};
HAIR_SIZE(hair_held)

// History of a guide vertex for BDF2, beside its state. Velocities are stored as displacements per
// substep.
struct hair_history {
    hair_vec4 rate;        // xyz: at the end of the last substep, m.
    // xyz: at the end of the substep before the last, m. w: 1 if the vertex touched a collider at
    // the end of the last substep.
    hair_vec4 rate_before;
};
HAIR_SIZE(hair_history)

// A sphere with two equal ends, a capsule, or a capsule around another shape. It is given at the
// start and at the end of the step, from the head's origin.
struct hair_capsule {
    hair_vec4 start[2]; // xyz: ends of the axis, m. w: radius, m.
    hair_vec4 end[2];
    // xyz: rotation about its own axis over the step, radians. A sphere may rotate about any axis.
    // w: maximum distance that an end travels, m.
    hair_vec4 spin;
};
HAIR_SIZE(hair_capsule)

// The collider itself, where a hair_capsule only encloses it, at the start and at the end of the
// step.
struct hair_body {
    // xyz: from the head's origin, m. [0].w: rounding, m. [1].w: factor of the friction.
    hair_vec4 position[2];
    hair_vec4 rotation[2]; // Unit quaternions of one hemisphere.
    hair_vec4 size;        // xyz: as the shape says, m. w: hair_shape.
};
HAIR_SIZE(hair_body)

// A collider, for scenes with any number of them.
struct hair_contact {
    HAIR_STRUCT(hair_capsule) around; // The collider, or a sphere around it.
    HAIR_STRUCT(hair_body) body;      // size.x of a collision mesh is its scale.
    hair_vec4 grid; // Grid of a collision mesh. xyz: first node, m. w: spacing of nodes, m.
    hair_uint nodes_x, nodes_y, nodes_z;
    hair_uint first; // Index of its first node.
    // Sphere around the collider during the rest of the step. xyz: centre, m. w: radius with the
    // margin, m.
    hair_vec4 ball;
};
HAIR_SIZE(hair_contact)

// Pose of the head at the end of a substep.
struct hair_substep {
    hair_vec4 rotation;     // Unit quaternion.
    // xyz: displacement of the head's origin over the substep, m. w: fraction of the step done at
    // its end.
    hair_vec4 displacement;
};
HAIR_SIZE(hair_substep)

// Parameters of a step that all its substeps share. Frequencies are angular.
struct hair_step_params {
    hair_vec4 gravity;   // xyz: m/s^2. w: length of a substep, s.
    float     keep;      // Fraction of the velocity left after a substep: exp(-damping dt).
    float     shape_frequency_root; // Frequency of the pull to the rest pose at the root, 1/s.
    float     shape_frequency_tip; // Frequency of the pull at the tip, 1/s.
    float     angular; // Square of the frequency of angular forces, 1/s^2.
    float     bend;    // Fraction of the bending error that an iteration corrects.
    float     collision_margin;  // m.
    hair_uint iterations;
    hair_uint substeps;
    hair_uint guides;
    hair_uint colliders;
    hair_uint smooth_vertices; // Per guide.
    float     alpha;           // Current time within the last substep. 0 is its start, 1 its end.
    hair_vec4 rotation_before; // Head rotation at the start of the last substep.
    hair_vec4 rotation_after;  // Head rotation at the end of the last substep.
    hair_vec4 rotation_now;
    hair_vec4 last_displacement; // xyz: displacement of the head's origin over the last substep, m.
    // Parameters of the rod solvers.
    hair_vec4 rotation_start; // Head rotation at the start of the first substep of this dispatch.
    // Stiffness about the section's x axis, about the strand's axis, and about the section's z
    // axis. All are relative to bending.
    hair_vec4 ratio;
    // h (1 - exp(-damping h)) / damping, s^2, with h the length of a substep. Displacement per
    // acceleration.
    float     kick;
    float     damping;        // 1/s.
    float     friction;
    float     fraction_start; // Fraction of the step done before this dispatch.
    // Factor of displacements after a change of the substep's length. Otherwise 1.
    float     rescale;
    hair_uint vertices; // Vertices of all guides.
    hair_uint bodies; // One bit per collider that is not a capsule, of HAIR_FEW_COLLIDERS.
    hair_uint rounds; // Rounds of implicit.glsl's cyclic reduction before its last.
    hair_uint list;   // 0 or 1. This dispatch's header in health[].
    hair_uint substep_first; // Index in `substep` at which this dispatch begins.
    hair_uint part_rounds; // Loop iterations that parts of a substep may take. See leap_parts.glsl.
    hair_uint unused0;
    // Parameters of the grid for looking up any number of colliders, from the head's origin.
    hair_vec4 cells_lower; // xyz: lower corner, m. w: 1 / side of a cell, 1/m.
    hair_uint cells_x, cells_y, cells_z;
    // Half the length of a vertex's path on which the grid finds everything that it can touch, m.
    float     cells_slack;
    HAIR_STRUCT(hair_substep) substep[HAIR_STEP_SUBSTEPS];
    HAIR_STRUCT(hair_capsule) collider[HAIR_STEP_COLLIDERS];
    HAIR_STRUCT(hair_body) body[HAIR_STEP_COLLIDERS];
};
HAIR_SIZE(hair_step_params)

// Wind parameters of the rod solvers.
struct hair_wind_params {
    // xyz: velocity of the wind far from all obstacles, m/s. w: standard deviation of gusts, m/s.
    hair_vec4 velocity;
    // xyz: lower corner of the fluid's box, from the head's origin, m. w: 1 / its side, 1/m. 0 if
    // there is no fluid.
    hair_vec4 box;
    hair_vec4 gust_turn; // Unit quaternion from the world to the gust texture.
    // xyz: the head's origin in the gust texture at the end of the dispatch. w: 1 / the texture's
    // side, 1/m.
    hair_vec4 gust_from;
    float     per_speed; // Reynolds number of a strand per wind speed across it, s/m.
    float     viscous;   // Drag by the air's viscosity, per mass of the strand, 1/s.
    float     shelter; // Fraction of the shelter by spheres that is applied.
    hair_uint balls;
    hair_uint sources;
    hair_uint volume; // 1 if there is a texture of velocities.
    hair_uint unused0, unused1;
    // Matrix from positions relative to the head's origin at the end of the dispatch to texture
    // coordinates.
    hair_mat4 to_volume;
    hair_vec4 ball[HAIR_WIND_BALLS];     // xyz: from the head's origin, m. w: radius, m.
    // xyz: from the head's origin at the end of the dispatch, m. w: radius, m.
    hair_vec4 source[HAIR_WIND_SOURCES];
    // xyz: unit direction. 0 if the source blows to all sides. w: speed, m/s.
    hair_vec4 jet[HAIR_WIND_SOURCES];
    // Head at the start of each substep, relative to the end of the dispatch. xyz: the head's
    // origin, m. w: time, s, below 0.
    hair_vec4 at[HAIR_STEP_SUBSTEPS];
};
HAIR_SIZE(hair_wind_params)

// Contribution of a guide vertex to the hair-hair grid, in the grid's units.
struct hair_grid_splat {
    hair_uint mass, volume;
    hair_uint first, end; // Vertices of its guide.
};
HAIR_SIZE(hair_grid_splat)

// Parameters of the hair-hair grid of mass, momentum and volume. The grid moves with the head.
struct hair_grid_params {
    hair_vec4 rotation; // Head rotation at the end of the last substep.
    // xyz: displacement of the head's origin over the last substep, m. w: speed per displacement,
    // 1/s.
    hair_vec4 moved;
    hair_vec4 lower;    // xyz: node 0, in the head's frame, m. w: spacing of nodes, m.
    hair_uint nodes_x, nodes_y, nodes_z;
    hair_uint vertices;  // Vertices of all guides.
    float     cohesion;  // Rate at which relative velocities are removed, 1/s.
    float     pressure_stiffness;    // Pressure coefficient, m^2/s^2.
    // Cells travelled to the middle of a block at HAIR_GRID_SPEED. 0 leaves positions as they are.
    float     ahead;
    // 1 / mass, in units, of a length of strand that never lies at one node.
    float     per_strand;
};
HAIR_SIZE(hair_grid_params)

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
    // Positions in the pixel of samples 2 i and 2 i + 1: xy and zw.
    hair_vec4 at[HAIR_RASTER_SAMPLES / 2];
};
HAIR_SIZE(hair_raster_params)

// Parameters of the activity test of guides that may have come to rest.
struct hair_activity_params {
    hair_uint vertices; // Vertices of all guides.
    hair_uint parity;     // 0 or 1. The answer that is written. The other one is cleared.
    hair_uint anchors;  // 1 if the current positions become the anchors.
    float     rate;     // Speed per displacement, 1/s.
};
HAIR_SIZE(hair_activity_params)

// Parameters by which motion.comp measures guides after the last substep.
struct hair_motion_params {
    hair_vec4 turn;  // Rotation of the head over the last substep, unit quaternion.
    // xyz: displacement of the head over the last substep, m. w: speed per displacement, 1/s.
    hair_vec4 moved;
    hair_uint guides;
    // Time for which nothing has driven the guides, s. Below 0 no guide is restless.
    float     calm;
    float     wait;  // Time that damping needs to calm any guide, s.
    float     creep; // Time added to `wait` per metre of a guide's length, s/m.
};
HAIR_SIZE(hair_motion_params)

// Parameters by which energy.comp watches the guides after a step.
struct hair_energy_params {
    hair_uint begins; // 1 if this step begins a new observation.
    hair_uint ends;   // 1 if the window ends with this step.
    float     time;   // Length of the step's substeps, s.
    float     rate;   // Speed per displacement, 1/s.
};
HAIR_SIZE(hair_energy_params)

// Mechanical energy of a guide, divided by its mass per metre, m^3/s^2.
struct hair_energy {
    // x: kinetic energy. y: energy of gravity, 0 at the root. z: energy of bending and twist. w:
    // energy of the pull to the rest pose.
    hair_vec4 now;
    // x: upper bound of energy and loss. y: their maximum in this window. z: half of the energy
    // that damping has taken in this window. w: greatest kinetic energy. Each earlier window counts
    // half as much as the one after it.
    hair_vec4 window;
};
HAIR_SIZE(hair_energy)

// A strand that is interpolated while drawing. t goes from 0 at its root to 1 at its tip, and u = t
// length_ratio. g_k(u) and F_k(u) are the position and frame of guide k. o(t) is the cubic Bezier
// curve of `offset`.
//   single(t) = g_0(u) + F_0(u) o(t)
//   multi(t)  = (1 - weight1 - weight2) g_0(u) + weight1 g_1(u) + weight2 g_2(u)
//               + F_0(u) (offset[1..3].w)
struct hair_follower {
    hair_uint guide0, guide1, guide2;
    hair_uint seed;
    float     weight1, weight2; // Barycentric weights of guides 1 and 2.
    // Its length as a fraction of guide 0's. Beyond 1 it goes on straight.
    float     length_ratio;
    // 0 for a single-strand follower. 1 for multi-strand at the root, tending to single-strand as
    // it clumps.
    float     multi;
    // xyz: control points in guide 0's frame, m. [0].w: radius, as a fraction of the look's.
    hair_vec4 offset[4];
};
HAIR_SIZE(hair_follower)

// Root binding: the point on the scalp to which a root is bound, at rest.
struct hair_root_binding {
    hair_uint corner0, corner1, corner2; // Scalp vertices of its triangle.
    float     weight1, weight2;          // Barycentric weights of corner1 and corner2.
    float     away_x, away_y, away_z;    // Offset from the point to the root, m.
};
HAIR_SIZE(hair_root_binding)

// Times of hair_root_transform.
#define HAIR_ROOT_TRANSFORM_THEN 0 // End of the last substep before this step.
#define HAIR_ROOT_TRANSFORM_START 1  // Start of this step.
#define HAIR_ROOT_TRANSFORM_END 2    // End of this step.
#define HAIR_ROOT_TRANSFORM_BEFORE 3 // Start of the last substep done.
#define HAIR_ROOT_TRANSFORM_AFTER 4  // End of the last substep done.
#define HAIR_ROOT_TRANSFORMS 5

// Scalp motion of a guide's root in the head. The rest pose is rotated about the root, then
// shifted.
struct hair_root_transform {
    hair_vec4 shift[HAIR_ROOT_TRANSFORMS]; // xyz: m, in the head's frame.
    hair_vec4 turn[HAIR_ROOT_TRANSFORMS];  // Unit quaternions.
};
HAIR_SIZE(hair_root_transform)

// Bits of hair_scalp_params.what.
#define HAIR_SCALP_CHANGED 1u // The scalp was set since the last step.
#define HAIR_SCALP_RESET 2u // There is no history.
#define HAIR_SCALP_AGAIN 4u // The step has already begun. Only its substeps continue.

// Parameters of the passes of a skinned scalp. A position in the head's frame is rotation (position
// + offset).
struct hair_scalp_params {
    hair_vec4 rotation;
    hair_vec4 offset;   // xyz: m.
    hair_uint vertices; // Vertices of the scalp.
    hair_uint guides;
    hair_uint followers;
    hair_uint first, stride; // First position and stride in the application's buffer, in floats.
    hair_uint flags;          // HAIR_SCALP_ bits.
    hair_uint substeps;      // Substeps of this step.
    // Fraction of the step done at the start of its last substep, where it has two or more.
    float     fraction_before;
    float     fraction_after;   // Fraction of the step done at the end of its last substep.
    hair_uint smooth_vertices;
    hair_uint unused0, unused1;
};
HAIR_SIZE(hair_scalp_params)

// Followers that are drawn together, in an order that may be cut short. Grooms make patches of at
// most HAIR_MAX_ISOLINES followers.
struct hair_patch {
    hair_uint first; // First follower.
    hair_uint count;
    float     density;    // Local density: fraction of the followers that grow here. [0, 1].
    hair_uint guide;      // Guide whose root is the origin of `reach`.
    hair_vec4 map_density;   // Factor of the density by each set of maps.
    hair_vec4 map_thickness; // Factor of the followers' radius by each set of maps.
    float     reach;         // Maximum distance of any follower from the guide's root, m.
    float     length;        // Length of its longest follower, m.
    float     importance;    // Factor of the size on the screen.
    hair_uint occluded;        // 1 if the last occlusion culling found the patch occluded.
};
HAIR_SIZE(hair_patch)

// Place and range of the distance field.
struct hair_field_params {
    hair_vec4 rotation; // Head rotation, unit quaternion.
    // xyz: lower corner of the field's box in the head's frame, m. w: side of a voxel, m.
    hair_vec4 lower;
    // xyz: 1 / sides of the box, 1/m. w: distance that stands for all greater distances, m.
    hair_vec4 inverse;
};
HAIR_SIZE(hair_field_params)

// A collider in the head's frame.
struct hair_field_collider {
    hair_vec4 position; // xyz: m. w: rounding, m.
    hair_vec4 rotation; // Unit quaternion from its own axes to the head's.
    hair_vec4 size;     // xyz: as its shape says, m. w of a collision mesh: its scale.
    hair_vec4 grid;     // Grid of a collision mesh. xyz: first node, m. w: spacing of nodes, m.
    hair_uint nodes_x, nodes_y, nodes_z;
    hair_uint first;  // Index of its first node.
    hair_uint shape;  // hair_shape.
    hair_uint number; // Index among the instance's colliders.
    hair_uint unused0, unused1;
};
HAIR_SIZE(hair_field_collider)

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
    hair_vec4
        plane;
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

// HAIR_BRICK^3 voxels, and the colliders that reach into them.
struct hair_field_brick {
    hair_uint at;    // Position among bricks: x + (y << 10) + (z << 20).
    hair_uint first; // First member.
    hair_uint count;
    hair_uint unused;
};
HAIR_SIZE(hair_field_brick)

// Parameters of the fluid. Its box is a cube along the world's axes.
struct hair_fluid_params {
    hair_vec4 lower;    // xyz: lower corner from the head's origin, m. w: side of a cell, m.
    // xyz: movement of the box since the last step, cells. w: cells per m/s in a step, s/m.
    hair_vec4 shift;
    hair_vec4 wind;     // xyz: of the scene, m/s. w: standard deviation of gusts, m/s.
    hair_vec4 gain;     // xyz: change of the wind since the last step, m/s.
    hair_vec4 rotation; // Head rotation, unit quaternion.
    hair_vec4 gust_turn, gust_from; // Fields of hair_wind_params, at the start of the step.
    hair_uint cells;    // Along each axis.
    hair_uint colliders;   // 0 if no collider is in reach.
    hair_uint open;     // 0 if the box is closed on all sides.
    hair_uint nodes;    // Nodes of the grid of hair along each axis.
    // Length of strands in a cubic metre per mass at a grid node, 1/m^2. 0 if there is no hair.
    float     thick;
    float     per_speed; // Reynolds number of a strand per wind speed, s/m.
    float     viscous;   // Drag of strands per viscous force, times the step, m^2.
    hair_uint unused;
};
HAIR_SIZE(hair_fluid_params)

// A level of the fluid's grid, and what a pass does there. Each level has half as many cells along
// an axis as the level before it.
struct hair_fluid_level {
    hair_uint cells; // Along each axis.
    hair_uint slot, cell; // The level's first slot and cell.
    hair_uint coarse_slot, coarse_cell; // First slot and cell of the next level.
    hair_uint color;
    float     relax; // Relaxation factor.
    hair_uint unused;
};
HAIR_SIZE(hair_fluid_level)

// Velocity of a collider. At a position p it is velocity + cross(spin, p).
struct hair_fluid_motion {
    hair_vec4 velocity; // xyz: at the head's origin, m/s.
    hair_vec4 spin;     // xyz: 1/s.
};
HAIR_SIZE(hair_fluid_motion)

// Curves of a look along a strand.
#define HAIR_CURVE_TAPER 0
#define HAIR_CURVE_CLUMP 1
#define HAIR_CURVE_CLUMP_WIDTH 2
#define HAIR_CURVE_TIP_STRAY 3
#define HAIR_CURVE_STRAY 4
#define HAIR_CURVE_FRIZZ 5
#define HAIR_CURVE_CURL 6
#define HAIR_CURVES 7

// Parameters by which a look shapes a strand, from hair_look.
struct hair_strand_look {
    // Intervals of each curve. An interval is a cubic c.x + x (c.y + x (c.z + x c.w)), with x from
    // 0 to 1.
    hair_vec4 curve[HAIR_CURVES * HAIR_CURVE_INTERVALS];
    // Cubics of one turn of a curl of radius 1, in the same form: those of x, then those of z.
    hair_vec4 loop[2 * HAIR_TURN_PLACES];
    float tip_stray_fraction, stray_fraction;
    float kinks; // 1/m.
    float drawn; // Fraction of the length.
    float length_variation;
    float curl_radius; // m.
    float curl_waves;  // 1/m.
    float curl_turns;
    float curl_guide_phase, curl_strand_phase, curl_spread, curl_left_fraction;
    // Bounds of how far the look moves a strand.
    float     max_stray; // Fraction of the length.
    float     max_offset; // m.
    float     max_width; // Factor of the offsets, at least 1.
    hair_uint unused;
};
HAIR_SIZE(hair_strand_look)

// A strand that is drawn without a tessellator.
struct hair_strand {
    hair_uint follower;
    float     width;   // Factor of its own width.
    float     widened; // Factor within `width` that compensates for strands that are left out.
    float     whole;   // Number of segments. The fraction is that of the last one.
};
HAIR_SIZE(hair_strand)

// An indirect command. A draw begins with what OpenGL reads of an indexed indirect draw. The
// dispatch that writes per-view vertices begins with three work group counts.
struct hair_draw_command {
    hair_uint count, instances, first, base_vertex, base_instance;
    // Strands in the list. Written in the first of two commands that draw a list, and in the
    // dispatch.
    hair_uint strands;
    hair_uint each;    // Vertices per strand, in the dispatch.
    hair_uint unused0;
};
HAIR_SIZE(hair_draw_command)

// Colours of strands.
struct hair_tint {
    hair_vec4 ramp[HAIR_CURVE_INTERVALS + 1]; // rgb: reflectance at equal steps along a strand.
    hair_vec4 streak; // rgb: reflectance of streaks. w: fraction of strands that are streaks.
    float     brightness;    // Relative spread between strands.
    float     hue;           // Relative spread of red against blue between strands.
    float     roughness;     // Relative spread between strands.
    float     tilt;          // Relative spread between strands.
    float     root_darkening;    // Fraction of the light lost at the root.
    float     root_recovery; // 1 / fraction of the strand over which the loss at the root fades.
    float     streak_clumping;  // Fraction of strands that are streaks together with their lock.
    float     sparkle;
    float     groom_color;       // Blend factor of the groom's colours.
    float     groom_color_power; // Exponent that darkens the groom's colours.
    hair_uint unused0, unused1;
};
HAIR_SIZE(hair_tint)

// xyz with w = 0: unit direction to the light. xyz with w = 1: position of the light from the
// head's origin, m.
#define HAIR_LIGHT_TO 0
// rgb: irradiance, for lights with a position at 1 m. w: squared distance below which the light
// gets no brighter, m^2.
#define HAIR_LIGHT_COLOR 1
// Axis of a spot light. xyz: unit direction towards the light. w: cosine at which its cone begins.
#define HAIR_LIGHT_AXIS 2
// x: slope of the brightness by the cosine. y: 1 / range squared, 1/m^2. 0 for an unlimited range.
// z: absorption, 1/m. w: index of its shadow map of hair. HAIR_SHADOW_MAPS for none.
#define HAIR_LIGHT_MORE 3
// x: index of its depth map of opaque geometry. HAIR_SHADOW_MAPS for none. y: bias of that map, m.
// Of both maps, z: metres per unit of depth. w: depth of an infinitely distant point in
// perspective. 0 for an orthographic map.
#define HAIR_LIGHT_MAP 4
#define HAIR_LIGHT_VECTORS 5

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
    hair_uint unused;
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
    // Matrices of r, g and b. The irradiance on a plane of unit normal n is (n, 1) sky (n, 1).
    hair_mat4 sky[3];
};
HAIR_SIZE(hair_draw_params)

#endif
