// cutter_test.c - shapes that cut hair, and boxes that they may reach.
#include "tests/support/support.h"

#include "lib/collide/cutter.h"

#define TRIES 200000

static float between(uint32_t* random, float min, float max)
{
    return min + (max - min) * hair_random(random);
}

static hair_vec3 anywhere(uint32_t* random, float reach)
{
    float x = between(random, -reach, reach), y = between(random, -reach, reach);
    return hair_v3(x, y, between(random, -reach, reach));
}

static hair_cut_desc shape_of(uint32_t* random, hair_cut_shape shape, float size)
{
    hair_cut_desc cut = hair_cut_desc_default();
    hair_vec3 at = anywhere(random, 1);
    cut.shape = shape;
    cut.radius = between(random, 0, size);
    hair_store3(cut.start, at);
    hair_store3(cut.end, hair_add(at, anywhere(random, size)));
    hair_store3(cut.last_start, hair_add(at, anywhere(random, size)));
    hair_store3(cut.last_end, hair_add(at, anywhere(random, size)));
    hair_store3(cut.normal, anywhere(random, 1));
    return cut;
}

// Return a place in a box.
static hair_vec3 inside(uint32_t* random, hair_vec3 lower, hair_vec3 upper)
{
    float x = between(random, lower.x, upper.x), y = between(random, lower.y, upper.y);
    return hair_v3(x, y, between(random, lower.z, upper.z));
}

static void a_shape_reaches_every_box_with_a_segment_that_it_meets(void** state)
{
    uint32_t random = 1;
    const double origin[3] = {0.3, -0.2, 0.1};
    (void)state;
    for (int shape = HAIR_CUT_SHAPE_PLANE; shape <= HAIR_CUT_SHAPE_BLADE; ++shape) {
        int met = 0, missed = 0;
        for (int i = 0; i < TRIES; ++i) {
            hair_cut_desc desc = shape_of(&random, (hair_cut_shape)shape, i % 2 ? 0.2f : 2);
            struct hair_cutter cutter = hair_cutter_from(&desc, origin);
            hair_vec3 lower = anywhere(&random, 1), size = anywhere(&random, i % 3 ? 0.3f : 2);
            hair_vec3 upper = hair_add(lower, hair_v3(fabsf(size.x), fabsf(size.y), fabsf(size.z)));
            hair_vec3 a = inside(&random, lower, upper), b = inside(&random, lower, upper);
            float t;
            bool meets = hair_cutter_meets(&cutter, a, b, &t),
                 reaches = hair_cutter_reaches(&cutter, lower, upper);
            if (meets) assert_true(reaches);
            met += meets, missed += !reaches;
        }
        print_message("    shape %d: %d segments are met, %d boxes are out of reach\n", shape, met, missed);
        assert_true(met > TRIES / 1000 && missed > TRIES / 10);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_shape_reaches_every_box_with_a_segment_that_it_meets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
