// Pictures of a report never share a file name, and every name fits a file system.
#include "report/pictures/picture_names.h"

#include <gmock/gmock.h>

#include <set>

namespace rigel::tests {
namespace {

using tools::fileNamePart;
using tools::pictureNamePrefix;
using tools::pictureNameStem;
using tools::rigNameParts;

TEST(PictureNames, ArePleasantWhereThereIsOneSceneAndClip) {
  const std::string prefix = pictureNamePrefix({.scene = "sample:street", .clip = "drive"});
  EXPECT_EQ(prefix, "");
  EXPECT_EQ(pictureNameStem(prefix, 0, "car", 25) + rigNameParts({"poly:12"})[0], "01-car-frame0025-poly_12");
  EXPECT_EQ(pictureNameStem(prefix, 2, "", 0), "03-frame0000-") << "an object without a name";
}

TEST(PictureNames, NumberScenesClipsAndObjects) {
  const std::string prefix = pictureNamePrefix({"../a folder/soldier.v2.glb", 0, 2, "walk/slow", 1, 3});
  EXPECT_EQ(prefix, "s1-soldier.v2-c2-walk_slow-");
  EXPECT_EQ(pictureNameStem(prefix, 2, "left boot", 25), "s1-soldier.v2-c2-walk_slow-o03-left_boot-frame0025-");
  EXPECT_EQ(pictureNamePrefix({"sample:stage", 1, 2, "", 0, 1}), "s2-stage-");
  EXPECT_EQ(pictureNamePrefix({"a.glb", 0, 1, "", 1, 2}), "c2-");
}

TEST(PictureNames, NeverMeet) {
  // Names that become the same text, and names that try to look like numbers.
  std::set<std::string> seen;
  std::size_t count = 0;
  const char* const names[] = {"a/b", "a_b", "a b", "", "2", "-o02-x", "1-c2"};
  const char* const clips[] = {"walk", "walk", "", "1-o01-a"};
  for (std::size_t scene = 0; scene < 12; ++scene)
    for (std::size_t clip = 0; clip < 4; ++clip)
      for (std::size_t object = 0; object < 120; ++object)
        for (const int frame : {0, 12, 12345}) {
          const std::string prefix = pictureNamePrefix({names[scene % 7], scene, 12, clips[clip], clip, 4});
          const std::string stem = pictureNameStem(prefix, object, names[object % 7], frame);
          EXPECT_TRUE(tools::isPictureName(stem + "truth.png")) << stem;
          seen.insert(stem);
          ++count;
        }
  EXPECT_EQ(seen.size(), count);
}

TEST(PictureNames, AreKnownAgain) {
  EXPECT_TRUE(tools::isPictureName("01-car-frame0025-poly_12-error.exr"));
  EXPECT_TRUE(tools::isPictureName("03-frame0000-truth.png"));
  for (const char* other : {"car.png", "01-car.png", "01-car-frame0025-truth.jpg", "1-car-frame0025-truth.png",
                            "beach-01-car-frame0025-truth.png", "frame0025-truth.png", ""})
    EXPECT_FALSE(tools::isPictureName(other)) << other;
}

TEST(PictureNames, StayShort) {
  const std::string name(300, 'n');
  const std::string prefix = pictureNamePrefix({"/" + name + "/" + name + ".gltf", 98, 99, name, 98, 99});
  const std::string longest = pictureNameStem(prefix, 998, name, 99999) + rigNameParts({name})[0] + "-error.png";
  EXPECT_LE(longest.size(), 170u) << longest;
  EXPECT_EQ(fileNamePart("\xC3\x9C"
                         "ber/auto",
                         100),
            "_ber_auto");
  EXPECT_EQ(fileNamePart("../../etc", 100), ".._.._etc");
  EXPECT_EQ(fileNamePart("abcdef", 3), "abc");
}

TEST(PictureNames, RigsThatReadAlikeGetANumber) {
  const std::string digits(80, '0');
  EXPECT_THAT(
      rigNameParts({"mixed:l3,g,c", "poly:" + digits + "6", "poly:" + digits + "7"}),
      testing::ElementsAre("mixed_l3_g_c", "poly_" + std::string(55, '0'), "poly_" + std::string(55, '0') + "-3"));
}

}  // namespace
}  // namespace rigel::tests
