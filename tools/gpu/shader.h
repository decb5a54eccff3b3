// SPIR-V as pipelines take it.
#pragma once

#include "gpu/context.h"

#include <bit>
#include <cstdint>
#include <span>

namespace rigel::tools {

/// A specialisation constant: its id and the bits of its value (bool: 0 or 1).
struct ShaderConstant {
  std::uint32_t id;
  std::uint32_t bits;
};

inline ShaderConstant shaderConstant(std::uint32_t id, float value) {
  return {id, std::bit_cast<std::uint32_t>(value)};
}
inline ShaderConstant shaderConstant(std::uint32_t id, int value) { return {id, std::bit_cast<std::uint32_t>(value)}; }
inline ShaderConstant shaderConstant(std::uint32_t id, bool value) { return {id, value ? 1u : 0u}; }

/// A module, counted in the device, and its constants, for as long as a pipeline is being made of them.
class ShaderStage {
 public:
  static Result<ShaderStage> create(const SharedDevice& device, VkShaderStageFlagBits stage,
                                    std::span<const std::uint32_t> spirv, std::span<const ShaderConstant> constants);

  ShaderStage(ShaderStage&& other) noexcept;
  ShaderStage& operator=(ShaderStage&&) = delete;
  ~ShaderStage();

  /// Valid while this stage stays where it is.
  VkPipelineShaderStageCreateInfo info();

 private:
  ShaderStage() = default;

  SharedDevice device_;
  VkShaderStageFlagBits stage_ = VK_SHADER_STAGE_COMPUTE_BIT;
  VkShaderModule module_ = VK_NULL_HANDLE;
  std::span<const ShaderConstant> constants_;
  std::vector<VkSpecializationMapEntry> entries_;
  VkSpecializationInfo specialization_{};
};

}  // namespace rigel::tools
