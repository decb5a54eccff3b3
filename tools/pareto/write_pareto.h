// Puts a finished study into its directory, all of it or nothing.
#pragma once

#include "pareto/pareto_data.h"

#include <filesystem>

namespace rigel::tools {

/// What would keep writePareto from putting its files into `directory`.
std::optional<Error> paretoObstacle(const std::filesystem::path& directory);

/// Writes pareto.html, pareto.json, pareto.csv and pareto.svg. Error: a figure is not finite, or a file cannot be
/// written; the directory then holds what it held before.
std::optional<Error> writePareto(const Pareto& pareto, const std::filesystem::path& directory);

}  // namespace rigel::tools
