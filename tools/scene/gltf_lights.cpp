// KHR_lights_punctual with Rigel's extras: `radius` on a point light makes a sphere of radiance I / (pi radius^2);
// `rigel: {type: disk, radius}` makes a disk of the same radiance; `rigel.pointRadius` is the small radius inside which
// a point or spot light stays bounded. And the disks of the draft EXT_lights_area.
#include "scene/gltf_import.h"

#include <rigel/sh.h>

#include <cmath>
#include <limits>

namespace rigel::tools {
namespace {

constexpr float kWidestCone = static_cast<float>(kPi / 2);  // of a spot light that stands for a disk
constexpr double kDefaultNits = 1000;                       // EXT_lights_area

// extras are free-form in glTF: only objects interest us.
std::optional<JsonPlace> objectMember(const JsonPlace& parent, std::string_view key) {
  auto found = parent.find(key);
  return found && found->value().is_object() ? found : std::nullopt;
}

double positiveNumber(const JsonPlace& place, std::string_view key, double otherwise) {
  const double value = place.number(key, otherwise);
  if (!(static_cast<float>(value) > 0)) place.member(key).fail("must be more than 0, is {}", value);
  return value;
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

Power readPower(const JsonPlace& light, double defaultIntensity = 1) {
  const double intensity = numberAtLeast(light, "intensity", defaultIntensity, 0);
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
  return light.has("range") ? static_cast<float>(positiveNumber(light, "range", 0)) : kNoRange;
}

std::optional<JsonPlace> ourExtras(const JsonPlace& light) {
  const auto extras = objectMember(light, "extras");
  return extras ? objectMember(*extras, "rigel") : std::nullopt;
}

float readPointRadius(const JsonPlace& light) {
  const auto ours = ourExtras(light);
  return ours ? static_cast<float>(numberAtLeast(*ours, "pointRadius", kDefaultPointRadius, 0)) : kDefaultPointRadius;
}

/// Radiance of a sphere, or of a disk on its axis, that gives the intensity from afar: I / (pi radius^2).
Rgb radianceOf(const Power& power, double radius, const JsonPlace& radiusOwner) {
  const Rgb radiance = power.scaled(1 / (kPi * radius * radius));
  for (int c = 0; c < 3; ++c) {
    if (!std::isfinite(radiance[c])) {
      radiusOwner.member("radius").fail("{} is so small that the radiance does not fit a float", radius);
    }
  }
  return radiance;
}

LightShape readPointOrSphere(GltfImport& import, const JsonPlace& light, const std::string& name) {
  const Power power = readPower(light);
  const float range = readRange(light);
  const auto extras = objectMember(light, "extras");
  const double radius = extras ? numberAtLeast(*extras, "radius", 0, 0) : 0;
  const auto smallRadius = static_cast<float>(radius);
  if (smallRadius == 0) return PointLight{{}, power.scaled(1), readPointRadius(light), range};
  if (range != kNoRange) import.note("range of sphere light \"{}\" ignored", name);
  return SphereLight{{}, smallRadius, radianceOf(power, radius, *extras)};
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

/// The disk that `extras.rigel` makes of a point or spot light; none without.
std::optional<DiskLight> readDisk(GltfImport& import, const JsonPlace& light, const std::string& name) {
  const auto ours = ourExtras(light);
  if (!ours || !ours->has("type")) return std::nullopt;
  const JsonPlace type = ours->member("type");
  if (type.asText() != "disk") type.fail("\"{}\" is not known (disk is)", type.asText());
  const std::string punctual = light.member("type").asText();
  if (punctual != "point" && punctual != "spot") {
    light.member("type").fail("\"{}\": a disk takes the intensity [cd] of a point or spot light", punctual);
  }
  if (!ours->has("radius")) ours->fail("has no \"radius\"");
  const double radius = positiveNumber(*ours, "radius", 0);
  if (light.has("range")) import.note("range of disk light \"{}\" ignored", name);
  if (punctual == "spot") {
    const SpotLight cone = readSpot(light);
    if (cone.innerAngle != 0 || cone.outerAngle < kWidestCone) {
      import.note("cone of disk light \"{}\" ignored: disks emit into the whole half space", name);
    }
  }
  return DiskLight{
      {}, {0, 0, -1}, static_cast<float>(radius), radianceOf(readPower(light), radius, *ours), ours->flag("twoSided")};
}

LightShape readPunctual(GltfImport& import, const JsonPlace& place, const std::string& name) {
  const std::string type = place.member("type").asText();
  if (const auto disk = readDisk(import, place, name)) return *disk;
  if (type == "directional") return DirectionalLight{{0, 0, -1}, readPower(place).scaled(1)};
  if (type == "point") return readPointOrSphere(import, place, name);
  if (type == "spot") return readSpot(place);
  place.member("type").fail("\"{}\" is none of directional, point, spot", type);
}

/// A disk of the draft: `size` is its diameter, `intensity` its luminance [cd/m2].
DiskLight readAreaDisk(const JsonPlace& light) {
  const auto ours = ourExtras(light);
  const double radius = 0.5 * positiveNumber(light, "size", 1);
  return {{},
          {0, 0, -1},
          static_cast<float>(radius),
          readPower(light, kDefaultNits).scaled(1),
          ours && ours->flag("twoSided")};
}

int add(GltfImport& import, SceneLight light) {
  import.scene.lights.push_back(std::move(light));
  return static_cast<int>(import.scene.lights.size()) - 1;
}

void importAreaLights(GltfImport& import, const JsonPlace& area) {
  for (const JsonPlace& place : area.items("lights", true)) {
    const std::string name = readName(place), type = place.text("type", "rect");
    if (type == "disk") {
      import.areaLight.push_back(add(import, {name, readAreaDisk(place), true}));
    } else if (type == "rect") {
      import.note("area light \"{}\" ignored: rect is not supported by this version (disk is)", name);
      import.areaLight.push_back(-1);
    } else {
      place.member("type").fail("\"{}\" is none of rect, disk", type);
    }
  }
}

}  // namespace

void importLights(GltfImport& import) {
  const auto extensions = import.document.root().find("extensions");
  if (!extensions) return;
  if (const auto punctual = extensions->find("KHR_lights_punctual")) {
    for (const JsonPlace& place : punctual->items("lights", true)) {
      const std::string name = readName(place);
      import.punctualLight.push_back(add(import, {name, readPunctual(import, place, name)}));
    }
  }
  if (const auto area = extensions->find("EXT_lights_area")) importAreaLights(import, *area);
}

}  // namespace rigel::tools
