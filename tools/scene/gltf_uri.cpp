#include "scene/gltf_uri.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace rigel::tools {
namespace {

namespace fs = std::filesystem;

std::string shortened(std::string_view uri) {
  std::string out(uri.substr(0, 60));
  for (char& c : out) c = static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  return out + (uri.size() > 60 ? "..." : "");
}

bool equalIgnoringCase(std::string_view a, std::string_view lower) {
  return std::ranges::equal(a, lower, [](char x, char y) { return std::tolower(static_cast<unsigned char>(x)) == y; });
}

int hexDigit(char c) {
  return c >= '0' && c <= '9' ? c - '0' : (c | 32) >= 'a' && (c | 32) <= 'f' ? (c | 32) - 'a' + 10 : -1;
}

// nullopt where an escape is broken.
std::optional<std::string> percentDecoded(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      out += text[i];
      continue;
    }
    const int high = i + 2 < text.size() ? hexDigit(text[i + 1]) : -1;
    const int low = i + 2 < text.size() ? hexDigit(text[i + 2]) : -1;
    if (high < 0 || low < 0) return std::nullopt;
    out += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return out;
}

constexpr std::array<signed char, 256> kBase64 = [] {
  std::array<signed char, 256> table{};
  table.fill(-1);
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < kDigits.size(); ++i)
    table[static_cast<unsigned char>(kDigits[i])] = static_cast<signed char>(i);
  return table;
}();

// RFC 4648, section 4. nullopt for other characters, padding in the middle, a length that no bytes give.
std::optional<std::string> base64Decoded(std::string_view text) {
  if (text.size() % 4 == 0)
    for (int pad = 0; pad < 2 && text.ends_with('='); ++pad) text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;
  std::string out;
  out.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int digit = kBase64[static_cast<unsigned char>(text[i])];
    if (digit < 0) return std::nullopt;
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    // A digit's 6 bits complete a byte wherever they are not the first of four.
    const unsigned left = 6 - static_cast<unsigned>(i % 4) * 2;
    if (i % 4 != 0) out += static_cast<char>(bits >> left & 0xff);
  }
  return out;
}

}  // namespace

bool isDataUri(std::string_view uri) { return uri.size() >= 5 && equalIgnoringCase(uri.substr(0, 5), "data:"); }

std::string decodeDataUri(const JsonPlace& place) {
  const std::string& uri = place.value().get_ref<const std::string&>();
  const std::string_view text = uri;
  const auto comma = text.find(',');
  if (comma == std::string_view::npos) place.fail("\"{}\": a data URI needs a comma before its data", shortened(text));
  const std::string_view head = text.substr(0, comma), data = text.substr(comma + 1);
  const bool base64 = head.size() >= 12 && equalIgnoringCase(head.substr(head.size() - 7), ";base64");
  auto bytes = base64 && data.find('%') == std::string_view::npos ? base64Decoded(data) : percentDecoded(data);
  if (base64 && bytes && data.find('%') != std::string_view::npos) bytes = base64Decoded(*bytes);  // "%3D" for "="
  if (!bytes) place.fail("\"{}\" is not valid {} data", shortened(head), base64 ? "base64" : "percent-encoded");
  return *std::move(bytes);
}

std::optional<fs::path> fileOfUri(const JsonPlace& place, const fs::path& folder) {
  const std::string uri = place.asText();
  if (uri.empty()) place.fail("is empty");
  if (uri.find('\0') != std::string::npos) place.fail("\"{}\" holds a null character", shortened(uri));
  std::error_code ignored;
  if (fs::is_regular_file(folder / uri, ignored)) return folder / uri;

  // RFC 3986: a colon in the first segment ends a scheme.
  const std::string_view segment = std::string_view(uri).substr(0, uri.find('/'));
  if (const auto colon = segment.find(':'); colon != std::string_view::npos) {
    const std::string_view scheme = segment.substr(0, colon);
    const bool valid = !scheme.empty() && std::isalpha(static_cast<unsigned char>(scheme[0])) != 0 &&
                       std::ranges::all_of(scheme, [](char c) {
                         return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '-' || c == '.';
                       });
    if (!valid) place.fail("\"{}\" is no URI", shortened(uri));
    return std::nullopt;
  }
  const auto decoded = percentDecoded(uri);
  if (!decoded || decoded->find('\0') != std::string::npos)
    place.fail("\"{}\" holds a broken % escape", shortened(uri));
  return folder / *decoded;
}

}  // namespace rigel::tools
