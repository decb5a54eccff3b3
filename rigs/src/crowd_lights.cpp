#include "crowd_lights.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <new>
#include <numeric>

#include "weights.h"

namespace rigel::crowd {
namespace {

using Kind = NearLight::Kind;

bool isFinite(Vec3 v) noexcept { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool counts(const NearLight& light) noexcept {
  return light.kind != Kind::directional && light.share > 0 && isFinite(light.position);
}

float rankRadius(const NearLight& light) noexcept { return std::max(light.radius, kMinPointRadius); }

float rankPower(const NearLight& light) noexcept {
  if (!counts(light)) return 0;
  const float radius = rankRadius(light), power = magnitude(light.colour);
  const bool area = light.kind == Kind::disk || light.kind == Kind::sphere;
  return area ? power * (static_cast<float>(kPi) * radius * radius) : power;
}

}  // namespace

void RankTable::reserve(std::size_t count) {
  rows_.reserve(RankRows::kRows * count);
  groups_.resize(std::max(groups_.size(), count));
}

void RankTable::set(std::size_t i, const NearLight& light, std::uint32_t groups) noexcept {
  const auto put = [&](RankRows::Row row, float value) {
    rows_.data()[static_cast<std::size_t>(row) * stride() + i] = value;
  };
  const bool spot = light.kind == Kind::spot, disk = light.kind == Kind::disk;
  const Vec3 position = counts(light) ? light.position : Vec3{};
  put(RankRows::x, position.x);
  put(RankRows::y, position.y);
  put(RankRows::z, position.z);
  put(RankRows::power, rankPower(light));
  put(RankRows::radius, rankRadius(light));
  put(RankRows::inverseRange, counts(light) && !disk && light.kind != Kind::sphere ? 1 / light.range : 0);
  put(RankRows::axisX, light.axis.x);
  put(RankRows::axisY, light.axis.y);
  put(RankRows::axisZ, light.axis.z);
  put(RankRows::cosOuter, spot ? light.cosOuter : -2);
  put(RankRows::inverseWidth, spot ? 1 / std::max(light.cosInner - light.cosOuter, kMinConeWidth) : 1);
  put(RankRows::disk, disk ? 1.0f : 0.0f);
  put(RankRows::twoSided, disk && light.cosOuter < 0 ? 1.0f : 0.0f);
  groups_[i] = groups;
}

RankRows RankTable::rows(std::size_t count, bool directed) const noexcept {
  RankRows view{};
  for (std::size_t r = 0; r < RankRows::kRows; ++r) view.row[r] = rows_.data() + r * stride();
  view.groups = groups_.data();
  view.count = static_cast<int>(count);
  view.directed = directed;
  return view;
}

void FrameLights::set(const CrowdLights& lights) {
  lights_ = lights.lights;
  prepared_ = lights.prepared;
  tree_ = lights.tree;
  count_ = lights_->size();
  setIds(lights.ids);
  if (!hasTree()) {
    version_ = 0;
    return setAll();
  }
  assert(tree_.cell > 0 && std::isfinite(tree_.cell));
  assert(static_cast<std::size_t>(prepared_->size()) == ids_.size() + tree_.tree->clusters().size());
  treeGroups_ = tree_.tree->groups();
  // The first frame after lights have changed tells who is new; in the next they no longer are.
  const std::uint64_t version = tree_.tree->version();
  if (version == version_) return fresh_.clear();
  findFresh([&](const auto& next) { lights_->visitAll([&](const auto& light) { next(colourOf(light) != Rgb{}); }); });
  version_ = version;
}

void FrameLights::setIds(std::span<const std::uint32_t> ids) {
  const auto count = static_cast<std::size_t>(count_);
  assert(ids.empty() || ids.size() == count);
  ids_ = ids;
  if (!ids.empty()) return;
  if (const std::size_t known = indices_.size(); known < count) {
    indices_.resize(count);
    std::iota(indices_.begin() + static_cast<std::ptrdiff_t>(known), indices_.end(), static_cast<std::uint32_t>(known));
  }
  ids_ = std::span<const std::uint32_t>(indices_).first(count);
}

void FrameLights::setAll() {
  const std::size_t count = ids_.size();
  near_.resize(count);
  table_.reserve(count);
  grouped_ = false;
  for (std::size_t i = 0; i < count; ++i) {
    const int n = static_cast<int>(i);
    const NearLight light = nearLightOf(n);
    const std::uint32_t groups = lights_->groups(n);
    new (&near_[i]) GpuNearLight(gpuNearLight(light));  // in place: of trivial structs, and copies wait for stores
    table_.set(i, light, groups);
    grouped_ = grouped_ || groups != kAllLightGroups;
  }
  ranks_ = table_.rows(count, directed());
  findFresh([&](const auto& next) {
    for (std::size_t i = 0; i < count; ++i) next(ranks_.row[RankRows::power][i] > 0);
  });
}

template <class Each>
void FrameLights::findFresh(const Each& each) {
  shone_.swap(shining_);
  shining_.reserve(ids_.size());
  shone_.reserve(ids_.size());
  shining_.resize(ids_.size());
  const std::uint32_t* id = ids_.data();
  std::uint32_t* to = shining_.data();
  each([&](bool shines) {
    *to = *id++;
    to += shines ? 1 : 0;
  });
  shining_.resize(static_cast<std::size_t>(to - shining_.data()));
  if (!std::ranges::is_sorted(shining_)) std::ranges::sort(shining_);
  fresh_.clear();
  fresh_.reserve(ids_.size());
  if (shining_ != shone_) std::ranges::set_difference(shining_, shone_, std::back_inserter(fresh_));
}

std::size_t FrameLights::bytes() const noexcept {
  return table_.bytes() + near_.capacity() * sizeof(GpuNearLight) +
         (indices_.capacity() + fresh_.capacity() + shining_.capacity() + shone_.capacity()) * sizeof(std::uint32_t);
}

}  // namespace rigel::crowd
