// Continuity of near lights and `auto` rigs (DESIGN section 2): the same motion at 60 and at 480 frames a second. What
// is continuous in time leaps an eighth as far; a hard switch leaps as far as before. RIGEL_FULL=1: whole clips and all
// samples of the report; otherwise a part of each clip in which lights come and go.
#include "lights/random.h"
#include "motion.h"
#include "report/run/run_options.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>

namespace rigel::tests {
namespace {

using namespace rigel::tools;

constexpr double kSlow = 60, kFast = 480;  // frames a second
// Of the leap at kSlow: twice an eighth over a whole clip; a short section has fewer frames to take the largest from.
// Worst measured: street, poly:6 --near 4, 0.233; in a section dragon, mixed:l3,g,c --near 2, 0.226.
constexpr double kAllowed = 0.25, kAllowedInSection = 0.3;
// The rig's part alone, without the near lights that make up for it: gallery, mixed:l3,g,c --near 2, 0.253.
constexpr double kAllowedOfRig = 0.3;
// Leaps below this are float rounding of near lights, which does not shrink with the frames; of the mean light. Worst
// measured 3e-4.
constexpr double kNoise = 2e-3;

struct Choice {
  std::string name;
  RigSpec rig;
  RunOptions options;
  bool hard = false;
  int slots = 0;  // kMaxNearLights: as many as are chosen
};

std::vector<Choice> choices() {
  std::vector<Choice> all;
  for (const char* near : {"2", "4", "auto"}) {
    for (const char* spec : {"poly:6", "mixed:l3,g,c", "auto"}) {
      for (const bool hard : {false, true}) {
        const bool adaptive = std::string_view(spec) == "auto";
        if (adaptive ? hard : std::string_view(near) == "auto") continue;
        Choice choice;
        choice.name = fmt::format("{}{} --near {}", hard ? "hard switch, " : "", spec, near);
        choice.rig = *parseRigSpec(spec);
        choice.options.rigs = {choice.rig};
        choice.options.near = *parseNear(near);
        choice.hard = hard;
        choice.slots = lightingOptions(choice.rig, choice.options).slots();
        all.push_back(choice);
      }
    }
  }
  return all;
}

struct Section {
  const char* scene;
  double from, to;       // s
  double longest = 1e9;  // s of the clip, with RIGEL_FULL=1
};

/// Largest leaps by name of the choice, relative to `reference`.
std::map<std::string, Leap> leaps(const Section& section, int samples, double rate, double& reference) {
  Motion motion(section.scene, samples);
  const int first = static_cast<int>(section.from * rate);
  const int last = static_cast<int>(std::min(section.to, motion.duration()) * rate);
  if (reference == 0) {
    constexpr int kLooks = 16;
    for (int i = 0; i < kLooks; ++i) {
      motion.show(section.from + (section.to - section.from) * i / kLooks);
      reference += motion.truth().mean / kLooks;
    }
  }
  const std::vector<Choice> all = choices();
  std::vector<std::unique_ptr<RigRunner>> rigs;
  for (const Choice& choice : all) {
    auto rig = makeRigRunner(choice.rig, lightingOptions(choice.rig, choice.options), kDefaultBands, motion.object(),
                             motion.rest(), motion.surface());
    if (!rig) throw std::runtime_error(rig.error().line());
    rigs.push_back(*std::move(rig));
    rigs.back()->setReference(static_cast<float>(reference));
    rigs.back()->reset();
  }
  std::vector<LeapMeter> meters(all.size());
  std::vector<RigRunner::Shaded> shaded(motion.surface().measured.size());
  for (int frame = first; frame <= last; ++frame) {
    motion.show(frame / rate);
    for (std::size_t r = 0; r < rigs.size(); ++r) {
      rigs[r]->fit(motion.object(), motion.posed(), motion.lights(), static_cast<float>(1 / rate));
      if (all[r].hard)
        shadeWithHardSwitch(*rigs[r], all[r].slots, motion, shaded);
      else
        rigs[r]->shade(motion.truth().points, motion.surface().wrap, shaded);
      meters[r].add(shaded, motion.truth());
    }
  }
  std::map<std::string, Leap> result;
  for (std::size_t r = 0; r < all.size(); ++r)
    result[all[r].name] = {meters[r].largest().error / reference, meters[r].largest().rig / reference};
  return result;
}

bool shrinks(double slow, double fast, double allowed) { return fast <= std::max(allowed * slow, kNoise); }

class Popping : public testing::TestWithParam<Section> {};

TEST_P(Popping, LeapsShrinkWithTheFrames) {
  Section section = GetParam();
  if (test::fullRun()) section = {section.scene, 0, std::min(section.longest, Motion(section.scene, 1).duration())};
  const int samples = test::fullRun() ? 4096 : 384;
  double reference = 0;
  const auto slow = leaps(section, samples, kSlow, reference);
  const auto fast = leaps(section, samples, kFast, reference);
  const double allowed = test::fullRun() ? kAllowed : kAllowedInSection;
  int compared = 0, hardSwitchesNoticed = 0;
  for (const Choice& choice : choices()) {
    const Leap& at60 = slow.at(choice.name);
    const Leap& at480 = fast.at(choice.name);
    fmt::print("{:8}{:36}error {:8.4f} {:8.4f} ratio {:.3f}  rig {:8.4f} {:8.4f} ratio {:.3f}\n", section.scene,
               choice.name, at60.error, at480.error, at480.error / at60.error, at60.rig, at480.rig,
               at60.rig > 0 ? at480.rig / at60.rig : 0);
    if (choice.hard) {
      hardSwitchesNoticed += shrinks(at60.error, at480.error, allowed) ? 0 : 1;
      continue;
    }
    ++compared;
    EXPECT_TRUE(shrinks(at60.error, at480.error, allowed))
        << choice.name << ": " << at60.error << " at 60 Hz, " << at480.error << " at 480 Hz";
    EXPECT_TRUE(shrinks(at60.rig, at480.rig, kAllowedOfRig))
        << choice.name << ", the rig's part: " << at60.rig << " at 60 Hz, " << at480.rig << " at 480 Hz";
  }
  EXPECT_EQ(compared, 7);
  EXPECT_GE(hardSwitchesNoticed, 2) << "this test would pass anything";
}

INSTANTIATE_TEST_SUITE_P(Scenes, Popping,
                         testing::Values(Section{"street", 1.2, 2}, Section{"stage", 1.6, 2.6},
                                         Section{"dragon", 0.4, 1}, Section{"touch", 3.2, 4},
                                         Section{"corridor", 1, 1.6}, Section{"gallery", 1, 1.4, 2}),
                         [](const auto& section) { return std::string(section.param.scene); });

}  // namespace
}  // namespace rigel::tests
