#include "pareto/write_pareto.h"

#include "pareto/pareto_html.h"
#include "pareto/pareto_json.h"
#include "pareto/pareto_svg.h"
#include "report/files/write_together.h"
#include "report/formats/report_json.h"

namespace rigel::tools {
namespace {

constexpr const char* kNames[] = {"pareto.html", "pareto.json", "pareto.csv", "pareto.svg"};

}  // namespace

std::optional<Error> paretoObstacle(const std::filesystem::path& directory) { return obstacleTo(kNames, directory); }

std::optional<Error> writePareto(const Pareto& pareto, const std::filesystem::path& directory) {
  const auto document = paretoJson(pareto);
  if (!document) return document.error();
  const FileContent files[] = {{kNames[0], paretoHtml(*document)},
                               {kNames[1], jsonText(*document, 1) + '\n'},
                               {kNames[2], paretoCsv(pareto)},
                               {kNames[3], paretoSvg(pareto)}};
  return writeTogether(files, directory);
}

}  // namespace rigel::tools
