#include "gpu/bindings.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace rigel::tools {
namespace {

VkDescriptorType typeOf(BindingSlot::Kind kind) {
  switch (kind) {
    case BindingSlot::Kind::uniform:
      return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    case BindingSlot::Kind::uniformDynamic:
      return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC;
    case BindingSlot::Kind::storage:
      return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    case BindingSlot::Kind::texels:
      return VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    case BindingSlot::Kind::texture:
      return VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
  }
  return VK_DESCRIPTOR_TYPE_MAX_ENUM;
}

}  // namespace

GpuLayout::State::~State() {
  if (device == nullptr || device->hanging) return;
  vkDestroyPipelineLayout(device->device, pipelineLayout, nullptr);
  vkDestroyDescriptorSetLayout(device->device, setLayout, nullptr);
}

Result<GpuLayout> GpuLayout::create(const GpuContext& context, std::span<const BindingSlot> slots,
                                    std::uint32_t pushBytes) {
  if (pushBytes > context.limits().maxPushConstantsSize) {
    return Error{std::to_string(pushBytes) + " bytes of push constants: the device takes " +
                     std::to_string(context.limits().maxPushConstantsSize) + " at most",
                 context.name()};
  }
  GpuLayout layout;
  layout.state_ = std::make_shared<State>();
  State& state = *layout.state_;
  state.device = context.device();
  state.slots.assign(slots.begin(), slots.end());
  state.pushBytes = pushBytes;

  std::vector<VkDescriptorSetLayoutBinding> bindings;
  for (const BindingSlot& slot : slots) {
    bindings.push_back({slot.binding, typeOf(slot.kind), slot.count, kShaderStages, nullptr});
  }
  auto setInfo = vulkanStruct<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
  setInfo.bindingCount = static_cast<std::uint32_t>(bindings.size());
  setInfo.pBindings = bindings.data();
  VkResult result = vkCreateDescriptorSetLayout(state.device->device, &setInfo, nullptr, &state.setLayout);
  if (result != VK_SUCCESS) return vulkanError(result, "a layout of bindings");

  const VkPushConstantRange range{kShaderStages, 0, pushBytes};
  auto info = vulkanStruct<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  info.setLayoutCount = 1;
  info.pSetLayouts = &state.setLayout;
  info.pushConstantRangeCount = pushBytes > 0 ? 1 : 0;
  info.pPushConstantRanges = &range;
  result = vkCreatePipelineLayout(state.device->device, &info, nullptr, &state.pipelineLayout);
  if (result != VK_SUCCESS) return vulkanError(result, "a layout of bindings");
  return layout;
}

Result<GpuBindings> GpuBindings::create(const GpuContext& context, const GpuLayout& layout) {
  GpuBindings bindings;
  bindings.device_ = context.device();
  bindings.layout_ = layout;
  std::vector<VkDescriptorPoolSize> sizes;
  for (const BindingSlot& slot : layout.slots()) sizes.push_back({typeOf(slot.kind), slot.count});
  if (sizes.empty()) sizes.push_back({VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1});  // an empty set needs a pool all the same
  auto poolInfo = vulkanStruct<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
  poolInfo.maxSets = 1;
  poolInfo.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
  poolInfo.pPoolSizes = sizes.data();
  VkDevice device = bindings.device_->device;
  VkResult result = vkCreateDescriptorPool(device, &poolInfo, nullptr, &bindings.pool_);
  if (result != VK_SUCCESS) return vulkanError(result, "a set of bindings");

  const VkDescriptorSetLayout setLayout = layout.setLayout();
  auto info = vulkanStruct<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
  info.descriptorPool = bindings.pool_;
  info.descriptorSetCount = 1;
  info.pSetLayouts = &setLayout;
  result = vkAllocateDescriptorSets(device, &info, &bindings.set_);
  if (result != VK_SUCCESS) return vulkanError(result, "a set of bindings");
  return bindings;
}

const BindingSlot* GpuBindings::slot(std::uint32_t binding) const {
  const auto& slots = layout_->slots();
  const auto found = std::ranges::find(slots, binding, &BindingSlot::binding);
  return found == slots.end() ? nullptr : &*found;
}

std::optional<Error> GpuBindings::set(std::uint32_t binding, const GpuBuffer& buffer, std::size_t range) {
  const BindingSlot* to = slot(binding);
  assert(to != nullptr && to->kind != BindingSlot::Kind::texture);
  if (range == 0) range = buffer.size();
  const VkPhysicalDeviceLimits& limits = device_->properties.limits;
  const bool isUniform = to->kind == BindingSlot::Kind::uniform || to->kind == BindingSlot::Kind::uniformDynamic;
  if (isUniform && range > limits.maxUniformBufferRange) {
    return Error{"a uniform block of " + std::to_string(range) + " bytes: the device takes " +
                     std::to_string(limits.maxUniformBufferRange) + " at most",
                 device_->properties.deviceName};
  }
  const VkDescriptorBufferInfo info{buffer.handle(), 0, range};
  const VkBufferView view = buffer.texelView();
  auto write = vulkanStruct<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
  write.dstSet = set_;
  write.dstBinding = binding;
  write.descriptorCount = 1;
  write.descriptorType = typeOf(to->kind);
  write.pBufferInfo = &info;
  write.pTexelBufferView = &view;
  vkUpdateDescriptorSets(device_->device, 1, &write, 0, nullptr);
  return {};
}

std::optional<Error> GpuBindings::set(std::uint32_t binding, const Texture3d& texture, std::uint32_t element) {
  [[maybe_unused]] const BindingSlot* to = slot(binding);
  assert(to != nullptr && to->kind == BindingSlot::Kind::texture && element < to->count);
  const VkDescriptorImageInfo info{texture.sampler(), texture.view(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
  auto write = vulkanStruct<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
  write.dstSet = set_;
  write.dstBinding = binding;
  write.dstArrayElement = element;
  write.descriptorCount = 1;
  write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
  write.pImageInfo = &info;
  vkUpdateDescriptorSets(device_->device, 1, &write, 0, nullptr);
  textures_.push_back(texture);
  return {};
}

GpuBindings& GpuBindings::operator=(GpuBindings&& other) noexcept {
  GpuBindings(std::move(other)).swap(*this);
  return *this;
}

GpuBindings::~GpuBindings() {
  if (device_ != nullptr && !device_->hanging) vkDestroyDescriptorPool(device_->device, pool_, nullptr);
}

void GpuBindings::swap(GpuBindings& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(layout_, other.layout_);
  std::swap(pool_, other.pool_);
  std::swap(set_, other.set_);
  std::swap(textures_, other.textures_);
}

}  // namespace rigel::tools
