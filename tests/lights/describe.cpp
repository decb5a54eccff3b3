#include "lights/describe.h"

#include <cstdio>

namespace rigel::test {

std::string describe(float value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", static_cast<double>(value));
  return text;
}

std::string describe(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string describe(Vec3 v) { return "(" + describe(v.x) + ", " + describe(v.y) + ", " + describe(v.z) + ")"; }

std::string describe(Rgb c) { return describe(Vec3{c.r, c.g, c.b}); }

std::string describe(const DirectionalLight& light) {
  return "directional light, direction " + describe(light.direction) + ", irradiance " + describe(light.irradiance);
}

std::string describe(const PointLight& light) {
  return "point light at " + describe(light.position) + ", intensity " + describe(light.intensity) + ", radius " +
         describe(light.radius) + ", range " + describe(light.range);
}

std::string describe(const SpotLight& light) {
  return "spot " + describe(PointLight{light.position, light.intensity, light.radius, light.range}) + ", direction " +
         describe(light.direction) + ", inner " + describe(light.innerAngle) + ", outer " + describe(light.outerAngle);
}

std::string describe(const SphereLight& light) {
  return "sphere light at " + describe(light.position) + ", radius " + describe(light.radius) + ", radiance " +
         describe(light.radiance);
}

std::string describe(const DiskLight& light) {
  return std::string(light.twoSided ? "two-sided " : "") + "disk light at " + describe(light.position) + " along " +
         describe(light.direction) + ", radius " + describe(light.radius) + ", radiance " + describe(light.radiance);
}

}  // namespace rigel::test
