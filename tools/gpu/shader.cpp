#include "gpu/shader.h"

#include <cstddef>
#include <utility>

namespace rigel::tools {

Result<ShaderStage> ShaderStage::create(const SharedDevice& device, VkShaderStageFlagBits stage,
                                        std::span<const std::uint32_t> spirv,
                                        std::span<const ShaderConstant> constants) {
  constexpr std::uint32_t kSpirvMagic = 0x07230203;
  if (spirv.empty() || spirv.front() != kSpirvMagic) return Error{"not SPIR-V", "a shader"};
  ShaderStage made;
  made.device_ = device;
  made.stage_ = stage;
  made.constants_ = constants;
  for (std::uint32_t i = 0; i < constants.size(); ++i) {
    const auto offset = static_cast<std::uint32_t>(i * sizeof(ShaderConstant) + offsetof(ShaderConstant, bits));
    made.entries_.push_back({constants[i].id, offset, sizeof(constants[i].bits)});
  }
  auto info = vulkanStruct<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
  info.codeSize = spirv.size_bytes();
  info.pCode = spirv.data();
  const VkResult result = vkCreateShaderModule(device->device, &info, nullptr, &made.module_);
  if (result != VK_SUCCESS) return vulkanError(result, "a shader");
  ++device->shaderModulesCreated;
  return made;
}

ShaderStage::ShaderStage(ShaderStage&& other) noexcept
    : device_(std::move(other.device_)),
      stage_(other.stage_),
      module_(std::exchange(other.module_, VK_NULL_HANDLE)),
      constants_(other.constants_),
      entries_(std::move(other.entries_)) {}

ShaderStage::~ShaderStage() {
  if (device_ != nullptr && !device_->hanging) vkDestroyShaderModule(device_->device, module_, nullptr);
}

VkPipelineShaderStageCreateInfo ShaderStage::info() {
  specialization_.mapEntryCount = static_cast<std::uint32_t>(entries_.size());
  specialization_.pMapEntries = entries_.data();
  specialization_.dataSize = constants_.size_bytes();
  specialization_.pData = constants_.data();
  auto info = vulkanStruct<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
  info.stage = stage_;
  info.module = module_;
  info.pName = "main";
  info.pSpecializationInfo = &specialization_;
  return info;
}

}  // namespace rigel::tools
