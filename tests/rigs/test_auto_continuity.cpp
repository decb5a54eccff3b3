// No popping of `auto` rigs: the same motion at 60, 120, 240 and 480 frames a second. What the error jumps from frame
// to frame shrinks with the frames, past lamps and through one.
#include <rigel/object_lighting.h>

#include "lights/random.h"

#include "lamp_row.h"
#include "lighting_fixture.h"

namespace rigel::test {
namespace {

using Kind = LightingTarget::Kind;

struct Motion {
  std::string name;
  LightSet lights;
  Vec3 from, velocity;
};

LightSet throughALight() {
  LightSet lights;
  lights.add(SphereLight{{0, 0.1f, 0.2f}, 0.25f, {20, 20, 20}});
  lights.add(PointLight{{1, 3, 1}, {20, 20, 20}});
  lights.add(PointLight{{-2, 2, 2}, {10, 10, 10}});
  lights.add(DirectionalLight{{0.2f, -1, 0.1f}, {2, 2, 2}});
  return lights;
}

/// More lights than are looked at one by one, with ranges and cones that begin and end.
LightSet street() {
  LightSet lights;
  std::mt19937 random(9);
  std::uniform_real_distribution<float> unit(0, 1);
  for (int i = 0; i < 70; ++i) {
    const Vec3 p{-12 + 0.35f * static_cast<float>(i), 1 + 3 * unit(random), i % 2 == 0 ? -2.5f : 2.5f};
    const float bright = 2 + 8 * unit(random);
    if (i % 3 == 0) {
      lights.add(SpotLight{p, {0, -1, 0}, {bright, bright, bright}, 0.4f, 0.9f});
    } else {
      lights.add(PointLight{p, {bright, bright, bright}, 0.02f, 4 + 4 * unit(random)});
    }
  }
  return lights;
}

std::vector<Motion> motions() {
  return {{"past lamps at 8 m/s", lampRow(), {-2, 0, 0}, {8, 0, 0}},
          {"through a light at 3 m/s", throughALight(), {-2.2f, 0, 0}, {3, 0, 0}},
          {"a street of 70 lights at 6 m/s", street(), {-2, 0, 0}, {6, 0, 0}}};
}

struct Result {
  double jump = 0;  // largest change of the error at a point from frame to frame, over the reference
  double rms = 0, near = 0, vectors = 0;
  double at = 0;  // seconds at which it jumps
};

constexpr float kReference = 4;  // W/m2, about the mean of all three

Result drive(LitBody<3>& lit, const Body& body, const Motion& motion, double rate, double seconds) {
  Result result;
  std::vector<double> last, now;
  double squares = 0, count = 0;
  const int frames = static_cast<int>(seconds * rate + 0.5);
  lit.lighting.reset();
  for (int i = 0; i <= frames; ++i) {
    const auto t = static_cast<float>(i / rate);
    lit.place(motion.from + motion.velocity * t);
    lit.lighting.light(motion.lights, static_cast<float>(1 / rate));
    result.near += static_cast<double>(lit.lighting.nearLights().size()) / (frames + 1);
    result.vectors += static_cast<double>(lit.lighting.coefficients().size()) / (frames + 1);
    now.clear();
    for (std::size_t p = 0; p < body.points.size(); ++p) {
      const auto parts = lit.shade(p);
      now.push_back(static_cast<double>(parts.rig.g + parts.nearLights.g) -
                    exactIrradiance(motion.lights, lit.world(p), body.normals[p]).g);
      squares += now.back() * now.back();
      ++count;
      if (!last.empty() && std::abs(now.back() - last[p]) > result.jump) {
        result.jump = std::abs(now.back() - last[p]);
        result.at = static_cast<double>(t);
      }
    }
    last.swap(now);
  }
  result.jump /= static_cast<double>(kReference);
  result.rms = std::sqrt(squares / count) / static_cast<double>(kReference);
  return result;
}

struct Aim {
  std::string spec, name;
  Kind kind;
  float value;
  std::optional<int> slots;
};

void PrintTo(const Aim& aim, std::ostream* out) { *out << aim.name; }

class AutoContinuity : public testing::TestWithParam<Aim> {};

// Of the reference: a fifth of a step of an 8-bit display. Steps of float, where nothing is wrong at all, do not shrink
// with the frame.
constexpr double kNoise = 2e-3;
// 0.125 is what linear motion would give. Worst measured 0.16; the long runs meet choices that change twice within a
// frame of 60 Hz.
const double kShrink = fullRun() ? 0.32 : 0.25;

TEST_P(AutoContinuity, JumpsShrinkWithTheFrame) {
  LightingOptions options;
  options.target = {GetParam().kind, GetParam().value};
  options.nearSlots = GetParam().slots;
  options.reference = kReference;
  for (const Vec3 half : {Vec3{1.5f, 0.6f, 0.7f}, Vec3{1, 1, 1}}) {
    const Body body = ellipsoidBody(half, 80);
    LitBody<3> lit(GetParam().spec, body, options);
    for (const Motion& motion : motions()) {
      const double seconds = fullRun() ? 1.5 : 0.75;
      const Result slow = drive(lit, body, motion, 60, seconds), fast = drive(lit, body, motion, 480, seconds);
      std::printf("  %s, %s: jump %.4f (%.3f s)", GetParam().name.c_str(), motion.name.c_str(), slow.jump, slow.at);
      if (fullRun()) {
        for (const double rate : {120.0, 240.0}) std::printf(" %.4f", drive(lit, body, motion, rate, seconds).jump);
      }
      std::printf(" %.4f (%.3f s), %.2f; rms %.4f, K %.1f, near %.1f\n", fast.jump, fast.at, fast.jump / slow.jump,
                  slow.rms, slow.vectors, slow.near);
      EXPECT_LE(fast.jump, std::max(kShrink * slow.jump, kNoise)) << motion.name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, AutoContinuity,
                         testing::Values(Aim{"auto", "spatial05", Kind::spatialError, 0.05f, {}},
                                         Aim{"auto", "spatial02", Kind::spatialError, 0.02f, {}},
                                         Aim{"auto", "total03", Kind::totalError, 0.03f, {}},
                                         Aim{"auto", "total03near2", Kind::totalError, 0.03f, 2},
                                         Aim{"auto", "budget150ns", Kind::budget, 1500, {}},
                                         Aim{"auto", "budget300ns", Kind::budget, 3000, {}},
                                         Aim{"poly:6", "poly6total03", Kind::totalError, 0.03f, 4},
                                         Aim{"poly:6", "poly6near2", Kind::none, 0, 2}),
                         [](const auto& aim) { return aim.param.name; });

}  // namespace
}  // namespace rigel::test
