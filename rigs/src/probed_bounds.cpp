#include <rigel/prepared_lights.h>
#include <rigel/probed_bounds.h>

#include "disk_field.h"
#include "light_place.h"
#include "poly_model.h"
#include "row_kernels.h"
#include "sample_bound.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

namespace rigel {
namespace {

using detail::SeenLight;
using detail::SeenPoint;

constexpr int kBands = 3;
constexpr std::size_t kCoefficients = shCount(kBands);
constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Points of a box, along each axis.
constexpr int kGrid = 8;

double squareOf(const Triple& v) noexcept { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }

/// A disk as points see it, by their ways from its centre.
struct Face {
  Triple axis{};
  double height(const Triple& way) const noexcept { return way[0] * axis[0] + way[1] * axis[1] + way[2] * axis[2]; }
  /// Distance to a disk of that radius.
  double gap(const Triple& way, double radius) const noexcept {
    const double z = height(way);
    const double beside = std::max(0.0, std::sqrt(std::max(0.0, squareOf(way) - z * z)) - radius);
    return std::sqrt(z * z + beside * beside);
  }
};

template <class Light>
Light white(Light light) noexcept {
  if constexpr (requires { light.intensity; })
    light.intensity = {1, 1, 1};
  else
    light.radiance = {1, 1, 1};
  return light;
}

}  // namespace

class ProbedBounds::Probes {
 public:
  Probes(const Rig& rig, const LightBounds& bounds) : rig_(rig) {
    if (bounds.samples_.cover < 0)
      fillBox();
    else
      cover();
    const bool smooth = bounds.plan_.polynomial && rig.spec().family != RigSpec::Family::rbf;
    between_ = smooth && bounds.samples_.cover >= 0 ? 1.25 : 1.5;
    stride_ = rowkernels::padded(patches_.size());
    for (std::vector<float>* row : {&x_, &y_, &z_}) row->resize(stride_, row->back());
    worldX_ = worldY_ = worldZ_ = x_;
    readBasis();
    if (rig.spec().falloff) readFalloff();
    const auto vectors = static_cast<std::size_t>(rig.shVectors());
    functionals_.resize(static_cast<std::size_t>(rig.projections()));
    coefficients_.resize(vectors);
    fitted_.resize(kCoefficients * vectors);
    sums_.resize(3 * kCoefficients * stride_);
    values_.resize(kCoefficients * stride_);
    down_.resize(stride_);
    up_.resize(stride_);
    seen_.resize(patches_.size());
    light_.reserve(1);
    prepared_.reserve(1);
  }

  void place(const RigFrame& worldFromRig) noexcept {
    frame_ = worldFromRig;
    for (std::size_t i = 0; i < stride_; ++i) {
      const Vec3 p = worldFromRig.point({x_[i], y_[i], z_[i]});
      worldX_[i] = p.x;
      worldY_[i] = p.y;
      worldZ_[i] = p.z;
    }
  }

  template <class Light>
  SeenLight see(const Light& light, const LightBounds& bounds) noexcept {
    light_.clear();
    light_.add(white(light));
    prepared_.set(light_);
    projectSamples<kBands>(rig_, frame_, prepared_, prepared_.all(), functionals_);
    SeenLight seen{.points = seen_, .between = between_, .spacing = spacing_};
    const Triple at = placeOf(bounds.plan_, frame_, light.position).position;
    if constexpr (std::is_same_v<Light, DiskLight>) expectFace(light, at, bounds, seen);
    fitRig<kBands>(rig_, functionals_, coefficients_);
    evaluate();
    rangeOverNormals(bounds.wrap_);
    for (std::size_t j = 0; j < seen_.size(); ++j) seen_[j] = {0, spread(down_, j), spread(up_, j), 0, 0};
    projectBatch<kBands>(prepared_, prepared_.all(), {worldX_, worldY_, worldZ_}, {}, sums_);
    for (std::size_t i = 0; i < kCoefficients; ++i)
      for (std::size_t j = 0; j < stride_; ++j) values_[i * stride_ + j] -= sums_[(3 * i + 1) * stride_ + j];
    rangeOverNormals(bounds.wrap_);
    for (std::size_t j = 0; j < stride_; ++j) up_[j] = std::max(up_[j], down_[j]);
    for (std::size_t j = 0; j < seen_.size(); ++j) seen_[j].error = spread(up_, j);
    if constexpr (std::is_same_v<Light, DiskLight>) {
      lookAt(light, at, bounds.wrap_, seen);
    } else {
      double radius = light.radius;
      if constexpr (!std::is_same_v<Light, SphereLight>) radius = std::max<double>(radius, kMinPointRadius);
      approach(at, seen, [&](const Triple& way, SeenPoint&) { return std::sqrt(squareOf(way)) - radius; });
    }
    return seen;
  }

 private:
  void add(Vec3 p, const ProbePatch& patch) {
    x_.push_back(p.x);
    y_.push_back(p.y);
    z_.push_back(p.z);
    patches_.push_back(patch);
  }

  void fillBox() {
    const RigBox& box = rig_.box();
    const Vec3 step = (box.hi - box.lo) * (1.0f / (kGrid - 1));
    // The ellipsoid that holds a cell.
    Eigen::Vector3d squares;
    for (int a = 0; a < 3; ++a) squares[a] = 0.75 * static_cast<double>(step[a]) * static_cast<double>(step[a]);
    squares.array() += kLeastSize;
    const ProbePatch cell(squares.asDiagonal());
    spacing_ = 0.5 * static_cast<double>(length(step));
    for (int i = 0; i < kGrid * kGrid * kGrid; ++i) {
      const int x = i % kGrid, y = i / kGrid % kGrid, z = i / (kGrid * kGrid);
      add(box.lo + Vec3{static_cast<float>(x) * step.x, static_cast<float>(y) * step.y, static_cast<float>(z) * step.z},
          cell);
    }
  }

  void cover() {
    const SurfaceProbes& from = rig_.model_->probes;
    const RigBox& box = rig_.box();
    const std::span<const RigSample> samples = rig_.samples();
    const BoxCoordinates coordinates(box);
    const Eigen::DiagonalMatrix<double, 3> half(coordinates.half.x, coordinates.half.y, coordinates.half.z);
    spacing_ = static_cast<double>(from.fineCover * from.stretch(box));
    const double least = 1e-3 * spacing_;
    const auto posed = [&](const ProbePatch& patch) {
      Eigen::Matrix3d shape = half * patch.shape() * half;
      shape.diagonal().array() += least * least + kLeastSize;
      return ProbePatch(shape);
    };
    for (std::size_t i = 0; i < from.patches.size(); ++i) {
      const bool sample = i < samples.size();
      const SurfaceProbes::Probe* probe = sample ? nullptr : &from.probes[i - samples.size()];
      add(sample ? samples[i].position : from.posed(*probe, samples[probe->anchor].position, box),
          posed(from.patches[i]));
    }
  }

  void readBasis() {
    basis_.resize(static_cast<std::size_t>(rig_.shVectors()) * stride_);
    RigBasis at;
    for (std::size_t i = 0; i < stride_; ++i) {
      rig_.basis({x_[i], y_[i], z_[i]}, at);
      for (int j = 0; j < at.count; ++j) basis_[static_cast<std::size_t>(at.index[j]) * stride_ + i] = at.value[j];
    }
  }

  /// invquad: q times values and errors varies as those of other rigs do; q itself is known all over a patch.
  void readFalloff() {
    const auto& [xx, yy, zz, xy, xz, yz, x, y, z, one] =
        static_cast<const Rig::PolyModel&>(*rig_.model_).falloff().coefficients();
    Eigen::Matrix3d curvature;
    curvature << 2 * xx, xy, xz, xy, 2 * yy, yz, xz, yz, 2 * zz;
    curvature /= 2;
    const Eigen::Vector3d slope(x, y, z);
    const double floor = static_cast<const Rig::PolyModel&>(*rig_.model_).falloff().least();
    const double concave = std::max(
        0.0, -Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(curvature, Eigen::EigenvaluesOnly).eigenvalues()(0));
    const Eigen::Matrix3d convex = curvature + concave * Eigen::Matrix3d::Identity();
    const SurfaceProbes& from = rig_.model_->probes;
    const BoxCoordinates coordinates(rig_.box());
    const std::size_t count = patches_.size();
    std::vector<double> q(count);
    std::vector<Eigen::Vector3d> u(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 at = coordinates({x_[i], y_[i], z_[i]});
      u[i] = {at.x, at.y, at.z};
      q[i] = std::max<double>(floor, static_cast<double>(one) + slope.dot(u[i]) + u[i].dot(curvature * u[i]));
    }
    for (std::size_t i = 0; i < count; ++i) {
      const double radius = from.patches[i].radius();
      // The concave part by its tangent, which is never below it by more than its own size on the patch.
      const double least = std::max(
          floor, from.patches[i].least(q[i], slope + 2 * (curvature * u[i]), convex) - concave * radius * radius);
      first_.push_back(neighbours_.size());
      double lowest = q[i];
      for (std::size_t k = 0; k < count; ++k) {
        const double dx = x_[i] - x_[k], dy = y_[i] - y_[k], dz = z_[i] - z_[k];
        const double share = std::clamp(2 - std::sqrt(dx * dx + dy * dy + dz * dz) / spacing_, 0.0, 1.0);
        if (!(share > 0)) continue;
        lowest = std::min(lowest, q[k] / share);
        neighbours_.push_back({k, static_cast<float>(share)});
      }
      for (std::size_t n = first_.back(); n < neighbours_.size(); ++n)
        neighbours_[n].factor *= static_cast<float>(std::max(1.0, std::sqrt(lowest * q[neighbours_[n].point]) / least));
    }
    first_.push_back(neighbours_.size());
  }

  void evaluate() noexcept {
    const std::size_t vectors = coefficients_.size();
    for (std::size_t k = 0; k < vectors; ++k)
      for (std::size_t i = 0; i < kCoefficients; ++i)
        fitted_[i * vectors + k] = coefficients_[k][static_cast<int>(i)].g;
    rowkernels::multiply(fitted_.data(), kCoefficients, vectors, basis_.data(), stride_, values_.data());
  }

  /// Of the irradiance of `values_`, over normals: between -down_ and up_, or less. With v the vector of band 1 and Q
  /// the form of band 2, e0 + |v| x + (v^T Q v / v^2) P2(x) in x = n.v/|v|, and no more than its norm of the rest of Q.
  void rangeOverNormals(const WrapField& wrap) noexcept {
    const auto s0 = static_cast<float>(wrap.s0 * std::sqrt(kPi));
    const auto s1 = static_cast<float>(wrap.s1 * std::sqrt(kPi / 3));
    const auto s2 = static_cast<float>(wrap.s2 * std::sqrt(kPi / 5));
    const auto root3 = static_cast<float>(std::sqrt(3.0));
    const auto row = [&](std::size_t i) { return &values_[i * stride_]; };
    const float *e = row(0), *vy = row(1), *vz = row(2), *vx = row(3);
    const float *xy = row(4), *yz = row(5), *zz = row(6), *xz = row(7), *xx = row(8);
    float sum = 0;
    for (std::size_t j = 0; j < stride_; ++j) {
      const float square = vx[j] * vx[j] + vy[j] * vy[j] + vz[j] * vz[j];
      const float inverse = 1 / std::max(square, std::numeric_limits<float>::min());
      const float x2 = vx[j] * vx[j] * inverse, y2 = vy[j] * vy[j] * inverse, z2 = vz[j] * vz[j] * inverse;
      const float norm2 = s2 * s2 * (xy[j] * xy[j] + yz[j] * yz[j] + zz[j] * zz[j] + xz[j] * xz[j] + xx[j] * xx[j]);
      const float mixed = (xy[j] * vx[j] * vy[j] + yz[j] * vy[j] * vz[j] + xz[j] * vx[j] * vz[j]) * inverse;
      const float p = s2 * (zz[j] * (z2 - 0.5f * (x2 + y2)) + root3 * (mixed + 0.5f * xx[j] * (x2 - y2)));
      const float rest = std::sqrt(std::max(0.0f, norm2 - p * p));
      const float norm = std::sqrt(norm2);
      const float one = s0 * e[j], v = std::abs(s1) * std::sqrt(square);
      // Extremes of v x + p P2(x): at x = +-1, and at -v/(3p) where that is within.
      const float vertex = -0.5f * p - (v < 3 * std::abs(p) ? v * v / (6 * p) : 0.0f);
      const bool inside = v < 3 * std::abs(p);
      const float most = std::max(v + p, inside ? vertex : v + p);
      const float least = std::min(p - v, inside ? vertex : p - v);
      up_[j] = std::max(0.0f, one + std::min(most + rest, v + norm));
      down_[j] = std::max(0.0f, std::min(rest - least, v + norm) - one);
      sum += up_[j] + down_[j];
    }
    if (std::isfinite(sum)) return;
    // Of numbers that are too large nothing is known.
    std::ranges::fill(up_, std::numeric_limits<float>::infinity());
    std::ranges::fill(down_, std::numeric_limits<float>::infinity());
  }

  /// What a row of sizes at the points says about all of a point's patch.
  float spread(std::span<const float> sizes, std::size_t j) const noexcept {
    if (first_.empty()) return sizes[j];
    float most = 0;
    for (std::size_t n = first_[j]; n < first_[j + 1]; ++n)
      most = std::max(most, neighbours_[n].factor * sizes[neighbours_[n].point]);
    return most;
  }

  /// Distance to the patches, or less; `farAway`: what is good enough some spacings away.
  double nearest(const Triple& at, double farAway) const noexcept {
    constexpr double kFar = 4;
    const double share = std::clamp(farAway / spacing_ - (kFar - 1), 0.0, 1.0);
    if (!(share < 1)) return farAway;
    double near = kInfinite;
    for (std::size_t j = 0; j < patches_.size(); ++j) {
      const Eigen::Vector3d way(static_cast<double>(x_[j]) - at[0], static_cast<double>(y_[j]) - at[1],
                                static_cast<double>(z_[j]) - at[2]);
      if (patches_[j].distanceAlong(way) < near) near = std::min(near, patches_[j].distance(way));
    }
    return near + share * (std::min(near, farAway) - near);
  }

  /// `gap(way, point)`: from the light's surface to the point, `way` from its centre.
  template <class Gap>
  void approach(const Triple& at, SeenLight& seen, Gap gap) noexcept {
    double farAway = kInfinite;
    for (std::size_t j = 0; j < seen_.size(); ++j) {
      const Triple way{static_cast<double>(x_[j]) - at[0], static_cast<double>(y_[j]) - at[1],
                       static_cast<double>(z_[j]) - at[2]};
      farAway = std::min(farAway, patches_[j].distanceAlong({way[0], way[1], way[2]}));
      const double apart = gap(way, seen_[j]);
      seen_[j].close = static_cast<float>(apart > spacing_ ? spacing_ / apart : 1.0);
    }
    seen.near = nearest(at, farAway);
  }

  static Face faceOf(const DiskLight& light, const RigFrame& frame) noexcept {
    Triple direction{};
    unitOf(light.direction, direction);
    return {inRigFrame(frame, direction)};
  }

  void lookAt(const DiskLight& light, const Triple& at, const WrapField& wrap, SeenLight& seen) noexcept {
    const Face face = faceOf(light, frame_);
    const double radius = light.radius;
    const DiskField field(wrap, radius, light.twoSided);
    approach(at, seen, [&](const Triple& way, SeenPoint& point) {
      const double bend = spacing_ - std::abs(face.height(way));
      if (bend > 0) {
        // <1 / distance^3> over the disk, from its plane.
        const double near = std::max(0.0, std::sqrt(squareOf(way)) - spacing_);
        const double clear = std::max(0.0, near * near - radius * radius);
        point.crease = static_cast<float>(bend / 2 * field.kink() / (clear * std::sqrt(clear)));
      }
      return face.gap(way, radius);
    });
  }

  /// A sample's light leaps as the disk's face passes it, and is left out before.
  void expectFace(const DiskLight& light, const Triple& at, const LightBounds& bounds, SeenLight& seen) noexcept {
    constexpr double kBefore = 0.02;
    const Face face = faceOf(light, frame_);
    const double radius = light.radius;
    const DiskField field(bounds.wrap_, radius, light.twoSided);
    for (std::size_t i = 0; i < functionals_.size(); ++i) {
      const RigSample& sample = rig_.samples()[i];
      const Vec3 p = sample.position;
      const Triple way{static_cast<double>(p.x) - at[0], static_cast<double>(p.y) - at[1],
                       static_cast<double>(p.z) - at[2]};
      // Samples take it to be as large as their footprint, at equal power.
      const double size = std::max<double>(radius, sample.footprint);
      const double share = 1 - face.gap(way, size) / (kBefore * size);
      if (!(share > 0)) continue;
      functionals_[i] = functionals_[i] * static_cast<float>(1 - share);
      seen.missing += share * static_cast<double>(bounds.samples_.sample[i].weight) * field.perVector() * kPi *
                      (radius / size) * (radius / size);
    }
  }

  static constexpr double kLeastSize = 1e-30;  // m2

  struct Neighbour {
    std::size_t point;
    float factor;
  };

  const Rig& rig_;
  RigFrame frame_;
  std::size_t stride_ = 0;        // of rows; what is beyond the points repeats the last
  std::vector<float> x_, y_, z_;  // rig frame
  std::vector<float> worldX_, worldY_, worldZ_;
  std::vector<ProbePatch> patches_;
  double between_ = 1;
  double spacing_ = 0;              // nothing served is farther from all points
  std::vector<float> basis_;        // shVectors rows
  std::vector<std::size_t> first_;  // of each point's neighbours; invquad alone
  std::vector<Neighbour> neighbours_;
  LightSet light_;
  PreparedLights prepared_;
  std::vector<RadianceSH<kBands>> functionals_, coefficients_;
  std::vector<float> fitted_;         // kCoefficients x shVectors
  std::vector<float> sums_, values_;  // rows: 3 kCoefficients, kCoefficients
  std::vector<float> down_, up_;
  std::vector<SeenPoint> seen_;
};

ProbedBounds::ProbedBounds(const Rig& rig, const RigFrame& worldFromRig, float wrap, float radius)
    : bounds_(rig, worldFromRig, wrap, radius) {
  const bool known = bounds_.samples_.cover < 0 || !rig.model_->probes.patches.empty();
  if (known && bounds_.plan_.kind == detail::BoundPlan::Kind::samples) probes_ = std::make_unique<Probes>(rig, bounds_);
  place(worldFromRig);
}

ProbedBounds::ProbedBounds(ProbedBounds&&) noexcept = default;
ProbedBounds& ProbedBounds::operator=(ProbedBounds&&) noexcept = default;
ProbedBounds::~ProbedBounds() = default;

void ProbedBounds::place(const RigFrame& worldFromRig) noexcept {
  bounds_.place(worldFromRig);
  if (probes_) probes_->place(worldFromRig);
}

template <class Light>
LightBound ProbedBounds::of(const Light& light) noexcept {
  if (!probes_) return bounds_(light);
  const SeenLight seen = probes_->see(light, bounds_);
  return bounds_.of(light, &seen);
}

LightBound ProbedBounds::operator()(const PointLight& light) noexcept { return of(light); }
LightBound ProbedBounds::operator()(const SpotLight& light) noexcept { return of(light); }
LightBound ProbedBounds::operator()(const SphereLight& light) noexcept { return of(light); }
LightBound ProbedBounds::operator()(const DiskLight& light) noexcept { return of(light); }

}  // namespace rigel
