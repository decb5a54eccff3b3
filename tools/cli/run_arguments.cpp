#include "cli/run_arguments.h"

#include <rigel/sh.h>
#include <rigel/wrap.h>

#include <fmt/format.h>

namespace rigel::tools {

void RunArguments::addScene(CLI::App& app) {
  app_ = &app;
  app.add_option("--clip", clip_, "Animation clip by name, or 'all' [the first]");
  app.add_option("--frames", frames_, "FIRST:LAST:STEP in frames of the clip, counted at --rate")
      ->capture_default_str();
  app.add_option("--rate", rate_, "Frames a second at which the clip is looked at")->capture_default_str();
  app.add_option("--wrap", wrap_, "Wrap reflectance of everything; 0 is Lambert [the materials']")
      ->check(CLI::Range(kMinWrap, kMaxWrap));
  app.add_option(
      "--lights", lights_,
      "Take the lights of another scene, scaled to this one's size (as they stand, where it has lights alone)");
  app.add_option("--exposure", exposure_, "Multiplies all light")->capture_default_str();
}

void RunArguments::add(CLI::App& app) {
  addScene(app);
  app.add_option("--near", near_,
                 "Lights evaluated exactly at every point: a number, or auto [auto for `auto` rigs, 0 for others]");
  app.add_option("--error", error_, "What `auto` and --near auto aim at: spatial RMS error over the mean light [0.05]");
  app.add_option("--total-error", totalError_, "The same for the total RMS error");
  app.add_option("--budget-us", budget_,
                 "Time for all objects of a frame together, in modelled microseconds, 10000 points an object:\n"
                 "what each aims at is then given up where it shows least [no limit]");
  app.add_option("--bands", bands_, "SH bands")->capture_default_str()->check(CLI::Range(kMinBands, kMaxBands));
}

std::optional<LightingTarget> RunArguments::target() const {
  using Kind = LightingTarget::Kind;
  if (error_) return LightingTarget{Kind::spatialError, *error_};
  if (totalError_) return LightingTarget{Kind::totalError, *totalError_};
  return std::nullopt;
}

bool RunArguments::given(const std::string& option) const {
  return app_ != nullptr && app_->get_option_no_throw(option) != nullptr && app_->count(option) > 0;
}

std::vector<std::string> RunArguments::adopt(const RunSettings& settings) {
  std::vector<std::string> taken;
  const auto take = [&](const char* name, const auto& from, auto& to, bool overridden) {
    if (!from || overridden) return;
    to = *from;
    taken.push_back(name);
  };
  take("clip", settings.clip, clip_, given("--clip"));
  take("frames", settings.frames, frames_, given("--frames"));
  take("rate", settings.rate, rate_, given("--rate"));
  take("near", settings.near, near_, given("--near"));
  const bool aims = given("--error") || given("--total-error");  // only one of the two can be aimed at
  take("error", settings.error, error_, aims);
  take("total_error", settings.totalError, totalError_, aims);
  take("budget_us", settings.budget, budget_, given("--budget-us"));
  take("wrap", settings.wrap, wrap_, given("--wrap"));
  take("bands", settings.bands, bands_, given("--bands"));
  take("exposure", settings.exposure, exposure_, given("--exposure"));
  if (lights_.empty()) loops_ = settings.loops;
  return taken;
}

Result<RunOptions> RunArguments::options() const {
  RunOptions options;
  const auto frames = parseFrameRange(frames_);
  if (!frames) return frames.error();
  options.clip = clip_;
  options.frames = *frames;
  options.rate = rate_;
  if (!near_.empty()) {
    const auto near = parseNear(near_);
    if (!near) return near.error();
    options.near = *near;
  }
  if (error_ && totalError_)
    return Error{"only one of the two can be aimed at",
                 fmt::format("--error {:g} --total-error {:g}", *error_, *totalError_)};
  options.target = target();
  options.budget = budget_;
  options.wrap = wrap_;
  options.bands = bands_;
  options.exposure = exposure_;
  options.lights = lights_;
  options.loops = loops_;
  return options;
}

std::string RunArguments::text() const {
  std::string line;
  if (!clip_.empty()) line += " --clip " + clip_;
  if (frames_ != defaultFrames_) line += " --frames " + frames_;
  if (rate_ != kDefaultRate) line += fmt::format(" --rate {}", rate_);
  if (!near_.empty()) line += " --near " + near_;
  if (const std::string aim = aimOptions(target(), budget_); !aim.empty()) line += " " + aim;
  if (wrap_) line += fmt::format(" --wrap {}", *wrap_);
  if (bands_ != kDefaultBands) line += fmt::format(" --bands {}", bands_);
  if (exposure_ != 1) line += fmt::format(" --exposure {}", exposure_);
  if (!lights_.empty()) line += " --lights " + lights_;
  return line;
}

}  // namespace rigel::tools
