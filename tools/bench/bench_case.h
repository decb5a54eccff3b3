// One benchmark: what runs, and what its time is given per.
#pragma once

#include <rigel/vec3.h>

#include <benchmark/benchmark.h>

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace rigel::tools {

struct BenchCase {
  std::string name;
  std::string unit;
  double perIteration = 1;  // items: lights x points, characters, points
  double nanosecondsPerUnit = 1;
  std::string baseline;
  std::function<void(benchmark::State&)> body;
  double flops = 0;         // floating-point operations an item, for its share of kPeakFigure; 0: none is given
  bool manualTime = false;  // the body says what counts (SetIterationTime), kManualIterations times a repetition

  // Of a figure that follows from others, whose least times an item [ns] `derive` takes; it has no body.
  std::vector<std::string> from = {};
  std::function<double(std::span<const double>)> derive = {};
};

inline constexpr int kManualIterations = 40;

/// What the machine's multiply-adds take at best.
inline constexpr const char* kPeakFigure = "limit.fma";

/// The surface of a body about the size of a person; its box is [-.3, .3] x [-.9, .9] x [-.2, .2] m.
std::vector<Vec3> bodySurface();

/// What the machine does at most.
void addLimitCases(std::vector<BenchCase>& cases);

/// Lights projected at points, in vectors, beside the textbook's form.
void addProjectionCases(std::vector<BenchCase>& cases);

/// Lights evaluated at points one by one against exact irradiance in double, and at many points in vectors.
void addNearCases(std::vector<BenchCase>& cases);

/// Bounds of lights' errors: made for a rig in a pose, and asked about a light.
void addBoundCases(std::vector<BenchCase>& cases);

/// Whole frames of crowds, their stages, and how they scale.
void addCrowdCases(std::vector<BenchCase>& cases);

/// The same on two threads.
class LazyPeople;
void addCrowdThreadCases(std::vector<BenchCase>& cases, const std::shared_ptr<LazyPeople>& thousand,
                         const std::shared_ptr<LazyPeople>& many);

/// Disk lights, one and many points at a time, beside Wallace's approximation.
void addDiskCases(std::vector<BenchCase>& cases);

/// Objects in cities of many lamps; building and refitting the light tree.
void addCrowdLightCases(std::vector<BenchCase>& cases);

}  // namespace rigel::tools
