// hair_grid_splat_test.c - the hair-hair grid: sums are exact, and accelerations agree with a
// reference in double precision.
#include "tests/support/hair_grid.h"

#include <math.h>
#include <stdlib.h>

// Place all vertices at random in a cube about the origin, at speeds up to `fastest` along each
// axis.
static struct hair_state* scatter(const struct hair_test_living* living, float width, float fastest,
                                  uint32_t* random)
{
    struct hair_state* state = calloc(living->vertices, sizeof *state);
    for (uint32_t i = 0; i < living->vertices; ++i) {
        float *p = &state[i].position.x, *d = &state[i].displacement.x;
        for (int k = 0; k < 3; ++k) {
            p[k] = width * (hair_random(random) - 0.5f);
            d[k] = 2 * fastest * (hair_random(random) - 0.5f) * (float)living->hair->sim.substep;
        }
    }
    return state;
}

#define NUMBERS HAIR_GRID_NODE_NUMBERS
#define STRAND_UNITS(hair_grid) (16 * (double)(hair_grid)->cell / (hair_grid)->metres * HAIR_GRID_UNITS)

// Buffers of the grid after the start of the block, and the sums of the reference in double
// precision.
struct grids {
    struct hair_grid hair_grid;
    double substep;
    uint32_t nodes;
    int32_t* grid;
    struct hair_grid_splat* fraction;
    float* limit;
    hair_vec4* push;
    double* twin;
};

// Trilinear position of a vertex among the eight nodes around it.
struct root_binding {
    double speed[3], at[3]; // Speed divided by HAIR_GRID_SPEED. Position in cells.
    uint32_t lowest[3];
    int inside;
};

static struct root_binding find_root_binding(const struct grids* g, const struct hair_state* state)
{
    const float *d = &state->displacement.x, *p = &state->position.x, *low = &g->hair_grid.lower.x;
    struct root_binding root_binding = {.inside = 1};
    double cell = (double)g->hair_grid.cell, top = (double)HAIR_GRID_SPEED;
    for (int k = 0; k < 3; ++k) {
        root_binding.speed[k] = fmin(fmax((double)d[k] / g->substep / top, -1), 1);
        root_binding.at[k] = (double)(p[k] - low[k]) / cell + root_binding.speed[k] * top * g->substep / cell;
        root_binding.inside =
            root_binding.inside && root_binding.at[k] >= 0 && root_binding.at[k] <= g->hair_grid.nodes[k] - 1;
        root_binding.lowest[k] =
            (uint32_t)fmin(floor(fmax(root_binding.at[k], 0)), g->hair_grid.nodes[k] - 2);
    }
    return root_binding;
}

// Return the weight at corner k. `from` is the offset from the node in cells, and `node` its index.
static double reach(const struct grids* g, const struct root_binding* root_binding, uint32_t k,
                    double from[3], uint32_t* node)
{
    double weight = 1;
    uint32_t n[3];
    for (int a = 0; a < 3; ++a) {
        n[a] = root_binding->lowest[a] + (k >> a & 1);
        from[a] = root_binding->at[a] - n[a];
        weight *= 1 - fabs(from[a]);
    }
    *node = n[0] + g->hair_grid.nodes[0] * (n[1] + g->hair_grid.nodes[1] * n[2]);
    return weight;
}

// Return the mass at corner k of the cell by the guide of i alone. The sum takes the run of
// consecutive vertices about i that reach any corner.
static double own_mass(const struct grids* g, const struct hair_state* state, uint32_t i, uint32_t k)
{
    struct root_binding root_binding = find_root_binding(g, &state[i]);
    double sum = 0;
    for (int way = -1; way <= 1; way += 2)
        for (int64_t j = way < 0 ? i : i + 1; j >= g->fraction[i].first && j < g->fraction[i].end; j += way) {
            struct root_binding other = find_root_binding(g, &state[j]);
            double weight = 1;
            int near = 1;
            for (int a = 0; a < 3; ++a) {
                double from = other.at[a] - root_binding.lowest[a];
                weight *= fmax(1 - fabs(from - (k >> a & 1)), 0);
                near = near && from > -1 && from < 2;
            }
            sum += weight * g->fraction[j].mass;
            if (!near) break;
        }
    return sum;
}

static void add(struct grids* g, const struct hair_state* state, uint32_t i)
{
    struct root_binding root_binding = find_root_binding(g, &state[i]);
    const double* v = root_binding.speed;
    for (uint32_t k = 0; k < 8 && root_binding.inside; ++k) {
        double r[3];
        uint32_t node;
        double weight = reach(g, &root_binding, k, r, &node), mass = weight * g->fraction[i].mass;
        double* sum = g->twin + NUMBERS * node;
        sum[0] += mass;
        sum[HAIR_GRID_VOLUME] += weight * g->fraction[i].volume;
        for (int a = 0; a < 3; ++a) {
            int b = (a + 1) % 3, c = (a + 2) % 3;
            sum[HAIR_GRID_MOMENTUM + a] += mass * v[a];
            sum[HAIR_GRID_MOMENT + a] += mass * r[a];
            sum[HAIR_GRID_ANGULAR + a] += mass * (r[b] * v[c] - r[c] * v[b]);
            sum[HAIR_GRID_SQUARES + a] += mass * r[a] * r[a];
            sum[HAIR_GRID_PRODUCTS + a] += mass * r[b] * r[c];
        }
        sum[HAIR_GRID_ALIKE] += mass * fmin(own_mass(g, state, i, k) / STRAND_UNITS(&g->hair_grid), 1);
    }
}

static struct grids find(struct hair_test_living* living, const struct hair_state* state)
{
    struct hair_sim* sim = &living->hair->sim;
    hair_test_set_state(living, state);
    hair_gl_enter(sim->gl);
    hair_grid_update(sim);
    hair_gl_leave(sim->gl);
    struct grids g = {.hair_grid = sim->hair_grid, .substep = sim->substep};
    g.nodes = g.hair_grid.nodes[0] * g.hair_grid.nodes[1] * g.hair_grid.nodes[2];
    g.grid = hair_test_buffer(g.hair_grid.grid, g.nodes * NUMBERS * sizeof *g.grid);
    g.fraction = hair_test_buffer(g.hair_grid.splat, living->vertices * sizeof *g.fraction);
    g.limit = hair_test_buffer(g.hair_grid.rest_density, g.nodes * sizeof *g.limit);
    g.push = hair_test_buffer(g.hair_grid.acceleration, living->vertices * sizeof *g.push);
    g.twin = calloc(g.nodes, NUMBERS * sizeof *g.twin);
    for (uint32_t i = 0; i < living->vertices; ++i) add(&g, state, i);
    return g;
}

static void let_go(struct grids* g)
{
    free(g->grid), free(g->fraction), free(g->limit), free(g->push), free(g->twin);
}

static void hair_grid_holds_mass_and_momentum_exactly(void** state)
{
    struct hair_test_living living;
    hair_physics physics = hair_test_only_hair_grid(5, 0.1f);
    uint32_t random = 3;
    hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO, 0, &physics);
    hair_test_hair_grid(*state, &desc, 0.04f, &living);
    struct hair_state* at = scatter(&living, 0.3f, 20, &random);
    struct grids g = find(&living, at);
    int64_t sum[5] = {0}, expected[5] = {0};
    for (uint32_t n = 0; n < g.nodes; ++n) {
        for (int k = 0; k < 5; ++k) sum[k] += g.grid[NUMBERS * n + (uint32_t)k];
        for (uint32_t k = 0; k < NUMBERS; ++k) // The total is 2^30. A vertex has at least 2^21.
            hair_test_near("node", NUMBERS * n + k, g.grid[NUMBERS * n + k], g.twin[NUMBERS * n + k], 2000);
    }
    uint32_t outside = 0;
    for (uint32_t i = 0; i < living.vertices; ++i) {
        struct root_binding root_binding = find_root_binding(&g, &at[i]);
        outside += !root_binding.inside;
        if (!root_binding.inside) continue;
        expected[0] += g.fraction[i].mass;
        expected[4] += g.fraction[i].volume;
        for (int k = 0; k < 3; ++k)
            expected[k + 1] +=
                (int64_t)floor((double)(float)g.fraction[i].mass * root_binding.speed[k] + 0.5);
    }
    assert_in_range(outside, 1, living.vertices * 3 / 4);
    assert_int_equal(sum[0], expected[0]);
    assert_int_equal(sum[4], expected[4]);
    // The speed itself is a product in floats on both sides. Each vertex has an error of a few
    // units of 2^21.
    for (int k = 1; k < 4; ++k) assert_true(llabs((long long)(sum[k] - expected[k])) <= 2 * living.vertices);
    free(at);
    let_go(&g);
    hair_test_die(&living);
}

// Solve m w = l, of three rows, by Cramer's rule.
static void solve(double m[3][3], const double l[3], double w[3])
{
    double c[3][3], whole = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            int a = (i + 1) % 3, b = (i + 2) % 3, d = (j + 1) % 3, e = (j + 2) % 3;
            c[i][j] = m[a][d] * m[b][e] - m[a][e] * m[b][d];
        }
    for (int j = 0; j < 3; ++j) whole += m[0][j] * c[0][j];
    for (int i = 0; i < 3; ++i) w[i] = (c[0][i] * l[0] + c[1][i] * l[1] + c[2][i] * l[2]) / whole;
}

// Compute the velocity at `from` of the rigid motion of all hair at a node.
static void rigid(const double* sum, const double from[3], double out[3])
{
    double m = sum[0], c[3], v[3], inertia[3][3], l[3], turn[3];
    for (int a = 0; a < 3; ++a) c[a] = sum[HAIR_GRID_MOMENT + a] / m, v[a] = sum[HAIR_GRID_MOMENTUM + a] / m;
    for (int a = 0; a < 3; ++a) {
        int b = (a + 1) % 3, d = (a + 2) % 3;
        l[a] = sum[HAIR_GRID_ANGULAR + a] / m - (c[b] * v[d] - c[d] * v[b]);
        inertia[a][a] = (sum[HAIR_GRID_SQUARES + b] + sum[HAIR_GRID_SQUARES + d]) / m - c[b] * c[b] -
                        c[d] * c[d] + 1e-5 + 16 / m;
        inertia[b][d] = inertia[d][b] = c[b] * c[d] - sum[HAIR_GRID_PRODUCTS + a] / m;
    }
    solve(inertia, l, turn);
    for (int a = 0; a < 3; ++a) {
        int b = (a + 1) % 3, d = (a + 2) % 3;
        out[a] = v[a] + turn[b] * (from[d] - c[d]) - turn[d] * (from[b] - c[b]);
    }
}

static void hair_grid_accelerations_equal_the_reference(void** state)
{
    struct hair_test_living living;
    hair_physics physics = hair_test_only_hair_grid(5, 0.02f);
    uint32_t random = 4;
    hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO, 0, &physics);
    hair_test_hair_grid(*state, &desc, 0.04f, &living);
    struct hair_state* at = scatter(&living, 0.05f, 1, &random);
    struct grids g = find(&living, at);
    double time = 2 * g.substep, rate = -expm1(-5 * time) / time, pressed = 0, drawn = 0;
    hair_test_near("block", 0, time, 1.0 / 120, 1e-9);
    for (uint32_t i = 0; i < living.vertices; ++i) {
        struct root_binding root_binding = find_root_binding(&g, &at[i]);
        const float* push = &g.push[i].x;
        double pull[3] = {0}, press[3] = {0};
        for (uint32_t k = 0; k < 8 && root_binding.inside; ++k) {
            double r[3], u[3];
            uint32_t n;
            double weight = reach(&g, &root_binding, k, r, &n);
            const double* sum = g.twin + NUMBERS * n;
            if (sum[0] < 1) continue;
            double alike = sum[HAIR_GRID_ALIKE] * STRAND_UNITS(&g.hair_grid) / (sum[0] * sum[0]);
            double company = fmin(fmax(2 * (1 - alike), 0), 1);
            double over = fmax(1 - (double)g.limit[n] / sum[HAIR_GRID_VOLUME], 0);
            rigid(sum, r, u);
            for (int a = 0; a < 3; ++a) {
                pull[a] += rate * (double)HAIR_GRID_SPEED * weight * company * (u[a] - root_binding.speed[a]);
                press[a] += 6 * (double)physics.hair_hair.pressure_stiffness / (double)g.hair_grid.cell *
                            weight * over * (r[a] - sum[HAIR_GRID_MOMENT + a] / sum[0]);
            }
        }
        for (int a = 0; a < 3; ++a) {
            pressed += fabs(press[a]), drawn += fabs(pull[a]);
            hair_test_near("acceleration", 3 * i + (uint32_t)a, (double)push[a], pull[a] + press[a], 2e-2);
        }
    }
    assert_true(pressed > 0.01 * living.vertices && drawn > pressed);
    free(at);
    let_go(&g);
    hair_test_die(&living);
}

// Magnitude of the sum divided by the sum of magnitudes, for forces and for torques.
struct one_sided {
    double force, torque;
};

static struct one_sided one_sided(struct hair_test* test, float cohesion, float volume)
{
    struct hair_test_living living;
    hair_physics physics = hair_test_only_hair_grid(cohesion, volume);
    uint32_t random = 5;
    hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO, 0, &physics);
    hair_test_hair_grid(test, &desc, 0.04f, &living);
    struct hair_state* at = scatter(&living, 0.05f, 1, &random);
    struct grids g = find(&living, at);
    double sum[6] = {0}, lengths[2] = {0};
    for (uint32_t i = 0; i < living.vertices; ++i) {
        struct root_binding root_binding = find_root_binding(&g, &at[i]);
        const float* a = &g.push[i].x;
        double mass = g.fraction[i].mass, each[6];
        for (int k = 0; k < 3; ++k) {
            int b = (k + 1) % 3, c = (k + 2) % 3;
            each[k] = mass * (double)a[k];
            each[k + 3] = mass * (root_binding.at[b] * (double)a[c] - root_binding.at[c] * (double)a[b]);
        }
        for (int k = 0; k < 6; ++k) sum[k] += each[k];
        lengths[0] += hypot(hypot(each[0], each[1]), each[2]);
        lengths[1] += hypot(hypot(each[3], each[4]), each[5]);
    }
    assert_true(lengths[0] > 0);
    free(at);
    let_go(&g);
    hair_test_die(&living);
    return (struct one_sided){hypot(hypot(sum[0], sum[1]), sum[2]) / lengths[0],
                              hypot(hypot(sum[3], sum[4]), sum[5]) / lengths[1]};
}

static void hair_grid_forces_have_no_sum_and_no_torque(void** state)
{
    for (int volume = 0; volume < 2; ++volume) {
        struct one_sided all = one_sided(*state, volume ? 0 : 10, volume ? 0.02f : 0);
        print_message("    of all that %s does, one-sided: %.1e of the force, %.1e of the torque\n",
                      volume ? "volume" : "cohesion", all.force, all.torque);
        hair_test_near("force", 0, all.force, 0, 1e-5);
        hair_test_near("torque", 0, all.torque, 0, 1e-4);
    }
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(hair_grid_holds_mass_and_momentum_exactly),
        HAIR_TEST(hair_grid_forces_have_no_sum_and_no_torque),
        HAIR_TEST(hair_grid_accelerations_equal_the_reference),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
