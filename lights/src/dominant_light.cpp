#include <rigel/dominant_light.h>
#include <rigel/shader_constants.h>

#include <algorithm>
#include <cmath>

namespace rigel {
namespace {

float luminance(Rgb c) noexcept {
  return static_cast<float>(kRigelLuminanceR) * c.r + static_cast<float>(kRigelLuminanceG) * c.g +
         static_cast<float>(kRigelLuminanceB) * c.b;
}

}  // namespace

template <int B>
DominantLight dominantLight(const RadianceSH<B>& radiance) noexcept {
  const Rgb x = radiance[3], y = radiance[1], z = radiance[2];
  const double v[3] = {luminance(x), luminance(y), luminance(z)};
  const double squared = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  // Also false for NaN.
  if (!(squared > 0 && std::isfinite(squared))) return {};

  const double size = std::sqrt(squared);
  DominantLight out;
  out.direction = {static_cast<float>(v[0] / size), static_cast<float>(v[1] / size), static_cast<float>(v[2] / size)};
  Rgb along = x * out.direction.x + y * out.direction.y + z * out.direction.z;
  along = {std::max(along.r, 0.0f), std::max(along.g, 0.0f), std::max(along.b, 0.0f)};
  const double share = size / static_cast<double>(luminance(along));
  out.irradiance = along * static_cast<float>(share / kRigelY1);
  return out;
}

template DominantLight dominantLight<2>(const RadianceSH<2>&) noexcept;
template DominantLight dominantLight<3>(const RadianceSH<3>&) noexcept;
template DominantLight dominantLight<4>(const RadianceSH<4>&) noexcept;
template DominantLight dominantLight<5>(const RadianceSH<5>&) noexcept;

}  // namespace rigel
