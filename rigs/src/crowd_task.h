// What one task of a frame has to itself: scratch memory for a block, and its part of the frame's account.
#pragma once

#include "crowd_kind.h"
#include "crowd_tree_task.h"

#include <atomic>

namespace rigel::crowd {

/// A part of a frame's blocks: whoever takes one from it has it alone.
class BlockQueue {
 public:
  static constexpr std::size_t kNone = ~std::size_t{0};

  void set(std::size_t begin, std::size_t end) noexcept {
    next_.store(begin, std::memory_order_relaxed);
    end_ = end;
  }
  std::size_t take() noexcept { return held(next_.fetch_add(1, std::memory_order_relaxed)); }
  /// What will be taken next, if others leave it.
  std::size_t following() const noexcept { return held(next_.load(std::memory_order_relaxed)); }

 private:
  std::size_t held(std::size_t i) const noexcept { return i < end_ ? i : kNone; }
  std::atomic<std::size_t> next_{0};
  std::size_t end_ = 0;
};

/// What a frame reads of a Character lies in so many lines.
inline constexpr std::size_t kCharacterLines = 2;

struct Task {
  alignas(64) BlockQueue blocks;  // others write it too, where they have done theirs
  alignas(64) Places places;
  alignas(64) float floors[kBlock];
  alignas(64) std::uint32_t groups[kBlock];
  alignas(64) float placeRows[kPlaceRows * kBlock];
  alignas(64) float rigPlaces[kBlock][kPlaceRows];
  NearHits hits;
  FetchList ahead;
  float* coefficientsOf[kBlock];            // where each character's go
  AlignedArray<float> positions;            // as skinAnchors writes them
  AlignedArray<float> x, y, z, footprints;  // dense
  AlignedArray<double> normal;              // refreshOperators
  AlignedArray<float> op, errors, sums, rows, coefficients, shown;
  BlockShares shares;
  TreeTask tree;
  CrowdStats stats;
  bool exhausted = false;  // memory has ended

  /// For blocks of a kind and that many lights without a tree; `width`: floats of an SH vector, `padded` as they are
  /// packed.
  void reserve(const CrowdKind::Data& kind, int width, int padded, int lights) {
    const auto s = static_cast<std::size_t>(kind.samples), k = static_cast<std::size_t>(kind.vectors);
    const auto w = static_cast<std::size_t>(width), v = static_cast<std::size_t>(padded);
    const auto n = static_cast<std::size_t>(lights);
    positions.reserve(3 * s * kBlock);
    for (AlignedArray<float>* row : {&x, &y, &z, &footprints}) row->reserve((s + 1) * kBlock);
    normal.reserve(refreshScratch(kind.samples, kind.vectors));
    op.reserve(k * s * kBlock);
    errors.reserve(n * kBlock);
    shares.reserve(n, n);
    sums.reserve((w * s + 1) * kBlock);
    rows.reserve(k * v * kBlock);
    coefficients.reserve(k * v * kBlock);
    shown.reserve(k * v);
    ahead.reserve(kBlock * linesAhead(kind, k * v * sizeof(float)));
  }

  /// Of a character: itself, its palette, its results.
  static std::size_t linesAhead(const CrowdKind::Data& kind, std::size_t resultBytes) noexcept {
    const std::size_t near = static_cast<std::size_t>(kind.options.nearSlots) * sizeof(GpuNearLight);
    return kCharacterLines + kind.jointLines.most() + mostLines(resultBytes) + mostLines(sizeof(GpuRig)) +
           mostLines(near);
  }

  std::size_t bytes() const noexcept {
    std::size_t sum = sizeof(*this) + normal.bytes() + shares.bytes() + ahead.bytes() + tree.bytes();
    for (const AlignedArray<float>* a :
         {&positions, &x, &y, &z, &footprints, &op, &errors, &sums, &rows, &coefficients, &shown})
      sum += a->bytes();
    return sum;
  }
};

/// Times stages by a probe's clock.
class StageClock {
 public:
  StageClock(CrowdProbe probe, CrowdStats& stats) noexcept : probe_(probe), stats_(stats) { last_ = now(); }
  void done(CrowdStage stage) noexcept {
    if (probe_.now == nullptr) return;
    const std::uint64_t time = now();
    stats_.ticks[static_cast<std::size_t>(stage)] += time - last_;
    last_ = time;
  }

 private:
  std::uint64_t now() const noexcept { return probe_.now != nullptr ? probe_.now(probe_.context) : 0; }
  CrowdProbe probe_;
  CrowdStats& stats_;
  std::uint64_t last_ = 0;
};

}  // namespace rigel::crowd
