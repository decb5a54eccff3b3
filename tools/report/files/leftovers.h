// What a program that was killed while it wrote a report has left in the report's directory.
#pragma once

#include <filesystem>

namespace rigel::tools {

/// In the folder ".images.PID" of a report that is being made:
inline constexpr const char* kPrevious = "previous";  // what had the names of its files before, under the same names
inline constexpr const char* kPlacing = "placing";    // names of the pictures that nothing had before, one a line
/// Written and put back in this order, withdrawn in the opposite one: a report is there with its report.json, which
/// says whose the pictures are.
inline constexpr const char* kReportFiles[] = {"report.html", "report.md", "report.csv", "report.json"};
inline constexpr const char* kDocument = kReportFiles[3];

/// Puts in order what programs that no longer run have left in `report`: an earlier report that was withdrawn comes
/// back with its pictures, unless the new one is there; then the pictures that only the earlier one named go. Their
/// folders and files aside are removed.
void putInOrder(const std::filesystem::path& report);

}  // namespace rigel::tools
