// many_heads.c - One groom on eight heads. Print the time and the memory of one head by stage.
//
//     many_heads [FILE.ppm [WIDTH]]
#include "bust.h"
#include "camera.h"
#include <hair/hair_egl.h>

enum { HEADS = 8, ROWS = 64 };

struct head {
    hair_instance* hair;
    float transform[16];
};

// Place a head in one of two rows. Every head has a colour and a look of its own.
static void make_head(struct head* head, int i, hair_context* context, const hair_groom* groom)
{
    float angle = 1.2f * sinf(2.5f * (float)i), s = sinf(angle), c = cosf(angle);
    float x = 0.48f * ((float)(i % 4) - 1.5f), y = 0.38f * (float)(i / 4), z = -0.4f * (float)(i / 4);
    const float transform[16] = {c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, x, y, z, 1};
    memcpy(head->transform, transform, sizeof transform);

    hair_look look = hair_look_default();
    check(hair_look_apply_preset(&look, i % 3 == 0 ? HAIR_LOOK_STRAIGHT : HAIR_LOOK_NATURAL));
    check(hair_look_color(&look, (hair_color)(i % HAIR_COLOR_COUNT)));
    look.strand.radius = 4e-4f; // 3000 strands stand for 100000.
    look.strand.segments = 16;
    hair_desc desc = hair_desc_default();
    desc.look = &look;
    memcpy(desc.transform, transform, sizeof transform);
    check(hair_create(context, groom, &desc, &head->hair));

    hair_collider colliders[BUST_COLLIDERS];
    bust_colliders(transform, colliders);
    check(hair_set_colliders(head->hair, colliders, BUST_COLLIDERS, sizeof *colliders));
}

static void print_report(hair_instance* hair, const hair_context* context)
{
    hair_report_info info = hair_report_info_default();
    hair_report_row rows[ROWS];
    uint32_t count;
    check(hair_report(hair, true, &info, rows, sizeof *rows, ROWS, &count));
    printf("%-20s %10s %10s\n", "stage", "ms", "KiB");
    for (uint32_t i = 0; i < count && i < ROWS; ++i)
        if (rows[i].runs || rows[i].bytes)
            printf("%-20s %10.3f %10.1f\n", rows[i].stage, (double)rows[i].ms, (double)rows[i].bytes / 1024);
    hair_memory memory = hair_memory_default();
    check(hair_get_memory(context, &memory));
    printf("one head: %.3f ms, %.1f KiB. All heads together: %.1f KiB.\n", (double)info.ms,
           (double)info.bytes / 1024, (double)memory.bytes / 1024);
}

int main(int argc, char** argv)
{
    hair_egl* egl;
    hair_context* context;
    hair_host host = {NULL, NULL, print_sentence, NULL};
    check(hair_egl_create(&host, -1, &egl));
    hair_context_desc context_desc = hair_context_desc_default();
    context_desc.host = &host;
    context_desc.get_proc = hair_egl_get_proc;
    context_desc.timings = true;
    check(hair_context_create(&context_desc, &context));

    struct head heads[HEADS];
    hair_groom* groom = make_groom(HAIR_STYLE_BOB, 3000);
    for (int i = 0; i < HEADS; ++i) make_head(&heads[i], i, context, groom);
    hair_groom_destroy(groom);
    for (int frame = 0; frame < 4; ++frame)
        for (int i = 0; i < HEADS; ++i) check(hair_step(heads[i].hair, 1.0f / 60));

    const float eye[3] = {0, 1.9f, 3.5f}, target[3] = {0, 1.70f, -0.2f};
    struct camera camera = camera_perspective(eye, target, 0.37f, 4.0f / 3);
    struct bust bust = bust_create();
    struct picture picture = picture_begin(argc > 2 ? (int)strtol(argv[2], NULL, 10) : 800);
    hair_lod lod = hair_lod_default();
    hair_view view = hair_view_default();
    memcpy(view.view, camera.view, sizeof view.view);
    memcpy(view.projection, camera.projection, sizeof view.projection);
    view.lod = &lod;
    for (int i = 0; i < HEADS; ++i) bust_draw(&bust, bust.program, heads[i].transform, camera.clip);
    for (int i = 0; i < HEADS; ++i) check(hair_draw(heads[i].hair, &view));
    picture_end(&picture, argc > 1 ? argv[1] : "many_heads.ppm");
    print_report(heads[0].hair, context);

    bust_destroy(&bust);
    for (int i = 0; i < HEADS; ++i) hair_destroy(heads[i].hair);
    hair_context_destroy(context);
    hair_egl_destroy(egl);
    return EXIT_SUCCESS;
}
