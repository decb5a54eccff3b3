#include "gpu/image.h"

#include <algorithm>
#include <utility>

namespace rigel::tools {

bool formatServes(const GpuContext& context, VkFormat format, VkFormatFeatureFlags features) {
  VkFormatProperties properties{};
  vkGetPhysicalDeviceFormatProperties(context.device()->physical, format, &properties);
  return (properties.optimalTilingFeatures & features) == features;
}

Result<GpuImage> GpuImage::create(const GpuContext& context, const ImageShape& shape, const std::string& what) {
  const VkPhysicalDeviceLimits& limits = context.limits();
  const std::uint32_t largest = std::max({shape.width, shape.height, shape.depth});
  const std::uint32_t limit = shape.volume ? limits.maxImageDimension3D : limits.maxImageDimension2D;
  if (largest > limit || std::min({shape.width, shape.height, shape.depth}) == 0) {
    return Error{what + " of " + std::to_string(shape.width) + " x " + std::to_string(shape.height) + " x " +
                     std::to_string(shape.depth) + ": the device takes 1 to " + std::to_string(limit) + " a side",
                 context.name()};
  }
  GpuImage image;
  image.device_ = context.device();
  image.shape_ = shape;
  auto info = vulkanStruct<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
  info.imageType = shape.volume ? VK_IMAGE_TYPE_3D : VK_IMAGE_TYPE_2D;
  info.format = shape.format;
  info.extent = {shape.width, shape.height, shape.depth};
  info.mipLevels = 1;
  info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = shape.usage;
  VkDevice device = image.device_->device;
  if (const VkResult result = vkCreateImage(device, &info, nullptr, &image.handle_); result != VK_SUCCESS) {
    return vulkanError(result, what);
  }
  VkMemoryRequirements needs{};
  vkGetImageMemoryRequirements(device, image.handle_, &needs);
  auto memory = allocateMemory(*image.device_, needs, MemoryUse::device, what);
  if (!memory) return memory.error();
  image.memory_ = *memory;
  const VkResult bound = vkBindImageMemory(device, image.handle_, image.memory_.handle, 0);
  if (bound != VK_SUCCESS) return vulkanError(bound, what);
  if (const auto error = image.createView(what)) return *error;
  return image;
}

VkImageAspectFlags GpuImage::aspect() const {
  return shape_.format == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

std::optional<Error> GpuImage::createView(const std::string& what) {
  auto info = vulkanStruct<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
  info.image = handle_;
  info.viewType = shape_.volume ? VK_IMAGE_VIEW_TYPE_3D : VK_IMAGE_VIEW_TYPE_2D;
  info.format = shape_.format;
  info.subresourceRange = {aspect(), 0, 1, 0, 1};
  const VkResult result = vkCreateImageView(device_->device, &info, nullptr, &view_);
  if (result != VK_SUCCESS) return vulkanError(result, what);
  return {};
}

GpuImage& GpuImage::operator=(GpuImage&& other) noexcept {
  GpuImage(std::move(other)).swap(*this);
  return *this;
}

GpuImage::~GpuImage() {
  if (device_ == nullptr || device_->hanging) return;
  vkDestroyImageView(device_->device, view_, nullptr);
  vkDestroyImage(device_->device, handle_, nullptr);
  vkFreeMemory(device_->device, memory_.handle, nullptr);
}

void GpuImage::swap(GpuImage& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(shape_, other.shape_);
  std::swap(memory_, other.memory_);
  std::swap(handle_, other.handle_);
  std::swap(view_, other.view_);
}

}  // namespace rigel::tools
