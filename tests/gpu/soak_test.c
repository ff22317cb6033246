// soak_test.c - heads of hair that live, die and change in turn leave no memory and no OpenGL
// error, and live every life alike.
//
//   soak_test [STEPS]    `make soak steps=1000000` runs it for long.
#include "tests/support/support.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "lib/base/bytes.h"
#include "tests/support/heads.h"
#include "tests/support/tessellated.h"

#define LIFE 20 // Number of steps of a life.
#define PERIOD (LIFE * HAIR_TEST_HEADS)
#define MIN_WARM_UP (3 * PERIOD) // Steps until which memory may grow, or 1 % of all.
#define MAX_GROWTH 1024 // KiB
#define MAX_SIDE 160

static uint32_t wanted = 1000;
static uint32_t gl_errors;

static void APIENTRY count_error(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                                 const GLchar* message, const void* user)
{
    (void)source, (void)id, (void)severity, (void)length, (void)user;
    if (type != GL_DEBUG_TYPE_ERROR) return;
    fprintf(stderr, "%s\n", message);
    ++gl_errors;
}

static double now(void)
{
    struct timespec t;
    timespec_get(&t, TIME_UTC);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

// Return the resident memory of the process in KiB.
static long resident(void)
{
    long pages = 0;
    FILE* file = fopen("/proc/self/statm", "r");
    if (!file || fscanf(file, "%*d %ld", &pages) != 1) fail_msg("no /proc/self/statm");
    fclose(file);
    return pages * (sysconf(_SC_PAGESIZE) / 1024);
}

// A target that is made again whenever its side changes.
struct target {
    GLuint framebuffer, textures[2];
    GLsizei side;
};

static void free_target(struct target* target)
{
    glDeleteFramebuffers(1, &target->framebuffer);
    glDeleteTextures(2, target->textures);
    *target = (struct target){0};
}

static void resize(struct target* target, GLsizei side)
{
    if (target->side == side) return;
    free_target(target);
    target->side = side;
    glCreateTextures(GL_TEXTURE_2D, 2, target->textures);
    glTextureStorage2D(target->textures[0], 1, GL_RGBA8, side, side);
    glTextureStorage2D(target->textures[1], 1, GL_DEPTH_COMPONENT32F, side, side);
    glCreateFramebuffers(1, &target->framebuffer);
    glNamedFramebufferTexture(target->framebuffer, GL_COLOR_ATTACHMENT0, target->textures[0], 0);
    glNamedFramebufferTexture(target->framebuffer, GL_DEPTH_ATTACHMENT, target->textures[1], 0);
}

// Draw with a level of detail and a size that follow from the step. Continue the hash by the
// pixels.
static void draw(struct hair_test* test, const struct hair_test_head* head, struct target* target,
                 uint64_t* hash)
{
    static unsigned char pixels[4 * MAX_SIDE * MAX_SIDE];
    static const float clear[5] = {0.2f, 0.2f, 0.2f, 1, 1};
    uint32_t i = head->steps;
    hair_lod lod = hair_lod_default();
    hair_view view = hair_test_tessellated();
    resize(target, (GLsizei)(64 + 32 * (i / 5 % 4)));
    lod.strand_fraction = 1 - 0.2f * (float)(i % 4);
    lod.per_patch = i / 10 % 2;
    view.lod = &lod;
    view.frame_index = i;
    view.view[13] = -1.6f;
    view.projection[0] = view.projection[5] = 4, view.projection[10] = -0.5f;
    glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
    glViewport(0, 0, target->side, target->side);
    glEnable(GL_DEPTH_TEST);
    glClearBufferfv(GL_COLOR, 0, clear);
    glClearBufferfv(GL_DEPTH, 0, clear + 4);
    hair_test_ok(test, hair_draw(head->hair, &view));
    glReadPixels(0, 0, target->side, target->side, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    *hash = hair_hash_bytes(*hash, pixels, 4 * (size_t)target->side * (size_t)target->side);
}

static void set_wind(struct hair_test* test, const struct hair_test_head* head, bool blows)
{
    hair_wind wind = hair_wind_default();
    wind.velocity[0] = 2;
    if (strcmp(head->kind->name, "wind fluid") != 0)
        hair_test_ok(test, hair_set_wind(head->hair, blows ? &wind : NULL));
}

// Live the life of a head from its creation to its end. Return a hash of all that it was.
static uint64_t live(struct hair_test* test, const struct hair_test_head_kind* kinds, uint32_t number,
                     struct target* target)
{
    uint64_t hash = HAIR_HASH_BEGIN, state;
    struct hair_test_head head;
    hair_collider ball = hair_collider_default();
    ball.position[1] = 1.5f, ball.size[0] = 0.08f;
    hair_test_ok(test, hair_test_head_create(test->context, kinds, number, &head));
    for (uint32_t i = 0; i < LIFE; ++i) {
        if (i == 5 || i == 15) set_wind(test, &head, i == 5);
        if (i % 6 == 3) hair_test_ok(test, hair_set_colliders(head.hair, &ball, i % 12 == 3, sizeof ball));
        if (i == 12) hair_test_ok(test, hair_test_head_renew(&head, test->context, kinds));
        hair_test_ok(test, hair_test_head_step(&head));
        if (i % 5 == 4) draw(test, &head, target, &hash);
    }
    hair_test_ok(test, hair_test_head_hash(&head, &state));
    hair_destroy(head.hair);
    return hair_hash_bytes(hash, &state, sizeof state);
}

static uint64_t gl_bytes(struct hair_test* test)
{
    hair_memory memory = hair_memory_default();
    hair_test_ok(test, hair_get_memory(test->context, &memory));
    return memory.bytes;
}

static void lives_in_turn_stay_alike_and_leave_nothing(void** state)
{
    struct hair_test* test = *state;
    static struct hair_test_head_kind kinds[HAIR_TEST_HEADS];
    struct target target = {0};
    uint64_t first[HAIR_TEST_HEADS], base_gl = 0;
    size_t base_host = 0;
    uint32_t steps = 0, warm_up = wanted / 100 > MIN_WARM_UP ? wanted / 100 : MIN_WARM_UP;
    long base = 0;
    double start = now();
    glDebugMessageCallback(count_error, NULL);
    hair_test_ok(test, hair_test_head_kinds_make(&test->host.host, kinds));
    for (uint32_t period = 0; steps < wanted; ++period) {
        for (uint32_t i = 0; i < HAIR_TEST_HEADS; ++i, steps += LIFE) {
            uint64_t hash = live(test, kinds, i, &target);
            if (!period) first[i] = hash;
            if (hash != first[i])
                fail_msg("%s: life %u has the hash %016" PRIx64 ", not %016" PRIx64, kinds[i].name, period,
                         hash, first[i]);
        }
        if (!period) base_gl = gl_bytes(test), base_host = test->host.live;
        if (gl_bytes(test) != base_gl)
            fail_msg("%" PRIu64 " bytes of OpenGL after life %u, not %" PRIu64, gl_bytes(test), period,
                     base_gl);
        if (test->host.live != base_host)
            fail_msg("%zu bytes of the host after life %u, not %zu", test->host.live, period, base_host);
        if (gl_errors || test->host.errors) fail_msg("errors in life %u: %s", period, test->host.sentence);
        if (steps <= warm_up) base = resident();
        if (period % 50 == 49)
            print_message("%u steps, %.0f a second, %ld KiB more\n", steps, steps / (now() - start),
                          resident() - base);
    }
    long growth = resident() - base;
    print_message("%u steps, %.0f a second, %ld KiB more after %u steps\n", steps, steps / (now() - start),
                  growth, warm_up);
#ifndef __SANITIZE_ADDRESS__ // The sanitizer keeps freed memory.
    // Zink keeps memory for later. It rises and falls by 20 MiB between lives.
    bool is_zink = strncmp((const char*)glGetString(GL_RENDERER), "zink", 4) == 0;
    assert_true(growth <= MAX_GROWTH || is_zink);
#endif
    free_target(&target);
    hair_test_head_kinds_free(kinds);
}

int main(int count, char** arguments)
{
    if (hair_test_skips()) return 0;
    if (getenv("HAIR_TEST_FULL")) wanted = 10000;
    if (count > 1) wanted = (uint32_t)strtoul(arguments[1], NULL, 10);
    const struct CMUnitTest tests[] = {HAIR_TEST(lives_in_turn_stay_alike_and_leave_nothing)};
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
