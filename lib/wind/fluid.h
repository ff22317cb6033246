// fluid.h - air around the head as a fluid without viscosity or density of its own, on a grid of cells whose faces have
// velocities (Harlow and Welch 1965): carried along, then freed of what would press it together.
//
// The grid is a cube along the world's axes that goes with the head by whole cells. Around it is the wind. Solids are what
// the field says, each with its own velocity; a face is as open as the field says of sixteen parts of it, and as hair leaves
// it, where the fluid is to know of hair: see glsl/wind/porous.comp.
#ifndef HAIR_WIND_FLUID_H
#define HAIR_WIND_FLUID_H

#include "lib/collide/solid.h"
#include "lib/field/field.h"
#include "lib/gl/gl.h"
#include "lib/wind/air.h"

#define HAIR_FLUID_LEVELS 5 // from 128 cells along an axis to 8
#define HAIR_FLUID_NODES                                                                                     \
    32 // of the grid of hair, along an axis, at most: guides stand for locks as wide as that is fine

// How air is kept from being pressed together.
typedef enum hair_fluid_method {
    HAIR_FLUID_MULTIGRID = 0, // V-cycles: a sweep before, three after; see lib/wind/solve.c
    HAIR_FLUID_RELAXATION, // sweeps of Gauss and Seidel that go beyond
    HAIR_FLUID_JACOBI // sweeps of Jacobi
} hair_fluid_method;

struct hair_fluid_desc {
    uint32_t cells; // along an axis: a multiple of 16, up to 128
    float side; // of the box. m
    hair_fluid_method method;
    uint32_t cycles; // of multigrid; else sweeps
    float relax; // share of what fits a cell that a sweep takes; 0: what suits the method
    int closed; // nothing goes in or out
};

// A buffer, and the same as shaders read it.
struct hair_fluid_buffer {
    GLuint buffer, texture;
};

// Hair in the way of air. There is none of it until it is asked for.
struct hair_fluid_hair {
    struct hair_fluid_buffer grid; // where its mass and momentum are, as in the crowd's
    struct hair_fluid_buffer wall, open; // in place of the fluid's own, which are as solids leave them
};

struct hair_fluid_level_at {
    uint32_t cells, slot, cell; // as in hair_fluid_level
};

struct hair_fluid {
    struct hair_gl* gl; // NULL: there is none
    struct hair_fluid_desc desc;
    struct hair_fluid_level_at level[HAIR_FLUID_LEVELS + 1];
    uint32_t levels;
    struct hair_fluid_buffer velocity[3]; // of which
    uint32_t now; // is where the last step left it
    struct hair_fluid_buffer wall, open, right;
    struct hair_fluid_buffer pressure[2]; // the second of Jacobi only
    uint32_t pressed; // which of them is the later one
    struct hair_fluid_hair hair;
    GLuint params, level_params, motion;
    GLuint air; // 3D texture, RGBA16F: velocity at the middles of cells, m/s
    int fresh; // there is no past: the first step begins with the wind everywhere
    double origin[3]; // of the box, in cells from the world's origin: whole
    hair_vec3 wind; // of the last step,
    GLuint gusts; // and their texture
    hair_vec3 lower; // of the box, from the head's origin. m
    struct hair_fluid_motion* motion_of; // of solids, `room` of them at most
    uint32_t room;
    int moving; // some solid was in the last step
    struct hair_fluid_params made_for; // what the faces are open for,
    uint32_t writes; // and the field
};

// What there is of hair in a step, if the grid has any.
struct hair_fluid_strands {
    double metres; // of strands that a unit of the grid's mass stands for
    float per_speed; // Reynolds number of a strand by the speed of air, s/m
    float viscous; // drag of strands by a viscous force, m^2/s
};

// Where all is in a step.
struct hair_fluid_now {
    struct hair_pose head; // at its end
    hair_vec3 middle; // of the box, in the head's frame
    hair_vec3 wind; // m/s
    struct hair_air_gusts gusts; // at its start
    struct hair_fluid_strands strands;
    double dt; // s
    const struct hair_solid_field* field;
    const struct hair_solids* solids; // which move from `before` to `now`
    double solids_dt; // in this time, s
};

hair_result hair_fluid_need_programs(struct hair_gl* gl, hair_fluid_method method, int porous);

// On failure nothing is left.
hair_result hair_fluid_create(struct hair_fluid* fluid, struct hair_gl* gl,
                              const struct hair_fluid_desc* desc);
void hair_fluid_destroy(struct hair_fluid* fluid);

// Room for the velocities of so many solids, before a step that has them.
hair_result hair_fluid_make_room(struct hair_fluid* fluid, uint32_t solids);
void hair_fluid_step(struct hair_fluid* fluid, const struct hair_fluid_now* now);

// The same in two: between them the grid of hair is filled, which is along the world's axes all over the box.
void hair_fluid_place(struct hair_fluid* fluid, const struct hair_fluid_now* now);
void hair_fluid_move(struct hair_fluid* fluid);

void hair_fluid_forget(struct hair_fluid* fluid); // the past: the next step is the first
void hair_fluid_show(struct hair_fluid* fluid); // the air as it is, where that was put there
void hair_fluid_bind(const struct hair_fluid* fluid); // the air, at HAIR_UNIT_AIR

static inline float hair_fluid_cell(const struct hair_fluid* fluid)
{
    return fluid->desc.side / (float)fluid->desc.cells;
}
static inline size_t hair_fluid_slots(const struct hair_fluid* fluid) // of the finest level
{
    return (size_t)(fluid->desc.cells + 1) * (fluid->desc.cells + 1) * (fluid->desc.cells + 1);
}

static inline uint32_t hair_fluid_nodes(const struct hair_fluid* fluid)
{
    return fluid->desc.cells < HAIR_FLUID_NODES ? fluid->desc.cells : HAIR_FLUID_NODES;
}

// The parts of a step, in order: `place` writes what they are to know of it and opens faces if that is another than it was.
void hair_fluid_open(struct hair_fluid* fluid, const struct hair_fluid_now* now);
void hair_fluid_carry(struct hair_fluid* fluid);
void hair_fluid_project(struct hair_fluid* fluid);

// porous.c: what hair takes; and how open it leaves faces.
hair_result hair_fluid_need_hair(struct hair_fluid* fluid, int wanted);
void hair_fluid_free_hair(struct hair_fluid* fluid);
void hair_fluid_let_through(struct hair_fluid* fluid);

// solve.c: pressures that fit, from what flows into cells.
void hair_fluid_solve(struct hair_fluid* fluid);

// Of so many numbers.
hair_result hair_fluid_make_buffer(struct hair_fluid* fluid, const char* label, size_t count, GLenum format,
                                   struct hair_fluid_buffer* out);
void hair_fluid_free_buffer(struct hair_fluid* fluid, struct hair_fluid_buffer* buffer);
void hair_fluid_coarsen(struct hair_fluid* fluid); // how open faces are, where a method wants it

// One pass over a level.
void hair_fluid_run(struct hair_fluid* fluid, hair_gl_pass pass, uint32_t level, uint32_t color,
                    uint32_t threads);

#endif
