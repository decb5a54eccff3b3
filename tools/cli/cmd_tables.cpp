// rigel tables: the disk tables as OpenEXR textures, and as the source file that is compiled into the library.
#include "cli/command.h"
#include "cli/progress_line.h"
#include "picture/file_replace.h"
#include "picture/image_io.h"
#include "report/files/made_directory.h"

#include <rigel/disk_table.h>
#include <rigel/make_disk_table.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cerrno>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <system_error>

namespace rigel::tools {
namespace {

using Json = nlohmann::ordered_json;

struct TablesOptions {
  std::string out;
  std::string embed;
  int size = kDiskTableSize;
  bool json = false;
};

constexpr const char* kChannels[2][4] = {{"q00", "q20", "q22", "q40"}, {"q42", "q44", "0", "0"}};

Image picture(const DiskTableTexels& table, int texture) {
  Image image(table.size, table.size);
  const std::vector<float>& texels = table.texels[texture];
  for (std::size_t i = 0; i < image.pixelCount(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) image.rgb[3 * i + c] = texels[4 * i + c];
    image.coverage[i] = texels[4 * i + 3];
  }
  return image;
}

std::string hashText(const DiskTableTexels& table) {
  return fmt::format("{:016x}", hashDiskTable(table.texels[0], table.texels[1]));
}

Json describe(const DiskTableTexels& table) {
  return {{"size", table.size},
          {"version", kDiskTableVersion},
          {"hash", hashText(table)},
          {"U", "1 - cx; texel i of a row at U = i/(size-1)"},
          {"V", "1 - (1-t^2)^(3/8); row j at V = j/(size-1)"},
          {"texels", "SH per vector irradiance in the bisector frame, less the integrands at psi = pi/4"},
          {"look_up", "shaders/include/rigel/shader_disk_table.h"}};
}

/// Has `write` fill the stream; tells why it could not.
Result<std::size_t> writeText(const std::filesystem::path& file, const std::string& text) {
  return replaceFile(file, [&](const std::filesystem::path& aside) {
    errno = 0;
    std::ofstream out(aside, std::ios::binary);
    out << text << std::flush;
    if (!out) {
      throw std::filesystem::filesystem_error("write", std::error_code(errno ? errno : EIO, std::generic_category()));
    }
  });
}

/// Two textures in two depths and a description. An Error where one could not be written.
Result<Json> writeDirectory(const DiskTableTexels& table, const std::filesystem::path& directory) {
  const Result<MadeDirectory> made = MadeDirectory::make(directory);
  if (!made) return made.error();
  Json description = describe(table);
  Json& files = description["files"] = Json::array();
  for (const ExrDepth depth : {ExrDepth::half, ExrDepth::full}) {
    for (int texture = 0; texture < 2; ++texture) {
      const char* format = depth == ExrDepth::half ? "half" : "float";
      const std::string name = fmt::format("disk_table_{}_{}.exr", texture, format);
      const Result<std::size_t> bytes = writeExr(picture(table, texture), directory / name, depth);
      if (!bytes) return bytes.error();
      files.push_back({{"name", name},
                       {"texture", texture},
                       {"format", format},
                       {"channels", kChannels[texture]},
                       {"bytes", *bytes}});
    }
  }
  const Result<std::size_t> bytes = writeText(directory / "disk_tables.json", description.dump(2) + "\n");
  if (!bytes) return bytes.error();
  return description;
}

/// disk_tables/src/disk_table_data.inc: the six moments of every texel in units of 2^-30, which holds them exactly.
std::string source(const DiskTableTexels& table) {
  std::string text = fmt::format(
      "// The texels of the disk table, q00 q20 q22 q40 q42 q44, in units of 2^-30. Written by\n"
      "//   rigel tables --embed disk_tables/src/disk_table_data.inc\n"
      "constexpr char kCommand[] = \"rigel tables --embed\";\n"
      "constexpr int kVersion = {};\n"
      "constexpr std::uint64_t kHash = 0x{};\n"
      "constexpr std::int32_t kTexels[6 * {} * {}] = {{\n",
      kDiskTableVersion, hashText(table), table.size, table.size);
  std::string line;
  const auto add = [&](float texel) {
    const std::string number = fmt::format("{},", static_cast<long>(std::ldexp(static_cast<double>(texel), 30)));
    if (line.size() + number.size() > 119) {
      text += line + "\n";
      line.clear();
    }
    line += number;
  };
  for (std::size_t i = 0; i < table.texels[0].size(); i += 4) {
    for (std::size_t c = 0; c < 4; ++c) add(table.texels[0][i + c]);
    for (std::size_t c = 0; c < 2; ++c) add(table.texels[1][i + c]);
  }
  return text + line + "\n};\n";
}

int run(const TablesOptions& options) {
  if (options.out.empty() && options.embed.empty()) {
    return fail(kExitBadUse, "tables: --out DIR says where to write (see rigel tables --help)");
  }
  if (!options.embed.empty() && options.size != kDiskTableSize) {
    return fail(kExitBadUse, fmt::format("tables: the embedded table has {} texels a side", kDiskTableSize));
  }
  ProgressLine progress;
  const DiskTableTexels table =
      makeDiskTable(options.size, [&](double share) { progress(share, "making the disk table"); });
  if (!options.embed.empty()) {
    const Result<std::size_t> bytes = writeText(options.embed, source(table));
    if (!bytes) return fail(kExitBadInput, bytes.error().line());
    if (!options.json) fmt::print("{}: {} bytes\n", options.embed, *bytes);
  }
  Json description = describe(table);
  if (!options.out.empty()) {
    const Result<Json> written = writeDirectory(table, options.out);
    if (!written) return fail(kExitBadInput, written.error().line());
    description = *written;
  }
  if (options.json) {
    fmt::print("{}\n", description.dump(2));
  } else if (!options.out.empty()) {
    for (const Json& file : description["files"]) {
      fmt::print("{}: {} bytes\n", (std::filesystem::path(options.out) / file["name"].get<std::string>()).string(),
                 file["bytes"].get<std::size_t>());
    }
    fmt::print("{}x{}, version {}, hash {}\n", table.size, table.size, kDiskTableVersion, hashText(table));
  }
  return kExitOk;
}

}  // namespace

Command addTables(CLI::App& root) {
  auto options = std::make_shared<TablesOptions>();
  CLI::App* app = root.add_subcommand("tables", "Write the disk tables as OpenEXR textures");
  app->add_option("-o,--out", options->out, "Directory for the textures, half and float, and disk_tables.json");
  app->add_option("--size", options->size, "Texels a side")
      ->check(CLI::Range(kMinDiskTableSize, kMaxDiskTableSize))
      ->capture_default_str();
  app->add_option("--embed", options->embed, "Write the source file of the embedded table");
  app->add_flag("--json", options->json, "Print JSON");
  return {app, [options] { return run(*options); }};
}

}  // namespace rigel::tools
