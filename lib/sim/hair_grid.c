// hair_grid.c - the hair-hair grid, filled and read at the start of every block.
#include "lib/sim/hair_grid.h"

#include "lib/sim/sim.h"

#define BLOCK (1.0 / 120) // Length of a block, s. A block is at least a substep long.
// Maximum length of a strand at a node, in cells, that the grid's units can hold. More counts as
// this.
#define MAX_OF_STRAND 16

// Return the number of vectors of four numbers, the unit in which the grid is cleared.
static uint32_t grid_fours(const struct hair_grid* hair_grid)
{
    return (HAIR_GRID_NODE_NUMBERS * hair_grid_count_nodes(hair_grid) + 3) / 4;
}

static hair_result make_grid(struct hair_sim* sim, const struct hair_guide* guides,
                             const struct hair_rest* rest)
{
    struct hair_gl* gl = sim->gl;
    struct hair_grid* hair_grid = &sim->hair_grid;
    HAIR_TRY(hair_grid_make_rest(sim, guides, rest));
    HAIR_TRY(hair_gl_ensure_programs(gl, HAIR_GL_HAIR_GRID_CLEAR, HAIR_GL_HAIR_GRID_GATHER, 0));
    size_t grid = (size_t)grid_fours(hair_grid) * 4 * sizeof(int32_t);
    HAIR_TRY(hair_gl_uniform(gl, HAIR_GL_CATEGORY_HAIR_GRID, "hair grid", sizeof(struct hair_grid_params),
                             &hair_grid->params));
    HAIR_TRY(hair_gl_storage(gl, HAIR_GL_CATEGORY_HAIR_GRID, "hair grid", grid, NULL, &hair_grid->grid));
    HAIR_TRY(hair_gl_undefined_storage(gl, HAIR_GL_CATEGORY_HAIR_GRID, "hair grid motion",
                                       hair_grid_count_nodes(hair_grid) * sizeof(struct hair_grid_node),
                                       &hair_grid->node_motion));
    return hair_gl_ensure_array(gl, HAIR_GL_CATEGORY_HAIR_GRID, "hair grid accelerations",
                                sim->guide_vertices * sizeof(hair_vec4), &hair_grid->acceleration, GL_RGBA32F,
                                &hair_grid->texture);
}

hair_result hair_grid_create(struct hair_sim* sim, const struct hair_guide* guides,
                             const struct hair_rest* rest)
{
    if (!hair_grid_is_on(sim) || sim->hair_grid.splat) return HAIR_OK;
    hair_result result = make_grid(sim, guides, rest);
    if (result) hair_grid_free(sim);
    return result;
}

hair_result hair_sim_ensure_hair_grid(struct hair_sim* sim)
{
    const struct hair_rest* rest;
    const struct hair_guide* guides = hair_sim_guides(sim, &rest);
    return guides ? hair_grid_create(sim, guides, rest) : HAIR_OK;
}

void hair_grid_free(struct hair_sim* sim)
{
    struct hair_grid* hair_grid = &sim->hair_grid;
    hair_gl_free_array(sim->gl, &hair_grid->acceleration, &hair_grid->texture);
    hair_grid_free_weights(sim);
}

void hair_grid_free_weights(struct hair_sim* sim)
{
    struct hair_grid* hair_grid = &sim->hair_grid;
    hair_gl_free_buffer(sim->gl, &hair_grid->params);
    hair_gl_free_buffer(sim->gl, &hair_grid->grid);
    hair_gl_free_buffer(sim->gl, &hair_grid->node_motion);
    hair_gl_free_buffer(sim->gl, &hair_grid->splat);
    hair_gl_free_buffer(sim->gl, &hair_grid->order);
    hair_gl_free_buffer(sim->gl, &hair_grid->rest_density);
}

static uint32_t block_length(const struct hair_sim* sim)
{
    return hair_sim_block_length(sim, BLOCK);
}

static void write_grid_params(const struct hair_sim* sim, struct hair_grid_params* params)
{
    const struct hair_grid* hair_grid = &sim->hair_grid;
    double time = block_length(sim) * sim->substep, rate = (double)sim->physics.hair_hair.cohesion;
    float sound = 0.5f * hair_grid->cell / (float)time; // Half a cell per block is stable.
    hair_quat q = sim->last_after.rotation;
    hair_vec3 moved = hair_pose_offset(&sim->last_after, &sim->last_before);
    // The fraction of a relative velocity after a block is exp(-rate time), for any length of the
    // block.
    *params = (struct hair_grid_params){
        .rotation = {q.x, q.y, q.z, q.w},
        .moved = {moved.x, moved.y, moved.z, (float)(1 / sim->last_substep)},
        .lower = {hair_grid->lower.x, hair_grid->lower.y, hair_grid->lower.z, hair_grid->cell},
        .nodes_x = hair_grid->nodes[0],
        .nodes_y = hair_grid->nodes[1],
        .nodes_z = hair_grid->nodes[2],
        .vertices = sim->guide_vertices,
        .cohesion = (float)(-expm1(-rate * time) / time),
        .pressure_stiffness = fminf(sim->physics.hair_hair.pressure_stiffness, sound * sound),
        .per_strand = (float)(hair_grid->metres / HAIR_GRID_UNITS) / (MAX_OF_STRAND * hair_grid->cell),
        .ahead = HAIR_GRID_SPEED * 0.5f * (float)time / hair_grid->cell,
    };
}

bool hair_grid_is_due(const struct hair_sim* sim)
{
    return hair_grid_is_on(sim) && hair_grid_substeps_left(sim) == block_length(sim);
}

uint32_t hair_grid_substeps_left(const struct hair_sim* sim)
{
    return hair_sim_block_left(sim->hair_grid.substeps_done, block_length(sim));
}

void hair_grid_reset(struct hair_sim* sim)
{
    sim->hair_grid.substeps_done = 0;
}

static uint32_t groups_for_threads(uint32_t threads)
{
    return (threads + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE;
}

void hair_grid_update(struct hair_sim* sim)
{
    struct hair_gl* gl = sim->gl;
    struct hair_grid* hair_grid = &sim->hair_grid;
    struct hair_grid_params params;
    GLuint storage[] = {sim->state,       hair_grid->grid,         sim->history,
                        hair_grid->splat, hair_grid->rest_density, hair_grid->acceleration};
    uint32_t groups = groups_for_threads(sim->guide_vertices);
    HAIR_ASSERT(hair_grid->texture && sim->last_substep > 0);
    hair_grid_reset(sim);
    write_grid_params(sim, &params);
    hair_gl_write_uniform(gl, hair_grid->params, sizeof params, &params);
    hair_gl_bind_buffers(gl, GL_UNIFORM_BUFFER, HAIR_BIND_HAIR_GRID_PARAMS, 1, &hair_grid->params);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_STATE, 6, storage);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_SPLAT_ORDER, 1, &hair_grid->order);
    hair_gl_run(gl, HAIR_GL_HAIR_GRID_CLEAR, groups_for_threads(grid_fours(hair_grid)));
    hair_gl_run(gl, HAIR_GL_HAIR_GRID_SPLAT, groups);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_NODE_MOTION, 1, &hair_grid->node_motion);
    hair_gl_run(gl, HAIR_GL_HAIR_GRID_MOTION, groups_for_threads(hair_grid_count_nodes(hair_grid)));
    hair_gl_run(gl, HAIR_GL_HAIR_GRID_GATHER, groups);
}

void hair_grid_bind(struct hair_sim* sim)
{
    hair_gl_bind_texture(sim->gl, HAIR_UNIT_ACCELERATION, sim->hair_grid.texture);
}

void hair_grid_count(struct hair_sim* sim, uint32_t substeps)
{
    sim->hair_grid.substeps_done = (sim->hair_grid.substeps_done + substeps) % block_length(sim);
}
