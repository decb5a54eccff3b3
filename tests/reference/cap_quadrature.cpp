#include "reference/cap_quadrature.h"

#include <boost/math/quadrature/gauss.hpp>

namespace rigel::reference {
namespace {

constexpr int kCosineNodes = 20;
constexpr int kAzimuthNodes = 64;

/// Any two unit vectors that make an orthonormal frame with `axis`.
std::array<Direction, 2> frameAbout(const Direction& axis) {
  const Direction helper = std::abs(axis.z) < 0.5 ? Direction{0, 0, 1} : Direction{1, 0, 0};
  Direction u{axis.y * helper.z - axis.z * helper.y, axis.z * helper.x - axis.x * helper.z,
              axis.x * helper.y - axis.y * helper.x};
  const double norm = std::sqrt(u.x * u.x + u.y * u.y + u.z * u.z);
  u = {u.x / norm, u.y / norm, u.z / norm};
  return {u, {axis.y * u.z - axis.z * u.y, axis.z * u.x - axis.x * u.z, axis.x * u.y - axis.y * u.x}};
}

}  // namespace

std::vector<CapNode> capNodes(const Direction& axis, double alpha) {
  using Gauss = boost::math::quadrature::gauss<double, kCosineNodes>;
  const auto [u, v] = frameAbout(axis);
  std::vector<CapNode> nodes;
  const double half = std::pow(std::sin(alpha / 2), 2);  // half the range of the cosine, (1 - cos alpha)/2
  for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i) {
    for (const double sign : {-1.0, 1.0}) {
      const double cosine = 1 - half + sign * half * Gauss::abscissa()[i];
      const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
      for (int j = 0; j < kAzimuthNodes; ++j) {
        const double phi = 2 * M_PI * j / kAzimuthNodes;
        const double a = sine * std::cos(phi);
        const double b = sine * std::sin(phi);
        nodes.push_back({{axis.x * cosine + u.x * a + v.x * b, axis.y * cosine + u.y * a + v.y * b,
                          axis.z * cosine + u.z * a + v.z * b},
                         half * Gauss::weights()[i] * 2 * M_PI / kAzimuthNodes});
      }
    }
  }
  return nodes;
}

}  // namespace rigel::reference
