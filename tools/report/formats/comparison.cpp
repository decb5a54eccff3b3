#include "report/formats/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <tuple>

namespace rigel::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uintmax_t kMostBytes = 256u << 20;

/// Walks a document of unknown origin; the first thing that is not as it should be is remembered with its place.
class Checker {
 public:
  std::optional<Error> check(const Json& document) {
    if (!document.is_object()) return Error{"this is no report", "document"};
    if (!document.contains("objects") || !document["objects"].is_array())
      return Error{"a report has an array of objects", "objects"};
    optionalText(document, "command", "");
    const Json& objects = document["objects"];
    for (std::size_t i = 0; i < objects.size(); ++i) object(objects[i], fmt::format("objects[{}]", i));
    return error_;
  }

 private:
  void fail(const std::string& place, const char* message) {
    if (!error_) error_ = Error{message, place};
  }
  void optionalText(const Json& of, const char* field, const std::string& place) {
    if (of.contains(field) && !of[field].is_string()) fail(place + field, "this is not text");
  }
  void neededText(const Json& of, const char* field, const std::string& place) {
    if (!of.contains(field) || !of[field].is_string()) fail(place + "." + field, "text is missing");
  }
  void object(const Json& object, const std::string& place) {
    if (!object.is_object()) return fail(place, "this is no object of a report");
    neededText(object, "name", place);
    for (const char* field : {"scene", "clip"}) optionalText(object, field, place + ".");
    if (!object.contains("rigs") || !object["rigs"].is_array()) return fail(place + ".rigs", "an array is missing");
    for (std::size_t i = 0; i < object["rigs"].size(); ++i)
      rig(object["rigs"][i], fmt::format("{}.rigs[{}]", place, i));
  }
  void rig(const Json& rig, const std::string& place) {
    if (!rig.is_object()) return fail(place, "this is no rig of a report");
    neededText(rig, "spec", place);
    optionalText(rig, "asked", place + ".");
    for (const RigFigure& figure : rigFigures()) {
      const auto value = valueOf(figure, rig);
      if (value && !(std::isfinite(*value) && *value >= 0))
        fail(fmt::format("{}{}", place, figure.pointer), "this is not a figure of a rig");
    }
    if (!valueOf(rigFigures().front(), rig)) fail(place + ".total.rms", "a number is missing");
  }

  std::optional<Error> error_;
};

using Key = std::tuple<std::string, std::string, std::string, std::string, std::string, int>;

/// The rigs of a document by what makes them the same.
std::vector<std::pair<Key, const Json*>> rigsOf(const Json& document) {
  std::map<Key, int> seen;
  std::vector<std::pair<Key, const Json*>> rigs;
  for (const Json& object : document["objects"])
    for (const Json& rig : object["rigs"]) {
      Key key{object.value("scene", ""), object.value("clip", ""), object.value("name", ""),
              rig.value("spec", ""),     rig.value("asked", ""),   0};
      std::get<int>(key) = seen[key]++;
      rigs.emplace_back(key, &rig);
    }
  return rigs;
}

}  // namespace

Result<ReportFile> parseReport(const std::string& name, std::string_view text) {
  ReportFile out{name, Json::parse(text, nullptr, false)};
  if (out.document.is_discarded()) return Error{"it is not JSON (a report.json is wanted)", name};
  if (const auto error = Checker().check(out.document)) return Error{error->message, name + ": " + error->place};
  return out;
}

Result<ReportFile> readReportFile(const std::filesystem::path& file) {
  const std::string name = file.string();
  std::error_code failed;
  if (!std::filesystem::is_regular_file(file, failed)) return Error{"there is no such file", name};
  if (const auto bytes = std::filesystem::file_size(file, failed); failed || bytes > kMostBytes)
    return Error{"it is too large for a report", name};
  std::ifstream in(file, std::ios::binary);
  std::ostringstream content;
  content << in.rdbuf();
  if (!in || in.bad()) return Error{"it cannot be read", name};
  return parseReport(name, content.str());
}

std::optional<double> ComparedRig::ratio(std::size_t figure, std::size_t run) const {
  const auto &from = values[figure][0], &to = values[figure][run];
  if (!from || !to) return std::nullopt;
  const double least = rigFigures()[figure].least;
  if (*to <= least && *from <= least) return 1;
  if (std::max(*from, least) == 0) return std::nullopt;
  return std::max(*to, least) / std::max(*from, least);
}

Result<Comparison> compareReports(const std::vector<ReportFile>& runs) {
  Comparison out;
  std::map<Key, std::size_t> placeOf;
  for (std::size_t run = 0; run < runs.size(); ++run) {
    out.runs.push_back(runs[run].name);
    out.commands.push_back(runs[run].document.value("command", ""));
    for (const auto& [key, rig] : rigsOf(runs[run].document)) {
      const auto [at, isNew] = placeOf.try_emplace(key, out.rigs.size());
      if (isNew) {
        const auto& [scene, clip, object, spec, asked, nth] = key;
        out.rigs.push_back({scene, clip, object, spec, asked, {}});
        out.rigs.back().values.assign(rigFigures().size(), std::vector<std::optional<double>>(runs.size()));
      }
      for (std::size_t f = 0; f < rigFigures().size(); ++f)
        out.rigs[at->second].values[f][run] = valueOf(rigFigures()[f], *rig);
    }
  }
  const bool shared = std::ranges::any_of(out.rigs, [&](const ComparedRig& rig) {
    return std::ranges::count_if(rig.values[0], [](const auto& v) { return v.has_value(); }) > 1;
  });
  if (!shared) return Error{"no rig of an object is in more than one of the reports", "--compare"};
  return out;
}

namespace {

double allowedFor(RigFigure::Kind kind, const Limits& limits) {
  constexpr double kAnything = std::numeric_limits<double>::infinity();
  if (kind == RigFigure::Kind::error) return limits.error.value_or(kAnything);
  return kind == RigFigure::Kind::time ? limits.time.value_or(kAnything) : kAnything;
}

}  // namespace

std::vector<std::string> worsened(const Comparison& comparison, const Limits& limits) {
  std::vector<std::string> lines;
  for (std::size_t run = 1; run < comparison.runs.size(); ++run)
    for (const ComparedRig& rig : comparison.rigs) {
      const std::string place = fmt::format("{}: {} of {}", comparison.runs[run], rig.spec, rig.object);
      const bool was = rig.values[0][0].has_value(), is = rig.values[0][run].has_value();
      if (was && !is && (limits.error || limits.time)) lines.push_back(place + " is missing");
      for (std::size_t f = 0; f < rigFigures().size(); ++f) {
        const RigFigure& figure = rigFigures()[f];
        const double allowed = allowedFor(figure.kind, limits);
        const auto ratio = rig.ratio(f, run);
        if (!ratio || !(*ratio > allowed)) continue;
        lines.push_back(fmt::format("{}: {} {} was {}: {:.3g} times, {:g} allowed", place, figure.title,
                                    shown(figure, rig.values[f][run]), shown(figure, rig.values[f][0]), *ratio,
                                    allowed));
      }
    }
  return lines;
}

}  // namespace rigel::tools
