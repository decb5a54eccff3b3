// poly, auto and invquad in GLSL against double, beside Rig::basis.
#include "gpu/rig_batch.h"

namespace rigel::test {
namespace {

const std::string kIrradiance = "e = rigel_rigIrradiance(texels, rig, p, y);";
const std::string kSh = "rigel_rigSh(texels, rig, p, sh);";
const std::string kAlone = "GpuRig rig = shared_.rig;\n" + kIrradiance;  // of one rig
// Other kinds are left out, and the sum is a loop: less for lavapipe to compile.
const std::string kPolyAlone = "#define RIGEL_HAS_KIND(rigKind) ((rigKind) == kGpuRigPoly)\n";
const std::string kInvquadAlone = "#define RIGEL_HAS_KIND(rigKind) ((rigKind) == kGpuRigInvquad)\n";
const std::string kLoop = "#define RIGEL_POLY_LOOP\n";

// Largest error of the shader, whatever the twin's, which is worse far from the origin, and on bodies that are a thread
// beside their distance from their frame's. Box coordinates are off by up to 2.0e-7 of their terms, and a monomial by
// as much for each of up to 5 of them: 1.5e-6 is the worst measured, three boxes from the thread.
constexpr double kShaderError = 2e-6, kCoordinateError = 3e-7;

void expectGood(const TwinFamilies& families) {
  families.expectWithinTwice();
  EXPECT_LE(families.gpuError(), kShaderError);
}

/// Every body at every distance.
template <int B>
void checkSpec(tools::ShaderFunction& function, const std::string& spec, int pointsOfEach, bool wantsSh,
               TwinFamilies& families, Random& random) {
  RigBatch<B> batch;
  batch.addFamilies(spec, pointsOfEach, random);
  batch.check(function, wantsSh, families);
}

template <int B>
void checkPolys(const std::string& defines, int mostTerms, int points) {
  Random random(41 + B);
  auto function = shaderFunction(batchSource(B, kPolyAlone + defines, kIrradiance));
  TwinFamilies families("poly, irradiance, " + std::to_string(B) + " bands");
  // Every number of terms up to a full vec4 of their bytes and one more; beyond, an ordinary run takes every eighth.
  for (int k = 1; k <= mostTerms; ++k)
    if (k <= 17 || k % 8 == 0 || fullRun())
      checkSpec<B>(function, "poly:" + std::to_string(k), points, false, families, random);
  checkSpec<B>(function, "auto:" + std::to_string(mostTerms), points, false, families, random);
  expectGood(families);
}

TEST(GpuRigPoly, IsTheTwinUnrolled) { checkPolys<3>("#define RIGEL_POLY_MAX 6\n", 6, 720); }
TEST(GpuRigPoly, IsTheTwinWithEveryNumberOfTerms) { checkPolys<3>(kLoop + "#define RIGEL_POLY_MAX 56\n", 56, 220); }
TEST(GpuRigPoly, IsTheTwinInTwoBands) { checkPolys<2>(kLoop, 24, 320); }
TEST(GpuRigPoly, IsTheTwinInFourBands) { checkPolys<4>(kLoop, 24, 320); }
TEST(GpuRigPoly, IsTheTwinInFiveBands) { checkPolys<5>(kLoop, 24, 320); }

template <int B>
void checkInvquad() {
  Random random(51 + B);
  auto function = shaderFunction(batchSource(B, kInvquadAlone + kLoop, kIrradiance));
  TwinFamilies families("invquad, irradiance, " + std::to_string(B) + " bands");
  for (const std::string spec : {"invquad:1", "invquad:4", "invquad:6", "invquad:12", "invquad:16"})
    checkSpec<B>(function, spec, 1020, false, families, random);
  expectGood(families);
}

TEST(GpuRigPoly, InvquadIsTheTwinInTwoBands) { checkInvquad<2>(); }
TEST(GpuRigPoly, InvquadIsTheTwinInThreeBands) { checkInvquad<3>(); }
TEST(GpuRigPoly, InvquadIsTheTwinInFourBands) { checkInvquad<4>(); }
TEST(GpuRigPoly, InvquadIsTheTwinInFiveBands) { checkInvquad<5>(); }

template <int B>
void checkSh() {
  Random random(61 + B);
  const std::string bands = std::to_string(B) + " bands";
  auto poly = shaderFunction(batchSource(B, kPolyAlone + kLoop, kSh, true));
  TwinFamilies families("poly, SH, " + bands);
  for (const std::string spec : {"poly:1", "poly:4", "poly:6", "poly:12", "auto"})
    checkSpec<B>(poly, spec, 1020, true, families, random);
  expectGood(families);
  auto invquad = shaderFunction(batchSource(B, kInvquadAlone + kLoop, kSh, true));
  TwinFamilies ratios("invquad, SH, " + bands);
  checkSpec<B>(invquad, "invquad:6", 5100, true, ratios, random);
  expectGood(ratios);
}

TEST(GpuRigPoly, ShIsTheTwinInTwoBands) { checkSh<2>(); }
TEST(GpuRigPoly, ShIsTheTwinInThreeBands) { checkSh<3>(); }
TEST(GpuRigPoly, ShIsTheTwinInFourBands) { checkSh<4>(); }
TEST(GpuRigPoly, ShIsTheTwinInFiveBands) { checkSh<5>(); }

/// What an entry shader defines instead of reading it from the rig: here as literals.
std::string constantsOf(const Rig& rig, int vectors) {
  std::vector<GpuVec4> none(packRigBound(rig, 3));
  const GpuRig packed = packRig<3>(rig, {}, {}, {}, {}, std::span<GpuVec4>(none));
  std::string text = "const int kTerms[" + std::to_string(vectors + 8) + "] = int[](0";
  for (int k = 1; k < vectors + 8; ++k) text += ", " + std::to_string(k < rig.shVectors() ? termOf(packed, k) : 0);
  return text + ");\n#define RIGEL_TERM(rig, k) kTerms[k]\n#define RIGEL_VECTORS(rig) " + std::to_string(vectors) +
         "\n#define RIGEL_POLY_MAX " + std::to_string(vectors) + "\n";
}

TEST(GpuRigPoly, IsTheTwinWithConstantsFromTheEntryShader) {
  Random random(71);
  TwinFamilies families("poly, constant terms");
  for (const int terms : {1, 6, 12, 13}) {
    const RigBody& body = rigBodies().front();
    const Rig rig = rigOn("poly:" + std::to_string(terms), body, random);
    // Fewer vectors than the shader sums: the packing fills up with zeros.
    for (const int padding : {0, 3}) {
      auto function = shaderFunction(rigSource(3, kPolyAlone + constantsOf(rig, terms + padding), kAlone));
      const RigRun<3> run("constants", rig, randomFrame(random, 10), terms, 5000, random);
      run.checkIrradiance(runPacked(function, run, terms + padding), families[std::to_string(terms) + " terms"]);
    }
  }
  expectGood(families);
}

TEST(GpuRigPoly, IsTheTwinFromAUniformBlock) {
  Random random(81);
  auto source = rigSource(3,
                          kPolyAlone + kLoop +
                              "#define RIGEL_SOURCE int\n"
                              "#define RIGEL_FETCH(source, i) shared_.coefficients[i]\n"
                              "#define RIGEL_OFFSET(rig) 0\n"
                              "#define RIGEL_SCALE(rig) 1.0\n",
                          "e = rigel_rigIrradiance(0, shared_.rig, p, y);");
  source.uniforms = "GpuRig rig; vec4 coefficients[112];";
  source.texels = false;
  struct Block {
    GpuRig rig;
    GpuVec4 coefficients[112];
  };
  auto function = shaderFunction(source);
  TwinFamilies families("poly, uniform block");
  for (const RigBody& body : rigBodies()) {
    const Rig rig = rigOn("poly:16", body, random);
    const RigRun<3> run(body.name, rig, randomFrame(random, 10), 16, 8000, random);
    std::vector<GpuVec4> buffer(packRigBound(rig, 3));
    Block block{};
    block.rig = packRig<3>(rig, run.frame, run.coefficients, {}, {}, std::span<GpuVec4>(buffer));
    std::copy_n(buffer.begin(), 112, block.coefficients);
    setUniforms(function, block);
    run.checkIrradiance(rigel::test::run(function, run.rows()), families[body.name]);
  }
  expectGood(families);
}

TEST(GpuRigPoly, BoxCoordinatesAreThoseOfTheBoxFarFromTheOrigin) {
  Random random(91);
  tools::ShaderFunctionSource source;
  source.prelude = "#include <rigel/rig_box.glsl>\n";
  source.inputs = {"vec3 p"};
  source.outputs = {"vec3 u"};
  source.uniforms = "GpuRig rig;";
  source.body = "u = rigel_boxCoordinates(shared_.rig, p);";
  auto function = shaderFunction(source);
  TwinFamilies families("box coordinates");
  for (const RigBody& body : rigBodies()) {
    const Rig rig = rigOn("poly:4", body, random);
    for (const double distance : kFrameDistances) {
      const RigFrame frame = randomFrame(random, distance);
      std::vector<GpuVec4> buffer(packRigBound(rig, 3));
      setUniforms(function, packRig<3>(rig, frame, {}, {}, {}, std::span<GpuVec4>(buffer)));
      const std::vector<Vec3> points = rigPoints(rig.box(), frame, 6000, random);
      std::vector<float> rows;
      for (Vec3 p : points) rows.insert(rows.end(), {p.x, p.y, p.z});
      const std::vector<float> results = run(function, rows);
      const RigReference reference(rig, frame);
      TwinCheck& check = families[body.name + distanceText(distance)];
      // The first three terms that move with x, y and z are the coordinates themselves.
      const Vec3 centre = rig.box().lo * 0.5f + rig.box().hi * 0.5f, half = rig.box().hi * 0.5f - rig.box().lo * 0.5f;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const auto [exact, absolute] = reference.coordinates(points[i]);
        const Vec3 d = frame.inversePoint(points[i]) - centre;
        for (int a = 0; a < 3; ++a) {
          const float twin = half[a] > 1e-30f ? d[a] * (1 / half[a]) : 0.0f;
          check.add(results[3 * i + a], std::isnan(twin) ? 0.0f : twin, exact[a], absolute[a], body.name);
        }
      }
    }
  }
  families.expectWithinTwice();
  EXPECT_LE(families.gpuError(), kCoordinateError);
}

TEST(GpuRigPoly, WithoutVectorsGivesNoLight) {
  Random random(95);
  auto function = shaderFunction(rigSource(3, kPolyAlone + kLoop, kAlone));
  const Rig rig = rigOn("auto", rigBodies().front(), random);
  const RigRun<3> run("empty", rig, {}, 0, 100, random);
  for (float e : runPacked(function, run)) EXPECT_EQ(e, 0);
}

}  // namespace
}  // namespace rigel::test
