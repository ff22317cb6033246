// vulkan_host.c - Hair in a renderer of Vulkan. Vulkan owns the images of colour and depth, and the
// library draws into them by OpenGL. Hair and triangles of Vulkan hide each other. Vulkan also owns
// a buffer of the strands, and draws beads on their tips.
//
//     vulkan_host [FILE.ppm [WIDTH [copy]]]     copy: strands go through main memory
#include "camera.h"
#include "vulkan_shared.h"
#include <hair/hair_egl.h>

// One of this number of strands has a bead. Vulkan limits the stride of vertices to 2048 bytes.
enum { TIPS = 3 };

// Create hair on two capsules, the skull and the shoulders.
static hair_instance* create_hair(const hair_host* host, hair_context** context)
{
    hair_context_desc context_desc = hair_context_desc_default();
    hair_look look = hair_look_default();
    hair_desc desc = hair_desc_default();
    hair_collider body[2] = {hair_collider_default(), hair_collider_default()};
    hair_groom* groom = make_groom(HAIR_STYLE_LONG, 8000);
    hair_instance* hair;
    context_desc.host = host;
    context_desc.get_proc = hair_egl_get_proc;
    look.strand.radius = 2.5e-4f;
    desc.look = &look;
    body[0].shape = body[1].shape = HAIR_SHAPE_CAPSULE;
    body[0].position[1] = 1.63f, body[0].size[0] = 0.08f, body[0].size[1] = 0.015f;
    body[1].position[1] = 1.36f, body[1].size[0] = 0.07f, body[1].size[1] = 0.11f;
    body[1].rotation[2] = body[1].rotation[3] = 0.70710678f;
    check(hair_context_create(&context_desc, context));
    check(hair_create(*context, groom, &desc, &hair));
    check(hair_set_colliders(hair, body, 2, sizeof *body));
    hair_groom_destroy(groom);
    return hair;
}

// Create a framebuffer of the shared images, and the state in which OpenGL draws as Vulkan does.
static GLuint create_framebuffer(void)
{
    GLuint framebuffer;
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, textures[COLOR], 0);
    glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, textures[DEPTH], 0);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        fail("OpenGL does not draw into the images.");
    glViewport(0, 0, (GLsizei)vk.width, (GLsizei)vk.height);
    glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE); // The first row is the highest one.
    glEnable(GL_DEPTH_TEST);
    return framebuffer;
}

// Change the depth of a projection from the range of OpenGL, [-1, 1], to [0, 1].
static void use_depth_of_vulkan(struct camera* camera)
{
    for (int i = 2; i < 16; i += 4)
        camera->projection[i] = 0.5f * (camera->projection[i] + camera->projection[i + 1]);
    multiply(camera->projection, camera->view, camera->clip);
}

// Draw hair by OpenGL into the images of Vulkan.
static void draw_hair(hair_instance* hair, const struct camera* camera)
{
    hair_view view = hair_view_default();
    memcpy(view.view, camera->view, sizeof view.view);
    memcpy(view.projection, camera->projection, sizeof view.projection);
    view.pass = HAIR_PASS_COLLIDERS; // An engine draws its own head.
    check(hair_draw(hair, &view));
    view.pass = HAIR_PASS_COLOR;
    view.coverage = HAIR_COVERAGE_ALPHA; // It blends, and writes no depth.
    check(hair_draw(hair, &view));
    view.pass = HAIR_PASS_DEPTH;
    view.coverage = HAIR_COVERAGE_MSAA;
    check(hair_draw(hair, &view));
}

// Return the positions of the strands of this frame, in a buffer of the library.
static hair_buffers get_strands(hair_instance* hair)
{
    hair_buffers out = hair_buffers_default();
    out.attributes = HAIR_ATTRIBUTE_POSITION;
    check(hair_get_buffers(hair, HAIR_READ_FOLLOWERS, &out));
    return out;
}

// Draw beads on tips of strands.
static void draw_tips(VkCommandBuffer commands, const hair_buffers* strands, const struct camera* camera)
{
    const VkDeviceSize tip = (strands->strand_vertices - 1) * strands->position.stride;
    float to_world[16], clip[16];
    memcpy(to_world, identity, sizeof to_world);
    for (int i = 0; i < 3; ++i) to_world[12 + i] = (float)strands->origin[i];
    multiply(camera->clip, to_world, clip);
    draw_beads(commands, strand_memory.buffer, tip, strands->strand_count / TIPS, clip);
}

// Draw a frame by Vulkan, OpenGL and Vulkan in turn. Only the GPU waits if there are semaphores.
static void draw_frame(hair_instance* hair, const struct camera* camera, bool is_first)
{
    VkCommandBuffer commands = begin(0);
    hand_over(commands, is_first ? VK_IMAGE_LAYOUT_UNDEFINED : layout, VK_QUEUE_FAMILY_IGNORED,
              VK_QUEUE_FAMILY_IGNORED);
    draw_triangle(commands, 0, camera->clip);
    hand_over(commands, layout, vk.family, VK_QUEUE_FAMILY_EXTERNAL);
    submit(commands, NULL, &vk.semaphores[TO_OPENGL]);

    if (vk.has_semaphores) wait_for_vulkan();
    draw_hair(hair, camera);
    hair_buffers strands = get_strands(hair); // They are valid until the next call for the hair.
    write_strands(strands.position.buffer, strands.position.offset);
    if (vk.has_semaphores)
        signal_vulkan();
    else
        glFinish();

    commands = begin(1);
    hand_over(commands, layout, VK_QUEUE_FAMILY_EXTERNAL, vk.family);
    draw_triangle(commands, 1, camera->clip);
    draw_tips(commands, &strands, camera);
    copy_pixels(commands);
    submit(commands, &vk.semaphores[TO_VULKAN], NULL);
}

int main(int argc, char** argv)
{
    const char* path = argc > 1 ? argv[1] : "vulkan_host.ppm";
    int width = argc > 2 ? (int)strtol(argv[2], NULL, 10) : 800;
    bool wants_copy = argc > 3 && strcmp(argv[3], "copy") == 0;
    if (argc > 3 && !wants_copy) fail("The last argument is not copy.");
    if (width < 16 || width > 4096) fail("WIDTH is not in [16, 4096].");
    hair_host host = {NULL, NULL, print_sentence, NULL};
    hair_egl* egl;
    hair_context* context;
    hair_instance* hair;
    unsigned char uuid[GL_UUID_SIZE_EXT];

    check(hair_egl_create(&host, -1, &egl));
    if (!epoxy_has_gl_extension("GL_EXT_memory_object_fd")) fail("OpenGL does not import memory.");
    glGetUnsignedBytei_vEXT(GL_DEVICE_UUID_EXT, 0, uuid); // Only the same device shares its memory.
    vk.width = (uint32_t)width, vk.height = (uint32_t)width * 3 / 4;
    create_device(uuid, epoxy_has_gl_extension("GL_EXT_semaphore_fd"));
    for (int i = 0; i < IMAGES; ++i) create_image(i);
    for (int i = 0; i < 2 && vk.has_semaphores; ++i) create_semaphore(i);
    create_pixels();
    GLuint framebuffer = create_framebuffer();
    hair = create_hair(&host, &context);
    for (int frame = 0; frame < 27; ++frame) check(hair_step(hair, 1.0f / 60));
    hair_buffers strands = get_strands(hair);
    create_strand_memory(strands.position.count * (VkDeviceSize)strands.position.stride, wants_copy);
    create_pipelines(TIPS * strands.strand_vertices * strands.position.stride);
    printf("OpenGL: %s\n", (const char*)glGetString(GL_RENDERER));
    printf("%u strands of %u vertices, %s\n", strands.strand_count, strands.strand_vertices,
           strand_memory.gl_buffer ? "in memory that Vulkan and OpenGL share" : "copied through main memory");
    printf("The interfaces wait for each other by %s.\n", vk.has_semaphores ? "semaphores" : "glFinish");

    const float eye[3] = {0.50f, 1.62f, 0.985f}, target[3] = {0, 1.56f, 0};
    struct camera camera = camera_perspective(eye, target, 0.38f, 4.0f / 3);
    use_depth_of_vulkan(&camera);

    for (int frame = 0; frame < 3; ++frame) {
        check(hair_step(hair, 1.0f / 60));
        draw_frame(hair, &camera, frame == 0);
    }
    write_pixels(path);

    hair_destroy(hair);
    hair_context_destroy(context);
    destroy_strand_buffer();
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteTextures(IMAGES, textures);
    glDeleteMemoryObjectsEXT(IMAGES, memory_objects);
    if (vk.has_semaphores) glDeleteSemaphoresEXT(2, semaphores);
    hair_egl_destroy(egl);
    destroy_vulkan();
    return EXIT_SUCCESS;
}
