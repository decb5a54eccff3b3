#include "pareto/pareto_axes.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <string_view>

namespace rigel::tools {
namespace {

constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

double frameMicroseconds(const ParetoPoint& p) {
  return p.fitMicroseconds.value_or(kNotMeasured) + p.shadeNanoseconds.value_or(kNotMeasured) * 1e-3 * kShadedPoints;
}

constexpr ParetoAxis kCosts[] = {
    {"frame_us", "fit and 10,000 points, µs", [](const ParetoPoint& p) { return frameMicroseconds(p); }},
    {"fit_us", "fit, µs", [](const ParetoPoint& p) { return p.fitMicroseconds.value_or(kNotMeasured); }},
    {"shade_ns_per_point", "shading, ns a point",
     [](const ParetoPoint& p) { return p.shadeNanoseconds.value_or(kNotMeasured); }},
    {"gpu_ns_per_point", "shading on the GPU, ns a point",
     [](const ParetoPoint& p) { return p.gpuNanoseconds.value_or(kNotMeasured); }},
    {"modelled_ns_per_point", "shading by the cost model, ns a point",
     [](const ParetoPoint& p) { return p.modelledNanoseconds.value_or(kNotMeasured); }},
    {"bytes", "bytes", [](const ParetoPoint& p) { return static_cast<double>(p.bytes); }},
};

constexpr ParetoAxis kErrors[] = {
    {"total_rms", "total RMS", [](const ParetoPoint& p) { return p.total.rms; }},
    {"spatial_rms", "spatial RMS", [](const ParetoPoint& p) { return p.spatial.rms; }},
    {"total_max", "total maximum", [](const ParetoPoint& p) { return p.total.max; }},
    {"spatial_max", "spatial maximum", [](const ParetoPoint& p) { return p.spatial.max; }},
};

}  // namespace

std::span<const ParetoAxis> costAxes() { return kCosts; }
std::span<const ParetoAxis> errorAxes() { return kErrors; }

const ParetoAxis& axisNamed(const char* name) {
  for (const auto axes : {costAxes(), errorAxes()})
    for (const ParetoAxis& axis : axes)
      if (std::string_view(axis.name) == name) return axis;
  assert(false && "no such axis");
  return kCosts[0];
}

int comparedBands(std::span<const ParetoPoint> points) {
  int fewest = kMaxBands;
  for (const ParetoPoint& point : points) {
    if (point.bands == kDefaultBands) return kDefaultBands;
    fewest = std::min(fewest, point.bands);
  }
  return fewest;
}

bool isCompared(const ParetoPoint& point, int bands) {
  return point.bands == bands && !point.half && point.form == NearForm::exact;
}

std::vector<CostAndError> compared(std::span<const ParetoPoint> points, const ParetoAxis& cost,
                                   const ParetoAxis& error) {
  const int bands = comparedBands(points);
  std::vector<CostAndError> all;
  for (const ParetoPoint& point : points)
    all.push_back(isCompared(point, bands) ? CostAndError{cost.of(point), error.of(point)}
                                           : CostAndError{kNotMeasured, kNotMeasured});
  return all;
}

}  // namespace rigel::tools
