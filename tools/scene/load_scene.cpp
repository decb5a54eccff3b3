#include "samples/samples.h"
#include "scene/gltf_load.h"

namespace rigel::tools {

Result<Scene> loadScene(const std::string& source) {
  constexpr std::string_view kPrefix = "sample:";
  if (!source.starts_with(kPrefix)) return loadGltf(source);
  const std::string name = source.substr(kPrefix.size());
  std::string known;
  for (const Sample& sample : samples()) {
    if (sample.name == name) return sample.make();
    known += (known.empty() ? "" : ", ") + sample.name;
  }
  return Error{"no such sample; there are " + known, source};
}

}  // namespace rigel::tools
