// sdl_test.c - a host program with SDL2 draws the same pixels after hair as before, in contexts of
// many kinds, and hair has its place in depth and the right brightness.
//
// The host sets its state once. It draws a wall behind the hair and a triangle in front of the left
// half.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <epoxy/gl.h>
#include <hair/hair.h>
#include <hair/hair_asset.h>
#include <SDL.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/hosts/host_scene.h"

struct window {
    SDL_Window* window;
    SDL_GLContext gl;
};

static struct window open_window(enum host_kind kind)
{
    struct window out;
    SDL_SetHint(SDL_HINT_VIDEODRIVER, "offscreen");
    SDL_GL_ResetAttributes();
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, kind == HOST_COMPATIBILITY
                                                         ? SDL_GL_CONTEXT_PROFILE_COMPATIBILITY
                                                         : SDL_GL_CONTEXT_PROFILE_CORE);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 4);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, 5);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_FLAGS, kind == HOST_CORE ? 0 : SDL_GL_CONTEXT_DEBUG_FLAG);
    SDL_GL_SetAttribute(SDL_GL_DEPTH_SIZE, 24);
    SDL_GL_SetAttribute(SDL_GL_FRAMEBUFFER_SRGB_CAPABLE, 1);
    if (SDL_Init(SDL_INIT_VIDEO)) fail_msg("%s", SDL_GetError());
    out.window = SDL_CreateWindow("host", 0, 0, HOST_SIZE, HOST_SIZE, SDL_WINDOW_OPENGL | SDL_WINDOW_HIDDEN);
    out.gl = out.window ? SDL_GL_CreateContext(out.window) : NULL;
    if (!out.gl) fail_msg("%s", SDL_GetError());
    return out;
}

static void close_window(struct window window)
{
    SDL_GL_DeleteContext(window.gl);
    SDL_DestroyWindow(window.window);
    SDL_Quit();
}

static void* get_proc(const char* name, void* user)
{
    (void)user;
    return SDL_GL_GetProcAddress(name);
}

// Count the errors of the library's log. A warning is one too, because the hair is the default.
static void count_sentence(hair_log_level level, const char* sentence, void* user)
{
    if (level == HAIR_LOG_INFO) return;
    print_message("%s\n", sentence);
    ++*(unsigned*)user;
}

struct guest {
    hair_host host;
    hair_context* context;
    hair_instance* hair;
    unsigned sentences;
};

static void start_hair(struct guest* guest)
{
    hair_asset* asset;
    hair_groom* groom;
    *guest = (struct guest){.host = {.log = count_sentence, .user = &guest->sentences}};
    hair_context_desc context = hair_context_desc_default();
    hair_style_desc style = hair_style_desc_default();
    hair_groom_desc groom_desc = hair_groom_desc_default();
    hair_look look = hair_look_default();
    hair_desc desc = hair_desc_default();
    context.host = groom_desc.host = &guest->host;
    context.get_proc = get_proc;
    look.strand.radius = 4e-4f;
    desc.look = &look;
    assert_int_equal(hair_context_create(&context, &guest->context), HAIR_OK);
    assert_int_equal(hair_asset_generate(&style, &asset), HAIR_OK);
    assert_int_equal(hair_asset_to_groom_desc(asset, &groom_desc), HAIR_OK);
    groom_desc.follower_count = 4000;
    assert_int_equal(hair_groom_create(&groom_desc, &groom), HAIR_OK);
    assert_int_equal(hair_create(guest->context, groom, &desc, &guest->hair), HAIR_OK);
    hair_groom_destroy(groom);
    hair_asset_destroy(asset);
}

// Return the number of pixels that differ in the columns from `first` up to, not including, `end`.
static unsigned count_changes(const struct host_pixels* a, const struct host_pixels* b, int first, int end)
{
    unsigned out = 0;
    for (int y = 0; y < HOST_SIZE; ++y)
        for (int x = first; x < end; ++x) out += memcmp(a->rgba[y][x], b->rgba[y][x], 4) != 0;
    return out;
}

// Draw without hair, with hair, and without hair again. Return the pixels with hair.
static struct host_pixels draw_beside_hair(enum host_kind kind)
{
    static struct host_pixels before, with, after;
    struct window window = open_window(kind);
    struct host_scene scene = host_scene_start(kind);
    struct guest guest;
    host_scene_draw(&scene, &before);
    start_hair(&guest);
    hair_view view = hair_view_default();
    memcpy(view.view, scene.view, sizeof view.view);
    memcpy(view.projection, scene.projection, sizeof view.projection);
    for (int i = 0; i < 3; ++i) {
        assert_int_equal(hair_step(guest.hair, 1.0f / 60), HAIR_OK);
        host_scene_draw(&scene, NULL);
        assert_int_equal(hair_draw(guest.hair, &view), HAIR_OK);
        host_read(&scene, &with);
    }
    host_scene_draw(&scene, &after);
    assert_int_equal(count_changes(&before, &after, 0, HOST_SIZE), 0);
    assert_int_equal(count_changes(&before, &with, 0, HOST_SIZE / 2 - 1), 0);
    assert_true(count_changes(&before, &with, HOST_SIZE / 2 + 1, HOST_SIZE) > HOST_SIZE * HOST_SIZE / 20);
    hair_destroy(guest.hair);
    hair_context_destroy(guest.context);
    host_scene_draw(&scene, &after);
    assert_int_equal(count_changes(&before, &after, 0, HOST_SIZE), 0);
    assert_int_equal(guest.sentences, 0);
    host_scene_stop(&scene); // Fails for errors and for messages of the debug context.
    close_window(window);
    return with;
}

static void pixels_of_the_host_stay_in_every_kind_of_context(void** state)
{
    (void)state;
    const enum host_kind kinds[] = {HOST_COMPATIBILITY, HOST_REVERSED_DEPTH, HOST_ODD_STATE};
    for (int i = 0; i < 3; ++i) {
        print_message("%s\n", host_kind_names[kinds[i]]);
        draw_beside_hair(kinds[i]);
    }
}

static void samples_smooth_the_edges_of_hair(void** state)
{
    (void)state;
    struct host_pixels plain = draw_beside_hair(HOST_DEBUG), smooth = draw_beside_hair(HOST_MSAA);
    assert_int_equal(count_changes(&plain, &smooth, 0, HOST_SIZE / 2 - 1), 0);
    assert_true(count_changes(&plain, &smooth, HOST_SIZE / 2 + 1, HOST_SIZE) > HOST_SIZE * HOST_SIZE / 50);
}

static void srgb_framebuffer_gets_encoded_brightness(void** state)
{
    (void)state;
    struct host_pixels linear = draw_beside_hair(HOST_CORE), encoded = draw_beside_hair(HOST_SRGB);
    unsigned wrong = 0, bright = 0;
    for (int y = 0; y < HOST_SIZE; ++y)
        for (int x = 0; x < HOST_SIZE; ++x)
            for (int c = 0; c < 3; ++c) {
                double low = host_encode((linear.rgba[y][x][c] - 0.51) / 255) * 255;
                double high = host_encode((linear.rgba[y][x][c] + 0.51) / 255) * 255;
                wrong += encoded.rgba[y][x][c] < low - 1 || encoded.rgba[y][x][c] > high + 1;
                bright += encoded.rgba[y][x][c] > linear.rgba[y][x][c] + 20;
            }
    assert_int_equal(wrong, 0);
    assert_true(bright > HOST_SIZE * HOST_SIZE / 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pixels_of_the_host_stay_in_every_kind_of_context),
        cmocka_unit_test(samples_smooth_the_edges_of_hair),
        cmocka_unit_test(srgb_framebuffer_gets_encoded_brightness),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
