// Writes a made-up study, for tests/page and for looking at: pareto_fixture cpu|gpu DIR
#include "made_up_pareto.h"
#include "pareto/write_pareto.h"

#include <fmt/format.h>

#include <cstdio>
#include <string_view>

int main(int argc, char** argv) {
  const std::string_view kind = argc == 3 ? argv[1] : "";
  if (kind != "cpu" && kind != "gpu") {
    fmt::print(stderr, "usage: pareto_fixture cpu|gpu DIR\n");
    return 2;
  }
  if (const auto error = rigel::tools::writePareto(rigel::tests::madeUpPareto(kind == "gpu"), argv[2])) {
    fmt::print(stderr, "{}\n", error->line());
    return 1;
  }
  return 0;
}
