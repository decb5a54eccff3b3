#include "pareto/pareto_front.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

namespace rigel::tests {
namespace {

using namespace rigel::tools;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<std::size_t> frontOf(const std::vector<CostAndError>& points) { return paretoFront(points); }

/// By the definition, pair by pair.
bool dominated(const std::vector<CostAndError>& points, std::size_t i) {
  for (const CostAndError& other : points) {
    if (!std::isfinite(other.cost) || !std::isfinite(other.error)) continue;
    const bool noWorse = other.cost <= points[i].cost && other.error <= points[i].error;
    if (noWorse && (other.cost < points[i].cost || other.error < points[i].error)) return true;
  }
  return false;
}

TEST(ParetoFront, LeavesOutWhatAnotherBeats) {
  EXPECT_THAT(frontOf({}), IsEmpty());
  EXPECT_THAT(frontOf({{1, 1}}), ElementsAre(0));
  EXPECT_THAT(frontOf({{3, 1}, {1, 3}, {2, 2}, {2, 3}, {4, 4}}), ElementsAre(1, 2, 0));
  // As cheap and worse, or as wrong and dearer, is beaten.
  EXPECT_THAT(frontOf({{1, 2}, {1, 1}}), ElementsAre(1));
  EXPECT_THAT(frontOf({{2, 1}, {1, 1}}), ElementsAre(1));
}

TEST(ParetoFront, EqualPointsAreOnItTogether) {
  EXPECT_THAT(frontOf({{1, 1}, {1, 1}, {2, 0.5}, {2, 0.5}, {2, 1}}), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(frontOf({{0, 0}, {-0.0, 0}}), ElementsAre(0, 1));
}

TEST(ParetoFront, WhatWasNotMeasuredIsNotOnItAndBeatsNothing) {
  EXPECT_THAT(frontOf({{kNan, 0}, {0, kNan}, {kNan, kNan}, {kInfinity, 0}, {0, kInfinity}, {-kInfinity, -kInfinity}}),
              IsEmpty());
  EXPECT_THAT(frontOf({{kNan, 0}, {5, 5}, {-kInfinity, 0}}), ElementsAre(1));
}

TEST(ParetoFront, IsWhatTheDefinitionSays) {
  std::mt19937 random(7);
  int onFront = 0;
  for (int round = 0; round < 300; ++round) {
    // Few values: ties are common.
    std::uniform_int_distribution<int> value(0, 1 + round % 20), count(0, 30);
    std::vector<CostAndError> points(static_cast<std::size_t>(count(random)));
    for (CostAndError& p : points) p = {double(value(random)), value(random) == 0 ? kNan : double(value(random))};
    std::vector<bool> expected;
    for (std::size_t i = 0; i < points.size(); ++i)
      expected.push_back(std::isfinite(points[i].error) && !dominated(points, i));
    std::vector<bool> actual(points.size(), false);
    const auto front = paretoFront(points);
    for (const std::size_t i : front) actual[i] = true;
    EXPECT_EQ(actual, expected) << "round " << round;
    for (std::size_t k = 1; k < front.size(); ++k) {
      EXPECT_LE(points[front[k - 1]].cost, points[front[k]].cost);
      EXPECT_GE(points[front[k - 1]].error, points[front[k]].error);
    }
    onFront += static_cast<int>(front.size());
  }
  EXPECT_GT(onFront, 500);
}

TEST(FrontDistance, IsTheLeastChangeOfEither) {
  const std::vector<CostAndError> others{{1, 8}, {2, 4}, {4, 2}, {kNan, 0}, {kInfinity, 0}};
  const auto distance = [&](double cost, double error) { return distanceToFront({cost, error}, others); };
  EXPECT_EQ(distance(2, 4).nearest(), 1);
  EXPECT_EQ(distance(3, 3).nearest(), 1);  // between two of them, beaten by neither
  EXPECT_EQ(distance(0.5, 100).nearest(), 1);
  const FrontDistance beaten = distance(3, 5);
  EXPECT_DOUBLE_EQ(beaten.cost, 1.5);
  EXPECT_DOUBLE_EQ(beaten.error, 1.25);
  EXPECT_DOUBLE_EQ(beaten.nearest(), 1.25);
  EXPECT_EQ(distanceToFront({1, 1}, {}).nearest(), 1);
}

TEST(FrontDistance, FromNoErrorAtAllIsInfinite) {
  const std::vector<CostAndError> others{{2, 0}};
  const FrontDistance d = distanceToFront({4, 1}, others);
  EXPECT_DOUBLE_EQ(d.cost, 2);
  EXPECT_EQ(d.error, kInfinity);
  EXPECT_DOUBLE_EQ(d.nearest(), 2);
  EXPECT_EQ(distanceToFront({2, 0}, others).nearest(), 1);
}

}  // namespace
}  // namespace rigel::tests
