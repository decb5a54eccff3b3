// What `rigel report` prints when it is done: one aligned table an object.
#pragma once

#include "report/report_data.h"

#include <string>

namespace rigel::tools {

/// UTF-8, lines ending in '\n'. The rig the verdict advises is marked. Control characters in names are written as '?':
/// a file cannot move the cursor of the terminal that reads it.
std::string reportText(const Report& report);

}  // namespace rigel::tools
