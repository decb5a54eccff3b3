#include "report/run_options.h"

#include <rigel/sh.h>
#include <rigel/wrap.h>

#include <fmt/format.h>

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

std::optional<Error> checkOptions(const RunOptions& options) {
  // Written so that NaN fails every comparison.
  if (options.wrap && !(*options.wrap >= kMinWrap && *options.wrap <= kMaxWrap))
    return Error{fmt::format("must lie in [{}, {}]", kMinWrap, kMaxWrap), fmt::format("--wrap {}", *options.wrap)};
  if (!(options.exposure > 0 && options.exposure <= kMaxExposure))
    return Error{fmt::format("must be more than 0 and at most {:g}", kMaxExposure),
                 fmt::format("--exposure {:g}", options.exposure)};
  if (options.bands < kMinBands || options.bands > kMaxBands)
    return Error{fmt::format("must be {} to {}", kMinBands, kMaxBands), fmt::format("--bands {}", options.bands)};
  if (options.frames.first < 0 || options.frames.step < 1 ||
      (options.frames.last && *options.frames.last < options.frames.first))
    return Error{"the range is empty", "--frames"};
  if (options.rigs.empty()) return Error{"names no rig", "--rig"};
  if (options.samples < 1) return Error{"needs at least one surface sample", "samples"};
  return std::nullopt;
}

}  // namespace rigel::tools
