// Histograms and body parts of errors, against sorted lists and sums over all of them.
#include "report/measure/error_spread.h"

#include "whole_run.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace rigel::tests {
namespace {

using namespace rigel::tools;

constexpr double kMean = 2.5;
// The tally's steps are 1/128 of an octave's start wide.
constexpr double kStep = 1.0 / 128;

std::vector<std::vector<Rgb>> randomErrors(std::size_t points, int frames) {
  std::mt19937 random(7);
  std::normal_distribution<float> size(-3, 2), shift(0.2f, 1);
  std::vector<std::vector<Rgb>> out;
  for (int f = 0; f < frames; ++f)
    for (auto& error : out.emplace_back(points))
      for (int c = 0; c < 3; ++c) error[c] = shift(random) * std::exp(size(random));
  return out;
}

TEST(ErrorSpread, CountsAndPercentilesAreThoseOfTheList) {
  ErrorSpread spread;
  std::vector<double> all;
  for (const auto& frame : randomErrors(500, 6)) {
    spread.add(frame);
    for (const Rgb& error : frame)
      for (int c = 0; c < 3; ++c) all.push_back(static_cast<double>(error[c]) / kMean);
  }
  const ErrorHistogram histogram = spread.histogram(kMean);
  EXPECT_EQ(std::accumulate(histogram.absolute.begin(), histogram.absolute.end(), std::uint64_t{0}), all.size());
  EXPECT_EQ(std::accumulate(histogram.signedBins.begin(), histogram.signedBins.end(), std::uint64_t{0}) +
                histogram.below + histogram.above,
            all.size());
  std::vector<double> sizes;
  for (const double error : all) sizes.push_back(std::abs(error));
  std::ranges::sort(sizes);
  const auto at = [&](double share) {
    return sizes[static_cast<std::size_t>(share * static_cast<double>(all.size()))];
  };
  EXPECT_NEAR(histogram.p50, at(0.5), 1.5 * kStep * at(0.5));
  EXPECT_NEAR(histogram.p90, at(0.9), 1.5 * kStep * at(0.9));
  EXPECT_NEAR(histogram.p99, at(0.99), 1.5 * kStep * at(0.99));
  EXPECT_EQ(histogram.limit, histogram.p99);
  // Cumulated, no bin is wrong by more than what lies within a step of its end.
  double below = 0;
  for (int bin = 0; bin + 1 < ErrorHistogram::kAbsoluteBins; ++bin) {
    below += static_cast<double>(histogram.absolute[static_cast<std::size_t>(bin)]);
    const double end = ErrorHistogram::kLeast * std::pow(10, (bin + 1.0) / ErrorHistogram::kPerDecade);
    const auto under = [&](double x) {
      return static_cast<double>(std::ranges::lower_bound(sizes, x) - sizes.begin());
    };
    EXPECT_GE(below, under(end * (1 - kStep))) << bin;
    EXPECT_LE(below, under(end * (1 + kStep))) << bin;
  }
  const auto positive = std::ranges::count_if(all, [&](double e) { return e > histogram.limit; });
  EXPECT_NEAR(static_cast<double>(histogram.above), static_cast<double>(positive),
              0.002 * static_cast<double>(all.size()));
  const double right = std::accumulate(histogram.signedBins.begin() + ErrorHistogram::kSignedBins / 2 + 1,
                                       histogram.signedBins.end(), 0.0);
  const double width = 2 * histogram.limit / ErrorHistogram::kSignedBins;
  const auto expected = std::ranges::count_if(all, [&](double e) { return e > width / 2 && e <= histogram.limit; });
  EXPECT_NEAR(right, static_cast<double>(expected), 0.005 * static_cast<double>(all.size()));
}

TEST(ErrorSpread, NoErrorAtAll) {
  ErrorSpread spread;
  spread.add(std::vector<Rgb>(4));
  const ErrorHistogram histogram = spread.histogram(kMean);
  EXPECT_EQ(histogram.absolute[0], 12u);
  EXPECT_EQ(histogram.signedBins[ErrorHistogram::kSignedBins / 2], 12u);
  EXPECT_EQ(histogram.p99, 0);
  const auto parts = spread.bodyParts({{{"all", -1, 1}}, {0, 0, 0, 0}}, kMean);
  EXPECT_EQ(parts.at(0).share, 0);
  EXPECT_EQ(parts.at(0).rms, 0);
}

TEST(ErrorSpread, BodyPartsAddUp) {
  ErrorSpread spread;
  const BodyParts parts{{{"hips", -1, 1}, {"arm", 0, 3}}, {0, 1, 1, 0, 1, 1, 1, 0, 0, 1}};
  double squares[2] = {}, sums[2] = {}, largest[2] = {};
  for (const auto& frame : randomErrors(10, 3)) {
    spread.add(frame);
    for (std::size_t i = 0; i < frame.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        const double error = static_cast<double>(frame[i][c]) / kMean;
        const int part = parts.ofSample[i];
        squares[part] += error * error;
        sums[part] += error;
        largest[part] = std::max(largest[part], std::abs(error));
      }
  }
  const auto out = spread.bodyParts(parts, kMean);
  ASSERT_EQ(out.size(), 2u);
  const double counts[2] = {4 * 9, 6 * 9};
  for (int k = 0; k < 2; ++k) {
    const BodyPartErrors& part = out[static_cast<std::size_t>(k)];
    EXPECT_NEAR(part.rms, std::sqrt(squares[k] / counts[k]), 1e-12 * part.rms);
    EXPECT_NEAR(part.mean, sums[k] / counts[k], 1e-12);
    EXPECT_NEAR(part.max, largest[k], 1e-12);
    EXPECT_NEAR(part.share, squares[k] / (squares[0] + squares[1]), 1e-12);
  }
  EXPECT_EQ(out[0].samples, 4u);
  EXPECT_DOUBLE_EQ(out[1].area, 0.6);
  EXPECT_EQ(out[1].parent, 0);
  EXPECT_EQ(out[1].nodes, 3);
}

/// Nodes without samples but the last of each branch, as deep as asked.
Scene comb(int teeth, int depth, SceneObject& object) {
  Scene scene;
  Mesh mesh;
  Primitive triangle;
  triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  triangle.triangles = {{0, 1, 2}};
  mesh.primitives = {triangle};
  scene.meshes = {mesh};
  scene.nodes.emplace_back().name = "root";
  scene.roots = {0};
  for (int tooth = 0; tooth < teeth; ++tooth) {
    int parent = 0;
    for (int k = 0; k < depth; ++k) {
      const int node = static_cast<int>(scene.nodes.size());
      scene.nodes.emplace_back().parent = parent;
      scene.nodes[static_cast<std::size_t>(parent)].children.push_back(node);
      parent = node;
    }
    scene.nodes.back().mesh = 0;
    scene.nodes.back().name = "tooth " + std::to_string(tooth);
    object.meshNodes.push_back(static_cast<int>(scene.nodes.size()) - 1);
    const auto base = static_cast<glm::uint>(object.vertexCount);
    object.triangles.push_back({base, base + 1, base + 2});
    object.vertexCount += 3;
  }
  return scene;
}

std::vector<SurfacePoint> samplesOf(const SceneObject& object, int each) {
  std::vector<SurfacePoint> out;
  for (std::uint32_t t = 0; t < object.triangles.size(); ++t) out.insert(out.end(), each, SurfacePoint{t, 0.3f, 0.3f});
  return out;
}

TEST(BodyParts, FewNodesAreOnePartEach) {
  SceneObject object;
  const Scene scene = comb(5, 2, object);
  const BodyParts parts = findBodyParts(scene, object, samplesOf(object, 20));
  ASSERT_EQ(parts.parts.size(), 5u);
  for (int tooth = 0; tooth < 5; ++tooth) {
    EXPECT_EQ(parts.parts[static_cast<std::size_t>(tooth)].name, "tooth " + std::to_string(tooth));
    EXPECT_EQ(parts.ofSample[static_cast<std::size_t>(20 * tooth)], tooth);
  }
}

TEST(BodyParts, ManyNodesAreFewParts) {
  for (const int teeth : {17, 1000}) {
    SceneObject object;
    const Scene scene = comb(teeth, 3, object);
    const auto samples = samplesOf(object, 10);
    const BodyParts parts = findBodyParts(scene, object, samples);
    EXPECT_EQ(parts.parts.size(), BodyParts::kMost);
    EXPECT_EQ(parts.parts[0].name, "root");
    int nodes = 0;
    for (const BodyParts::Part& part : parts.parts) nodes += part.nodes;
    EXPECT_EQ(nodes, teeth);
    EXPECT_EQ(parts.ofSample.size(), samples.size());
  }
}

TEST(BodyParts, NamesAreOptional) {
  SceneObject object;
  Scene scene = comb(1, 4, object);
  scene.nodes.back().name.clear();
  const BodyParts parts = findBodyParts(scene, object, samplesOf(object, 1));
  ASSERT_EQ(parts.parts.size(), 1u);
  EXPECT_EQ(parts.parts[0].name, "node 4");
}

TEST(BodyParts, ASkinsPartsAreItsJoints) {
  auto options = quickRun("sample:stage", "0", "constant");
  options.samples = 2048;
  const auto fine = run(options);
  ASSERT_TRUE(fine);
  const auto& parts = fine->scenes.at(0).objects.at(0).rigs.at(0).bodyParts;
  ASSERT_LE(parts.size(), BodyParts::kMost);
  EXPECT_GE(parts.size(), 10u);
  EXPECT_EQ(parts[0].name, "hips");
  double share = 0, area = 0;
  bool arm = false;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    EXPECT_LT(parts[i].parent, static_cast<int>(i));
    EXPECT_GE(parts[i].samples, static_cast<std::size_t>(BodyParts::kLeastSamples));
    share += parts[i].share;
    area += parts[i].area;
    arm = arm || parts[i].name == "forearm left";
  }
  EXPECT_TRUE(arm);
  const auto has = [&](const std::string& name) {
    return std::ranges::any_of(parts, [&](const BodyPartErrors& part) { return part.name == name; });
  };
  for (const char* limb : {"clavicle", "upper arm", "forearm", "hand", "thigh", "shin", "foot"})
    EXPECT_EQ(has(std::string(limb) + " left"), has(std::string(limb) + " right")) << limb;
  EXPECT_NEAR(share, 1, 1e-9);
  EXPECT_NEAR(area, 1, 1e-9);
}

}  // namespace
}  // namespace rigel::tests
