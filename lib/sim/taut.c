// taut.c - strands that a heavy tip pulls taut.
//
// Under the weight W_i of all beyond segment i a strand swings crosswise, vertex against vertex,
// with at most
//
//   w^2 = 2 (W_(i-1) / l_(i-1) + W_i / l_i) / m_i
//
// What keeps lengths takes their directions to be known, and no longer finds them where w b goes
// far beyond 1, b being h or, of BDF2, 2/3 h. There vertices are given more inertia, not weight:
// they rest where they did, and what is added vanishes with h squared. It is little beside the
// tip's: with 32 vertices and a tip of 1000 times the strand's mass a hundredth.
#include "lib/sim/rod_shape.h"

#define MOST_PHASE 2.7 // w b. Measured: with 5 lengths get lost when the head shakes, with 3.3 hardly ever.

static int is_heavy(const struct hair_rod_shape* s)
{
    double length = 0;
    for (uint32_t i = 0; i < s->count; ++i) length += s->length[i];
    return s->held && !s->tied[s->count - 1] &&
           s->mass[s->count - 1] > length; // As glsl/sim/rod.comp has it.
}

// Crosswise stiffness at vertices 1 to count - 2, times 2.
static void find_stiffness(const struct hair_rod_shape* s, double* out)
{
    double weight = s->mass[s->count - 1] * s->gravity;
    for (uint32_t i = s->count - 1; i-- > 1;) {
        double below = weight / s->length[i];
        weight += s->mass[i] * s->gravity;
        out[i] = 2 * (below + weight / s->length[i - 1]);
    }
}

double hair_rod_tautness(const struct hair_rod_shape* s)
{
    double stiffness[HAIR_MAX_GUIDE_VERTICES], most = 0;
    if (!is_heavy(s)) return 0;
    find_stiffness(s, stiffness);
    for (uint32_t i = 1; i + 1 < s->count; ++i) most = fmax(most, stiffness[i] / s->mass[i]);
    return sqrt(most);
}

double hair_rod_longest_taut(const struct hair_rod_shape* s)
{
    return MOST_PHASE / hair_rod_tautness(s);
}

void hair_rod_add_inertia(struct hair_rod_shape* s, double b)
{
    double stiffness[HAIR_MAX_GUIDE_VERTICES];
    if (!is_heavy(s)) return;
    find_stiffness(s, stiffness);
    for (uint32_t i = 1; i + 1 < s->count; ++i)
        s->mass[i] = fmax(s->mass[i], stiffness[i] * b * b / (MOST_PHASE * MOST_PHASE));
}

double hair_rod_weight_share(const struct hair_rod_shape* s, uint32_t i)
{
    if (i == 0 || i + 1 >= s->count) return 1;
    return fmin((s->length[i - 1] + s->length[i]) / 2 / s->mass[i], 1);
}
