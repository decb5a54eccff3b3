// What a crowd asks for ahead of time: each line of the cache once, and none that is not used.
#include "crowd_ahead.h"

#include <rigel/crowd.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace rigel {
namespace {

using crowd::FetchList;
using crowd::JointLines;
using crowd::kCacheLine;

struct alignas(kCacheLine) Memory {
  char bytes[200 * kCacheLine];
};

std::set<const void*> linesOf(const Memory& memory, std::size_t begin, std::size_t size) {
  std::set<const void*> lines;
  for (std::size_t i = begin; i < begin + size; ++i) lines.insert(memory.bytes + i / kCacheLine * kCacheLine);
  return lines;
}

/// Checks that no line comes twice.
std::set<const void*> linesOf(const FetchList& list) {
  std::set<const void*> lines(list.view().begin(), list.view().end());
  EXPECT_EQ(lines.size(), list.view().size());
  return lines;
}

TEST(CrowdAhead, AsksForEveryLineOfAThing) {
  static const Memory memory{};
  for (std::size_t begin = 0; begin < 2 * kCacheLine; begin += 4)
    for (const std::size_t size : {std::size_t{4}, std::size_t{60}, kCacheLine, std::size_t{68}, std::size_t{672}}) {
      FetchList list;
      list.reserve(crowd::mostLines(size));
      list.add(memory.bytes + begin, size);
      EXPECT_EQ(linesOf(list), linesOf(memory, begin, size)) << size << " bytes from " << begin;
    }
}

TEST(CrowdAhead, AsksForTheJointsThatAreRead) {
  static const Memory memory{};
  const std::vector<std::uint16_t> joints = {0, 1, 2, 7, 8, 30, 59};
  const JointLines lines(joints, sizeof(JointMatrix));
  std::size_t most = 0;
  for (std::size_t begin = 0; begin < kCacheLine; begin += alignof(JointMatrix)) {
    std::set<const void*> expected;
    for (const std::uint16_t joint : joints)
      expected.merge(linesOf(memory, begin + joint * sizeof(JointMatrix), sizeof(JointMatrix)));
    const char* palette = memory.bytes + begin;
    FetchList list;
    list.reserve(lines.most());
    list.add(palette, lines.of(palette));
    EXPECT_EQ(linesOf(list), expected) << "palette from " << begin;
    most = std::max(most, expected.size());
  }
  EXPECT_EQ(lines.most(), most);
}

TEST(CrowdAhead, StopsWhereThereIsNoRoom) {
  static const Memory memory{};
  FetchList list;
  list.reserve(5);
  list.add(memory.bytes, 3 * kCacheLine);
  list.add(memory.bytes + 10 * kCacheLine, 3 * kCacheLine);
  const std::uint16_t more[] = {20, 21};
  list.add(memory.bytes, more);
  EXPECT_EQ(list.view().size(), 5u);
  list.clear();
  EXPECT_TRUE(list.view().empty());
  list.add(memory.bytes, more);
  EXPECT_EQ(linesOf(list), linesOf(memory, 20 * kCacheLine, 2 * kCacheLine));
}

}  // namespace
}  // namespace rigel
