// What the bounds need of rigs whose samples are anywhere: poly, rbf, @lsq and @gauss.
#pragma once

#include "falloff.h"

#include <rigel/light_bound.h>

#include <bitset>

namespace rigel {

/// Reads the operator and the basis of a rig in its current pose.
class SamplePlanner {
 public:
  explicit SamplePlanner(const Rig& rig) noexcept;

  /// Fills `samples`, and in `plan` what concerns them. False where the rig has more samples than the plan holds.
  bool plan(detail::BoundPlan& plan, detail::SamplePlan& samples) noexcept;

 private:
  static constexpr int kMax = detail::SamplePlan::kMaxSamples;
  static constexpr int kMaxWatched = 96;
  static constexpr int kMaxDegree = detail::SamplePlan::kMaxDegree;
  static constexpr int kLinear = 4;          // 1, x, y, z
  static constexpr std::size_t kAtOnce = 8;  // points probed
  using Degrees = std::array<std::uint8_t, 3>;
  using Values = std::array<float, kMaxWatched>;

  void readSpan(detail::BoundPlan& plan) noexcept;
  void watch(int i, int j, int k) noexcept;
  bool watches(int i, int j, int k) const noexcept;
  void watchBeyond() noexcept;
  void valuesAt(const std::array<float, 3>& p, float* out) const noexcept;
  void weightsAt(std::span<const Vec3> points, int samples, float* out) const noexcept;
  void probe(std::span<const Vec3> points, detail::SamplePlan& samples) noexcept;
  void probeSome(std::span<const Vec3> points, detail::SamplePlan& samples) noexcept;
  void probeAll(detail::SamplePlan& samples) noexcept;
  int errorsOfLinear(const Falloff& falloff, std::span<Degrees> monomials,
                     std::span<double> coefficients) const noexcept;
  void coverFalloff(detail::SamplePlan& samples) noexcept;
  void placeProbes(detail::SamplePlan& samples) const noexcept;
  void listBoundary(detail::SamplePlan& samples) const noexcept;

  const Rig& rig_;
  std::array<double, 3> centre_{}, inverseHalf_{};
  int watched_ = 0;                         // products of Chebyshev polynomials whose error is measured
  std::array<Degrees, kMaxWatched> watch_;  // their degrees: first those of the span, then some beyond
  std::bitset<kMaxDegree * kMaxDegree * kMaxDegree> known_;  // what watch_ holds
  std::array<Degrees, RigBasis::kCapacity> span_;            // of an invquad rig's polynomial
  int degree_ = 1;                                           // largest of them
  Values defect_{};                                          // largest error of the rig about each
  std::size_t stride_ = 0;                                   // floats of a row of values: zeros beyond those watched
  std::array<float, kMax * kMaxWatched> atSample_;           // samples x stride
  double lebesgue_ = 1;
  std::array<bool, 3> spanned_{};  // the functions x, y, z
};

}  // namespace rigel
