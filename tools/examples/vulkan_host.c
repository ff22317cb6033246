// vulkan_host.c - Hair in a renderer of Vulkan. Vulkan owns the images of colour and depth, and the
// library draws into them by OpenGL. Hair and triangles of Vulkan hide each other.
//
//     vulkan_host [FILE.ppm [WIDTH]]
#include "camera.h"
#include "vulkan_scene.h"
#include <hair/hair_egl.h>

enum { TO_OPENGL, TO_VULKAN }; // Semaphores.
static const GLenum gl_formats[IMAGES] = {GL_RGBA16F, GL_DEPTH_COMPONENT32F};
static const GLenum gl_layouts[IMAGES] = {GL_LAYOUT_GENERAL_EXT, GL_LAYOUT_GENERAL_EXT};

static GLuint memory_objects[IMAGES], textures[IMAGES], semaphores[2];

// Return the address of a function of an extension.
#define VK_FUNCTION(name) ((PFN_##name)vkGetDeviceProcAddr(vk.device, #name))

// Create an image in memory of its own, and an OpenGL texture in the same memory.
static void create_image(int which)
{
    static const VkImageUsageFlags usages[] = {
        VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
        VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT};
    const VkExternalMemoryImageCreateInfo external = {VK_STRUCTURE_TYPE_EXTERNAL_MEMORY_IMAGE_CREATE_INFO,
                                                      NULL, VK_EXTERNAL_MEMORY_HANDLE_TYPE_OPAQUE_FD_BIT};
    const VkImageCreateInfo image = {VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                     .pNext = &external,
                                     .imageType = VK_IMAGE_TYPE_2D,
                                     .format = formats[which],
                                     .extent = {vk.width, vk.height, 1},
                                     .mipLevels = 1,
                                     .arrayLayers = 1,
                                     .samples = VK_SAMPLE_COUNT_1_BIT,
                                     .usage = usages[which]};
    VkMemoryRequirements needs;
    vk_check(vkCreateImage(vk.device, &image, NULL, &vk.images[which]));
    vkGetImageMemoryRequirements(vk.device, vk.images[which], &needs);
    const VkMemoryDedicatedAllocateInfo dedicated = {VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO, NULL,
                                                     vk.images[which], VK_NULL_HANDLE};
    const VkExportMemoryAllocateInfo export = {VK_STRUCTURE_TYPE_EXPORT_MEMORY_ALLOCATE_INFO, &dedicated,
                                               VK_EXTERNAL_MEMORY_HANDLE_TYPE_OPAQUE_FD_BIT};
    const VkMemoryAllocateInfo allocation = {
        VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, &export, needs.size,
        find_memory(needs.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT)};
    vk_check(vkAllocateMemory(vk.device, &allocation, NULL, &vk.memories[which]));
    vk_check(vkBindImageMemory(vk.device, vk.images[which], vk.memories[which], 0));
    const VkImageViewCreateInfo view = {VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO, .image = vk.images[which],
                                        .viewType = VK_IMAGE_VIEW_TYPE_2D, .format = formats[which],
                                        .subresourceRange = {aspects[which], 0, 1, 0, 1}};
    vk_check(vkCreateImageView(vk.device, &view, NULL, &vk.views[which]));

    const VkMemoryGetFdInfoKHR get = {VK_STRUCTURE_TYPE_MEMORY_GET_FD_INFO_KHR, NULL, vk.memories[which],
                                      VK_EXTERNAL_MEMORY_HANDLE_TYPE_OPAQUE_FD_BIT};
    const GLint is_dedicated = GL_TRUE;
    int file;
    vk_check(VK_FUNCTION(vkGetMemoryFdKHR)(vk.device, &get, &file));
    glCreateMemoryObjectsEXT(1, &memory_objects[which]);
    glMemoryObjectParameterivEXT(memory_objects[which], GL_DEDICATED_MEMORY_OBJECT_EXT, &is_dedicated);
    // OpenGL owns the file from here on.
    glImportMemoryFdEXT(memory_objects[which], needs.size, GL_HANDLE_TYPE_OPAQUE_FD_EXT, file);
    glCreateTextures(GL_TEXTURE_2D, 1, &textures[which]);
    glTextureStorageMem2DEXT(textures[which], 1, gl_formats[which], (GLsizei)vk.width, (GLsizei)vk.height,
                             memory_objects[which], 0);
    if (glGetError() != GL_NO_ERROR) fail("OpenGL refuses the memory of an image.");
}

// Create a semaphore of both interfaces.
static void create_semaphore(int which)
{
    const VkExportSemaphoreCreateInfo export = {VK_STRUCTURE_TYPE_EXPORT_SEMAPHORE_CREATE_INFO, NULL,
                                                VK_EXTERNAL_SEMAPHORE_HANDLE_TYPE_OPAQUE_FD_BIT};
    const VkSemaphoreCreateInfo semaphore = {VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, &export, 0};
    vk_check(vkCreateSemaphore(vk.device, &semaphore, NULL, &vk.semaphores[which]));
    const VkSemaphoreGetFdInfoKHR get = {VK_STRUCTURE_TYPE_SEMAPHORE_GET_FD_INFO_KHR, NULL,
                                         vk.semaphores[which],
                                         VK_EXTERNAL_SEMAPHORE_HANDLE_TYPE_OPAQUE_FD_BIT};
    int file;
    vk_check(VK_FUNCTION(vkGetSemaphoreFdKHR)(vk.device, &get, &file));
    glGenSemaphoresEXT(1, &semaphores[which]);
    glImportSemaphoreFdEXT(semaphores[which], GL_HANDLE_TYPE_OPAQUE_FD_EXT, file);
}

// Make writes to the images visible, and hand the images from one owner to another.
static void hand_over(VkCommandBuffer commands, VkImageLayout from, uint32_t owner, uint32_t next)
{
    VkImageMemoryBarrier barriers[IMAGES];
    for (int i = 0; i < IMAGES; ++i)
        barriers[i] = (VkImageMemoryBarrier){VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
                                             NULL,
                                             VK_ACCESS_MEMORY_WRITE_BIT,
                                             VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT,
                                             from,
                                             layout,
                                             owner,
                                             next,
                                             vk.images[i],
                                             {aspects[i], 0, 1, 0, 1}};
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0,
                         0, NULL, 0, NULL, IMAGES, barriers);
}

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
    if (vk.has_semaphores) glWaitSemaphoreEXT(semaphores[TO_OPENGL], 0, NULL, IMAGES, textures, gl_layouts);
    view.pass = HAIR_PASS_COLLIDERS; // An engine draws its own head.
    check(hair_draw(hair, &view));
    view.pass = HAIR_PASS_COLOR;
    view.coverage = HAIR_COVERAGE_ALPHA; // It blends, and writes no depth.
    check(hair_draw(hair, &view));
    view.pass = HAIR_PASS_DEPTH;
    view.coverage = HAIR_COVERAGE_MSAA;
    check(hair_draw(hair, &view));
    if (!vk.has_semaphores)
        glFinish();
    else
        glSignalSemaphoreEXT(semaphores[TO_VULKAN], 0, NULL, IMAGES, textures, gl_layouts), glFlush();
}

int main(int argc, char** argv)
{
    const char* path = argc > 1 ? argv[1] : "vulkan_host.ppm";
    int width = argc > 2 ? (int)strtol(argv[2], NULL, 10) : 800;
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
    create_pipeline();
    create_pixels();
    GLuint framebuffer = create_framebuffer();
    hair = create_hair(&host, &context);
    for (int frame = 0; frame < 30; ++frame) check(hair_step(hair, 1.0f / 60));

    const float eye[3] = {0.50f, 1.62f, 0.985f}, target[3] = {0, 1.56f, 0};
    struct camera camera = camera_perspective(eye, target, 0.38f, 4.0f / 3);
    use_depth_of_vulkan(&camera);

    VkCommandBuffer commands = begin(0);
    hand_over(commands, VK_IMAGE_LAYOUT_UNDEFINED, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED);
    draw_triangle(commands, 0, camera.clip);
    hand_over(commands, layout, vk.family, VK_QUEUE_FAMILY_EXTERNAL);
    submit(commands, NULL, &vk.semaphores[TO_OPENGL]);

    draw_hair(hair, &camera);

    commands = begin(1);
    hand_over(commands, layout, VK_QUEUE_FAMILY_EXTERNAL, vk.family);
    draw_triangle(commands, 1, camera.clip);
    copy_pixels(commands);
    submit(commands, &vk.semaphores[TO_VULKAN], NULL);
    write_pixels(path);

    hair_destroy(hair);
    hair_context_destroy(context);
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteTextures(IMAGES, textures);
    glDeleteMemoryObjectsEXT(IMAGES, memory_objects);
    if (vk.has_semaphores) glDeleteSemaphoresEXT(2, semaphores);
    hair_egl_destroy(egl);
    destroy_vulkan();
    return EXIT_SUCCESS;
}
