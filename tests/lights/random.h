// Random test input: reproducible, over many orders of magnitude.
#pragma once

#include <rigel/light.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>

namespace rigel::test {

/// RIGEL_FULL=1 (set by tools/test --full) asks for the long runs.
inline bool fullRun() {
  const char* value = std::getenv("RIGEL_FULL");
  return value && *value && *value != '0';
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  double uniform(double lo = 0, double hi = 1) { return std::uniform_real_distribution<double>(lo, hi)(engine_); }
  float uniformf(double lo = 0, double hi = 1) { return static_cast<float>(uniform(lo, hi)); }
  double logUniform(double lo, double hi) { return std::exp(uniform(std::log(lo), std::log(hi))); }
  int index(int count) { return std::uniform_int_distribution<int>(0, count - 1)(engine_); }

  /// Uniform on the sphere; unit to within float rounding.
  Vec3 direction() {
    const double z = uniform(-1, 1);
    const double phi = uniform(0, 2 * M_PI);
    const double s = std::sqrt(1 - z * z);
    return {static_cast<float>(s * std::cos(phi)), static_cast<float>(s * std::sin(phi)), static_cast<float>(z)};
  }
  Vec3 pointInCube(double half) { return {uniformf(-half, half), uniformf(-half, half), uniformf(-half, half)}; }
  Rgb colour() { return {uniformf(0.1, 2), uniformf(0.1, 2), uniformf(0.1, 2)}; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace rigel::test
