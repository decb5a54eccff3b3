// The pictures of a report while it is being made: aside, so that a failure leaves an older report as it was.
#pragma once

#include "report/files/earlier_pictures.h"
#include "report/files/staged_file.h"

#include <rigel/result.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace rigel::tools {

/// Owns the folder ".images.PID" in the report's directory, which the destructor removes. Pictures of an earlier report
/// are replaced and removed; a file that its report.json does not name is never touched. Where the program is killed,
/// there is the earlier report, or none while its place is being taken, or the new one; the next begin() puts in order
/// what was left (leftovers.h).
///
///     images->directory()     write pictures here
///     images->putInPlace()    the earlier report is withdrawn; now they are in images/
///     ...write the rest...    a failure here, and the destructor puts the earlier report back
///     images->keep()          what only the earlier report had is removed
class StagedImages {
 public:
  /// Tries that pictures (if there will be any) can get into place, and removes what killed programs have left. The
  /// directory must exist.
  static Result<std::unique_ptr<StagedImages>> begin(const std::filesystem::path& report, bool pictures);
  ~StagedImages();
  StagedImages(const StagedImages&) = delete;
  StagedImages& operator=(const StagedImages&) = delete;

  const std::filesystem::path& directory() const { return aside_; }
  std::optional<Error> putInPlace();
  void keep();

 private:
  explicit StagedImages(const std::filesystem::path& report);
  std::optional<Error> check() const;
  /// Takes the earlier report.html and report.json aside, and notes which of the pictures `names` will be new.
  std::optional<Error> withdraw(const std::vector<std::string>& names);

  std::filesystem::path report_, target_, aside_;
  std::set<std::string> earlier_;  // names of the earlier report's pictures
  std::set<std::string> placed_;
  std::vector<std::unique_ptr<StagedFile>> files_;
  bool madeTarget_ = false, kept_ = false;
};

}  // namespace rigel::tools
