#include "report/run/run_settings.h"

#include "scene/gltf_json.h"

#include <rigel/sh.h>
#include <rigel/wrap.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace rigel::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kPlace = "/extras/rigel/settings";
constexpr std::size_t kMaxLoops = 16;

std::string printable(std::string name) {
  for (char& c : name)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return name.substr(0, 60);
}

double within(const JsonPlace& place, double least, double most) {
  const double value = place.asNumber();
  if (!(value >= least && value <= most)) place.fail("must be {:g} to {:g}, is {:g}", least, most, value);
  return value;
}

float positive(const JsonPlace& place, double most) {
  const double value = place.asNumber();
  if (!(static_cast<float>(value) > 0 && value <= most))
    place.fail("must be more than 0 and at most {:g}, is {:g}", most, value);
  return static_cast<float>(value);
}

/// What `parse` makes of the text, whose errors become those of the place.
template <class Parse>
std::string textFor(const JsonPlace& place, Parse&& parse) {
  std::string text = place.asText();
  if (const auto parsed = parse(text); !parsed) place.fail("{}", printable(text) + ": " + parsed.error().message);
  return text;
}

std::string nearText(const JsonPlace& place) {
  if (place.value().is_string()) return textFor(place, parseNear);
  const std::string text = std::to_string(place.asSize());
  if (const auto near = parseNear(text); !near) place.fail("{}", near.error().message);
  return text;
}

std::vector<double> readLoops(const JsonPlace& parent) {
  std::vector<double> loops;
  for (const JsonPlace& loop : parent.items("loops")) {
    if (loops.size() == kMaxLoops) parent.member("loops").fail("has more than {} entries", kMaxLoops);
    loops.push_back(loop.asNumber());
    if (!(loops.back() > 0)) loop.fail("must be more than 0 s, is {:g}", loops.back());
  }
  return loops;
}

using Reader = void (*)(const JsonPlace& parent, const JsonPlace& place, RunSettings& out);

const std::map<std::string, Reader>& readers() {
  using P = const JsonPlace&;
  using S = RunSettings&;
  static const std::map<std::string, Reader> kReaders = {
      {"rigs", [](P, P p, S s) { s.rigs = textFor(p, parseRigSpecs); }},
      {"clip", [](P, P p, S s) { s.clip = p.asText(); }},
      {"frames", [](P, P p, S s) { s.frames = textFor(p, parseFrameRange); }},
      {"near", [](P, P p, S s) { s.near = nearText(p); }},
      {"rate", [](P, P p, S s) { s.rate = within(p, kMinRate, kMaxRate); }},
      {"error", [](P, P p, S s) { s.error = positive(p, kMaxErrorTarget); }},
      {"total_error", [](P, P p, S s) { s.totalError = positive(p, kMaxErrorTarget); }},
      {"budget_us", [](P, P p, S s) { s.budget = positive(p, kMaxBudget); }},
      {"wrap", [](P, P p, S s) { s.wrap = static_cast<float>(within(p, kMinWrap, kMaxWrap)); }},
      {"exposure", [](P, P p, S s) { s.exposure = positive(p, kMaxExposure); }},
      {"bands",
       [](P, P p, S s) {
         s.bands = static_cast<int>(std::min<std::size_t>(p.asSize(), kMaxBands + 1));
         if (*s.bands < kMinBands || *s.bands > kMaxBands) p.fail("must be {} to {}", kMinBands, kMaxBands);
       }},
      {"loops", [](P parent, P, S s) { s.loops = readLoops(parent); }},
  };
  return kReaders;
}

}  // namespace

Result<RunSettings> parseRunSettings(std::string_view json) {
  try {
    const nlohmann::json document = nlohmann::json::parse(json, nullptr, false);
    const JsonPlace root(document, kPlace);
    RunSettings out;
    for (const auto& [name, value] : root.members()) {
      const auto reader = readers().find(name);
      if (reader == readers().end()) {
        out.notes.push_back(std::string(kPlace) + ": \"" + printable(name) + "\" is not known and left out");
      } else {
        reader->second(root, value, out);
      }
    }
    if (out.error && out.totalError) root.fail("has both error and total_error: only one can be aimed at");
    return out;
  } catch (const LoadError& error) {
    return Error{error.message, error.place};
  }
}

std::string runSettingsText(const RunOptions& options) {
  Json out = Json::object();
  std::string rigs;
  for (const RigSpec& rig : options.rigs) rigs += (rigs.empty() ? "" : ";") + rig.text;
  out["rigs"] = rigs;
  if (!options.clip.empty()) out["clip"] = options.clip;
  const FrameRange& frames = options.frames;
  out["frames"] = fmt::format("{}:{}:{}", frames.first, frames.last ? std::to_string(*frames.last) : "", frames.step);
  out["rate"] = options.rate;
  if (options.near) out["near"] = options.near->automatic ? Json("auto") : Json(options.near->slots);
  if (options.target) {
    const bool total = options.target->kind == LightingTarget::Kind::totalError;
    out[total ? "total_error" : "error"] = double{options.target->value};
  }
  if (options.budget) out["budget_us"] = double{*options.budget};
  if (options.wrap) out["wrap"] = double{*options.wrap};
  out["bands"] = options.bands;
  out["exposure"] = double{options.exposure};
  if (!options.loops.empty()) out["loops"] = options.loops;
  return out.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace rigel::tools
