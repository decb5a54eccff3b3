#include "render/point_shader.h"

#include "shader_binaries.h"

#include <algorithm>
#include <numeric>

namespace rigel::tools {
namespace {

constexpr std::uint32_t kGroup = 64;  // local_size_x of points.comp

/// As points.comp has it.
struct PointConstants {
  std::int32_t count = 0, first = 0;
  std::int32_t firstNear = 0, nearCount = 0;
  float unused[28] = {};
};
static_assert(sizeof(PointConstants) == 128);

struct PointTexels {
  GpuVec4 position, normal;
};
struct PointResult {
  GpuVec4 rig, near;
};

Rgb colourOf(GpuVec4 v) { return {v.x, v.y, v.z}; }

}  // namespace

Result<PointShader> PointShader::create(const GpuContext& context, const RigRunner& rig, std::span<const float> wraps,
                                        RigStorage storage, std::size_t mostPoints, Effect wrappedDisk) {
  if (const auto error = checkGpuRig(rig.rig().spec())) return *error;
  ShadingRoom room{{&rig}, {wraps.begin(), wraps.end()}};
  for (const float wrap : wraps)
    if (nearKindsOf(rig.lightKinds(), wrap, wrappedDisk).has(Effect::light_near_diskTable)) room.diskTable = true;
  auto buffers = ShadingBuffers::create(context, room, storage);
  if (!buffers) return buffers.error();
  auto commands = GpuCommands::create(context);
  if (!commands) return commands.error();
  auto points = GpuBuffer::create(context, BufferUse::texels, mostPoints * sizeof(PointTexels));
  if (!points) return points.error();
  auto results = GpuBuffer::create(context, BufferUse::output, mostPoints * sizeof(PointResult));
  if (!results) return results.error();
  PointShader shader(context, *std::move(buffers), *std::move(commands), *std::move(points), *std::move(results));
  if (auto error = shader.buffers_.setPoints(shader.points_, shader.results_)) return *error;
  shader.lightKinds_ = rig.lightKinds();
  shader.wrappedDisk_ = wrappedDisk;
  shader.wraps_.assign(wraps.begin(), wraps.end());
  const GpuRig packed = shader.buffers_.pack(0, rig).packed;
  for (const float wrap : wraps)
    for (const ShaderVariant& variant : possibleVariants(rig, packed, wrap, shader.nearKinds(wrap)))
      if (auto error = shader.add(context, variant)) return *error;
  if (auto error = shader.warmUp()) return *error;
  return shader;
}

std::optional<Error> PointShader::add(const GpuContext& context, const ShaderVariant& variant) {
  if (pipelineOf(variant) != nullptr) return std::nullopt;
  auto pipeline = GpuPipeline::compute(context, buffers_.layout(), shaderBinary(variant.binary("points.comp")),
                                       variant.constants());
  if (!pipeline) return pipeline.error();
  shelf_.push_back({variant, *std::move(pipeline)});
  return std::nullopt;
}

/// Drivers put compiling off to the first use.
std::optional<Error> PointShader::warmUp() {
  std::ranges::fill(points_.bytes(), std::byte{0});
  if (auto error = commands_.begin()) return error;
  buffers_.upload(commands_);
  for (const Entry& entry : shelf_) {
    dispatch(entry.pipeline, {0, 0, 1});
    commands_.barrier();
  }
  return commands_.run();
}

std::size_t PointShader::mostPoints() const { return points_.size() / sizeof(PointTexels); }

bool PointShader::knowsWraps(std::span<const float> wraps) const {
  return std::ranges::all_of(wraps, [&](float wrap) { return std::ranges::find(wraps_, wrap) != wraps_.end(); });
}

const GpuPipeline* PointShader::pipelineOf(const ShaderVariant& variant) const {
  const auto found = std::ranges::find(shelf_, variant, &Entry::variant);
  return found == shelf_.end() ? nullptr : &found->pipeline;
}

void PointShader::fillPoints(std::span<const PointAndNormal> points, std::span<const float> wraps) {
  order_.resize(points.size());
  std::iota(order_.begin(), order_.end(), 0u);
  std::ranges::stable_sort(order_, {}, [&](std::uint32_t i) { return wraps[i]; });
  batches_.clear();
  const std::span<PointTexels> to = points_.as<PointTexels>();
  for (std::uint32_t k = 0; k < order_.size(); ++k) {
    const PointAndNormal& point = points[order_[k]];
    to[k] = {{point.position.x, point.position.y, point.position.z, 1},
             {point.normal.x, point.normal.y, point.normal.z, 0}};
    const float wrap = wraps[order_[k]];
    if (batches_.empty() || batches_.back().wrap != wrap) batches_.push_back({wrap, k, 0});
    ++batches_.back().count;
  }
}

void PointShader::dispatch(const GpuPipeline& pipeline, const Batch& batch) {
  const std::uint32_t offsets[] = {place_.rig, buffers_.material(batch.wrap)};
  PointConstants constants;
  constants.count = static_cast<std::int32_t>(batch.count);
  constants.first = static_cast<std::int32_t>(batch.first);
  constants.firstNear = place_.firstNear;
  constants.nearCount = place_.nearCount;
  commands_.bind(pipeline, buffers_.bindings(0), offsets);
  commands_.push(std::as_bytes(std::span(&constants, 1)));
  commands_.dispatch((batch.count + kGroup - 1) / kGroup, static_cast<std::uint32_t>(repeats_));
}

/// All batches, by their own pipelines or another. [us]
Result<double> PointShader::run(const GpuPipeline* instead) {
  if (auto error = commands_.begin()) return *error;
  buffers_.upload(commands_);
  const int start = commands_.mark();
  for (const Batch& batch : batches_) dispatch(instead != nullptr ? *instead : *pipelineOf(batch.variant), batch);
  const int end = commands_.mark();
  if (auto error = commands_.run()) return *error;
  return 1e6 * commands_.seconds(start, end);
}

Result<double> PointShader::again() { return run(nullptr); }

Result<double> PointShader::emptyMicroseconds() {
  ShaderVariant nothing;
  nothing.bands = variant().bands;
  if (pipelineOf(nothing) == nullptr) {
    if (auto error = add(*context_, nothing)) return *error;
    if (const auto first = run(pipelineOf(nothing)); !first) return first.error();
  }
  return run(pipelineOf(nothing));
}

Result<double> PointShader::shade(const RigRunner& rig, std::span<const PointAndNormal> points,
                                  std::span<const float> wraps, std::span<RigRunner::Shaded> out, int repeats) {
  if (points.size() > mostPoints()) return Error{"more points than room was made for", rig.rig().spec().text};
  repeats_ = repeats;
  buffers_.begin();
  place_ = buffers_.pack(0, rig);
  fillPoints(points, wraps);
  for (Batch& batch : batches_) {
    batch.variant = variantOf(rig, place_.packed, rig.effects(batch.wrap), nearKinds(batch.wrap));
    if (pipelineOf(batch.variant) == nullptr)
      return Error{"an effect that was not prepared for", rig.rig().spec().text};
  }
  const auto microseconds = run(nullptr);
  if (!microseconds) return microseconds.error();
  const std::span<const PointResult> results = results_.as<PointResult>();
  for (std::size_t k = 0; k < order_.size(); ++k)
    out[order_[k]] = {colourOf(results[k].rig), colourOf(results[k].near)};
  return *microseconds;
}

}  // namespace rigel::tools
