#include "least_squares.h"

#include "rig_fixture.h"

#include <Eigen/Dense>

namespace rigel::test {
namespace {

struct Problem {
  Eigen::MatrixXd a;  // points x functions; column 0 is the constant
  std::vector<float> weights;
};

Problem randomProblem(std::mt19937& random, int points, int functions) {
  std::uniform_real_distribution<double> coordinate(-1, 1);
  Problem problem{Eigen::MatrixXd(points, functions), std::vector<float>(points)};
  float sum = 0;
  for (int s = 0; s < points; ++s) {
    for (int k = 0; k < functions; ++k) problem.a(s, k) = k == 0 ? 1 : coordinate(random);
    sum += problem.weights[s] = 0.2f + static_cast<float>(std::abs(coordinate(random)));
  }
  for (float& w : problem.weights) w /= sum;
  return problem;
}

/// P (functions x points) and the condition number as solve gives them.
std::pair<Eigen::MatrixXd, double> solve(const Problem& problem) {
  const int points = static_cast<int>(problem.a.rows());
  const int functions = static_cast<int>(problem.a.cols());
  LeastSquares fit(points, functions);
  for (int s = 0; s < points; ++s)
    for (int k = 0; k < functions; ++k) fit.row(s)[k] = problem.a(s, k);
  std::vector<double> constant(functions, 0);
  constant[0] = 1;
  std::vector<float> op(points * functions);
  const double condition = fit.solve(problem.weights, constant, op);
  Eigen::MatrixXd p(functions, points);
  for (int k = 0; k < functions; ++k)
    for (int s = 0; s < points; ++s) p(k, s) = op[k * points + s];
  return {p, condition};
}

TEST(LeastSquares, MatchesTheWeightedPseudoInverse) {
  std::mt19937 random(1);
  double worst = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const int functions = 1 + trial % 20;
    const Problem problem = randomProblem(random, 2 * functions + trial % 7, functions);
    const auto [p, condition] = solve(problem);
    const Eigen::VectorXd root =
        Eigen::Map<const Eigen::VectorXf>(problem.weights.data(), problem.a.rows()).cast<double>().cwiseSqrt();
    const Eigen::MatrixXd weighted = root.asDiagonal() * problem.a;
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(weighted, Eigen::ComputeThinU | Eigen::ComputeThinV);
    const Eigen::MatrixXd expected = svd.solve(Eigen::MatrixXd(root.asDiagonal()));
    worst = std::max(worst, (p - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff());
    const double trueCondition = svd.singularValues()(0) / svd.singularValues().tail(1)(0);
    EXPECT_LT(condition, 8 * trueCondition);
    EXPECT_GT(condition, trueCondition / 8);
  }
  // The pull (1e-6 of the diagonal) times the squared condition number of these problems; worst seen 3e-5.
  EXPECT_LT(worst, 1e-4);
}

TEST(LeastSquares, KeepsConstantsExactWhateverTheCondition) {
  // Three points cannot tell eight functions apart: P must stay finite and still map 1 to the constant function.
  std::mt19937 random(2);
  const Problem problem = randomProblem(random, 3, 8);
  const auto [p, condition] = solve(problem);
  EXPECT_TRUE(p.allFinite());
  const Eigen::VectorXd one = p.rowwise().sum();
  EXPECT_NEAR(one(0), 1, 1e-5);
  EXPECT_LT(one.tail(7).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_GT(condition, 100);
}

TEST(LeastSquares, IsContinuousThroughALossOfRank) {
  // Two columns become the same and part again: the fitted values must not jump.
  std::mt19937 random(3);
  Problem problem = randomProblem(random, 12, 4);
  const Eigen::VectorXd other = problem.a.col(3);
  Eigen::MatrixXd before;
  double worst = 0;
  for (int step = -200; step <= 200; ++step) {
    problem.a.col(3) = problem.a.col(2) + step * 1e-6 * other;
    const Eigen::MatrixXd fitted = problem.a * solve(problem).first;
    if (before.size() > 0) worst = std::max(worst, (fitted - before).cwiseAbs().maxCoeff());
    before = fitted;
  }
  EXPECT_LT(worst, 0.01);
}

}  // namespace
}  // namespace rigel::test
