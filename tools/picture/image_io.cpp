#include "picture/image_io.h"

#include "picture/file_replace.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>
#include <fmt/format.h>
#include <half.h>
#include <png.h>

#include <cassert>
#include <cerrno>
#include <cstdio>
#include <deque>
#include <stdexcept>
#include <string>
#include <system_error>

namespace rigel::tools {
namespace {

// A header may state any size; a GiB of pixels is read.
constexpr std::int64_t kMaxSide = 1 << 16, kMaxPixels = 1 << 26;

constexpr const char* kChannels[4] = {"R", "G", "B", "A"};

/// One channel, converted.
template <class T>
std::vector<T> channelOf(const std::vector<float>& values, std::size_t first, std::size_t stride) {
  std::vector<T> out;
  out.reserve(values.size() / stride);
  for (std::size_t i = first; i < values.size(); i += stride) out.push_back(T(values[i]));
  return out;
}

/// The file as it will lie on the disk. OpenEXR writes its last bytes in a destructor, which tells nobody that the disk
/// was full: so it writes to memory.
template <class T>
std::string encodeExrAs(const Image& image, std::span<const ExrLayer> layers, Imf::PixelType type) {
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::FrameBuffer frame;
  std::deque<std::vector<T>> channels;  // which stay where they are
  const auto add = [&](const std::string& name, std::vector<T> values) {
    channels.push_back(std::move(values));
    header.channels().insert(name, Imf::Channel(type));
    frame.insert(name, Imf::Slice(type, reinterpret_cast<char*>(channels.back().data()), sizeof(T),
                                  sizeof(T) * static_cast<std::size_t>(image.width)));
  };
  for (std::size_t c = 0; c < 3; ++c) add(kChannels[c], channelOf<T>(image.rgb, c, 3));
  add(kChannels[3], channelOf<T>(image.coverage, 0, 1));
  for (const ExrLayer& layer : layers) {
    assert(layer.image->width == image.width && layer.image->height == image.height);
    for (std::size_t c = 0; c < 3; ++c)
      add(std::string(layer.name) + "." + kChannels[c], channelOf<T>(layer.image->rgb, c, 3));
  }
  Imf::StdOSStream bytes;
  {
    Imf::OutputFile out(bytes, header);
    out.setFrameBuffer(frame);
    out.writePixels(image.height);
  }
  return bytes.str();
}

/// All bytes, or a filesystem_error that says why not: streams do not tell.
void writeBytes(const std::filesystem::path& file, const void* bytes, std::size_t size) {
  const auto fail = [](int cause) {
    throw std::filesystem::filesystem_error("write", std::error_code(cause, std::generic_category()));
  };
  std::FILE* out = std::fopen(file.c_str(), "wb");
  if (!out) fail(errno);
  const int writeError = std::fwrite(bytes, 1, size, out) == size ? 0 : errno;
  const int closeError = std::fclose(out) == 0 ? 0 : errno;  // a full disk may show only here
  if (const int cause = writeError ? writeError : closeError) fail(cause);
}

Result<std::vector<std::uint8_t>> pngFailure(const png_image& png) {
  return Error{std::string("PNG: ") + png.message, ""};
}

}  // namespace

Result<std::size_t> writeExr(const Image& image, const std::filesystem::path& file, ExrDepth depth) {
  return writeExr(image, {}, file, depth);
}

Result<std::size_t> writeExr(const Image& image, std::span<const ExrLayer> layers, const std::filesystem::path& file,
                             ExrDepth depth) {
  return replaceFile(file, [&](const std::filesystem::path& aside) {
    const std::string bytes = depth == ExrDepth::half ? encodeExrAs<half>(image, layers, Imf::HALF)
                                                      : encodeExrAs<float>(image, layers, Imf::FLOAT);
    writeBytes(aside, bytes.data(), bytes.size());
  });
}

Result<Image> readExr(const std::filesystem::path& file) { return readExrLayer(file, ""); }

Result<Image> readExrLayer(const std::filesystem::path& file, std::string_view layer) {
  const std::string prefix = layer.empty() ? "" : std::string(layer) + ".";
  try {
    Imf::InputFile in(file.string().c_str());
    const Imath::Box2i window = in.header().dataWindow();
    for (std::size_t c = 0; c < 3; ++c) {
      if (!in.header().channels().findChannel(prefix + kChannels[c])) {
        return Error{"has no channel " + prefix + kChannels[c], file.string()};
      }
    }
    const std::int64_t columns = std::int64_t{window.max.x} - window.min.x + 1;
    const std::int64_t rows = std::int64_t{window.max.y} - window.min.y + 1;
    if (columns < 1 || rows < 1 || columns > kMaxSide || rows > kMaxSide || columns * rows > kMaxPixels)
      return Error{fmt::format("has {} x {} pixels, more than {}", columns, rows, kMaxPixels), file.string()};
    Image image(static_cast<int>(columns), static_cast<int>(rows));
    const auto width = static_cast<std::size_t>(image.width);
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < 3; ++c) {
      frame.insert(prefix + kChannels[c], Imf::Slice::Make(Imf::FLOAT, image.rgb.data() + c, window, 3 * sizeof(float),
                                                           3 * sizeof(float) * width));
    }
    frame.insert("A", Imf::Slice::Make(Imf::FLOAT, image.coverage.data(), window, sizeof(float), sizeof(float) * width,
                                       1, 1, 1.0));
    in.setFrameBuffer(frame);
    in.readPixels(window.min.y, window.max.y);
    return image;
  } catch (const std::exception& e) {
    return Error{std::string("cannot read: ") + e.what(), file.string()};
  }
}

Result<std::vector<std::uint8_t>> encodePng(const Image8& image) {
  if (image.width < 1 || image.height < 1) return Error{"PNG: a picture without pixels", ""};
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::vector<std::uint8_t> bytes(size);
  if (!png_image_write_to_memory(&png, bytes.data(), &size, 0, image.pixels.data(), 0, nullptr)) return pngFailure(png);
  bytes.resize(size);
  return bytes;
}

Result<std::size_t> writeEncodedPng(std::span<const std::uint8_t> png, const std::filesystem::path& file) {
  return replaceFile(file, [&](const std::filesystem::path& aside) { writeBytes(aside, png.data(), png.size()); });
}

Result<std::size_t> writePng(const Image8& image, const std::filesystem::path& file) {
  const Result<std::vector<std::uint8_t>> bytes = encodePng(image);
  if (!bytes) return Error{bytes.error().message, file.string()};
  return writeEncodedPng(*bytes, file);
}

}  // namespace rigel::tools
