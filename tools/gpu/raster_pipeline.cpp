// GpuPipeline::raster.
#include "gpu/pipeline.h"

#include <array>

namespace rigel::tools {
namespace {

/// The structures that VkGraphicsPipelineCreateInfo points to.
struct RasterInfo {
  RasterInfo(std::span<const VertexStream> streams, const RasterState& state, std::size_t colours);
  RasterInfo(const RasterInfo&) = delete;
  RasterInfo& operator=(const RasterInfo&) = delete;

  std::vector<VkVertexInputBindingDescription> bindings;
  std::vector<VkVertexInputAttributeDescription> attributes;
  std::vector<VkPipelineColorBlendAttachmentState> blends;
  std::array<VkDynamicState, 2> dynamicStates = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  VkPipelineVertexInputStateCreateInfo vertexInput{};
  VkPipelineInputAssemblyStateCreateInfo assembly{};
  VkPipelineViewportStateCreateInfo viewport{};
  VkPipelineRasterizationStateCreateInfo rasterization{};
  VkPipelineMultisampleStateCreateInfo multisample{};
  VkPipelineDepthStencilStateCreateInfo depth{};
  VkPipelineColorBlendStateCreateInfo blend{};
  VkPipelineDynamicStateCreateInfo dynamic{};
};

RasterInfo::RasterInfo(std::span<const VertexStream> streams, const RasterState& state, std::size_t colours) {
  for (const VertexStream& stream : streams) {
    const auto binding = static_cast<std::uint32_t>(bindings.size());
    bindings.push_back(
        {binding, stream.stride, stream.perInstance ? VK_VERTEX_INPUT_RATE_INSTANCE : VK_VERTEX_INPUT_RATE_VERTEX});
    for (const VertexAttribute& a : stream.attributes) attributes.push_back({a.location, binding, a.format, a.offset});
  }
  vertexInput.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
  vertexInput.vertexBindingDescriptionCount = static_cast<std::uint32_t>(bindings.size());
  vertexInput.pVertexBindingDescriptions = bindings.data();
  vertexInput.vertexAttributeDescriptionCount = static_cast<std::uint32_t>(attributes.size());
  vertexInput.pVertexAttributeDescriptions = attributes.data();
  assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
  assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
  viewport.viewportCount = viewport.scissorCount = 1;
  rasterization.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
  rasterization.cullMode = state.cullBack ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_NONE;
  rasterization.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
  rasterization.lineWidth = 1;
  multisample.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
  multisample.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
  depth.depthTestEnable = depth.depthWriteEnable = state.depthTest ? VK_TRUE : VK_FALSE;
  depth.depthCompareOp = VK_COMPARE_OP_LESS;
  constexpr VkColorComponentFlags kAll =
      VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
  VkPipelineColorBlendAttachmentState replace{};
  replace.colorWriteMask = kAll;
  blends.assign(colours, replace);
  blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
  blend.attachmentCount = static_cast<std::uint32_t>(blends.size());
  blend.pAttachments = blends.data();
  dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
  dynamic.dynamicStateCount = static_cast<std::uint32_t>(dynamicStates.size());
  dynamic.pDynamicStates = dynamicStates.data();
}

}  // namespace

Result<GpuPipeline> GpuPipeline::raster(const GpuContext& context, const GpuLayout& layout, const ShaderCode& vertex,
                                        const ShaderCode& fragment, std::span<const VertexStream> streams,
                                        const RasterTarget& target, const RasterState& state) {
  auto vertexStage = ShaderStage::create(context.device(), VK_SHADER_STAGE_VERTEX_BIT, vertex.spirv, vertex.constants);
  if (!vertexStage) return vertexStage.error();
  auto fragmentStage =
      ShaderStage::create(context.device(), VK_SHADER_STAGE_FRAGMENT_BIT, fragment.spirv, fragment.constants);
  if (!fragmentStage) return fragmentStage.error();
  const std::array stages = {vertexStage->info(), fragmentStage->info()};
  const RasterInfo raster(streams, state, target.colours().size());
  auto info = vulkanStruct<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO);
  info.stageCount = static_cast<std::uint32_t>(stages.size());
  info.pStages = stages.data();
  info.pVertexInputState = &raster.vertexInput;
  info.pInputAssemblyState = &raster.assembly;
  info.pViewportState = &raster.viewport;
  info.pRasterizationState = &raster.rasterization;
  info.pMultisampleState = &raster.multisample;
  info.pDepthStencilState = &raster.depth;
  info.pColorBlendState = &raster.blend;
  info.pDynamicState = &raster.dynamic;
  info.layout = layout.handle();
  info.renderPass = target.renderPass();
  GpuPipeline pipeline(context.device(), layout, VK_PIPELINE_BIND_POINT_GRAPHICS);
  GpuDevice& device = *context.device();
  const VkResult result =
      vkCreateGraphicsPipelines(device.device, device.pipelineCache, 1, &info, nullptr, &pipeline.handle_);
  if (result != VK_SUCCESS) return vulkanError(result, "a raster pipeline");
  ++device.pipelinesCreated;
  return pipeline;
}

}  // namespace rigel::tools
