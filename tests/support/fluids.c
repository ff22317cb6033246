// fluids.c - a fluid around a ball, and the contents of its buffers.
#include "tests/support/fluids.h"

#include <math.h>
#include <stdlib.h>

#include "tests/reference/fluid.h"

// Make strands along every axis, so that the field is a cube.
static hair_groom* make_groom(struct hair_test* test)
{
    float positions[6 * 4 * 3] = {0};
    uint32_t vertices[6];
    hair_groom* groom = NULL;
    hair_groom_desc desc = hair_groom_desc_default();
    for (int i = 0; i < 6; ++i) {
        vertices[i] = 4;
        for (int k = 0; k < 4; ++k)
            positions[3 * (4 * i + k) + i / 2] = (i % 2 ? 0.0375f : -0.0375f) * (float)(k + 1);
    }
    desc.host = &test->host.host;
    desc.positions = positions;
    desc.strand_vertices = vertices;
    desc.strand_count = 6;
    desc.strand_set = HAIR_STRAND_SET_GUIDES;
    desc.guide_vertices = 4;
    desc.follower_count = 0;
    hair_test_ok(test, hair_groom_create(&desc, &groom));
    return groom;
}

struct hair_fluid_desc hair_test_fluid_desc(uint32_t cells)
{
    return (struct hair_fluid_desc){.cells = cells, .side = HAIR_TEST_FLUID_SIDE, .cycles = 4};
}

void hair_test_fluid_begin(struct hair_test* test, const struct hair_fluid_desc* desc, int ball,
                           struct hair_test_fluid* out)
{
    static const struct hair_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
    hair_collider collider = hair_collider_default();
    collider.size[0] = HAIR_TEST_FLUID_BALL;
    *out = (struct hair_test_fluid){.test = test, .cells = desc->cells};
    out->groom = make_groom(test);
    hair_gl_enter(&test->context->gl);
    hair_field_create(&out->field, &test->context->sdf_pool, out->groom, 0.005f);
    hair_field_want_numbers(&out->field);
    hair_test_ok(test, hair_colliders_set(&test->host.host, &out->colliders, &collider, (uint32_t)ball,
                                          sizeof collider));
    hair_test_ok(test, hair_field_update(&out->field, out->colliders.current.collider,
                                         out->colliders.current.count, &origin));
    hair_test_ok(test, hair_fluid_create(&out->fluid, &test->context->gl, desc));
    hair_test_ok(test, hair_fluid_make_room(&out->fluid, 1));
    out->now = (struct hair_fluid_now){.head = origin,
                                       .wind = {5, 0, 0},
                                       .dt = 1.0 / 60,
                                       .field = &out->field,
                                       .colliders = &out->colliders,
                                       .colliders_dt = 1.0 / 60};
    out->faces = 3 * hair_fluid_slots(&out->fluid);
    out->count = (size_t)desc->cells * desc->cells * desc->cells;
}

void hair_test_fluid_end(struct hair_test_fluid* f)
{
    hair_fluid_destroy(&f->fluid);
    hair_field_destroy(&f->field);
    hair_gl_leave(&f->test->context->gl);
    hair_colliders_free(&f->test->host.host, &f->colliders);
    hair_groom_destroy(f->groom);
}

double* hair_test_floats(GLuint buffer, size_t count)
{
    float* numbers = malloc(count * sizeof *numbers);
    double* out = malloc(count * sizeof *out);
    glGetNamedBufferSubData(buffer, 0, (GLsizeiptr)(count * sizeof *numbers), numbers);
    for (size_t i = 0; i < count; ++i) out[i] = (double)numbers[i];
    free(numbers);
    return out;
}

void hair_test_put_floats(GLuint buffer, const double* numbers, size_t count)
{
    float* floats = malloc(count * sizeof *floats);
    for (size_t i = 0; i < count; ++i) floats[i] = (float)numbers[i];
    glFinish(); // One driver loses data written to a buffer that a running dispatch writes.
    glNamedBufferSubData(buffer, 0, (GLsizeiptr)(count * sizeof *floats), floats);
    free(floats);
}

double* hair_test_fluid_velocity(const struct hair_test_fluid* f)
{
    return hair_test_floats(f->fluid.velocity[f->fluid.now].buffer, f->faces);
}

double* hair_test_fluid_open(const struct hair_test_fluid* f, uint32_t level)
{
    uint32_t first = f->fluid.level[level].slot, count = f->fluid.level[level + 1].slot - first;
    uint32_t* slots = malloc(count * sizeof *slots);
    double* out = malloc(3 * (size_t)count * sizeof *out);
    glGetNamedBufferSubData(f->fluid.face_fraction.buffer, 4 * (GLintptr)first, 4 * (GLsizeiptr)count, slots);
    for (uint32_t i = 0; i < 3 * count; ++i) out[i] = (slots[i % count] >> 10 * (i / count) & 1023) / 1023.0;
    free(slots);
    return out;
}

double hair_test_fluid_at(const struct hair_test_fluid* f, const double* velocity, int axis,
                          const double place[3])
{
    size_t side = f->cells + 1, base = (size_t)axis * side * side * side, stride[3] = {1, side, side * side};
    double part[3], sum = 0;
    for (int k = 0; k < 3; ++k) {
        double max = k == axis ? f->cells : f->cells - 1;
        double g = fmin(fmax(place[k] - (k == axis ? 0 : 0.5), 0), max);
        double low = fmin(floor(g), max - 1);
        part[k] = g - low;
        base += (size_t)low * stride[k];
    }
    for (int c = 0; c < 8; ++c) {
        double weight = 1;
        size_t at = base;
        for (int k = 0; k < 3; ++k) {
            weight *= c >> k & 1 ? part[k] : 1 - part[k];
            at += (size_t)(c >> k & 1) * stride[k];
        }
        sum += weight * velocity[at];
    }
    return sum;
}

void hair_test_gust_at(const struct hair_test_fluid* f, const struct hair_wind_gusts* gusts,
                       const float* texel, const double place[3], double out[3])
{
    const float* lower = &f->fluid.lower.x;
    const float* from = &gusts->from.x;
    double cell = (double)HAIR_TEST_FLUID_SIDE / f->cells;
    hair_quat turn = {gusts->turn.x, gusts->turn.y, gusts->turn.z, gusts->turn.w};
    hair_vec3 at = hair_v3(lower[0] + (float)(place[0] * cell), lower[1] + (float)(place[1] * cell),
                           lower[2] + (float)(place[2] * cell));
    hair_vec3 way = hair_rotate(turn, at);
    double g[3] = {(double)way.x, (double)way.y, (double)way.z};
    out[0] = out[1] = out[2] = 0;
    for (int c = 0; c < 8; ++c) {
        double weight = (double)gusts->speed;
        int index = 0, stride = 1;
        for (int k = 0; k < 3; ++k, stride *= HAIR_GUST_NODES) {
            double s = ((double)from[k] + (double)from[3] * g[k]) * HAIR_GUST_NODES - 0.5,
                   part = s - floor(s);
            int n = ((int)floor(s) + (c >> k & 1)) % HAIR_GUST_NODES;
            index += stride * (n < 0 ? n + HAIR_GUST_NODES : n);
            weight *= c >> k & 1 ? part : 1 - part;
        }
        for (int k = 0; k < 3; ++k) out[k] += weight * (double)texel[4 * index + k];
    }
}

double hair_test_rms(const double* numbers, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; ++i) sum += numbers[i] * numbers[i];
    return sqrt(sum / (double)count);
}

double hair_test_fluid_left(struct hair_test_fluid* f)
{
    double* velocity = hair_test_fluid_velocity(f);
    double* open = hair_test_fluid_open(f, 0);
    double* wall = hair_test_floats(f->fluid.wall_velocity.buffer, f->faces);
    double* right = malloc(f->count * sizeof *right);
    hair_reference_inflow(f->cells, open, wall, velocity, right);
    double rms = hair_test_rms(right, f->count);
    free(velocity), free(open), free(wall), free(right);
    return rms;
}
