// A compiled pipeline, compute or raster.
#pragma once

#include "gpu/bindings.h"
#include "gpu/raster_target.h"
#include "gpu/shader.h"

namespace rigel::tools {

struct ShaderCode {
  std::span<const std::uint32_t> spirv;
  std::span<const ShaderConstant> constants = {};
};

struct VertexAttribute {
  std::uint32_t location;
  VkFormat format;
  std::uint32_t offset;  // bytes, in a vertex of the stream
};

/// A buffer of vertices: GpuCommands::bindVertices takes its index in the list of streams.
struct VertexStream {
  std::uint32_t stride;  // bytes
  std::vector<VertexAttribute> attributes;
  bool perInstance = false;
};

/// Triangle lists, no blending. Counter-clockwise triangles, seen with y up, face the front.
struct RasterState {
  bool cullBack = false;
  bool depthTest = true;  // the nearer (smaller) wins, and is written
};

/// Drivers may put the work of compiling off to the first use (lavapipe does, 0.2 s each): run each once while loading.
class GpuPipeline {
 public:
  static Result<GpuPipeline> compute(const GpuContext& context, const GpuLayout& layout,
                                     std::span<const std::uint32_t> spirv,
                                     std::span<const ShaderConstant> constants = {});

  static Result<GpuPipeline> raster(const GpuContext& context, const GpuLayout& layout, const ShaderCode& vertex,
                                    const ShaderCode& fragment, std::span<const VertexStream> streams,
                                    const RasterTarget& target, const RasterState& state = {});

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
