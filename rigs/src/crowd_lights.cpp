#include "crowd_lights.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "weights.h"

namespace rigel::crowd {
namespace {

bool isFinite(Vec3 v) noexcept { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

void FrameLights::addRank(int i, const NearLight& light) noexcept {
  using Kind = NearLight::Kind;
  const auto put = [&](RankRows::Row row, float value) {
    rows_.data()[static_cast<std::size_t>(row) * (rows_.size() / RankRows::kRows) + static_cast<std::size_t>(i)] =
        value;
  };
  const bool spot = light.kind == Kind::spot, disk = light.kind == Kind::disk;
  const bool counts = light.kind != Kind::directional && light.share > 0 && isFinite(light.position);
  const float radius = std::max(light.radius, kMinPointRadius);
  float power = counts ? magnitude(light.colour) : 0;
  if (disk || light.kind == Kind::sphere) power *= static_cast<float>(kPi) * radius * radius;
  const Vec3 position = counts ? light.position : Vec3{};
  put(RankRows::x, position.x);
  put(RankRows::y, position.y);
  put(RankRows::z, position.z);
  put(RankRows::power, power);
  put(RankRows::radius, radius);
  put(RankRows::inverseRange, counts && !disk && light.kind != Kind::sphere ? 1 / light.range : 0);
  put(RankRows::axisX, light.axis.x);
  put(RankRows::axisY, light.axis.y);
  put(RankRows::axisZ, light.axis.z);
  put(RankRows::cosOuter, spot ? light.cosOuter : -2);
  put(RankRows::inverseWidth, spot ? 1 / std::max(light.cosInner - light.cosOuter, kMinConeWidth) : 1);
  put(RankRows::disk, disk ? 1.0f : 0.0f);
  put(RankRows::twoSided, disk && light.cosOuter < 0 ? 1.0f : 0.0f);
}

void FrameLights::set(const CrowdLights& lights) {
  lights_ = lights.lights;
  prepared_ = lights.prepared;
  const auto count = static_cast<std::size_t>(lights_->size());
  assert(lights.ids.empty() || lights.ids.size() == count);
  ids_.resize(count);
  near_.resize(count);
  if (lights.ids.empty()) std::iota(ids_.begin(), ids_.end(), 0u);
  if (!lights.ids.empty()) std::ranges::copy(lights.ids, ids_.begin());
  groups_.resize(count);
  grouped_ = false;
  for (std::size_t i = 0; i < count; ++i) {
    groups_[i] = lights_->groups(static_cast<int>(i));
    grouped_ = grouped_ || groups_[i] != kAllLightGroups;
  }

  rows_.reserve(RankRows::kRows * count);
  const std::size_t stride = rows_.size() / RankRows::kRows;
  for (std::size_t r = 0; r < RankRows::kRows; ++r) ranks_.row[r] = rows_.data() + r * stride;
  ranks_.groups = groups_.data();
  ranks_.count = static_cast<int>(count);
  ranks_.directed = lights_->spotCount() + lights_->diskCount() > 0;
  for (int i = 0; i < static_cast<int>(count); ++i)
    lights_->visit(i, [&](const auto& light) {
      const NearLight near = nearLight(light);
      near_[i] = gpuNearLight(near);
      addRank(i, near);
    });
  findFresh();
}

void FrameLights::findFresh() {
  shone_.swap(shining_);
  shining_.clear();
  shining_.reserve(ids_.size());
  shone_.reserve(ids_.size());
  for (std::size_t i = 0; i < ids_.size(); ++i)
    if (ranks_.row[RankRows::power][i] > 0) shining_.push_back(ids_[i]);
  if (!std::ranges::is_sorted(shining_)) std::ranges::sort(shining_);
  fresh_.assign(ids_.size(), 0);
  if (shining_ == shone_) return;
  for (std::size_t i = 0; i < ids_.size(); ++i) fresh_[i] = std::ranges::binary_search(shone_, ids_[i]) ? 0 : 1;
}

std::size_t FrameLights::bytes() const noexcept {
  return rows_.bytes() + near_.capacity() * sizeof(GpuNearLight) + fresh_.capacity() +
         (ids_.capacity() + groups_.capacity() + shining_.capacity() + shone_.capacity()) * sizeof(std::uint32_t);
}

}  // namespace rigel::crowd
