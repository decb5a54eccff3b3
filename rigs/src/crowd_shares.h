// Shares of a block's characters in its lights.
#pragma once

#include <rigel/project_batch.h>

#include "aligned_array.h"
#include "crowd_block.h"

#include <algorithm>
#include <vector>

namespace rigel::crowd {

/// 1 but where they are set.
class BlockShares {
 public:
  /// For so many lights, of which so many have shares.
  void reserve(std::size_t lights, std::size_t shared) {
    if (lights > rows_.size()) rows_.resize(lights, nullptr);
    numbers_.reserve(shared * kRow);
  }
  void clear(std::size_t characters) noexcept {
    if (used_ > 0) std::ranges::fill(rows_, nullptr);
    used_ = 0;
    period_ = characters;
  }
  void set(int light, std::size_t character, float share) noexcept {
    if (rows_[light] == nullptr) {
      rows_[light] = numbers_.data() + used_++ * kRow;
      std::fill_n(rows_[light], kRow, 1.0f);
    }
    for (std::size_t i = character; i < kRow; i += period_) rows_[light][i] = share;
  }
  PointShares view(std::size_t lights) const noexcept { return {{rows_.data(), used_ > 0 ? lights : 0}, period_}; }
  std::size_t bytes() const noexcept { return numbers_.bytes() + rows_.capacity() * sizeof(float*); }

 private:
  // Whole lines of the cache, so that vectors of full blocks are not split between two.
  static constexpr std::size_t kRow = 2 * kBlock;
  static_assert(kRow >= kBlock + PointShares::kRowEnd);

  std::vector<float*> rows_;
  AlignedArray<float> numbers_;
  std::size_t used_ = 0, period_ = 1;
};

}  // namespace rigel::crowd
