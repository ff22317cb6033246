// flow.c - The fluid around a ball, and its measures.
#include "tools/bench/flow.h"

#include "tests/reference/fluid.h"

#include <math.h>
#include <stdlib.h>

static const struct hair_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};

// Make one strand in each direction of each axis, so that the field's box is a cube.
static hair_result make_groom(struct bench* bench, hair_groom** out)
{
    enum { VERTICES = 4 };
    float positions[6 * VERTICES * 3] = {0};
    uint32_t vertices[6];
    for (int i = 0; i < 6; ++i) {
        vertices[i] = VERTICES;
        for (int k = 0; k < VERTICES; ++k)
            positions[3 * (VERTICES * i + k) + i / 2] = (i % 2 ? 0.0375f : -0.0375f) * (float)(k + 1);
    }
    hair_groom_desc desc = hair_groom_desc_default();
    desc.host = &bench->host;
    desc.positions = positions;
    desc.strand_vertices = vertices;
    desc.strand_count = 6;
    desc.strand_set = HAIR_STRAND_SET_GUIDES;
    desc.guide_vertices = VERTICES;
    desc.follower_count = 0;
    return hair_groom_create(&desc, out);
}

bool bench_flow_live(struct bench* bench, const struct hair_fluid_desc* desc, bool ball,
                     struct bench_flow* out)
{
    struct hair_gl* gl = &bench->context->gl;
    hair_collider collider = hair_collider_default();
    collider.size[0] = FLOW_BALL;
    *out = (struct bench_flow){.bench = bench};
    hair_result result = make_groom(bench, &out->groom);
    if (result) return false;
    hair_gl_enter(gl);
    hair_field_create(&out->field, &bench->context->sdf_pool, out->groom, 0.005f);
    hair_field_want_numbers(&out->field);
    result = hair_colliders_set(&bench->context->host, &out->colliders, &collider, ball, sizeof collider);
    if (!result) result = hair_field_update(&out->field, out->colliders.current.collider, ball, &origin);
    if (!result) result = hair_fluid_create(&out->fluid, gl, desc);
    if (!result) result = hair_fluid_make_room(&out->fluid, 1);
    if (result) {
        bench_flow_die(out);
        return false;
    }
    out->now = (struct hair_fluid_now){.head = origin,
                                       .wind = {(float)FLOW_WIND, 0, 0},
                                       .dt = 1.0 / 60,
                                       .field = &out->field,
                                       .colliders = &out->colliders};
    out->faces = 3 * hair_fluid_slots(&out->fluid);
    out->cells = (size_t)desc->cells * desc->cells * desc->cells;
    return true;
}

void bench_flow_die(struct bench_flow* flow)
{
    hair_fluid_destroy(&flow->fluid);
    hair_field_destroy(&flow->field);
    hair_colliders_free(&flow->bench->context->host, &flow->colliders);
    hair_gl_leave(&flow->bench->context->gl);
    hair_groom_destroy(flow->groom);
}

bool bench_flow_step(struct bench_flow* flow)
{
    hair_fluid_step(&flow->fluid, &flow->now);
    return !bench_was_interrupted();
}

// Reading -----------------------------------------------------------------------------------------

static double* read_floats(GLuint buffer, size_t count)
{
    float* numbers = malloc(count * sizeof *numbers);
    double* out = malloc(count * sizeof *out);
    if (!numbers || !out) abort();
    glGetNamedBufferSubData(buffer, 0, (GLsizeiptr)(count * sizeof *numbers), numbers);
    for (size_t i = 0; i < count; ++i) out[i] = (double)numbers[i];
    free(numbers);
    return out;
}

static double* read_open(const struct bench_flow* flow)
{
    size_t count = flow->faces / 3;
    uint32_t* slots = malloc(count * sizeof *slots);
    double* out = malloc(3 * count * sizeof *out);
    if (!slots || !out) abort();
    glGetNamedBufferSubData(flow->fluid.face_fraction.buffer, 0, (GLsizeiptr)(count * sizeof *slots), slots);
    for (size_t i = 0; i < 3 * count; ++i) out[i] = (slots[i % count] >> 10 * (i / count) & 1023) / 1023.0;
    free(slots);
    return out;
}

static double rms(const double* numbers, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; ++i) sum += numbers[i] * numbers[i];
    return sqrt(sum / (double)count);
}

double bench_flow_residual(const struct bench_flow* flow)
{
    const struct hair_fluid* fluid = &flow->fluid;
    double* right = read_floats(fluid->rhs.buffer, flow->cells);
    double* pressure = read_floats(fluid->pressure[fluid->current_pressure].buffer, flow->cells);
    double *open = read_open(flow), *left = malloc(flow->cells * sizeof *left);
    if (!left) abort();
    hair_reference_residual(fluid->desc.cells, open, right, pressure, left);
    double fraction = rms(left, flow->cells) / rms(right, flow->cells);
    free(right), free(pressure), free(open), free(left);
    return fraction;
}

double* bench_flow_velocity(const struct bench_flow* flow)
{
    return read_floats(flow->fluid.velocity[flow->fluid.now].buffer, flow->faces);
}

// Measuring ---------------------------------------------------------------------------------------

double bench_flow_at(const struct bench_flow* flow, const double* velocity, int axis, const double place[3])
{
    size_t cells = flow->fluid.desc.cells, side = cells + 1, stride[3] = {1, side, side * side};
    size_t base = (size_t)axis * side * side * side;
    double part[3], sum = 0;
    for (int k = 0; k < 3; ++k) {
        double max = k == axis ? (double)cells : (double)cells - 1;
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

double bench_flow_flux(const struct bench_flow* flow, const double* velocity)
{
    enum { POINTS = 20000 };
    double n = flow->fluid.desc.cells, radius = 1 + (double)FLOW_BALL * n / (double)FLOW_SIDE, sum = 0,
           in = 0;
    for (int i = 0; i < POINTS; ++i) { // evenly spaced along a spiral
        double z = 1 - (2 * i + 1.0) / POINTS, side = sqrt(1 - z * z), out = 0;
        double normal[3] = {side * cos(2.399963 * i), side * sin(2.399963 * i), z}, place[3];
        for (int k = 0; k < 3; ++k) place[k] = n / 2 + radius * normal[k];
        for (int k = 0; k < 3; ++k) out += normal[k] * bench_flow_at(flow, velocity, k, place);
        sum += out;
        if (out < 0) in -= out;
    }
    return sum / in;
}

double bench_flow_asymmetry(const struct bench_flow* flow, const double* velocity, int axis)
{
    size_t n = flow->fluid.desc.cells;
    double sum = 0;
    for (size_t i = 0; i < flow->cells; ++i) {
        double place[3] = {(double)(i % n) + 0.5, (double)(i / n % n) + 0.5, (double)(i / n / n) + 0.5};
        double other[3] = {place[0], place[1], place[2]};
        other[axis] = (double)n - place[axis];
        for (int k = 0; k < 3; ++k) {
            double off = bench_flow_at(flow, velocity, k, place) -
                         (k == axis ? -1 : 1) * bench_flow_at(flow, velocity, k, other);
            sum += off * off / (double)flow->cells;
        }
    }
    return sqrt(sum);
}

double bench_flow_beside(const struct bench_flow* flow, const double* velocity, double along, double beside)
{
    double n = flow->fluid.desc.cells, radius = (double)FLOW_BALL * n / (double)FLOW_SIDE;
    double place[3] = {n / 2 + along * radius, n / 2 + beside * radius, n / 2};
    return bench_flow_at(flow, velocity, 0, place);
}

double bench_flow_energy(const double* velocity, size_t faces)
{
    double r = rms(velocity, faces);
    return r * r * (double)faces / 2;
}
