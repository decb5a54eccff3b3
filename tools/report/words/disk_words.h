// Which method each disk light used and why, in words.
#pragma once

#include "report/report_data.h"

namespace rigel::tools {

/// What the rigs of an object did with its disk lights, in the order of rigs and lights. `wraps`: a material of the
/// object wraps, and near disks light it by bands.
std::vector<DiskUse> diskUses(const ObjectReport& object, bool wraps);

/// Why rigs take quadrature-6 and near lights the closed form, with the figures of this run.
std::string diskChoice(const std::vector<DiskMethodRow>& methods);

}  // namespace rigel::tools
