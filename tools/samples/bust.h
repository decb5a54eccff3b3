// The bust of `gallery`: head, neck and shoulders on a round socle, 0.72 m tall, facing +z.
#pragma once

#include "scene/scene.h"

namespace rigel::tools {

inline constexpr float kBustHeight = 0.72f;  // m

/// A closed mesh that stands on y = 0 about the y axis; normals, but no material.
Primitive makeBust();

}  // namespace rigel::tools
