// The options that every subcommand which runs a scene understands: what is looked at, when, and how its rigs choose.
#pragma once

#include "report/run/run_settings.h"

#include <CLI/CLI.hpp>

namespace rigel::tools {

/// As typed. Add to a command with `add`, then read with `options`.
class RunArguments {
 public:
  /// `frames` is what --frames is without being given.
  explicit RunArguments(std::string frames = "0:") : defaultFrames_(std::move(frames)), frames_(defaultFrames_) {}

  void add(CLI::App& app);
  /// Without what governs the rigs' choices, for who runs many rigs of his own: what is looked at, and when.
  void addScene(CLI::App& app);

  /// Everything but scenes, rigs and images. Error: names the option and what it allows.
  Result<RunOptions> options() const;

  bool framesGiven() const { return frames_ != defaultFrames_; }

  /// Takes what the scene's own settings say where no option was given; returns the names of what was taken. With
  /// --lights the settings' loops, which are those of captured lights, are left.
  std::vector<std::string> adopt(const RunSettings& settings);

  /// The options that were given, as typed, each with a blank before it.
  std::string text() const;

 private:
  std::optional<LightingTarget> target() const;
  bool given(const std::string& option) const;

  const CLI::App* app_ = nullptr;
  std::vector<double> loops_;
  std::string clip_;
  std::string defaultFrames_, frames_;
  double rate_ = kDefaultRate;
  std::string near_;
  std::optional<float> error_, totalError_, budget_;
  std::optional<float> wrap_;
  int bands_ = kDefaultBands;
  float exposure_ = 1;
  std::string lights_;
};

}  // namespace rigel::tools
