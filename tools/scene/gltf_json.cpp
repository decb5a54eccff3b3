#include "scene/gltf_json.h"

#include <cmath>
#include <limits>

namespace rigel::tools {
namespace {

// Keys in a JSON pointer: '~' and '/' are escaped (RFC 6901), and control characters must not break the line.
std::string pointerToken(std::string_view key) {
  std::string token;
  for (const char c : key) {
    if (c == '~') {
      token += "~0";
    } else if (c == '/') {
      token += "~1";
    } else {
      token += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
    }
  }
  return token;
}

}  // namespace

std::optional<JsonPlace> JsonPlace::find(std::string_view key) const {
  if (!value_->is_object()) fail("must be an object, is {}", value_->type_name());
  const auto it = value_->find(std::string(key));
  if (it == value_->end()) return std::nullopt;
  return JsonPlace(*it, path_ + "/" + pointerToken(key));
}

JsonPlace JsonPlace::member(std::string_view key) const {
  if (auto found = find(key)) return *found;
  fail("has no \"{}\"", key);
}

std::vector<JsonPlace> JsonPlace::items(std::string_view key, bool required) const {
  std::vector<JsonPlace> out;
  const auto array = required ? member(key) : find(key);
  if (!array) return out;
  if (!array->value_->is_array()) array->fail("must be an array, is {}", array->value_->type_name());
  if (required && array->value_->empty()) array->fail("must not be empty");
  out.reserve(array->value_->size());
  for (const nlohmann::json& element : *array->value_) {
    out.emplace_back(element, array->path_ + "/" + std::to_string(out.size()));
  }
  return out;
}

std::vector<std::pair<std::string, JsonPlace>> JsonPlace::members() const {
  if (!value_->is_object()) fail("must be an object, is {}", value_->type_name());
  std::vector<std::pair<std::string, JsonPlace>> out;
  for (const auto& [key, element] : value_->items()) {
    out.emplace_back(key, JsonPlace(element, path_ + "/" + pointerToken(key)));
  }
  return out;
}

std::string JsonPlace::asText() const {
  if (!value_->is_string()) fail("must be a string, is {}", value_->type_name());
  return value_->get<std::string>();
}

double JsonPlace::asNumber() const {
  if (!value_->is_number()) fail("must be a number, is {}", value_->type_name());
  const double number = value_->get<double>();
  if (!(std::abs(number) <= std::numeric_limits<float>::max())) fail("{} does not fit a float", number);
  return number;
}

std::size_t JsonPlace::asSize() const {
  // JSON has one kind of number: 3.0 is a whole number too, and beyond 2^53 doubles are not exact.
  constexpr double kLargest = 0x1p53;
  const double number = value_->is_number() ? value_->get<double>() : -1;
  if (!(number >= 0 && number <= kLargest) || number != std::floor(number)) {
    fail("must be a whole number of at least 0, is {}", value_->is_number() ? value_->dump() : value_->type_name());
  }
  return static_cast<std::size_t>(number);
}

int JsonPlace::asIndex(std::size_t count, std::string_view what) const {
  const std::size_t i = asSize();
  if (i >= count) fail("{} {} does not exist (there are {})", what, i, count);
  return static_cast<int>(i);
}

std::string JsonPlace::text(std::string_view key, std::string_view otherwise) const {
  const auto found = find(key);
  return found ? found->asText() : std::string(otherwise);
}

bool JsonPlace::flag(std::string_view key, bool otherwise) const {
  const auto found = find(key);
  if (!found) return otherwise;
  if (!found->value_->is_boolean()) found->fail("must be true or false, is {}", found->value_->type_name());
  return found->value_->get<bool>();
}

double JsonPlace::number(std::string_view key, double otherwise) const {
  const auto found = find(key);
  return found ? found->asNumber() : otherwise;
}

std::size_t JsonPlace::size(std::string_view key, std::size_t otherwise) const {
  const auto found = find(key);
  return found ? found->asSize() : otherwise;
}

std::size_t JsonPlace::requiredSize(std::string_view key) const { return member(key).asSize(); }

int JsonPlace::index(std::string_view key, std::size_t count, std::string_view what) const {
  const auto found = find(key);
  return found ? found->asIndex(count, what) : -1;
}

int JsonPlace::requiredIndex(std::string_view key, std::size_t count, std::string_view what) const {
  return member(key).asIndex(count, what);
}

bool JsonPlace::numbers(std::string_view key, std::size_t width, float* out) const {
  if (!has(key)) return false;
  const std::vector<JsonPlace> values = items(key);
  if (values.size() != width) member(key).fail("must have {} numbers, has {}", width, values.size());
  for (std::size_t i = 0; i < width; ++i) out[i] = static_cast<float>(values[i].asNumber());
  return true;
}

}  // namespace rigel::tools
