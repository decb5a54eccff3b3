// A JSON value that knows where it stands, so that every refusal names its place: the only way the loader reads JSON.
#pragma once

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace rigel::tools {

/// Thrown while loading, turned into an Error by loadGltf: `place` is a JSON pointer such as "/nodes/3".
struct LoadError {
  std::string place;
  std::string message;
};

class JsonPlace {
 public:
  explicit JsonPlace(const nlohmann::json& value, std::string path = "") : value_(&value), path_(std::move(path)) {}

  const nlohmann::json& value() const noexcept { return *value_; }
  const std::string& path() const noexcept { return path_; }

  template <class... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> text, Args&&... args) const {
    throw LoadError{path_, fmt::format(text, std::forward<Args>(args)...)};
  }

  /// A member that must, or may, be there. A value that is not an object fails.
  JsonPlace member(std::string_view key) const;
  std::optional<JsonPlace> find(std::string_view key) const;
  bool has(std::string_view key) const { return find(key).has_value(); }

  /// Elements of an array member; none where it is absent, unless `required` (then at least one).
  std::vector<JsonPlace> items(std::string_view key, bool required = false) const;

  /// Name and value of every member.
  std::vector<std::pair<std::string, JsonPlace>> members() const;

  /// Scalar members. Absent ones give the default; a wrong type fails. Numbers are finite as float.
  std::string text(std::string_view key, std::string_view otherwise = "") const;
  bool flag(std::string_view key, bool otherwise = false) const;
  double number(std::string_view key, double otherwise) const;
  std::size_t size(std::string_view key, std::size_t otherwise) const;
  std::size_t requiredSize(std::string_view key) const;

  /// A reference to one of `count` things called `what` ("accessor"); -1 where absent.
  int index(std::string_view key, std::size_t count, std::string_view what) const;
  int requiredIndex(std::string_view key, std::size_t count, std::string_view what) const;

  /// This value itself, read as such a reference, number, string or whole number.
  int asIndex(std::size_t count, std::string_view what) const;
  double asNumber() const;
  std::string asText() const;
  std::size_t asSize() const;

  /// An array member of exactly `width` numbers, absent: false and `out` untouched.
  bool numbers(std::string_view key, std::size_t width, float* out) const;

 private:
  const nlohmann::json* value_;
  std::string path_;
};

}  // namespace rigel::tools
