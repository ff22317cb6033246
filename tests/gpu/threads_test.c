// threads_test.c - eight threads, each with an OpenGL context and a hair context of its own,
// simulate and draw the same hair at once, and get the same bits. `make test config=tsan
// filter=threads` looks for races between them.
#define _POSIX_C_SOURCE 200809L
#include "tests/support/support.h"

#include <pthread.h>
#include <stdio.h>
#include <string.h>

#include "lib/base/bytes.h"
#include "tests/support/heads.h"
#include "tests/support/tessellated.h"

#define THREADS 8
#define FRAMES 60
#define SIDE 64

struct thread {
    pthread_t id;
    uint32_t number; // kind of head
    struct hair_test_host host;
    hair_result result;
    uint64_t hash;
};

// Threads start together.
static pthread_barrier_t barrier;

static hair_result draw(const struct hair_test_head* head)
{
    static const float clear[5] = {0.2f, 0.2f, 0.2f, 1, 1};
    hair_view view = hair_test_tessellated();
    view.frame_index = head->steps;
    view.view[13] = -1.6f;
    view.projection[0] = view.projection[5] = 4, view.projection[10] = -0.5f;
    glClearBufferfv(GL_COLOR, 0, clear);
    glClearBufferfv(GL_DEPTH, 0, clear + 4);
    return hair_draw(head->hair, &view);
}

static hair_result run_frames(struct thread* thread, struct hair_test_head* head)
{
    unsigned char pixels[4 * SIDE * SIDE];
    GLuint framebuffer, textures[2];
    glCreateTextures(GL_TEXTURE_2D, 2, textures);
    glTextureStorage2D(textures[0], 1, GL_RGBA8, SIDE, SIDE);
    glTextureStorage2D(textures[1], 1, GL_DEPTH_COMPONENT32F, SIDE, SIDE);
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, textures[0], 0);
    glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, textures[1], 0);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, SIDE, SIDE);
    glEnable(GL_DEPTH_TEST);
    hair_result result = HAIR_OK;
    for (uint32_t i = 0; i < FRAMES && !result; ++i) {
        result = hair_test_head_step(head);
        if (!result) result = draw(head);
    }
    if (!result) result = hair_test_head_hash(head, &thread->hash);
    glReadPixels(0, 0, SIDE, SIDE, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    thread->hash = hair_hash_bytes(thread->hash, pixels, sizeof pixels);
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteTextures(2, textures);
    return result;
}

static void* run(void* user)
{
    struct thread* thread = user;
    struct hair_test_head_kind kinds[HAIR_TEST_HEADS];
    struct hair_test_head head = {0};
    hair_egl* egl = NULL;
    hair_context* context = NULL;
    hair_context_desc desc = hair_context_desc_default();
    hair_test_host_init(&thread->host);
    desc.host = &thread->host.host;
    desc.get_proc = hair_egl_get_proc;
    thread->result = hair_egl_create(&thread->host.host, -1, &egl);
    pthread_barrier_wait(&barrier);
    hair_result kinds_result = hair_test_head_kinds_make(&thread->host.host, kinds);
    if (!thread->result) thread->result = kinds_result;
    if (!thread->result) thread->result = hair_context_create(&desc, &context);
    if (!thread->result) thread->result = hair_test_head_create(context, kinds, thread->number, &head);
    if (!thread->result) thread->result = run_frames(thread, &head);
    hair_destroy(head.hair);
    hair_context_destroy(context);
    hair_egl_destroy(egl);
    hair_test_head_kinds_free(kinds);
    return NULL;
}

static void check_threads(uint32_t number)
{
    static struct thread threads[THREADS];
    memset(threads, 0, sizeof threads);
    assert_int_equal(pthread_barrier_init(&barrier, NULL, THREADS), 0);
    for (int i = 0; i < THREADS; ++i) {
        threads[i].number = number;
        assert_int_equal(pthread_create(&threads[i].id, NULL, run, &threads[i]), 0);
    }
    for (int i = 0; i < THREADS; ++i) pthread_join(threads[i].id, NULL);
    pthread_barrier_destroy(&barrier);
    for (int i = 0; i < THREADS; ++i) {
        if (threads[i].result) fail_msg("thread %d: %s", i, threads[i].host.sentence);
        assert_int_equal(threads[i].host.blocks, 0);
        assert_int_equal(threads[i].host.errors, 0);
        if (threads[i].hash != threads[0].hash) fail_msg("thread %d has other bits than thread 0", i);
    }
}

static void eight_contexts_of_straight_hair_give_equal_bits(void** state)
{
    (void)state;
    check_threads(0);
}

static void eight_contexts_among_colliders_give_equal_bits(void** state)
{
    (void)state;
    check_threads(5);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(eight_contexts_of_straight_hair_give_equal_bits),
        cmocka_unit_test(eight_contexts_among_colliders_give_equal_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
