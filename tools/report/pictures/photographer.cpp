#include "report/pictures/photographer.h"

#include "picture/heat_map.h"
#include "picture/shade_exact.h"
#include "picture/tone_map.h"

#include <rigel/sh.h>

#include <algorithm>
#include <cmath>

namespace rigel::tools {
namespace {

// Point lights are drawn as balls of at least this share of the object's radius, so that one sees where light comes
// from.
constexpr float kLightMarker = 0.02f;
constexpr float kLightBrightness = 1.2f;  // bright, with its colour still seen
// Below this top of the scale a heat map would magnify what no one can see.
constexpr float kLeastHeatScale = 0.05f;

float magnitudeOf(Rgb e) { return std::sqrt((e.r * e.r + e.g * e.g + e.b * e.b) / 3); }

std::vector<float> magnitudes(std::span<const Rgb> error) {
  std::vector<float> out;
  out.reserve(error.size());
  for (Rgb e : error) out.push_back(magnitudeOf(e));
  return out;
}

/// The sum over the object's samples of weight times value, and of the weights.
Image weighted(const VisibleSurface& surface, std::span<const std::size_t> samples, const auto& valueOf) {
  Image image(surface.width, surface.height);
  for (const std::size_t i : samples) {
    const VisibleSample& sample = surface.samples[i];
    const Rgb value = valueOf(i);
    for (int c = 0; c < 3; ++c) image.rgb[3 * sample.pixel + static_cast<std::size_t>(c)] += sample.weight * value[c];
    image.coverage[sample.pixel] += sample.weight;
  }
  return image;
}

}  // namespace

Photographer::Photographer(const PosedScene& scene, const ObjectRun& run, std::optional<float> wrap, PictureSize size,
                           std::optional<float> exposure)
    : run_(run) {
  poseObject(scene.scene, run.object(), scene.pose, posed_);
  const BoundingSphere sphere = boundingSphere(posed_.positions);
  RayCaster caster;
  caster.add(run.object(), posed_);
  PosedObject scenery;
  for (const SceneObject& object : scene.objects) {
    if (&object == &run.object()) continue;
    poseObject(scene.scene, object, scene.pose, scenery);
    caster.add(object, scenery, SampleKind::scenery);
  }
  addLights(caster, scene.lights, kLightMarker * sphere.radius, kLightBrightness);
  surface_ = caster.cast(framePoints(posed_.positions, size.width, size.height));
  if (wrap)
    for (VisibleSample& sample : surface_.samples) sample.wrap = *wrap;

  exact_ = exactIrradiance(surface_, scene.lights);
  exposure_ = exposure ? *exposure : autoExposure(surface_, tools::shade(surface_, exact_));
  for (std::size_t i = 0; i < surface_.samples.size(); ++i) {
    const VisibleSample& sample = surface_.samples[i];
    if (sample.kind != SampleKind::object) continue;
    objectSamples_.push_back(i);
    points_.push_back({sample.position, sample.normal});
    wraps_.push_back(sample.wrap);
  }
}

ShadedRig Photographer::shade(std::size_t rigIndex, std::size_t frame, const LightSet& lights) const {
  run_.relight(rigIndex, frame, posed_, lights);
  std::vector<RigRunner::Shaded> shaded(points_.size());
  run_.rig(rigIndex).shade(points_, wraps_, shaded);
  const double mean = run_.meanIrradiance();
  const float scale = mean > 0 ? static_cast<float>(1 / mean) : 0;
  ShadedRig out{exact_, std::vector<Rgb>(exact_.size())};
  for (std::size_t i = 0; i < shaded.size(); ++i) {
    const std::size_t sample = objectSamples_[i];
    out.irradiance[sample] = shaded[i].clamped();
    out.error[sample] = (out.irradiance[sample] - exact_[sample]) * scale;
  }
  return out;
}

Image Photographer::radiance(std::span<const Rgb> irradiance) const {
  return resolve(surface_, tools::shade(surface_, irradiance, 1 / exposure_));
}

Image Photographer::surroundings() const {
  std::vector<Rgb> colours = tools::shade(surface_, exact_, 1 / exposure_);
  for (const std::size_t i : objectSamples_) colours[i] = {};
  return resolve(surface_, colours);
}

Image Photographer::reflectance() const {
  constexpr auto kInversePi = static_cast<float>(1 / kPi);
  return weighted(surface_, objectSamples_, [&](std::size_t i) { return surface_.samples[i].baseColour * kInversePi; });
}

Image Photographer::objectMean(std::span<const Rgb> values) const {
  Image image = weighted(surface_, objectSamples_, [&](std::size_t i) { return values[i]; });
  for (std::size_t i = 0; i < image.pixelCount(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      if (image.coverage[i] > 0) image.rgb[3 * i + c] /= image.coverage[i];
  for (float& share : image.coverage) share = std::min(share, 1.0f);  // nine ninths may sum to a hair above 1
  return image;
}

double Photographer::rms(std::span<const Rgb> error) const {
  double squares = 0;
  double weight = 0;
  for (std::size_t i : objectSamples_) {
    const double magnitude = static_cast<double>(magnitudeOf(error[i]));
    const double w = static_cast<double>(surface_.samples[i].weight);
    squares += w * magnitude * magnitude;
    weight += w;
  }
  return weight > 0 ? std::sqrt(squares / weight) : 0;
}

float Photographer::heatScaleOf(std::span<const Rgb> error) const {
  return std::max(kLeastHeatScale, heatScale(surface_, magnitudes(error)));
}

Image8 Photographer::heat(std::span<const Rgb> error, float top) const {
  return heatMap(surface_, magnitudes(error), top);
}

}  // namespace rigel::tools
