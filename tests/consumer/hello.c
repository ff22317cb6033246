// One strand, simulated for a second without a window.
#include <hair/hair.h>
#include <hair/hair_egl.h>
#include <stdio.h>

int main(void)
{
    static const float strand[] = {0, 1.7f, 0, 0.1f, 1.73f, 0, 0.2f, 1.72f, 0}; // xyz, root first, metres
    static const uint32_t sizes[] = {3};
    float vertices[3 * 64];
    uint32_t count;
    hair_egl* egl;
    hair_context* context;
    hair_groom* groom;
    hair_instance* hair;

    if (hair_egl_create(NULL, -1, &egl)) return 1; // A game has its own context.
    hair_context_desc context_desc = hair_context_desc_default();
    context_desc.get_proc = hair_egl_get_proc;
    if (hair_context_create(&context_desc, &context)) return 1;

    hair_groom_desc groom_desc = hair_groom_desc_default();
    groom_desc.positions = strand;
    groom_desc.strand_vertices = sizes;
    groom_desc.strand_count = 1;
    if (hair_groom_create(&groom_desc, &groom)) return 1;

    hair_desc desc = hair_desc_default();
    if (hair_create(context, groom, &desc, &hair)) return 1;
    for (int frame = 0; frame < 60; ++frame)
        if (hair_step(hair, 1.0f / 60)) return 1; // A game calls hair_draw(hair, &view) here.

    if (hair_read_positions(hair, HAIR_READ_GUIDES, vertices, 64, &count)) return 1;
    const float* tip = vertices + 3 * (count - 1);
    printf("the tip is at (%.3f, %.3f, %.3f) m\n", (double)tip[0], (double)tip[1], (double)tip[2]);
    hair_destroy(hair), hair_groom_destroy(groom), hair_context_destroy(context), hair_egl_destroy(egl);
    return 0;
}
