// How much of a run the page's 3-D views show: which objects and frames, and how finely.
#pragma once

#include <cstddef>
#include <vector>

namespace rigel::tools {

/// What a report's views may take on the page and in time. What does not fit is left out, and the page says so.
struct ViewBudget {
  std::size_t bytes = 1'400'000;         // on the page, as base64
  std::size_t evaluations = 30'000'000;  // of a light's exact irradiance at a vertex: a second on one core
  std::size_t objects = 8;
};

inline constexpr std::size_t kViewFrames = 16;         // at most
inline constexpr std::size_t kViewVertices = 8000;     // at most: 16,000 triangles or so
inline constexpr std::size_t kViewLightPlaces = 4096;  // lights x frames, at most
inline constexpr std::size_t kViewSamples = 128;       // of a rig, at most: more would hide the object
inline constexpr std::size_t kWrapEvaluations = 40;    // as many of Lambert's as one with wrap takes

/// The budget of one of `scenes` scenes and clips of a report.
ViewBudget shareOf(const ViewBudget& budget, std::size_t scenes);

/// What a plan depends on.
struct ViewDemand {
  std::vector<double> errors;            // of each object: those with the largest are shown
  std::vector<std::size_t> worstFrames;  // of each; views of few objects show them
  std::size_t frames = 0;
  std::size_t rigs = 0;
  std::size_t evaluations = 0;  // at a point: the lights, kWrapEvaluations times as many where materials wrap
};

struct ViewPlan {
  std::vector<std::size_t> objects;  // rising
  std::vector<std::size_t> frames;   // of the run, rising
  std::size_t vertices = 0;          // of each object, at most
  std::size_t bytes = 0;             // of each object on the page, at most
};

/// `count` (1 to `all`) of `all` indices, evenly spread from the first to the last.
std::vector<std::size_t> spread(std::size_t all, std::size_t count);

/// Shows no object where even the least view of one would be too large.
ViewPlan planViews(const ViewDemand& demand, const ViewBudget& budget);

}  // namespace rigel::tools
