// What shaders read and write: the slots of a layout, and sets of buffers and textures that fill them.
#pragma once

#include "gpu/buffer.h"
#include "gpu/texture3d.h"

#include <memory>
#include <span>
#include <vector>

namespace rigel::tools {

struct BindingSlot {
  enum class Kind {
    uniform,         // uniform block
    uniformDynamic,  // uniform block at an offset given with each bind
    storage,         // buffer block
    texels,          // samplerBuffer
    texture,         // sampler3D, or an array of them
  };
  std::uint32_t binding;  // of set 0
  Kind kind;
  std::uint32_t count = 1;
};

/// Stages that see slots and push constants.
inline constexpr VkShaderStageFlags kShaderStages =
    VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT;

/// The slots of set 0 and the bytes of push constants, for vertex, fragment and compute shaders alike. Cheap to copy.
class GpuLayout {
 public:
  static Result<GpuLayout> create(const GpuContext& context, std::span<const BindingSlot> slots,
                                  std::uint32_t pushBytes = 0);

  const std::vector<BindingSlot>& slots() const { return state_->slots; }
  std::uint32_t pushBytes() const { return state_->pushBytes; }
  VkPipelineLayout handle() const { return state_->pipelineLayout; }
  VkDescriptorSetLayout setLayout() const { return state_->setLayout; }

 private:
  struct State {
    ~State();
    SharedDevice device;
    std::vector<BindingSlot> slots;
    std::uint32_t pushBytes = 0;
    VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;
    VkPipelineLayout pipelineLayout = VK_NULL_HANDLE;
  };
  std::shared_ptr<State> state_;
};

/// One filling of a layout. Buffers must outlive its use; textures are kept. Not to be changed while a submission uses
/// it.
class GpuBindings {
 public:
  static Result<GpuBindings> create(const GpuContext& context, const GpuLayout& layout);

  /// A uniform, storage or texel buffer, by the kind of the slot. `range`: bytes that the shader sees (0: all); of a
  /// uniformDynamic slot, from the offset on. An error beyond a limit of the device.
  std::optional<Error> set(std::uint32_t binding, const GpuBuffer& buffer, std::size_t range = 0);
  std::optional<Error> set(std::uint32_t binding, const Texture3d& texture, std::uint32_t element = 0);

  GpuBindings(GpuBindings&& other) noexcept { swap(other); }
  GpuBindings& operator=(GpuBindings&& other) noexcept;
  ~GpuBindings();

  const GpuLayout& layout() const { return *layout_; }
  VkDescriptorSet handle() const { return set_; }

 private:
  GpuBindings() = default;
  void swap(GpuBindings& other) noexcept;
  const BindingSlot* slot(std::uint32_t binding) const;

  SharedDevice device_;
  std::optional<GpuLayout> layout_;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  std::vector<Texture3d> textures_;
};

}  // namespace rigel::tools
