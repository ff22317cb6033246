// step_params.c - parameters of a step that shaders read.
#include "lib/sim/sim.h"

#define TWO_PI 6.28318530718f
// Maximum displacement in a substep, m. Beyond it redblack.comp resets strands to their rest pose.
#define FARTHEST 1e4f

static hair_vec4 vec4_with(hair_vec3 v, float w)
{
    return (hair_vec4){v.x, v.y, v.z, w};
}

static float squared_frequency(float hertz)
{
    return TWO_PI * TWO_PI * hertz * hertz;
}

void hair_sim_write_physics(const struct hair_sim* sim, struct hair_step_params* params)
{
    HAIR_ASSERT(sim->substep > 0);
    const hair_physics* physics = &sim->physics;
    params->gravity =
        (hair_vec4){physics->gravity[0], physics->gravity[1], physics->gravity[2], (float)sim->substep};
    params->keep = (float)exp(-(double)physics->damping * sim->substep); // dv/dt = -c v, exactly
    // Solvers with rods only ask whether there is a frequency.
    const hair_physics max = hair_sim_max_physics(sim);
    params->shape_frequency_root = TWO_PI * max.shape.frequency_root;
    params->shape_frequency_tip = TWO_PI * max.shape.frequency_tip;
    params->angular = squared_frequency(physics->redblack.angular_hz);
    params->bend = physics->redblack.bend;
    params->collision_margin = physics->collision.margin;
    params->iterations = physics->redblack.iterations;
    params->guides = sim->guides;
    params->vertices = sim->guide_vertices;
    params->smooth_vertices = sim->smooth_vertices;
    if (sim->rods) hair_sim_write_rods(sim, params);
}

void hair_sim_write_now(const struct hair_sim* sim, struct hair_step_params* params)
{
    hair_vec3 moved = hair_pose_offset(&sim->last_after, &sim->last_before);
    int far = !(hair_dot(moved, moved) < FARTHEST * FARTHEST); // Too far to interpolate.
    double span = sim->next_substep > 0 ? sim->next_substep : sim->last_substep;
    HAIR_ASSERT(span > 0 && sim->accumulator >= 0);
    params->alpha = far ? 1 : (float)fmin(sim->accumulator / span, 1);
    params->rotation_before = hair_quat_to_vec4(sim->last_before.rotation);
    params->rotation_after = hair_quat_to_vec4(sim->last_after.rotation);
    params->rotation_now = hair_quat_to_vec4(sim->head.rotation);
    params->last_displacement = vec4_with(far ? hair_v3(0, 0, 0) : moved, 0);
}

void hair_sim_upload(struct hair_sim* sim, const struct hair_step_params* params)
{
    hair_gl_write_uniform(sim->gl, sim->step, sizeof *params, params);
}

void hair_sim_upload_render_state(struct hair_sim* sim)
{
    struct hair_step_params params = {0};
    hair_sim_write_physics(sim, &params);
    hair_sim_write_now(sim, &params);
    // The head may have moved since.
    params.rotation_now = hair_quat_to_vec4(sim->head_at_last_step.rotation);
    hair_sim_upload(sim, &params);
}

double hair_sim_fraction_at_end(const struct hair_sim* sim, uint32_t i, double from, double dt)
{
    return fmax(fmin((from + (i + 1) * sim->substep) / dt, 1), 0);
}

void hair_sim_write_substeps(struct hair_sim* sim, struct hair_step_params* params, uint32_t count,
                             double from, double dt)
{
    HAIR_ASSERT(0 < count && count <= HAIR_STEP_SUBSTEPS);
    for (uint32_t i = 0; i < count; ++i) {
        double fraction = hair_sim_fraction_at_end(sim, i, from, dt);
        sim->last_before = sim->last_after;
        sim->last_after = hair_pose_between(&sim->head_at_last_step, &sim->head, fraction);
        params->substep[i].rotation = hair_quat_to_vec4(sim->last_after.rotation);
        params->substep[i].displacement =
            vec4_with(hair_pose_offset(&sim->last_after, &sim->last_before), (float)fraction);
    }
    params->substeps = count;
}

// Set the bits of the colliders that are neither spheres nor capsules.
static void mark_bodies(struct hair_step_params* params)
{
    HAIR_ASSERT(params->colliders <= HAIR_FEW_COLLIDERS); // `bodies` has a bit for each.
    for (uint32_t i = 0; i < params->colliders; ++i)
        if (params->body[i].size.w > HAIR_SHAPE_CAPSULE) params->bodies |= 1u << i;
}

void hair_sim_write_colliders(const struct hair_sim* sim, struct hair_step_params* params)
{
    if (sim->contacts.any) {
        hair_contacts_write(sim, params);
    } else if (sim->rods) {
        params->colliders = hair_colliders_bodies(&sim->colliders, &sim->head_at_last_step, &sim->head,
                                                  params->collider, params->body);
    } else {
        params->colliders =
            hair_colliders_capsules(&sim->colliders, &sim->head_at_last_step, &sim->head, params->collider);
    }
    if (sim->rods && !sim->contacts.listed) mark_bodies(params);
}
