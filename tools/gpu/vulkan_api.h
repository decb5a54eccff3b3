// The Vulkan functions that Rigel calls, looked up in the system's loader when a program first asks for a device: a
// machine without Vulkan runs everything else, and learns what to install. Tests put failing functions in their place.
#pragma once

#define VK_NO_PROTOTYPES
#include <rigel/result.h>
#include <vulkan/vulkan_core.h>

#include <optional>

// clang-format off
#define RIGEL_VULKAN_FUNCTIONS(X) \
  X(vkEnumerateInstanceVersion) X(vkEnumerateInstanceLayerProperties) X(vkEnumerateInstanceExtensionProperties) \
  X(vkCreateInstance) X(vkDestroyInstance) X(vkGetInstanceProcAddr) X(vkEnumeratePhysicalDevices) \
  X(vkGetPhysicalDeviceProperties) X(vkGetPhysicalDeviceFeatures) X(vkGetPhysicalDeviceFormatProperties) \
  X(vkGetPhysicalDeviceMemoryProperties) X(vkGetPhysicalDeviceQueueFamilyProperties) \
  X(vkCreateDevice) X(vkDestroyDevice) X(vkGetDeviceQueue) X(vkDeviceWaitIdle) \
  X(vkCreateCommandPool) X(vkDestroyCommandPool) X(vkAllocateCommandBuffers) X(vkFreeCommandBuffers) \
  X(vkBeginCommandBuffer) X(vkEndCommandBuffer) X(vkQueueSubmit) \
  X(vkCreateFence) X(vkDestroyFence) X(vkResetFences) X(vkWaitForFences) \
  X(vkCreateQueryPool) X(vkDestroyQueryPool) X(vkGetQueryPoolResults) X(vkCmdResetQueryPool) X(vkCmdWriteTimestamp) \
  X(vkAllocateMemory) X(vkFreeMemory) X(vkMapMemory) \
  X(vkCreateBuffer) X(vkDestroyBuffer) X(vkGetBufferMemoryRequirements) X(vkBindBufferMemory) \
  X(vkCreateBufferView) X(vkDestroyBufferView) \
  X(vkCreateImage) X(vkDestroyImage) X(vkGetImageMemoryRequirements) X(vkBindImageMemory) \
  X(vkCreateImageView) X(vkDestroyImageView) X(vkCreateSampler) X(vkDestroySampler) \
  X(vkCreateShaderModule) X(vkDestroyShaderModule) X(vkCreatePipelineCache) X(vkDestroyPipelineCache) \
  X(vkGetPipelineCacheData) X(vkCreateDescriptorSetLayout) X(vkDestroyDescriptorSetLayout) \
  X(vkCreatePipelineLayout) X(vkDestroyPipelineLayout) X(vkCreateComputePipelines) X(vkCreateGraphicsPipelines) \
  X(vkDestroyPipeline) X(vkCreateDescriptorPool) X(vkDestroyDescriptorPool) X(vkAllocateDescriptorSets) \
  X(vkUpdateDescriptorSets) X(vkCreateRenderPass) X(vkDestroyRenderPass) X(vkCreateFramebuffer) X(vkDestroyFramebuffer) \
  X(vkCmdBindPipeline) X(vkCmdBindDescriptorSets) X(vkCmdPushConstants) X(vkCmdDispatch) X(vkCmdPipelineBarrier) \
  X(vkCmdCopyBuffer) X(vkCmdCopyBufferToImage) X(vkCmdCopyImageToBuffer) X(vkCmdBeginRenderPass) X(vkCmdEndRenderPass) \
  X(vkCmdSetViewport) X(vkCmdSetScissor) X(vkCmdBindVertexBuffers) X(vkCmdBindIndexBuffer) X(vkCmdDraw) X(vkCmdDrawIndexed)
// clang-format on

namespace rigel::tools {

#define RIGEL_DECLARE(name) extern PFN_##name name;
RIGEL_VULKAN_FUNCTIONS(RIGEL_DECLARE)
#undef RIGEL_DECLARE

/// Looks the functions up, once in a process. An error says what to install.
std::optional<Error> loadVulkan();

/// What a failed call means to a user: its cause in words, its name in Vulkan, and what was being done.
Error vulkanError(VkResult result, const std::string& doing);

/// A structure that says what it is and is zero otherwise.
template <class T>
T vulkanStruct(VkStructureType type) {
  T made{};
  made.sType = type;
  return made;
}

}  // namespace rigel::tools
