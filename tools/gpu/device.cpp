#include "gpu/device.h"

#include <algorithm>

namespace rigel::tools {

GpuDevice::~GpuDevice() {
  if (hanging) return;
  if (device != VK_NULL_HANDLE) {
    vkDeviceWaitIdle(device);
    vkDestroyPipelineCache(device, pipelineCache, nullptr);
    vkDestroyCommandPool(device, commandPool, nullptr);
    vkDestroyDevice(device, nullptr);
  }
  if (messenger != VK_NULL_HANDLE) {
    const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance, "vkDestroyDebugUtilsMessengerEXT"));
    destroy(instance, messenger, nullptr);
  }
  if (instance != VK_NULL_HANDLE) vkDestroyInstance(instance, nullptr);
}

void GpuDevice::note(const std::string& line) {
  if (std::ranges::find(notes, line) == notes.end()) notes.push_back(line);
}

std::optional<Error> GpuDevice::failure() const {
  if (lost) return vulkanError(VK_ERROR_DEVICE_LOST, properties.deviceName);
  if (hanging) return Error{"the device takes no more work: an earlier submission did not end", properties.deviceName};
  return {};
}

}  // namespace rigel::tools
