// rod_preload.c - how one guide holds its groom against gravity, as lib/rod/gravity_preload.c
// describes.
#include "tests/support/rod_statics.h"

#include <string.h>

#define MARGIN 1.3 // Multiple of gravity under which a pose must be stable.
// Minimum frequency about a pose, rad/s. The default damping of 4/s damps this frequency
// critically.
#define SLOWEST 2.0
#define FINENESS 1.02 // Precision of 1 + c, as a ratio.
#define STEP 0.125 // Step of t.
#define BISECTIONS 3 // Number of bisections of a step of t.
#define STEPS 1 // Steps of Newton's method for each t below 1.
#define LAST_STEPS 60 // Maximum steps of Newton's method where it must converge.
#define SAME 1e-4 // Maximum distance between equal poses, as a fraction of the length.

struct search {
    struct hair_rod_shape* shape;
    struct hair_rod_pose pose;
    struct hair_rod_stability stability; // Stability of the groom, prepared.
    // Strain of the groom, times the stiffness. Entry 0 is not kept.
    double strain[HAIR_MAX_GUIDE_VERTICES];
    hair_dvec3 root_stress; // Stress of the groom at the root.
    double bend[HAIR_MAX_GUIDE_VERTICES]; // Stiffness of the material.
    double lever[HAIR_MAX_GUIDE_VERTICES]; // e_i / e_0
    hair_rod_rest own[HAIR_MAX_GUIDE_VERTICES]; // Rest shape equal to the groom.
    hair_rod_rest rest[HAIR_MAX_GUIDE_VERTICES]; // Rest shape that balances the pose.
};

static void find_levers(const struct hair_rod_shape* s, double* lever)
{
    double beyond = 0;
    lever[s->count - 1] = 0;
    for (uint32_t i = s->count - 1; i-- > 0;) {
        beyond += s->mass[i + 1];
        lever[i] = lever[i + 1] + beyond * s->length[i];
    }
    HAIR_ASSERT(lever[0] > 0);
    for (uint32_t i = s->count; i-- > 0;) lever[i] /= lever[0];
}

static void stiffen(struct search* a, double c)
{
    HAIR_ASSERT(c >= 0);
    struct hair_rod_shape* s = a->shape;
    for (uint32_t i = 0; i + 1 < s->count; ++i)
        s->bend[i] = a->bend[i] * fmin(HAIR_ROD_MAX_STIFFEN, 1 + c * a->lever[i]);
}

// Return the difference of the groom's own strain and the rest strain.
static hair_dvec3 strain_off(const struct search* a, uint32_t i)
{
    hair_rod_rest own = a->own[i], rest = a->rest[i];
    HAIR_ASSERT(i + 1 < a->shape->count);
    return (hair_dvec3){own.x - rest.x, own.y - rest.y, own.z - rest.z};
}

// Set `rest` to the rest shape that balances the pose under gravity. Return whether the strain of
// the rest shape is allowed.
static bool balance_gravity(struct search* a)
{
    const struct hair_rod_shape* s = a->shape;
    hair_rod_load(s, 1, &a->pose);
    hair_rod_balance(s, &a->pose);
    for (uint32_t i = 0; i + 1 < s->count; ++i) {
        hair_dvec3 g = hair_dscale(a->pose.stress[i], 1 / hair_rod_stiffness(s, i));
        hair_dvec3 ratio = hair_rod_ratios_at(s, i);
        hair_dquat t = a->pose.turn[i];
        a->rest[i] = (hair_rod_rest){2 * t.x - g.x / ratio.x, 2 * t.y - g.y / ratio.y,
                                     2 * t.z - g.z / ratio.z, 2 * t.w};
        if (!(hair_dlength(strain_off(a, i)) <= HAIR_ROD_MAX_STRAIN)) return false;
    }
    return true;
}

// Return whether the pose can be held. Set `rest` to the rest shape that holds the pose.
static bool holds(struct search* a)
{
    if (!balance_gravity(a)) return false;
    hair_rod_load(a->shape, MARGIN, &a->pose);
    hair_rod_balance(a->shape, &a->pose);
    return hair_rod_is_stable(a->shape, &a->pose, SLOWEST * SLOWEST);
}

// Return the length of the strain that a stress causes at vertex i with the stiffness 1.
static double strain_by(const struct search* a, uint32_t i, hair_dvec3 stress)
{
    hair_dvec3 r = hair_rod_ratios_at(a->shape, i);
    return hair_dlength((hair_dvec3){stress.x / r.x, stress.y / r.y, stress.z / r.z});
}

// Prepare tests of the groom. The pose is the groom, whose stress does not depend on the stiffness.
static void prepare_groom(struct search* a)
{
    const struct hair_rod_shape* s = a->shape;
    hair_rod_load(s, 1, &a->pose);
    hair_rod_balance(s, &a->pose);
    for (uint32_t i = 0; i + 1 < s->count; ++i) a->strain[i] = strain_by(a, i, a->pose.stress[i]);
    a->root_stress = a->pose.stress[0];
    hair_rod_load(s, MARGIN, &a->pose);
    hair_rod_balance(s, &a->pose);
    hair_rod_prepare_stability(s, &a->pose, SLOWEST * SLOWEST, &a->stability);
}

// Return whether the groom can be held with the present stiffness.
static bool groom_holds(struct search* a)
{
    const struct hair_rod_shape* s = a->shape;
    // The stiffness changes the ratios at the clamp.
    a->strain[0] = strain_by(a, 0, a->root_stress);
    for (uint32_t i = 0; i + 1 < s->count; ++i)
        if (!(a->strain[i] <= HAIR_ROD_MAX_STRAIN * hair_rod_stiffness(s, i))) return false;
    return hair_rod_test_stability(s, &a->pose, &a->stability);
}

// Return the smallest c with which the groom holds. The groom holds with c = `does`.
static double min_stiffening(struct search* a, double does)
{
    HAIR_ASSERT(does >= 0);
    double fails = 1; // 1 + c
    for (does += 1; does > FINENESS * fails;) {
        double middle = sqrt(fails * does);
        stiffen(a, middle - 1);
        if (groom_holds(a))
            does = middle;
        else
            fails = middle;
    }
    return does - 1;
}

// Move the pose to y(t). Return whether the pose holds.
static bool holds_at(struct search* a, double t)
{
    hair_rod_settle(a->shape, a->own, t, t < 1 ? STEPS : LAST_STEPS, &a->pose);
    return holds(a);
}

// Find the smallest t whose pose holds, and set the pose. Return more than 1 if no pose holds.
static double find_pose(struct search* a)
{
    hair_dquat failed[HAIR_MAX_GUIDE_VERTICES], found[HAIR_MAX_GUIDE_VERTICES];
    size_t size = a->shape->count * sizeof *failed;
    double fails = 0, does = STEP;
    memcpy(failed, a->shape->frame, size);
    for (; !holds_at(a, does); does += STEP) {
        if (does >= 1) return does + STEP;
        memcpy(failed, a->pose.frame, size);
        fails = does;
    }
    memcpy(found, a->pose.frame, size);
    for (int k = 0; k < BISECTIONS; ++k) {
        double middle = (fails + does) / 2;
        hair_rod_pose_at(a->shape, failed, &a->pose);
        int here = holds_at(a, middle);
        memcpy(here ? found : failed, a->pose.frame, size);
        *(here ? &does : &fails) = middle;
    }
    hair_rod_pose_at(a->shape, found, &a->pose);
    return does;
}

// Return the maximum distance of a vertex of the pose from its position in `place`.
static double max_distance(const struct search* a, const hair_dvec3* place)
{
    double max = 0;
    for (uint32_t i = 1; i < a->shape->count; ++i)
        max = fmax(max, hair_dlength(hair_dadd(a->pose.place[i], hair_dscale(place[i], -1))));
    return max;
}

// Return whether the guide comes to rest in the pose when released from its groom.
static bool is_reached(const struct search* a)
{
    struct hair_rod_pose released;
    double length = 0;
    for (uint32_t i = 0; i + 1 < a->shape->count; ++i) length += a->shape->length[i];
    hair_rod_pose_at(a->shape, a->shape->frame, &released);
    hair_rod_settle(a->shape, a->rest, 1, LAST_STEPS, &released);
    return max_distance(a, released.place) < SAME * length;
}

// Find the pose to hold and its rest shape. Return the distance of that pose from the groom.
static double sag(struct search* a)
{
    double t = find_pose(a);
    while (t <= 1) {
        if (holds(a) && is_reached(a)) return max_distance(a, a->shape->place);
        if (t >= 1) break;
        t = fmin(t + STEP, 1);
        holds_at(a, t);
    }
    // No pose can be held. The rest shape balances no gravity, and the guide hangs.
    memcpy(a->rest, a->own, sizeof a->rest);
    hair_rod_pose_at(a->shape, a->shape->frame, &a->pose);
    hair_rod_settle(a->shape, a->own, 1, LAST_STEPS, &a->pose);
    return max_distance(a, a->shape->place);
}

static bool resists(const struct hair_rod_shape* s)
{
    for (uint32_t i = 0; i + 1 < s->count; ++i)
        if (!(hair_rod_stiffness(s, i) > 0)) return false;
    return true;
}

static void start_search(struct search* a, struct hair_rod_shape* s)
{
    a->shape = s;
    memcpy(a->bend, s->bend, s->count * sizeof *a->bend);
    for (uint32_t i = 0; i + 1 < s->count; ++i)
        a->own[i] = (hair_rod_rest){2 * s->turn[i].x, 2 * s->turn[i].y, 2 * s->turn[i].z, 2 * s->turn[i].w};
    find_levers(s, a->lever);
    hair_rod_pose_at(s, s->frame, &a->pose);
}

// Set the stress that the rest strain causes in the groom. Set rest_real to the rest shape.
static void finish_search(struct search* a)
{
    struct hair_rod_shape* s = a->shape;
    for (uint32_t i = 0; i + 1 < s->count; ++i) {
        hair_dvec3 u = hair_dscale(strain_off(a, i), hair_rod_stiffness(s, i));
        hair_dvec3 ratio = hair_rod_ratios_at(s, i);
        s->stress[i] = (hair_dvec3){ratio.x * u.x, ratio.y * u.y, ratio.z * u.z};
        s->rest_real[i] = a->rest[i].w;
    }
}

struct hair_rod_preload hair_rod_preload_gravity(struct hair_rod_shape* s)
{
    struct hair_rod_preload held = {.stiffest = 1};
    struct search a;
    if (hair_ddot(s->load, s->load) == 0) return held;
    start_search(&a, s);
    if (!resists(s)) { // No multiple of the stiffness helps.
        hair_rod_load(s, 1, &a.pose);
        hair_rod_balance(s, &a.pose);
        memcpy(s->stress, a.pose.stress, (s->count - 1) * sizeof *s->stress);
        return held;
    }
    prepare_groom(&a);
    if (!groom_holds(&a)) {
        double max = (HAIR_ROD_MAX_STIFFEN - 1) / a.lever[s->count - 2], c = max;
        stiffen(&a, max);
        held.sags = !groom_holds(&a);
        if (!held.sags) c = min_stiffening(&a, max);
        stiffen(&a, c);
        held.stiffest = s->bend[0] / a.bend[0];
        HAIR_ASSERT(held.stiffest >= 1 && held.stiffest < 1.001 * HAIR_ROD_MAX_STIFFEN);
        if (held.sags) held.sag = sag(&a);
    }
    if (!held.sags) balance_gravity(&a);
    finish_search(&a);
    return held;
}
