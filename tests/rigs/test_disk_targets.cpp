// What rigs of all kinds promise about scenes of disk lights: error targets are met, and estimates are near the truth.
#include "lights/random.h"

#include "lighting_fixture.h"

namespace rigel::test {
namespace {

using Kind = LightingTarget::Kind;

/// A row of ceiling panels and a wall of spots that graze the object, moved along below it.
LightSet corridorOfDisks(float along) {
  LightSet lights;
  for (int i = -3; i <= 3; ++i) {
    const float x = 1.6f * static_cast<float>(i) + along;
    lights.add(DiskLight{{x, 1.5f, 0.1f}, {0, -1, 0}, 0.3f, {12, 11, 9}});
    lights.add(DiskLight{{x + 0.5f, 0.4f, -1.1f}, {0.4f, 0.2f, 1}, 0.06f, {60, 70, 80}, i % 2 == 0});
    lights.add(DiskLight{{x, 1.2f, 1}, {1, -0.25f, -0.1f}, 0.15f, {30, 20, 20}});
  }
  return lights;
}

struct Outcomes {
  int judged = 0, met = 0;
  double worst = 0;
  std::vector<double> estimates;  // over the truth

  void add(double truth, double target) {
    ++judged;
    met += truth <= target ? 1 : 0;
    worst = std::max(worst, truth / target);
  }
  void print(const char* what) {
    std::ranges::sort(estimates);
    std::printf("  %s: within in %d of %d, worst %.2f of it; estimate / true %.2f %.2f %.2f\n", what, met, judged,
                worst, estimates.front(), estimates[estimates.size() / 2], estimates.back());
  }
};

/// Errors over frames, relative to the object's own mean.
template <class Judge>
void drive(const std::string& spec, const LightingOptions& options, Judge judge) {
  const int frames = fullRun() ? 64 : 8;
  for (const Vec3 half : {Vec3{0.3f, 0.9f, 0.25f}, Vec3{0.9f, 0.4f, 0.4f}}) {
    LitBody<3> lit(spec, ellipsoidBody(half, 300), options);
    for (int i = 0; i < frames; ++i) {
      const LightSet lights = corridorOfDisks(3.2f * static_cast<float>(i) / static_cast<float>(frames));
      lit.lighting.reset();
      lit.lighting.light(lights, 1.0f / 60);
      judge(lit, lit.errors(lights, fullRun() ? 1 : 2));
    }
  }
}

class DiskTargets : public testing::TestWithParam<std::string> {};

// Over 128 frames: all within, worst 0.98 of the target (lattice:3x2x2, spatial 0.02).
TEST_P(DiskTargets, AreMet) {
  for (const auto& [kind, target] : {std::pair{Kind::spatialError, 0.05f}, std::pair{Kind::spatialError, 0.02f},
                                     std::pair{Kind::totalError, 0.03f}}) {
    LightingOptions options;
    options.target = {kind, target};
    options.estimate = true;
    const bool total = kind == Kind::totalError;
    Outcomes outcomes;
    double near = 0;
    drive(GetParam(), options, [&](const LitBody<3>& lit, const LightingErrors& errors) {
      const double truth = (total ? errors.total : errors.spatial) / errors.mean;
      outcomes.add(truth, static_cast<double>(target));
      outcomes.estimates.push_back(
          static_cast<double>(total ? *lit.lighting.totalEstimate() : *lit.lighting.spatialEstimate()) / truth);
      near += static_cast<double>(lit.lighting.nearLights().size());
    });
    outcomes.print((GetParam() + (total ? " total " : " spatial ") + std::to_string(target) + ", near lights " +
                    std::to_string(near / outcomes.judged))
                       .c_str());
    EXPECT_GE(outcomes.met, 0.95 * outcomes.judged);
    EXPECT_LE(outcomes.worst, 1.1);
  }
}

// Over 128 frames: all, the truth at most 1.6 times the estimate (lattice:3x2x2); medians of estimate/true 0.76 to 1.6.
TEST_P(DiskTargets, EstimatesOfTheRigAloneAreNearTheTruth) {
  LightingOptions options;
  options.estimate = true;
  Outcomes outcomes;
  drive(GetParam(), options, [&](const LitBody<3>& lit, const LightingErrors& errors) {
    const double truth = errors.spatial / errors.mean, estimate = static_cast<double>(*lit.lighting.spatialEstimate());
    outcomes.add(truth, 1.6 * estimate);
    outcomes.estimates.push_back(estimate / truth);
  });
  outcomes.print(GetParam().c_str());
  EXPECT_GE(outcomes.met, 0.95 * outcomes.judged);
}

INSTANTIATE_TEST_SUITE_P(Rigs, DiskTargets,
                         testing::Values("auto", "constant", "gradient", "lattice:3x2x2", "mixed:l3,g,c", "poly:6",
                                         "poly:12", "invquad:6", "lattice:3x2x2@lsq", "lattice:3x2x2@gauss"),
                         [](const auto& rig) { return std::to_string(rig.index); });

}  // namespace
}  // namespace rigel::test
