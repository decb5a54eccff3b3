// A buffer that the host writes or reads in place.
#pragma once

#include "gpu/context.h"
#include "gpu/memory.h"

#include <cstddef>
#include <span>

namespace rigel::tools {

enum class BufferUse {
  uniform,  // std140 block
  texels,   // samplerBuffer of RGBA32F: the fastest way to per-lane reads on lavapipe (a storage buffer takes 10 times
            // as long)
  halfTexels,  // samplerBuffer of RGBA16F
  storage,     // std430 block that shaders read
  output,      // std430 block that shaders write and the host reads
  vertices,
  indices,   // 32 bits each
  upload,    // copied to images
  readBack,  // copied from images
};

/// Always mapped: no staging copies. Memory of the device that the host can write to is taken where there is some.
class GpuBuffer {
 public:
  /// `bytes` > 0. Errors: out of memory, beyond a limit of the device.
  static Result<GpuBuffer> create(const GpuContext& context, BufferUse use, std::size_t bytes);
  /// The same, filled.
  static Result<GpuBuffer> create(const GpuContext& context, BufferUse use, std::span<const std::byte> content);
  template <class T>
  static Result<GpuBuffer> of(const GpuContext& context, BufferUse use, std::span<const T> content) {
    return create(context, use, std::as_bytes(content));
  }

  GpuBuffer(GpuBuffer&& other) noexcept { swap(other); }
  GpuBuffer& operator=(GpuBuffer&& other) noexcept;
  ~GpuBuffer();

  std::size_t size() const { return size_; }
  /// Not while a submission uses them.
  std::span<std::byte> bytes() { return {memory_.mapped, size_}; }
  std::span<const std::byte> bytes() const { return {memory_.mapped, size_}; }
  /// The content as numbers or structs.
  template <class T>
  std::span<T> as() {
    return {reinterpret_cast<T*>(memory_.mapped), size_ / sizeof(T)};
  }

  VkBuffer handle() const { return handle_; }
  VkBufferView texelView() const { return view_; }  // of texel buffers

 private:
  GpuBuffer() = default;
  void swap(GpuBuffer& other) noexcept;
  std::optional<Error> createView(VkFormat format);

  SharedDevice device_;
  GpuMemory memory_;
  VkBuffer handle_ = VK_NULL_HANDLE;
  VkBufferView view_ = VK_NULL_HANDLE;
  std::size_t size_ = 0;
};

}  // namespace rigel::tools
