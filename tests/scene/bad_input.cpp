#include "bad_input.h"

#include <gtest/gtest.h>

namespace rigel::tools::test {

void expectLoadError(GltfMaker& g, const std::string& expected) {
  const TemporaryFolder folder;
  const auto file = g.write(folder);
  const auto scene = loadGltf(file);
  ASSERT_FALSE(scene) << "accepted, expected: " << expected;
  EXPECT_EQ(scene.error().line(), file.string() + ": " + expected);
  EXPECT_EQ(scene.error().line().find('\n'), std::string::npos);
}

}  // namespace rigel::tools::test
