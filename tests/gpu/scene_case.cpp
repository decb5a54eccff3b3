#include "gpu/scene_case.h"

#include "report/run/run_options.h"

#include <fmt/format.h>

namespace rigel::test {

using namespace tools;

std::string SceneCase::text() const {
  std::string text = scene + " --rig " + rig;
  if (!near.empty()) text += " --near " + near;
  if (target)
    text += fmt::format(" {} {:g}", target->kind == LightingTarget::Kind::totalError ? "--total-error" : "--error",
                        target->value);
  if (wrap) text += fmt::format(" --wrap {:g}", *wrap);
  if (bands != 3) text += fmt::format(" --bands {}", bands);
  if (!lights.empty()) text += " --lights " + lights;
  static constexpr const char* kStorages[] = {"float32", "float16", "texture32", "texture16"};
  if (wrappedDisk != kWrappedDisk)
    text += wrappedDisk == Effect::light_near_diskTable ? " --disks table" : " --disks quadrature";
  if (storage != RigStorage::float32) text += fmt::format(" --storage {}", kStorages[static_cast<int>(storage)]);
  return text;
}

std::ostream& operator<<(std::ostream& out, const SceneCase& what) { return out << what.text(); }

RenderOptions renderOptions(const SceneCase& what) {
  RenderOptions options;
  options.run.scenes = {what.scene};
  options.run.rigs = {must(parseRigSpec(what.rig))};
  if (!what.near.empty()) options.run.near = must(parseNear(what.near));
  options.run.frames = what.frames;
  options.run.target = what.target;
  options.run.wrap = what.wrap;
  options.run.bands = what.bands;
  options.run.lights = what.lights;
  options.width = 240;
  options.height = 180;
  options.supersampling = 1;
  options.storage = what.storage;
  options.wrappedDisk = what.wrappedDisk;
  return options;
}

SceneRender sceneRender(const RenderOptions& options) { return must(SceneRender::create(options, gpu())); }

}  // namespace rigel::test
