// Parses the text form of rig models. Grammar, blanks ignored:
//
//   spec   := ( "constant" | "gradient" | lattice | mixed | poly | dropped ) [ "@" fit ]
//   lattice:= "lattice:" N "x" N "x" N [ ":" kernel ]
//   mixed  := "mixed:" [ "xyz:" ] axis "," axis "," axis
//   axis   := "c" | "g" | "l" N
//   poly   := "poly:" K | "invquad:" K | "auto" [ ":" K ]
//   dropped:= "rbf:" K | "latticegrad:" N "x" N "x" N [ ":" kernel ] | "hermite:" N "x" N "x" N
//   kernel := "linear" | "smooth" | "cubic"
//   fit    := "corners" | "numeric" | "gauss" | "lsq"
#include <rigel/rig_spec.h>

#include <algorithm>
#include <charconv>
#include <optional>

namespace rigel {
namespace {

/// Errors quote what was typed, and are one line whatever that is.
std::string printable(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return text;
}

std::optional<int> parseInt(std::string_view text) {
  int value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const auto at = text.find(separator);
    parts.push_back(text.substr(0, at));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

bool consumePrefix(std::string_view& text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return false;
  text.remove_prefix(prefix.size());
  return true;
}

std::optional<AxisModel> latticeAxis(std::string_view count) {
  const auto nodes = parseInt(count);
  if (!nodes || *nodes < 1 || *nodes > kMaxAxisNodes) return std::nullopt;
  if (*nodes == 1) return AxisModel{};
  return AxisModel{AxisModel::Kind::lattice, *nodes};
}

std::optional<AxisModel> parseAxis(std::string_view text) {
  if (text == "c") return AxisModel{AxisModel::Kind::constant, 1};
  if (text == "g") return AxisModel{AxisModel::Kind::gradient, 1};
  return consumePrefix(text, "l") ? latticeAxis(text) : std::nullopt;
}

std::optional<LatticeKernel> parseKernel(std::string_view text) {
  if (text == "linear") return LatticeKernel::linear;
  if (text == "smooth") return LatticeKernel::smooth;
  if (text == "cubic") return LatticeKernel::cubic;
  return std::nullopt;
}

/// K of a polynomial. Returns what is wrong, or "".
std::string parseTerms(std::string_view text, RigSpec& spec) {
  const auto terms = parseInt(text);
  if (!terms || *terms < 1 || *terms > kMaxPolyTerms)
    return "'" + std::string(text) + "' is not a number of terms from 1 to " + std::to_string(kMaxPolyTerms);
  spec.family = RigSpec::Family::poly;
  spec.fit = FitMethod::lsq;
  spec.terms = *terms;
  return "";
}

/// K of radial basis functions. Returns what is wrong, or "".
std::string parseCentres(std::string_view text, RigSpec& spec) {
  const auto centres = parseInt(text);
  if (!centres || *centres < 1 || *centres > kMaxLsqVectors)
    return "'" + std::string(text) + "' is not a number of centres from 1 to " + std::to_string(kMaxLsqVectors);
  spec.family = RigSpec::Family::rbf;
  spec.fit = FitMethod::lsq;
  spec.terms = *centres;
  return "";
}

/// "AxBxC" or, where `takesKernel`, "AxBxC:kernel". Returns what is wrong, or "".
std::string parseLattice(std::string_view name, std::string_view text, bool takesKernel, RigSpec& spec) {
  const auto parts = split(text, ':');
  const auto counts = split(parts[0], 'x');
  if (counts.size() != 3) return "a lattice needs three node counts, as in " + std::string(name) + ":3x2x2";
  for (int axis = 0; axis < 3; ++axis) {
    const auto model = latticeAxis(counts[axis]);
    if (!model) return "'" + std::string(counts[axis]) + "' is not a node count from 1 to 64";
    spec.axes[axis] = *model;
  }
  if (parts.size() > 2) return "too many ':'";
  if (parts.size() == 1) return "";
  if (!takesKernel) return std::string(name) + " takes no kernel";
  const auto kernel = parseKernel(parts[1]);
  if (!kernel) return "unknown kernel '" + std::string(parts[1]) + "' (known: linear, smooth, cubic)";
  spec.kernel = *kernel;
  return "";
}

/// The part before '@'. Returns what is wrong, or "".
std::string parseModel(std::string_view text, RigSpec& spec) {
  if (text == "constant") return "";
  if (text == "gradient") {
    spec.axes.fill({AxisModel::Kind::gradient, 1});
    return "";
  }
  if (consumePrefix(text, "lattice:")) return parseLattice("lattice", text, true, spec);
  if (consumePrefix(text, "latticegrad:")) {
    spec.family = RigSpec::Family::latticegrad;
    return parseLattice("latticegrad", text, true, spec);
  }
  if (consumePrefix(text, "hermite:")) {
    spec.family = RigSpec::Family::hermite;
    return parseLattice("hermite", text, false, spec);
  }
  if (consumePrefix(text, "mixed:")) {
    spec.pinnedAxes = consumePrefix(text, "xyz:");
    const auto parts = split(text, ',');
    if (parts.size() != 3) return "a mixed rig needs three axis models, as in mixed:l3,g,c";
    for (int axis = 0; axis < 3; ++axis) {
      const auto model = parseAxis(parts[axis]);
      if (!model) return "unknown axis model '" + std::string(parts[axis]) + "' (known: c, g, lN with N from 1 to 64)";
      spec.axes[axis] = *model;
    }
    return "";
  }
  if (consumePrefix(text, "poly:")) return parseTerms(text, spec);
  if (consumePrefix(text, "invquad:")) {
    spec.falloff = true;
    return parseTerms(text, spec);
  }
  if (consumePrefix(text, "auto:")) {
    spec.adaptive = true;
    return parseTerms(text, spec);
  }
  if (consumePrefix(text, "rbf:")) return parseCentres(text, spec);
  if (text == "auto") {
    spec.adaptive = true;
    return parseTerms(std::to_string(kAutoTerms), spec);
  }
  return "unknown rig model (known: constant, gradient, lattice:AxBxC, mixed:m1,m2,m3, poly:K, invquad:K, auto, "
         "auto:K; for comparison rbf:K, latticegrad:AxBxC, hermite:AxBxC)";
}

/// The part after '@'. Returns what is wrong, or "".
std::string parseFit(std::string_view text, RigSpec& spec) {
  const auto only = [&](std::string_view method, std::string what) {
    return text == method ? "" : std::move(what) + ": '@" + std::string(text) + "' does not apply";
  };
  switch (spec.family) {
    case RigSpec::Family::poly:
      return only("lsq", "a polynomial rig is always least squares");
    case RigSpec::Family::rbf:
      return only("lsq", "an rbf rig is always least squares");
    case RigSpec::Family::latticegrad:
    case RigSpec::Family::hermite:
      return only("corners", "nodes that hold slopes are always spread over the box");
    case RigSpec::Family::tensor:
      break;
  }
  if (text == "corners") {
    spec.fit = FitMethod::corners;
  } else if (text == "lsq") {
    spec.fit = FitMethod::lsq;
  } else if (text == "numeric") {
    if (std::ranges::none_of(spec.axes, [](AxisModel a) { return a.kind == AxisModel::Kind::gradient; }))
      return "'@numeric' needs a gradient axis";
    spec.fit = FitMethod::numeric;
  } else if (text == "gauss") {
    if (spec.text.starts_with("lattice") &&
        spec.text.find(':', std::string_view("lattice:").size()) != std::string::npos)
      return "'@gauss' puts polynomials through its nodes and takes no kernel";
    spec.fit = FitMethod::gauss;
  } else {
    return "unknown suffix '@" + std::string(text) + "' (known: @corners, @numeric, @gauss, @lsq)";
  }
  return "";
}

/// What latticegrad and hermite do not take of what a tensor rig may have.
std::optional<Error> checkSlopeGrid(const RigSpec& spec, const std::string& place) {
  if (spec.family == RigSpec::Family::tensor) return std::nullopt;
  if (std::ranges::any_of(spec.axes, [](AxisModel a) { return a.kind == AxisModel::Kind::gradient; }))
    return Error{"every node holds all slopes: an axis has a number of nodes and no model", place};
  if (spec.fit != FitMethod::corners) return Error{"nodes that hold slopes are spread over the box", place};
  if (spec.kernel == LatticeKernel::cubic)
    return Error{"a cubic kernel blends 64 nodes of four functions each at a point; linear and smooth do", place};
  if (spec.family == RigSpec::Family::hermite && spec.kernel != LatticeKernel::linear)
    return Error{"hermite takes no kernel", place};
  return std::nullopt;
}

}  // namespace

int RigSpec::shVectors() const noexcept {
  if (family == Family::poly || family == Family::rbf) return terms;
  int nodes = 1;
  int slopes = family == Family::tensor ? 0 : 3;
  for (const AxisModel& axis : axes) {
    nodes *= axis.nodes;
    slopes += axis.kind == AxisModel::Kind::gradient;
  }
  return nodes * (1 + slopes);
}

std::optional<Error> checkRigSpec(const RigSpec& spec) {
  const std::string place = "rig spec '" + spec.text + "'";
  if (spec.falloff && (spec.family != RigSpec::Family::poly || spec.adaptive))
    return Error{"only polynomial rigs, and not adaptive ones, have a falloff", place};
  if (spec.adaptive && spec.family != RigSpec::Family::poly) return Error{"only polynomial rigs are adaptive", place};
  if (spec.family == RigSpec::Family::poly) {
    if (spec.terms < 1 || spec.terms > kMaxPolyTerms)
      return Error{"a poly rig has 1 to " + std::to_string(kMaxPolyTerms) + " terms", place};
    return std::nullopt;
  }
  if (spec.family == RigSpec::Family::rbf) {
    if (spec.terms < 1 || spec.terms > kMaxLsqVectors)
      return Error{"an rbf rig has 1 to " + std::to_string(kMaxLsqVectors) + " centres", place};
    return std::nullopt;
  }
  for (const AxisModel& axis : spec.axes)
    if (axis.nodes < 1 || axis.nodes > kMaxAxisNodes || (axis.nodes > 1) != (axis.kind == AxisModel::Kind::lattice))
      return Error{"a lattice axis has 2 to " + std::to_string(kMaxAxisNodes) + " nodes, any other has one", place};
  if (const auto error = checkSlopeGrid(spec, place)) return error;
  const bool lsq = spec.fit == FitMethod::lsq;
  const bool gauss = spec.fit == FitMethod::gauss;
  if (gauss && spec.kernel != LatticeKernel::linear) return Error{"@gauss takes no kernel", place};
  const int limit = lsq ? kMaxLsqVectors : gauss ? kMaxGaussVectors : kMaxShVectors;
  if (spec.shVectors() > limit)
    return Error{std::to_string(spec.shVectors()) + " SH vectors; at most " + std::to_string(limit) +
                     (lsq     ? " with least squares"
                      : gauss ? " with @gauss"
                              : ""),
                 place};
  return std::nullopt;
}

Result<RigSpec> parseRigSpec(std::string_view text) {
  RigSpec spec;
  std::ranges::copy_if(text, std::back_inserter(spec.text), [](char c) { return c != ' ' && c != '\t'; });
  const std::string place = "rig spec '" + printable(std::string(text)) + "'";
  if (spec.text.empty()) return Error{"empty", place};

  const auto at = spec.text.find('@');
  std::string wrong = parseModel(std::string_view(spec.text).substr(0, at), spec);
  if (wrong.empty() && at != std::string::npos) wrong = parseFit(std::string_view(spec.text).substr(at + 1), spec);
  if (!wrong.empty()) return Error{printable(std::move(wrong)), place};
  if (const auto error = checkRigSpec(spec)) return *error;
  return spec;
}

Result<std::vector<RigSpec>> parseRigSpecs(std::string_view text) {
  std::vector<RigSpec> specs;
  for (std::string_view part : split(text, ';')) {
    auto spec = parseRigSpec(part);
    if (!spec) return spec.error();
    if (const auto other = std::ranges::find(specs, *spec); other != specs.end()) {
      const bool sameText = other->text == spec->text;
      return Error{sameText ? "given twice" : "the same rig as '" + other->text + "'", "rig spec '" + spec->text + "'"};
    }
    specs.push_back(*std::move(spec));
  }
  return specs;
}

}  // namespace rigel
