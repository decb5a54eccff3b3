// report.json: the report for programs. Field names are fixed by DESIGN section 7; scripts rely on them.
#pragma once

#include "report/report_data.h"

#include <rigel/result.h>
#include <nlohmann/json.hpp>

#include <string>

namespace rigel::tools {

/// The whole report as one document, objects of all scenes in one list, each naming its scene. Numbers keep full double
/// precision. JSON has no infinity and no NaN, and a report that holds one is not worth reading: the Error names
/// object, rig and field of the first one. What was not measured (movement between frames that do not follow on each
/// other) is null.
Result<nlohmann::ordered_json> reportJson(const Report& report);

/// UTF-8 text of a document. Names come from files: bytes that are not UTF-8 become U+FFFD. `indent` < 0 gives one
/// line.
std::string jsonText(const nlohmann::ordered_json& document, int indent);

}  // namespace rigel::tools
