// beads.c - A bead on the tip of every strand, by the OpenGL buffers of the strands, with no copy.
//
//     beads [FILE.ppm [WIDTH]]
#include "bust.h"
#include "camera.h"
#include <hair/hair_egl.h>

// A bead is a square that faces the eye, one for each tip. Its pixels are those of a sphere.
static const char bead_vertex_text[] =
    "#version 450 core\n"
    "layout(location = 0) uniform mat4 view;\n"
    "layout(location = 1) uniform mat4 projection;\n"
    "layout(location = 2) uniform float radius;\n"
    "layout(location = 3) uniform vec3 origin;\n"
    "layout(location = 0) in vec3 tip;\n"
    "layout(location = 0) out vec2 place;\n"
    "layout(location = 1) flat out float tint;\n"
    "void main()\n"
    "{\n"
    "    place = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;\n"
    "    tint = fract(float(gl_InstanceID) * 0.618034);\n"
    "    vec4 center = view * vec4(origin + tip, 1.0);\n"
    "    gl_Position = projection * (center + vec4(radius * place, radius, 0.0));\n"
    "}\n";

static const char bead_fragment_text[] =
    "#version 450 core\n"
    "layout(location = 4) uniform vec3 to_light;\n" // in view space
    "layout(location = 0) in vec2 place;\n"
    "layout(location = 1) flat in float tint;\n"
    "layout(location = 0) out vec4 color;\n"
    "void main()\n"
    "{\n"
    "    float square = dot(place, place);\n"
    "    if (square > 1.0) discard;\n"
    "    vec3 n = vec3(place, sqrt(1.0 - square));\n"
    "    vec3 own = tint < 0.5 ? vec3(0.80, 0.50, 0.12) : vec3(0.05, 0.40, 0.42);\n"
    "    float glint = pow(max(dot(n, normalize(to_light + vec3(0.0, 0.0, 1.0))), 0.0), 60.0);\n"
    "    color = vec4(own * (0.2 + max(dot(n, to_light), 0.0)) + 0.7 * glint, 1.0);\n"
    "}\n";

static hair_instance* make_hair(hair_context* context)
{
    hair_instance* hair;
    hair_groom* groom = make_groom(HAIR_STYLE_BOB, 3000);
    hair_look look = hair_look_default();
    look.strand.radius = 4e-4f; // 3000 strands stand for 100000.
    hair_desc desc = hair_desc_default();
    desc.look = &look;
    check(hair_create(context, groom, &desc, &hair));
    hair_groom_destroy(groom);
    return hair;
}

// Take the last vertex of each strand as the attribute 0 of an instance.
static void bind_tips(GLuint vertex_array, const hair_buffers* strands)
{
    const hair_buffer* from = &strands->position; // A GL_RGB32F for each vertex.
    GLuint last = from->offset + (strands->strand_vertices - 1) * from->stride;
    GLsizei stride = (GLsizei)(strands->strand_vertices * from->stride);
    glVertexArrayVertexBuffer(vertex_array, 0, from->buffer, (GLintptr)last, stride);
    glVertexArrayBindingDivisor(vertex_array, 0, 1);
    glVertexArrayAttribFormat(vertex_array, 0, 3, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(vertex_array, 0, 0);
    glEnableVertexArrayAttrib(vertex_array, 0);
}

static void draw_beads(hair_instance* hair, GLuint program, const struct camera* camera)
{
    const float light[3] = {0.41f, 0.79f, 0.46f};
    float to_light[3], origin[3];
    GLuint vertex_array;
    // The names of the buffers may change with every call for this instance, so ask each frame.
    hair_buffers strands = hair_buffers_default();
    strands.attributes = HAIR_ATTRIBUTE_POSITION;
    check(hair_get_buffers(hair, HAIR_READ_FOLLOWERS, &strands));
    // A compute shader wrote the positions. A vertex array reads them.
    glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
    glCreateVertexArrays(1, &vertex_array);
    bind_tips(vertex_array, &strands);
    for (int i = 0; i < 3; ++i) {
        origin[i] = (float)strands.origin[i];
        to_light[i] =
            camera->view[i] * light[0] + camera->view[4 + i] * light[1] + camera->view[8 + i] * light[2];
    }
    glProgramUniformMatrix4fv(program, 0, 1, GL_FALSE, camera->view);
    glProgramUniformMatrix4fv(program, 1, 1, GL_FALSE, camera->projection);
    glProgramUniform1f(program, 2, 0.0022f);
    glProgramUniform3fv(program, 3, 1, origin);
    glProgramUniform3fv(program, 4, 1, to_light);
    glUseProgram(program);
    glBindVertexArray(vertex_array);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, (GLsizei)strands.strand_count);
    glDeleteVertexArrays(1, &vertex_array);
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
    GLuint beads = make_program(bead_vertex_text, bead_fragment_text);
    check(hair_step(hair, 1.0f / 60));

    const float eye[3] = {0.50f, 1.62f, 0.985f}, target[3] = {0, 1.58f, 0};
    struct camera camera = camera_perspective(eye, target, 0.33f, 4.0f / 3);
    struct picture picture = picture_begin(argc > 2 ? (int)strtol(argv[2], NULL, 10) : 800);
    bust_draw(&bust, bust.program, identity, camera.clip);
    hair_view view = hair_view_default();
    memcpy(view.view, camera.view, sizeof view.view);
    memcpy(view.projection, camera.projection, sizeof view.projection);
    view.render_path = HAIR_RENDER_PATH_CACHED; // Hair and beads then share the vertices.
    check(hair_draw(hair, &view));
    draw_beads(hair, beads, &camera);
    picture_end(&picture, argc > 1 ? argv[1] : "beads.ppm");

    glDeleteProgram(beads);
    bust_destroy(&bust);
    hair_destroy(hair);
    hair_context_destroy(context);
    hair_egl_destroy(egl);
    return EXIT_SUCCESS;
}
