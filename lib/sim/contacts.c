// contacts.c - colliders of any shape and number. A few are in the parameters of the step. Many are
// in GPU buffers, with lists of the colliders in each cell.
#include "lib/sim/sim.h"

// Assumed maximum speed of hair relative to the head, m/s. Faster hair may pass through thin
// colliders.
#define FASTEST 5.0f
#define FARTHEST 1e4f // m. FARTHEST of glsl/sim/rod.glsl.
// Maximum iterations of sphere tracing in a list on a software rasteriser. See rounds_of_list() in
// loop_budget.c.
#define MAX_ROUNDS 630

static struct hair_collider_grid_desc describe_grid(const struct hair_sim* sim, double dt,
                                                    float fraction_start, double longest)
{
    hair_vec3 moved = hair_pose_offset(&sim->head, &sim->head_at_last_step);
    float h = (float)longest, half = 0.5f * (FASTEST * h + hair_length(moved) * fminf(h / (float)dt, 1));
    float far = HAIR_SIM_LOOSE * sim->reach;
    return (struct hair_collider_grid_desc){
        .reach = hair_sim_may_leave(sim) ? FARTHEST : fminf(far, FARTHEST),
        .slack = (float)HAIR_CONTACT_FIT + fminf(half, HAIR_CONTACT_SLACK),
        .margin = sim->physics.collision.margin,
        .fraction_start = fraction_start,
        .max_rounds = sim->gl->software ? MAX_ROUNDS : UINT32_MAX,
    };
}

bool hair_contacts_are_any(const struct hair_sim* sim)
{
    return sim->rods && (sim->colliders.meshes || hair_contacts_are_listed(sim));
}

bool hair_contacts_are_listed(const struct hair_sim* sim)
{
    return sim->rods && sim->colliders.contacts > HAIR_FEW_COLLIDERS;
}

static void release_meshes(struct hair_sim* sim, const uint32_t* held, uint32_t count)
{
    for (uint32_t i = 0; i < count; ++i) hair_sdf_pool_release(sim->contacts.sdf_pool, held[i]);
}

// Hold the collision meshes of this step's contacts. Release those of the last step's.
static hair_result retain_meshes(struct hair_sim* sim)
{
    struct hair_contacts* contacts = &sim->contacts;
    struct hair_collider_grid* cells = &contacts->grid;
    uint32_t count = 0, taken = 0;
    hair_result result = HAIR_OK;
    for (uint32_t i = 0; i < cells->contacts; ++i) count += cells->contact[i].body.size.w == HAIR_SHAPE_MESH;
    if (!count && !contacts->holds) return HAIR_OK;
    uint32_t* held = hair_alloc(&sim->gl->host, count, sizeof *held);
    if (!held) return hair_fail_memory(&sim->gl->host, "the collision meshes of colliders");
    for (uint32_t i = 0; i < cells->contacts && !result; ++i) {
        if (cells->contact[i].body.size.w != HAIR_SHAPE_MESH) continue;
        HAIR_ASSERT(taken < count && cells->collider[i] < sim->colliders.current.count);
        result = hair_sdf_pool_acquire(
            contacts->sdf_pool, sim->colliders.current.collider[cells->collider[i]].mesh, &held[taken]);
        if (!result) ++taken;
    }
    if (result) {
        release_meshes(sim, held, taken);
        hair_free(&sim->gl->host, held);
        return result;
    }
    HAIR_ASSERT(taken == count);
    release_meshes(sim, contacts->held, contacts->holds);
    hair_free(&sim->gl->host, contacts->held);
    contacts->held = held;
    contacts->holds = taken;
    if (taken) result = hair_sdf_pool_ensure_texture(contacts->sdf_pool);
    for (uint32_t i = 0, k = 0; i < cells->contacts; ++i) // hair_sdf_pool_acquire() may move nodes.
        if (cells->contact[i].body.size.w == HAIR_SHAPE_MESH)
            cells->contact[i].mesh.first = contacts->sdf_pool->pooled[held[k++]].first;
    return result;
}

static hair_result ensure_texture_buffer(struct hair_gl* gl, const char* label, GLenum format, size_t size,
                                         const void* data, GLuint* buffer, GLuint* texture)
{
    size_t texel = format == GL_R32UI ? 4 : 16;
    HAIR_ASSERT(size > 0 && size % texel == 0);
    if (size / texel > (size_t)gl->max_buffer_texels)
        return hair_fail(&gl->host, HAIR_ERROR_OPENGL, "%s takes %zu texels, more than the driver's %d",
                         label, size / texel, gl->max_buffer_texels);
    if (!*buffer) HAIR_TRY(hair_gl_uniform(gl, HAIR_GL_CATEGORY_FIELD, label, 16, buffer));
    if (!*texture) HAIR_TRY(hair_gl_buffer_texture(gl, label, format, *buffer, texture));
    return hair_gl_resize(gl, label, size, data, *buffer);
}

static hair_result upload_contacts(struct hair_sim* sim)
{
    struct hair_contacts* contacts = &sim->contacts;
    const struct hair_collider_grid* cells = &contacts->grid;
    const struct hair_contact none = {.ball = {0, 0, 0, 0}};
    HAIR_TRY(ensure_texture_buffer(
        sim->gl, "hair contacts", GL_RGBA32UI, (cells->contacts ? cells->contacts : 1) * sizeof none,
        cells->contacts ? cells->contact : &none, &contacts->collider, &contacts->collider_texture));
    return ensure_texture_buffer(sim->gl, "hair contact cells", GL_R32UI,
                                 cells->entries * sizeof *cells->entry, cells->entry, &contacts->cell,
                                 &contacts->cell_texture);
}

static hair_result find_contacts(struct hair_sim* sim, const struct hair_collider_grid_desc* desc)
{
    const hair_host* host = &sim->gl->host;
    struct hair_collider_grid* cells = &sim->contacts.grid;
    int others = 0;
    HAIR_TRY(
        hair_collider_grid_gather(host, cells, &sim->colliders, &sim->head_at_last_step, &sim->head, desc));
    HAIR_TRY(retain_meshes(sim));
    if (!sim->contacts.listed) return HAIR_OK;
    HAIR_TRY(hair_collider_grid_build(host, cells, desc, &others));
    return others ? upload_contacts(sim) : HAIR_OK;
}

hair_result hair_contacts_find(struct hair_sim* sim, double dt, float fraction_start, double longest)
{
    struct hair_collider_grid_desc desc = describe_grid(sim, dt, fraction_start, longest);
    hair_result result = find_contacts(sim, &desc);
    if (result) sim->contacts.grid.entries = 0; // The lists on the GPU may be incomplete.
    return result;
}

static void write_few(const struct hair_collider_grid* cells, struct hair_step_params* params)
{
    HAIR_ASSERT(cells->contacts <= HAIR_FEW_COLLIDERS);
    for (uint32_t i = 0; i < cells->contacts; ++i) {
        params->collider[i] = cells->contact[i].around;
        params->body[i] = cells->contact[i].body;
        params->mesh[i] = cells->contact[i].mesh;
    }
}

void hair_contacts_write(const struct hair_sim* sim, struct hair_step_params* params)
{
    const struct hair_collider_grid* cells = &sim->contacts.grid;
    params->colliders = cells->contacts;
    if (!sim->contacts.listed) {
        write_few(cells, params);
        return;
    }
    HAIR_ASSERT(cells->size > 0 && cells->entries > 0);
    params->cells_lower = (hair_vec4){cells->lower.x, cells->lower.y, cells->lower.z, 1 / cells->size};
    params->cells_x = cells->cells[0];
    params->cells_y = cells->cells[1];
    params->cells_z = cells->cells[2];
    params->cells_slack = cells->made_for.slack - (float)HAIR_CONTACT_FIT;
}

void hair_contacts_bind(const struct hair_sim* sim)
{
    const struct hair_contacts* contacts = &sim->contacts;
    if (contacts->listed) {
        HAIR_ASSERT(contacts->collider_texture && contacts->cell_texture);
        hair_gl_bind_texture(sim->gl, HAIR_UNIT_CONTACT, contacts->collider_texture);
        hair_gl_bind_texture(sim->gl, HAIR_UNIT_CELL, contacts->cell_texture);
    }
    if (contacts->holds) hair_gl_bind_texture(sim->gl, HAIR_UNIT_NODE, contacts->sdf_pool->texture);
}

void hair_contacts_free(struct hair_sim* sim)
{
    struct hair_contacts* contacts = &sim->contacts;
    release_meshes(sim, contacts->held, contacts->holds);
    hair_free(&sim->gl->host, contacts->held);
    hair_gl_free_array(sim->gl, &contacts->collider, &contacts->collider_texture);
    hair_gl_free_array(sim->gl, &contacts->cell, &contacts->cell_texture);
    hair_collider_grid_free(&sim->gl->host, &contacts->grid);
    *contacts = (struct hair_contacts){.sdf_pool = contacts->sdf_pool};
}
