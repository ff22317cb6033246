// porous.c - hair as an obstacle that closes faces of the fluid in part.
#include "lib/wind/fluid.h"

static hair_result make_porous_buffers(struct hair_fluid* fluid)
{
    struct hair_fluid_hair* hair = &fluid->hair;
    size_t nodes = hair_fluid_nodes(fluid);
    HAIR_TRY(hair_fluid_make_buffer(fluid, "hair grid of the fluid", 4 * nodes * nodes * nodes, GL_RGBA32I,
                                    &hair->grid));
    HAIR_TRY(hair_fluid_make_buffer(fluid, "hair fluid walls among hair", 3 * hair_fluid_slots(fluid),
                                    GL_R32F, &hair->wall_velocity));
    return hair_fluid_make_buffer(fluid, "hair fluid openings among hair", fluid->level[fluid->levels].slot,
                                  GL_R32UI, &hair->face_fraction);
}

hair_result hair_fluid_ensure_hair(struct hair_fluid* fluid, int wanted)
{
    HAIR_ASSERT(fluid->gl && fluid->levels > 0);
    struct hair_fluid_hair* hair = &fluid->hair;
    if (!wanted == !hair->grid.buffer) return HAIR_OK;
    fluid->made_for.cells = 0; // Coarser faces depend on hair from now on, or no longer.
    hair_fluid_free_hair(fluid);
    if (!wanted) return HAIR_OK;
    HAIR_TRY(hair_fluid_ensure_programs(fluid->gl, fluid->desc.method, 1));
    hair_result result = make_porous_buffers(fluid);
    if (result) hair_fluid_free_hair(fluid);
    return result;
}

void hair_fluid_free_hair(struct hair_fluid* fluid)
{
    hair_fluid_free_buffer(fluid, &fluid->hair.grid);
    hair_fluid_free_buffer(fluid, &fluid->hair.wall_velocity);
    hair_fluid_free_buffer(fluid, &fluid->hair.face_fraction);
}

void hair_fluid_apply_porosity(struct hair_fluid* fluid)
{
    HAIR_ASSERT(fluid->hair.grid.buffer && fluid->hair.wall_velocity.buffer &&
                fluid->hair.face_fraction.buffer);
    hair_fluid_run(fluid, HAIR_GL_FLUID_POROUS, 0, 0, (uint32_t)hair_fluid_slots(fluid));
    hair_fluid_coarsen(fluid);
}
