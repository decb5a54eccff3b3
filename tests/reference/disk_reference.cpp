#include "reference/disk_reference.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

namespace rigel::reference {
namespace {

using Coefficients = std::vector<double>;

Point operator+(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point operator*(const Point& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Point& a) { return std::sqrt(dot(a, a)); }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// sum[i] += weight Y_i(w), by the recursions of P_l^m without the sign of Condon and Shortley.
void addBasis(const Point& w, double weight, int bands, Coefficients& sum) {
  double re = 1, im = 0;  // sin^m(theta) e^(i m phi)
  double diagonal = 1;    // (2m-1)!!
  for (int m = 0; m < bands; ++m) {
    double previous = 0, current = diagonal;
    for (int l = m; l < bands; ++l) {
      double factorials = 1;  // (l+m)!/(l-m)!
      for (int k = l - m + 1; k <= l + m; ++k) factorials *= k;
      const double norm = weight * std::sqrt((2 * l + 1) * (m == 0 ? 1.0 : 2.0) / (4 * M_PI * factorials)) * current;
      sum[l * (l + 1) + m] += norm * re;
      if (m > 0) sum[l * (l + 1) - m] += norm * im;
      const double next = ((2 * l + 1) * w[2] * current - (l + m) * previous) / (l + 1 - m);
      previous = current;
      current = next;
    }
    diagonal *= 2 * m + 1;
    const double nextRe = re * w[0] - im * w[1];
    im = re * w[1] + im * w[0];
    re = nextRe;
  }
}

/// The disk from where `p` is: in the frame of its axis, at height z, with its centre at distance rho along `across`.
struct Pose {
  Point down, across, side;
  double z = 0, rho = 0, radius = 0;
};

Pose poseOf(const DiskLight& light, const Point& p) {
  Pose pose;
  const Point n = pointOf(light.direction) * (1 / length(pointOf(light.direction)));
  const Point toCentre = pointOf(light.position) - p;
  const double height = -dot(toCentre, n);
  pose.radius = light.radius;
  pose.z = light.twoSided ? std::abs(height) : height;
  pose.down = n * (height > 0 ? -1.0 : 1.0);
  const Point radial = toCentre + n * height;
  pose.rho = length(radial);
  const Point helper = std::abs(n[0]) < 0.5 ? Point{1, 0, 0} : Point{0, 1, 0};
  const Point direction = pose.rho > 0 ? radial : cross(n, helper);
  pose.across = direction * (1 / length(direction));
  pose.side = cross(pose.down, pose.across);
  return pose;
}

/// All directions of azimuth phi that meet the plane between distances near and near + width from the foot.
void addMeridian(const Pose& pose, double phi, double near, double width, double weight, int bands, Coefficients& sum) {
  using Gauss = boost::math::quadrature::gauss<double, 16>;
  const Point outward = pose.across * std::cos(phi) + pose.side * std::sin(phi);
  const double from = std::atan2(near, pose.z);
  const double half = 0.5 * std::atan2(pose.z * width, pose.z * pose.z + near * (near + width));
  for (std::size_t k = 0; k < Gauss::abscissa().size(); ++k) {
    for (const double sign : {-1.0, 1.0}) {
      const double theta = from + half * (1 + sign * Gauss::abscissa()[k]);
      const Point w = outward * std::sin(theta) + pose.down * std::cos(theta);
      addBasis(w, weight * Gauss::weights()[k] * half * std::sin(theta), bands, sum);
    }
  }
}

/// The meridian at tau in [-pi/2, pi/2], which runs over all azimuths under which the disk is seen.
void addMeridianOf(const Pose& pose, double tau, double weight, int bands, Coefficients& sum) {
  const double r = pose.radius, rho = pose.rho;
  const double gap2 = (rho - r) * (rho + r);
  if (rho < r) {
    const double phi = 2 * tau;
    const double root = std::sqrt(r * r * std::cos(phi) * std::cos(phi) - gap2 * std::sin(phi) * std::sin(phi));
    const double along = rho * std::cos(phi);
    const double far = along > 0 ? along + root : -gap2 / (root - along);
    addMeridian(pose, phi, 0, far, 2 * weight, bands, sum);
  } else {
    const double sine = r / rho * std::sin(tau);
    const double cosine = std::sqrt(std::cos(tau) * std::cos(tau) + std::sin(tau) * std::sin(tau) * gap2 / (rho * rho));
    const double root = r * std::cos(tau);
    const double near = rho > r ? gap2 / (rho * cosine + root) : 0;
    addMeridian(pose, std::atan2(sine, cosine), near, 2 * root, weight * r * std::cos(tau) / (rho * cosine), bands,
                sum);
  }
}

double distance(const Coefficients& a, const Coefficients& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

Coefficients panel(const Pose& pose, double lo, double hi, int bands) {
  using Gauss = boost::math::quadrature::gauss<double, 10>;
  Coefficients sum(static_cast<std::size_t>(bands * bands));
  const double centre = 0.5 * (lo + hi), half = 0.5 * (hi - lo);
  for (std::size_t k = 0; k < Gauss::abscissa().size(); ++k) {
    for (const double sign : {-1.0, 1.0}) {
      addMeridianOf(pose, centre + sign * half * Gauss::abscissa()[k], half * Gauss::weights()[k], bands, sum);
    }
  }
  return sum;
}

/// Halves until twice the nodes change nothing.
void integrate(const Pose& pose, double lo, double hi, const Coefficients& coarse, double tolerance, int depth,
               Coefficients& sum) {
  const int bands = static_cast<int>(std::lround(std::sqrt(static_cast<double>(sum.size()))));
  const double middle = 0.5 * (lo + hi);
  const Coefficients left = panel(pose, lo, middle, bands);
  const Coefficients right = panel(pose, middle, hi, bands);
  Coefficients fine = left;
  for (std::size_t i = 0; i < fine.size(); ++i) fine[i] += right[i];
  if (depth == 0 || distance(fine, coarse) <= tolerance) {
    for (std::size_t i = 0; i < fine.size(); ++i) sum[i] += fine[i];
    return;
  }
  integrate(pose, lo, middle, left, tolerance, depth - 1, sum);
  integrate(pose, middle, hi, right, tolerance, depth - 1, sum);
}

}  // namespace

Point pointOf(Vec3 v) { return {v.x, v.y, v.z}; }

std::vector<double> projectDiskReference(const DiskLight& light, const Point& p, int bands) {
  Coefficients sum(static_cast<std::size_t>(bands * bands));
  const Pose pose = poseOf(light, p);
  if (!(pose.z > 0)) return sum;
  const Coefficients coarse = panel(pose, -0.5 * M_PI, 0.5 * M_PI, bands);
  integrate(pose, -0.5 * M_PI, 0.5 * M_PI, coarse, 1e-14 * distance(coarse, sum), 40, sum);
  return sum;
}

std::vector<double> projectDiskPatches(const DiskLight& light, const Point& p, int bands, int rings) {
  Coefficients sum(static_cast<std::size_t>(bands * bands));
  const Pose pose = poseOf(light, p);
  if (!(pose.z > 0)) return sum;
  const int sectors = 4 * rings;
  const double area = M_PI * pose.radius * pose.radius / (rings * sectors);
  for (int i = 0; i < rings; ++i) {
    const double r = pose.radius * std::sqrt((i + 0.5) / rings);
    for (int k = 0; k < sectors; ++k) {
      const double phi = 2 * M_PI * (k + 0.5) / sectors;
      const Point v =
          pose.across * (pose.rho + r * std::cos(phi)) + pose.side * (r * std::sin(phi)) + pose.down * pose.z;
      const double d = length(v);
      addBasis(v * (1 / d), area * pose.z / (d * d * d), bands, sum);
    }
  }
  return sum;
}

}  // namespace rigel::reference
