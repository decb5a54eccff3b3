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

nlohmann::json& primitive(GltfMaker& g) { return g.json["meshes"][0]["primitives"][0]; }

}  // namespace rigel::tools::test
