// fibre_test.c - the scattering table of a fibre: energy is conserved, and lobes agree with rays
// traced through a cylinder.
#include "tests/support/support.h"

#include <math.h>
#include <string.h>

#include "lib/light/fibre.h"

#define PI 3.14159265358979

static const struct hair_fibre usual = {0.3f, 0.3f, 1.55f};

static double step_of(int column)
{
    int ends = column == 0 || column == HAIR_FIBRE_COLUMNS - 1;
    return 2 * PI / (HAIR_FIBRE_COLUMNS - 1) * (ends ? 0.5 : 1);
}

static void a_fibre_that_absorbs_nothing_loses_no_light(void** state)
{
    (void)state;
    static hair_fibre_table table;
    static const float roughness[] = {0.1f, 0.3f, 0.6f, 1};
    for (int r = 0; r < 4; ++r) {
        struct hair_fibre fibre = usual;
        fibre.around = roughness[r];
        hair_fibre_fill(&fibre, table);
        for (int row = 0; row < HAIR_FIBRE_ROWS; ++row) {
            double sum = 0;
            for (int i = 0; i < HAIR_FIBRE_COLUMNS; ++i) {
                const hair_vec4* w = &table[0][row][i];
                sum += step_of(i) * (double)(w->x + w->y + w->z + w->w);
            }
            hair_test_near("light that leaves", (size_t)row, sum, 1, 0.005);
            hair_test_near("on and back", (size_t)row, (double)(table[2][row][0].x + table[2][row][0].y), 1,
                           0.005);
        }
    }
}

static void more_absorption_sends_on_less_light(void** state)
{
    (void)state;
    static hair_fibre_table table;
    hair_fibre_fill(&usual, table);
    for (int row = 0; row < HAIR_FIBRE_ROWS; ++row) {
        for (int i = 1; i < HAIR_FIBRE_COLUMNS; ++i) {
            // Beyond this, no light leaves after passing through.
            int little = i < HAIR_FIBRE_COLUMNS / 2;
            assert_true(table[2][row][i].x - table[2][row][i - 1].x <= (little ? -1e-6f : 0));
            assert_true(table[2][row][i].y <= table[2][row][i - 1].y);
        }
        // Reflected light is not absorbed.
        assert_true(table[2][row][HAIR_FIBRE_COLUMNS - 1].y > 0.01f);
    }
}

struct vec {
    double x, y;
};

static double dot(struct vec a, struct vec b)
{
    return a.x * b.x + a.y * b.y;
}

static double fresnel(double in, double out, double index)
{
    double p = (index * in - out) / (index * in + out), s = (in - index * out) / (in + index * out);
    return 0.5 * (p * p + s * s);
}

// Return the angle by which a ray is deflected on leaving a unit circle after `legs` legs inside.
// The ray enters at height h along -x, and is refracted by Snell's law. `fraction` is the part of
// the light that leaves then, and `path` the length inside.
static double trace(double h, int legs, double index, double* fraction, double* path)
{
    struct vec p = {sqrt(1 - h * h), h}, d = {-1, 0};
    double in = -dot(p, d), out = sqrt(1 - (1 - in * in) / (index * index)), f = fresnel(in, out, index);
    *path = 0;
    if (legs == 0) {
        *fraction = f;
        d = (struct vec){d.x + 2 * in * p.x, d.y + 2 * in * p.y};
        return atan2(d.y, d.x);
    }
    *fraction = 1 - f;
    struct vec way = {d.x / index + (in / index - out) * p.x, d.y / index + (in / index - out) * p.y};
    for (int leg = 1;; ++leg) {
        double far = -2 * dot(p, way);
        *path += far;
        p = (struct vec){p.x + far * way.x, p.y + far * way.y};
        double meet = dot(p, way), leave = sqrt(1 - (1 - meet * meet) * index * index);
        // The reflectance for the opposite direction is the same.
        double r = fresnel(leave, meet, index);
        if (leg == legs) {
            *fraction *= 1 - r;
            struct vec n = {way.x * index + (leave - meet * index) * p.x,
                            way.y * index + (leave - meet * index) * p.y};
            return atan2(n.y, n.x);
        }
        *fraction *= r;
        way = (struct vec){way.x - 2 * meet * p.x, way.y - 2 * meet * p.y};
    }
}

// Compare lobes of light from +x that leaves at angle phi. The table sums over the width with as
// many rays, so only its geometry is tested.
static void lobes_lie_where_traced_rays_leave_the_fibre(void** state)
{
    (void)state;
    static hair_fibre_table table;
    hair_fibre_fill(&usual, table);
    double scale = (double)hair_fibre_scale(usual.around), max = 0;
    double cut = 1 / (1 + exp(-PI / scale)) - 1 / (1 + exp(PI / scale));
    for (int i = 0; i < HAIR_FIBRE_COLUMNS; i += 7)
        for (int legs = 0; legs < 3; ++legs) {
            double sum = 0, far = 0;
            int rays = 20000;
            for (int k = 0; k < rays; ++k) {
                double fraction, path,
                    angle = trace((k + 0.5) / rays * 2 - 1, legs, (double)usual.index, &fraction, &path);
                double x = PI * i / (HAIR_FIBRE_COLUMNS - 1) - angle;
                x -= 2 * PI * floor((x + PI) / (2 * PI));
                double e = exp(-fabs(x) / scale), density = e / (scale * (1 + e) * (1 + e)) / cut;
                sum += fraction * density / rays;
                far += fraction * density * path / rays;
            }
            const hair_vec4 *w = &table[0][HAIR_FIBRE_ROWS - 1][i], *l = &table[1][HAIR_FIBRE_ROWS - 1][i];
            double density = (double)(legs == 0 ? w->x : legs == 1 ? w->y : w->z);
            max = fmax(max, fabs(density - sum));
            hair_test_near("density", (size_t)(3 * i + legs), density, sum, 5e-4);
            if (legs)
                hair_test_near("path", (size_t)(3 * i + legs), (double)(legs == 1 ? l->x : l->y), far / sum,
                               2e-2);
        }
    print_message("    off by up to %.2g of 1/radian\n", max);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_fibre_that_absorbs_nothing_loses_no_light),
        cmocka_unit_test(more_absorption_sends_on_less_light),
        cmocka_unit_test(lobes_lie_where_traced_rays_leave_the_fibre),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
