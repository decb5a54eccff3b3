// G. Golub and J. Welsch, "Calculation of Gauss quadrature rules", 1969: nodes are the eigenvalues of the Jacobi matrix
// of the measure, weights the squares of the eigenvectors' first entries. The matrix comes from the Lanczos process on
// the measure's points (W. Gautschi, "Orthogonal Polynomials: Computation and Approximation", 2004, section 2.2), with
// full reorthogonalisation, so that clustered points do no harm.
#include "gauss_axis.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace rigel {
namespace {

constexpr double kEvenShare = 0.01;
constexpr double kLeastGap = 1e-4;  // between nodes: far less than 64 nodes of an even surface have (1e-3)
constexpr int kEvenPoints = 256;    // more than there are nodes

struct Measure {
  Eigen::VectorXd point, mass;  // mass sums to 1
};

Measure measureOf(std::span<const double> coordinates) {
  const auto count = static_cast<Eigen::Index>(coordinates.size());
  Measure measure{Eigen::VectorXd(count + kEvenPoints), Eigen::VectorXd(count + kEvenPoints)};
  for (Eigen::Index i = 0; i < count; ++i) measure.point(i) = std::clamp(coordinates[i], -1.0, 1.0);
  for (int i = 0; i < kEvenPoints; ++i) measure.point(count + i) = (2.0 * i + 1) / kEvenPoints - 1;
  measure.mass.head(count).setConstant((1 - kEvenShare) / static_cast<double>(count));
  measure.mass.tail(kEvenPoints).setConstant(kEvenShare / kEvenPoints);
  return measure;
}

/// Diagonal and subdiagonal of the Jacobi matrix.
std::pair<Eigen::VectorXd, Eigen::VectorXd> lanczos(const Measure& measure, int count) {
  Eigen::VectorXd diagonal(count);
  Eigen::VectorXd below(count);
  Eigen::MatrixXd basis(measure.point.size(), count);  // orthonormal polynomials at the points, times sqrt(mass)
  Eigen::VectorXd next = measure.mass.cwiseSqrt();
  for (int k = 0; k < count; ++k) {
    basis.col(k) = next.normalized();
    next = measure.point.cwiseProduct(basis.col(k));
    diagonal(k) = basis.col(k).dot(next);
    for (int twice = 0; twice < 2; ++twice)
      next -= basis.leftCols(k + 1) * (basis.leftCols(k + 1).transpose() * next).eval();
    below(k) = next.norm();
  }
  return {diagonal, below.head(count - 1)};
}

}  // namespace

GaussAxis::GaussAxis(std::span<const double> coordinates, int count) {
  const auto [diagonal, below] = lanczos(measureOf(coordinates), count);
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal, below);
  for (int i = 0; i < count; ++i) {
    const double apart = i > 0 ? node[i - 1] + kLeastGap : -1;
    node_.push_back(static_cast<float>(std::max(solver.eigenvalues()(i), apart)));
    node.push_back(static_cast<double>(node_[i]));
    weight.push_back(solver.eigenvectors()(0, i) * solver.eigenvectors()(0, i));
  }

  spread.assign(count, 0);
  std::vector<int> population(count, 0);
  for (double u : coordinates) {
    const auto nearest = std::ranges::min_element(node, {}, [u](double x) { return std::abs(x - u); }) - node.begin();
    spread[nearest] += (u - node[nearest]) * (u - node[nearest]);
    ++population[nearest];
  }
  for (int i = 0; i < count; ++i) spread[i] /= std::max(population[i], 1);

  for (int i = 0; i < count; ++i) {
    double scale = 1;
    for (int j = 0; j < count; ++j)
      if (j != i) scale *= node[i] - node[j];
    inverseScale_.push_back(static_cast<float>(1 / scale));
  }
}

void GaussAxis::lagrange(float u, std::span<float> out) const noexcept {
  // Products of the differences before and after each node: no division, so u may be a node.
  const int count = static_cast<int>(node_.size());
  float before = 1;
  for (int i = 0; i < count; ++i) {
    out[i] = before * inverseScale_[i];
    before *= u - node_[i];
  }
  float after = 1;
  for (int i = count - 1; i >= 0; --i) {
    out[i] *= after;
    after *= u - node_[i];
  }
}

}  // namespace rigel
