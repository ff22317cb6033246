// rod_shape.c - a guide's lengths, masses, stiffness, frames and strain in its groom.
#include "lib/rod/rod_shape.h"

#define TWO_PI 6.283185307179586

static hair_dvec3 along(hair_dquat q)
{
    return hair_drotate(q, (hair_dvec3){0, 1, 0});
}

static hair_dquat unit(hair_dquat q)
{
    double s = sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w), over = 1 / s;
    return s > 1e-20 ? (hair_dquat){q.x * over, q.y * over, q.z * over, q.w * over}
                     : (hair_dquat){0, 0, 0, 1};
}

static hair_dquat load_frame(const hair_vec4* q)
{
    return unit((hair_dquat){(double)q->x, (double)q->y, (double)q->z, (double)q->w});
}

// Return a frame of the groom, corrected for rounding. The smallest rotation aligns its y axis with
// the segment.
static hair_dquat frame_of(const hair_vec4* rounded, hair_dvec3 segment)
{
    hair_dquat q = load_frame(rounded);
    hair_dvec3 from = along(q);
    double size = hair_dlength(segment);
    if (!(size > 0)) return q;
    hair_dvec3 to = hair_dscale(segment, 1 / size), c = hair_dcross(from, to);
    double w = 1 + hair_ddot(from, to);
    if (w < 1e-6) return hair_dmultiply(q, (hair_dquat){1, 0, 0, 0}); // Not a frame of its segment.
    return unit(hair_dmultiply(unit((hair_dquat){c.x, c.y, c.z, w}), q));
}

void hair_rods_ratios(const hair_physics* physics, double ratio[3])
{
    double flat = (double)physics->fiber.flatness;
    HAIR_ASSERT(flat > 0);
    ratio[0] = flat;
    ratio[1] = 2 / ((1 + (double)physics->fiber.poisson_ratio) * (flat + 1 / flat));
    ratio[2] = 1 / flat;
}

double hair_rod_pull_squared(const hair_physics* physics, double fraction)
{
    double root = (double)physics->shape.frequency_root,
           frequency = root + fraction * ((double)physics->shape.frequency_tip - root);
    return TWO_PI * TWO_PI * frequency * frequency;
}

static void find_masses(struct hair_rod_shape* s, const struct hair_rest* rest, const hair_physics* physics)
{
    double total = 0, so_far = 0, radius = (double)physics->fiber.radius;
    double bend =
        (double)physics->fiber.youngs_modulus * radius * radius / (4 * (double)physics->fiber.density);
    hair_dvec3 gravity = hair_dload(physics->gravity);
    for (uint32_t i = 0; i < s->count; ++i) {
        s->length[i] = i + 1 < s->count ? fmax((double)rest[i].position.w, HAIR_ROD_SHORTEST) : 0;
        s->mass[i] = (s->length[i] + (i > 0 ? s->length[i - 1] : 0)) / 2;
        total += s->length[i];
    }
    HAIR_ASSERT(total > 0);
    double cut_off = (double)rest[s->count - 1].position.w, whole = total + cut_off;
    // The additional mass of the tip is cut off with the tip.
    if (cut_off == 0) s->mass[s->count - 1] += (double)physics->tip_mass * total;
    s->weight = 0;
    s->gravity = hair_dlength(gravity);
    for (uint32_t i = 0; i < s->count; ++i) {
        double fraction = so_far / whole, root = (double)physics->shape.stiffness_root;
        s->bend[i] = bend * (root + fraction * ((double)physics->shape.stiffness_tip - root));
        s->pull[i] = hair_rod_pull_squared(physics, (double)i / (s->count - 1) * (total / whole));
        so_far += s->length[i];
        if (i > 0) s->weight += s->mass[i] * s->gravity;
    }
}

static void find_turns(struct hair_rod_shape* s, const struct hair_guide* guide, const struct hair_rest* rest)
{
    hair_dquat before = load_frame(&guide->root_frame);
    s->place[0] = (hair_dvec3){0, 0, 0};
    for (uint32_t i = 0; i + 1 < s->count; ++i) {
        hair_dvec3 from = hair_dload(&rest[i].position.x), to = hair_dload(&rest[i + 1].position.x);
        s->frame[i] = frame_of(&rest[i].frame, hair_dadd(to, hair_dscale(from, -1)));
        hair_dquat r = hair_dmultiply(hair_dconjugate(before), s->frame[i]);
        s->turn[i] = r.w < 0 ? (hair_dquat){-r.x, -r.y, -r.z, -r.w} : r;
        s->rest_real[i] = 2 * s->turn[i].w;
        before = s->frame[i];
        s->place[i + 1] = hair_dadd(s->place[i], hair_dscale(along(s->frame[i]), s->length[i]));
    }
}

void hair_rod_shape_of(const struct hair_guide* guide, const struct hair_rest* rest,
                       const hair_physics* physics, struct hair_rod_shape* out)
{
    HAIR_ASSERT(2 <= guide->count && guide->count <= HAIR_MAX_GUIDE_VERTICES);
    hair_rods_ratios(physics, out->ratio);
    out->count = guide->count;
    out->clamped = physics->root == HAIR_ROOT_CLAMPED;
    out->held = physics->root != HAIR_ROOT_FREE;
    for (uint32_t i = 0; i < out->count; ++i) {
        out->pinned[i] = 0;
        out->stress[i] = (hair_dvec3){0, 0, 0};
    }
    out->rest_real[out->count - 1] = 0;
    // Only a clamped strand can balance gravity. A hinged strand hangs, and a free strand falls.
    out->load =
        hair_dscale(hair_dload(physics->gravity), out->clamped ? (double)physics->shape.gravity_preload : 0);
    find_masses(out, rest, physics);
    find_turns(out, guide, rest);
}

// Return the stiffness of the hinge at the clamp, divided by B / l. B is the bending stiffness
// `bend`, l the segment's length, and T the tension. Without weight the result is 2, because the
// hinge then stands for half a segment. A chain under tension that leaves the clamp at a small
// angle straightens by the factor r per segment, where r + 1/r = 2 + p^2 and p = l sqrt(T / B). The
// result gives the chain the moment of a continuous rod at the clamp, sqrt(B T) times the angle.
// The tension is taken to be the whole weight, whichever way the strand hangs.
//
// Large angles a, from the clamp to straight down, need no other factor. The continuous rod turns
// by the moment 2 sqrt(B T) sin(a / 2). Its curvature k along the arc length s satisfies
//
//   integral k^2 ds = 4 sqrt(T / B) (1 - cos(a / 2))
//
// Segments are as long as the arcs they stand for. The chords of those arcs are shorter by the
// fraction l^2 k^2 / 24. A chain thus hangs too low by
//
//   l^2 / 6 sqrt(T / B) (1 - cos(a / 2))
//
// With this factor and the energy of the mixed scheme, limp strands from a level or rising clamp
// have at most 1.3 times this error. See tests/unit/rod_rest_test.c. Neither another stiffness of
// the clamp nor another part of the second term of its energy comes much nearer.
static double clamp_factor(double length, double weight, double bend)
{
    HAIR_ASSERT(length > 0 && weight >= 0 && bend > 0);
    double p = length * sqrt(weight / bend);
    return 1 + p / 2 + sqrt(1 + p * p / 4);
}

double hair_rod_stiffness(const struct hair_rod_shape* shape, uint32_t i)
{
    double bend = shape->bend[i];
    if (i + 1 >= shape->count || !(bend > 0)) return 0;
    if (i > 0) return 2 * bend / (shape->length[i - 1] + shape->length[i]);
    return shape->clamped ? clamp_factor(shape->length[0], shape->weight, bend) * bend / shape->length[0] : 0;
}

// Tension does not change twist, so that the clamp resists twist as half a segment does.
hair_dvec3 hair_rod_ratios_at(const struct hair_rod_shape* shape, uint32_t i)
{
    const double* ratio = shape->ratio;
    double length = shape->length[0], weight = shape->weight, bend = shape->bend[0];
    if (i > 0 || !shape->clamped || !(bend > 0)) return (hair_dvec3){ratio[0], ratio[1], ratio[2]};
    double factor = clamp_factor(length, weight, bend);
    return (hair_dvec3){ratio[0] * clamp_factor(length, weight, ratio[0] * bend) / factor,
                        ratio[1] * 2 / factor,
                        ratio[2] * clamp_factor(length, weight, ratio[2] * bend) / factor};
}

hair_dvec3 hair_rod_excess(const struct hair_rod_shape* shape, uint32_t i, double stiffness)
{
    HAIR_ASSERT(i + 1 < shape->count && stiffness > 0);
    hair_dvec3 ratio = hair_rod_ratios_at(shape, i), g = hair_dscale(shape->stress[i], 1 / stiffness);
    return (hair_dvec3){g.x / ratio.x, g.y / ratio.y, g.z / ratio.z};
}

void hair_rod_bear(struct hair_rod_shape* shape, const struct hair_rod_borne* borne)
{
    for (uint32_t i = 0; i < shape->count; ++i) {
        HAIR_ASSERT(borne[i].stiffen > 0.999 && borne[i].stiffen < 1.001 * HAIR_ROD_MAX_STIFFEN);
        shape->stress[i] = (hair_dvec3){borne[i].stress[0], borne[i].stress[1], borne[i].stress[2]};
        shape->rest_real[i] = borne[i].rest_real;
        shape->bend[i] *= borne[i].stiffen;
    }
}
