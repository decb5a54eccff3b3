// File names of a report's pictures: numbers make them different, names make them pleasant.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace rigel::tools {

/// `name` for a file: letters, digits, '.' and '-' stay, each run of other bytes becomes one '_'; at most `longest`
/// bytes. Different names may give the same text.
std::string fileNamePart(std::string_view name, std::size_t longest);

/// One run among all of a report. Numbers count from 0.
struct PictureSeries {
  std::string scene;  // file or sample:NAME
  std::size_t sceneNumber = 0, sceneCount = 1;
  std::string clip;
  std::size_t clipNumber = 0, clipCount = 1;  // of this scene
};

/// What all file names of a series begin with: "s1-street-c2-walk-", without the scene or the clip where there is only
/// one. No two series of a report begin alike.
std::string pictureNamePrefix(const PictureSeries& series);

/// "PREFIXo03-NAME-frame0025-", "03-..." without a prefix; no two objects and frames of a series share it.
std::string pictureNameStem(std::string_view prefix, std::size_t objectNumber, std::string_view objectName, int frame);

/// The names' ends: each spec as a file name part; a number is added where two would be the same.
std::vector<std::string> rigNameParts(const std::vector<std::string>& specs);

/// Whether a picture of some report could have this name (with its extension).
bool isPictureName(const std::string& name);

}  // namespace rigel::tools
