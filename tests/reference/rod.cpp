// rod.cpp - Creation of rods, and access to their state.
#include "tests/reference/rod_state.h"

#include <cmath>

namespace
{

std::vector<double> array_of(const double* values, size_t count, double otherwise)
{
    return values ? std::vector<double>(values, values + count) : std::vector<double>(count, otherwise);
}

std::vector<Vector3d> vectors_of(const double* values, size_t count)
{
    std::vector<Vector3d> vectors(count, Vector3d(0, 0, 0));
    for (size_t i = 0; values && i < count; ++i) vectors[i] = vector_of(values + 3 * i);
    return vectors;
}

void set_geometry(hair_reference_rod& rod, const hair_reference_rod_desc& desc)
{
    const uint32_t n = rod.segments();
    rod.lengths = array_of(desc.lengths, n, 0);
    rod.root_frame = quaternion_of(desc.root_frame).normalized();
    if (desc.positions) {
        rod.x = vectors_of(desc.positions, rod.vertices);
        for (uint32_t j = 0; j < n && !desc.lengths; ++j) rod.lengths[j] = (rod.x[j + 1] - rod.x[j]).norm();
    } else {
        rod.x.assign(1, Vector3d(0, 0, 0));
        for (uint32_t j = 0; j < n; ++j) rod.x.push_back(rod.x[j] + rod.lengths[j] * along(rod.root_frame));
    }
    rod.arm = rod.x[0];
    rod.target = desc.pull_target ? vectors_of(desc.pull_target, rod.vertices) : rod.x;
}

// Return 2 w of joints with a given strain 2 v.
std::vector<double> real_of(const std::vector<Vector3d>& strain)
{
    std::vector<double> real;
    for (const Vector3d& u : strain) real.push_back(std::sqrt(std::fmax(4 - u.squaredNorm(), 0)));
    return real;
}

void set_masses(hair_reference_rod& rod, const hair_reference_rod_desc& desc)
{
    rod.masses = array_of(desc.masses, rod.vertices, 0);
    for (uint32_t j = 0; j < rod.segments() && !desc.masses; ++j) {
        rod.masses[j] += desc.line_density * rod.lengths[j] / 2;
        rod.masses[j + 1] += desc.line_density * rod.lengths[j] / 2;
    }
    rod.masses.back() += desc.tip_mass;
}

void place(hair_reference_rod& rod, const hair_reference_rod_pose& head)
{
    rod.head = {vector_of(head.position), quaternion_of(head.rotation).normalized()};
    for (Vector3d& x : rod.x) x = rod.head.position + rod.head.rotation * x;
    rod.frames.clear();
    for (uint32_t j = 0; j < rod.segments(); ++j)
        rod.frames.push_back(hair_reference_rod_turned(j ? rod.frames[j - 1] : rod.scalp(),
                                                       direction_of(rod.x[j + 1] - rod.x[j])));
}

bool is_positive(const std::vector<double>& values)
{
    for (double value : values)
        if (!(value > 0 && value < 1e300)) return false;
    return true;
}

bool is_not_negative(const std::vector<double>& values)
{
    for (double value : values)
        if (!(value >= 0 && value < 1e300)) return false;
    return true;
}

bool is_finite(const std::vector<Vector3d>& vectors)
{
    for (const Vector3d& v : vectors)
        if (!std::isfinite(v.squaredNorm())) return false;
    return true;
}

bool is_sound(const hair_reference_rod& rod)
{
    return is_positive(rod.lengths) && is_positive(rod.masses) && is_not_negative(rod.pull) &&
           is_not_negative(rod.scale) && is_not_negative({rod.bend[0], rod.bend[1], rod.twist}) &&
           is_not_negative({rod.damping, rod.drag}) && is_finite(rod.x) && is_finite(rod.target) &&
           is_finite(rod.rest_strain) && is_not_negative(rod.rest_real) &&
           is_finite({rod.gravity, rod.wind}) && std::fabs(rod.scalp().norm() - 1) < 1e-9;
}

} // namespace

hair_reference_rod_desc hair_reference_rod_desc_default(void)
{
    hair_reference_rod_desc desc = {};
    desc.root_frame[3] = 1;
    desc.head.rotation[3] = 1;
    return desc;
}

hair_reference_rod* hair_reference_rod_create(const hair_reference_rod_desc* desc)
{
    if (desc->vertices < 2 || desc->vertices > HAIR_REFERENCE_ROD_MAX_VERTICES) return nullptr;
    if (!desc->positions && !desc->lengths) return nullptr;
    hair_reference_rod* rod = new hair_reference_rod;
    rod->vertices = desc->vertices;
    set_geometry(*rod, *desc);
    set_masses(*rod, *desc);
    rod->pull = array_of(desc->pull, rod->vertices, 0);
    for (double& w : rod->pull) w *= w;
    rod->bend[0] = desc->bend[0];
    rod->bend[1] = desc->bend[1];
    rod->twist = desc->twist;
    rod->scale = array_of(desc->scale, rod->vertices, 1);
    rod->rest_strain = vectors_of(desc->rest_strain, rod->segments());
    rod->rest_real =
        desc->rest_real ? array_of(desc->rest_real, rod->segments(), 0) : real_of(rod->rest_strain);
    rod->straight = desc->straight != 0;
    rod->plain_clamp = desc->plain_clamp != 0;
    rod->root = desc->root;
    rod->gravity = vector_of(desc->gravity);
    rod->wind = vector_of(desc->wind);
    rod->damping = desc->damping;
    rod->line_density = desc->line_density;
    rod->drag = desc->drag;
    rod->diameter = desc->diameter;
    rod->air = desc->air;
    rod->root_velocity = Vector3d(0, 0, 0);
    rod->v.assign(rod->vertices, Vector3d(0, 0, 0));
    place(*rod, desc->head);
    if (!is_sound(*rod)) {
        delete rod;
        return nullptr;
    }
    hair_reference_rod_stiffen(*rod);
    hair_reference_rod_update(*rod);
    return rod;
}

hair_reference_rod* hair_reference_rod_copy(const hair_reference_rod* rod)
{
    return new hair_reference_rod(*rod);
}

void hair_reference_rod_destroy(hair_reference_rod* rod)
{
    delete rod;
}

void hair_reference_rod_set_state(hair_reference_rod* rod, const double* positions, const double* velocities)
{
    if (velocities) rod->v = vectors_of(velocities, rod->vertices);
    if (!positions) return;
    rod->x = vectors_of(positions, rod->vertices);
    hair_reference_rod_update(*rod);
}

void hair_reference_rod_set_gravity(hair_reference_rod* rod, const double gravity[3])
{
    rod->gravity = vector_of(gravity);
    hair_reference_rod_stiffen(*rod);
    hair_reference_rod_update(*rod);
}

void hair_reference_rod_set_damping(hair_reference_rod* rod, double damping)
{
    rod->damping = damping;
}

void hair_reference_rod_set_wind(hair_reference_rod* rod, const double wind[3], double drag)
{
    rod->wind = vector_of(wind);
    rod->drag = drag;
}

uint32_t hair_reference_rod_vertices(const hair_reference_rod* rod)
{
    return rod->vertices;
}

void hair_reference_rod_positions(const hair_reference_rod* rod, double* positions)
{
    for (uint32_t i = 0; i < rod->vertices; ++i) store(rod->x[i], positions + 3 * i);
}

void hair_reference_rod_velocities(const hair_reference_rod* rod, double* velocities)
{
    for (uint32_t i = 0; i < rod->vertices; ++i) store(rod->v[i], velocities + 3 * i);
}

void hair_reference_rod_frames(const hair_reference_rod* rod, double* frames)
{
    for (uint32_t j = 0; j < rod->segments(); ++j) store(rod->frames[j], frames + 4 * j);
}

void hair_reference_rod_masses(const hair_reference_rod* rod, double* masses)
{
    for (uint32_t i = 0; i < rod->vertices; ++i) masses[i] = rod->masses[i];
}

double hair_reference_rod_stretch(const hair_reference_rod* rod)
{
    double max_value = 0;
    for (uint32_t j = 0; j < rod->segments(); ++j)
        max_value = std::fmax(max_value, std::fabs((rod->x[j + 1] - rod->x[j]).norm() / rod->lengths[j] - 1));
    return max_value;
}

struct hair_reference_rod_energy hair_reference_rod_energy_of(const hair_reference_rod* rod)
{
    struct hair_reference_rod_energy e = {};
    e.elastic = rod->energy;
    for (uint32_t i = 0; i < rod->vertices; ++i) {
        e.kinetic += rod->masses[i] * rod->v[i].squaredNorm() / 2;
        e.gravity -= rod->masses[i] * rod->gravity.dot(rod->x[i]);
        e.pull += rod->masses[i] * rod->pull[i] * (rod->x[i] - rod->target_of(i)).squaredNorm() / 2;
    }
    e.total = e.kinetic + e.elastic + e.gravity + e.pull;
    return e;
}

void hair_reference_rod_elastic_forces(const hair_reference_rod* rod, double* forces)
{
    for (uint32_t i = 0; i < rod->vertices; ++i) store(rod->force[i], forces + 3 * i);
}
