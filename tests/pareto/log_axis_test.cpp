#include "pareto/log_axis.h"

#include <gmock/gmock.h>

#include <limits>

namespace rigel::tests {
namespace {

using namespace rigel::tools;
using testing::DoubleEq;
using testing::ElementsAre;
using testing::Pointwise;

TEST(LogAxis, GoesFromEndToEnd) {
  const LogAxis axis{1, 100, 50, 250};
  EXPECT_DOUBLE_EQ(axis(1), 50);
  EXPECT_DOUBLE_EQ(axis(10), 150);
  EXPECT_DOUBLE_EQ(axis(100), 250);
}

TEST(LogAxis, TicksAreRoundAndNotTooMany) {
  EXPECT_THAT((LogAxis{0.9, 11, 0, 1}.ticks()), ElementsAre(1, 2, 5, 10));
  EXPECT_THAT((LogAxis{1, 1000, 0, 1}.ticks()), ElementsAre(1, 3, 10, 30, 100, 300, 1000));
  EXPECT_THAT((LogAxis{0.01, 1000, 0, 1}.ticks()), Pointwise(DoubleEq(), {0.01, 0.1, 1.0, 10.0, 100.0, 1000.0}));
}

TEST(LogAxis, HoldsWhatIsPositiveAndFinite) {
  const double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();
  const LogAxis axis = logAxis({kNan, 0, -3, 2, kInfinity, 8}, 2, 0, 1);
  EXPECT_DOUBLE_EQ(axis.low, 1);
  EXPECT_DOUBLE_EQ(axis.high, 16);
  const LogAxis empty = logAxis({0, kNan}, 2, 0, 1);
  EXPECT_NEAR(empty.high / empty.low, 10, 1e-12);
  EXPECT_NEAR(empty(1), 0.5, 1e-12);
  const LogAxis single = logAxis({5}, 2, 0, 1);
  EXPECT_NEAR(single(5), 0.5, 1e-12);
}

}  // namespace
}  // namespace rigel::tests
