// rods_strain_test.c - the rest strain of guides as rods: that of the groom, or one that balances
// gravity in the groom.
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/reference/rod.h"
#include "tests/support/rods.h"

static void guide_without_preload_rests_in_the_groomed_strain(void** state)
{
    (void)state;
    struct hair_test_rod* f = hair_test_rod_make();
    double p[3 * 20], root[4], strain[3 * 20];
    hair_test_rod_curl(f, 20, 0.002);
    for (int i = 0; i < 60; ++i) p[i] = (double)(&f->rest[i / 3].position.x)[i % 3];
    for (int k = 0; k < 4; ++k) root[k] = (double)(&f->guide.root_frame.x)[k];
    hair_reference_rod_strain(20, p, root, strain);
    for (int k = 0; k < 4; ++k) {
        f->physics = hair_physics_default();
        f->physics.shape.gravity_preload = k == 0 ? 0 : 1;
        f->physics.gravity[1] = k == 1 ? 0 : -9.81f;
        f->physics.root = k == 2 ? HAIR_ROOT_HINGED : k == 3 ? HAIR_ROOT_FREE : HAIR_ROOT_CLAMPED;
        hair_test_rod_write(f, HAIR_SOLVER_DIRECT, 1.0 / 240);
        for (int i = 0; i < 57; ++i)
            hair_test_near("strain", (size_t)i, (double)(&f->rod[i / 3].strain.x)[i % 3], strain[i], 2e-6);
    }
    free(f);
}

// Check that q and -q give the same strain.
static void rest_strain_does_not_depend_on_the_frame_sign(void** state)
{
    (void)state;
    struct hair_test_rod* f = hair_test_rod_make();
    struct hair_rod rod[20];
    hair_test_rod_curl(f, 20, 0.01);
    hair_test_rod_write(f, HAIR_SOLVER_DIRECT, 1.0 / 240);
    memcpy(rod, f->rod, sizeof rod);
    for (int i = 0; i < 20; i += 3)
        for (int k = 0; k < 4; ++k) (&f->rest[i].frame.x)[k] *= -1;
    hair_test_rod_write(f, HAIR_SOLVER_DIRECT, 1.0 / 240);
    for (size_t i = 0; i < 19; ++i)
        for (int k = 0; k < 3; ++k)
            hair_test_near("strain", i, (double)(&f->rod[i].strain.x)[k], (double)(&rod[i].strain.x)[k],
                           1e-7);
    free(f);
}

// Compare with the reference, which uses another method. It has a clamp factor for each stiffness.
// The section here is round, and the twist at the root is left out.
static void rest_strain_of_a_preloaded_groom_equals_the_reference(void** state)
{
    (void)state;
    struct hair_test_rod* f = hair_test_rod_make();
    double p[3 * 20], strain[3 * 20], real[20], max = 0;
    hair_test_rod_curl(f, 20, 0.002);
    hair_test_rod_write(f, HAIR_SOLVER_DIRECT, 1.0 / 240);
    assert_int_equal(f->report.stiffened, 0);
    for (int i = 0; i < 60; ++i) p[i] = (double)(&f->rest[i / 3].position.x)[i % 3];
    struct hair_reference_rod_desc desc = hair_reference_rod_desc_default();
    double ratio[3];
    hair_rods_ratios(&f->physics, ratio);
    desc.vertices = 20;
    desc.positions = p;
    desc.line_density = 1;
    desc.bend[0] = desc.bend[1] = hair_test_rod_bend(&f->physics);
    desc.twist = ratio[1] * desc.bend[0];
    for (int k = 0; k < 3; ++k) desc.gravity[k] = (double)f->physics.gravity[k];
    for (int k = 0; k < 4; ++k) desc.root_frame[k] = (double)(&f->guide.root_frame.x)[k];
    assert_true(hair_reference_rod_hold(&desc, strain, real));
    for (int i = 0; i < 57; ++i)
        if (i != 1)
            hair_test_near("strain", (size_t)i, (double)(&f->rod[i / 3].strain.x)[i % 3], strain[i], 5e-6);
    for (uint32_t i = 0; i < 19; ++i) hair_test_near("real part", i, f->borne[i].rest_real, real[i], 2e-6);
    hair_reference_rod_strain(20, p, desc.root_frame, strain);
    for (int i = 0; i < 57; ++i) max = fmax(max, fabs((double)(&f->rod[i / 3].strain.x)[i % 3] - strain[i]));
    assert_true(max > 0.005); // Gravity is visible in the strain.
    free(f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(guide_without_preload_rests_in_the_groomed_strain),
        cmocka_unit_test(rest_strain_does_not_depend_on_the_frame_sign),
        cmocka_unit_test(rest_strain_of_a_preloaded_groom_equals_the_reference),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
