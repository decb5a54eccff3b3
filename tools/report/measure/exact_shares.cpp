#include "report/measure/exact_shares.h"

#include <rigel/exact_bands.h>

namespace rigel::tools {
namespace {

void addScaled(std::vector<RgbD>& to, const std::vector<RgbD>& from, double scale) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += {scale * from[i].r, scale * from[i].g, scale * from[i].b};
}

}  // namespace

void ExactShares::begin(const Truth& truth, const SurfaceSet& surface, const LightSet& lights, int bands) {
  truth_ = &truth;
  surface_ = &surface;
  lights_ = &lights;
  bands_ = bands;
  all_.assign(truth.points.size(), {});
  forSamples(all_.size(), [&](std::size_t i) {
    const auto& [p, n] = truth.points[i];
    for (int light = 0; light < lights.size(); ++light)
      all_[i] +=
          lights.visit(light, [&](const auto& one) { return exactBandIrradiance(one, p, n, surface.wrap[i], bands); });
  });
  single_.clear();
  single_.resize(static_cast<std::size_t>(lights.size()));
}

const ExactShares::Light& ExactShares::alone(std::size_t light) {
  Light& entry = single_[light];
  if (!entry.exact.empty()) return entry;
  entry.exact.resize(all_.size());
  entry.bands.resize(all_.size());
  lights_->visit(static_cast<int>(light), [&](const auto& one) {
    forSamples(all_.size(), [&](std::size_t i) {
      const auto& [p, n] = truth_->points[i];
      entry.exact[i] = exactIrradiance(one, p, n, surface_->wrap[i]);
      entry.bands[i] = exactBandIrradiance(one, p, n, surface_->wrap[i], bands_);
    });
  });
  return entry;
}

void ExactShares::near(std::span<const LightVerdict> verdicts, std::vector<RgbD>& out) {
  out.assign(all_.size(), {});
  for (std::size_t light = 0; light < verdicts.size(); ++light)
    if (verdicts[light].weight > 0) addScaled(out, alone(light).exact, static_cast<double>(verdicts[light].weight));
}

void ExactShares::farBands(std::span<const LightVerdict> verdicts, std::vector<RgbD>& out) {
  out = all_;
  for (std::size_t light = 0; light < verdicts.size(); ++light)
    if (verdicts[light].weight > 0) addScaled(out, alone(light).bands, -static_cast<double>(verdicts[light].weight));
}

}  // namespace rigel::tools
