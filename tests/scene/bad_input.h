// What the tests of damaged files share: one line that names file, place and cause.
#pragma once

#include "scene_files.h"

namespace rigel::tools::test {

/// Writes and loads `g`; the error must be `expected` after the file name.
void expectLoadError(GltfMaker& g, const std::string& expected);

}  // namespace rigel::tools::test
