// A frame's lights as the crowd's blocks read them: made once a frame, shared by all.
#pragma once

#include <rigel/light_tree.h>

#include "aligned_array.h"
#include "crowd_block.h"

namespace rigel::crowd {

/// What lights are ranked by, a column a light.
class RankTable {
 public:
  /// For so many lights; what was in it is lost where it grows.
  void reserve(std::size_t count);
  void set(std::size_t i, const NearLight& light, std::uint32_t groups) noexcept;
  /// Of the first lights.
  RankRows rows(std::size_t count, bool directed) const noexcept;
  std::size_t bytes() const noexcept { return rows_.bytes() + groups_.capacity() * sizeof(std::uint32_t); }

 private:
  std::size_t stride() const noexcept { return rows_.size() / RankRows::kRows; }

  AlignedArray<float> rows_;
  std::vector<std::uint32_t> groups_;
};

class FrameLights {
 public:
  /// Allocates while lights grow in number. With a tree linear in the lights where it is another than in the last
  /// frame, and otherwise without a look at them.
  void set(const CrowdLights& lights);

  int count() const noexcept { return count_; }
  const LightSet& lights() const noexcept { return *lights_; }
  const PreparedLights& prepared() const noexcept { return *prepared_; }
  const CrowdTree& tree() const noexcept { return tree_; }
  const LightTree::Groups& treeGroups() const noexcept { return treeGroups_; }
  bool hasTree() const noexcept { return tree_.tree != nullptr; }
  bool directed() const noexcept { return lights_->spotCount() + lights_->diskCount() > 0; }
  NearLight nearLightOf(int i) const noexcept {
    return lights_->visit(i, [](const auto& light) { return nearLight(light); });
  }
  /// All of it.
  GpuNearLight near(int i) const noexcept { return hasTree() ? gpuNearLight(nearLightOf(i)) : near_[i]; }
  std::span<const std::uint32_t> ids() const noexcept { return ids_; }
  /// Sorted ids of lights of which nothing was in any rig in the last frame.
  std::span<const std::uint32_t> fresh() const noexcept { return fresh_; }

  // Without a tree.
  const RankRows& ranks() const noexcept { return ranks_; }
  /// All lights.
  std::span<const LightUse> uses() const noexcept { return prepared_->all().first(static_cast<std::size_t>(count_)); }
  bool grouped() const noexcept { return grouped_; }  // not all lights are of all groups

  std::size_t bytes() const noexcept;

 private:
  void setIds(std::span<const std::uint32_t> ids);
  void setAll();
  /// `each` calls what it is given with whether a light shines, for all in their order.
  template <class Each>
  void findFresh(const Each& each);

  const LightSet* lights_ = nullptr;
  const PreparedLights* prepared_ = nullptr;
  CrowdTree tree_;
  LightTree::Groups treeGroups_;
  std::uint64_t version_ = 0;  // of the tree in the last frame, or 0
  int count_ = 0;
  RankTable table_;
  RankRows ranks_{};
  std::vector<GpuNearLight> near_;
  std::span<const std::uint32_t> ids_;
  std::vector<std::uint32_t> indices_;  // ids where the caller gave none
  bool grouped_ = false;
  std::vector<std::uint32_t> fresh_;
  std::vector<std::uint32_t> shining_, shone_;  // sorted ids of lights that are not black, of this frame and the last
};

}  // namespace rigel::crowd
