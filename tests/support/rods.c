#include "tests/support/rods.h"

#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>

#include "lib/base/math.h"

#define MAX HAIR_MAX_GUIDE_VERTICES

void hair_test_rod_place(struct hair_test_rod* f, uint32_t count, const float* p)
{
    f->guide = (struct hair_guide){.count = count};
    hair_quat at = {0, 0, 0, 1};
    hair_vec3 was = {0, 1, 0};
    for (uint32_t i = 0; i < count; ++i) {
        float length = 0;
        if (i + 1 < count) {
            hair_vec3 link = hair_sub(hair_load3(p + 3 * i + 3), hair_load3(p + 3 * i));
            hair_vec3 to = hair_normalize(link, was);
            length = hair_length(link);
            at = hair_quat_normalize(hair_quat_multiply(hair_quat_between(was, to), at));
            was = to;
        }
        f->rest[i].position = (hair_vec4){p[3 * i], p[3 * i + 1], p[3 * i + 2], length};
        f->rest[i].frame = (hair_vec4){at.x, at.y, at.z, at.w};
        if (i == 0) f->guide.root_frame = f->rest[0].frame;
        f->guide.arc_length += length;
    }
}

void hair_test_rod_straight(struct hair_test_rod* f, uint32_t count, double length, double angle)
{
    float p[3 * MAX];
    for (uint32_t i = 0; i < count; ++i) {
        double s = length * i / (count - 1);
        p[3 * i] = (float)(s * sin(angle));
        p[3 * i + 1] = (float)(-s * cos(angle));
        p[3 * i + 2] = 0;
    }
    hair_test_rod_place(f, count, p);
}

void hair_test_rod_curl(struct hair_test_rod* f, uint32_t count, double segment)
{
    float p[3 * MAX];
    for (uint32_t i = 0; i < count; ++i) {
        double t = i + 0.2 * sin(5.0 * i);
        p[3 * i] = (float)(segment * (0.8 * t + cos(0.7 * t)));
        p[3 * i + 1] = (float)(segment * 0.4 * t);
        p[3 * i + 2] = (float)(segment * sin(0.7 * t));
    }
    hair_test_rod_place(f, count, p);
}

struct hair_test_rod* hair_test_rod_make(void)
{
    struct hair_test_rod* f = calloc(1, sizeof *f);
    f->physics = hair_physics_default();
    f->physics.fiber.youngs_modulus = 3e9f;
    f->physics.fiber.radius = 5e-5f;
    return f;
}

double hair_test_rod_bend(const hair_physics* p)
{
    double r = (double)p->fiber.radius;
    return (double)p->fiber.youngs_modulus * r * r / (4 * (double)p->fiber.density);
}

void hair_test_rod_hold(struct hair_test_rod* f)
{
    hair_result result =
        hair_rods_preload_gravity(NULL, &f->guide, f->rest, 1, &f->physics, f->borne, &f->report);
    assert_int_equal(result, HAIR_OK);
}

void hair_test_rod_write(struct hair_test_rod* f, hair_solver solver, double substep)
{
    hair_test_rod_hold(f);
    hair_rods_write(&f->guide, f->rest, f->borne, &f->physics, solver, 0, substep, f->rod);
}

bool hair_test_rod_is_mixed(struct hair_test_rod* f, hair_solver solver, bool is_held, double substep)
{
    hair_test_rod_hold(f);
    return hair_rods_are_mixed(&f->guide, f->rest, f->borne, 1, &f->physics, solver, is_held, substep);
}

double hair_test_rod_substep(struct hair_test_rod* f, hair_solver solver)
{
    hair_test_rod_hold(f);
    return hair_rods_substep(&f->guide, f->rest, f->borne, 1, &f->physics, solver, 0);
}
