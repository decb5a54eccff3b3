// Writes a made-up report, for tests/page and for looking at: report_fixture made-up|crowd|smallest|hostile DIR
#include "report/files/write_report.h"
#include "report/formats/report_text.h"
#include "report_fixture.h"

#include <fmt/format.h>

#include <cstdio>
#include <string_view>

int main(int argc, char** argv) {
  using namespace rigel;
  const std::string_view kind = argc == 3 ? argv[1] : "";
  if (kind != "made-up" && kind != "crowd" && kind != "smallest" && kind != "hostile") {
    fmt::print(stderr, "usage: report_fixture made-up|crowd|smallest|hostile DIR\n");
    return 2;
  }
  const tools::Report report = kind == "made-up"    ? tests::madeUpReport()
                               : kind == "crowd"    ? tests::crowdReport()
                               : kind == "smallest" ? tests::smallestReport()
                                                    : tests::hostileReport();
  const auto written = tools::writeReport(report, argv[2]);
  if (!written) {
    fmt::print(stderr, "{}\n", written.error().line());
    return 1;
  }
  fmt::print("{}", tools::reportText(report));
  return 0;
}
