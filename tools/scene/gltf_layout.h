// Where things lie: every buffer, view and accessor of a glTF document fits into what it refers to.
#pragma once

#include "scene/gltf_json.h"

namespace rigel::tools {

/// Checks fields, references, bounds, strides and alignment of all buffers, bufferViews and accessors, used or not,
/// sparse ones included, from the JSON alone: nothing is read or allocated by the sizes that it states. Throws
/// LoadError.
void checkLayouts(const JsonPlace& root);

}  // namespace rigel::tools
