// host_scene.h - what a host program draws itself, by state that it sets only once.
#ifndef HAIR_TESTS_HOSTS_HOST_SCENE_H
#define HAIR_TESTS_HOSTS_HOST_SCENE_H

enum { HOST_SIZE = 96 };

// Kinds of contexts and of state. The first has no debug messages.
enum host_kind {
    HOST_CORE,
    HOST_DEBUG,
    HOST_COMPATIBILITY,
    HOST_MSAA,
    HOST_SRGB,
    HOST_REVERSED_DEPTH,
    HOST_ODD_STATE,
    HOST_KINDS
};
static const char* const host_kind_names[HOST_KINDS] = {
    "core", "debug", "compatibility", "MSAA", "sRGB", "reversed depth", "odd state",
};

struct host_pixels {
    unsigned char rgba[HOST_SIZE][HOST_SIZE][4];
};

struct host_scene {
    enum host_kind kind;
    GLuint program, vertex_array, buffer, texture, framebuffer, attachments[2], odd[7];
    float view[16], projection[16];
    unsigned messages;
};

static const char host_vertex_text[] =
    "#version 450 core\n"
    "layout(location = 0) uniform mat4 clip;\n"
    "layout(location = 0) in vec3 position;\n"
    "layout(location = 0) out vec2 place;\n"
    "void main() { place = position.xy; gl_Position = clip * vec4(position, 1.0); }\n";
static const char host_fragment_text[] = "#version 450 core\n"
                                         "layout(binding = 0) uniform sampler2D picture;\n"
                                         "layout(location = 0) in vec2 place;\n"
                                         "layout(location = 0) out vec4 color;\n"
                                         "void main() { color = vec4(texture(picture, place).rgb, 1.0); }\n";

static void APIENTRY host_count_message(GLenum source, GLenum type, GLuint id, GLenum severity,
                                        GLsizei length, const GLchar* message, const void* user)
{
    (void)source, (void)id, (void)severity, (void)length;
    if (type != GL_DEBUG_TYPE_ERROR && type != GL_DEBUG_TYPE_PERFORMANCE &&
        type != GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR)
        return;
    print_message("OpenGL: %s\n", message);
    ++((struct host_scene*)user)->messages;
}

static GLuint host_shader(GLenum stage, const char* text)
{
    GLuint shader = glCreateShader(stage);
    glShaderSource(shader, 1, &text, NULL);
    glCompileShader(shader);
    return shader;
}

// Look at the head from 1.1 m in front of it, with a depth of 0.2 m to 2.2 m.
static void host_set_camera(struct host_scene* scene)
{
    const float near = 0.2f, far = 2.2f;
    memset(scene->view, 0, sizeof scene->view);
    memset(scene->projection, 0, sizeof scene->projection);
    for (int i = 0; i < 4; ++i) scene->view[5 * i] = 1;
    scene->view[13] = -1.52f, scene->view[14] = -1.1f;
    scene->projection[0] = scene->projection[5] = 3.5f;
    scene->projection[11] = -1;
    scene->projection[10] = (far + near) / (near - far),
    scene->projection[14] = 2 * far * near / (near - far);
    if (scene->kind != HOST_REVERSED_DEPTH) return;
    scene->projection[10] = near / (far - near), scene->projection[14] = far * near / (far - near);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glDepthFunc(GL_GREATER);
    glClearDepth(0);
}

// Set state that hosts seldom have, but which their frame must find again.
static void host_set_odd_state(struct host_scene* scene)
{
    glCreateBuffers(5, scene->odd);
    glCreateSamplers(1, &scene->odd[5]);
    glCreateTransformFeedbacks(1, &scene->odd[6]);
    for (int i = 0; i < 5; ++i) glNamedBufferStorage(scene->odd[i], 4096, NULL, GL_DYNAMIC_STORAGE_BIT);
    for (GLuint i = 0; i < 4; ++i) {
        glBindBufferBase(GL_UNIFORM_BUFFER, i, scene->odd[0]);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, i, scene->odd[1]);
    }
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, scene->odd[2]);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, scene->odd[3]);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, scene->odd[4]);
    glSamplerParameteri(scene->odd[5], GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glSamplerParameteri(scene->odd[5], GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glBindSampler(0, scene->odd[5]);
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, scene->odd[6]);
    glActiveTexture(GL_TEXTURE7);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 7);
    glPatchParameteri(GL_PATCH_VERTICES, 5);
    glEnable(GL_PRIMITIVE_RESTART);
    glPrimitiveRestartIndex(3);
    glDepthRange(0.25, 0.75);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, HOST_SIZE, HOST_SIZE - 8);
    glEnable(GL_CULL_FACE);
    glFrontFace(GL_CCW);
}

// Draw into a framebuffer of four samples. Pixels are read from the window.
static void host_bind_framebuffer(struct host_scene* scene)
{
    glCreateFramebuffers(1, &scene->framebuffer);
    glCreateRenderbuffers(2, scene->attachments);
    glNamedRenderbufferStorageMultisample(scene->attachments[0], 4, GL_RGBA8, HOST_SIZE, HOST_SIZE);
    glNamedRenderbufferStorageMultisample(scene->attachments[1], 4, GL_DEPTH_COMPONENT24, HOST_SIZE,
                                          HOST_SIZE);
    glNamedFramebufferRenderbuffer(scene->framebuffer, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                   scene->attachments[0]);
    glNamedFramebufferRenderbuffer(scene->framebuffer, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                   scene->attachments[1]);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, scene->framebuffer);
}

static void host_make_texture(struct host_scene* scene)
{
    unsigned char picture[16][16][4];
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            const unsigned char texel[4] = {(unsigned char)(13 * x), 90, (unsigned char)(255 - 13 * y), 255};
            memcpy(picture[y][x], texel, 4);
        }
    glCreateTextures(GL_TEXTURE_2D, 1, &scene->texture);
    glTextureStorage2D(scene->texture, 1, GL_RGBA8, 16, 16);
    glTextureSubImage2D(scene->texture, 0, 0, 0, 16, 16, GL_RGBA, GL_UNSIGNED_BYTE, picture);
    glBindTextureUnit(0, scene->texture);
}

static void host_make_geometry(struct host_scene* scene)
{
    // The wall is 0.6 m behind the head. The triangle is 0.4 m in front, left of the middle.
    const float corners[9][3] = {{-2, 0, -0.6f}, {2, 0, -0.6f}, {2, 4, -0.6f}, {-2, 0, -0.6f},  {2, 4, -0.6f},
                                 {-2, 4, -0.6f}, {0, -9, 0.4f}, {0, 12, 0.4f}, {-9, 1.5f, 0.4f}};
    glCreateBuffers(1, &scene->buffer);
    glNamedBufferStorage(scene->buffer, sizeof corners, corners, 0);
    glCreateVertexArrays(1, &scene->vertex_array);
    glVertexArrayVertexBuffer(scene->vertex_array, 0, scene->buffer, 0, 12);
    glVertexArrayAttribFormat(scene->vertex_array, 0, 3, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(scene->vertex_array, 0, 0);
    glEnableVertexArrayAttrib(scene->vertex_array, 0);
    glBindVertexArray(scene->vertex_array);
}

static struct host_scene host_scene_start(enum host_kind kind)
{
    struct host_scene scene = {.kind = kind};
    float clip[16] = {0};
    glViewport(0, 0, HOST_SIZE, HOST_SIZE);
    glEnable(GL_DEPTH_TEST);
    glClearColor(0.1f, 0.1f, 0.1f, 1);
    if (kind == HOST_SRGB) glEnable(GL_FRAMEBUFFER_SRGB);
    host_set_camera(&scene);
    for (int i = 0; i < 16; ++i)
        for (int k = 0; k < 4; ++k) clip[i] += scene.projection[4 * k + i % 4] * scene.view[i / 4 * 4 + k];
    host_make_texture(&scene);
    host_make_geometry(&scene);
    scene.program = glCreateProgram();
    GLuint shaders[] = {host_shader(GL_VERTEX_SHADER, host_vertex_text),
                        host_shader(GL_FRAGMENT_SHADER, host_fragment_text)};
    for (int i = 0; i < 2; ++i) glAttachShader(scene.program, shaders[i]), glDeleteShader(shaders[i]);
    glLinkProgram(scene.program);
    glProgramUniformMatrix4fv(scene.program, 0, 1, GL_FALSE, clip);
    glUseProgram(scene.program);
    if (kind == HOST_ODD_STATE) host_set_odd_state(&scene);
    if (kind == HOST_MSAA) host_bind_framebuffer(&scene);
    if (kind != HOST_COMPATIBILITY) return scene;
    glMatrixMode(GL_PROJECTION);
    glLoadMatrixf(clip);
    glColor3f(0.9f, 0.8f, 0.1f);
    return scene;
}

// Copy the pixels of the window. A multisampled framebuffer is resolved into the window first.
static void host_read(const struct host_scene* scene, struct host_pixels* out)
{
    if (scene->framebuffer)
        glBlitNamedFramebuffer(scene->framebuffer, 0, 0, 0, HOST_SIZE, HOST_SIZE, 0, 0, HOST_SIZE, HOST_SIZE,
                               GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glReadPixels(0, 0, HOST_SIZE, HOST_SIZE, GL_RGBA, GL_UNSIGNED_BYTE, out->rgba);
}

// Draw a frame. The fixed functions of the compatibility profile draw the triangle there.
static void host_scene_draw(struct host_scene* scene, struct host_pixels* out)
{
    if (scene->kind != HOST_CORE) {
        glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
        glDebugMessageCallback(host_count_message, scene);
    }
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glDrawArrays(GL_TRIANGLES, 0, scene->kind == HOST_COMPATIBILITY ? 6 : 9);
    if (scene->kind == HOST_COMPATIBILITY) {
        glUseProgram(0);
        glBegin(GL_TRIANGLES);
        glVertex3f(0, -9, 0.4f), glVertex3f(0, 12, 0.4f), glVertex3f(-9, 1.5f, 0.4f);
        glEnd();
        glUseProgram(scene->program);
    }
    if (out) host_read(scene, out);
}

static void host_scene_stop(struct host_scene* scene)
{
    assert_int_equal(glGetError(), GL_NO_ERROR);
    assert_int_equal(scene->messages, 0);
    glDeleteProgram(scene->program);
    glDeleteTextures(1, &scene->texture);
    glDeleteVertexArrays(1, &scene->vertex_array);
    glDeleteBuffers(1, &scene->buffer);
    glDeleteFramebuffers(1, &scene->framebuffer);
    glDeleteRenderbuffers(2, scene->attachments);
    if (scene->kind != HOST_ODD_STATE) return;
    glDeleteBuffers(5, scene->odd);
    glDeleteSamplers(1, &scene->odd[5]);
    glDeleteTransformFeedbacks(1, &scene->odd[6]);
}

// Return a linear value as sRGB.
static double host_encode(double value)
{
    value = fmin(fmax(value, 0), 1);
    return value <= 0.0031308 ? 12.92 * value : 1.055 * pow(value, 1 / 2.4) - 0.055;
}

#endif
