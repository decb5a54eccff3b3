// How a captured run was asked for: extras.rigel.settings of a glTF file, so that a bug report is one file.
#pragma once

#include "report/run/run_options.h"

#include <string_view>

namespace rigel::tools {

/// What a file may say of a run; what it leaves out is empty. Values are those that the options allow.
struct RunSettings {
  std::optional<std::string> rigs, clip, frames, near;
  std::optional<double> rate;
  std::optional<float> error, totalError, budget;
  std::optional<float> wrap, exposure;
  std::optional<int> bands;
  std::vector<double> loops;
  std::vector<std::string> notes;  // names that are not known
};

/// Parses the JSON text of Scene::settings. Errors name the place, /extras/rigel/settings/NAME, and what it allows.
Result<RunSettings> parseRunSettings(std::string_view json);

/// The settings of a run as JSON text: all that its options say but scenes, borrowed lights and pictures. `clip` and
/// `exposure` are the run's own.
std::string runSettingsText(const RunOptions& options);

}  // namespace rigel::tools
