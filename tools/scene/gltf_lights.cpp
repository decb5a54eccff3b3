// KHR_lights_punctual with Rigel's extras: `radius` on a point light makes a sphere of radiance I / (pi radius^2);
// `rigel.pointRadius` is the small radius inside which a point or spot light stays bounded.
#include "scene/gltf_import.h"

#include <rigel/sh.h>

#include <cmath>
#include <limits>

namespace rigel::tools {
namespace {

// extras are free-form in glTF: only objects interest us.
std::optional<JsonPlace> objectMember(const JsonPlace& parent, std::string_view key) {
  auto found = parent.find(key);
  return found && found->value().is_object() ? found : std::nullopt;
}

double numberAtLeast(const JsonPlace& place, std::string_view key, double otherwise, double least) {
  const double value = place.number(key, otherwise);
  if (value < least) place.member(key).fail("must be at least {}, is {}", least, value);
  return value;
}

// colour * intensity in double, so that values split on saving come back exactly.
struct Power {
  double rgb[3];
  Rgb scaled(double s) const {
    return {static_cast<float>(rgb[0] * s), static_cast<float>(rgb[1] * s), static_cast<float>(rgb[2] * s)};
  }
};

Power readPower(const JsonPlace& light) {
  const double intensity = numberAtLeast(light, "intensity", 1, 0);
  Power power{{intensity, intensity, intensity}};
  if (light.has("color")) {
    const auto colour = light.items("color");
    if (colour.size() != 3) light.member("color").fail("must have 3 numbers, has {}", colour.size());
    for (int c = 0; c < 3; ++c) {
      const double value = colour[c].asNumber();
      if (value < 0) colour[c].fail("must be at least 0, is {}", value);
      power.rgb[c] *= value;
      if (!(power.rgb[c] <= std::numeric_limits<float>::max()))
        light.fail("colour times intensity does not fit a float");
    }
  }
  return power;
}

float readRange(const JsonPlace& light) {
  if (!light.has("range")) return kNoRange;
  const double range = light.number("range", 0);
  if (!(static_cast<float>(range) > 0)) light.member("range").fail("must be more than 0, is {}", range);
  return static_cast<float>(range);
}

float readPointRadius(const JsonPlace& light) {
  const auto extras = objectMember(light, "extras");
  const auto ours = extras ? objectMember(*extras, "rigel") : std::nullopt;
  return ours ? static_cast<float>(numberAtLeast(*ours, "pointRadius", kDefaultPointRadius, 0)) : kDefaultPointRadius;
}

LightShape readPointOrSphere(GltfImport& import, const JsonPlace& light, const std::string& name) {
  const Power power = readPower(light);
  const float range = readRange(light);
  const auto extras = objectMember(light, "extras");
  const double radius = extras ? numberAtLeast(*extras, "radius", 0, 0) : 0;
  const auto smallRadius = static_cast<float>(radius);
  if (smallRadius == 0) return PointLight{{}, power.scaled(1), readPointRadius(light), range};
  if (range != kNoRange) import.note("range of sphere light \"{}\" ignored", name);
  const SphereLight sphere{{}, smallRadius, power.scaled(1 / (kPi * radius * radius))};
  for (int c = 0; c < 3; ++c) {
    if (!std::isfinite(sphere.radiance[c])) {
      extras->member("radius").fail("{} is so small that the radiance does not fit a float", radius);
    }
  }
  return sphere;
}

SpotLight readSpot(const JsonPlace& light) {
  const JsonPlace cone = light.member("spot");
  SpotLight spot;
  spot.direction = {0, 0, -1};
  spot.intensity = readPower(light).scaled(1);
  const double inner = numberAtLeast(cone, "innerConeAngle", 0, 0);
  const double outer = numberAtLeast(cone, "outerConeAngle", kPi / 4, 0);
  spot.innerAngle = static_cast<float>(inner);
  spot.outerAngle = static_cast<float>(outer);
  if (spot.outerAngle > static_cast<float>(kPi)) cone.member("outerConeAngle").fail("must be at most pi, is {}", outer);
  if (inner >= outer) cone.fail("innerConeAngle {} must be less than outerConeAngle {}", inner, outer);
  spot.radius = readPointRadius(light);
  spot.range = readRange(light);
  return spot;
}

bool isDisk(const JsonPlace& light) {
  const auto extras = objectMember(light, "extras");
  const auto ours = extras ? objectMember(*extras, "rigel") : std::nullopt;
  return ours && ours->has("type") && ours->member("type").value() == "disk";
}

}  // namespace

void importLights(GltfImport& import) {
  const auto extensions = import.document.root().find("extensions");
  if (!extensions) return;
  if (const auto area = extensions->find("EXT_lights_area")) {
    for (const JsonPlace& light : area->items("lights")) {
      import.note("area light \"{}\" ignored: not supported by this version", readName(light));
    }
  }
  const auto punctual = extensions->find("KHR_lights_punctual");
  if (!punctual) return;
  for (const JsonPlace& place : punctual->items("lights", true)) {
    SceneLight light{readName(place), {}};
    const std::string type = place.member("type").asText();
    if (isDisk(place)) {
      import.note("disk light \"{}\" ignored: not supported by this version", light.name);
      import.sceneLight.push_back(-1);
      continue;
    }
    if (type == "directional") {
      light.shape = DirectionalLight{{0, 0, -1}, readPower(place).scaled(1)};
    } else if (type == "point") {
      light.shape = readPointOrSphere(import, place, light.name);
    } else if (type == "spot") {
      light.shape = readSpot(place);
    } else {
      place.member("type").fail("\"{}\" is none of directional, point, spot", type);
    }
    import.sceneLight.push_back(static_cast<int>(import.scene.lights.size()));
    import.scene.lights.push_back(std::move(light));
  }
}

}  // namespace rigel::tools
