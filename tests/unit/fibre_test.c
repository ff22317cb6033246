// fibre_test.c - the scattering table of a fibre: energy is conserved, and lobes agree with rays
// traced through cylinders.
#include "tests/support/support.h"

#include <math.h>
#include <string.h>

#include "lib/light/fibre.h"

#define PI 3.14159265358979

static const struct hair_fibre usual = {0.3f, 0.3f, 1.55f, 1};

static double step_of(int column)
{
    int ends = column == 0 || column == HAIR_FIBRE_COLUMNS - 1;
    return 2 * PI / (HAIR_FIBRE_COLUMNS - 1) * (ends ? 0.5 : 1);
}

static void a_fibre_that_absorbs_nothing_loses_no_light(void** state)
{
    (void)state;
    static hair_fibre_table table;
    static const float roughness[] = {0.1f, 0.3f, 0.6f, 1, 0.3f, 0.3f}, flatness[] = {1, 1, 1, 1, 0.6f, 0.2f};
    for (int r = 0; r < 6; ++r) {
        struct hair_fibre fibre = usual;
        fibre.around = roughness[r], fibre.flatness = flatness[r];
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

static double fresnel(double in, double out, double index)
{
    double p = (index * in - out) / (index * in + out), s = (in - index * out) / (in + index * out);
    return 0.5 * (p * p + s * s);
}

// Elliptic cross section of a fibre with the area of a unit circle.
struct section {
    double a, b, index; // Half axes, longer first, and index of refraction.
};

static struct section section_of(const struct hair_fibre* fibre)
{
    double flat = (double)fibre->flatness;
    return (struct section){1 / sqrt(flat), sqrt(flat), (double)fibre->index};
}

static double width_of(const struct section* s, double turn)
{
    return hypot(s->a * sin(turn), s->b * cos(turn));
}

// Return the angle of the outward normal at the parameter t of the ellipse.
static double normal_at(const struct section* s, double t)
{
    return atan2(sin(t) / s->b, cos(t) / s->a);
}

// Return the parameter at which light from the angle `turn` meets the ellipse, at the height h.
static double enter(const struct section* s, double turn, double h)
{
    double top = atan2(s->b * cos(turn), -s->a * sin(turn)), t = top - acos(h);
    return cos(normal_at(s, t) - turn) > 0 ? t : top + acos(h);
}

// Return the angle by which a ray is deflected on leaving an ellipse after `legs` legs inside. It
// comes from the angle `turn` at height h, and is refracted by Snell's law. `fraction` is the part
// of the light that leaves then, and `path` the length inside. Angles stand for directions, and the
// ends of a chord are found on the circle that the ellipse is when it is stretched.
static double trace(const struct section* s, double turn, double h, int legs, double* fraction, double* path)
{
    double t = enter(s, turn, h), normal = normal_at(s, t), in = turn - normal,
           inside = asin(sin(in) / s->index);
    double f = fresnel(cos(in), cos(inside), s->index), way = normal + PI + inside;
    *path = 0;
    *fraction = legs ? 1 - f : f;
    if (!legs) return normal - in - turn;
    for (int leg = 1;; ++leg) {
        double from = t;
        t = 2 * atan2(sin(way) / s->b, cos(way) / s->a) - t - PI;
        *path += hypot(s->a * (cos(t) - cos(from)), s->b * (sin(t) - sin(from)));
        normal = normal_at(s, t), inside = remainder(way - normal, 2 * PI);
        double sine = s->index * sin(inside);
        bool is_total = fabs(sine) >= 1;
        f = is_total ? 1 : fresnel(cos(asin(sine)), cos(inside), s->index);
        if (leg == legs) {
            *fraction *= 1 - f;
            return is_total ? 0 : normal + asin(sine) - turn;
        }
        *fraction *= f;
        way = normal + PI - inside;
    }
}

// Compare lobes of light that leaves at angle phi, and the paths inside. The table sums over the
// width with as many rays, so only its geometry is tested.
static void check_lobes(const struct hair_fibre* fibre, int directions, int rays, double tolerance)
{
    static hair_fibre_table table;
    hair_fibre_fill(fibre, table);
    struct section section = section_of(fibre);
    double scale = (double)hair_fibre_scale(fibre->around), max = 0, width = 0;
    double cut = 1 / (1 + exp(-PI / scale)) - 1 / (1 + exp(PI / scale));
    for (int d = 0; d < directions; ++d) width += width_of(&section, PI * (d + 0.5) / directions);
    for (int i = 0; i < HAIR_FIBRE_COLUMNS; i += 7)
        for (int legs = 0; legs < 3; ++legs) {
            double sum = 0, far = 0;
            for (int k = 0; k < rays * directions; ++k) {
                double turn = PI * (k % directions + 0.5) / directions, fraction, path;
                double angle =
                    trace(&section, turn, (k / directions + 0.5) / rays * 2 - 1, legs, &fraction, &path);
                double e = exp(-fabs(remainder(PI * i / (HAIR_FIBRE_COLUMNS - 1) - angle, 2 * PI)) / scale);
                double density = e / (scale * (1 + e) * (1 + e)) / cut;
                fraction *= width_of(&section, turn) / width;
                sum += fraction * density / rays;
                far += fraction * density * path / rays;
            }
            const hair_vec4 *w = &table[0][HAIR_FIBRE_ROWS - 1][i], *l = &table[1][HAIR_FIBRE_ROWS - 1][i];
            double density = (double)(legs == 0 ? w->x : legs == 1 ? w->y : w->z);
            max = fmax(max, fabs(density - sum));
            hair_test_near("density", (size_t)(3 * i + legs), density, sum, tolerance);
            double path = legs == 0 ? 0 : (double)(legs == 1 ? l->x : l->y);
            hair_test_near("path", (size_t)(3 * i + legs), density * path, far, 3 * tolerance);
        }
    print_message("    off by up to %.2g of 1/radian\n", max);
}

static void lobes_lie_where_traced_rays_leave_the_fibre(void** state)
{
    (void)state;
    check_lobes(&usual, 1, 20000, 5e-4);
}

static void lobes_of_flat_fibres_are_the_mean_of_all_directions(void** state)
{
    (void)state;
    static const float flatness[] = {0.8f, 0.5f, 0.2f};
    for (int i = 0; i < 3; ++i) {
        struct hair_fibre flat = usual;
        flat.flatness = flatness[i];
        check_lobes(&flat, 90, 400, 3e-3);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_fibre_that_absorbs_nothing_loses_no_light),
        cmocka_unit_test(more_absorption_sends_on_less_light),
        cmocka_unit_test(lobes_lie_where_traced_rays_leave_the_fibre),
        cmocka_unit_test(lobes_of_flat_fibres_are_the_mean_of_all_directions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
