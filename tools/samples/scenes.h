// The functions behind samples(); one file each.
#pragma once

#include "scene/scene.h"

namespace rigel::tools {

Scene makeStreet();
Scene makeStage();
Scene makeDragon();
Scene makeTouch();
Scene makeFigure1();
Scene makeCorridor();
Scene makeGallery();

}  // namespace rigel::tools
