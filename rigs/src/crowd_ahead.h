// What a crowd's blocks will touch, as lines of the cache that projection fetches meanwhile: the palettes and
// characters of a thousand people, and where their results go, are more than the second-level cache holds.
#pragma once

#include <rigel/project_batch.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rigel::crowd {

inline constexpr std::size_t kCacheLine = 64;

/// Where in its line a thing begins, and how many lines it lies in.
inline std::size_t placeInLine(const void* at) noexcept { return reinterpret_cast<std::uintptr_t>(at) % kCacheLine; }
inline std::size_t linesOf(const void* at, std::size_t bytes) noexcept {
  return (placeInLine(at) + bytes + kCacheLine - 1) / kCacheLine;
}
/// The same of a thing that may begin anywhere.
constexpr std::size_t mostLines(std::size_t bytes) noexcept { return (bytes + 2 * kCacheLine - 2) / kCacheLine; }

class FetchList {
 public:
  /// Room for so many lines; what finds none is not fetched.
  void reserve(std::size_t lines) {
    if (lines > lines_.size()) lines_.resize(lines);
  }
  void clear() noexcept { count_ = 0; }

  void add(const void* at, std::size_t bytes) noexcept {
    const char* first = static_cast<const char*>(at) - placeInLine(at);
    const std::size_t count = std::min(linesOf(at, bytes), lines_.size() - count_);
    const void** to = lines_.data() + count_;
    for (std::size_t i = 0; i < count; ++i) to[i] = first + kCacheLine * i;
    count_ += count;
  }
  /// Lines `numbers` from that of `at` on.
  void add(const void* at, std::span<const std::uint16_t> numbers) noexcept {
    const char* first = static_cast<const char*>(at) - placeInLine(at);
    const std::size_t count = std::min(numbers.size(), lines_.size() - count_);
    const void** to = lines_.data() + count_;
    for (std::size_t i = 0; i < count; ++i) to[i] = first + kCacheLine * numbers[i];
    count_ += count;
  }

  LinesAhead view() const noexcept { return {lines_.data(), count_}; }
  std::size_t bytes() const noexcept { return lines_.capacity() * sizeof(const void*); }

 private:
  std::vector<const void*> lines_;
  std::size_t count_ = 0;
};

/// The lines of a palette that some joints lie in, for each place in a line that a palette may begin at.
class JointLines {
 public:
  JointLines() = default;
  /// `joints`: ascending.
  JointLines(std::span<const std::uint16_t> joints, std::size_t jointBytes) {
    for (std::size_t place = 0; place < kPlaces; ++place) {
      first_[place] = static_cast<std::uint32_t>(lines_.size());
      for (const std::uint16_t joint : joints) {
        const std::size_t begin = place * sizeof(float) + joint * jointBytes, last = begin + jointBytes - 1;
        for (std::size_t line = begin / kCacheLine; line <= last / kCacheLine; ++line)
          if (lines_.size() == first_[place] || lines_.back() < line)
            lines_.push_back(static_cast<std::uint16_t>(line));
      }
    }
    first_[kPlaces] = static_cast<std::uint32_t>(lines_.size());
  }

  std::span<const std::uint16_t> of(const void* palette) const noexcept {
    const std::size_t place = placeInLine(palette) / sizeof(float);
    return std::span(lines_).subspan(first_[place], first_[place + 1] - first_[place]);
  }
  /// Of any palette, at most.
  std::size_t most() const noexcept {
    std::size_t most = 0;
    for (std::size_t place = 0; place < kPlaces; ++place)
      most = std::max<std::size_t>(most, first_[place + 1] - first_[place]);
    return most;
  }

 private:
  static constexpr std::size_t kPlaces = kCacheLine / sizeof(float);
  std::vector<std::uint16_t> lines_;
  std::uint32_t first_[kPlaces + 1] = {};
};

}  // namespace rigel::crowd
