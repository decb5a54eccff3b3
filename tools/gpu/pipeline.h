// A compiled pipeline, compute or raster.
#pragma once

#include "gpu/bindings.h"
#include "gpu/shader.h"

namespace rigel::tools {

/// Drivers may put the work of compiling off to the first use (lavapipe does, 0.2 s each): run each once while loading.
class GpuPipeline {
 public:
  static Result<GpuPipeline> compute(const GpuContext& context, const GpuLayout& layout,
                                     std::span<const std::uint32_t> spirv,
                                     std::span<const ShaderConstant> constants = {});

  GpuPipeline(GpuPipeline&& other) noexcept;
  GpuPipeline& operator=(GpuPipeline&& other) noexcept;
  ~GpuPipeline();

  const GpuLayout& layout() const { return layout_; }
  VkPipelineBindPoint bindPoint() const { return bindPoint_; }
  VkPipeline handle() const { return handle_; }

 private:
  GpuPipeline(SharedDevice device, GpuLayout layout, VkPipelineBindPoint bindPoint);

  SharedDevice device_;
  GpuLayout layout_;
  VkPipelineBindPoint bindPoint_;
  VkPipeline handle_ = VK_NULL_HANDLE;
};

}  // namespace rigel::tools
