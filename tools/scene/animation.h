// One animation channel at one moment.
#pragma once

#include "scene/scene.h"

namespace rigel::tools {

/// Writes `channel.width` floats to `out`: the channel at `time` [s], clamped to its first and last key (NaN counts as
/// before the first). Rotations come out as unit quaternions x, y, z, w; linear ones by shortest-arc slerp. glTF 2.0,
/// appendix C. No allocation.
void sampleChannel(const Channel& channel, double time, float* out) noexcept;

}  // namespace rigel::tools
