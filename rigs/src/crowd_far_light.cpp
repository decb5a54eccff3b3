#include "crowd_far_light.h"

#include <algorithm>

namespace rigel::crowd {

void addSlopes(const FarLight& far, std::size_t rows, Vec3 centre, float* slopes) noexcept {
  const Vec3 by = centre - far.centre;
  const float* from = far.slopes.data();
  for (std::size_t row = 0; row < rows; ++row, from += 4, slopes += 4) {
    slopes[0] += from[0] + from[1] * by.x + from[2] * by.y + from[3] * by.z;
    for (int axis = 1; axis < 4; ++axis) slopes[axis] += from[axis];
  }
}

void FarLights::reserve(std::size_t uses, std::size_t rows) {
  const std::size_t list = std::min(uses, kList);
  if (rows != rows_) clear();
  rows_ = rows;
  for (FarLight& far : kept_) {
    far.slopes.reserve(4 * rows);
    far.parts.reserve(list);
    far.rest.open.reserve(list);
  }
  whole_.reserve(list);
  parts_.reserve(list);
}

template <int B>
const FarLight& FarLights::find(const FrameLights& lights, const Cell& cell) {
  const Cell region = regionOf(cell);
  const auto end = kept_.begin() + static_cast<std::ptrdiff_t>(count_);
  const auto known = std::find_if(kept_.begin(), end, [&](const FarLight& far) { return far.region == region; });
  if (known != end) return *known;
  // The oldest goes.
  FarLight& far = kept_[next_];
  next_ = (next_ + 1) % kKept;
  count_ = std::min(count_ + 1, kKept);
  far.region.level = kNobodys;  // should memory end
  ask<B>(lights, region, far);
  far.region = region;
  return far;
}

template <int B>
void FarLights::ask(const FrameLights& lights, const Cell& region, FarLight& far) {
  const CrowdTree& tree = lights.tree();
  const CellBall ball = ballOfRegion(region, tree.cell);
  LightQuery query;
  query.centre = far.centre = ball.centre;
  query.radius = ball.radius;
  query.target = tree.target;
  query.wrap = tree.wrap;
  query.groups = region.groups;
  // Cells of a level are all as large.
  const float part = ballOf(region, tree.cell).radius;
  tree.tree->takeDistant(query, part, whole_, parts_, far.rest);
  ++asked_;

  const auto single = [&](const LightUse& use) { return use.light < static_cast<std::uint32_t>(lights.count()); };
  far.lights = static_cast<int>(std::ranges::count_if(whole_, single) + std::ranges::count_if(parts_, single));
  far.clusters = static_cast<int>(whole_.size() + parts_.size()) - far.lights;
  far.parts.set(lights.prepared(), parts_);
  std::fill_n(far.slopes.data(), 4 * rows_, 0.0f);
  addSlopes(projectFar<B>(lights.prepared(), whole_, far.centre), far.slopes.data());
}

std::size_t FarLights::bytes() const noexcept {
  std::size_t sum = (whole_.capacity() + parts_.capacity()) * sizeof(LightUse);
  for (const FarLight& far : kept_)
    sum += far.slopes.bytes() + far.parts.bytes() + far.rest.open.capacity() * sizeof(LightCut::Part);
  return sum;
}

template const FarLight& FarLights::find<2>(const FrameLights&, const Cell&);
template const FarLight& FarLights::find<3>(const FrameLights&, const Cell&);
template const FarLight& FarLights::find<4>(const FrameLights&, const Cell&);
template const FarLight& FarLights::find<5>(const FrameLights&, const Cell&);

}  // namespace rigel::crowd
