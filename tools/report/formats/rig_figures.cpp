#include "report/formats/rig_figures.h"

#include <fmt/format.h>

namespace rigel::tools {
namespace {

using Kind = RigFigure::Kind;

constexpr double kLeastError = 1e-4;  // of the mean light
constexpr double kLeastFit = 0.5;     // us
constexpr double kLeastShade = 1;     // ns a point

constexpr RigFigure kFigures[] = {
    {"total_rms", "total RMS %", "/total/rms", Kind::error, 100, 2, kLeastError},
    {"total_max", "total max %", "/total/max", Kind::error, 100, 2, kLeastError},
    {"spatial_rms", "spatial RMS %", "/spatial/rms", Kind::error, 100, 2, kLeastError},
    {"spatial_max", "spatial max %", "/spatial/max", Kind::error, 100, 2, kLeastError},
    {"max_jump", "max jump %", "/max_jump", Kind::error, 100, 2, kLeastError},
    {"fit_us", "fit us", "/fit_us", Kind::time, 1, 1, kLeastFit},
    {"shade_ns_per_point", "shade ns/pt", "/shade_ns_per_point", Kind::time, 1, 1, kLeastShade},
    {"sh_vectors", "SH vectors", "/sh_vectors", Kind::size, 1, 1, 0},
    {"near_lights", "near lights", "/near_lights", Kind::size, 1, 1, 0},
    {"bytes", "bytes", "/bytes", Kind::size, 1, 0, 0},
};

}  // namespace

std::span<const RigFigure> rigFigures() { return kFigures; }

std::optional<double> valueOf(const RigFigure& figure, const nlohmann::ordered_json& rig) {
  const nlohmann::ordered_json::json_pointer at(figure.pointer);
  if (!rig.contains(at) || !rig.at(at).is_number()) return std::nullopt;
  return rig.at(at).get<double>();
}

std::string shown(const RigFigure& figure, const std::optional<double>& value) {
  return value ? fmt::format("{:.{}f}", figure.scale * *value, figure.decimals) : "-";
}

}  // namespace rigel::tools
