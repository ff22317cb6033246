// tip_inertia.c - tip inertia: added inertia for strands that a heavy tip pulls taut.
//
// Let W_i be the weight of all beyond segment i, l_i the length of segment i, and m_i the mass of
// vertex i. Vertices of the strand oscillate crosswise against each other with an angular frequency
// of at most
//
//   w^2 = 2 (W_(i-1) / l_(i-1) + W_i / l_i) / m_i
//
// The length constraints take the directions of segments to be known, and fail where w b is far
// beyond 1. In a substep of length h, b is 2/3 h for BDF2, and h for other methods. Such vertices
// get more inertia, but no more weight. They rest where they did, and the added inertia vanishes
// with h squared. The added inertia is small beside that of the tip. With 32 vertices and a tip of
// 1000 times the strand's mass, it is a hundredth.
#include "lib/rod/rod_shape.h"

// Maximum of w b. When the head shakes, lengths get lost with 5, and hardly ever with 3.3.
#define MAX_PHASE 2.7

static bool is_heavy(const struct hair_rod_shape* s)
{
    double length = 0;
    for (uint32_t i = 0; i < s->count; ++i) length += s->length[i];
    return s->held && !s->pinned[s->count - 1] &&
           s->mass[s->count - 1] > length; // See `heavy` of glsl/sim/load_store.glsl.
}

// Compute twice the crosswise stiffness at vertices 1 to count - 2.
static void find_stiffness(const struct hair_rod_shape* s, double* out)
{
    double weight = s->mass[s->count - 1] * s->gravity;
    for (uint32_t i = s->count - 1; i-- > 1;) {
        HAIR_ASSERT(s->length[i] > 0 && s->length[i - 1] > 0);
        double below = weight / s->length[i];
        weight += s->mass[i] * s->gravity;
        out[i] = 2 * (below + weight / s->length[i - 1]);
    }
}

double hair_rod_tautness(const struct hair_rod_shape* s)
{
    double stiffness[HAIR_MAX_GUIDE_VERTICES], max = 0;
    if (!is_heavy(s)) return 0;
    find_stiffness(s, stiffness);
    for (uint32_t i = 1; i + 1 < s->count; ++i) max = fmax(max, stiffness[i] / s->mass[i]);
    return sqrt(max);
}

double hair_rod_longest_taut(const struct hair_rod_shape* s)
{
    return MAX_PHASE / hair_rod_tautness(s);
}

void hair_rod_add_inertia(struct hair_rod_shape* s, double b)
{
    HAIR_ASSERT(b > 0);
    double stiffness[HAIR_MAX_GUIDE_VERTICES];
    if (!is_heavy(s)) return;
    find_stiffness(s, stiffness);
    for (uint32_t i = 1; i + 1 < s->count; ++i)
        s->mass[i] = fmax(s->mass[i], stiffness[i] * b * b / (MAX_PHASE * MAX_PHASE));
}

double hair_rod_weight_fraction(const struct hair_rod_shape* s, uint32_t i)
{
    if (i == 0 || i + 1 >= s->count) return 1;
    HAIR_ASSERT(s->mass[i] > 0);
    return fmin((s->length[i - 1] + s->length[i]) / 2 / s->mass[i], 1);
}
