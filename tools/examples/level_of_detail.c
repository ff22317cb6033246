// level_of_detail.c - Hair at three distances. The upper row is drawn without level of detail, the
// lower row with it. The program prints how many triangles are drawn.
//
//     level_of_detail [FILE.ppm [WIDTH]]
#include "bust.h"
#include "camera.h"
#include <hair/hair_egl.h>

static hair_instance* make_hair(hair_context* context)
{
    hair_instance* hair;
    hair_groom* groom = make_groom(HAIR_STYLE_BOB, 6000);
    hair_look look = hair_look_default();
    look.strand.radius = 3e-4f; // 6000 strands stand for 100000.
    hair_desc desc = hair_desc_default();
    desc.look = &look;
    check(hair_create(context, groom, &desc, &hair));
    hair_groom_destroy(groom);
    return hair;
}

// Draw one view. Return the number of triangles that hair becomes, counted by OpenGL.
static GLuint draw(hair_instance* hair, const struct bust* bust, float distance, float aspect,
                   const hair_lod* lod)
{
    const float target[3] = {0, 1.56f, 0};
    const float eye[3] = {0.4f * distance, 1.56f + 0.05f * distance, 0.9f * distance};
    struct camera camera = camera_perspective(eye, target, 0.45f, aspect);
    bust_draw(bust, bust->program, identity, camera.clip);

    hair_view view = hair_view_default();
    memcpy(view.view, camera.view, sizeof view.view);
    memcpy(view.projection, camera.projection, sizeof view.projection);
    view.lod = lod; // Draws everything if NULL.
    GLuint query, triangles;
    glGenQueries(1, &query);
    glBeginQuery(GL_PRIMITIVES_GENERATED, query);
    check(hair_draw(hair, &view));
    glEndQuery(GL_PRIMITIVES_GENERATED);
    glGetQueryObjectuiv(query, GL_QUERY_RESULT, &triangles);
    glDeleteQueries(1, &query);
    return triangles;
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
    check(hair_context_create(&context_desc, &context));
    hair_instance* hair = make_hair(context);
    struct bust bust = bust_create();
    check(hair_step(hair, 1.0f / 60));

    // Strands thinner than half a pixel become fewer and wider. Segments become 4 pixels long.
    hair_lod lod = hair_lod_default();
    lod.strand_pixels = 0.5f;

    const float distances[3] = {1, 2, 4}; // m
    struct picture picture = picture_begin(argc > 2 ? (int)strtol(argv[2], NULL, 10) : 800);
    int width = picture.width / 3, height = picture.height / 2;
    for (int i = 0; i < 3; ++i) {
        float aspect = (float)width / (float)height;
        glViewport(i * width, height, width, height);
        GLuint all = draw(hair, &bust, distances[i], aspect, NULL);
        glViewport(i * width, 0, width, height);
        GLuint some = draw(hair, &bust, distances[i], aspect, &lod);
        printf("%.0f m: %u of %u triangles\n", (double)distances[i], some, all);
    }
    picture_end(&picture, argc > 1 ? argv[1] : "level_of_detail.ppm");

    bust_destroy(&bust);
    hair_destroy(hair);
    hair_context_destroy(context);
    hair_egl_destroy(egl);
    return EXIT_SUCCESS;
}
