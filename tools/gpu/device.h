// The device behind a GpuContext. Every buffer, image and pipeline holds a share of it, so that they may be destroyed
// in any order.
#pragma once

#include "gpu/messages.h"
#include "gpu/vulkan_api.h"

#include <atomic>
#include <memory>
#include <string>
#include <vector>

namespace rigel::tools {

struct GpuDevice {
  GpuDevice() = default;
  ~GpuDevice();
  GpuDevice(const GpuDevice&) = delete;
  GpuDevice& operator=(const GpuDevice&) = delete;

  /// Adds it to `notes`, once.
  void note(const std::string& line);

  /// The device takes no more work: an earlier submission was lost, or did not end in time.
  std::optional<Error> failure() const;

  VkInstance instance = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  std::uint32_t queueFamily = 0;
  VkQueue queue = VK_NULL_HANDLE;
  VkCommandPool commandPool = VK_NULL_HANDLE;
  VkPipelineCache pipelineCache = VK_NULL_HANDLE;

  VkPhysicalDeviceProperties properties{};
  VkPhysicalDeviceMemoryProperties memory{};
  std::uint32_t timestampBits = 0;  // 0: the queue has no timestamps
  double timeout = 0;               // s

  bool lost = false;     // after VK_ERROR_DEVICE_LOST
  bool hanging = false;  // after a time-out: its objects may still be in use, so they are abandoned
  std::atomic<int> shaderModulesCreated = 0;
  std::atomic<int> pipelinesCreated = 0;
  std::vector<std::string> notes;
  std::shared_ptr<GpuMessages> messages = std::make_shared<GpuMessages>();
};

using SharedDevice = std::shared_ptr<GpuDevice>;

}  // namespace rigel::tools
