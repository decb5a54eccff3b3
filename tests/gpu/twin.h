// A shader function beside its C++ twin: both against double precision, the shader allowed at most twice the twin's
// error.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <string>
#include <type_traits>
#include <utility>

#include "lights/random.h"

namespace rigel::test {

class TwinCheck {
 public:
  explicit TwinCheck(std::string name) : name_(std::move(name)) {}

  /// One number: the shader's, the twin's, the truth, and the sum of the absolute values of the terms that add up to
  /// the truth, which errors are relative to. `describe`: the inputs, a string or a function that returns one (called
  /// for the worst alone).
  template <class Describe>
  void add(float gpuValue, float twinValue, double exactValue, double sumOfAbsoluteTerms, const Describe& describe) {
    ++comparisons_;
    twin_.take(relativeError(twinValue, exactValue, sumOfAbsoluteTerms), twinValue, exactValue, describe);
    gpu_.take(relativeError(gpuValue, exactValue, sumOfAbsoluteTerms), gpuValue, exactValue, describe);
  }

  // Where the twin happens to hit the truth, the shader may still round its result once.
  static constexpr double kHalfUlp = 0x1p-24;

  /// Fails when nothing was compared, or the shader's worst error is beyond both twice the twin's worst and `rounding`:
  /// more than the default is for shaders that have float where the twin has double. Prints both.
  void expectWithinTwice(double rounding = kHalfUlp) const {
    print();
    checkWithinTwice(rounding);
  }

  void print() const {
    std::printf("%s: worst relative error %.3g (shader), %.3g (C++), of %lld numbers\n", name_.c_str(), gpu_.error,
                twin_.error, comparisons_);
  }

  /// expectWithinTwice without a word where all is well.
  void checkWithinTwice(double rounding = kHalfUlp) const {
    EXPECT_GT(comparisons_, 0) << name_ << ": nothing was compared";
    EXPECT_TRUE(std::isfinite(twin_.error)) << name_ << ": the twin fails: " << twin_.text();
    EXPECT_LE(gpu_.error, std::max(2 * twin_.error, rounding))
        << name_ << "\n  shader: " << gpu_.text() << "\n  C++: " << twin_.text();
  }

  double gpuError() const { return gpu_.error; }
  double twinError() const { return twin_.error; }
  long long comparisons() const { return comparisons_; }

  /// |value - exact| / sum. The same infinity, or NaN for NaN, is no error; a finite number for either, or the reverse,
  /// an infinite one, as is a difference where all terms are zero.
  static double relativeError(float value, double exact, double sum) {
    if (std::isnan(exact)) return std::isnan(value) ? 0 : std::numeric_limits<double>::infinity();
    if (static_cast<double>(value) == exact) return 0;
    const double error = std::abs(static_cast<double>(value) - exact) / sum;
    return std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
  }

 private:
  struct Worst {
    double error = 0, exact = 0;
    float value = 0;
    std::string inputs;

    template <class Describe>
    void take(double newError, float newValue, double newExact, const Describe& describe) {
      if (newError <= error) return;
      error = newError;
      value = newValue;
      exact = newExact;
      if constexpr (std::is_invocable_v<Describe>)
        inputs = describe();
      else
        inputs = describe;
    }
    std::string text() const {
      char numbers[128];
      std::snprintf(numbers, sizeof(numbers), "%.9g instead of %.17g (%.3g) at ", static_cast<double>(value), exact,
                    error);
      return numbers + inputs;
    }
  };

  std::string name_;
  Worst gpu_, twin_;
  long long comparisons_ = 0;
};

/// A function over families of inputs that differ in kind, each checked apart: pooled, the twin's worst error in one
/// would hide a bad shader in another.
class TwinFamilies {
 public:
  explicit TwinFamilies(std::string function) : function_(std::move(function)) {}

  TwinCheck& operator[](const std::string& family) {
    return families_.try_emplace(family, function_ + ", " + family).first->second;
  }

  /// As TwinCheck's, of every family. Prints a line: the worst of all, and the family that is the closest to failing;
  /// with RIGEL_FULL=1 a line a family.
  void expectWithinTwice(double rounding = TwinCheck::kHalfUlp) const {
    EXPECT_FALSE(families_.empty()) << function_ << ": nothing was compared";
    const TwinCheck* closest = nullptr;
    std::string family;
    double error = 0, twinError = 0, leastRoom = -1;
    long long comparisons = 0;
    for (const auto& [name, check] : families_) {
      check.checkWithinTwice(rounding);
      if (fullRun()) check.print();
      error = std::max(error, check.gpuError());
      twinError = std::max(twinError, check.twinError());
      comparisons += check.comparisons();
      const double room = check.gpuError() / std::max(2 * check.twinError(), rounding);
      if (room <= leastRoom) continue;
      leastRoom = room;
      closest = &check;
      family = name;
    }
    if (closest == nullptr) return;
    std::printf("%s: worst %.3g (shader), %.3g (C++), of %lld numbers in %zu families; least room: %s, %.3g and %.3g\n",
                function_.c_str(), error, twinError, comparisons, families_.size(), family.c_str(), closest->gpuError(),
                closest->twinError());
  }

  double gpuError() const {
    double error = 0;
    for (const auto& [name, check] : families_) error = std::max(error, check.gpuError());
    return error;
  }

 private:
  std::string function_;
  std::map<std::string, TwinCheck> families_;
};

}  // namespace rigel::test
