// SH of the float path against the 50-digit reference. Errors are taken in 50 digits, so that scales far outside of
// double's comfort do not matter.
#pragma once

#include <rigel/project.h>

#include <string>

#include "lights/describe.h"
#include "reference/projection_reference.h"

namespace rigel::test {

/// ||q - reference|| / ||reference|| of one channel, the reference times the light's colour in that channel.
template <int B>
double relativeError(const RadianceSH<B>& q, const reference::Coefficients50& expected, float colour, int channel = 0) {
  reference::Real50 error = 0, norm = 0;
  for (int i = 0; i < shCount(B); ++i) {
    const reference::Real50 wanted = expected[i] * reference::Real50(colour);
    const reference::Real50 difference = reference::Real50(q[i][channel]) - wanted;
    error += difference * difference;
    norm += wanted * wanted;
  }
  return static_cast<double>(sqrt(error / norm));
}

/// Both vectors side by side.
template <int B>
std::string sideBySide(const RadianceSH<B>& q, const reference::Coefficients50& expected, float colour) {
  std::string text;
  for (int i = 0; i < shCount(B); ++i) {
    text += "\n  " + std::to_string(i) + ": " + describe(q[i].r) + ", expected " +
            describe(static_cast<double>(expected[i] * reference::Real50(colour)));
  }
  return text;
}

}  // namespace rigel::test
