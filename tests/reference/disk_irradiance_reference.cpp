#include "reference/disk_irradiance_reference.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "reference/smoothed_quadrature.h"
#include "reference/wrap_reference.h"

namespace rigel::reference {
namespace {

/// The receiver in units of the radius: its height above the face, its distance from the axis, and its normal with x
/// towards the axis and z towards the disk's plane.
struct Pose {
  double z = 0, rho = 0;
  double nx = 0, ny = 0, nz = 0;
};

/// int f sin(theta) dtheta from `lo` to `hi`, theta the angle from the foot point, in the half plane at `phi`.
double meridian(const Pose& pose, double phi, double lo, double hi, double a) {
  const double across = pose.nx * std::cos(phi) + pose.ny * std::sin(phi);
  const double swing = std::hypot(across, pose.nz);
  const double mid = std::atan2(across, pose.nz);
  const auto ring = [&](double theta) {
    return std::sin(theta) * wrapKernelReference(swing * std::cos(theta - mid), a);
  };
  // Cut where x = -a.
  std::vector<double> cut = {lo, hi};
  if (swing > std::abs(a)) {
    const double reach = std::acos(-a / swing);
    for (const double angle : {mid - reach, mid + reach, mid + reach - 2 * M_PI, mid - reach + 2 * M_PI})
      if (angle > lo && angle < hi) cut.push_back(angle);
  }
  std::sort(cut.begin(), cut.end());
  double sum = 0;
  for (std::size_t i = 0; i + 1 < cut.size(); ++i) {
    if (ring(0.5 * (cut[i] + cut[i + 1])) != 0) sum += integrateSmoothed(ring, cut[i], cut[i + 1]);
  }
  return sum;
}

/// The range of theta of the disk at `phi`; empty where lo >= hi.
void extent(const Pose& pose, double phi, double& lo, double& hi) {
  const double sine = pose.rho * std::sin(phi);
  const double half = std::sqrt(std::max(0.0, (1 - sine) * (1 + sine)));
  const double mid = pose.rho * std::cos(phi);
  // mid - half = (rho^2 - 1) / (mid + half).
  const double nearest = pose.rho > 1 ? (pose.rho - 1) * (pose.rho + 1) / (mid + half) : 0;
  const double farthest = pose.rho > 1 ? mid + half
                          : mid > 0    ? mid + half
                                       : (1 - pose.rho) * (1 + pose.rho) / (half - mid);
  lo = std::atan2(nearest, pose.z);
  hi = std::atan2(farthest, pose.z);
}

}  // namespace

double diskIrradianceReference(const DiskLight& light, Vec3 p, Vec3 n, double a) {
  const double axisLength = std::hypot<double>(light.direction.x, light.direction.y, light.direction.z);
  const double normalLength = std::hypot<double>(n.x, n.y, n.z);
  double axis[3], normal[3], offset[3];
  double z = 0;
  for (int i = 0; i < 3; ++i) {
    axis[i] = static_cast<double>(light.direction[i]) / axisLength;
    normal[i] = static_cast<double>(n[i]) / normalLength;
    offset[i] =
        (static_cast<double>(p[i]) - static_cast<double>(light.position[i])) / static_cast<double>(light.radius);
    z += axis[i] * offset[i];
  }
  if (!(light.twoSided ? z != 0 : z > 0)) return 0;
  double across[3];
  double rho2 = 0;
  for (int i = 0; i < 3; ++i) {
    across[i] = offset[i] - axis[i] * z;
    rho2 += across[i] * across[i];
    if (z < 0) axis[i] = -axis[i];
  }
  Pose pose;
  pose.z = std::abs(z);
  pose.rho = std::sqrt(rho2);
  double along = 0;
  double inward = 0;
  for (int i = 0; i < 3; ++i) {
    along += normal[i] * axis[i];
    inward -= pose.rho > 0 ? normal[i] * across[i] / pose.rho : 0;
  }
  pose.nz = -along;
  if (pose.rho > 1e-15) {
    pose.nx = inward;
    pose.ny = std::sqrt(std::max(0.0, 1 - along * along - inward * inward));
  } else {
    pose.rho = 0;
    pose.nx = std::sqrt(std::max(0.0, 1 - along * along));
  }

  const double end = pose.rho > 1 ? std::asin(1 / pose.rho) : M_PI;
  const auto spoke = [&](double phi) {
    double lo = 0, hi = 0;
    extent(pose, phi, lo, hi);
    return hi > lo ? meridian(pose, phi, lo, hi, a) : 0.0;
  };
  // Bisected until halves and whole agree: the horizon makes kinks anywhere.
  const auto refine = [&](const auto& self, double lo, double hi, double whole, int depth) -> double {
    const double mid = 0.5 * (lo + hi);
    const double left = integrateSmoothed(spoke, lo, mid);
    const double right = integrateSmoothed(spoke, mid, hi);
    const double scale = pose.z / std::max(1.0, std::pow(pose.rho * pose.rho + pose.z * pose.z, 1.5));
    if (depth == 0 || std::abs(left + right - whole) <= 1e-10 * std::min(1.0, scale)) return left + right;
    return self(self, lo, mid, left, depth - 1) + self(self, mid, hi, right, depth - 1);
  };
  double sum = 0;
  for (int i = -2; i < 2; ++i) {
    const double lo = 0.5 * i * end;
    const double hi = 0.5 * (i + 1) * end;
    sum += refine(refine, lo, hi, integrateSmoothed(spoke, lo, hi), 12);
  }
  return sum;
}

double diskIrradianceByRays(const DiskLight& light, Vec3 p, Vec3 n, double a, int count) {
  const double radius = light.radius;
  double axis[3], normal[3], side[3], up[3];
  const double axisLength = std::hypot<double>(light.direction.x, light.direction.y, light.direction.z);
  const double normalLength = std::hypot<double>(n.x, n.y, n.z);
  for (int i = 0; i < 3; ++i) {
    axis[i] = static_cast<double>(light.direction[i]) / axisLength;
    normal[i] = static_cast<double>(n[i]) / normalLength;
  }
  const int least = std::abs(axis[0]) < 0.5 ? 0 : 1;
  double sideLength = 0;
  for (int i = 0; i < 3; ++i) {
    side[i] = (i == least ? 1 : 0) - axis[least] * axis[i];
    sideLength += side[i] * side[i];
  }
  for (int i = 0; i < 3; ++i) side[i] /= std::sqrt(sideLength);
  for (int i = 0; i < 3; ++i) up[i] = axis[(i + 1) % 3] * side[(i + 2) % 3] - axis[(i + 2) % 3] * side[(i + 1) % 3];

  double sum = 0;
  for (int k = 0; k < count; ++k) {
    double radical = 0;
    double digit = 0.5;
    for (int bits = k; bits > 0; bits /= 2, digit /= 2) radical += digit * (bits % 2);
    const double r = radius * std::sqrt((k + 0.5) / count);
    const double cosine = r * std::cos(2 * M_PI * radical);
    const double sine = r * std::sin(2 * M_PI * radical);
    double d2 = 0, atLight = 0, atReceiver = 0;
    for (int i = 0; i < 3; ++i) {
      const double v = static_cast<double>(light.position[i]) - p[i] + cosine * side[i] + sine * up[i];
      d2 += v * v;
      atLight -= v * axis[i];
      atReceiver += v * normal[i];
    }
    const double d = std::sqrt(d2);
    const double emitted = light.twoSided ? std::abs(atLight) : std::max(0.0, atLight);
    sum += wrapKernelReference(atReceiver / d, a) * emitted / (d * d2);
  }
  return sum * M_PI * radius * radius / count;
}

}  // namespace rigel::reference
