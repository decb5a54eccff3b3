#include "crowd_tree_task.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <ranges>
#include <utility>

namespace rigel::crowd {
namespace {

/// A character's box as a ball in the world.
CellBall ballOf(const Places& places, int c) noexcept {
  Vec3 axes[4];
  for (int i = 0; i < 12; ++i) axes[i / 3][i % 3] = places.frame[i][c];
  Vec3 centre = axes[3];
  float half = 0, longest = 0;
  for (int a = 0; a < 3; ++a) {
    centre += axes[a] * (0.5f * (places.lo[a][c] + places.hi[a][c]));
    const float h = 0.5f * (places.hi[a][c] - places.lo[a][c]);
    half += h * h;
    longest = std::max(longest, dot(axes[a], axes[a]));
  }
  return {centre, std::sqrt(half * longest)};
}

/// Whether a light could be seen there: squares of distances are finite. Not for NaN.
bool isInReach(const CellBall& ball) noexcept {
  const auto within = [](float v) { return std::abs(v) < 1e15f; };
  return within(ball.centre.x) && within(ball.centre.y) && within(ball.centre.z) && within(ball.radius);
}

/// From all of a block to the members of a cell, a number a sample and character.
void gather(const float* from, int n, std::span<const int> members, std::size_t samples, float* to) noexcept {
  for (std::size_t s = 0; s < samples; ++s, from += n)
    for (const int c : members) *to++ = from[c];
}

}  // namespace

void TreeTask::reserve(int samples, int rows, std::size_t uses) {
  const std::size_t lights = std::min(uses, kListed);
  const auto points = static_cast<std::size_t>(samples) * kBlock;
  cellLights_.reserve(uses, static_cast<std::size_t>(rows));
  cells_.reserve(CellLights::kBlockCells);
  listed_.reserve(lights);
  merged_.reserve(lights);
  shares_.reserve((lights + 1) * kBlock);
  ranks_.reserve(lights);
  blockShares_.reserve(lights, std::size_t{kBlock} * kMaxCrowdNear);
  for (AlignedArray<float>* row : {&x_, &y_, &z_, &footprints_}) row->reserve(points);
  sums_.reserve(static_cast<std::size_t>(rows) * points);
}

void TreeTask::addShare(const CellShare& share, int c) noexcept {
  auto entry = std::ranges::find(cells_, share.cell, &BlockCell::cell);
  if (entry == cells_.end()) {
    cells_.push_back({share.cell});
    entry = cells_.end() - 1;
  }
  entry->share[c] = share.share;
}

template <int B>
void TreeTask::select(const FrameLights& lights, const Places& places, const std::uint32_t* groups, int n,
                      CrowdStats& stats) {
  cells_.clear();
  for (int c = 0; c < n; ++c) {
    const CellBall ball = ballOf(places, c);
    if (places.finite[c] != 0 || !isInReach(ball)) continue;
    CellShare shares[kMostShares];
    const std::uint32_t mask = groupsThatCount(groups[c], lights.treeGroups());
    const int count = cellsOf(ball.centre, ball.radius, lights.tree().cell, mask, shares);
    for (int i = 0; i < count; ++i) addShare(shares[i], c);
  }
  // What a character is given is summed in the same order whoever else is in the block.
  std::ranges::sort(cells_, {}, &BlockCell::cell);
  cellLights_.beginBlock();
  for (BlockCell& cell : cells_) cell.number = cellLights_.find<B>(lights, cell.cell);
  count(n, stats);
}

void TreeTask::count(int n, CrowdStats& stats) const noexcept {
  float bound[kBlock] = {}, mean[kBlock] = {};
  for (const BlockCell& cell : cells_) {
    const CellLight light = cellLights_[cell.number];
    for (int c = 0; c < n; ++c) {
      if (cell.share[c] == 0) continue;
      stats.lights += static_cast<std::uint64_t>(light.lights);
      stats.clusters += static_cast<std::uint64_t>(light.clusters);
      bound[c] += cell.share[c] * light.bound;
      mean[c] += cell.share[c] * light.mean;
    }
  }
  for (int c = 0; c < n; ++c)
    if (mean[c] > 0) stats.merged = std::max(stats.merged, bound[c] / mean[c]);
}

RankRows TreeTask::rank(const FrameLights& lights) {
  listed_.clear();
  for (const BlockCell& cell : cells_) {
    const auto numbers = [](const LightUse& use) { return use.light; };
    merged_.clear();
    std::ranges::set_union(listed_, cellLights_[cell.number].single | std::views::transform(numbers),
                           std::back_inserter(merged_));
    listed_.swap(merged_);
  }
  shares_.reserve((listed_.size() + 1) * kBlock);
  std::fill_n(shares_.data(), listed_.size() * kBlock, 0.0f);
  for (const BlockCell& cell : cells_) {
    std::size_t row = 0;
    for (const LightUse& use : cellLights_[cell.number].single) {
      while (listed_[row] != use.light) ++row;
      for (int c = 0; c < kBlock; ++c) shares_.data()[row * kBlock + c] += cell.share[c] * use.share;
    }
  }
  ranks_.reserve(listed_.size());
  for (std::size_t i = 0; i < listed_.size(); ++i) {
    const int light = static_cast<int>(listed_[i]);
    ranks_.set(i, lights.nearLightOf(light), lights.lights().groups(light));
  }
  return ranks_.rows(listed_.size(), lights.directed());
}

void TreeTask::share(float* errors) const noexcept {
  for (std::size_t i = 0; i < listed_.size() * kBlock; ++i) errors[i] *= shares_.data()[i];
}

void TreeTask::setNear(int c, std::span<const NearSlot> slots) noexcept {
  nearCount_[c] = 0;
  for (const NearSlot& slot : slots) {
    if (!(slot.to > 0)) continue;
    const auto light = static_cast<std::uint32_t>(slot.light);
    const std::ptrdiff_t row = rowOf(listed_, light);
    if (row < 0) continue;
    const float whole = shares_.data()[row * kBlock + c];
    if (!(whole > 0)) continue;
    near_[c][static_cast<std::size_t>(nearCount_[c]++)] = {light, std::max(0.0f, 1 - slot.to / whole)};
  }
}

void TreeTask::setShares(const CellLight& light, std::span<const int> members) {
  blockShares_.reserve(light.near.size(), std::size_t{kBlock} * kMaxCrowdNear);
  blockShares_.clear(members.size());
  for (std::size_t j = 0; j < members.size(); ++j) {
    const auto c = static_cast<std::size_t>(members[j]);
    for (const NearShare& near : std::span(near_[c]).first(static_cast<std::size_t>(nearCount_[c]))) {
      const auto found = std::ranges::lower_bound(light.single, near.light, {}, &LightUse::light);
      if (found == light.single.end() || found->light != near.light) continue;
      blockShares_.set(static_cast<int>(found - light.single.begin()), j, near.rest);
    }
  }
}

template <int B>
void TreeTask::projectCell(const FrameLights& lights, const CellLight& light, const Vec3Rows& points,
                           std::span<const float> footprints, std::span<const int> members, std::span<float> sums,
                           LinesAhead ahead) {
  setShares(light, members);
  projectBatch<B>(lights.prepared(), light.near, points, footprints, sums, blockShares_.view(light.near.size()), ahead);
  if (light.distant != nullptr) addDistant(light.distant, light.centre, points, sums);
}

template <int B>
void TreeTask::project(const FrameLights& lights, const Vec3Rows& points, std::span<const float> footprints, int n,
                       std::span<float> sums, LinesAhead ahead) {
  constexpr std::size_t kRows = 3 * shCount(B);
  const std::size_t samples = points.x.size() / static_cast<std::size_t>(n);
  std::array<int, kBlock> all;
  int seen[kBlock] = {};
  for (int c = 0; c < n; ++c) all[static_cast<std::size_t>(c)] = c;
  const auto whole = std::span(all).first(static_cast<std::size_t>(n));
  const auto isWhole = [](float share) { return share == 1; };
  if (cells_.size() == 1 && std::ranges::all_of(std::span(cells_[0].share).first(whole.size()), isWhole))
    return projectCell<B>(lights, cellLights_[cells_[0].number], points, footprints, whole, sums, ahead);

  std::ranges::fill(sums, 0.0f);
  for (const BlockCell& cell : cells_) {
    std::array<int, kBlock> memberOf;
    std::size_t count = 0;
    for (const int c : whole)
      if (cell.share[c] > 0) memberOf[count++] = c;
    const auto members = std::span<const int>(memberOf).first(count);
    const std::size_t own = count * samples;
    gather(points.x.data(), n, members, samples, x_.data());
    gather(points.y.data(), n, members, samples, y_.data());
    gather(points.z.data(), n, members, samples, z_.data());
    gather(footprints.data(), n, members, samples, footprints_.data());
    const auto row = [own](const AlignedArray<float>& a) { return std::span(a.data(), own); };
    projectCell<B>(lights, cellLights_[cell.number], {row(x_), row(y_), row(z_)}, row(footprints_), members,
                   {sums_.data(), kRows * own}, std::exchange(ahead, {}));
    const float* from = sums_.data();
    float* to = sums.data();
    for (std::size_t s = 0; s < kRows * samples; ++s, to += n)
      for (const int c : members) {
        const float part = cell.share[c] * *from++;
        to[c] = seen[c] == 0 ? part : to[c] + part;
      }
    for (const int c : members) ++seen[c];
  }
}

std::size_t TreeTask::bytes() const noexcept {
  std::size_t sum = cellLights_.bytes() + cells_.capacity() * sizeof(BlockCell) + ranks_.bytes() +
                    blockShares_.bytes() + (listed_.capacity() + merged_.capacity()) * sizeof(std::uint32_t);
  for (const AlignedArray<float>* a : {&shares_, &x_, &y_, &z_, &footprints_, &sums_}) sum += a->bytes();
  return sum;
}

template void TreeTask::select<2>(const FrameLights&, const Places&, const std::uint32_t*, int, CrowdStats&);
template void TreeTask::select<3>(const FrameLights&, const Places&, const std::uint32_t*, int, CrowdStats&);
template void TreeTask::select<4>(const FrameLights&, const Places&, const std::uint32_t*, int, CrowdStats&);
template void TreeTask::select<5>(const FrameLights&, const Places&, const std::uint32_t*, int, CrowdStats&);
template void TreeTask::project<2>(const FrameLights&, const Vec3Rows&, std::span<const float>, int, std::span<float>,
                                   LinesAhead);
template void TreeTask::project<3>(const FrameLights&, const Vec3Rows&, std::span<const float>, int, std::span<float>,
                                   LinesAhead);
template void TreeTask::project<4>(const FrameLights&, const Vec3Rows&, std::span<const float>, int, std::span<float>,
                                   LinesAhead);
template void TreeTask::project<5>(const FrameLights&, const Vec3Rows&, std::span<const float>, int, std::span<float>,
                                   LinesAhead);

}  // namespace rigel::crowd
