#include "report/formats/deflate.h"

#include "report/formats/base64.h"

#include <zlib.h>

#include <new>

namespace rigel::tools {

std::vector<std::uint8_t> deflated(std::span<const std::uint8_t> bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<std::uint8_t> out(size);
  const int level = 6;  // 9 takes three times as long for 1 % less
  // With the bound's room nothing but memory can be wanting.
  if (compress2(out.data(), &size, bytes.data(), static_cast<uLong>(bytes.size()), level) != Z_OK)
    throw std::bad_alloc();
  out.resize(size);
  return out;
}

std::string packedText(std::span<const std::uint8_t> bytes) { return base64(deflated(bytes)); }

}  // namespace rigel::tools
