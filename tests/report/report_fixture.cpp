#include "report_fixture.h"

#include "view_fixture.h"

#include "picture/flip.h"
#include "picture/tone_map.h"
#include "report/pictures/pixel_packing.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace rigel::tests {
namespace {

using tools::ObjectReport;
using tools::Picture;
using tools::Report;
using tools::RigReport;
using tools::SceneReport;

struct MadeUpRig {
  const char* spec;
  double shVectors;
  int projections;
  double spatial, total, fit, shade;
  double nearLights = 0;
};

constexpr MadeUpRig kRigs[] = {
    {"constant", 1, 1, 0.360, 0.371, 0.9, 4.1},           {"gradient", 4, 4, 0.158, 0.176, 3.4, 7.9},
    {"mixed:l3,g,c", 6, 12, 0.194, 0.208, 9.8, 13.0},     {"lattice:3x2x2", 12, 12, 0.097, 0.121, 9.1, 31.5},
    {"lattice:8x4x2", 64, 64, 0.045, 0.0801, 49.0, 33.2}, {"poly:6", 6, 12, 0.092, 0.117, 10.4, 11.8},
    {"poly:12", 12, 24, 0.047, 0.0815, 22.3, 21.9},       {"auto", 5.5, 24, 0.041, 0.0611, 48.0, 43.5, 1.3},
};

double wave(double time, double phase) { return 0.5 + 0.5 * std::sin(3.1 * time + phase); }

constexpr float kHeatScale = 0.5f;
constexpr double kMeanIrradiance = 3.71;

/// Pictures of one moment as the program takes them.
struct Moment {
  std::vector<Picture> files;
  tools::PixelFrame pixels;
};

/// A ball under a lamp that passes with time, on a dim floor; `softness` blurs its light as a poor rig would.
Moment moment(int frame, double time, bool full) {
  const int width = full ? 240 : 80, height = full ? 160 : 53;
  const auto light = [&](double x, double y, double softness) {
    const double z = std::sqrt(std::max(0.0, 1 - x * x - y * y));
    const double lx = std::cos(1.4 * time), ly = -0.6, lz = 0.5;
    return 9 * std::max(0.0, (x * lx + y * ly + z * lz) / 1.27 * (1 - softness) + 0.4 * softness);
  };
  tools::Image reflectance(width, height), surroundings(width, height), truth(width, height);
  std::vector<tools::Image> rigs(std::size(kRigs), truth);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const auto i = static_cast<std::size_t>(row * width + column);
      const double x = (column + 0.5 - width / 2.0) * 3.4 / width, y = (row + 0.5 - height / 2.0) * 2.3 / height;
      const bool onBall = x * x + y * y <= 1, onFloor = y > 0.7;
      const auto set = [i](tools::Image& image, double value) {
        for (std::size_t c = 0; c < 3; ++c)
          image.rgb[3 * i + c] = tools::roundedToHalf(static_cast<float>(value * (1 - 0.15 * static_cast<double>(c))));
      };
      if (onBall) {
        truth.coverage[i] = 1;
        set(reflectance, 0.2);
        set(truth, light(x, y, 0));
        for (std::size_t r = 0; r < rigs.size(); ++r) set(rigs[r], light(x, y, 2 * kRigs[r].total));
      } else if (onFloor) {
        set(surroundings, 0.1);
      }
      surroundings.coverage[i] = onBall || onFloor ? 1 : 0;
    }
  }
  Moment result;
  result.pixels = tools::packFrame({reflectance, surroundings, truth, rigs}, 1, full ? 0 : 3);
  result.pixels.frame = frame;
  result.pixels.time = time;
  result.pixels.exposure = 0.45f;
  result.pixels.heatScale = kHeatScale;
  for (std::size_t r = 0; r < rigs.size(); ++r) result.pixels.rigs[r].rms = kRigs[r].total;
  if (!full) return result;
  const auto file = [&](const char* label) -> Picture& {
    Picture& picture = result.files.emplace_back();
    picture.label = label;
    picture.frame = frame;
    picture.time = time;
    const std::string stem = "images/" + std::to_string(frame) + "-" + std::to_string(result.files.size());
    picture.imagePng = stem + ".png";
    picture.imageExr = stem + ".exr";
    return picture;
  };
  const auto shown = [&](const tools::Image& irradiance) {
    tools::Image image = surroundings;
    for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] += reflectance.rgb[i] * irradiance.rgb[i];
    return tools::toneMap(image, result.pixels.exposure);
  };
  const tools::Flip flip(shown(truth));
  const auto meanFlip = [&](const tools::Image& irradiance) {
    const std::vector<float> errors = flip.against(shown(irradiance));
    double sum = 0, pixels = 0;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      if (truth.coverage[i] == 0) continue;
      sum += static_cast<double>(errors[i]);
      ++pixels;
    }
    return sum / pixels;
  };
  file("truth");
  for (const MadeUpRig& made : kRigs) {
    Picture& picture = file(made.spec);
    picture.errorPng = "images/error-" + std::to_string(result.files.size()) + ".png";
    picture.heatMapMax = static_cast<double>(kHeatScale);
    picture.rms = made.total;
    picture.flip = meanFlip(rigs[static_cast<std::size_t>(&made - kRigs)]);
  }
  return result;
}

/// Weight of a lamp that is near around its own moment.
float lampWeight(double time, double moment) {
  const double x = std::clamp(2.0 - 4 * std::abs(time - moment), 0.0, 1.0);
  return static_cast<float>(x * x * (3 - 2 * x));
}

/// Three lights that pass one after another, one that is culled at times, and many small ones.
std::vector<tools::LightReport> lightUses(const std::vector<tools::LightRow>& rows, int frames, bool choosing) {
  std::vector<tools::LightReport> uses;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    tools::LightReport& use = uses.emplace_back();
    use.name = rows[i].name;
    use.type = rows[i].type;
    const bool passes = i < 3;
    use.share = passes ? 0.2 : 0.4 / static_cast<double>(rows.size() - 3);
    for (int f = 0; f < frames; ++f) {
      const double time = f / 30.0;
      const float w = passes && choosing ? lampWeight(time, 0.4 + 0.6 * static_cast<double>(i)) : 0;
      use.roles.push_back(w == 1                      ? LightRole::exact
                          : w > 0                     ? LightRole::blended
                          : i % 5 == 4 && f % 20 > 12 ? LightRole::culled
                                                      : LightRole::inRig);
      use.weights.push_back(w);
      const double size = passes
                              ? 0.02 + 0.3 * static_cast<double>(lampWeight(time, 0.4 + 0.6 * static_cast<double>(i)))
                              : 0.02 / static_cast<double>(i);
      use.bounds.push_back(static_cast<float>(size));
      use.bound = std::max(use.bound, size);
    }
    if (!passes || !choosing) use.weights.clear();
    if (i > 12 || !choosing) use.bounds.clear();
    use.why = passes && choosing
                  ? "near in frames 12-18: in the rig it could be wrong by 32.0 % of the mean light (target 5.00 %)"
                  : "far: in the rig it is wrong by at most 0.66 % of the mean light";
  }
  return uses;
}

/// Spatial error, and truncation that half makes up for it.
void breakDown(RigReport& rig, std::size_t samples, int frames) {
  const double total = rig.total.rms * rig.total.rms,
               spatial = std::min(0.9 * total, rig.spatial.rms * rig.spatial.rms);
  tools::ErrorParts& parts = rig.parts.emplace();
  parts.total = total;
  parts.unclamped = 1.04 * total;
  const double squares[tools::kErrorCauses] = {1e-9 * total, 1.2 * (total - spatial), 2e-12 * total, spatial,
                                               1e-12 * total};
  parts.interaction = total;
  for (const double square : squares) parts.interaction -= square;
  for (std::size_t k = 0; k < tools::kErrorCauses; ++k)
    parts.parts[k] = {squares[k], total - squares[k] - (squares[k] > 1e-6 * total ? parts.interaction : 0)};

  constexpr struct {
    const char* name;
    int parent;
    double area, error;
  } kParts[] = {{"body", -1, 0.55, 0.8},       {"door, left", 0, 0.15, 1.1},        {"mirror", 1, 0.01, 2.2},
                {"door, right", 0, 0.15, 1.2}, {"wheel front left", -1, 0.07, 0.9}, {"wheel front right", -1, 0.07, 1}};
  for (const auto& part : kParts) {
    rig.bodyParts.push_back({part.name, part.parent, part.parent < 0 ? 3 : 1,
                             static_cast<std::size_t>(part.area * static_cast<double>(samples)), part.area,
                             part.area * part.error * part.error, part.error * rig.total.rms,
                             part.error * rig.total.max / 2.2, (part.error - 1) * rig.total.rms});
  }

  tools::ErrorHistogram& histogram = rig.histogram.emplace();
  const double count = 3.0 * static_cast<double>(samples * static_cast<std::size_t>(frames));
  const auto bell = [](double x) { return std::exp(-x * x / 2); };
  for (std::size_t i = 0; i < histogram.absolute.size(); ++i) {
    const double size = histogram.kLeast * std::pow(10, (static_cast<double>(i) + 0.5) / histogram.kPerDecade);
    histogram.absolute[i] = static_cast<std::uint64_t>(count / 12 * bell(1.2 * std::log(size / rig.total.rms * 1.5)));
  }
  histogram.p50 = 0.6 * rig.total.rms;
  histogram.p90 = 1.7 * rig.total.rms;
  histogram.p99 = histogram.limit = 3.2 * rig.total.rms;
  for (std::size_t i = 0; i < histogram.signedBins.size(); ++i) {
    const double error = 3.2 * (2.0 * static_cast<double>(i) / (histogram.kSignedBins - 1) - 1);
    histogram.signedBins[i] = static_cast<std::uint64_t>(count / 20 * bell(1.1 * error + 0.2));
  }
  histogram.below = histogram.above = static_cast<std::uint64_t>(count / 200);
}

ObjectReport object(const std::string& name, int frames, double scale, const std::vector<tools::LightRow>& lights) {
  ObjectReport result;
  result.name = name;
  result.triangles = 18432;
  result.samples = 4096;
  result.meanIrradiance = kMeanIrradiance;
  for (int i = 0; i < frames; ++i) {
    const double time = i / 30.0;
    result.truth.push_back({time, 2 + 3 * wave(time, 0), {}});
    const bool startsOver = i == 40;  // a clip, in the middle of the run
    if (i > 0 && !startsOver) result.truth.back().movement = 0.12 * wave(2 * time, 1);
  }
  for (const MadeUpRig& made : kRigs) {
    RigReport rig;
    rig.spec = made.spec;
    rig.shVectors = made.shVectors;
    rig.projections = made.projections;
    rig.spatial = {scale * made.spatial, 6 * scale * made.spatial};
    rig.total = {scale * made.total, 7 * scale * made.total};
    rig.fitMicroseconds = made.fit;
    rig.shadeNanosecondsPerPoint = made.shade;
    rig.bytes = static_cast<std::size_t>(std::ceil(made.shVectors)) * 112;
    rig.nearLights = made.nearLights;
    rig.estimate = 1.1 * rig.spatial.rms;
    rig.totalEstimate = 1.1 * rig.total.rms;
    rig.modelledNanoseconds = 30 + 3.5 * made.shVectors + 25 * made.nearLights;
    const bool choosing = made.nearLights > 0;
    if (choosing) rig.asked = "--near auto --error 0.05";
    rig.lights = lightUses(lights, frames, choosing);
    if (frames > 1) rig.maxJump = 0.4 * made.spatial;
    breakDown(rig, static_cast<std::size_t>(result.samples), frames);
    rig.condition = made.spec[0] == 'p' ? 14.2 : 1;
    rig.stages = {{"project", 0.8 * made.fit}, {"fit", 0.2 * made.fit}};
    for (int i = 0; i < frames; ++i) {
      const double swing = 0.35 + 1.3 * wave(i / 30.0, made.shVectors * 0.1);
      tools::FrameReport& frame = rig.frames.emplace_back();
      frame.time = i / 30.0;
      frame.spatialRms = rig.spatial.rms * swing;
      frame.totalRms = rig.total.rms * swing;
      frame.estimate = frame.spatialRms * (0.95 + 0.3 * wave(frame.time, 2));
      frame.totalEstimate = frame.totalRms * 1.1;
      frame.shVectors = static_cast<int>(choosing ? 3 + 5 * wave(frame.time, 1) : made.shVectors);
      frame.modelledNanoseconds = rig.modelledNanoseconds;
      for (std::size_t l = 0; l < rig.lights.size(); ++l)
        if (choosing && !rig.lights[l].weights.empty() && rig.lights[l].weights[static_cast<std::size_t>(i)] > 0)
          frame.near.push_back(static_cast<int>(l));
    }
    result.rigs.push_back(rig);
  }
  for (const int frame : {0, 10, 20, 30, 40, 50, 60}) {
    if (frame >= frames) continue;
    Moment taken = moment(frame, frame / 30.0, frame == 30 || frames == 1);
    std::ranges::move(taken.files, std::back_inserter(result.pictures));
    result.pixels.push_back(std::move(taken.pixels));
  }
  return result;
}

tools::DiskReport diskReport() {
  tools::DiskReport disks;
  disks.pairs = 3120;
  disks.methods = {
      {"table", "two textures of 32 x 32, float", tools::ErrorFigures{2.1e-5, 1.6e-4}, {0.021, 0.09}, 52.1},
      {"quadrature-6", "6 nodes, float", tools::ErrorFigures{4.1e-7, 3.9e-5}, {0.021, 0.09}, 43.7},
      {"near", "closed form, float", std::nullopt, {2.2e-7, 9.4e-7}, 61.3},
      {"wallace", "Wallace, Elmquist, Haines 1989", std::nullopt, {0.11, 0.87}, 9.2}};
  disks.choice = "Rigs project disks by quadrature with 6 nodes.";
  for (const char* rig : {"constant", "auto"}) {
    disks.uses.push_back({"washer 1", "car", rig, "none", "culled: it gives this object nothing in any frame"});
    disks.uses.push_back({"washer 2", "car", rig, "quadrature-6", "far: in the rig by 6 nodes"});
    disks.uses.push_back({"sconce 4", "car", rig, rig[0] == 'a' ? "near, quadrature-6" : "quadrature-6", "close"});
  }
  return disks;
}

/// Pictures take a quarter of a second: made once.
Report makeReport() {
  Report report;
  report.version = "0.1.0";
  report.commandLine =
      "rigel report sample:street characters/soldier1.gltf --rig \"constant;gradient;mixed:l3,g,c\" --out report";

  SceneReport street;
  street.scene = "sample:street";
  street.clip = "drive";
  street.frames = 61;
  street.seconds = 12.4;
  street.effects = {"point", "spot", "sphere"};
  street.notes = {"material paint: the clearcoat of KHR_materials_clearcoat is left out"};
  street.lights = {{"lamp 1", "sphere", "L 900 860 700 W/(m2 sr), radius 0.12 m"},
                   {"headlight left", "spot", "I 400 400 380 W/sr, 20 to 35 degrees"},
                   {"neon", "point", "I 40 40 36 W/sr, radius 0.05 m"}};
  for (int i = 3; i < 60; ++i) street.lights.push_back({"window " + std::to_string(i), "point", "I 1 1 1 W/sr"});
  street.objects = {object("car", 61, 1.0, street.lights)};
  street.disks = diskReport();
  addMadeUpView(street);

  SceneReport still;
  still.scene = "characters/soldier1.gltf";
  still.lightsFrom = "sample:street";
  still.frames = 1;
  still.seconds = 2.1;
  still.effects = {"point", "wrap"};
  still.objects = {object("soldier", 1, 0.55, {})};

  report.scenes = {street, still};
  return report;
}

}  // namespace

Report madeUpReport() {
  static const Report report = makeReport();
  return report;
}

Report crowdReport() {
  Report report = madeUpReport();
  report.scenes.pop_back();
  SceneReport& scene = report.scenes.front();
  for (const char* name : {"van", "wheel"}) {
    scene.objects.push_back(scene.objects.front());
    scene.objects.back().name = name;
    scene.objects.back().pictures.clear();
    scene.objects.back().pixels.clear();
  }
  for (const char* spec : {"auto", "poly:6"}) {
    scene.budgets.push_back({spec, 2500, spec[0] == 'a' ? std::optional(0.03) : std::nullopt, 2411.5, 2688, 4});
    for (ObjectReport& object : scene.objects) {
      RigReport& rig = *std::ranges::find(object.rigs, spec, &RigReport::spec);
      const double part = object.name == "wheel" ? 1 : 0.5;
      rig.budget = tools::BudgetUse{820, 0.061, {}};
      rig.budget->alone = {820 / part, 0.03 * part, part * rig.spatial.rms, part * rig.total.rms, rig.shVectors, 2};
      if (part == 1) rig.budget->alone->nearLights = rig.nearLights;
    }
  }
  return report;
}

Report smallestReport() {
  Report report = madeUpReport();
  report.scenes.erase(report.scenes.begin());
  SceneReport& scene = report.scenes.front();
  scene.effects.clear();
  scene.objects.front().pictures.clear();
  scene.objects.front().pixels.clear();
  scene.objects.front().rigs.resize(1);
  RigReport& rig = scene.objects.front().rigs.front();
  rig.parts.reset();
  rig.bodyParts.clear();
  rig.histogram.reset();
  return report;
}

Report hostileReport() {
  Report report = madeUpReport();
  SceneReport& scene = report.scenes.front();
  scene.scene = kHostileQuotes;
  scene.clip = "\xE2\x80\xA8 line \xE2\x80\xA9 paragraph";
  scene.notes = {kHostileMarkup, "escape \x1b[2J bell \a"};
  scene.lights.front().name = "\xFF\xC3 no UTF-8 \xED\xA0\x80";
  scene.lights.front().summary = kHostileMarkup;
  scene.disks->uses.front().light = kHostileMarkup;
  scene.disks->uses.front().object = kHostileMarkup;
  scene.objects.front().name = kHostileMarkup;
  scene.objects.front().rigs.front().spec = kHostileSpec;
  for (RigReport& rig : scene.objects.front().rigs) {
    rig.bodyParts[1].name = kHostileMarkup;
    rig.bodyParts[2].name = "\xFF\xC3 no UTF-8 \xED\xA0\x80";
  }
  for (Picture& shown : scene.objects.front().pictures)
    if (shown.label == "constant") shown.label = kHostileSpec;
  report.commandLine = kHostileMarkup;
  // No two of its frames follow on each other.
  for (tools::TruthFrame& frame : scene.objects.front().truth) frame.movement.reset();
  for (RigReport& rig : scene.objects.front().rigs) {
    rig.maxJump.reset();
    if (!rig.lights.empty()) rig.lights.front().name = rig.lights.front().why = kHostileMarkup;
  }
  // Estimates that were not asked for.
  RigReport& first = scene.objects.front().rigs.front();
  first.estimate.reset();
  first.totalEstimate.reset();
  for (tools::FrameReport& frame : first.frames) {
    frame.estimate.reset();
    frame.totalEstimate.reset();
  }
  return report;
}

}  // namespace rigel::tests
