#include "lattice_kernel.h"

#include "basis_rows.h"
#include "lights/every_target.h"
#include "rig_fixture.h"

namespace rigel::test {
namespace {

constexpr LatticeKernel kAll[] = {LatticeKernel::linear, LatticeKernel::smooth, LatticeKernel::cubic};

/// Interpolates node values f(i) at u.
template <class F>
float interpolate(LatticeKernel kernel, int nodes, float u, F f) {
  const AxisWeights w = axisWeights(kernel, nodes, u);
  float sum = 0;
  for (int i = 0; i < w.count; ++i) {
    EXPECT_GE(w.first + i, 0);
    EXPECT_LT(w.first + i, nodes);
    sum += w.weight[i] * f(w.first + i);
  }
  return sum;
}

TEST(LatticeKernel, IsAPartitionOfUnityInsideAndOutside) {
  for (LatticeKernel kernel : kAll)
    for (int nodes : {1, 2, 3, 5, 8})
      for (float u = -1.5f; u <= 1.5f; u += 0.01f)
        ASSERT_NEAR(interpolate(kernel, nodes, u, [](int) { return 1.0f; }), 1, 1e-6f) << nodes << " nodes at " << u;
}

// Many points in vectors, and what is left of a vector.
TEST(LatticeKernel, RowsOfWeightsAreThoseOfPoints) {
  std::vector<float> u;
  for (int i = 0; i < 147; ++i) u.push_back(-1.5f + 0.0207f * static_cast<float>(i));
  for (const float hard : {-1.0f, 0.0f, 1.0f, -1e30f, 1e30f}) u.push_back(hard);
  onEveryTarget([&] {
    for (const bool smooth : {false, true})
      for (const int nodes : {2, 3, 5, 8}) {
        std::vector<float> rows(static_cast<std::size_t>(nodes) * u.size());
        basisrows::hats(nodes, smooth, u.data(), u.size(), rows.data());
        for (std::size_t i = 0; i < u.size(); ++i) {
          std::vector<float> expected(static_cast<std::size_t>(nodes));
          const AxisWeights w = axisWeights(smooth ? LatticeKernel::smooth : LatticeKernel::linear, nodes, u[i]);
          for (int k = 0; k < w.count; ++k) expected[static_cast<std::size_t>(w.first + k)] = w.weight[k];
          for (std::size_t node = 0; node < expected.size(); ++node)
            ASSERT_NEAR(rows[node * u.size() + i], expected[node], 2e-7f) << "node " << node << " at " << u[i];
        }
      }
  });
}

TEST(LatticeKernel, InterpolatesItsNodes) {
  for (LatticeKernel kernel : kAll)
    for (int nodes : {2, 3, 5, 8})
      for (int n = 0; n < nodes; ++n) {
        const float u = 2 * static_cast<float>(n) / static_cast<float>(nodes - 1) - 1;
        EXPECT_NEAR(interpolate(kernel, nodes, u, [&](int i) { return i == n ? 1.0f : 0.0f; }), 1, 1e-5f);
      }
}

TEST(LatticeKernel, LinearAndCubicReproduceStraightLines) {
  for (LatticeKernel kernel : {LatticeKernel::linear, LatticeKernel::cubic})
    for (int nodes : {2, 3, 5, 8})
      for (float u = -1; u <= 1; u += 0.01f)
        ASSERT_NEAR(interpolate(kernel, nodes, u,
                                [&](int i) { return 2 * static_cast<float>(i) / static_cast<float>(nodes - 1) - 1; }),
                    u, 2e-6f);
}

TEST(LatticeKernel, IsContinuousAcrossNodes) {
  const auto bumpy = [](int i) { return static_cast<float>(i * i % 3); };
  for (LatticeKernel kernel : kAll) {
    float before = interpolate(kernel, 5, -1, bumpy);
    for (float u = -1; u <= 1; u += 1e-3f) {
      const float now = interpolate(kernel, 5, u, bumpy);
      ASSERT_LT(std::abs(now - before), 0.02f) << u;  // steepest slope 2 a cell, times 1.5 for smooth, times the step
      before = now;
    }
  }
}

}  // namespace
}  // namespace rigel::test
