// crowd_grid_test.c - the grid of the crowd: sums that are exact, and accelerations as a twin in double precision has
// them.
#include "tests/support/crowd.h"

#include <math.h>
#include <stdlib.h>

// Anywhere within a cube about the origin, as fast as 20 m/s.
static struct hair_state* scatter(const struct hair_test_living* living, float width, uint32_t* random)
{
    struct hair_state* state = calloc(living->vertices, sizeof *state);
    for (uint32_t i = 0; i < living->vertices; ++i) {
        float *p = &state[i].position.x, *d = &state[i].displacement.x;
        for (int k = 0; k < 3; ++k) {
            p[k] = width * (hair_random(random) - 0.5f);
            d[k] = 40 * (hair_random(random) - 0.5f) * (float)living->hair->sim.substep;
        }
    }
    return state;
}

// The grid's buffers after the block's start, and the twin's: the same sums in double precision.
struct grids {
    struct hair_crowd  crowd;
    uint32_t           nodes;
    int32_t*           grid;
    struct hair_share* share;
    float*             limit;
    hair_vec4*         push;
    double*            twin; // five per node: mass, momentum, volume
};

static hair_vec3 speed_of(const struct hair_state* state, double substep)
{
    const float* d = &state->displacement.x;
    float        v[3];
    for (int k = 0; k < 3; ++k)
        v[k] = (float)fmin(fmax((double)d[k] / substep / (double)HAIR_CROWD_SPEED, -1), 1);
    return hair_load3(v);
}

static uint32_t corner(const struct hair_crowd* crowd, const hair_vec4* position, uint32_t k, double w[4])
{
    const double at[3] = {(double)(position->x - crowd->lower.x), (double)(position->y - crowd->lower.y),
                          (double)(position->z - crowd->lower.z)};
    double       side[3];
    uint32_t     node[3];
    for (int a = 0; a < 3; ++a) {
        double g   = fmin(fmax(at[a] / (double)crowd->cell, 0), crowd->nodes[a] - 1);
        double low = fmin(floor(g), crowd->nodes[a] - 2);
        node[a]    = (uint32_t)low + (k >> a & 1);
        side[a]    = k >> a & 1 ? g - low : 1 - (g - low);
    }
    w[3] = side[0] * side[1] * side[2]; // and its slope along each axis
    for (int a = 0; a < 3; ++a) w[a] = (k >> a & 1 ? 1 : -1) * side[(a + 1) % 3] * side[(a + 2) % 3];
    return node[0] + crowd->nodes[0] * (node[1] + crowd->nodes[1] * node[2]);
}

static struct grids find(struct hair_test_living* living, const struct hair_state* state)
{
    struct hair_sim* sim = &living->hair->sim;
    hair_test_set_state(living, state);
    sim->crowd.beat = 0;
    hair_gl_enter(sim->gl);
    hair_crowd_left(sim);
    hair_gl_leave(sim->gl);
    struct grids g = {.crowd = sim->crowd};
    g.nodes        = g.crowd.nodes[0] * g.crowd.nodes[1] * g.crowd.nodes[2];
    g.grid         = hair_test_buffer(g.crowd.grid, g.nodes * 5 * sizeof *g.grid);
    g.share        = hair_test_buffer(g.crowd.share, living->vertices * sizeof *g.share);
    g.limit        = hair_test_buffer(g.crowd.limit, g.nodes * sizeof *g.limit);
    g.push         = hair_test_buffer(g.crowd.push, living->vertices * sizeof *g.push);
    g.twin         = calloc(g.nodes, 5 * sizeof *g.twin);
    for (uint32_t i = 0; i < living->vertices; ++i) {
        hair_vec3 v = speed_of(&state[i], sim->substep);
        for (uint32_t k = 0; k < 8; ++k) {
            double   w[4], mass = g.share[i].mass;
            uint32_t node = corner(&g.crowd, &state[i].position, k, w);
            g.twin[5 * node] += w[3] * mass;
            g.twin[5 * node + 1] += w[3] * mass * (double)v.x;
            g.twin[5 * node + 2] += w[3] * mass * (double)v.y;
            g.twin[5 * node + 3] += w[3] * mass * (double)v.z;
            g.twin[5 * node + 4] += w[3] * g.share[i].volume;
        }
    }
    return g;
}

static void let_go(struct grids* g)
{
    free(g->grid), free(g->share), free(g->limit), free(g->push), free(g->twin);
}

static void the_grid_holds_exactly_the_mass_and_the_momentum_of_the_hair(void** state)
{
    struct hair_test_living living;
    hair_physics            physics = hair_test_only_crowd(5, 0.1f);
    uint32_t                random  = 3;
    hair_desc               desc    = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_MAPPING_AUTO, 0, &physics);
    hair_test_crowd(*state, &desc, 0.04f, &living);
    struct hair_state* at     = scatter(&living, 0.3f, &random);
    struct grids       g      = find(&living, at);
    int64_t            sum[5] = {0}, expected[5] = {0};
    for (uint32_t n = 0; n < g.nodes; ++n) {
        for (int k = 0; k < 4; ++k) sum[k] += g.grid[4 * n + (uint32_t)k];
        sum[4] += g.grid[4 * g.nodes + n];
        for (uint32_t k = 0; k < 5; ++k) {
            double own = k < 4 ? g.grid[4 * n + k] : g.grid[4 * g.nodes + n];
            hair_test_near("node", n, own, g.twin[5 * n + k], 2000); // of 2^30 in all, 2^21 and more a vertex
        }
    }
    for (uint32_t i = 0; i < living.vertices; ++i) {
        float        mass = (float)g.share[i].mass;
        hair_vec3    v    = speed_of(&at[i], living.hair->sim.substep);
        const float* each = &v.x;
        expected[0] += g.share[i].mass;
        expected[4] += g.share[i].volume;
        for (int k = 0; k < 3; ++k) expected[k + 1] += (int64_t)floorf(mass * each[k] + 0.5f);
    }
    assert_int_equal(sum[0], expected[0]);
    assert_int_equal(sum[4], expected[4]);
    assert_true(llabs((long long)sum[0] - (1 << 30)) <= (long long)living.vertices);
    // The speed itself is a product in floats, here and there: a few units of 2^21 for each vertex.
    for (int k = 1; k < 4; ++k) assert_true(llabs((long long)(sum[k] - expected[k])) <= 2 * living.vertices);
    free(at);
    let_go(&g);
    hair_test_die(&living);
}

static void accelerations_are_those_of_the_twin_in_double_precision(void** state)
{
    struct hair_test_living living;
    hair_physics            physics = hair_test_only_crowd(5, 0.02f);
    uint32_t                random  = 4;
    hair_desc               desc    = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_MAPPING_AUTO, 0, &physics);
    hair_test_crowd(*state, &desc, 0.04f, &living);
    struct hair_state* at   = scatter(&living, 0.05f, &random);
    struct grids       g    = find(&living, at);
    double             time = 2 * living.hair->sim.substep, rate = -expm1(-5 * time) / time, pressed = 0;
    hair_test_near("block", 0, time, 1.0 / 120, 1e-9);
    for (uint32_t i = 0; i < living.vertices; ++i) {
        hair_vec3    speed = speed_of(&at[i], living.hair->sim.substep);
        const float *v = &speed.x, *push = &g.push[i].x;
        double       drawn[3] = {0}, press[3] = {0};
        for (uint32_t k = 0; k < 8; ++k) {
            double        w[4];
            uint32_t      n      = corner(&g.crowd, &at[i].position, k, w);
            const double* node   = g.twin + 5 * n;
            double        full   = fmax(log(node[4] / (double)g.limit[n]), 0);
            double        own[4] = {0}; // of its guide: mass and momentum at the node
            for (uint32_t j = g.share[i].first; j < g.share[i].end; ++j)
                for (uint32_t c = 0; c < 8; ++c) {
                    double u[4];
                    if (corner(&g.crowd, &at[j].position, c, u) != n) continue;
                    hair_vec3 other = speed_of(&at[j], living.hair->sim.substep);
                    for (int a = 0; a < 3; ++a) own[a] += u[3] * g.share[j].mass * (double)(&other.x)[a];
                    own[3] += u[3] * g.share[j].mass;
                }
            for (int a = 0; a < 3; ++a) {
                double others = node[a + 1] - own[a] - (double)v[a] * (node[0] - own[3]);
                if (node[0] > 0) drawn[a] += w[3] * others / node[0];
                press[a] -= (double)physics.volume / (double)g.crowd.cell * w[a] * full;
            }
        }
        double length = sqrt(press[0] * press[0] + press[1] * press[1] + press[2] * press[2]);
        double most   = 0.25 * (double)g.crowd.cell / (time * time);
        pressed += length;
        for (int a = 0; a < 3; ++a)
            hair_test_near("acceleration", 3 * i + (uint32_t)a, (double)push[a],
                           rate * (double)HAIR_CROWD_SPEED * drawn[a] + press[a] * fmin(1, most / length),
                           2e-2);
    }
    assert_true(pressed > 0.01 * living.vertices);
    free(at);
    let_go(&g);
    hair_test_die(&living);
}

// Sum of mass times acceleration, by the sum of its lengths.
static double one_sided(struct hair_test* test, float cohesion, float volume)
{
    struct hair_test_living living;
    hair_physics            physics = hair_test_only_crowd(cohesion, volume);
    uint32_t                random  = 5;
    hair_desc               desc    = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_MAPPING_AUTO, 0, &physics);
    hair_test_crowd(test, &desc, 0.04f, &living);
    struct hair_state* at     = scatter(&living, 0.05f, &random);
    struct grids       g      = find(&living, at);
    double             sum[3] = {0}, lengths = 0;
    for (uint32_t i = 0; i < living.vertices; ++i) {
        const float* a    = &g.push[i].x;
        double       mass = g.share[i].mass;
        for (int k = 0; k < 3; ++k) sum[k] += mass * (double)a[k];
        lengths += mass * hypot(hypot((double)a[0], (double)a[1]), (double)a[2]);
    }
    assert_true(lengths > 0);
    free(at);
    let_go(&g);
    hair_test_die(&living);
    return hypot(hypot(sum[0], sum[1]), sum[2]) / lengths;
}

static void cohesion_makes_no_momentum_and_volume_little(void** state)
{
    double cohesion = one_sided(*state, 10, 0), volume = one_sided(*state, 0, 0.02f);
    print_message("    of all that acts, one-sided: %.1e of cohesion, %.3f of volume\n", cohesion, volume);
    hair_test_near("cohesion", 0, cohesion, 0, 1e-4);
    hair_test_near("volume", 0, volume, 0, 0.2);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(the_grid_holds_exactly_the_mass_and_the_momentum_of_the_hair),
        HAIR_TEST(cohesion_makes_no_momentum_and_volume_little),
        HAIR_TEST(accelerations_are_those_of_the_twin_in_double_precision),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
