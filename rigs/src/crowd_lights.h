// A frame's lights as the crowd's blocks read them: made once a frame, shared by all.
#pragma once

#include "aligned_array.h"
#include "crowd_block.h"

namespace rigel::crowd {

class FrameLights {
 public:
  /// Allocates while lights grow in number.
  void set(const CrowdLights& lights);

  int count() const noexcept { return static_cast<int>(ids_.size()); }
  const PreparedLights& prepared() const noexcept { return *prepared_; }
  const RankRows& ranks() const noexcept { return ranks_; }
  const GpuNearLight& near(int i) const noexcept { return near_[i]; }  // all of it
  /// All lights.
  std::span<const LightUse> uses() const noexcept { return prepared_->all().first(ids_.size()); }
  std::span<const std::uint32_t> ids() const noexcept { return ids_; }
  bool grouped() const noexcept { return grouped_; }  // not all lights are of all groups
  std::span<const std::uint8_t> fresh() const noexcept { return fresh_; }

  std::size_t bytes() const noexcept;

 private:
  void addRank(int i, const NearLight& light) noexcept;
  void findFresh();

  const LightSet* lights_ = nullptr;
  const PreparedLights* prepared_ = nullptr;
  AlignedArray<float> rows_;
  RankRows ranks_{};
  std::vector<GpuNearLight> near_;
  std::vector<std::uint32_t> ids_;
  std::vector<std::uint32_t> groups_;
  bool grouped_ = false;
  std::vector<std::uint8_t> fresh_;
  std::vector<std::uint32_t> shining_, shone_;  // sorted ids of lights that are not black, of this frame and the last
};

}  // namespace rigel::crowd
