// The rigel program: subcommands, version, exit codes.
#include "cli/command.h"
#include "cli/interrupt.h"

#include <fmt/core.h>

#include <cstdio>
#include <exception>
#include <vector>

namespace rigel::tools {

int fail(int code, const std::string& message) {
  fmt::print(stderr, "rigel: {}\n", message);
  return code;
}

namespace {

constexpr const char* kFooter = R"(Scenes are .gltf or .glb files, or built-in ones: sample:NAME (rigel sample --list).

  rigel report sample:street --rig "constant;mixed:l3,g,c;poly:6" --out street
  rigel report soldier.glb --clip walk --rig poly:12 --lights sample:stage --out soldier

Exit code: 0 success, 1 input that cannot be used, 2 a command line that makes no sense,
130 interrupted.)";

// CLI11's messages may run over several lines; ours take one.
std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

int run(int argc, char** argv) {
  CLI::App app("Irradiance rigs: lighting for dynamic characters.", "rigel");
  app.set_version_flag("--version", "rigel " RIGEL_VERSION);
  app.require_subcommand(1);
  app.footer(kFooter);
  const std::vector<Command> commands = {addReport(app), addPareto(app), addRender(app), addInfo(app),
                                         addSample(app), addTables(app), addProbe(app),  addBench(app)};
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {  // --help, --version
    return app.exit(request);
  } catch (const CLI::ParseError& error) {
    std::string program = "rigel";
    for (const Command& command : commands) {
      if (command.app->parsed()) program += " " + command.app->get_name();
    }
    return fail(kExitBadUse, firstLine(error.what()) + " (see " + program + " --help)");
  }
  for (const Command& command : commands) {
    if (command.app->parsed()) return command.run();
  }
  return fail(kExitBadUse, "no command given (see rigel --help)");
}

}  // namespace
}  // namespace rigel::tools

int main(int argc, char** argv) {
  try {
    return rigel::tools::run(argc, argv);
  } catch (const rigel::tools::Interrupted& interrupt) {
    return rigel::tools::fail(rigel::tools::kExitInterrupted, interrupt.what());
  } catch (const std::exception& error) {
    return rigel::tools::fail(rigel::tools::kExitBadInput, error.what());
  }
}
