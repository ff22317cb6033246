// clustered_lights.c - Hair under many lights of the application, which are in storage buffers. A
// grid over the view lists the lights that reach each of its cells, its clusters.
//
//     clustered_lights [FILE.ppm [WIDTH]]
#include "bust.h"
#include "camera.h"
#include <hair/hair_egl.h>

enum { LIGHTS = 64, COLUMNS = 8, ROWS = 6, SLICES = 12, CLUSTERS = COLUMNS * ROWS * SLICES };

#define NEAREST 0.5f // Distance of the first slice from the eye, in metres.
#define SLICE 0.06f // Depth of a slice.
#define REACH 0.18f // Distance at which a light ends.

struct light {
    float position[3], reach, color[3], unused;
};

// Both buffers as GLSL has them. Bindings from 8 on belong to the application.
struct light_lists {
    uint32_t first[CLUSTERS + 1]; // Beginning of the list of a cluster in `light`.
    uint32_t light[CLUSTERS * LIGHTS];
};

// The text is for the bust and for the hair. `example_cell` is the size of a cluster in pixels.
static const char lights_text[] =
    "struct example_light { vec4 place, color; };\n"
    "layout(std430, binding = 8) readonly buffer example_lights { example_light example_light_of[]; };\n"
    "layout(std430, binding = 9) readonly buffer example_lists { uint example_list[]; };\n"
    "layout(std140, binding = 8) uniform example_grid {\n"
    "    mat4 example_view;\n"
    "    vec2 example_cell;\n"
    "};\n"
    // The range in example_list of the lights that reach a position.
    "uvec2 example_lights_at(vec3 position)\n"
    "{\n"
    "    const uvec3 size = uvec3(8u, 6u, 12u);\n"
    "    float away = -(example_view * vec4(position, 1.0)).z;\n"
    "    uvec3 at = uvec3(gl_FragCoord.xy / example_cell, max(away - 0.5, 0.0) / 0.06);\n"
    "    at = min(at, size - 1u);\n"
    "    uint cluster = (at.z * size.y + at.y) * size.x + at.x;\n"
    "    return uvec2(example_list[cluster], example_list[cluster + 1u]) + size.x * size.y * size.z + 1u;\n"
    "}\n"
    "vec3 example_irradiance(uint number, vec3 position, out vec3 to)\n"
    "{\n"
    "    example_light light = example_light_of[example_list[number]];\n"
    "    vec3 way = light.place.xyz - position;\n"
    "    float square = dot(way, way), ended = square / (light.place.w * light.place.w);\n"
    "    to = way * inversesqrt(max(square, 1e-8));\n"
    "    return light.color.rgb * pow(max(1.0 - ended * ended, 0.0), 2.0) / max(square, 1e-4);\n"
    "}\n";

// The hair hides part of the lights around it, about as much as of the sky.
static const char hair_text[] = "vec4 hair_shade(hair_fragment f)\n"
                                "{\n"
                                "    vec3 position = hair_world(f), sum = hair_shade_ours(f), to;\n"
                                "    float through = hair_sky_through(f);\n"
                                "    uvec2 range = example_lights_at(position);\n"
                                "    for (uint i = range.x; i < range.y; ++i) {\n"
                                "        vec3 irradiance = example_irradiance(i, position, to);\n"
                                "        sum += hair_reflect(f, to, irradiance, through);\n"
                                "    }\n"
                                "    return vec4(sum, 1.0);\n"
                                "}\n";

static const char bust_text[] = "layout(location = 0) in vec3 position;\n"
                                "layout(location = 1) in vec3 normal;\n"
                                "layout(location = 0) out vec4 color;\n"
                                "void main()\n"
                                "{\n"
                                "    vec3 n = normalize(normal), sum = vec3(0.05), to;\n"
                                "    uvec2 range = example_lights_at(position);\n"
                                "    for (uint i = range.x; i < range.y; ++i) {\n"
                                "        vec3 irradiance = example_irradiance(i, position, to);\n"
                                "        sum += irradiance * max(dot(n, to), 0.0);\n"
                                "    }\n"
                                "    color = vec4(sum * vec3(0.5, 0.4, 0.35) / 3.14159, 1.0);\n"
                                "}\n";

// Place lights of three colours on a spiral around the head.
static void place_lights(struct light lights[LIGHTS])
{
    static const float colors[3][3] = {
        {0.030f, 0.011f, 0.003f}, {0.004f, 0.018f, 0.026f}, {0.022f, 0.005f, 0.020f}};
    for (int i = 0; i < LIGHTS; ++i) {
        float part = ((float)i + 0.5f) / LIGHTS, angle = 2.3999632f * (float)i;
        float across = 0.15f + 0.13f * part, x = across * cosf(angle), z = across * sinf(angle);
        lights[i] = (struct light){
            {x, 1.78f - 0.42f * part, z}, REACH, {colors[i % 3][0], colors[i % 3][1], colors[i % 3][2]}, 0};
    }
}

// Return whether a light reaches a cluster. The sphere of the light is compared with the box around
// the cluster in view space.
static int reaches(const struct light* light, const struct camera* camera, int x, int y, int slice)
{
    float square = 0, near = NEAREST + SLICE * (float)slice, far = near + SLICE;
    if (slice == 0) near = 0;
    if (slice == SLICES - 1) far = 1e6f;
    for (int k = 0; k < 3; ++k) {
        const float* v = camera->view;
        const float* p = light->position;
        float at = v[k] * p[0] + v[4 + k] * p[1] + v[8 + k] * p[2] + v[12 + k], lower = -far, upper = -near;
        if (k < 2) { // The slopes of both sides of the cluster, from the eye.
            float cells = k ? ROWS : COLUMNS, number = (float)(k ? y : x), scale = camera->projection[5 * k];
            float first = (2 * number / cells - 1) / scale, last = (2 * (number + 1) / cells - 1) / scale;
            lower = fminf(first * near, first * far), upper = fmaxf(last * near, last * far);
        }
        float off = fmaxf(fmaxf(lower - at, at - upper), 0);
        square += off * off;
    }
    return square < light->reach * light->reach;
}

// List the lights of each cluster. Return the number of entries. An engine does this in a compute
// shader.
static uint32_t make_lists(const struct light lights[LIGHTS], const struct camera* camera,
                           struct light_lists* out)
{
    uint32_t count = 0;
    for (int cluster = 0; cluster < CLUSTERS; ++cluster) {
        int x = cluster % COLUMNS, y = cluster / COLUMNS % ROWS, slice = cluster / (COLUMNS * ROWS);
        out->first[cluster] = count;
        for (uint32_t i = 0; i < LIGHTS; ++i)
            if (reaches(&lights[i], camera, x, y, slice)) out->light[count++] = i;
    }
    out->first[CLUSTERS] = count;
    return count;
}

static void bind_lights(GLuint buffers[3], const struct camera* camera, const struct picture* picture)
{
    static struct light lights[LIGHTS];
    static struct light_lists lists;
    struct {
        float view[16], cell[4];
    } grid;
    place_lights(lights);
    uint32_t count = make_lists(lights, camera, &lists);
    memcpy(grid.view, camera->view, sizeof grid.view);
    grid.cell[0] = (float)picture->width / COLUMNS, grid.cell[1] = (float)picture->height / ROWS;
    glCreateBuffers(3, buffers);
    glNamedBufferStorage(buffers[0], sizeof lights, lights, 0);
    glNamedBufferStorage(buffers[1], (GLsizeiptr)(sizeof lists.first + count * sizeof *lists.light), &lists,
                         0);
    glNamedBufferStorage(buffers[2], sizeof grid, &grid, 0);
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 8, 2, buffers);
    glBindBufferBase(GL_UNIFORM_BUFFER, 8, buffers[2]);
}

static hair_instance* make_hair(hair_context* context)
{
    hair_instance* hair;
    hair_groom* groom = make_groom(HAIR_STYLE_BOB, 6000);
    hair_look look = hair_look_default();
    look.strand.radius = 3e-4f; // 6000 strands stand for 100000.
    look.self_shadow.method = HAIR_SELF_SHADOW_STRANDS; // For hair_sky_through().
    hair_desc desc = hair_desc_default();
    desc.look = &look;
    check(hair_create(context, groom, &desc, &hair));
    hair_groom_destroy(groom);
    return hair;
}

int main(int argc, char** argv)
{
    static char text[sizeof lights_text + sizeof bust_text + 32];
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
    snprintf(text, sizeof text, "#version 450 core\n%s%s", lights_text, bust_text);
    GLuint bust_program = make_program(bust_vertex_text, text), buffers[3];
    check(hair_step(hair, 1.0f / 60));

    // Storage buffers need shading by pixel.
    hair_shader* shader;
    hair_shader_desc shader_desc = hair_shader_desc_default();
    snprintf(text, sizeof text, "%s%s", lights_text, hair_text);
    shader_desc.label = "clustered";
    shader_desc.glsl = text;
    shader_desc.at = HAIR_SHADE_PIXELS;
    check(hair_shader_create(context, &shader_desc, &shader));

    const float eye[3] = {0.42f, 1.66f, 0.84f}, target[3] = {0, 1.55f, 0};
    struct camera camera = camera_perspective(eye, target, 0.42f, 4.0f / 3);
    struct picture picture = picture_begin(argc > 2 ? (int)strtol(argv[2], NULL, 10) : 800);
    bind_lights(buffers, &camera, &picture);
    bust_draw(&bust, bust_program, identity, camera.clip);
    hair_view view = hair_view_default();
    memcpy(view.view, camera.view, sizeof view.view);
    memcpy(view.projection, camera.projection, sizeof view.projection);
    view.shader = shader;
    view.light_count = 0; // The library's own lights. A sun could be one.
    for (int i = 0; i < 3; ++i) view.ambient[i] = 0.05f;
    check(hair_draw(hair, &view));
    picture_end(&picture, argc > 1 ? argv[1] : "clustered_lights.ppm");

    glDeleteBuffers(3, buffers);
    glDeleteProgram(bust_program);
    bust_destroy(&bust);
    hair_destroy(hair);
    hair_shader_destroy(shader);
    hair_context_destroy(context);
    hair_egl_destroy(egl);
    return EXIT_SUCCESS;
}
