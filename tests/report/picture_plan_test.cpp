// The pictures of a whole run: the page's numbers are those of the files, and the page stays small.
#include "report/pictures/picture_plan.h"

#include "picture/image_io.h"
#include "unpacked_pixels.h"
#include "whole_run.h"

#include <gmock/gmock.h>

namespace rigel::tests {
namespace {

using namespace rigel::tools;

PixelMask objectOf(const PixelFrame& frame) {
  const std::size_t pixels = static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height);
  const auto coverage = inflated(frame.coverage, 2 * pixels);
  PixelMask mask{frame.width, frame.height, std::vector<bool>(pixels)};
  for (std::size_t i = 0; i < pixels; ++i) mask.covered[i] = coverage[i] > 0;
  return mask;
}

/// Numbers of the object's pixels as the page has them, as a picture.
std::vector<float> numbers(const HalfPlanes& planes, const PixelMask& mask, float scale) {
  std::vector<float> rgb(3 * mask.covered.size());
  std::size_t k = 0;
  for (std::size_t i = 0; i < mask.covered.size(); ++i) {
    if (!mask.covered[i]) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const int exponent = planes[c][k] >> 10, digits = planes[c][k] & 1023;
      rgb[3 * i + c] = scale * (exponent ? std::ldexp(1 + static_cast<float>(digits) / 1024, exponent - 15)
                                         : std::ldexp(static_cast<float>(digits), -24));
    }
    ++k;
  }
  return rgb;
}

/// One run for all tests: moving, two rigs.
class PicturePlan : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<test::TemporaryFolder>();
    RunOptions options = quickRun("sample:street", "0:20:4", "constant;poly:4");
    options.images = true;
    auto report = runReport(options, folder_->path() / "images", [](double, const std::string&) {});
    ASSERT_TRUE(report) << report.error().line();
    object_ = std::make_unique<ObjectReport>(std::move(report->scenes.at(0).objects.at(0)));
  }
  static void TearDownTestSuite() {
    folder_.reset();
    object_.reset();
  }

  static std::filesystem::path file(const std::string& name) { return folder_->path() / name; }
  static const PixelFrame& exact() { return *std::ranges::find(object_->pixels, true, &PixelFrame::exact); }

  inline static std::unique_ptr<test::TemporaryFolder> folder_;
  inline static std::unique_ptr<ObjectReport> object_;
};

TEST_F(PicturePlan, EveryFrameIsPicturedInOrderAndOneInFull) {
  std::vector<int> frames;
  for (const PixelFrame& frame : object_->pixels) {
    frames.push_back(frame.frame);
    EXPECT_EQ(frame.rigs.size(), 2u);
    EXPECT_EQ(frame.exposure, object_->pixels.front().exposure) << "one exposure for the clip";
    EXPECT_GT(frame.rigs[0].rms, 0);
  }
  EXPECT_THAT(frames, testing::ElementsAre(0, 4, 8, 12, 16, 20));
  EXPECT_EQ(std::ranges::count(object_->pixels, true, &PixelFrame::exact), 1);
  EXPECT_EQ(exact().width, kPictureSize.width);
  ASSERT_EQ(object_->pictures.size(), 3u);
  for (const Picture& picture : object_->pictures) {
    EXPECT_EQ(picture.frame, exact().frame);
    EXPECT_EQ(picture.flip.has_value(), picture.label != "truth");
  }
  const double coarse = *object_->pictures[1].flip, fine = *object_->pictures[2].flip;
  EXPECT_GT(fine, 0);
  EXPECT_GT(coarse, fine) << "constant looks worse than poly:4";
  EXPECT_LT(coarse, 0.5);
}

TEST_F(PicturePlan, PageHasTheNumbersOfTheFiles) {
  const PixelFrame& frame = exact();
  const PixelMask mask = objectOf(frame);
  ASSERT_GT(mask.count(), 10'000u);
  const HalfPlanes truth = unpackPlanes(frame.truth, mask);
  const auto truthFile = readExrLayer(file(object_->pictures[0].imageExr), "irradiance");
  ASSERT_TRUE(truthFile) << truthFile.error().line();
  EXPECT_EQ(numbers(truth, mask, frame.scale), truthFile->rgb);
  for (std::size_t r = 0; r < 2; ++r) {
    const Picture& picture = object_->pictures[r + 1];
    const auto rigFile = readExrLayer(file(picture.imageExr), "irradiance");
    const auto errorFile = readExr(file(picture.errorExr));
    ASSERT_TRUE(rigFile && errorFile);
    EXPECT_EQ(numbers(unpackPlanes(frame.rigs[r].irradiance, mask, &truth), mask, frame.scale), rigFile->rgb);
    for (std::size_t i = 0; i < mask.covered.size(); ++i) {
      ASSERT_EQ(errorFile->coverage[i], mask.covered[i] ? 1 : 0) << i;
      for (std::size_t c = 0; c < 3; ++c) {
        const auto difference =
            static_cast<double>(rigFile->rgb[3 * i + c]) - static_cast<double>(truthFile->rgb[3 * i + c]);
        ASSERT_EQ(errorFile->rgb[3 * i + c], roundedToHalf(static_cast<float>(difference / object_->meanIrradiance)))
            << i;
      }
    }
  }
}

TEST_F(PicturePlan, PartsOfAPictureGiveTheFilesRadiance) {
  const PixelFrame& frame = exact();
  const PixelMask mask = objectOf(frame);
  const std::vector<float> reflectance = numbers(unpackPlanes(frame.reflectance, mask), mask, 1);
  const auto irradiance = readExrLayer(file(object_->pictures[1].imageExr), "irradiance");
  const auto radiance = readExr(file(object_->pictures[1].imageExr));
  ASSERT_TRUE(irradiance && radiance);
  // Both factors and the product are half floats: three roundings of 2^-11.
  constexpr float kTolerance = 0.0015f;
  const auto coverage = inflated(frame.coverage, 2 * mask.covered.size());
  std::size_t compared = 0;
  for (std::size_t i = 0; i < mask.covered.size(); ++i) {
    if (coverage[i] != 255) continue;  // scenery shows too, or colours mix
    for (std::size_t c = 0; c < 3; ++c) {
      const float wanted = radiance->rgb[3 * i + c];
      const bool isEdge =
          std::abs(reflectance[3 * i + c] * irradiance->rgb[3 * i + c] - wanted) > kTolerance * wanted + 1e-6f;
      compared += isEdge ? 0 : 1;
    }
  }
  // Where two colours share a pixel, the product of means is not the mean of products: the seams of the car.
  EXPECT_GT(static_cast<double>(compared),
            0.95 * 3 *
                static_cast<double>(std::ranges::count(
                    coverage.begin(), coverage.begin() + static_cast<std::ptrdiff_t>(mask.covered.size()), 255)));
}

/// The pictures that a report would take of the first object, had it so many bytes for them: width of each frame,
/// negative where it is exact.
std::vector<int> widthsWithin(std::size_t bytes) {
  const RunOptions options = quickRun("sample:touch", "0:30:6", "constant");
  const auto scene = LoadedScene::load("sample:touch", options, nullptr);
  EXPECT_TRUE(scene);
  const Timeline& timeline = scene->timelines().front();
  auto stage = Stage::create(*scene, timeline);
  const auto moving = std::ranges::find(scene->objects(), false, &SceneObject::isStatic);
  PosedObject posed;
  stage->pose(0);
  poseObject(scene->scene(), *moving, stage->nodes(), posed);
  auto run = ObjectRun::create(*moving, posed, options, {});
  EXPECT_TRUE(run);
  for (std::size_t f = 0; f < timeline.frames.size(); ++f) {
    const int frame = timeline.frames[f];
    stage->pose(frame);
    poseObject(scene->scene(), *moving, stage->nodes(), run->posed());
    run->measure({frame, timeline.time(frame), timeline.followsOn(f)}, stage->lights().set);
  }
  const test::TemporaryFolder folder;
  const auto taken = takePictures(*scene, timeline, *stage, *run, options, {folder.path(), ""}, bytes, [](double) {});
  EXPECT_TRUE(taken);
  EXPECT_EQ(taken->pictures.size(), 2u) << "files of one frame, whatever the page has";
  std::vector<int> widths;
  for (const PixelFrame& frame : taken->frames) widths.push_back(frame.exact ? -frame.width : frame.width);
  return widths;
}

TEST(PicturePlanBudget, FewBytesMakeFewAndSmallPictures) {
  const int small = kPictureSize.width / 3, medium = kPictureSize.width / 2, full = -kPictureSize.width;
  EXPECT_THAT(widthsWithin(1), testing::ElementsAre(small)) << "one that shows something at least";
  const std::vector<int> some = widthsWithin(kPagePictureBytes / 12), many = widthsWithin(kPagePictureBytes);
  EXPECT_EQ(std::ranges::count(some, full), 1);
  EXPECT_EQ(std::ranges::count(some, small), static_cast<std::ptrdiff_t>(some.size()) - 1);
  EXPECT_EQ(std::ranges::count(many, full), 1);
  EXPECT_EQ(std::ranges::count(many, medium), 5);
}

}  // namespace
}  // namespace rigel::tests
