// A run as one file: the scene, the lights as they shone in each frame, and the settings.
#pragma once

#include "report/run/run_options.h"

#include <filesystem>

namespace rigel::tools {

/// Writes a .glb (or .gltf) that `rigel report FILE` runs again without options. A scene under its own lights is kept
/// as it is. Borrowed lights become lights of the scene, with a key for each frame up to the run's last; where they
/// move for longer than the clip, the clip's keys are written out for as long. Key times and directions are then
/// rounded to float: errors of the second run differ by that (README). Error: more than one scene or clip, what loading
/// gives, a file that cannot be written. Returns the bytes written.
Result<std::size_t> writeCapture(const RunOptions& options, const std::filesystem::path& file);

}  // namespace rigel::tools
