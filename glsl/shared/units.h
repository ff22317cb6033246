// units.h - texture units and image units.
#ifndef HAIR_SHARED_UNITS_H
#define HAIR_SHARED_UNITS_H

// Texture units. Vertex and tessellation stages use them because OpenGL guarantees those stages no
// storage buffers.
#define HAIR_UNIT_POSITION 0
#define HAIR_UNIT_FRAME 1 // uvec2 per vertex, as at HAIR_BIND_FRAME.
// hair_follower[] as unsigned integers, because float textures may flush small integers to 0.
#define HAIR_UNIT_FOLLOWER 3
#define HAIR_UNIT_PATCH 4    // hair_patch[], unsigned.
// hair_strand[], unsigned. Without a tessellator, in place of patches.
#define HAIR_UNIT_STRAND 4
// HAIR_BIND_TILE, for the pass that composes tiles, in place of guide positions.
#define HAIR_UNIT_TILE 0
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
// Vertex cache of the previous frame, as HAIR_UNIT_CACHED_POSITION. For motion vectors, in place
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
#define HAIR_UNIT_LENGTH 24 // float per follower. Fraction of its length that is left.
// hair_strand_look.factor_count floats per follower. Factors of single strands.
#define HAIR_UNIT_STRAND_FACTOR 25
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
// Impulses of colliders, of the rod solvers and of the pass that sums them.
#define HAIR_IMAGE_IMPULSE 0
#define HAIR_IMAGE_AIR 0 // Texture at HAIR_UNIT_AIR, of the pass that writes it.

#endif
