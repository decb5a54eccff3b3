// gradient, lattice and mixed rigs in GLSL against double, beside Rig::basis.
#include "gpu/rig_twin.h"

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

// Largest error of the shader, whatever the twin's, which is worse far from its frame's origin. 3.4e-5 is the worst
// measured: @gauss on the thread, whose coordinates across are off by 1e-3 and weights by the square of it; elsewhere
// 4e-6.
constexpr double kShaderError = 5e-5;

/// Every rig costs a compilation, most of all where Mesa's cache is cold: RIGEL_FULL=1 takes all of them in all bands,
/// on three bodies; otherwise all in 3 bands and every fourth in others.
std::vector<std::string> chosen(const std::vector<std::string>& specs, int bands) {
  if (fullRun() || bands == kDefaultBands) return specs;
  std::vector<std::string> some;
  for (std::size_t i = static_cast<std::size_t>(bands) % 4; i < specs.size(); i += 4) some.push_back(specs[i]);
  return some.empty() ? std::vector{specs.front()} : some;
}

template <int B>
void checkSpecs(const std::string& name, const std::string& kind, const std::vector<std::string>& all, bool wantsSh) {
  const std::vector<std::string> specs = chosen(all, B);
  Random random(31 + B);
  const std::string body =
      wantsSh ? "rigel_rigSh(texels, shared_.rig, p, sh);" : "e = rigel_rigIrradiance(texels, shared_.rig, p, y);";
  auto function = shaderFunction(rigSource(B, only(kind), body, wantsSh));
  TwinCheck check(name + ", " + std::to_string(B) + " bands");
  const int sets = fullRun() || B == kDefaultBands ? 3 : 1;  // of body and distance, a spec
  const int points = 1 + 100000 / (sets * static_cast<int>(specs.size()));
  for (const std::string& spec : specs)
    for (int set = 0; set < sets; ++set) {
      const RigBody& rigBody = rigBodies()[random.index(static_cast<int>(rigBodies().size()))];
      const double distance = kFrameDistances[random.index(std::size(kFrameDistances))];
      const Rig rig = rigOn(spec, rigBody, random);
      const RigRun<B> run(spec + " on the " + rigBody.name, rig, randomFrame(random, distance), rig.shVectors(), points,
                          random);
      const std::vector<float> results = runPacked(function, run);
      if (wantsSh)
        run.checkSh(results, check);
      else
        run.checkIrradiance(results, check);
    }
  check.expectWithinTwice();
  EXPECT_LE(check.gpuError(), kShaderError);
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
  TwinCheck check("mixed:l3,g,c, constants");
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
    run.checkIrradiance(runPacked(function, run), check);
  }
  check.expectWithinTwice();
}

}  // namespace
}  // namespace rigel::test
