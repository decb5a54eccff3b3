#include "report/run/run_options.h"

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

std::optional<Error> checkAim(const RunOptions& options) {
  const std::string asked = aimOptions(options.target, options.budget);
  if (asked.empty()) return std::nullopt;
  if (options.budget && !(*options.budget > 0 && *options.budget <= kMaxBudget))
    return Error{fmt::format("must be more than 0 and at most {:.0f} microseconds", kMaxBudget),
                 aimOptions({}, options.budget)};
  if (options.target && !(options.target->value > 0 && options.target->value <= kMaxErrorTarget))
    return Error{fmt::format("must be more than 0 and at most {:g} (0.05 is 5 % of the mean light)", kMaxErrorTarget),
                 aimOptions(options.target, {})};
  if (std::ranges::none_of(options.rigs, [&](const RigSpec& rig) { return chooses(rig, options); }))
    return Error{"no rig here chooses anything: that takes an `auto` rig or --near auto", asked};
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

LightingTarget targetOf(const RunOptions& options) {
  return options.target.value_or(options.budget ? kBudgetTarget : kDefaultTarget);
}

LightingOptions lightingOptions(const RigSpec& rig, const RunOptions& options) {
  LightingOptions lighting;
  if (chooses(rig, options)) lighting.target = targetOf(options);
  const NearChoice near = options.near.value_or(NearChoice{rig.adaptive, 0});
  lighting.nearSlots = near.automatic ? kMaxNearLights : near.slots;
  lighting.estimate = true;
  lighting.cost = options.cost;
  return lighting;
}

std::string choiceOptions(const RigSpec& rig, const RunOptions& options) {
  const NearChoice near = options.near.value_or(NearChoice{rig.adaptive, 0});
  if (!near.automatic && near.slots == 0 && !rig.adaptive) return "";
  std::string text = near.automatic ? "--near auto" : fmt::format("--near {}", near.slots);
  if (!chooses(rig, options)) return text;
  const bool silent = !options.target && !options.budget;
  return text + " " + aimOptions(silent ? kDefaultTarget : options.target, options.budget);
}

std::string aimOptions(const std::optional<LightingTarget>& target, const std::optional<float>& budget) {
  const bool total = target && target->kind == LightingTarget::Kind::totalError;
  std::string text;
  if (target) text = fmt::format("{} {:g}", total ? "--total-error" : "--error", target->value);
  if (budget) text += fmt::format("{}--budget-us {:g}", text.empty() ? "" : " ", *budget);
  return text;
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
  return checkAim(options);
}

}  // namespace rigel::tools
