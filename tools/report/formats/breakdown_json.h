// The causes of a rig's error, its body parts and its histogram in report.json.
#pragma once

#include "report/report_data.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <string_view>

namespace rigel::tools {

/// Adds those fields that the rig has. Every number that may not be finite goes through `checked`, with its field.
void addBreakdown(const RigReport& rig, nlohmann::ordered_json& out,
                  const std::function<double(double, std::string_view)>& checked);

}  // namespace rigel::tools
