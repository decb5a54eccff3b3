#include "picture/image_io.h"

#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <png.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

namespace rigel::tools {
namespace {

namespace fs = std::filesystem;

class ImageIo : public ::testing::Test {
 protected:
  int fileCount() const {
    return static_cast<int>(std::distance(fs::directory_iterator(directory_), fs::directory_iterator()));
  }

  test::TemporaryFolder folder_;
  const fs::path directory_ = folder_.path();
};

/// Values over nine decades, negative ones and exact zeros.
Image makeImage(int width, int height) {
  Image image(width, height);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    const float sign = i % 7 == 3 ? -1.0f : 1.0f;
    image.rgb[i] = i % 11 == 0 ? 0.0f : sign * std::pow(10.0f, static_cast<float>(i % 9) - 4.5f) * 1.2345f;
  }
  for (std::size_t i = 0; i < image.coverage.size(); ++i) image.coverage[i] = static_cast<float>(i % 5) / 4;
  return image;
}

std::vector<Rgb8> decodePng(const std::vector<std::uint8_t>& bytes, int& width, int& height) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&png, bytes.data(), bytes.size())) return {};
  png.format = PNG_FORMAT_RGB;
  width = static_cast<int>(png.width);
  height = static_cast<int>(png.height);
  std::vector<Rgb8> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  if (!png_image_finish_read(&png, nullptr, pixels.data(), 0, nullptr)) return {};
  return pixels;
}

TEST_F(ImageIo, LayersStandBesideThePicture) {
  const Image image = makeImage(37, 23);
  Image other = image;
  for (float& v : other.rgb) v += 1;
  const ExrLayer layer{"irradiance", &other};
  ASSERT_TRUE(writeExr(image, std::span(&layer, 1), directory_ / "a.exr", ExrDepth::full));
  const auto picture = readExr(directory_ / "a.exr"), beside = readExrLayer(directory_ / "a.exr", "irradiance");
  ASSERT_TRUE(picture && beside);
  EXPECT_EQ(picture->rgb, image.rgb);
  EXPECT_EQ(beside->rgb, other.rgb);
  EXPECT_EQ(beside->coverage, image.coverage);
  const auto missing = readExrLayer(directory_ / "a.exr", "albedo");
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().message, ::testing::HasSubstr("albedo.R"));
}

TEST_F(ImageIo, FullExrKeepsEveryBit) {
  const Image image = makeImage(37, 23);
  const auto written = writeExr(image, directory_ / "a.exr", ExrDepth::full);
  ASSERT_TRUE(written) << written.error().line();
  EXPECT_EQ(*written, fs::file_size(directory_ / "a.exr"));
  const auto read = readExr(directory_ / "a.exr");
  ASSERT_TRUE(read) << read.error().line();
  EXPECT_EQ(read->width, 37);
  EXPECT_EQ(read->height, 23);
  EXPECT_EQ(read->rgb, image.rgb);
  EXPECT_EQ(read->coverage, image.coverage);
  EXPECT_EQ(fileCount(), 1) << "something was left beside the picture";
}

TEST_F(ImageIo, HalfExrKeepsElevenBits) {
  constexpr float kHalfUlp = 1.0f / 2048;  // of a normal half-float, relative
  constexpr float kSmallest = 0x1p-25f;    // half the spacing of subnormal half-floats
  const Image image = makeImage(37, 23);
  ASSERT_TRUE(writeExr(image, directory_ / "a.exr", ExrDepth::half));
  const auto read = readExr(directory_ / "a.exr");
  ASSERT_TRUE(read) << read.error().line();
  float worst = 0;
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    const float allowed = std::max(std::abs(image.rgb[i]) * kHalfUlp, kSmallest);
    worst = std::max(worst, std::abs(read->rgb[i] - image.rgb[i]) / allowed);
  }
  EXPECT_GT(worst, 0) << "half-floats cannot have been written";
  EXPECT_LE(worst, 1);
}

TEST_F(ImageIo, PngComesBackFromMemoryAndFile) {
  Image8 image(19, 7);
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 19; ++x)
      image.at(x, y) = {static_cast<std::uint8_t>(13 * x), static_cast<std::uint8_t>(36 * y),
                        static_cast<std::uint8_t>(x * y)};
  const auto bytes = encodePng(image);
  ASSERT_TRUE(bytes) << bytes.error().line();
  int width = 0, height = 0;
  EXPECT_EQ(decodePng(*bytes, width, height), image.pixels);
  EXPECT_EQ(width, 19);
  EXPECT_EQ(height, 7);

  const auto written = writePng(image, directory_ / "a.png");
  ASSERT_TRUE(written) << written.error().line();
  std::ifstream in(directory_ / "a.png", std::ios::binary);
  const std::vector<char> file((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  EXPECT_EQ(std::vector<std::uint8_t>(file.begin(), file.end()), *bytes);
  EXPECT_EQ(fileCount(), 1);
}

TEST_F(ImageIo, FailedWritesNameTheFileAndLeaveNothing) {
  const fs::path nowhere = directory_ / "missing" / "a";
  const auto exr = writeExr(makeImage(4, 4), nowhere);
  ASSERT_FALSE(exr);
  EXPECT_EQ(exr.error().place, nowhere.string());
  const auto png = writePng(Image8(4, 4), nowhere);
  ASSERT_FALSE(png);
  EXPECT_EQ(png.error().place, nowhere.string());
  EXPECT_FALSE(encodePng(Image8()));

  // A directory stands where the file should go: the rename fails after the data was written.
  fs::create_directories(directory_ / "taken" / "inside");
  EXPECT_FALSE(writePng(Image8(4, 4), directory_ / "taken"));
  EXPECT_FALSE(writeExr(makeImage(4, 4), directory_ / "taken"));
  EXPECT_EQ(fileCount(), 1) << "a temporary file was left behind";
}

TEST_F(ImageIo, AFullDiskIsNamed) {
  // What is written aside is a link to the device that is always full.
  const std::string part = ".part" + std::to_string(::getpid());
  fs::create_symlink("/dev/full", directory_ / ("a.png" + part));
  const auto png = writePng(Image8(4, 4), directory_ / "a.png");
  ASSERT_FALSE(png);
  EXPECT_NE(png.error().message.find("No space left"), std::string::npos) << png.error().line();
  fs::create_symlink("/dev/full", directory_ / ("a.exr" + part));
  const auto exr = writeExr(makeImage(4, 4), directory_ / "a.exr");
  ASSERT_FALSE(exr);
  EXPECT_NE(exr.error().message.find("No space left"), std::string::npos) << exr.error().line();
  EXPECT_EQ(fileCount(), 0);
}

TEST_F(ImageIo, OverwritesAnOlderPicture) {
  ASSERT_TRUE(writePng(Image8(40, 40, {1, 2, 3}), directory_ / "a.png"));
  ASSERT_TRUE(writePng(Image8(2, 2, {9, 9, 9}), directory_ / "a.png"));
  EXPECT_LT(fs::file_size(directory_ / "a.png"), 200u);
}

TEST_F(ImageIo, ReadExrRefusesWhatIsNone) {
  std::ofstream(directory_ / "a.exr") << "not a picture";
  const auto read = readExr(directory_ / "a.exr");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().place, (directory_ / "a.exr").string());
  EXPECT_FALSE(readExr(directory_ / "missing.exr"));
}

// Damaged files from elsewhere, which have crashed OpenEXR before: one line, or a picture.
TEST_F(ImageIo, ReadExrSurvivesDamagedFiles) {
  const fs::path damaged = fs::path(RIGEL_SHARED_DATA) / "malformed/exr";
  if (!fs::exists(damaged)) {
    std::printf("[ no data  ] %s is not there: nothing tested\n", damaged.c_str());
    return;
  }
  int files = 0, refused = 0;
  for (const auto& entry : fs::directory_iterator(damaged)) {
    SCOPED_TRACE(entry.path());
    const auto read = readExr(entry.path());
    ++files;
    if (read) continue;
    ++refused;
    EXPECT_EQ(read.error().line().find('\n'), std::string::npos) << read.error().line();
  }
  EXPECT_GE(files, 30);
  EXPECT_GE(refused, 20);
  std::printf("[ measured ] %d of %d damaged files are refused\n", refused, files);
}

}  // namespace
}  // namespace rigel::tools
