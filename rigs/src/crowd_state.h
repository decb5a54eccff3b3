// The characters of a crowd, and how a frame is cut into blocks.
#pragma once

#include "crowd_kind.h"
#include "crowd_lights.h"
#include "crowd_near.h"
#include "crowd_task.h"

namespace rigel::crowd {

/// From one frame to the next. A line of the cache is what moves it, the next all that planning a frame looks at.
struct alignas(kCacheLine) Character {
  CrowdInput input;
  CrowdResult result;
  std::size_t offset = 0;        // vec4 in the output's coefficients
  std::uint32_t generation = 1;  // CrowdId{} is nobody's
  int interval = 1;              // that was asked for when it was last updated, or what it has come down to
  int span = 1, step = 0;        // frames between its results, and how many are over
  float seconds = 0;             // since the last update
  bool alive = false;
  bool lit = false;     // has results to go on from
  bool kept = false;    // they are in Population::results
  bool usable = false;  // they are finite
  RigBox from, to;      // of the results between which it is shown; last, for most frames do without

  /// How far between its results it is shown.
  float shown() const noexcept { return static_cast<float>(step + 1) / static_cast<float>(span); }
};

static_assert(offsetof(CrowdInput, groups) == kCacheLine && offsetof(Character, from) <= kCharacterLines * kCacheLine);

/// All characters of a kind. Results are pairs of `vectors` packed SH vectors, from and to.
struct Population {
  std::shared_ptr<const CrowdKind> kind;
  std::vector<Character> characters;
  std::vector<NearSlot> near;  // nearSlots a character
  std::vector<float> results;
  std::vector<std::uint32_t> free;
  int padded = 0;  // floats of a packed SH vector

  const CrowdKind::Data& data() const noexcept { return kind->data(); }
  std::size_t nearSlots() const noexcept { return static_cast<std::size_t>(kind->options().nearSlots); }
  std::size_t floats() const noexcept { return static_cast<std::size_t>(data().vectors) * padded; }
  std::span<NearSlot> nearOf(std::size_t i) noexcept { return std::span(near).subspan(i * nearSlots(), nearSlots()); }
  float* fromOf(std::size_t i) noexcept { return results.data() + 2 * i * floats(); }
  float* toOf(std::size_t i) noexcept { return fromOf(i) + floats(); }

  /// One more free place. All or nothing.
  void grow();
  /// A free place, of which there must be one.
  std::uint32_t take() noexcept;
  void remove(std::uint32_t i) noexcept;
  std::size_t bytesPerCharacter() const noexcept;
};

/// Characters of a population, updated or shown as they are, by their places in the schedule's list.
struct Block {
  std::uint32_t population = 0;
  std::uint32_t begin = 0, count = 0;
  bool update = false;
};

/// Who is seen in a frame, who is updated, in which blocks, and where the results go.
class Schedule {
 public:
  void reserve(std::span<const Population> populations);
  /// For plans with cells.
  void reservePlaces() { places_.reserve(shown_.capacity()); }

  /// `cut`: for all. `cell` [m]: blocks are of characters that are close together, by a grid of that size; 0: in their
  /// order.
  CrowdStats plan(std::span<Population> populations, std::uint64_t frame, float seconds, bool cut, float cell) noexcept;

  std::span<const Block> blocks() const noexcept { return blocks_; }
  std::uint32_t character(std::uint32_t place) const noexcept { return order_[place]; }
  std::uint32_t size() const noexcept { return static_cast<std::uint32_t>(order_.size()); }
  std::size_t bytes() const noexcept {
    return blocks_.capacity() * sizeof(Block) + (order_.capacity() + shown_.capacity()) * sizeof(std::uint32_t) +
           places_.capacity() * sizeof(Place);
  }

 private:
  void addBlocks(std::uint32_t population, std::size_t begin, std::uint32_t size, bool update);
  void addBlocksByPlace(const Population& of, std::uint32_t population, std::size_t begin, float cell);

  std::vector<Block> blocks_;
  std::vector<std::uint32_t> order_;  // characters, block by block
  std::vector<std::uint32_t> shown_;  // scratch of plan
  struct Place {
    std::uint64_t key = 0;
    std::uint32_t character = 0;
    friend auto operator<=>(const Place&, const Place&) = default;
  };
  std::vector<Place> places_;  // the same
};

}  // namespace rigel::crowd
