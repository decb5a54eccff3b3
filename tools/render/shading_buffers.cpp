#include "render/shading_buffers.h"

#include <rigel/disk_table.h>
#include <rigel/wrap.h>

#include <algorithm>
#include <cassert>
#include <cstring>

namespace rigel::tools {
namespace {

// Bindings of shade_object.glsl.
enum Binding : std::uint32_t {
  kCoefficients,
  kGaussNodes,
  kNearLights,
  kLattice,
  kObject,
  kMaterial,
  kPoints,  // of points.comp, as kResults
  kResults,
  kDiskTable
};

constexpr int kNearVec4 = sizeof(GpuNearLight) / sizeof(GpuVec4);

bool isHalf(RigStorage storage) { return storage == RigStorage::float16 || storage == RigStorage::texture16; }

/// A light as four vec4 of floats: what shaders fetch from a texel buffer holds no integers.
void putNearLight(const NearLight& light, GpuVec4* out) {
  const GpuNearLight packed = gpuNearLight(light);
  std::memcpy(static_cast<void*>(out), &packed, sizeof packed);
  out[1].w = static_cast<float>(packed.kind);
}

}  // namespace

Result<ShadingBuffers> ShadingBuffers::create(const GpuContext& context, const ShadingRoom& room, RigStorage storage) {
  using Kind = BindingSlot::Kind;
  constexpr BindingSlot kSlots[] = {
      {kCoefficients, Kind::texels}, {kGaussNodes, Kind::texels},     {kNearLights, Kind::texels},
      {kLattice, Kind::texture},     {kObject, Kind::uniformDynamic}, {kMaterial, Kind::uniformDynamic},
      {kPoints, Kind::texels},       {kResults, Kind::storage},       {kDiskTable, Kind::texels}};
  constexpr std::uint32_t kPushBytes = 128;  // what every device has
  auto layout = GpuLayout::create(context, kSlots, kPushBytes);
  if (!layout) return layout.error();
  ShadingBuffers buffers(*layout);
  if (auto error = buffers.createBuffers(context, room, storage)) return *error;
  if (auto error = buffers.createBindings(context, room)) return *error;
  return buffers;
}

std::optional<Error> ShadingBuffers::createBuffers(const GpuContext& context, const ShadingRoom& room,
                                                   RigStorage storage) {
  storage_ = storage;
  uniformStep_ = context.uniformStride(std::max(sizeof(GpuRig), sizeof(GpuWrap)));
  int vec4 = 0, gauss = 0, texels = 0, near = room.lights;
  for (const RigRunner* runner : room.rigs) {
    places_.push_back({vec4, 0, gauss});
    const auto size = isTexture(storage) ? textureSize(runner->rig(), runner->bands()) : std::nullopt;
    std::optional<Texture3d> texture;
    if (size) {
      texels = std::max(texels, size->texels());
      const std::vector<float> black(4 * static_cast<std::size_t>(size->texels()));
      auto created = Texture3d::create(context, {size->width, size->height, size->depth},
                                       isHalf(storage) ? TextureFormat::rgba16f : TextureFormat::rgba32f, black);
      if (!created) return created.error();
      texture = *created;
    }
    textures_.push_back(texture);
    vec4 += packRigBound(runner->rig(), runner->bands());
    gauss += packGaussNodesBound(runner->rig());
    near += kMaxNearLights;
  }
  texels_.resize(static_cast<std::size_t>(texels));
  halfTexels_.resize(static_cast<std::size_t>(texels));
  wraps_ = room.wraps;
  if (std::ranges::find(wraps_, 0.0f) == wraps_.end()) wraps_.push_back(0);

  const auto make = [&](std::optional<GpuBuffer>& to, BufferUse use, std::size_t bytes) -> std::optional<Error> {
    auto buffer = GpuBuffer::create(context, use, bytes);
    if (!buffer) return buffer.error();
    std::ranges::fill(buffer->bytes(), std::byte{0});
    to = *std::move(buffer);
    return std::nullopt;
  };
  const bool half = storage == RigStorage::float16;
  const auto count = [](int n) { return static_cast<std::size_t>(std::max(n, 1)); };
  if (auto error = make(coefficients_, half ? BufferUse::halfTexels : BufferUse::texels,
                        count(vec4) * (half ? sizeof(GpuHalf4) : sizeof(GpuVec4))))
    return error;
  if (auto error = make(gaussNodes_, BufferUse::texels, count(gauss) * sizeof(GpuVec4))) return error;
  if (auto error = make(nearLights_, BufferUse::texels, count(near) * sizeof(GpuNearLight))) return error;
  if (auto error = make(objects_, BufferUse::uniform, count(static_cast<int>(room.rigs.size())) * uniformStep_))
    return error;
  if (auto error = make(materials_, BufferUse::uniform, wraps_.size() * uniformStep_)) return error;

  for (std::size_t i = 0; i < room.rigs.size(); ++i) {
    const Rig& rig = room.rigs[i]->rig();
    packGaussNodes(rig, gaussNodes_->as<GpuVec4>().subspan(places_[i].gaussOffset, packGaussNodesBound(rig)));
  }
  if (room.diskTable) {
    if (auto error = make(diskTable_, BufferUse::texels, 2 * DiskTable::data(0).size_bytes())) return error;
    for (const int texture : {0, 1})
      std::ranges::copy(DiskTable::data(texture),
                        diskTable_->as<float>().subspan(texture * DiskTable::data(0).size()).begin());
  }
  for (std::size_t i = 0; i < wraps_.size(); ++i) {
    const GpuWrap packed = gpuWrap(wraps_[i]);
    std::memcpy(materials_->bytes().data() + i * uniformStep_, &packed, sizeof packed);
  }
  return std::nullopt;
}

std::optional<Error> ShadingBuffers::createBindings(const GpuContext& context, const ShadingRoom& room) {
  constexpr float kBlack[4] = {};
  auto none = Texture3d::create(context, {1, 1, 1}, TextureFormat::rgba32f, kBlack);
  if (!none) return none.error();
  noTexture_ = *none;
  for (std::size_t i = 0; i < std::max<std::size_t>(1, room.rigs.size()); ++i) {
    auto bindings = GpuBindings::create(context, layout_);
    if (!bindings) return bindings.error();
    for (auto error : {bindings->set(kCoefficients, *coefficients_), bindings->set(kGaussNodes, *gaussNodes_),
                       bindings->set(kNearLights, *nearLights_), bindings->set(kObject, *objects_, sizeof(GpuRig)),
                       bindings->set(kMaterial, *materials_, sizeof(GpuWrap)),
                       // Nobody reads it where there is no table, but what a shader might read must be there.
                       bindings->set(kDiskTable, diskTable_ ? *diskTable_ : *nearLights_),
                       bindings->set(kLattice, i < textures_.size() && textures_[i] ? *textures_[i] : *noTexture_)})
      if (error) return error;
    bindings_.push_back(*std::move(bindings));
  }
  return std::nullopt;
}

std::optional<Error> ShadingBuffers::setPoints(const GpuBuffer& points, const GpuBuffer& results) {
  for (GpuBindings& bindings : bindings_) {
    if (auto error = bindings.set(kPoints, points)) return error;
    if (auto error = bindings.set(kResults, results)) return error;
  }
  return std::nullopt;
}

std::uint32_t ShadingBuffers::material(float wrap) const {
  const auto found = std::ranges::find(wraps_, wrap);
  assert(found != wraps_.end());
  return static_cast<std::uint32_t>(static_cast<std::size_t>(found - wraps_.begin()) * uniformStep_);
}

ShadingPlace ShadingBuffers::pack(std::size_t i, const RigRunner& runner) {
  GpuRig packed;
  if (textures_[i]) {
    const auto size = textures_[i]->size();
    const std::size_t texels =
        static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]);
    if (textures_[i]->format() == TextureFormat::rgba16f) {
      const std::span<GpuHalf4> to = std::span(halfTexels_).first(texels);
      packed = runner.packTexture(to);
      textures_[i]->stage(std::as_bytes(to));
    } else {
      const std::span<GpuVec4> to = std::span(texels_).first(texels);
      packed = runner.packTexture(to);
      textures_[i]->stage(std::as_bytes(to));
    }
    packHighBand(runner.highBandVector(), places_[i].offset, coefficients_->as<GpuVec4>(), packed);
  } else {
    packed = storage_ == RigStorage::float16 ? runner.pack(places_[i], coefficients_->as<GpuHalf4>())
                                             : runner.pack(places_[i], coefficients_->as<GpuVec4>());
  }
  const std::size_t at = i * uniformStep_;
  std::memcpy(objects_->bytes().data() + at, &packed, sizeof packed);
  ShadingPlace result = place(runner.nearLights());
  result.rig = static_cast<std::uint32_t>(at);
  result.packed = packed;
  return result;
}

ShadingPlace ShadingBuffers::place(std::span<const NearLight> lights) {
  ShadingPlace result{0, nearUsed_, 0, {}};
  const std::span<GpuVec4> to = nearLights_->as<GpuVec4>();
  for (const NearLight& light : lights) {
    if (!(light.share > 0)) continue;
    putNearLight(light, &to[static_cast<std::size_t>(kNearVec4 * nearUsed_++)]);
    ++result.nearCount;
  }
  return result;
}

void ShadingBuffers::upload(GpuCommands& commands) const {
  for (const auto& texture : textures_)
    if (texture) commands.upload(*texture);
}

}  // namespace rigel::tools
