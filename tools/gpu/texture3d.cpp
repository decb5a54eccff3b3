#include "gpu/texture3d.h"

#include "gpu/commands.h"

#include <Imath/half.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

namespace rigel::tools {
namespace {

constexpr const char* kWhat = "a 3-D texture";

VkFormat formatOf(TextureFormat format) {
  return format == TextureFormat::rgba16f ? VK_FORMAT_R16G16B16A16_SFLOAT : VK_FORMAT_R32G32B32A32_SFLOAT;
}

std::size_t bytesOf(TextureFormat format) { return format == TextureFormat::rgba16f ? 2 : 4; }

bool filters(const GpuContext& context, TextureFormat format) {
  return formatServes(context, formatOf(format), VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT);
}

Result<VkSampler> linearSampler(const GpuDevice& device) {
  auto info = vulkanStruct<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
  info.magFilter = info.minFilter = VK_FILTER_LINEAR;
  info.mipmapMode = VK_SAMPLER_MIPMAP_MODE_NEAREST;
  info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  VkSampler sampler = VK_NULL_HANDLE;
  const VkResult result = vkCreateSampler(device.device, &info, nullptr, &sampler);
  if (result != VK_SUCCESS) return vulkanError(result, kWhat);
  return sampler;
}

/// What a device that cannot filter `wished` gets instead.
Result<TextureFormat> filteredFormat(const GpuContext& context, TextureFormat wished) {
  if (filters(context, wished)) return wished;
  if (wished == TextureFormat::rgba32f && filters(context, TextureFormat::rgba16f)) {
    context.device()->note("3-D textures are RGBA16F: the device does not filter RGBA32F");
    return TextureFormat::rgba16f;
  }
  return Error{"the device filters neither RGBA32F nor RGBA16F textures", context.name()};
}

}  // namespace

Texture3d::State::State(SharedDevice ownDevice, TextureFormat ownFormat, GpuImage ownImage, GpuBuffer ownStaging)
    : device(std::move(ownDevice)), format(ownFormat), image(std::move(ownImage)), staging(std::move(ownStaging)) {}

Texture3d::State::~State() {
  if (!device->hanging) vkDestroySampler(device->device, sampler, nullptr);
}

Result<Texture3d> Texture3d::create(const GpuContext& context, std::array<int, 3> size, TextureFormat wished,
                                    std::span<const float> rgba) {
  const auto format = filteredFormat(context, wished);
  if (!format) return format.error();
  ImageShape shape;
  shape.format = formatOf(*format);
  shape.width = static_cast<std::uint32_t>(size[0]);
  shape.height = static_cast<std::uint32_t>(size[1]);
  shape.depth = static_cast<std::uint32_t>(size[2]);
  shape.volume = true;
  shape.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  auto image = GpuImage::create(context, shape, kWhat);
  if (!image) return image.error();
  const std::size_t floats = std::size_t{4} * shape.width * shape.height * shape.depth;
  auto staging = GpuBuffer::create(context, BufferUse::upload, floats * bytesOf(*format));
  if (!staging) return staging.error();
  Texture3d texture(std::make_shared<State>(context.device(), *format, *std::move(image), *std::move(staging)));
  auto sampler = linearSampler(*context.device());
  if (!sampler) return sampler.error();
  texture.state_->sampler = *sampler;

  if (const auto error = texture.stage(rgba)) return *error;
  auto commands = GpuCommands::create(context);
  if (!commands) return commands.error();
  if (const auto error = commands->begin()) return *error;
  commands->upload(texture);
  if (const auto error = commands->run()) return *error;
  return texture;
}

std::optional<Error> Texture3d::stage(std::span<const float> rgba) const {
  const std::span<std::byte> to = state_->staging.bytes();
  if (rgba.size() * bytesOf(state_->format) != to.size()) {
    return Error{std::to_string(rgba.size()) + " floats given, " + std::to_string(to.size() / bytesOf(state_->format)) +
                     " expected",
                 kWhat};
  }
  if (state_->format == TextureFormat::rgba32f) {
    std::memcpy(to.data(), rgba.data(), to.size());
    return {};
  }
  const auto beyond = std::ranges::find_if(rgba, [](float v) { return std::isfinite(v) && std::abs(v) > HALF_MAX; });
  if (beyond != rgba.end()) return Error{fmt::format("{} is beyond half-float range: scale it", *beyond), kWhat};
  std::ranges::transform(rgba, reinterpret_cast<Imath::half*>(to.data()), [](float v) { return Imath::half(v); });
  return {};
}

void Texture3d::stage(std::span<const std::byte> texels) const {
  const std::span<std::byte> to = state_->staging.bytes();
  assert(texels.size() == to.size());
  std::ranges::copy(texels, to.begin());
}

std::array<int, 3> Texture3d::size() const {
  const ImageShape& shape = state_->image.shape();
  return {static_cast<int>(shape.width), static_cast<int>(shape.height), static_cast<int>(shape.depth)};
}

}  // namespace rigel::tools
