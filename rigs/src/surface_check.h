// Points of an object's surface at which lights are compared with what its rig makes of them.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "nested_fit.h"
#include "row_kernels.h"
#include "trade_off.h"

namespace rigel {

/// Turns lights into the rows of a TradeOff: what each adds to the error of a rig, at two dozen points or more, each
/// standing for its share of the surface. An `auto` or large least-squares rig is checked at its own points (which
/// costs no projection of their own), any other at points that its fit has not seen.
template <int B>
class SurfaceCheck {
 public:
  /// `truncation`: what the rig's bands leave out is wanted, too.
  SurfaceCheck(const Rig& rig, const RigShape& rest, float wrap, bool truncation);

  /// Indices into RigShape::surface of the points that setPose wants, after the rig's own.
  std::span<const int> extraAnchors() const noexcept { return extraAnchors_; }
  /// `rig` is in the pose already; `anchors` are its own, then the extra ones, in the rig frame.
  void setPose(const Rig& rig, std::span<const Vec3> anchors) noexcept;
  /// The pose in the world; after setPose.
  void place(std::span<const Vec3> anchors, const RigFrame& worldFromRig) noexcept;

  /// Room for so many lights at once.
  void reserve(int lights);

  /// Writes block `index` of `rows` for one light, or a set of them. Returns its mean irradiance [W/m2] over the
  /// surface, the sphere of normals and the channels.
  float describe(const LightSet& lights, Rig& rig, int index);

  /// The mean irradiance alone.
  template <class Light>
  float meanIrradiance(const Light& light) const noexcept {
    float sum = 0;
    for (const Point& point : points_) {
      const RadianceSH<kMinBands> sh = project<kMinBands>(light, point.position, point.footprint);
      sum += point.share * (sh[0].r + sh[0].g + sh[0].b);
    }
    return sum * meanPerL00_;
  }

  /// Orthonormal rows of an `auto` rig; empty for others.
  const std::optional<NestedFit>& nested() const noexcept { return nested_; }
  std::span<const float> damping() const noexcept { return nested_ ? nested_->damping() : std::span<const float>(); }

  /// The high band, what is the same in truncated rows of all points, times `weight`.
  void highBand(std::span<const float> truncated, float weight, HighBand& out) const noexcept;

  LightRows rows;

 private:
  static constexpr int kWidth = 3 * shCount(B);
  static constexpr int kStride = static_cast<int>(rowkernels::padded(kWidth));  // zeros beyond kWidth
  static constexpr int kFirstTruncated = B < kMaxBands ? B : kMaxBands - 1;
  static constexpr int kTruncatedWidth = 3 * (shCount(kMaxBands) - shCount(kFirstTruncated));

  struct Point {
    Vec3 position;  // world
    float share = 0;
    float footprint = 0;
  };

  void setUpScales(float wrap, bool truncation);
  void setUpRows();
  void projectAtPoints(const LightSet& lights);
  void subtractRig(Rig& rig, float* residuals);
  template <class Light>
  float excessOf(const Light& light) const noexcept;

  bool own_ = false;  // points are the rig's own anchors
  std::vector<int> extraAnchors_;
  std::vector<Point> points_;
  std::vector<float> shares_;
  std::optional<NestedFit> nested_;
  RigFrame frame_;
  float meanPerL00_ = 0;
  std::vector<float> truncationScale_;
  std::vector<float> values_;                  // SH times sqrt(share): points x stride
  std::vector<float> x_, y_, z_, footprints_;  // of the points, those with all bands first
  std::vector<std::size_t> rowOf_;             // of each point among these
  std::size_t whole_ = 0;                      // points with all bands
  PreparedLights prepared_;
  std::vector<float> sums_, wholeSums_;  // rows of points, rows of whole_ points
  std::vector<RadianceSH<B>> functionals_, coefficients_;
};

}  // namespace rigel
