// solve.c - pressure solvers, by cycles of multigrid or by sweeps over a single grid.
#include "lib/wind/fluid.h"

static bool takes(hair_fluid_method method, hair_gl_pass pass)
{
    int coarse = pass == HAIR_GL_FLUID_RESTRICT || pass == HAIR_GL_FLUID_COARSE_SOLVE ||
                 pass == HAIR_GL_FLUID_PROLONG || pass == HAIR_GL_FLUID_COARSEN;
    if (coarse) return method == HAIR_FLUID_MULTIGRID;
    if (pass >= HAIR_GL_FLUID_CLEAR && pass <= HAIR_GL_FLUID_POROUS) return false;
    if (pass == HAIR_GL_FLUID_SMOOTH) return method != HAIR_FLUID_JACOBI;
    return pass != HAIR_GL_FLUID_JACOBI || method == HAIR_FLUID_JACOBI;
}

hair_result hair_fluid_ensure_programs(struct hair_gl* gl, hair_fluid_method method, int porous)
{
    for (hair_gl_pass pass = HAIR_GL_FLUID_FACE_FRACTIONS; pass <= HAIR_GL_FLUID_EXPORT_VELOCITY; ++pass)
        if (takes(method, pass)) HAIR_TRY(hair_gl_ensure_program(gl, pass));
    if (!porous) return HAIR_OK;
    return hair_gl_ensure_programs(gl, HAIR_GL_FLUID_CLEAR, HAIR_GL_FLUID_POROUS, 0);
}

static uint32_t cubed(uint32_t n)
{
    return n * n * n;
}

static void sweep_level(struct hair_fluid* fluid, uint32_t level, uint32_t first)
{
    HAIR_ASSERT(level < fluid->levels && first < 2);
    uint32_t cells = cubed(fluid->level[level].cells) / 2;
    hair_fluid_run(fluid, HAIR_GL_FLUID_SMOOTH, level, first, cells);
    hair_fluid_run(fluid, HAIR_GL_FLUID_SMOOTH, level, 1 - first, cells);
}

// Run a V-cycle. Coarse cells take over the residuals of eight finer cells, and return their
// pressures by injection. With halved right sides, the correction is as large as a smooth error
// needs. Injection mixes no pressures across colliders. One sweep before and three after were the
// fewest sweeps that reached a fraction of 1e-3 over balls, plates and slits.
static void cycle(struct hair_fluid* fluid)
{
    uint32_t last = fluid->levels - 1;
    HAIR_ASSERT(fluid->level[last].cells <= HAIR_FLUID_COARSEST);
    for (uint32_t i = 0; i < last; ++i) {
        sweep_level(fluid, i, 0);
        hair_fluid_run(fluid, HAIR_GL_FLUID_RESTRICT, i, 0, cubed(fluid->level[i + 1].cells));
    }
    // One group, whatever its size.
    hair_fluid_run(fluid, HAIR_GL_FLUID_COARSE_SOLVE, last, 0, HAIR_GROUP_SIZE);
    for (uint32_t i = last; i-- > 0;) {
        hair_fluid_run(fluid, HAIR_GL_FLUID_PROLONG, i, 0, cubed(fluid->level[i].cells));
        for (int k = 0; k < 3; ++k) sweep_level(fluid, i, 1);
    }
}

void hair_fluid_solve(struct hair_fluid* fluid)
{
    fluid->current_pressure = 0;
    hair_fluid_run(fluid, HAIR_GL_FLUID_DIVERGENCE, 0, 0, cubed(fluid->desc.cells));
    for (uint32_t i = 0; i < fluid->desc.cycles; ++i) {
        if (fluid->desc.method == HAIR_FLUID_MULTIGRID)
            cycle(fluid);
        else if (fluid->desc.method == HAIR_FLUID_RELAXATION)
            sweep_level(fluid, 0, 0);
        else
            hair_fluid_run(fluid, HAIR_GL_FLUID_JACOBI, 0, 0, cubed(fluid->desc.cells));
    }
}
