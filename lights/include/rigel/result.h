// Result<T>: a value, or what was wrong with data from outside (files, command lines, specs). Bugs are asserts instead.
#pragma once

#include <string>
#include <utility>
#include <variant>

namespace rigel {

/// What was wrong and where. `place` names the thing at fault (file, node, spec); `message` the cause. One line each.
struct Error {
  std::string message;
  std::string place;

  /// "place: message", or the message alone.
  std::string line() const { return place.empty() ? message : place + ": " + message; }
};

template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}      // NOLINT(google-explicit-constructor)
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT(google-explicit-constructor)

  explicit operator bool() const noexcept { return state_.index() == 0; }
  T& operator*() & { return std::get<0>(state_); }
  const T& operator*() const& { return std::get<0>(state_); }
  T&& operator*() && { return std::get<0>(std::move(state_)); }
  T* operator->() { return &std::get<0>(state_); }
  const T* operator->() const { return &std::get<0>(state_); }
  const Error& error() const { return std::get<1>(state_); }

 private:
  std::variant<T, Error> state_;
};

}  // namespace rigel
