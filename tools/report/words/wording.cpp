#include "report/words/wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rigel::tools {

std::string percent(double relative) {
  const double value = 100 * relative;
  return value >= 99.95 || value == 0 ? fmt::format("{:.0f} %", value) : fmt::format("{:#.3g} %", value);
}

std::string smallPercentage(double relative) {
  constexpr double kMostDecimals = 9;
  const double value = 100 * relative;
  if (!(value > 0)) return "0";
  const double decimals = std::clamp(1 - std::floor(std::log10(value)), 0.0, kMostDecimals);
  return fmt::format("{:.{}f}", value, static_cast<int>(decimals));
}

std::string counted(double number, std::string_view one, std::string_view many) {
  const int digits = number == std::floor(number) ? 0 : 1;
  if (number == 1) return fmt::format("1 {}", one);
  return many.empty() ? fmt::format("{:.{}f} {}s", number, digits, one)
                      : fmt::format("{:.{}f} {}", number, digits, many);
}

std::string printable(std::string_view text) {
  std::string safe;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const unsigned char c = static_cast<unsigned char>(text[i]);
    const bool c1 = c == 0xC2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xA0;  // U+0080..9F
    if (c < 0x20 || c == 0x7F || c1) {
      safe += '?';
      i += c1 ? 1 : 0;
    } else {
      safe += text[i];
    }
  }
  return safe;
}

}  // namespace rigel::tools
