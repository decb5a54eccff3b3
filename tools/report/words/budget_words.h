// What became of a frame's budget, in words.
#pragma once

#include "report/report_data.h"

#include <string>

namespace rigel::tools {

/// Whether sharing the frame's time shows: the total error is larger than it would be with that time to itself.
bool gaveUp(const RigReport& rig);

/// "total RMS 6.10 % instead of 3.90 % with the frame to itself; 8.1 SH vectors instead of 11.3, ..."; "nothing" where
/// sharing does not show; "" of a rig that shares with nobody.
std::string givenUp(const RigReport& rig);

/// "1500 us a frame for 5 objects lit by auto: 1463 us on average, 1502 us at most."
std::string budgetSentence(const SharedBudget& budget, std::size_t objects);

}  // namespace rigel::tools
