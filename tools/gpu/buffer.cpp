#include "gpu/buffer.h"

#include <cstring>
#include <limits>
#include <utility>

namespace rigel::tools {
namespace {

std::size_t texelBytes(BufferUse use) { return use == BufferUse::halfTexels ? 8 : 16; }
bool isTexels(BufferUse use) { return use == BufferUse::texels || use == BufferUse::halfTexels; }

struct Kind {
  const char* name;
  VkBufferUsageFlags usage;
  MemoryUse memory;
};

Kind kindOf(BufferUse use) {
  switch (use) {
    case BufferUse::uniform:
      return {"a uniform buffer", VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, MemoryUse::upload};
    case BufferUse::texels:
    case BufferUse::halfTexels:
      return {"a texel buffer", VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT, MemoryUse::upload};
    case BufferUse::storage:
      return {"a storage buffer", VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryUse::upload};
    case BufferUse::output:
      return {"an output buffer", VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryUse::readBack};
    case BufferUse::vertices:
      return {"vertices", VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, MemoryUse::upload};
    case BufferUse::indices:
      return {"indices", VK_BUFFER_USAGE_INDEX_BUFFER_BIT, MemoryUse::upload};
    case BufferUse::upload:
      return {"an upload", VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryUse::upload};
    case BufferUse::readBack:
      return {"a read-back", VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryUse::readBack};
  }
  return {"a buffer", 0, MemoryUse::upload};
}

std::size_t limitOf(const VkPhysicalDeviceLimits& limits, BufferUse use) {
  switch (use) {
    // A larger uniform buffer would be legal, bound in parts; ours are bound whole or in parts that the shader knows.
    case BufferUse::texels:
    case BufferUse::halfTexels:
      return std::size_t{limits.maxTexelBufferElements} * texelBytes(use);
    case BufferUse::storage:
    case BufferUse::output:
      return limits.maxStorageBufferRange;
    default:
      return std::numeric_limits<std::size_t>::max();
  }
}

}  // namespace

Result<GpuBuffer> GpuBuffer::create(const GpuContext& context, BufferUse use, std::size_t bytes) {
  const Kind kind = kindOf(use);
  if (bytes == 0) return Error{"no bytes asked for", kind.name};
  if (isTexels(use) && bytes % texelBytes(use) != 0) return Error{"not a whole number of vec4", kind.name};
  if (const std::size_t limit = limitOf(context.limits(), use); bytes > limit) {
    return Error{std::string(kind.name) + " of " + std::to_string(bytes) + " bytes: the device takes " +
                     std::to_string(limit) + " at most",
                 context.name()};
  }
  GpuBuffer buffer;
  buffer.device_ = context.device();
  buffer.size_ = bytes;
  VkDevice device = buffer.device_->device;
  auto info = vulkanStruct<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  info.size = bytes;
  info.usage = kind.usage;
  if (const VkResult result = vkCreateBuffer(device, &info, nullptr, &buffer.handle_); result != VK_SUCCESS) {
    return vulkanError(result, kind.name);
  }
  VkMemoryRequirements needs{};
  vkGetBufferMemoryRequirements(device, buffer.handle_, &needs);
  auto memory = allocateMemory(*buffer.device_, needs, kind.memory, kind.name);
  if (!memory) return memory.error();
  buffer.memory_ = *memory;
  const VkResult bound = vkBindBufferMemory(device, buffer.handle_, buffer.memory_.handle, 0);
  if (bound != VK_SUCCESS) return vulkanError(bound, kind.name);
  if (isTexels(use)) {
    // Every device must read both from texel buffers.
    const VkFormat format = use == BufferUse::texels ? VK_FORMAT_R32G32B32A32_SFLOAT : VK_FORMAT_R16G16B16A16_SFLOAT;
    if (const auto error = buffer.createView(format)) return *error;
  }
  return buffer;
}

Result<GpuBuffer> GpuBuffer::create(const GpuContext& context, BufferUse use, std::span<const std::byte> content) {
  auto buffer = create(context, use, content.size());
  if (buffer) std::memcpy(buffer->memory_.mapped, content.data(), content.size());
  return buffer;
}

std::optional<Error> GpuBuffer::createView(VkFormat format) {
  auto info = vulkanStruct<VkBufferViewCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO);
  info.buffer = handle_;
  info.format = format;
  info.range = VK_WHOLE_SIZE;
  const VkResult result = vkCreateBufferView(device_->device, &info, nullptr, &view_);
  if (result != VK_SUCCESS) return vulkanError(result, "the view of a texel buffer");
  return {};
}

GpuBuffer& GpuBuffer::operator=(GpuBuffer&& other) noexcept {
  GpuBuffer(std::move(other)).swap(*this);
  return *this;
}

GpuBuffer::~GpuBuffer() {
  if (device_ == nullptr || device_->hanging) return;
  vkDestroyBufferView(device_->device, view_, nullptr);
  vkDestroyBuffer(device_->device, handle_, nullptr);
  vkFreeMemory(device_->device, memory_.handle, nullptr);
}

void GpuBuffer::swap(GpuBuffer& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(memory_, other.memory_);
  std::swap(handle_, other.handle_);
  std::swap(view_, other.view_);
  std::swap(size_, other.size_);
}

}  // namespace rigel::tools
