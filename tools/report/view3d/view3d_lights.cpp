#include "report/view3d/view3d_lights.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rigel::tools {
namespace {

/// Unit, or 0 where there is none: in double, where no length overflows.
Vec3 unit(Vec3 v) {
  const double size = std::hypot(static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z));
  if (!(size > 0) || !std::isfinite(size)) return {};
  const auto part = [&](float x) { return static_cast<float>(static_cast<double>(x) / size); };
  return {part(v.x), part(v.y), part(v.z)};
}

}  // namespace

std::vector<int> foremostLights(std::span<const ObjectReport> objects, std::size_t count, std::size_t most) {
  std::vector<double> weight(count, 0);
  for (const ObjectReport& object : objects)
    for (const RigReport& rig : object.rigs)
      for (std::size_t i = 0; i < std::min(count, rig.lights.size()); ++i) {
        const LightReport& use = rig.lights[i];
        const bool near = !use.weights.empty();
        weight[i] = std::max(weight[i], use.share + (near ? 1 : 0));  // shares are at most 1
      }
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(
      order, [&](int a, int b) { return weight[static_cast<std::size_t>(a)] > weight[static_cast<std::size_t>(b)]; });
  order.resize(std::min(count, most));
  std::ranges::sort(order);
  return order;
}

std::vector<ViewLight> viewLights(const LightSet& lights, std::span<const int> indices) {
  std::vector<ViewLight> out;
  for (const int index : indices) {
    ViewLight& shown = out.emplace_back();
    shown.index = index;
    lights.visit(index, [&](const auto& light) {
      shown.colour = colourOf(light);
      if constexpr (requires { light.outerAngle; }) {
        shown.innerAngle = light.innerAngle;
        shown.outerAngle = light.outerAngle;
      }
      if constexpr (requires { light.twoSided; }) shown.twoSided = light.twoSided;
    });
  }
  return out;
}

std::vector<ViewLightPlace> lightPlaces(const LightSet& lights, std::span<const ViewLight> shown) {
  std::vector<ViewLightPlace> out;
  for (const ViewLight& entry : shown) {
    ViewLightPlace& place = out.emplace_back();
    lights.visit(entry.index, [&](const auto& light) {
      if constexpr (requires { light.position; }) place.position = light.position;
      if constexpr (requires { light.direction; }) place.direction = unit(light.direction);
      if constexpr (requires { light.radius; }) place.radius = light.radius;
    });
  }
  return out;
}

}  // namespace rigel::tools
