#include "report/wording.h"

#include <fmt/format.h>

#include <cmath>

namespace rigel::tools {

std::string percent(double relative) {
  const double value = 100 * relative;
  return value >= 99.95 || value == 0 ? fmt::format("{:.0f} %", value) : fmt::format("{:#.3g} %", value);
}

std::string counted(double number, std::string_view noun) {
  const bool whole = number == std::floor(number);
  return fmt::format("{:.{}f} {}{}", number, whole ? 0 : 1, noun, number == 1 ? "" : "s");
}

}  // namespace rigel::tools
