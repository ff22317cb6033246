// wind_coupling.c - the fluid of a simulation. The wind's settings decide its size and method. The
// fluid is stepped at the start of every block of substeps.
#include "lib/sim/wind_coupling.h"

#include "lib/sim/sim.h"

#define BLOCK (1.0 / 60) // Length of a block, s. A block is at least a substep long.
// Default side of the fluid's box, as a multiple of the distance field's longest side.
#define AROUND 1.5f

bool hair_wind_coupling_is_on(const struct hair_sim* sim)
{
    return sim->rods && sim->wind.model == HAIR_WIND_FLUID && hair_wind_is_on(&sim->wind);
}

static hair_vec3 field_size(const struct hair_field_box* box)
{
    float side = HAIR_BRICK * box->voxel;
    return hair_v3(side * (float)box->bricks[0], side * (float)box->bricks[1], side * (float)box->bricks[2]);
}

// Return the number of cycles or sweeps that reduce the divergence to a thousandth.
static uint32_t enough(hair_projection projection, uint32_t cells)
{
    if (projection == HAIR_PROJECTION_MULTIGRID) return 4;
    return projection == HAIR_PROJECTION_RELAXATION ? 5 * cells / 2 : cells * cells / 2;
}

static struct hair_fluid_desc desc_of(const struct hair_sim* sim)
{
    const hair_wind* wind = &sim->wind;
    hair_vec3 size = field_size(&sim->wind_coupling.field->box);
    struct hair_fluid_desc desc = {.cells = (wind->fluid.resolution + 15) / 16 * 16,
                                   .side = wind->fluid.grid_size,
                                   .method = (hair_fluid_method)wind->fluid.projection,
                                   .cycles = wind->fluid.projection_iterations};
    if (desc.side == 0) desc.side = AROUND * fmaxf(size.x, fmaxf(size.y, size.z));
    if (desc.cycles == 0) desc.cycles = enough(wind->fluid.projection, desc.cells);
    return desc;
}

static void free_hair(struct hair_wind_coupling* wind_coupling, struct hair_gl* gl)
{
    hair_gl_free_buffer(gl, &wind_coupling->splat);
    hair_gl_free_buffer(gl, &wind_coupling->order);
    hair_gl_free_buffer(gl, &wind_coupling->params);
}

void hair_wind_coupling_free_hair(struct hair_sim* sim)
{
    free_hair(&sim->wind_coupling, sim->gl);
}

static bool is_porous(const struct hair_sim* sim)
{
    return sim->wind.fluid.drag_strand_count > 0 && sim->physics.drag > 0;
}

static hair_result ensure_hair(struct hair_sim* sim, struct hair_fluid* fluid)
{
    struct hair_wind_coupling* wind_coupling = &sim->wind_coupling;
    int wanted = is_porous(sim);
    if (!wanted) free_hair(wind_coupling, sim->gl);
    HAIR_TRY(hair_fluid_ensure_hair(fluid, wanted));
    if (wanted && !wind_coupling->order)
        HAIR_TRY(hair_grid_weigh(sim, &wind_coupling->splat, &wind_coupling->order, &wind_coupling->metres));
    if (wanted && !wind_coupling->params)
        HAIR_TRY(hair_gl_uniform(sim->gl, HAIR_GL_CATEGORY_WIND, "hair grid of the fluid",
                                 sizeof(struct hair_grid_params), &wind_coupling->params));
    return HAIR_OK;
}

hair_result hair_wind_coupling_ensure_programs(struct hair_sim* sim)
{
    if (!hair_wind_coupling_is_on(sim)) return HAIR_OK;
    return hair_fluid_ensure_programs(sim->gl, (hair_fluid_method)sim->wind.fluid.projection, is_porous(sim));
}

static hair_result ensure_parts(struct hair_sim* sim, struct hair_fluid* fluid)
{
    HAIR_TRY(ensure_hair(sim, fluid));
    return hair_fluid_make_room(fluid, sim->colliders.current.count);
}

hair_result hair_wind_coupling_prepare(struct hair_sim* sim, struct hair_fluid* other)
{
    struct hair_fluid* fluid = &sim->wind_coupling.fluid;
    *other = (struct hair_fluid){0};
    if (!hair_wind_coupling_is_on(sim)) return HAIR_OK;
    struct hair_fluid_desc desc = desc_of(sim), was = fluid->desc;
    if (fluid->gl && was.cells == desc.cells && was.side == desc.side && was.method == desc.method) {
        fluid->desc.cycles = desc.cycles;
        return ensure_parts(sim, fluid);
    }
    HAIR_TRY(hair_fluid_create(other, sim->gl, &desc));
    hair_result result = ensure_parts(sim, other);
    if (result) hair_fluid_destroy(other);
    return result;
}

void hair_wind_coupling_replace(struct hair_wind_coupling* wind_coupling, const struct hair_fluid* other)
{
    if (!other->gl) return;
    wind_coupling->fluid = *other;
    wind_coupling->substeps_done = 0;
}

hair_result hair_wind_coupling_ensure(struct hair_sim* sim)
{
    struct hair_fluid other;
    HAIR_TRY(hair_wind_coupling_prepare(sim, &other));
    if (other.gl) hair_fluid_destroy(&sim->wind_coupling.fluid);
    hair_wind_coupling_replace(&sim->wind_coupling, &other);
    return HAIR_OK;
}

void hair_wind_coupling_free(struct hair_sim* sim)
{
    free_hair(&sim->wind_coupling, sim->gl);
    hair_fluid_destroy(&sim->wind_coupling.fluid);
    sim->wind_coupling.substeps_done = 0;
}

void hair_wind_coupling_reset(struct hair_sim* sim)
{
    if (sim->wind_coupling.fluid.gl) hair_fluid_reset(&sim->wind_coupling.fluid);
    sim->wind_coupling.substeps_done = 0;
}

static uint32_t wind_block_length(const struct hair_sim* sim)
{
    return hair_sim_block_length(sim, BLOCK);
}

// Gather the mass and momentum of hair in the fluid's box.
static void gather_hair(struct hair_sim* sim)
{
    struct hair_gl* gl = sim->gl;
    const struct hair_fluid* fluid = &sim->wind_coupling.fluid;
    HAIR_ASSERT(fluid->hair.grid.buffer && sim->wind_coupling.splat && sim->last_substep > 0);
    uint32_t nodes = hair_fluid_nodes(fluid), fours = nodes * nodes * nodes;
    float cell = fluid->desc.side / (float)nodes, half = 0.5f * cell;
    hair_vec3 lower = hair_add(fluid->lower, hair_v3(half, half, half));
    struct hair_grid_params params = {.rotation = {0, 0, 0, 1},
                                      .moved = {0, 0, 0, (float)(1 / sim->last_substep)},
                                      .lower = {lower.x, lower.y, lower.z, cell},
                                      .nodes_x = nodes,
                                      .nodes_y = nodes,
                                      .nodes_z = nodes,
                                      .vertices = sim->guide_vertices};
    GLuint storage[] = {sim->state, fluid->hair.grid.buffer, sim->history, sim->wind_coupling.splat};
    hair_gl_write_uniform(gl, sim->wind_coupling.params, sizeof params, &params);
    hair_gl_bind_buffers(gl, GL_UNIFORM_BUFFER, HAIR_BIND_HAIR_GRID_PARAMS, 1, &sim->wind_coupling.params);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_STATE, 4, storage);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_SPLAT_ORDER, 1, &sim->wind_coupling.order);
    hair_gl_run(gl, HAIR_GL_FLUID_CLEAR, (fours + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE);
    hair_gl_run(gl, HAIR_GL_FLUID_SPLAT, (sim->guide_vertices + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE);
}

// Return the drag of the hair on the air, from the drag of the air on guides. The guides gain the
// momentum that the air loses.
static struct hair_fluid_strands strands_of(const struct hair_sim* sim)
{
    const hair_wind* wind = &sim->wind;
    HAIR_ASSERT(sim->guides > 0 && sim->wind_coupling.metres > 0);
    double viscosity = (double)wind->viscosity / (double)wind->density;
    return (struct hair_fluid_strands){
        .metres = sim->wind_coupling.metres * wind->fluid.drag_strand_count / sim->guides,
        .per_speed = (float)(2 * (double)sim->physics.fiber.radius / viscosity),
        .viscous = (float)((double)sim->physics.drag * viscosity),
    };
}

bool hair_wind_coupling_is_due(const struct hair_sim* sim)
{
    return hair_wind_coupling_is_on(sim) && hair_wind_coupling_substeps_left(sim) == wind_block_length(sim);
}

uint32_t hair_wind_coupling_substeps_left(const struct hair_sim* sim)
{
    return hair_sim_block_left(sim->wind_coupling.substeps_done, wind_block_length(sim));
}

void hair_wind_coupling_update(struct hair_sim* sim, double dt)
{
    struct hair_wind_coupling* wind_coupling = &sim->wind_coupling;
    const struct hair_field_box* box = &wind_coupling->field->box;
    HAIR_ASSERT(wind_coupling->fluid.gl && dt > 0);
    wind_coupling->substeps_done = 0;
    struct hair_fluid_now now = {.head = sim->last_after,
                                 .middle = hair_add(box->lower, hair_scale(field_size(box), 0.5f)),
                                 .wind = hair_load3(sim->wind.velocity),
                                 .gusts =
                                     hair_wind_find_gusts(&sim->wind_state, &sim->wind, &sim->last_after),
                                 .dt = wind_block_length(sim) * sim->substep,
                                 .field = wind_coupling->field,
                                 .colliders = &sim->colliders,
                                 .colliders_dt = dt};
    if (wind_coupling->splat) now.strands = strands_of(sim);
    hair_fluid_place(&wind_coupling->fluid, &now);
    if (wind_coupling->splat) gather_hair(sim);
    hair_fluid_move(&wind_coupling->fluid);
}

void hair_wind_coupling_count(struct hair_sim* sim, uint32_t substeps)
{
    HAIR_ASSERT(sim->wind_coupling.substeps_done + substeps <= wind_block_length(sim));
    sim->wind_coupling.substeps_done = (sim->wind_coupling.substeps_done + substeps) % wind_block_length(sim);
}

hair_vec4 hair_wind_coupling_box(const struct hair_sim* sim)
{
    const struct hair_fluid* fluid = &sim->wind_coupling.fluid;
    double cell = (double)hair_fluid_cell(fluid), lower[3];
    for (int k = 0; k < 3; ++k) lower[k] = fluid->origin[k] * cell - sim->last_after.position[k];
    return (hair_vec4){(float)lower[0], (float)lower[1], (float)lower[2], 1 / fluid->desc.side};
}
