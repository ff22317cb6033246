// guide_rod.cpp - A guide of a groom as a rod of the reference.
#include "tests/reference/guide_rod.h"

#include <cmath>
#include <vector>

namespace
{

// Arrays that hair_reference_rod_desc points to.
struct arrays {
    std::vector<double> positions, lengths, scale, pull, strain, real;
};

double between(float root, float tip, double fraction)
{
    return double(root) + fraction * (double(tip) - double(root));
}

void fill_arrays(const hair_reference_guide_rod& guide, arrays& out)
{
    const uint32_t count = guide.guide->count;
    const auto& shape = guide.physics->shape;
    double total = 0, so_far = 0;
    for (uint32_t i = 0; i + 1 < count; ++i) total += double(guide.rest[i].position.w);
    for (uint32_t i = 0; i < count; ++i) {
        const hair_vec4& at = guide.rest[i].position;
        for (float x : {at.x, at.y, at.z}) out.positions.push_back(double(x));
        out.lengths.push_back(double(at.w));
        out.scale.push_back(between(shape.stiffness_root, shape.stiffness_tip, so_far / total) *
                            (guide.stiffen ? guide.stiffen[i] : 1));
        out.pull.push_back(6.283185307179586 *
                           between(shape.frequency_root, shape.frequency_tip, double(i) / (count - 1)));
        so_far += double(at.w);
    }
    out.strain.resize(3 * count);
    out.real.resize(count);
}

void fill_material(const hair_reference_guide_rod& guide, hair_reference_rod_desc& out)
{
    const hair_physics& physics = *guide.physics;
    const double radius = double(physics.fiber.radius), flat = double(physics.fiber.flatness);
    const double bend =
        double(physics.fiber.youngs_modulus) * radius * radius / (4 * double(physics.fiber.density));
    out.line_density = 1;
    out.tip_mass = double(physics.tip_mass) * double(guide.guide->arc_length);
    out.bend[0] = bend * flat;
    out.bend[1] = bend / flat;
    out.twist = bend * 2 / ((1 + double(physics.fiber.poisson_ratio)) * (flat + 1 / flat));
    out.damping = double(physics.damping);
    for (int k = 0; k < 3; ++k) out.gravity[k] = double(physics.gravity[k]);
    for (int k = 0; k < 3; ++k) out.wind[k] = double(guide.wind->velocity[k]);
    out.drag = hair_reference_guide_rod_drag(&physics, guide.wind);
    out.diameter = 2 * radius;
    out.air = {double(guide.wind->density), double(guide.wind->viscosity)};
}

} // namespace

double hair_reference_guide_rod_drag(const hair_physics* physics, const hair_wind* wind)
{
    const double radius = double(physics->fiber.radius);
    const float* v = wind->velocity;
    if (v[0] == 0 && v[1] == 0 && v[2] == 0 && !wind->still_air) return 0;
    return double(physics->drag) / (double(physics->fiber.density) * 3.14159265358979 * radius * radius);
}

hair_reference_rod* hair_reference_guide_rod_create(const hair_reference_guide_rod* guide)
{
    const hair_physics& physics = *guide->physics;
    const uint32_t count = guide->guide->count;
    hair_reference_rod_desc desc = hair_reference_rod_desc_default();
    arrays arrays;
    fill_arrays(*guide, arrays);
    fill_material(*guide, desc);
    desc.vertices = count;
    desc.positions = arrays.positions.data();
    desc.lengths = arrays.lengths.data();
    desc.scale = arrays.scale.data();
    if (physics.shape.frequency_root > 0 || physics.shape.frequency_tip > 0) desc.pull = arrays.pull.data();
    desc.root = hair_reference_rod_root(physics.root);
    const hair_vec4& frame = guide->guide->root_frame;
    desc.root_frame[0] = double(frame.x), desc.root_frame[1] = double(frame.y);
    desc.root_frame[2] = double(frame.z), desc.root_frame[3] = double(frame.w);
    if (guide->head) desc.head = *guide->head;
    desc.rest_strain = arrays.strain.data();
    if (physics.shape.gravity_preload > 0 && physics.root == HAIR_ROOT_CLAMPED) {
        hair_reference_rod_desc held = desc;
        for (double& g : held.gravity) g *= double(physics.shape.gravity_preload);
        if (!hair_reference_rod_hold(&held, arrays.strain.data(), arrays.real.data())) return nullptr;
        desc.rest_real = arrays.real.data();
    } else {
        hair_reference_rod_strain(count, desc.positions, desc.root_frame, arrays.strain.data());
    }
    double max_value = 0;
    for (uint32_t i = 0; i < 3 * (count - 1); ++i)
        max_value = std::fmax(max_value, std::fabs(arrays.strain[i]));
    desc.straight = max_value < 2e-5 && physics.fiber.flatness == 1 && !guide->is_mixed;
    return hair_reference_rod_create(&desc);
}
