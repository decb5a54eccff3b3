// The study on a terminal.
#pragma once

#include "pareto/pareto_data.h"

#include <string>

namespace rigel::tools {

/// Of every object the front of total error against the time of a frame, and how far `auto` is from the front by the
/// cost model.
std::string frontText(const Pareto& pareto);

}  // namespace rigel::tools
