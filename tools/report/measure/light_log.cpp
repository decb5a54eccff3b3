#include "report/measure/light_log.h"

#include "report/words/wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace rigel::tools {
namespace {

using Kind = LightingTarget::Kind;

/// "in all frames", "in frame 7", "in frames 3-9, 12 and 4 more stretches".
std::string framesWith(const LightReport& use, LightRole role, std::span<const int> numbers) {
  constexpr int kNamed = 2;
  if (use.framesOf(role) == static_cast<int>(use.roles.size())) return "in all frames";
  std::string text;
  int stretches = 0;
  bool several = false;
  for (std::size_t first = 0; first < use.roles.size();) {
    std::size_t end = first;
    while (end < use.roles.size() && use.roles[end] == use.roles[first]) ++end;
    if (use.roles[first] == role && ++stretches <= kNamed) {
      text += (text.empty() ? "" : ", ") + std::to_string(numbers[first]);
      if (end - first > 1) text += "-" + std::to_string(numbers[end - 1]);
      several = several || stretches > 1 || end - first > 1;
    }
    first = end;
  }
  text = (several ? "in frames " : "in frame ") + text;
  if (stretches > kNamed) text += " and " + counted(stretches - kNamed, "more stretch", "more stretches");
  return text;
}

/// "32.0 % of the mean light", "551 times the mean light".
std::string ofMeanLight(double relative) {
  return relative < 10 ? percent(relative) + " of the mean light"
                       : fmt::format("{:.0f} times the mean light", relative);
}

std::string goalOf(const LightLogContext& context) {
  if (context.budget) return fmt::format("{:g} us a frame for all objects", *context.budget);
  if (context.asked.target.kind != Kind::none)
    return "target " + percent(static_cast<double>(context.asked.target.value));
  return counted(context.asked.slots(), "near light") + " at most";
}

std::string whyFar(const LightReport& use, const LightLogContext& context) {
  if (use.bound == 0) return "far: the rig holds it without error";
  const std::string error = fmt::format("far: in the rig it is wrong by at most {}", ofMeanLight(use.bound));
  const LightingOptions& asked = context.asked;
  if (asked.target.kind == Kind::none)
    return error + (asked.slots() == 0 ? "; no light is evaluated apart" : "; others come before it");
  if (use.bound <= static_cast<double>(asked.target.value)) return error;
  return error + (context.budget ? "; others take the budget" : "; by the rig's estimate the target is met without it");
}

std::string whyOf(const LightReport& use, const LightLogContext& context) {
  const auto frames = [&](LightRole role) { return framesWith(use, role, context.frames); };
  const int near = use.framesOf(LightRole::exact), blended = use.framesOf(LightRole::blended);
  const int culled = use.framesOf(LightRole::culled);
  if (culled == static_cast<int>(use.roles.size()))
    return "culled: it gives this object nothing in any frame (out of range, outside its cone, or black)";
  std::string why;
  if (near + blended == 0) {
    why = whyFar(use, context);
  } else {
    why =
        fmt::format("{} {}: in the rig it could be wrong by {} ({})", near > 0 ? "near" : "partly near",
                    frames(near > 0 ? LightRole::exact : LightRole::blended), ofMeanLight(use.bound), goalOf(context));
    if (near > 0 && blended > 0) why += "; partly " + frames(LightRole::blended);
  }
  if (culled > 0) why += "; gives nothing " + frames(LightRole::culled);
  return why;
}

/// Leaves the course over the frames to the lights that have one worth showing.
void thinOut(std::vector<LightReport>& uses) {
  std::vector<LightReport*> far;
  for (LightReport& use : uses) {
    if (std::ranges::all_of(use.weights, [](float w) { return w == 0; })) use.weights.clear();
    if (use.weights.empty()) far.push_back(&use);
  }
  std::ranges::stable_sort(far, [](const LightReport* a, const LightReport* b) { return a->bound > b->bound; });
  const std::size_t kept = far.size() == uses.size() ? 0 : LightLog::kKept;
  for (std::size_t rank = kept; rank < far.size(); ++rank) far[rank]->bounds.clear();
}

}  // namespace

const char* roleName(LightRole role) {
  switch (role) {
    case LightRole::culled:
      return "culled";
    case LightRole::inRig:
      return "far";
    case LightRole::blended:
      return "blended";
    case LightRole::exact:
      break;
  }
  return "near";
}

void LightLog::add(std::span<const LightVerdict> verdicts) { frames_.emplace_back(verdicts.begin(), verdicts.end()); }

std::vector<LightReport> LightLog::uses(const LightLogContext& context) const {
  assert(context.frames.size() == frames_.size());
  const float scale = context.meanIrradiance > 0 ? static_cast<float>(1 / context.meanIrradiance) : 0;
  std::vector<LightReport> uses;
  for (std::size_t i = 0; i < context.lights.size(); ++i) {
    LightReport& use = uses.emplace_back();
    use.name = context.lights[i].name;
    use.type = context.lights[i].type;
    for (const std::vector<LightVerdict>& frame : frames_) {
      const LightVerdict& verdict = frame.at(i);
      use.roles.push_back(verdict.role);
      use.weights.push_back(verdict.weight);
      use.bounds.push_back(scale * verdict.bound);
      use.bound = std::max(use.bound, static_cast<double>(use.bounds.back()));
      use.share += static_cast<double>(verdict.share) / static_cast<double>(frames_.size());
    }
    use.why = whyOf(use, context);
  }
  thinOut(uses);
  return uses;
}

}  // namespace rigel::tools
