// SH of disk lights in double: the integrals of shader_disk.h by tanh-sinh quadrature (H. Takahasi, M. Mori, "Double
// exponential formulas for numerical integration", 1974), whose nodes crowd at both ends of the quarter of the rim. The
// integrand's only singularities lie beyond psi = pi/2, at a distance that vanishes on the rim.
#include <rigel/disk.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "disk_bands.h"

namespace rigel {
namespace {

constexpr int kPairs = 128;     // and the node in the middle
constexpr double kReach = 3.3;  // of the parameter; there the weight is 1e-17
constexpr double kStep = kReach / kPairs;

struct NodePair {
  double weight;  // of each of the two, sum over all nodes 1
  double u, v;    // cos^2, sin^2 of the lower one's psi
};

std::array<NodePair, kPairs + 1> makeNodes() noexcept {
  std::array<NodePair, kPairs + 1> nodes;
  double sum = 0;
  for (int k = 0; k <= kPairs; ++k) {
    const double t = k * kStep;
    const double s = 0.5 * kPi * std::sinh(t);
    // psi = pi/4 (1 - tanh s)
    const double psi = 0.5 * kPi / (1 + std::exp(2 * s));
    const double sine = std::sin(psi);
    const double weight = std::cosh(t) / (std::cosh(s) * std::cosh(s)) * (k == 0 ? 0.5 : 1.0);
    nodes[k] = {weight, 1 - sine * sine, sine * sine};
    sum += 2 * weight;
  }
  for (NodePair& node : nodes) node.weight /= sum;
  return nodes;
}

}  // namespace

detail::DiskMoments<double> detail::exactDiskMoments(const DiskCone<double>& cone) noexcept {
  static const auto kNodes = makeNodes();
  DiskSums<double> sums = diskSums(0.0);
  // The lightest first.
  for (int k = kPairs; k >= 0; --k) {
    const NodePair& at = kNodes[k];
    addDiskNodes<kMaxBands>(sums, diskNode(cone, at.weight, at.u), diskNode(cone, at.weight, at.v));
  }
  return diskMomentsOf<kMaxBands>(sums, cone);
}

void projectDiskExact(const DiskLight& light, Vec3 p, int bands, std::span<double> sh) noexcept {
  std::fill(sh.begin(), sh.end(), 0.0);
  const detail::LocalDisk disk = detail::localDisk(light, p);
  if (!disk.lit) return;
  const auto view = detail::viewOf<double>(disk);
  double q[shCount(kMaxBands)];
  detail::diskBands<kMaxBands>(detail::exactDiskMoments(view.cone), view, q);
  for (int channel = 0; channel < 3; ++channel) {
    const double scale = disk.powerScale * view.flux * light.radiance[channel];
    for (int i = 0; i < shCount(bands); ++i) sh[3 * i + channel] = scale * q[i];
  }
}

}  // namespace rigel
