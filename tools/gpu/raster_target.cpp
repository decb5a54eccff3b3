#include "gpu/raster_target.h"

#include <algorithm>
#include <array>
#include <utility>

namespace rigel::tools {
namespace {

constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;
constexpr VkPipelineStageFlags kDepthStages =
    VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
constexpr VkPipelineStageFlags kDrawing = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT | kDepthStages;
constexpr VkAccessFlags kDrawn = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
constexpr VkAccessFlags kDrawnOrRead = kDrawn | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT;

std::string nameOf(VkFormat format) {
  switch (format) {
    case VK_FORMAT_R32G32B32A32_SFLOAT:
      return "VK_FORMAT_R32G32B32A32_SFLOAT";
    case VK_FORMAT_R16G16B16A16_SFLOAT:
      return "VK_FORMAT_R16G16B16A16_SFLOAT";
    case VK_FORMAT_R32_UINT:
      return "VK_FORMAT_R32_UINT";
    case VK_FORMAT_D32_SFLOAT:
      return "VK_FORMAT_D32_SFLOAT";
    default:
      return "VkFormat " + std::to_string(static_cast<int>(format));
  }
}

Result<GpuImage> attachment(const GpuContext& context, int width, int height, VkFormat format) {
  const bool isDepth = format == kDepthFormat;
  const VkFormatFeatureFlags feature =
      isDepth ? VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT;
  if (!formatServes(context, format, feature | VK_FORMAT_FEATURE_TRANSFER_SRC_BIT)) {
    return Error{"the device does not draw to images of " + nameOf(format), context.name()};
  }
  ImageShape shape;
  shape.format = format;
  shape.width = static_cast<std::uint32_t>(std::max(width, 0));
  shape.height = static_cast<std::uint32_t>(std::max(height, 0));
  shape.usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                (isDepth ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
  return GpuImage::create(context, shape, "an image to draw to");
}

std::optional<Error> checkLimits(const GpuContext& context, int width, int height, std::size_t colours) {
  const VkPhysicalDeviceLimits& limits = context.limits();
  const std::size_t most = std::min(limits.maxColorAttachments, limits.maxFragmentOutputAttachments);
  if (colours > most) {
    return Error{std::to_string(colours) + " images to draw to: the device takes " + std::to_string(most) + " at most",
                 context.name()};
  }
  if (static_cast<std::int64_t>(width) > limits.maxFramebufferWidth ||
      static_cast<std::int64_t>(height) > limits.maxFramebufferHeight) {
    return Error{"a picture of " + std::to_string(width) + " x " + std::to_string(height) + ": the device takes " +
                     std::to_string(limits.maxFramebufferWidth) + " x " + std::to_string(limits.maxFramebufferHeight) +
                     " at most",
                 context.name()};
  }
  return {};
}

VkAttachmentDescription described(VkFormat format) {
  VkAttachmentDescription description{};
  description.format = format;
  description.samples = VK_SAMPLE_COUNT_1_BIT;
  description.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  description.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  description.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  description.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  description.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  description.finalLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
  return description;
}

/// The pass waits until earlier passes are drawn and read, and what reads its images waits for it.
std::array<VkSubpassDependency, 2> dependencies() {
  VkSubpassDependency before{};
  before.srcSubpass = VK_SUBPASS_EXTERNAL;
  before.srcStageMask = kDrawing | VK_PIPELINE_STAGE_TRANSFER_BIT;
  before.dstStageMask = kDrawing;
  before.srcAccessMask = kDrawn;
  before.dstAccessMask = kDrawnOrRead;
  VkSubpassDependency after{};
  after.dstSubpass = VK_SUBPASS_EXTERNAL;
  after.srcStageMask = kDrawing;
  after.dstStageMask = VK_PIPELINE_STAGE_TRANSFER_BIT;
  after.srcAccessMask = kDrawn;
  after.dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
  return {before, after};
}

}  // namespace

RasterTarget::RasterTarget(SharedDevice device, std::vector<GpuImage> colours, GpuImage depth)
    : device_(std::move(device)), colours_(std::move(colours)), depth_(std::move(depth)) {}

Result<RasterTarget> RasterTarget::create(const GpuContext& context, int width, int height,
                                          std::span<const VkFormat> colours) {
  if (const auto error = checkLimits(context, width, height, colours.size())) return *error;
  std::vector<GpuImage> images;
  for (const VkFormat format : colours) {
    auto image = attachment(context, width, height, format);
    if (!image) return image.error();
    images.push_back(*std::move(image));
  }
  auto depth = attachment(context, width, height, kDepthFormat);
  if (!depth) return depth.error();
  RasterTarget target(context.device(), std::move(images), *std::move(depth));
  if (const auto error = target.createPass()) return *error;
  if (const auto error = target.createFramebuffer()) return *error;
  return target;
}

std::optional<Error> RasterTarget::createPass() {
  std::vector<VkAttachmentDescription> attachments;
  std::vector<VkAttachmentReference> references;
  for (const GpuImage& colour : colours_) {
    references.push_back({static_cast<std::uint32_t>(attachments.size()), VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL});
    attachments.push_back(described(colour.shape().format));
  }
  const VkAttachmentReference depth{static_cast<std::uint32_t>(attachments.size()),
                                    VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
  attachments.push_back(described(kDepthFormat));
  VkSubpassDescription subpass{};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = static_cast<std::uint32_t>(references.size());
  subpass.pColorAttachments = references.data();
  subpass.pDepthStencilAttachment = &depth;
  const auto order = dependencies();
  auto info = vulkanStruct<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
  info.attachmentCount = static_cast<std::uint32_t>(attachments.size());
  info.pAttachments = attachments.data();
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  info.dependencyCount = static_cast<std::uint32_t>(order.size());
  info.pDependencies = order.data();
  const VkResult result = vkCreateRenderPass(device_->device, &info, nullptr, &renderPass_);
  if (result != VK_SUCCESS) return vulkanError(result, "a render pass");
  return {};
}

std::optional<Error> RasterTarget::createFramebuffer() {
  std::vector<VkImageView> views;
  for (const GpuImage& colour : colours_) views.push_back(colour.view());
  views.push_back(depth_.view());
  auto info = vulkanStruct<VkFramebufferCreateInfo>(VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO);
  info.renderPass = renderPass_;
  info.attachmentCount = static_cast<std::uint32_t>(views.size());
  info.pAttachments = views.data();
  info.width = depth_.shape().width;
  info.height = depth_.shape().height;
  info.layers = 1;
  const VkResult result = vkCreateFramebuffer(device_->device, &info, nullptr, &framebuffer_);
  if (result != VK_SUCCESS) return vulkanError(result, "a framebuffer");
  return {};
}

RasterTarget::RasterTarget(RasterTarget&& other) noexcept
    : device_(other.device_),
      colours_(std::move(other.colours_)),
      depth_(std::move(other.depth_)),
      renderPass_(std::exchange(other.renderPass_, VK_NULL_HANDLE)),
      framebuffer_(std::exchange(other.framebuffer_, VK_NULL_HANDLE)) {}

RasterTarget& RasterTarget::operator=(RasterTarget&& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(colours_, other.colours_);
  std::swap(depth_, other.depth_);
  std::swap(renderPass_, other.renderPass_);
  std::swap(framebuffer_, other.framebuffer_);
  return *this;
}

RasterTarget::~RasterTarget() {
  if (device_->hanging) return;
  vkDestroyFramebuffer(device_->device, framebuffer_, nullptr);
  vkDestroyRenderPass(device_->device, renderPass_, nullptr);
}

}  // namespace rigel::tools
