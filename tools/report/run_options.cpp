#include "report/run_options.h"

#include <charconv>

namespace rigel::tools {
namespace {

bool parseNumber(std::string_view text, int& value) {
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  return status == std::errc() && end == text.data() + text.size();
}

}  // namespace

Result<FrameRange> parseFrameRange(const std::string& text) {
  const std::string place = "--frames " + text;
  const Error malformed{"expected FIRST:LAST:STEP, FIRST:LAST, FIRST: or FIRST", place};
  FrameRange range;
  const std::string_view all = text;
  const auto colon = all.find(':');
  if (const auto first = all.substr(0, colon); !first.empty() || colon == std::string_view::npos) {
    if (!parseNumber(first, range.first)) return malformed;
  }
  if (colon == std::string_view::npos) {
    range.last = range.first;
  } else {
    const std::string_view rest = all.substr(colon + 1);
    const auto second = rest.find(':');
    int last = 0;
    if (const auto lastText = rest.substr(0, second); !lastText.empty()) {
      if (!parseNumber(lastText, last)) return malformed;
      range.last = last;
    }
    if (second != std::string_view::npos && !parseNumber(rest.substr(second + 1), range.step)) return malformed;
  }
  if (range.first < 0 || (range.last && *range.last < range.first)) return Error{"the range is empty", place};
  if (range.step < 1) return Error{"the step must be 1 or more", place};
  return range;
}

}  // namespace rigel::tools
