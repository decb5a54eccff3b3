#include "report/pictures/picture_plan.h"

#include <algorithm>

namespace rigel::tools {
namespace {

constexpr int kSmall = 3;   // divides the sides of pictures for playing
constexpr int kMedium = 2;  // where there are bytes enough
constexpr std::size_t kMostPlayed = 48;
// Measured on the built-in scenes: bytes of one frame in full, and at a half, over those at a third with fewer digits.
constexpr double kFullOverSmall = 9.5;
constexpr double kMediumOverSmall = 2.0;
constexpr double kEnoughPlayed = 24;  // before they become larger

/// `count` of `total` indices, evenly spread, the first and the last among them, and `wanted`.
std::vector<std::size_t> spread(std::size_t count, std::size_t total, std::size_t wanted) {
  std::vector<std::size_t> out{wanted};
  for (std::size_t k = 0; k < count; ++k) out.push_back(count > 1 ? k * (total - 1) / (count - 1) : wanted);
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

float median(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

Result<ObjectPictures> takePictures(const LoadedScene& scene, const Timeline& timeline, Stage& stage,
                                    const ObjectRun& run, const RunOptions& options, const GalleryFiles& files,
                                    std::size_t bytes, const std::function<void(double)>& progress) {
  const std::size_t total = timeline.frames.size(), worst = run.worstFrame();
  const auto pose = [&](std::size_t f) {
    stage.pose(timeline.frames[f]);
    return PosedScene{scene.scene(), scene.objects(), stage.nodes(), stage.lights().set};
  };
  const auto label = [&](std::size_t f) {
    return FrameLabel{f, timeline.frames[f], timeline.time(timeline.frames[f])};
  };

  PixelFrame first = sketch(pose(worst), run, label(worst), options, kSmall);
  const double budget = static_cast<double>(bytes) / static_cast<double>(std::max<std::size_t>(first.bytes(), 1));
  const bool full = budget >= kFullOverSmall;
  const double left = std::max(0.0, budget - (full ? kFullOverSmall : 1));
  const double pairs = kPlayedPairs * static_cast<double>(bytes) / static_cast<double>(kPagePictureBytes);
  const auto affordable = [&](int divisor) {
    const double pixels = static_cast<double>(kPictureSize.width * kPictureSize.height) / (divisor * divisor);
    const double inTime = pairs / (pixels * std::max(1, stage.lights().set.size()));
    return std::min(left / (divisor == kMedium ? kMediumOverSmall : 1), inTime);
  };
  const double all = static_cast<double>(std::min(total, kMostPlayed));
  const int divisor = affordable(kMedium) >= std::min(kEnoughPlayed, all) ? kMedium : kSmall;
  const auto count = static_cast<std::size_t>(std::min(affordable(divisor), all));

  ObjectPictures out;
  std::vector<float> exposures;
  const std::vector<std::size_t> frames = spread(count, total, worst);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    progress(static_cast<double>(k) / static_cast<double>(frames.size() + 1));
    const std::size_t f = frames[k];
    out.frames.push_back(f == worst ? std::move(first) : sketch(pose(f), run, label(f), options, divisor));
    exposures.push_back(out.frames.back().exposure);
  }
  // One exposure for the clip: that of its middle.
  auto pictures = photograph(pose(worst), run, label(worst), options, median(exposures), files);
  if (!pictures) return pictures.error();
  for (PixelFrame& frame : out.frames) frame.exposure = pictures->pixels.exposure;
  out.pictures = std::move(pictures->pictures);
  if (full) *std::ranges::find(out.frames, label(worst).number, &PixelFrame::frame) = std::move(pictures->pixels);
  return out;
}

}  // namespace rigel::tools
