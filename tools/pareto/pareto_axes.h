// The costs and errors that points are compared by, and what of a study may be compared at all.
#pragma once

#include "pareto/pareto_data.h"
#include "pareto/pareto_front.h"

#include <span>

namespace rigel::tools {

/// NaN where a point was not measured.
struct ParetoAxis {
  const char* name;   // in pareto.json: "fit_us", "total_rms"
  const char* title;  // "fit, µs an object and frame"
  double (*of)(const ParetoPoint& point);
};

/// fit_us, shade_ns_per_point, gpu_ns_per_point, modelled_ns_per_point, frame_us (fit and kShadedPoints points), bytes.
std::span<const ParetoAxis> costAxes();
/// total_rms, spatial_rms, total_max, spatial_max.
std::span<const ParetoAxis> errorAxes();
const ParetoAxis& axisNamed(const char* name);

/// Bands of the points that fronts compare: 3 where there are some, else the fewest. Spatial errors of different bands
/// are errors against different things.
int comparedBands(std::span<const ParetoPoint> points);

/// Is the point among those: of these bands, in floats, with near lights as reports have them?
bool isCompared(const ParetoPoint& point, int bands);

/// All of `points` by two axes; those that are not compared count as not measured.
std::vector<CostAndError> compared(std::span<const ParetoPoint> points, const ParetoAxis& cost,
                                   const ParetoAxis& error);

}  // namespace rigel::tools
