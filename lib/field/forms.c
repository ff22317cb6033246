// forms.c - distance grids of collision meshes, pooled in one buffer. Unused grids are dropped when
// the buffer grows, and the buffer is freed with the last one.
#include "lib/field/forms.h"

#include <string.h>

#define LEAST_ROOM 65536 // Minimum capacity, in nodes.

static size_t count_nodes(const hair_collision_mesh* form)
{
    return (size_t)form->size[0] * form->size[1] * form->size[2];
}

static void upload(struct hair_forms* forms, GLuint buffer, struct hair_pooled_form* pooled)
{
    size_t count = count_nodes(pooled->form);
    HAIR_ASSERT(forms->used + count <= forms->room);
    pooled->first = (uint32_t)forms->used;
    forms->gl->NamedBufferSubData(buffer, (GLintptr)(forms->used * sizeof(float)),
                                  (GLsizeiptr)(count * sizeof(float)), pooled->form->distance);
    forms->used += count;
}

// Make a buffer that holds all used grids and `more` nodes.
static hair_result make_room(struct hair_forms* forms, size_t more)
{
    if (forms->nodes && forms->used + more <= forms->room) return HAIR_OK;
    GLuint buffer = 0;
    size_t used = 0;
    for (uint32_t i = 0; i < forms->count; ++i)
        if (forms->pooled[i].form) used += count_nodes(forms->pooled[i].form);
    size_t room = used + more + (used + more) / 2;
    if (room < LEAST_ROOM) room = LEAST_ROOM;
    hair_result result =
        hair_gl_storage(forms->gl, "hair collision meshes", room * sizeof(float), NULL, &buffer);
    if (result) return result;
    hair_gl_free_buffer_texture(forms->gl, &forms->texture);
    hair_gl_free_buffer(forms->gl, &forms->nodes);
    forms->nodes = buffer;
    forms->room = room;
    forms->used = 0;
    for (uint32_t i = 0; i < forms->count; ++i)
        if (forms->pooled[i].form) upload(forms, buffer, &forms->pooled[i]);
    return HAIR_OK;
}

// Find a free place, or append one.
static hair_result find_place(struct hair_forms* forms, uint32_t* place)
{
    HAIR_ASSERT(forms->count <= forms->capacity);
    for (*place = 0; *place < forms->count; ++*place)
        if (!forms->pooled[*place].form) return HAIR_OK;
    if (forms->count == forms->capacity) {
        const hair_host* host = &forms->gl->host;
        uint32_t capacity = 2 * forms->capacity + 8;
        struct hair_pooled_form* pooled = hair_alloc(host, capacity, sizeof *pooled);
        if (!pooled) return hair_fail_memory(host, "the collision meshes of colliders");
        if (forms->count) memcpy(pooled, forms->pooled, forms->count * sizeof *pooled);
        hair_free(host, forms->pooled);
        forms->pooled = pooled;
        forms->capacity = capacity;
    }
    ++forms->count;
    return HAIR_OK;
}

static void free_if_empty(struct hair_forms* forms)
{
    for (uint32_t i = 0; i < forms->count; ++i)
        if (forms->pooled[i].form) return;
    hair_gl_free_buffer_texture(forms->gl, &forms->texture);
    hair_gl_free_buffer(forms->gl, &forms->nodes);
    hair_free(&forms->gl->host, forms->pooled);
    *forms = (struct hair_forms){.gl = forms->gl};
}

hair_result hair_forms_take(struct hair_forms* forms, const hair_collision_mesh* form, uint32_t* place)
{
    HAIR_ASSERT(form && form->distance);
    for (uint32_t i = 0; i < forms->count; ++i)
        if (forms->pooled[i].form == form) {
            ++forms->pooled[i].users;
            *place = i;
            return HAIR_OK;
        }
    hair_result result = make_room(forms, count_nodes(form));
    if (!result) result = find_place(forms, place);
    if (result) {
        free_if_empty(forms);
        return result;
    }
    hair_collision_mesh_hold(form);
    forms->pooled[*place] = (struct hair_pooled_form){.form = form, .users = 1};
    upload(forms, forms->nodes, &forms->pooled[*place]);
    return HAIR_OK;
}

void hair_forms_drop(struct hair_forms* forms, uint32_t place)
{
    HAIR_ASSERT(place < forms->count);
    struct hair_pooled_form* pooled = &forms->pooled[place];
    HAIR_ASSERT(pooled->form && pooled->users > 0);
    if (--pooled->users) return;
    hair_collision_mesh_release(pooled->form);
    pooled->form = NULL;
    free_if_empty(forms);
}

hair_result hair_forms_need_texture(struct hair_forms* forms)
{
    if (forms->texture || !forms->nodes) return HAIR_OK;
    return hair_gl_buffer_texture(forms->gl, "hair collision meshes", GL_R32F, forms->nodes, &forms->texture);
}
