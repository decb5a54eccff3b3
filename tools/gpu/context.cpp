#include "gpu/context.h"

#include "gpu/device_choice.h"
#include "gpu/instance.h"
#include "gpu/pipeline_cache.h"

#include <cstdlib>

namespace rigel::tools {
namespace {

DeviceWish wishOf(const GpuOptions& options) {
  DeviceWish wish;
  wish.name = options.deviceName;
  const char* name = std::getenv("RIGEL_VULKAN_DEVICE");
  if (wish.name.empty() && name != nullptr) {
    wish.name = name;
    wish.namedBy = "RIGEL_VULKAN_DEVICE=";
  }
  wish.preferCpu = options.preferCpuDevice;
  wish.features = options.features;
  return wish;
}

std::optional<Error> createDevice(GpuDevice& device, const VkPhysicalDeviceFeatures& features) {
  const float priority = 1;
  auto queue = vulkanStruct<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
  queue.queueFamilyIndex = device.queueFamily;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  auto info = vulkanStruct<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.pEnabledFeatures = &features;
  VkResult result = vkCreateDevice(device.physical, &info, nullptr, &device.device);
  if (result != VK_SUCCESS) return vulkanError(result, device.properties.deviceName);
  vkGetDeviceQueue(device.device, device.queueFamily, 0, &device.queue);

  auto pool = vulkanStruct<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
  pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
  pool.queueFamilyIndex = device.queueFamily;
  result = vkCreateCommandPool(device.device, &pool, nullptr, &device.commandPool);
  if (result != VK_SUCCESS) return vulkanError(result, "a command pool");
  return {};
}

std::string versionText(std::uint32_t version) {
  return std::to_string(VK_API_VERSION_MAJOR(version)) + "." + std::to_string(VK_API_VERSION_MINOR(version)) + "." +
         std::to_string(VK_API_VERSION_PATCH(version));
}

}  // namespace

GpuContext::GpuContext(SharedDevice device, std::filesystem::path pipelineCache)
    : device_(std::move(device)), pipelineCache_(std::move(pipelineCache)) {}

Result<GpuContext> GpuContext::create(const GpuOptions& options) {
  if (const auto error = loadVulkan()) return *error;
  const auto features = featuresNamed(options.features);
  if (!features) return features.error();
  auto device = std::make_shared<GpuDevice>();
  device->timeout = options.timeout;
  if (const auto error = createInstance(*device, options.validation)) return *error;
  if (const auto error = chooseDevice(*device, wishOf(options))) return *error;
  if (const auto error = createDevice(*device, *features)) return *error;
  if (const auto error = createPipelineCache(*device, options.pipelineCache)) return *error;
  return GpuContext(std::move(device), options.pipelineCache);
}

std::string GpuContext::versions() const {
  return "Vulkan " + versionText(device_->properties.apiVersion) + ", driver " +
         versionText(device_->properties.driverVersion);
}

std::size_t GpuContext::uniformStride(std::size_t bytes) const {
  const std::size_t alignment = limits().minUniformBufferOffsetAlignment;
  return (bytes + alignment - 1) / alignment * alignment;
}

std::optional<Error> GpuContext::savePipelineCache() const {
  if (pipelineCache_.empty()) return {};
  return tools::savePipelineCache(*device_, pipelineCache_);
}

}  // namespace rigel::tools
