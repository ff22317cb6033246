// shared.h - what C, C++ and GLSL must agree on: constants, binding slots, struct layouts.
//
// Rule: members are 4-byte scalars, hair_vec4, hair_mat4 or arrays of structs of these; a struct is a
// multiple of 16 bytes. Then std430, std140, C and C++ lay it out alike, with no padding to get wrong.
// (A vec3 would be aligned as a vec4 and take 12 bytes: never use one here.) The asserts below and
// tests/gpu/layout_test.c hold the rule.
#ifndef HAIR_SHARED_H
#define HAIR_SHARED_H

#ifdef GL_core_profile
#define hair_vec4 vec4
#define hair_mat4 mat4
#define hair_uint uint
#define HAIR_STRUCT(T) T
#define HAIR_SIZE(T, n)
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
#define HAIR_SIZE(T, n) static_assert(sizeof(struct T) == n, #T " is not as GLSL lays it out");
#else
#define HAIR_SIZE(T, n) _Static_assert(sizeof(struct T) == n, #T " is not as GLSL lays it out");
#endif
#endif

// Storage buffers of compute passes: OpenGL 4.5 promises a compute shader no more than eight.
#define HAIR_BIND_GUIDE 0    // hair_guide[]    per guide, never written
#define HAIR_BIND_REST 1     // hair_rest[]     per guide vertex, never written
#define HAIR_BIND_STATE 2    // hair_state[]    per guide vertex
#define HAIR_BIND_POSITION 3 // hair_vec4[] per smooth vertex: position from the head, length from the root
#define HAIR_BIND_TANGENT 4  // hair_vec4[]     per smooth vertex: unit tangent, stretch of the segment
#define HAIR_BIND_FRAME 5    // hair_vec4[]     per smooth vertex: unit quaternion, y along the strand
// The solvers of rods read and write no smooth vertices; they have, in their place:
#define HAIR_BIND_ROD 3     // hair_rod[]      per guide vertex, never written
#define HAIR_BIND_HISTORY 4 // hair_history[]  per guide vertex
#define HAIR_BIND_MATERIAL                                                                                   \
    5 // hair_vec4[]     per guide vertex: frame of its segment, unit quaternion, y along it
#define HAIR_BIND_HEALTH 6    // uint[], of every solver: HAIR_HEALTH_COUNT counts; then, of those that go in two, HAIR_HEALTH_LISTS
#define HAIR_BIND_BEND 7      // hair_vec4[], of the mixed scheme in its place: see hair_rods_bend_size()
#define HAIR_BIND_REDUCTION 7 // hair_vec4[] per round and guide vertex, never written: see lib/sim/reduce.c
// The pass that writes the field has neither guides nor these:
#define HAIR_BIND_BRICK 0  // hair_field_brick[] per work group
#define HAIR_BIND_MEMBER 1 // uint[]             places in HAIR_UNIT_WORK of the solids that reach into each brick
#define HAIR_BIND_NODE 3   // float[]            distances at the nodes of forms, m
// The passes of the crowd, which is what a hair feels of the hair around it, read the state and the history; and:
#define HAIR_BIND_CROWD 3    // int[]          of the grid: HAIR_CROWD_NODE_NUMBERS per node; of the fluid's four, mass and momentum
#define HAIR_BIND_SHARE 5    // hair_share[]   per guide vertex, never written
#define HAIR_BIND_LIMIT 6    // float[]        per node, never written: volume from which it presses
#define HAIR_BIND_PUSH 7     // hair_vec4[]    per guide vertex: acceleration, m/s^2

// The pass that looks at how far guides stir reads the state, and:
#define HAIR_BIND_ANCHOR 3 // hair_vec4[]  per guide vertex: where it was, from the head's origin
#define HAIR_BIND_STIR 4   // uint[4]      two in turn of: farthest from there, m, and fastest, m/s, as bits of floats

// The passes that diagnose hair have the buffers of the solvers of rods; and:
#define HAIR_BIND_FOUND 3  // uint[HAIR_FOUND_COUNT], of motion.comp
#define HAIR_BIND_ENERGY 7 // hair_energy[] per guide, of energy.comp

// The passes that let roots ride on a skinned scalp have guides, the rest shape, and:
#define HAIR_BIND_GIVEN 2      // float[]     what holds the scalp's positions, as it is given
#define HAIR_BIND_RIDE 3       // hair_ride[]     per guide
#define HAIR_BIND_SCALP 4      // float[]     xyz per vertex, as it is given
#define HAIR_BIND_SCALP_REST 5 // float[]     and at rest, in groom space, never written
#define HAIR_BIND_SEAT 6       // hair_seat[]     of guides, then of followers, never written
#define HAIR_BIND_FOLLOWER 7   // hair_follower[]

// Of the passes that look for followers inside solids:
#define HAIR_BIND_HIT 3    // float[]     per follower: the first vertex inside, HAIR_NO_HIT if none is
#define HAIR_BIND_REPAIR 4 // uvec2[]     per follower and control point of repair.glsl: four halves
#define HAIR_BIND_LIST 5   // uint[]      two counts, in turn, and the followers that are to be repaired
// The one with a work group per follower, and the one that writes followers out, have no textures of guides and followers
// but, all never written:
#define HAIR_BIND_STORED_POSITION 0 // hair_vec4[] per smooth vertex, as at HAIR_BIND_POSITION
#define HAIR_BIND_STORED_TANGENT 1  // hair_vec4[] likewise
#define HAIR_BIND_STORED_FRAME 2    // hair_vec4[] likewise
#define HAIR_BIND_STORED_FOLLOWER 6 // hair_follower[]

// Of the pass that writes followers out:
#define HAIR_BIND_EXPANDED 4         // hair_vec4[] per follower vertex: position from the head's origin, radius
#define HAIR_BIND_SHADED 6           // uvec2[]     per follower vertex: light to the eye, as halves
#define HAIR_BIND_EXPANDED_TANGENT 5 // uvec2[]     per follower vertex: three 16-bit shares of [-1, 1]

// Of the passes that list the strands that are drawn without a tessellator:
#define HAIR_BIND_START 3   // uint[]              per patch: where its strands begin in the list
#define HAIR_BIND_STRAND 4  // hair_strand[]       per strand that is drawn
#define HAIR_BIND_COMMAND 5 // hair_draw_command[HAIR_COMMANDS]: two by their ends, one sorted, two by pairs of vertices, one
                            // that writes vertices
#define HAIR_COMMANDS 6
#define HAIR_SORTED_COMMAND 2
#define HAIR_PAIRED_COMMAND 3
#define HAIR_STAGE_COMMAND 5
#define HAIR_PAIRED_INDICES 6 // of a segment
// Of the pass that writes their vertices for one view, as at HAIR_BIND_EXPANDED and the two after it, in the order of the list; as
// they are drawn, at the first of those hair_vec4[] per side of a vertex, or of lines per vertex: in clip space.
#define HAIR_BIND_LISTED 3  // hair_draw_command[HAIR_COMMANDS], never written
// Of the passes that sort their segments, these too:
#define HAIR_BIND_BUCKET 0 // uint[HAIR_SORT_BUCKETS]
#define HAIR_BIND_SORTED 1 // uvec2[]              per segment: the numbers of its vertices

// Of the passes that make pixels of segments without units that draw:
#define HAIR_BIND_NEAREST 0 // uvec2[]     per sample: of the ribbon that is seen the number of its segment, and bits of its depth, negated
                            // where that falls with the distance; all bits: there is none. Of depth alone uint[]: the second
#define HAIR_BIND_TILE 1    // uint[]      per tile: 1: there is hair in it
// Of the passes that find how much light hair leaves to itself:
#define HAIR_BIND_DENSITY 0        // uint[]      per node of its grid: how much hair is there
#define HAIR_BIND_DENSITY_BOX 1    // uint[6]     around all hair
#define HAIR_BIND_DENSITY_LIGHT 3  // float[]     per node: share of the sky, then what each light meets
#define HAIR_BIND_DENSITY_STRAND 4 // hair_vec4[] as at HAIR_BIND_EXPANDED, never written
#define HAIR_BIND_LIGHT 5          // uint[]      per follower vertex: of the sky, then of each light; see light.comp

// Of the passes that find which patches the host's depth hides:
#define HAIR_BIND_HIDE_DEPTH 0 // float[]      farthest depth of every texel of every level: see glsl/hide.glsl
#define HAIR_BIND_HIDE_BOX 1   // hair_vec4[]  per guide and part of it: its lower corner, then its upper, m
#define HAIR_BIND_HIDE_PATCH 2 // hair_patch[]

// Of the passes of the fluid, which read what they do not write as textures:
#define HAIR_BIND_VELOCITY 0 // float[]     per axis and slot: of the face along the axis, m/s; see glsl/wind/fluid.glsl
#define HAIR_BIND_WALL 1     // float[]     likewise: of what closes it
#define HAIR_BIND_OPEN 2     // uint[]      per slot of every level: what is open of its faces, in 1023rds of 10 bits
#define HAIR_BIND_PRESSURE 3 // float[]     per cell of every level: difference of pressure as it changes a velocity, m/s
#define HAIR_BIND_RIGHT 4    // float[]     likewise: right side of its equation, m/s
#define HAIR_BIND_MOTION 5   // hair_fluid_motion[] per solid, never written

#define HAIR_LIGHTS 16     // of a view
#define HAIR_SHADOW_MAPS 4 // of all of its lights
#define HAIR_MOST_LIGHT 64000.0 // of a colour that is drawn: formats of half floats hold it

// Most Newton steps of the mixed scheme in a substep, by a work group, and by a thread for a guide of n vertices.
#define HAIR_MIXED_STEPS 16u
#define HAIR_MIXED_STEPS_BY_THREAD(n) ((n) <= 32 ? 16u : (n) <= 64 ? 12u : (n) <= 128 ? 8u : 5u)
#define HAIR_MIXED_ROW_VECTORS 14u // Vectors in a row of the mixed scheme: see glsl/sim/mixed_rows.glsl.

#define HAIR_HEALTH_EULER 0 // what is counted, as in hair_health
#define HAIR_HEALTH_FOLLOW 1
#define HAIR_HEALTH_RESET 2
#define HAIR_HEALTH_TAUT 3
#define HAIR_HEALTH_PARTS 4
#define HAIR_HEALTH_GAINING 5
#define HAIR_HEALTH_COUNT 6
#define HAIR_FOUND_RESTLESS 0 // what motion.comp finds, as in hair_health
#define HAIR_FOUND_OVERSTRETCHED 1
#define HAIR_FOUND_FASTEST 2 // m/s, as bits of a float
#define HAIR_FOUND_STRETCH 3 // the same
#define HAIR_FOUND_COUNT 4
#define HAIR_FIRST_GUIDES 28 // of a work group of subgroups, in programs that many guides go through first
// Two lists of guides follow in turn, at HAIR_HEALTH_COUNT: the work groups of an indirect dispatch over each, x, y and z, and its
// length. The guides of the list of this dispatch are at HAIR_HEALTH_LISTS.
#define HAIR_HEALTH_LIST 4 // of one of the two
#define HAIR_HEALTH_LISTS (HAIR_HEALTH_COUNT + 2 * HAIR_HEALTH_LIST)

// Uniform buffers.
#define HAIR_BIND_STEP 0         // hair_step_params
#define HAIR_BIND_DRAW 1         // hair_draw_params
#define HAIR_BIND_FIELD 2        // hair_field_params
#define HAIR_BIND_WIND 2         // hair_wind_params, of the solvers of rods and of the pass that draws air
#define HAIR_BIND_CROWD_PARAMS 1 // hair_crowd_params, of the passes that draw nothing
#define HAIR_BIND_SCALP_PARAMS 1 // hair_scalp_params, likewise
#define HAIR_BIND_FLUID 0        // hair_fluid_params, of the passes of the fluid,
#define HAIR_BIND_LEVEL 1        // and hair_fluid_level
#define HAIR_BIND_STIR_PARAMS 1  // hair_stir_params, likewise
#define HAIR_BIND_ENERGY_PARAMS 1 // hair_energy_params, likewise
#define HAIR_BIND_MOTION_PARAMS 1 // hair_motion_params, likewise
#define HAIR_BIND_SHOWN 0        // hair_shown_params, of the passes that draw solids, the field and air
#define HAIR_BIND_HIDE 0         // hair_hide_params, of the passes that find what is hidden
#define HAIR_BIND_RASTER 0       // hair_raster_params, of the passes that make pixels of segments

// Texture units. Vertex and tessellation stages are promised no storage buffers: they read these.
#define HAIR_UNIT_POSITION 0
#define HAIR_UNIT_TANGENT 1
#define HAIR_UNIT_FRAME 2
#define HAIR_UNIT_FOLLOWER 3 // hair_follower[], unsigned: float textures may flush small integers
#define HAIR_UNIT_PATCH 4    // hair_patch[], likewise
#define HAIR_UNIT_STRAND 4   // hair_strand[], likewise, in place of patches where there is no tessellator
#define HAIR_UNIT_TILE 2     // uint per tile: HAIR_BIND_TILE, of what composes them
#define HAIR_UNIT_STATE 0    // of redblack by transform feedback: hair_state[],
#define HAIR_UNIT_REST 1     // hair_rest[],
#define HAIR_UNIT_GUIDE 2    // hair_guide[], unsigned, and
#define HAIR_UNIT_OWNER 3    // uint per guide vertex: its guide
#define HAIR_UNIT_PUSH 0     // of the solvers of rods, whose storage slots are all taken: HAIR_BIND_PUSH
#define HAIR_UNIT_CONTACT 1  // of the same: hair_contact[], unsigned as followers are,
#define HAIR_UNIT_TIE 2      // hair_held[], of the same, where guides are tied
#define HAIR_UNIT_CELL 3     // uint[]: of each cell of the grid the place of its first member, from the array's
                             // start on; after the last cell's, where its members end; then the members
#define HAIR_UNIT_NODE 4     // float[]: HAIR_BIND_NODE
#define HAIR_UNIT_RIDE 6     // of the passes that need to know where a skinned scalp has roots: HAIR_BIND_RIDE
#define HAIR_UNIT_HIT 6      // float per follower, as in the buffer
#define HAIR_UNIT_REPAIR 7   // vec4 per follower and control point
#define HAIR_UNIT_EXPANDED 6         // of what draws expanded followers, in place of what they were made with
#define HAIR_UNIT_SHADED 1           // vec4 per vertex, of the same: as HAIR_BIND_SHADED
#define HAIR_UNIT_EXPANDED_TANGENT 7 // vec4 per vertex: xyz: in [0, 1] for [-1, 1]
#define HAIR_UNIT_FIELD 8    // the field: signed distance, m
#define HAIR_UNIT_SOLID 9    // and whose it is: number of the nearest solid
#define HAIR_UNIT_FIBRE 10   // of lib/draw/fibre.h
#define HAIR_UNIT_AIR 11     // the fluid's velocity at the middles of its cells, m/s
#define HAIR_UNIT_VELOCITY 0 // of the passes of the fluid: HAIR_BIND_VELOCITY as it was,
#define HAIR_UNIT_CARRIED 1  // as it has been carried along,
#define HAIR_UNIT_OPEN 2     // and what else is bound as its slots say
#define HAIR_UNIT_PRESSURE 3
#define HAIR_UNIT_THICKET 3 // in its place, of the pass that knows of hair: HAIR_BIND_CROWD in fours, of a grid all over the box
#define HAIR_UNIT_RIGHT 4
#define HAIR_UNIT_WALL 6
#define HAIR_UNIT_BARE_OPEN 5 // what is bound as HAIR_BIND_OPEN and _WALL as solids leave them; at their own units
#define HAIR_UNIT_BARE_WALL 7 // they are as hair does
#define HAIR_UNIT_BEFORE 2 // of what draws velocities, in place of frames: as HAIR_UNIT_EXPANDED, of the frame before
#define HAIR_UNIT_UV 5       // vec2 per follower: of its root on the scalp
#define HAIR_UNIT_COLOR 16   // by these: the host's texture of colours
#define HAIR_UNIT_PAINT 17   // vec4 per follower and place along it: colours of its own
#define HAIR_UNIT_SHADOW 12 // and the three after it: the host's shadow maps
#define HAIR_UNIT_LIGHT 18   // uint per follower vertex and light, unsigned: HAIR_BIND_LIGHT
#define HAIR_UNIT_BODY 19    // and the three after it: the host's depth maps of bodies
#define HAIR_UNIT_HIDDEN 23  // the host's depth of what hides hair
#define HAIR_UNIT_GUST 8     // of what knows air, in place of the field: gusts of deviation 1,
#define HAIR_UNIT_VOLUME 9   // and the application's velocities of the air, m/s
#define HAIR_UNIT_WORK 0     // hair_field_solid[], of the pass that writes the field, in place of the first

// Image units, for the pass that writes the field.
#define HAIR_IMAGE_FIELD 0
#define HAIR_IMAGE_SOLID 1
#define HAIR_IMAGE_AIR 0 // of the pass that writes the texture at HAIR_UNIT_AIR

#define HAIR_MOST_GROUPS 65535u      // in one dimension: what OpenGL promises
#define HAIR_GROUP_SIZE 64           // threads of a work group, but for those of a guide: lib/gl/passes.inl
#define HAIR_MAX_GUIDES 262144       // of a groom
#define HAIR_MAX_GUIDE_VERTICES 256  // one thread per vertex of a guide
#define HAIR_MAX_SMOOTH_VERTICES 511 // two samples per segment of the longest guide
#define HAIR_MAX_ISOLINES 64         // made at once of a patch, and
#define HAIR_MAX_ISOLINE_SEGMENTS 64 // of an isoline: what OpenGL promises
#define HAIR_INSTANCE_STRANDS 64     // drawn as one instance, without a tessellator
#define HAIR_SORT_BUCKETS 16384      // from far to near
#define HAIR_RASTER_SAMPLES 16       // of a pixel, at most
#define HAIR_RASTER_SEGMENTS 16      // of a work group
#define HAIR_RASTER_TILE 32          // pixels along each axis that are composed together, if there is hair in any
#define HAIR_RASTER_PIECE 32         // pixels of a row that a thread goes over
#define HAIR_NOBODY 0xffffffffu      // what there is of a sample where nothing is seen
#define HAIR_COUNT_THREADS 256       // of the work group that counts the strands that are drawn
#define HAIR_STEP_SUBSTEPS 64        // of one dispatch
#define HAIR_STEP_SOLIDS 64        // of one dispatch that has them in its parameters,
#define HAIR_FEW_SOLIDS 16         // of them as many as solvers of rods look at one by one: grids are faster for more
#define HAIR_CELL_SOLIDS 64        // and in a cell of the grid where it has not
#define HAIR_CONTACT_ROUNDS 4000   // of a substep's loops over these, where a thread counts them: see lib/sim/rounds.c
#define HAIR_CONTACT_TEXELS 13
#define HAIR_MEMBER_NUMBER 1048575u // of a member of a cell: which hair_contact,
#define HAIR_MEMBER_WALKED 16777216u // and whether it is no sphere or capsule,
#define HAIR_MEMBER_LONG 33554432u   // or no sphere
#define HAIR_FOLLOWER_TEXELS 6
#define HAIR_PATCH_TEXELS 4
#define HAIR_MAP_SETS 4 // of a groom, at most
#define HAIR_CURVE_INTERVALS 7 // of a curve along a strand
#define HAIR_TURN_PLACES 16    // that a turn of a curl is given at
#define HAIR_BRICK 8            // voxels along the side of what one work group writes of the field
#define HAIR_SHOWN_SOLIDS 96    // drawn at once
#define HAIR_SOLID_TEXELS 6
#define HAIR_WIND_BALLS 4    // that shelter
#define HAIR_WIND_SOURCES 4  // of an instance
#define HAIR_GUST_NODES 32   // of the texture of gusts, along each axis,
#define HAIR_GUST_LENGTHS 8  // and how many integral length scales its side is
#define HAIR_NO_SOLID 4294967295u // in place of a solid's number: none is near
#define HAIR_CROWD_NODES 32       // along an axis, at most
#define HAIR_CROWD_NODE_NUMBERS 18 // of a node: its mass, and from these on about the node, in cells:
#define HAIR_CROWD_MOMENTUM 1u    // three,
#define HAIR_CROWD_VOLUME 4u      // one,
#define HAIR_CROWD_MOMENT 5u      // three, mass times position,
#define HAIR_CROWD_ANGULAR 8u     // three, angular momentum,
#define HAIR_CROWD_SQUARES 11u    // and mass times position twice: xx, yy, zz,
#define HAIR_CROWD_PRODUCTS 14u   // yz, zx, xy,
#define HAIR_CROWD_ALIKE 17u      // and mass times mass of the same guide there, by per_strand
#define HAIR_CROWD_SPEED 16.0f // m/s along an axis relative to the head: what is faster counts as that fast

#define HAIR_FLUID_BOTTOM 8 // cells along an axis of the coarsest level, at most: see glsl/wind/bottom.comp
#define HAIR_FLUID_BOTTOM_THREADS 256
#define HAIR_FLUID_FASTEST 1e4 // m/s: what is faster is taken for no number

#define HAIR_FIBRE_COLUMNS 64 // of its table
#define HAIR_FIBRE_ROWS 16
#define HAIR_FIBRE_LAYERS 3
#define HAIR_FIBRE_MU 0.5 // absorption per radius in the middle of its columns

#define HAIR_DENSITY_NODES 1048576u // of the grid of how much hair there is, at most
#define HAIR_DENSITY_UNITS 65536.0  // of hair that is worth one side of a cell

#define HAIR_HIDE_PARTS 4 // of strands, which are hidden each for itself
#define HAIR_HIDE_FIRST 8 // texels of the host's depth, along each axis, that are one of the first level,
#define HAIR_HIDE_NEXT 4  // of a level that are one of the next,
#define HAIR_HIDE_TEXELS 8 // and that a box is looked up in, at most

#define HAIR_NO_HIT 1e9
#define HAIR_HIT_FOLLOWERS 32    // that a work group looks at,
#define HAIR_HIT_THREADS 4       // for each of them so many
#define HAIR_HIT_COLUMNS 4096u   // of the texture with a texel per follower, where a prepass finds hits
#define HAIR_SWITCH_ZONE 0.2     // of the length, above the first vertex inside
#define HAIR_REPAIR_INTERVALS 8  // that the curves of repair.glsl cut a follower into
#define HAIR_REPAIR_CONTROLS 10  // that are kept of each
#define HAIR_REPAIR_THREADS 32   // of a work group
#define HAIR_REPAIR_SAMPLES 64   // segments of a follower that are looked at
#define HAIR_COLLISION_IS_SWITCH 1 // hair_collision

// A guide at rest, in groom space.
struct hair_guide {
    hair_vec4 root_frame; // unit quaternion of the first segment: y along it
    hair_uint first;      // of its vertices
    hair_uint count;
    float     arc_length; // m
    hair_uint unused;
};
HAIR_SIZE(hair_guide, 32)

// A guide vertex at rest, in groom space.
struct hair_rest {
    hair_vec4 position; // xyz: m; w: distance to the next vertex, m (0 for the tip)
    // xyz: unit direction to the next vertex, in the frame carried here along the strand from the segment before
    // (at the root: in the root frame); w: distance to the vertex after the next, m
    hair_vec4 direction;
    hair_vec4
        frame; // of the segment to the next vertex: unit quaternion, y along it, carried so from the root's
};
HAIR_SIZE(hair_rest, 48)

// A guide vertex as part of a rod, for the solvers of Kirchhoff's equations. Everything is divided by the mass
// of a metre of hair, so that masses are lengths. Follow-the-leader reads strain and factors in its own way: strain has
// what lib/sim/follow.c calls K r + a' and c, factor p, all over the inertia; factor_euler r and a rate of damping.
struct hair_rod {
    // xyz: rest strain at the vertex, between the frames of segments i-1 and i (at the root: of the scalp and
    // segment 0): 2 Im(conj(q_(i-1)) q_i); w: bending stiffness over the length it is for, m^3/s^2
    hair_vec4 strain;
    // x: length of segment i, m (0 for the tip); y: 1 / mass, 1/m; z: pull squared, 1/s^2; w: of a first vertex, how
    // accurate takes it: 0 explicitly, 1 by BDF2, 2 by implicit Euler, for a heavy tip pulls it taut. For the mixed
    // scheme, of every vertex: 2 w0, twice the real part of that quaternion at rest (0 for the tip)
    hair_vec4 segment;
    // Rows of L D L^T of the implicit systems: x: 1/D, y: L(i+1,i), z: L(i+2,i). Of the solver's own method, w: the
    // number of the first tie beyond this vertex, from 1, or 0; and of implicit Euler, to which it falls back
    hair_vec4 factor;
    hair_vec4 factor_euler;
};
HAIR_SIZE(hair_rod, 64)

// A guide vertex in motion. Positions are from the head's origin, so that far from the world's origin floats
// still resolve micrometres; the displacement is kept rather than differenced, for the same reason.
struct hair_state {
    // xyz: m, world axes, from the head's origin at the end of the substep; w: of a guide's first vertex, how much
    // of the past a solver knows: 0 nothing, it is at rest; 1 the displacement; 2 hair_history as well; see predict.glsl
    hair_vec4 position;
    hair_vec4 displacement; // xyz: m, over the last substep, in the world; w: tension / line density, m^2/s^2
};
HAIR_SIZE(hair_state, 32)

// What holds a vertex of a guide, beside the scalp. In the order of guides and their vertices.
struct hair_held {
    // xyz: where it is to be at the end of the step, m; w: 0: in groom space; -1: in the world, from the head's origin
    hair_vec4 place;
    // Of what it ends: x, y: the held vertices before and after, counted from the guide's root; z: length between them
    // at rest, m; 0 where nothing holds it before; w: 1: the next in the list is the same guide's
    hair_vec4 span;
};
HAIR_SIZE(hair_held, 32)

// What BDF2 knows of a guide vertex beside its state: displacements per substep that its velocities stand for.
struct hair_history {
    hair_vec4 rate;        // xyz: at the end of the last substep, m
    hair_vec4 rate_before; // xyz: of the one before; w: 1: the vertex touched a solid at the end of the last
};
HAIR_SIZE(hair_history, 32)

// A sphere (both ends alike) or capsule, or what is around another shape, at the start and at the end of the step, from the head's origin.
struct hair_capsule {
    hair_vec4 start[2]; // xyz: ends of the axis, m; w: radius, m
    hair_vec4 end[2];
    hair_vec4 spin; // xyz: turn about its own axis (a sphere: any) over the step, radians; w: way of an end, at most, m
};
HAIR_SIZE(hair_capsule, 80)

// The same solid as it is, where the capsule is only around it: at the start and at the end of the step.
struct hair_body {
    hair_vec4 position[2]; // xyz: from the head's origin, m; [0].w: rounding, m; [1].w: factor of the friction
    hair_vec4 rotation[2]; // unit quaternions, on the same side
    hair_vec4 size;        // xyz: as the shape says, m; w: hair_shape
};
HAIR_SIZE(hair_body, 80)

// One of any number of solids.
struct hair_contact {
    HAIR_STRUCT(hair_capsule) around; // it, or a sphere around it
    HAIR_STRUCT(hair_body) body;      // size.x of a form: how many times as large it is
    hair_vec4 grid; // of a form: xyz: its first node, w: from node to node, m
    hair_uint nodes_x, nodes_y, nodes_z;
    hair_uint first; // of its nodes
    hair_vec4 ball;  // around all that it is during what is left of the step: xyz: middle, w: radius, with the margin; m
};
HAIR_SIZE(hair_contact, 16 * HAIR_CONTACT_TEXELS)

// One substep: where the head is at its end.
struct hair_substep {
    hair_vec4 rotation;     // unit quaternion
    hair_vec4 displacement; // xyz: of the head's origin over it, m; w: share of the step done at its end
};
HAIR_SIZE(hair_substep, 32)

// What the substeps of one step share. Frequencies are angular.
struct hair_step_params {
    hair_vec4 gravity;   // xyz: m/s^2; w: length of a substep, s
    float     keep;      // share of the velocity left after a substep: exp(-damping dt)
    float     pull_root; // angular frequency, 1/s
    float     pull_tip;
    float     angular; // squared, 1/s^2
    float     bend;    // share per iteration
    float     margin;  // m
    hair_uint iterations;
    hair_uint substeps;
    hair_uint guides;
    hair_uint solids;
    hair_uint smooth_vertices; // per guide
    float     alpha;           // of the last substep, where now is: 0 its start, 1 its end
    hair_vec4 rotation_before; // head at the start of the last substep
    hair_vec4 rotation_after;  // head at its end
    hair_vec4 rotation_now;
    hair_vec4 last_displacement; // xyz: of the head's origin over the last substep, m
    // Of the solvers of rods.
    hair_vec4 rotation_start; // head at the start of the first substep of this dispatch
    hair_vec4 ratio;          // of stiffness about the section's x axis, along it, and about z, to bending's
    float     kick;           // h (1 - exp(-damping h)) / damping, s^2: displacement by an acceleration
    float     damping;        // 1/s
    float     friction;
    float     share_start; // of the step done before this dispatch
    float     rescale;     // of displacements, where the substep's length has changed; else 1
    hair_uint vertices; // of all guides
    hair_uint bodies; // a bit for each solid that is no capsule, of HAIR_FEW_SOLIDS
    hair_uint rounds; // of implicit.glsl's reduction, before its last
    hair_uint list;   // 0 or 1: which of health[]'s is this dispatch's
    hair_uint substep_first; // of `substep`, the one that this dispatch begins with
    hair_uint part_rounds;   // of loops, that parts of a substep may take: see leap_parts.glsl
    hair_uint unused0;
    // Of the grid in which any number of solids are looked up, from the head's origin.
    hair_vec4 cells_lower; // xyz: its corner, m; w: 1 / side of a cell, 1/m
    hair_uint cells_x, cells_y, cells_z;
    float     cells_give; // m: half the way of a vertex on all of which it finds what it can touch
    HAIR_STRUCT(hair_substep) substep[HAIR_STEP_SUBSTEPS];
    HAIR_STRUCT(hair_capsule) solid[HAIR_STEP_SOLIDS];
    HAIR_STRUCT(hair_body) body[HAIR_STEP_SOLIDS];
};
HAIR_SIZE(hair_step_params, 240 + HAIR_STEP_SUBSTEPS * 32 + HAIR_STEP_SOLIDS * 160)

// What the solvers of rods know of the wind.
struct hair_wind_params {
    hair_vec4 velocity;  // xyz: of the air far from all it flows around, m/s; w: standard deviation of gusts, m/s
    hair_vec4 box;       // xyz: corner of the fluid's, from the head's origin, m; w: 1 / its side, 1/m; 0: there is none
    hair_vec4 gust_turn; // unit quaternion: world to the texture of gusts
    hair_vec4 gust_from; // xyz: where in it the head's origin is, at the end of the dispatch; w: 1 / its side, 1/m
    float     per_speed; // Reynolds number of a strand by the air's speed across it, s/m
    float     viscous;   // drag by the air's viscosity, by a strand's mass, 1/s
    float     shelter;
    hair_uint balls;
    hair_uint sources;
    hair_uint volume; // 1: there is a texture of velocities
    hair_uint unused0, unused1;
    hair_mat4 to_volume; // its coordinates, of positions from the head's origin at the end of the dispatch
    hair_vec4 ball[HAIR_WIND_BALLS];     // xyz: from the head's origin, m; w: radius, m
    hair_vec4 source[HAIR_WIND_SOURCES]; // xyz: from the head's origin at the end of the dispatch, m; w: radius, m
    hair_vec4 jet[HAIR_WIND_SOURCES];    // xyz: unit direction, or 0; w: speed, m/s
    // At the start of each substep, seen from the end of the dispatch: xyz: the head's origin, m; w: time, s, below 0.
    hair_vec4 at[HAIR_STEP_SUBSTEPS];
};
HAIR_SIZE(hair_wind_params, 160 + 16 * HAIR_WIND_BALLS + 32 * HAIR_WIND_SOURCES + 16 * HAIR_STEP_SUBSTEPS)

// What a guide vertex puts into the crowd's grid, in its units.
struct hair_share {
    hair_uint mass, volume;
    hair_uint first, end; // vertices of its guide
};
HAIR_SIZE(hair_share, 16)

// What the hair's mass, momentum and volume are gathered in: a grid that goes along with the head.
struct hair_crowd_params {
    hair_vec4 rotation; // of the head, where the last substep left it
    hair_vec4 moved;    // xyz: displacement of the head's origin over that, m; w: speed per displacement, 1/s
    hair_vec4 lower;    // xyz: node 0, in the head's frame, m; w: distance between nodes, m
    hair_uint nodes_x, nodes_y, nodes_z;
    hair_uint vertices;  // of all guides
    float     cohesion;  // share of a relative velocity to be removed, per second, 1/s
    float     volume;    // m^2/s^2
    float     ahead;     // cells to the middle of a block at HAIR_CROWD_SPEED; 0 takes positions as they are
    float     per_strand; // 1 / the mass, in units, of so much of a strand as is never at a node
};
HAIR_SIZE(hair_crowd_params, 80)

// Of the passes that find which patches the host's depth hides.
struct hair_hide_params {
    hair_mat4 to_texture; // from the head's origin: xy texture coordinates, z depth with the sign, times w
    hair_uint width, height;   // of the host's texture
    hair_uint first_x, first_y; // texel of its first level, were all of it made, where that begins;
    hair_uint columns, rows;   // and so many of them there are
    hair_uint levels;
    hair_uint level;    // that is made of the one before it
    float     sign;     // 1, or -1 where the host's depth falls with the distance
    float     most;     // the farthest depth there is, with the sign
    float     slack;    // what depth is rounded by
    float     thick;    // m: of strands, that maps and the groom make no thicker, at most
    float     beside_x, beside_y; // of texture coordinates: by which what is drawn is wider than that
    hair_uint clips;    // 1: what is outside of the texture is not seen
    hair_uint guides;
};
HAIR_SIZE(hair_hide_params, 128)

// Of the passes that make pixels of segments. Rows of pixels follow each other, and of a pixel its samples.
struct hair_raster_params {
    hair_mat4 to_window; // from the head's origin: xy pixels from the first one's corner, z depth in [0, 1], times w
    hair_vec4 part;      // xy: of clip space the lower corner of all that hair can be in, zw: the upper
    hair_uint columns, rows, samples;
    hair_uint flips;     // all bits, where depth falls with the distance; else 0
    hair_uint first_x, first_y; // of the pixels, in the window
    hair_uint claims;    // 1: segments claim the samples of which they are the nearest; 0: that is to be found
    hair_uint clamps;    // 1: depth is clamped and not clipped
    float     depth_from, depth_by; // depth as it is written: its value at 0, and what is added to that at 1
    hair_uint across, tiles; // of tiles, in a row and in all
    hair_vec4 at[HAIR_RASTER_SAMPLES / 2]; // of samples 2 i and 2 i + 1: xy and zw in the pixel
};
HAIR_SIZE(hair_raster_params, 128 + 8 * HAIR_RASTER_SAMPLES)

// How the guides are looked at that may have come to rest.
struct hair_stir_params {
    hair_uint vertices; // of all guides
    hair_uint turn;     // which of the two answers this one is; the other is cleared
    hair_uint anchors;  // 1: where vertices are becomes where they were
    float     rate;     // speed per displacement, 1/s
};
HAIR_SIZE(hair_stir_params, 16)

// Parameters by which motion.comp measures guides after the last substep.
struct hair_motion_params {
    hair_vec4 turn;  // rotation of the head over the last substep, unit quaternion
    hair_vec4 moved; // xyz: displacement of the head over it, m; w: speed per displacement, 1/s
    hair_uint guides;
    float     calm;  // time for which nothing has driven the guides, s; below 0: no guide is restless
    float     wait;  // time that damping needs to calm any guide, s,
    float     creep; // and for each metre of its length, s/m
};
HAIR_SIZE(hair_motion_params, 48)

// Parameters by which energy.comp watches the guides after a step.
struct hair_energy_params {
    hair_uint begins; // 1: what was watched before counts no more.
    hair_uint ends;   // 1: the window ends with this step.
    float     time;   // length of the step's substeps, s
    float     rate;   // speed per displacement, 1/s
};
HAIR_SIZE(hair_energy_params, 16)

// The mechanical energy of a guide, all divided by its mass per metre: m^3/s^2.
struct hair_energy {
    hair_vec4 now; // x: kinetic; y: of gravity, 0 at the root; z: of bending and twist; w: of the pull to the rest pose
    // x: the most that energy and loss may be; y: the most that they were in this window; z: half of what damping has
    // taken in it; w: the greatest kinetic energy, of which windows before count half, a quarter, and so on
    hair_vec4 window;
};
HAIR_SIZE(hair_energy, 32)

// A strand that is made while drawing. With t from 0 at its root to 1 at its tip, u = t length_ratio,
// g_k(u) and F_k(u) position and frame of guide k, o(t) the cubic Bezier curve of `offset`:
//   single(t) = g_0(u) + F_0(u) o(t)
//   multi(t)  = (1 - weight1 - weight2) g_0(u) + weight1 g_1(u) + weight2 g_2(u) + F_0(u) (offset[1..3].w)
struct hair_follower {
    hair_uint guide0, guide1, guide2;
    hair_uint seed;
    float     weight1, weight2; // barycentric, of guide 1 and 2
    float     length_ratio;     // its length as a share of the guide's; beyond 1 it goes on straight
    float     multi;     // 0: single-strand only; 1: multi-strand at the root, tending to single as it clumps
    hair_vec4 offset[4]; // xyz: control points in guide 0's frame, m; [0].w: radius, as a share of the look's
};
HAIR_SIZE(hair_follower, 96)

// Where on the scalp a root sits, at rest.
struct hair_seat {
    hair_uint corner0, corner1, corner2; // of its triangle: vertices of the scalp
    float     weight1, weight2;          // barycentric, of the last two
    float     away_x, away_y, away_z;    // from there to the root, m
};
HAIR_SIZE(hair_seat, 32)

#define HAIR_RIDE_THEN 0   // where the last substep before this step left it
#define HAIR_RIDE_START 1  // at the start of this step
#define HAIR_RIDE_END 2    // and at its end
#define HAIR_RIDE_BEFORE 3 // at the start of the last substep done
#define HAIR_RIDE_AFTER 4  // and at its end
#define HAIR_RIDES 5

// How a guide's root sits otherwise in the head than at rest: its rest pose turned about the root, and shifted.
struct hair_ride {
    hair_vec4 shift[HAIR_RIDES]; // xyz: m, in the head's frame
    hair_vec4 turn[HAIR_RIDES];  // unit quaternions
};
HAIR_SIZE(hair_ride, HAIR_RIDES * 32)

#define HAIR_SCALP_FRESH 1u // it has been given since the last step
#define HAIR_SCALP_RESET 2u // there is no past
#define HAIR_SCALP_AGAIN 4u // the step has begun already: only its substeps go on

// Of the passes of a skinned scalp. Into the head's frame: rotation (position + offset).
struct hair_scalp_params {
    hair_vec4 rotation;
    hair_vec4 offset;   // xyz: m
    hair_uint vertices; // of the scalp
    hair_uint guides;
    hair_uint followers;
    hair_uint first, stride; // of what is given, in floats
    hair_uint what;          // HAIR_SCALP_
    hair_uint substeps;      // of this step
    float     share_before;  // of the step done at the start of its last substep, of two or more
    float     share_after;   // and at its end
    hair_uint smooth_vertices;
    hair_uint unused0, unused1;
};
HAIR_SIZE(hair_scalp_params, 80)

// What is drawn together: followers, in an order fit to be cut short. Grooms make patches of HAIR_MAX_ISOLINES at most.
struct hair_patch {
    hair_uint first; // follower
    hair_uint count;
    float     density;    // local, [0, 1]: the share of them that grows here
    hair_uint guide;      // from whose root its reach is
    hair_vec4 map_density;   // share of that by each set of maps
    hair_vec4 map_thickness; // of the followers' radius, likewise
    float     reach;         // m: no follower gets farther from there
    float     length;        // m: of its longest follower
    float     importance;    // as a multiple
    hair_uint hidden;        // 1: of what was last asked for, by what the host has drawn
};
HAIR_SIZE(hair_patch, 64)

// Where the field is, and what it counts as near.
struct hair_field_params {
    hair_vec4 rotation; // of the head: unit quaternion
    hair_vec4 lower;    // xyz: corner of its box, m, in the head's frame; w: side of a voxel, m
    hair_vec4 inverse;  // xyz: 1 / sides of the box, 1/m; w: the distance that stands for all beyond it, m
};
HAIR_SIZE(hair_field_params, 48)

// A solid in the head's frame.
struct hair_field_solid {
    hair_vec4 position; // xyz: m; w: rounding, m
    hair_vec4 rotation; // unit quaternion: its own axes to the head's
    hair_vec4 size;     // xyz: as its shape says, m; w: of a form, how many times as large it is
    hair_vec4 grid;     // of a form: xyz: its first node, w: from node to node, m
    hair_uint nodes_x, nodes_y, nodes_z;
    hair_uint first;  // of its nodes
    hair_uint shape;  // hair_shape
    hair_uint number; // among the instance's solids
    hair_uint unused0, unused1;
};
HAIR_SIZE(hair_field_solid, 96)

// A solid to be drawn, and the box around it in its own axes.
struct hair_shown_solid {
    HAIR_STRUCT(hair_field_solid) solid;
    hair_vec4 lower; // xyz: m
    hair_vec4 upper;
};
HAIR_SIZE(hair_shown_solid, 128)

// Solids drawn for debugging, cut open where a slice of the field is.
struct hair_shown_params {
    hair_vec4 rotation; // of the head: unit quaternion
    hair_vec4
        plane; // of the slice, in the head's frame: xyz: unit normal, 0 if there is none; w: its distance, m
    hair_vec4 corner;  // xyz: of the slice, m
    hair_vec4 side[2]; // xyz: from there along it, m
    hair_vec4 depth;   // depth in the framebuffer is x + y times that in clip space
    hair_vec4 air;     // of arrows: x, y: how many along each side; z: how far apart, m; w: speed that is grey, m/s
    HAIR_STRUCT(hair_shown_solid) shown[HAIR_SHOWN_SOLIDS];
};
HAIR_SIZE(hair_shown_params, 112 + HAIR_SHOWN_SOLIDS * 128)

// HAIR_BRICK^3 voxels, and the solids that reach into them.
struct hair_field_brick {
    hair_uint at;    // its place among bricks: x + (y << 10) + (z << 20)
    hair_uint first; // member
    hair_uint count;
    hair_uint unused;
};
HAIR_SIZE(hair_field_brick, 16)

// The fluid's box is a cube along the world's axes.
struct hair_fluid_params {
    hair_vec4 lower;    // xyz: its corner, from the head's origin, m; w: side of a cell, m
    hair_vec4 shift;    // xyz: by how many cells it has moved since the last step; w: cells per m/s in a step, s/m
    hair_vec4 wind;     // xyz: of the scene, m/s; w: standard deviation of gusts, m/s
    hair_vec4 gain;     // xyz: by how much that has changed since the last step, m/s
    hair_vec4 rotation; // of the head: unit quaternion
    hair_vec4 gust_turn, gust_from; // as in hair_wind_params, at the start of the step
    hair_uint cells;    // along each axis
    hair_uint solids;   // 0: there are none in reach
    hair_uint open;     // 0: the box is closed all round
    hair_uint nodes;    // of the grid of hair, along each axis
    float     thick;    // strands in a cubic metre by the mass at a node of it, 1/m^2; 0: there is no hair
    float     per_speed; // Reynolds number of a strand by the speed of air, s/m
    float     viscous;   // drag of strands by a viscous force, and that over a step, m^2
    hair_uint unused;
};
HAIR_SIZE(hair_fluid_params, 144)

// A level of the fluid's grid, each of half as many cells along an axis as the one before; and what a pass does there.
struct hair_fluid_level {
    hair_uint cells; // along each axis
    hair_uint slot, cell; // its first
    hair_uint coarse_slot, coarse_cell; // and those of the next level
    hair_uint color;
    float     relax; // share of what fits a cell that is taken
    hair_uint unused;
};
HAIR_SIZE(hair_fluid_level, 32)

// A solid's velocity: at a place, this and spin x place.
struct hair_fluid_motion {
    hair_vec4 velocity; // xyz: at the head's origin, m/s
    hair_vec4 spin;     // xyz: 1/s
};
HAIR_SIZE(hair_fluid_motion, 32)

// The curves of a look along a strand.
#define HAIR_CURVE_TAPER 0
#define HAIR_CURVE_CLUMP 1
#define HAIR_CURVE_CLUMP_WIDTH 2
#define HAIR_CURVE_TIP_STRAY 3
#define HAIR_CURVE_STRAY 4
#define HAIR_CURVE_FRIZZ 5
#define HAIR_CURVE_CURL 6
#define HAIR_CURVES 7

// What a look makes of a strand's way, as hair_look has it.
struct hair_strand_look {
    // Cubics c over intervals: c.x + x (c.y + x (c.z + x c.w)), x from 0 to 1. Of each curve its intervals,
    hair_vec4 curve[HAIR_CURVES * HAIR_CURVE_INTERVALS];
    hair_vec4 loop[2 * HAIR_TURN_PLACES]; // and of a turn of a curl of radius 1: x, then z
    float tip_strays, strays;
    float kinks; // 1/m
    float drawn; // share
    float thinning;
    float curl_radius; // m
    float curl_waves;  // 1/m
    float curl_turns;
    float curl_lock_phase, curl_phase, curl_spread, curl_left;
    // The most that all this makes of how far a strand gets.
    float     most_stray; // in lengths
    float     most_aside; // m
    float     most_width; // multiple of what its offsets are; 1 or more
    hair_uint unused;
};
HAIR_SIZE(hair_strand_look, (HAIR_CURVES * HAIR_CURVE_INTERVALS + 2 * HAIR_TURN_PLACES) * 16 + 64)

// A strand that is drawn without a tessellator.
struct hair_strand {
    hair_uint follower;
    float     width;   // share of its own
    float     widened; // of that what makes up for strands that are left out
    float     whole;   // segments, with the share that there is of the last one
};
HAIR_SIZE(hair_strand, 16)

// Beginning with what OpenGL reads of an indirect draw with indices; that which writes vertices, with three numbers of work
// groups.
struct hair_draw_command {
    hair_uint count, instances, first, base_vertex, base_instance;
    hair_uint strands; // of the first of those that draw a list, and of that which writes vertices: in it
    hair_uint each;    // of the latter: vertices of a strand
    hair_uint unused0;
};
HAIR_SIZE(hair_draw_command, 32)

// What colours strands have.
struct hair_tint {
    hair_vec4 ramp[HAIR_CURVE_INTERVALS + 1]; // rgb: reflectance at even places along a strand
    hair_vec4 streak;        // rgb: that of streaks; w: share of the strands that are
    float     brightness;    // relative spread between strands
    float     hue;           // likewise, of red against blue
    float     roughness;     // likewise
    float     tilt;          // likewise
    float     root_shade;    // share that is lost at the root
    float     root_recovery; // 1 / share of the strand over which it comes back
    float     streak_locks;  // share of strands that go by their lock
    float     sparkle;
    float     paint;       // share of the colours of the groom
    float     paint_power; // that these are darkened by
    hair_uint unused0, unused1;
};
HAIR_SIZE(hair_tint, (HAIR_CURVE_INTERVALS + 2) * 16 + 48)

#define HAIR_LIGHT_TO 0    // xyz, w 0: unit, towards it; w 1: m, from the head's origin to it
#define HAIR_LIGHT_COLOR 1 // rgb: irradiance, or that 1 m away; w: m^2: squared distance below which it is no brighter
#define HAIR_LIGHT_AXIS 2  // xyz: of a spot: unit, from what it shines at; w: cosine from which on there is light
// x: slope of its brightness by that cosine; y: 1 over the square of its range, 1/m^2, 0: any; z: absorption, 1/m; w: which
// of the shadow maps of hair it has, HAIR_SHADOW_MAPS: none
#define HAIR_LIGHT_MORE 3
// x: which of the maps of bodies it has, HAIR_SHADOW_MAPS: none; y: how far behind those there is light, m; of both maps z:
// m per unit of depth; w: depth of what is infinitely far away in perspective, 0: there is none
#define HAIR_LIGHT_MAP 4
#define HAIR_LIGHT_VECTORS 5

// One draw. Positions are from the head's origin, as in the smoothed guides.
struct hair_draw_params {
    hair_mat4 view; // to view space
    hair_mat4 view_to_clip;
    hair_vec4 eye;        // xyz: eye, or direction to it when w is 0 (orthographic)
    hair_vec4 specular;   // strengths of both highlights, their exponents
    hair_vec4 fibre;      // variance along, absorption per log of reflectance squared, tilt in radians, scattering
    float     radius;     // m
    float     density;
    hair_uint segments;
    hair_uint smooth_vertices;
    hair_uint colored; // 0: only depth is asked for, nothing is shaded
    // Of what is done about followers inside solids.
    hair_uint followers; // in all
    hair_uint collision; // hair_collision
    hair_uint turn;      // which of the two counts of the list this time's is
    float     margin;    // m, from a solid, of what is pushed out of it
    hair_uint lights;    // how many there are
    hair_uint textured;  // 1: there is a texture of colours
    hair_uint lit;       // numbers of a vertex at HAIR_UNIT_LIGHT; 0: there are none
    hair_uint culls;     // 1: patches of which `sides` cut off all are left out
    hair_uint drawn_only; // 1: passes over vertices of followers leave out those that the view does not draw
    hair_uint chunks;     // work groups that share a patch there
    float     led;        // share of what leads followers round solids that the view shows
    hair_vec4 map_weights; // of the sets of maps: their sum is 1
    // Of the level of detail.
    hair_mat4 sides;           // of what is seen, as planes: xyz: unit normals, inwards; w: distance, m
    hair_vec4 skull;           // xyz: centre of a ball that hides what is behind it, w: radius, m; 0: there is none
    float     strand_share;    // of the strands, at most
    float     segment_share;   // of the segments, at most
    float     width_power;     // strands are by this power of 1 / share as wide
    float     pixels_per_unit; // where w of clip space is 1; 0: it does not matter how large strands appear
    float     strand_pixels;   // wanted
    float     segment_pixels;  // wanted
    float     least_share;
    float     hidden_share; // as a multiple, of strands behind the skull
    hair_mat4 now_to_clip;    // from the head's origin, without jitter
    hair_mat4 before_to_clip; // from where the head's origin was, when hair was drawn before
    hair_vec4 origin;         // xyz: of the head, world, m; w: cells of the grid of how much hair there is, m
    hair_vec4 head;           // its unit quaternion
    // xy: pixels; z: by which ribbons are widened to each side to reach all pixels that they cover a share of; w: opacity
    hair_vec4 viewport;
    hair_vec4 sort; // x: m from the eye where the nearest bucket begins; y: buckets in a metre
    HAIR_STRUCT(hair_tint) tint;
    HAIR_STRUCT(hair_strand_look) strand;
    hair_vec4 light[HAIR_LIGHTS * HAIR_LIGHT_VECTORS]; // of each as HAIR_LIGHT_ says
    hair_mat4 shadow[HAIR_SHADOW_MAPS]; // to each: xy texture coordinates, z depth, both in [0, 1], times w
    hair_mat4 sky[3]; // of r, g, b: irradiance on a plane with unit normal n is (n, 1) sky (n, 1)
};
HAIR_SIZE(hair_draw_params, 5 * 64 + 10 * 16 + 80 + sizeof(struct hair_tint) + sizeof(struct hair_strand_look) +
                                HAIR_LIGHTS * HAIR_LIGHT_VECTORS * 16 + (HAIR_SHADOW_MAPS + 3) * 64)

#endif
