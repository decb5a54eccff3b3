#include "report/run_options.h"

#include <rigel/sh.h>
#include <rigel/wrap.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace rigel::tools {
namespace {

bool parseNumber(std::string_view text, int& value) {
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  return status == std::errc() && end == text.data() + text.size();
}

std::optional<Error> checkTarget(const RunOptions& options) {
  if (!options.target) return std::nullopt;
  const LightingTarget& target = *options.target;
  const bool budget = target.kind == LightingTarget::Kind::budget;
  if (budget && !(target.value > 0 && target.value <= kMaxBudget))
    return Error{fmt::format("must be more than 0 and at most {:.0f} microseconds", kMaxBudget), targetOption(target)};
  if (!budget && !(target.value > 0 && target.value <= kMaxErrorTarget))
    return Error{fmt::format("must be more than 0 and at most {:g} (0.05 is 5 % of the mean light)", kMaxErrorTarget),
                 targetOption(target)};
  if (std::ranges::none_of(options.rigs, [&](const RigSpec& rig) { return chooses(rig, options); }))
    return Error{"no rig here chooses anything: that takes an `auto` rig or --near auto", targetOption(target)};
  return std::nullopt;
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

Result<NearChoice> parseNear(const std::string& text) {
  if (text == "auto") return NearChoice{true, 0};
  NearChoice near;
  if (!parseNumber(text, near.slots) || near.slots < 0 || near.slots > kMaxNearLights)
    return Error{fmt::format("expected auto, or a number of lights from 0 to {}", kMaxNearLights), "--near " + text};
  return near;
}

bool chooses(const RigSpec& rig, const RunOptions& options) {
  return rig.adaptive || (options.near && options.near->automatic);
}

LightingOptions lightingOptions(const RigSpec& rig, const RunOptions& options) {
  LightingOptions lighting;
  if (chooses(rig, options)) lighting.target = options.target.value_or(kDefaultTarget);
  const NearChoice near = options.near.value_or(NearChoice{rig.adaptive, 0});
  lighting.nearSlots = near.automatic ? kMaxNearLights : near.slots;
  lighting.estimate = true;
  return lighting;
}

std::string choiceOptions(const RigSpec& rig, const RunOptions& options) {
  const NearChoice near = options.near.value_or(NearChoice{rig.adaptive, 0});
  if (!near.automatic && near.slots == 0 && !rig.adaptive) return "";
  std::string text = near.automatic ? "--near auto" : fmt::format("--near {}", near.slots);
  if (chooses(rig, options)) text += " " + targetOption(options.target.value_or(kDefaultTarget));
  return text;
}

std::string targetOption(const LightingTarget& target) {
  switch (target.kind) {
    case LightingTarget::Kind::spatialError:
      return fmt::format("--error {:g}", target.value);
    case LightingTarget::Kind::totalError:
      return fmt::format("--total-error {:g}", target.value);
    case LightingTarget::Kind::budget:
      return fmt::format("--budget-us {:g}", target.value);
    case LightingTarget::Kind::none:
      break;
  }
  return "";
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
  if (!(options.rate >= kMinRate && options.rate <= kMaxRate))
    return Error{fmt::format("must be {:g} to {:g} frames a second", kMinRate, kMaxRate),
                 fmt::format("--rate {:g}", options.rate)};
  if (options.rigs.empty()) return Error{"names no rig", "--rig"};
  if (options.samples < 1) return Error{"needs at least one surface sample", "samples"};
  return checkTarget(options);
}

}  // namespace rigel::tools
