// Where a rig's error comes from, where on the body it is and how it is distributed: figures of a report.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rigel::tools {

/// In the order in which the steps lead from the exact irradiance to what the rig gives; README.md defines them.
enum class ErrorCause { nearForm, truncation, lightModel, spatial, precision };
inline constexpr std::size_t kErrorCauses = 5;
inline constexpr std::array<const char*, kErrorCauses> kErrorCauseNames = {"near form", "truncation", "light model",
                                                                           "spatial", "precision"};

/// Squares of errors relative to the mean irradiance, mean over samples, channels and frames. The parts' squares and
/// the interaction add up to `total`, the square of the total RMS.
struct ErrorParts {
  struct Part {
    double square = 0;
    double without = 0;  // of the total square, if this cause alone were gone
  };
  std::array<Part, kErrorCauses> parts;
  double interaction = 0;  // twice the mean products of all pairs of parts; negative where causes cancel
  double total = 0;
  double unclamped = 0;  // the total square, if the rig's part were not clamped at 0
};

/// A glTF node or joint, or several that hang together. A part comes after the one that it hangs from.
struct BodyPartErrors {
  std::string name;
  int parent = -1;  // index of the part that it hangs from, -1 for none
  int nodes = 1;    // nodes and joints taken together
  std::size_t samples = 0;
  double area = 0;                    // share of the object's, in the rest pose
  double share = 0;                   // of the squared error
  double rms = 0, max = 0, mean = 0;  // relative; mean is signed
};

/// How often errors of which size occur, over samples, channels and frames; relative errors.
struct ErrorHistogram {
  /// Absolute errors: bin i holds those from least 10^(i/perDecade) on; the first and the last, what is beyond, too.
  static constexpr double kLeast = 1e-5;
  static constexpr int kPerDecade = 8, kAbsoluteBins = 48;
  std::array<std::uint64_t, kAbsoluteBins> absolute{};

  /// Signed errors: equal bins from -limit to limit (p99, or kLeast if that is larger), and what is below and above.
  static constexpr int kSignedBins = 51;
  double limit = 0;
  std::array<std::uint64_t, kSignedBins> signedBins{};
  std::uint64_t below = 0, above = 0;

  double p50 = 0, p90 = 0, p99 = 0;  // of absolute errors
};

}  // namespace rigel::tools
