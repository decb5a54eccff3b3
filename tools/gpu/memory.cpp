#include "gpu/memory.h"

#include <algorithm>
#include <bit>

namespace rigel::tools {
namespace {

struct Wish {
  VkMemoryPropertyFlags needed;
  VkMemoryPropertyFlags preferred;
};

Wish wishFor(MemoryUse use) {
  constexpr VkMemoryPropertyFlags kHost = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  switch (use) {
    case MemoryUse::device:
      return {0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT};
    case MemoryUse::upload:
      return {kHost, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT};
    case MemoryUse::readBack:
      return {kHost, VK_MEMORY_PROPERTY_HOST_CACHED_BIT};
  }
  return {0, 0};
}

/// Indices of the memory types that serve, those with more of what is preferred first.
std::vector<std::uint32_t> typesFor(const GpuDevice& device, std::uint32_t allowed, Wish wish) {
  std::vector<std::uint32_t> types;
  for (std::uint32_t i = 0; i < device.memory.memoryTypeCount; ++i) {
    const VkMemoryPropertyFlags flags = device.memory.memoryTypes[i].propertyFlags;
    if ((allowed >> i & 1) != 0 && (flags & wish.needed) == wish.needed) types.push_back(i);
  }
  std::ranges::stable_sort(types, std::greater{}, [&](std::uint32_t i) {
    return std::popcount(device.memory.memoryTypes[i].propertyFlags & wish.preferred);
  });
  return types;
}

std::string doing(const GpuDevice& device, const std::string& what, VkDeviceSize bytes) {
  return std::string(device.properties.deviceName) + ": " + std::to_string(bytes) + " bytes for " + what;
}

}  // namespace

Result<GpuMemory> allocateMemory(const GpuDevice& device, const VkMemoryRequirements& needs, MemoryUse use,
                                 const std::string& what) {
  GpuMemory memory;
  VkResult result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
  for (const std::uint32_t type : typesFor(device, needs.memoryTypeBits, wishFor(use))) {
    // Vulkan forbids the attempt where the whole heap is too small.
    if (needs.size > device.memory.memoryHeaps[device.memory.memoryTypes[type].heapIndex].size) continue;
    auto info = vulkanStruct<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    info.allocationSize = needs.size;
    info.memoryTypeIndex = type;
    result = vkAllocateMemory(device.device, &info, nullptr, &memory.handle);
    if (result == VK_SUCCESS) break;
  }
  if (result != VK_SUCCESS) return vulkanError(result, doing(device, what, needs.size));
  if (use == MemoryUse::device) return memory;
  void* mapped = nullptr;
  result = vkMapMemory(device.device, memory.handle, 0, VK_WHOLE_SIZE, 0, &mapped);
  if (result != VK_SUCCESS) {
    vkFreeMemory(device.device, memory.handle, nullptr);
    return vulkanError(result, doing(device, what, needs.size));
  }
  memory.mapped = static_cast<std::byte*>(mapped);
  return memory;
}

}  // namespace rigel::tools
