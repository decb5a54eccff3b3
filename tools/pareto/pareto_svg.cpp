#include "pareto/pareto_svg.h"

#include "pareto/log_axis.h"
#include "pareto/machine.h"
#include "pareto/pareto_axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace rigel::tools {
namespace {

constexpr int kWidth = 1200, kHeight = 560;
constexpr double kTop = 92, kBottom = 490;

// As page/pareto.css colours families.
struct FamilyColour {
  const char *family, *light, *dark;
};
constexpr FamilyColour kFamilies[] = {
    {"constant", "#4f6573", "#a5b9c5"}, {"gradient", "#a37200", "#ebc44f"}, {"lattice", "#1668c1", "#6cb2ff"},
    {"mixed", "#0b8457", "#4fd3a0"},    {"poly", "#8640b0", "#c99df2"},     {"invquad", "#c2185b", "#ff83b1"},
    {"auto", "#d2410f", "#ff9263"},     {"rbf", "#5b8a22", "#abd86f"},      {"latticegrad", "#007f8c", "#4dd6e6"},
    {"hermite", "#74503f", "#cfa792"},
};

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (static_cast<unsigned char>(c) >= 0x20)
      out += c;
  }
  return out;
}

std::string tickLabel(double value) {
  return value >= 1e6   ? fmt::format("{:g}M", value / 1e6)
         : value >= 1e4 ? fmt::format("{:g}k", value / 1e3)
                        : fmt::format("{:g}", value);
}

/// "poly:6", "poly:6 near 2", "auto 5 %", "gradient near auto 2 % total".
std::string labelOf(const ParetoPoint& point) {
  std::string label = point.spec;
  if (!point.target.empty()) {
    const double aimed = 100 * std::strtod(point.target.c_str() + point.target.find_last_of(' '), nullptr);
    label += fmt::format("{} {:g} %{}", point.family == "auto" ? "" : " near auto", aimed,
                         point.target.starts_with("--total") ? " total" : "");
  } else if (point.near != "0") {
    label += " near " + point.near;
  }
  return label;
}

struct Panel {
  double left, right;
  const char *title, *cost, *error;
  bool withNear;
};

class Drawing {
 public:
  explicit Drawing(const ParetoObject& object) : object_(object) {}

  void draw(const Panel& panel) {
    const ParetoAxis& cost = axisNamed(panel.cost);
    const ParetoAxis& error = axisNamed(panel.error);
    std::vector<CostAndError> at = compared(object_.points, cost, error);
    for (std::size_t i = 0; i < at.size(); ++i)
      if (!panel.withNear && object_.points[i].nearLights > 0) at[i].cost = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> costs, errors;
    for (const CostAndError& p : at)
      if (std::isfinite(p.cost) && p.error > 0) costs.push_back(p.cost), errors.push_back(p.error);
    const LogAxis x = logAxis(costs, 1.15, panel.left, panel.right);
    const LogAxis y = logAxis(errors, 1.15, kBottom, kTop);
    axes(panel, cost, x, y);

    const std::vector<std::size_t> front = paretoFront(at);
    staircase(front, at, x, y, panel);
    taken_.clear();
    for (const std::size_t i : front)
      if (at[i].error > 0) taken_.push_back(around(x(at[i].cost), y(at[i].error)));
    for (const bool onFront : {false, true})
      for (std::size_t i = 0; i < at.size(); ++i) {
        if (!std::isfinite(at[i].cost) || !(at[i].error > 0)) continue;
        if ((std::ranges::find(front, i) != front.end()) != onFront) continue;
        out_ += fmt::format("<circle class=\"{}{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"/>\n", object_.points[i].family,
                            onFront ? " front" : "", x(at[i].cost), y(at[i].error), onFront ? 5 : 3);
      }
    for (const std::size_t i : front)
      if (at[i].error > 0) label(labelOf(object_.points[i]), x(at[i].cost), y(at[i].error), panel);
  }

  const std::string& text() const { return out_; }

 private:
  struct Box {
    double left, right, top, bottom;
  };

  static Box around(double x, double y) { return {x - 6, x + 6, y - 6, y + 6}; }

  void axes(const Panel& panel, const ParetoAxis& cost, const LogAxis& x, const LogAxis& y) {
    for (const double tick : x.ticks())
      out_ += fmt::format(
          "<path class=\"grid\" d=\"M{0:.1f} {1}V{2}\"/><text x=\"{0:.1f}\" y=\"{3}\" "
          "text-anchor=\"middle\">{4}</text>\n",
          x(tick), kTop, kBottom, kBottom + 18, tickLabel(tick));
    for (const double tick : y.ticks())
      out_ += fmt::format(
          "<path class=\"grid\" d=\"M{0} {1:.1f}H{2}\"/><text x=\"{3}\" y=\"{4:.1f}\" "
          "text-anchor=\"end\">{5} %</text>\n",
          panel.left, y(tick), panel.right, panel.left - 8, y(tick) + 4, tickLabel(100 * tick));
    out_ += fmt::format("<text class=\"title\" x=\"{}\" y=\"{}\">{}</text>\n", panel.left, kTop - 14, panel.title);
    out_ += fmt::format("<text class=\"axis\" x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>\n", panel.right,
                        kBottom + 38, cost.title);
  }

  void staircase(const std::vector<std::size_t>& front, const std::vector<CostAndError>& at, const LogAxis& x,
                 const LogAxis& y, const Panel& panel) {
    std::string path;
    for (const std::size_t i : front) {
      if (!(at[i].error > 0)) continue;
      path += path.empty() ? fmt::format("M{:.1f} {}V{:.1f}", x(at[i].cost), kTop, y(at[i].error))
                           : fmt::format("H{:.1f}V{:.1f}", x(at[i].cost), y(at[i].error));
    }
    if (!path.empty()) out_ += fmt::format("<path class=\"stairs\" d=\"{}H{}\"/>\n", path, panel.right);
  }

  /// Beside the point where nothing is yet; left out where everything is taken.
  void label(const std::string& text, double x, double y, const Panel& panel) {
    const double width = 6.1 * static_cast<double>(text.size());
    // Below and to the left of a front there is nothing else.
    const std::array<std::pair<double, double>, 6> places{
        {{-8 - width, 12}, {-8 - width, -4}, {-8 - width, 25}, {-8 - width, 38}, {8, -5}, {8, 13}}};
    for (const auto& [dx, dy] : places) {
      const Box box{x + dx, x + dx + width, y + dy - 11, y + dy + 3};
      if (box.left < panel.left || box.right > panel.right + 12 || box.bottom > kBottom || box.top < kTop) continue;
      const auto meets = [&](const Box& other) {
        return box.left < other.right && other.left < box.right && box.top < other.bottom && other.top < box.bottom;
      };
      if (std::ranges::any_of(taken_, meets)) continue;
      taken_.push_back(box);
      out_ +=
          fmt::format("<text class=\"label\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", box.left, y + dy, escaped(text));
      return;
    }
  }

  const ParetoObject& object_;
  std::string out_;
  std::vector<Box> taken_;
};

std::string style() {
  std::string light, dark;
  for (const FamilyColour& f : kFamilies) {
    light += fmt::format(".{}{{fill:{}}}", f.family, f.light);
    dark += fmt::format(".{}{{fill:{}}}", f.family, f.dark);
  }
  return "<style>\n"
         "text{font:12px system-ui,'DejaVu Sans',sans-serif;fill:#5e5e62}.title,.head{font-weight:650;fill:#1b1b1d}"
         ".head{font-size:17px}.axis,.label{fill:#1b1b1d}.label{font-size:11px;paint-order:stroke;stroke:#fff;"
         "stroke-width:3px;stroke-linejoin:round}.back{fill:#fff}.grid{stroke:#dddcd8;fill:none}"
         ".stairs{stroke:#1b1b1d;stroke-width:1.2;fill:none;stroke-dasharray:5 4}circle{opacity:.5}"
         "circle.front{opacity:1;stroke:#1b1b1d;stroke-width:1.2}\n" +
         light +
         "\n@media(prefers-color-scheme:dark){text{fill:#a3a3a8}.title,.head,.axis,.label{fill:#ececea}"
         ".label{stroke:#1d1d20}.back{fill:#1d1d20}.grid{stroke:#36363b}.stairs{stroke:#ececea}"
         "circle.front{stroke:#ececea}\n" +
         dark + "}\n</style>\n";
}

std::string legend(const ParetoObject& object) {
  std::string out;
  double x = 64;
  for (const FamilyColour& f : kFamilies) {
    if (std::ranges::none_of(object.points, [&](const ParetoPoint& p) { return p.family == f.family; })) continue;
    out +=
        fmt::format("<circle class=\"{0} front\" cx=\"{1}\" cy=\"51\" r=\"5\"/><text x=\"{2}\" y=\"55\">{0}</text>\n",
                    f.family, x + 5, x + 15);
    x += 34 + 7 * static_cast<double>(std::string_view(f.family).size());
  }
  return out;
}

}  // namespace

std::string paretoSvg(const Pareto& pareto) {
  std::string body;
  if (!pareto.objects.empty()) {
    const ParetoObject& object = pareto.objects.front();
    Drawing drawing(object);
    drawing.draw({64, 570, "Spatial RMS against the time to fit, no near light", "fit_us", "spatial_rms", false});
    drawing.draw({660, 1166, "Total RMS against the time of a frame, with and without near lights", "frame_us",
                  "total_rms", true});
    body = fmt::format("<text class=\"head\" x=\"64\" y=\"30\">{}: {}, {} bands</text>\n", escaped(pareto.scene),
                       escaped(object.name), comparedBands(object.points)) +
           legend(object) + drawing.text();
  }
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
             "role=\"img\" aria-label=\"What accuracy costs in time\">\n",
             kWidth, kHeight) +
         style() + fmt::format("<rect class=\"back\" width=\"{}\" height=\"{}\"/>\n", kWidth, kHeight) + body +
         fmt::format("<text x=\"64\" y=\"{}\">One thread of {}. Errors over the mean light.</text>\n</svg>\n",
                     kHeight - 14, escaped(machineText(pareto.machine)));
}

}  // namespace rigel::tools
