// first_head.c - The shortest way to a head in a window of SDL, lit and in shadow, in one file.
#include <SDL.h>
#include <epoxy/gl.h>
#include <hair/hair.h>
#include <hair/hair_asset.h>

// A game draws meshes. Here each pixel finds the body, and what shades it, along rays.
static const char* const text[2] = {
    "#version 450 core\n"
    "void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }\n",
    "#version 450 core\n"
    "layout(location = 0) uniform mat4 view;\n"
    "layout(location = 1) uniform mat4 projection;\n"
    "layout(location = 2) uniform vec3 sun;\n" // the unit direction to the light
    "layout(location = 3) uniform vec2 size;\n"
    "layout(location = 0) out vec4 color;\n"
    "float body(vec3 p) {\n" // the distance to skull, neck and shoulders
    "    float skull = (length((p - vec3(0, 1.62, 0)) / vec3(0.075, 0.106, 0.094)) - 1) * 0.075;\n"
    "    float neck = length(vec3(p.x, p.y - clamp(p.y, 1.36, 1.56), p.z)) - 0.045;\n"
    "    float shoulders = length(vec3(p.x - clamp(p.x, -0.12, 0.12), p.y - 1.34, p.z)) - 0.07;\n"
    "    return -log(exp(-90 * skull) + exp(-90 * neck) + exp(-90 * shoulders)) / 90;\n"
    "}\n"
    "float march(vec3 from, vec3 way, float end) {\n"
    "    float t = 0, d = 1;\n"
    "    for (int i = 0; i < 64 && t < end && d > 2e-4; ++i) t += d = body(from + t * way);\n"
    "    return t;\n"
    "}\n"
    "void main() {\n"
    "    mat4 clip = projection * view, back = inverse(clip);\n"
    "    vec4 a = back * vec4(gl_FragCoord.xy / size * 2 - 1, -1, 1), b = a + 2 * back[2];\n"
    "    vec3 from = a.xyz / a.w, ray = normalize(b.xyz / b.w - from), e = vec3(1e-3, 0, 0);\n"
    "    vec3 p = from + march(from, ray, 3) * ray;\n"
    "    vec3 n = normalize(vec3(body(p + e), body(p + e.yxy), body(p + e.yyx)) - body(p));\n"
    "    vec4 depth = clip * vec4(p, 1);\n"
    "    if (body(p) > 0.01) discard;\n"
    "    gl_FragDepth = 0.5 + 0.5 * depth.z / depth.w;\n"
    "    float lit = march(p + 0.004 * n, sun, 0.4) < 0.4 ? 0 : max(dot(n, sun), 0);\n"
    "    color = vec4(vec3(0.5, 0.38, 0.31) / 3.1416 * (3 * lit + 0.35), 1);\n"
    "}\n"};

#define CHECK(failed) ((failed) ? (fprintf(stderr, "failed: %s\n", #failed), exit(1)) : (void)0)

static void* get_proc(const char* name, void* user)
{
    (void)user;
    return SDL_GL_GetProcAddress(name);
}

static hair_instance* make_hair(hair_context* context)
{
    hair_asset* asset;
    hair_groom* groom;
    hair_instance* hair;
    hair_style_desc style = hair_style_desc_default();
    hair_groom_desc groom_desc = hair_groom_desc_default();
    hair_look look = hair_look_default();
    hair_desc desc = hair_desc_default();
    CHECK(hair_asset_generate(&style, &asset) || hair_asset_to_groom_desc(asset, &groom_desc));
    look.strand.radius = 2e-4f; // 12000 strands stand for 100000.
    look.self_shadow.method = HAIR_SELF_SHADOW_STRANDS; // Hair and colliders shade hair.
    groom_desc.follower_count = 12000, desc.look = &look;
    CHECK(hair_groom_create(&groom_desc, &groom) || hair_create(context, groom, &desc, &hair));
    hair_asset_destroy(asset), hair_groom_destroy(groom);
    hair_collider body[2] = {hair_collider_default(), hair_collider_default()}; // skull, chest
    body[0].shape = HAIR_SHAPE_ELLIPSOID, body[0].position[1] = 1.62f;
    body[0].size[0] = 0.077f, body[0].size[1] = 0.108f, body[0].size[2] = 0.096f;
    body[1].shape = HAIR_SHAPE_CAPSULE, body[1].position[1] = 1.34f, body[1].size[0] = 0.072f;
    body[1].size[1] = 0.12f, body[1].rotation[2] = body[1].rotation[3] = 0.70710678f;
    CHECK(hair_set_colliders(hair, body, 2, sizeof *body));
    return hair;
}

int main(void)
{
    CHECK(SDL_Init(SDL_INIT_VIDEO));
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, SDL_GL_CONTEXT_PROFILE_CORE);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 4),
        SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, 5);
    SDL_GL_SetAttribute(SDL_GL_FRAMEBUFFER_SRGB_CAPABLE, 1);
    SDL_Window* window = SDL_CreateWindow("hair", 0, 0, 640, 480, SDL_WINDOW_OPENGL);
    CHECK(!window || !SDL_GL_CreateContext(window));
    hair_context* context;
    hair_context_desc context_desc = hair_context_desc_default();
    context_desc.get_proc = get_proc;
    CHECK(hair_context_create(&context_desc, &context));
    hair_instance* hair = make_hair(context);

    GLuint program = glCreateProgram(), vertex_array;
    for (int i = 0; i < 2; ++i) {
        GLuint shader = glCreateShader(i ? GL_FRAGMENT_SHADER : GL_VERTEX_SHADER);
        glShaderSource(shader, 1, &text[i], NULL);
        glCompileShader(shader), glAttachShader(program, shader);
    }
    glLinkProgram(program), glUseProgram(program);
    glGenVertexArrays(1, &vertex_array), glBindVertexArray(vertex_array);

    hair_light sun = hair_light_default();
    sun.direction[0] = 0.6f, sun.direction[1] = 0.64f, sun.direction[2] = 0.48f;
    hair_view view = hair_view_default();
    view.lights = &sun;
    view.coverage = HAIR_COVERAGE_ALPHA; // Smooth edges without multisampling.
    view.view[13] = -1.52f, view.view[14] = -1.1f; // The camera is 1.52 m up and 1.1 m in front.
    view.projection[0] = 3, view.projection[5] = 4; // It sees 28 degrees, from 0.2 m to 2.2 m.
    view.projection[10] = -1.2f, view.projection[14] = -0.44f, view.projection[11] = -1,
    view.projection[15] = 0;
    glUniformMatrix4fv(0, 1, GL_FALSE, view.view), glUniformMatrix4fv(1, 1, GL_FALSE, view.projection);
    glUniform3fv(2, 1, sun.direction), glUniform2f(3, 640, 480);
    glEnable(GL_DEPTH_TEST), glEnable(GL_FRAMEBUFFER_SRGB); // Linear colours become sRGB.
    glClearColor(0.16f, 0.19f, 0.24f, 1);

    for (SDL_Event event = {0}; event.type != SDL_QUIT; SDL_PollEvent(&event)) {
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        CHECK(hair_step(hair, 1.0f / 60) || hair_draw(hair, &view));
        SDL_GL_SwapWindow(window);
    }
    hair_destroy(hair), hair_context_destroy(context);
    SDL_Quit();
    return 0;
}
