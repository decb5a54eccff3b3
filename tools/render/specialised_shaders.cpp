#include "render/specialised_shaders.h"

#include "picture/file_replace.h"
#include "shader_binaries.h"
#include "spirv/specialise.h"

#include <cstring>
#include <fstream>
#include <iterator>

namespace rigel::tools {
namespace {

using Words = std::vector<std::uint32_t>;
using Shaders = std::map<std::uint64_t, Words>;

constexpr std::uint32_t kMagic = 0x50534752;  // "RGSP"
// Of the format and of what specialise() makes: raised with either.
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kHeaderWords = 4;  // magic, version, hash
constexpr std::size_t kEntryWords = 3;   // key, words that follow
constexpr std::uint32_t kSpirvMagic = 0x07230203;
/// A file past this is begun anew: shaders of scenes long gone.
constexpr std::size_t kMostWords = std::size_t{4} << 20;

/// FNV-1a over words: against damage, not against malice.
std::uint64_t hashOf(std::span<const std::uint32_t> words, std::uint64_t hash = 0xcbf29ce484222325u) {
  for (const std::uint32_t word : words) hash = (hash ^ word) * 0x100000001b3u;
  return hash;
}

std::uint32_t low(std::uint64_t x) { return static_cast<std::uint32_t>(x); }
std::uint32_t high(std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); }
std::uint64_t join(std::uint32_t low, std::uint32_t high) { return static_cast<std::uint64_t>(high) << 32 | low; }

Words wordsOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(stream), {}};
  Words words(content.size() / sizeof(std::uint32_t));
  if (!words.empty()) std::memcpy(words.data(), content.data(), words.size() * sizeof(std::uint32_t));
  return words;
}

}  // namespace

Words packShaders(const Shaders& shaders) {
  Words file(kHeaderWords);
  for (const auto& [key, words] : shaders) {
    file.insert(file.end(), {low(key), high(key), static_cast<std::uint32_t>(words.size())});
    file.insert(file.end(), words.begin(), words.end());
  }
  const std::uint64_t hash = hashOf(std::span(file).subspan(kHeaderWords));
  const std::uint32_t header[] = {kMagic, kVersion, low(hash), high(hash)};
  std::memcpy(file.data(), header, sizeof header);
  return file;
}

Result<Shaders> unpackShaders(std::span<const std::uint32_t> file) {
  if (file.size() < kHeaderWords || file[0] != kMagic) return Error{"not shaders of Rigel", ""};
  if (file[1] != kVersion) return Error{"of another version", ""};
  std::span<const std::uint32_t> rest = file.subspan(kHeaderWords);
  if (hashOf(rest) != join(file[2], file[3])) return Error{"damaged", ""};
  Shaders shaders;
  while (!rest.empty()) {
    if (rest.size() < kEntryWords || rest.size() - kEntryWords < rest[2]) return Error{"damaged", ""};
    const auto words = rest.subspan(kEntryWords, rest[2]);
    if (words.empty() || words[0] != kSpirvMagic) return Error{"damaged", ""};
    shaders.emplace(join(rest[0], rest[1]), Words(words.begin(), words.end()));
    rest = rest.subspan(kEntryWords + words.size());
  }
  return shaders;
}

SpecialisedShaders::SpecialisedShaders(std::filesystem::path file) : file_(std::move(file)) {
  if (file_.empty()) return;
  const Words words = wordsOf(file_);
  if (words.size() > kMostWords) return;
  if (auto shaders = unpackShaders(words)) shaders_ = *std::move(shaders);
}

Result<std::span<const std::uint32_t>> SpecialisedShaders::get(const std::string& name,
                                                               std::span<const ShaderConstant> constants) {
  const std::span<const std::uint32_t> shader = shaderBinary(name);
  std::uint64_t key = hashOf(shader);
  std::vector<SpecialisedConstant> known;
  for (const ShaderConstant& constant : constants) {
    known.push_back({constant.id, constant.bits});
    const std::uint32_t pair[] = {constant.id, constant.bits};
    key = hashOf(pair, key);
  }
  auto found = shaders_.find(key);
  if (found == shaders_.end()) {
    auto words = specialise(shader, known, StageInterface::whole);
    if (!words) return Error{words.error().message, "shader " + name};
    found = shaders_.emplace(key, *std::move(words)).first;
    ++made_;
    changed_ = true;
  }
  return std::span<const std::uint32_t>(found->second);
}

std::optional<Error> SpecialisedShaders::save() {
  if (file_.empty() || !changed_) return std::nullopt;
  const Words words = packShaders(shaders_);
  const auto written = replaceFile(file_, [&](const std::filesystem::path& aside) {
    std::ofstream stream(aside, std::ios::binary);
    stream.exceptions(std::ios::failbit | std::ios::badbit);
    stream.write(reinterpret_cast<const char*>(words.data()),
                 static_cast<std::streamsize>(words.size() * sizeof(std::uint32_t)));
  });
  if (!written) return written.error();
  changed_ = false;
  return std::nullopt;
}

}  // namespace rigel::tools
