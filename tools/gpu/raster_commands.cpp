// The part of GpuCommands that draws.
#include "gpu/commands.h"

#include <array>
#include <cassert>

namespace rigel::tools {

void GpuCommands::beginPass(const RasterTarget& target, std::span<const VkClearColorValue> clear) {
  assert(clear.size() == target.colours().size());
  std::vector<VkClearValue> values(clear.size() + 1);
  for (std::size_t i = 0; i < clear.size(); ++i) values[i].color = clear[i];
  values.back().depthStencil = {1, 0};
  const VkRect2D area{{0, 0}, {target.depth().shape().width, target.depth().shape().height}};
  auto info = vulkanStruct<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
  info.renderPass = target.renderPass();
  info.framebuffer = target.framebuffer();
  info.renderArea = area;
  info.clearValueCount = static_cast<std::uint32_t>(values.size());
  info.pClearValues = values.data();
  vkCmdBeginRenderPass(buffer_, &info, VK_SUBPASS_CONTENTS_INLINE);
  // A negative height turns Vulkan's y, which points down, up (core since 1.1).
  const auto width = static_cast<float>(target.width());
  const auto height = static_cast<float>(target.height());
  const VkViewport viewport{0, height, width, -height, 0, 1};
  vkCmdSetViewport(buffer_, 0, 1, &viewport);
  vkCmdSetScissor(buffer_, 0, 1, &area);
}

void GpuCommands::endPass() { vkCmdEndRenderPass(buffer_); }

void GpuCommands::bindVertices(std::uint32_t stream, const GpuBuffer& buffer, std::size_t offset) {
  const VkBuffer handle = buffer.handle();
  const VkDeviceSize at = offset;
  vkCmdBindVertexBuffers(buffer_, stream, 1, &handle, &at);
}

void GpuCommands::bindIndices(const GpuBuffer& buffer, std::size_t offset) {
  vkCmdBindIndexBuffer(buffer_, buffer.handle(), offset, VK_INDEX_TYPE_UINT32);
}

void GpuCommands::draw(std::uint32_t vertices, std::uint32_t firstVertex) {
  vkCmdDraw(buffer_, vertices, 1, firstVertex, 0);
}

void GpuCommands::drawIndexed(std::uint32_t indices, std::uint32_t firstIndex, std::int32_t vertexOffset) {
  vkCmdDrawIndexed(buffer_, indices, 1, firstIndex, vertexOffset, 0);
}

void GpuCommands::read(const GpuImage& image, const GpuBuffer& to) {
  VkBufferImageCopy copy{};
  copy.imageSubresource = {image.aspect(), 0, 0, 1};
  copy.imageExtent = {image.shape().width, image.shape().height, 1};
  vkCmdCopyImageToBuffer(buffer_, image.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to.handle(), 1, &copy);
}

}  // namespace rigel::tools
