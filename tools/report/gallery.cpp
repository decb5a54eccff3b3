#include "report/gallery.h"

#include "picture/heat_map.h"
#include "picture/image_io.h"
#include "picture/shade_exact.h"
#include "picture/tone_map.h"
#include "report/earlier_pictures.h"
#include "report/picture_names.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rigel::tools {
namespace {

constexpr int kWidth = 560;
constexpr int kHeight = 420;
// Point lights are drawn as balls of at least this share of the object's radius, so that one sees where light comes
// from.
constexpr float kLightMarker = 0.02f;
constexpr float kLightBrightness = 1.2f;  // bright, with its colour still seen
// Below this top of the scale a heat map would magnify what no one can see.
constexpr float kLeastHeatScale = 0.05f;

/// The object's place among those of the scene that get pictures.
std::size_t numberOf(const SceneObject& wanted, std::span<const SceneObject> objects) {
  std::size_t number = 0;
  for (const SceneObject& object : objects) {
    if (&object == &wanted) break;
    if (!object.isStatic) ++number;
  }
  return number;
}

/// The picture of one frame, cast once and shaded many times.
class Photographer {
 public:
  Photographer(const Scene& scene, std::span<const SceneObject> objects, const ScenePose& pose, const LightSet& lights,
               const ObjectRun& run, std::optional<float> wrap)
      : run_(run) {
    poseObject(scene, run.object(), pose, posed_);
    const BoundingSphere sphere = boundingSphere(posed_.positions);
    RayCaster caster;
    caster.add(run.object(), posed_);
    PosedObject scenery;
    for (const SceneObject& object : objects) {
      if (&object == &run.object()) continue;
      poseObject(scene, object, pose, scenery);
      caster.add(object, scenery, SampleKind::scenery);
    }
    addLights(caster, lights, kLightMarker * sphere.radius, kLightBrightness);
    surface_ = caster.cast(framePoints(posed_.positions, kWidth, kHeight));
    if (wrap)
      for (VisibleSample& sample : surface_.samples) sample.wrap = *wrap;

    exact_ = exactIrradiance(surface_, lights);
    exposure_ = autoExposure(surface_, shade(surface_, exact_));
    for (std::size_t i = 0; i < surface_.samples.size(); ++i) {
      const VisibleSample& sample = surface_.samples[i];
      if (sample.kind != SampleKind::object) continue;
      objectSamples_.push_back(i);
      points_.push_back({sample.position, sample.normal});
      wraps_.push_back(sample.wrap);
    }
  }

  const std::vector<Rgb>& truth() const { return exact_; }

  /// Irradiance at every sample as a rig of the run, lit to this frame, gives it: clamped, scenery by the truth. Near
  /// lights that fade after a switch or a teleport are shown as they end up.
  std::vector<Rgb> irradianceOf(std::size_t rigIndex, std::size_t frame, const LightSet& lights) const {
    run_.relight(rigIndex, frame, posed_, lights);
    RigRunner& rig = run_.rig(rigIndex);
    std::vector<RigRunner::Shaded> shaded(points_.size());
    rig.shade(points_, wraps_, shaded);
    std::vector<Rgb> all = exact_;
    for (std::size_t i = 0; i < shaded.size(); ++i) all[objectSamples_[i]] = shaded[i].clamped();
    return all;
  }

  Image radiance(std::span<const Rgb> irradiance) const {
    return resolve(surface_, shade(surface_, irradiance, 1 / exposure_));
  }
  Image8 display(const Image& radiance) const { return toneMap(radiance, exposure_); }

  /// rig - truth over the run's mean exact irradiance, per sample and channel; 0 off the object.
  std::vector<Rgb> relativeError(std::span<const Rgb> irradiance) const {
    const double mean = run_.meanIrradiance();
    const float scale = mean > 0 ? static_cast<float>(1 / mean) : 0;
    std::vector<Rgb> error(exact_.size());
    for (std::size_t i : objectSamples_) error[i] = (irradiance[i] - exact_[i]) * scale;
    return error;
  }

  double rms(std::span<const Rgb> error) const {
    double squares = 0;
    double weight = 0;
    for (std::size_t i : objectSamples_) {
      const double magnitude = static_cast<double>(magnitudeOf(error[i]));
      const double w = static_cast<double>(surface_.samples[i].weight);
      squares += w * magnitude * magnitude;
      weight += w;
    }
    return weight > 0 ? std::sqrt(squares / weight) : 0;
  }

  float heatScaleOf(std::span<const Rgb> error) const { return heatScale(surface_, magnitudes(error)); }
  Image8 heat(std::span<const Rgb> error, float top) const { return heatMap(surface_, magnitudes(error), top); }
  Image errorImage(std::span<const Rgb> error) const { return resolve(surface_, error); }

 private:
  static float magnitudeOf(Rgb e) { return std::sqrt((e.r * e.r + e.g * e.g + e.b * e.b) / 3); }
  static std::vector<float> magnitudes(std::span<const Rgb> error) {
    std::vector<float> out;
    out.reserve(error.size());
    for (Rgb e : error) out.push_back(magnitudeOf(e));
    return out;
  }

  const ObjectRun& run_;
  PosedObject posed_;
  VisibleSurface surface_;
  std::vector<Rgb> exact_;  // all samples
  float exposure_ = 1;
  std::vector<std::size_t> objectSamples_;  // into surface_.samples; points_ and wraps_ are theirs
  std::vector<PointAndNormal> points_;
  std::vector<float> wraps_;
};

/// Writes one picture as OpenEXR and PNG; keeps the PNG's bytes for the page.
class PictureWriter {
 public:
  explicit PictureWriter(std::filesystem::path directory) : directory_(std::move(directory)) {}

  std::optional<Error> write(const std::string& stem, const Image& linear, const Image8& display, std::string& exr,
                             std::string& png, std::vector<std::uint8_t>& bytes) const {
    const std::string folder = std::string(kImageFolder) + "/";
    if (auto written = writeExr(linear, directory_ / (stem + ".exr")); !written) return written.error();
    auto encoded = encodePng(display);
    if (!encoded) return encoded.error();
    if (auto written = writeEncodedPng(*encoded, directory_ / (stem + ".png")); !written) return written.error();
    exr = folder + stem + ".exr";
    png = folder + stem + ".png";
    bytes = *std::move(encoded);
    return std::nullopt;
  }

 private:
  std::filesystem::path directory_;
};

}  // namespace

Result<std::vector<Picture>> photograph(const Scene& scene, std::span<const SceneObject> objects, const ScenePose& pose,
                                        const LightSet& lights, const ObjectRun& run, FrameLabel frame,
                                        const RunOptions& options, const GalleryFiles& files) {
  std::error_code code;
  std::filesystem::create_directories(files.directory, code);
  if (code) return Error{"cannot make the directory: " + code.message(), files.directory.string()};

  const Photographer photographer(scene, objects, pose, lights, run, options.wrap);
  const PictureWriter writer(files.directory);
  const std::string stem =
      pictureNameStem(files.prefix, numberOf(run.object(), objects), run.object().name, frame.number);

  std::vector<Picture> pictures(1);
  Picture& truth = pictures.front();
  truth.label = "truth";
  truth.time = frame.time;
  truth.frame = frame.number;
  const Image truthImage = photographer.radiance(photographer.truth());
  if (auto error = writer.write(stem + "truth", truthImage, photographer.display(truthImage), truth.imageExr,
                                truth.imagePng, truth.imageBytes))
    return *error;

  struct Shaded {
    std::vector<Rgb> irradiance, error;
  };
  std::vector<Shaded> shaded;
  // One scale for all rigs of the frame, or their heat maps could not be compared: that of the best one, whose errors
  // would be black on any other's.
  float top = std::numeric_limits<float>::infinity();
  for (std::size_t r = 0; r < run.rigCount(); ++r) {
    auto irradiance = photographer.irradianceOf(r, frame.index, lights);
    auto error = photographer.relativeError(irradiance);
    top = std::min(top, std::max(kLeastHeatScale, photographer.heatScaleOf(error)));
    shaded.push_back({std::move(irradiance), std::move(error)});
  }

  std::vector<std::string> specs;
  for (std::size_t r = 0; r < run.rigCount(); ++r) specs.push_back(run.rig(r).rig().spec().text);
  const std::vector<std::string> rigNames = rigNameParts(specs);
  for (std::size_t r = 0; r < shaded.size(); ++r) {
    Picture picture;
    picture.label = specs[r];
    picture.time = frame.time;
    picture.frame = frame.number;
    picture.rms = photographer.rms(shaded[r].error);
    picture.heatMapMax = static_cast<double>(top);
    const Image image = photographer.radiance(shaded[r].irradiance);
    const std::string name = stem + rigNames[r];
    if (auto error = writer.write(name, image, photographer.display(image), picture.imageExr, picture.imagePng,
                                  picture.imageBytes))
      return *error;
    if (auto error = writer.write(name + "-error", photographer.errorImage(shaded[r].error),
                                  photographer.heat(shaded[r].error, top), picture.errorExr, picture.errorPng,
                                  picture.errorBytes))
      return *error;
    pictures.push_back(std::move(picture));
  }
  return pictures;
}

}  // namespace rigel::tools
