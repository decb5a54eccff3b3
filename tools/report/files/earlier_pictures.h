// Which files in images/ are ours: those the report.json beside them names.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>

namespace rigel::tools {

/// Name of the folder of pictures within a report's directory.
inline constexpr const char* kImageFolder = "images";

/// The names, within kImageFolder, of the pictures that the text of a report.json lists; empty where it is none of
/// ours. No name leads out of the folder.
std::set<std::string> picturesNamedIn(std::string_view document);

/// The names, within kImageFolder, of the pictures that report.json in `report` lists and that are regular files. Empty
/// where there is no report.json or it is not one of ours. What it says is not trusted.
std::set<std::string> earlierPictures(const std::filesystem::path& report);
/// The same by another copy of its report.json.
std::set<std::string> picturesNamed(const std::filesystem::path& document, const std::filesystem::path& report);

}  // namespace rigel::tools
