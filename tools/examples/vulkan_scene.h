// vulkan_scene.h - A device of Vulkan, triangles and beads that it draws, and the pixels as a file.
// Nothing here is about hair.
#ifndef TOOLS_EXAMPLES_VULKAN_SCENE_H
#define TOOLS_EXAMPLES_VULKAN_SCENE_H

#include "common.h"
#include <math.h>
#include <stdbool.h>
#include <vulkan/vulkan.h>

// glslc -mfmt=c compiles these files from shaders beside this header.
static const uint32_t vertex_code[] =
#include "vulkan_scene.vert.inc"
    ;
static const uint32_t bead_code[] =
#include "vulkan_beads.vert.inc"
    ;
static const uint32_t fragment_code[] =
#include "vulkan_scene.frag.inc"
    ;

enum { COLOR, DEPTH, IMAGES };
// Colours are linear, of 16 bits.
static const VkFormat formats[IMAGES] = {VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_D32_SFLOAT};
static const VkImageAspectFlags aspects[IMAGES] = {VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_ASPECT_DEPTH_BIT};
// Images are in this layout for the whole frame, in both interfaces.
static const VkImageLayout layout = VK_IMAGE_LAYOUT_GENERAL;
static struct vulkan {
    uint32_t width, height;
    VkInstance instance;
    VkPhysicalDevice physical;
    VkDevice device;
    uint32_t family;
    VkQueue queue;
    VkCommandPool pool;
    VkCommandBuffer commands[2]; // Before hair, and after hair.
    VkImage images[IMAGES];
    VkDeviceMemory memories[IMAGES];
    VkImageView views[IMAGES];
    VkPipelineLayout pipeline_layout;
    VkPipeline triangles, beads;
    VkBuffer pixels;
    VkDeviceMemory pixel_memory;
    bool has_semaphores; // True if semaphores order the work of both interfaces.
    VkSemaphore semaphores[2];
} vk;

// Stop the program unless a call of Vulkan succeeded.
static void vk_check(VkResult result)
{
    if (result < 0) fprintf(stderr, "Vulkan: error %d\n", result), exit(EXIT_FAILURE);
}

// Select the device of a UUID.
static void select_device(const unsigned char uuid[VK_UUID_SIZE])
{
    VkPhysicalDevice devices[16];
    uint32_t count = 16;
    vk_check(vkEnumeratePhysicalDevices(vk.instance, &count, devices));
    for (uint32_t i = 0; i < count && !vk.physical; ++i) {
        VkPhysicalDeviceIDProperties id = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ID_PROPERTIES};
        VkPhysicalDeviceProperties2 properties = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &id, {0}};
        vkGetPhysicalDeviceProperties2(devices[i], &properties);
        if (memcmp(id.deviceUUID, uuid, VK_UUID_SIZE) != 0) continue;
        vk.physical = devices[i];
        printf("Vulkan: %s\n", properties.properties.deviceName);
    }
    if (!vk.physical) fail("Vulkan does not have the device of the OpenGL context.");
}

// Return the index of the first family of queues that draws.
static uint32_t find_queue_family(void)
{
    VkQueueFamilyProperties families[16];
    uint32_t count = 16;
    vkGetPhysicalDeviceQueueFamilyProperties(vk.physical, &count, families);
    for (uint32_t i = 0; i < count; ++i)
        if (families[i].queueFlags & VK_QUEUE_GRAPHICS_BIT) return i;
    fail("The device does not draw.");
    return 0;
}

// Create the device of a UUID. Semaphores need one more extension.
static void create_device(const unsigned char uuid[VK_UUID_SIZE], bool has_semaphores)
{
    const VkApplicationInfo application = {VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                           .apiVersion = VK_API_VERSION_1_3};
    const VkInstanceCreateInfo instance = {VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                           .pApplicationInfo = &application};
    const float priority = 1;
    const VkPhysicalDeviceVulkan13Features features = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES,
                                                       .dynamicRendering = VK_TRUE};
    const char* extensions[] = {VK_KHR_EXTERNAL_MEMORY_FD_EXTENSION_NAME,
                                VK_KHR_EXTERNAL_SEMAPHORE_FD_EXTENSION_NAME};
    vk_check(vkCreateInstance(&instance, NULL, &vk.instance));
    select_device(uuid);
    vk.family = find_queue_family();
    vk.has_semaphores = has_semaphores;
    const VkDeviceQueueCreateInfo queue = {VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                           .queueFamilyIndex = vk.family, .queueCount = 1,
                                           .pQueuePriorities = &priority};
    const VkDeviceCreateInfo device = {VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                       .pNext = (void*)&features,
                                       .queueCreateInfoCount = 1,
                                       .pQueueCreateInfos = &queue,
                                       .enabledExtensionCount = vk.has_semaphores ? 2 : 1,
                                       .ppEnabledExtensionNames = extensions};
    const VkCommandPoolCreateInfo pool = {VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                          .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                                          .queueFamilyIndex = vk.family};
    vk_check(vkCreateDevice(vk.physical, &device, NULL, &vk.device));
    vkGetDeviceQueue(vk.device, vk.family, 0, &vk.queue);
    vk_check(vkCreateCommandPool(vk.device, &pool, NULL, &vk.pool));
    const VkCommandBufferAllocateInfo commands = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, NULL,
                                                  vk.pool, VK_COMMAND_BUFFER_LEVEL_PRIMARY, 2};
    vk_check(vkAllocateCommandBuffers(vk.device, &commands, vk.commands));
}

// Return the index of a type of memory with the properties.
static uint32_t find_memory(uint32_t types, VkMemoryPropertyFlags wanted)
{
    VkPhysicalDeviceMemoryProperties properties;
    vkGetPhysicalDeviceMemoryProperties(vk.physical, &properties);
    for (uint32_t i = 0; i < properties.memoryTypeCount; ++i)
        if (types >> i & 1 && (properties.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
    fail("Vulkan has no such memory.");
    return 0;
}

static VkPipelineShaderStageCreateInfo make_stage(VkShaderStageFlagBits stage, const uint32_t* code,
                                                  size_t size)
{
    const VkShaderModuleCreateInfo module = {VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, NULL, 0, size,
                                             code};
    VkPipelineShaderStageCreateInfo out = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                                           .stage = stage, .pName = "main"};
    vk_check(vkCreateShaderModule(vk.device, &module, NULL, &out.module));
    return out;
}

static VkPipeline create_pipeline(const VkPipelineVertexInputStateCreateInfo* vertices, const uint32_t* code,
                                  size_t size)
{
    VkPipeline out;
    const VkPipelineShaderStageCreateInfo stages[] = {
        make_stage(VK_SHADER_STAGE_VERTEX_BIT, code, size),
        make_stage(VK_SHADER_STAGE_FRAGMENT_BIT, fragment_code, sizeof fragment_code)};
    // A viewport of negative height has +y upwards, as OpenGL has it.
    const float width = (float)vk.width, height = (float)vk.height;
    const VkViewport viewport = {0, height, width, -height, 0, 1};
    const VkRect2D scissor = {{0, 0}, {vk.width, vk.height}};
    const VkPipelineColorBlendAttachmentState write = {.colorWriteMask = 15};
    const VkPipelineRenderingCreateInfo rendering = {
        VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO, .colorAttachmentCount = 1,
        .pColorAttachmentFormats = &formats[COLOR], .depthAttachmentFormat = formats[DEPTH]};
    const VkPipelineInputAssemblyStateCreateInfo assembly = {
        VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
    const VkPipelineViewportStateCreateInfo view = {VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
                                                    .viewportCount = 1, .pViewports = &viewport,
                                                    .scissorCount = 1, .pScissors = &scissor};
    const VkPipelineRasterizationStateCreateInfo raster = {
        VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO, .lineWidth = 1};
    const VkPipelineMultisampleStateCreateInfo samples = {
        VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO, .rasterizationSamples = 1};
    const VkPipelineDepthStencilStateCreateInfo depth = {
        VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO, .depthTestEnable = VK_TRUE,
        .depthWriteEnable = VK_TRUE, .depthCompareOp = VK_COMPARE_OP_LESS};
    const VkPipelineColorBlendStateCreateInfo blend = {
        VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO, .attachmentCount = 1,
        .pAttachments = &write};
    const VkGraphicsPipelineCreateInfo pipeline = {VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                                   .pNext = &rendering,
                                                   .stageCount = 2,
                                                   .pStages = stages,
                                                   .pVertexInputState = vertices,
                                                   .pInputAssemblyState = &assembly,
                                                   .pViewportState = &view,
                                                   .pRasterizationState = &raster,
                                                   .pMultisampleState = &samples,
                                                   .pDepthStencilState = &depth,
                                                   .pColorBlendState = &blend,
                                                   .layout = vk.pipeline_layout};
    vk_check(vkCreateGraphicsPipelines(vk.device, VK_NULL_HANDLE, 1, &pipeline, NULL, &out));
    for (int i = 0; i < 2; ++i) vkDestroyShaderModule(vk.device, stages[i].module, NULL);
    return out;
}

// Create the pipelines. A bead is an instance. Its only attribute is a position.
static void create_pipelines(uint32_t bead_stride)
{
    const VkPushConstantRange clip = {VK_SHADER_STAGE_VERTEX_BIT, 0, 64};
    const VkPipelineLayoutCreateInfo pipeline_layout = {VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                                        .pushConstantRangeCount = 1,
                                                        .pPushConstantRanges = &clip};
    const VkVertexInputBindingDescription bead = {0, bead_stride, VK_VERTEX_INPUT_RATE_INSTANCE};
    const VkVertexInputAttributeDescription position = {0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0};
    VkPipelineVertexInputStateCreateInfo vertices = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    vk_check(vkCreatePipelineLayout(vk.device, &pipeline_layout, NULL, &vk.pipeline_layout));
    vk.triangles = create_pipeline(&vertices, vertex_code, sizeof vertex_code);
    vertices.vertexBindingDescriptionCount = vertices.vertexAttributeDescriptionCount = 1;
    vertices.pVertexBindingDescriptions = &bead;
    vertices.pVertexAttributeDescriptions = &position;
    vk.beads = create_pipeline(&vertices, bead_code, sizeof bead_code);
}

// Create a buffer for the pixels that the program writes into a file.
static void create_pixels(void)
{
    const VkBufferCreateInfo buffer = {VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                       .size = 8 * (VkDeviceSize)vk.width * vk.height,
                                       .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT};
    VkMemoryRequirements needs;
    vk_check(vkCreateBuffer(vk.device, &buffer, NULL, &vk.pixels));
    vkGetBufferMemoryRequirements(vk.device, vk.pixels, &needs);
    const VkMemoryAllocateInfo allocation = {
        VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, NULL, needs.size,
        find_memory(needs.memoryTypeBits,
                    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT)};
    vk_check(vkAllocateMemory(vk.device, &allocation, NULL, &vk.pixel_memory));
    vk_check(vkBindBufferMemory(vk.device, vk.pixels, vk.pixel_memory, 0));
}

static void begin_drawing(VkCommandBuffer commands, VkPipeline pipeline, VkAttachmentLoadOp load,
                          const float clip[16])
{
    const VkClearValue clear[IMAGES] = {{.color = {{0.16f, 0.19f, 0.24f, 1}}}, {.depthStencil = {1, 0}}};
    VkRenderingAttachmentInfo attachments[IMAGES];
    for (int i = 0; i < IMAGES; ++i)
        attachments[i] = (VkRenderingAttachmentInfo){VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                                     .imageView = vk.views[i],
                                                     .imageLayout = layout,
                                                     .loadOp = load,
                                                     .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                                     .clearValue = clear[i]};
    const VkRenderingInfo rendering = {VK_STRUCTURE_TYPE_RENDERING_INFO,
                                       .renderArea = {{0, 0}, {vk.width, vk.height}},
                                       .layerCount = 1,
                                       .colorAttachmentCount = 1,
                                       .pColorAttachments = &attachments[COLOR],
                                       .pDepthAttachment = &attachments[DEPTH]};
    vkCmdBeginRendering(commands, &rendering);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdPushConstants(commands, vk.pipeline_layout, VK_SHADER_STAGE_VERTEX_BIT, 0, 64, clip);
}

// Draw a triangle. The first one clears the images.
static void draw_triangle(VkCommandBuffer commands, uint32_t triangle, const float clip[16])
{
    const VkAttachmentLoadOp load = triangle ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_CLEAR;
    begin_drawing(commands, vk.triangles, load, clip);
    vkCmdDraw(commands, 3, 1, 3 * triangle, 0);
    vkCmdEndRendering(commands);
}

// Draw beads at positions of a buffer, which begin at an offset.
static void draw_beads(VkCommandBuffer commands, VkBuffer positions, VkDeviceSize offset, uint32_t count,
                       const float clip[16])
{
    begin_drawing(commands, vk.beads, VK_ATTACHMENT_LOAD_OP_LOAD, clip);
    vkCmdBindVertexBuffers(commands, 0, 1, &positions, &offset);
    vkCmdDraw(commands, 3, count, 0, 0);
    vkCmdEndRendering(commands);
}

static VkCommandBuffer begin(int number)
{
    const VkCommandBufferBeginInfo info = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    vk_check(vkBeginCommandBuffer(vk.commands[number], &info));
    return vk.commands[number];
}

// Submit commands. They wait for a semaphore and signal another, or the call waits for the GPU.
static void submit(VkCommandBuffer commands, const VkSemaphore* waits, const VkSemaphore* signals)
{
    const VkPipelineStageFlags stage = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
    const VkSubmitInfo info = {VK_STRUCTURE_TYPE_SUBMIT_INFO,
                               .waitSemaphoreCount = vk.has_semaphores && waits,
                               .pWaitSemaphores = waits,
                               .pWaitDstStageMask = &stage,
                               .commandBufferCount = 1,
                               .pCommandBuffers = &commands,
                               .signalSemaphoreCount = vk.has_semaphores && signals,
                               .pSignalSemaphores = signals};
    vk_check(vkEndCommandBuffer(commands));
    vk_check(vkQueueSubmit(vk.queue, 1, &info, VK_NULL_HANDLE));
    if (!vk.has_semaphores || !signals) vk_check(vkQueueWaitIdle(vk.queue));
}

// Copy the colours to the buffer of pixels.
static void copy_pixels(VkCommandBuffer commands)
{
    const VkBufferImageCopy all = {.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                   .imageExtent = {vk.width, vk.height, 1}};
    const VkMemoryBarrier written = {VK_STRUCTURE_TYPE_MEMORY_BARRIER, NULL, VK_ACCESS_MEMORY_WRITE_BIT,
                                     VK_ACCESS_TRANSFER_READ_BIT};
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 1,
                         &written, 0, NULL, 0, NULL);
    vkCmdCopyImageToBuffer(commands, vk.images[COLOR], layout, vk.pixels, 1, &all);
}

// Return a linear colour of 16 bits as a byte of sRGB.
static unsigned char encode(uint16_t half)
{
    int exponent = half >> 10 & 31;
    float fraction = (float)(half & 1023) / 1024;
    float value = exponent ? ldexpf(1 + fraction, exponent - 15) : ldexpf(fraction, -14);
    if (half >> 15) return 0;
    if (value > 1) value = 1;
    value = value <= 0.0031308f ? 12.92f * value : 1.055f * powf(value, 1 / 2.4f) - 0.055f;
    return (unsigned char)(255 * value + 0.5f);
}

// Write the pixels into a PPM file. The first row is the highest one in both.
static void write_pixels(const char* path)
{
    const uint16_t(*rgba)[4];
    FILE* file = fopen(path, "wb");
    if (!file) fail("The picture cannot be written.");
    vk_check(vkMapMemory(vk.device, vk.pixel_memory, 0, VK_WHOLE_SIZE, 0, (void**)&rgba));
    fprintf(file, "P6\n%u %u\n255\n", vk.width, vk.height);
    for (size_t i = 0; i < (size_t)vk.width * vk.height; ++i)
        for (int k = 0; k < 3; ++k) fputc(encode(rgba[i][k]), file);
    if (fclose(file)) fail("The picture cannot be written.");
}

static void destroy_vulkan(void)
{
    for (int i = 0; i < 2; ++i) vkDestroySemaphore(vk.device, vk.semaphores[i], NULL);
    for (int i = 0; i < IMAGES; ++i) {
        vkDestroyImageView(vk.device, vk.views[i], NULL);
        vkDestroyImage(vk.device, vk.images[i], NULL);
        vkFreeMemory(vk.device, vk.memories[i], NULL);
    }
    vkDestroyBuffer(vk.device, vk.pixels, NULL);
    vkFreeMemory(vk.device, vk.pixel_memory, NULL);
    vkDestroyPipeline(vk.device, vk.triangles, NULL);
    vkDestroyPipeline(vk.device, vk.beads, NULL);
    vkDestroyPipelineLayout(vk.device, vk.pipeline_layout, NULL);
    vkDestroyCommandPool(vk.device, vk.pool, NULL);
    vkDestroyDevice(vk.device, NULL);
    vkDestroyInstance(vk.instance, NULL);
}

#endif
