#include "gpu/rig_reference.h"

#include "gpu/packed_rig.h"

#include <algorithm>
#include <cmath>

namespace rigel::test {
namespace {

double wide(float x) { return static_cast<double>(x); }

/// Catmull-Rom's cardinal function at distance x of its node.
double catmullRom(double x) {
  x = std::abs(x);
  if (x >= 2) return 0;
  return x < 1 ? 1 - 2.5 * x * x + 1.5 * x * x * x : 2 - 4 * x + 2.5 * x * x - 0.5 * x * x * x;
}

}  // namespace

RigReference::RigReference(const Rig& rig, const RigFrame& worldFromRig)
    : rig_(rig), frame_(worldFromRig), gaussNodes_(packGaussNodesBound(rig)) {
  std::vector<GpuVec4> none(packRigBound(rig, 2));
  packed_ = packRig<2>(rig, worldFromRig, {}, {}, {}, std::span<GpuVec4>(none));
  packGaussNodes(rig, gaussNodes_);
}

std::array<RigReference::Point, 2> RigReference::coordinates(Vec3 world) const {
  const std::array<Vec3, 3> columns{frame_.x, frame_.y, frame_.z};
  std::array<double, 3> centre{};
  for (int i = 0; i < 3; ++i) {
    centre[i] = wide(frame_.origin[i]);
    for (int a = 0; a < 3; ++a)
      centre[i] += wide(columns[a][i]) * (wide(rig_.box().lo[a]) + wide(rig_.box().hi[a])) / 2;
  }
  std::array<Point, 2> out{};
  for (int a = 0; a < 3; ++a) {
    const double half = (wide(rig_.box().hi[a]) - wide(rig_.box().lo[a])) / 2;
    if (half <= 1e-30) continue;
    for (int i = 0; i < 3; ++i) {
      const double term = wide(columns[a][i]) * (wide(world[i]) - centre[i]) / half;
      out[0][a] += term;
      out[1][a] += std::abs(term);
    }
    if (std::isnan(out[0][a])) out[0][a] = out[1][a] = 0;
  }
  return out;
}

RigReference::Basis RigReference::at(Vec3 world) const {
  const auto [u, absolute] = coordinates(world);
  return rig_.spec().family == RigSpec::Family::poly ? poly(u, absolute) : tensor(u, absolute);
}

RigReference::Basis RigReference::poly(const Point& u, const Point& absolute) const {
  double q = 1, sum = 1;
  if (rig_.spec().falloff) {
    Point v, w;  // held to the box; what is beyond it is 1 however it was rounded
    for (int a = 0; a < 3; ++a) {
      v[a] = std::clamp(u[a], -1.0, 1.0);
      w[a] = std::abs(u[a]) > 1 + 1e-5 * absolute[a] ? 1 : absolute[a];
    }
    const auto monomials = [](const Point& x) {
      return std::array{x[0] * x[0], x[1] * x[1], x[2] * x[2], x[0] * x[1], x[0] * x[2],
                        x[1] * x[2], x[0],        x[1],        x[2],        1.0};
    };
    const std::array<double, 10> monomial = monomials(v), size = monomials(w);
    q = sum = 0;
    for (int i = 0; i < 10; ++i) {
      const double c = wide((&packed_.falloff[0].x)[i]);
      q += c * monomial[i];
      sum += std::abs(c) * size[i];
    }
  }
  Basis out;
  for (int k = 0; k < rig_.shVectors(); ++k) {
    double value = 1, size = 1;
    for (int j = k; j > 0; j = termOf(packed_, j) / 4) {
      value *= u[termOf(packed_, j) % 4];
      size *= absolute[termOf(packed_, j) % 4];
    }
    out.value.push_back(value / q);
    out.absolute.push_back(size * sum / (q * q));
  }
  return out;
}

std::vector<double> RigReference::axisWeights(int axis, double u) const {
  const int nodes = rig_.axes()[axis].nodes;
  const double v = std::clamp(u, -1.0, 1.0);
  std::vector<double> out(nodes);
  if (!gaussNodes_.empty()) {
    std::size_t first = 0;
    for (int a = 0; a < axis; ++a) first += static_cast<std::size_t>(rig_.axes()[a].nodes + 1) / 2;
    const auto node = [&](int i) {
      const GpuVec4& pair = gaussNodes_[first + static_cast<std::size_t>(i) / 2];
      return wide(i % 2 == 0 ? pair.x : pair.z);
    };
    for (int i = 0; i < nodes; ++i) {
      out[i] = 1;
      for (int j = 0; j < nodes; ++j)
        if (j != i) out[i] *= (v - node(j)) / (node(i) - node(j));
    }
    return out;
  }
  if (nodes == 1) return {1};
  const double x = (v + 1) / 2 * (nodes - 1);
  const auto add = [&](int i, double w) {
    // Beyond the ends the nodes go on in a straight line.
    const int last = nodes - 1;
    if (i < 0) {
      out[0] += 2 * w;
      out[1] -= w;
    } else if (i > last) {
      out[last] += 2 * w;
      out[last - 1] -= w;
    } else {
      out[i] += w;
    }
  };
  for (int i = -1; i <= nodes; ++i) {
    const double distance = std::abs(x - i);
    switch (rig_.spec().kernel) {
      case LatticeKernel::linear:
        if (i >= 0 && i < nodes) add(i, std::max(0.0, 1 - distance));
        break;
      case LatticeKernel::smooth:
        if (i >= 0 && i < nodes && distance < 1) add(i, 1 - distance * distance * (3 - 2 * distance));
        break;
      case LatticeKernel::cubic:
        add(i, catmullRom(x - i));
        break;
    }
  }
  return out;
}

RigReference::Basis RigReference::tensor(const Point& u, const Point& absolute) const {
  // A weight's terms are its own and, to first order, those of the coordinate that it depends on, which counts from -1:
  // its steepest slope as far as the coordinate's rounding reaches, which may be beyond a kink.
  constexpr double kStep = 1e-5, kRounding = 0x1p-21;
  std::array<std::vector<double>, 3> w, size;
  for (int a = 0; a < 3; ++a) {
    w[a] = axisWeights(a, u[a]);
    const double terms = 1 + absolute[a], step = std::max(kStep, kRounding * terms);
    const std::vector<double> before = axisWeights(a, u[a] - step), after = axisWeights(a, u[a] + step);
    for (std::size_t i = 0; i < w[a].size(); ++i) {
      const double slope = std::max(std::abs(after[i] - w[a][i]), std::abs(w[a][i] - before[i])) / step;
      size[a].push_back(std::abs(w[a][i]) + slope * terms);
    }
  }
  Basis out;
  for (std::size_t k = 0; k < w[2].size(); ++k)
    for (std::size_t j = 0; j < w[1].size(); ++j)
      for (std::size_t i = 0; i < w[0].size(); ++i) {
        const double b = w[2][k] * w[1][j] * w[0][i], sizeOfB = size[2][k] * size[1][j] * size[0][i];
        out.value.push_back(b);
        out.absolute.push_back(sizeOfB);
        for (int a = 0; a < 3; ++a) {
          if (rig_.axes()[a].kind != AxisModel::Kind::gradient) continue;
          out.value.push_back(b * u[a]);
          out.absolute.push_back(sizeOfB * absolute[a]);
        }
      }
  return out;
}

}  // namespace rigel::test
