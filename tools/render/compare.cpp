#include "render/compare.h"

#include <rigel/glm.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rigel::tools {
namespace {

bool showsSame(const RenderedFrame& frame, const VisibleSample& sample, std::span<const std::uint32_t> partOf) {
  return sample.kind == SampleKind::object && frame.part[sample.pixel] == partOf[sample.part] &&
         frame.triangle[sample.pixel] == sample.triangle;
}

}  // namespace

double takePoints(const RenderedFrame& frame, const RenderedPoints& points, std::span<const std::uint32_t> partOf,
                  VisibleSurface& seen) {
  double apart = 0;
  for (VisibleSample& sample : seen.samples) {
    if (!showsSame(frame, sample, partOf)) continue;
    const glm::vec3 position = points.position[sample.pixel];
    apart = std::max(apart, static_cast<double>(glm::distance(position, toGlm(sample.position))));
    sample.position = fromGlm(position);
    sample.normal = fromGlm(points.normal[sample.pixel]);
  }
  return apart;
}

Difference compare(const RenderedFrame& frame, const VisibleSurface& seen, std::span<const Rgb> reference,
                   std::span<const std::uint32_t> partOf) {
  assert(reference.size() == seen.samples.size() && frame.width == seen.width && frame.height == seen.height);
  Difference result;
  double squares = 0;
  std::vector<double> largest;
  for (std::size_t i = 0; i < seen.samples.size(); ++i) {
    const VisibleSample& sample = seen.samples[i];
    if (sample.kind != SampleKind::object) continue;
    ++result.covered;
    if (!showsSame(frame, sample, partOf)) continue;
    double worst = 0;
    for (int c = 0; c < 3; ++c) {
      const double expected = static_cast<double>(reference[i][c]);
      const double error = std::abs(static_cast<double>(frame.irradiance[sample.pixel][c]) - expected);
      result.mean += expected;
      squares += error * error;
      worst = std::max(worst, error == error ? error : HUGE_VAL);
    }
    largest.push_back(worst);
  }
  result.compared = largest.size();
  if (largest.empty()) return result;
  const double values = 3 * static_cast<double>(largest.size());
  result.mean /= values;
  // Where it should be black, any light is too much.
  if (result.mean <= 0) result.mean = squares > 0 ? std::sqrt(squares / values) : 1;
  std::ranges::sort(largest);
  result.rms = std::sqrt(squares / values) / result.mean;
  result.max = largest.back() / result.mean;
  result.p99 = largest[(largest.size() - 1) * 99 / 100] / result.mean;
  return result;
}

}  // namespace rigel::tools
