// pareto.svg: the study as a picture that documents can hold, light and dark.
#pragma once

#include "pareto/pareto_data.h"

#include <string>

namespace rigel::tools {

/// The first object's points in the bands that fronts compare: spatial RMS against the time to fit, of rigs that hold
/// all light, and total RMS against the time of a frame, of everything. Fronts are drawn and named.
std::string paretoSvg(const Pareto& pareto);

}  // namespace rigel::tools
