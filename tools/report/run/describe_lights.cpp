#include "report/run/describe_lights.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace rigel::tools {
namespace {

std::string rgb(Rgb c) { return fmt::format("{:.4g} {:.4g} {:.4g}", c.r, c.g, c.b); }

std::string range(float r) { return r == kNoRange ? std::string() : fmt::format(", range {:.4g} m", r); }

double degrees(float radians) { return static_cast<double>(radians) * 180 / std::numbers::pi; }

}  // namespace

std::optional<Error> scaleLights(Scene& scene, float factor) {
  for (SceneLight& light : scene.lights) {
    Rgb& brightness = std::visit([](auto& shape) -> Rgb& { return colourOf(shape); }, light.shape);
    brightness = brightness * factor;
    for (int c = 0; c < 3; ++c) {
      if (!std::isfinite(brightness[c]))
        return Error{fmt::format("--exposure {:g} makes it brighter than a float holds", factor),
                     "light '" + light.name + "'"};
    }
  }
  return std::nullopt;
}

std::vector<LightRow> describeLights(const PosedLights& lights) {
  std::vector<LightRow> rows;
  const auto add = [&](const char* type, std::string summary) {
    rows.push_back({lights.names[rows.size()], type, std::move(summary)});
  };
  const LightSet& set = lights.set;
  for (int i = 0; i < set.directionalCount(); ++i)
    add("directional", fmt::format("irradiance {} W/m²", rgb(set.directional(i).irradiance)));
  for (int i = 0; i < set.pointCount(); ++i) {
    const PointLight l = set.point(i);
    add("point", fmt::format("intensity {} W/sr, radius {:.4g} m{}", rgb(l.intensity), l.radius, range(l.range)));
  }
  for (int i = 0; i < set.spotCount(); ++i) {
    const SpotLight l = set.spot(i);
    add("spot", fmt::format("intensity {} W/sr, cone {:.3g}° to {:.3g}°{}", rgb(l.intensity), degrees(l.innerAngle),
                            degrees(l.outerAngle), range(l.range)));
  }
  for (int i = 0; i < set.sphereCount(); ++i) {
    const SphereLight l = set.sphere(i);
    add("sphere", fmt::format("radiance {} W/(m² sr), radius {:.4g} m", rgb(l.radiance), l.radius));
  }
  for (int i = 0; i < set.diskCount(); ++i) {
    const DiskLight l = set.disk(i);
    add("disk", fmt::format("radiance {} W/(m² sr), radius {:.4g} m{}", rgb(l.radiance), l.radius,
                            l.twoSided ? ", both faces" : ""));
  }
  return rows;
}

}  // namespace rigel::tools
