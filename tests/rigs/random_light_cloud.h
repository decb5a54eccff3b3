// Many lights at once, kinds and sizes mixed, some of them hard: what the light tree is tested on.
#pragma once

#include <rigel/light.h>

#include <cmath>
#include <limits>
#include <random>

namespace rigel::test {

class RandomLightCloud {
 public:
  explicit RandomLightCloud(unsigned seed) : random_(seed) {}

  double uniform(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random_); }
  double logUniform(double lo, double hi) { return std::exp(uniform(std::log(lo), std::log(hi))); }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }
  bool chance(double p) { return uniform(0, 1) < p; }
  std::mt19937& random() { return random_; }

  Vec3 direction() {
    const double z = uniform(-1, 1), phi = uniform(0, 2 * M_PI), s = std::sqrt(1 - z * z);
    return {static_cast<float>(s * std::cos(phi)), static_cast<float>(s * std::sin(phi)), static_cast<float>(z)};
  }

  enum class Kinds { plain, all };

  /// A cloud of some shape (ball, plane, line, few dense heaps, one point) and size about the origin.
  LightSet cloud(int count, float size, Kinds kinds, bool hard) {
    LightSet lights;
    const int shape = below(5);
    const Vec3 flat = shape == 1 ? Vec3{1, 0.02f, 1} : shape == 2 ? Vec3{1, 0.01f, 0.01f} : Vec3{1, 1, 1};
    const bool coloured = chance(0.5);
    // Lamps of one street point one way.
    const Vec3 common = direction();
    const bool alike = chance(0.5);
    Vec3 heap{};
    for (int i = 0; i < count; ++i) {
      if (i % 16 == 0) heap = direction() * static_cast<float>(size * uniform(0, 1));
      Vec3 p = direction() * static_cast<float>(size * std::cbrt(uniform(0, 1)));
      p = {p.x * flat.x, p.y * flat.y, p.z * flat.z};
      if (shape == 3) p = heap + p * 0.05f;
      if (shape == 4) p = Vec3{1, 2, 3} * (0.1f * size);
      const float radius = static_cast<float>(0.02 * size * logUniform(1e-3, 1));
      Rgb c = Rgb{1, 0.9f, 0.8f} * static_cast<float>(logUniform(0.1, 10));
      if (coloured) c = {c.r * static_cast<float>(uniform(0, 1)), c.g, c.b * static_cast<float>(uniform(0, 2))};
      if (hard && chance(0.02)) c = c * 1000.0f;
      if (hard && chance(0.05)) c = {};
      if (hard && chance(0.02)) p.x = std::numeric_limits<float>::quiet_NaN();
      if (hard && chance(0.02)) c.g = std::numeric_limits<float>::quiet_NaN();
      if (hard && chance(0.01)) p.y = std::numeric_limits<float>::infinity();
      if (hard && chance(0.02)) p = p * 1000.0f;
      add(lights, p, radius, c, kinds == Kinds::plain ? below(2) : below(7), alike ? common : direction(), size);
    }
    return lights;
  }

 private:
  void add(LightSet& lights, Vec3 p, float radius, Rgb c, int kind, Vec3 axis, float size) {
    const Rgb radiance = c * static_cast<float>(1 / (M_PI * radius * radius));
    const auto range = static_cast<float>(size * logUniform(0.2, 5));
    const auto inner = static_cast<float>(uniform(0, 1));
    switch (kind) {
      case 0:
        lights.add(PointLight{p, c, radius});
        break;
      case 1:
        lights.add(SphereLight{p, radius, radiance});
        break;
      case 2:
        lights.add(PointLight{p, c, radius, range});
        break;
      case 3:
        lights.add(SpotLight{p, axis, c, inner, inner + static_cast<float>(uniform(0, 1)), radius});
        break;
      case 4:
        lights.add(SpotLight{p, axis, c, 0.4f, 0.4f, radius, range});
        break;
      case 5:
        lights.add(DiskLight{p, axis, radius, radiance, chance(0.5)});
        break;
      default:
        if (chance(0.05))
          lights.add(DirectionalLight{axis, c * (1 / (size * size))});
        else
          lights.add(DiskLight{p, axis, radius, radiance});
    }
  }

  std::mt19937 random_;
};

}  // namespace rigel::test
