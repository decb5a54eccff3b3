// An image in the device's memory, with the view that shaders and passes use.
#pragma once

#include "gpu/context.h"
#include "gpu/memory.h"

namespace rigel::tools {

struct ImageShape {
  VkFormat format = VK_FORMAT_UNDEFINED;
  std::uint32_t width = 1, height = 1, depth = 1;  // depth > 1, or `volume`: 3-D
  bool volume = false;
  VkImageUsageFlags usage = 0;
};

class GpuImage {
 public:
  /// Errors: out of memory, larger than the device takes. The caller has asked whether the format serves.
  static Result<GpuImage> create(const GpuContext& context, const ImageShape& shape, const std::string& what);

  GpuImage(GpuImage&& other) noexcept { swap(other); }
  GpuImage& operator=(GpuImage&& other) noexcept;
  ~GpuImage();

  const ImageShape& shape() const { return shape_; }
  VkImageAspectFlags aspect() const;
  VkImage handle() const { return handle_; }
  VkImageView view() const { return view_; }

 private:
  GpuImage() = default;
  void swap(GpuImage& other) noexcept;
  std::optional<Error> createView(const std::string& what);

  SharedDevice device_;
  ImageShape shape_;
  GpuMemory memory_;
  VkImage handle_ = VK_NULL_HANDLE;
  VkImageView view_ = VK_NULL_HANDLE;
};

/// Whether images of this format can be all of that.
bool formatServes(const GpuContext& context, VkFormat format, VkFormatFeatureFlags features);

}  // namespace rigel::tools
