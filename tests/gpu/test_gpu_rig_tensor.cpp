// gradient, lattice and mixed rigs in GLSL against double, beside Rig::basis.
#include "gpu/rig_batch.h"

namespace rigel::test {
namespace {

/// Only one kind compiled in, as in an entry shader.
std::string only(const std::string& kind) { return "#define RIGEL_HAS_KIND(rigKind) ((rigKind) == " + kind + ")\n"; }

const std::vector<std::string> kConstants = {"constant", "constant@lsq", "constant@gauss"};
const std::vector<std::string> kTensors = {"gradient",
                                           "gradient@numeric",
                                           "gradient@lsq",
                                           "lattice:2x2x2",
                                           "lattice:3x2x2",
                                           "lattice:3x2x2:smooth",
                                           "lattice:4x3x2:cubic",
                                           "lattice:2x2x2:cubic",
                                           "lattice:64x2x1",
                                           "lattice:3x2x2@lsq",
                                           "lattice:8x4x2",
                                           "mixed:l3,g,c",
                                           "mixed:l3,g,c@numeric",
                                           "mixed:l3,g,c@lsq",
                                           "mixed:xyz:c,l4,g",
                                           "mixed:g,g,c",
                                           "mixed:l2,g,g@lsq"};
const std::vector<std::string> kGausses = {"gradient@gauss", "lattice:3x2x2@gauss", "lattice:8x4x2@gauss",
                                           "mixed:l3,g,c@gauss", "lattice:5x3x1@gauss"};

// Largest error of the shader, whatever the twin's, which is worse far from its frame's origin: that of 25 products;
// 4.7e-7 is the worst measured. An SH coefficient has no others to be small beside: where all but one node count next
// to nothing, 1 - b(t) of the smooth kernel is still rounded as 1 is: 1.5e-6, and 3.1e-6 with other
// inputs.
constexpr double kShaderError = 8e-7, kShaderErrorSh = 5e-6;

template <int B>
void checkSpecs(const std::string& name, const std::string& kind, const std::vector<std::string>& specs, bool wantsSh) {
  Random random(31 + B);
  auto function = shaderFunction(batchSource(
      B, only(kind), wantsSh ? "rigel_rigSh(texels, rig, p, sh);" : "e = rigel_rigIrradiance(texels, rig, p, y);",
      wantsSh));
  TwinFamilies families(name + ", " + std::to_string(B) + " bands");
  const std::size_t kinds = rigBodies().size() * std::size(kFrameDistances);
  for (const std::string& spec : specs) {
    RigBatch<B> batch;
    batch.addFamilies(spec, 1 + 100000 / static_cast<int>(kinds * specs.size()), random);
    batch.check(function, wantsSh, families);
  }
  families.expectWithinTwice();
  EXPECT_LE(families.gpuError(), wantsSh ? kShaderErrorSh : kShaderError);
}

template <int B>
void checkEveryKind() {
  checkSpecs<B>("constant, irradiance", "kGpuRigConstant", kConstants, false);
  checkSpecs<B>("tensor, irradiance", "kGpuRigTensor", kTensors, false);
  checkSpecs<B>("gauss, irradiance", "kGpuRigGauss", kGausses, false);
}

TEST(GpuRigTensor, IsTheTwinOfBasisInTwoBands) { checkEveryKind<2>(); }
TEST(GpuRigTensor, IsTheTwinOfBasisInThreeBands) { checkEveryKind<3>(); }
TEST(GpuRigTensor, IsTheTwinOfBasisInFourBands) { checkEveryKind<4>(); }
TEST(GpuRigTensor, IsTheTwinOfBasisInFiveBands) { checkEveryKind<5>(); }

TEST(GpuRigTensor, ShIsTheTwin) {
  checkSpecs<3>("constant, SH", "kGpuRigConstant", kConstants, true);
  checkSpecs<3>("tensor, SH", "kGpuRigTensor", kTensors, true);
  checkSpecs<3>("gauss, SH", "kGpuRigGauss", kGausses, true);
}

TEST(GpuRigTensor, IsTheTwinWithConstantsFromTheEntryShader) {
  Random random(37);
  const RigBody& body = rigBodies().front();
  TwinFamilies families("mixed:l3,g,c, constants");
  const Rig rig = rigOn("mixed:xyz:l3,g,c", body, random);
  auto function = shaderFunction(rigSource(3,
                                           "#define RIGEL_IS_KIND(rig, rigKind) ((rigKind) == kGpuRigTensor)\n"
                                           "#define RIGEL_NODES(rig) ivec3(3, 1, 1)\n"
                                           "#define RIGEL_SLOPE(rig) ivec3(0, 1, 0)\n"
                                           "#define RIGEL_PER_NODE(rig) 2\n"
                                           "#define RIGEL_KERNEL(rig) kGpuLinear\n",
                                           "e = rigel_rigIrradiance(texels, shared_.rig, p, y);"));
  for (const double distance : kFrameDistances) {
    const RigRun<3> run("constants", rig, randomFrame(random, distance), rig.shVectors(), 25000, random);
    run.checkIrradiance(runPacked(function, run), families["the body" + distanceText(distance)]);
  }
  families.expectWithinTwice();
}

}  // namespace
}  // namespace rigel::test
