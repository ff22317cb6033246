// collider_grid_test.c - lists of colliders per cell: no collider in reach is missing, and no list
// is too long.
#include "tests/support/support.h"

#include <math.h>

#include "lib/collide/grid.h"
#include "lib/collide/distance.h"

#define MAX 3000

static struct hair_test_host test;
static struct hair_colliders colliders;
static struct hair_collider_grid grid;
static hair_collider given[MAX];
static uint32_t seed;

static const struct hair_pose before = {{10, -3, 2}, {0, 0, 0, 1}}, now = {{10.02, -3, 2.01}, {0, 0, 0, 1}};
static struct hair_collider_grid_desc usual = {0.6f, 0.03f, 0.001f, -0.3f, UINT32_MAX};

static int start(void** state)
{
    (void)state;
    hair_test_host_init(&test);
    seed = 1;
    return 0;
}

static int stop(void** state)
{
    (void)state;
    hair_collider_grid_free(&test.host, &grid);
    hair_colliders_free(&test.host, &colliders);
    return test.blocks != 0;
}

static float random_in(float min, float max)
{
    seed = seed * 1664525u + 1013904223u;
    return min + (max - min) * (float)(seed >> 8) / 16777216.0f;
}

static void move(hair_collider* collider, float way, float angle)
{
    hair_quat q = {collider->rotation[0], collider->rotation[1], collider->rotation[2],
                   collider->rotation[3]};
    hair_quat r = hair_quat_normalize(
        (hair_quat){random_in(-angle, angle), random_in(-angle, angle), random_in(-angle, angle), 2});
    q = hair_quat_normalize(hair_quat_multiply(r, q));
    collider->rotation[0] = q.x, collider->rotation[1] = q.y, collider->rotation[2] = q.z,
    collider->rotation[3] = q.w;
    for (int k = 0; k < 3; ++k) collider->position[k] += random_in(-way, way);
}

static void set(uint32_t count)
{
    assert_int_equal(hair_colliders_set(&test.host, &colliders, given, count, sizeof *given), HAIR_OK);
}

// Scatter moving and rotating colliders of every shape except collision meshes, of at most `size`.
static void scatter(uint32_t count, float size)
{
    for (uint32_t i = 0; i < count; ++i) {
        given[i] = hair_collider_default();
        given[i].shape = (hair_shape)(i % (i % 60 == 5 ? 6 : 5));
        for (int k = 0; k < 3; ++k) {
            given[i].size[k] = random_in(0.2f * size, size);
            given[i].position[k] = (float)before.position[k] + random_in(-0.5f, 0.5f);
        }
        given[i].rounding = random_in(0, 0.2f * size);
        move(&given[i], 0, 3);
    }
    set(count);
    hair_colliders_end_step(&colliders);
    for (uint32_t i = 0; i < count; ++i) move(&given[i], 0.05f, 0.3f);
    set(count);
}

static int fill(const struct hair_collider_grid_desc* desc)
{
    int changed = -1;
    assert_int_equal(hair_collider_grid_gather(&test.host, &grid, &colliders, &before, &now, desc), HAIR_OK);
    assert_int_equal(hair_collider_grid_build(&test.host, &grid, desc, &changed), HAIR_OK);
    return changed;
}

// Return the cell of a position, as the shader does.
static uint32_t cell_of(hair_vec3 place)
{
    const float at[] = {place.x - grid.lower.x, place.y - grid.lower.y, place.z - grid.lower.z};
    uint32_t i[3];
    for (int k = 0; k < 3; ++k) {
        float cell = fminf(fmaxf(at[k] * (1 / grid.size), 0), (float)grid.cells[k]);
        i[k] = (uint32_t)cell < grid.cells[k] - 1 ? (uint32_t)cell : grid.cells[k] - 1;
    }
    return i[0] + grid.cells[0] * (i[1] + grid.cells[1] * i[2]);
}

static int lists(uint32_t cell, uint32_t contact)
{
    for (uint32_t i = grid.entry[cell]; i < grid.entry[cell + 1]; ++i)
        if ((grid.entry[i] & HAIR_ENTRY_NUMBER) == contact) return 1;
    return 0;
}

static hair_vec4 mix(hair_vec4 a, hair_vec4 b, float t)
{
    return (hair_vec4){a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z),
                       a.w + t * (b.w - a.w)};
}

// Return the distance of a contact from a position relative to the head's origin, when
// `fraction` of the step is done.
static double distance_of(const struct hair_contact* contact, const hair_collider* collider, float fraction,
                          hair_vec3 place)
{
    const struct hair_contact_body* body = &contact->body;
    hair_vec4 at = mix(body->position[0], body->position[1], fraction);
    hair_vec4 r = mix(body->rotation[0], body->rotation[1], fraction);
    hair_quat turn = hair_quat_normalize((hair_quat){r.x, r.y, r.z, r.w});
    hair_vec3 p = hair_rotate(hair_quat_conjugate(turn), hair_sub(place, hair_v3(at.x, at.y, at.z)));
    const double own[] = {(double)p.x, (double)p.y, (double)p.z};
    return hair_distance_to_shape(collider->shape, collider->size, own, NULL) - (double)collider->rounding;
}

static void check(const struct hair_collider_grid_desc* desc, uint32_t places)
{
    uint32_t met = 0;
    for (uint32_t n = 0; n < places; ++n) {
        hair_vec3 place = hair_v3(random_in(-0.6f, 0.6f), random_in(-0.6f, 0.6f), random_in(-0.6f, 0.6f));
        uint32_t cell = cell_of(place);
        for (uint32_t i = 0; i < grid.contacts; ++i)
            for (int s = 0; s < 5; ++s) {
                float fraction = desc->fraction_start + (1 - desc->fraction_start) * (float)s / 4;
                if (distance_of(&grid.contact[i], &given[grid.collider[i]], fraction, place) >
                    (double)(desc->slack + desc->margin))
                    continue;
                ++met;
                if (!lists(cell, i)) fail_msg("collider %u is missing at place %u", grid.collider[i], n);
            }
    }
    print_message(
        "    %u of a step's moments of %u colliders met in %u x %u x %u cells, the longest list is %u\n", met,
        grid.contacts, grid.cells[0], grid.cells[1], grid.cells[2], grid.longest);
    assert_true(met > 100);
}

static void grid_lists_contain_every_reachable_collider(void** state)
{
    (void)state;
    for (int n = 0; n < 3; ++n) {
        scatter(n == 2 ? 40 : 12, n ? 0.03f : 0.2f);
        fill(&usual);
        assert_int_equal(grid.left_out, 0);
        check(&usual, 3000);
    }
    struct hair_collider_grid_desc anywhere = usual; // The reach of a free root.
    anywhere.reach = 1e4f;
    fill(&anywhere);
    check(&anywhere, 3000);
}

static void overlong_grid_list_keeps_the_nearest_in_order(void** state)
{
    (void)state;
    for (uint32_t i = 0; i < 500; ++i) {
        given[i] = hair_collider_default();
        given[i].position[0] = 10 + 0.0005f * (float)((i * 77) % 500);
        given[i].position[1] = -3;
        given[i].position[2] = 2;
        given[i].size[0] = 0.001f;
    }
    set(500);
    hair_colliders_end_step(&colliders);
    fill(&usual);
    assert_int_equal(grid.longest, HAIR_CELL_COLLIDERS);
    assert_true(grid.left_out > 0);
    for (uint32_t c = 0; c < grid.cells[0]; ++c)
        for (uint32_t i = grid.entry[c]; i + 1 < grid.entry[c + 1]; ++i)
            assert_true(grid.entry[i] < grid.entry[i + 1]);
    // Fewer colliders of this kind are kept, because they are tested one by one.
    for (uint32_t i = 0; i < 500; ++i) {
        given[i].shape = HAIR_SHAPE_BOX;
        for (int k = 0; k < 3; ++k) given[i].size[k] = 0.001f;
    }
    set(500);
    hair_colliders_end_step(&colliders);
    struct hair_collider_grid_desc few = usual;
    few.max_rounds = 250;
    fill(&few);
    assert_int_equal(grid.longest, 20);
}

static void grid_lists_are_rebuilt_only_after_motion(void** state)
{
    (void)state;
    scatter(100, 0.02f);
    assert_int_equal(fill(&usual), 1);
    struct hair_collider_grid_desc later = usual;
    later.fraction_start = -0.1f;
    assert_int_equal(fill(&usual), 0);
    // The collider moves, so the start time of its motion matters.
    assert_int_equal(fill(&later), 1);
    hair_colliders_end_step(&colliders);
    assert_int_equal(hair_collider_grid_gather(&test.host, &grid, &colliders, &now, &now, &later), HAIR_OK);
    int changed;
    assert_int_equal(hair_collider_grid_build(&test.host, &grid, &later, &changed), HAIR_OK);
    assert_int_equal(changed, 1);
    assert_int_equal(hair_collider_grid_gather(&test.host, &grid, &colliders, &now, &now, &usual), HAIR_OK);
    assert_int_equal(hair_collider_grid_build(&test.host, &grid, &usual, &changed), HAIR_OK);
    assert_int_equal(changed, 0); // The collider does not move.
    given[50].size[0] *= 1.5f;
    set(100);
    assert_int_equal(hair_collider_grid_gather(&test.host, &grid, &colliders, &now, &now, &usual), HAIR_OK);
    assert_int_equal(hair_collider_grid_build(&test.host, &grid, &usual, &changed), HAIR_OK);
    assert_int_equal(changed, 1);
}

static void grid_of_maximum_colliders_has_bounded_size(void** state)
{
    (void)state;
    for (uint32_t i = 0; i < MAX; ++i) {
        given[i] = hair_collider_default();
        given[i].shape = i % 2 ? HAIR_SHAPE_PLANE : HAIR_SHAPE_BOX;
        for (int k = 0; k < 3; ++k) given[i].size[k] = 1e6f, given[i].position[k] = i % 3 ? 0 : 1e9f;
    }
    set(MAX);
    hair_colliders_end_step(&colliders);
    fill(&usual);
    assert_true(grid.entries < (1u << 22));
    assert_true(grid.longest <= HAIR_CELL_COLLIDERS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(grid_lists_contain_every_reachable_collider, start, stop),
        cmocka_unit_test_setup_teardown(overlong_grid_list_keeps_the_nearest_in_order, start, stop),
        cmocka_unit_test_setup_teardown(grid_lists_are_rebuilt_only_after_motion, start, stop),
        cmocka_unit_test_setup_teardown(grid_of_maximum_colliders_has_bounded_size, start, stop),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
