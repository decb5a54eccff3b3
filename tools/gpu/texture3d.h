// RGBA 3-D textures with linear filtering, clamped at the edge: what a lattice rig is sampled from.
#pragma once

#include "gpu/buffer.h"
#include "gpu/image.h"

#include <array>
#include <memory>

namespace rigel::tools {

enum class TextureFormat { rgba16f, rgba32f };

/// Cheap to copy: copies are the same texture.
class Texture3d {
 public:
  /// Filled and ready to sample. `rgba`: 4 floats a texel, x fastest. Where the device does not filter 32-bit floats it
  /// becomes rgba16f, with a note of the context. Errors: values beyond half-float range in rgba16f (scale them first),
  /// too large, out of memory.
  static Result<Texture3d> create(const GpuContext& context, std::array<int, 3> size, TextureFormat format,
                                  std::span<const float> rgba);

  /// New values of the same size, for GpuCommands::upload to copy; not while a submission reads the old ones.
  std::optional<Error> stage(std::span<const float> rgba) const;
  /// The same as the texture holds them: 4 floats or half floats a texel.
  void stage(std::span<const std::byte> texels) const;

  std::array<int, 3> size() const;
  TextureFormat format() const { return state_->format; }
  std::size_t bytes() const { return state_->staging.size(); }

  const GpuImage& image() const { return state_->image; }
  const GpuBuffer& staging() const { return state_->staging; }
  VkImageView view() const { return state_->image.view(); }
  VkSampler sampler() const { return state_->sampler; }

 private:
  struct State {
    State(SharedDevice device, TextureFormat format, GpuImage image, GpuBuffer staging);
    ~State();
    SharedDevice device;
    TextureFormat format;
    GpuImage image;
    GpuBuffer staging;
    VkSampler sampler = VK_NULL_HANDLE;
  };
  explicit Texture3d(std::shared_ptr<State> state) : state_(std::move(state)) {}

  std::shared_ptr<State> state_;
};

}  // namespace rigel::tools
