#include "report/measure/far_truth.h"

#include "parallel/parallel.h"

namespace rigel::tools {

Rgb FarTruth::at(int light, std::size_t point) const {
  const auto& [p, n] = truth_->points[point];
  return withBands(bands_, [&]<int B>() {
    const RadianceSH<B> radiance = lights_->visit(light, [&](const auto& one) { return project<B>(one, p); });
    return rigel::irradiance<B>(radiance, wrapCoefficients<B>(surface_->wrap[point]), n);
  });
}

void FarTruth::begin(const Truth& truth, const SurfaceSet& surface, const LightSet& lights, int bands) {
  truth_ = &truth;
  surface_ = &surface;
  lights_ = &lights;
  bands_ = bands;
  all_.assign(truth.points.size(), {});
  forSamples(all_.size(), [&](std::size_t i) {
    for (int light = 0; light < lights.size(); ++light) all_[i] += at(light, i) * 1.0;
  });
  single_.clear();
  for (int light = 0; light < lights.size(); ++light) single_.push_back(std::make_unique<Light>());
}

std::span<const Rgb> FarTruth::alone(int light) {
  Light& entry = *single_[static_cast<std::size_t>(light)];
  std::call_once(entry.projected, [&] {
    entry.irradiance.resize(all_.size());
    for (std::size_t i = 0; i < all_.size(); ++i) entry.irradiance[i] = at(light, i);
  });
  return entry.irradiance;
}

void FarTruth::irradiance(std::span<const LightVerdict> verdicts, std::vector<Rgb>& out) {
  std::vector<RgbD> far = all_;
  for (std::size_t light = 0; light < verdicts.size(); ++light) {
    if (verdicts[light].weight == 0) continue;
    const double weight = static_cast<double>(verdicts[light].weight);
    const std::span<const Rgb> taken = alone(static_cast<int>(light));
    for (std::size_t i = 0; i < far.size(); ++i) far[i] += taken[i] * -weight;
  }
  out.resize(far.size());
  for (std::size_t i = 0; i < far.size(); ++i)
    out[i] = {static_cast<float>(far[i].r), static_cast<float>(far[i].g), static_cast<float>(far[i].b)};
}

}  // namespace rigel::tools
