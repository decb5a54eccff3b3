// What `rigel report` is asked to do, checked and parsed.
#pragma once

#include <rigel/rig_spec.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rigel::tools {

inline constexpr double kFramesPerSecond = 30;

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

struct RunOptions {
  std::vector<std::string> scenes;
  std::vector<RigSpec> rigs;
  std::string clip;  // "" the first, "all" every one, else by name
  FrameRange frames;
  std::optional<float> wrap;  // overrides the materials'
  int bands = 3;
  float exposure = 1;
  std::string lights;  // donor scene of --lights, or ""
  bool images = true;
  int samples = 4096;
};

/// The first value that no run can serve, named by its option: not finite, or outside its range. For who fills
/// RunOptions (a program's user gets it as bad use); runReport asks again.
std::optional<Error> checkOptions(const RunOptions& options);

/// Called often during long work with the share done in [0, 1] and what is being done.
using Progress = std::function<void(double share, const std::string& what)>;

}  // namespace rigel::tools
