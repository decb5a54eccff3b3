#include "report/formats/breakdown_json.h"

namespace rigel::tools {
namespace {

using Json = nlohmann::ordered_json;
using Checked = std::function<double(double, std::string_view)>;

Json partsJson(const ErrorParts& parts, const Checked& checked) {
  Json causes = Json::array();
  for (std::size_t i = 0; i < kErrorCauses; ++i)
    causes.push_back({{"cause", kErrorCauseNames[i]},
                      {"square", checked(parts.parts[i].square, "parts square")},
                      {"without", checked(parts.parts[i].without, "parts without")}});
  return {{"causes", std::move(causes)},
          {"interaction", checked(parts.interaction, "parts interaction")},
          {"total", checked(parts.total, "parts total")},
          {"unclamped", checked(parts.unclamped, "parts unclamped")}};
}

Json bodyPartJson(const BodyPartErrors& part, const Checked& checked) {
  return {{"name", part.name},
          {"parent", part.parent < 0 ? Json(nullptr) : Json(part.parent)},
          {"nodes", part.nodes},
          {"samples", part.samples},
          {"area", checked(part.area, "body part area")},
          {"share", checked(part.share, "body part share")},
          {"rms", checked(part.rms, "body part rms")},
          {"max", checked(part.max, "body part max")},
          {"mean", checked(part.mean, "body part mean")}};
}

Json histogramJson(const ErrorHistogram& histogram, const Checked& checked) {
  return {
      {"absolute",
       {{"least", ErrorHistogram::kLeast}, {"per_decade", ErrorHistogram::kPerDecade}, {"counts", histogram.absolute}}},
      {"signed",
       {{"limit", checked(histogram.limit, "histogram limit")},
        {"counts", histogram.signedBins},
        {"below", histogram.below},
        {"above", histogram.above}}},
      {"p50", checked(histogram.p50, "histogram p50")},
      {"p90", checked(histogram.p90, "histogram p90")},
      {"p99", checked(histogram.p99, "histogram p99")}};
}

}  // namespace

void addBreakdown(const RigReport& rig, Json& out, const Checked& checked) {
  if (rig.parts) out["parts"] = partsJson(*rig.parts, checked);
  if (!rig.bodyParts.empty()) {
    Json parts = Json::array();
    for (const BodyPartErrors& part : rig.bodyParts) parts.push_back(bodyPartJson(part, checked));
    out["body_parts"] = std::move(parts);
  }
  if (rig.histogram) out["histogram"] = histogramJson(*rig.histogram, checked);
}

}  // namespace rigel::tools
