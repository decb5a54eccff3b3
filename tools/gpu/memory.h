// Device memory for one buffer or image.
#pragma once

#include "gpu/device.h"

#include <string>

namespace rigel::tools {

enum class MemoryUse {
  device,    // the device alone
  upload,    // written by the host in order, read by the device
  readBack,  // written by the device, read by the host
};

struct GpuMemory {
  VkDeviceMemory handle = VK_NULL_HANDLE;
  std::byte* mapped = nullptr;  // for as long as it exists; nullptr: MemoryUse::device
};

/// Tries the kinds of memory that serve, best first; running out of one (a small window to a GPU's memory, say) leads
/// to the next. `what` names the thing in errors.
Result<GpuMemory> allocateMemory(const GpuDevice& device, const VkMemoryRequirements& needs, MemoryUse use,
                                 const std::string& what);

}  // namespace rigel::tools
