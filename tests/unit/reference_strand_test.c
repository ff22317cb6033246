// reference_strand_test.c - the reference of drawn strands: transported frames, smoothed guides and
// followers agree with closed forms.
#include "tests/support/reference_guide.h"

#include <math.h>
#include <string.h>

#define PI 3.141592653589793

// Compute rotate(q, v) for unit q, by the matrix of q.
static void rotate(const double q[4], const double v[3], double out[3])
{
    double x = q[0], y = q[1], z = q[2], w = q[3];
    double m[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                      {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                      {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}};
    for (int i = 0; i < 3; ++i) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
}

// Check a frame around a plane curve. All its rotations are about the plane's normal, so a closed
// circle returns the frame to its initial value.
static void a_frame_carried_around_a_circle_comes_back(void** state)
{
    (void)state;
    enum { SEGMENTS = 63 };
    double directions[3 * SEGMENTS], frames[4 * SEGMENTS], root[4] = {0, 0, 0, 1};
    for (int i = 0; i < SEGMENTS; ++i) {
        double angle = 2 * PI * i / (SEGMENTS - 1);
        directions[3 * i] = -sin(angle);
        directions[3 * i + 1] = cos(angle);
        directions[3 * i + 2] = 0;
    }
    hair_reference_frames(SEGMENTS, directions, root, frames);
    for (int i = 0; i < SEGMENTS; ++i) {
        double y[3], z[3];
        rotate(frames + 4 * i, (double[]){0, 1, 0}, y);
        rotate(frames + 4 * i, (double[]){0, 0, 1}, z);
        hair_test_near3("y", y, directions[3 * i], directions[3 * i + 1], 0, 1e-13);
        hair_test_near3("z", z, 0, 0, 1, 1e-13);
    }
}

// Check parallel transport around a triangle on the sphere of directions with three right angles.
// It rotates a frame by the triangle's area, pi/2 (Gauss and Bonnet).
static void a_frame_carried_around_an_octant_turns_by_a_right_angle(void** state)
{
    (void)state;
    double directions[] = {0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0}, frames[16], root[4] = {0, 0, 0, 1}, x[3];
    hair_reference_frames(4, directions, root, frames);
    rotate(frames + 12, (double[]){1, 0, 0}, x);
    hair_test_near3("x", x, 0, 0, -1, 1e-14);
}

// Check a parabola p(s) = c0 + c1 s + c2 s^2 at uneven s. Its slopes are exact, so that the cubic
// equals the parabola.
static void hermite_reproduces_parabolas_exactly(void** state)
{
    (void)state;
    static const double s[] = {0, 0.3, 0.5, 1.2}, c[3][3] = {{1, -2, 0.5}, {0.3, 2, -1}, {-0.7, 0.4, 1.5}};
    double p[4][3], slope[2][3];
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 3; ++k) p[i][k] = c[0][k] + s[i] * (c[1][k] + s[i] * c[2][k]);
    for (int i = 0; i < 2; ++i) {
        hair_reference_slope(p[i], p[i + 1], p[i + 2], s[i + 1] - s[i], s[i + 2] - s[i + 1], slope[i]);
        for (int k = 0; k < 3; ++k)
            hair_test_near("slope", i, slope[i][k], c[1][k] + 2 * s[i + 1] * c[2][k], 1e-14);
    }
    for (int n = 0; n <= 10; ++n) {
        double w = n / 10.0, at = s[1] + w * (s[2] - s[1]), position[3], tangent[3];
        hair_reference_hermite(p[1], slope[0], p[2], slope[1], s[2] - s[1], w, position, tangent);
        for (int k = 0; k < 3; ++k) {
            hair_test_near("position", n, position[k], c[0][k] + at * (c[1][k] + at * c[2][k]), 1e-14);
            hair_test_near("tangent", n, tangent[k], (s[2] - s[1]) * (c[1][k] + 2 * at * c[2][k]), 1e-14);
        }
    }
}

// Check vertices around a circle of radius 1, at angles a. Chords have the length 2 sin(a/2).
// Slopes have the length cos(a/2), along the tangents.
//
// Half way between two vertices the chord is cos(a/2) from the centre. Hermite's cubic adds an
// eighth of the chord's length times the difference of the slopes, outwards. The difference is 2
// sin(a/2) cos(a/2) = sin(a). Together the radius is 1 - 3/128 a^4.
static void a_smoothed_circle_is_round_to_fourth_order(void** state)
{
    (void)state;
    struct hair_test_guide f = hair_test_guide_straight_down(33, 0.01f);
    double a = 0.15;
    for (int i = 0; i < 33; ++i) {
        f.state[i].position[0] = cos(a * i);
        f.state[i].position[1] = sin(a * i);
        f.rest[i].position.w = (float)(2 * sin(a / 2) / 1.25);
    }
    struct hair_reference_sample samples[65];
    f.params.smooth_vertices = 65;
    f.params.alpha = 1;
    hair_reference_smooth(hair_test_guide_whole(&f), f.state, samples);
    for (int k = 0; k < 65; ++k) {
        hair_test_near("to root", k, samples[k].to_root, 32 * 2 * sin(a / 2) * k / 64, 1e-12);
        hair_test_near("stretch", k, samples[k].stretch, 0.25, 1e-6);
        double radius = k % 2 ? cos(a / 2) + sin(a / 2) * sin(a) / 4 : 1;
        double from = hair_test_distance3(samples[k].position, (double[]){0, 0, 0});
        if (k != 1 && k != 63)
            hair_test_near("radius", k, from, radius, 1e-12); // The ends have no neighbours.
        hair_test_near("tangent", k, hair_test_distance3(samples[k].tangent, (double[]){0, 0, 0}), 1, 1e-14);
        double y[3];
        rotate(samples[k].frame, (double[]){0, 1, 0}, y);
        hair_test_near3("frame", y, samples[k].tangent[0], samples[k].tangent[1], samples[k].tangent[2],
                        1e-13);
    }
}

// Check that drawn positions are interpolated between the ends of the last substep, relative to the
// moving head.
static void smoothing_interpolates_between_the_ends_of_a_substep(void** state)
{
    (void)state;
    struct hair_test_guide f = hair_test_guide_straight_down(4, 0.01f);
    struct hair_reference_sample samples[7];
    f.params.smooth_vertices = 7;
    f.params.alpha = 0.25f;
    f.params.last_displacement.x = 1;
    for (int i = 0; i < 4; ++i) f.state[i].displacement[0] = 1.2; // Relative to the head: 0.2.
    hair_reference_smooth(hair_test_guide_whole(&f), f.state, samples);
    for (int k = 0; k < 7; ++k) hair_test_near("x", k, samples[k].position[0], -0.2 * 0.75, 1e-15);
}

// Return a look without strays or clumps.
static hair_look plain_look(float radius)
{
    hair_look look = hair_look_default();
    look.strand.radius = radius;
    look.strays.tip_fraction = look.strays.fraction = 0;
    look.clump.weight = hair_curve_line(0, 0);
    return look;
}

// Check a follower of a straight guide that hangs down. It is its Bezier curve in the guide's
// frame.
static void a_follower_of_a_straight_guide_is_its_bezier_curve(void** state)
{
    (void)state;
    struct hair_test_guide f = hair_test_guide_straight_down(4, 0.01f);
    struct hair_reference_sample samples[7];
    struct hair_reference_point point;
    f.params.smooth_vertices = 7;
    hair_look look = plain_look(0.5f);
    look.strand.taper = hair_curve_line(1, 0.5f);
    hair_reference_smooth(hair_test_guide_whole(&f), f.state, samples);
    struct hair_follower follower = {.length_ratio = 1,
                                     .offset = {{0, 0, 0, 2}, {1, 0, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 0}}};
    hair_reference_follower(&follower, &look, 7, samples, 0.5, NULL, &point);
    // In the middle, each inner control point has a weight of 3/8. Half a turn about x keeps x and
    // inverts z.
    hair_test_near3("middle", point.position, 0.375, -0.5 * 3 * (double)0.01f, -0.375, 1e-9);
    hair_test_near("radius", 0, point.radius, 0.5 * 2 * 0.75, 1e-7);
    follower.length_ratio = 1.5f; // Extrapolated straight beyond the tip.
    hair_reference_follower(&follower, &look, 7, samples, 1, NULL, &point);
    hair_test_near3("tip", point.position, 0, -1.5 * 3 * (double)0.01f, 0, 1e-9);
}

// Check a follower of three straight parallel guides. It is their weighted mean, until it clumps.
static void a_follower_between_guides_is_their_mean(void** state)
{
    (void)state;
    struct hair_test_guide f = hair_test_guide_straight_down(4, 0.01f);
    struct hair_reference_sample samples[21];
    struct hair_reference_point point;
    f.params.smooth_vertices = 7;
    for (int guide = 0; guide < 3; ++guide) {
        for (int i = 0; i < 4; ++i) f.state[i].position[0] = guide == 1;
        for (int i = 0; i < 4; ++i) f.state[i].position[2] = guide == 2;
        hair_reference_smooth(hair_test_guide_whole(&f), f.state, samples + 7 * guide);
    }
    hair_look look = plain_look(1);
    struct hair_follower follower = {
        .guide1 = 1, .guide2 = 2, .weight1 = 0.5f, .weight2 = 0.25f, .length_ratio = 1, .multi = 1};
    follower.offset[0].w = 1;
    hair_reference_follower(&follower, &look, 7, samples, 1, NULL, &point);
    hair_test_near3("mean", point.position, 0.5, -3 * (double)0.01f, 0.25, 1e-9);
    look.clump.weight = hair_curve_line(0, 1);
    hair_reference_follower(&follower, &look, 7, samples, 1, NULL, &point);
    hair_test_near3("clumped", point.position, 0, -3 * (double)0.01f, 0, 1e-9);
    hair_reference_follower(&follower, &look, 7, samples, 0, NULL, &point);
    hair_test_near3("root", point.position, 0.5, 0, 0.25, 1e-9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_frame_carried_around_a_circle_comes_back),
        cmocka_unit_test(a_frame_carried_around_an_octant_turns_by_a_right_angle),
        cmocka_unit_test(hermite_reproduces_parabolas_exactly),
        cmocka_unit_test(a_smoothed_circle_is_round_to_fourth_order),
        cmocka_unit_test(smoothing_interpolates_between_the_ends_of_a_substep),
        cmocka_unit_test(a_follower_of_a_straight_guide_is_its_bezier_curve),
        cmocka_unit_test(a_follower_between_guides_is_their_mean),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
