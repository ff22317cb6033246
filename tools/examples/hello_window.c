// hello_window.c - A head of hair that turns to and fro in a window of SDL.
//
//     hello_window [FRAMES FILE.ppm]
//
// The program runs until the window is closed. With arguments the window is hidden, and the program
// simulates FRAMES of 1/60 s and writes the last one.
#include "bust.h"
#include "camera.h"
#include <SDL.h>

// The caller of the library decides where OpenGL functions come from.
static void* get_proc(const char* name, void* user)
{
    (void)user;
    return SDL_GL_GetProcAddress(name);
}

static SDL_Window* open_window(int width, int height, int hidden)
{
    if (SDL_Init(SDL_INIT_VIDEO)) fail(SDL_GetError());
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, SDL_GL_CONTEXT_PROFILE_CORE);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 4);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, 5);
    SDL_GL_SetAttribute(SDL_GL_DEPTH_SIZE, 24);
    SDL_GL_SetAttribute(SDL_GL_FRAMEBUFFER_SRGB_CAPABLE, 1);
    Uint32 flags = SDL_WINDOW_OPENGL | SDL_WINDOW_RESIZABLE | (hidden ? SDL_WINDOW_HIDDEN : 0u);
    SDL_Window* window = SDL_CreateWindow("hair", 0, 0, width, height, flags);
    if (!window || !SDL_GL_CreateContext(window)) fail(SDL_GetError());
    SDL_GL_SetSwapInterval(1);
    return window;
}

static hair_instance* make_hair(hair_context* context)
{
    hair_instance* hair;
    hair_groom* groom = make_groom(HAIR_STYLE_LONG, 6000);
    hair_look look = hair_look_default();
    look.strand.radius = 3e-4f; // 6000 strands stand for 100000.
    look.self_shadow.method = HAIR_SELF_SHADOW_STRANDS; // Strands shade strands, without a map.
    hair_desc desc = hair_desc_default();
    desc.look = &look;
    check(hair_create(context, groom, &desc, &hair));
    hair_groom_destroy(groom);
    return hair;
}

// Turn the head and its colliders, then advance the hair.
static void step(hair_instance* hair, float time, float dt, float transform[16])
{
    hair_collider colliders[BUST_COLLIDERS];
    float angle = 0.8f * sinf(4 * time), s = sinf(angle), c = cosf(angle);
    const float turned[16] = {c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, 0, 0, 0, 1};
    memcpy(transform, turned, sizeof turned);
    bust_colliders(transform, colliders);
    check(hair_set_transform(hair, transform));
    check(hair_set_colliders(hair, colliders, BUST_COLLIDERS, sizeof *colliders));
    check(hair_step(hair, dt));
}

static void draw(hair_instance* hair, const struct bust* bust, const float transform[16], int width,
                 int height)
{
    const float eye[3] = {0.35f, 1.60f, 1.25f}, target[3] = {0, 1.54f, 0};
    struct camera camera = camera_perspective(eye, target, 0.36f, (float)width / (float)height);
    glViewport(0, 0, width, height);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    bust_draw(bust, bust->program, transform, camera.clip);
    hair_view view = hair_view_default();
    memcpy(view.view, camera.view, sizeof view.view);
    memcpy(view.projection, camera.projection, sizeof view.projection);
    view.coverage = HAIR_COVERAGE_ALPHA; // Smooth edges without multisampling.
    check(hair_draw(hair, &view));
}

static int wants_to_quit(void)
{
    SDL_Event event;
    while (SDL_PollEvent(&event))
        if (event.type == SDL_QUIT) return 1;
    return 0;
}

int main(int argc, char** argv)
{
    const char* out = argc > 2 ? argv[2] : NULL;
    long frames = out ? strtol(argv[1], NULL, 10) : 0;
    int width, height;
    SDL_Window* window = open_window(out ? 256 : 800, out ? 192 : 600, out != NULL);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_FRAMEBUFFER_SRGB); // Linear colours become those of the window.
    glClearColor(0.16f, 0.19f, 0.24f, 1);

    hair_context* context;
    hair_host host = {NULL, NULL, print_sentence, NULL};
    hair_context_desc context_desc = hair_context_desc_default();
    context_desc.host = &host;
    context_desc.get_proc = get_proc;
    check(hair_context_create(&context_desc, &context));
    hair_instance* hair = make_hair(context);
    struct bust bust = bust_create();

    float time = out ? 0 : (float)SDL_GetTicks64() / 1000, transform[16];
    for (long frame = 0; out ? frame < frames : !wants_to_quit(); ++frame) {
        float now = out ? (float)(frame + 1) / 60 : (float)SDL_GetTicks64() / 1000;
        step(hair, now, fminf(now - time, 0.1f), transform);
        time = now;
        if (out && frame < frames - 1) continue;
        SDL_GL_GetDrawableSize(window, &width, &height);
        draw(hair, &bust, transform, width, height);
        if (out) write_ppm(out, width, height);
        SDL_GL_SwapWindow(window);
    }
    bust_destroy(&bust);
    hair_destroy(hair);
    hair_context_destroy(context);
    SDL_Quit();
    return EXIT_SUCCESS;
}
