// What is fuzzed: each takes any bytes, and must neither crash nor hang nor break what it promises of its result.
#pragma once

#include <string_view>

namespace rigel::fuzz {

/// A whole .gltf or .glb: loaded from memory (no file is opened), posed, sampled.
void gltf(std::string_view bytes);

/// One line of `rigel probe`: the answer is one line of JSON.
void probe(std::string_view line);

/// The text of --rig: what is understood prints as text that means the same.
void rigSpec(std::string_view text);

/// A report.json found in a directory that a new report goes to.
void reportJson(std::string_view text);

}  // namespace rigel::fuzz
