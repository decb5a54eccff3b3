#include "report/pictures/gallery.h"

#include "parallel/parallel.h"
#include "picture/flip.h"
#include "picture/image_io.h"
#include "picture/tone_map.h"
#include "report/files/earlier_pictures.h"
#include "report/pictures/picture_names.h"
#include "report/pictures/pixel_packing.h"

#include <algorithm>
#include <limits>

namespace rigel::tools {
namespace {

/// The object's place among those of the scene that get pictures.
std::size_t numberOf(const SceneObject& wanted, std::span<const SceneObject> objects) {
  std::size_t number = 0;
  for (const SceneObject& object : objects) {
    if (&object == &wanted) break;
    if (!object.isStatic) ++number;
  }
  return number;
}

/// All that is shown of a frame, rounded to what half floats hold: files and page then have the same numbers.
struct ShadedFrame {
  std::vector<ShadedRig> rigs;
  Image truth;
  std::vector<Image> irradiance;  // of the rigs
  float scale = 1;                // of the half floats
  // One scale for all rigs, or their heat maps could not be compared: that of the best one, whose errors would be black
  // on any other's.
  float heatScale = std::numeric_limits<float>::infinity();
};

ShadedFrame shadeAll(const Photographer& photographer, const ObjectRun& run, std::size_t frame,
                     const LightSet& lights) {
  ShadedFrame out;
  out.truth = photographer.objectMean(photographer.truth());
  for (std::size_t r = 0; r < run.rigCount(); ++r) {
    out.rigs.push_back(photographer.shade(r, frame, lights));
    out.irradiance.push_back(photographer.objectMean(out.rigs.back().irradiance));
    out.heatScale = std::min(out.heatScale, photographer.heatScaleOf(out.rigs.back().error));
  }
  float largest = 0;
  const auto each = [&](const auto& visit) {
    for (float& v : out.truth.rgb) visit(v);
    for (Image& image : out.irradiance)
      for (float& v : image.rgb) visit(v);
  };
  each([&](float v) { largest = std::max(largest, v); });
  out.scale = halfScale(largest);
  each([&](float& v) { v = roundedToHalf(v, out.scale); });
  return out;
}

/// What two pictures of irradiance differ by, relative to `mean`; coverage 1 where the object is.
Image difference(const Image& rig, const Image& truth, double mean) {
  Image out(truth.width, truth.height);
  for (std::size_t i = 0; i < out.pixelCount(); ++i) out.coverage[i] = truth.coverage[i] > 0 ? 1.0f : 0.0f;
  for (std::size_t i = 0; i < out.rgb.size() && mean > 0; ++i)
    out.rgb[i] = static_cast<float>((static_cast<double>(rig.rgb[i]) - static_cast<double>(truth.rgb[i])) / mean);
  return out;
}

PixelFrame pack(const Photographer& photographer, const ShadedFrame& shaded, FrameLabel frame, int dropped) {
  PixelFrame out = packFrame({photographer.reflectance(), photographer.surroundings(), shaded.truth, shaded.irradiance},
                             shaded.scale, dropped);
  out.frame = frame.number;
  out.time = frame.time;
  out.exposure = photographer.exposure();
  out.heatScale = shaded.heatScale;
  for (std::size_t r = 0; r < out.rigs.size(); ++r) out.rigs[r].rms = photographer.rms(shaded.rigs[r].error);
  return out;
}

/// A mean over the pixels that show the object.
double meanOnObject(std::span<const float> values, const Image& truth) {
  double sum = 0, pixels = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(truth.coverage[i] > 0)) continue;
    sum += static_cast<double>(values[i]);
    ++pixels;
  }
  return pixels > 0 ? sum / pixels : 0;
}

/// A rig's picture, and how different from the truth's it looks.
struct Shown {
  Image radiance;
  Image8 display;
  double flip = 0;
};

std::vector<Shown> showAll(const Photographer& photographer, const ShadedFrame& shaded, const Image8& truth) {
  const Flip flip(truth);
  std::vector<Shown> all(shaded.rigs.size());
  parallelFor(static_cast<int>(all.size()), [&](int r) {
    const auto i = static_cast<std::size_t>(r);
    Shown& shown = all[i];
    shown.radiance = photographer.radiance(shaded.rigs[i].irradiance);
    shown.display = toneMap(shown.radiance, photographer.exposure());
    shown.flip = meanOnObject(flip.against(shown.display), shaded.truth);
  });
  return all;
}

/// Writes one picture as OpenEXR and PNG.
class PictureWriter {
 public:
  PictureWriter(std::filesystem::path directory, ExrDepth depth) : directory_(std::move(directory)), depth_(depth) {}

  std::optional<Error> write(const std::string& stem, const Image& linear, const Image* irradiance,
                             const Image8& display, std::string& exr, std::string& png) const {
    const std::string folder = std::string(kImageFolder) + "/";
    const ExrLayer layer{"irradiance", irradiance};
    const std::span<const ExrLayer> layers(&layer, irradiance ? 1 : 0);
    if (auto written = writeExr(linear, layers, directory_ / (stem + ".exr"), depth_); !written) return written.error();
    if (auto written = writePng(display, directory_ / (stem + ".png")); !written) return written.error();
    exr = folder + stem + ".exr";
    png = folder + stem + ".png";
    return std::nullopt;
  }

 private:
  std::filesystem::path directory_;
  ExrDepth depth_;
};

}  // namespace

Result<FramePictures> photograph(const PosedScene& scene, const ObjectRun& run, FrameLabel frame,
                                 const RunOptions& options, std::optional<float> exposure, const GalleryFiles& files) {
  std::error_code code;
  std::filesystem::create_directories(files.directory, code);
  if (code) return Error{"cannot make the directory: " + code.message(), files.directory.string()};

  const Photographer photographer(scene, run, options.wrap, kPictureSize, exposure);
  const ShadedFrame shaded = shadeAll(photographer, run, frame.index, scene.lights);
  // Numbers beyond the range of half floats are half floats times a power of two, which a float holds.
  const PictureWriter writer(files.directory, shaded.scale == 1 ? ExrDepth::half : ExrDepth::full);
  const std::string stem =
      pictureNameStem(files.prefix, numberOf(run.object(), scene.objects), run.object().name, frame.number);

  FramePictures out{std::vector<Picture>(1), pack(photographer, shaded, frame, 0)};
  Picture& truth = out.pictures.front();
  truth.label = "truth";
  truth.time = frame.time;
  truth.frame = frame.number;
  const Image seen = photographer.radiance(photographer.truth());
  const Image8 truthDisplay = toneMap(seen, photographer.exposure());
  if (auto error = writer.write(stem + "truth", seen, &shaded.truth, truthDisplay, truth.imageExr, truth.imagePng))
    return *error;

  std::vector<std::string> specs;
  for (std::size_t r = 0; r < run.rigCount(); ++r) specs.push_back(run.rig(r).rig().spec().text);
  const std::vector<std::string> rigNames = rigNameParts(specs);
  const std::vector<Shown> shown = showAll(photographer, shaded, truthDisplay);
  for (std::size_t r = 0; r < specs.size(); ++r) {
    const ShadedRig& rig = shaded.rigs[r];
    Picture picture;
    picture.label = specs[r];
    picture.time = frame.time;
    picture.frame = frame.number;
    picture.rms = out.pixels.rigs[r].rms;
    picture.heatMapMax = static_cast<double>(shaded.heatScale);
    picture.flip = shown[r].flip;
    const Image error = difference(shaded.irradiance[r], shaded.truth, run.meanIrradiance());
    const std::string name = stem + rigNames[r];
    if (auto failed = writer.write(name, shown[r].radiance, &shaded.irradiance[r], shown[r].display, picture.imageExr,
                                   picture.imagePng))
      return *failed;
    if (auto failed = writer.write(name + "-error", error, nullptr, photographer.heat(rig.error, shaded.heatScale),
                                   picture.errorExr, picture.errorPng))
      return *failed;
    out.pictures.push_back(std::move(picture));
  }
  return out;
}

PixelFrame sketch(const PosedScene& scene, const ObjectRun& run, FrameLabel frame, const RunOptions& options,
                  int divisor) {
  constexpr int kDropped = 3;  // leaves seven binary digits: a half of one in 128
  const PictureSize size{kPictureSize.width / divisor, kPictureSize.height / divisor};
  const Photographer photographer(scene, run, options.wrap, size);
  return pack(photographer, shadeAll(photographer, run, frame.index, scene.lights), frame, kDropped);
}

}  // namespace rigel::tools
