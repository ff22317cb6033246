// accuracy_motion.c - Motions of the suite `accuracy`.
#include "tools/bench/accuracy.h"
#include "tools/bench/coil.h"

#include <math.h>

#define LENGTH 0.3 // length of straight strands and of the wave, m

static struct bench_scene make_scene(const struct bench* bench, uint32_t vertices, double clamp)
{
    struct bench_scene scene = bench_scene_default();
    const double root[3] = {0.1, 0, 0}; // on a head of this radius
    const double along[3] = {cos(clamp), sin(clamp), 0};
    bench_scene_straight(&scene, vertices, LENGTH, root, along);
    scene.strands = bench->options.strands;
    if (!scene.strands) scene.strands = bench->options.quick ? 64 : 1000;
    scene.mapping = bench->options.mapping;
    return scene;
}

// The head yaws by 0.6 sin^2(pi t) rad. The strand is released straight and falls.
void bench_make_shake(const struct bench* bench, uint32_t vertices, struct bench_motion* out)
{
    *out = (struct bench_motion){
        .name = "shake", .length = LENGTH, .frames = BENCH_MOTION_FRAMES, .moves = true, .runs = 1};
    out->scene = make_scene(bench, vertices, -BENCH_PI / 6);
    hair_physics* p = &out->scene.physics;
    p->damping = 1;
    p->fiber.youngs_modulus = 3e9f; // E R^2 / (4 rho) is 1.442308e-3 m^4/s^2.
    p->fiber.radius = 5e-5f;
    p->fiber.density = 1300;
    const double up[3] = {0, 1, 0}, none[3] = {0, 0, 0};
    for (uint32_t k = 0; k < out->frames; ++k) {
        double sine = sin(BENCH_PI * (k + 1) * BENCH_MOTION_FRAME);
        out->heads[k] = bench_pose(up, 0.6 * sine * sine, none);
    }
}

// Positions and radii of shoulders. The error of one strand can be half larger or half smaller by
// chance, therefore there are several shoulders. Shoulders over which the strand can fall to either
// side are excluded, because the reference itself does not converge there. The reference differs
// from half as many substeps by less than 1e-4 of the length for each shoulder. The difference is
// 2e-3 and 6e-4 if the first shoulder is 2 cm farther out or in. The difference is 6e-4 for 2 cm
// out and up, and 3e-3 for a radius of 0.25 with the same top.
static const struct bench_place shoulders[] = {
    {0.2f, -0.45f, 0.2f},  {0.2f, -0.43f, 0.2f},  {0.2f, -0.47f, 0.2f},  {0.24f, -0.45f, 0.2f},
    {0.16f, -0.45f, 0.2f}, {0.18f, -0.43f, 0.2f}, {0.22f, -0.47f, 0.2f}, {0.18f, -0.47f, 0.2f},
    {0.2f, -0.35f, 0.1f},  {0.22f, -0.35f, 0.1f},
};

static void set_places(struct bench_motion* motion, const struct bench_place* places, uint32_t count)
{
    motion->places = places;
    motion->runs = count;
    bench_set_place(motion, 0);
}

void bench_set_place(struct bench_motion* motion, uint32_t run)
{
    const struct bench_place* place = &motion->places[run];
    hair_collider* last = &motion->colliders[motion->collider_count - 1];
    last->position[0] = place->x;
    last->position[1] = place->y;
    last->size[0] = place->radius;
}

static hair_collider make_level_capsule(void)
{
    hair_collider capsule = hair_collider_default();
    capsule.shape = HAIR_SHAPE_CAPSULE;
    capsule.rotation[0] = capsule.rotation[3] = (float)sqrt(0.5); // The axis is along z.
    capsule.size[1] = 0.12f;
    return capsule;
}

// The head is a sphere, and the strand falls on a shoulder and is drawn over it. Other colliders
// make any two runs diverge. The tip strikes an upright collider like a whip, and over a ridge
// along the strand it can fall to either side.
void bench_make_contact(const struct bench* bench, uint32_t vertices, struct bench_motion* out)
{
    bench_make_shake(bench, vertices, out);
    out->name = "contact";
    out->fine_substeps = 512;
    out->colliders[0] = hair_collider_default();
    out->colliders[0].size[0] = 0.095f;
    out->colliders[1] = make_level_capsule();
    out->collider_count = 2;
    set_places(out, shoulders, sizeof shoulders / sizeof *shoulders);
}

// Make a chain without bending stiffness that is released horizontally. The whip at 0.25 s
// distinguishes solvers.
void bench_make_swing(const struct bench* bench, uint32_t vertices, struct bench_motion* out)
{
    *out = (struct bench_motion){.name = "swing", .length = LENGTH, .frames = 24, .runs = 1};
    out->scene = make_scene(bench, vertices, 0);
    out->scene.physics.fiber.youngs_modulus = 0;
    out->scene.physics.redblack.bend = 0;
}

// Make a level strand with bending stiffness and without damping that is released.
void bench_make_whip(const struct bench* bench, uint32_t vertices, struct bench_motion* out)
{
    *out = (struct bench_motion){.name = "whip", .length = LENGTH, .runs = 1};
    out->frames = BENCH_MOTION_FRAMES;
    out->scene = make_scene(bench, vertices, 0);
}

// The head turns at a rate that grows to 3 Hz after a second.
void bench_make_taut(const struct bench* bench, uint32_t vertices, struct bench_motion* out)
{
    const double up[3] = {0, 1, 0}, none[3] = {0, 0, 0};
    *out = (struct bench_motion){.name = "taut", .length = LENGTH, .moves = true, .runs = 1};
    out->frames = BENCH_MOTION_FRAMES;
    out->scene = make_scene(bench, vertices, 0);
    out->scene.physics.damping = 4;
    for (uint32_t k = 0; k < out->frames; ++k) {
        double time = (k + 1) * BENCH_MOTION_FRAME;
        out->heads[k] = bench_pose(up, 2 * BENCH_PI * 3 * time * time / 2, none);
    }
}

// Curved at rest ----------------------------------------------------------------------------------

static void set_curved(struct bench_motion* out)
{
    hair_physics* p = &out->scene.physics;
    p->damping = 4;
    p->gravity[0] = (float)(BENCH_GRAVITY * sin(BENCH_PI / 6));
    p->gravity[1] = (float)(-BENCH_GRAVITY * cos(BENCH_PI / 6));
    out->length = bench_scene_length(&out->scene);
    out->frames = BENCH_MOTION_FRAMES;
    out->runs = 1;
}

// Make three waves of 20 mm in a plane. The angle to the axis is a cosine of the arc length.
void bench_make_wave(const struct bench* bench, struct bench_motion* out)
{
    enum { VERTICES = 48, WAVES = 3 };
    const double steepest = 1.2, piece = LENGTH / (VERTICES - 1); // rad, m
    *out = (struct bench_motion){.name = "wave", .scene = make_scene(bench, VERTICES, 0)};
    double at[2] = {0, 0};
    for (int i = 0; i < VERTICES; ++i) {
        double angle = steepest * cos(2 * BENCH_PI * WAVES * (i + 0.5) / (VERTICES - 1));
        out->scene.positions[3 * i] = (float)at[0];
        out->scene.positions[3 * i + 1] = (float)at[1];
        at[0] += piece * sin(angle);
        at[1] -= piece * cos(angle);
    }
    set_curved(out);
}

static void make_helix(const struct bench* bench, const char* name, const struct bench_coil* coil,
                       struct bench_motion* out)
{
    *out = (struct bench_motion){.name = name, .scene = make_scene(bench, coil->vertices, 0)};
    bench_scene_coil(&out->scene, coil);
    set_curved(out);
}

void bench_make_curl(const struct bench* bench, struct bench_motion* out)
{
    const struct bench_coil coil = {.radius = 0.012, .pitch = 0.05, .turns = 5, .vertices = 64};
    make_helix(bench, "curl", &coil, out);
}

void bench_make_curl_contact(const struct bench* bench, struct bench_motion* out)
{
    static const struct bench_place bars[] = {
        {0.06f, -0.12f, 0.03f}, {0.07f, -0.12f, 0.03f}, {0.06f, -0.15f, 0.03f}, {0.08f, -0.18f, 0.04f}};
    bench_make_curl(bench, out);
    out->name = "curl contact";
    // With 256 and more, single precision does not resolve the twist between held vertices.
    out->fine_substeps = 128;
    out->colliders[0] = make_level_capsule();
    out->collider_count = 1;
    set_places(out, bars, sizeof bars / sizeof *bars);
}

void bench_make_coil(const struct bench* bench, struct bench_motion* out)
{
    const struct bench_coil coil = {.radius = 0.004, .pitch = 0.016, .turns = 5, .vertices = 61};
    make_helix(bench, "coil", &coil, out);
}
