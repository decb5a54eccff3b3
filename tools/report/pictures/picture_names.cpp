#include "report/pictures/picture_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <regex>

namespace rigel::tools {
namespace {

// Scene, clip and object together stay near 60 bytes, so that a name fits a file manager's column and, with everything
// around it, the 255 bytes of a file system.
constexpr std::size_t kLongestScene = 16;
constexpr std::size_t kLongestClip = 16;
constexpr std::size_t kLongestObject = 28;
constexpr std::size_t kLongestSpec = 60;

bool isPlain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-';
}

/// "-NAME", or nothing of a name that is not there.
std::string decoration(std::string_view name, std::size_t longest) {
  const std::string part = fileNamePart(name, longest);
  return part.empty() ? "" : "-" + part;
}

std::string sceneName(const std::string& scene) {
  constexpr std::string_view kSample = "sample:";
  return scene.starts_with(kSample) ? scene.substr(kSample.size()) : std::filesystem::path(scene).stem().string();
}

}  // namespace

std::string fileNamePart(std::string_view name, std::size_t longest) {
  std::string part;
  for (const char c : name) {
    if (part.size() == longest) break;
    if (isPlain(c))
      part += c;
    else if (!part.ends_with('_'))
      part += '_';
  }
  return part;
}

std::string pictureNamePrefix(const PictureSeries& series) {
  std::string prefix;
  if (series.sceneCount > 1)
    prefix += fmt::format("s{}{}-", series.sceneNumber + 1, decoration(sceneName(series.scene), kLongestScene));
  if (series.clipCount > 1)
    prefix += fmt::format("c{}{}-", series.clipNumber + 1, decoration(series.clip, kLongestClip));
  return prefix;
}

std::string pictureNameStem(std::string_view prefix, std::size_t objectNumber, std::string_view objectName, int frame) {
  return fmt::format("{}{}{:02}{}-frame{:04}-", prefix, prefix.empty() ? "" : "o", objectNumber + 1,
                     decoration(objectName, kLongestObject), frame);
}

std::vector<std::string> rigNameParts(const std::vector<std::string>& specs) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < specs.size(); ++i) {
    std::string part = fileNamePart(specs[i], kLongestSpec);
    // '-' occurs in no spec, so the number makes it different from every other part.
    if (std::ranges::find(parts, part) != parts.end()) part += fmt::format("-{}", i + 1);
    parts.push_back(std::move(part));
  }
  return parts;
}

bool isPictureName(const std::string& name) {
  static const std::regex kNames(R"((?:[sc]\d+-.*o)?\d\d+-(?:.+-)?frame\d{4,}-.+\.(?:png|exr))");
  return std::regex_match(name, kNames);
}

}  // namespace rigel::tools
