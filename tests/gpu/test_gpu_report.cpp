// A report whose rigs are evaluated on the GPU says what the CPU's says, and what half floats add.
#include "gpu/gpu_test.h"
#include "render/gpu_shading.h"
#include "report/run/scene_run.h"

#include <gtest/gtest.h>

#include "reference/worst.h"

namespace rigel::test {
namespace {

using namespace rigel::tools;

RunOptions optionsFor(const char* scene) {
  RunOptions options;
  options.scenes = {scene};
  options.rigs = *parseRigSpecs("constant;mixed:l3,g,c;lattice:3x2x2@gauss;poly:6;invquad:6;auto");
  options.frames = *parseFrameRange("0:30:30");
  options.images = false;
  options.samples = 512;
  return options;
}

Report reportOf(const RunOptions& options) {
  return must(runReport(options, "", [](double, const std::string&) {}));
}

// Of the error itself. Worst measured 5.3e-6 (RMS) and 2.9e-6 (largest), with wrap: the kernel's power and roots in
// float, on both sides.
constexpr double kSameRms = 2e-5, kSameMax = 1e-4;
// Of the mean light. Worst measured 2.7e-4 (poly:6 under lights in contact): 2^-11 of coefficients that cancel.
constexpr double kHalf = 1e-3;

void compareDevices(RunOptions options) {
  const Report cpu = reportOf(options);
  options.shading = [] { return makeGpuShading(gpu()); };
  const Report device = reportOf(options);
  reference::Worst rms("RMS errors on the GPU and on the CPU"), max("largest errors"), half("half floats");
  const auto add = [](reference::Worst& worst, double actual, double expected, const std::string& spec) {
    worst.add(std::abs(actual - expected) / expected, [&] { return spec; });
  };
  for (std::size_t o = 0; o < cpu.scenes[0].objects.size(); ++o) {
    for (std::size_t r = 0; r < options.rigs.size(); ++r) {
      const RigReport& expected = cpu.scenes[0].objects[o].rigs[r];
      const RigReport& actual = device.scenes[0].objects[o].rigs[r];
      add(rms, actual.total.rms, expected.total.rms, expected.spec);
      add(rms, actual.spatial.rms, expected.spatial.rms, expected.spec);
      add(max, actual.total.max, expected.total.max, expected.spec);
      EXPECT_FALSE(expected.halfFloat) << "nobody measured it";
      ASSERT_TRUE(actual.halfFloat) << expected.spec;
      EXPECT_GT(actual.halfFloat->rms, 1e-6) << expected.spec << ": no coefficient was rounded";
      half.add(actual.halfFloat->rms, [&] { return expected.spec; });
    }
  }
  rms.expectWithin(kSameRms);
  max.expectWithin(kSameMax);
  half.expectWithin(kHalf);
}

TEST(GpuReport, SaysWhatTheCpuSays) { compareDevices(optionsFor("sample:street")); }

TEST(GpuReport, WithNearLightsAndWrap) {
  RunOptions options = optionsFor("sample:touch");
  options.near = NearChoice{false, 2};
  options.wrap = 0.3f;
  compareDevices(options);
}

TEST(GpuReport, WithAHighBand) {
  RunOptions options = optionsFor("sample:dragon");
  options.rigs = *parseRigSpecs("auto");
  options.target = LightingTarget{LightingTarget::Kind::totalError, 0.02f};
  compareDevices(options);
}

}  // namespace
}  // namespace rigel::test
