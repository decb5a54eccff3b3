#include "simulated_lights.h"

#include <rigel/wrap.h>

#include <algorithm>
#include <cmath>

namespace rigel {
namespace {

constexpr std::size_t kMostPoints = 128;
constexpr std::array kDistances{0.06f, 0.15f, 0.4f, 1.0f, 3.0f};  // in largest extents of the box
constexpr int kLightsPerDistance = 8;
constexpr float kRadius = 0.2f;  // of a light, in its distance

/// Three coordinates in [0, 1) that fill the cube evenly (M. Roberts, "The unreasonable effectiveness of quasirandom
/// sequences", 2018).
std::array<double, 3> quasiRandom(int i) noexcept {
  constexpr std::array kStep{0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
  std::array<double, 3> u{};
  for (int a = 0; a < 3; ++a) {
    const double x = 0.5 + (i + 1) * kStep[a];
    u[a] = x - std::floor(x);
  }
  return u;
}

Vec3 directionOf(double u, double v) noexcept {
  const double z = 2 * u - 1;
  const double across = std::sqrt(std::max(0.0, 1 - z * z));
  return {static_cast<float>(across * std::cos(2 * kPi * v)), static_cast<float>(across * std::sin(2 * kPi * v)),
          static_cast<float>(z)};
}

/// Away from `from` along `direction` until no point is nearer than `distance`.
Vec3 standOff(std::span<const Vec3> points, Vec3 from, Vec3 direction, float distance) noexcept {
  constexpr int kSteps = 16;
  Vec3 at = from + direction * distance;
  for (int step = 0; step < kSteps; ++step) {
    float nearest = distance;
    for (Vec3 p : points) nearest = std::min(nearest, length(p - at));
    at += direction * (distance - nearest);
  }
  return at;
}

/// What each SH coefficient adds to mean-square irradiance over normals, up to a factor.
std::array<float, 9> energies() noexcept {
  const std::array<float, 3> f = wrapCoefficients<3>(0);
  std::array<float, 9> out{};
  for (int l = 0; l < 3; ++l)
    for (int i = shCount(l); i < shCount(l + 1); ++i) out[i] = f[l] * f[l];
  return out;
}

}  // namespace

SimulatedLights::Row SimulatedLights::project(const SphereLight& light, Vec3 p, float footprint) {
  const RadianceSH<kBands> sh = rigel::project<kBands>(light, p, footprint);
  Row row;
  for (int i = 0; i < kWidth; ++i) row[i] = sh[i].r;
  return row;
}

SimulatedLights::SimulatedLights(const RigShape& rest) {
  const std::size_t step = (rest.surface.size() + kMostPoints - 1) / kMostPoints;
  for (std::size_t i = 0; i < rest.surface.size(); i += step) points_.push_back(rest.surface[i]);
  const Vec3 extent = rest.box.hi - rest.box.lo;
  const float size = std::max({extent.x, extent.y, extent.z});
  const Vec3 centre = rest.box.lo * 0.5f + rest.box.hi * 0.5f;
  for (const float distance : kDistances) {
    for (int i = 0; i < kLightsPerDistance; ++i) {
      const auto [u, v, w] = quasiRandom(static_cast<int>(lights_.size()));
      const Vec3 from = points_[static_cast<std::size_t>(u * static_cast<double>(points_.size()))];
      Vec3 direction = directionOf(v, w);
      if (dot(direction, from - centre) < 0) direction = -direction;
      Light& added = lights_.emplace_back();
      added.light = {standOff(points_, from, direction, distance * size), kRadius * distance * size, {1, 1, 1}};
      for (Vec3 p : points_) {
        added.truth.push_back(project(added.light, p, 0));
        added.mean += added.truth.back()[0] / static_cast<float>(points_.size());
      }
    }
  }
}

double SimulatedLights::error(Rig::Model& model) const {
  static const std::array<float, 9> kEnergies = energies();
  std::vector<float> first(model.samples.size());  // L_00, all that a falloff looks at
  std::vector<Row> functionals(model.samples.size());
  std::vector<Row> coefficients(static_cast<std::size_t>(model.op.rows()));
  RigBasis phi;
  double logarithms = 0;
  for (const Light& light : lights_) {
    for (std::size_t s = 0; s < functionals.size(); ++s) {
      functionals[s] = project(light.light, model.samples[s].position, model.samples[s].footprint);
      first[s] = functionals[s][0];
    }
    model.adapt(first, 1);
    model.op.apply({functionals.front().data(), functionals.size() * kWidth}, kWidth,
                   {coefficients.front().data(), coefficients.size() * kWidth});
    double square = 0;
    for (std::size_t p = 0; p < points_.size(); ++p) {
      model.basis(points_[p], phi);
      Row wrong = light.truth[p];
      for (int j = 0; j < phi.count; ++j)
        for (int i = 0; i < kWidth; ++i) wrong[i] -= phi.value[j] * coefficients[phi.index[j]][i];
      for (int i = 0; i < kWidth; ++i) square += static_cast<double>(kEnergies[i] * wrong[i] * wrong[i]);
    }
    // A shape that every rig serves exactly has no error to compare.
    constexpr double kLeast = 1e-6;
    const double rms = std::sqrt(square / static_cast<double>(points_.size()));
    logarithms += std::log(std::max(kLeast, rms / static_cast<double>(light.mean)));
  }
  return std::exp(logarithms / static_cast<double>(lights_.size()));
}

}  // namespace rigel
