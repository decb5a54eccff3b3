// pareto.json and pareto.csv: the study for programs.
#pragma once

#include "pareto/pareto_data.h"

#include <nlohmann/json.hpp>

namespace rigel::tools {

/// Figures have seven digits; what was not measured is null. Beside its points an object has `fronts` (by every cost
/// and error, indices of points by rising cost) and `auto`: how far each point of an `auto` rig is from them. Error: a
/// figure is not finite (object, point and field).
Result<nlohmann::ordered_json> paretoJson(const Pareto& pareto);

/// A line a point, with a head line; fields that hold a comma are in quotes. What was not measured is empty.
std::string paretoCsv(const Pareto& pareto);

}  // namespace rigel::tools
