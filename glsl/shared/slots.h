// slots.h - binding slots of storage buffers and uniform buffers.
#ifndef HAIR_SHARED_SLOTS_H
#define HAIR_SHARED_SLOTS_H

#define HAIR_LOCATION_GROUPS 0 // Uniform of compute passes. See workgroup.glsl.

// Storage buffers of compute passes. OpenGL 4.5 guarantees only eight to a compute shader.
#define HAIR_BIND_GUIDE 0    // hair_guide[] per guide. Read-only.
#define HAIR_BIND_REST 1     // hair_rest[] per guide vertex. Read-only.
#define HAIR_BIND_STATE 2    // hair_state[] per guide vertex.
// hair_vec4[] per smoothed vertex. xyz: position from the head's origin, m. w: length from the
// root, m.
#define HAIR_BIND_POSITION 3
// uvec2[] per smoothed vertex. Unit quaternion, y along the strand, and stretch of the segment. See
// strands/packed_frame.glsl.
#define HAIR_BIND_FRAME 4
#define HAIR_FRAME_STRETCH 2e-4 // Unit of the stretch, which is at most 127 units.
// hair_vec4[] per smoothed vertex. xyz: unit tangent. Of strands/guide_tangents.comp.
#define HAIR_BIND_TANGENT 5
// hair_vec4[] per smoothed vertex. Guides at rest, from the root and in the root frame, m. Of
// strands/displace.comp, in place of HAIR_BIND_SOLVER_STATS. It writes the displacements of guides
// behind the positions of smoothed guides.
#define HAIR_BIND_GUIDE_SHAPE 6
// Buffers of the rod solvers, in place of those of smoothed vertices, which they neither read nor
// write.
#define HAIR_BIND_ROD 3     // hair_vec4[]. Rods, see sim/rod_buffers.glsl. Read-only.
#define HAIR_BIND_HISTORY 4 // hair_history[] per guide vertex.
// hair_vec4[] per guide vertex. Frame of its segment, unit quaternion, y along the segment.
#define HAIR_BIND_MATERIAL 5
// uint[] of every solver. It begins with HAIR_SOLVER_STATS_COUNT counters. For solvers that run as
// two programs, the two headers and the numbers of HAIR_SOLVER_STATS_LISTS follow. It ends with the
// order of guides, see sim/guide_level.glsl.
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
// Buffers of the passes that compute the distances of a body. They also have HAIR_BIND_NODE.
#define HAIR_BIND_BODY_POSITION 0 // float[]. xyz per vertex, voxels from the first node. Read-only.
#define HAIR_BIND_BODY_TRIANGLE 1 // uint[]. Three vertices per triangle. Read-only.
#define HAIR_BIND_BODY_NEAREST 2  // uint[] per node. Nearest triangle, see glsl/field/body.glsl.
#define HAIR_BIND_BODY_CROSSING 4 // int[] per node. Surfaces that its column enters, see there.
#define HAIR_BIND_BODY_POINT 5    // hair_vec4[] per node. Surface point, see body_line.comp.
#define HAIR_BIND_BODY_BEFORE 6   // float[]. Positions of the shape before. Read-only.
#define HAIR_BIND_BODY_CHANGE 7   // hair_body_change.
// Additional buffers of the hair-hair grid, whose passes also read the state and the history. The
// grid gives each guide vertex the effect of the hair around it.

// int[]. HAIR_GRID_NODE_NUMBERS per grid node. The grid of the fluid has four per node: mass and
// momentum.
#define HAIR_BIND_HAIR_GRID 3
#define HAIR_BIND_SPLAT 5    // hair_grid_splat[] per guide vertex. Read-only.
// hair_grid_node[] per grid node, in place of HAIR_BIND_SPLAT.
#define HAIR_BIND_NODE_MOTION 5
#define HAIR_BIND_SPLAT_ORDER 1 // uint[]. Guide vertices sorted by their cell at rest. Read-only.
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

// Buffer of the pass that sums the impulses of colliders. It also reads the state. uint[], see
// HAIR_IMPULSE_WORDS.
#define HAIR_BIND_IMPULSE_SUM 3

// Buffers of the scalp motion passes, which also have guides and the rest shape.

// float[]. The application's buffer, which contains the scalp's positions.
#define HAIR_BIND_GIVEN 2
#define HAIR_BIND_ROOT_TRANSFORM 3       // hair_root_transform[] per guide.
#define HAIR_BIND_SCALP 4      // float[]. xyz per scalp vertex, in the space of the application.
#define HAIR_BIND_SCALP_REST 5 // float[]. xyz per scalp vertex at rest, in groom space. Read-only.
// hair_root_binding[] of guides, then of followers. Read-only.
#define HAIR_BIND_ROOT_BINDING 6
#define HAIR_BIND_FOLLOWER 7   // hair_follower[]
// Buffers of the pass that skins the scalp. It has the scalp, and the scalp at rest.
#define HAIR_BIND_VERTEX_JOINTS 2 // hair_vertex_joints[] per scalp vertex. Read-only.
#define HAIR_BIND_JOINT 7         // hair_joint[] per joint. Read-only.

// Buffers of the pass that blends targets. The first two are also of smooth.comp.

// float[]. xyz per guide vertex: target at the end of the step, in the space of the application.
// Read-only.
#define HAIR_BIND_TARGET_POSITION 6
// hair_vec4[] per guide vertex. xyz: target at the end of the last substep, in the head's frame, m.
// w: weight.
#define HAIR_BIND_TARGET 7
#define HAIR_BIND_TARGET_WEIGHT 3 // float[] per guide. Weight to come. Read-only.

// Buffer of the pass that cuts guides, which also has those of the rod solvers but
// HAIR_BIND_ROD. hair_length_change[] per guide that changes. Read-only.
#define HAIR_BIND_LENGTH_CHANGE 3

// Buffers of the passes that find followers inside colliders.
#define HAIR_BIND_HIT 3    // float[] per follower. First vertex inside, or HAIR_NO_HIT.
// uvec2[] per follower and control point of strands/repair.glsl. Four halves.
#define HAIR_BIND_REPAIR 4
#define HAIR_BIND_LIST 5 // uint[]. Two counts, used alternately, then the followers to be repaired.
// Read-only buffers of guides, followers and patches, which compute shaders have in place of
// textures.
#define HAIR_BIND_STORED_FOLLOWER 0 // hair_follower[] per follower.
#define HAIR_BIND_STORED_FRAME 1    // uvec2[] per smoothed vertex, as at HAIR_BIND_FRAME.
#define HAIR_BIND_STORED_PATCH 2    // hair_patch[]. Occlusion culling writes this buffer.
#define HAIR_BIND_STORED_POSITION 7 // hair_vec4[] per smoothed vertex, as at HAIR_BIND_POSITION.

// Buffers of the vertex cache of followers.

// hair_vec4[] per follower vertex. xyz: position from the head's origin, m. w: radius, m.
#define HAIR_BIND_CACHED_POSITION 4
#define HAIR_BIND_SHADED 6           // uvec2[] per follower vertex. Light to the eye, as halves.
// uvec2[] per follower vertex. Unit tangent, three 16-bit numbers that map to [-1, 1].
#define HAIR_BIND_CACHED_TANGENT 5
// hair_vec4[] per patch. Lower corner, then upper corner of the box around its vertices, m.
#define HAIR_BIND_PATCH_BOUNDS 5

// Buffers of the passes that write the strand list, which is drawn without a tessellator.
#define HAIR_BIND_START 3   // uint[] per patch. Index of its first strand in the list.
#define HAIR_BIND_STRAND 4  // hair_strand[] per drawn strand.
// hair_draw_command[]. Commands 0 and HAIR_PAIRED_COMMAND draw the strands beyond the last full
// instance. Command HAIR_EXPAND_VIEW_COMMAND dispatches the pass that writes the per-view vertices.
// Draws of draw.draw_instances full instances follow from HAIR_LIST_COMMANDS on. Each has
// HAIR_LIST_KINDS commands: by the two ends of segments, by pairs of vertices, and sorted.
#define HAIR_BIND_COMMAND 5
#define HAIR_PAIRED_COMMAND 1
#define HAIR_EXPAND_VIEW_COMMAND 2
#define HAIR_LIST_COMMANDS 3
#define HAIR_LIST_KINDS 3
#define HAIR_LIST_LINES 0
#define HAIR_LIST_PAIRED 1
#define HAIR_LIST_SORTED 2
#define HAIR_PAIRED_INDICES 6 // Per segment.
// Buffers of the pass that writes the per-view vertices, in the order of the strand list. It writes
// to HAIR_BIND_CACHED_POSITION and the two slots after it, in their formats. With HAIR_SIDES it
// writes clip-space positions to HAIR_BIND_CACHED_POSITION: one hair_vec4 per side of a ribbon
// vertex, or one per line vertex.
#define HAIR_BIND_LIST_COMMAND 3  // hair_draw_command[], as at HAIR_BIND_COMMAND. Read-only.
// hair_strand[] of the strand list, in place of HAIR_BIND_STORED_PATCH. Read-only. The compute
// rasteriser has it too.
#define HAIR_BIND_LISTED_STRAND 2
// Additional buffers of the passes that sort the segments of listed strands.
#define HAIR_BIND_HISTOGRAM 0 // uint[HAIR_SORT_BUCKETS]. Depth histogram, later its prefix sum.
#define HAIR_BIND_SORTED_SEGMENTS 1 // uvec2[] per segment. Indices of its two vertices.

// Buffers of the compute rasteriser.

// uvec2[] per sample. x: segment number of the visible ribbon. y: its depth as bits of a float,
// inverted where depth decreases with distance. HAIR_NOBODY means that no ribbon is visible.
// Depth-only passes have a uint[] with y alone.
#define HAIR_BIND_NEAREST 0
// uint[]. Command of HAIR_TILE_FIRST numbers, then the tiles that contain hair.
#define HAIR_BIND_TILE 1
#define HAIR_BIND_BATCH 3   // hair_batch_head[]. Read-only.
// Vertices of ribbons, as at HAIR_BIND_CACHED_POSITION and HAIR_BIND_CACHED_TANGENT. Read-only. The
// passes that sort segments have the positions too.
#define HAIR_BIND_RIBBON_POSITION 6
#define HAIR_BIND_RIBBON_TANGENT 7
// Buffers of the self-shadowing passes.
// uint[HAIR_DENSITY_FIRST]. Bounding box of all hair, in the encoding of light/float_key.glsl.
// uint[] per node of the density grid follows. Amount of hair.
#define HAIR_BIND_DENSITY 6
#define HAIR_DENSITY_FIRST 8 // The box has six numbers.
// uint[] per node. Two halves for the visible fraction of the sky and the strands met on the way to
// the first light, then a float for each further light.
#define HAIR_BIND_DENSITY_LIGHT 3
#define HAIR_BIND_DENSITY_STRAND 4 // hair_vec4[] as at HAIR_BIND_CACHED_POSITION. Read-only.
// uint[] per follower vertex. One number for the sky, then one per light. See
// vertex_transmittance.comp.
#define HAIR_BIND_LIGHT 5

// Buffers of occlusion culling against the application's depth.

// float[]. Hi-Z: farthest depth of every texel of every level. See glsl/draw/hiz.glsl.
#define HAIR_BIND_HIZ 3
// hair_vec4[] per guide and part. Lower corner, then upper corner, m.
#define HAIR_BIND_GUIDE_BOUNDS 4

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

// Uniform buffers.
#define HAIR_BIND_STEP 0         // hair_step_params.
#define HAIR_BIND_DRAW 1         // hair_draw_params.
#define HAIR_BIND_FIELD 2        // hair_field_params.
// hair_wind_params, of the rod solvers and of the pass that draws the wind.
#define HAIR_BIND_WIND 2
#define HAIR_BIND_HAIR_GRID_PARAMS 1 // hair_grid_params, of passes that draw nothing.
#define HAIR_BIND_SCALP_PARAMS 1 // hair_scalp_params, of passes that draw nothing.
#define HAIR_BIND_BODY 0         // hair_body_params, of the passes that compute a body's distances.
#define HAIR_BIND_FLUID 0        // hair_fluid_params, of the fluid passes.
#define HAIR_BIND_LEVEL 1        // hair_fluid_level, of the fluid passes.
#define HAIR_BIND_TARGET_PARAMS 1 // hair_target_params, of passes that draw nothing.
#define HAIR_BIND_ACTIVITY_PARAMS 1  // hair_activity_params, of passes that draw nothing.
#define HAIR_BIND_ENERGY_PARAMS 1 // hair_energy_params, of passes that draw nothing.
#define HAIR_BIND_MOTION_PARAMS 1 // hair_motion_params, of passes that draw nothing.
// hair_debug_params, of the passes that draw colliders, the distance field and the wind.
#define HAIR_BIND_DEBUG 0
#define HAIR_BIND_OCCLUSION 0         // hair_occlusion_params, of occlusion culling.
// hair_group_factors[HAIR_STRAND_GROUPS], of passes that compute or shade vertices of followers.
#define HAIR_BIND_GROUP_LOOKS 0
#define HAIR_BIND_RASTER 0       // hair_raster_params, of the compute rasteriser.

#endif
