// vulkan_shared.h - Images, semaphores and a buffer that Vulkan and OpenGL share.
#ifndef TOOLS_EXAMPLES_VULKAN_SHARED_H
#define TOOLS_EXAMPLES_VULKAN_SHARED_H

#include "vulkan_scene.h"

enum { TO_OPENGL, TO_VULKAN }; // Semaphores.
static const GLenum gl_formats[IMAGES] = {GL_RGBA16F, GL_DEPTH_COMPONENT32F};
static const GLenum gl_layouts[IMAGES] = {GL_LAYOUT_GENERAL_EXT, GL_LAYOUT_GENERAL_EXT};

static GLuint memory_objects[IMAGES], textures[IMAGES], semaphores[2];

// Memory of Vulkan for positions of strands.
static struct strand_memory {
    VkBuffer buffer;
    VkDeviceMemory memory;
    VkDeviceSize size;
    GLuint memory_object, gl_buffer; // 0 if OpenGL does not share the buffer.
    void* mapped; // Address for the processor. NULL if OpenGL shares the buffer.
} strand_memory;

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

// Create the buffer of Vulkan, in memory that OpenGL shares or that the processor writes to.
static void create_strand_buffer(bool is_shared)
{
    const VkExternalMemoryBufferCreateInfo external = {VK_STRUCTURE_TYPE_EXTERNAL_MEMORY_BUFFER_CREATE_INFO,
                                                       NULL, VK_EXTERNAL_MEMORY_HANDLE_TYPE_OPAQUE_FD_BIT};
    const VkBufferCreateInfo buffer = {VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                       .pNext = is_shared ? &external : NULL, .size = strand_memory.size,
                                       .usage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT};
    const VkMemoryPropertyFlags properties =
        is_shared ? VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT
                  : VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    VkMemoryRequirements needs;
    vk_check(vkCreateBuffer(vk.device, &buffer, NULL, &strand_memory.buffer));
    vkGetBufferMemoryRequirements(vk.device, strand_memory.buffer, &needs);
    const VkExportMemoryAllocateInfo export = {VK_STRUCTURE_TYPE_EXPORT_MEMORY_ALLOCATE_INFO, NULL,
                                               VK_EXTERNAL_MEMORY_HANDLE_TYPE_OPAQUE_FD_BIT};
    const VkMemoryAllocateInfo allocation = {VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                             is_shared ? &export : NULL, needs.size,
                                             find_memory(needs.memoryTypeBits, properties)};
    vk_check(vkAllocateMemory(vk.device, &allocation, NULL, &strand_memory.memory));
    vk_check(vkBindBufferMemory(vk.device, strand_memory.buffer, strand_memory.memory, 0));
    if (!is_shared) {
        vk_check(vkMapMemory(vk.device, strand_memory.memory, 0, VK_WHOLE_SIZE, 0, &strand_memory.mapped));
        return;
    }
    const VkMemoryGetFdInfoKHR get = {VK_STRUCTURE_TYPE_MEMORY_GET_FD_INFO_KHR, NULL, strand_memory.memory,
                                      VK_EXTERNAL_MEMORY_HANDLE_TYPE_OPAQUE_FD_BIT};
    int file;
    vk_check(VK_FUNCTION(vkGetMemoryFdKHR)(vk.device, &get, &file));
    glCreateMemoryObjectsEXT(1, &strand_memory.memory_object);
    glImportMemoryFdEXT(strand_memory.memory_object, needs.size, GL_HANDLE_TYPE_OPAQUE_FD_EXT, file);
    glCreateBuffers(1, &strand_memory.gl_buffer);
    glNamedBufferStorageMemEXT(strand_memory.gl_buffer, (GLsizeiptr)strand_memory.size,
                               strand_memory.memory_object, 0);
}

static void destroy_strand_buffer(void)
{
    glDeleteBuffers(1, &strand_memory.gl_buffer);
    if (strand_memory.memory_object) glDeleteMemoryObjectsEXT(1, &strand_memory.memory_object);
    vkDestroyBuffer(vk.device, strand_memory.buffer, NULL);
    vkFreeMemory(vk.device, strand_memory.memory, NULL);
    strand_memory = (struct strand_memory){.size = strand_memory.size};
}

// Create memory for the strands. llvmpipe refuses to share buffers by GL_OUT_OF_MEMORY. The strands
// then go through main memory.
static void create_strand_memory(VkDeviceSize size, bool wants_copy)
{
    strand_memory.size = size;
    create_strand_buffer(!wants_copy);
    if (glGetError() == GL_NO_ERROR) return;
    destroy_strand_buffer();
    create_strand_buffer(false);
}

// Copy positions from a buffer of the library to Vulkan. A compute shader wrote the positions.
static void write_strands(GLuint from, GLintptr offset)
{
    const GLsizeiptr size = (GLsizeiptr)strand_memory.size;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    if (strand_memory.gl_buffer)
        glCopyNamedBufferSubData(from, strand_memory.gl_buffer, offset, 0, size);
    else
        glGetNamedBufferSubData(from, offset, size, strand_memory.mapped);
}

// Wait for a semaphore of Vulkan, which hands over the images and the strands.
static void wait_for_vulkan(void)
{
    glWaitSemaphoreEXT(semaphores[TO_OPENGL], strand_memory.gl_buffer != 0, &strand_memory.gl_buffer, IMAGES,
                       textures, gl_layouts);
}

// Signal a semaphore of Vulkan, which hands over the images and the strands.
static void signal_vulkan(void)
{
    glSignalSemaphoreEXT(semaphores[TO_VULKAN], strand_memory.gl_buffer != 0, &strand_memory.gl_buffer,
                         IMAGES, textures, gl_layouts);
    glFlush();
}

// Make writes to shared memory visible, and hand the memory from one owner to another.
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
    const VkBufferMemoryBarrier strands = {VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER,
                                           NULL,
                                           VK_ACCESS_MEMORY_WRITE_BIT,
                                           VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT,
                                           owner,
                                           next,
                                           strand_memory.buffer,
                                           0,
                                           VK_WHOLE_SIZE};
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0,
                         0, NULL, strand_memory.gl_buffer != 0, &strands, IMAGES, barriers);
}

#endif
