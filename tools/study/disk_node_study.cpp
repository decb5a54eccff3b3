// Where the nodes of shader_disk.h come from: of all rules of so many nodes, one of them at psi = 0 and exact for
// 1, cos 2 psi and cos 4 psi, that whose largest error over all cones is least. `rigel_disk_node_study NODES STARTS`
// prints it; from each of the random starts a p-norm of the errors is minimised by Gauss-Newton, for growing p.
#include <fmt/core.h>
#include <rigel/disk.h>
#include <rigel/sh.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

namespace rigel {
namespace {

// Asked for at the rim: the tolerance grows by kNearer from 1e-2 to 1e-3 radii, and nearer is not looked at.
constexpr double kRim = 1e-2, kNearestRim = 1e-3, kNearer = 6;

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Sample {
  detail::DiskCone<double> cone;
  VectorXd exact;                     // the integrals: q00, q20, q22, q40, q42, q44
  double perNorm3 = 0, perNorm5 = 0;  // over ||q|| of 3 and 5 bands and the tolerance
  double rim = 0;
};

VectorXd integralsOf(const detail::DiskMoments<double>& q) {
  VectorXd out(6);
  out << q.q00, q.q20, q.q22, q.q40, q.q42, q.q44;
  return out;
}

void add(std::vector<Sample>& samples, double rho, double z) {
  Sample sample;
  sample.rim = std::hypot(rho - 1, z);
  if (sample.rim < 0.999 * kNearestRim) return;
  sample.cone = detail::diskCone(rho, (rho - 1) * (rho + 1) + z * z, z);
  const detail::DiskMoments<double> q = detail::exactDiskMoments(sample.cone);
  sample.exact = integralsOf(q);
  const double norm3 = std::hypot(kRigelY1, sample.exact.head(3).norm());
  const double norm5 = std::hypot(kRigelY1, sample.exact.norm(), std::hypot(q.q30, q.q32));
  const double tolerance = std::pow(std::max(1.0, kRim / sample.rim), std::log(kNearer) / std::log(kRim / kNearestRim));
  sample.perNorm3 = 1 / (norm3 * tolerance);
  sample.perNorm5 = 1 / (norm5 * tolerance);
  samples.push_back(sample);
}

/// All angles at all distances from the rim, and at all distances from the disk.
std::vector<Sample> samplesOfAllPoses() {
  std::vector<Sample> samples;
  for (double gap = kNearestRim; gap < 2; gap *= 1.4) {
    for (int k = 0; k < 40; ++k) {
      const double angle = M_PI * (k + 0.1) / 39.2;
      add(samples, std::abs(1 + gap * std::cos(angle)), gap * std::sin(angle));
    }
  }
  for (double d = 1e-3; d < 100; d *= 1.6) {
    for (int k = 0; k < 12; ++k) {
      const double angle = 0.5 * M_PI * (k + 0.3) / 12;
      add(samples, d * std::sin(angle), d * std::cos(angle));
    }
  }
  return samples;
}

struct Rule {
  VectorXd psi, weight;
};

/// x: psi of all nodes but the first, then weights, which are changed as little as exactness asks for.
Rule ruleOf(const VectorXd& x) {
  const Eigen::Index n = (x.size() + 1) / 2;
  Rule rule{VectorXd::Zero(n), x.tail(n)};
  rule.psi.tail(n - 1) = x.head(n - 1);
  MatrixXd conditions(3, n);
  conditions.row(0).setOnes();
  conditions.row(1) = (2 * rule.psi).array().cos();
  conditions.row(2) = (4 * rule.psi).array().cos();
  const VectorXd missed = conditions * rule.weight - VectorXd::Unit(3, 0);
  rule.weight -= conditions.transpose() * (conditions * conditions.transpose()).ldlt().solve(missed);
  return rule;
}

/// One row a sample: errors of the integrals over ||q||, as 5 bands and as 3.
MatrixXd errorsOf(const Rule& rule, const std::vector<Sample>& samples) {
  MatrixXd errors(samples.size(), 9);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const Sample& sample = samples[k];
    detail::DiskSums<double> sums = detail::diskSums(0.0);
    for (Eigen::Index i = 0; i < rule.psi.size(); ++i) {
      const double cosine = std::cos(rule.psi[i]);
      const auto node = detail::diskNode(sample.cone, rule.weight[i], cosine * cosine);
      detail::addDiskNode<kMaxBands>(sums, node, 1 / (1 + node.c));
    }
    const VectorXd error = integralsOf(detail::diskMomentsOf<kMaxBands>(sums, sample.cone)) - sample.exact;
    errors.row(static_cast<Eigen::Index>(k)) << (error * sample.perNorm5).transpose(),
        (error.head(3) * sample.perNorm3).transpose();
  }
  return errors;
}

VectorXd sizesOf(const MatrixXd& errors) {
  return errors.leftCols(6).rowwise().norm().cwiseMax(errors.rightCols(3).rowwise().norm());
}

double logNorm(const VectorXd& sizes, double p) {
  const double largest = sizes.maxCoeff();
  return std::log(largest) + std::log((sizes / largest).array().pow(p).sum()) / p;
}

/// A step of reweighted least squares, damped until the p-norm falls; false where it no longer does.
bool improve(VectorXd& x, double p, double& damping, const std::vector<Sample>& samples) {
  const MatrixXd errors = errorsOf(ruleOf(x), samples);
  const VectorXd sizes = sizesOf(errors);
  MatrixXd slope(errors.size(), x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    constexpr double kStep = 1e-6;
    slope.col(i) = ((errorsOf(ruleOf(x + kStep * VectorXd::Unit(x.size(), i)), samples) - errors) / kStep).reshaped();
  }
  const VectorXd weights =
      (sizes / sizes.maxCoeff()).array().max(1e-9).pow(p - 2).matrix().replicate(1, errors.cols()).reshaped();
  const MatrixXd normal = slope.transpose() * weights.asDiagonal() * slope;
  const VectorXd right = -slope.transpose() * (weights.asDiagonal() * errors.reshaped()) / (p - 1);
  for (int attempt = 0; attempt < 12; ++attempt, damping *= 4) {
    MatrixXd damped = normal;
    damped.diagonal() *= 1 + damping;
    damped.diagonal().array() += 1e-14 * normal.diagonal().maxCoeff();
    const VectorXd next = x + damped.ldlt().solve(right);
    if ((next.array() <= 0).any()) continue;
    if (logNorm(sizesOf(errorsOf(ruleOf(next), samples)), p) < logNorm(sizes, p) - 1e-10) {
      x = next;
      damping *= 0.3;
      return true;
    }
  }
  return false;
}

/// Nodes that crowd towards psi = pi/2, with the weights of the trapezium rule.
VectorXd randomStart(Eigen::Index n, std::mt19937_64& engine) {
  std::uniform_real_distribution<double> uniform;
  const double power = 1 / (0.3 + 0.7 * uniform(engine));
  VectorXd psi = VectorXd::Zero(n + 1);
  for (Eigen::Index i = 1; i < n; ++i) {
    const double t = static_cast<double>(i) / (static_cast<double>(n) - 0.2 - 0.3 * uniform(engine));
    psi[i] = 0.5 * M_PI * (1 - std::pow(1 - t, power));
  }
  psi[n] = 0.5 * M_PI;
  VectorXd x(2 * n - 1);
  x.head(n - 1) = psi.segment(1, n - 1);
  for (Eigen::Index i = 0; i < n; ++i) x[n - 1 + i] = (psi[i + 1] - psi[std::max<Eigen::Index>(i - 1, 0)]) / M_PI;
  return x;
}

void run(int nodes, int starts) {
  const std::vector<Sample> samples = samplesOfAllPoses();
  std::mt19937_64 engine(1);
  VectorXd best;
  double least = std::numeric_limits<double>::infinity();
  for (int start = 0; start < starts; ++start) {
    VectorXd x = randomStart(nodes, engine);
    double damping = 1e-3;
    for (double p = 2; p < 50; p = p < 8 ? p + 1 : p * 1.4) {
      for (int step = 0; step < 25 && improve(x, p, damping, samples); ++step) damping = std::max(damping, 1e-12);
      const double largest = sizesOf(errorsOf(ruleOf(x), samples)).maxCoeff();
      if (largest < least) {
        least = largest;
        best = x;
      }
      damping = 1e-3;
    }
  }
  const Rule rule = ruleOf(best);
  fmt::print("{} nodes, largest error {:.2g} of ||q||, rim {} R away and more\n", nodes, least, kRim);
  for (Eigen::Index i = 0; i < nodes; ++i) {
    const double cosine = std::cos(rule.psi[i]);
    fmt::print("  psi {:.16f}  weight {:.16f}  cos^2 {:.16f}\n", rule.psi[i], rule.weight[i], cosine * cosine);
  }
}

}  // namespace
}  // namespace rigel

int main(int count, char** arguments) {
  const int nodes = count > 1 ? std::atoi(arguments[1]) : 6;
  const int starts = count > 2 ? std::atoi(arguments[2]) : 20;
  if (nodes < 4 || nodes > 12 || starts < 1) {
    fmt::print(stderr, "usage: rigel_disk_node_study NODES STARTS, 4 to 12 nodes\n");
    return 2;
  }
  rigel::run(nodes, starts);
  return 0;
}
