#include "probe.h"

#include <rigel/disk.h>
#include <rigel/disk_table.h>
#include <rigel/exact.h>
#include <rigel/project.h>
#include <rigel/wrap.h>

#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <variant>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace rigel::tools {
namespace {

using nlohmann::json;
using Light = std::variant<DirectionalLight, PointLight, SpotLight, SphereLight, DiskLight>;

/// What is wrong with a request, as the answer will say it.
struct BadRequest : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Request {
  Light light;
  Vec3 point;
  std::optional<Vec3> normal;
  float wrap = 0;
  int bands = kDefaultBands;
  DiskMethod method = DiskMethod::quadrature;  // of a disk light
};

const json& field(const json& object, const std::string& name) {
  const auto found = object.find(name);
  if (found == object.end()) throw BadRequest("missing field \"" + name + "\"");
  return *found;
}

float number(const json& value, const std::string& name) {
  if (!value.is_number()) throw BadRequest("\"" + name + "\" is not a number");
  const double wide = value.get<double>();
  if (!(std::abs(wide) <= static_cast<double>(std::numeric_limits<float>::max()))) {
    throw BadRequest("\"" + name + "\" is out of the range of float");
  }
  return static_cast<float>(wide);
}

float numberOr(const json& object, const std::string& name, float fallback) {
  const auto found = object.find(name);
  return found == object.end() ? fallback : number(*found, name);
}

Vec3 vector(const json& object, const std::string& name) {
  const json& value = field(object, name);
  if (!value.is_array() || value.size() != 3) throw BadRequest("\"" + name + "\" is not an array of three numbers");
  return {number(value[0], name), number(value[1], name), number(value[2], name)};
}

Vec3 directionVector(const json& object, const std::string& name) {
  const Vec3 v = vector(object, name);
  if (v == Vec3{}) throw BadRequest("\"" + name + "\" has length zero");
  return v;
}

Rgb colour(const json& object, const std::string& name) {
  const Vec3 v = vector(object, name);
  return {v.x, v.y, v.z};
}

float radiusOf(float radius) {
  if (radius < 0) throw BadRequest(fmt::format("\"radius\" is negative ({})", radius));
  return radius;
}

/// A field that the light type does not have would be ignored in silence: a misspelt one, most likely.
void refuseOtherFields(const json& light, const std::string& type, std::initializer_list<const char*> known) {
  for (const auto& [name, value] : light.items()) {
    bool found = name == "type";
    for (const char* candidate : known) found = found || name == candidate;
    if (!found) throw BadRequest("a " + type + " light has no field \"" + name + "\"");
  }
}

PointLight pointLight(const json& light) {
  PointLight out{vector(light, "position"), colour(light, "intensity")};
  out.radius = radiusOf(numberOr(light, "radius", kDefaultPointRadius));
  out.range = numberOr(light, "range", kNoRange);
  if (!(out.range > 0)) throw BadRequest("\"range\" is not positive");
  return out;
}

SpotLight spotLight(const json& light) {
  const PointLight point = pointLight(light);
  SpotLight out{point.position, directionVector(light, "direction"), point.intensity};
  out.radius = point.radius;
  out.range = point.range;
  out.innerAngle = numberOr(light, "inner", out.innerAngle);
  out.outerAngle = numberOr(light, "outer", out.outerAngle);
  if (!(0 <= out.innerAngle && out.innerAngle <= out.outerAngle && out.outerAngle <= static_cast<float>(kPi))) {
    throw BadRequest("spot angles need 0 <= inner <= outer <= pi");
  }
  return out;
}

DiskLight diskLight(const json& light) {
  const float radius = radiusOf(number(field(light, "radius"), "radius"));
  DiskLight out{vector(light, "position"), directionVector(light, "direction"), radius, colour(light, "radiance")};
  if (const auto found = light.find("two_sided"); found != light.end()) {
    if (!found->is_boolean()) throw BadRequest("\"two_sided\" is not true or false");
    out.twoSided = found->get<bool>();
  }
  return out;
}

std::string stringField(const json& object, const std::string& name) {
  const json& value = field(object, name);
  if (!value.is_string()) throw BadRequest("\"" + name + "\" is not a string");
  return value.get<std::string>();
}

Light parseLight(const json& light) {
  if (!light.is_object()) throw BadRequest("\"light\" is not an object");
  const std::string type = stringField(light, "type");
  if (type == "directional") {
    refuseOtherFields(light, type, {"direction", "irradiance"});
    return DirectionalLight{directionVector(light, "direction"), colour(light, "irradiance")};
  }
  if (type == "point") {
    refuseOtherFields(light, type, {"position", "intensity", "radius", "range"});
    return pointLight(light);
  }
  if (type == "spot") {
    refuseOtherFields(light, type, {"position", "direction", "intensity", "inner", "outer", "radius", "range"});
    return spotLight(light);
  }
  if (type == "sphere") {
    refuseOtherFields(light, type, {"position", "radius", "radiance"});
    return SphereLight{vector(light, "position"), radiusOf(number(field(light, "radius"), "radius")),
                       colour(light, "radiance")};
  }
  if (type == "disk") {
    refuseOtherFields(light, type, {"position", "direction", "radius", "radiance", "two_sided"});
    return diskLight(light);
  }
  throw BadRequest("unknown light type \"" + type + "\"");
}

int bandCount(const json& request) {
  const auto found = request.find("bands");
  if (found == request.end()) return kDefaultBands;
  const float bands = number(*found, "bands");
  if (bands != std::floor(bands) || bands < kMinBands || bands > kMaxBands) {
    throw BadRequest(fmt::format("\"bands\" is not one of {} to {}", kMinBands, kMaxBands));
  }
  return static_cast<int>(bands);
}

DiskMethod diskMethod(const json& request, const Light& light) {
  if (!request.contains("method")) return DiskMethod::quadrature;
  const std::string name = stringField(request, "method");
  if (!std::holds_alternative<DiskLight>(light)) throw BadRequest("\"method\" is for disk lights alone");
  if (name == "table") return DiskMethod::table;
  if (name == "quadrature") return DiskMethod::quadrature;
  if (name == "exact") return DiskMethod::exact;
  throw BadRequest("\"method\" is not one of table, quadrature, exact");
}

Request parseRequest(const json& object) {
  if (!object.is_object()) throw BadRequest("the request is not an object");
  Request request;
  request.light = parseLight(field(object, "light"));
  request.method = diskMethod(object, request.light);
  request.point = vector(object, "point");
  if (object.contains("normal")) request.normal = directionVector(object, "normal");
  request.wrap = numberOr(object, "wrap", 0);
  if (request.wrap < kMinWrap || request.wrap > kMaxWrap) {
    throw BadRequest(fmt::format("\"wrap\" is not within {} to {}", kMinWrap, kMaxWrap));
  }
  request.bands = bandCount(object);
  return request;
}

std::string text(Rgb c) { return fmt::format("[{:.9g},{:.9g},{:.9g}]", c.r, c.g, c.b); }
std::string text(const RgbD& c) { return fmt::format("[{:.17g},{:.17g},{:.17g}]", c.r, c.g, c.b); }

std::string text(std::span<const Rgb> coefficients) {
  std::string out = "[";
  for (const Rgb& c : coefficients) out += (out.size() > 1 ? "," : "") + text(c);
  return out + "]";
}

/// Both normals are unit: the exact path normalises in double, this one for the SH.
Vec3 unit(Vec3 v) {
  const double norm = std::hypot(static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z));
  return {static_cast<float>(v.x / norm), static_cast<float>(v.y / norm), static_cast<float>(v.z / norm)};
}

/// The coefficients asked for, and as they are printed.
template <int B>
struct Answered {
  RadianceSH<B> sh;
  std::string text;
};

template <int B>
Answered<B> answered(const RadianceSH<B>& sh) {
  return {sh, text(sh.c)};
}

template <int B>
Answered<B> exactAnswer(const DiskLight& light, Vec3 point) {
  std::array<double, 3 * shCount(B)> numbers{};
  projectDiskExact(light, point, B, numbers);
  Answered<B> out;
  for (int i = 0; i < shCount(B); ++i) {
    const double* c = &numbers[3 * i];
    for (int channel = 0; channel < 3; ++channel) out.sh[i][channel] = static_cast<float>(c[channel]);
    out.text += (i > 0 ? "," : "") + text(RgbD{c[0], c[1], c[2]});
  }
  out.text = "[" + out.text + "]";
  return out;
}

template <int B>
std::string answer(const Request& request) {
  const auto projection =
      std::visit([&](const auto& light) { return projectWithGradient<B>(light, request.point); }, request.light);
  Answered<B> projected = answered(projection.value);
  if (const auto* disk = std::get_if<DiskLight>(&request.light)) {
    if (request.method == DiskMethod::table) projected = answered(DiskTable::project<B>(*disk, request.point));
    if (request.method == DiskMethod::exact) projected = exactAnswer<B>(*disk, request.point);
  }
  std::string out = "{\"sh\":" + projected.text + ",\"gradient\":[";
  for (int axis = 0; axis < 3; ++axis) out += (axis > 0 ? "," : "") + text(projection.gradient.d[axis].c);
  out += "]";
  if (request.normal) {
    const Rgb fromSh = evaluate(irradianceFromRadiance(projected.sh, request.wrap), unit(*request.normal));
    const RgbD exact = std::visit(
        [&](const auto& light) { return exactIrradiance(light, request.point, *request.normal, request.wrap); },
        request.light);
    out += ",\"irradiance_sh\":" + text(fromSh) + ",\"irradiance_exact\":" + text(exact);
  }
  return out + "}";
}

std::string answerRequest(const Request& request) {
  switch (request.bands) {
    case 2:
      return answer<2>(request);
    case 3:
      return answer<3>(request);
    case 4:
      return answer<4>(request);
    default:
      return answer<5>(request);
  }
}

std::string errorAnswer(const std::string& message) {
  // A message may quote bytes of the line that are no UTF-8.
  return json{{"error", message}}.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace

std::string answerProbe(const std::string& line) {
  try {
    return answerRequest(parseRequest(json::parse(line)));
  } catch (const BadRequest& error) {
    return errorAnswer(error.what());
  } catch (const json::exception& error) {
    return errorAnswer(std::string("not JSON: ") + error.what());
  }
}

}  // namespace rigel::tools
