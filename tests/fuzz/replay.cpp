// Runs one target over kept files: fuzz_replay TARGET DIRECTORY. What once crashed stays a file there.
#include "expect.h"
#include "targets.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

int main(int count, char** arguments) {
  using namespace rigel::fuzz;
  const std::map<std::string, void (*)(std::string_view)> targets = {
      {"gltf", gltf}, {"probe", probe}, {"rig_spec", rigSpec}, {"report_json", reportJson}};
  if (count != 3 || !targets.contains(arguments[1])) {
    std::fprintf(stderr, "use: fuzz_replay gltf|probe|rig_spec|report_json DIRECTORY\n");
    return 2;
  }
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(arguments[2])) {
    std::ifstream stream(entry.path(), std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(stream), {});
    std::printf("%s\n", entry.path().c_str());
    std::fflush(stdout);  // the last one is it, where the program ends here
    targets.at(arguments[1])(bytes);
    ++files;
  }
  std::printf("%d files\n", files);
  return files > 0 ? 0 : 1;
}
