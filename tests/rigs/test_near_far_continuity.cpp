// No popping: the same drive past lamps at 60, 120, 240 and 480 frames a second. What the lights jump from frame to
// frame shrinks with the frames; what a hard switch jumps does not.
#include "near_far_motion.h"

namespace rigel::test {
namespace {

WeightPolicy continuousWeights(int slots, float rate) {
  const auto nearFar = std::make_shared<NearFar>(NearFarOptions{slots, 0, rate});
  return [nearFar](std::span<const float> errors, float seconds) {
    nearFar->update(errors, {}, seconds);
    return std::vector<float>(nearFar->weights().begin(), nearFar->weights().end());
  };
}

/// What NearFar replaces: the `slots` largest errors, all or nothing.
WeightPolicy hardTopLights(int slots) {
  return [slots](std::span<const float> errors, float) {
    std::vector<float> sorted(errors.begin(), errors.end());
    std::nth_element(sorted.begin(), sorted.begin() + slots, sorted.end(), std::greater<>());
    std::vector<float> weights;
    for (const float e : errors) weights.push_back(e > sorted[slots] ? 1.0f : 0.0f);
    return weights;
  };
}

struct Jumps {
  double at60 = 0, at120 = 0, at240 = 0, at480 = 0;
  double rms = 0;
};

Jumps jumps(LampRow& row, const std::function<WeightPolicy()>& policy) {
  const MotionResult slow = row.drive(policy(), 60);
  return {slow.maxJump, row.drive(policy(), 120).maxJump, row.drive(policy(), 240).maxJump,
          row.drive(policy(), 480).maxJump, slow.rms};
}

class NearFarContinuity : public testing::TestWithParam<std::string> {};

// Measured: 0.13 to 0.16 with the rate limit, 0.14 to 0.19 without, 1.01 to 1.09 for the hard choice; 0.125 is what
// linear motion would give.
TEST_P(NearFarContinuity, JumpsShrinkWithTheFrame) {
  LampRow row(GetParam());
  for (const int slots : {2, 4}) {
    for (const float rate : {20.0f, 0.0f}) {
      const Jumps jump = jumps(row, [&] { return continuousWeights(slots, rate); });
      std::printf("  %s, %d slots, rate %.0f: max jump %.4f %.4f %.4f %.4f, rms %.4f\n", GetParam().c_str(), slots,
                  static_cast<double>(rate), jump.at60, jump.at120, jump.at240, jump.at480, jump.rms);
      EXPECT_LE(jump.at480, 0.25 * jump.at60) << slots << " slots, rate " << rate;
      EXPECT_LT(jump.at240, jump.at120);
    }
  }
}

TEST_P(NearFarContinuity, AHardChoiceFailsTheSameTest) {
  LampRow row(GetParam());
  for (const int slots : {2, 4}) {
    const Jumps jump = jumps(row, [&] { return hardTopLights(slots); });
    EXPECT_GT(jump.at480, 0.8 * jump.at60) << slots << " slots";
    const Jumps smooth = jumps(row, [&] { return continuousWeights(slots, 20); });
    EXPECT_LT(smooth.at480, 0.2 * jump.at480) << slots << " slots";
    // Bought with lights that are near in part: up to a quarter more error.
    EXPECT_LT(smooth.rms, 1.25 * jump.rms) << slots << " slots";
  }
}

INSTANTIATE_TEST_SUITE_P(Rigs, NearFarContinuity, testing::Values("constant", "mixed:l3,g,c", "poly:6"),
                         [](const auto& rig) { return std::to_string(rig.index); });

}  // namespace
}  // namespace rigel::test
