// field.c - textures of the field, and the dispatches that write them.
#include "lib/field/bricks.h"

#include <string.h>

// Alignment of ranges in storage buffers, the maximum that a driver may require.
#define ALIGNMENT 256

void hair_field_create(struct hair_collider_field* field, struct hair_sdf_pool* pool,
                       const struct hair_groom* groom, float voxel)
{
    memset(field, 0, sizeof *field);
    field->gl = pool->gl;
    field->sdf_pool = pool;
    field->box = hair_field_box_of(groom, voxel);
}

// Free everything that views may change, and return to the state after hair_field_create().
static void clear(struct hair_collider_field* field)
{
    struct hair_gl* gl = field->gl;
    for (uint32_t i = 0; i < field->count; ++i)
        if (field->placed[i].mesh) hair_sdf_pool_release(field->sdf_pool, field->placed[i].place);
    hair_gl_free_texture(gl, &field->distance);
    hair_gl_free_texture(gl, &field->number);
    hair_gl_free_buffer(gl, &field->params);
    hair_gl_free_array(gl, &field->work, &field->work_texture);
    hair_free(&gl->host, field->placed);
    hair_free(&gl->host, field->dirty);
    hair_free(&gl->host, field->brick_colliders);
    hair_free(&gl->host, field->best);
    *field = (struct hair_collider_field){.gl = gl,
                                          .sdf_pool = field->sdf_pool,
                                          .box = field->box,
                                          .wants_numbers = field->wants_numbers,
                                          .writes = field->writes + 1,
                                          .stepped = field->stepped,
                                          .stepped_count = field->stepped_count,
                                          .stepped_room = field->stepped_room};
}

void hair_field_set_voxel(struct hair_collider_field* field, const struct hair_groom* groom, float voxel)
{
    clear(field);
    field->box = hair_field_box_of(groom, voxel);
}

void hair_field_destroy(struct hair_collider_field* field)
{
    if (!field->gl) return;
    clear(field);
    hair_free(&field->gl->host, field->stepped);
    field->stepped = NULL;
    field->stepped_count = field->stepped_room = 0;
}

static hair_result make_field(struct hair_collider_field* field)
{
    HAIR_ASSERT(!field->distance && !field->dirty);
    struct hair_gl* gl = field->gl;
    const struct hair_field_box* box = &field->box;
    uint32_t bricks = hair_field_bricks(box), size[3];
    for (int i = 0; i < 3; ++i) size[i] = HAIR_BRICK * box->bricks[i];
    HAIR_TRY(hair_gl_texture_3d(gl, HAIR_GL_CATEGORY_FIELD, "hair field", GL_R16F, size, GL_LINEAR,
                                &field->distance));
    HAIR_TRY(hair_gl_uniform(gl, HAIR_GL_CATEGORY_FIELD, "hair field", sizeof(struct hair_field_params),
                             &field->params));
    HAIR_TRY(hair_gl_uniform(gl, HAIR_GL_CATEGORY_FIELD, "hair field work", ALIGNMENT, &field->work));
    HAIR_TRY(hair_gl_buffer_texture(gl, "hair field work", GL_RGBA32UI, field->work, &field->work_texture));
    field->dirty = hair_alloc(&gl->host, bricks, sizeof *field->dirty);
    field->brick_colliders = hair_alloc(&gl->host, bricks, sizeof *field->brick_colliders);
    field->best = hair_alloc(&gl->host, bricks, sizeof *field->best);
    if (!field->dirty || !field->brick_colliders || !field->best)
        return hair_fail_memory(&gl->host, "the field");
    memset(field->dirty, 1, bricks);
    return HAIR_OK;
}

// Make the texture of numbers, which every brick must write.
static hair_result make_numbers(struct hair_collider_field* field)
{
    const struct hair_field_box* box = &field->box;
    uint32_t size[3];
    for (int i = 0; i < 3; ++i) size[i] = HAIR_BRICK * box->bricks[i];
    HAIR_TRY(hair_gl_texture_3d(field->gl, HAIR_GL_CATEGORY_FIELD, "hair field collider", GL_R32UI, size,
                                GL_NEAREST, &field->number));
    memset(field->dirty, 1, hair_field_bricks(box));
    return HAIR_OK;
}

void hair_field_want_numbers(struct hair_collider_field* field)
{
    field->wants_numbers = true;
}

hair_gl_pass hair_field_pass(const struct hair_collider_field* field, hair_gl_pass pass)
{
    return field->wants_numbers ? hair_gl_add_features(pass, HAIR_GL_WITH(NUMBERS)) : pass;
}

// Placing -----------------------------------------------------------------------------------------

static hair_result reserve_colliders(const hair_host* host, struct hair_placed_collider** array,
                                     uint32_t* room, uint32_t count)
{
    if (count <= *room) return HAIR_OK;
    void* placed = hair_grow(host, *array, sizeof **array, room, count < 16 ? 16 : count + count / 2);
    if (!placed) return hair_fail_memory(host, "colliders in the field");
    *array = placed;
    return HAIR_OK;
}

// Replace a placed collider by `now`. Keep the reference if both have the same collision mesh.
static hair_result replace(struct hair_collider_field* field, struct hair_placed_collider* placed,
                           struct hair_placed_collider* now)
{
    now->place = placed->place;
    if (now->mesh == placed->mesh) {
        *placed = *now;
        return HAIR_OK;
    }
    if (now->mesh) HAIR_TRY(hair_sdf_pool_acquire(field->sdf_pool, now->mesh, &now->place));
    if (placed->mesh) hair_sdf_pool_release(field->sdf_pool, placed->place);
    *placed = *now;
    return HAIR_OK;
}

// Place a collider for a step. The place depends on earlier steps only, and not on views that wrote
// the field since.
static struct hair_placed_collider place_for_step(struct hair_collider_field* field,
                                                  const hair_collider* collider, uint32_t i,
                                                  const struct hair_pose* head)
{
    struct hair_placed_collider now = hair_field_place(&field->box, collider, i, head);
    if (i < field->stepped_count && !hair_field_has_moved(&field->box, &field->stepped[i], &now))
        hair_field_keep_pose(&field->box, &field->stepped[i], &now);
    field->stepped[i] = now;
    return now;
}

// Place all colliders at their current transforms. Mark the bricks that they leave and enter, if
// the field exists.
static hair_result place_all(struct hair_collider_field* field, const hair_collider* colliders,
                             uint32_t count, const struct hair_pose* head, bool is_step)
{
    hair_result result = HAIR_OK;
    uint32_t max = count > field->count ? count : field->count, near = 0;
    HAIR_ASSERT(max <= field->room);
    memset(field->placed + field->count, 0, (max - field->count) * sizeof *field->placed);
    for (uint32_t i = 0; i < max && !result; ++i) {
        struct hair_placed_collider* placed = &field->placed[i];
        int was = i < field->count, is = i < count;
        struct hair_placed_collider now = {0};
        if (is)
            now = is_step ? place_for_step(field, &colliders[i], i, head)
                          : hair_field_place(&field->box, &colliders[i], i, head);
        if (!was || !is ||
            (is_step ? hair_field_differs(placed, &now) : hair_field_has_moved(&field->box, placed, &now))) {
            if (was && field->dirty) hair_field_mark_dirty(field, placed);
            if (is && field->dirty) hair_field_mark_dirty(field, &now);
            result = replace(field, placed, &now);
        }
        near += is && hair_field_is_inside(placed);
    }
    field->count = result ? max : count;
    field->near = near;
    if (is_step) field->stepped_count = count;
    return result;
}

// Writing -----------------------------------------------------------------------------------------

static void write_params(struct hair_collider_field* field, hair_quat rotation)
{
    const struct hair_field_box* box = &field->box;
    float brick = HAIR_BRICK * box->voxel;
    struct hair_field_params params = {.rotation = {rotation.x, rotation.y, rotation.z, rotation.w},
                                       .lower = {box->lower.x, box->lower.y, box->lower.z, box->voxel},
                                       .inverse = {1 / (brick * (float)box->bricks[0]),
                                                   1 / (brick * (float)box->bricks[1]),
                                                   1 / (brick * (float)box->bricks[2]), box->far}};
    field->rotation = rotation;
    hair_gl_write_uniform(field->gl, field->params, sizeof params, &params);
}

static size_t aligned(size_t size)
{
    return (size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
}

// Number of parts of the work buffer, which are colliders, members, bricks, and bricks with
// collision meshes.
#define PARTS 4
// Maximum colliders of the bricks in a dispatch of a GPU and of a software rasteriser, unless a
// brick has more.
#define MAX_COLLIDERS (1u << 14)
#define MAX_COLLIDERS_SOFTWARE 8192

// Return the end of the bricks from `first` on that are of one round and have few enough colliders
// together.
static uint32_t find_end(const struct hair_field_brick* brick, uint32_t first, uint32_t bricks, uint32_t max)
{
    uint32_t end = first, colliders = 0;
    do colliders += brick[end++].count;
    while (end < bricks && brick[end].round == brick[first].round && colliders + brick[end].count <= max);
    return end;
}

static void run_pass(struct hair_collider_field* field, hair_gl_pass pass,
                     const struct hair_field_brick* brick, uint32_t bricks, int part, const GLintptr* at,
                     const GLsizeiptr* length)
{
    HAIR_ASSERT(2 <= part && part < PARTS);
    const GLuint buffers[] = {field->work, field->work};
    const GLintptr begin[] = {at[part], at[1]};
    const GLsizeiptr size[] = {length[part], length[1]};
    if (!bricks) return;
    hair_gl_bind_ranges(field->gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_BRICK, 2, buffers, begin, size);
    uint32_t max = field->gl->software ? MAX_COLLIDERS_SOFTWARE : MAX_COLLIDERS;
    for (uint32_t first = 0, end; first < bricks; first = end) {
        end = find_end(brick, first, bricks, max);
        if (brick[first].round) hair_gl_barrier(field->gl, GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
        hair_gl_run_part(field->gl, pass, first, end, bricks);
    }
}

static hair_result dispatch_job(struct hair_collider_field* field, const struct hair_field_job* job)
{
    struct hair_gl* gl = field->gl;
    HAIR_ASSERT(job->with_meshes <= job->bricks && field->work);
    uint32_t plain = job->bricks - job->with_meshes;
    const size_t sizes[PARTS] = {job->colliders * sizeof *job->collider,
                                 job->brick_colliders * sizeof *job->brick_collider,
                                 plain * sizeof *job->brick, job->with_meshes * sizeof *job->brick};
    const void* parts[PARTS] = {job->collider, job->brick_collider, job->brick, job->brick + plain};
    GLintptr at[PARTS];
    GLsizeiptr length[PARTS];
    size_t all = 0;
    for (int i = 0; i < PARTS; ++i) {
        at[i] = (GLintptr)all;
        length[i] = (GLsizeiptr)(sizes[i] ? sizes[i] : 16);
        all += aligned((size_t)length[i]);
        HAIR_ASSERT(at[i] % ALIGNMENT == 0 && all % ALIGNMENT == 0);
    }
    if (sizes[0] / 16 > (size_t)gl->max_buffer_texels)
        return hair_fail(&gl->host, HAIR_ERROR_OPENGL,
                         "the field's %u colliders at once take more than the driver's %d texels",
                         job->colliders, gl->max_buffer_texels);
    unsigned char* bytes = hair_alloc(&gl->host, all, 1);
    if (!bytes) return hair_fail_memory(&gl->host, "what is to be written of the field");
    for (int i = 0; i < PARTS; ++i)
        if (sizes[i]) memcpy(bytes + at[i], parts[i], sizes[i]);
    hair_result result = hair_gl_resize(gl, "hair field work", all, bytes, field->work);
    hair_free(&gl->host, bytes);
    HAIR_TRY(result);
    hair_gl_pass without = hair_field_pass(field, HAIR_GL_VOXELISE),
                 with = hair_field_pass(field, HAIR_GL_VOXELISE_MESHES);
    if (plain) HAIR_TRY(hair_gl_ensure_program(gl, without));
    if (job->with_meshes) HAIR_TRY(hair_gl_ensure_program(gl, with));
    hair_gl_bind_texture(gl, HAIR_UNIT_WORK, field->work_texture);
    run_pass(field, without, job->brick, plain, 2, at, length);
    if (job->with_meshes)
        hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_NODE, 1, &field->sdf_pool->nodes);
    run_pass(field, with, job->brick + plain, job->with_meshes, 3, at, length);
    return HAIR_OK;
}

static hair_result write_marked(struct hair_collider_field* field)
{
    struct hair_gl* gl = field->gl;
    struct hair_field_job job;
    hair_result result;
    int ran = 0;
    hair_field_begin(field, &job);
    while ((result = hair_field_next(field, &job)) == HAIR_OK && job.bricks) {
        if (!ran) {
            hair_gl_bind_buffers(gl, GL_UNIFORM_BUFFER, HAIR_BIND_FIELD, 1, &field->params);
            hair_gl_bind_image(gl, HAIR_IMAGE_FIELD, field->distance, true, GL_READ_WRITE, GL_R16F);
            if (field->number)
                hair_gl_bind_image(gl, HAIR_IMAGE_COLLIDER, field->number, true, GL_READ_WRITE, GL_R32UI);
        }
        ran = 1;
        result = dispatch_job(field, &job);
        if (result) break;
    }
    hair_field_end(field, &job);
    field->writes += ran != 0;
    // Order these writes before later writes to the field, and before readbacks by the application.
    if (ran) hair_gl_barrier(gl, GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    // Passes that are recorded later would bind these images again.
    for (GLuint unit = HAIR_IMAGE_FIELD; ran && unit <= HAIR_IMAGE_COLLIDER; ++unit)
        hair_gl_bind_image(gl, unit, 0, false, GL_READ_ONLY, GL_R8);
    return result;
}

static int is_same(hair_quat a, hair_quat b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w;
}

// Update the field, which has colliders. A failure leaves it half written.
static hair_result update(struct hair_collider_field* field, const hair_collider* colliders, uint32_t count,
                          const struct hair_pose* head, bool is_step)
{
    const hair_host* host = &field->gl->host;
    HAIR_TRY(reserve_colliders(host, &field->placed, &field->room, count));
    if (is_step) HAIR_TRY(reserve_colliders(host, &field->stepped, &field->stepped_room, count));
    HAIR_TRY(place_all(field, colliders, count, head, is_step));
    if (field->near && !field->distance) {
        HAIR_TRY(make_field(field));
        write_params(field, head->rotation);
    }
    if (!field->distance) return HAIR_OK;
    if (field->wants_numbers && !field->number) HAIR_TRY(make_numbers(field));
    if (!is_same(field->rotation, head->rotation)) write_params(field, head->rotation);
    return write_marked(field);
}

static hair_result update_or_clear(struct hair_collider_field* field, const hair_collider* colliders,
                                   uint32_t count, const struct hair_pose* head, bool is_step)
{
    if (!count) {
        if (field->placed) clear(field);
        if (is_step) field->stepped_count = 0;
        return HAIR_OK;
    }
    hair_result result = update(field, colliders, count, head, is_step);
    if (result) clear(field);
    return result;
}

hair_result hair_field_update(struct hair_collider_field* field, const hair_collider* colliders,
                              uint32_t count, const struct hair_pose* head)
{
    return update_or_clear(field, colliders, count, head, false);
}

hair_result hair_field_update_for_step(struct hair_collider_field* field, const hair_collider* colliders,
                                       uint32_t count, const struct hair_pose* head)
{
    return update_or_clear(field, colliders, count, head, true);
}

struct hair_field_collider hair_field_shown(const struct hair_collider_field* field,
                                            const hair_collider* collider, uint32_t i,
                                            const struct hair_pose* head, hair_vec3* lower, hair_vec3* upper)
{
    struct hair_placed_collider placed = hair_field_place(&field->box, collider, i, head);
    const struct hair_placed_collider* known = i < field->count ? &field->placed[i] : NULL;
    hair_field_shown_extent(&placed, lower, upper);
    if (known && placed.mesh && known->mesh == placed.mesh)
        placed.collider.first = field->sdf_pool->pooled[known->place].first;
    else if (collider->shape == HAIR_SHAPE_MESH)
        *lower = *upper = hair_v3(0, 0, 0); // The mesh has no distance grid to read.
    return placed.collider;
}

int hair_field_is_near(const struct hair_collider_field* field)
{
    return field->distance && field->near;
}

void hair_field_bind(const struct hair_collider_field* field)
{
    HAIR_ASSERT(hair_field_is_near(field));
    struct hair_gl* gl = field->gl;
    hair_gl_bind_buffers(gl, GL_UNIFORM_BUFFER, HAIR_BIND_FIELD, 1, &field->params);
    hair_gl_bind_texture(gl, HAIR_UNIT_FIELD, field->distance);
    hair_gl_bind_sampler(gl, HAIR_UNIT_FIELD, 0);
    if (!field->number) return;
    hair_gl_bind_texture(gl, HAIR_UNIT_COLLIDER, field->number);
    hair_gl_bind_sampler(gl, HAIR_UNIT_COLLIDER, 0);
}
