#include "gpu/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>

namespace rigel::tools {
namespace {

constexpr VkPipelineStageFlags kAllCommands = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;

void imageBarrier(VkCommandBuffer buffer, const GpuImage& image, VkAccessFlags before, VkAccessFlags after,
                  VkImageLayout from, VkImageLayout to) {
  auto barrier = vulkanStruct<VkImageMemoryBarrier>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER);
  barrier.srcAccessMask = before;
  barrier.dstAccessMask = after;
  barrier.oldLayout = from;
  barrier.newLayout = to;
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image.handle();
  barrier.subresourceRange = {image.aspect(), 0, 1, 0, 1};
  vkCmdPipelineBarrier(buffer, kAllCommands, kAllCommands, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

void memoryBarrier(VkCommandBuffer buffer, VkPipelineStageFlags to, VkAccessFlags after) {
  auto barrier = vulkanStruct<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
  barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
  barrier.dstAccessMask = after;
  vkCmdPipelineBarrier(buffer, kAllCommands, to, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

}  // namespace

Result<GpuCommands> GpuCommands::create(const GpuContext& context) {
  GpuCommands commands;
  commands.device_ = context.device();
  GpuDevice& device = *commands.device_;
  auto info = vulkanStruct<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
  info.commandPool = device.commandPool;
  info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  info.commandBufferCount = 1;
  VkResult result = vkAllocateCommandBuffers(device.device, &info, &commands.buffer_);
  if (result != VK_SUCCESS) return vulkanError(result, "a command buffer");
  const auto fence = vulkanStruct<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
  result = vkCreateFence(device.device, &fence, nullptr, &commands.fence_);
  if (result != VK_SUCCESS) return vulkanError(result, "a fence");
  if (device.timestampBits > 0) {
    if (const auto error = commands.createQueries()) return *error;
  }
  return commands;
}

std::optional<Error> GpuCommands::createQueries() {
  auto info = vulkanStruct<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
  info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  info.queryCount = kMaxMarks;
  const VkResult result = vkCreateQueryPool(device_->device, &info, nullptr, &queries_);
  if (result != VK_SUCCESS) return vulkanError(result, "timestamps");
  return {};
}

std::optional<Error> GpuCommands::begin() {
  if (const auto error = device_->failure()) return error;
  assert(!pending_);
  auto info = vulkanStruct<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  if (const VkResult result = vkBeginCommandBuffer(buffer_, &info); result != VK_SUCCESS) return failed(result);
  marks_ = 0;
  if (hasTimestamps()) vkCmdResetQueryPool(buffer_, queries_, 0, kMaxMarks);
  return {};
}

void GpuCommands::bind(const GpuPipeline& pipeline, const GpuBindings& bindings,
                       std::span<const std::uint32_t> dynamicOffsets) {
  layout_ = pipeline.layout().handle();
  const VkDescriptorSet set = bindings.handle();
  vkCmdBindPipeline(buffer_, pipeline.bindPoint(), pipeline.handle());
  vkCmdBindDescriptorSets(buffer_, pipeline.bindPoint(), layout_, 0, 1, &set,
                          static_cast<std::uint32_t>(dynamicOffsets.size()), dynamicOffsets.data());
}

void GpuCommands::push(std::span<const std::byte> constants) {
  vkCmdPushConstants(buffer_, layout_, kShaderStages, 0, static_cast<std::uint32_t>(constants.size()),
                     constants.data());
}

void GpuCommands::dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z) { vkCmdDispatch(buffer_, x, y, z); }

void GpuCommands::barrier() {
  memoryBarrier(buffer_, kAllCommands, VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT);
}

void GpuCommands::upload(const Texture3d& texture) {
  const GpuImage& image = texture.image();
  imageBarrier(buffer_, image, 0, VK_ACCESS_TRANSFER_WRITE_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
               VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  VkBufferImageCopy copy{};
  copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  copy.imageExtent = {image.shape().width, image.shape().height, image.shape().depth};
  vkCmdCopyBufferToImage(buffer_, texture.staging().handle(), image.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                         &copy);
  imageBarrier(buffer_, image, VK_ACCESS_TRANSFER_WRITE_BIT, VK_ACCESS_SHADER_READ_BIT,
               VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

int GpuCommands::mark() {
  assert(marks_ < kMaxMarks);
  if (hasTimestamps()) {
    vkCmdWriteTimestamp(buffer_, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, queries_, static_cast<std::uint32_t>(marks_));
  }
  return marks_++;
}

std::optional<Error> GpuCommands::submit() {
  memoryBarrier(buffer_, VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
  VkResult result = vkEndCommandBuffer(buffer_);
  if (result != VK_SUCCESS) return failed(result);
  result = vkResetFences(device_->device, 1, &fence_);
  if (result != VK_SUCCESS) return failed(result);
  auto info = vulkanStruct<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
  info.commandBufferCount = 1;
  info.pCommandBuffers = &buffer_;
  submitted_ = std::chrono::steady_clock::now();
  result = vkQueueSubmit(device_->queue, 1, &info, fence_);
  if (result != VK_SUCCESS) return failed(result);
  pending_ = true;
  return {};
}

std::optional<Error> GpuCommands::wait() {
  assert(pending_);
  if (const auto error = device_->failure()) return error;
  const auto nanoseconds = static_cast<std::uint64_t>(device_->timeout * 1e9);
  const VkResult result = vkWaitForFences(device_->device, 1, &fence_, VK_TRUE, nanoseconds);
  if (result == VK_TIMEOUT) {
    device_->hanging = true;
    return Error{fmt::format("the work did not end within {} s", device_->timeout), device_->properties.deviceName};
  }
  pending_ = false;
  if (result != VK_SUCCESS) return failed(result);
  wallSeconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - submitted_).count();
  return readMarks();
}

std::optional<Error> GpuCommands::run() {
  if (const auto error = submit()) return error;
  return wait();
}

std::optional<Error> GpuCommands::readMarks() {
  times_.assign(static_cast<std::size_t>(marks_), 0);
  if (marks_ == 0 || !hasTimestamps()) return {};
  const VkResult result = vkGetQueryPoolResults(device_->device, queries_, 0, static_cast<std::uint32_t>(marks_),
                                                times_.size() * sizeof(times_[0]), times_.data(), sizeof(times_[0]),
                                                VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
  if (result != VK_SUCCESS) return failed(result);
  return {};
}

double GpuCommands::seconds(int from, int to) const {
  if (!hasTimestamps()) return wallSeconds_;
  // Counters narrower than 64 bits wrap around.
  const std::uint32_t bits = device_->timestampBits;
  const std::uint64_t mask = bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
  const std::uint64_t ticks = (times_[static_cast<std::size_t>(to)] - times_[static_cast<std::size_t>(from)]) & mask;
  return static_cast<double>(ticks) * static_cast<double>(device_->properties.limits.timestampPeriod) * 1e-9;
}

std::optional<Error> GpuCommands::failed(VkResult result) {
  if (result == VK_ERROR_DEVICE_LOST) device_->lost = true;
  return vulkanError(result, device_->properties.deviceName);
}

GpuCommands& GpuCommands::operator=(GpuCommands&& other) noexcept {
  GpuCommands(std::move(other)).swap(*this);
  return *this;
}

GpuCommands::~GpuCommands() {
  if (device_ == nullptr) return;
  if (pending_ && !device_->hanging) wait();  // what it uses may be destroyed next
  if (device_->hanging) return;
  vkDestroyQueryPool(device_->device, queries_, nullptr);
  vkDestroyFence(device_->device, fence_, nullptr);
  vkFreeCommandBuffers(device_->device, device_->commandPool, 1, &buffer_);
}

void GpuCommands::swap(GpuCommands& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(buffer_, other.buffer_);
  std::swap(fence_, other.fence_);
  std::swap(queries_, other.queries_);
  std::swap(layout_, other.layout_);
  std::swap(pending_, other.pending_);
  std::swap(marks_, other.marks_);
  std::swap(times_, other.times_);
  std::swap(submitted_, other.submitted_);
  std::swap(wallSeconds_, other.wallSeconds_);
}

}  // namespace rigel::tools
