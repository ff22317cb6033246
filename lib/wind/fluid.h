// fluid.h - air around the head as an inviscid, incompressible fluid, on a staggered grid with
// velocities at the faces of cells (Harlow and Welch 1965). A step advects the velocities, then
// projects them to be free of divergence. Pressures are stored as changes of velocity, so no
// density appears.
//
// The grid is a cube along the world's axes that follows the head by whole cells. The wind
// surrounds it. Colliders are given by the field, each with its own velocity. The field is sampled
// at sixteen parts of a face to find its open fraction. If the fluid couples to hair, hair closes
// faces further. See glsl/wind/porous.comp.
#ifndef HAIR_WIND_FLUID_H
#define HAIR_WIND_FLUID_H

#include "lib/collide/collider.h"
#include "lib/field/field.h"
#include "lib/gl/commands.h"
#include "lib/wind/wind_params.h"

#define HAIR_FLUID_LEVELS 5 // From 128 cells along an axis to 8.
// Alignment of ranges in uniform buffers, the maximum that a driver may require.
#define HAIR_FLUID_ALIGNMENT 256
// Maximum nodes along an axis of the grid of hair. A guide stands for a lock about as wide as the
// finest spacing.
#define HAIR_FLUID_NODES 32

// Pressure projection method.
typedef enum hair_fluid_method {
    // V-cycles with one sweep before and three after. See lib/wind/solve.c.
    HAIR_FLUID_MULTIGRID = 0,
    HAIR_FLUID_RELAXATION, // Sweeps of successive over-relaxation.
    HAIR_FLUID_JACOBI // Sweeps of Jacobi.
} hair_fluid_method;

struct hair_fluid_desc {
    uint32_t cells; // Cells along an axis, a multiple of 16 up to 128.
    float side; // Side of the box, in metres.
    hair_fluid_method method;
    uint32_t cycles; // Number of multigrid cycles, or of sweeps.
    float relax; // Relaxation factor of a sweep. 0 selects the default of the method.
    int closed; // Nonzero if nothing flows in or out.
};

// Buffer, and its buffer texture for shaders.
struct hair_fluid_buffer {
    GLuint buffer, texture;
};

// Coupling of hair to the fluid. Its buffers exist only on demand.
struct hair_fluid_hair {
    struct hair_fluid_buffer grid; // Mass and momentum of hair, as in the hair-hair grid.
    // Walls and openness with hair. The fluid's own buffers hold those without hair.
    struct hair_fluid_buffer wall_velocity, face_fraction;
};

struct hair_fluid_level_at {
    uint32_t cells, slot, cell; // See hair_fluid_level.
};

struct hair_fluid {
    struct hair_gl* gl; // NULL if there is no fluid.
    struct hair_fluid_desc desc;
    struct hair_fluid_level_at level[HAIR_FLUID_LEVELS + 1];
    uint32_t levels;
    // Current, advected and next velocities, in rotating order.
    struct hair_fluid_buffer velocity[3];
    uint32_t now; // Index of the velocities after the last step.
    struct hair_fluid_buffer wall_velocity, face_fraction, rhs;
    struct hair_fluid_buffer pressure[2]; // The second exists only for Jacobi.
    uint32_t current_pressure; // Index of the newer pressures.
    struct hair_fluid_hair hair;
    GLuint params, level_params, motion;
    GLuint air; // 3D texture, RGBA16F. Velocity at the centres of cells, in m/s.
    int is_reset; // Nonzero if there is no past. The first step starts with the wind everywhere.
    double origin[3]; // Corner of the box, in whole cells from the world's origin.
    hair_vec3 wind; // Wind in the last step.
    GLuint gusts; // Texture of gusts in the last step.
    hair_vec3 lower; // Corner of the box from the head's origin, in metres.
    struct hair_fluid_motion* motion_of; // Motions of colliders, at most `room`.
    uint32_t room;
    int moving; // Nonzero if a collider moved in the last step.
    struct hair_fluid_params made_for; // Parameters that the openness of faces was computed for.
    uint32_t writes; // Value of hair_collider_field.writes that it was computed for.
};

// Hair in a step, if the fluid couples to hair.
struct hair_fluid_strands {
    double metres; // Metres of strands per unit of the grid's mass.
    float per_speed; // Reynolds number of a strand per speed of the air, in s/m.
    float viscous; // Drag of strands by a viscous force, in m^2/s.
};

// Inputs of a step.
struct hair_fluid_now {
    struct hair_pose head; // Head at the end of the step.
    hair_vec3 middle; // Centre of the box, in the head's frame.
    hair_vec3 wind; // Velocity of the wind, in m/s.
    struct hair_wind_gusts gusts; // Gusts at the start of the step.
    struct hair_fluid_strands strands;
    double dt; // Duration of the step, in s.
    const struct hair_collider_field* field;
    const struct hair_colliders* colliders; // Colliders, which move from `previous` to `current`.
    double colliders_dt; // Duration of their motion, in s.
};

hair_result hair_fluid_ensure_programs(struct hair_gl* gl, hair_fluid_method method, int porous);

// Create a fluid. On failure nothing is left.
hair_result hair_fluid_create(struct hair_fluid* fluid, struct hair_gl* gl,
                              const struct hair_fluid_desc* desc);
void hair_fluid_destroy(struct hair_fluid* fluid);

// Make room for the velocities of `colliders` colliders, before a step that has them.
hair_result hair_fluid_make_room(struct hair_fluid* fluid, uint32_t colliders);
void hair_fluid_step(struct hair_fluid* fluid, const struct hair_fluid_now* now);

// Run the first half of a step. The grid of hair, which spans the box along the world's axes, is
// filled between the halves.
void hair_fluid_place(struct hair_fluid* fluid, const struct hair_fluid_now* now);
// Run the second half of a step.
void hair_fluid_move(struct hair_fluid* fluid);

// Forget the past. The next step is the first.
void hair_fluid_reset(struct hair_fluid* fluid);
// Publish the current velocities, after other code has written them.
void hair_fluid_publish(struct hair_fluid* fluid);
// Bind the air's velocities at HAIR_UNIT_AIR.
void hair_fluid_bind(const struct hair_fluid* fluid);

static inline float hair_fluid_cell(const struct hair_fluid* fluid)
{
    return fluid->desc.side / (float)fluid->desc.cells;
}
// Return the number of slots of the finest level.
static inline size_t hair_fluid_slots(const struct hair_fluid* fluid)
{
    return (size_t)(fluid->desc.cells + 1) * (fluid->desc.cells + 1) * (fluid->desc.cells + 1);
}

static inline uint32_t hair_fluid_nodes(const struct hair_fluid* fluid)
{
    return fluid->desc.cells < HAIR_FLUID_NODES ? fluid->desc.cells : HAIR_FLUID_NODES;
}

// Compute how open faces are. hair_fluid_place() writes the inputs of all parts of a step, and
// calls this if the openness changes.
void hair_fluid_find_face_fractions(struct hair_fluid* fluid, const struct hair_fluid_now* now);
// Advect the velocities.
void hair_fluid_advect(struct hair_fluid* fluid);
// Subtract the pressure gradient and publish the velocities.
void hair_fluid_project(struct hair_fluid* fluid);

// Create the buffers of hair coupling, or free them if `wanted` is 0. Defined in porous.c.
hair_result hair_fluid_ensure_hair(struct hair_fluid* fluid, int wanted);
void hair_fluid_free_hair(struct hair_fluid* fluid);
// Reduce the openness of faces by hair.
void hair_fluid_apply_porosity(struct hair_fluid* fluid);

// Compute the pressures that cancel the divergence of cells. Defined in solve.c.
void hair_fluid_solve(struct hair_fluid* fluid);

// Functions of fluid_pass.c, on which all files above build.

// Create a buffer of `count` numbers, and its buffer texture.
hair_result hair_fluid_make_buffer(struct hair_fluid* fluid, const char* label, size_t count, GLenum format,
                                   struct hair_fluid_buffer* out);
void hair_fluid_free_buffer(struct hair_fluid* fluid, struct hair_fluid_buffer* buffer);
// Compute how open faces of coarser levels are, if the method needs it.
void hair_fluid_coarsen(struct hair_fluid* fluid);

// Run one pass over a level.
void hair_fluid_run(struct hair_fluid* fluid, hair_gl_pass pass, uint32_t level, uint32_t color,
                    uint32_t threads);

#endif
