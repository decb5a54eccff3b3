// Error against cost of one object: sums of hand-made rows against direct evaluation in double, and what a choice may
// never do.
#include "trade_off.h"

#include "reference/worst.h"

#include <algorithm>
#include <numeric>

#include "rig_fixture.h"

namespace rigel::test {
namespace {

using reference::Worst;
using Kind = LightingTarget::Kind;

constexpr int kNested = 12, kPoints = 24, kWidth = 27, kTruncatedRows = 8, kTruncatedWidth = 48;
constexpr int kHighFirst = 21, kHighCount = 27;

/// Rows of random lights: strength falls off by `octaves` from the first to the last, coefficients by a factor of two
/// each.
struct Lights {
  Lights(int count, unsigned seed, double octaves = 6, double scale = 1) : damping(kNested, 1.0f) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    std::uniform_real_distribution<float> unit(0, 1);
    rows.nested = kNested;
    rows.residuals = kPoints;
    rows.width = kWidth;
    rows.truncatedRows = kTruncatedRows;
    rows.truncated = kTruncatedRows * kTruncatedWidth;
    rows.highFirst = kHighFirst;
    rows.highCount = kHighCount;
    rows.tail = 1.2f;
    rows.weight.resize(kWidth);
    for (float& w : rows.weight) w = 0.2f + unit(random);
    rows.resize(count);
    for (int i = 0; i <= count; ++i) {
      const bool rest = i == count;
      const double octave = rest ? octaves + 1 : octaves * i / std::max(1, count - 1);
      const auto size = static_cast<float>(scale * std::exp2(-octave));
      for (int r = 0; r < rows.rows(); ++r) {
        const float row = size * (r < kNested ? std::exp2(-0.5f * static_cast<float>(r)) : 0.002f);
        for (int j = 0; j < kWidth; ++j) rows.fields[(i * rows.rows() + r) * kWidth + j] = row * normal(random);
      }
      for (int j = 0; j < rows.truncated; ++j)
        rows.truncation[i * rows.truncated + j] = 0.004f * size * (0.5f + normal(random));
      rows.excess[i] = i % 3 == 0 ? 1e-4f * size * size : 0.0f;
    }
    std::ranges::fill(rows.fade, 1.0f);
    damping[5] = 0.8f;
    damping[9] = 0.01f;
  }

  LightRows rows;
  std::vector<float> damping;
};

struct Errors {
  std::vector<double> beyond;
  double excess = 0, truncation = 0, truncationHigh = 0;
  double used = 0;  // of spatialSquare, for given coefficient weights
};

double inflationOf(double points, double used) { return std::pow(points / std::max(points - used, points / 4), 2); }

/// As trade_off.h states it, straight from the rows.
Errors direct(const LightRows& rows, std::span<const float> damping, std::span<const float> weights,
              std::span<const float> kept) {
  const auto share = [&](int i) { return i == rows.lights ? 1.0 : 1 - static_cast<double>(weights[i]); };
  const auto summed = [&](const std::vector<float>& from, std::size_t size, std::size_t j) {
    double sum = 0;
    for (int i = 0; i <= rows.lights; ++i) sum += share(i) * static_cast<double>(from[i * size + j]);
    return sum;
  };
  const auto rowEnergy = [&](int r) {
    double sum = 0;
    for (int i = 0; i < rows.width; ++i) {
      const double v = summed(rows.fields, rows.block(), static_cast<std::size_t>(r) * rows.width + i);
      sum += static_cast<double>(rows.weight[i]) * v * v;
    }
    return sum;
  };
  Errors out;
  for (int i = 0; i <= rows.lights; ++i) out.excess += share(i) * share(i) * static_cast<double>(rows.excess[i]);
  std::vector<double> energy;
  for (int r = 0; r < rows.rows(); ++r) energy.push_back(rowEnergy(r));
  const double rest = std::accumulate(energy.begin() + rows.nested, energy.end(), 0.0);
  for (int k = 0; k <= rows.nested; ++k) {
    double sum = rest;
    for (int j = 0; j < rows.nested; ++j)
      sum += energy[j] * (j < k ? std::pow(1 - static_cast<double>(damping[j]), 2) : 1.0);
    out.beyond.push_back(sum *
                         (rows.nested > 0 ? inflationOf(rows.residuals, k) : static_cast<double>(rows.inflation)));
    if (k > 0) out.beyond[k] = std::min(out.beyond[k], out.beyond[k - 1]);
  }
  for (double& square : out.beyond) square += out.excess;
  double lost = rest, count = 0;
  for (int j = 0; j < rows.nested; ++j) {
    lost += energy[j] * std::pow(1 - static_cast<double>(damping[j]) * static_cast<double>(kept[j]), 2);
    count += static_cast<double>(kept[j]);
  }
  out.used =
      lost * (rows.nested > 0 ? inflationOf(rows.residuals, count) : static_cast<double>(rows.inflation)) + out.excess;

  double mean = 0;
  for (int j = 0; j < rows.truncated; ++j) out.truncation += std::pow(summed(rows.truncation, rows.truncated, j), 2);
  out.truncation *= static_cast<double>(rows.tail);
  const int perRow = rows.truncatedRows > 0 ? rows.truncated / rows.truncatedRows : 0;
  for (int i = rows.highFirst; i < rows.highFirst + rows.highCount; ++i) {
    double sum = 0;
    for (int s = 0; s < rows.truncatedRows; ++s) sum += summed(rows.truncation, rows.truncated, s * perRow + i);
    mean += sum * sum / rows.truncatedRows;
  }
  out.truncationHigh = std::max(0.0, out.truncation - mean);
  return out;
}

TEST(TradeOff, ErrorsEqualDirectEvaluation) {
  Worst worst("errors of rows, relative");  // float sums of a thousand terms; 1.3e-6
  std::mt19937 random(4);
  std::uniform_real_distribution<float> unit(0, 1);
  for (unsigned seed = 0; seed < 12; ++seed) {
    Lights lights(static_cast<int>(seed), seed);
    if (seed % 4 == 3) {  // a fixed rig
      lights.rows.nested = 0;
      lights.rows.residuals = kNested + kPoints;
      lights.rows.inflation = 1.3f;
      lights.damping.clear();
    }
    std::vector<float> weights(lights.rows.lights), kept(lights.rows.nested);
    for (float& w : weights) w = unit(random) < 0.3f ? std::round(unit(random)) : unit(random);
    for (float& k : kept) k = unit(random);
    FarError out;
    TradeOff().farError(lights.rows, lights.damping, weights, out);
    const Errors expected = direct(lights.rows, lights.damping, weights, kept);
    const auto compare = [&](float value, double truth, const char* what) {
      worst.add(std::abs(static_cast<double>(value) - truth) / std::max(truth, 1e-12), [&] {
        return std::string(what) + ", seed " + std::to_string(seed) + ": " + std::to_string(value) + " for " +
               std::to_string(truth);
      });
    };
    ASSERT_EQ(out.beyond.size(), expected.beyond.size());
    for (std::size_t j = 0; j < out.beyond.size(); ++j) compare(out.beyond[j], expected.beyond[j], "beyond");
    compare(out.excess, expected.excess, "excess");
    compare(out.truncation, expected.truncation, "truncation");
    compare(out.truncationHigh, expected.truncationHigh, "truncation with the high band");
    compare(TradeOff::spatialSquare(lights.rows, out, lights.damping, kept), expected.used, "spatial square");
  }
  worst.expectWithin(1e-5);
}

TEST(TradeOff, InflationIsThatOfCrossValidation) {
  EXPECT_EQ(inflation(24, 0), 1);
  EXPECT_FLOAT_EQ(inflation(24, 12), 4);
  EXPECT_FLOAT_EQ(inflation(24, 24), 16);  // held
  EXPECT_FLOAT_EQ(inflation(24, 100), 16);
}

TEST(TradeOff, WeightsAreContinuousInTheLevelAndNeverOutnumberTheSlots) {
  for (const int slots : {1, 2, 4, 16, 64}) {
    Lights lights(40, 5, 10);
    for (int i = 0; i < 6; ++i) lights.rows.fade[i] = 0.2f * static_cast<float>(i);
    TradeOff tradeOff;
    tradeOff.build(lights.rows, lights.damping, slots, true);
    std::vector<float> now(40), last;
    float largest = 0;
    constexpr float kStep = 1.0f / 512;
    for (float level = -16; level < 6; level += kStep) {
      tradeOff.weightsAt(level, now);
      EXPECT_LE(std::ranges::count_if(now, [](float w) { return w > 0; }), slots) << level;
      for (int i = 0; i < 40; ++i) {
        EXPECT_GE(now[i], 0);
        EXPECT_LE(now[i], 1);
        // The higher the level, the fewer lights are near.
        if (!last.empty()) {
          EXPECT_LE(now[i], last[i]);
          largest = std::max(largest, last[i] - now[i]);
        }
      }
      last = now;
    }
    // smoothstep'(1/2) = 1.5, over a window of a tenth of a level at e / threshold = 1.05: 10.9 an octave.
    EXPECT_LT(largest, 11 * kStep) << slots;
    EXPECT_EQ(now[0], 0);  // faded out
  }
}

/// A choice carried out, as ObjectLighting does.
struct Outcome {
  TradeOff::Choice choice;
  double spatial = 0, total = 0;  // estimates [W/m2]
  int vectors = 0, near = 0;
  double nanoseconds = 0;  // of what is evaluated
};

Outcome carryOut(const TradeOff& tradeOff, const Lights& lights, const TradeOff::Request& request) {
  Outcome out;
  tradeOff.choose(request, out.choice);
  const std::vector<float>& weights = out.choice.weights;
  std::vector<float> kept(lights.rows.nested);
  FarError error;
  tradeOff.farError(lights.rows, lights.damping, weights, error);
  const double removed = static_cast<double>(out.choice.highBand * (2 - out.choice.highBand));
  const double truncation =
      std::lerp(static_cast<double>(error.truncation), static_cast<double>(error.truncationHigh), removed);
  TradeOff::Choice settled = out.choice;
  if (request.kind == Kind::totalError)
    settled.spatialError = TradeOff::spatialRoom(request, static_cast<float>(truncation));
  out.vectors = tradeOff.coefficientWeights(error, settled, kept);
  for (std::size_t j = 0; j < kept.size(); ++j) {
    EXPECT_GE(kept[j], 0);
    EXPECT_LE(kept[j], j > 0 ? kept[j - 1] : 1.0f);
  }
  out.near = static_cast<int>(std::ranges::count_if(weights, [](float w) { return w > 0; }));
  const double square = static_cast<double>(TradeOff::spatialSquare(lights.rows, error, lights.damping, kept));
  out.spatial = std::sqrt(square);
  out.total = std::sqrt(square + truncation);
  out.nanoseconds =
      static_cast<double>(TradeOff::nanoseconds(request.cost, static_cast<float>(out.vectors),
                                                static_cast<float>(out.near), out.choice.highBand > 0 ? 1.0f : 0.0f));
  return out;
}

TradeOff::Request requestOf(Kind kind, double value) {
  TradeOff::Request request;
  request.kind = kind;
  request.value = static_cast<float>(value);
  request.highBand = kind != Kind::spatialError;
  return request;
}

const char* nameOf(Kind kind) {
  return kind == Kind::spatialError ? "spatial" : kind == Kind::totalError ? "total" : "budget";
}

// Two choices that are far apart may cost about the same (a rig of many vectors, a few lights and no rig); what lies
// between them costs more than either, and must not be taken.
TEST(TradeOff, ALooserTargetCostsNoMore) {
  for (const Kind kind : {Kind::spatialError, Kind::totalError}) {
    Worst worst(std::string("cost of a looser target over that of a tighter one, less 1: ") + nameOf(kind));
    int crossings = 0;
    for (unsigned seed = 0; seed < 8; ++seed) {
      const Lights lights(1 + 6 * static_cast<int>(seed), seed);
      TradeOff tradeOff;
      tradeOff.build(lights.rows, lights.damping, 64, kind == Kind::totalError);
      double last = 0;
      TradeOff::Choice choice;
      int level = lights.rows.lights;
      for (double value = 1e-3; value < 10; value *= 1.05) {
        tradeOff.choose(requestOf(kind, value), choice);
        const double cost = static_cast<double>(choice.nanoseconds);
        EXPECT_TRUE(std::isfinite(cost));
        if (last > 0)
          worst.add(cost / last - 1, [&] { return "seed " + std::to_string(seed) + ", " + std::to_string(value); });
        crossings += std::abs(choice.pick.level - level) > 1;
        level = choice.pick.level;
        last = cost + 1e-9;
      }
    }
    worst.expectWithin(1e-6);
    EXPECT_GT(crossings, 0) << "no two choices far apart were compared";
  }
}

// Lights leave as the rig becomes ready: not before any coefficient is there, freely once all are.
TEST(TradeOff, ReadinessIsTheShareOfTheWantedCoefficients) {
  const Lights lights(12, 3);
  TradeOff tradeOff;
  tradeOff.build(lights.rows, lights.damping, 64, false);
  TradeOff::Choice choice;
  tradeOff.choose(requestOf(Kind::spatialError, 0.3), choice);
  FarError error;
  tradeOff.farError(lights.rows, lights.damping, choice.weights, error);
  std::vector<float> kept(kNested), none(kNested, 0.0f), all(kNested, 1.0f);
  ASSERT_GT(tradeOff.coefficientWeights(error, choice, kept), 1);
  EXPECT_EQ(tradeOff.readiness(choice, none), 0);
  EXPECT_EQ(tradeOff.readiness(choice, all), 1);
  EXPECT_NEAR(tradeOff.readiness(choice, kept), 1, 1e-6);
  for (float& weight : kept) weight *= 0.25f;
  EXPECT_NEAR(tradeOff.readiness(choice, kept), 0.25, 1e-6);
}

/// Least estimate that any choice reaches: all lights with a slot near, all coefficients.
double leastError(const TradeOff& tradeOff, const Lights& lights, bool total) {
  std::vector<float> weights(lights.rows.lights), all(lights.rows.nested, 1.0f);
  tradeOff.weightsAt(-40, weights);
  FarError error;
  tradeOff.farError(lights.rows, lights.damping, weights, error);
  const float square = std::min(TradeOff::spatialSquare(lights.rows, error, lights.damping, all), error.beyond.back());
  return std::sqrt(static_cast<double>(square + (total ? error.truncationHigh : 0)));
}

TEST(TradeOff, AHeldChoiceStandsUntilAnotherIsClearlyCheaper) {
  Worst dearer("what a held choice is dearer by than the cheapest, of its cost");
  int held = 0, left = 0;
  for (unsigned seed = 0; seed < 8; ++seed) {
    const Lights lights(1 + 6 * static_cast<int>(seed), seed);
    TradeOff tradeOff;
    tradeOff.build(lights.rows, lights.damping, 64, true);
    for (double value = 1.5 * leastError(tradeOff, lights, true); value < 10; value *= 1.2) {
      TradeOff::Request request = requestOf(Kind::totalError, value);
      TradeOff::Choice cheapest, choice;
      tradeOff.choose(request, cheapest);
      for (int level = 0; level <= lights.rows.lights; ++level)
        for (const bool high : {false, true}) {
          request.held = TradeOff::Pick{level, high};
          tradeOff.choose(request, choice);
          if (choice.pick == cheapest.pick) {
            ++left;
            continue;
          }
          EXPECT_EQ(choice.pick, *request.held) << "seed " << seed << ", target " << value;
          dearer.add(static_cast<double>((choice.objective - cheapest.objective) / choice.nanoseconds),
                     [&] { return "seed " + std::to_string(seed) + ", target " + std::to_string(value); });
          ++held;
        }
    }
  }
  dearer.expectWithin(0.03 + 1e-5);
  EXPECT_GT(held, 20);
  EXPECT_GT(left, 20);
}

// A coefficient fades in between 0.7 and 0.9 times the error without it, and levels blend: what is left may pass the
// target by a quarter, for which the margins of ObjectLighting make up.
TEST(TradeOff, AFeasibleTargetIsMetByItsOwnEstimate) {
  for (const Kind kind : {Kind::spatialError, Kind::totalError}) {
    const bool total = kind == Kind::totalError;
    Worst worst(std::string("estimate over target, less 1: ") + nameOf(kind));
    for (unsigned seed = 0; seed < 8; ++seed) {
      const Lights lights(1 + 6 * static_cast<int>(seed), seed);
      TradeOff tradeOff;
      tradeOff.build(lights.rows, lights.damping, 64, total);
      const double least = leastError(tradeOff, lights, total);
      for (double value = 1.5 * least; value < 10; value *= 1.1) {
        const Outcome out = carryOut(tradeOff, lights, requestOf(kind, value));
        worst.add((total ? out.total : out.spatial) / value - 1, [&] {
          return "seed " + std::to_string(seed) + ", target " + std::to_string(value) + ", least " +
                 std::to_string(least) + ", vectors " + std::to_string(out.vectors) + ", near " +
                 std::to_string(out.near);
        });
      }
    }
    worst.expectWithin(0.3);
  }
}

TEST(TradeOff, ABudgetIsKept) {
  Worst small("cost over budget [ns], below 100 ns"), worst("cost over budget [ns]"),
      gain("error of a larger budget over that of a smaller one, less 1");
  for (unsigned seed = 0; seed < 8; ++seed) {
    const Lights lights(1 + 6 * static_cast<int>(seed), seed);
    TradeOff tradeOff;
    tradeOff.build(lights.rows, lights.damping, 64, true);
    double last = 0;
    for (double budget = 50; budget < 1000; budget *= 1.03) {
      const Outcome out = carryOut(tradeOff, lights, requestOf(Kind::budget, budget));
      const auto where = [&] {
        return "seed " + std::to_string(seed) + ", budget " + std::to_string(budget) + " ns, vectors " +
               std::to_string(out.vectors) + ", near " + std::to_string(out.near) + ", high " +
               std::to_string(out.choice.highBand);
      };
      (budget < 100 ? small : worst).add(out.nanoseconds - budget, where);
      if (last > 0) gain.add(out.total / last - 1, where);
      last = out.total;
    }
  }
  small.expectWithin(3);
  worst.expectWithin(3);
  gain.expectWithin(0.1);
}

// Near lights that nobody can pay for are neither evaluated nor counted.
TEST(TradeOff, NoNearLightCostsNothing) {
  for (const int count : {1, 2, 20}) {
    const Lights lights(count, 2);
    TradeOff tradeOff;
    tradeOff.build(lights.rows, lights.damping, 64, true);
    for (const Kind kind : {Kind::spatialError, Kind::totalError, Kind::budget}) {
      TradeOff::Request request = requestOf(kind, kind == Kind::budget ? 60 : 0.1);
      request.cost.nearLight = 1e5f;
      const Outcome out = carryOut(tradeOff, lights, request);
      EXPECT_EQ(out.near, 0) << nameOf(kind);
      EXPECT_GT(out.vectors, 0) << nameOf(kind);
      EXPECT_LT(out.choice.nanoseconds, 100) << nameOf(kind);
    }
    TradeOff::Choice nothing;
    tradeOff.choose(requestOf(Kind::spatialError, 1000), nothing);
    EXPECT_LT(nothing.nanoseconds, 1e-3f) << "no rig either";
  }
}

TEST(TradeOff, NoLightsAndBlackLights) {
  for (const int count : {0, 5})
    for (const Kind kind : {Kind::spatialError, Kind::totalError, Kind::budget})
      for (const double value : {0.0, 0.02, 100.0}) {
        const Lights lights(count, 1, 6, 0);
        TradeOff tradeOff;
        tradeOff.build(lights.rows, lights.damping, 64, true);
        const Outcome out = carryOut(tradeOff, lights, requestOf(kind, value));
        const std::string what = std::string(nameOf(kind)) + " " + std::to_string(value);
        EXPECT_TRUE(std::ranges::all_of(out.choice.weights, [](float w) { return w >= 0 && w <= 1; })) << what;
        EXPECT_TRUE(std::isfinite(out.choice.nanoseconds)) << what;
        EXPECT_TRUE(std::isfinite(out.choice.highBand)) << what;
        EXPECT_TRUE(std::isfinite(out.choice.spatialError)) << what;
        EXPECT_EQ(out.near, 0) << what;
        if (kind != Kind::budget) {
          EXPECT_EQ(out.vectors, 0) << what;
        }
        EXPECT_EQ(out.spatial, 0) << what;
      }
}

TEST(TradeOff, OneLightAMillionTimesBrighter) {
  Lights lights(20, 3, 1);
  for (std::size_t j = 0; j < lights.rows.block(); ++j) lights.rows.fields[7 * lights.rows.block() + j] *= 1e6f;
  for (int j = 0; j < lights.rows.truncated; ++j) lights.rows.truncation[7 * lights.rows.truncated + j] *= 1e6f;
  TradeOff tradeOff;
  tradeOff.build(lights.rows, lights.damping, 64, true);
  const double least = leastError(tradeOff, lights, true);
  // From all of it in the rig to all other lights near.
  for (double value = 1.5 * least; value < 1e7; value *= 2) {
    const Outcome out = carryOut(tradeOff, lights, requestOf(Kind::totalError, value));
    EXPECT_LE(out.total, 1.3 * value);
    EXPECT_LE(out.nanoseconds, 42 + 12 * 1.9 + 21 * 21 + 15);
    if (value < 1e4) {
      EXPECT_EQ(out.choice.weights[7], 1) << value;
    }
  }
}

}  // namespace
}  // namespace rigel::test
