// The worst of many comparisons, with the input it came from. Zero comparisons are a failure, NaN is worse than all.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <limits>
#include <string>

namespace rigel::reference {

class Worst {
 public:
  explicit Worst(std::string what) : what_(std::move(what)) {}

  /// `describe()` gives the input and both values; it is called only for a new worst error.
  template <class Describe>
  void add(double error, const Describe& describe) {
    ++count_;
    if (error <= error_) return;
    error_ = error == error ? error : std::numeric_limits<double>::infinity();
    where_ = describe();
  }

  double error() const { return error_; }

  void expectWithin(double tolerance) const {
    EXPECT_GT(count_, 0) << what_ << ": nothing was compared";
    EXPECT_LE(error_, tolerance) << what_ << ", worst of " << count_ << ":\n" << where_;
    std::printf("  %s: worst of %ld is %.2g, tolerance %.2g\n", what_.c_str(), count_, error_, tolerance);
  }

 private:
  std::string what_;
  std::string where_;
  double error_ = -1;
  long count_ = 0;
};

}  // namespace rigel::reference
