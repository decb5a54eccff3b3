#include "pareto/pareto_html.h"

#include "report/formats/page_template.h"
#include "report/formats/report_html.h"

namespace rigel::tools {

std::string paretoHtml(const nlohmann::ordered_json& document) {
  const auto all = [](std::string_view extension) { return concatenated(paretoPageFiles(), extension); };
  return fillTemplate(all(".html"),
                      {{"STYLE", all(".css")}, {"SCRIPT", all(".js")}, {"DATA", scriptSafeJson(document)}});
}

}  // namespace rigel::tools
