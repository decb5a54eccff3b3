// What is drawn into: colour images and a depth image, cleared at the start of every pass and ready to be read after
// it.
#pragma once

#include "gpu/image.h"

#include <span>
#include <vector>

namespace rigel::tools {

class RasterTarget {
 public:
  /// One image for every colour format (VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_R32_UINT, ...), and depth in 32-bit
  /// floats. Errors: a format that the device cannot draw to, by name; too many or too large; out of memory.
  static Result<RasterTarget> create(const GpuContext& context, int width, int height,
                                     std::span<const VkFormat> colours);

  int width() const { return static_cast<int>(depth_.shape().width); }
  int height() const { return static_cast<int>(depth_.shape().height); }
  const std::vector<GpuImage>& colours() const { return colours_; }
  const GpuImage& depth() const { return depth_; }

  /// Any target of the same formats does for a pipeline made for this one.
  VkRenderPass renderPass() const { return renderPass_; }
  VkFramebuffer framebuffer() const { return framebuffer_; }

  RasterTarget(RasterTarget&& other) noexcept;
  RasterTarget& operator=(RasterTarget&& other) noexcept;
  ~RasterTarget();

 private:
  RasterTarget(SharedDevice device, std::vector<GpuImage> colours, GpuImage depth);
  std::optional<Error> createPass();
  std::optional<Error> createFramebuffer();

  SharedDevice device_;
  std::vector<GpuImage> colours_;
  GpuImage depth_;
  VkRenderPass renderPass_ = VK_NULL_HANDLE;
  VkFramebuffer framebuffer_ = VK_NULL_HANDLE;
};

}  // namespace rigel::tools
