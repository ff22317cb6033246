// pins.c - pins: checking, sorting, and upload for the solvers.
#include "lib/sim/sim.h"
#include "lib/base/schema.h"

#include <stdlib.h>
#include <string.h>

static hair_pin pin_at(const hair_pin* from, uint32_t i, size_t stride)
{
    hair_pin pin;
    memcpy(&pin, (const unsigned char*)from + i * stride, sizeof pin);
    return pin;
}

static hair_result check_pin(const struct hair_sim* sim, const hair_pin* pin, uint32_t i)
{
    const hair_host* host = &sim->gl->host;
    if (pin->guide >= sim->guides)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "pins[%u].guide is %u, not in [0, %u]", i, pin->guide,
                         sim->guides - 1);
    return hair_schema_check_element(host, "pins", i, pin, hair_schema_of_hair_pin());
}

static hair_result check_all(const struct hair_sim* sim, const hair_pin* from, uint32_t count, size_t stride)
{
    const hair_host* host = &sim->gl->host;
    if (count > HAIR_MAX_PINS)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "pin count is %u, not in [0, %u]", count, HAIR_MAX_PINS);
    if (count && !from)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "pins is NULL but their count is %u", count);
    if (count && (stride < sizeof(hair_pin) || stride > 4096))
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "pin stride is %zu, not in [%zu, 4096]", stride,
                         sizeof(hair_pin));
    if (count && !sim->rods)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "the solver redblack has no pins, but their count is %u",
                         count);
    for (uint32_t i = 0; i < count; ++i) {
        hair_pin pin = pin_at(from, i, stride);
        HAIR_TRY(check_pin(sim, &pin, i));
    }
    return HAIR_OK;
}

static int compare_pins(const void* a, const void* b)
{
    const struct hair_resolved_pin *p = a, *q = b;
    if (p->guide != q->guide) return p->guide < q->guide ? -1 : 1;
    return (p->vertex > q->vertex) - (p->vertex < q->vertex);
}

static uint32_t hash_of_pins(const struct hair_resolved_pin* resolved_pin, uint32_t count)
{
    uint32_t vertex_hash = 0;
    for (uint32_t i = 0; i < count; ++i)
        vertex_hash = hair_hash(hair_hash(vertex_hash + resolved_pin[i].guide) + resolved_pin[i].vertex);
    return count ? vertex_hash | 1 : 0;
}

static uint32_t max_per_guide(const struct hair_resolved_pin* resolved_pin, uint32_t count)
{
    uint32_t max = 0, in_row = 0;
    for (uint32_t i = 0; i < count; ++i) {
        in_row = i > 0 && resolved_pin[i - 1].guide == resolved_pin[i].guide ? in_row + 1 : 1;
        if (in_row > max) max = in_row;
    }
    return max;
}

static bool are_same_pins(const struct hair_pins* pins, const struct hair_resolved_pin* resolved_pin,
                          uint32_t count)
{
    int alike = pins->count == count;
    for (uint32_t i = 0; i < count && alike; ++i) {
        const struct hair_resolved_pin* other = &pins->resolved_pin[i];
        alike = compare_pins(other, &resolved_pin[i]) == 0 && other->world == resolved_pin[i].world &&
                memcmp(other->place, resolved_pin[i].place, sizeof other->place) == 0;
    }
    return alike;
}

const struct hair_resolved_pin* hair_pins_get(const struct hair_sim* sim, uint32_t* count)
{
    *count = sim->pins.count;
    return sim->pins.resolved_pin;
}

void hair_pins_adopt(struct hair_sim* sim, struct hair_resolved_pin* resolved_pin, uint32_t count)
{
    HAIR_ASSERT(count <= HAIR_MAX_PINS && (resolved_pin || !count));
    for (uint32_t i = 1; i < count; ++i)
        HAIR_ASSERT(compare_pins(&resolved_pin[i - 1], &resolved_pin[i]) < 0);
    hair_free(&sim->gl->host, sim->pins.resolved_pin);
    sim->pins.resolved_pin = resolved_pin;
    sim->pins.count = count;
    sim->pins.max_per_guide = max_per_guide(resolved_pin, count);
    sim->pins.vertex_hash = hash_of_pins(resolved_pin, count);
}

void hair_pins_drop_lost(struct hair_sim* sim)
{
    struct hair_pins* pins = &sim->pins;
    const struct hair_rest* rest;
    const struct hair_guide* guides = hair_sim_guides(sim, &rest);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < pins->count; ++i) {
        const struct hair_guide* guide = &guides[pins->resolved_pin[i].guide];
        uint32_t tip = guide->count - 1, vertex = pins->resolved_pin[i].vertex;
        if (vertex < tip || (vertex == tip && rest[guide->first + tip].position.w == 0))
            pins->resolved_pin[kept++] = pins->resolved_pin[i];
    }
    pins->count = kept;
    pins->max_per_guide = max_per_guide(pins->resolved_pin, kept);
    pins->vertex_hash = hash_of_pins(pins->resolved_pin, kept);
}

hair_result hair_pins_set(struct hair_sim* sim, const hair_pin* from, uint32_t count, size_t stride)
{
    const hair_host* host = &sim->gl->host;
    HAIR_TRY(check_all(sim, from, count, stride));
    const struct hair_guide* guides = hair_sim_guides(sim, NULL);
    struct hair_resolved_pin* resolved_pin = hair_alloc(host, count, sizeof *resolved_pin);
    if (!resolved_pin) return hair_fail_memory(host, "pins");
    for (uint32_t i = 0; i < count; ++i) {
        hair_pin pin = pin_at(from, i, stride);
        uint32_t tip = guides[pin.guide].count - 1;
        HAIR_ASSERT(tip >= 1);
        resolved_pin[i] =
            (struct hair_resolved_pin){.guide = pin.guide, .vertex = pin.vertex < tip ? pin.vertex : tip};
        resolved_pin[i].world = pin.to == HAIR_PIN_WORLD;
        resolved_pin[i].given = i;
        for (int k = 0; k < 3; ++k) resolved_pin[i].place[k] = (double)pin.position[k];
    }
    if (count) qsort(resolved_pin, count, sizeof *resolved_pin, compare_pins);
    hair_result result = HAIR_OK;
    for (uint32_t i = 1; i < count && !result; ++i)
        if (compare_pins(&resolved_pin[i - 1], &resolved_pin[i]) == 0)
            result =
                hair_fail(host, HAIR_ERROR_ARGUMENT, "pins[%u] and pins[%u] both hold vertex %u of guide %u",
                          resolved_pin[i - 1].given, resolved_pin[i].given, resolved_pin[i].vertex,
                          resolved_pin[i].guide);
    if (result) {
        hair_free(host, resolved_pin);
    } else {
        if (!are_same_pins(&sim->pins, resolved_pin, count)) hair_sleep_wake(sim);
        hair_pins_adopt(sim, resolved_pin, count);
    }
    return result;
}

hair_result hair_pins_check(const struct hair_sim* sim, const struct hair_resolved_pin* resolved_pin,
                            uint32_t count)
{
    // The pins of vertices that guides have lost are removed after their lengths are loaded.
    const struct hair_guide* guides = sim->rods ? sim->rods->groom->guides : NULL;
    for (uint32_t i = 0; i < count; ++i) {
        const struct hair_resolved_pin* k = &resolved_pin[i];
        if (!guides || k->guide >= sim->guides || k->vertex == 0 || k->vertex >= guides[k->guide].count)
            return hair_fail(&sim->gl->host, HAIR_ERROR_FILE,
                             "pin %u of the saved state holds vertex %u of guide %u, which there is not", i,
                             k->vertex, k->guide);
        if (i > 0 && compare_pins(k - 1, k) >= 0)
            return hair_fail(&sim->gl->host, HAIR_ERROR_FILE,
                             "pin %u of the saved state does not come after the one before", i);
    }
    return HAIR_OK;
}

void hair_pins_free(struct hair_sim* sim)
{
    hair_pins_adopt(sim, NULL, 0);
    hair_gl_free_array(sim->gl, &sim->pins.buffer, &sim->pins.texture);
}

static struct hair_held held_by(const struct hair_sim* sim, uint32_t i)
{
    const struct hair_rest* rest;
    const struct hair_guide* guides = hair_sim_guides(sim, &rest);
    const struct hair_pins* pins = &sim->pins;
    const struct hair_resolved_pin* resolved_pin = &pins->resolved_pin[i];
    uint32_t first = guides[resolved_pin->guide].first;
    int second = i > 0 && resolved_pin[-1].guide == resolved_pin->guide;
    int more = i + 1 < pins->count && resolved_pin[1].guide == resolved_pin->guide;
    uint32_t from = second ? resolved_pin[-1].vertex : 0;
    HAIR_ASSERT(from < resolved_pin->vertex && resolved_pin->vertex < guides[resolved_pin->guide].count);
    double at[3], length = 0;
    if (second || sim->physics.root != HAIR_ROOT_FREE)
        for (uint32_t k = from; k < resolved_pin->vertex; ++k) length += (double)rest[first + k].position.w;
    for (int k = 0; k < 3; ++k)
        at[k] = resolved_pin->place[k] - (resolved_pin->world ? sim->head.position[k] : 0);
    return (struct hair_held){
        .place = {(float)at[0], (float)at[1], (float)at[2], resolved_pin->world ? -1.0f : 0.0f},
        .span = {(float)from, (float)resolved_pin->vertex, (float)length, (float)more},
    };
}

hair_result hair_pins_write(struct hair_sim* sim)
{
    struct hair_gl* gl = sim->gl;
    struct hair_pins* pins = &sim->pins;
    if (!pins->count) return HAIR_OK;
    struct hair_held* held = hair_alloc(&gl->host, pins->count, sizeof *held);
    if (!held) return hair_fail_memory(&gl->host, "pins");
    for (uint32_t i = 0; i < pins->count; ++i) held[i] = held_by(sim, i);
    size_t size = pins->count * sizeof *held;
    hair_result result = HAIR_OK;
    if (!pins->buffer) result = hair_gl_uniform(gl, HAIR_GL_CATEGORY_SOLVE, "hair pins", size, &pins->buffer);
    if (!result) result = hair_gl_resize(gl, "hair pins", size, held, pins->buffer);
    if (!result && !pins->texture)
        result = hair_gl_buffer_texture(gl, "hair pins", GL_RGBA32F, pins->buffer, &pins->texture);
    hair_free(&gl->host, held);
    return result;
}

void hair_pins_bind(struct hair_sim* sim)
{
    hair_gl_bind_texture(sim->gl, HAIR_UNIT_PIN, sim->pins.texture);
}

void hair_pins_teleport(struct hair_sim* sim, const struct hair_pose* from, const struct hair_pose* to)
{
    hair_quat turn = hair_quat_multiply(to->rotation, hair_quat_conjugate(from->rotation));
    for (uint32_t i = 0; i < sim->pins.count; ++i) {
        struct hair_resolved_pin* resolved_pin = &sim->pins.resolved_pin[i];
        struct hair_pose at = {
            .position = {resolved_pin->place[0], resolved_pin->place[1], resolved_pin->place[2]}};
        hair_vec3 arm = hair_rotate(turn, hair_pose_offset(&at, from));
        if (!resolved_pin->world) continue;
        resolved_pin->place[0] = to->position[0] + (double)arm.x;
        resolved_pin->place[1] = to->position[1] + (double)arm.y;
        resolved_pin->place[2] = to->position[2] + (double)arm.z;
    }
}
