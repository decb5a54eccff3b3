// Figures in sentences, written alike wherever the report speaks.
#pragma once

#include <string>
#include <string_view>

namespace rigel::tools {

/// "4.70 %", "0 %", "120 %": three digits, as the page writes them.
std::string percent(double relative);

/// "0.000029": a percentage of which two digits count, however small, and never as a power of ten.
std::string smallPercentage(double relative);

/// Text for a terminal: names come from files, and control characters of theirs would be obeyed there.
std::string printable(std::string_view text);

/// "1 SH vector", "12 SH vectors", "3.4 SH vectors" (a mean).
std::string counted(double number, std::string_view one, std::string_view many = {});

}  // namespace rigel::tools
