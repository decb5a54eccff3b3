// Built-in scenes, generated in code: animated, lit, exportable with `rigel sample NAME --out FILE.glb`.
#pragma once

#include "scene/scene.h"

#include <span>

namespace rigel::tools {

struct Sample {
  std::string name;
  std::string summary;  // one line: what it shows and which hard case it holds
  Scene (*make)();
};

/// street, stage, dragon, touch, figure1, corridor, gallery: in that order.
std::span<const Sample> samples();

}  // namespace rigel::tools
