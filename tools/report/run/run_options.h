// What `rigel report` is asked to do, checked and parsed.
#pragma once

#include <rigel/light_budget.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rigel::tools {

inline constexpr double kDefaultRate = 30;  // frames a second
inline constexpr double kMinRate = 1;
inline constexpr double kMaxRate = 1000;

/// --rig where nothing is said.
inline constexpr const char* kDefaultRigs =
    "constant;gradient;mixed:l3,g,c;lattice:3x2x2;lattice:8x4x2;poly:6;poly:12;auto";

/// --exposure at most: from the dimmest photometric file to a sun in lux it takes less.
inline constexpr float kMaxExposure = 1e6f;

/// A:B:STEP in frames of the clip, B inclusive; `last` empty: to the end.
struct FrameRange {
  int first = 0;
  std::optional<int> last;
  int step = 1;
};

/// "A:B:STEP", with A, B and :STEP left out at will; "A" is one frame.
Result<FrameRange> parseFrameRange(const std::string& text);

/// --near: how many lights a rig may leave to exact evaluation at every point, or that it chooses that itself.
struct NearChoice {
  bool automatic = false;
  int slots = 0;  // where it is not automatic
};

/// "K" or "auto".
Result<NearChoice> parseNear(const std::string& text);

/// --error where nothing is said: errors of a twentieth of the mean light are hard to see in motion.
inline constexpr LightingTarget kDefaultTarget{LightingTarget::Kind::spatialError, 0.05f};
inline constexpr float kMaxErrorTarget = 1;  // as large as the light itself
/// And under --budget-us, of the error that is seen: time spent on less than this is not seen.
inline constexpr LightingTarget kBudgetTarget{LightingTarget::Kind::totalError, 0.02f};
inline constexpr float kMaxBudget = 1'000'000;  // us

class PointShading;

struct RunOptions {
  std::vector<std::string> scenes;
  std::vector<RigSpec> rigs;
  std::string clip;  // "" the first, "all" every one, else by name
  FrameRange frames;
  double rate = kDefaultRate;            // frames a second of the clip, which `frames` counts
  std::optional<NearChoice> near;        // empty: automatic for `auto` rigs, none for the others
  std::optional<LightingTarget> target;  // of the rigs that choose: an error; empty: kDefaultTarget, kBudgetTarget
  std::optional<float> budget;           // modelled us a frame for all objects together, with a rig that chooses
  std::optional<float> wrap;             // overrides the materials'
  int bands = 3;
  float exposure = 1;
  /// Further clocks that start over [s], of a run that was captured: each is a cut, not a movement
  /// (Timeline::followsOn).
  std::vector<double> loops;
  std::string settingsNote;  // which of these came out of the scene's own settings; "" for none
  std::string lights;        // donor scene of --lights, or ""
  bool images = true;
  int samples = 4096;
  CostModel cost = CostModel::cpu();  // of who shades
  /// Makes who evaluates a rig at points (RigRunner::setShading); empty: the CPU.
  std::function<std::unique_ptr<PointShading>()> shading;
};

/// The first value that no run can serve, named by its option: not finite, or outside its range. For who fills
/// RunOptions (a program's user gets it as bad use); runReport asks again.
std::optional<Error> checkOptions(const RunOptions& options);

/// Does the rig choose in each frame: an `auto` rig always, a fixed one its near lights under --near auto?
bool chooses(const RigSpec& rig, const RunOptions& options);

/// The error that rigs which choose aim at.
LightingTarget targetOf(const RunOptions& options);

/// What is asked of one rig of the run. Reference irradiance and wrap are left for who knows the object.
LightingOptions lightingOptions(const RigSpec& rig, const RunOptions& options);

/// The options that govern what a rig chooses, as a user types them: "--near auto --error 0.05"; "" for a rig that
/// chooses nothing and has no near lights.
std::string choiceOptions(const RigSpec& rig, const RunOptions& options);

/// The options that say what to aim at, as a user types them: "--error 0.05", "--total-error 0.03 --budget-us 1500".
std::string aimOptions(const std::optional<LightingTarget>& target, const std::optional<float>& budget);

/// Called often during long work with the share done in [0, 1] and what is being done.
using Progress = std::function<void(double share, const std::string& what)>;

}  // namespace rigel::tools
