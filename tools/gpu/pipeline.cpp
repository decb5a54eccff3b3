#include "gpu/pipeline.h"

#include <utility>

namespace rigel::tools {

GpuPipeline::GpuPipeline(SharedDevice device, GpuLayout layout, VkPipelineBindPoint bindPoint)
    : device_(std::move(device)), layout_(std::move(layout)), bindPoint_(bindPoint) {}

Result<GpuPipeline> GpuPipeline::compute(const GpuContext& context, const GpuLayout& layout,
                                         std::span<const std::uint32_t> spirv,
                                         std::span<const ShaderConstant> constants) {
  auto stage = ShaderStage::create(context.device(), VK_SHADER_STAGE_COMPUTE_BIT, spirv, constants);
  if (!stage) return stage.error();
  GpuPipeline pipeline(context.device(), layout, VK_PIPELINE_BIND_POINT_COMPUTE);
  auto info = vulkanStruct<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
  info.stage = stage->info();
  info.layout = layout.handle();
  GpuDevice& device = *context.device();
  const VkResult result =
      vkCreateComputePipelines(device.device, device.pipelineCache, 1, &info, nullptr, &pipeline.handle_);
  if (result != VK_SUCCESS) return vulkanError(result, "a compute pipeline");
  ++device.pipelinesCreated;
  return pipeline;
}

GpuPipeline::GpuPipeline(GpuPipeline&& other) noexcept
    : device_(other.device_),
      layout_(other.layout_),
      bindPoint_(other.bindPoint_),
      handle_(std::exchange(other.handle_, VK_NULL_HANDLE)) {}

GpuPipeline& GpuPipeline::operator=(GpuPipeline&& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(layout_, other.layout_);
  std::swap(bindPoint_, other.bindPoint_);
  std::swap(handle_, other.handle_);
  return *this;
}

GpuPipeline::~GpuPipeline() {
  if (!device_->hanging) vkDestroyPipeline(device_->device, handle_, nullptr);
}

}  // namespace rigel::tools
